//! A few places of an object that textures of pigment hold on to.
//!
//! Method (a) of Bousseau, Kaplan, Thollot and Sillion 2006: each particle has a
//! copy of the texture, flat in the picture, that moves with it; a pixel blends
//! them by its distance from the particles on the object.

use glam::Vec3;

use super::hierarchy::Hierarchy;
use super::random::Seed;
use super::sight::Sight;

/// How often particles are moved to the middle of what is theirs.
const ROUNDS: usize = 20;

/// Copies blend where the squares of two distances differ by less than this part
/// of the square of the distance between two particles: over half of the way.
const BLEND: f32 = 0.5;

/// The most octaves of an infinite zoom.
pub(super) const MOST_OCTAVES: usize = 8;

/// Particles of a mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct Particles {
    /// Where they are, in the model's unit.
    pub(super) places: Vec<Vec3>,
    /// The squared distance between neighbours, in the mean.
    spacing_squared: f32,
}

/// A texture and how it is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AnchoredNoise {
    /// What the texture's own waves are long in the picture, in pixels, above 0;
    /// it stays so while the model comes or goes.
    pub wave_px: f32,
    /// How long they are in the texture, in texels, above 0.
    pub wave_texels: f32,
    /// Octaves of the infinite zoom, 2 to 8.
    pub octaves: usize,
    /// Where in the texture each copy begins.
    pub seed: u64,
}

impl AnchoredNoise {
    /// Slow changes, of a texture with waves of 32 texels.
    pub const FLOW: Self = Self { wave_px: 80.0, wave_texels: 32.0, octaves: 4, seed: 1 };
    /// Fine grain, of a texture with waves of 8 texels.
    pub const DISPERSION: Self = Self { wave_px: 10.0, wave_texels: 8.0, octaves: 4, seed: 2 };
}

/// A copy of the texture in the picture, as backends take it.
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub struct Anchor {
    /// The particle's place in the model.
    pub place: [f32; 3],
    /// 1, or less where the particle is about to pass the eye.
    pub presence: f32,
    /// Its place in the picture, in pixels.
    pub x: f32,
    /// The same downwards.
    pub y: f32,
    /// Texels of the finest octave on a pixel; each further one has half as many.
    pub texels: f32,
    /// For alignment.
    pub spare: f32,
    /// Weight of each octave, the finest first; their squares add up to 1.
    pub weights: [f32; MOST_OCTAVES],
    /// Where in the texture each octave begins, in texels, to the right.
    pub right: [f32; MOST_OCTAVES],
    /// The same downwards.
    pub down: [f32; MOST_OCTAVES],
}

/// All copies of a picture.
#[derive(Debug, Clone, PartialEq)]
pub struct Anchors {
    pub(super) each: Vec<Anchor>,
    /// Octaves of each.
    pub(super) octaves: usize,
    /// A copy ends where its squared distance is by this farther than the nearest's.
    pub(super) reach_squared: f32,
    pub(super) sight: Sight,
}

impl Particles {
    /// `count` particles of a mesh, at least one: the middles of the faces of the
    /// box around it, further ones where the mesh is farthest from all others,
    /// then all moved to the middles of the parts of the mesh that are nearest to
    /// them (Lloyd 1982). A copy of the texture slides over the mesh the more, the
    /// farther it is from its particle; there, that is least.
    #[must_use]
    pub fn new(hierarchy: &Hierarchy, count: usize) -> Self {
        let (low, high) = hierarchy
            .faces
            .iter()
            .flat_map(|face| face.corners)
            .fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(low, high), at| {
                (low.min(at), high.max(at))
            });
        if hierarchy.faces.is_empty() {
            return Self { places: vec![Vec3::ZERO], spacing_squared: 1.0 };
        }
        let (middle, half) = ((low + high) / 2.0, (high - low) / 2.0);
        let sides = [Vec3::Z, Vec3::NEG_Z, Vec3::X, Vec3::NEG_X, Vec3::Y, Vec3::NEG_Y];
        let mut places: Vec<Vec3> =
            sides.iter().take(count.max(1)).map(|side| middle + *side * half).collect();
        let points: Vec<(Vec3, f64)> = hierarchy
            .faces
            .iter()
            .map(|face| (face.corners.iter().sum::<Vec3>() / 3.0, face.area))
            .collect();
        while places.len() < count {
            let away = |at: Vec3| distance_squared(&places, at).1;
            let farthest = points.iter().max_by(|a, b| away(a.0).total_cmp(&away(b.0)));
            places.extend(farthest.map(|point| point.0));
        }
        for _ in 0..ROUNDS {
            let mut sums = vec![[0.0f64; 4]; places.len()];
            for &(place, area) in &points {
                let sum = &mut sums[distance_squared(&places, place).0];
                for (sum, value) in sum.iter_mut().zip([place.x, place.y, place.z, 1.0]) {
                    *sum += f64::from(value) * area;
                }
            }
            for (place, [x, y, z, area]) in places.iter_mut().zip(sums) {
                if area > 0.0 {
                    *place = Vec3::from([x, y, z].map(|sum| (sum / area) as f32));
                }
            }
        }
        let nearest = (0..places.len()).map(|own| {
            let others = (0..places.len()).filter(|&other| other != own);
            let squares = others.map(|other| places[own].distance_squared(places[other]));
            squares.fold(f32::INFINITY, f32::min)
        });
        let mean = nearest.sum::<f32>() / places.len() as f32;
        let spacing_squared = if mean.is_finite() && mean > 0.0 { mean } else { 1.0 };
        Self { places, spacing_squared }
    }

    /// Where they are, in the model's unit.
    #[must_use]
    pub fn places(&self) -> &[Vec3] {
        &self.places
    }

    /// What is to be drawn of a texture in a picture.
    #[must_use]
    pub fn anchors(&self, sight: &Sight, noise: AnchoredNoise) -> Anchors {
        let octaves = noise.octaves.clamp(2, MOST_OCTAVES);
        let anchor = |(number, &place): (usize, &Vec3)| {
            let at = sight.beyond_near(place);
            let zoom = (sight.focal_px / at.distance * self.spacing_squared.sqrt()).log2();
            let (whole, part) = (zoom.floor(), zoom - zoom.floor());
            let near = sight.camera.near;
            let presence = ((at.along - near) / near).clamp(1e-3, 1.0);
            let mut anchor = Anchor {
                place: place.into(),
                presence,
                x: at.x,
                y: at.y,
                // The middle octaves are the strongest.
                texels: noise.wave_texels / noise.wave_px
                    * 2.0f32.powf(octaves as f32 / 2.0 - part),
                spare: 0.0,
                weights: [0.0; MOST_OCTAVES],
                right: [0.0; MOST_OCTAVES],
                down: [0.0; MOST_OCTAVES],
            };
            for octave in 0..octaves {
                let place = (octave as f32 + part) / octaves as f32;
                let weight = (std::f32::consts::PI * place).sin();
                anchor.weights[octave] = weight * (2.0 / octaves as f32).sqrt();
                // As it grows, this octave becomes the next: it keeps its seed.
                let same = (octave as i64 - whole as i64) as u64;
                let seed = Seed(noise.seed).below(number as u64).below(same);
                anchor.right[octave] = 4096.0 * seed.unit(0);
                anchor.down[octave] = 4096.0 * seed.unit(1);
            }
            anchor
        };
        let each = self.places.iter().enumerate().map(anchor).collect();
        let reach_squared = BLEND * self.spacing_squared;
        Anchors { each, octaves, reach_squared, sight: *sight }
    }
}

