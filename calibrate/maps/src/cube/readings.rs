//! White and dark readings of a camera: means and scatter over their lines, and what they make of
//! the counts of a scan.

use rayon::prelude::*;

use super::conversion::{Conversion, Terms};
use super::error::CubeError;
use super::opened::Opened;
use super::window::{Pixels, Window};
use crate::pixel_maps::Mask;

/// Least light of a band: share of the brightest band's.
const LEAST_LIGHT: f64 = 0.01;
/// Columns without light from which a white reading is refused, as a share of all.
const MOST_DEAD: f64 = 0.05;
/// Range in which every band must have light, in nm.
const VISIBLE_NM: std::ops::RangeInclusive<f64> = 380.0..=730.0;
/// Bytes of the values that are read at once.
const BLOCK_BYTES: usize = 16 << 20;

/// Mean of a reading over its lines.
#[derive(Debug)]
pub(crate) struct Reading {
    /// Mean of each band of each column, column after column.
    mean: Vec<f64>,
    /// Standard deviation of each band over lines, all columns together; 0 for one line.
    sd: Vec<f64>,
    /// Largest single value.
    pub(crate) largest: f32,
    columns: usize,
}

impl Reading {
    /// Averages `opened` over its lines; it must fit to `scan`.
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

/// Readings that belong to a scan.
#[derive(Debug)]
pub(crate) struct Readings {
    pub(crate) white: Reading,
    /// Dark of the scan; `None` if it is subtracted already.
    pub(crate) dark: Option<Reading>,
    /// Dark of the white, where it has one of its own.
    pub(crate) white_dark: Option<Reading>,
    /// Reflectance of the white.
    pub(crate) tile: f64,
    /// Integration time of the scan divided by that of the white.
    pub(crate) time_ratio: f64,
}

/// Reflectance by readings.
#[derive(Debug)]
pub(crate) struct Referenced {
    pub(crate) terms: Terms,
    /// Whether each band has light.
    pub(crate) good: Vec<bool>,
    /// Standard deviation of a white's reflectance in each band, by the scatter of the white.
    pub(crate) white_sd: Vec<f64>,
    /// Standard deviation of a black's reflectance in each band, by the scatter of the dark.
    pub(crate) black_sd: Vec<f64>,
    pub(crate) remarks: Vec<String>,
}

impl Readings {
    /// Terms for the counts of `scan`; `nm` are its wavelengths.
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
