//! Textures that follow a few points of an object, the particles.
//!
//! This is method (a) of Bousseau, Kaplan, Thollot and Sillion 2006. Each particle has a copy of
//! the texture, which is flat in the picture and moves with the particle. A pixel blends the
//! copies by its distance from the particles on the object.

use glam::Vec3;
use rayon::prelude::*;

use super::hierarchy::{Hierarchy, Seed};
use super::projection::Projection;
use crate::compute::{Compute, GpuCompute, GreyImage, Image, Plane, assert_size};
use crate::field::Field;
use crate::gpu::{DeviceError, Kernel, Storage, layout};

/// Draws a texture that follows particles. The result is 0.5 plus the blended differences of its
/// copies from 0.5, clamped to 0..1. Pixels of `depth` 1 show no surface and get 0.5.
///
/// The weight of a copy is `(1 - (s - s_min) / reach)^2`. Here s is the squared distance of its
/// particle from the position that the pixel shows, and s_min is the same for the nearest
/// particle. Blending lowers contrast. We divide the sum by the root of the sum of squared
/// weights, which restores it where copies are uncorrelated (Heeger and Bergen 1995).
///
/// # Errors
/// [`DeviceError`] if a device has no memory left or was lost, never on the processor.
///
/// # Panics
/// If the width or height of the texture, which repeats, is not a power of two, if `depth` does
/// not have the size of the anchors' projection, or if another form of [`Compute`] made an image.
pub fn draw_anchored(
    compute: &mut Compute,
    depth: &GreyImage,
    texture: &GreyImage,
    anchors: &Anchors,
) -> Result<GreyImage, DeviceError> {
    let (width, height) = texture.size();
    let repeats = width.is_power_of_two() && height.is_power_of_two();
    assert!(repeats, "a repeating texture has sides of powers of two, found {width} x {height}");
    assert_size("depth", depth.size(), (anchors.projection.width, anchors.projection.height));
    match compute {
        Compute::Cpu => Ok(draw_anchored_on_cpu(depth.host(), texture.host(), anchors).into()),
        Compute::Gpu(gpu) => {
            draw_anchored_on_gpu(gpu, depth.plane(), texture.plane(), anchors).map(Image::from)
        }
    }
}

fn bilinear(texture: &Field<f32>, x: f32, y: f32) -> f32 {
    let left = x.floor();
    let top = y.floor();
    let right = x - left;
    let down = y - top;
    let columns = texture.width() - 1;
    let rows = texture.height() - 1;
    let i = left as i32 as usize;
    let j = top as i32 as usize;
    let values = texture.values();
    let upper = (j & rows) * texture.width();
    let lower = (j.wrapping_add(1) & rows) * texture.width();
    let (i, next) = (i & columns, i.wrapping_add(1) & columns);
    let above = values[upper + i] + (values[upper + next] - values[upper + i]) * right;
    let below = values[lower + i] + (values[lower + next] - values[lower + i]) * right;
    above + (below - above) * down
}

fn copy(texture: &Field<f32>, anchor: &Anchor, octaves: usize, right: f32, down: f32) -> f32 {
    let mut texels = anchor.texels;
    let mut sum = 0.0;
    for octave in 0..octaves {
        let x = right * texels + anchor.right[octave];
        let y = down * texels + anchor.down[octave];
        sum += anchor.weights[octave] * (bilinear(texture, x, y) - 0.5);
        texels *= 0.5;
    }
    sum
}

fn draw_anchored_on_cpu(depth: &Field<f32>, texture: &Field<f32>, anchors: &Anchors) -> Field<f32> {
    let width = depth.width();
    let height = depth.height();
    let mut blended = Field::filled(width, height, 0.5);
    let rows = blended.values_mut().par_chunks_mut(width.max(1)).enumerate();
    rows.for_each_init(
        || vec![0.0f32; anchors.each.len()],
        |distances, (y, values)| {
            let depths = depth.row(y, 0, width);
            for (x, (value, &depth)) in values.iter_mut().zip(depths).enumerate() {
                if depth < 1.0 {
                    let position = anchors.projection.unproject((x, y), depth);
                    let at = [x as f32 + 0.5, y as f32 + 0.5];
                    let sum = blend(texture, anchors, position, at, distances);
                    *value = (0.5 + sum).clamp(0.0, 1.0);
                }
            }
        },
    );
    blended
}

