//! Maps of the pixels of one block: shares, presence, errors and masks as flat vectors.

use serde::{Deserialize, Serialize};

/// Tells whether a pixel is mapped, or why it is not.
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
    /// No mixture of the library explains the pixel. Its chi-square and residual are told, and nothing else.
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

    /// Tells whether the pixel was compared with mixtures, so that it has a chi-square.
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
/// The vectors `share`, `share_sd` and `presence` hold `pigments` numbers a pixel, the others one.
/// A pixel that is not mapped holds NaN in every number and an empty `second`, but for the chi-square and the
/// residual of one that is out of gamut.
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
    /// Second-best set of each pixel: bit `i` is pigment `i`; 0 where there is none.
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
        let of_pigments = || Vec::with_capacity(pixels * pigments);
        let of_pixels = || Vec::with_capacity(pixels);
        Self {
            pigments,
            share: of_pigments(),
            share_sd: of_pigments(),
            presence: of_pigments(),
            chi2: of_pixels(),
            rms: of_pixels(),
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

    /// Tells whether the lengths of all vectors agree.
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
