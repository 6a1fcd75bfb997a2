//! Whole frames of a still life of 60,000 triangles at 750 x 570 pixels, one sample per pixel. A
//! frame is two steps of the world, and the picture. Every frame begins with the same growing
//! volumes.

#![expect(clippy::unwrap_used, reason = "a bench may panic")]

use std::sync::Arc;

use divan::Bencher;
use glam::Vec3;
use graphics::camera::{Camera, Framing};
use graphics::compute::Compute;
use graphics::gpu::{BackendChoice, choose};
use graphics::mesh::{Mesh, SampleModel};
use paint::document::{Lighting, palette_slots};
use paint::ground::GroundKind;
use pigment::PigmentLibrary;
use volumes::painter::{VolumePainter, VolumePigments};
use volumes::script::RegionStyle;
use volumes::settings::{Inside, Settings};
use volumes::world::{Pour, Recipe, Single, World, WorldSettings};

const SIZE: (usize, usize) = (750, 570);

const STEPS: usize = 2;

const SHELLS: [f32; 4] = [1.0, 0.93, 0.86, 0.79];

fn main() {
    divan::main();
}

struct Scene {
    mesh: Mesh,
    camera: Camera,
}

impl Scene {
    fn new() -> Self {
        let mesh = SampleModel::StillLife.mesh(60_000);
        let framing = Framing { aspect: SIZE.0 as f32 / SIZE.1 as f32, ..Framing::default() };
        let camera = framing.fit(&mesh.positions);
        Self { mesh, camera }
    }

    fn poured(&self, count: usize) -> World {
        let settings = Settings::default();
        let mut world = World::of(&self.mesh, &WorldSettings::from(&settings)).unwrap();
        let cells = &world.grid().cells;
        let samples = &world.grid().samples;
        let distance = |cell: &usize| cells.centers[*cell].distance(self.camera.eye);
        // A cell with little surface holds less paint than its volume is born with.
        let mut nearest: Vec<usize> =
            (0..cells.len()).filter(|&cell| cells.capacities[cell] > 1 << 20).collect();
        nearest.sort_by(|a, b| distance(a).total_cmp(&distance(b)));
        // Half of what a cell takes, over two seconds, so that nothing spills.
        let pours: Vec<Pour> = nearest[..count]
            .iter()
            .map(|&cell| {
                let place = samples.places[samples.of_cell(cell).start];
                let rate = 0.25 * f64::from(cells.capacities[cell]) * world.quantum_mm3();
                Pour::at(place, rate, 2.0, Recipe::of_slot(cell % 3))
            })
            .collect();
        for pour in pours {
            world.pour(pour).unwrap();
        }
        (0..180).for_each(|_| world.step().unwrap());
        assert_eq!(world.volumes().len(), count, "paint spilled, or cells are missing");
        world
    }

    fn hero(&self) -> World {
        let settings = Settings::default();
        let mut world = World::of(&self.mesh, &WorldSettings::from(&settings)).unwrap();
        let [low, high] = self.mesh.bounds();
        let radius = 0.25 * (high - low).max_element();
        let center = Vec3::new(0.5 * (low.x + high.x), low.y, 0.5 * (low.z + high.z));
        let single = Single { center, radius, detail: 4, recipe: None, region: 0 };
        world.add_volume(&single).unwrap();
        (0..6).for_each(|_| world.step().unwrap());
        world
    }

    fn painter(&self, shells: &[f32], hatching: f32, inside: Inside) -> VolumePainter {
        let mut settings = Settings::default();
        settings.picture.samples = 1;
        (settings.hatching.inside, settings.hatching.outside) = (hatching, hatching);
        let tints = (0..=shells.len()).map(|shell| shell as f32 / shells.len() as f32).collect();
        let shells = shells.to_vec();
        let stain = "#ffffff".to_owned();
        let style = RegionStyle { name: String::new(), inside, shells, tints, stain };
        VolumePainter::new(&self.mesh, &settings, &[style]).unwrap()
    }
}

