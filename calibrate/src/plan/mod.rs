//! Which swatches to prepare, so that K and S of every pigment can be told.
//!
//! A design is a list of indices into one pool of recipes, [`candidates`]. The
//! [`usual`] design needs no knowledge of the paint; the [`optimal`] one is
//! chosen for [`Information`] on a library of paint like it (D-optimality:
//! Fedorov 1972, Theory of Optimal Experiments).

mod palette;

mod recipe;

mod candidates;

mod weighing;

mod usual;

mod information;

mod exchange;

mod sheet;

pub use candidates::candidates;
pub use exchange::optimal;
pub use information::{Information, RelativeDeviation};
pub use palette::{Palette, PlanError};
pub use recipe::{Purpose, Recipe};
pub use sheet::{Sheet, sample_names};
pub use usual::{usual, usual_count};
pub use weighing::Weighing;
