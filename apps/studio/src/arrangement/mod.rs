//! Where the panels of the window stand, as data: columns of groups of tabs. Moving, folding
//! and sharing the height are functions of it.

mod groups;
mod moves;
mod heights;

pub use groups::{Arrangement, Column, Group, Side, WIDTHS};
pub use heights::{HeightRequest, heights};
pub use moves::{Move, Place};