/// The nearest place and its squared distance.
fn distance_squared(places: &[Vec3], at: Vec3) -> (usize, f32) {
    let all = places.iter().map(|place| place.distance_squared(at)).enumerate();
    all.fold((0, f32::INFINITY), |nearest, own| if own.1 < nearest.1 { own } else { nearest })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::Camera;
    use crate::mesh::Mesh;

    const NOISE: AnchoredNoise =
        AnchoredNoise { wave_px: 32.0, wave_texels: 16.0, octaves: 4, seed: 3 };

    #[test]
    fn six_particles_of_a_ball_face_its_six_sides() {
        let particles = Particles::new(&Hierarchy::new(&Mesh::sphere(3000)), 6);
        for side in [Vec3::X, Vec3::Y, Vec3::Z, -Vec3::X, -Vec3::Y, -Vec3::Z] {
            let facing =
                particles.places().iter().filter(|place| place.normalize().dot(side) > 0.95);
            assert_eq!(facing.count(), 1, "{side}: {particles:?}");
        }
        let many = Particles::new(&Hierarchy::new(&Mesh::sphere(3000)), 30);
        assert_eq!(many.places().len(), 30);
        assert!(many.spacing_squared < 0.4 * particles.spacing_squared);
        assert_eq!(Particles::new(&Hierarchy::default(), 6).places().len(), 1);
    }

    #[test]
    fn zoom_has_no_end_and_no_step() {
        let particles = Particles::new(&Hierarchy::new(&Mesh::sphere(300)), 6);
        let at = |distance: f32| {
            let camera = Camera {
                eye: Vec3::Z * distance,
                target: Vec3::ZERO,
                up: Vec3::Y,
                field_of_view_deg: 30.0,
                near: 0.01,
                far: 1e4,
            };
            particles.anchors(&Sight::new(&camera, 100, 100), NOISE).each[0]
        };
        // What the texture shows ten pixels beside the particle, by its offset.
        let shown = |anchor: Anchor| {
            let mut octaves: Vec<(f32, f32, f32)> = (0..4)
                .map(|i| {
                    let texels = 10.0 * anchor.texels / (1 << i) as f32;
                    (anchor.right[i], texels, anchor.weights[i])
                })
                .filter(|octave| octave.2 > 0.01)
                .collect();
            octaves.sort_by(|a, b| a.0.total_cmp(&b.0));
            octaves
        };
        for step in 0..2000 {
            let distance = 2.0 + 0.01 * step as f32;
            let (before, after) = (shown(at(distance)), shown(at(distance * 1.0005)));
            let squares: f32 = before.iter().map(|octave| octave.2 * octave.2).sum();
            assert!((squares - 1.0).abs() < 1e-3, "{squares}");
            for (right, texels, weight) in before {
                let same = after.iter().find(|octave| octave.0 == right);
                let (_, texels_then, weight_then) = same.copied().unwrap_or((0.0, texels, 0.0));
                assert!((texels - texels_then).abs() < 0.003 * texels, "{distance}");
                assert!((weight - weight_then).abs() < 0.012, "{distance}");
            }
        }
    }
}
