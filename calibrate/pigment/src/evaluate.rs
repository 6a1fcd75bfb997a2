//! Colours and colour differences of reflectances and their summary, remarks on a result, and rounding for
//! files. You can also check whether a wavelength grid covers the visible band.

use std::fmt;

use documents::hint::{Explain, Hint};
use serde::{Deserialize, Serialize};
use spectra::color::{Lab, delta_e_ciede2000};
use spectra::{Grid, TristimulusWeights};

pub use spectra::Viewing;

/// CIELAB of a reflectance on the grid of `weights`.
#[must_use]
pub fn lab(weights: &TristimulusWeights, reflectance: &[f64]) -> Lab {
    Lab::from_xyz(weights.xyz(reflectance), weights.white())
}

/// CIEDE2000 difference of two reflectances on the grid of `weights`.
#[must_use]
pub fn delta_e(weights: &TristimulusWeights, first: &[f64], second: &[f64]) -> f64 {
    delta_e_ciede2000(lab(weights, first), lab(weights, second))
}

/// Four numbers that summarise a set of colour differences.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Summary {
    /// Arithmetic mean of the differences.
    pub mean: f64,
    /// Median of the differences.
    pub median: f64,
    /// 90th percentile of the differences.
    pub p90: f64,
    /// Largest of the differences.
    pub max: f64,
}

impl Summary {
    /// Summarises `errors`. If you pass none, every number is 0.
    #[must_use]
    pub fn of(errors: &[f64]) -> Self {
        Self {
            mean: errors.iter().sum::<f64>() / errors.len().max(1) as f64,
            median: percentile(errors, 50.0),
            p90: percentile(errors, 90.0),
            max: percentile(errors, 100.0),
        }
    }

    /// Copy rounded to six significant digits, for a file.
    #[must_use]
    pub fn rounded(&self) -> Self {
        let Self { mean, median, p90, max } = *self;
        let [mean, median, p90, max] = [mean, median, p90, max].map(rounded);
        Self { mean, median, p90, max }
    }
}

/// `percent` of `values` do not exceed this value. We interpolate linearly between order statistics
/// (Hyndman and Fan 1996, definition 7, as numpy does). You get 0 for no values.
#[must_use]
pub fn percentile(values: &[f64], percent: f64) -> f64 {
    let Some(last) = values.len().checked_sub(1) else { return 0.0 };
    let position = percent / 100.0 * last as f64;
    let below = position.floor() as usize;
    let fraction = position - below as f64;
    let mut partly_sorted = values.to_vec();
    let (_, &mut low, above) = partly_sorted.select_nth_unstable_by(below, f64::total_cmp);
    let high = above.iter().copied().min_by(f64::total_cmp).unwrap_or(low);
    low + fraction * (high - low)
}

/// Kind of a [`Remark`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RemarkKind {
    /// A choice that we made for you, or progress.
    Note,
    /// A warning about the result.
    Warning,
}

/// One sentence about a computation, for you to read.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Remark {
    /// Whether it is a note or a warning.
    pub kind: RemarkKind,
    /// The sentence. Write it in lower case and without a full stop.
    pub text: String,
    /// Advice on another choice, if a setting allows one.
    pub hint: Option<Hint>,
}

impl Remark {
    /// A note: something that was read or chosen.
    #[must_use]
    pub fn note(text: impl Into<String>) -> Self {
        Self { kind: RemarkKind::Note, text: text.into(), hint: None }
    }

    /// A warning about the result.
    #[must_use]
    pub fn warning(text: impl Into<String>) -> Self {
        Self { kind: RemarkKind::Warning, text: text.into(), hint: None }
    }

    /// The remark with a hint. Put settings in square brackets, e.g. `try [over=0.85]`.
    #[must_use]
    pub fn with_hint(self, hint: impl Into<String>) -> Self {
        Self { hint: Some(Hint::new(hint)), ..self }
    }
}

impl fmt::Display for Remark {
    /// Writes the sentence, with `warning: ` before a warning. A hint follows behind a semicolon.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.kind == RemarkKind::Warning {
            f.write_str("warning: ")?;
        }
        f.write_str(&self.text)?;
        self.hint.as_ref().map_or(Ok(()), |hint| write!(f, "; {hint}"))
    }
}

/// Rounds `value` to six significant digits. That is more than any reading carries, and few enough that you
/// get the same bytes in a file on every machine.
#[must_use]
pub fn rounded(value: f64) -> f64 {
    format!("{value:.5e}").parse().unwrap_or(value)
}

/// A grid must touch this band in nm to have a colour at all.
const NEEDED_NM: [f64; 2] = [400.0, 700.0];
/// A grid should cover this band in nm, because it holds nearly all of the luminance and chroma.
pub(crate) const WANTED_NM: [f64; 2] = [420.0, 680.0];

/// Above this step in nm a grid is too coarse for the absorption bands of most pigments. We chose it by eye.
pub(crate) const COARSE_STEP_NM: f64 = 20.0;

