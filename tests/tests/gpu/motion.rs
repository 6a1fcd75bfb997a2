//! On the GPU, sub-steps equal the reference on the CPU bit for bit and conserve paint. Drying, dry
//! layers and undo tiles are exact. Includes random paint and contacts to test with.

use graphics::field::Field;
use graphics::tile::{Rect, TILE, Tile, TileSet};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use paint::contact::{Contact, ExchangeRates, Touch, Wicking};
use paint::engine::PaintEngine;
use paint::layer::{Cell, Layer};
use paint::motion::MotionConstants;
use paint::motion::skin::drying;
use paint::{BrushId, UndoSlot};

const SIZE: (usize, usize) = (83, 41);
const HEAD: (usize, usize) = (9, 7);

fn reference(rng: &mut ChaCha8Rng, canvas: Amounts, head: Amounts) -> Reference {
    let floor = (0..SIZE.0 * SIZE.1).map(|_| rng.random_range(-(1 << 18)..1 << 18)).collect();
    Reference {
        floor: Field::from_values(SIZE.0, SIZE.1, floor),
        wet: films(rng, SIZE, canvas),
        brush: paint(rng, HEAD, head),
    }
}

fn contact_on(rng: &mut ChaCha8Rng, at: &Reference, rect: Rect) -> Contact {
    contact(
        rng,
        rect,
        |x: usize, y: usize| at.floor[(x, y)] + at.wet.cell(y * SIZE.0 + x).volume() as i32,
        (HEAD.0 * HEAD.1) as u32,
    )
}

fn engine(start: &Reference) -> Option<(PaintEngine, BrushId)> {
    Some(start.in_engine(PaintEngine::on_device(crate::device()?, &start.floor).unwrap()))
}

/// Rectangles in the middle, at every edge, of one cell, and of the whole canvas.
fn rects() -> Vec<Rect> {
    let (width, height) = SIZE;
    fn rect(x: usize, y: usize, width: usize, height: usize) -> Rect {
        Rect { x, y, width, height }
    }
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
            // Some paint carries the hair, as if a stroke began here.
            for tile in TileSet::all(engine.bounds()).iter().filter(|_| rng.random_bool(0.3)) {
                wanted.note_bed(tile, &motion).unwrap();
                engine.note_bed(tile, &motion).unwrap();
            }
            let contact = [contact_on(&mut rng, &start, rect)];
            wanted.apply_contacts(wanted_brush, &motion, &contact).unwrap();
            engine.apply_contacts(brush, &motion, &contact).unwrap();
            let label = format!("canvas {canvas:?}, head {head:?}, {rect:?}");
            assert!(engine.wet().unwrap() == wanted.wet().unwrap(), "wet paint, {label}");
            let paint = wanted.brush_paint(wanted_brush).unwrap();
            assert!(engine.brush_paint(brush).unwrap() == paint, "the head, {label}");
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
            skin_quanta: 1000,
            padding: 0,
        },
        MotionConstants {
            push_share: 0,
            squeeze_share: 0,
            yield_quanta: 1 << 31,
            levelling_share: 0,
            adhesion_quanta: 65535,
            everywhere: 1,
            skin_quanta: 0,
            padding: 0,
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
    let films = end.wet.single_films();
    let most = films
        .flat_map(|film| film.vehicle.values().iter().chain(film.pigments.values().as_flattened()));
    assert!(most.max() < Some(&(1 << 31)), "an amount below zero");
}

/// A canvas (floor and wet paint), and the paint on one brush head.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Reference {
    pub(crate) floor: Field<i32>,
    pub(crate) wet: Layer,
    pub(crate) brush: Layer,
}

impl Reference {
    /// The canvas and the brush on the processor. Its sub-steps are tested against the
    /// specification.
    pub(crate) fn on_cpu(&self) -> (PaintEngine, BrushId) {
        self.in_engine(PaintEngine::on_cpu(self.floor.clone()))
    }

    /// The canvas and the brush in `engine`. You must make it for this floor.
    pub(crate) fn in_engine(&self, mut engine: PaintEngine) -> (PaintEngine, BrushId) {
        let brush = engine.add_brush(self.brush.width(), self.brush.height()).unwrap();
        engine.set_wet(&self.wet).unwrap();
        engine.set_brush_paint(brush, &self.brush).unwrap();
        (engine, brush)
    }

    /// Paint on canvas and head in quanta, by slot and then the vehicle.
    pub(crate) fn totals(&self) -> [u64; 9] {
        let wet = self.wet.totals();
        let brush = self.brush.totals();
        std::array::from_fn(|i| wet[i] + brush[i])
    }
}

/// Range of the random amounts in a cell.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Amounts {
    None,
    /// Up to 1000 quanta per slot, for columns below and above the adhesion.
    Thin,
    /// Up to a quarter of a cell per slot, as in a painting.
    Usual,
    /// Up to 2^28 quanta in all, so that a cell and the inflow of eight such neighbours fit in 32
    /// bits.
    Full,
}

