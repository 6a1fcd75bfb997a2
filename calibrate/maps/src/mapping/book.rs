//! Maps pixels with the book of a survey.
//!
//! The book holds spectra of some pixels with the sets of pigments that explain them. We compare
//! each pixel with the sets of the four nearest pixels in the book. If none of them explains it, we
//! search all sets. The result depends only on the pixel and the book.

use pigment::library::PigmentLibrary;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use crate::films::bands::{Bands, BareGround, Ground, MOST_BANDS};
use crate::films::film::{Films, Paints, Pixel};
use crate::films::settings::{MapSettings, ModelError, Noise};
use crate::films::whitening::WhiteningNoise;
use crate::pixel_maps::{MapError, Mask};
use crate::search::set_fit::{Scores, SetFit};
use crate::search::{Engine, Nearest, Point, Scratch, Table};

const VERSION: u32 = 4;
/// In this version the palette holds the probability that the scan holds a pigment anywhere.
const WITH_PROBABILITIES: u32 = 3;
/// Frequencies of a palette lie between these, because no survey sees all paints.
pub(crate) const WITHIN: [f64; 2] = [0.02, 0.9];

/// Median chi-square of a scan with the errors that we expect.
fn expected_chi2() -> f32 {
    1.0
}

/// A set of pigments of an entry, with its shares.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BookSet {
    /// Places of the pigments in the book's list of names.
    pub pigments: Vec<u8>,
    /// Indices of the pigments in [`Book::pigments`], rising.
    pub shares: Vec<f32>,
}

/// A pixel of the survey.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BookEntry {
    /// Coordinates of the spectrum. We use them to find similar pixels.
    pub point: Vec<f32>,
    /// Chi-square of the best set.
    pub chi2: f32,
    /// Sets that explain the spectrum, the best first.
    pub sets: Vec<BookSet>,
}

/// A set of pigments, and how much of the survey it explains.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SetFrequency {
    /// Indices of the pigments in [`Book::pigments`], rising.
    pub pigments: Vec<u8>,
    /// Mean probability of the set over the pixels of the survey.
    pub part: f32,
}

/// Result of a survey. With the library and the settings, you need nothing else to map a pixel.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Book {
    format: String,
    version: u32,
    /// Identity of library, wavelengths and settings.
    pub identity: String,
    /// Error of the library's predictions, as text.
    pub model_error: String,
    /// Names of the pigments.
    pub pigments: Vec<String>,
    /// Sets that the survey found, the most frequent first.
    pub sets: Vec<SetFrequency>,
    /// How much of the scan holds each pigment, as a probability above 0 and below 1. Paints count
    /// by the square root of their pixels.
    pub palette: Vec<f32>,
    /// Median chi-square per degree of freedom over the pixels of the survey. Surveys of version 3 do not
    /// state it.
    #[serde(default = "expected_chi2")]
    pub median_chi2: f32,
    /// 95th percentile of chi-square over the pixels of the survey.
    pub usual_chi2: f32,
    /// The pixels of the survey.
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
            median_chi2: 1.0,
            usual_chi2: 0.0,
            entries: Vec::new(),
        }
    }

    /// The book as JSON.
    pub fn to_json(&self) -> Result<String, MapError> {
        serde_json::to_string(self).map_err(|error| MapError::Book(error.to_string()))
    }

    /// Reads a book that you wrote with [`Book::to_json`].
    ///
    /// # Errors
    /// [`MapError::Book`] if the text is not a book of this version or of version 3, or its numbers
    /// contradict each other.
    pub fn from_json(text: &str) -> Result<Self, MapError> {
        let mut book: Self =
            serde_json::from_str(text).map_err(|error| MapError::Book(error.to_string()))?;
        if book.version == WITH_PROBABILITIES {
            book.version = VERSION;
            let [least, most] = WITHIN.map(|bound| bound as f32);
            book.palette.iter_mut().for_each(|p| *p = p.clamp(least, most));
        }
        if book.format != "impasto-survey" || book.version != VERSION {
            let reason = format!("`{}` of version {}", book.format, book.version);
            return Err(MapError::Book(reason));
        }
        let known = |set: &[u8]| {
            (1..=4).contains(&set.len())
                && set.windows(2).all(|pair| pair[0] < pair[1])
                && set.iter().all(|&p| usize::from(p) < book.pigments.len())
        };
        if let Some(index) = book.entries.iter().position(|entry: &BookEntry| {
            entry.point.len() != crate::search::DIMENSIONS
                || entry.point.iter().any(|value| !value.is_finite())
                || entry.sets.iter().any(|set: &BookSet| {
                    !known(&set.pigments)
                        || set.shares.len() != set.pigments.len()
                        || set.shares.iter().any(|share| !(0.0..=1.0).contains(share))
                })
        }) {
            return Err(MapError::Book(format!("entry {} is not valid", index + 1)));
        }
        let palette = &book.palette;
        if palette.len() != book.pigments.len() || !palette.iter().all(|p| *p > 0.0 && *p < 1.0) {
            let reason = "its palette has not one probability a pigment".to_owned();
            return Err(MapError::Book(reason));
        }
        if !(book.median_chi2.is_finite() && book.median_chi2 >= 0.0) {
            return Err(MapError::Book("its median chi-square is no number".to_owned()));
        }
        if book.sets.iter().any(|set| !known(&set.pigments)) {
            return Err(MapError::Book("a set names an unknown pigment".to_owned()));
        }
        Ok(book)
    }

    /// SHA-256 of [`Book::to_json`], in hexadecimal.
    pub fn sha256(&self) -> Result<String, MapError> {
        let digest = Sha256::digest(self.to_json()?.as_bytes());
        Ok(digest.iter().map(|byte| format!("{byte:02x}")).collect())
    }
}

