//! Pigment maps of spectral scans: which measured pigments are where, how much, and how sure.
//!
//! ```text
//! scan --> Cube --> blocks of pixels ------------------------------+
//! library (K, S) ---+--> Mapper --> survey (some pixels) --> Book --+--> map (any pixel) --> BlockMaps
//! wavelengths, noise +                                                    |
//!                                            StoredMaps <-- MapStore <----+
//! ```
//!
//! Without the feature `files` (default) there are no stores and no scans but those of ENVI, whose bytes the caller
//! reads. Pages in browsers use it like this.
//!
//! Modules are ordered by dependence: each uses only modules declared above it.

pub mod pixel_maps;
mod kept_numbers;
mod map_error;
mod films;
mod search;
mod mapping;
pub mod accuracy;
pub mod camera;
mod numbers;

#[cfg(feature = "files")]
mod zarr;
pub mod cube;
mod maps_about;

#[cfg(feature = "files")]
pub mod store;

#[cfg(feature = "files")]
pub mod truth;

#[cfg(feature = "files")]
pub mod blocks;
mod surveyed;

#[cfg(feature = "files")]
mod stored_run;
mod spot;
pub mod pictures;
mod told;
mod told_text;

#[cfg(feature = "files")]
pub use blocks::map_cube;
pub use cube::Cube;
pub use films::bands;
pub use films::ground::Ground;
pub use films::noise::{LEAST_MIXTURES, ModelError, USUAL_MODEL_ERROR};
pub use films::paints::Paints;
pub use films::settings::{MapSettings, PigmentGroup};
pub use map_error::MapError;
pub use mapping::book::{Book, BookEntry, BookSet, SetFrequency};
pub use mapping::groups::{ALIKE, Column, Confusion};
pub use mapping::mapper::Mapper;
pub use mapping::open_book::OpenBook;
pub use mapping::survey::{SURVEYED, survey_step};
pub use maps_about::MapsAbout;
pub use spot::{Spot, SpotError, SpotPigment};
#[cfg(feature = "files")]
pub use store::{MapStore, StoreMode, StoredMaps};
pub use surveyed::{FoundColumn, Region, SurveyError, SurveyedScan};
