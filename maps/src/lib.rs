//! Pigment maps of spectral scans: which measured pigments are where, how much, and how sure.
//!
//! ```text
//! scan --> Cube --> blocks of pixels ------------------------------+
//! library (K, S) ---+--> Mapper --> survey (some pixels) --> Book --+--> map (any pixel) --> BlockMaps
//! wavelengths, noise +                                                    |
//!                                            StoredMaps <-- MapStore <----+
//! ```
//!
//! Modules are ordered by dependence: each uses only modules declared above it.

pub mod pixel_maps;

mod map_error;

mod films;

mod search;

mod mapping;

pub mod accuracy;

pub mod camera;

mod numbers;

mod zarr;

pub mod cube;

pub mod store;

pub mod truth;

pub mod blocks;

mod surveyed;

mod spot;

pub mod pictures;

mod told;

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
pub use spot::{Spot, SpotError, SpotPigment};
pub use store::{MapStore, StoreMode, StoredMaps};
pub use surveyed::{FoundColumn, Region, SurveyError, SurveyedScan};
