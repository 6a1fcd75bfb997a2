//! A simulated camera. It scans scenes with exactly known spectra, so that you can test maps.
//!
//! ```text
//! exact spectra --> varied surface --> blur --> bands --> drift of the white --> noise
//! ```
//!
//! We draw every number from a seed and the place of the pixel, so a scan has the same values in
//! blocks of any size.

use std::collections::BTreeMap;
use std::ops::Range;

use documents::hint::Explain;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use rayon::prelude::*;
use spectra::optics::Surface;
use spectra::{Extrapolation, Grid, Interpolation, Response, Spectrum};

/// A scene with exactly known spectra.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scene {
    /// Number of rows.
    pub lines: usize,
    /// Number of columns.
    pub samples: usize,
    /// Wavelengths of its spectra.
    pub grid: Grid,
    /// Surface of its paint.
    pub surface: Surface,
}

/// Rows of a simulated scan.
#[derive(Debug, Clone, PartialEq)]
pub struct SimulatedRows {
    /// Reflectances that the camera reports, pixel by pixel with all bands of each.
    pub told: Vec<f32>,
    /// Mean over the bands of the reflectance of each pixel, blurred, without drift and noise.
    pub mean: Vec<f32>,
}

/// A simulated camera in front of a scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Camera {
    scene: Scene,
    settings: CameraSettings,
    bands: CameraBands,
    blur: Blur,
    sensor: Sensor,
    variation: SurfaceVariation,
}

impl Camera {
    /// Sets up the camera.
    ///
    /// # Errors
    /// [`CameraError`] if a setting is out of its range, or the camera sees too few wavelengths of
    /// the scene.
    pub fn new(scene: Scene, settings: &CameraSettings) -> Result<Self, CameraError> {
        settings.check()?;
        if scene.lines == 0 || scene.samples == 0 {
            let Scene { lines, samples, .. } = scene;
            return Err(CameraError::Size { lines, samples });
        }
        let CameraSettings { shot_noise, read_noise, drift, seed, .. } = *settings;
        Ok(Self {
            scene,
            settings: *settings,
            bands: CameraBands::new(scene.grid, settings.bands)?,
            blur: Blur::new(settings.blur_px),
            sensor: Sensor { shot_noise, read_noise, drift, seed },
            variation: SurfaceVariation {
                surface: scene.surface,
                relative: settings.surface,
                seed,
            },
        })
    }

    /// The scene that the camera sees.
    #[must_use]
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// Settings of the camera.
    #[must_use]
    pub fn settings(&self) -> &CameraSettings {
        &self.settings
    }

    /// Wavelengths of the bands in nm, rising.
    #[must_use]
    pub fn wavelengths_nm(&self) -> &[f64] {
        &self.bands.nm
    }

    /// Rows that the camera reports. `exact(line)` must give the measured reflectances of a row of
    /// the scene, pixel by pixel with all wavelengths of each. We call it for these rows and for
    /// neighbours that the blur needs.
    #[must_use]
    pub fn rows(
        &self,
        rows: Range<usize>,
        exact: &(dyn Fn(usize) -> Vec<f64> + Sync),
    ) -> SimulatedRows {
        let Scene { lines, samples, grid, .. } = self.scene;
        let count = grid.count();
        let blurred = self.blurred(rows.clone(), &|line| {
            let mut values = exact(line);
            let factors = self.variation.factors(line, samples);
            for (pixel, factor) in values.chunks_exact_mut(count).zip(factors) {
                self.variation.exchange(pixel, factor);
            }
            values
        });
        let each: Vec<(Vec<f32>, Vec<f32>)> = (blurred.par_iter().zip(rows))
            .map(|(values, line)| {
                let pixels = values.chunks_exact(count);
                let seen: Vec<f64> = pixels.flat_map(|pixel| self.bands.values(pixel)).collect();
                let bands = self.bands.nm.len();
                let means = seen
                    .chunks_exact(bands)
                    .map(|pixel: &[f64]| (pixel.iter().sum::<f64>() / bands as f64) as f32)
                    .collect();
                (self.sensor.told(&seen, line, lines), means)
            })
            .collect();
        let mut told = Vec::new();
        let mut mean = Vec::new();
        for (values, means) in each {
            told.extend(values);
            mean.extend(means);
        }
        SimulatedRows { told, mean }
    }

