//! Rows of a scene as the camera tells them, with the paint that is really there.

use std::collections::BTreeMap;
use std::ops::Range;

use rayon::prelude::*;
use spectra::Grid;
use spectra::optics::Surface;

use super::bands::CameraBands;
use super::blur::Blur;
use super::sensor::Sensor;
use super::settings::{CameraError, CameraSettings};
use super::surface_variation::SurfaceVariation;

/// A scene whose exact spectra are known.
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
    /// Reflectances as the camera tells them, those of all bands of one pixel after another.
    pub told: Vec<f32>,
    /// Mean over the bands of the reflectance of each pixel, blurred, without drift and noise.
    pub mean: Vec<f32>,
}

/// A simulated camera before a scene.
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
    /// [`CameraError`] if a setting is out of its range, or the spectra of the scene are out of those that the
    /// camera sees.
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

    /// The scene before the camera.
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

    /// Rows as the camera tells them. `exact(line)` gives the measured reflectances of a row of the scene, those of
    /// all its wavelengths of one pixel after another; it is called for the rows and for those that the blur
    /// brings in.
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

    /// Rows of any numbers of the scene, blurred as the camera blurs light. `of(line)` gives the numbers of a
    /// row, those of one pixel after another.
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

#[cfg(test)]
mod tests {
    use spectra::optics::Specular;

    use super::*;

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
}
