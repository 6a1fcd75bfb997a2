//! Interprets the raw values of a scan as reflectance, with white and dark readings where it has them.

use pigment::Remark;
use rayon::prelude::*;

use super::error::CubeError;
use super::options::{CubeOptions, CubeScale};
use super::white::guessed_white;
use super::window::{Conversion, Opened, Pixels, Terms, Values, Window};
use crate::pixel_maps::Mask;

/// We sample this many rows.
const ROWS: usize = 16;
/// We sample this many pixels of a row.
const COLUMNS: usize = 256;
/// If the largest value of most pixels is at most this, values are fractions.
const MOST_FRACTION: f32 = 2.0;
/// If the largest value of most pixels is at most this, values are percent.
const MOST_PERCENT: f32 = 200.0;
/// Full scales of detectors that do not use all bits of a number.
const FULL_SCALES: [f32; 4] = [1023.0, 4095.0, 16383.0, 65535.0];

/// How values become reflectance, with remarks for the user.
#[derive(Debug)]
pub(crate) struct Interpreted {
    pub(crate) conversion: Conversion,
    /// Indices of the bands that we use, in the order of rising wavelength.
    pub(crate) bands: Vec<usize>,
    pub(crate) white_sd: Option<Vec<f64>>,
    pub(crate) black_sd: Option<Vec<f64>>,
    pub(crate) remarks: Vec<Remark>,
}

/// Raw values of pixels all over the scan, with their columns.
struct Sample {
    values: Vec<f32>,
    columns: Vec<usize>,
    bands: usize,
}

impl Sample {
    fn of(scan: &Opened, bands: &[usize]) -> Result<Self, CubeError> {
        let rows = ROWS.min(scan.lines);
        let width = COLUMNS.min(scan.samples);
        let mut sample = Self { values: Vec::new(), columns: Vec::new(), bands: bands.len() };
        for at in 0..rows {
            let row = (2 * at + 1) * scan.lines / (2 * rows);
            // Each row at another place, so that the sample crosses the scan.
            let start = (scan.samples - width) * at / rows.max(2).saturating_sub(1);
            let start = start.min(scan.samples - width);
            let window = Window { rows: row..row + 1, columns: start..start + width };
            let mut values = vec![0.0; width * bands.len()];
            let mut mask = vec![Mask::Mapped; width];
            let pixels = Pixels { values: &mut values, mask: &mut mask };
            scan.source.read(&window, bands, &Conversion::none(), pixels)?;
            sample.values.extend(values);
            sample.columns.extend(window.columns);
        }
        Ok(sample)
    }

    /// Largest values of pixels with data, in rising order.
    fn largest(&self, ignore: Option<f32>) -> Vec<f32> {
        let pixels = self.values.chunks_exact(self.bands);
        let mut found: Vec<f32> = pixels
            .filter(|pixel: &&[f32]| {
                pixel.iter().all(|value| value.is_finite() && Some(*value) != ignore)
            })
            .map(|pixel: &[f32]| pixel.iter().copied().fold(f32::NEG_INFINITY, f32::max))
            .collect();
        found.sort_by(f32::total_cmp);
        found
    }
}

/// Bands in the order of rising wavelength, without bad ones.
fn rising(nm: &[f64], good: &[bool]) -> Vec<usize> {
    let mut bands: Vec<usize> = (0..nm.len()).filter(|&band| good[band]).collect();
    bands.sort_by(|&a, &b| nm[a].total_cmp(&nm[b]));
    bands
}

