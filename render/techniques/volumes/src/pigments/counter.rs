//! Heights of films at all pixels of a picture, frame after frame. We count films on surfaces at
//! every pixel.

use graphics::camera::Camera;
use graphics::field::Field;
use graphics::surface::{Crossing, CrossingSum, Crossings, PackedMesh, VisibilityBuffer};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::film::{Film, FilmHeights, FilmProfile, FilmScale, SampleLattice, SampledSurface};
use super::seen::{Facets, SeenPlaces};
use super::through::{Density, FilmThrough};
use crate::surfaces::VolumeSurfaces;
use crate::volume::Volume;

/// Where the paint of a volume is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum FilmKind {
    /// On the surfaces that it holds. You see the same from all sides, and as much paint as you
    /// poured.
    #[default]
    Surface,
    /// All through the volume. A film is as high as the eye ray is long inside of it.
    Through,
}

/// A scene that is ready for counting films of volumes on it.
#[derive(Debug, Clone)]
pub struct FilmCounter {
    facets: Facets,
    lattice: SampleLattice,
    /// Profile of films on surfaces.
    pub profile: FilmProfile,
    /// Lengths by which we measure paint.
    pub scale: FilmScale,
    surfaces: VolumeSurfaces,
    crossings: Crossings,
}

impl FilmCounter {
    /// Prepares the scene `mesh` with the samples of its surface. This sorts samples into cubes
    /// with sides of `side`. Choose about the radius of most volumes.
    ///
    /// # Panics
    /// If `side` is not above 0.
    #[must_use]
    pub fn new(
        mesh: &PackedMesh,
        surface: &SampledSurface<'_>,
        side: f32,
        profile: FilmProfile,
        scale: FilmScale,
    ) -> Self {
        let facets = Facets::of(mesh);
        let lattice = SampleLattice::of(surface.places, side);
        let surfaces = VolumeSurfaces::default();
        let crossings = Crossings::default();
        Self { facets, lattice, profile, scale, surfaces, crossings }
    }

    /// Sets the body of each triangle. Use 0 for triangles that films of all bodies lie on.
    pub fn tell_bodies(&mut self, bodies: &[u32]) {
        self.facets.tell_bodies(bodies);
    }

    /// Heights of the films of `volumes` at each pixel of `visible`, which is what `camera` sees
    /// of `mesh`. Pass the same `mesh` and `surface` as to [`Self::new`].
    ///
    /// # Panics
    /// If `visible` shows a triangle that the mesh does not have.
    #[must_use]
    pub fn heights(
        &mut self,
        (mesh, surface): (&PackedMesh, &SampledSurface<'_>),
        volumes: &[Volume],
        kind: FilmKind,
        camera: &Camera,
        visible: &VisibilityBuffer,
    ) -> Field<FilmHeights> {
        let Self { facets, lattice, profile, scale, surfaces, crossings } = self;
        surfaces.update(volumes);
        let seen = SeenPlaces::of(mesh, facets, visible);
        match kind {
            FilmKind::Surface => {
                let samples = (surface, &*lattice);
                let films = Film::of_volumes(volumes, *profile, samples, scale);
                let films = FilmOnSurface { films: &films, seen: &seen };
                crossings.sum(&films, surfaces.closed(), camera, visible)
            }
            FilmKind::Through => {
                let densities = volumes.par_iter().map(|volume| Density::of(volume, scale));
                let densities: Vec<Density> = densities.collect();
                let films = FilmThrough::new(&densities, camera, &seen.places, false);
                crossings.sum(&films, surfaces.closed(), camera, visible)
            }
        }
    }
}

/// The heights of the films at each pixel. We add a volume's part where the ray leaves its faces
/// behind the seen place, and subtract it where the ray enters them there. Pass the surfaces of
/// the volumes, in the order of the volumes.
#[derive(Debug, Clone, Copy)]
pub struct FilmOnSurface<'a> {
    /// The film of each volume.
    pub films: &'a [Film],
    /// Places that the pixels show.
    pub seen: &'a SeenPlaces<'a>,
}

