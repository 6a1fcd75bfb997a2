//! Shows the volumes themselves as coloured glass over the scene.
//!
//! The glass absorbs light from the scene along the eye ray's way through the volumes (Beer and
//! Lambert). We shade the faces towards the eye, more where you see them at a grazing angle.

use glam::Vec3;
use graphics::camera::Camera;
use graphics::field::Field;
use graphics::surface::{Crossings, Fragment, NO_TRIANGLE, Rasteriser, Sides, VisibilityBuffer};
use paint::layer::SLOTS;
use rayon::prelude::*;
use spectra::color::Rgb;

use super::film::FilmHeights;
use super::through::{Density, FilmThrough};
use crate::surfaces::VolumeSurfaces;
use crate::volume::Volume;

/// How volumes look when you show them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Glass {
    /// White light has the colour of a volume after a path of this length in it, above 0, in radii
    /// of the volume.
    pub deep: f32,
    /// Opacity of the shaded face where you see it straight on, 0..1.
    pub face: f32,
    /// Opacity of the shaded face at its outline, 0..1.
    pub outline: f32,
}

impl Default for Glass {
    /// Light has the colour of a volume after a path of one radius. Faces are faint, outlines
    /// clear.
    fn default() -> Self {
        Self { deep: 1.0, face: 0.12, outline: 0.75 }
    }
}

const STEPS: f32 = 65_536.0;

/// Darkest channel of a colour of glass. This way it never blocks all light.
const DARKEST: f64 = 0.03;

const AMBIENT: f32 = 0.45;

impl Glass {
    /// The picture of `scene` through volumes of these encoded colours. It is in encoded sRGB and
    /// keeps its fourth value. `visible` is what `camera` sees of the scene, and `places` holds the
    /// places that it shows.
    ///
    /// # Panics
    /// If the pictures differ in size, or there is not one colour for each volume.
    #[must_use]
    pub fn picture(
        &self,
        scene: &Field<[f32; 4]>,
        (volumes, colors): (&[Volume], &[[f32; 3]]),
        camera: &Camera,
        visible: &VisibilityBuffer,
        places: &Field<Vec3>,
    ) -> Field<[f32; 4]> {
        assert_eq!(scene.bounds(), visible.bounds(), "pictures differ in size");
        assert_eq!(volumes.len(), colors.len(), "each volume has a colour");
        let surfaces = VolumeSurfaces::of(volumes);
        let VolumeSurfaces { vertices, triangles } = &surfaces;
        let linear: Vec<Vec3> = colors.iter().map(|&color| decoded(color)).collect();
        let densities = volumes.iter().zip(&linear).map(|(volume, &color)| {
            let mut density = Density([0.0; SLOTS + 1]);
            let per_unit = STEPS / (self.deep * volume.radius);
            let opaque = color.to_array().map(|value| -value.ln() * per_unit);
            density.0[..3].copy_from_slice(&opaque);
            density
        });
        let densities: Vec<Density> = densities.collect();
        let through = FilmThrough::new(&densities, camera, places, true);
        let sums = Crossings::default().sum(&through, surfaces.closed(), camera, visible);
        let width = scene.width();
        let height = scene.height();
        let mut fronts = Field::filled(width, height, Fragment::EMPTY);
        let clip_from_model = camera.clip_from_model(width as f32 / height.max(1) as f32);
        let mut rasteriser = Rasteriser::default();
        rasteriser.draw(clip_from_model, vertices, triangles, Sides::Front, &mut fronts);
        let faces = Faces { surfaces: &surfaces, normals: &surfaces.normals(), camera };
        let pixels = scene.values().par_iter().zip(sums.values()).with_min_len(4096);
        let pixels = pixels.zip(fronts.values()).zip(visible.values());
        let seen = pixels.map(|(((&scene, sum), front), behind)| {
            let front = (front.triangle != NO_TRIANGLE && front.depth < behind.depth)
                .then(|| faces.light(*front));
            self.pixel(scene, sum, front.map(|(volume, lit)| (linear[volume], lit)))
        });
        Field::from_values(width, height, seen.collect())
    }

    /// The colour of a pixel of the scene behind glass of this thickness. If `front` is set, a face
    /// with this colour and light lies before the scene.
    fn pixel(
        &self,
        scene: [f32; 4],
        thickness: &FilmHeights,
        front: Option<(Vec3, FaceLight)>,
    ) -> [f32; 4] {
        let FilmHeights([r, g, b, ..]) = *thickness;
        if front.is_none() && [r, g, b] == [0; 3] {
            return scene;
        }
        let opaque = [r, g, b].map(|steps| steps.max(0) as f32 / STEPS);
        let mut light = decoded_any(scene) * Vec3::from(opaque.map(|value| (-value).exp()));
        if let Some((color, lit)) = front {
            let share = self.face + (self.outline - self.face) * lit.grazing;
            light = light.lerp(color.map(f32::sqrt) * lit.diffuse, share) + lit.mirrored;
        }
        let [r, g, b] = Rgb(light.to_array().map(f64::from)).encoded().0;
        [r as f32, g as f32, b as f32, scene[3]]
    }
}

struct Faces<'a> {
    surfaces: &'a VolumeSurfaces,
    normals: &'a [Vec3],
    camera: &'a Camera,
}