/// Finds how the values of `scan` become reflectance. Pass its wavelengths as `nm`.
pub(crate) fn interpret(
    scan: &Opened,
    nm: &[f64],
    readings: Option<&Readings>,
    options: &CubeOptions,
) -> Result<Interpreted, CubeError> {
    let mut remarks = Vec::new();
    let mut good = scan.good.clone();
    let referenced = readings.map(|readings| readings.terms(scan, nm)).transpose()?;
    if let Some(referenced) = &referenced {
        for (good, has_light) in good.iter_mut().zip(&referenced.good) {
            *good &= has_light;
        }
    }
    let bands = rising(nm, &good);
    let sample = Sample::of(scan, &bands)?;
    let ignore = scan.ignore.map(|value| value as f32);
    let largest = sample.largest(ignore);
    check_has_light(scan, &largest)?;
    let mut white_sd = None;
    let mut black_sd = None;
    let terms = match referenced {
        Some(referenced) => {
            remarks.extend(referenced.remarks.into_iter().map(Remark::note));
            white_sd = Some(referenced.white_sd);
            black_sd = Some(referenced.black_sd);
            referenced.terms
        }
        None => terms_of_values(scan, &largest, options, &mut remarks)?,
    };
    let guessed = readings.and_then(|readings| {
        let most = largest.last().copied().unwrap_or(0.0);
        guessed_full_scale(most, readings.white.largest, &largest)
    });
    let full_scale = options.full_scale.map(|full| full as f32).or(guessed);
    let full_scale = full_scale.or(scan.source.full_scale().map(|full| full as f32));
    if let (Some(full), Some(readings)) = (full_scale, readings) {
        check_white(scan, readings, full)?;
    }
    let conversion = Conversion { ignore, saturated: full_scale, terms };
    let conversion = conversion.of_bands(&bands, scan.bands);
    check_usable(scan, &sample, &conversion)?;
    let [white_sd, black_sd] =
        [white_sd, black_sd].map(|of| of.map(|all| bands.iter().map(|&band| all[band]).collect()));
    Ok(Interpreted { white_sd, black_sd, conversion, bands, remarks })
}

fn check_has_light(scan: &Opened, largest: &[f32]) -> Result<(), CubeError> {
    let problem = match largest.last() {
        None => "no sampled pixel has data: all are marked as ignored or are not numbers",
        Some(most) if *most <= 0.0 => "all sampled values are 0 or less: the scan is dark",
        _ => return Ok(()),
    };
    Err(CubeError::Unusable {
        path: scan.path.clone(),
        problem: problem.to_owned(),
        way_out: "scan again with light, and check `data ignore value` of the header".to_owned(),
    })
}

/// Terms for values without a white reading.
fn terms_of_values(
    scan: &Opened,
    largest: &[f32],
    options: &CubeOptions,
    remarks: &mut Vec<Remark>,
) -> Result<Terms, CubeError> {
    match options.scale {
        CubeScale::ByFile => {}
        CubeScale::Fraction => return Ok(Terms::One(1.0)),
        CubeScale::Percent => return Ok(Terms::One(0.01)),
        CubeScale::White(white) => return Ok(Terms::One((1.0 / white) as f32)),
    }
    // A few glints or dead pixels do not decide.
    let most = largest[(largest.len() - 1) * 98 / 100];
    match &scan.values {
        Values::Divided(factor) => Ok(Terms::One((1.0 / factor) as f32)),
        Values::Gains(pairs) => {
            let gain = pairs.iter().map(|(gain, _)| *gain as f32).collect();
            Ok(Terms::Columns {
                dark: pairs
                    .iter()
                    .map(|(gain, offset): &(f64, f64)| (-offset / gain) as f32)
                    .collect(),
                gain,
            })
        }
        Values::Unknown { are_whole: false } if most <= MOST_FRACTION => Ok(Terms::One(1.0)),
        Values::Unknown { are_whole: false } if most <= MOST_PERCENT => {
            remarks.push(Remark::note(format!("values up to {most} are taken for percent")));
            Ok(Terms::One(0.01))
        }
        Values::Counts => Err(no_reflectance(scan, most)),
        Values::Unknown { .. } => {
            let greatest = largest.last().copied().unwrap_or(most);
            let guess = guessed_white(&scan.path, &scan.told, most.into(), greatest.into());
            let Some(guess) = guess else { return Err(no_reflectance(scan, most)) };
            let text = format!("a white is taken to read {}: {}", guess.white, guess.reason);
            remarks.push(Remark::warning(text).with_hint(
                "give the number that a white reads with [scale=10000], or [white_reading=FILE] for raw counts",
            ));
            Ok(Terms::One((1.0 / guess.white) as f32))
        }
    }
}

