//! The book of a survey: spectra of some pixels with the sets of pigments that explain them.

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use crate::map_error::MapError;

/// Version of the file of a book.
const VERSION: u32 = 3;

/// A set of pigments of an entry, with its shares.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BookSet {
    /// Places of the pigments in the book's list of names.
    pub pigments: Vec<u8>,
    /// Shares of these pigments, sum 1.
    pub shares: Vec<f32>,
}

/// A pixel of the survey.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BookEntry {
    /// Coordinates of the spectrum, by which similar pixels are found.
    pub point: Vec<f32>,
    /// Chi-square of the best set.
    pub chi2: f32,
    /// Sets that explain the spectrum, the best first.
    pub sets: Vec<BookSet>,
}

/// A set of pigments with the part of the survey that it explains.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SetFrequency {
    /// Places of the pigments in the book's list of names.
    pub pigments: Vec<u8>,
    /// Sum of the set's probabilities over the pixels of the survey, divided by their number.
    pub part: f32,
}

/// Result of a survey: all that a map of any other pixel depends on, beside the library and the settings.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Book {
    format: String,
    version: u32,
    /// Identity of library, wavelengths and settings.
    pub identity: String,
    /// Error of the library's predictions, in words.
    pub model_error: String,
    /// Names of the pigments.
    pub pigments: Vec<String>,
    /// Sets that the survey found, the most frequent first.
    pub sets: Vec<SetFrequency>,
    /// Probability of each pigment to be in the palette of the scan, 0 to 1.
    pub palette: Vec<f32>,
    /// Chi-square that nineteen of twenty pixels of the survey do not exceed.
    pub usual_chi2: f32,
    /// Pixels of the survey.
    pub entries: Vec<BookEntry>,
}

impl Book {
    pub(crate) fn new(identity: String, model_error: String, pigments: Vec<String>) -> Self {
        Self {
            format: "impasto-survey".to_owned(),
            version: VERSION,
            identity,
            model_error,
            pigments,
            sets: Vec::new(),
            palette: Vec::new(),
            usual_chi2: 0.0,
            entries: Vec::new(),
        }
    }

    /// The book as JSON.
    ///
    /// # Errors
    /// [`MapError::Book`] if a number cannot be written.
    pub fn to_json(&self) -> Result<String, MapError> {
        serde_json::to_string(self).map_err(|error| MapError::Book { reason: error.to_string() })
    }

    /// Reads a book that [`Book::to_json`] wrote.
    ///
    /// # Errors
    /// [`MapError::Book`] for text that is no book of this version, or whose numbers contradict each other.
    pub fn from_json(text: &str) -> Result<Self, MapError> {
        let book: Self = serde_json::from_str(text)
            .map_err(|error| MapError::Book { reason: error.to_string() })?;
        if book.format != "impasto-survey" || book.version != VERSION {
            let reason = format!("`{}` of version {}", book.format, book.version);
            return Err(MapError::Book { reason });
        }
        let known = |set: &[u8]| {
            (1..=4).contains(&set.len())
                && set.windows(2).all(|pair| pair[0] < pair[1])
                && set.iter().all(|&p| usize::from(p) < book.pigments.len())
        };
        let is_entry = |entry: &BookEntry| {
            entry.point.len() == crate::search::nearest::DIMENSIONS
                && entry.point.iter().all(|value| value.is_finite())
                && entry.sets.iter().all(|set: &BookSet| {
                    known(&set.pigments)
                        && set.shares.len() == set.pigments.len()
                        && set.shares.iter().all(|share| (0.0..=1.0).contains(share))
                })
        };
        if let Some(index) = book.entries.iter().position(|entry| !is_entry(entry)) {
            return Err(MapError::Book { reason: format!("entry {} is not valid", index + 1) });
        }
        let palette = &book.palette;
        if palette.len() != book.pigments.len() || palette.iter().any(|p| !(0.0..=1.0).contains(p))
        {
            let reason = "its palette has not one probability a pigment".to_owned();
            return Err(MapError::Book { reason });
        }
        if book.sets.iter().any(|set| !known(&set.pigments)) {
            return Err(MapError::Book { reason: "a set names an unknown pigment".to_owned() });
        }
        Ok(book)
    }

    /// SHA-256 of [`Book::to_json`], in hexadecimal.
    ///
    /// # Errors
    /// [`MapError::Book`] if a number cannot be written.
    pub fn sha256(&self) -> Result<String, MapError> {
        let digest = Sha256::digest(self.to_json()?.as_bytes());
        Ok(digest.iter().map(|byte| format!("{byte:02x}")).collect())
    }
}