    /// Blurs rows of any numbers of the scene as the camera blurs light. `of(line)` must give the
    /// numbers of a row, pixel by pixel.
    #[must_use]
    pub fn blurred(
        &self,
        rows: Range<usize>,
        of: &(dyn Fn(usize) -> Vec<f64> + Sync),
    ) -> Vec<Vec<f64>> {
        let Scene { lines, samples, .. } = self.scene;
        let needed = self.blur.needed(&rows, lines);
        let known: BTreeMap<usize, Vec<f64>> =
            needed.into_par_iter().map(|line| (line, of(line))).collect();
        let nothing: &[f64] = &[];
        rows.into_par_iter()
            .map(|at| {
                self.blur.line(at, (lines, samples), |line| {
                    known.get(&line).map_or(nothing, Vec::as_slice)
                })
            })
            .collect()
    }
}

/// A detector with noise, and a white that changes along the scan.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sensor {
    /// Standard deviation of the shot noise at a reflectance of 1.
    pub shot_noise: f64,
    /// Standard deviation of the noise of reading.
    pub read_noise: f64,
    /// Relative change of the values from the first to the last line, e.g. 0.01.
    pub drift: f64,
    /// Seed of the random numbers.
    pub seed: u64,
}

impl Sensor {
    /// Factor on the values of a line: 1 in the first of `lines`, 1 + drift in the last.
    #[must_use]
    pub fn gain(&self, line: usize, lines: usize) -> f64 {
        1.0 + self.drift * line as f64 / (lines.max(2) - 1) as f64
    }

    /// Variance of the noise of a value.
    #[must_use]
    pub fn variance(&self, value: f64) -> f64 {
        self.read_noise.powi(2) + self.shot_noise.powi(2) * value.max(0.0)
    }

    /// Values that the detector reports in the line `line` of `lines`.
    #[must_use]
    pub fn told(&self, values: &[f64], line: usize, lines: usize) -> Vec<f32> {
        let mut random = ChaCha8Rng::seed_from_u64(self.seed);
        random.set_stream(line as u64);
        let gain = self.gain(line, lines);
        let told = values.iter().map(|value| {
            let normal: f64 = StandardNormal.sample(&mut random);
            let value = gain * value;
            (value + self.variance(value).sqrt() * normal) as f32
        });
        told.collect()
    }
}

/// The camera sees these wavelengths in nm, as far as the spectra of the scene reach.
pub(crate) const RANGE_NM: [f64; 2] = [400.0, 1000.0];

/// Settings of a simulated camera.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CameraSettings {
    /// Number of bands, 2 to 2000. They lie evenly from 400 to 1000 nm, or over the part of this
    /// range that the scene covers.
    pub bands: usize,
    /// Standard deviation of the blur in pixels, 0 to 20.
    pub blur_px: f64,
    /// Standard deviation of the shot noise at a reflectance of 1, 0 to 0.5. It grows with the square root
    /// of the reflectance.
    pub shot_noise: f64,
    /// Standard deviation of the noise of reading, in reflectance, 0 to 0.5.
    pub read_noise: f64,
    /// Relative change of the white from the first to the last line, -0.5 to 0.5. For example, 0.01
    /// makes the values of the last line 1 % too high.
    pub drift: f64,
    /// Relative standard deviation of the reflection at the surface (k1) over the scene, 0 to 1.
    pub surface: f64,
    /// Seed of all random numbers.
    pub seed: u64,
}

impl Default for CameraSettings {
    /// 31 bands, a blur of 1.5 pixels, shot noise 0.003, noise of reading 0.001, drift 1 %, k1 varied by 20 %.
    fn default() -> Self {
        Self {
            bands: 31,
            blur_px: 1.5,
            shot_noise: 0.003,
            read_noise: 0.001,
            drift: 0.01,
            surface: 0.2,
            seed: 1,
        }
    }
}