#[derive(Clone, Copy)]
struct FaceLight {
    diffuse: f32,
    mirrored: f32,
    /// This is 0 where you see the face straight on, and 1 at its outline.
    grazing: f32,
}

impl Faces<'_> {
    fn light(&self, front: Fragment) -> (usize, FaceLight) {
        let triangle = &self.surfaces.triangles[front.triangle as usize];
        let corners = triangle.corners.map(|corner| corner as usize);
        let normals = corners.map(|corner| self.normals[corner]);
        let places = corners.map(|corner| Vec3::from(self.surfaces.vertices[corner]));
        let [normal, place] = [normals, places]
            .map(|[a, b, c]: [Vec3; 3]| a + (b - a) * front.second + (c - a) * front.third);
        let normal = normal.normalize_or_zero();
        let to_eye = (self.camera.eye - place).normalize_or_zero();
        // The lamp stands to the upper left behind the eye.
        let [right, up, back] = self.camera.axes();
        let to_lamp = (back + 0.8 * up - 0.6 * right).normalize();
        let grazing = 1.0 - normal.dot(to_eye).clamp(0.0, 1.0);
        let half = (to_lamp + to_eye).normalize_or_zero();
        let light = FaceLight {
            diffuse: AMBIENT + (1.0 - AMBIENT) * normal.dot(to_lamp).max(0.0),
            mirrored: 0.35 * normal.dot(half).max(0.0).powi(60),
            grazing: grazing * grazing,
        };
        (triangle.material as usize, light)
    }
}

fn decoded(color: [f32; 3]) -> Vec3 {
    let linear = Rgb(color.map(f64::from)).linear().0;
    Vec3::from(linear.map(|value| value.clamp(DARKEST, 1.0) as f32))
}

fn decoded_any([r, g, b, _]: [f32; 4]) -> Vec3 {
    let linear = Rgb([r, g, b].map(f64::from)).linear().0;
    Vec3::from(linear.map(|value| value as f32))
}

#[cfg(test)]
mod tests {
    use graphics::surface::{PackedMesh, visible};

    use super::*;
    use crate::pigments::{Facets, SeenPlaces};
    use crate::test_volumes::{bumpy, camera, plane};

    const SIZE: (usize, usize) = (80, 60);

    fn shown(volumes: &[Volume], color: [f32; 3]) -> (Field<[f32; 4]>, Field<[f32; 4]>) {
        let mesh = plane(2);
        let camera = camera(20.0, 6.0);
        let seen = visible(&mesh, &camera, SIZE.0, SIZE.1);
        let mesh = PackedMesh::new(&mesh);
        let facets = Facets::of(&mesh);
        let places = SeenPlaces::of(&mesh, &facets, &seen).places;
        let grey = (0..SIZE.0 * SIZE.1).map(|at| [0.4 + 0.05 * (at % 9) as f32; 4]);
        let scene = Field::from_values(SIZE.0, SIZE.1, grey.collect());
        let colors = vec![color; volumes.len()];
        let glass = Glass::default();
        let picture = glass.picture(&scene, (volumes, &colors), &camera, &seen, &places);
        (scene, picture)
    }

    fn changed(scene: &Field<[f32; 4]>, picture: &Field<[f32; 4]>) -> usize {
        scene.values().iter().zip(picture.values()).filter(|(a, b)| a != b).count()
    }

    #[test]
    fn volumes_before_the_scene_colour_it_and_hidden_ones_do_not() {
        let ball = bumpy(Vec3::new(2.0, 2.0, 1.0), 0.6, 3, 1);
        let (scene, picture) = shown(&[ball], [0.9, 0.2, 0.1]);
        let count = changed(&scene, &picture);
        assert!((250..900).contains(&count), "{count}");
        let redder = scene
            .values()
            .iter()
            .zip(picture.values())
            .filter(|(a, b)| a != b && b[0] - b[2] > a[0] - a[2] + 0.1);
        assert!(redder.count() * 10 > 9 * count);
        assert!(picture.values().iter().flatten().all(|value| (0.0..=1.5).contains(value)));
        assert!(scene.values().iter().zip(picture.values()).all(|(a, b)| a[3] == b[3]));
        let hidden = bumpy(Vec3::new(2.0, 2.0, -1.0), 0.6, 3, 1);
        let (scene, picture) = shown(&[hidden], [0.9, 0.2, 0.1]);
        assert_eq!(changed(&scene, &picture), 0);
    }

    #[test]
    fn longer_ways_are_deeper_in_colour() {
        let pixels = [0.0, 0.3, 0.6, 1.2].map(|radius: f32| {
            let glass = Glass { face: 0.0, outline: 0.0, ..Glass::default() };
            let steps = (radius * STEPS) as i32;
            let thickness = FilmHeights([0, steps, 2 * steps, 0, 0, 0, 0, 0, 0]);
            glass.pixel([0.8, 0.8, 0.8, 1.0], &thickness, None)
        });
        for pair in pixels.windows(2) {
            assert!(pair[0][0] - pair[1][0] < 1e-6 && pair[1][1] < pair[0][1]);
            assert!(pair[1][2] / pair[1][1] < pair[0][2] / pair[0][1]);
        }
        assert_eq!(pixels[0], [0.8, 0.8, 0.8, 1.0]);
    }
}
