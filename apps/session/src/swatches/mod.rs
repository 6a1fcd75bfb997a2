//! Mixtures that a painter keeps: recipes with names, their file, and their colours.

mod error;
mod mixture;
mod book;
mod file;

pub use book::{SwatchBook, SwatchChange};
pub use error::SwatchBookError;
pub use mixture::{KeptMixture, Usable};