/// For each pixel we take the pigment sets of this many entries of the book, the nearest ones.
const NEIGHBOURS: usize = 4;
/// We try at most this many sets of the nearest entries.
const PROPOSED: usize = 8;
/// Gauss-Newton steps of each set that we try.
const STEPS: usize = 1;
/// A set of the book explains a pixel if its chi-square is at most this many times the greatest of
/// the nearest entries, or at most the survey's usual one.
const WORSE: f32 = 1.2;

/// A book that is ready for mapping.
#[derive(Debug, Clone)]
pub struct OpenBook {
    nearest: Nearest,
    /// Where the sets of each entry end in `sets`.
    ends: Vec<u32>,
    sets: Vec<SetFit>,
    chi2: Vec<f32>,
    usual_chi2: f32,
    /// Search with the palette of the survey.
    engine: Engine,
}

impl OpenBook {
    /// Prepares `book` for the pixels of a map.
    ///
    /// # Errors
    /// [`MapError::OtherBook`] if someone made it with another library, other wavelengths or other
    /// settings.
    pub(crate) fn new(prepared: &Prepared, identity: &str, book: &Book) -> Result<Self, MapError> {
        if book.identity != identity || book.pigments != prepared.paints.names {
            let found = book.identity.clone();
            let expected = identity.to_owned();
            return Err(MapError::OtherBook { found, expected });
        }
        let points: Vec<Point> = (book.entries.iter())
            .map(|entry| std::array::from_fn(|i| entry.point.get(i).copied().unwrap_or(0.0)))
            .collect();
        let mut ends = Vec::new();
        let mut sets = Vec::new();
        for entry in &book.entries {
            for set in &entry.sets {
                let parts = set.pigments.iter().zip(&set.shares);
                let parts: Vec<(usize, f32)> =
                    parts.map(|(&member, &share)| (usize::from(member), share)).collect();
                sets.extend(SetFit::of_parts(&parts));
            }
            ends.push(sets.len() as u32);
        }
        Ok(Self {
            nearest: Nearest::new(&points),
            ends,
            sets,
            chi2: book.entries.iter().map(|entry| entry.chi2).collect(),
            usual_chi2: book.usual_chi2,
            engine: prepared.engine.with_survey(&book.palette, f64::from(book.median_chi2)),
        })
    }

    fn sets(&self, entry: usize) -> &[SetFit] {
        let start = entry.checked_sub(1).map_or(0, |before| self.ends[before]) as usize;
        &self.sets[start..self.ends[entry] as usize]
    }

