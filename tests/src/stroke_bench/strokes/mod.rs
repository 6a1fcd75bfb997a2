//! The strokes of the bench, one file a case or two.

mod film;
mod relief;
mod thick;
mod exchange;
mod palette;
mod knife;
mod outline;
mod edge;
mod ground;

use super::canvas::Bench;
use super::figure::CaseReport;

/// A case: its name and the function that paints and measures it.
pub type Case = (&'static str, fn(&Bench) -> CaseReport);

/// All cases, in the order of the table.
pub const CASES: &[Case] = &[
    ("film", film::film),
    ("cell", film::cell),
    ("furrows", relief::furrows),
    ("stiffness", relief::stiffness),
    ("stamp", relief::stamp),
    ("lips", thick::lips),
    ("saw-tooth", thick::saw_tooth),
    ("pick-up", exchange::pick_up),
    ("wet-in-wet", exchange::wet_in_wet),
    ("palette", palette::palette),
    ("knife", knife::knife),
    ("outline", outline::outline),
    ("lag", outline::lag),
    ("edge", edge::edge),
    ("weave", ground::weave),
    ("fill", ground::fill),
];
