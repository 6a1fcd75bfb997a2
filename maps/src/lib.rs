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

pub mod bands;

pub mod left_out;

mod paints;

mod noise;

mod settings;

mod whitening;

mod film;

mod nearest;

mod set_fit;

mod quadratic;

mod table;

mod search;

mod groups;

mod prepared;

mod book;

mod survey;

mod presence;

mod mapping;

mod mapper;

pub mod accuracy;

mod numbers;

mod zarr;

pub mod cube;

pub mod store;

pub mod blocks;

mod surveyed;

mod spot;

pub mod pictures;

pub use blocks::map_cube;
pub use book::{Book, BookEntry, BookSet, SetFrequency};
pub use cube::Cube;
pub use groups::{ALIKE, Column, Confusion};
pub use map_error::MapError;
pub use mapper::Mapper;
pub use mapping::OpenBook;
pub use noise::{ModelError, USUAL_MODEL_ERROR};
pub use paints::Paints;
pub use settings::{MapSettings, PigmentGroup};
pub use spot::{Spot, SpotError, SpotPigment};
pub use store::{MapStore, StoreMode, StoredMaps};
pub use survey::{SURVEYED, survey_step};
pub use surveyed::{FoundColumn, Region, SurveyError, SurveyedScan};

#[cfg(test)]
mod film_tests;
