//! Colours as films of a palette's pigments.
//!
//! [`PaintFilm`] tells the colour of any film of a palette over a ground;
//! [`Separation`] finds the film for a colour; [`choose_palette`] finds the pigments
//! for a picture.

mod film;

mod nearest;

mod mixtures;

mod table;

mod errors;

mod selection;

pub use errors::{ColorErrors, rebuilt};
pub use film::{Materials, PaintFilm};
pub use selection::{ChosenPalette, choose_palette};
pub use table::{OUT_OF_GAMUT, Separation, SeparationError, SeparationSettings};