/// Blends all copies at a pixel that shows `position`. `distances` is scratch memory, one number
/// for each anchor.
fn blend(
    texture: &Field<f32>,
    anchors: &Anchors,
    position: Vec3,
    at: [f32; 2],
    distances: &mut [f32],
) -> f32 {
    let mut nearest = f32::INFINITY;
    for (distance, anchor) in distances.iter_mut().zip(&anchors.each) {
        *distance = position.distance_squared(anchor.position.into());
        nearest = nearest.min(*distance);
    }
    let mut sum = 0.0;
    let mut squares = 0.0;
    for (distance, anchor) in distances.iter().zip(&anchors.each) {
        let near = 1.0 - (distance - nearest) / anchors.reach_squared;
        if near > 0.0 {
            let weight = near * near * anchor.presence;
            let right = at[0] - anchor.x;
            let down = at[1] - anchor.y;
            sum += weight * copy(texture, anchor, anchors.octaves, right, down);
            squares += weight * weight;
        }
    }
    sum / squares.sqrt()
}

#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
struct AnchoredParams {
    model_from_clip: [[f32; 4]; 4],
    width: u32,
    height: u32,
    texture_width: u32,
    texture_height: u32,
    first: u32,
    count: u32,
    octaves: u32,
    reach_squared: f32,
}

/// The kernel that blends the copies of a texture at each pixel.
pub static ANCHOR_TEXTURES: Kernel = Kernel {
    name: "anchor_textures",
    source: include_str!("anchored.wgsl"),
    parameters: layout!(AnchoredParams {
        model_from_clip,
        width,
        height,
        texture_width,
        texture_height,
        first,
        count,
        octaves,
        reach_squared,
    }),
    structs: &[layout!(Anchor { position, presence, x, y, texels, spare, weights, right, down })],
    storage: &[Storage::Read, Storage::Read, Storage::Batch, Storage::Write],
};

fn draw_anchored_on_gpu(
    gpu: &mut GpuCompute,
    depth: &Plane<f32>,
    texture: &Plane<f32>,
    anchors: &Anchors,
) -> Result<Plane<f32>, DeviceError> {
    let (width, height) = depth.size();
    let (texture_width, texture_height) = texture.size();
    let blended = gpu.plane(width, height)?;
    let params = AnchoredParams {
        model_from_clip: anchors.projection.model_from_clip().to_cols_array_2d(),
        width: width as u32,
        height: height as u32,
        texture_width: texture_width as u32,
        texture_height: texture_height as u32,
        first: gpu.batch(&anchors.each),
        count: anchors.each.len() as u32,
        octaves: anchors.octaves.min(MOST_OCTAVES) as u32,
        reach_squared: anchors.reach_squared,
    };
    let buffers = [depth.buffer(), texture.buffer(), blended.buffer()];
    gpu.dispatch(&ANCHOR_TEXTURES, &params, &buffers, (width, height));
    Ok(blended)
}

/// Iterations of Lloyd's algorithm. We chose more than needed: on the tested models, particles
/// stop moving after fewer.
const LLOYD_ROUNDS: usize = 20;

/// Copies blend where the squared distances of two particles differ by less than this fraction of
/// the squared distance between neighbouring particles. We chose it by eye.
const BLEND: f32 = 0.5;

pub(super) const MOST_OCTAVES: usize = 8;

/// Particles spread evenly over a mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct Particles {
    pub(super) positions: Vec<Vec3>,
    /// Mean squared distance between neighbours.
    spacing_squared: f32,
}

/// How to draw a texture that follows particles: as an infinite zoom. Its waves keep their length
/// in the picture while the model comes nearer or moves away.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AnchoredNoise {
    /// Length of the texture's waves in the picture, in pixels, above 0.
    pub wave_px: f32,
    /// Length of the waves in the texture, in texels, above 0.
    pub wave_texels: f32,
    /// Octaves of the infinite zoom, 2 to 8.
    pub octaves: usize,
    /// Seed of the offsets at which the copies begin in the texture.
    pub seed: u64,
}

