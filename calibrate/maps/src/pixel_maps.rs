//! Maps of the pixels of one block: shares, presence, errors and masks as flat vectors.
//!
//! You also find here how stored maps describe their run, the precision of stored numbers, and the
//! errors of maps.

use std::ops::Range;

use calibrate::ResidualsError;
use documents::{Cancelled, hint::Explain};
use half::f16;
use pigment::RecipeError;
use serde::{Deserialize, Serialize};
#[cfg(feature = "files")]
use serde_json::json;
use serde_json::{Map, Value};

/// Whether a pixel is mapped, or why it is not.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[repr(u8)]
pub enum Mask {
    /// The pixel holds a reflectance that can be mapped.
    Mapped = 0,
    /// The file marks the pixel as having no data.
    Ignored = 1,
    /// A band of the pixel is not a finite number.
    NotFinite = 2,
    /// The pixel is darker than the surface itself reflects (k1).
    TooDark = 3,
    /// The detector was saturated in a band of the pixel.
    Saturated = 4,
    /// A band lies outside the range of reflectances.
    OutOfRange = 5,
    /// No mixture of the library explains the pixel. You get its chi-square and residual, and
    /// nothing else.
    OutOfGamut = 6,
    /// The pixel shows the bare ground.
    Ground = 7,
}

impl Mask {
    /// Every mask in the order of its number.
    pub const ALL: [Self; 8] = [
        Self::Mapped,
        Self::Ignored,
        Self::NotFinite,
        Self::TooDark,
        Self::Saturated,
        Self::OutOfRange,
        Self::OutOfGamut,
        Self::Ground,
    ];

    /// Whether we compared the pixel with mixtures, so that it has a chi-square.
    #[must_use]
    pub const fn is_compared(self) -> bool {
        matches!(self, Self::Mapped | Self::OutOfGamut)
    }

    /// Returns the number that files store.
    #[must_use]
    pub const fn code(self) -> u8 {
        self as u8
    }

    /// Returns the mask of a stored number.
    #[must_use]
    pub fn from_code(code: u8) -> Option<Self> {
        Self::ALL.get(usize::from(code)).copied()
    }

    /// Returns the name that files and tables show.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Mapped => "mapped",
            Self::Ignored => "ignored",
            Self::NotFinite => "not finite",
            Self::TooDark => "too dark",
            Self::Saturated => "saturated",
            Self::OutOfRange => "out of range",
            Self::OutOfGamut => "out of gamut",
            Self::Ground => "bare ground",
        }
    }
}

/// Number of pixels by mask.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct PixelCounts {
    counts: [u64; Mask::ALL.len()],
}

impl PixelCounts {
    /// Number of pixels with this mask.
    #[must_use]
    pub fn of(&self, mask: Mask) -> u64 {
        self.counts[usize::from(mask.code())]
    }

    /// Number of all pixels.
    #[must_use]
    pub fn all(&self) -> u64 {
        self.counts.iter().sum()
    }

    pub(crate) fn add(&mut self, masks: &[Mask]) {
        for mask in masks {
            self.counts[usize::from(mask.code())] += 1;
        }
    }
    #[cfg(feature = "files")]
    pub(crate) fn add_all(&mut self, other: &Self) {
        for (sum, count) in self.counts.iter_mut().zip(other.counts) {
            *sum += count;
        }
    }
}

/// Maps of the pixels of one block, in the order of the block's pixels: row after row.
///
/// The vectors `share`, `share_sd` and `presence` hold `pigments` numbers for each pixel, the
/// others one. If a pixel is not mapped, every number is NaN and `second` is empty. If it is out of
/// gamut, you still get chi-square and residual.
#[derive(Debug, Clone, PartialEq)]
pub struct BlockMaps {
    /// Number of pigments or groups of pigments.
    pub pigments: usize,
    /// Shares of the pigments, 0 to 1, which add up to 1 in a pixel.
    pub share: Vec<f32>,
    /// Standard deviations of the shares.
    pub share_sd: Vec<f32>,
    /// Probabilities that the pigments are present, 0 to 1.
    pub presence: Vec<f32>,
    /// Chi-square of each pixel per degree of freedom.
    pub chi2: Vec<f32>,
    /// Root mean square of the residual in reflectance over the bands.
    pub rms: Vec<f32>,
    /// Second-best set of each pixel, where bit `i` is pigment `i`. If there is none, this is 0.
    pub second: Vec<u64>,
    /// Whether each pixel is mapped, or why not.
    pub mask: Vec<Mask>,
}

