//! The quick palette: a round menu at the pointer with tubes, mixtures and brush sizes.

mod ring;
mod choice;
mod menu;

pub(super) use choice::{QuickChoice, quick_choices};
pub(super) use menu::{QuickAnswer, QuickPalette};
