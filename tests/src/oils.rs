//! The shipped Van Gogh oils: swatches, fits and pigment library.

use calibrate::PigmentId;
use calibrate::calibration::{Calibration, calibrate};
use calibrate::evaluate::Viewing;
use calibrate::fit::{FitSettings, Method};
use calibrate::measurement::{MeasurementTable, ScaleChoice};
use calibrate::observation::BelowSurface;
use calibrate::swatch::SwatchSet;
use documents::Task;
use spectra::optics::{Specular, Surface};

/// The error limits of the oils assume this Saunderson surface.
pub const SURFACE: Surface = Surface { k1: 0.03, k2: 0.6, specular: Specular::Included };

/// Swatches of the shipped measurement file, and the index of zinc white.
///
/// # Panics
/// If the file cannot be read.
#[must_use]
pub fn swatches() -> (SwatchSet, PigmentId) {
    let bytes = include_bytes!("../../measurements/van-gogh-oils.csv");
    let table = MeasurementTable::from_csv("van-gogh-oils.csv", bytes, ScaleChoice::ByFile)
        .expect("the shipped oils are sound");
    let set = SwatchSet::from_table(&table).expect("the shipped oils are sound");
    let white = set.pigments.iter().position(|p| p == "Zinc White").expect("a zinc white");
    (set, PigmentId(white))
}

/// Fit settings for the oils. Some readings lie below k1 and are raised to the floor.
#[must_use]
pub fn settings(method: Method) -> FitSettings {
    FitSettings { method, below_surface: BelowSurface::Floor, ..FitSettings::default() }
}

/// Fits all swatches of the oils with zinc white as the reference.
///
/// # Panics
/// If the fit fails.
#[must_use]
pub fn fitted(method: Method, surface: Surface) -> Calibration {
    let (set, white) = swatches();
    calibrate(&set, white, surface, &settings(method), &Viewing::default(), &Task::default())
        .expect("a fit")
}

/// The shipped pigment library of the oils.
///
/// # Panics
/// If it cannot be read.
#[must_use]
pub fn library() -> calibrate::library::PigmentLibrary {
    let path = crate::program::repository("measurements/van-gogh-oils.pigments.json");
    let text = std::fs::read_to_string(&path).expect("the shipped library is there");
    calibrate::library::PigmentLibrary::from_json(&path, &text).expect("the library is valid")
}
