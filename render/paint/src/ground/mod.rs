//! Grounds to paint on. The relief is generated from a seed or taken from a
//! picture; the colour is that of the priming.
//!
//! Heights are 0 or more, in mm above the plane of the canvas. Equal descriptions always
//! give equal grounds.

mod error;
mod bare_surface;
mod relief;
mod toned;
mod primer;
mod linen;
mod panel;
mod paper;
mod wood;
mod picture_relief;
mod spec;

pub use bare_surface::Ground;
pub use error::GroundError;
pub use linen::Linen;
pub use panel::Panel;
pub use paper::{Paper, PaperFinish};
pub use picture_relief::PictureRelief;
pub use primer::{ColorPrimer, MeasuredPrimer, Primer, PrimerSpectrum};
pub use spec::{GroundKind, GroundRelief, GroundSpec, ParseGroundKindError};
pub use toned::{PrimerFilm, TonedPrimer};
pub use wood::Wood;
