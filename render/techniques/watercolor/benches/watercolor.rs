//! Benchmarks of watercolour at 750 x 570 pixels: abstraction of pictures (mean shift, then
//! morphological smoothing), visibility and toon shading of meshes, both coherent noises (flow and
//! dispersion) for a frame of 60,000 triangles, effects, and whole pictures of a mesh, each from
//! another direction.

#![expect(clippy::unwrap_used, reason = "a bench may panic")]

use std::sync::Arc;

use divan::Bencher;
use graphics::camera::{Camera, CameraPath, Framing};
use graphics::coherence::{
    AnchoredNoise, FeatureNoise, Features, Hierarchy, Particles, Projection, depth_field,
    draw_anchored, draw_splats, repeating_noise,
};
use graphics::compute::{ColorImage, Compute, Image};
use graphics::field::Field;
use graphics::gpu::{BackendChoice, DeviceError};
use graphics::mesh::{Mesh, SampleModel};
use graphics::morphology::opening_then_closing;
use graphics::segmentation::{SegmentationSettings, segment};
use graphics::surface::{Fragment, Model, PackedMesh, visible};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use watercolor::{
    CoherenceMethod, Controls, DensityLayer, DryBrushReach, ModelPainter, PaperShading, Preset,
    Settings, TextureImages, Textures, Toon, Wash, apply_density, apply_dry_brush, back_runs,
    edges, paint, shade_paper, shade_toon, wobble,
};

fn main() {
    divan::main();
}

const SIZE: (usize, usize) = (750, 570);

struct Frame {
    mesh: Mesh,
    hierarchy: Arc<Hierarchy>,
    projection: Projection,
    depth: Field<f32>,
}

fn frame() -> Frame {
    let mesh = Mesh::torus_knot(60_000);
    let (width, height) = SIZE;
    let framing = Framing { aspect: width as f32 / height as f32, ..Framing::default() };
    let camera: Camera = framing.camera(mesh.bounds());
    let depth = depth_field(&visible(&mesh, &camera, width, height));
    let hierarchy = Arc::new(Hierarchy::new(&mesh));
    Frame { mesh, hierarchy, projection: Projection::new(&camera, width, height), depth }
}

/// The hierarchy of patches, built once for each model.
#[divan::bench]
fn hierarchy(bencher: Bencher<'_, '_>) {
    let frame = frame();
    bencher.bench_local(|| Hierarchy::new(&frame.mesh));
}

/// The selection of features, which runs on the CPU for both backends.
#[divan::bench]
fn features_of_a_view(bencher: Bencher<'_, '_>) {
    let frame = frame();
    let features = Features::new(frame.hierarchy.clone(), 1);
    bencher.bench_local(|| {
        [FeatureNoise::FLOW, FeatureNoise::DISPERSION]
            .map(|noise| features.splats(&frame.projection, noise))
    });
}

fn features(bencher: Bencher<'_, '_>, compute: &mut Compute) {
    let frame = frame();
    let features = Features::new(frame.hierarchy.clone(), 1);
    let depth = compute.upload(&frame.depth).unwrap();
    bencher.bench_local(|| {
        [FeatureNoise::FLOW, FeatureNoise::DISPERSION].map(|noise| {
            let drawn = draw_splats(compute, &depth, &features.splats(&frame.projection, noise));
            compute.download(&drawn.unwrap()).unwrap()
        })
    });
}

fn particles(bencher: Bencher<'_, '_>, compute: &mut Compute, count: usize) {
    let frame = frame();
    let particles = Particles::new(&frame.hierarchy, count);
    let depth = compute.upload(&frame.depth).unwrap();
    let textures = [(32, AnchoredNoise::FLOW), (8, AnchoredNoise::DISPERSION)]
        .map(|(wave, noise)| (compute.upload(&repeating_noise(wave, 1)).unwrap(), noise));
    bencher.bench_local(|| {
        for (texture, noise) in &textures {
            let anchors = particles.anchors(&frame.projection, *noise);
            let drawn = draw_anchored(compute, &depth, texture, &anchors).unwrap();
            divan::black_box(compute.download(&drawn).unwrap());
        }
    });
}

