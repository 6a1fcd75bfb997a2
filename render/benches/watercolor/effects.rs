//! Effects on a picture of 750 x 570.

use divan::Bencher;
use render::field::Field;
use render::gpu::{BackendChoice, choose};
use render::watercolor::{
    Controls, Density, DensityLayer, DryBrush, DryBrushReach, Edges, OnCpu, OnGpu, OnSheet, Preset,
    Settings, Sheet, Textures, TexturesOn, Wash, Watercolor, Wobble, paint,
};

const SIZE: (usize, usize) = (750, 570);

/// Flat patches, as an abstracted picture has them.
fn wash() -> Wash {
    let (width, height) = SIZE;
    let patch = |i: usize| {
        let (x, y) = (i % width / 40, i / width / 30);
        let shade = |step: usize| ((x * 7 + y * step) % 11) as f32 / 11.0;
        [shade(3), shade(5), shade(9), 1.0]
    };
    let color = Field::from_values(width, height, (0..width * height).map(patch).collect());
    Wash { color, controls: Controls::default() }
}

fn settings() -> Settings {
    Preset::Landscape.settings().for_size(SIZE.0, SIZE.1)
}

fn textures<B: Watercolor>(backend: &mut B) -> TexturesOn<B> {
    Textures::new(SIZE.0, SIZE.1, &settings()).unwrap().on(backend).unwrap()
}

#[divan::bench]
fn all_on_cpu(bencher: Bencher<'_, '_>) {
    let (wash, settings, textures) = (wash(), settings(), textures(&mut OnCpu));
    let TexturesOn { flow, dispersion, paper } = &textures;
    bencher.with_inputs(|| wash.on(&mut OnCpu).unwrap()).bench_local_values(|wash| {
        paint(&mut OnCpu, wash, flow, dispersion, paper, &settings, None).unwrap()
    });
}

/// With the picture read back.
#[divan::bench]
fn all_on_gpu(bencher: Bencher<'_, '_>) {
    let Some(device) = choose(BackendChoice::Gpu).ok().flatten() else { return };
    let mut gpu = OnGpu::new(device);
    let (wash, settings, textures) = (wash(), settings(), textures(&mut gpu));
    let there = wash.on(&mut gpu).unwrap();
    let TexturesOn { flow, dispersion, paper } = &textures;
    bencher.bench_local(|| {
        use render::watercolor::{Backend, WashOn};
        let wash = WashOn { color: there.color.clone(), dry_brush: None, density: None };
        let painted = paint(&mut gpu, wash, flow, dispersion, paper, &settings, None).unwrap();
        gpu.color_field(&painted).unwrap()
    });
}

#[divan::bench]
fn wobble(bencher: Bencher<'_, '_>) {
    let (wash, textures) = (wash(), textures(&mut OnCpu));
    bencher
        .with_inputs(|| wash.color.clone())
        .bench_local_values(|c| OnCpu.wobbled(c, &textures.paper.heights, 3.0).unwrap());
}

#[divan::bench]
fn edges(bencher: Bencher<'_, '_>) {
    let wash = wash();
    bencher.bench_local(|| OnCpu.edges(&wash.color, 0.75).unwrap());
}

#[divan::bench]
fn four_densities(bencher: Bencher<'_, '_>) {
    let (wash, textures) = (wash(), textures(&mut OnCpu));
    let layer = |texture| DensityLayer { texture, strength: 1.0, pivot: 0.5 };
    let greys = [&textures.flow, &textures.dispersion, &textures.paper.heights, &textures.flow];
    bencher
        .with_inputs(|| wash.color.clone())
        .bench_local_values(|c| OnCpu.densified(c, 0.8, &greys.map(layer), None).unwrap());
}

#[divan::bench]
fn dry_brush(bencher: Bencher<'_, '_>) {
    let (wash, textures) = (wash(), textures(&mut OnCpu));
    let reach = DryBrushReach { threshold: 0.4, softness: 0.1, patches: 1.0 };
    let (heights, flow) = (&textures.paper.heights, &textures.flow);
    bencher
        .with_inputs(|| wash.color.clone())
        .bench_local_values(|c| OnCpu.dry_brushed(c, heights, flow, reach, None).unwrap());
}

#[divan::bench]
fn sheet(bencher: Bencher<'_, '_>) {
    let (wash, textures) = (wash(), textures(&mut OnCpu));
    let sheet = Sheet { color: [0.98; 3], relief: 0.1 };
    bencher
        .with_inputs(|| wash.color.clone())
        .bench_local_values(|c| OnCpu.on_sheet(c, &textures.paper.heights, sheet).unwrap());
}

/// All textures, made once for a picture.
#[divan::bench]
fn making_textures(bencher: Bencher<'_, '_>) {
    let settings = settings();
    bencher.bench_local(|| Textures::new(SIZE.0, SIZE.1, &settings).unwrap());
}
