//! Sub-steps with random contacts: conservation of paint, limits of columns, agreement with the
//! reference, and independence of threads.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::amount::{MAX_COLUMN, QUANTA_PER_CELL};
use crate::contact::{Contact, ExchangeRates, Touch, Wicking};
use crate::engine::BrushId;
use crate::engine::cpu::CpuPaint;
use crate::engine::cpu::below::Below;
use crate::engine::cpu::reference::sub_step;
use crate::layer::{Cell, Layer, SLOTS};
use crate::mask::Mask;
use crate::motion::MotionConstants;
use crate::motion::press::CROWDED_VOLUME;
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

/// An engine with random paint up to four cells high on its canvas and on its brush.
fn painted(random: &mut ChaCha8Rng, canvas: (usize, usize), brush: (usize, usize)) -> CpuPaint {
    painted_to(4 * QUANTA_PER_CELL, random, canvas, brush)
}

/// An engine like [`painted`], but with paint on the canvas up to `highest` quanta high.
fn painted_to(
    highest: u32,
    random: &mut ChaCha8Rng,
    canvas: (usize, usize),
    brush: (usize, usize),
) -> CpuPaint {
    let heights = (0..canvas.0 * canvas.1).map(|_| random.random_range(-9999..300_000)).collect();
    let mut engine = CpuPaint::new(Field::from_values(canvas.0, canvas.1, heights));
    let wet = random_layer(random, canvas.0, canvas.1, highest);
    engine.set_wet(&wet);
    engine.add_brush(brush.0, brush.1);
    let paint = random_layer(random, brush.0, brush.1, 4 * QUANTA_PER_CELL);
    engine.set_brush_paint(BRUSH, &paint);
    engine
}

/// A random contact of a head with holes. Each head cell covers up to 3 x 3 canvas cells. `speed`,
/// in parts of 256, is random if `None`.
fn random_contact(
    random: &mut ChaCha8Rng,
    canvas: (usize, usize),
    brush: (usize, usize),
    speed: Option<u16>,
) -> Contact {
    let width = random.random_range(1..=canvas.0.min(40));
    let height = random.random_range(1..=canvas.1.min(40));
    let x = random.random_range(0..=canvas.0 - width);
    let y = random.random_range(0..=canvas.1 - height);
    let coarse = random.random_range(1..=3);
    let cell = |i: usize| {
        ((i / width) / coarse % brush.1 * brush.0 + (i % width) / coarse % brush.0) as u32
    };
    let mut sharers = vec![0_u16; brush.0 * brush.1];
    (0..width * height).for_each(|i| sharers[cell(i) as usize] += 1);
    let lowest = random.random_range(-1..=2) * QUANTA_PER_CELL as i32;
    // Half of the heads are stripes across the rows.
    let stripes = random.random_bool(0.5);
    let touches = (0..width * height).map(|i| {
        let between = stripes && (i % width + 2 * (i / width)) % 16 > 3;
        if between || random.random_range(0..5) == 0 {
            return Touch::NONE;
        }
        let height = lowest + random.random_range(0..2 * QUANTA_PER_CELL as i32);
        let velocity = (random.random_range(-300..=300), random.random_range(-300..=300));
        let speed = speed.unwrap_or_else(|| random.random_range(0..=256));
        let mut touch = Touch::new(height, cell(i), velocity, speed, sharers[cell(i) as usize]);
        touch.set_release(random.random_range(0..128));
        touch
    });
    let touches = touches.collect();
    let mut share = || [0, 700, 65536, random.random_range(0..=65536)][random.random_range(0..4)];
    let wicking = Wicking {
        share: share(),
        first_row: share() % 3,
        hairs: share() % 4,
        ..Wicking::default()
    };
    let rates = ExchangeRates {
        release: share(),
        film: share(),
        deposit: share(),
        pick_up: share(),
        mixing: share(),
        sink: 8 * share(),
        drag: share() >> 8,
        bearing: share(),
    };
    Contact { rect: Rect { x, y, width, height }, touches, rates, wicking }
}

fn totals(engine: &mut CpuPaint) -> [u64; SLOTS + 1] {
    let wet = engine.wet().totals();
    let brush = engine.brush_paint(BRUSH).totals();
    std::array::from_fn(|i| wet[i] + brush[i])
}

