//! Windows of raw values, and blocks of pixels with their reflectances.
//!
//! Here we also convert raw values to reflectance and find out why a pixel cannot be mapped.

use std::fmt::Debug;
use std::ops::Range;
use std::path::PathBuf;

use pigment::Remark;
use rayon::prelude::*;

use super::error::CubeError;
use crate::pixel_maps::Mask;

#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Window {
    pub(crate) rows: Range<usize>,
    pub(crate) columns: Range<usize>,
}

impl Window {
    pub(crate) fn width(&self) -> usize {
        self.columns.len()
    }

    pub(crate) fn pixels(&self) -> usize {
        self.rows.len() * self.columns.len()
    }
}

/// Values and masks of the pixels of a window, which a reader fills.
#[derive(Debug)]
pub(crate) struct Pixels<'p> {
    pub(crate) values: &'p mut [f32],
    /// One mask a pixel.
    pub(crate) mask: &'p mut [Mask],
}

impl<'p> Pixels<'p> {
    /// The rows of a window, each with its line, so that all threads can fill them.
    pub(crate) fn rows(
        self,
        window: &Window,
        bands: usize,
    ) -> impl IndexedParallelIterator<Item = (usize, Pixels<'p>)> {
        let width = window.width().max(1);
        let values = self.values.par_chunks_mut((width * bands).max(1));
        let rows = values.zip(self.mask.par_chunks_mut(width)).zip(window.rows.clone());
        rows.map(|((values, mask), line)| (line, Pixels { values, mask }))
    }

    /// Splits this into the first `rows` rows and the rest.
    #[cfg(feature = "files")]
    pub(crate) fn split(self, window: &Window, bands: usize, rows: usize) -> (Self, Self) {
        let pixels = rows * window.width();
        let (values, more_values) = self.values.split_at_mut(pixels * bands);
        let (mask, more_mask) = self.mask.split_at_mut(pixels);
        (Pixels { values, mask }, Pixels { values: more_values, mask: more_mask })
    }
}

/// Raw values of a cube, lines x samples x bands numbers as the file stores them.
pub(crate) trait Source: Debug + Send + Sync {
    /// Fills `pixels` with the values of `bands` (indices in the file) for the pixels of `window`.
    /// After reading a row, this converts it by `conversion`. The window and the bands must lie
    /// inside the cube.
    fn read(
        &self,
        window: &Window,
        bands: &[usize],
        conversion: &Conversion,
        pixels: Pixels<'_>,
    ) -> Result<(), CubeError>;

    /// Bytes of memory that you need beside the values to read a window of `rows` x `columns`.
    fn scratch_bytes(&self, rows: usize, columns: usize) -> usize;

    /// Number of rows that are stored together, for example in a chunk. It is best to read them at
    /// once.
    fn natural_rows(&self) -> usize {
        1
    }

    /// Value at which a detector saturates, if the type of the numbers shows this.
    fn full_scale(&self) -> Option<f64> {
        None
    }

    /// Refuses values of a file that was changed or removed since it was opened.
    #[cfg(feature = "files")]
    fn check_unchanged(&self) -> Result<(), CubeError> {
        Ok(())
    }
}

/// We map pixels from this reflectance on, because of the noise around black.
pub const LEAST_REFLECTANCE: f32 = -0.1;
/// We map pixels up to this reflectance, because of a little gloss on white.
pub const GREATEST_REFLECTANCE: f32 = 1.2;

/// Numbers that turn raw values into reflectance: (raw - dark) x gain.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Terms {
    /// One gain for all values without a dark.
    One(f32),
    /// A dark and a gain for each band of each column, column after column. If there is only one
    /// column, it counts for all.
    Columns { dark: Vec<f32>, gain: Vec<f32> },
}

/// How raw values become reflectance.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Conversion {
    /// Raw value that marks a pixel without data. If this is NaN, only NaN marks such a pixel.
    pub(crate) ignore: Option<f32>,
    /// From this raw value on the detector is saturated.
    pub(crate) saturated: Option<f32>,
    pub(crate) terms: Terms,
}