impl CameraSettings {
    pub(crate) fn check(&self) -> Result<(), CameraError> {
        for (name, value, least, most) in [
            ("bands", self.bands as f64, 2.0, 2000.0),
            ("blur", self.blur_px, 0.0, 20.0),
            ("shot_noise", self.shot_noise, 0.0, 0.5),
            ("read_noise", self.read_noise, 0.0, 0.5),
            ("drift", self.drift, -0.5, 0.5),
            ("surface", self.surface, 0.0, 1.0),
        ] {
            if !(least..=most).contains(&value) {
                return Err(CameraError::Setting { name, value, least, most });
            }
        }
        Ok(())
    }
}

/// The scene or the settings do not suit the camera.
#[derive(Debug, Clone, PartialEq, thiserror::Error, Explain)]
pub enum CameraError {
    /// A setting is out of its range.
    #[error("{name} of the camera must be {least} to {most}, found `{value}`")]
    #[hint("give another [{name}]")]
    #[fault(Setting)]
    Setting {
        /// Name of the setting.
        name: &'static str,
        /// Value that was given.
        value: f64,
        /// Least value that is allowed.
        least: f64,
        /// Greatest value that is allowed.
        most: f64,
    },
    /// The scene has no pixels.
    #[error("a scan needs at least one pixel, found {lines} x {samples}")]
    Size {
        /// Rows of the scene.
        lines: usize,
        /// Columns of the scene.
        samples: usize,
    },
    /// The spectra of the scene have too few wavelengths that the camera sees.
    #[error("the camera sees {} to {} nm, the spectra of the scene go from {} to {} nm", RANGE_NM[0], RANGE_NM[1], .0.start_nm(), .0.end_nm())]
    #[hint("paint with a library of visible or near infrared wavelengths")]
    Wavelengths(Grid),
}

/// Distance in pixels between independent values of k1. In between, k1 changes smoothly.
const PATCH_PX: usize = 16;
/// Number of the first random stream for the surface. Each line has a stream for its noise below
/// this number.
const STREAMS: u64 = 1 << 63;
/// Greatest k1 of a varied surface.
const MOST_K1: f64 = 0.9;

/// A surface with a k1 that varies smoothly over a scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfaceVariation {
    /// Surface that the spectra of the scene were computed with.
    pub surface: Surface,
    /// Standard deviation of k1, relative to the surface's k1.
    pub relative: f64,
    /// Seed of the random numbers.
    pub seed: u64,
}

impl SurfaceVariation {
    /// Factors on k1 in a line. At every place they have the mean 1 and the standard deviation
    /// `relative`. Within about 16 pixels they are similar.
    #[must_use]
    pub fn factors(&self, line: usize, samples: usize) -> Vec<f64> {
        let corners = samples / PATCH_PX + 2;
        let above = line / PATCH_PX;
        let down = smooth(line % PATCH_PX);
        let rows: [Vec<f64>; 2] = [above, above + 1].map(|at| {
            let mut random = ChaCha8Rng::seed_from_u64(self.seed);
            random.set_stream(STREAMS + at as u64);
            StandardNormal.sample_iter(&mut random).take(corners).collect()
        });
        (0..samples)
            .map(|sample: usize| {
                let left = sample / PATCH_PX;
                let across = smooth(sample % PATCH_PX);
                let mut sum = 0.0;
                let mut squares = 0.0;
                for (row, down) in rows.iter().zip([1.0 - down, down]) {
                    for (at, across) in [(left, 1.0 - across), (left + 1, across)] {
                        sum += down * across * row[at];
                        squares += (down * across).powi(2);
                    }
                }
                // The weights' squares make the deviation equal between corners and at them.
                1.0 + self.relative * sum / squares.sqrt()
            })
            .collect()
    }

    /// Replaces the surface of a spectrum by one with k1 times `factor`.
    pub fn exchange(&self, spectrum: &mut [f64], factor: f64) {
        let k1 = (self.surface.k1 * factor).clamp(0.0, MOST_K1);
        let other = Surface { k1, ..self.surface };
        for value in spectrum {
            let internal = self.surface.internal_from_measured(*value).unwrap_or(0.0);
            *value = other.measured_from_internal(internal);
        }
    }
}

/// Smooth step from 0 to 1 over a patch.
fn smooth(at: usize) -> f64 {
    let x = at as f64 / PATCH_PX as f64;
    x * x * (3.0 - 2.0 * x)
}

