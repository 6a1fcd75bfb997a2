//! The reference picture beside the canvas: its colours, marks of samples and guides of strokes on
//! it.

mod picture;
mod picture_view;
mod traced;
mod edited;
mod samples;
mod combing;
mod pointer_line;
mod overlay;
mod command;
mod next_step;
mod mode;
mod place;
mod state;
mod over_canvas;
mod controls;
mod picking;
mod sketching;
mod sample_list;
mod guide_list;
mod panel;

pub use state::Reference;