#[divan::bench]
fn features_on_cpu(bencher: Bencher<'_, '_>) {
    features(bencher, &mut Compute::cpu());
}

#[divan::bench]
fn features_on_gpu(bencher: Bencher<'_, '_>) {
    let Ok(mut gpu) = Compute::choose(BackendChoice::Gpu) else { return };
    features(bencher, &mut gpu);
}

#[divan::bench(args = [6, 64])]
fn particles_on_cpu(bencher: Bencher<'_, '_>, count: usize) {
    particles(bencher, &mut Compute::cpu(), count);
}

#[divan::bench(args = [6, 64])]
fn particles_on_gpu(bencher: Bencher<'_, '_>, count: usize) {
    let Ok(mut gpu) = Compute::choose(BackendChoice::Gpu) else { return };
    particles(bencher, &mut gpu, count);
}

/// A wash of flat patches, like an abstracted photograph.
fn wash() -> Wash {
    let (width, height) = SIZE;
    let color = Field::from_values(
        width,
        height,
        (0..width * height)
            .map(|i: usize| {
                let x = i % width / 40;
                let y = i / width / 30;
                let [r, g, b] =
                    [3, 5, 9].map(|step: usize| ((x * 7 + y * step) % 11) as f32 / 11.0);
                [r, g, b, 1.0]
            })
            .collect(),
    );
    Wash { color, controls: Controls::default() }
}

fn settings() -> Settings {
    Preset::Landscape.settings().for_size(SIZE.0, SIZE.1)
}

fn textures(compute: &mut Compute) -> TextureImages {
    Textures::new(SIZE.0, SIZE.1, &settings()).unwrap().upload(compute).unwrap()
}

#[divan::bench]
fn all_on_cpu(bencher: Bencher<'_, '_>) {
    let wash = wash();
    let settings = settings();
    let textures = textures(&mut Compute::cpu());
    bencher.with_inputs(|| wash.upload(&mut Compute::cpu()).unwrap()).bench_local_values(|wash| {
        paint(&mut Compute::cpu(), wash, (&textures).into(), &settings, None).unwrap()
    });
}

/// Includes the download of the picture.
#[divan::bench]
fn all_on_gpu(bencher: Bencher<'_, '_>) {
    let Ok(mut gpu) = Compute::choose(BackendChoice::Gpu) else { return };
    let wash = wash();
    let settings = settings();
    let textures = textures(&mut gpu);
    let wash = wash.upload(&mut gpu).unwrap();
    bencher.bench_local(|| {
        let painted = paint(&mut gpu, wash.clone(), (&textures).into(), &settings, None).unwrap();
        gpu.download(&painted).unwrap()
    });
}

/// Times one effect on the CPU. The effect may reuse the memory of its input.
fn effect(
    bencher: Bencher<'_, '_>,
    effect: impl Fn(&mut Compute, ColorImage, &TextureImages) -> Result<ColorImage, DeviceError>,
) {
    let wash = wash();
    let textures = textures(&mut Compute::cpu());
    bencher
        .with_inputs(|| ColorImage::from(wash.color.clone()))
        .bench_local_values(|color| effect(&mut Compute::cpu(), color, &textures).unwrap());
}

#[divan::bench(name = "wobble")]
fn wobbling(bencher: Bencher<'_, '_>) {
    effect(bencher, |cpu, color, textures| wobble(cpu, color, &textures.paper.heights, 3.0));
}

#[divan::bench(name = "edges")]
fn finding_edges(bencher: Bencher<'_, '_>) {
    let color = ColorImage::from(wash().color);
    bencher.bench_local(|| edges(&mut Compute::cpu(), &color, 0.75).unwrap());
}