impl BlockMaps {
    /// Most pigments that the bits of `second` can name.
    pub const MOST_PIGMENTS: usize = 64;

    /// Returns maps in which every pixel has the mask `mask` and no value.
    #[must_use]
    pub fn without_values(pixels: usize, pigments: usize, mask: Mask) -> Self {
        let of_pigments = vec![f32::NAN; pixels * pigments];
        Self {
            pigments,
            share: of_pigments.clone(),
            share_sd: of_pigments.clone(),
            presence: of_pigments,
            chi2: vec![f32::NAN; pixels],
            rms: vec![f32::NAN; pixels],
            second: vec![0; pixels],
            mask: vec![mask; pixels],
        }
    }

    /// Maps that hold no pixel yet, with room for `pixels`.
    pub(crate) fn with_capacity(pixels: usize, pigments: usize) -> Self {
        Self {
            pigments,
            share: Vec::with_capacity(pixels * pigments),
            share_sd: Vec::with_capacity(pixels * pigments),
            presence: Vec::with_capacity(pixels * pigments),
            chi2: Vec::with_capacity(pixels),
            rms: Vec::with_capacity(pixels),
            second: Vec::with_capacity(pixels),
            mask: Vec::with_capacity(pixels),
        }
    }

    /// Adds a pixel that is not mapped.
    pub(crate) fn push_masked(&mut self, mask: Mask, chi2: f64, rms: f64) {
        let end = self.share.len() + self.pigments;
        for values in [&mut self.share, &mut self.share_sd, &mut self.presence] {
            values.resize(end, f32::NAN);
        }
        self.chi2.push(chi2 as f32);
        self.rms.push(rms as f32);
        self.second.push(0);
        self.mask.push(mask);
    }

    /// Adds the pixels of `other`, which has as many pigments.
    pub(crate) fn append(&mut self, other: Self) {
        self.share.extend(other.share);
        self.share_sd.extend(other.share_sd);
        self.presence.extend(other.presence);
        self.chi2.extend(other.chi2);
        self.rms.extend(other.rms);
        self.second.extend(other.second);
        self.mask.extend(other.mask);
    }

    /// Number of pixels.
    #[must_use]
    pub fn pixels(&self) -> usize {
        self.mask.len()
    }

    /// Whether the lengths of all vectors agree.
    #[must_use]
    pub fn is_consistent(&self) -> bool {
        let pixels = self.pixels();
        let numbers = pixels.checked_mul(self.pigments);
        let of_pigments = [&self.share, &self.share_sd, &self.presence];
        let of_pixels = [self.chi2.len(), self.rms.len(), self.second.len()];
        self.pigments <= Self::MOST_PIGMENTS
            && of_pigments.iter().all(|values| Some(values.len()) == numbers)
            && of_pixels.iter().all(|&length| length == pixels)
    }
}

/// We store a probability of 1 as this number.
pub(crate) const PRESENCE_ONE: f32 = 250.0;
/// We store this number if there is no probability.
pub(crate) const NO_PRESENCE: u8 = 255;

/// Share or deviation as we store it. Every NaN has the same bits.
pub(crate) fn half_of(value: f32) -> f16 {
    if value.is_nan() { f16::NAN } else { f16::from_f32(value) }
}

/// Probability as we store it.
pub(crate) fn code_of(presence: f32) -> u8 {
    match presence.is_nan() {
        true => NO_PRESENCE,
        false => (presence.clamp(0.0, 1.0) * PRESENCE_ONE).round() as u8,
    }
}

