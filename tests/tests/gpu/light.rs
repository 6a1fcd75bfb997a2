//! Rendering on the GPU compared with the layer and shading formulas in f64.

use graphics::field::Field;
use graphics::tile::TileSet;
use paint::View;
use paint::amount::QUANTA_PER_CELL;
use paint::engine::PaintEngine;
use paint::layer::{Cell, Layer};
use paint::optics::{Gloss, Lamp, LayerOptics, NODES, Scene, SceneSurface};
use paint::shade::{MOST, ReliefLamp, SOFT, Tap};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use spectra::optics::{Layer as Film, Specular, Surface};

/// Tolerance in linear RGB for f32 with the inexact `exp`, `sqrt` and division of WGSL. On lavapipe
/// the largest error is 4e-7.
const NEAR: f64 = 3e-6;

/// Tolerance for three layers of two films with relief and gloss. For three layers of one film the largest error on
/// lavapipe is 1.9e-6.
const NEAR_STACK: f64 = 2e-5;

fn flat_scene(ground: f32, wet: LayerOptics, dry: Vec<LayerOptics>) -> Scene {
    let gloss = Gloss { strength: 0.25, exponent: 60.0 };
    Scene {
        ground: [ground; NODES],
        dry,
        wet,
        surface: SceneSurface { k1: 0.03, k2: 0.5, specular: 0.03 },
        // Channels with different weights: red even, green of the first four nodes, blue rising.
        rgb_from_nodes: std::array::from_fn(|node| {
            [0.125, if node < 4 { 0.25 } else { 0.0 }, (node as f32) / 28.0]
        }),
        lamp: Lamp {
            direction: [-0.45, -0.45, 0.771],
            relief: 0.0,
            ambient: 0.5,
            wet: gloss,
            dry: Gloss { strength: 0.06, ..gloss },
            ground: Gloss { strength: 0.0, ..gloss },
        },
        cell_mm: 0.1,
    }
}

/// Linear RGB of a level surface from its internal reflectance at each node.
fn color(scene: &Scene, internal: [f64; NODES]) -> [f64; 3] {
    let surface = Surface::new(0.03, 0.5, Specular::Included).unwrap();
    let mut sum = [0.0; 3];
    for (internal, rgb) in internal.into_iter().zip(scene.rgb_from_nodes) {
        for (sum, weight) in sum.iter_mut().zip(rgb) {
            *sum += surface.measured_from_internal(internal) * f64::from(weight);
        }
    }
    sum
}

fn film(coat: &LayerOptics, cell: &Cell, node: usize, backing: f64) -> f64 {
    let [k, s] = [&coat.absorption, &coat.scattering].map(|per| -> f64 {
        let parts = per.iter().zip(cell.pigments);
        parts.map(|(per, amount)| f64::from(per[node]) * f64::from(amount)).sum()
    });
    Film::new(k, s, 1.0).over(backing)
}

/// Largest difference of a channel, and its cell. Panics if a value is not finite or alpha is not
/// 1.
fn largest(found: &Field<[f32; 4]>, wanted: impl Fn(usize) -> [f64; 3]) -> (f64, usize) {
    let mut worst = (0.0, 0);
    for (i, found) in found.values().iter().enumerate() {
        assert!(found.iter().all(|value| value.is_finite()), "cell {i}: {found:?}");
        assert!((found[3] - 1.0).abs() == 0.0, "cell {i}: {found:?}");
        for (found, wanted) in found.iter().zip(wanted(i)) {
            assert!(wanted.is_finite(), "cell {i} wants {wanted}");
            let off = (f64::from(*found) - wanted).abs();
            if off > worst.0 {
                worst = (off, i);
            }
        }
    }
    worst
}

#[test]
fn a_film_is_that_of_the_layer_equations_from_nothing_to_huge() {
    // The first pigment only absorbs and sets K d, the second only scatters and sets S d.
    let steps: Vec<u32> =
        std::iter::once(0).chain((0..32).map(|power| 1 << power)).chain([3, 1 << 31]).collect();
    let count = steps.len();
    let mut wet = Layer::empty(count, count);
    for (y, k) in steps.iter().enumerate() {
        for (x, s) in steps.iter().enumerate() {
            let mut cell = Cell::default();
            (cell.pigments[0], cell.pigments[1]) = (k / 2, s / 2);
            wet.set_cell(y * count + x, cell);
        }
    }
    for per_quantum in [1e-9, 1e-7, 1e-5] {
        for ground in [0.0, 0.04, 0.5, 1.0] {
            let mut coat = LayerOptics::EMPTY;
            // Absorption falls over the wavelengths, while scattering rises.
            coat.absorption[0] = std::array::from_fn(|i| per_quantum * (8 - i) as f32);
            coat.scattering[1] = std::array::from_fn(|i| per_quantum * (1 + i) as f32);
            let scene = flat_scene(ground, coat, Vec::new());
            let Some(device) = crate::device() else { return };
            let mut engine =
                PaintEngine::on_device(device, &Field::filled(count, count, 0)).unwrap();
            engine.set_wet(&wet).unwrap();
            let all = TileSet::all(engine.bounds());
            engine.render(View::First, &scene, &all, &TileSet::default()).unwrap();
            let picture = engine.picture().unwrap();
            let (off, cell) = largest(&picture, |i| {
                let nodes =
                    std::array::from_fn(|node| film(&coat, &wet.cell(i), node, f64::from(ground)));
                color(&scene, nodes)
            });
            let found = wet.cell(cell).pigments;
            assert!(off < NEAR, "{per_quantum} over {ground}: {off:e} off at {found:?}");
        }
    }
}