#[divan::bench]
fn four_densities(bencher: Bencher<'_, '_>) {
    effect(bencher, |cpu, color, textures| {
        let TextureImages { flow, dispersion, paper, .. } = textures;
        let layers = [flow, dispersion, &paper.heights, flow].map(|texture| DensityLayer {
            texture,
            strength: 1.0,
            pivot: 0.5,
        });
        apply_density(cpu, color, 0.8, &layers, None)
    });
}

#[divan::bench]
fn dry_brush(bencher: Bencher<'_, '_>) {
    let reach =
        DryBrushReach { threshold: 0.4, softness: 0.1, patches: 1.0, outline: 0.0, darkest: 0.2 };
    effect(bencher, |cpu, color, textures| {
        apply_dry_brush(cpu, color, &textures.paper.heights, &textures.flow, reach, None, None)
    });
}

#[divan::bench(name = "sheet")]
fn paper_shading(bencher: Bencher<'_, '_>) {
    let shading = PaperShading { color: [0.98; 3], relief: 0.1 };
    effect(bencher, |cpu, color, textures| {
        shade_paper(cpu, color, &textures.paper.heights, shading)
    });
}

/// All textures, which are computed once for a picture.
#[divan::bench]
fn making_textures(bencher: Bencher<'_, '_>) {
    let settings = settings();
    bencher.bench_local(|| Textures::new(SIZE.0, SIZE.1, &settings).unwrap());
}

/// All textures of a photograph. Its blooms depend on its colours.
#[divan::bench]
fn making_textures_of_a_photograph(bencher: Bencher<'_, '_>) {
    let wash = wash().color;
    let settings = settings();
    bencher.bench_local(|| Textures::of_photograph(&wash, &settings).unwrap());
}

/// Only the blooms of water of [`making_textures_of_a_photograph`].
#[divan::bench(name = "back_runs")]
fn blooming(bencher: Bencher<'_, '_>) {
    let wash = wash().color;
    let settings = settings().back_runs;
    bencher.bench_local(|| back_runs(&wash, &settings));
}

const FRAME_SIZE: (usize, usize) = (750, 570);

/// A painter of a torus knot with one sample per pixel, and the cameras of a turntable.
fn painter(
    compute: Compute,
    triangles: usize,
    method: CoherenceMethod,
) -> (ModelPainter, Vec<Camera>) {
    let mesh = Mesh::torus_knot(triangles);
    let framing =
        Framing { aspect: FRAME_SIZE.0 as f32 / FRAME_SIZE.1 as f32, ..Framing::default() };
    let cameras = framing.fit_turntable(&mesh.positions, 60);
    let mut settings = Settings::default();
    settings.coherence.method = method;
    let painter = ModelPainter::new(compute, mesh, &settings, FRAME_SIZE).unwrap();
    (painter.with_samples(1), cameras)
}

fn frames(bencher: Bencher<'_, '_>, compute: Compute, triangles: usize, method: CoherenceMethod) {
    let (mut painter, cameras) = painter(compute, triangles, method);
    let mut around = cameras.iter().cycle();
    bencher.bench_local(|| painter.paint(around.next().unwrap()).unwrap());
}

fn on_gpu(bencher: Bencher<'_, '_>, triangles: usize, method: CoherenceMethod) {
    if let Ok(compute) = Compute::choose(BackendChoice::Gpu) {
        frames(bencher, compute, triangles, method);
    }
}

#[divan::bench(args = [25_000, 160_000], sample_count = 60)]
fn still_on_cpu(bencher: Bencher<'_, '_>, triangles: usize) {
    frames(bencher, Compute::cpu(), triangles, CoherenceMethod::Static);
}

#[divan::bench(args = [25_000, 160_000], sample_count = 20)]
fn still_on_gpu(bencher: Bencher<'_, '_>, triangles: usize) {
    on_gpu(bencher, triangles, CoherenceMethod::Static);
}