/// The blur ends at this distance from its centre, in standard deviations.
const REACH: f64 = 3.5;

/// A Gaussian blur. Beyond the edges we mirror the picture, so that its mean does not change.
#[derive(Debug, Clone, PartialEq)]
pub struct Blur {
    /// Weights from the middle outwards. Over both sides they sum to 1.
    weights: Vec<f64>,
}

impl Blur {
    /// A blur with the standard deviation `pixels`. If you pass 0, it leaves everything as it is.
    #[must_use]
    pub fn new(pixels: f64) -> Self {
        if !(pixels > 0.0 && pixels.is_finite()) {
            return Self { weights: vec![1.0] };
        }
        let reach = (REACH * pixels).ceil() as usize;
        let mut weights: Vec<f64> =
            (0..=reach).map(|at| libm::exp(-0.5 * (at as f64 / pixels).powi(2))).collect();
        let sum = 2.0 * weights.iter().sum::<f64>() - weights[0];
        weights.iter_mut().for_each(|weight| *weight /= sum);
        Self { weights }
    }

    /// Distance in pixels up to which a neighbour counts.
    #[must_use]
    pub fn reach(&self) -> usize {
        self.weights.len() - 1
    }

    /// Lines that you need to blur the lines `rows` of a picture of `lines` lines, in rising order.
    #[must_use]
    pub fn needed(&self, rows: &Range<usize>, lines: usize) -> Vec<usize> {
        let reach = self.reach() as i64;
        let first = rows.start as i64 - reach;
        let end = rows.end as i64 + reach;
        let mut needed: Vec<usize> = (first..end).map(|line| mirrored(line, lines)).collect();
        needed.sort_unstable();
        needed.dedup();
        needed
    }

    /// The blurred line `line` of a picture of `lines` lines and `samples` columns. `of(line)` must
    /// give the numbers of a line, pixel by pixel.
    pub fn line<'l>(
        &self,
        line: usize,
        (lines, samples): (usize, usize),
        of: impl Fn(usize) -> &'l [f64],
    ) -> Vec<f64> {
        let whole = of(line);
        let numbers = whole.len() / samples.max(1);
        let mut down: Vec<f64> = whole.iter().map(|value| self.weights[0] * value).collect();
        for (distance, weight) in self.weights.iter().enumerate().skip(1) {
            let above = of(mirrored(line as i64 - distance as i64, lines));
            let below = of(mirrored(line as i64 + distance as i64, lines));
            for ((sum, a), b) in down.iter_mut().zip(above).zip(below) {
                *sum += weight * (a + b);
            }
        }
        let mut both = vec![0.0; down.len()];
        both.par_chunks_mut(numbers.max(1)).enumerate().for_each(|(sample, pixel)| {
            let at = |offset: i64| {
                let place = mirrored(sample as i64 + offset, samples) * numbers;
                &down[place..place + numbers]
            };
            pixel.iter_mut().zip(at(0)).for_each(|(sum, v)| *sum = self.weights[0] * v);
            for (distance, weight) in self.weights.iter().enumerate().skip(1) {
                let left = at(-(distance as i64));
                let right = at(distance as i64);
                for ((sum, a), b) in pixel.iter_mut().zip(left).zip(right) {
                    *sum += weight * (a + b);
                }
            }
        });
        both
    }
}

/// Mirrors a place outside 0 to `count` back inside. The mirror stands at the edge between pixels.
fn mirrored(at: i64, count: usize) -> usize {
    let count = count.max(1) as i64;
    let inside = at.rem_euclid(2 * count);
    (if inside < count { inside } else { 2 * count - 1 - inside }) as usize
}

/// Interpolates spectra on a grid at the wavelengths of bands.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct CameraBands {
    pub(crate) nm: Vec<f64>,
    /// For each band the first wavelength of the grid that counts, and the weights from there on.
    rows: Vec<(usize, Vec<f64>)>,
}

