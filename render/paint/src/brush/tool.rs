//! Tools work the wet paint with a clean head. You can also get the contacts of many sub-steps at
//! once here.
//!
//! A tool is the head of the brush with other rates of exchange, so both backends move the paint by
//! the laws that hold under a brush.
//!
//! We bend a head through its poses one after another, which takes a small part of the time. The
//! bend at a pose decides its contact, so several threads draw the contacts side by side. You get
//! the contacts of [`Head::advance_as`] to the bit.

use documents::hint::Explain;
use graphics::tile::Rect;
use rayon::prelude::*;

use super::footprint::{Border, Hold, Imprint};
use super::head::Head;
use super::locks::Lock;
use super::relief::Relief;
use super::surface::Net;
use super::uptake::share;
use crate::amount::{QUANTA_PER_CELL, quanta_from_mm};
use crate::contact::{Contact, ExchangeRates, Touch, Wicking};
use crate::pose::Pose;

/// Use of a head on the wet paint below it.
///
/// With every tool but [`StrokeTool::Paint`] the head is clean. We set the paint on the brush aside
/// for the stroke. At the end of the stroke, the paint that the clean head holds is removed from
/// the surface. Dry paint never moves.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum StrokeTool {
    /// Paints with what is on the brush.
    #[default]
    Paint,
    /// Softens and mixes like a dry mop: the head picks paint up and lays it down again.
    Blend {
        /// How much the paint is mixed and moved, above 0 to 1.
        strength: f64,
    },
    /// Takes all paint higher than a blade that glides over the crests of the ground. Paint between
    /// the crests stays.
    Scrape {
        /// Height of the blade over the crests at pressure 0 in mm, 0 to 10. It falls to 0 at full
        /// pressure.
        height_mm: f64,
    },
    /// Takes a share of the paint, as a rag does. This takes more with pressure and with each mm of
    /// the way.
    Erase {
        /// How much it takes, above 0 to 1. For example, with 1 and full pressure the paint falls
        /// to 1/e over 1 mm.
        strength: f64,
    },
}

/// A number of a tool is out of range.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error, Explain)]
#[error("the {field} of the tool `{tool}` is {wanted}, found `{found}`")]
#[hint("a strength of 0.5 and a height of 0 mm suit most paint")]
pub struct ToolError {
    /// Name of the tool in a script.
    pub tool: &'static str,
    /// Name of the number in a script.
    pub field: &'static str,
    /// Description of the range.
    pub wanted: &'static str,
    /// Value of the number.
    pub found: f64,
}

impl StrokeTool {
    /// Name in scripts and labels: `paint`, `blend`, `scrape` or `erase`.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::Paint => "paint",
            Self::Blend { .. } => "blend",
            Self::Scrape { .. } => "scrape",
            Self::Erase { .. } => "erase",
        }
    }

    /// Returns whether the head paints with the paint on the brush.
    #[must_use]
    pub fn is_paint(&self) -> bool {
        *self == Self::Paint
    }

    /// The tool with `change` applied to its number.
    #[must_use]
    pub fn map(self, change: impl Fn(f64) -> f64) -> Self {
        match self {
            Self::Paint => Self::Paint,
            Self::Blend { strength } => Self::Blend { strength: change(strength) },
            Self::Scrape { height_mm } => Self::Scrape { height_mm: change(height_mm) },
            Self::Erase { strength } => Self::Erase { strength: change(strength) },
        }
    }

    /// Checks the range of its number.
    ///
    /// # Errors
    /// [`ToolError`] if it is out of range.
    pub fn check(&self) -> Result<(), ToolError> {
        let (field, wanted, found, valid) = match *self {
            Self::Paint => return Ok(()),
            Self::Blend { strength } | Self::Erase { strength } => {
                let valid = strength > 0.0 && strength <= 1.0;
                ("strength", "above 0 to 1", strength, valid)
            }
            Self::Scrape { height_mm } => {
                ("height_mm", "0 to 10", height_mm, (0.0..=10.0).contains(&height_mm))
            }
        };
        if valid { Ok(()) } else { Err(ToolError { tool: self.name(), field, wanted, found }) }
    }
}

/// Distance in mm over which the paint under a rag falls to 1/e at full strength and pressure.
const ERASE_MM: f64 = 1.0;

/// Height in mm over the crests at which a rag no longer rubs. The lower the head is below this,
/// the more it rubs.
const RUB_MM: f64 = 0.3;

