//! Properties of a palette (charts, gamut, graded mixtures, hiding power, tinting strength, lights)
//! compared with closed forms, with properties of any palette, and on the oils.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

mod charts;
mod figures;
mod gamut;
mod hiding;
mod made;
