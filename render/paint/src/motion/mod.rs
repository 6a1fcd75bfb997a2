//! The motion of paint in one sub-step, cell by cell and in whole numbers: the
//! specification that both backends follow.
//!
//! Baxter, Wendt and Lin 2004, section 4. Lengths are in cells (heights in quanta), times
//! in sub-steps; the head moves by at most one cell in a sub-step.
//!
//! # A sub-step
//! On the contact's rectangle grown by two cells, within the canvas:
//!
//! 1. [`press::penetration`] of each touched cell, from the floor and the wet volume at
//!    the start; [`press::NO_CONTACT`] everywhere else.
//! 2. [`press::velocity`] of each cell of the rectangle grown by one, with the central
//!    differences of penetration, where cells without contact and beyond the rectangle
//!    count as 0. A component that would carry paint off the canvas is set to 0; near
//!    crowded columns [`press::avoid_crowded_columns`] applies.
//! 3. [`advect::outflow`] of each of these cells, from the amounts at the start, for all
//!    cells at once.
//! 4. [`transfer::exchange`] for every cell that was in contact in step 1, with that
//!    penetration: between the cell of the canvas as step 3 left it and the cell of the
//!    head as it was at the start, for all cells at once. The transfers of several cells
//!    with one cell of the head add up; as none takes more than a tenth of its share, the
//!    head's amounts never fall below zero.
//!
//! A column receives paint from at most eight neighbours, none of them crowded, so
//! advection leaves every column below [`crate::amount::MAX_COLUMN`].

mod constants;

pub mod press;

pub mod advect;

pub mod transfer;

pub use constants::MotionConstants;
