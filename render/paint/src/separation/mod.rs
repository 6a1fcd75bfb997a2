//! Separation of colours into films of a palette's pigments.
//!
//! [`PaintFilm`] computes the colour of any film of a palette over a ground,
//! [`Separation`] finds the film for a colour, [`SeparationByHeight`] that of a given height, and [`choose_palette`] finds the pigments
//! for a picture.

mod film;
mod film_search;
mod sampled_films;
mod table;
mod by_height;
mod errors;
mod selection;

pub use by_height::SeparationByHeight;
pub use errors::{ColorErrors, rebuild_picture};
pub use film::{FilmMaterials, PaintFilm};
pub use selection::{ChosenPalette, choose_palette};
pub use table::{OUT_OF_GAMUT, Separation, SeparationError, SeparationSettings};