impl CameraBands {
    /// Places `count` bands evenly over the wavelengths of `grid` that the camera sees.
    pub(crate) fn new(grid: Grid, count: usize) -> Result<Self, CameraError> {
        let first = grid.start_nm().max(RANGE_NM[0]);
        let last = grid.end_nm().min(RANGE_NM[1]);
        if first >= last {
            return Err(CameraError::Wavelengths(grid));
        }
        let nm: Vec<f64> = (0..count)
            .map(|band| first + (last - first) * band as f64 / (count.max(2) - 1) as f64)
            // Three digits, which the header holds.
            .map(|nm| ((nm * 1000.0).round() / 1000.0).clamp(first, last))
            .collect();
        let units = (0..grid.count()).map(|at| {
            let unit = (0..grid.count()).map(|other| f64::from(u8::from(other == at))).collect();
            Spectrum::<Response>::new(grid, unit).map_err(|_| CameraError::Wavelengths(grid))
        });
        let units = units.collect::<Result<Vec<_>, _>>()?;
        let method = Interpolation::best_for(grid);
        let rows = nm
            .iter()
            .map(|nm: &f64| {
                let weights = units.iter().map(|unit| unit.at(*nm, method, Extrapolation::Refuse));
                let weights = weights
                    .collect::<Result<Vec<f64>, _>>()
                    .map_err(|_| CameraError::Wavelengths(grid))?;
                let first = weights.iter().position(|weight| *weight != 0.0).unwrap_or(0);
                let last = weights.iter().rposition(|weight| *weight != 0.0);
                let end = last.map_or(first, |last| last + 1);
                Ok((first, weights[first..end].to_vec()))
            })
            .collect::<Result<_, CameraError>>()?;
        Ok(Self { nm, rows })
    }

