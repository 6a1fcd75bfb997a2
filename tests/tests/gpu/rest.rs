//! Drying, dry layers and undo tiles on the GPU: exact amounts, and exact restoring.

use graphics::field::Field;
use graphics::tile::{TILE, Tile};
use paint::UndoSlot;
use paint::engine::PaintEngine;
use paint::layer::Layer;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::reference::{Amounts, paint};

const SIZE: (usize, usize) = (150, 70);

fn canvas(seed: u64) -> Option<(PaintEngine, Field<i32>, Layer)> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let floor = (0..SIZE.0 * SIZE.1).map(|_| rng.random_range(-1000..1000)).collect();
    let floor = Field::from_values(SIZE.0, SIZE.1, floor);
    let wet = paint(&mut rng, SIZE, Amounts::Usual);
    let mut engine = PaintEngine::on_device(crate::device()?, &floor).unwrap();
    engine.set_wet(&wet).unwrap();
    Some((engine, floor, wet))
}

fn raised(floor: &Field<i32>, layer: &Layer) -> Field<i32> {
    let mut floor = floor.clone();
    for (i, height) in floor.values_mut().iter_mut().enumerate() {
        *height += layer.cell(i).volume() as i32;
    }
    floor
}

#[test]
fn paint_dries_from_the_bottom_and_the_floor_rises() {
    for share in [0, 1, 30000, 65536] {
        let Some((mut engine, floor, wet)) = canvas(u64::from(share)) else { return };
        let mut dried = Layer::empty(SIZE.0, SIZE.1);
        let mut left = dried.clone();
        for i in 0..SIZE.0 * SIZE.1 {
            dried.set_cell(i, wet.cell(i).share_of_65536(share));
            left.set_cell(i, wet.cell(i).minus(&dried.cell(i)));
        }
        engine.dry(share).unwrap();
        assert!(engine.wet().unwrap() == left, "wet paint after {share}");
        assert_eq!(engine.dry_layer_count(), 1);
        assert!(engine.dry_layer(0).unwrap() == dried, "dry layer after {share}");
        assert!(engine.floor().unwrap() == raised(&floor, &dried), "floor after {share}");
    }
}

#[test]
fn a_dry_layer_comes_and_goes() {
    let Some((mut engine, floor, wet)) = canvas(5) else { return };
    engine.push_dry_layer(&wet).unwrap();
    engine.dry(20000).unwrap();
    let top = engine.pop_dry_layer().unwrap();
    assert_eq!(engine.dry_layer_count(), 1);
    assert!(engine.floor().unwrap() == raised(&floor, &wet), "floor with one layer");
    engine.push_dry_layer(&top).unwrap();
    assert!(engine.dry_layer(1).unwrap() == top, "the layer pushed again");
    engine.pop_dry_layer().unwrap();
    assert!(engine.pop_dry_layer().unwrap() == wet, "the first layer");
    assert!(engine.floor().unwrap() == floor, "floor without layers");
}

#[test]
fn undo_then_redo_is_the_identity() {
    let Some((mut engine, _, before)) = canvas(6) else { return };
    let after = paint(&mut ChaCha8Rng::seed_from_u64(7), SIZE, Amounts::Usual);
    let tiles: Vec<_> = (0..SIZE.1.div_ceil(TILE))
        .flat_map(|row| (0..SIZE.0.div_ceil(TILE)).map(move |column| Tile { row, column }))
        .collect();
    // Slots in several blocks of undo memory, in descending order.
    let slot = |i: usize| UndoSlot(200 - 30 * i);
    for (i, &tile) in tiles.iter().enumerate() {
        engine.save_tile(tile, slot(i)).unwrap();
    }
    engine.set_wet(&after).unwrap();
    for wanted in [&before, &after, &before] {
        for (i, &tile) in tiles.iter().enumerate() {
            engine.swap_tile(tile, slot(i)).unwrap();
        }
        assert!(engine.wet().unwrap() == *wanted, "undo or redo");
    }
}
