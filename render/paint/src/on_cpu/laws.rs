//! What a sub-step keeps, over random contacts.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::OnCpu;
use super::reference::sub_step;
use crate::amount::{FULL, QUANTA_PER_CELL};
use crate::contact::{Contact, Touch};
use crate::engine::{BrushId, Engine};
use crate::layer::{Cell, Layer, SLOTS};
use crate::motion::Motion;
use crate::motion::press::CROWDED;
use graphics::field::Field;
use graphics::tile::Rect;

const BRUSH: BrushId = BrushId(0);

fn random_layer(random: &mut ChaCha8Rng, width: usize, height: usize, highest: u32) -> Layer {
    let mut layer = Layer::empty(width, height);
    for index in 0..width * height {
        // A third of the cells stay bare, and most pigments are in few cells.
        if random.random_range(0..3) > 0 {
            let mut amount = || match random.random_range(0..4) {
                0 => random.random_range(0..=highest / 9),
                1 => random.random_range(0..100),
                _ => 0,
            };
            let pigments = std::array::from_fn(|_| amount());
            layer.set_cell(index, Cell { pigments, vehicle: amount() });
        }
    }
    layer
}

/// An engine with paint up to four cells high on it and on its brush.
fn painted(random: &mut ChaCha8Rng, canvas: (usize, usize), brush: (usize, usize)) -> OnCpu {
    painted_to(4 * QUANTA_PER_CELL, random, canvas, brush)
}

/// The same, the paint on the canvas up to `highest` high.
fn painted_to(
    highest: u32,
    random: &mut ChaCha8Rng,
    canvas: (usize, usize),
    brush: (usize, usize),
) -> OnCpu {
    let heights = (0..canvas.0 * canvas.1).map(|_| random.random_range(-9999..300_000)).collect();
    let mut engine = OnCpu::new(Field::from_values(canvas.0, canvas.1, heights));
    let wet = random_layer(random, canvas.0, canvas.1, highest);
    engine.set_wet(&wet).expect("room");
    engine.add_brush(brush.0, brush.1).expect("room");
    let paint = random_layer(random, brush.0, brush.1, 4 * QUANTA_PER_CELL);
    engine.set_brush(BRUSH, &paint).expect("room");
    engine
}

/// A head with holes at random heights, `coarse` cells of the canvas under each
/// of its own, in x and in y; at `speed` of 256.
fn random_contact(
    random: &mut ChaCha8Rng,
    canvas: (usize, usize),
    brush: (usize, usize),
    speed: Option<u16>,
) -> Contact {
    let (width, height) =
        (random.random_range(1..=canvas.0.min(40)), random.random_range(1..=canvas.1.min(40)));
    let x = random.random_range(0..=canvas.0 - width);
    let y = random.random_range(0..=canvas.1 - height);
    let coarse = random.random_range(1..=3);
    let cell = |i: usize| {
        ((i / width) / coarse % brush.1 * brush.0 + (i % width) / coarse % brush.0) as u32
    };
    let mut sharers = vec![0_u16; brush.0 * brush.1];
    (0..width * height).for_each(|i| sharers[cell(i) as usize] += 1);
    let lowest = random.random_range(-1..=2) * QUANTA_PER_CELL as i32;
    let touches = (0..width * height).map(|i| {
        if random.random_range(0..5) == 0 {
            return Touch::NONE;
        }
        let height = lowest + random.random_range(0..2 * QUANTA_PER_CELL as i32);
        let velocity = (random.random_range(-300..=300), random.random_range(-300..=300));
        let speed = speed.unwrap_or_else(|| random.random_range(0..=256));
        Touch::new(height, cell(i), velocity, speed, sharers[cell(i) as usize])
    });
    Contact { rect: Rect { x, y, width, height }, touches: touches.collect() }
}

fn totals(engine: &mut OnCpu) -> [u64; SLOTS + 1] {
    let wet = engine.wet().expect("paint").totals();
    let brush = engine.brush(BRUSH).expect("paint").totals();
    std::array::from_fn(|i| wet[i] + brush[i])
}

#[test]
fn over_ten_thousand_sub_steps_no_pigment_is_lost_or_made_and_no_cell_is_overfull() {
    let random = &mut ChaCha8Rng::seed_from_u64(1);
    let (canvas, brush) = ((60, 44), (24, 17));
    let mut engine = painted(random, canvas, brush);
    let before = totals(&mut engine);
    for _ in 0..100 {
        let contacts: Vec<_> =
            (0..100).map(|_| random_contact(random, canvas, brush, None)).collect();
        engine.play(BRUSH, &Motion::default(), &contacts).expect("played");
    }
    assert_eq!(totals(&mut engine), before);
    let wet = engine.wet().expect("paint");
    let highest = (0..60 * 44).map(|i| wet.cell(i).volume()).max();
    assert!(highest.is_some_and(|highest| highest <= FULL), "{highest:?} in a cell");
}