fn painted(rng: &mut ChaCha8Rng, size: usize) -> Layer {
    let mut layer = Layer::empty(size, size);
    for i in 0..size * size {
        if rng.random_range(0..3) > 0 {
            let pigments = std::array::from_fn(|_| rng.random_range(0..1 << 17));
            let cell = Cell { pigments, vehicle: rng.random_range(0..1 << 18) };
            // Every second cell has a skin.
            let share = if i % 2 == 0 { rng.random_range(0..65536) } else { 0 };
            let skin = cell.share_of_65536(share);
            layer.set_films(i, [cell.minus(&skin), skin]);
        }
    }
    layer
}

fn any_layer(rng: &mut ChaCha8Rng) -> LayerOptics {
    let [absorption, scattering] = [(); 2]
        .map(|()| std::array::from_fn(|_| std::array::from_fn(|_| rng.random_range(0.0..4e-6))));
    // About half of the cells are covered.
    let covers = std::array::from_fn(|_| rng.random_range(0.0..3e-6));
    LayerOptics { absorption, scattering, covers }
}

#[test]
fn layers_relief_and_gloss_are_those_of_the_formulas() {
    const SIZE: usize = 100;
    let mut rng = ChaCha8Rng::seed_from_u64(3);
    let Some(device) = crate::device() else { return };
    let floor = (0..SIZE * SIZE).map(|_| rng.random_range(-(1 << 19)..1 << 19)).collect();
    let floor = Field::from_values(SIZE, SIZE, floor);
    let layers: Vec<_> = (0..3).map(|_| painted(&mut rng, SIZE)).collect();
    let coats: Vec<_> = (0..3).map(|_| any_layer(&mut rng)).collect();
    let mut engine = PaintEngine::on_device(device, &floor).unwrap();
    engine.push_dry_layer(&layers[0]).unwrap();
    engine.push_dry_layer(&layers[1]).unwrap();
    engine.set_wet(&layers[2]).unwrap();
    let floor = engine.floor().unwrap();
    let mut scene = flat_scene(0.8, coats[2], coats[..2].to_vec());
    scene.lamp.relief = 0.7;
    let all = TileSet::all(engine.bounds());
    // The first call bakes the dry layers. The second only composites the wet layer over them.
    engine.render(View::First, &scene, &all, &TileSet::default()).unwrap();
    scene.lamp.ambient = 0.2;
    engine.render(View::First, &scene, &TileSet::default(), &all).unwrap();

    let top = |x: isize, y: isize| {
        let end = SIZE as isize - 1;
        let i = y.clamp(0, end) as usize * SIZE + x.clamp(0, end) as usize;
        f64::from(floor.values()[i]) + f64::from(layers[2].cell(i).volume())
    };
    let lamp = scene.lamp;
    let prepared = ReliefLamp::new(&scene);
    let picture = engine.picture().unwrap();
    let (off, cell) = largest(&picture, |i| {
        let nodes = std::array::from_fn(|node| {
            let stack = layers.iter().zip(&coats);
            let ground = f64::from(scene.ground[node]);
            stack.fold(ground, |ground, (paint, coat)| {
                let mut covered = 0.0;
                paint.films(i).into_iter().fold(ground, |bare, cell| {
                    let amounts = cell.pigments.into_iter().chain([cell.vehicle]).zip(coat.covers);
                    covered +=
                        amounts.map(|(a, share)| f64::from(a) * f64::from(share)).sum::<f64>();
                    let share = if covered > 0.0 { covered.min(1.0) } else { 1.0 };
                    let thicker = LayerOptics {
                        absorption: coat.absorption.map(|slot| slot.map(|k| k / share as f32)),
                        scattering: coat.scattering.map(|slot| slot.map(|s| s / share as f32)),
                        ..*coat
                    };
                    bare + share * (film(&thicker, &cell, node, bare) - bare)
                })
            })
        });
        let at = ((i % SIZE) as isize, (i / SIZE) as isize);
        let gloss = match bare(&layers, i) {
            0 => lamp.wet,
            1 => lamp.dry,
            _ => lamp.ground,
        };
        shaded(&prepared, &lamp, gloss, |x, y| top(at.0 + x, at.1 + y), color(&scene, nodes))
    });
    assert!(off < NEAR_STACK, "{off:e} off at cell {cell}");
}

