//! Drying, dry layers, undo tiles, and rendering of changed tiles.

use crate::engine::cpu::CpuPaint;
use crate::engine::{UndoSlot, View};
use crate::layer::{Cell, Layer, SLOTS};
use crate::optics::{Gloss, Lamp, LayerOptics, NODES, Scene, SceneSurface};
use graphics::field::Field;
use graphics::tile::{Rect, Tile, TileSet};

const WIDTH: usize = 150;
const HEIGHT: usize = 100;

/// Paint in the cells of `rect` only, with different amounts in each cell.
fn paint_in(rect: Rect) -> Layer {
    let mut layer = Layer::empty(WIDTH, HEIGHT);
    for y in rect.y..rect.y + rect.height {
        for x in rect.x..rect.x + rect.width {
            let pigments = std::array::from_fn(|i| (x * 1000 + y * 7 + i * 10_000) as u32);
            layer.set_cell(y * WIDTH + x, Cell { pigments, vehicle: (y * 100) as u32 });
        }
    }
    layer
}

/// A rectangle that overlaps four of the six tiles.
const SPOT: Rect = Rect { x: 50, y: 40, width: 40, height: 40 };

fn engine() -> CpuPaint {
    let heights = (0..WIDTH * HEIGHT).map(|i| (i % 321) as i32 - 100).collect();
    let mut engine = CpuPaint::new(Field::from_values(WIDTH, HEIGHT, heights));
    engine.set_wet(&paint_in(SPOT));
    engine
}

#[test]
fn drying_parts_the_paint_and_raises_the_floor_by_what_dried() {
    let mut engine = engine();
    let wet = engine.wet();
    let floor = engine.floor();
    engine.dry(20_000);
    assert_eq!(engine.dry_layer_count(), 1);
    let rest = engine.wet();
    let dried = engine.dry_layer(0);
    let risen = engine.floor();
    for index in 0..WIDTH * HEIGHT {
        assert_eq!(rest.cell(index).plus(&dried.cell(index)), wet.cell(index), "cell {index}");
        assert_eq!(dried.cell(index), wet.cell(index).share_of_65536(20_000), "cell {index}");
        let rise = risen.values()[index] - floor.values()[index];
        assert_eq!(rise, dried.cell(index).volume() as i32, "cell {index}");
    }
    assert!(engine.remove_dry_layer(0) == dried, "the popped layer differs");
    assert!(engine.floor() == floor, "floor without the layer");
    engine.insert_dry_layer(0, &dried);
    assert!(engine.floor() == risen, "floor with the layer");
    engine.dry(65_536);
    assert_eq!(engine.wet().totals(), [0; SLOTS + 1]);
}

#[test]
fn a_dry_layer_takes_memory_only_where_it_is_painted() {
    let mut engine = engine();
    engine.dry(65_536);
    engine.dry(65_536);
    let tiles: Vec<_> = engine.dry.iter().map(|layer| layer.tiles().count()).collect();
    assert_eq!(tiles, [4, 0]);
}

#[test]
fn a_tile_is_exchanged_with_what_was_saved_and_nothing_else_changes() {
    let mut engine = engine();
    let before = engine.wet();
    let tile = Tile { row: 1, column: 1 };
    engine.save_tile(tile, UndoSlot(3));
    engine.set_wet(&paint_in(Rect { x: 0, y: 0, width: WIDTH, height: HEIGHT }));
    let after = engine.wet();
    engine.swap_tile(tile, UndoSlot(3));
    let swapped = engine.wet();
    for index in 0..WIDTH * HEIGHT {
        let x = index % WIDTH;
        let y = index / WIDTH;
        let inside = (64..128).contains(&x) && y >= 64;
        let expected = if inside { before.cell(index) } else { after.cell(index) };
        assert_eq!(swapped.cell(index), expected, "cell {x}, {y}");
    }
    engine.swap_tile(tile, UndoSlot(3));
    assert!(engine.wet() == after, "exchanged twice");
}

fn scene(layers: usize) -> Scene {
    let layer = |strength: f32| LayerOptics {
        absorption: std::array::from_fn(|slot| {
            std::array::from_fn(|node| strength * ((slot * 3 + node * 5) % 7) as f32)
        }),
        scattering: [[strength * 2.0; NODES]; SLOTS],
    };
    let gloss = |strength: f32| Gloss { strength, exponent: 20.0 };
    Scene {
        ground: [0.8; NODES],
        dry: (0..layers).map(|i| layer(1e-6 * (i + 1) as f32)).collect(),
        wet: layer(2e-6),
        surface: SceneSurface { k1: 0.03, k2: 0.5, specular: 0.0 },
        rgb_from_nodes: std::array::from_fn(|node| [0.125, 0.02 * node as f32, 0.1]),
        lamp: Lamp {
            direction: [-0.5, -0.5, 0.707],
            relief: 1.0,
            ambient: 0.5,
            wet: gloss(0.3),
            dry: gloss(0.2),
            ground: gloss(0.1),
        },
        cell_mm: 0.1,
    }
}

#[test]
fn lighting_what_changed_gives_the_picture_of_lighting_all() {
    let mut engine = engine();
    engine.dry(30_000);
    let all = TileSet::all(engine.bounds());
    let none = TileSet::default();
    engine.render(View::First, &scene(1), &all, &none);
    let first = engine.picture();
    // Replaces the wet paint of `SPOT` by paint in one of its four tiles, and later dries it.
    let stroke = Rect { x: 70, y: 70, width: 20, height: 20 };
    engine.set_wet(&paint_in(stroke));
    let mut spot = TileSet::default();
    spot.insert(SPOT);
    engine.render(View::First, &scene(1), &none, &spot);
    let shown = engine.picture();
    engine.render(View::First, &scene(1), &all, &none);
    assert!(engine.picture() == shown, "shown tiles alone");
    // Shading looks 8 cells of 0.1 mm far.
    let untouched = |x: usize, y: usize| x >= 128 || !(32..88).contains(&y) && x < 42;
    for (index, (now, before)) in shown.values().iter().zip(first.values()).enumerate() {
        let x = index % WIDTH;
        let y = index / WIDTH;
        assert!(!untouched(x, y) || now == before, "cell {x}, {y}");
    }
    assert_ne!(shown[(80, 80)], first[(80, 80)]);
    engine.dry(65_536);
    engine.render(View::First, &scene(2), &spot, &none);
    let baked = engine.picture();
    engine.render(View::First, &scene(2), &all, &all);
    assert!(engine.picture() == baked, "baked tiles alone");
    assert!(baked.values().iter().all(|rgba| rgba.iter().all(|v| v.is_finite())), "finite");
}

#[test]
fn bare_ground_shows_what_an_instrument_would_read_of_it() {
    let mut engine = CpuPaint::new(Field::filled(WIDTH, HEIGHT, 0));
    let all = TileSet::all(engine.bounds());
    engine.render(View::First, &scene(0), &all, &all);
    let seen = engine.picture()[(7, 5)][0];
    // Internal reflectance 0.8, k1 = 0.03, k2 = 0.5; the weights of eight nodes sum to 1.
    let measured = 0.97 * 0.5 * 0.8 / (1.0 - 0.5 * 0.8);
    assert!((seen - measured).abs() < 1e-6, "{seen} {measured}");
}

#[test]
fn a_picture_before_any_light_is_dark() {
    let picture = engine().picture();
    assert!(picture.values().iter().all(|rgba| *rgba == [0.0, 0.0, 0.0, 1.0]), "not dark");
    assert_eq!((picture.width(), picture.height()), (WIDTH, HEIGHT));
}