#[divan::bench(args = [60_000], sample_count = 60)]
fn frame_features_on_cpu(bencher: Bencher<'_, '_>, triangles: usize) {
    frames(bencher, Compute::cpu(), triangles, CoherenceMethod::Features);
}

#[divan::bench(args = [60_000], sample_count = 20)]
fn frame_features_on_gpu(bencher: Bencher<'_, '_>, triangles: usize) {
    on_gpu(bencher, triangles, CoherenceMethod::Features);
}

#[divan::bench(args = [60_000], sample_count = 60)]
fn animated_particles_on_cpu(bencher: Bencher<'_, '_>, triangles: usize) {
    frames(bencher, Compute::cpu(), triangles, CoherenceMethod::Particles);
}

#[divan::bench(args = [60_000], sample_count = 20)]
fn animated_particles_on_gpu(bencher: Bencher<'_, '_>, triangles: usize) {
    on_gpu(bencher, triangles, CoherenceMethod::Particles);
}

/// From the edge of the table into the still life, so that single fruits fill the picture.
const NEAR: &str = "
frames = 20
[[keyframe]]
eye = [0.9, 1.2, 2.2]
target = [0.0, 0.6, 0.0]
[[keyframe]]
eye = [1.6, 1.3, 1.6]
target = [0.0, 0.6, 0.0]
";

/// A camera that passes near a still life, 1000 x 750 pixels, as `impasto watercolor
/// shape:still-life --camera` paints it: 4 samples a pixel, cast shadows, and noise that stays on
/// its object.
fn near(bencher: Bencher<'_, '_>, compute: Compute) {
    let mesh = SampleModel::StillLife.mesh(60_000);
    let cameras = CameraPath::from_text("near", NEAR).unwrap().cameras(mesh.bounds());
    let mut painter = ModelPainter::new(compute, mesh, &Settings::default(), (1000, 750)).unwrap();
    let mut along = cameras.iter().cycle();
    bencher.bench_local(|| painter.paint(along.next().unwrap()).unwrap());
}

#[divan::bench(sample_count = 20)]
fn near_on_cpu(bencher: Bencher<'_, '_>) {
    near(bencher, Compute::cpu());
}

#[divan::bench(sample_count = 20)]
fn near_on_gpu(bencher: Bencher<'_, '_>) {
    if let Ok(compute) = Compute::choose(BackendChoice::Gpu) {
        near(bencher, compute);
    }
}

/// Shaded discs over each other, with noise: as much detail as a photograph.
fn picture(width: usize, height: usize) -> Field<[f32; 4]> {
    let mut random = ChaCha8Rng::seed_from_u64(1);
    let mut number = |from: f32, to: f32| random.random_range(from..to);
    let discs: Vec<([f32; 3], [f32; 3])> = (0..150)
        .map(|_| {
            let place =
                [number(0.0, width as f32), number(0.0, height as f32), number(15.0, 110.0)];
            (place, [number(0.1, 0.9), number(0.1, 0.9), number(0.1, 0.9)])
        })
        .collect();
    let mut picture = Field::filled(width, height, [1.0; 4]);
    for y in 0..height {
        for x in 0..width {
            let mut color = [0.6, 0.55, 0.5];
            for ([disc_x, disc_y, radius], own) in &discs {
                let away = (x as f32 - disc_x).hypot(y as f32 - disc_y);
                let cover = ((radius - away) / 3.0).clamp(0.0, 1.0);
                for (color, own) in color.iter_mut().zip(own) {
                    *color += cover * (own - 0.1 * away / radius - *color);
                }
            }
            let [r, g, b] = color.map(|value| value + number(-0.03, 0.03));
            picture[(x, y)] = [r, g, b, 1.0];
        }
    }
    picture
}

/// Segments 1 megapixel by mean shift, with radii of 10 px and of 8 in CIELUV.
#[divan::bench(sample_count = 5)]
fn mean_shift(bencher: Bencher<'_, '_>) {
    let picture = picture(1000, 1000);
    let settings = SegmentationSettings::default();
    bencher.bench_local(|| segment(&picture, &settings).unwrap());
}

