//! The motion of paint in one sub-step, cell by cell and in whole numbers: the
//! specification that both backends follow.
//!
//! After Baxter, Wendt and Lin 2004, section 4. Lengths are in cells (heights in quanta), times
//! in sub-steps; the head moves by at most one cell in a sub-step. [`MotionConstants`] and the
//! [`ExchangeRates`](crate::contact::ExchangeRates) of a head are made from lengths in mm, so that
//! a stroke hardly depends on the size of the cells.
//!
//! # A sub-step
//! On the contact's rectangle grown by two cells, within the canvas, the reach:
//!
//! 1. If the contact has [`wicking`](crate::contact::Contact::wicking), paint flows along the
//!    hair of the head, and the mean volume of each hair is taken anew: see [`wick`].
//!    [`press::penetration`] of each touched cell, from the floor, the wet volume, the [`bed`] of
//!    the stroke and the [`press::coat`] of the head at the start; [`press::NO_CONTACT`]
//!    everywhere else.
//! 2. [`press::flow`] between each cell of the rectangle grown by one and its neighbours in x
//!    and y; beyond the reach, the nearest cell of the reach counts. [`press::velocity`] of
//!    each of these cells from its flows and from [`press::dragged`]. A component that would
//!    carry paint off the canvas is set to 0; near crowded columns
//!    [`press::avoid_crowded_columns`] applies. Unless [`MotionConstants::everywhere`] is 1, only
//!    cells move that have a penetration or one of whose eight neighbours has.
//! 3. [`advect::outflow`] of each of these cells, from the amounts at the start, for all
//!    cells at once.
//! 4. [`transfer::exchange`] for every cell that was in contact in step 1, with that
//!    penetration: between the cell of the canvas as step 3 left it and the cell of the
//!    head as it was at the start, for all cells at once. The transfers of several cells
//!    with one cell of the head add up; as none takes more than half of its share, the
//!    head's amounts never fall below zero.
//!
//! A cell that a [mask](crate::mask) covers is never in contact, and counts as crowded: its paint
//! neither moves nor gets more.
//!
//! A column receives paint from at most eight neighbours, none of them crowded, so
//! advection leaves every column below [`crate::amount::MAX_COLUMN`].

mod constants;
pub mod bed;
pub mod press;
pub mod advect;
pub mod transfer;
pub mod wick;

pub use constants::{MotionConstants, levelling_sub_steps};