    /// Finds the sets that explain a pixel and leaves them in `scratch.found`, the best first.
    /// Returns whether the book explained the pixel.
    pub(crate) fn find(&self, folded: &Folded, scratch: &mut Scratch) -> bool {
        let engine = &self.engine;
        let near = self.nearest.find::<NEIGHBOURS>(&folded.projected);
        scratch.clear();
        let mut proposed = Vec::with_capacity(PROPOSED);
        let mut usual = self.usual_chi2;
        // The best sets of all neighbours come before the second-best of any.
        'ranks: for rank in 0.. {
            let mut any = false;
            for &(_, entry) in near.iter().filter(|(_, entry)| *entry != u32::MAX) {
                let entry = entry as usize;
                if rank == 0 {
                    usual = usual.max(WORSE * self.chi2[entry].min(4.0 * self.usual_chi2));
                }
                let Some(set) = self.sets(entry).get(rank) else { continue };
                any = true;
                if proposed.iter().any(|known: &SetFit| known.key() == set.key()) {
                    continue;
                }
                if proposed.len() == PROPOSED {
                    break 'ranks;
                }
                proposed.push(*set);
            }
            if !any {
                break;
            }
        }
        for set in proposed {
            engine.add(&folded.pixel, set, STEPS, scratch);
        }
        engine.sort(&folded.pixel, scratch);
        let explained = scratch.found.first().is_some_and(|best| best.chi2 <= usual);
        if !explained {
            let place = engine.table.nearest(&folded.projected);
            engine.search(&folded.pixel, place, scratch);
        }
        explained
    }
}

/// Reflectances that a band of a scan can have. Other values show raw counts, percent or a wrong
/// white.
const REFLECTANCES: std::ops::RangeInclusive<f32> = -0.2..=1.5;

/// Everything that does not change from pixel to pixel.
#[derive(Debug, Clone)]
pub(crate) struct Prepared {
    pub(crate) bands: Bands,
    pub(crate) paints: Paints,
    pub(crate) noise: Noise,
    pub(crate) engine: Engine,
    /// Bands of the scan that we use.
    used: Vec<usize>,
    /// Where the row of each folded band ends in `terms`.
    ends: Vec<usize>,
    terms: Vec<(u32, f32)>,
    ground: Option<BareGround>,
}

/// A pixel on the folded bands.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Folded {
    pub(crate) pixel: Pixel,
    /// Its coordinates by [`Projection`](crate::search::Projection), to find similar spectra.
    pub(crate) projected: Point,
}

impl Prepared {
    /// Prepares `library`. `model` is the error of its predictions.
    pub(crate) fn new(
        library: &PigmentLibrary,
        wavelengths: &[f64],
        settings: &MapSettings,
        model: &ModelError,
    ) -> Result<Self, MapError> {
        let bands = Bands::new(wavelengths, library.grid)?;
        let paints = Paints::new(library, &settings.palette, &bands)?;
        let noise = Noise::new(&bands, settings.sensor_noise, model);
        let films = Films::new(&paints);
        let table = Table::new(&paints, &films, &noise);
        let engine = Engine {
            films,
            table,
            noise: WhiteningNoise::new(&noise),
            at_most: settings.at_most.min(paints.count()),
            scores: Scores::new(paints.count(), settings.penalty, noise.evidence),
            strength_sd: vec![0.0; paints.count()],
        };
        let mut ends = Vec::new();
        let mut terms = Vec::new();
        let mut used = Vec::new();
        for row in &bands.from_scan {
            terms.extend(row.terms.iter().map(|&(band, weight)| (band as u32, weight as f32)));
            used.extend(row.terms.iter().map(|&(band, _)| band));
            ends.push(terms.len());
        }
        used.sort_unstable();
        used.dedup();
        let ground = settings
            .ground
            .as_ref()
            .map(|ground: &Ground| BareGround::new(ground, wavelengths, &bands, &noise.sensor))
            .transpose()?;
        Ok(Self { bands, paints, noise, engine, used, ends, terms, ground })
    }

    /// Folds a pixel of the scan.
    ///
    /// # Errors
    /// The reason why we cannot map it.
    pub(crate) fn fold(&self, scan: &[f32]) -> Result<Folded, Mask> {
        for &band in &self.used {
            let value = scan[band];
            if !value.is_finite() {
                return Err(Mask::NotFinite);
            }
            if !REFLECTANCES.contains(&value) {
                return Err(Mask::OutOfRange);
            }
        }
        let mut folded = [0.0; MOST_BANDS];
        let mut start = 0;
        for (value, &end) in folded.iter_mut().zip(&self.ends) {
            for &(band, weight) in &self.terms[start..end] {
                *value += weight * scan[band as usize];
            }
            start = end;
        }
        let folded = &folded[..self.bands.count()];
        let mean = folded.iter().sum::<f32>() / folded.len() as f32;
        if mean <= self.paints.surface.floor() as f32 {
            return Err(Mask::TooDark);
        }
        if self.ground.as_ref().is_some_and(|ground| ground.explains(folded)) {
            return Err(Mask::Ground);
        }
        let projected = self.engine.table.projection.of(folded);
        Ok(Folded { pixel: self.engine.films.pixel(&self.engine.noise, folded), projected })
    }
}