fn no_reflectance(scan: &Opened, most: f32) -> CubeError {
    CubeError::NoReflectance { path: scan.path.clone(), largest: f64::from(most) }
}

/// Guesses the full scale from a maximum that several values share.
fn guessed_full_scale(most: f32, white: f32, largest: &[f32]) -> Option<f32> {
    let shared = largest.iter().filter(|value| **value == most).count() > 1;
    full(white).or_else(|| full(most).filter(|_| shared && white <= most))
}

fn full(value: f32) -> Option<f32> {
    FULL_SCALES.contains(&value).then_some(value)
}

fn check_white(scan: &Opened, readings: &Readings, full: f32) -> Result<(), CubeError> {
    let largest = readings.white.largest;
    if largest < full {
        return Ok(());
    }
    Err(CubeError::Reading {
        path: scan.path.clone(),
        role: "white",
        problem: format!("of this scan is saturated: its largest count is `{largest}`"),
        way_out: "take white and scan with a shorter exposure; if the detector was not saturated, give its largest count with [full_scale]".to_owned(),
    })
}

/// Refuses a scan if we cannot use most of its sampled pixels for one and the same reason.
fn check_usable(scan: &Opened, sample: &Sample, conversion: &Conversion) -> Result<(), CubeError> {
    let mut counts = [0_usize; Mask::ALL.len()];
    let mut values = sample.values.clone();
    let pixels = values.chunks_exact_mut(sample.bands).zip(&sample.columns);
    for (pixel, column) in pixels {
        counts[usize::from(conversion.pixel(*column, pixel).code())] += 1;
    }
    let with_data: usize = counts.iter().sum::<usize>() - counts[usize::from(Mask::Ignored.code())];
    let (words, way_out) = [
        (
            Mask::Saturated,
            "are saturated",
            "scan again with a shorter exposure; if the detector was not saturated, give its largest count with [full_scale]",
        ),
        (
            Mask::OutOfRange,
            "have reflectances below -0.1 or above 1.2",
            "check the white reading, or give the value of a white with [scale]",
        ),
        (Mask::NotFinite, "are not numbers", "check the export of the scan"),
    ]
    .into_iter()
    .find(|(mask, ..)| 2 * counts[usize::from(mask.code())] > with_data)
    .map_or(("", ""), |(_, words, way_out)| (words, way_out));
    if words.is_empty() {
        return Ok(());
    }
    Err(CubeError::Unusable {
        path: scan.path.clone(),
        problem: format!("more than half of {with_data} sampled pixels {words}"),
        way_out: way_out.to_owned(),
    })
}

/// Least light of a band, as a share of the light in the brightest band.
const LEAST_LIGHT: f64 = 0.01;
/// We refuse a white reading if more than this share of its columns is without light.
const MOST_DEAD: f64 = 0.05;
/// Range in which every band must have light, in nm.
const VISIBLE_NM: std::ops::RangeInclusive<f64> = 380.0..=730.0;
/// We read this many bytes of values at once.
const BLOCK_BYTES: usize = 16 << 20;

/// Mean of a reading over its lines.
#[derive(Debug)]
pub(crate) struct Reading {
    /// Mean of each band of each column, column after column.
    mean: Vec<f64>,
    /// Standard deviation of each band over lines, for all columns together. This is 0 if there is
    /// only one line.
    sd: Vec<f64>,
    /// Largest single value.
    pub(crate) largest: f32,
    columns: usize,
}

