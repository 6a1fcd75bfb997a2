//! Benchmarks of drawing a still life of 60,000 triangles at 750 x 570 pixels: visibility, shading
//! with and without hatching, composing the picture, and whole frames.

#![expect(clippy::unwrap_used, reason = "a bench may panic")]

use divan::Bencher;
use graphics::camera::{Camera, Framing};
use graphics::compute::{ColorImage, Compute, Image};
use graphics::field::Field;
use graphics::gpu::BackendChoice;
use graphics::mesh::SampleModel;
use graphics::surface::{Fragment, Model, PackedMesh};
use volumes::drawing::{DrawingLook, Inside, Region, Shells, reveal, shade};
use volumes::hatching::{Hatching, ThresholdTexture};

const SIZE: (usize, usize) = (750, 570);

fn main() {
    divan::main();
}

struct Scene {
    compute: Compute,
    model: Model,
    hatching: Hatching,
    camera: Camera,
    look: DrawingLook,
    counts: Image<i32>,
}

impl Scene {
    fn new(mut compute: Compute) -> Self {
        let mesh = SampleModel::StillLife.mesh(60_000);
        let packed = PackedMesh::new(&mesh);
        let texture = ThresholdTexture::new(1);
        let hatching = Hatching::new(&mut compute, &texture, &packed).unwrap();
        let model = Model::new(&mut compute, packed).unwrap();
        let framing = Framing { aspect: SIZE.0 as f32 / SIZE.1 as f32, ..Framing::default() };
        let camera = framing.fit(&mesh.positions);
        // Patches of every count, as many as volumes with four shells make.
        let counts = (0..SIZE.0 * SIZE.1)
            .map(|i: usize| ((i % SIZE.0 / 40 + i / SIZE.0 / 30) % 5) as i32)
            .collect();
        let counts = Field::from_values(SIZE.0, SIZE.1, counts);
        let counts = compute.upload(&counts).unwrap();
        Self { compute, model, hatching, camera, look: DrawingLook::default(), counts }
    }

    fn visible(&mut self) -> Image<Fragment> {
        self.model.visible(&mut self.compute, &self.camera, SIZE.0, SIZE.1).unwrap()
    }

    fn shade(&mut self, visible: &Image<Fragment>) -> ColorImage {
        let Self { compute, model, hatching, camera, look, .. } = self;
        shade(compute, model, visible, camera, look, hatching).unwrap()
    }

    fn reveal(&mut self, visible: &Image<Fragment>, shaded: &ColorImage) -> ColorImage {
        let region = Region {
            counts: self.counts.clone(),
            table: Shells::washed().table().clone(),
            inside: Inside::OwnColors,
            stain: Region::UNSTAINED,
        };
        reveal(&mut self.compute, shaded, visible, &[region], Some([1.0; 3]), 1).unwrap()
    }
}

#[divan::bench(sample_count = 10)]
fn strokes(bencher: Bencher<'_, '_>) {
    bencher.bench_local(|| ThresholdTexture::new(1));
}

#[divan::bench]
fn seen(bencher: Bencher<'_, '_>) {
    let mut scene = Scene::new(Compute::cpu());
    bencher.bench_local(|| drop(divan::black_box(scene.visible())));
}

#[divan::bench]
fn shaded_with_hatching(bencher: Bencher<'_, '_>) {
    let mut scene = Scene::new(Compute::cpu());
    let visible = scene.visible();
    bencher.bench_local(|| scene.shade(&visible));
}

#[divan::bench]
fn shaded_without_hatching(bencher: Bencher<'_, '_>) {
    let mut scene = Scene::new(Compute::cpu());
    let visible = scene.visible();
    scene.look.hatching.inside = 0.0;
    scene.look.hatching.outside = 0.0;
    bencher.bench_local(|| scene.shade(&visible));
}

#[divan::bench]
fn revealed(bencher: Bencher<'_, '_>) {
    let mut scene = Scene::new(Compute::cpu());
    let visible = scene.visible();
    let shaded = scene.shade(&visible);
    bencher.bench_local(|| scene.reveal(&visible, &shaded));
}

/// All steps from the model to the picture, which is then in the processor's memory. We do not
/// count volumes here, but use prepared counts.
#[divan::bench(args = [BackendChoice::Cpu, BackendChoice::Gpu])]
fn frame(bencher: Bencher<'_, '_>, choice: BackendChoice) {
    let Ok(compute) = Compute::choose(choice) else { return };
    let mut scene = Scene::new(compute);
    bencher.bench_local(|| {
        let visible = scene.visible();
        let shaded = scene.shade(&visible);
        let picture = scene.reveal(&visible, &shaded);
        scene.compute.download(&picture).unwrap()
    });
}
