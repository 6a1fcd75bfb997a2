//! Random paint and contacts to test with.

use graphics::field::Field;
use graphics::tile::Rect;
use paint::BrushId;
use paint::contact::{Contact, ExchangeRates, Touch, Wicking};
use paint::engine::PaintEngine;
use paint::layer::{Cell, Layer};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

/// A canvas (floor and wet paint) and the paint on one brush head.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Reference {
    pub(crate) floor: Field<i32>,
    pub(crate) wet: Layer,
    pub(crate) brush: Layer,
}

impl Reference {
    /// The canvas and the brush in an engine on the processor, whose sub-steps are tested
    /// against the specification.
    pub(crate) fn on_cpu(&self) -> (PaintEngine, BrushId) {
        self.in_engine(PaintEngine::on_cpu(self.floor.clone()))
    }

    /// The canvas and the brush in `engine`, which was made for this floor.
    pub(crate) fn in_engine(&self, mut engine: PaintEngine) -> (PaintEngine, BrushId) {
        let brush = engine.add_brush(self.brush.width(), self.brush.height()).unwrap();
        engine.set_wet(&self.wet).unwrap();
        engine.set_brush_paint(brush, &self.brush).unwrap();
        (engine, brush)
    }

    /// Paint on canvas and head in quanta: by slot, vehicle last.
    pub(crate) fn totals(&self) -> [u64; 9] {
        let wet = self.wet.totals();
        let brush = self.brush.totals();
        std::array::from_fn(|i| wet[i] + brush[i])
    }
}

/// Range of the random amounts in a cell.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Amounts {
    /// No paint.
    None,
    /// Up to 1000 quanta per slot: columns below and above the adhesion.
    Thin,
    /// Up to a quarter of a cell per slot, as in a painting.
    Usual,
    /// Up to 2^28 quanta in all: a cell and the inflow of eight such neighbours fit in 32 bits.
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

/// A random contact over `rect`: heights near the tops of the paint, head cells that several
/// canvas cells share, and an eighth of the canvas cells without a head cell. Half of the heads are
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
            let mut along = || [0, 256, -256, rng.random_range(-300..300)][rng.random_range(0..4)];
            let velocity = (along(), along());
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
    };
    Contact { rect, touches, rates, wicking }
}
