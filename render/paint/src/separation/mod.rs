//! Separation of colours into films of a palette's pigments.
//!
//! [`PaintFilm`] computes the colour of any film of a palette over a ground. [`Separation`] finds
//! the film for a colour, [`SeparationByHeight`] the film of a given height, and [`choose_palette`]
//! the pigments for a picture.

mod film;
mod film_search;
mod table;
mod selection;

pub use film::{FilmMaterials, PaintFilm};
pub use selection::{ChosenPalette, ColorErrors, choose_palette, rebuild_picture};
pub use table::{
    OUT_OF_GAMUT, Separation, SeparationByHeight, SeparationError, SeparationSettings,
};