/// The part of the head up to this height over the crests, in mm, is the edge of the blade.
const EDGE_MM: f64 = 0.3;

/// Distance in mm over which the colours of mop and canvas fall to 1/e of their difference at full
/// strength (chosen by the measured width of a blended edge).
const MIX_MM: f64 = 1.0;

/// Distance in mm over which a mop at full strength stirs a skin into the body below.
const STIR_MM: f64 = 0.3;

/// Distance in mm over which a mop fills at full strength. [`LAY_MM`] is the distance over which it
/// lays the paint down again.
const FILL_MM: f64 = 12.0;
const LAY_MM: f64 = 0.5;

/// Velocity of the paint under a mop relative to a brush at full strength.
const DRAG: f64 = 0.5;

/// Coat of a mop relative to the paint on its hair, in parts of 32. This is the largest possible,
/// so that the mop is full when it holds a quarter of the film below it.
const MOP_RELEASE: u32 = 127;

/// A mop holds paint in the last 1 / `TIP` of the head.
const TIP: usize = 3;

/// Distance in mm by which the hair of a mop sways to each side at full strength, so that
/// neighbouring colours mix too. It sways there and back over [`SWAY_EVERY_MM`] of a stroke.
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

    /// Turns the contact `out` of the sub-step at `pose` into the contact of `tool`. `sub_steps` is
    /// the number since the head was set down, this one included.
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
        shear: share(cell_mm, STIR_MM / strength).min(32768),
        held: 0,
        carried: 0,
        padding: 0,
    };
    contact.touches.iter_mut().for_each(|touch| touch.set_release(MOP_RELEASE));
}

/// Lets the hair sway: each touch meets the hair `columns` columns further around a head of `width`
/// x `height` cells. Only the tip exchanges paint.
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

/// A rag takes the share of `rub` (0 to 1) of the paint that it reaches, and less where it hardly
/// touches.
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

/// A bent head in one of the sub-steps, and the buffers of its contact.
#[derive(Debug, Clone)]
struct Step {
    net: Net,
    locks: Vec<Lock>,
    imprint: Imprint,
    lifted: bool,
    hold: Option<Hold>,
    border: Option<Border>,
    /// Number of sub-steps since the head was set down, this one included.
    sub_steps: u32,
}

/// Buffers for sub-steps that are drawn side by side.
#[derive(Debug, Clone, Default)]
pub(crate) struct SideBySide {
    steps: Vec<Step>,
}

impl SideBySide {
    /// Moves `head` through `poses` as `tool`, and fills one of `contacts` for each. You must use
    /// one head in all calls.
    ///
    /// # Panics
    /// If there are fewer contacts than poses.
    pub(crate) fn advance_as(
        &mut self,
        (head, tool): (&mut Head, StrokeTool),
        poses: &[Pose],
        relief: &Relief,
        bounds: Rect,
        contacts: &mut [Contact],
    ) {
        let contacts = &mut contacts[..poses.len()];
        while self.steps.len() < poses.len() {
            self.steps.push(Step::of(head));
        }
        let steps = &mut self.steps[..poses.len()];
        for ((step, pose), contact) in steps.iter_mut().zip(poses).zip(&mut *contacts) {
            (step.lifted, step.hold) = head.bend(pose, relief, contact);
            step.net.clone_from(&head.net);
            step.locks.clone_from(&head.locks.columns);
            step.sub_steps = head.sub_step();
        }
        steps.par_iter_mut().for_each(|step| {
            if let Some(hold) = &step.hold {
                step.imprint.evaluate(&step.net, hold, relief);
            }
        });
        for step in &mut *steps {
            if step.lifted {
                head.sides.lift();
            }
            let extent = step.hold.and_then(|_| step.imprint.extent());
            step.border = head.sides.follow(extent);
        }
        let head = &*head;
        let places = steps.par_iter_mut().zip(poses.par_iter().zip(contacts.par_iter_mut()));
        places.for_each(|(step, (pose, contact))| {
            if let Some(hold) = &step.hold {
                step.imprint.draw(&step.locks, hold, step.border, bounds, contact);
            }
            head.use_as(tool, (pose, step.sub_steps), relief, contact);
        });
    }
}

impl Step {
    fn of(head: &Head) -> Self {
        Self {
            net: head.net.clone(),
            locks: head.locks.columns.clone(),
            imprint: head.imprint.clone(),
            lifted: false,
            hold: None,
            border: None,
            sub_steps: 0,
        }
    }
}
