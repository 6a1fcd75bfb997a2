//! Reflectance from the counts of a sample, of a white, and of the dark.
//!
//! ```text
//! R = R_tile (S - D_S) / t_S / ((W - D_W) / t_W)
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | S, W, D | sample, white, dark | counts, or power |
//! | R_tile | reflectance of the white itself | fraction |
//! | t | integration time | ms |
//!
//! Baxter, Wendt and Lin 2004 measured their paints in this way, with a Fluorilon tile as
//! white.

mod files;

use std::ops::RangeInclusive;

use documents::hint::Explain;

use crate::instrument::{MeasuredQuantity, MeasuredSpectrum, Role, Unit};
use crate::interpolate::Extrapolation;
use crate::spectrum::{IrregularSpectrum, SmoothCurve};

pub use files::{DarkFiles, OpenedReferences, ReferenceFiles, ReferenceFilesError, TileSource};

/// The white must exceed its dark by this many standard deviations of the dark's noise. This is the
/// usual limit of detection.
const NOISE_MULTIPLE: f64 = 3.0;

/// We take negative reflectance down to minus this value for noise and set it to 0 (chosen by eye).
const NEGATIVE_NOISE: f64 = 0.01;

/// Default of [`Referencing::least_light`].
const LEAST_LIGHT: f64 = 0.01;

/// A reference measurement: everything that turns the counts of a sample into reflectance.
#[derive(Debug, Clone, PartialEq)]
pub struct Referencing {
    /// Reading of the white under the lamp and geometry of the sample.
    pub white: MeasuredSpectrum,
    /// The detector's signal without light.
    pub dark: Dark,
    /// Reflectance of the white itself.
    pub tile: Tile,
    /// Largest count of the detector. `None` to estimate it from the readings.
    pub full_scale: Option<f64>,
    /// Least light of the white at every wavelength, as a fraction of its peak (default 0.01). If
    /// you pass a larger value, noisy ends give an error instead of noisy reflectance.
    pub least_light: f64,
}

impl Referencing {
    /// A reference measurement with a tile that reflects everything, a full scale
    /// estimated from the readings, and the default [`Referencing::least_light`].
    #[must_use]
    pub fn new(white: MeasuredSpectrum, dark: Dark) -> Self {
        let tile = Tile::Even(1.0);
        let full_scale = None;
        let least_light = LEAST_LIGHT;
        Self { white, dark, tile, full_scale, least_light }
    }

    /// The reflectances of the samples among `spectra`, the spectra of one file. This skips
    /// readings of the white or the dark, and spectra that the instrument's program computed from
    /// counts in the same file. If nothing else is left, all are samples.
    ///
    /// # Errors
    /// [`ReferencingError`] in the cases of [`Referencing::reflectance`].
    pub fn reflectances(
        &self,
        spectra: &[MeasuredSpectrum],
    ) -> Result<Vec<MeasuredSpectrum>, ReferencingError> {
        self.samples(spectra).into_iter().map(|sample| self.reflectance(sample)).collect()
    }

