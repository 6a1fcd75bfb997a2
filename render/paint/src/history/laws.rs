//! Undo and redo over random actions on the processor.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::{History, Kept, TILE_BYTES};
use crate::contact::{Contact, Touch};
use crate::engine::{BrushId, Engine};
use crate::layer::{Cell, Layer};
use crate::motion::Motion;
use crate::on_cpu::OnCpu;
use graphics::field::Field;
use graphics::tile::Rect;

/// Six tiles, those at the right and lower edge smaller.
const WIDTH: usize = 150;
const HEIGHT: usize = 100;
const SIZE: usize = 30;

/// All that an engine holds, and the number that the caller keeps with it.
type State = (Layer, Vec<Layer>, Vec<Layer>, Field<i32>, usize);

fn state(engine: &mut OnCpu, caller: usize) -> State {
    let brushes = [0, 1].map(|i| engine.brush(BrushId(i)).expect("paint")).to_vec();
    let dry = (0..engine.dry_count()).map(|i| engine.dry_layer(i).expect("paint")).collect();
    (engine.wet().expect("paint"), brushes, dry, engine.floor().expect("a floor"), caller)
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

fn engine(random: &mut ChaCha8Rng) -> OnCpu {
    let mut engine = OnCpu::new(Field::filled(WIDTH, HEIGHT, 1000));
    engine.set_wet(&painted(WIDTH, HEIGHT, random)).expect("room");
    for _ in 0..2 {
        let brush = engine.add_brush(SIZE, SIZE).expect("room");
        engine.set_brush(brush, &painted(SIZE, SIZE, random)).expect("room");
    }
    engine
}

fn stroke(history: &mut History<usize>, engine: &mut OnCpu, random: &mut ChaCha8Rng) {
    let brush = BrushId(random.random_range(0..2));
    history.touch_brush(engine, brush).expect("room");
    for _ in 0..random.random_range(1..4) {
        let x = random.random_range(0..=WIDTH - SIZE);
        let y = random.random_range(0..=HEIGHT - SIZE);
        let rect = Rect { x, y, width: SIZE, height: SIZE };
        let reach = rect.grown(2, engine.bounds());
        history.touch(engine, reach).expect("room");
        let velocity = (random.random_range(-256..=256), random.random_range(-256..=256));
        let touches = (0..SIZE * SIZE).map(|i| Touch::new(900_000, i as u32, velocity, 256, 1));
        let contact = Contact { rect, touches: touches.collect() };
        engine.play(brush, &Motion::default(), &[contact]).expect("played");
    }
}

/// Strokes, and in turn a dry layer more, drying, and a layer exchanged for
/// another.
fn act(history: &mut History<usize>, engine: &mut OnCpu, random: &mut ChaCha8Rng, turn: usize) {
    match turn % 5 {
        1 => {
            let layer = painted(WIDTH, HEIGHT, random);
            history.push_dry(engine, &layer).expect("room");
        }
        2 => history.dry(engine, random.random_range(0..=65536)).expect("room"),
        4 => {
            stroke(history, engine, random);
            history.pop_dry(engine).expect("a layer");
            history.dry(engine, 30_000).expect("room");
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
        assert_eq!(history.commit(), Kept::Undoable);
        states.push(state(&mut engine, now + 1));
    }
    let mut at = 25;
    for step in 0..80 {
        // All the way back, all the way on, then at random.
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
        let Some(restored) = restored.expect("no device to lose") else { continue };
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
    let (mut most, mut states) = (0, Vec::new());
    for now in 0..60 {
        states.push(state(&mut engine, now));
        history.begin(now);
        stroke(&mut history, &mut engine, random);
        assert_eq!(history.commit(), Kept::Undoable, "action {now}");
        assert!(history.bytes() <= limit, "{} of {limit} bytes", history.bytes());
        most = most.max(history.bytes());
    }
    assert!(most > limit / 2, "{most} of {limit} bytes");
    assert!(history.slots <= 12, "{} slots", history.slots);
    assert!((1..60).contains(&history.undo_count()), "{} kept", history.undo_count());
    let mut now = 60;
    while let Some(restored) = history.undo(&mut engine, now).expect("no device to lose") {
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
    history.touch(&mut engine, one_tile).expect("room");
    assert_eq!(history.commit(), Kept::Undoable);
    let mut other = OnCpu::new(engine.floor().expect("a floor"));
    other.set_wet(&engine.wet().expect("paint")).expect("room");
    other.dry(1000).expect("room");
    history.begin(1);
    // Six tiles.
    history.dry(&mut engine, 1000).expect("room");
    assert_eq!(history.commit(), Kept::TooLarge);
    assert!(engine.wet().expect("paint") == other.wet().expect("paint"), "dried otherwise");
    assert!(history.undo(&mut engine, 2).expect("no device to lose").is_none(), "undone");
    assert_eq!(history.bytes(), 0);
    history.begin(2);
    history.touch(&mut engine, one_tile).expect("room");
    assert_eq!(history.commit(), Kept::Undoable);
}