#[test]
fn over_ten_thousand_sub_steps_no_pigment_is_lost_or_made_and_no_cell_is_overfull() {
    let random = &mut ChaCha8Rng::seed_from_u64(1);
    let canvas = (60, 44);
    let brush = (24, 17);
    let mut engine = painted(random, canvas, brush);
    let before = totals(&mut engine);
    for _ in 0..100 {
        let contacts: Vec<_> =
            (0..100).map(|_| random_contact(random, canvas, brush, None)).collect();
        engine.apply_contacts(BRUSH, &MotionConstants::new(0.1, 0.7), &contacts);
    }
    assert_eq!(totals(&mut engine), before);
    let wet = engine.wet();
    let highest = (0..60 * 44).map(|i| wet.cell(i).volume()).max();
    assert!(highest.is_some_and(|highest| highest <= MAX_COLUMN), "{highest:?} in a cell");
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
        ((50, 30), 4 * CROWDED_VOLUME),
        ((1, 9), 4 * CROWDED_VOLUME),
    ] {
        let brush = (11, 13);
        let mut engine = painted_to(highest, random, canvas, brush);
        let masks = [None, Some(Mask::with_open(engine.bounds(), |cell| cell % 11 < 7))];
        let motions = [
            MotionConstants::new(0.1, 0.7),
            MotionConstants {
                push_share: 8192,
                squeeze_share: 65536,
                yield_quanta: 0,
                levelling_share: 8192,
                adhesion_quanta: 65535,
                everywhere: 0,
                padding: [0; 2],
            },
            MotionConstants {
                push_share: 0,
                squeeze_share: 0,
                yield_quanta: 1 << 31,
                levelling_share: 0,
                adhesion_quanta: 0,
                everywhere: 1,
                padding: [0; 2],
            },
        ];
        for (i, motion) in motions.iter().cycle().take(60).enumerate() {
            if i % 7 == 3 {
                engine.note_bed(engine.bounds());
            }
            engine.set_mask(masks[i / 5 % 2].as_ref());
            let contact = random_contact(random, canvas, brush, None);
            let mut wet = engine.wet();
            let mut head = engine.brushes[BRUSH.0].clone();
            let floor = engine.floor();
            let below = Below { floor: &floor, bed: &engine.bed, mask: engine.mask.as_ref() };
            sub_step(motion, &contact, below, &mut wet, &mut head);
            engine.apply_contacts(BRUSH, motion, &[contact]);
            assert!(engine.wet() == wet, "canvas {canvas:?}, sub-step {i}");
            assert!(engine.brush_paint(BRUSH) == *head.cells.layer(), "brush, sub-step {i}");
            let columns = (0..wet.vehicle.values().len()).map(|at| wet.cell(at).volume());
            assert!(engine.wet.volume().iter().copied().eq(columns), "volumes, sub-step {i}");
        }
    }
}

#[test]
fn columns_pushed_together_stay_below_full_and_whole() {
    let random = &mut ChaCha8Rng::seed_from_u64(8);
    let canvas = (40, 40);
    let brush = (9, 9);
    let mut engine = CpuPaint::new(Field::filled(40, 40, 0));
    let vehicle = Field::filled(40, 40, CROWDED_VOLUME - 1);
    let wet = Layer { vehicle, ..Layer::empty(40, 40) };
    engine.set_wet(&wet);
    engine.add_brush(brush.0, brush.1);
    let before = totals(&mut engine);
    let pushy =
        MotionConstants { push_share: 8192, yield_quanta: 0, ..MotionConstants::new(0.1, 0.7) };
    for _ in 0..400 {
        let contact = random_contact(random, canvas, brush, None);
        engine.apply_contacts(BRUSH, &pushy, &[contact]);
    }
    let wet = engine.wet();
    let highest = (0..40 * 40).map(|i| wet.cell(i).volume()).max().expect("cells");
    assert!((CROWDED_VOLUME..MAX_COLUMN).contains(&highest), "{highest} in a cell");
    assert_eq!(totals(&mut engine), before);
}

