//! Plans of swatches: which mixtures to prepare, so that a fit identifies K and S of every pigment.
//!
//! A design is a list of indices into one pool of recipes, [`candidates`]. The [`usual`] design needs no
//! knowledge of the paint. The [`optimal`] one is chosen for its [`Information`], estimated from a library
//! of similar paint (D-optimality: Fedorov 1972, Theory of Optimal Experiments). [`plan`] does it all.

mod error;
mod paints;
mod swatch_recipe;
mod candidates;
mod weighing;
mod usual;
mod information;
mod exchange;
mod form;
mod planned;
mod told;

pub use candidates::candidates;
pub use error::PlanError;
pub use exchange::optimal;
pub use form::MeasurementForm;
pub use information::{Information, RelativeDeviation};
pub use paints::PaintSet;
pub use planned::{Forecast, Plan, PlanOptions, PlannedSwatch, plan, plan_until};
pub use swatch_recipe::{Purpose, SwatchRecipe};
pub use usual::{usual, usual_count};
pub use weighing::Weighing;