    fn samples<'a>(&self, spectra: &'a [MeasuredSpectrum]) -> Vec<&'a MeasuredSpectrum> {
        let has_counts = spectra.iter().any(|spectrum| spectrum.role == Role::Sample);
        let samples: Vec<&MeasuredSpectrum> = spectra
            .iter()
            .filter(|spectrum| match spectrum.role {
                role if has_counts => role == Role::Sample,
                Role::White | Role::Dark => false,
                _ => {
                    **spectrum != self.white
                        && !self.darks().is_some_and(|darks| darks.contains(spectrum))
                }
            })
            .collect();
        if samples.is_empty() { spectra.iter().collect() } else { samples }
    }

    /// The reflectance of `sample` at its own wavelengths, as a fraction. We interpolate white and
    /// dark linearly, because they hold the lines of the lamp, and a measured tile by a spline. The
    /// remarks of the result name every assumption.
    ///
    /// # Errors
    /// [`ReferencingError`] if the readings do not belong together, or have too much or too little
    /// light from 380 to 730 nm. Outside this band we leave such wavelengths out.
    pub fn reflectance(
        &self,
        sample: &MeasuredSpectrum,
    ) -> Result<MeasuredSpectrum, ReferencingError> {
        let mut remarks = sample.remarks.clone();
        self.check_quantities(sample)?;
        let sample_reading = self.reading("sample", sample)?;
        let white = self.reading("white", &self.white)?;
        let scale = self.time_scale(sample, &mut remarks);
        if self.darks().is_some_and(<[_]>::is_empty) {
            remarks.push("no dark was subtracted".to_owned());
        }
        let least = self.least_signal(&white);
        let tile_curve = self.tile.curve();
        let band = sound_band(sample, |nm: f64| {
            let light = white.at(nm)?;
            if light <= least {
                let name = self.white.name.clone();
                return Err(ReferencingError::Dim { name, nm, light, least });
            }
            let tile = tile_curve.at(nm).ok_or(ReferencingError::Uncovered { role: "tile", nm })?;
            let reflectance = tile * scale * sample_reading.at(nm)? / light;
            if reflectance < -NEGATIVE_NOISE {
                let name = sample.name.clone();
                return Err(ReferencingError::BelowDark { name, nm, reflectance });
            }
            Ok(reflectance.max(0.0))
        })?;
        if let Some(remark) = band.left_out {
            remarks.push(remark);
        }
        let mut details = sample.details.clone();
        details.push(("White".to_owned(), self.white.name.clone()));
        Ok(MeasuredSpectrum {
            name: sample.name.clone(),
            quantity: MeasuredQuantity::Reflectance,
            role: Role::Main,
            unit: Unit::Fraction,
            wavelengths_nm: band.nm,
            values: band.reflectance,
            line: sample.line,
            point_lines: Vec::new(),
            details,
            remarks,
        })
    }

    /// The dark readings, or `None` if the dark is already subtracted.
    fn darks(&self) -> Option<&[MeasuredSpectrum]> {
        match &self.dark {
            Dark::Readings(darks) => Some(darks),
            Dark::Subtracted => None,
        }
    }

    fn check_quantities(&self, sample: &MeasuredSpectrum) -> Result<(), ReferencingError> {
        use MeasuredQuantity::{Counts, Power, Unknown, Unstated};
        let darks = self.darks().unwrap_or_default();
        let others =
            std::iter::once(("white", &self.white)).chain(darks.iter().map(|d| ("dark", d)));
        for (role, reading) in std::iter::once(("sample", sample)).chain(others) {
            let name = reading.name.clone();
            let found = reading.quantity;
            if !matches!(reading.quantity, Counts | Power | Unknown | Unstated) {
                return Err(ReferencingError::Quantity { role, name, found });
            }
            if reading.quantity != sample.quantity
                && reading.quantity != Unstated
                && sample.quantity != Unstated
            {
                let expected = sample.quantity;
                return Err(ReferencingError::Mixed { role, name, expected, found });
            }
        }
        Ok(())
    }

    fn reading<'a>(
        &self,
        role: &'static str,
        reading: &'a MeasuredSpectrum,
    ) -> Result<Reading<'a>, ReferencingError> {
        let dark = self.dark_of(role, reading)?;
        let counted = reading.quantity != MeasuredQuantity::Power || self.full_scale.is_some();
        let ceiling = if counted { ceiling(&reading.values, self.full_scale) } else { None };
        Ok(Reading {
            role,
            spectrum: reading,
            signal: irregular_of(reading),
            dark: dark.map(irregular_of),
            ceiling,
        })
    }

    /// The dark reading for `reading`: the one of its integration time.
    fn dark_of(
        &self,
        role: &'static str,
        reading: &MeasuredSpectrum,
    ) -> Result<Option<&MeasuredSpectrum>, ReferencingError> {
        let darks = match self.darks() {
            None => return Ok(None),
            Some([]) if reading.quantity == MeasuredQuantity::Counts => {
                return Err(ReferencingError::NoDark { role, name: reading.name.clone() });
            }
            Some(darks) => darks,
        };
        let times: Vec<Option<f64>> = darks.iter().map(integration_time_ms).collect();
        match (integration_time_ms(reading), darks) {
            (_, []) => Ok(None),
            (None, [one]) => Ok(Some(one)),
            (None, _) => Err(ReferencingError::UnknownTime {
                role,
                name: reading.name.clone(),
                darks: darks.len(),
            }),
            (Some(_), [one]) if times[0].is_none() => Ok(Some(one)),
            (Some(time_ms), _) => {
                let found = times.iter().flatten().map(|time| format!("{time} ms"));
                let index = times
                    .iter()
                    .position(|time| time.is_some_and(|time| is_equal(time, time_ms)))
                    .ok_or_else(|| {
                        let found = found.collect::<Vec<_>>().join(", ");
                        ReferencingError::DarkTime {
                            role,
                            name: reading.name.clone(),
                            time_ms,
                            found,
                        }
                    })?;
                Ok(Some(&darks[index]))
            }
        }
    }

    /// The factor that brings the sample's counts to the integration time of the white.
    fn time_scale(&self, sample: &MeasuredSpectrum, remarks: &mut Vec<String>) -> f64 {
        // Power is already per unit of time.
        if sample.quantity == MeasuredQuantity::Power {
            return 1.0;
        }
        match (integration_time_ms(sample), integration_time_ms(&self.white)) {
            (Some(sample), Some(white)) if !is_equal(sample, white) => {
                remarks.push(format!(
                    "integrated for {sample} ms, its white for {white} ms: brought to one time"
                ));
                white / sample
            }
            (Some(_), None) | (None, Some(_)) => {
                remarks.push(
                    "only one of sample and white states its integration time: assumed to be equal"
                        .to_owned(),
                );
                1.0
            }
            _ => 1.0,
        }
    }

    /// The signal that the white, minus its dark, must exceed.
    fn least_signal(&self, white: &Reading<'_>) -> f64 {
        let lit = white.signal.wavelengths_nm().iter().filter_map(|&nm| white.at(nm).ok());
        let peak = lit.fold(0.0, f64::max);
        let noise = white.dark.as_ref().map_or(0.0, |dark| dark_noise(dark.values()));
        (self.least_light * peak).max(NOISE_MULTIPLE * noise)
    }
}