impl AnchoredNoise {
    /// Slow changes. Use this with a texture with waves of 32 texels.
    pub const FLOW: Self = Self { wave_px: 80.0, wave_texels: 32.0, octaves: 4, seed: 1 };
    /// Fine grain. Use this with a texture with waves of 8 texels.
    pub const DISPERSION: Self = Self { wave_px: 10.0, wave_texels: 8.0, octaves: 4, seed: 2 };
}

/// One copy of the texture in the picture. The kernel reads this layout.
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub struct Anchor {
    /// Position of the particle in the unit of the model.
    pub position: [f32; 3],
    /// Weight of the copy: 1, falling to 0 while the particle passes the near plane.
    pub presence: f32,
    /// Distance of the particle from the left edge of the picture, in pixels.
    pub x: f32,
    /// Distance of the particle from the upper edge of the picture, in pixels.
    pub y: f32,
    /// Texels per pixel of the finest octave. Each further octave has half as many.
    pub texels: f32,
    /// Padding to the alignment of WGSL.
    pub spare: f32,
    /// Weight of each octave, the finest first. The squares sum to 1.
    pub weights: [f32; MOST_OCTAVES],
    /// Horizontal offset in the texture at which each octave begins, in texels.
    pub right: [f32; MOST_OCTAVES],
    /// Vertical offset in the texture at which each octave begins, in texels.
    pub down: [f32; MOST_OCTAVES],
}

/// All copies of the texture in one picture.
#[derive(Debug, Clone, PartialEq)]
pub struct Anchors {
    pub(super) each: Vec<Anchor>,
    pub(super) octaves: usize,
    /// A copy fades to 0 where its squared distance exceeds the nearest copy's by this.
    pub(super) reach_squared: f32,
    pub(super) projection: Projection,
}

impl Particles {
    /// Spreads `count` particles, at least one, over a mesh. The first ones start at the centres
    /// of the faces of the bounding box, further ones where the mesh is farthest from all others.
    /// Then all move to the centroids of the parts of the mesh nearest to them (Lloyd 1982). This
    /// keeps distances from the particles small, so the texture slides little over the mesh.
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
            return Self { positions: vec![Vec3::ZERO], spacing_squared: 1.0 };
        }
        let center = (low + high) / 2.0;
        let half = (high - low) / 2.0;
        let sides = [Vec3::Z, Vec3::NEG_Z, Vec3::X, Vec3::NEG_X, Vec3::Y, Vec3::NEG_Y];
        let mut positions: Vec<Vec3> =
            sides.iter().take(count.max(1)).map(|side| center + *side * half).collect();
        let points: Vec<(Vec3, f64)> = hierarchy
            .faces
            .iter()
            .map(|face| (face.corners.iter().sum::<Vec3>() / 3.0, face.area))
            .collect();
        while positions.len() < count {
            fn away(at: Vec3, positions: &[Vec3]) -> f32 {
                nearest_of(positions, at).1
            }
            let farthest = points
                .iter()
                .max_by(|a, b| away(a.0, &positions).total_cmp(&away(b.0, &positions)));
            positions.extend(farthest.map(|point| point.0));
        }
        for _ in 0..LLOYD_ROUNDS {
            let mut sums = vec![[0.0f64; 4]; positions.len()];
            for &(position, area) in &points {
                let sum = &mut sums[nearest_of(&positions, position).0];
                for (sum, value) in sum.iter_mut().zip([position.x, position.y, position.z, 1.0]) {
                    *sum += f64::from(value) * area;
                }
            }
            for (position, [x, y, z, area]) in positions.iter_mut().zip(sums) {
                if area > 0.0 {
                    *position = Vec3::from([x, y, z].map(|sum| (sum / area) as f32));
                }
            }
        }
        let nearest = (0..positions.len()).map(|own| {
            let others = (0..positions.len()).filter(|&other| other != own);
            let squares = others.map(|other| positions[own].distance_squared(positions[other]));
            squares.fold(f32::INFINITY, f32::min)
        });
        let mean = nearest.sum::<f32>() / positions.len() as f32;
        let spacing_squared = if mean.is_finite() && mean > 0.0 { mean } else { 1.0 };
        Self { positions, spacing_squared }
    }

    /// Positions of the particles in the unit of the model.
    #[must_use]
    pub fn positions(&self) -> &[Vec3] {
        &self.positions
    }

    /// The copies of a texture to draw in a projection. Pass this to
    /// [`draw_anchored`].
    #[must_use]
    pub fn anchors(&self, projection: &Projection, noise: AnchoredNoise) -> Anchors {
        let octaves = noise.octaves.clamp(2, MOST_OCTAVES);
        let each = self
            .positions
            .iter()
            .enumerate()
            .map(|(number, &position): (usize, &Vec3)| {
                let at = projection.project_clamped(position);
                let zoom = (projection.focal_px / at.distance * self.spacing_squared.sqrt()).log2();
                let whole = zoom.floor();
                let part = zoom - zoom.floor();
                let near = projection.camera.near;
                let presence = ((at.along - near) / near).clamp(1e-3, 1.0);
                let mut anchor = Anchor {
                    position: position.into(),
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
                    let phase = (octave as f32 + part) / octaves as f32;
                    let weight = (std::f32::consts::PI * phase).sin();
                    anchor.weights[octave] = weight * (2.0 / octaves as f32).sqrt();
                    // As the model comes nearer, this octave becomes the next one and keeps its seed.
                    let level = (octave as i64 - whole as i64) as u64;
                    let seed = Seed(noise.seed).child(number as u64).child(level);
                    anchor.right[octave] = 4096.0 * seed.unit(0);
                    anchor.down[octave] = 4096.0 * seed.unit(1);
                }
                anchor
            })
            .collect();
        let reach_squared = BLEND * self.spacing_squared;
        Anchors { each, octaves, reach_squared, projection: *projection }
    }
}

