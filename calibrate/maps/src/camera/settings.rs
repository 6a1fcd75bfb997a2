//! Settings of a simulated camera.

use documents::hint::{Explain, Fault, Hint};
use spectra::Grid;

/// Range of wavelengths in nm that the camera sees, where the spectra of the scene reach so far.
pub(crate) const RANGE_NM: [f64; 2] = [400.0, 1000.0];

/// Settings of a simulated camera.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CameraSettings {
    /// Number of bands, 2 to 2000, evenly spaced from 400 to 1000 nm or over what the scene has of it.
    pub bands: usize,
    /// Standard deviation of the blur in pixels, 0 to 20.
    pub blur_px: f64,
    /// Standard deviation of the shot noise at a reflectance of 1, 0 to 0.5. It grows with the square root
    /// of the reflectance.
    pub shot_noise: f64,
    /// Standard deviation of the noise of reading, in reflectance, 0 to 0.5.
    pub read_noise: f64,
    /// Relative change of the white from the first to the last line, -0.5 to 0.5: values of the last line
    /// are too high by this part.
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
    /// Checks every setting.
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

/// A scene or settings that the camera cannot take.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CameraError {
    /// A setting is out of its range.
    #[error("{name} of the camera must be {least} to {most}, found `{value}`")]
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
    #[error(
        "the camera sees {} to {} nm, the spectra of the scene go from {} to {} nm",
        RANGE_NM[0], RANGE_NM[1], grid.start_nm(), grid.end_nm()
    )]
    Wavelengths {
        /// Wavelengths of the scene.
        grid: Grid,
    },
}

impl Explain for CameraError {
    fn hint(&self) -> Option<Hint> {
        match self {
            Self::Setting { name, .. } => Some(Hint::new(format!("give another [{name}]"))),
            Self::Size { .. } => None,
            Self::Wavelengths { .. } => {
                Some(Hint::new("paint with a library of visible or near infrared wavelengths"))
            }
        }
    }

    fn fault(&self) -> Fault {
        match self {
            Self::Setting { .. } => Fault::Setting,
            _ => Fault::Input,
        }
    }
}