fn irregular_of(spectrum: &MeasuredSpectrum) -> IrregularSpectrum {
    irregular(spectrum.wavelengths_nm.clone(), spectrum.values.clone())
}

/// The reflectance of a sample at the wavelengths where we can compute it.
struct SoundBand {
    nm: Vec<f64>,
    reflectance: Vec<f64>,
    /// Remark on the wavelengths that we left out.
    left_out: Option<String>,
}

/// Evaluates the reflectance by `at`, first at the visible wavelengths of `sample`, then outwards
/// on either side up to the first wavelength that fails.
fn sound_band(
    sample: &MeasuredSpectrum,
    at: impl Fn(f64) -> Result<f64, ReferencingError>,
) -> Result<SoundBand, ReferencingError> {
    let all = &sample.wavelengths_nm;
    let first = all.partition_point(|nm| nm < VISIBLE_NM.start());
    let end = all.partition_point(|nm| nm <= VISIBLE_NM.end());
    if first == end {
        return Err(ReferencingError::Invisible(sample.name.clone()));
    }
    let visible = all[first..end].iter().map(|&nm| at(nm));
    let mut reflectance = visible.collect::<Result<Vec<f64>, _>>()?;
    let mut below: Vec<f64> = all[..first].iter().rev().map_while(|&nm| at(nm).ok()).collect();
    below.reverse();
    let start = first - below.len();
    reflectance.splice(..0, below);
    reflectance.extend(all[end..].iter().map_while(|&nm| at(nm).ok()));
    let end = start + reflectance.len();
    let beside = start.checked_sub(1).into_iter().chain([end]);
    let left: Vec<String> =
        beside.filter_map(|index| Some(at(*all.get(index)?).err()?.to_string())).collect();
    let left_out = (!left.is_empty())
        .then(|| format!("kept from {} to {} nm: {}", all[start], all[end - 1], left.join("; ")));
    Ok(SoundBand { nm: all[start..end].to_vec(), reflectance, left_out })
}

/// A reading of the sample or the white with its dark. We interpolate both linearly, because a
/// spline would swing next to the lines of the lamp.
struct Reading<'a> {
    /// `sample` or `white`, for errors.
    role: &'static str,
    spectrum: &'a MeasuredSpectrum,
    signal: IrregularSpectrum,
    dark: Option<IrregularSpectrum>,
    /// Counts from which on the detector is saturated.
    ceiling: Option<f64>,
}

