//! Errors of the libraries, in the words of the page.

use documents::hint::{Explain, Hint};

pub(crate) use told::{Result, setting};

/// Settings that a hint may name, each with its control on the page. Other settings exist only as
/// options of the program.
const CONTROLS: [(&str, &str); 45] = [
    ("reference", "\"White\""),
    ("percent", "\"Readings are in\": percent"),
    ("fraction", "\"Readings are in\": fractions"),
    ("format", "\"Format\""),
    ("pigments", "\"Columns of pigments\""),
    ("recipes", "the CSV of recipes in \"Recipes of the samples\""),
    ("saunderson", "\"Surface\" (k1 and k2)"),
    ("specular", "\"Gloss of the readings\""),
    ("below_surface", "\"Readings below the surface\""),
    ("smoothness", "\"Smoothness\""),
    ("unevenness", "\"Unevenness\""),
    ("exclude", "\"Samples to leave out\""),
    ("amounts", "\"Amounts\""),
    ("method", "\"Method\""),
    ("white_reading", "\"White reading\""),
    ("dark_reading", "\"Dark readings\""),
    ("tile", "\"Reflectance of the white\""),
    ("full_scale", "\"Largest count\""),
    ("least_light", "\"Least light\""),
    ("illuminant", "\"Light\""),
    ("observer", "\"Observer\""),
    ("thickness", "\"Thickness\""),
    ("over", "\"Over\""),
    ("only", "\"Only these pigments\""),
    ("with", "\"With\""),
    ("without", "\"Without\""),
    ("at_most", "\"Pigments at most\""),
    ("least", "\"Least share\""),
    ("tolerance", "\"Tolerance\""),
    ("surface_of", "\"Surface of a library\""),
    ("sample", "\"Sample\""),
    ("over_white", "\"Over white\""),
    ("over_black", "\"Over black\""),
    ("white_card", "\"White card\""),
    ("black_card", "\"Black card\""),
    ("thickness_mm", "\"Thickness, mm\""),
    ("solids", "\"Solids\""),
    ("contrast", "\"Contrast\""),
    ("noise", "\"Noise\""),
    ("swatches", "\"Swatches\""),
    ("minutes", "\"Minutes\""),
    ("minutes_each", "\"Minutes each\""),
    ("grams", "\"Grams\""),
    ("balance", "\"Balance\""),
    ("replicates", "\"Readings of each\""),
];

pub(crate) fn hint_text(hint: &Hint) -> String {
    told::hint_text(hint, &CONTROLS)
}

/// A request that the page passes as JSON.
pub(crate) fn request<T: serde::de::DeserializeOwned>(json: &str) -> Result<T> {
    told::request(json, &CONTROLS)
}

/// Converts the error of a result into the JSON that the page reads.
pub(crate) trait Told<T> {
    fn told(self) -> Result<T>;
}

impl<T, E: Explain> Told<T> for std::result::Result<T, E> {
    fn told(self) -> Result<T> {
        self.map_err(|error| told::refusal(&error, &CONTROLS))
    }
}
