//! The strokes of the bench, one file a case or two.

mod film;

use super::canvas::Bench;
use super::figure::CaseReport;

/// A case: its name and the function that paints and measures it.
pub type Case = (&'static str, fn(&Bench) -> CaseReport);

/// All cases, in the order of the table.
pub const CASES: &[Case] = &[("film", film::film), ("cell", film::cell)];