impl Reading<'_> {
    /// Signal minus dark at `nm`, in counts or in the unit of power.
    ///
    /// # Errors
    /// [`ReferencingError`] where the detector is saturated, or outside the band of the
    /// reading or of its dark.
    fn at(&self, nm: f64) -> Result<f64, ReferencingError> {
        if let Some(ceiling) = self.ceiling.filter(|&ceiling| self.max_neighbour(nm) >= ceiling) {
            let role = self.role;
            let name = self.spectrum.name.clone();
            return Err(ReferencingError::Saturated { role, name, nm, value: ceiling });
        }
        let signal = value_at(nm, &self.signal, self.role)?;
        Ok(signal - self.dark.as_ref().map_or(Ok(0.0), |dark| value_at(nm, dark, "dark"))?)
    }

    /// The larger value of the two pixels around `nm`, or the value of the pixel at `nm`.
    fn max_neighbour(&self, nm: f64) -> f64 {
        let values = self.signal.values();
        let after = self.signal.wavelengths_nm().partition_point(|&at| at < nm);
        let exact = self.signal.wavelengths_nm().get(after) == Some(&nm);
        let before = if exact { after } else { after.saturating_sub(1) };
        values[before].max(values[after.min(values.len() - 1)])
    }
}

fn value_at(
    nm: f64,
    spectrum: &IrregularSpectrum,
    role: &'static str,
) -> Result<f64, ReferencingError> {
    let value = spectrum.at_linear(nm, Extrapolation::Refuse);
    value.map_err(|_| ReferencingError::Uncovered { role, nm })
}

/// Standard deviation of the noise in a dark reading, from the median difference between
/// neighbouring pixels. Neither a slope nor a few hot pixels disturb this.
fn dark_noise(dark: &[f64]) -> f64 {
    let mut steps: Vec<f64> = dark.windows(2).map(|pair| (pair[1] - pair[0]).abs()).collect();
    steps.sort_by(f64::total_cmp);
    // The median of |x| of a normal distribution is 0.6745 standard deviations, and the
    // difference of two values has the square root of 2 times the noise of one.
    steps.get(steps.len() / 2).map_or(0.0, |median| median / 0.6745 / 2.0_f64.sqrt())
}

/// Every value must be sound in this band in nm. Outside it we leave unsound values out.
const VISIBLE_NM: RangeInclusive<f64> = 380.0..=730.0;

/// The detector's signal without light.
#[derive(Debug, Clone, PartialEq)]
pub enum Dark {
    /// Readings without light. If you give several, sample and white each use the one of their own
    /// integration time. A dark signal is an offset plus a current, so it does not scale with time.
    Readings(Vec<MeasuredSpectrum>),
    /// The dark is already subtracted from sample and white.
    Subtracted,
}

/// The reflectance of the white itself.
#[derive(Debug, Clone, PartialEq)]
pub enum Tile {
    /// One fraction (0 to 1) for all wavelengths.
    Even(f64),
    /// Measured reflectance as a fraction.
    Measured(IrregularSpectrum),
}

/// A tile in percent that reflects no more than this fraction was written as fractions.
const LEAST_TILE: f64 = 0.012;

impl Tile {
    /// A tile that reflects the fraction `value` at every wavelength.
    ///
    /// # Errors
    /// [`ReferencingError::Tile`] unless above 0 and at most 1.2 (a reflectance factor may
    /// exceed 1).
    pub fn even(value: f64) -> Result<Self, ReferencingError> {
        if value > 0.0 && value <= 1.2 {
            Ok(Self::Even(value))
        } else {
            Err(ReferencingError::Tile(value))
        }
    }

