//! Sub-steps on the GPU equal the reference on the CPU bit for bit, and conserve paint.

use graphics::field::Field;
use graphics::tile::{Rect, TileSet};
use paint::engine::PaintEngine;
use paint::motion::MotionConstants;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::reference::{Amounts, Reference, contact, paint};

const SIZE: (usize, usize) = (83, 41);
const HEAD: (usize, usize) = (9, 7);

fn reference(rng: &mut ChaCha8Rng, canvas: Amounts, head: Amounts) -> Reference {
    let floor = (0..SIZE.0 * SIZE.1).map(|_| rng.random_range(-(1 << 18)..1 << 18)).collect();
    Reference {
        floor: Field::from_values(SIZE.0, SIZE.1, floor),
        wet: paint(rng, SIZE, canvas),
        brush: paint(rng, HEAD, head),
    }
}

fn contact_on(rng: &mut ChaCha8Rng, at: &Reference, rect: Rect) -> paint::contact::Contact {
    contact(
        rng,
        rect,
        |x: usize, y: usize| at.floor[(x, y)] + at.wet.cell(y * SIZE.0 + x).volume() as i32,
        (HEAD.0 * HEAD.1) as u32,
    )
}

fn engine(start: &Reference) -> Option<(PaintEngine, paint::BrushId)> {
    Some(start.in_engine(PaintEngine::on_device(crate::device()?, &start.floor).unwrap()))
}

/// Rectangles in the middle, at every edge, of one cell, and of the whole canvas.
fn rects() -> Vec<Rect> {
    let (width, height) = SIZE;
    let rect = |x, y, width, height| Rect { x, y, width, height };
    vec![
        rect(20, 10, 24, 17),
        rect(0, 0, 5, 6),
        rect(width - 4, height - 9, 4, 9),
        rect(0, 12, width, 1),
        rect(40, 0, 1, height),
        rect(width - 1, 0, 1, 1),
        rect(30, 30, 1, 1),
        rect(0, 0, width, height),
    ]
}

#[test]
fn a_sub_step_is_that_of_the_processor_over_all_regimes() {
    use Amounts::{Full, None, Thin, Usual};
    for (canvas, head) in [
        (Usual, Usual),
        (None, Usual),
        (Usual, None),
        (Thin, Thin),
        (Full, Usual),
        (Usual, Full),
        (None, None),
    ] {
        let mut rng = ChaCha8Rng::seed_from_u64(canvas as u64 * 7 + head as u64);
        let start = reference(&mut rng, canvas, head);
        let Some((mut engine, brush)) = engine(&start) else { return };
        let (mut wanted, wanted_brush) = start.on_cpu();
        let motion = MotionConstants::new(0.1, 0.7);
        for rect in rects().into_iter().chain(rects()) {
            // Some paint bears the hair, as if a stroke began here.
            for tile in TileSet::all(engine.bounds()).iter().filter(|_| rng.random_bool(0.3)) {
                wanted.note_bed(tile).unwrap();
                engine.note_bed(tile).unwrap();
            }
            let contact = [contact_on(&mut rng, &start, rect)];
            wanted.apply_contacts(wanted_brush, &motion, &contact).unwrap();
            engine.apply_contacts(brush, &motion, &contact).unwrap();
            let told = format!("canvas {canvas:?}, head {head:?}, {rect:?}");
            assert!(engine.wet().unwrap() == wanted.wet().unwrap(), "wet paint, {told}");
            let paint = wanted.brush_paint(wanted_brush).unwrap();
            assert!(engine.brush_paint(brush).unwrap() == paint, "the head, {told}");
        }
    }
}

#[test]
fn other_constants_are_followed_too() {
    for motion in [
        MotionConstants {
            push_share: 8192,
            squeeze_share: 65536,
            yield_quanta: 0,
            levelling_share: 8192,
            adhesion_quanta: 0,
            everywhere: 0,
            padding: [0; 2],
        },
        MotionConstants {
            push_share: 0,
            squeeze_share: 0,
            yield_quanta: 1 << 31,
            levelling_share: 0,
            adhesion_quanta: 65535,
            everywhere: 1,
            padding: [0; 2],
        },
    ] {
        let mut rng = ChaCha8Rng::seed_from_u64(motion.push_share.into());
        let start = reference(&mut rng, Amounts::Usual, Amounts::Usual);
        let Some((mut engine, brush)) = engine(&start) else { return };
        let (mut wanted, wanted_brush) = start.on_cpu();
        for rect in rects() {
            let contact = [contact_on(&mut rng, &start, rect)];
            wanted.apply_contacts(wanted_brush, &motion, &contact).unwrap();
            engine.apply_contacts(brush, &motion, &contact).unwrap();
        }
        assert!(engine.wet().unwrap() == wanted.wet().unwrap(), "wet paint, {motion:?}");
        let paint = wanted.brush_paint(wanted_brush).unwrap();
        assert!(engine.brush_paint(brush).unwrap() == paint, "the head, {motion:?}");
    }
}

#[test]
fn ten_thousand_sub_steps_keep_every_pigment() {
    let mut rng = ChaCha8Rng::seed_from_u64(11);
    let start = reference(&mut rng, Amounts::Usual, Amounts::Usual);
    let Some((mut engine, brush)) = engine(&start) else { return };
    let contacts: Vec<_> = (0..100)
        .map(|_| {
            let x = rng.random_range(0..SIZE.0 - 12);
            let y = rng.random_range(0..SIZE.1 - 9);
            contact_on(&mut rng, &start, Rect { x, y, width: 12, height: 9 })
        })
        .collect();
    for _ in 0..100 {
        engine.apply_contacts(brush, &MotionConstants::new(0.1, 0.7), &contacts).unwrap();
    }
    let end = Reference {
        wet: engine.wet().unwrap(),
        brush: engine.brush_paint(brush).unwrap(),
        ..start.clone()
    };
    assert_eq!(end.totals(), start.totals());
    assert!(end.wet != start.wet && end.brush != start.brush, "nothing moved");
    let most = end.wet.vehicle.values().iter().chain(end.wet.pigments.values().as_flattened());
    assert!(most.max() < Some(&(1 << 31)), "an amount below zero");
}