#[test]
fn a_still_brush_moves_no_paint_across_sides_and_leaves_the_adhesion() {
    let random = &mut ChaCha8Rng::seed_from_u64(3);
    let canvas = (40, 40);
    let brush = (9, 9);
    let mut engine = painted(random, canvas, brush);
    let motion = MotionConstants::new(0.1, 0.7);
    let head = engine.brush_paint(BRUSH);
    for _ in 0..200 {
        let before = engine.wet();
        let mut contact = random_contact(random, (38, 38), brush, Some(0));
        // Paint goes up onto a head that drags it over the edge, and flows along still hair.
        (contact.rect.x, contact.rect.y) = (contact.rect.x + 1, contact.rect.y + 1);
        contact.wicking = Wicking::default();
        engine.apply_contacts(BRUSH, &motion, &[contact]);
        let after = engine.wet();
        for index in 0..canvas.0 * canvas.1 {
            let stays = before.cell(index).volume().min(motion.adhesion_quanta);
            let volume = after.cell(index).volume();
            assert!(volume >= stays, "cell {index}: {volume} of {stays}");
        }
    }
    assert!(engine.brush_paint(BRUSH) == head, "the head's paint changed");
}

#[test]
fn the_result_does_not_depend_on_the_number_of_threads() {
    let play = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| {
            let random = &mut ChaCha8Rng::seed_from_u64(4);
            let canvas = (150, 130);
            let brush = (60, 60);
            let mut engine = painted(random, canvas, brush);
            let contacts: Vec<_> = (0..20).map(|_| whole_contact(random, canvas, brush)).collect();
            engine.apply_contacts(BRUSH, &MotionConstants::new(0.1, 0.7), &contacts);
            (engine.wet(), engine.brush_paint(BRUSH))
        })
    };
    let alone = play(1);
    for threads in [2, 3, 5] {
        assert!(play(threads) == alone, "{threads} threads");
    }
}

/// A contact that repeats a random one over the whole canvas, large enough for many threads.
fn whole_contact(
    random: &mut ChaCha8Rng,
    canvas: (usize, usize),
    brush: (usize, usize),
) -> Contact {
    let part = random_contact(random, (40, 40), brush, None);
    let touch = |i: usize| {
        let x = i % canvas.0 % part.rect.width;
        let y = i / canvas.0 % part.rect.height;
        let touch = part.touches[y * part.rect.width + x];
        let sharers = (canvas.0 * canvas.1) as u16;
        Touch { weights: touch.weights & 0xffff | u32::from(sharers) << 16, ..touch }
    };
    let rect = Rect { x: 0, y: 0, width: canvas.0, height: canvas.1 };
    Contact { rect, touches: (0..canvas.0 * canvas.1).map(touch).collect(), ..part.clone() }
}

#[test]
fn paint_dragged_over_the_edge_goes_onto_the_head_and_piles_up_nowhere() {
    for velocity in [(256, 256), (-256, 0), (0, -200)] {
        let film = QUANTA_PER_CELL / 4;
        let mut engine = CpuPaint::new(Field::filled(12, 9, 0));
        let vehicle = Field::filled(12, 9, film);
        engine.set_wet(&Layer { vehicle, ..Layer::empty(12, 9) });
        engine.add_brush(1, 1);
        let before = totals(&mut engine);
        let touch = Touch::new(0, 0, velocity, 0, 108);
        let rect = engine.bounds();
        let rates = ExchangeRates { drag: 128, ..ExchangeRates::default() };
        let contact = Contact { rect, touches: vec![touch; 108], rates, ..Contact::default() };
        let mut highest = 0;
        for _ in 0..100 {
            let now = std::slice::from_ref(&contact);
            engine.apply_contacts(BRUSH, &MotionConstants::new(0.1, 0.7), now);
            highest = highest.max(engine.wet.volume().iter().copied().max().unwrap_or(0));
        }
        assert_eq!(totals(&mut engine), before);
        assert!(highest < 10 * film, "{velocity:?}: {} films", highest / film);
        let kept: u64 = engine.brush_paint(BRUSH).totals().iter().sum();
        let all: u64 = before.iter().sum();
        assert!(kept * 10 > all * 9, "{velocity:?}: {kept} of {all} quanta on the head");
    }
}