/// Index of the nearest position, and its squared distance.
fn nearest_of(positions: &[Vec3], at: Vec3) -> (usize, f32) {
    let all = positions.iter().map(|position| position.distance_squared(at)).enumerate();
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
    fn six_particles_of_a_sphere_face_its_six_sides() {
        let particles = Particles::new(&Hierarchy::new(&Mesh::sphere(3000)), 6);
        for side in [Vec3::X, Vec3::Y, Vec3::Z, -Vec3::X, -Vec3::Y, -Vec3::Z] {
            let facing =
                particles.positions().iter().filter(|place| place.normalize().dot(side) > 0.95);
            assert_eq!(facing.count(), 1, "{side}: {particles:?}");
        }
        let many = Particles::new(&Hierarchy::new(&Mesh::sphere(3000)), 30);
        assert_eq!(many.positions().len(), 30);
        assert!(many.spacing_squared < 0.4 * particles.spacing_squared);
        assert_eq!(Particles::new(&Hierarchy::default(), 6).positions().len(), 1);
    }

    #[test]
    fn the_zoom_is_continuous_at_every_distance() {
        let particles = Particles::new(&Hierarchy::new(&Mesh::sphere(300)), 6);
        fn at(distance: f32, particles: &Particles) -> Anchor {
            let camera = Camera {
                eye: Vec3::Z * distance,
                target: Vec3::ZERO,
                up: Vec3::Y,
                field_of_view_deg: 30.0,
                near: 0.01,
                far: 1e4,
            };
            particles.anchors(&Projection::new(&camera, 100, 100), NOISE).each[0]
        }
        // The texture ten pixels to the right of the particle.
        fn shown(anchor: Anchor) -> Vec<(f32, f32, f32)> {
            let mut octaves: Vec<(f32, f32, f32)> = (0..4)
                .map(|i| {
                    let texels = 10.0 * anchor.texels / (1 << i) as f32;
                    (anchor.right[i], texels, anchor.weights[i])
                })
                .filter(|octave| octave.2 > 0.01)
                .collect();
            octaves.sort_by(|a, b| a.0.total_cmp(&b.0));
            octaves
        }
        for step in 0..2000 {
            let distance = 2.0 + 0.01 * step as f32;
            let before = shown(at(distance, &particles));
            let after = shown(at(distance * 1.0005, &particles));
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