impl Reading {
    /// Averages the white or dark reading `opened` over its lines. It must have the bands of
    /// `scan`, at the same wavelengths, and as many columns, or one.
    pub(crate) fn of(
        opened: &Opened,
        scan: &Opened,
        role: &'static str,
    ) -> Result<Self, CubeError> {
        let fault = |problem: String| CubeError::Reading {
            path: opened.path.clone(),
            role,
            problem,
            way_out: "take white and dark readings with the settings of the scan".to_owned(),
        };
        if opened.bands != scan.bands {
            return Err(fault(format!("has {} bands, the scan {}", opened.bands, scan.bands)));
        }
        if ![1, scan.samples].contains(&opened.samples) {
            return Err(fault(format!(
                "has {} samples, expected {} as the scan, or 1",
                opened.samples, scan.samples
            )));
        }
        if let (Some(of_reading), Some(of_scan)) = (&opened.wavelengths_nm, &scan.wavelengths_nm) {
            let mut pairs = of_reading.iter().zip(of_scan);
            if let Some((a, b)) = pairs.find(|(a, b)| (*a - *b).abs() > 0.5) {
                return Err(fault(format!("has a band at {a} nm where the scan has {b} nm")));
            }
        }
        Self::averaged(opened)
    }

    fn averaged(opened: &Opened) -> Result<Self, CubeError> {
        let columns = opened.samples;
        let bands = opened.bands;
        let all: Vec<usize> = (0..bands).collect();
        let row_values = columns * bands;
        let rows = (BLOCK_BYTES / 4 / row_values).clamp(1, opened.lines);
        let mut sums = vec![(0.0_f64, 0.0_f64); row_values];
        let mut largest = f32::NEG_INFINITY;
        let mut values = vec![0.0; rows * row_values];
        let mut mask = vec![Mask::Mapped; rows * columns];
        for start in (0..opened.lines).step_by(rows) {
            let window =
                Window { rows: start..(start + rows).min(opened.lines), columns: 0..columns };
            let values = &mut values[..window.rows.len() * row_values];
            let mask = &mut mask[..window.pixels()];
            let pixels = Pixels { values: &mut *values, mask };
            opened.source.read(&window, &all, &Conversion::none(), pixels)?;
            for row in values.chunks_exact(row_values) {
                sums.par_iter_mut().zip(row).for_each(|((sum, squares), &value)| {
                    let value = f64::from(value);
                    *sum += value;
                    *squares += value * value;
                });
            }
            largest = values.iter().copied().fold(largest, f32::max);
        }
        let lines = opened.lines as f64;
        let mut variance = vec![0.0; bands];
        for (at, (sum, squares)) in sums.iter().enumerate() {
            let scatter = (squares - sum * sum / lines).max(0.0);
            variance[at % bands] += scatter / (lines - 1.0).max(1.0) / columns as f64;
        }
        let mean = sums.into_iter().map(|(sum, _)| sum / lines).collect();
        let sd = variance.into_iter().map(f64::sqrt).collect();
        Ok(Self { mean, sd, largest, columns })
    }

    fn at(&self, column: usize, band: usize) -> f64 {
        let bands = self.sd.len();
        let column = if self.columns == 1 { 0 } else { column };
        self.mean[column * bands + band]
    }
}

#[derive(Debug)]
pub(crate) struct Readings {
    pub(crate) white: Reading,
    /// Dark reading of the scan, or `None` if the dark is subtracted already.
    pub(crate) dark: Option<Reading>,
    /// Separate dark reading of the white, if there is one.
    pub(crate) white_dark: Option<Reading>,
    pub(crate) tile: f64,
    /// Integration time of the scan divided by the white's.
    pub(crate) time_ratio: f64,
}

