//! Effects on a picture of 750 x 570 pixels.

use divan::Bencher;
use graphics::compute::{ColorImage, Compute};
use graphics::field::Field;
use graphics::gpu::{BackendChoice, DeviceError};
use watercolor::{
    Controls, DensityLayer, DryBrushReach, PaperShading, Preset, Settings, TextureImages, Textures,
    Wash, apply_density, apply_dry_brush, back_runs, edges, paint, shade_paper, wobble,
};

const SIZE: (usize, usize) = (750, 570);

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
                let shade = |step: usize| ((x * 7 + y * step) % 11) as f32 / 11.0;
                [shade(3), shade(5), shade(9), 1.0]
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

/// All textures of a photograph, whose blooms depend on its colours.
#[divan::bench]
fn making_textures_of_a_photograph(bencher: Bencher<'_, '_>) {
    let wash = wash().color;
    let settings = settings();
    bencher.bench_local(|| Textures::of_photograph(&wash, &settings).unwrap());
}

/// Blooms of water alone, those of [`making_textures_of_a_photograph`].
#[divan::bench(name = "back_runs")]
fn blooming(bencher: Bencher<'_, '_>) {
    let wash = wash().color;
    let settings = settings().back_runs;
    bencher.bench_local(|| back_runs(&wash, &settings));
}
