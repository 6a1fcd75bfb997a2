//! The unit of a file, and values that are no reflectance: noise at the ends of spectra, and noisy points.

use std::ops::RangeInclusive;

use serde::{Deserialize, Serialize};
use spectra::instrument::StatedValues;

use super::error::MeasurementError;

/// Wavelengths in nm at which instruments for paint measure.
pub(super) const MEASURABLE_NM: RangeInclusive<f64> = 200.0..=2500.0;

/// A reading must be valid at these wavelengths in nm, because they determine nearly all of the colour.
/// Beyond them lamps and detectors are weak, and exported files hold noise.
pub(super) const SOUND: RangeInclusive<f64> = 400.0..=700.0;

/// We read a value above minus this fraction as 0 with noise. It comes from dark paint under little light,
/// or from a dark reading a little too high. We chose it by eye.
const NOISE_BELOW_ZERO: f64 = 0.02;

/// No surface has a greater reflectance, as a fraction. If you see a greater reading, its unit is wrong.
const LARGEST_REFLECTANCE: f64 = 2.0;

/// Values in this range may be a noisy point of a sound file, as fractions (chosen by eye). Others are
/// mistakes or values in another unit.
const NOISY: RangeInclusive<f64> = -0.1..=3.0;

/// At most one reading in so many may be left out for a noisy point.
const ONE_NOISY_IN: usize = 4;

/// Whether `fraction` may be a reflectance.
pub(super) fn is_reflectance(fraction: f64) -> bool {
    (-NOISE_BELOW_ZERO..=LARGEST_REFLECTANCE).contains(&fraction)
}

/// Whether of `all` readings those can be left out that have one of the `bad` values, as fractions, at
/// wavelengths where readings must be valid.
pub(super) fn may_be_left_out(
    all: usize,
    readings: usize,
    mut bad: impl Iterator<Item = f64>,
) -> bool {
    ONE_NOISY_IN * readings <= all && bad.all(|value| NOISY.contains(&value))
}

/// A remark on a reading that is left out. `value` is written in the unit of the file.
pub(super) fn left_out(sample: &str, row: u64, nm: f64, value: f64, scale: Scale) -> String {
    let sign = if scale == Scale::Percent { " %" } else { "" };
    format!(
        "{sample} is left out: it reads {value}{sign} at {nm} nm (row {row}), and readings are {}",
        scale.range()
    )
}

/// A remark on `count` values of a sample that count as 0.
pub(super) fn just_below_zero(sample: &str, count: usize) -> String {
    let one = "reading just below zero counts";
    let many = "readings just below zero count";
    format!("{sample}: {} as 0", documents::counted_as(count, one, many))
}

/// A remark on wavelengths that we leave out because no colour instrument measures there.
pub(super) fn outside_remark(nm: impl Iterator<Item = f64>) -> Option<String> {
    let (short, long): (Vec<f64>, Vec<f64>) =
        nm.filter(|nm| !MEASURABLE_NM.contains(nm)).partition(|nm| nm < MEASURABLE_NM.start());
    let part = |nm: &[f64]| {
        let first = nm.iter().copied().reduce(f64::min)?;
        let last = nm.iter().copied().reduce(f64::max)?;
        Some(if first == last { format!("{first}") } else { format!("{first} to {last}") })
    };
    let parts: Vec<String> = [part(&short), part(&long)].into_iter().flatten().collect();
    let cut = parts.join(" nm and ");
    (!parts.is_empty()).then(|| {
        format!(
            "readings at {cut} nm are left out; {} to {} nm are read",
            MEASURABLE_NM.start(),
            MEASURABLE_NM.end()
        )
    })
}

/// The part of a spectrum without the impossible values at its ends: indices of the first and behind the
/// last value. `invalid` are the indices of impossible values. The second list are those that no cut removes.
pub(super) fn without_ends(
    wavelengths_nm: &[f64],
    invalid: impl Iterator<Item = usize>,
) -> (std::ops::Range<usize>, Vec<usize>) {
    let mut sound = 0..wavelengths_nm.len();
    let has_middle = wavelengths_nm.iter().any(|nm| SOUND.contains(nm));
    let mut inside = Vec::new();
    for index in invalid {
        let nm = wavelengths_nm[index];
        if has_middle && nm < *SOUND.start() {
            sound.start = sound.start.max(index + 1);
        } else if has_middle && nm > *SOUND.end() {
            sound.end = sound.end.min(index);
        } else {
            inside.push(index);
        }
    }
    (sound, inside)
}

/// Unit in which a file writes reflectance.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Scale {
    /// A white reads about 100.
    Percent,
    /// A white reads about 1.
    Fraction,
}

/// How the unit of a file is determined.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ScaleChoice {
    /// By the largest value of the whole file. Above 2 we take the unit for percent.
    #[default]
    ByFile,
    /// You know the unit.
    Known(Scale),
    /// The values are another quantity, from which reflectance follows ([`StatedValues::conversion`]).
    Converted(StatedValues),
}

impl Scale {
    pub(super) fn of_largest(largest: f64) -> Self {
        if largest > 2.0 { Self::Percent } else { Self::Fraction }
    }

    pub(super) fn to_fraction(self) -> f64 {
        match self {
            Self::Percent => 0.01,
            Self::Fraction => 1.0,
        }
    }

    pub(super) fn range(self) -> &'static str {
        match self {
            Self::Percent => "from 0 to 200 %",
            Self::Fraction => "from 0 to 2",
        }
    }
}

/// Readings of a file in percent that have no value above 1. They are black, or fractions among percent.
#[derive(Debug, Default)]
pub(super) struct DarkReadings {
    all: usize,
    count: usize,
    /// Row, sample and largest value of the first.
    first: Option<(u64, String, f64)>,
}

/// If several readings, and more than one in so many, are dark, the file holds two groups, and not a
/// black patch or two.
const ONE_DARK_IN: usize = 4;

impl DarkReadings {
    /// Counts a reading. `largest` is its largest value in percent.
    pub(super) fn add(&mut self, row: u64, sample: &str, largest: f64) {
        self.all += 1;
        if largest <= 1.0 {
            self.count += 1;
            self.first.get_or_insert_with(|| (row, sample.to_owned(), largest));
        }
    }

    /// A remark on the dark readings, if there are any. Where they may be fractions, this fails.
    pub(super) fn checked(self, file: &str) -> Result<Option<String>, MeasurementError> {
        let Some((row, sample, largest)) = self.first else { return Ok(None) };
        let is_a_group = self.count > 1 || self.all < 3;
        if is_a_group && ONE_DARK_IN * self.count > self.all {
            return Err(MeasurementError::MixedScale { file: file.to_owned(), row, largest });
        }
        let others = match self.count - 1 {
            0 => String::new(),
            more => format!(", and {}", documents::counted(more, "other dark reading")),
        };
        Ok(Some(format!(
            "{sample} is read as at most {largest} %, since the file is in percent{others}"
        )))
    }
}