/// Facts about the values of a pixel that decide its mask.
#[derive(Debug, Clone, Copy, Default)]
struct Signs {
    ignored: bool,
    saturated: bool,
    outside: bool,
}

impl Conversion {
    /// A conversion that leaves values as the file stores them.
    pub(crate) fn none() -> Self {
        Self { ignore: None, saturated: None, terms: Terms::One(1.0) }
    }

    /// Converts a row of raw values that starts at `column`.
    pub(crate) fn row(&self, column: usize, values: &mut [f32], mask: &mut [Mask]) {
        let bands = (values.len() / mask.len().max(1)).max(1);
        for (at, (pixel, mask)) in values.chunks_exact_mut(bands).zip(mask).enumerate() {
            *mask = self.pixel(column + at, pixel);
        }
    }

    /// Converts the raw values of the pixel in `column`. Returns whether it can be mapped.
    pub(crate) fn pixel(&self, column: usize, values: &mut [f32]) -> Mask {
        let signs = match &self.terms {
            Terms::One(gain) => {
                let gain = *gain;
                self.each(values.iter_mut().map(|value| (value, 0.0, gain)))
            }
            Terms::Columns { dark, gain } => {
                let bands = values.len();
                let start = if dark.len() == bands { 0 } else { column * bands };
                let dark = &dark[start..start + bands];
                let gain = &gain[start..start + bands];
                let terms = values.iter_mut().zip(dark.iter().zip(gain));
                self.each(terms.map(|(value, (dark, gain))| (value, *dark, *gain)))
            }
        };
        let ignores_nan = self.ignore.is_some_and(f32::is_nan);
        let is_finite = !signs.outside || values.iter().all(|value| value.is_finite());
        match signs {
            _ if signs.ignored || (ignores_nan && !is_finite) => Mask::Ignored,
            _ if !is_finite => Mask::NotFinite,
            _ if signs.saturated => Mask::Saturated,
            _ if signs.outside => Mask::OutOfRange,
            _ => Mask::Mapped,
        }
    }

    #[inline]
    fn each<'v>(&self, values: impl Iterator<Item = (&'v mut f32, f32, f32)>) -> Signs {
        let ignore = self.ignore.unwrap_or(f32::NAN);
        let full = self.saturated.unwrap_or(f32::INFINITY);
        let mut signs = Signs::default();
        for (value, dark, gain) in values {
            let raw = *value;
            let reflectance = (raw - dark) * gain;
            signs.ignored |= raw == ignore;
            signs.saturated |= raw >= full;
            // Also true for NaN.
            let is_inside = (LEAST_REFLECTANCE..=GREATEST_REFLECTANCE).contains(&reflectance);
            signs.outside |= !is_inside;
            *value = reflectance;
        }
        signs
    }

    /// The conversion of some bands only. `chosen` are indices into the `all` bands so far.
    pub(crate) fn of_bands(&self, chosen: &[usize], all: usize) -> Self {
        let terms = match &self.terms {
            Terms::One(gain) => Terms::One(*gain),
            Terms::Columns { dark, gain } => {
                let [dark, gain] = [dark, gain].map(|terms| {
                    let columns = terms.chunks_exact(all);
                    columns.flat_map(|column| chosen.iter().map(|&band| column[band])).collect()
                });
                Terms::Columns { dark, gain }
            }
        };
        Self { terms, ..self.clone() }
    }
}

/// Reflectances of a rectangle of pixels.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Block {
    /// Rows of the cube that the block holds.
    pub rows: Range<usize>,
    /// Columns of the cube that the block holds.
    pub columns: Range<usize>,
    /// Number of bands.
    pub bands: usize,
    /// Reflectance factors (a white is 1), pixel after pixel: row, column, band.
    pub values: Vec<f32>,
    /// Whether each pixel can be mapped, or why not.
    pub mask: Vec<Mask>,
}

