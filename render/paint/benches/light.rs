//! Benchmarks of light: rendering a painting of three layers, mixing two paints, and fitting
//! wavelengths.

use divan::{Bencher, counter::ItemsCount};
use graphics::field::Field;
use paint::composite::composite_layer_row;
use paint::document::{Document, DryLayer, LayerId, Lighting, Medium};
use paint::ground::Ground;
use paint::layer::Layer;
use paint::light::{Light, Mixer};
use paint::optics::{Gloss, NODES, Scene};
use paint::scene::{picture, scene};
use paint::shade::{TopMaterial, Tops, shade_row};
use pigment::library::PigmentLibrary;
use pigment::{PigmentId, evaluate::Viewing};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

fn main() {
    divan::main();
}

const WIDTH: usize = 1024;

fn library() -> PigmentLibrary {
    PigmentLibrary::van_gogh_oils()
}

/// Paint of eight pigments in every cell, up to 0.1 mm of each.
fn layer(width: usize, height: usize, seed: u64) -> Layer {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut layer = Layer::empty(width, height);
    for cell in layer.pigments.values_mut() {
        *cell = std::array::from_fn(|_| random.random_range(0..1 << 21));
    }
    layer
}

/// A painting of two dry layers and a wet one, with its scene.
fn painting(width: usize, height: usize) -> (Document, Scene) {
    let library = library();
    let light = Light::new(&library, &Viewing::default()).expect("eight wavelengths of D65");
    let slots = std::array::from_fn(|slot| Some(PigmentId(slot)));
    let dry =
        [1, 2].map(|id| DryLayer::new(LayerId(id), slots, layer(width, height, u64::from(id))));
    let document = Document {
        title: String::new(),
        cell_mm: 0.1,
        ground: Ground {
            name: String::new(),
            height: Field::filled(width, height, 0),
            reflectance: vec![0.9; library.grid.count()],
            gloss: Gloss { strength: 0.0, exponent: 1.0 },
        },
        library,
        medium: Medium::default(),
        dry: dry.into(),
        next_layer: LayerId(3),
        slots,
        wet: layer(width, height, 3),
        lighting: Lighting::default(),
    };
    let scene = scene(&document, &light);
    (document, scene)
}

/// One layer of eight pigments at eight wavelengths over the ground, to internal
/// reflectance. One core.
#[divan::bench]
fn one_layer(bencher: Bencher) {
    let (document, scene) = painting(WIDTH, 4);
    let cells = document.wet.vehicle.values().len();
    bencher
        .counter(ItemsCount::new(cells))
        .with_inputs(|| vec![scene.ground; cells])
        .bench_local_refs(|internal| {
            for (y, internal) in internal.chunks_mut(WIDTH).enumerate() {
                composite_layer_row(&scene.wet, &document.wet, (0, y), internal);
            }
        });
}

/// One layer to linear RGB without relief, rows in parallel on `threads` threads.
#[divan::bench(args = [1, 2])]
fn one_layer_to_rgb(bencher: Bencher, threads: usize) {
    let (document, mut scene) = painting(WIDTH, 256);
    scene.lamp.relief = 0.0;
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
    let level = Tops::level(WIDTH, 1);
    let mut out = vec![[0.0; 4]; document.wet.vehicle.values().len()];
    bencher.counter(ItemsCount::new(out.len())).bench_local(|| {
        pool.install(|| {
            let rows = out.par_chunks_mut(WIDTH).enumerate();
            rows.for_each_init(
                || vec![scene.ground; WIDTH],
                |internal: &mut Vec<[f32; NODES]>, (y, out): (usize, &mut [_])| {
                    internal.fill(scene.ground);
                    composite_layer_row(&scene.wet, &document.wet, (0, y), internal);
                    shade_row(&scene, (&level, (0, 0)), internal, &[TopMaterial::Wet; WIDTH], out);
                },
            );
        });
    });
}

/// Three layers of 1024 x 1024 with relief and gloss, on all cores.
#[divan::bench(sample_count = 20)]
fn three_layers(bencher: Bencher) {
    let (document, scene) = painting(WIDTH, WIDTH);
    bencher.counter(ItemsCount::new(WIDTH * WIDTH)).bench_local(|| picture(&document, &scene));
}

/// Two paints mixed in 4096 ratios, on one core.
#[divan::bench]
fn mixer(bencher: Bencher) {
    let library = library();
    let light = Light::new(&library, &Viewing::default()).expect("eight wavelengths of D65");
    let mixer = Mixer::new(&library, &light, &[(PigmentId(1), 1.0)], &[(PigmentId(15), 1.0)])
        .expect("two pigments");
    let shares: Vec<f32> = (0..4096u16).map(|i| f32::from(i) / 4095.0).collect();
    let mut out = vec![[0.0; 3]; shares.len()];
    bencher
        .counter(ItemsCount::new(shares.len()))
        .bench_local(|| mixer.mix_into(divan::black_box(&shares), &mut out));
}