    /// Values of a spectrum in each band.
    pub(crate) fn values(&self, spectrum: &[f64]) -> impl Iterator<Item = f64> {
        self.rows.iter().map(|(first, weights)| {
            weights.iter().zip(&spectrum[*first..]).map(|(weight, value)| weight * value).sum()
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use spectra::optics::Specular;

    fn scene() -> Scene {
        Scene {
            lines: 11,
            samples: 7,
            grid: Grid::from_range(400.0, 700.0, 10.0).unwrap(),
            surface: Surface::of_most_paints(Specular::Included),
        }
    }

    /// Spectra that differ from pixel to pixel, above k1.
    fn exact(line: usize) -> Vec<f64> {
        (0..7 * 31).map(|at| 0.05 + ((line * 57 + at * 13) % 89) as f64 / 100.0).collect()
    }

    #[test]
    fn rows_are_the_same_in_blocks_of_any_size() {
        let camera = Camera::new(scene(), &CameraSettings::default()).unwrap();
        let whole = camera.rows(0..11, &exact);
        assert_eq!((whole.told.len(), whole.mean.len()), (11 * 7 * 31, 11 * 7));
        for size in [1, 4] {
            let blocks = (0..11).step_by(size).map(|start| start..(start + size).min(11));
            let blocks: Vec<SimulatedRows> = blocks.map(|rows| camera.rows(rows, &exact)).collect();
            let told: Vec<f32> = blocks.iter().flat_map(|block| block.told.clone()).collect();
            let mean: Vec<f32> = blocks.iter().flat_map(|block| block.mean.clone()).collect();
            assert_eq!(SimulatedRows { told, mean }, whole, "blocks of {size} rows");
        }
    }

    #[test]
    fn an_even_scene_stays_even_but_for_drift() {
        let quiet = CameraSettings {
            shot_noise: 0.0,
            read_noise: 0.0,
            surface: 0.0,
            bands: 50,
            ..CameraSettings::default()
        };
        let camera = Camera::new(scene(), &quiet).unwrap();
        let rows = camera.rows(0..11, &|_| vec![0.5; 7 * 31]);
        for (line, told) in rows.told.chunks_exact(7 * 50).enumerate() {
            let expected = 0.5 * (1.0 + 0.01 * line as f32 / 10.0);
            assert!(told.iter().all(|value| (value - expected).abs() < 1e-6), "line {line}");
        }
        assert!(rows.mean.iter().all(|mean| (mean - 0.5).abs() < 1e-6), "without drift");
    }

    #[test]
    fn what_the_camera_cannot_take_is_told() {
        let wrong = CameraSettings { blur_px: f64::NAN, ..CameraSettings::default() };
        let error = Camera::new(scene(), &wrong).unwrap_err();
        assert_eq!(error.to_string(), "blur of the camera must be 0 to 20, found `NaN`");
        let none = Scene { samples: 0, ..scene() };
        let error = Camera::new(none, &CameraSettings::default()).unwrap_err();
        assert_eq!(error, CameraError::Size { lines: 11, samples: 0 });
    }

    const SENSOR: Sensor = Sensor { shot_noise: 0.02, read_noise: 0.01, drift: 0.1, seed: 3 };

    #[test]
    fn the_noise_has_the_variance_that_was_asked_for() {
        for (value, expected) in [(0.0, 0.0001_f64), (0.25, 0.0002), (1.0, 0.0005)] {
            let told = SENSOR.told(&[value; 40_000], 0, 9);
            let mean = told.iter().map(|v| f64::from(*v)).sum::<f64>() / told.len() as f64;
            let squares = told.iter().map(|v| (f64::from(*v) - value).powi(2));
            let variance = squares.sum::<f64>() / told.len() as f64;
            assert!((mean - value).abs() < 4.0 * (expected / 40_000.0).sqrt(), "{mean}");
            assert!((variance / expected - 1.0).abs() < 0.03, "{variance}, not {expected}");
        }
    }

    #[test]
    fn the_white_drifts_evenly_along_the_scan() {
        let quiet = Sensor { shot_noise: 0.0, read_noise: 0.0, ..SENSOR };
        for (line, expected) in [(0, 0.5), (50, 0.525), (100, 0.55)] {
            let told = quiet.told(&[0.5], line, 101);
            assert!((f64::from(told[0]) - expected).abs() < 1e-6, "line {line}: {told:?}");
        }
        assert_eq!(quiet.gain(0, 1), 1.0, "a single line");
    }

    #[test]
    fn lines_have_noise_of_their_own_and_the_same_again() {
        let once = SENSOR.told(&[0.5; 8], 4, 9);
        assert_eq!(SENSOR.told(&[0.5; 8], 4, 9), once);
        let other = Sensor { seed: 4, drift: 0.0, ..SENSOR };
        let own = Sensor { drift: 0.0, ..SENSOR };
        assert_ne!(own.told(&[0.5; 8], 4, 9), own.told(&[0.5; 8], 5, 9));
        assert_ne!(own.told(&[0.5; 8], 4, 9), other.told(&[0.5; 8], 4, 9));
    }

    fn varied(relative: f64) -> SurfaceVariation {
        let surface = Surface::of_most_paints(Specular::Included);
        SurfaceVariation { surface, relative, seed: 5 }
    }

    #[test]
    fn the_factors_have_the_mean_and_the_deviation_that_were_asked_for() {
        let all: Vec<f64> = (0..1600).flat_map(|line| varied(0.2).factors(line, 1600)).collect();
        let count = all.len() as f64;
        let mean = all.iter().sum::<f64>() / count;
        let sd = (all.iter().map(|f| (f - mean).powi(2)).sum::<f64>() / count).sqrt();
        // 10,000 corners are independent.
        assert!((mean - 1.0).abs() < 0.008 && (sd - 0.2).abs() < 0.008, "{mean} {sd}");
        let line = varied(0.2).factors(7, 400);
        let steps = line.windows(2).map(|pair| (pair[1] - pair[0]).abs());
        assert!(steps.fold(0.0, f64::max) < 0.2, "neighbours are alike");
    }

    #[test]
    fn another_surface_keeps_the_film_below_it() {
        let varied = varied(0.2);
        let mut spectrum = [0.03, 0.2, 0.9];
        varied.exchange(&mut spectrum, 1.0);
        for (found, expected) in spectrum.iter().zip([0.03, 0.2, 0.9]) {
            assert!((found - expected).abs() < 1e-12, "{found}");
        }
        varied.exchange(&mut spectrum, 1.5);
        assert!((spectrum[0] - 0.045).abs() < 1e-12, "black shows the surface alone");
        let dull = Surface { k1: 0.045, ..varied.surface };
        let internal = varied.surface.internal_from_measured(0.2).unwrap();
        assert!((dull.internal_from_measured(spectrum[1]).unwrap() - internal).abs() < 1e-12);
    }

    fn blurred(blur: &Blur, picture: &[Vec<f64>], samples: usize) -> Vec<Vec<f64>> {
        let size = (picture.len(), samples);
        (0..picture.len()).map(|line| blur.line(line, size, |line| &picture[line])).collect()
    }

    #[test]
    fn the_mean_of_each_number_stays_also_in_pictures_smaller_than_the_blur() {
        let blur = Blur::new(1.5);
        for (lines, samples) in [(9, 13), (2, 3), (1, 1)] {
            let picture: Vec<Vec<f64>> = (0..lines)
                .map(|line| (0..samples * 2).map(|at| value(line, at)).collect())
                .collect();
            let found = blurred(&blur, &picture, samples);
            for number in 0..2 {
                let [before, after] = [&picture, &found].map(|all| {
                    all.iter().flat_map(|line| line.iter().skip(number).step_by(2)).sum::<f64>()
                });
                assert!((before - after).abs() < 1e-9 * before.max(1.0), "{before} {after}");
            }
        }
    }

    fn value(line: usize, at: usize) -> f64 {
        ((line * 31 + at * 17) % 23) as f64
    }

    #[test]
    fn a_point_becomes_a_gaussian_of_the_width_that_was_asked_for() {
        let mut picture = vec![vec![0.0; 41]; 41];
        picture[20][20] = 1.0;
        let found = blurred(&Blur::new(1.5), &picture, 41);
        let mut across = 0.0;
        let mut down = 0.0;
        for (y, x) in (0..41).flat_map(|y| (0..41).map(move |x| (y, x))) {
            across += (x as f64 - 20.0).powi(2) * found[y][x];
            down += (y as f64 - 20.0).powi(2) * found[y][x];
        }
        assert!((across - 2.25).abs() < 0.03 && (down - 2.25).abs() < 0.03, "{across} {down}");
        assert_eq!(blurred(&Blur::new(0.0), &picture, 41), picture, "no blur");
    }

    #[test]
    fn the_lines_that_are_needed_lie_inside() {
        let blur = Blur::new(1.0);
        assert_eq!(blur.reach(), 4);
        assert_eq!(blur.needed(&(0..2), 100), [0, 1, 2, 3, 4, 5]);
        assert_eq!(blur.needed(&(50..51), 100), [46, 47, 48, 49, 50, 51, 52, 53, 54]);
        assert_eq!(blur.needed(&(0..2), 3), [0, 1, 2]);
    }

    #[test]
    fn bands_lie_evenly_and_take_smooth_spectra_as_they_are() {
        let grid = Grid::from_range(380.0, 700.0, 10.0).unwrap();
        let bands = CameraBands::new(grid, 31).unwrap();
        let expected: Vec<f64> = (0..31).map(|band| 400.0 + 10.0 * f64::from(band)).collect();
        assert_eq!(bands.nm, expected);
        let spectrum: Vec<f64> = grid.wavelengths_nm().map(|nm| (nm / 60.0).sin()).collect();
        let at: Vec<f64> = bands.values(&spectrum).collect();
        assert!(at.iter().zip(&spectrum[2..]).all(|(a, b)| (a - b).abs() < 1e-12), "on the grid");
        let fine = CameraBands::new(grid, 204).unwrap();
        assert_eq!((fine.nm[0], fine.nm[203]), (400.0, 700.0));
        for (nm, value) in fine.nm.iter().zip(fine.values(&spectrum)) {
            // The last intervals are bounded by extrapolated values.
            let most = if (420.0..670.0).contains(nm) { 1e-5 } else { 2e-3 };
            assert!((value - (nm / 60.0).sin()).abs() < most, "{nm}: {value}");
        }
    }

    #[test]
    fn the_range_is_that_of_the_camera() {
        let long = Grid::from_range(300.0, 2500.0, 10.0).unwrap();
        let bands = CameraBands::new(long, 4).unwrap();
        assert_eq!(bands.nm, [400.0, 600.0, 800.0, 1000.0]);
        let infrared = Grid::from_range(1200.0, 2500.0, 10.0).unwrap();
        let error = CameraBands::new(infrared, 4).unwrap_err().to_string();
        assert!(error.contains("1200 to 2500 nm"), "{error}");
    }
}
