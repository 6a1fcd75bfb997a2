//! The contact of a head that works the paint as a tool; see [`StrokeTool`].
//!
//! A tool is the head of the brush with other rates of exchange, so both backends move the paint by
//! the same laws as under a brush.

use super::head::Head;
use super::relief::Relief;
use super::tool::StrokeTool;
use super::uptake::share;
use crate::amount::{QUANTA_PER_CELL, quanta_from_mm};
use crate::contact::{Contact, ExchangeRates, Touch, Wicking};
use crate::pose::Pose;
use graphics::tile::Rect;

/// Distance in mm over which the paint under a rag falls to 1/e at full strength and pressure.
const ERASE_MM: f64 = 1.0;

/// Height in mm over the crests at which a rag no longer rubs; below it rubs the more the lower.
const RUB_MM: f64 = 0.3;

/// Height in mm over the crests up to which the head is the edge of the blade.
const EDGE_MM: f64 = 0.3;

/// Distance in mm over which the colours of mop and canvas fall to 1/e of their difference at full
/// strength (chosen by the measured width of a blended edge).
const MIX_MM: f64 = 1.0;

/// Distances in mm over which a mop fills at full strength, and over which it lays again.
const FILL_MM: f64 = 12.0;
const LAY_MM: f64 = 0.5;

/// Velocity of the paint under a mop relative to that of a brush at full strength.
const DRAG: f64 = 0.5;

/// Coat of a mop relative to the paint on its hair, in parts of 32: the most there is, so that the
/// mop is full when it holds a quarter of the film below it.
const MOP_RELEASE: u32 = 127;

/// Part of the head, from its end, in which a mop holds paint.
const TIP: usize = 3;

/// Distance in mm by which the hair of a mop sways to each side at full strength, so that colours
/// beside each other mix too, and the way in mm on which it sways there and back.
const SWAY_MM: f64 = 1.0;
const SWAY_EVERY_MM: f64 = 3.0;

impl Head {
    /// Moves the head as [`Head::advance`] does, and fills `out` with its contact as `tool`.
    pub fn advance_as(
        &mut self,
        tool: StrokeTool,
        pose: &Pose,
        relief: &Relief,
        bounds: Rect,
        out: &mut Contact,
    ) {
        self.advance(pose, relief, bounds, out);
        self.use_as(tool, (pose, self.sub_step()), relief, out);
    }

    /// Makes the contact `out` of the sub-step at `pose` that of `tool`. `sub_steps` is the number
    /// since the head was set down, this one included.
    pub(super) fn use_as(
        &self,
        tool: StrokeTool,
        (pose, sub_steps): (&Pose, u32),
        relief: &Relief,
        out: &mut Contact,
    ) {
        let pressure = pose.pressure.clamp(0.0, 1.0);
        match tool {
            StrokeTool::Paint => {}
            StrokeTool::Blend { strength } => {
                blend(out, strength, self.cell_mm(), self.paint_cell_area());
                sway(out, self.paint_grid(), self.columns_swayed(strength, sub_steps));
            }
            StrokeTool::Scrape { height_mm } => {
                scrape(out, height_mm * (1.0 - pressure), relief);
            }
            StrokeTool::Erase { strength } => erase(out, strength * pressure, relief),
        }
    }

    /// Columns of paint cells by which the hair of a mop has swayed aside after `sub_steps`.
    fn columns_swayed(&self, strength: f64, sub_steps: u32) -> i32 {
        let way_mm = f64::from(sub_steps) * self.cell_mm();
        let phase = (way_mm / SWAY_EVERY_MM).fract();
        let aside = 1.0 - 4.0 * (phase - 0.5).abs();
        (aside * strength * SWAY_MM / self.cell_mm()).round() as i32
    }
}

/// A dry mop: it fills to a small part of the film, exchanges paint quickly and lays it again.
fn blend(contact: &mut Contact, strength: f64, cell_mm: f64, paint_cell_area: f64) {
    let rates = &mut contact.rates;
    *rates = ExchangeRates {
        release: ((1.0 / paint_cell_area).min(1.0) * 65536.0) as u32,
        film: 0,
        deposit: share(cell_mm, LAY_MM),
        pick_up: share(cell_mm, FILL_MM / strength),
        mixing: share(cell_mm, MIX_MM / strength),
        sink: rates.sink,
        drag: (f64::from(rates.drag) * DRAG * strength) as u32,
        bearing: 0,
    };
    contact.touches.iter_mut().for_each(|touch| touch.set_release(MOP_RELEASE));
}

/// Lets the hair sway: each touch meets the hair `columns` columns further around a head of
/// `width` x `height` cells. Only the tip exchanges paint.
fn sway(contact: &mut Contact, (width, height): (usize, usize), columns: i32) {
    let width = width as u32;
    let first_row = (height - height.div_ceil(TIP)) as u32;
    let further = columns.rem_euclid(width as i32) as u32;
    contact.wicking.first_row = contact.wicking.first_row.max(first_row);
    for touch in contact.touches.iter_mut().filter(|touch| touch.height != Touch::NONE.height) {
        let row = touch.brush_cell / width;
        let column = touch.brush_cell % width;
        touch.brush_cell = row * width + (column + further) % width;
        if row < first_row {
            touch.set_transfer_weight(0);
        }
    }
}

/// A level blade `height_mm` over the crests of the ground, where the head is near them.
fn scrape(contact: &mut Contact, height_mm: f64, relief: &Relief) {
    let cell_mm = relief.cell_mm();
    // Without mixing, an exchange may take the whole column.
    contact.rates = ExchangeRates { pick_up: 65536, ..ExchangeRates::default() };
    contact.wicking = Wicking::default();
    let edge = quanta_from_mm(EDGE_MM, cell_mm) as i32;
    let height = quanta_from_mm(height_mm, cell_mm) as i32;
    over_crests(contact, relief, |touch, crest| {
        if touch.height.saturating_sub(crest) > edge {
            *touch = Touch::NONE;
        } else {
            touch.height = crest.saturating_add(height);
            touch.set_transfer_weight(256);
        }
    });
}

/// A rag: it takes the share of `rub` (0 to 1) of what it reaches, less where it hardly touches.
fn erase(contact: &mut Contact, rub: f64, relief: &Relief) {
    let cell_mm = relief.cell_mm();
    let pick_up = if rub > 0.0 { share(cell_mm, ERASE_MM / rub) } else { 0 };
    contact.rates = ExchangeRates { pick_up, sink: contact.rates.sink, ..ExchangeRates::default() };
    contact.wicking = Wicking::default();
    let highest = f64::from(quanta_from_mm(RUB_MM, cell_mm));
    over_crests(contact, relief, |touch, crest| {
        let above = f64::from(touch.height.saturating_sub(crest)).max(0.0);
        touch.set_transfer_weight((256.0 * (1.0 - above / highest).max(0.0)) as u32);
    });
}

/// Calls `change` with each touch of the head and the height of the crests there, in quanta.
fn over_crests(contact: &mut Contact, relief: &Relief, change: impl Fn(&mut Touch, i32)) {
    let rect = contact.rect;
    let view = relief.seen_from((rect.x as i64, rect.y as i64));
    for (row, touches) in contact.touches.chunks_exact_mut(rect.width.max(1)).enumerate() {
        for (column, touch) in touches.iter_mut().enumerate() {
            if touch.height != Touch::NONE.height {
                let crest = view.height(column as f32 + 0.5, row as f32 + 0.5);
                change(touch, (crest * QUANTA_PER_CELL as f32) as i32);
            }
        }
    }
}