fn smooth(bencher: Bencher<'_, '_>, picture: Field<[f32; 4]>, radius_px: u32) {
    let mut compute = Compute::cpu();
    let image = picture.into();
    bencher.bench_local(|| opening_then_closing(&mut compute, &image, radius_px).unwrap());
}

/// Opens and closes a picture of 1 megapixel with several radii.
#[divan::bench(args = [3, 7, 20, 60], sample_count = 20)]
fn smoothing(bencher: Bencher<'_, '_>, radius_px: u32) {
    smooth(bencher, picture(1000, 1000), radius_px);
}

/// Opens and closes a picture of 750 x 570 pixels with several radii.
#[divan::bench(args = [3, 5], sample_count = 20)]
fn smoothing_750(bencher: Bencher<'_, '_>, radius_px: u32) {
    smooth(bencher, picture(750, 570), radius_px);
}

const TRIANGLES: [usize; 2] = [25_000, 160_000];

/// A torus knot and the cameras of a turntable. The knot covers about a third of the picture, with
/// an overdraw of about two.
fn knot(triangles: usize) -> (Mesh, Vec<Camera>) {
    let mesh = Mesh::torus_knot(triangles);
    let framing = Framing { aspect: 750.0 / 570.0, ..Framing::default() };
    let cameras = framing.turntable(mesh.bounds(), 36);
    (mesh, cameras)
}

/// Times one frame of the turntable at `samples` times 750 x 570.
fn shaded_frames(
    bencher: Bencher<'_, '_>,
    mut compute: Compute,
    triangles: usize,
    samples: usize,
    shade: impl Fn(&mut Compute, &Model, Image<Fragment>, &Camera),
) {
    let (mesh, cameras) = knot(triangles);
    let mut model = Model::new(&mut compute, PackedMesh::new(&mesh)).unwrap();
    let mut cameras = cameras.iter().cycle();
    bencher.bench_local(|| {
        let camera = cameras.next().unwrap();
        let size = (750 * samples, 570 * samples);
        let visible = model.visible(&mut compute, camera, size.0, size.1).unwrap();
        shade(&mut compute, &model, visible, camera);
    });
}

#[divan::bench(args = TRIANGLES)]
fn seen_on_cpu(bencher: Bencher<'_, '_>, triangles: usize) {
    shaded_frames(bencher, Compute::cpu(), triangles, 1, |_, _, visible, _| {
        drop(divan::black_box(visible));
    });
}

#[divan::bench(args = TRIANGLES)]
fn toon_on_cpu(bencher: Bencher<'_, '_>, triangles: usize) {
    let toon = Toon::default();
    shaded_frames(bencher, Compute::cpu(), triangles, 1, |compute, model, visible, camera| {
        drop(divan::black_box(shade_toon(compute, model, &visible, camera, &toon, None).unwrap()));
    });
}

/// Four samples per pixel.
#[divan::bench(args = TRIANGLES)]
fn smooth_toon_on_cpu(bencher: Bencher<'_, '_>, triangles: usize) {
    let toon = Toon { samples: 2, ..Toon::default() };
    shaded_frames(bencher, Compute::cpu(), triangles, 2, |compute, model, visible, camera| {
        drop(divan::black_box(shade_toon(compute, model, &visible, camera, &toon, None).unwrap()));
    });
}

/// Includes the download of the picture. Does nothing without an adapter.
#[divan::bench(args = TRIANGLES)]
fn toon_on_gpu(bencher: Bencher<'_, '_>, triangles: usize) {
    let Ok(compute) = Compute::choose(BackendChoice::Gpu) else { return };
    let toon = Toon::default();
    shaded_frames(bencher, compute, triangles, 1, |compute, model, visible, camera| {
        let color = shade_toon(compute, model, &visible, camera, &toon, None).unwrap();
        drop(divan::black_box(compute.download(&color).unwrap()));
    });
}
