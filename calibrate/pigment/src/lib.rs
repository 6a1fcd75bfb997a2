//! The pigment library and its uses: mixtures, recipes, quadrature, palettes.
//!
//! A [`PigmentLibrary`] holds the Kubelka-Munk K and S of calibrated paints. You get the colour of any
//! mixture from it ([`PigmentLibrary::color`]), and recipes for any colour
//! ([`MatchRequest::run`]).
//!
//! ```text
//! library (JSON) -> recipe -> K and S of the mixture -> film -> reflectance -> colour
//!                     ^                                                          |
//!                     +---------------------- matching <------------- target ----+
//! ```
//!
//! ```
//! use documents::Task;
//! use pigment::{MatchRequest, PigmentLibrary, Viewing};
//!
//! let oils = PigmentLibrary::van_gogh_oils();
//! let color = oils.color([("Zinc White", 9.0), ("Cobalt Blue", 1.0)], &Viewing::default())?;
//! println!("{} L* {:.1}", color.hex(), color.lab.lightness);
//!
//! let request = MatchRequest { at_most: 3, ..MatchRequest::default() };
//! let found = request.run(&oils, &"#4a7d8c".parse()?, &Task::default())?;
//! println!("nearest: {:.2} CIEDE2000", found.nearest());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! If you want to measure and fit paints, see the crate `calibrate`. For instruments' files, see `spectra`.
//! Modules are ordered by dependence: each uses only modules declared above it.
pub mod rows;
pub mod evaluate;
pub mod recipe;
mod least_squares;
pub mod smooth_reflectance;
mod color_index;
pub mod library;
pub mod color;
pub mod thin_films;
pub mod curation;
pub mod quadrature;
pub mod palette;
pub mod matching;

pub use color::{
    Appearance, Backing, BackingError, ColorError, FilmOver, IlluminantChange, MixtureColor,
};
pub use evaluate::{Remark, RemarkKind, Viewing};
pub use library::{LibraryError, Pigment, PigmentLibrary, RecipeError};
pub use matching::{
    ColorTarget, MatchError, MatchRequest, PriceList, RecipeMatch, RecipeMatches, ViewingCondition,
};
pub use recipe::{Curves, PigmentId, Recipe};

/// Numbers rounded to significant digits.
pub mod digits {
    pub use crate::evaluate::rounded;
}

/// K and S over wavelength.
pub mod curves {
    pub use crate::recipe::Curves;
}

/// Remarks that accompany a result.
pub mod remark {
    pub use crate::evaluate::{Remark, RemarkKind};
}

/// The check that spectra cover the visible band.
pub mod visible_band {
    pub use crate::evaluate::{BandError, check_has_color, check_visible_band};
}

/// How a library was fitted.
pub mod fit_settings {
    pub use crate::library::{BelowSurface, FitSettings, Method, Smoothness};
}
