//! The motion of paint in one sub-step, cell by cell and in whole numbers. Both backends follow
//! this specification.
//!
//! We follow Baxter, Wendt and Lin 2004, section 4. Lengths are in cells (heights in quanta), times
//! in sub-steps. The head moves by at most one cell in a sub-step. [`MotionConstants`] and the
//! [`ExchangeRates`](crate::contact::ExchangeRates) of a head come from lengths in mm, so that a
//! stroke hardly depends on the size of the cells.
//!
//! # A sub-step
//! The reach is the contact's rectangle grown by two cells, within the canvas. In it we compute:
//!
//! 1. If the contact has [`wicking`](crate::contact::Contact::wicking), paint first flows along the
//!    hair of the head, and we compute the mean volume of each hair again: see [`wick`].
//!    Then we compute the [`press::penetration`] of each touched cell from the floor, the wet
//!    volume, the [`bed`] of the stroke and the [`press::coat`] of the head at the start. All other
//!    cells get [`press::NO_CONTACT`].
//! 2. We compute the [`press::flow`] between each cell of the rectangle grown by one cell and its
//!    neighbours in x and y. Beyond the reach, the nearest cell of the reach counts. The
//!    [`press::velocity`] of each of these cells follows from its flows and from
//!    [`press::dragged`]. We set a component to 0 that would carry paint off the canvas. Near
//!    crowded columns we apply [`press::avoid_crowded_columns`]. Unless
//!    [`MotionConstants::everywhere`] is 1, a cell only moves if it or one of its eight neighbours
//!    is in contact.
//! 3. We compute the [`advect::outflow`] of each of these cells from the amounts at the start, for
//!    all cells at once.
//! 4. For every cell in contact, we compute the [`transfer::exchange`] with its penetration from
//!    step 1: between the cell of the canvas as step 3 left it and the cell of the head as it was
//!    at the start, for all cells at once. The transfers of several cells with one cell of the head
//!    add up. As none takes more than half of its share, the head's amounts never fall below zero.
//!    Then the hair stirs skin and body of the cell into each other, see [`skin`].
//!
//! Both films of a column move as one: they have one velocity, and the same shares of both leave.
//!
//! A cell that a [mask](crate::mask) covers is never in contact, and counts as crowded: its paint
//! neither moves nor gets more.
//!
//! A column receives paint from at most eight neighbours, none of them crowded, so
//! advection leaves every column below [`crate::amount::MAX_COLUMN`].

pub mod bed;
pub mod press;
pub mod advect;
pub mod skin;
pub mod transfer;
pub mod wick;

use crate::amount::{QUANTA_PER_CELL, quanta_from_mm};

/// The constants of motion of a paint on cells of one size. They are uniforms of the shaders
/// as well.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct MotionConstants {
    /// Share of a difference in pressure between two columns, one of them under the head,
    /// that flows in a sub-step, in parts of 65536. Up to 8192.
    pub push_share: u32,
    /// Pressure of the head where it has sunk 1 mm into the paint, in parts of 65536 of the
    /// pressure that 1 mm of paint has by its height. At 65536 the two are equal.
    pub squeeze_share: u32,
    /// Difference in height between two columns, in quanta, that the paint bears without flowing.
    /// This is its yield.
    pub yield_quanta: u32,
    /// Share of a crest or pit one cell wide that is levelled in a sub-step, in parts of 65536. Up
    /// to 8192.
    pub levelling_share: u32,
    /// Height in quanta that always stays behind when a column moves. Below 65536.
    pub adhesion_quanta: u32,
    /// 0 if paint moves in contact with the head and next to it only. 1 if it moves everywhere, as
    /// after a stroke.
    pub everywhere: u32,
    /// Height in quanta of the skin that stays apart from the body when a stroke begins. See
    /// [`skin`].
    pub skin_quanta: u32,
    /// Unused. Pads the uniforms of the shaders.
    pub padding: u32,
}

/// Flow under the head: mm2 of paint that leaves under a pressure of 1 mm of paint, for each mm
/// that the head moves (chosen by measured lips).
const PUSH_MM: f64 = 0.002;

/// Slope that the stiffest paint bears.
const STEEPEST: f64 = 1.5;

/// Slope that the most fluid paint bears.
const FLATTEST: f64 = 0.01;

/// Height in mm that stays behind when a column moves (chosen by eye).
const ADHESION_MM: f64 = 0.0002;

impl MotionConstants {
    /// Constants for cells of `cell_mm` mm and a paint of this `stiffness`: 0 is stand oil, which
    /// levels by itself, 1 is putty, which stays where you lay it.
    #[must_use]
    pub fn new(cell_mm: f64, stiffness: f64) -> Self {
        let slope = FLATTEST * libm::pow(STEEPEST / FLATTEST, stiffness.clamp(0.0, 1.0));
        Self {
            push_share: parts((PUSH_MM / cell_mm).min(0.125)),
            squeeze_share: parts(1.0),
            yield_quanta: (slope * f64::from(QUANTA_PER_CELL)) as u32,
            levelling_share: parts(1.0 / 16.0),
            adhesion_quanta: quanta_from_mm(ADHESION_MM, cell_mm).min(65535),
            everywhere: 0,
            skin_quanta: quanta_from_mm(skin::SKIN_MM, cell_mm),
            padding: 0,
        }
    }

    /// These constants for paint that moves everywhere.
    #[must_use]
    pub fn everywhere(self) -> Self {
        Self { everywhere: 1, ..self }
    }
}

fn parts(share: f64) -> u32 {
    (share * 65536.0).round() as u32
}

/// Stiffness below which paint levels after a stroke.
const LEVELS_BELOW: f64 = 0.5;

/// Sub-steps of levelling of the most fluid paint on cells of 0.1 mm. A wave of 1 mm then falls
/// to a hundredth.
const MOST_LEVELLING: f64 = 96.0;

/// Number of sub-steps without a head after a stroke in which paint of this `stiffness` levels,
/// on cells of `cell_mm` mm: at most 256, none for paint from the tube.
#[must_use]
pub fn levelling_sub_steps(cell_mm: f64, stiffness: f64) -> usize {
    let fluid = (1.0 - stiffness / LEVELS_BELOW).max(0.0);
    // Diffusion over a distance takes a time that grows with its square.
    (MOST_LEVELLING * fluid * (0.1 / cell_mm).powi(2)).ceil().min(256.0) as usize
}