impl CrossingSum for FilmOnSurface<'_> {
    type Sum = FilmHeights;

    #[inline]
    fn add(&self, sum: &mut FilmHeights, crossing: &Crossing) {
        let (place, normal) = self.seen.at(crossing.pixel);
        let film = &self.films[crossing.surface as usize];
        let foreign = film.wetted.is_foreign(self.seen.body(crossing.pixel));
        if let Some(heights) = film.at(place, normal).filter(|_| !foreign) {
            sum.add(&heights, crossing.sign);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::containing::Inside;
    use crate::pigments::FilmSum;
    use crate::test_volumes::{bumpy, camera, plane};
    use crate::wetting::{SAMPLES_PER_CELL, SurfaceSamples};
    use crate::world::{Pour, Recipe, World, WorldSettings};
    use glam::Vec3;
    use graphics::mesh::SampleModel;
    use graphics::surface::visible;
    use paint::amount::mm_from_quanta;
    use paint::layer::{Cell, SLOTS};
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    const CELL: f32 = 1.0 / 3.0;

    const SCALE: FilmScale = FilmScale { quantum_mm3: 3e-7, unit_mm: 20.0, cell_mm: 0.2 };

    struct Poured {
        mesh: PackedMesh,
        samples: SurfaceSamples,
        visible: Vec<(Camera, VisibilityBuffer)>,
        volumes: Vec<Volume>,
    }

    impl Poured {
        fn new(cameras: &[Camera], (width, height): (usize, usize)) -> Self {
            let mesh = plane(24);
            let samples = SurfaceSamples::of(&mesh, CELL, SAMPLES_PER_CELL, 5).unwrap();
            let random = &mut ChaCha8Rng::seed_from_u64(8);
            let volumes: Vec<Volume> = (0..9)
                .map(|seed| {
                    let mut within = |low: f32, high: f32| random.random_range(low..high);
                    let center = Vec3::new(within(0.9, 3.1), within(0.9, 3.1), within(-0.1, 0.1));
                    let mut volume = bumpy(center, within(0.25, 0.6), 2, seed);
                    let mut pigments = [0; SLOTS];
                    pigments[seed as usize % 3] = (within(1.0, 4.0) * 1e6) as u32;
                    volume.paint = Cell { pigments, vehicle: 600_000 };
                    volume.normal = Vec3::Z;
                    volume
                })
                .collect();
            let visible = cameras
                .iter()
                .map(|camera: &Camera| (*camera, visible(&mesh, camera, width, height)))
                .collect();
            Self { mesh: PackedMesh::new(&mesh), samples, visible, volumes }
        }

        fn films(&self) -> Vec<Film> {
            let surface = SampledSurface::from(&self.samples);
            let lattice = SampleLattice::of(surface.places, CELL);
            let profile = FilmProfile::default();
            Film::of_volumes(&self.volumes, profile, (&surface, &lattice), &SCALE)
        }

        fn heights(&self, sight: usize) -> Field<FilmHeights> {
            let surface = SampledSurface::from(&self.samples);
            let profile = FilmProfile::default();
            let mut counter = FilmCounter::new(&self.mesh, &surface, CELL, profile, SCALE);
            let (camera, visible) = &self.visible[sight];
            let scene = (&self.mesh, &surface);
            counter.heights(scene, &self.volumes, FilmKind::Surface, camera, visible)
        }
    }

    #[test]
    fn the_film_of_a_picture_face_on_is_the_paint_poured() {
        let distance = 5.6;
        let width = 750;
        let height = 570;
        let poured = Poured::new(&[camera(0.0, distance)], (width, height));
        let heights = poured.heights(0);
        let pixel_mm =
            f64::from(2.0 * distance * 20_f32.to_radians().tan() / height as f32) * SCALE.unit_mm;
        for slot in [0, 1, 2, SLOTS] {
            let sum: f64 = heights.values().iter().map(|heights| f64::from(heights.0[slot])).sum();
            let laid = sum * mm_from_quanta(1, SCALE.cell_mm) * pixel_mm * pixel_mm;
            let quanta = poured.volumes.iter().map(|volume| match slot {
                SLOTS => volume.paint.vehicle,
                _ => volume.paint.pigments[slot],
            });
            let all: f64 = quanta.map(f64::from).sum();
            let ratio = laid / (all * SCALE.quantum_mm3);
            assert!((0.98..1.02).contains(&ratio), "{slot}: {ratio}");
        }
    }

    #[test]
    fn the_films_on_a_still_life_are_the_paint_poured() {
        let mesh = SampleModel::StillLife.mesh(6000);
        let [low, high] = mesh.bounds();
        let cell = (high - low).max_element() / 12.0;
        let samples = SurfaceSamples::of(&mesh, cell, SAMPLES_PER_CELL, 5).unwrap();
        let surface = SampledSurface::from(&samples);
        let lattice = SampleLattice::of(surface.places, cell);
        let volumes: Vec<Volume> = (0..40)
            .map(|at| {
                let radius = cell * (0.5 + 0.02 * at as f32);
                let sample = (at * 7919 + 11) % samples.len();
                let mut volume = bumpy(samples.places[sample], radius, 2, at as u64);
                volume.paint = Cell { pigments: [0; SLOTS], vehicle: 2_000_000 };
                volume.normal = samples.normals[sample];
                volume
            })
            .collect();
        let profile = FilmProfile::default();
        let films = Film::of_volumes(&volumes, profile, (&surface, &lattice), &SCALE);
        let insides: Vec<Inside> = volumes.iter().map(Inside::of).collect();
        let sum = FilmSum { films: &films, insides: &insides };
        // These are other samples, 25 times as many.
        let fine = SurfaceSamples::of(&mesh, 0.2 * cell, SAMPLES_PER_CELL, 6).unwrap();
        let patch_mm2 = f64::from(fine.areas[0]) * SCALE.unit_mm * SCALE.unit_mm;
        let heights: f64 = (0..fine.len())
            .map(|at: usize| f64::from(sum.at(fine.places[at], fine.normals[at]).0[SLOTS]))
            .sum();
        let laid = heights * mm_from_quanta(1, SCALE.cell_mm) * patch_mm2;
        let ratio = laid / (40.0 * 2e6 * SCALE.quantum_mm3);
        assert!((0.98..1.02).contains(&ratio), "{ratio}");
    }

    #[test]
    fn the_films_of_a_world_are_the_paint_on_its_scene() {
        let mesh = SampleModel::Village.mesh(6000);
        let mut world = World::of(&mesh, &WorldSettings::default()).unwrap();
        for (slot, at) in [(0, 100), (1, 900), (3, 2100)] {
            let place = Vec3::from(mesh.positions[at]);
            world.pour(Pour::at(place, 60.0, 1.0, Recipe::of_slot(slot))).unwrap();
        }
        // We go on until volumes are wider than the samples are apart.
        (0..400).for_each(|_| world.step().unwrap());
        let samples = &world.grid().samples;
        let surface = SampledSurface::from(samples);
        let lattice = SampleLattice::of(surface.places, samples.lattice.cell);
        let unit_mm = world.unit_mm();
        let quantum_mm3 = world.quantum_mm3();
        let scale = FilmScale { quantum_mm3, unit_mm, cell_mm: 0.2 };
        let profile = FilmProfile::default();
        let films = Film::of_volumes(world.volumes(), profile, (&surface, &lattice), &scale);
        let insides: Vec<Inside> = world.volumes().iter().map(Inside::of).collect();
        let sum = FilmSum { films: &films, insides: &insides };
        let fine =
            SurfaceSamples::of(&mesh, 0.2 * samples.lattice.cell, SAMPLES_PER_CELL, 6).unwrap();
        let patch_mm2 = f64::from(fine.areas[0]) * unit_mm * unit_mm;
        let mut laid = [0.0; SLOTS + 1];
        for (sample, (&place, &normal)) in fine.places.iter().zip(&fine.normals).enumerate() {
            let body = world.grid().bodies.of_triangles[fine.triangles[sample] as usize];
            let heights = sum.on_body(place, normal, body).0;
            laid.iter_mut().zip(heights).for_each(|(laid, height)| *laid += f64::from(height));
        }
        let on_scene = world.tally().on_scene;
        for slot in [0, 1, 3] {
            let laid_mm3 = laid[slot] * mm_from_quanta(1, 0.2) * patch_mm2;
            let ratio = laid_mm3 / (on_scene[slot] as f64 * quantum_mm3);
            // Both sums are over samples. The samples of the world are five times as far apart.
            assert!((0.96..1.04).contains(&ratio), "{slot}: {ratio}");
        }
        assert!(world.volumes().len() > 20, "{}", world.volumes().len());
    }

    #[test]
    fn counted_films_are_those_of_the_volumes_that_hold_each_place() {
        let poured = Poured::new(&[camera(25.0, 5.0), camera(-60.0, 2.5)], (97, 61));
        let insides: Vec<Inside> = poured.volumes.iter().map(Inside::of).collect();
        let films = poured.films();
        let sum = FilmSum { films: &films, insides: &insides };
        let facets = Facets::of(&poured.mesh);
        for sight in 0..2 {
            let seen = SeenPlaces::of(&poured.mesh, &facets, &poured.visible[sight].1);
            let heights = poured.heights(sight);
            let mut off = 0;
            let mut covered = 0;
            for (pixel, found) in heights.values().iter().enumerate() {
                let (place, normal) = seen.at(pixel);
                let wanted = sum.at(place, normal);
                off += usize::from(*found != wanted);
                covered += usize::from(wanted != FilmHeights::default());
            }
            // These places lie at the skins. Their depth is the depth of a face, to rounding.
            assert!(off <= 2, "{off} of {covered} in sight {sight}");
            assert!(covered > 800, "{covered}");
        }
    }

    #[test]
    fn heights_stay_at_their_places_when_the_picture_turns() {
        let size = (750, 570);
        let poured = Poured::new(&[camera(0.0, 5.6), camera(60.0, 5.0)], size);
        let straight = poured.heights(0);
        let turned = poured.heights(1);
        let clip = poured.visible[0].0.clip_from_model(size.0 as f32 / size.1 as f32);
        let facets = Facets::of(&poured.mesh);
        let seen = SeenPlaces::of(&poured.mesh, &facets, &poured.visible[1].1);
        let mut off = 0.0;
        let mut all = 0.0;
        let mut compared = 0;
        for (pixel, heights) in turned.values().iter().enumerate() {
            let (place, _) = seen.at(pixel);
            if heights.0[SLOTS] == 0 || place.is_nan() {
                continue;
            }
            let at = clip.project_point3(place);
            let x = (0.5 + 0.5 * at.x) * size.0 as f32 - 0.5;
            let y = (0.5 - 0.5 * at.y) * size.1 as f32 - 0.5;
            let column = x as usize;
            let row = y as usize;
            let around = [(0, 0), (1, 0), (0, 1), (1, 1)];
            let around =
                around.map(|(right, down)| straight[(column + right, row + down)].0[SLOTS]);
            // If other volumes hold a pixel's neighbours, there is a step between them.
            let [least, most] = [around.iter().min(), around.iter().max()].map(|one| *one.unwrap());
            if f64::from(most - least) > 0.1 * f64::from(most) {
                continue;
            }
            let [a, b, c, d] = around.map(|height| height as f32);
            let u = x.fract();
            let v = y.fract();
            let above = a + (b - a) * u;
            let below = c + (d - c) * u;
            let wanted = f64::from(above + (below - above) * v);
            off += (f64::from(heights.0[SLOTS]) - wanted).abs();
            all += wanted;
            compared += 1;
        }
        assert!(compared > 40_000, "{compared}");
        assert!(off <= 0.01 * all, "{} of the heights", off / all);
    }

    #[test]
    fn places_outside_of_all_volumes_have_no_film_in_any_order_on_any_threads() {
        let mut poured = Poured::new(&[camera(-40.0, 4.0)], (160, 120));
        let heights = poured.heights(0);
        let none = heights.values().iter().filter(|heights| **heights == FilmHeights::default());
        assert!(none.count() > 4000);
        assert!(heights.values().iter().all(|heights| heights.0.iter().all(|&height| height >= 0)));
        for threads in [1, 2, 8] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            assert_eq!(pool.install(|| poured.heights(0)), heights);
        }
        poured.volumes.rotate_left(4);
        poured.volumes.swap(0, 2);
        assert_eq!(poured.heights(0), heights, "in another order");
    }
}
