//! Recipes for a colour.
//!
//! Which pigments of a library, and how much of each, come nearest to a target
//! under one light or several? Every set of pigments is tried, from one pigment
//! up to the wanted number; the shares of each are found by least squares in
//! the colour difference itself, started from the best recipe of a set with one pigment
//! fewer.

mod sight;

mod film;

mod bounded_step;

mod bounded_descent;

mod forward;

mod descent;

mod request;

mod candidate;

mod watch;

mod search;

mod whole_parts;

mod ranking;

pub use bounded_descent::{Cost, descend_inside};
pub use bounded_step::{Bounds, UNKNOWNS};
pub use film::{FilmKind, Thickness};
pub use ranking::{Recipe, recipes, recipes_watched};
pub use request::{MatchError, MatchRequest};
pub use sight::{Metric, Sight, Target};
pub use watch::Watch;
pub use whole_parts::few_parts;
