//! Pigment maps of spectral scans: which measured pigments are where, how much of each, and how
//! sure we are.
//!
//! ```text
//! scan --> Cube --> blocks of pixels ------------------------------+
//! library (K, S) ---+--> Mapper --> survey (some pixels) --> Book --+--> map (any pixel) --> BlockMaps
//! wavelengths, noise +                                                    |
//!                                            StoredMaps <-- MapStore <----+
//! ```
//!
//! If you switch off the feature `files` (a default), there are no stores, ENVI is the only kind of
//! scan, and you read its bytes yourself. Pages in browsers do this.
//!
//! Modules are ordered by dependence: each uses only modules declared above it.

pub mod pixel_maps;
mod films;
mod search;
mod mapping;
pub mod accuracy;
pub mod camera;
mod numbers;
#[cfg(feature = "files")]
mod zarr;
pub mod cube;
#[cfg(feature = "files")]
pub mod store;
#[cfg(feature = "files")]
pub mod truth;
mod surveyed;
#[cfg(feature = "files")]
pub mod blocks;
pub mod pictures;
mod outcomes;
mod request;
mod identify;

#[cfg(feature = "files")]
pub use blocks::map_cube;
pub use cube::Cube;
pub use films::bands;
pub use films::bands::Ground;
pub use films::film::Paints;
pub use films::settings::{
    LEAST_MIXTURES, MapSettings, ModelError, PigmentGroup, USUAL_MODEL_ERROR,
};
pub use identify::{Identified, IdentifiedSpectrum, IdentifyRequest, PigmentSet};
pub use mapping::Mapper;
pub use mapping::book::{Book, BookEntry, BookSet, OpenBook, SetFrequency};
pub use mapping::groups::{ALIKE, Column, Confusion};
pub use mapping::survey::{SURVEYED, survey_step};
pub use pixel_maps::{MapError, MapsAbout};
#[cfg(feature = "files")]
pub use request::MappedScan;
pub use request::{GroundSource, MapRequest, MapRequestError};
#[cfg(feature = "files")]
pub use store::{MapStore, StoreMode, StoredMaps};
pub use surveyed::{FoundColumn, Region, Spot, SpotError, SpotPigment, SurveyError, SurveyedScan};