pub(crate) fn paint(rng: &mut ChaCha8Rng, size: (usize, usize), amounts: Amounts) -> Layer {
    let mut layer = Layer::empty(size.0, size.1);
    let most = match amounts {
        Amounts::None => 0,
        Amounts::Thin => 1000,
        Amounts::Usual => 1 << 19,
        Amounts::Full => (1 << 28) / 9,
    };
    for i in 0..size.0 * size.1 {
        let mut amount = || match rng.random_range(0..4) {
            0 => 0,
            1 => most,
            _ => rng.random_range(0..=most),
        };
        let pigments = std::array::from_fn(|_| amount());
        layer.set_cell(i, Cell { pigments, vehicle: amount() });
    }
    layer
}

/// Paint like [`paint`], of which a part is the skin of every second cell.
pub(crate) fn films(rng: &mut ChaCha8Rng, size: (usize, usize), amounts: Amounts) -> Layer {
    let mut layer = paint(rng, size, amounts);
    for i in (0..size.0 * size.1).step_by(2) {
        let cell = layer.cell(i);
        let skin = cell.share_of_65536(rng.random_range(0..65536));
        layer.set_films(i, [cell.minus(&skin), skin]);
    }
    layer
}

/// A random contact over `rect`: heights near the tops of the paint, head cells that several canvas
/// cells share, and an eighth of the canvas cells without a head cell. Half of the heads are
/// stripes across the rows.
pub(crate) fn contact(
    rng: &mut ChaCha8Rng,
    rect: Rect,
    tops: impl Fn(usize, usize) -> i32,
    brush_cells: u32,
) -> Contact {
    let mut touches = Vec::new();
    let stripes = rng.random_bool(0.5);
    for y in rect.y..rect.y + rect.height {
        for x in rect.x..rect.x + rect.width {
            if stripes && (x + 2 * y) % 16 > 3 || rng.random_range(0..8) == 0 {
                touches.push(Touch::NONE);
                continue;
            }
            let around = [0, -1, 1, -(1 << 22), 1 << 10][rng.random_range(0..5)];
            let height = tops(x, y) + around + rng.random_range(-(1 << 18)..1 << 16);
            let [x, y] = [(); 2]
                .map(|()| [0, 256, -256, rng.random_range(-300..300)][rng.random_range(0..4)]);
            let velocity = (x, y);
            let speed = [0, 256, rng.random_range(0..=256)][rng.random_range(0..3)];
            let mut touch =
                Touch::new(height, rng.random_range(0..brush_cells), velocity, speed, 0);
            touch.weights = touch.weights & !(0x7f << 9) | rng.random_range(0..128) << 9;
            touches.push(touch);
        }
    }
    let mut sharers = vec![0_u32; brush_cells as usize];
    for touch in touches.iter().filter(|touch| **touch != Touch::NONE) {
        sharers[touch.brush_cell as usize] += 1;
    }
    for touch in touches.iter_mut().filter(|touch| **touch != Touch::NONE) {
        touch.weights |= sharers[touch.brush_cell as usize] << 16;
    }
    let mut share = || [0, 700, 65536, rng.random_range(0..=65536)][rng.random_range(0..4)];
    let hairs = 1 + share() % 4;
    let turns = 1 + share() % 3;
    let wicking = Wicking {
        share: share(),
        first_row: share() % 3,
        hairs,
        shift: share() % hairs,
        turns,
        turn: share() % turns,
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
        shear: share(),
        held: 8 * share(),
        carried: 8 * share(),
        padding: 0,
    };
    Contact { rect, touches, rates, wicking }
}

const DRIED_SIZE: (usize, usize) = (150, 70);

fn canvas(seed: u64) -> Option<(PaintEngine, Field<i32>, Layer)> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let floor = (0..DRIED_SIZE.0 * DRIED_SIZE.1).map(|_| rng.random_range(-1000..1000)).collect();
    let floor = Field::from_values(DRIED_SIZE.0, DRIED_SIZE.1, floor);
    let wet = films(&mut rng, DRIED_SIZE, Amounts::Usual);
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
        let mut dried = Layer::empty(DRIED_SIZE.0, DRIED_SIZE.1);
        let mut left = dried.clone();
        for i in 0..DRIED_SIZE.0 * DRIED_SIZE.1 {
            let [body, skin] = wet.films(i);
            let shares = drying(share, body.volume(), skin.volume());
            let parts = [body.share_of_65536(shares[0]), skin.share_of_65536(shares[1])];
            dried.set_films(i, parts);
            left.set_films(i, [body.minus(&parts[0]), skin.minus(&parts[1])]);
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
    let after = films(&mut ChaCha8Rng::seed_from_u64(7), DRIED_SIZE, Amounts::Usual);
    let tiles: Vec<_> = (0..DRIED_SIZE.1.div_ceil(TILE))
        .flat_map(|row| (0..DRIED_SIZE.0.div_ceil(TILE)).map(move |column| Tile { row, column }))
        .collect();
    // These slots lie in several blocks of undo memory, in descending order.
    fn slot(i: usize) -> UndoSlot {
        UndoSlot(200 - 30 * i)
    }
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
