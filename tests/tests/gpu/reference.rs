//! Reference for a sub-step, cell by cell with the functions of `paint::motion`; random paint and
//! contacts to test with.

use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use render::field::Field;
use render::layer::{Cell, Layer};
use render::paint::contact::{Contact, Touch};
use render::paint::motion::MotionConstants;
use render::paint::motion::advect::{mobile_share, outflow};
use render::paint::motion::press::{
    CROWDED_VOLUME, NO_CONTACT, avoid_crowded_columns, penetration, velocity,
};
use render::paint::motion::transfer::{Exchange, Source, exchange};
use render::tile::Rect;

/// A canvas (floor and wet paint) and the paint on one brush head.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Reference {
    pub(crate) floor: Field<i32>,
    pub(crate) wet: Layer,
    pub(crate) brush: Layer,
}

impl Reference {
    pub(crate) fn step(&mut self, motion: &MotionConstants, contact: &Contact) {
        let canvas = self.floor.bounds();
        let width = canvas.width;
        let touch = |x: isize, y: isize| {
            let Rect { x: left, y: top, width, height } = contact.rect;
            let (i, j) = (x - left as isize, y - top as isize);
            let inside = i >= 0 && j >= 0 && i < width as isize && j < height as isize;
            inside.then(|| contact.touches[j as usize * width + i as usize])
        };
        let before = self.wet.clone();
        let depth = |x: isize, y: isize| {
            let i = || y as usize * width + x as usize;
            touch(x, y).map_or(NO_CONTACT, |touch| {
                penetration(touch, self.floor.values()[i()], before.cell(i()).volume())
            })
        };
        let pressed = |x: isize, y: isize| match depth(x, y) {
            NO_CONTACT => 0,
            depth => depth,
        };
        let moving = contact.rect.grown(1, canvas);
        for y in moving.y..moving.y + moving.height {
            for x in moving.x..moving.x + moving.width {
                let (i, j) = (x as isize, y as isize);
                let slopes =
                    (pressed(i + 1, j) - pressed(i - 1, j), pressed(i, j + 1) - pressed(i, j - 1));
                let over = touch(i, j).unwrap_or(Touch::NONE);
                let (mut u, mut v) = velocity(motion, over, depth(i, j), slopes);
                let stays = |at: isize, along: i32, size: usize| {
                    let to = at + along.signum() as isize;
                    to >= 0 && to < size as isize
                };
                u = if stays(i, u, canvas.width) { u } else { 0 };
                v = if stays(j, v, canvas.height) { v } else { 0 };
                let (u, v) = avoid_crowded_columns((u, v), |to_x, to_y| {
                    let there = (j + to_y as isize) as usize * width + (i + to_x as isize) as usize;
                    before.cell(there).volume() > CROWDED_VOLUME
                });
                let here = y * width + x;
                let cell = before.cell(here);
                let share = mobile_share(motion, cell.volume());
                let out = outflow(&cell, share, (u.unsigned_abs(), v.unsigned_abs()));
                let (right, below) = (u.signum() as isize, v.signum() as isize);
                for (part, to_x, to_y) in
                    [(out.in_x, right, 0), (out.in_y, 0, below), (out.diagonal, right, below)]
                {
                    let there = (j + to_y) as usize * width + (i + to_x) as usize;
                    self.wet.set_cell(here, self.wet.cell(here).minus(&part));
                    self.wet.set_cell(there, self.wet.cell(there).plus(&part));
                }
            }
        }
        let head = self.brush.clone();
        let mut given_back = Vec::new();
        for y in contact.rect.y..contact.rect.y + contact.rect.height {
            for x in contact.rect.x..contact.rect.x + contact.rect.width {
                let (i, j) = (x as isize, y as isize);
                let penetration = depth(i, j);
                let Some(touch) = touch(i, j).filter(|_| penetration != NO_CONTACT) else {
                    continue;
                };
                let (here, there) = (y * width + x, touch.brush_cell as usize);
                let (cell, brush) = (self.wet.cell(here), head.cell(there));
                let Exchange { source, share } =
                    exchange(motion, touch, penetration as u32, cell.volume(), brush.volume());
                if source == Source::Brush {
                    let part = brush.share_of_65536(share);
                    self.wet.set_cell(here, cell.plus(&part));
                    self.brush.set_cell(there, self.brush.cell(there).minus(&part));
                } else {
                    let part = cell.share_of_65536(share);
                    self.wet.set_cell(here, cell.minus(&part));
                    given_back.push((there, part));
                }
            }
        }
        for (there, part) in given_back {
            self.brush.set_cell(there, self.brush.cell(there).plus(&part));
        }
    }

    /// Paint on canvas and head in quanta: by slot, vehicle last.
    pub(crate) fn totals(&self) -> [u64; 9] {
        let (wet, brush) = (self.wet.totals(), self.brush.totals());
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
/// canvas cells share, and an eighth of the canvas cells without a head cell.
pub(crate) fn contact(
    rng: &mut ChaCha8Rng,
    rect: Rect,
    tops: impl Fn(usize, usize) -> i32,
    brush_cells: u32,
) -> Contact {
    let mut touches = Vec::new();
    for y in rect.y..rect.y + rect.height {
        for x in rect.x..rect.x + rect.width {
            if rng.random_range(0..8) == 0 {
                touches.push(Touch::NONE);
                continue;
            }
            let around = [0, -1, 1, -(1 << 22), 1 << 10][rng.random_range(0..5)];
            let height = tops(x, y) + around + rng.random_range(-(1 << 18)..1 << 16);
            let mut along = || [0, 256, -256, rng.random_range(-300..300)][rng.random_range(0..4)];
            let velocity = (along(), along());
            let speed = [0, 256, rng.random_range(0..=256)][rng.random_range(0..3)];
            touches.push(Touch::new(height, rng.random_range(0..brush_cells), velocity, speed, 0));
        }
    }
    let mut sharers = vec![0_u32; brush_cells as usize];
    for touch in touches.iter().filter(|touch| **touch != Touch::NONE) {
        sharers[touch.brush_cell as usize] += 1;
    }
    for touch in touches.iter_mut().filter(|touch| **touch != Touch::NONE) {
        touch.weights |= sharers[touch.brush_cell as usize] << 16;
    }
    Contact { rect, touches }
}
