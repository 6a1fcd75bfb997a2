//! Stroke scripts: the file format `strokes`, version 1.
//!
//! A script is JSON with a canvas, its pigments and brushes, and a list of actions. It is
//! written by hand, by a program, or by a session that records. Units are mm, seconds and
//! degrees.
//!
//! ```json
//! {
//!   "format": "strokes", "version": 1, "title": "A study", "licence": "CC0-1.0",
//!   "canvas": {"width_mm": 100, "height_mm": 80, "cell_mm": 0.1, "ground": {"kind": "linen", "seed": 1}},
//!   "library": "oils.json",
//!   "palette": {"W": "Zinc White", "B": "Prussian Blue"},
//!   "brushes": {"big": {"shape": "flat", "size_mm": 12}},
//!   "actions": [
//!     {"load": {"brush": "big", "recipe": {"W": 3, "B": 1}, "vehicle": 0.2, "amount_mm": 0.3}},
//!     {"stroke": {"brush": "big", "samples": [[0, 10, 10, 0.2], [0.5, 60, 12, 0.6, 10, 0, 45]]}},
//!     {"dry": {"fraction": 1}},
//!     {"save": {"path": "study.exr"}}
//!   ]
//! }
//! ```
//!
//! A sample is `[seconds, x, y, pressure, tilt x, tilt y, twist]`; numbers left out at its
//! end are 0. A palette is an object of short names, or a list, of at most eight pigments;
//! recipes use short names or names of the library. A layer is `"wet"`, the index of a dry
//! layer from 0, the lowest, or `{"id": 3}`: its identity, which stays when layers are moved
//! or merged. [`Action`] lists all actions.
//!
//! With `"tool": "blend"`, `"scrape"` or `"erase"` a stroke works the wet paint with a clean head
//! ([`StrokeTool`]); the paint on its brush is set aside. Blending and erasing have a `"strength"`
//! above 0 to 1, scraping has the `"height_mm"` of the blade over the ground:
//! `{"stroke": {"brush": "big", "tool": "erase", "strength": 0.5, "samples": [..]}}`.
//!
//! `{"mask": {"polygon_mm": [[x, y], ..]}}` covers the canvas outside a polygon, as with masking
//! film; [`MaskChange`] lists the other masks.
//!
//! The key `mixing` describes a palette to mix on, as a second canvas with cells of the
//! same width; strokes, heaps and scraping act on it with `"on": "palette"`. With `start`,
//! the path of a painting (`.exr`), the script continues that painting: `canvas` and
//! `palette` must agree with it, `medium` and `lighting` are left out. `"table": true` takes the
//! palette's paint and the loads of the brushes from that file as well; else the palette begins
//! bare and the brushes clean, whatever the file holds.
//!
//! Scripts are untrusted input. Unknown and repeated keys, numbers out of range and files
//! that are too long are refused with their location, and a script saves only below a
//! folder that the caller chooses.

mod limits;
mod names;
mod error;
mod check_context;
mod palette;
mod surface_id;
mod sample_rows;
mod stroke_action;
mod action;
mod rounding;
mod script;
mod side_table;
mod unloaded;
mod save_path;
mod action_limits;
mod script_check;
mod json;
mod resolve;
mod start;
mod named_files;

#[cfg(test)]
mod tests;

pub use crate::brush::StrokeTool;
pub use crate::canvas::Canvas;
pub use crate::painting::{LayerRef, MaskChange};
pub use crate::stroke::SampleDecimals;
pub use action::{Action, Load, Recipe, Squeeze};
pub use error::{InvalidValue, ScriptError, ValueLocation};
pub use limits::{MAX_ACTIONS, MAX_CELLS, MAX_FILE_BYTES, MAX_MASK_POINTS, MAX_NAMES, MAX_SAMPLES};
pub use named_files::ScriptLibrary;
pub use palette::PaletteSpec;
pub use resolve::{ActionPigments, Resolved};
pub use script::{BrushSpec, StrokeScript};
pub use side_table::{KeptBrush, SideTable};
pub use start::ScriptStartError;
pub use stroke_action::Stroke;
pub use surface_id::{PerSurface, SurfaceId};

pub(super) use action_limits::{ActionLimits, check_brush, check_sample, check_size, check_tool};
pub(super) use check_context::CheckContext;
pub(super) use json::action_line;
pub(super) use resolve::PigmentNames;
pub(super) use rounding::six_digits;
pub(super) use start::pigment_names;
