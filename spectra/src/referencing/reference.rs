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

use super::error::ReferencingError;
use super::integration_time::{integration_time_ms, is_equal};
use super::reading::{Reading, dark_noise};
use super::saturation::ceiling;
use super::tile::{Dark, Tile, VISIBLE_NM, irregular};
use crate::instrument::{MeasuredQuantity, MeasuredSpectrum, Role, Unit};

/// The white must exceed its dark by this many standard deviations of the dark's noise
/// (the usual limit of detection).
const NOISE_MULTIPLE: f64 = 3.0;

/// Negative reflectance down to minus this value counts as noise and becomes 0 (chosen by
/// eye).
const NEGATIVE_NOISE: f64 = 0.01;

/// Default of [`Referencing::least_light`].
pub(super) const LEAST_LIGHT: f64 = 0.01;

/// A reference measurement: everything that turns the counts of a sample into reflectance.
#[derive(Debug, Clone, PartialEq)]
pub struct Referencing {
    /// Reading of the white under the lamp and geometry of the sample.
    pub white: MeasuredSpectrum,
    /// The detector's signal without light.
    pub dark: Dark,
    /// Reflectance of the white itself.
    pub tile: Tile,
    /// Largest count of the detector; `None` to estimate it from the readings.
    pub full_scale: Option<f64>,
    /// Least light of the white at every wavelength, as a fraction of its peak (default
    /// 0.01). A larger value turns noisy ends into an error instead of noisy reflectance.
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

    /// The reflectances of the samples among `spectra`, the spectra of one file: readings of
    /// the white or the dark, and spectra that the instrument's program computed from
    /// counts in the same file, are skipped. If nothing else is left, all are samples.
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
        let is_reference = |spectrum: &MeasuredSpectrum| {
            matches!(spectrum.role, Role::White | Role::Dark)
                || *spectrum == self.white
                || self.darks().is_some_and(|darks| darks.contains(spectrum))
        };
        let has_counts = spectra.iter().any(|spectrum| spectrum.role == Role::Sample);
        let is_sample = |spectrum: &&MeasuredSpectrum| {
            if has_counts { spectrum.role == Role::Sample } else { !is_reference(spectrum) }
        };
        let samples: Vec<&MeasuredSpectrum> = spectra.iter().filter(is_sample).collect();
        if samples.is_empty() { spectra.iter().collect() } else { samples }
    }

    /// The reflectance of `sample` at its own wavelengths, as a fraction. White and
    /// dark, which hold the lines of the lamp, are interpolated linearly, a measured tile by a spline. The remarks of the result name every assumption.
    ///
    /// # Errors
    /// [`ReferencingError`] for readings that do not belong together, and for too much or
    /// too little light from 380 to 730 nm. Outside that band such wavelengths are left out.
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
        let at = |nm: f64| {
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
        };
        let band = sound_band(sample, at)?;
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
            details,
            remarks,
        })
    }

    /// The dark readings, `None` if the dark is already subtracted.
    fn darks(&self) -> Option<&[MeasuredSpectrum]> {
        match &self.dark {
            Dark::Readings(darks) => Some(darks),
            Dark::Subtracted => None,
        }
    }

    fn check_quantities(&self, sample: &MeasuredSpectrum) -> Result<(), ReferencingError> {
        use MeasuredQuantity::{Counts, Power, Unstated};
        let darks = self.darks().unwrap_or_default();
        let others =
            std::iter::once(("white", &self.white)).chain(darks.iter().map(|d| ("dark", d)));
        for (role, reading) in std::iter::once(("sample", sample)).chain(others) {
            let name = reading.name.clone();
            let found = reading.quantity;
            if !matches!(reading.quantity, Counts | Power | Unstated) {
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
        let of = |spectrum: &MeasuredSpectrum| {
            irregular(spectrum.wavelengths_nm.clone(), spectrum.values.clone())
        };
        let counted = reading.quantity != MeasuredQuantity::Power || self.full_scale.is_some();
        let ceiling = if counted { ceiling(&reading.values, self.full_scale) } else { None };
        Ok(Reading { role, spectrum: reading, signal: of(reading), dark: dark.map(of), ceiling })
    }

    /// The dark reading for `reading`: the one of its integration time.
    fn dark_of(
        &self,
        role: &'static str,
        reading: &MeasuredSpectrum,
    ) -> Result<Option<&MeasuredSpectrum>, ReferencingError> {
        let name = || reading.name.clone();
        let darks = match self.darks() {
            None => return Ok(None),
            Some([]) if reading.quantity == MeasuredQuantity::Counts => {
                return Err(ReferencingError::NoDark { role, name: name() });
            }
            Some(darks) => darks,
        };
        let times: Vec<Option<f64>> = darks.iter().map(integration_time_ms).collect();
        match (integration_time_ms(reading), darks) {
            (_, []) => Ok(None),
            (None, [one]) => Ok(Some(one)),
            (None, _) => {
                Err(ReferencingError::UnknownTime { role, name: name(), darks: darks.len() })
            }
            (Some(_), [one]) if times[0].is_none() => Ok(Some(one)),
            (Some(time_ms), _) => {
                let fits = |time: &Option<f64>| time.is_some_and(|time| is_equal(time, time_ms));
                let found = times.iter().flatten().map(|time| format!("{time} ms"));
                let index = times.iter().position(fits).ok_or_else(|| {
                    let found = found.collect::<Vec<_>>().join(", ");
                    ReferencingError::DarkTime { role, name: name(), time_ms, found }
                })?;
                Ok(Some(&darks[index]))
            }
        }
    }

    /// Factor that brings the sample's counts to the integration time of the white.
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

/// The reflectance of a sample at the wavelengths where it can be computed.
struct SoundBand {
    nm: Vec<f64>,
    reflectance: Vec<f64>,
    /// Remark on the wavelengths that were left out.
    left_out: Option<String>,
}

/// Evaluates the reflectance `at` the visible wavelengths of `sample`, and at those on
/// either side up to the first that fails.
fn sound_band(
    sample: &MeasuredSpectrum,
    at: impl Fn(f64) -> Result<f64, ReferencingError>,
) -> Result<SoundBand, ReferencingError> {
    let all = &sample.wavelengths_nm;
    let first = all.partition_point(|nm| nm < VISIBLE_NM.start());
    let end = all.partition_point(|nm| nm <= VISIBLE_NM.end());
    if first == end {
        return Err(ReferencingError::Invisible { name: sample.name.clone() });
    }
    let visible = all[first..end].iter().map(|&nm| at(nm));
    let mut reflectance = visible.collect::<Result<Vec<f64>, _>>()?;
    let mut below: Vec<f64> = all[..first].iter().rev().map_while(|&nm| at(nm).ok()).collect();
    below.reverse();
    let start = first - below.len();
    reflectance.splice(..0, below);
    reflectance.extend(all[end..].iter().map_while(|&nm| at(nm).ok()));
    let end = start + reflectance.len();
    let reason = |nm: Option<&f64>| Some(at(*nm?).err()?.to_string());
    let below = start.checked_sub(1).and_then(|last| reason(all.get(last)));
    let left: Vec<String> = below.into_iter().chain(reason(all.get(end))).collect();
    let left_out = (!left.is_empty())
        .then(|| format!("kept from {} to {} nm: {}", all[start], all[end - 1], left.join("; ")));
    Ok(SoundBand { nm: all[start..end].to_vec(), reflectance, left_out })
}