    /// A tile of measured reflectance, in percent or as a fraction
    /// ([`MeasuredSpectrum::is_percent`]).
    ///
    /// # Errors
    /// [`ReferencingError`] if the spectrum is not a reflectance, or is not above 0 and at
    /// most 1.2 from 380 to 730 nm.
    pub fn measured(spectrum: &MeasuredSpectrum) -> Result<Self, ReferencingError> {
        use MeasuredQuantity::{Reflectance, Unstated};
        if !matches!(spectrum.quantity, Reflectance | Unstated) {
            let name = spectrum.name.clone();
            let found = spectrum.quantity;
            return Err(ReferencingError::TileQuantity { name, found });
        }
        let scale = if spectrum.is_percent() { 0.01 } else { 1.0 };
        let values: Vec<f64> = spectrum.values.iter().map(|value| value * scale).collect();
        let largest = values.iter().copied().fold(0.0, f64::max);
        if spectrum.is_percent() && largest <= LEAST_TILE {
            let name = spectrum.name.clone();
            return Err(ReferencingError::DarkTile { name, percent: 100.0 * largest });
        }
        for (&value, nm) in values.iter().zip(&spectrum.wavelengths_nm) {
            if VISIBLE_NM.contains(nm) {
                Self::even(value)?;
            }
        }
        Ok(Self::Measured(irregular(spectrum.wavelengths_nm.clone(), values)))
    }

    /// Prepares the tile for interpolation.
    fn curve(&self) -> TileCurve<'_> {
        match self {
            Self::Even(value) => TileCurve::Even(*value),
            Self::Measured(spectrum) => TileCurve::Measured(spectrum.smooth_curve()),
        }
    }
}

/// The reflectance of a white over wavelength.
enum TileCurve<'a> {
    Even(f64),
    Measured(SmoothCurve<'a>),
}

impl TileCurve<'_> {
    /// Reflectance at `nm` as a fraction. `None` outside the measured band.
    fn at(&self, nm: f64) -> Option<f64> {
        match self {
            Self::Even(value) => Some(*value),
            Self::Measured(curve) => curve.at(nm),
        }
    }
}

fn irregular(wavelengths_nm: Vec<f64>, values: Vec<f64>) -> IrregularSpectrum {
    IrregularSpectrum::new(wavelengths_nm, values)
        .expect("a measured spectrum has rising wavelengths with one value each")
}

/// The integration time in ms from a detail, for example
/// `Integration Time (usec): 24000 (JAZA1479)` or `Integration time: 100.00 ms`. You get `None` if
/// no detail states one with a unit.
#[must_use]
pub fn integration_time_ms(record: &MeasuredSpectrum) -> Option<f64> {
    record.details.iter().find_map(|(key, value)| {
        let key = key.to_lowercase();
        let (_, after) = key.split_once("integration time")?;
        let value = value.trim().to_lowercase();
        let number = value.split_whitespace().next()?;
        // The unit follows the keyword or the number, or is attached to the number.
        let digits = number.trim_end_matches(|c: char| c.is_alphabetic() || c == '\u{b5}');
        let behind = value.split_whitespace().nth(1).unwrap_or_default();
        let units =
            [after.trim_matches(|c: char| !c.is_alphanumeric()), &number[digits.len()..], behind];
        let scale = units.into_iter().find_map(unit_ms)?;
        let time = digits.replace(',', ".").parse::<f64>().ok()? * scale;
        (time.is_finite() && time > 0.0).then_some(time)
    })
}

fn unit_ms(word: &str) -> Option<f64> {
    match word {
        "usec" | "us" | "\u{b5}s" | "\u{3bc}s" | "microseconds" => Some(1e-3),
        "msec" | "ms" | "milliseconds" => Some(1.0),
        "sec" | "s" | "seconds" => Some(1e3),
        _ => None,
    }
}

/// Whether two times agree to one part in a thousand.
fn is_equal(a_ms: f64, b_ms: f64) -> bool {
    (a_ms - b_ms).abs() <= 1e-3 * a_ms.max(b_ms)
}

/// Largest counts of converters of 12, 14 and 16 bits.
const FULL_SCALES: [f64; 3] = [4095.0, 16383.0, 65535.0];

/// If this many neighbouring pixels have exactly the maximum, we call it saturation rather than a
/// peak (chosen by eye).
const PLATEAU: usize = 4;

/// The count from which on the detector is saturated, or `None` if nothing is. This is the full
/// scale if you give it and it is reached. Otherwise it is the maximum, if a converter ends there
/// or several neighbours have it.
fn ceiling(counts: &[f64], full_scale: Option<f64>) -> Option<f64> {
    let most = counts.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    if let Some(full) = full_scale {
        return (most >= full).then_some(full);
    }
    let flat = counts.chunk_by(|a, b| a == b).any(|run| run[0] == most && run.len() >= PLATEAU);
    // A reading of zeros is flat, but not saturated.
    (most > 0.0 && (flat || FULL_SCALES.contains(&most))).then_some(most)
}

