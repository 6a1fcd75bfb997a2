//! Recorded strokes: the format `strokes`, version 1.
//!
//! JSON that says what is painted on, with which pigments and brushes, and what
//! is done, action by action: one format for replay, tests, benches and
//! recording. Units are mm, seconds and degrees.
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
//! A sample is `[seconds, x, y, pressure, tilt x, tilt y, twist]`; what is left
//! out at its end is 0. A palette is an object of short names, or a list of at
//! most eight pigments; recipes name either. See [`Action`] for what can be done.
//!
//! A second surface to mix on is described as `mixing`, another canvas with cells
//! of the same width; strokes, heaps and scraping are done there with
//! `"on": "palette"`. With `start`, the path of a painting (`.exr`), the script
//! goes on with that painting, which has a size, pigments, a medium and a light
//! of its own: `canvas` and `palette` must agree with it, `medium` and `lighting`
//! are left out.
//!
//! A script may come from anywhere. Unknown and repeated keys, numbers out of
//! range and files that are too long are refused with their place; what it saves
//! stays below the folder that the caller chooses.

mod limits;

mod names;

mod palette;

mod rows;

mod action;

mod digits;

mod script;

mod error;

mod at;

mod saved_path;

mod bounds;

mod check;

mod file;

mod resolve;

mod beginning;

pub use crate::painting::LayerRef;
pub use action::{Action, Load, Recipe, Squeeze, Stroke, SurfaceId};
pub use beginning::ScriptStartError;
pub use error::{InvalidValue, ScriptError, ValueLocation};
pub use limits::{MAX_ACTIONS, MAX_CELLS, MAX_FILE_BYTES, MAX_NAMES, MAX_SAMPLES};
pub use palette::PaletteSpec;
pub use resolve::{ActionPigments, Resolved};
pub use script::{BrushSpec, Canvas, StrokeScript};

pub(super) use at::At;
pub(super) use beginning::names;
pub(super) use bounds::{Surfaces, check_brush, check_sample, check_size};
pub(super) use digits::{sample as sample_as_written, six};
pub(super) use file::line;
pub(super) use resolve::Scope;
