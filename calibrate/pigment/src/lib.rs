//! The pigment library and its uses: mixtures, recipes, quadrature, palettes.
//!
//! A [`PigmentLibrary`] holds the Kubelka-Munk K and S of calibrated paints. From it follow the colour of
//! any mixture ([`PigmentLibrary::color`]) and recipes for any colour ([`PigmentLibrary::recipes_for`]).
//!
//! ```text
//! library (JSON) -> recipe -> K and S of the mixture -> film -> reflectance -> colour
//!                     ^                                                          |
//!                     +---------------------- matching <------------- target ----+
//! ```
//!
//! ```
//! use pigment::{MatchOptions, PigmentLibrary, Viewing};
//!
//! let oils = PigmentLibrary::van_gogh_oils();
//! let color = oils.color([("Zinc White", 9.0), ("Cobalt Blue", 1.0)], &Viewing::default())?;
//! println!("{} L* {:.1}", color.hex(), color.lab.lightness);
//!
//! let options = MatchOptions { at_most: 3, ..MatchOptions::default() };
//! let found = oils.recipes_for(&"#4a7d8c".parse()?, &options)?;
//! println!("nearest: {:.2} CIEDE2000", found.nearest());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Measuring and fitting are in the crate `calibrate`, instruments' files in `spectra`. Modules are ordered
//! by dependence: each uses only modules declared above it.

pub mod digits;
pub mod remark;
pub mod evaluate;
pub mod visible_band;
pub mod appearance;
pub mod curves;
pub mod recipe;
pub mod backing;
mod least_squares;
pub mod smooth_reflectance;
pub mod fit_settings;
pub mod library;
pub mod color;
pub mod curation;
pub mod quadrature;
pub mod palette;
mod illuminant_change;
pub mod matching;

pub use appearance::Appearance;
pub use backing::{Backing, BackingError};
pub use color::{ColorError, FilmOver, MixtureColor};
pub use curves::Curves;
pub use evaluate::Viewing;
pub use illuminant_change::IlluminantChange;
pub use library::{LibraryError, Pigment, PigmentLibrary, RecipeError};
pub use matching::{
    ColorTarget, MatchError, MatchOptions, PriceList, RecipeMatch, RecipeMatches, ViewingCondition,
};
pub use recipe::{PigmentId, Recipe};
pub use remark::{Remark, RemarkKind};
