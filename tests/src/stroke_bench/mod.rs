//! The bench of strokes: a fixed set of strokes, measured in mm, with a table and a picture sheet.
//!
//! ```text
//! hand, canvas (paint) -> heights -> measure (pure) -> figure -> report (table, JSON)
//!         |                                               |
//!         +----------------- pictures --------------------+----> sheet (PNG)
//! ```
//!
//! The program `stroke-bench` runs all cases of [`strokes::CASES`]. The guide to it is
//! `docs/guide/strokes.md`.

pub mod heights;
pub mod measure;
pub mod report;
pub mod hand;
pub mod canvas;
pub mod strokes;
pub mod sheet;