/// Part of the visible band that a grid covers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BandCoverage {
    /// 420 to 680 nm or more.
    Full,
    /// Only a part. We hold the end values for the rest.
    Partial,
    /// Nothing from 400 to 700 nm.
    Missing,
}

impl BandCoverage {
    /// Coverage of `grid`.
    #[must_use]
    pub fn of(grid: Grid) -> Self {
        let start = grid.start_nm();
        let end = grid.end_nm();
        if end < NEEDED_NM[0] || start > NEEDED_NM[1] {
            Self::Missing
        } else if start > WANTED_NM[0] || end < WANTED_NM[1] {
            Self::Partial
        } else {
            Self::Full
        }
    }
}

/// Checks that spectra on `grid` have colours. You get a warning if the grid covers only a part of the
/// visible band, or if its steps are coarse: above 20 nm.
///
/// # Errors
/// [`BandError`] for a grid without any visible wavelength.
pub fn check_visible_band(grid: Grid) -> Result<Option<Remark>, BandError> {
    let start_nm = grid.start_nm();
    let end_nm = grid.end_nm();
    let part = match BandCoverage::of(grid) {
        BandCoverage::Full => None,
        BandCoverage::Partial => Some(format!(
            "spectra from {start_nm} to {end_nm} nm; colours take the end values for the rest of the visible band"
        )),
        BandCoverage::Missing => return Err(BandError { start_nm, end_nm }),
    };
    let step = grid.step_nm();
    let coarse = (step > COARSE_STEP_NM).then(|| {
        format!(
            "spectra in steps of {step} nm; colours between them are a guess, measure in steps of {COARSE_STEP_NM} nm or less"
        )
    });
    let texts: Vec<String> = part.into_iter().chain(coarse).collect();
    Ok((!texts.is_empty()).then(|| Remark::warning(texts.join("; "))))
}

/// At most so many nm from 420 to 680 may be missing for the colour of a measurement.
const MOST_MISSING_NM: f64 = 65.0;

/// Checks that measured spectra on `grid` have a colour, as [`check_visible_band`] does, and that no more
/// than a quarter of 420 to 680 nm is missing.
///
/// # Errors
/// [`BandError`] for a grid of which too much is missing, such as 250 to 400 nm or 675 to 2495 nm.
pub fn check_has_color(grid: Grid) -> Result<Option<Remark>, BandError> {
    let start_nm = grid.start_nm();
    let end_nm = grid.end_nm();
    let [first, last] = WANTED_NM;
    let missing = (start_nm - first).max(0.0) + (last - end_nm).max(0.0);
    if missing > MOST_MISSING_NM {
        return Err(BandError { start_nm, end_nm });
    }
    check_visible_band(grid)
}

/// Spectra with too little of the visible band have no colour.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error, Explain)]
#[hint("measure from 400 to 700 nm or more")]
#[error("spectra from {start_nm} to {end_nm} nm have no colour")]
pub struct BandError {
    /// First wavelength of the spectra in nm.
    pub start_nm: f64,
    /// Last wavelength of the spectra in nm.
    pub end_nm: f64,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn measurements_without_most_of_the_visible_band_have_no_color() {
        for (first, last, step) in
            [(250.0, 400.0, 10.0), (675.0, 2495.0, 10.0), (642.0, 642.3, 0.1), (500.0, 700.0, 10.0)]
        {
            let refused = check_has_color(Grid::from_range(first, last, step).unwrap());
            assert_eq!(refused.unwrap_err().start_nm, first);
        }
        let most = check_has_color(Grid::from_range(450.0, 950.0, 10.0).unwrap()).unwrap();
        assert!(most.is_some_and(|remark| remark.text.contains("end values")));
        for step in [10.0, 20.0] {
            assert_eq!(check_has_color(Grid::from_range(400.0, 700.0, step).unwrap()), Ok(None));
        }
    }

    fn warning(first: f64, last: f64, step: f64) -> String {
        let found = check_visible_band(Grid::from_range(first, last, step).unwrap()).unwrap();
        found.map(|remark| remark.text).unwrap_or_default()
    }

    #[test]
    fn coarse_steps_are_a_warning() {
        assert!(warning(400.0, 700.0, 300.0).starts_with("spectra in steps of 300 nm; "));
        let both = warning(500.0, 650.0, 50.0);
        assert!(
            both.contains("end values") && both.contains("; spectra in steps of 50 nm"),
            "{both}"
        );
        assert_eq!(warning(400.0, 700.0, 20.0), "");
    }

    #[test]
    fn percentiles_are_those_of_numpy() {
        let values = [4.0, 1.0, 3.0, 2.0];
        assert_eq!(percentile(&values, 50.0), 2.5);
        assert!((percentile(&values, 90.0) - 3.7).abs() < 1e-12);
        assert_eq!(percentile(&values, 100.0), 4.0);
        assert_eq!(percentile(&[], 50.0), 0.0);
    }
}
