//! Reflectance of a sample from its light, that of a white, and the dark.
//!
//! ```text
//! R = R_tile (S - D_S) / t_S / ((W - D_W) / t_W)
//! ```
//!
//! | symbol | here | unit |
//! |---|---|---|
//! | S, W, D | sample, white, dark | counts, or power |
//! | R_tile | reflectance of the white itself | fraction |
//! | t | integration time | ms |
//!
//! So Baxter, Wendt and Lin 2004 measured their paints, with a Fluorilon tile as white.

use std::ops::RangeInclusive;

use super::error::ReferencingError;
use super::integration_time::{integration_time_ms, same};
use super::saturation::ceiling;
use crate::instrument::{MeasuredQuantity, MeasuredSpectrum, Role, Unit};
use crate::interpolate::Extrapolation;
use crate::irregular::IrregularSpectrum;

/// Where every value must be good; beyond, bad ones are left out.
const VISIBLE_NM: RangeInclusive<f64> = 380.0..=730.0;

/// A white must stand above so many standard deviations of its dark's noise.
const NOISE_MULTIPLE: f64 = 3.0;

/// A reflectance below zero by no more than this is noise, and becomes 0.
const NEGATIVE_NOISE: f64 = 0.01;

/// The detector's own signal.
#[derive(Debug, Clone, Copy)]
pub enum Dark<'a> {
    /// Readings without light. Of several, each of sample and white takes the one of its own
    /// integration time: a dark is offset and current, and does not scale.
    Readings(&'a [MeasuredSpectrum]),
    /// Subtracted already.
    Subtracted,
}

/// The reflectance of the white itself.
#[derive(Debug, Clone, PartialEq)]
pub enum Tile {
    /// The same everywhere.
    Even(f64),
    /// As measured, a fraction.
    Measured(IrregularSpectrum),
}

/// What a sample's light is set against.
#[derive(Debug, Clone)]
pub struct Referencing<'a> {
    /// The white, by the same lamp and geometry.
    pub white: &'a MeasuredSpectrum,
    /// The dark.
    pub dark: Dark<'a>,
    /// The white's own reflectance.
    pub tile: Tile,
    /// The largest count of the detector, where known; else it is guessed.
    pub full_scale: Option<f64>,
    /// The share of its peak that the white must have everywhere. More makes noisy ends an error
    /// rather than a noisy reflectance.
    pub least_light: f64,
}

impl Tile {
    /// A constant.
    ///
    /// # Errors
    /// [`ReferencingError::Tile`] unless above 0 and at most 1.2 (a reflectance factor may
    /// pass 1).
    pub fn even(value: f64) -> Result<Self, ReferencingError> {
        if value > 0.0 && value <= 1.2 {
            Ok(Self::Even(value))
        } else {
            Err(ReferencingError::Tile { value })
        }
    }

    /// A measured reflectance, percent or fraction as the record says, else percent if above 2.
    ///
    /// # Errors
    /// [`ReferencingError`] if the record is no reflectance, or is 0 or above 1.2 somewhere.
    pub fn measured(record: &MeasuredSpectrum) -> Result<Self, ReferencingError> {
        if !matches!(record.quantity, MeasuredQuantity::Reflectance | MeasuredQuantity::Unstated) {
            let (name, found) = (record.name.clone(), record.quantity);
            return Err(ReferencingError::TileQuantity { name, found });
        }
        let percent = match record.unit {
            Unit::Percent => true,
            Unit::Fraction => false,
            Unit::Unstated => record.values.iter().any(|&value| value > 2.0),
        };
        let scale = if percent { 0.01 } else { 1.0 };
        let values: Vec<f64> = record.values.iter().map(|value| value * scale).collect();
        for (&value, nm) in values.iter().zip(&record.wavelengths_nm) {
            if VISIBLE_NM.contains(nm) {
                Self::even(value)?;
            }
        }
        Ok(Self::Measured(samples(record.wavelengths_nm.clone(), values)))
    }

    fn at(&self, nm: f64) -> Option<f64> {
        match self {
            Self::Even(value) => Some(*value),
            Self::Measured(samples) => samples.at_linear(nm, Extrapolation::Refuse).ok(),
        }
    }
}

/// One reading with its dark, each at any wavelength.
struct Light<'a> {
    role: &'static str,
    record: &'a MeasuredSpectrum,
    signal: IrregularSpectrum,
    dark: Option<IrregularSpectrum>,
    ceiling: Option<f64>,
}

