//! Separation of colours into films of a palette's pigments.
//!
//! Use [`PaintFilm`] for the colour of any film of a palette over a ground, [`Separation`] to find
//! the film for a colour, [`SeparationByHeight`] for a film of a given height, and
//! [`choose_palette`] to find pigments for a picture.

mod film;
mod film_search;
mod table;
mod selection;

pub use film::{FilmMaterials, PaintFilm};
pub use selection::{ChosenPalette, ColorErrors, choose_palette, rebuild_picture};
pub use table::{
    OUT_OF_GAMUT, Separation, SeparationByHeight, SeparationError, SeparationSettings,
};