#[derive(Debug)]
pub(crate) struct Referenced {
    pub(crate) terms: Terms,
    /// Whether each band has light.
    pub(crate) good: Vec<bool>,
    /// Standard deviation of the reflectance of a white in each band, from the scatter of the white
    /// reading over its lines.
    pub(crate) white_sd: Vec<f64>,
    /// Standard deviation of the reflectance of a black in each band, from the scatter of the dark
    /// reading over its lines.
    pub(crate) black_sd: Vec<f64>,
    pub(crate) remarks: Vec<String>,
}

impl Readings {
    /// Terms that turn the counts of `scan` into reflectance. Pass its wavelengths as `nm`.
    pub(crate) fn terms(&self, scan: &Opened, nm: &[f64]) -> Result<Referenced, CubeError> {
        let fault = |problem: String, way_out: &str| CubeError::Reading {
            path: scan.path.clone(),
            role: "white",
            problem,
            way_out: way_out.to_owned(),
        };
        let white_dark = self.white_dark.as_ref().or(self.dark.as_ref());
        let dark = |of: Option<&Reading>, column, band| of.map_or(0.0, |it| it.at(column, band));
        let light = |column, band| self.white.at(column, band) - dark(white_dark, column, band);
        let columns = scan.samples;
        let means: Vec<f64> = (0..scan.bands)
            .map(|band| (0..columns).map(|at| light(at, band)).sum::<f64>() / columns as f64)
            .collect();
        let peak = means.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        // Written so that NaN is refused too.
        if peak.is_nan() || peak <= 0.0 {
            let problem = format!("of this scan is at most `{peak}` above its dark reading");
            return Err(fault(problem, "check that white and dark were not interchanged"));
        }
        let least = LEAST_LIGHT * peak;
        let good: Vec<bool> = means.iter().map(|mean| *mean >= least).collect();
        let dim =
            (0..nm.len()).find(|&at| scan.good[at] && !good[at] && VISIBLE_NM.contains(&nm[at]));
        if let Some(at) = dim {
            let nm = nm[at];
            let mean = means[at];
            return Err(fault(
                format!(
                    "of this scan has too little light at {nm} nm: `{mean}` above its dark, expected {least}"
                ),
                "take the white with more light, or mark the band as bad (bbl)",
            ));
        }
        let mut remarks = Vec::new();
        let bad = good.iter().zip(&scan.good).filter(|(light, good)| !**light && **good).count();
        if bad > 0 {
            remarks.push(format!(
                "{bad} bands outside 380 to 730 nm have too little light and are left out"
            ));
        }
        let mut dead = 0;
        let mut terms = (Vec::new(), Vec::new());
        for column in 0..columns {
            let mut is_dead = false;
            for (band, has_light) in good.iter().enumerate() {
                let light = light(column, band);
                is_dead |= *has_light && scan.good[band] && light < least / 10.0;
                terms.0.push(dark(self.dark.as_ref(), column, band) as f32);
                terms.1.push((self.tile / (light * self.time_ratio)) as f32);
            }
            if is_dead {
                dead += 1;
                let start = column * scan.bands;
                terms.1[start..].fill(f32::NAN);
            }
        }
        if dead as f64 > MOST_DEAD * columns as f64 {
            let problem = format!("of this scan has no light in {dead} of {columns} columns");
            return Err(fault(problem, "take a white that fills the whole line"));
        }
        if dead > 0 {
            remarks.push(format!(
                "{dead} of {columns} columns have no light in the white reading and are not mapped"
            ));
        }
        let scatter = |of: &[f64]| -> Vec<f64> {
            let pairs = of.iter().zip(&means);
            pairs.map(|(sd, mean)| self.tile * sd / (mean * self.time_ratio)).collect()
        };
        let black_sd =
            self.dark.as_ref().map_or_else(|| vec![0.0; scan.bands], |it| scatter(&it.sd));
        Ok(Referenced {
            terms: Terms::Columns { dark: terms.0, gain: terms.1 },
            good,
            white_sd: scatter(&self.white.sd),
            black_sd,
            remarks,
        })
    }
}
