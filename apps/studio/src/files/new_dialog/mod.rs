//! The dialog of a new painting: format, ground and presets, with a picture of the ground.

mod memory;
mod preview;
mod answer;
mod dialog;
mod size_rows;
mod mixture_rows;
mod ground_rows;
mod preset_row;
mod show;

pub(super) use answer::{CanvasPicture, NewAnswer};
pub(super) use dialog::NewDialog;
