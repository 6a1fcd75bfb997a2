//! The guided tour as data: its steps, and what tells that a step was done.

mod facts;
mod step;
mod tour;

pub use facts::Facts;
pub use step::TourStep;
pub use tour::Tour;