/// Why readings of sample, white and dark do not give a reflectance.
#[derive(Debug, Clone, PartialEq, thiserror::Error, Explain)]
pub enum ReferencingError {
    /// A reading is neither counts nor power.
    #[error("the {role} `{name}` must be counts or power to be referenced, found `{found}`")]
    #[hint(
        "export the raw counts, or leave [white_reading] and [dark_reading] out: reflectance needs neither"
    )]
    Quantity {
        /// `sample`, `white` or `dark`.
        role: &'static str,
        /// Name of the reading.
        name: String,
        /// Quantity of the reading.
        found: MeasuredQuantity,
    },
    /// The spectrum of the tile holds another quantity than a reflectance.
    #[error("the tile `{name}` must be a reflectance, found `{found}`")]
    #[hint("give a fraction, such as [tile=0.99], or a file of its reflectance")]
    TileQuantity {
        /// Name of the tile's spectrum.
        name: String,
        /// Quantity of the spectrum.
        found: MeasuredQuantity,
    },
    /// The file states percent, but holds fractions.
    #[error("the tile `{name}` is stated in percent and reflects at most {percent:.3} %")]
    #[hint(
        "its values are fractions: take the percent sign out of its heading, or give a fraction, such as [tile=0.99]"
    )]
    DarkTile {
        /// Name of the tile's spectrum.
        name: String,
        /// Its largest reflectance in percent.
        percent: f64,
    },
    /// Counts and power are mixed.
    #[error("the {role} `{name}` must be {expected} like the sample, found `{found}`")]
    #[hint("export sample, white and dark the same way")]
    Mixed {
        /// `white` or `dark`.
        role: &'static str,
        /// Name of the reading.
        name: String,
        /// Quantity of the sample.
        expected: MeasuredQuantity,
        /// Quantity of the reading.
        found: MeasuredQuantity,
    },
    /// The dark is missing. Counts need one, because they contain the detector's signal without
    /// light.
    #[error("counts of the {role} `{name}` need a dark reading")]
    #[hint(
        "add [dark_reading=FILE] (the same integration time, light shut off), or [dark_reading=0] if the dark is subtracted already"
    )]
    NoDark {
        /// `sample` or `white`.
        role: &'static str,
        /// Name of the reading.
        name: String,
    },
    /// No dark was taken at the integration time of the reading.
    #[error(
        "the {role} `{name}` was integrated for {time_ms} ms, but no dark was; found `{found}`"
    )]
    #[hint(
        "a dark does not scale with time: take one at each integration time and give [dark_reading] for each"
    )]
    DarkTime {
        /// `sample` or `white`.
        role: &'static str,
        /// Name of the reading.
        name: String,
        /// Integration time of the reading in ms.
        time_ms: f64,
        /// Integration times of the darks, as text.
        found: String,
    },
    /// There are several darks, and the reading does not state its integration time.
    #[error("cannot select one of {darks} darks for the {role}: no integration time in `{name}`")]
    #[hint(
        "a dark does not scale with time: take one at each integration time and give [dark_reading] for each"
    )]
    UnknownTime {
        /// `sample` or `white`.
        role: &'static str,
        /// Name of the reading.
        name: String,
        /// Number of darks.
        darks: usize,
    },
    /// The detector is saturated.
    #[error("the {role} `{name}` is saturated at {nm} nm, at `{value}`")]
    #[hint(
        "measure again with a shorter integration time; if the detector was not saturated, give its largest count with [full_scale]"
    )]
    Saturated {
        /// `sample` or `white`.
        role: &'static str,
        /// Name of the reading.
        name: String,
        /// Wavelength in nm.
        nm: f64,
        /// Value at which the detector saturates.
        value: f64,
    },
    /// The white has too little light to divide by.
    #[error(
        "the white `{name}` has too little light at {nm} nm: expected {least:.4} above its dark, found `{light:.4}`"
    )]
    #[hint("measure with more light there or a longer integration time, or lower [least_light]")]
    Dim {
        /// Name of the white.
        name: String,
        /// Wavelength in nm.
        nm: f64,
        /// Signal of the white minus its dark.
        light: f64,
        /// The signal that it must exceed.
        least: f64,
    },
    /// A reading does not cover a wavelength of the sample.
    #[error("the {role} has no value at `{nm}` nm, where the sample has one")]
    #[hint("measure over all wavelengths of the sample")]
    Uncovered {
        /// `white`, `dark` or `tile`.
        role: &'static str,
        /// Wavelength in nm.
        nm: f64,
    },
    /// The sample is darker than its dark by more than noise.
    #[error("the sample `{name}` reads below its dark at {nm} nm: reflectance `{reflectance}`")]
    #[hint("check that sample and dark were not interchanged")]
    BelowDark {
        /// Name of the sample.
        name: String,
        /// Wavelength in nm.
        nm: f64,
        /// The negative reflectance that results.
        reflectance: f64,
    },
    /// The sample has no visible wavelength.
    #[error("the sample `{0}` has no wavelength from 380 to 730 nm")]
    Invisible(String),
    /// The white's own reflectance is out of range.
    #[error("the tile's reflectance must be above 0 and at most 1.2, found `{0}`")]
    #[hint("give a fraction, such as [tile=0.99], or a file of its reflectance")]
    Tile(f64),
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::instrument::{MeasuredQuantity, Role, Unit};

    #[test]
    fn a_tile_that_is_stated_in_percent_and_holds_fractions_is_refused() {
        let text = b"nm\tReflectance[%]\n400\t0.99\n500\t0.98\n700\t0.99\n";
        let tile = crate::instrument::read("tile", text, None).unwrap().spectra.remove(0);
        let refused = Tile::measured(&tile).unwrap_err();
        assert!(matches!(refused, ReferencingError::DarkTile { .. }), "{refused}");
        let values = tile.values.iter().map(|value| 100.0 * value).collect();
        assert!(Tile::measured(&MeasuredSpectrum { values, ..tile }).is_ok());
    }

    #[test]
    fn integration_times_of_several_makers_are_parsed() {
        for (key, value, ms) in [
            ("Integration Time (usec)", "24000 (JAZA1479)", Some(24.0)),
            ("Integration Time (sec)", "2.000000E-2", Some(20.0)),
            ("Integration time", "100.00 ms", Some(100.0)),
            ("Integration time", "8,5ms", Some(8.5)),
            ("Integration time [ms]", "7", Some(7.0)),
            ("Autoset integration time", "false", None),
            ("Integration time", "100", None),
            ("Integration Time (sec)", "-1", None),
            ("Scans", "20 ms", None),
        ] {
            let record = MeasuredSpectrum {
                name: "r".into(),
                quantity: MeasuredQuantity::Counts,
                role: Role::Main,
                unit: Unit::Unstated,
                wavelengths_nm: vec![400.0],
                values: vec![1.0],
                line: 1,
                point_lines: Vec::new(),
                details: vec![(key.to_owned(), value.to_owned())],
                remarks: Vec::new(),
            };
            assert_eq!(integration_time_ms(&record), ms, "{key}: {value}");
        }
    }

    #[test]
    fn a_converters_maximum_a_plateau_and_a_given_scale_saturate() {
        assert_eq!(ceiling(&[1.0, 65535.0, 2.0], None), Some(65535.0));
        assert_eq!(ceiling(&[1.0, 900.0, 900.0, 900.0, 900.0, 2.0], None), Some(900.0));
        assert_eq!(ceiling(&[1.0, 950.0, 900.0, 960.0], Some(940.0)), Some(940.0));
        assert_eq!(ceiling(&[1.0, 940.0, 900.0], Some(940.0)), Some(940.0), "reached");
        assert_eq!(ceiling(&[1.0, 940.0, 900.0], Some(940.1)), None, "not reached");
    }

    #[test]
    fn a_peak_does_not_saturate() {
        assert_eq!(ceiling(&[1.0, 900.0, 900.0, 900.0, 2.0], None), None);
        assert_eq!(ceiling(&[5.0, 5.0, 5.0, 5.0, 9.0], None), None);
        assert_eq!(ceiling(&[0.0; 9], None), None);
        assert_eq!(ceiling(&[1.0, 4095.0, 4094.0], Some(65535.0)), None);
    }
}