fn frames(bencher: Bencher<'_, '_>, world: &World, camera: &Camera, mut painter: VolumePainter) {
    bencher.with_inputs(|| world.clone()).bench_local_values(|mut world| {
        (0..STEPS).for_each(|_| world.step().unwrap());
        (painter.paint(&world, camera, SIZE).unwrap(), world)
    });
}

#[divan::bench(args = [0, 64, 256])]
fn hard_edge(bencher: Bencher<'_, '_>, volumes: usize) {
    let scene = Scene::new();
    let painter = scene.painter(&[1.0], 0.0, Inside::OwnColors);
    frames(bencher, &scene.poured(volumes), &scene.camera, painter);
}

#[divan::bench(args = [0, 64, 256])]
fn hatched_with_four_shells(bencher: Bencher<'_, '_>, volumes: usize) {
    let scene = Scene::new();
    let painter = scene.painter(&SHELLS, 1.0, Inside::OwnColors);
    frames(bencher, &scene.poured(volumes), &scene.camera, painter);
}

#[divan::bench]
fn hero(bencher: Bencher<'_, '_>) {
    let scene = Scene::new();
    let painter = scene.painter(&[1.0], 0.0, Inside::OwnColors);
    frames(bencher, &scene.hero(), &scene.camera, painter);
}

/// Paints frames wholly on any graphics device. Without one, this does nothing.
#[divan::bench(args = [0, 64, 256])]
fn on_a_device(bencher: Bencher<'_, '_>, volumes: usize) {
    let Ok(Some(device)) = choose(BackendChoice::Gpu) else { return };
    let scene = Scene::new();
    let painter = scene.painter(&[1.0], 0.0, Inside::OwnColors);
    let painter = painter.on(Compute::gpu(device)).unwrap();
    frames(bencher, &scene.poured(volumes), &scene.camera, painter);
}

#[divan::bench(args = [64])]
fn hatched_on_a_device(bencher: Bencher<'_, '_>, volumes: usize) {
    let Ok(Some(device)) = choose(BackendChoice::Gpu) else { return };
    let scene = Scene::new();
    let painter = scene.painter(&SHELLS, 1.0, Inside::OwnColors);
    let painter = painter.on(Compute::gpu(device)).unwrap();
    frames(bencher, &scene.poured(volumes), &scene.camera, painter);
}

/// A film on the surface over a grisaille with hatching: three layers.
#[divan::bench(args = [64, 256])]
fn pigments(bencher: Bencher<'_, '_>, volumes: usize) {
    let scene = Scene::new();
    let library = Arc::new(PigmentLibrary::van_gogh_oils());
    let names = ["Ultramarine", "Chrome Yellow", "Vermilion"].map(str::to_owned);
    let pigments = VolumePigments {
        slots: palette_slots(&names, &library).unwrap(),
        library,
        own_colors: None,
        ground: GroundKind::Panel.spec(1),
        lighting: Lighting { relief: 0.0, ..Lighting::default() },
    };
    let painter = scene.painter(&[1.0], 1.0, Inside::Glaze).with_pigments(pigments).unwrap();
    frames(bencher, &scene.poured(volumes), &scene.camera, painter);
}

#[divan::bench(args = [64, 256])]
fn steps(bencher: Bencher<'_, '_>, volumes: usize) {
    let world = Scene::new().poured(volumes);
    bencher.with_inputs(|| world.clone()).bench_local_values(|mut world| {
        (0..STEPS).for_each(|_| world.step().unwrap());
        world
    });
}

/// Makes what you need once for a scene: its grid and its samples.
#[divan::bench(sample_count = 10)]
fn world(bencher: Bencher<'_, '_>) {
    let scene = Scene::new();
    bencher.bench_local(|| World::of(&scene.mesh, &WorldSettings::default()).unwrap());
}
