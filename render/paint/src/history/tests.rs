//! Tests of undo and redo with random actions on the CPU, and of the memory limit.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::{CommitOutcome, History, TILE_BYTES};
use crate::contact::{Contact, ExchangeRates, Touch, Wicking};
use crate::engine::{BrushId, PaintEngine};
use crate::layer::{Cell, Layer};
use crate::motion::MotionConstants;
use graphics::field::Field;
use graphics::tile::Rect;

/// Size of the canvas in cells: six tiles, smaller ones at the right and lower edges.
const WIDTH: usize = 150;
const HEIGHT: usize = 100;
const SIZE: usize = 30;

/// The wet layer, brushes, dry layers and floor of an engine, and the caller's value.
type State = (Layer, Vec<Layer>, Vec<Layer>, Field<i32>, usize);

fn state(engine: &mut PaintEngine, caller: usize) -> State {
    let brushes = [0, 1].map(|i| engine.brush_paint(BrushId(i)).unwrap()).to_vec();
    let dry = (0..engine.dry_layer_count()).map(|i| engine.dry_layer(i).unwrap()).collect();
    (engine.wet().unwrap(), brushes, dry, engine.floor().unwrap(), caller)
}

fn painted(width: usize, height: usize, random: &mut ChaCha8Rng) -> Layer {
    let mut layer = Layer::empty(width, height);
    for index in 0..width * height {
        let mut amount = || random.random_range(0..400_000);
        let pigments = std::array::from_fn(|_| amount());
        layer.set_cell(index, Cell { pigments, vehicle: amount() });
    }
    layer
}

fn engine(random: &mut ChaCha8Rng) -> PaintEngine {
    let mut engine = PaintEngine::on_cpu(Field::filled(WIDTH, HEIGHT, 1000));
    engine.set_wet(&painted(WIDTH, HEIGHT, random)).unwrap();
    for _ in 0..2 {
        let brush = engine.add_brush(SIZE, SIZE).unwrap();
        engine.set_brush_paint(brush, &painted(SIZE, SIZE, random)).unwrap();
    }
    engine
}

fn stroke(history: &mut History<usize>, engine: &mut PaintEngine, random: &mut ChaCha8Rng) {
    let brush = BrushId(random.random_range(0..2));
    history.save_brush(engine, brush).unwrap();
    for _ in 0..random.random_range(1..4) {
        let x = random.random_range(0..=WIDTH - SIZE);
        let y = random.random_range(0..=HEIGHT - SIZE);
        let rect = Rect { x, y, width: SIZE, height: SIZE };
        let reach = rect.grown(2, engine.bounds());
        history.save_tiles(engine, reach).unwrap();
        let velocity = (random.random_range(-256..=256), random.random_range(-256..=256));
        let touches = (0..SIZE * SIZE).map(|i| Touch::new(900_000, i as u32, velocity, 256, 1));
        let rates = ExchangeRates {
            release: 20_000,
            deposit: 6000,
            pick_up: 6000,
            mixing: 900,
            ..ExchangeRates::default()
        };
        let wicking = Wicking { share: 9000, ..Wicking::default() };
        let contact = Contact { rect, touches: touches.collect(), rates, wicking };
        engine.apply_contacts(brush, &MotionConstants::new(0.1, 0.7), &[contact]).unwrap();
    }
}

/// One action: a stroke, a new dry layer, drying with a layer moved, or a dry layer replaced by another.
fn act(
    history: &mut History<usize>,
    engine: &mut PaintEngine,
    random: &mut ChaCha8Rng,
    turn: usize,
) {
    match turn % 5 {
        1 => {
            let layer = painted(WIDTH, HEIGHT, random);
            let index = random.random_range(0..=engine.dry_layer_count());
            history.insert_dry_layer(engine, index, &layer).unwrap();
        }
        2 => {
            history.dry(engine, random.random_range(0..=65536)).unwrap();
            let count = engine.dry_layer_count();
            let from = random.random_range(0..count);
            let to = random.random_range(0..count);
            history.move_dry_layer(engine, from, to);
        }
        4 => {
            stroke(history, engine, random);
            let index = random.random_range(0..engine.dry_layer_count());
            history.remove_dry_layer(engine, index).unwrap();
            history.dry(engine, 30_000).unwrap();
        }
        _ => stroke(history, engine, random),
    }
}