/// Light of a cell by the formulas of [`paint::shade`] in f64. `flat` is the colour of a level
/// cell, and `top` gives heights around the cell in quanta.
fn shaded(
    prepared: &ReliefLamp,
    lamp: &Lamp,
    gloss: Gloss,
    top: impl Fn(isize, isize) -> f64,
    flat: [f64; 3],
) -> [f64; 3] {
    let unit = f64::from(QUANTA_PER_CELL);
    let relief = f64::from(lamp.relief);
    let ambient = f64::from(lamp.ambient);
    let light = lamp.direction.map(f64::from);
    let slope = |tap: &Tap| {
        let [x, y] = tap.offset.map(|cells| cells as isize);
        (top(x, y) - top(0, 0)) * f64::from(tap.per_quantum) - f64::from(tap.less)
    };
    let hidden = prepared.shadow.iter().map(slope).fold(0.0, f64::max);
    let free = 1.0 / (1.0 + (hidden / f64::from(SOFT)).powi(2));
    let sky = prepared.around.iter().map(|tap| slope(tap).max(0.0).powi(2)).sum::<f64>() / 8.0;
    let open = 1.0 / (1.0 + sky);

    let slope_x = relief * (top(1, 0) - top(-1, 0)) / (2.0 * unit);
    let slope_y = relief * (top(0, 1) - top(0, -1)) / (2.0 * unit);
    let normal = [-slope_x, -slope_y, 1.0];
    let size = normal.map(|v| v * v).iter().sum::<f64>().sqrt();
    let [by_light, by_halfway] = [light, [light[0], light[1], light[2] + 1.0]]
        .map(|way| normal.iter().zip(way).map(|(n, w)| n * w).sum::<f64>() / size);
    let direct = free * by_light.max(0.0) / light[2];
    let diffuse = ambient * open + (1.0 - ambient) * direct;
    let most = flat.into_iter().fold(0.0, f64::max);
    let more = (diffuse - 1.0).max(0.0);
    let bound = 1.0 + more * (most / (1.0 - most) + 1.0 / f64::from(MOST));
    let factor = diffuse.min(1.0) + more / bound;

    let halfway = [light[0], light[1], light[2] + 1.0];
    let length = halfway.map(|v| v * v).iter().sum::<f64>().sqrt();
    let exponent = f64::from(gloss.exponent);
    let level = (halfway[2] / length).powf(exponent);
    let mirrored = (by_halfway.max(0.0) / length).powf(exponent) - level;
    let shine = f64::from(gloss.strength) * (1.0 - ambient) * free * mirrored.max(0.0);
    flat.map(|value| value * factor + shine / (1.0 + shine) * (1.0 - value * factor))
}

/// Topmost material of a cell: 0 wet paint (the last of `layers`), 1 dry paint, 2 the ground.
fn bare(layers: &[Layer], cell: usize) -> u8 {
    fn has(layer: &Layer, cell: usize) -> bool {
        layer.cell(cell).volume() > 0
    }
    match (has(&layers[2], cell), layers[..2].iter().any(|layer| has(layer, cell))) {
        (true, _) => 0,
        (false, true) => 1,
        (false, false) => 2,
    }
}

#[test]
fn only_the_tiles_that_are_named_change() {
    let Some(device) = crate::device() else { return };
    let mut engine = PaintEngine::on_device(device, &Field::filled(200, 130, 0)).unwrap();
    let all = TileSet::all(engine.bounds());
    engine
        .render(View::First, &flat_scene(0.5, LayerOptics::EMPTY, Vec::new()), &all, &all)
        .unwrap();
    let before = engine.picture().unwrap();
    let mut one = TileSet::default();
    one.insert(graphics::tile::Rect { x: 130, y: 100, width: 1, height: 1 });
    engine
        .render(
            View::First,
            &flat_scene(0.9, LayerOptics::EMPTY, Vec::new()),
            &one,
            &TileSet::default(),
        )
        .unwrap();
    let after = engine.picture().unwrap();
    for y in 0..130 {
        for x in 0..200 {
            let inside = (128..192).contains(&x) && (64..128).contains(&y);
            assert_eq!(after[(x, y)] != before[(x, y)], inside, "cell {x}, {y}");
        }
    }
}