/// Probability of a stored number.
pub(crate) fn presence_of(code: u8) -> f32 {
    match code {
        NO_PRESENCE => f32::NAN,
        code => f32::from(code) / PRESENCE_ONE,
    }
}

impl BlockMaps {
    /// The maps as you would read them from a store: shares and their deviations in half precision,
    /// presence in steps of 1/250.
    #[must_use]
    pub fn as_kept(mut self) -> Self {
        for value in self.share.iter_mut().chain(&mut self.share_sd) {
            *value = half_of(*value).to_f32();
        }
        for value in &mut self.presence {
            *value = presence_of(code_of(*value));
        }
        self
    }
}

/// Everything on which the bytes of maps depend.
#[derive(Debug, Clone, PartialEq)]
pub struct MapsAbout {
    /// Names of the pigments or groups, in the order of the maps. At most 64, all different.
    pub pigments: Vec<String>,
    /// SHA-256 of the library's file, in hexadecimal digits.
    pub library_sha256: String,
    /// SHA-256 of the survey's book, in hexadecimal digits.
    pub book_sha256: String,
    /// SHA-256 or another fingerprint of the scan.
    pub scan: String,
    /// Rows of the scan that are mapped.
    pub rows: Range<usize>,
    /// Columns of the scan that are mapped.
    pub columns: Range<usize>,
    /// Settings of the run.
    pub settings: Map<String, Value>,
}

impl MapsAbout {
    #[cfg(feature = "files")]
    pub(crate) fn attributes(&self) -> Map<String, Value> {
        let all = json!({
            "title": "pigment maps",
            "impasto_version": env!("CARGO_PKG_VERSION"),
            "library_sha256": self.library_sha256,
            "book_sha256": self.book_sha256,
            "scan": self.scan,
            "pigments": self.pigments,
            "rows": [self.rows.start, self.rows.end],
            "columns": [self.columns.start, self.columns.end],
            "settings": self.settings,
        });
        match all {
            Value::Object(map) => map,
            _ => Map::new(),
        }
    }
}

