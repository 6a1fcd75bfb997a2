//! Finds how the raw values of a scan become reflectance: by its file, by settings, by readings, or
//! by a sample of its pixels.

use super::conversion::{Conversion, Terms};
use super::error::CubeError;
use super::opened::{Opened, Values};
use super::options::{CubeOptions, CubeScale};
use super::readings::Readings;
use super::window::{Pixels, Window};
use crate::pixel_maps::Mask;

/// Rows that are sampled.
const ROWS: usize = 16;
/// Pixels of a row that are sampled.
const COLUMNS: usize = 256;
/// Largest value of most pixels up to which values are fractions.
const MOST_FRACTION: f32 = 2.0;
/// Largest value of most pixels up to which values are percent.
const MOST_PERCENT: f32 = 200.0;
/// Full scales of detectors whose numbers have more bits than they use.
const FULL_SCALES: [f32; 4] = [1023.0, 4095.0, 16383.0, 65535.0];

/// How values become reflectance, and sentences about it.
#[derive(Debug)]
pub(crate) struct Interpreted {
    pub(crate) conversion: Conversion,
    /// Bands that stay, in the order of rising wavelength.
    pub(crate) bands: Vec<usize>,
    pub(crate) white_sd: Option<Vec<f64>>,
    pub(crate) black_sd: Option<Vec<f64>>,
    pub(crate) remarks: Vec<String>,
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
        let has_data =
            |pixel: &&[f32]| pixel.iter().all(|value| value.is_finite() && Some(*value) != ignore);
        let largest = |pixel: &[f32]| pixel.iter().copied().fold(f32::NEG_INFINITY, f32::max);
        let mut found: Vec<f32> = pixels.filter(has_data).map(largest).collect();
        found.sort_by(f32::total_cmp);
        found
    }
}

/// Bands in the order of rising wavelength, without those that are bad.
fn rising(nm: &[f64], good: &[bool]) -> Vec<usize> {
    let mut bands: Vec<usize> = (0..nm.len()).filter(|&band| good[band]).collect();
    bands.sort_by(|&a, &b| nm[a].total_cmp(&nm[b]));
    bands
}

/// Finds how the values of `scan` become reflectance; `nm` are its wavelengths.
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
            remarks.extend(referenced.remarks);
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
    let sorted = |of: Option<Vec<f64>>| of.map(|all| bands.iter().map(|&band| all[band]).collect());
    Ok(Interpreted {
        white_sd: sorted(white_sd),
        black_sd: sorted(black_sd),
        conversion,
        bands,
        remarks,
    })
}

fn check_has_light(scan: &Opened, largest: &[f32]) -> Result<(), CubeError> {
    let problem = match largest.last() {
        None => "no sampled pixel has data: all are marked as ignored or are no numbers",
        Some(most) if *most <= 0.0 => "all sampled values are 0 or less: the scan is dark",
        _ => return Ok(()),
    };
    Err(CubeError::Unusable {
        path: scan.path.clone(),
        problem: problem.to_owned(),
        way_out: "scan again with light, and check `data ignore value` of the header".to_owned(),
    })
}

/// Terms for values that no reading accompanies.
fn terms_of_values(
    scan: &Opened,
    largest: &[f32],
    options: &CubeOptions,
    remarks: &mut Vec<String>,
) -> Result<Terms, CubeError> {
    match options.scale {
        CubeScale::ByFile => {}
        CubeScale::Fraction => return Ok(Terms::One(1.0)),
        CubeScale::Percent => return Ok(Terms::One(0.01)),
        CubeScale::White(white) => return Ok(Terms::One((1.0 / white) as f32)),
    }
    // A few glints or dead pixels do not decide.
    let most = largest[(largest.len() - 1) * 98 / 100];
    let refused = || CubeError::NoReflectance { path: scan.path.clone(), largest: f64::from(most) };
    match &scan.values {
        Values::Divided(factor) => Ok(Terms::One((1.0 / factor) as f32)),
        Values::Gains(pairs) => {
            let gain = pairs.iter().map(|(gain, _)| *gain as f32).collect();
            let dark = |(gain, offset): &(f64, f64)| (-offset / gain) as f32;
            Ok(Terms::Columns { dark: pairs.iter().map(dark).collect(), gain })
        }
        Values::Counts | Values::Unknown { are_whole: true } => Err(refused()),
        Values::Unknown { are_whole: false } if most <= MOST_FRACTION => Ok(Terms::One(1.0)),
        Values::Unknown { are_whole: false } if most <= MOST_PERCENT => {
            remarks.push(format!("values up to {most} are taken for percent"));
            Ok(Terms::One(0.01))
        }
        Values::Unknown { .. } => Err(refused()),
    }
}

/// Full scale by a maximum that several values share.
fn guessed_full_scale(most: f32, white: f32, largest: &[f32]) -> Option<f32> {
    let shared = largest.iter().filter(|value| **value == most).count() > 1;
    let full = |value: f32| FULL_SCALES.contains(&value).then_some(value);
    full(white).or_else(|| full(most).filter(|_| shared && white <= most))
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

/// Refuses a scan of which most sampled pixels cannot be used, for one reason.
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
        (Mask::NotFinite, "are no numbers", "check the export of the scan"),
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