#[test]
fn the_fast_path_agrees_with_the_specification() {
    let random = &mut ChaCha8Rng::seed_from_u64(2);
    let low = 4 * QUANTA_PER_CELL;
    for (canvas, highest) in [
        ((50, 30), low),
        ((7, 90), low),
        ((1, 1), low),
        ((3, 2), low),
        ((90, 90), low),
        ((50, 30), 4 * CROWDED),
        ((1, 9), 4 * CROWDED),
    ] {
        let brush = (11, 13);
        let mut engine = painted_to(highest, random, canvas, brush);
        let motions = [
            Motion::default(),
            Motion { push: 7, adhesion: 65535, most: 65535, cutoff: 256 },
            Motion { push: 1 << 30, adhesion: 0, most: 0, cutoff: 1 << 30 },
        ];
        for (i, motion) in motions.iter().cycle().take(60).enumerate() {
            let contact = random_contact(random, canvas, brush, None);
            let (mut wet, mut paint) =
                (engine.wet().expect("paint"), engine.brush(BRUSH).expect("paint"));
            let floor = engine.floor().expect("a floor");
            sub_step(motion, &contact, &floor, &mut wet, &mut paint);
            engine.play(BRUSH, motion, &[contact]).expect("played");
            assert!(engine.wet().expect("paint") == wet, "canvas {canvas:?}, sub-step {i}");
            assert!(engine.brush(BRUSH).expect("paint") == paint, "brush, sub-step {i}");
            let columns = (0..wet.vehicle.values().len()).map(|at| wet.cell(at).volume());
            assert!(engine.wet.volume().iter().copied().eq(columns), "volumes, sub-step {i}");
        }
    }
}

#[test]
fn columns_pushed_together_stay_below_full_and_whole() {
    let random = &mut ChaCha8Rng::seed_from_u64(8);
    let (canvas, brush) = ((40, 40), (9, 9));
    let mut engine = OnCpu::new(Field::filled(40, 40, 0));
    let vehicle = Field::filled(40, 40, CROWDED - 1);
    let wet = Layer { vehicle, ..Layer::empty(40, 40) };
    engine.set_wet(&wet).expect("room");
    engine.add_brush(brush.0, brush.1).expect("room");
    let before = totals(&mut engine);
    let pushy = Motion { push: 7, ..Motion::default() };
    for _ in 0..400 {
        let contact = random_contact(random, canvas, brush, None);
        engine.play(BRUSH, &pushy, &[contact]).expect("played");
    }
    let wet = engine.wet().expect("paint");
    let highest = (0..40 * 40).map(|i| wet.cell(i).volume()).max().expect("cells");
    assert!((CROWDED..FULL).contains(&highest), "{highest} in a cell");
    assert_eq!(totals(&mut engine), before);
}

#[test]
fn a_still_brush_moves_no_paint_across_sides_and_leaves_the_adhesion() {
    let random = &mut ChaCha8Rng::seed_from_u64(3);
    let (canvas, brush) = ((40, 40), (9, 9));
    let mut engine = painted(random, canvas, brush);
    let motion = Motion::default();
    let head = engine.brush(BRUSH).expect("paint");
    for _ in 0..200 {
        let before = engine.wet().expect("paint");
        let contact = random_contact(random, canvas, brush, Some(0));
        engine.play(BRUSH, &motion, &[contact]).expect("played");
        let after = engine.wet().expect("paint");
        for index in 0..canvas.0 * canvas.1 {
            let stays = before.cell(index).volume().min(motion.adhesion);
            let volume = after.cell(index).volume();
            assert!(volume >= stays, "cell {index}: {volume} of {stays}");
        }
    }
    assert!(engine.brush(BRUSH).expect("paint") == head, "the head's paint changed");
}

#[test]
fn the_result_does_not_depend_on_the_number_of_threads() {
    let play = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| {
            let random = &mut ChaCha8Rng::seed_from_u64(4);
            let (canvas, brush) = ((150, 130), (60, 60));
            let mut engine = painted(random, canvas, brush);
            let contacts: Vec<_> = (0..20).map(|_| whole_contact(random, canvas, brush)).collect();
            engine.play(BRUSH, &Motion::default(), &contacts).expect("played");
            (engine.wet().expect("paint"), engine.brush(BRUSH).expect("paint"))
        })
    };
    let alone = play(1);
    for threads in [2, 3, 5] {
        assert!(play(threads) == alone, "{threads} threads");
    }
}

/// A contact that covers the canvas with random ones, enough for many threads.
fn whole_contact(
    random: &mut ChaCha8Rng,
    canvas: (usize, usize),
    brush: (usize, usize),
) -> Contact {
    let part = random_contact(random, (40, 40), brush, None);
    let touch = |i: usize| {
        let (x, y) = (i % canvas.0 % part.rect.width, i / canvas.0 % part.rect.height);
        let touch = part.touches[y * part.rect.width + x];
        let sharers = (canvas.0 * canvas.1) as u16;
        Touch { weights: touch.speed() | u32::from(sharers) << 16, ..touch }
    };
    let rect = Rect { x: 0, y: 0, width: canvas.0, height: canvas.1 };
    Contact { rect, touches: (0..canvas.0 * canvas.1).map(touch).collect() }
}

#[test]
fn paint_stays_on_the_canvas() {
    let random = &mut ChaCha8Rng::seed_from_u64(5);
    let mut engine = painted(random, (12, 9), (1, 1));
    engine.set_brush(BRUSH, &Layer::empty(1, 1)).expect("room");
    let before = totals(&mut engine);
    let touch = Touch::new(i32::MIN / 4, 0, (256, 256), 0, 108);
    let contact = Contact { rect: engine.bounds(), touches: vec![touch; 108] };
    engine.play(BRUSH, &Motion::default(), &vec![contact; 100]).expect("played");
    assert_eq!(totals(&mut engine), before);
    let wet = engine.wet().expect("paint");
    let edge: u64 = (0..108)
        .filter(|i| i % 12 >= 8 || i / 12 >= 6)
        .map(|i| u64::from(wet.cell(i).volume()))
        .sum();
    let all: u64 = before.iter().sum();
    assert!(edge * 10 > all * 9, "{edge} of {all} quanta were pushed into the corner");
}