impl Block {
    /// Number of pixels.
    #[must_use]
    pub fn pixels(&self) -> usize {
        self.mask.len()
    }

    /// Reflectances of a pixel, by its place in the block.
    ///
    /// # Panics
    /// If the block has no such pixel.
    #[must_use]
    pub fn pixel(&self, index: usize) -> &[f32] {
        &self.values[index * self.bands..(index + 1) * self.bands]
    }

    /// Reflectances and masks of all pixels in order.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = (&[f32], Mask)> {
        self.values.chunks_exact(self.bands.max(1)).zip(self.mask.iter().copied())
    }
}

/// How raw values become reflectance, as far as the file states this.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Values {
    /// The file does not state it. `are_whole` says whether its numbers are integers.
    Unknown { are_whole: bool },
    /// Reflectance is the value divided by this number.
    Divided(f64),
    /// Reflectance is the value times the first number plus the second, for each band.
    Gains(Vec<(f64, f64)>),
    /// Counts or radiance, which need a white reading.
    Counts,
}

/// A scan before we interpret its values.
#[derive(Debug)]
pub(crate) struct Opened {
    pub(crate) path: PathBuf,
    pub(crate) lines: usize,
    pub(crate) samples: usize,
    pub(crate) bands: usize,
    /// One wavelength for each band, or `None` if the file has none.
    pub(crate) wavelengths_nm: Option<Vec<f64>>,
    /// Full width at half maximum of each band, if known.
    pub(crate) fwhm_nm: Option<Vec<f64>>,
    pub(crate) good: Vec<bool>,
    /// Value that marks pixels without data.
    pub(crate) ignore: Option<f64>,
    pub(crate) values: Values,
    /// Texts of the file on its values, each with the name of its key.
    pub(crate) told: Vec<(String, String)>,
    pub(crate) integration_time: Option<f64>,
    pub(crate) remarks: Vec<Remark>,
    pub(crate) source: Box<dyn Source>,
}

#[cfg(test)]
mod tests {
    use super::*;

    fn conversion(terms: Terms) -> Conversion {
        Conversion { ignore: Some(-999.0), saturated: Some(4095.0), terms }
    }

    #[test]
    fn every_reason_is_told() {
        let conversion = conversion(Terms::One(1e-4));
        for (raw, mask) in [
            ([5000.0, 100.0], Mask::Saturated),
            ([4000.0, 100.0], Mask::Mapped),
            ([-999.0, 100.0], Mask::Ignored),
            ([-1500.0, 100.0], Mask::OutOfRange),
            ([f32::NAN, 100.0], Mask::NotFinite),
            ([f32::INFINITY, 100.0], Mask::NotFinite),
            ([-999.0, f32::NAN], Mask::Ignored),
        ] {
            let mut values = raw;
            assert_eq!(conversion.pixel(3, &mut values), mask, "{raw:?}");
        }
        let nan = Conversion { ignore: Some(f32::NAN), ..conversion };
        assert_eq!(nan.pixel(0, &mut [f32::NAN, 1.0]), Mask::Ignored, "NaN marks no data");
    }

    #[test]
    fn each_column_has_its_dark_and_gain() {
        let dark = vec![10.0, 20.0, 30.0, 40.0];
        let gain = vec![1.0 / 64.0, 1.0 / 32.0, 1.0 / 128.0, 1.0 / 1024.0];
        let conversion = conversion(Terms::Columns { dark, gain });
        let mut values = [42.0, 28.0];
        assert_eq!(conversion.pixel(0, &mut values), Mask::Mapped);
        assert_eq!(values, [0.5, 0.25]);
        let mut values = [94.0, 552.0];
        assert_eq!(conversion.pixel(1, &mut values), Mask::Mapped);
        assert_eq!(values, [0.5, 0.5]);
        let second = conversion.of_bands(&[1], 2);
        let mut values = [552.0];
        second.pixel(1, &mut values);
        assert_eq!(values, [0.5], "the second band of the second column");
    }
}