#[test]
fn undo_and_redo_walk_the_same_states_to_the_bit() {
    let random = &mut ChaCha8Rng::seed_from_u64(1);
    let mut engine = engine(random);
    let mut history = History::new(u64::MAX);
    let mut states = vec![state(&mut engine, 0)];
    for now in 0..25 {
        history.begin(now);
        act(&mut history, &mut engine, random, now);
        assert_eq!(history.commit(), CommitOutcome::Undoable);
        states.push(state(&mut engine, now + 1));
    }
    let mut at = 25;
    for step in 0..80 {
        // Undoes every action, redoes every action, then either at random.
        let back = match step {
            0..25 => true,
            25..50 => false,
            _ => random.random_range(0..2) == 0,
        };
        let caller = states[at].4;
        let restored = if back {
            history.undo(&mut engine, caller)
        } else {
            history.redo(&mut engine, caller)
        };
        let Some(restored) = restored.unwrap() else { continue };
        at = if back { at - 1 } else { at + 1 };
        assert!(state(&mut engine, restored.caller) == states[at], "step {step}, state {at}");
    }
    assert_eq!(history.undo_count() + history.redo_count(), 25);
}

#[test]
fn memory_stays_within_its_limit_and_slots_are_used_again() {
    let random = &mut ChaCha8Rng::seed_from_u64(2);
    let mut engine = engine(random);
    let limit = 12 * TILE_BYTES;
    let mut history = History::new(limit);
    let mut most = 0;
    let mut states = Vec::new();
    for now in 0..60 {
        states.push(state(&mut engine, now));
        history.begin(now);
        stroke(&mut history, &mut engine, random);
        assert_eq!(history.commit(), CommitOutcome::Undoable, "action {now}");
        assert!(history.bytes() <= limit, "{} of {limit} bytes", history.bytes());
        most = most.max(history.bytes());
    }
    assert!(most > limit / 2, "{most} of {limit} bytes");
    assert!(history.slot_count <= 12, "{} slots", history.slot_count);
    assert!((1..60).contains(&history.undo_count()), "{} kept", history.undo_count());
    let mut now = 60;
    while let Some(restored) = history.undo(&mut engine, now).unwrap() {
        now -= 1;
        assert!(state(&mut engine, restored.caller) == states[now], "state {now}");
        assert!(history.bytes() <= limit, "{} of {limit} bytes", history.bytes());
    }
    history.begin(now);
    assert_eq!((history.redo_count(), history.bytes()), (0, 0));
}

#[test]
fn an_action_beyond_the_limit_stays_done_and_cannot_be_undone() {
    let random = &mut ChaCha8Rng::seed_from_u64(3);
    let mut engine = engine(random);
    let mut history = History::new(5 * TILE_BYTES);
    let one_tile = Rect { x: 0, y: 0, width: 64, height: 64 };
    history.begin(0);
    history.save_tiles(&mut engine, one_tile).unwrap();
    assert_eq!(history.commit(), CommitOutcome::Undoable);
    let mut other = PaintEngine::on_cpu(engine.floor().unwrap());
    other.set_wet(&engine.wet().unwrap()).unwrap();
    other.dry(1000).unwrap();
    history.begin(1);
    // Drying saves all six tiles, but the limit is five.
    history.dry(&mut engine, 1000).unwrap();
    assert_eq!(history.commit(), CommitOutcome::TooLarge);
    assert!(engine.wet().unwrap() == other.wet().unwrap(), "drying differs without undo");
    assert!(history.undo(&mut engine, 2).unwrap().is_none(), "undone beyond the limit");
    assert_eq!(history.bytes(), 0);
    history.begin(2);
    history.save_tiles(&mut engine, one_tile).unwrap();
    assert_eq!(history.commit(), CommitOutcome::Undoable);
}

#[test]
fn actions_that_nothing_reaches_give_their_memory_back() {
    let random = &mut ChaCha8Rng::seed_from_u64(4);
    let mut engine = engine(random);
    let mut history = History::new(u64::MAX);
    for now in 0..6 {
        history.begin(now);
        stroke(&mut history, &mut engine, random);
        history.commit();
    }
    history.undo(&mut engine, 6).unwrap();
    history.undo(&mut engine, 5).unwrap();
    let before = history.bytes();
    history.keep_only(1, 1);
    assert_eq!((history.undo_count(), history.redo_count()), (1, 1));
    assert!(history.bytes() < before, "{} of {before} bytes", history.bytes());
    let next = history.redo(&mut engine, 4).unwrap().unwrap();
    assert_eq!(next.caller, 5, "the next redo is kept, not the last");
}