impl Light<'_> {
    /// The reading less its dark at `nm`.
    fn at(&self, nm: f64) -> Result<f64, ReferencingError> {
        let value = |samples: &IrregularSpectrum, role| {
            let value = samples.at_linear(nm, Extrapolation::Refuse);
            value.map_err(|_| ReferencingError::Uncovered { role, nm })
        };
        if let Some(ceiling) = self.ceiling.filter(|&ceiling| self.most_beside(nm) >= ceiling) {
            let (role, name) = (self.role, self.record.name.clone());
            return Err(ReferencingError::Saturated { role, name, nm, value: ceiling });
        }
        let light = value(&self.signal, self.role)?;
        Ok(light - self.dark.as_ref().map_or(Ok(0.0), |dark| value(dark, "dark"))?)
    }

    /// The larger of the two pixels between which `nm` lies.
    fn most_beside(&self, nm: f64) -> f64 {
        let values = self.signal.values();
        let after = self.signal.wavelengths_nm().partition_point(|&at| at < nm);
        let exact = self.signal.wavelengths_nm().get(after) == Some(&nm);
        let before = if exact { after } else { after.saturating_sub(1) };
        values[before].max(values[after.min(values.len() - 1)])
    }
}

impl Referencing<'_> {
    /// The reflectance of `sample` at its own wavelengths, a fraction; what had to be decided is
    /// in the record's remarks. White, dark and tile are brought there by straight lines.
    ///
    /// # Errors
    /// [`ReferencingError`] for readings that do not belong together, and for light that is too
    /// much or too little from 380 to 730 nm. Beyond, such wavelengths are left out.
    pub fn reflectance(
        &self,
        sample: &MeasuredSpectrum,
    ) -> Result<MeasuredSpectrum, ReferencingError> {
        let mut remarks = sample.remarks.clone();
        self.check_quantities(sample)?;
        let sample_light = self.light("sample", sample)?;
        let white = self.light("white", self.white)?;
        let scale = self.time_scale(sample, &mut remarks);
        if matches!(self.dark, Dark::Readings([])) {
            remarks.push("no dark was subtracted".to_owned());
        }
        let least = self.least(&white);
        let at = |nm: f64| {
            let light = white.at(nm)?;
            if light <= least {
                let name = self.white.name.clone();
                return Err(ReferencingError::Dim { name, nm, light, least });
            }
            let tile = self.tile.at(nm);
            let tile = tile.ok_or(ReferencingError::Uncovered { role: "tile", nm })?;
            let reflectance = tile * scale * sample_light.at(nm)? / light;
            if reflectance < -NEGATIVE_NOISE {
                let name = sample.name.clone();
                return Err(ReferencingError::BelowDark { name, nm, reflectance });
            }
            Ok(reflectance.max(0.0))
        };
        let good = usable(sample, at)?;
        if let Some(remark) = good.left_out {
            remarks.push(remark);
        }
        let mut details = sample.details.clone();
        details.push(("White".to_owned(), self.white.name.clone()));
        Ok(MeasuredSpectrum {
            name: sample.name.clone(),
            quantity: MeasuredQuantity::Reflectance,
            role: Role::Main,
            unit: Unit::Fraction,
            wavelengths_nm: good.nm,
            values: good.reflectance,
            line: sample.line,
            details,
            remarks,
        })
    }

    fn check_quantities(&self, sample: &MeasuredSpectrum) -> Result<(), ReferencingError> {
        use MeasuredQuantity::{Counts, Power, Unstated};
        let darks = match self.dark {
            Dark::Readings(darks) => darks,
            Dark::Subtracted => &[],
        };
        let others =
            std::iter::once(("white", self.white)).chain(darks.iter().map(|d| ("dark", d)));
        for (role, record) in std::iter::once(("sample", sample)).chain(others) {
            let (name, found) = (record.name.clone(), record.quantity);
            if !matches!(record.quantity, Counts | Power | Unstated) {
                return Err(ReferencingError::Quantity { role, name, found });
            }
            if record.quantity != sample.quantity
                && record.quantity != Unstated
                && sample.quantity != Unstated
            {
                let wanted = sample.quantity;
                return Err(ReferencingError::Mixed { role, name, wanted, found });
            }
        }
        Ok(())
    }

    fn light<'a>(
        &self,
        role: &'static str,
        record: &'a MeasuredSpectrum,
    ) -> Result<Light<'a>, ReferencingError> {
        let dark = self.dark_of(role, record)?;
        let of = |record: &MeasuredSpectrum| {
            samples(record.wavelengths_nm.clone(), record.values.clone())
        };
        let counted = record.quantity != MeasuredQuantity::Power || self.full_scale.is_some();
        let ceiling = if counted { ceiling(&record.values, self.full_scale) } else { None };
        Ok(Light { role, record, signal: of(record), dark: dark.map(of), ceiling })
    }

    fn dark_of(
        &self,
        role: &'static str,
        record: &MeasuredSpectrum,
    ) -> Result<Option<&MeasuredSpectrum>, ReferencingError> {
        let name = || record.name.clone();
        let darks = match self.dark {
            Dark::Subtracted => return Ok(None),
            Dark::Readings([]) if record.quantity == MeasuredQuantity::Counts => {
                return Err(ReferencingError::NoDark { role, name: name() });
            }
            Dark::Readings(darks) => darks,
        };
        let times: Vec<Option<f64>> = darks.iter().map(integration_time_ms).collect();
        match (integration_time_ms(record), darks) {
            (_, []) => Ok(None),
            (None, [one]) => Ok(Some(one)),
            (None, _) => {
                Err(ReferencingError::UnknownTime { role, name: name(), darks: darks.len() })
            }
            (Some(_), [one]) if times[0].is_none() => Ok(Some(one)),
            (Some(time_ms), _) => {
                let fits = |time: &Option<f64>| time.is_some_and(|time| same(time, time_ms));
                let found = times.iter().flatten().map(|time| format!("{time} ms"));
                let index = times.iter().position(fits).ok_or_else(|| {
                    let found = found.collect::<Vec<_>>().join(", ");
                    ReferencingError::DarkTime { role, name: name(), time_ms, found }
                })?;
                Ok(Some(&darks[index]))
            }
        }
    }

    /// What sample counts are multiplied by to be those of the white's integration time.
    fn time_scale(&self, sample: &MeasuredSpectrum, remarks: &mut Vec<String>) -> f64 {
        // Power is per second already.
        if sample.quantity == MeasuredQuantity::Power {
            return 1.0;
        }
        match (integration_time_ms(sample), integration_time_ms(self.white)) {
            (Some(sample), Some(white)) if !same(sample, white) => {
                remarks.push(format!(
                    "integrated for {sample} ms, its white for {white} ms: brought to one time"
                ));
                white / sample
            }
            (Some(_), None) | (None, Some(_)) => {
                remarks.push(
                    "only one of sample and white tells its integration time: taken to be the same"
                        .to_owned(),
                );
                1.0
            }
            _ => 1.0,
        }
    }

    /// What white less dark must exceed.
    fn least(&self, white: &Light<'_>) -> f64 {
        let lit = white.signal.wavelengths_nm().iter().filter_map(|&nm| white.at(nm).ok());
        let peak = lit.fold(0.0, f64::max);
        let noise = white.dark.as_ref().map_or(0.0, |dark| noise(dark.values()));
        (self.least_light * peak).max(NOISE_MULTIPLE * noise)
    }
}

/// Reflectance where it is good.
struct Usable {
    nm: Vec<f64>,
    reflectance: Vec<f64>,
    left_out: Option<String>,
}

/// The visible wavelengths of `sample`, and those around them up to the first that fail.
fn usable(
    sample: &MeasuredSpectrum,
    at: impl Fn(f64) -> Result<f64, ReferencingError>,
) -> Result<Usable, ReferencingError> {
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
    Ok(Usable { nm: all[start..end].to_vec(), reflectance, left_out })
}

/// The standard deviation of a dark's noise: from the median step between neighbours, which a
/// slope and a few hot pixels leave alone.
fn noise(dark: &[f64]) -> f64 {
    let mut steps: Vec<f64> = dark.windows(2).map(|pair| (pair[1] - pair[0]).abs()).collect();
    steps.sort_by(f64::total_cmp);
    // The median of |x| of a normal distribution is 0.6745 deviations; a step holds two noises.
    steps.get(steps.len() / 2).map_or(0.0, |median| median / 0.6745 / 2.0_f64.sqrt())
}

fn samples(nm: Vec<f64>, values: Vec<f64>) -> IrregularSpectrum {
    IrregularSpectrum::new(nm, values).expect("a record's wavelengths rise, each with a value")
}