/// We cannot make a map.
#[derive(Debug, Clone, PartialEq, thiserror::Error, Explain)]
pub enum MapError {
    /// The wavelengths of the scan do not rise.
    #[error("wavelengths must rise strictly, found `{after}` nm at band {band} after {before} nm")]
    #[hint("sort the bands of the scan by wavelength, in nm")]
    Order {
        /// Number of the band, counted from 1.
        band: usize,
        /// Wavelength of the band before, in nm.
        before: f64,
        /// Wavelength of this band, in nm.
        after: f64,
    },
    /// Too few bands of the scan lie within the library's wavelengths.
    #[error(
        "{inside} of {bands} bands lie within {start_nm} to {end_nm} nm, where the library's K and S are known; {needed} are needed"
    )]
    #[hint(
        "check that the wavelengths are in nm, or fit a library from readings that cover the scan"
    )]
    Overlap {
        /// Number of bands of the scan.
        bands: usize,
        /// Number of them within the library's wavelengths.
        inside: usize,
        /// Least number that is needed.
        needed: usize,
        /// First wavelength of the library in nm.
        start_nm: f64,
        /// Last wavelength of the library in nm.
        end_nm: f64,
    },
    /// A name matches no pigment of the library, or several.
    #[error(transparent)]
    #[fault(Setting)]
    Name(#[from] RecipeError),
    /// Residuals do not suit the library.
    #[error(transparent)]
    Residuals(#[from] ResidualsError),
    /// Too few or too many pigments take part.
    #[error("1 to {most} pigments can take part in a map, found `{found}`")]
    #[hint("name the pigments with [palette]")]
    #[fault(Setting)]
    Pigments {
        /// Number of pigments that would take part.
        found: usize,
        /// Greatest number that can.
        most: usize,
    },
    /// A pigment belongs to two groups.
    #[error("{pigment} is in the group `{first}` and in the group `{second}`")]
    #[hint("name each pigment in one [group]")]
    #[fault(Setting)]
    TwoGroups {
        /// Name of the pigment.
        pigment: String,
        /// Name of the first group.
        first: String,
        /// Name of the second group.
        second: String,
    },
    /// A group has a name that it cannot have.
    #[error("a group is named `{name}`, expected {expected}")]
    #[hint("give the [group] a short name, e.g. whites")]
    #[fault(Setting)]
    GroupName {
        /// Start of the name.
        name: String,
        /// Names that a group may have.
        expected: &'static str,
    },
    /// The ground is not a reflectance, or does not cover the bands of the scan.
    #[error("the spectrum of the ground {0}")]
    #[hint(
        "give reflectances from 0 to 1 at rising wavelengths that cover the scan, or a region of bare ground in the scan, as the [ground]"
    )]
    #[fault(Setting)]
    Ground(String),
    /// A setting is out of its range.
    #[error("{name} must be {range}, found `{value}`")]
    #[fault(Setting)]
    Setting {
        /// Name of the setting.
        name: &'static str,
        /// Range of the setting, in words.
        range: &'static str,
        /// Value that was given.
        value: f64,
    },
    /// The number of reflectances is not a whole number of pixels.
    #[error("{values} reflectances do not make whole pixels of {bands} bands")]
    #[hint("give the reflectances pixel after pixel, all bands of each")]
    Length {
        /// Number of reflectances.
        values: usize,
        /// Bands of a pixel.
        bands: usize,
    },
    /// The number of masks is not the number of pixels.
    #[error("{masks} masks for {pixels} pixels")]
    #[hint("give one mask for each pixel, or none at all")]
    Masks {
        /// Number of masks.
        masks: usize,
        /// Number of pixels.
        pixels: usize,
    },
    /// We cannot map any pixel of the survey.
    #[error("none of {0} surveyed pixels holds a reflectance that can be mapped")]
    #[hint("check that the scan holds reflectances from 0 to 1 rather than raw counts or percent")]
    NothingToSurvey(usize),
    /// You made the book with another library, other wavelengths or other settings.
    #[error("the book of the survey was made for `{found}`, not for `{expected}`")]
    #[hint("survey the scan again with these settings")]
    OtherBook {
        /// Identity of the book.
        found: String,
        /// Identity of the mapper.
        expected: String,
    },
    /// You made the book with another error of the library's predictions.
    #[error("the survey was made with {found}, not with {expected}")]
    #[hint(
        "give the same [residuals] or [model_error] as for the survey, or survey the scan again"
    )]
    OtherModelError {
        /// Error of the book, in words.
        found: String,
        /// Error of the mapper, in words.
        expected: String,
    },
    /// We cannot read the file of a book.
    #[error("the book of a survey is not valid: {0}")]
    #[hint("survey the scan again: without this file, or with another one as the [survey]")]
    Book(String),
    /// Someone ended the survey early.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mask_survives_its_number() {
        for (code, mask) in (0_u8..).zip(Mask::ALL) {
            assert_eq!(mask.code(), code, "{}", mask.name());
            assert_eq!(Mask::from_code(code), Some(mask), "{}", mask.name());
        }
        assert_eq!(Mask::from_code(8), None, "no mask has the number 8");
    }

    #[test]
    fn lengths_that_disagree_are_seen() {
        let maps = BlockMaps::without_values(6, 3, Mask::Ignored);
        assert!(maps.is_consistent(), "a fresh block of maps");
        for change in [
            |maps: &mut BlockMaps| maps.share.truncate(5),
            |maps: &mut BlockMaps| maps.share_sd.truncate(5),
            |maps: &mut BlockMaps| maps.presence.truncate(5),
            |maps: &mut BlockMaps| maps.chi2.truncate(5),
            |maps: &mut BlockMaps| maps.rms.truncate(5),
            |maps: &mut BlockMaps| maps.second.truncate(5),
            |maps: &mut BlockMaps| maps.pigments = 2,
        ] {
            let mut changed = maps.clone();
            change(&mut changed);
            assert!(!changed.is_consistent(), "{changed:?}");
        }
    }
}
