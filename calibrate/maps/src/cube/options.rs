//! Settings for opening a cube.

use std::path::{Path, PathBuf};

use super::error::CubeError;

/// Scale of the values of a cube.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum CubeScale {
    /// By the file; where it does not tell, values up to 2 are fractions and up to 200 percent, if
    /// they are no integers.
    #[default]
    ByFile,
    /// A white reads about 1.
    Fraction,
    /// A white reads about 100.
    Percent,
    /// A white reads about this number.
    White(f64),
}

/// Dark reading of a camera.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub enum DarkReading {
    /// None is given.
    #[default]
    Missing,
    /// The camera's program subtracted it already.
    Subtracted,
    /// A scan with the shutter closed, at the settings of the scan.
    File(PathBuf),
}

/// Settings for opening a cube.
#[derive(Debug, Clone, PartialEq)]
pub struct CubeOptions {
    /// A scan of a white at the settings of the scan, for raw counts.
    pub white_reading: Option<PathBuf>,
    /// The dark that belongs to it.
    pub dark_reading: DarkReading,
    /// Reflectance of that white.
    pub tile: f64,
    /// Scale of the values.
    pub scale: CubeScale,
    /// Largest count of the detector; guessed where it is not given.
    pub full_scale: Option<f64>,
    /// File with the wavelengths of the bands, for cubes that name none.
    pub wavelengths: Option<PathBuf>,
    /// Name of the array, for Zarr groups that hold several.
    pub variable: Option<String>,
    /// Folder for the unpacked values of packed images; the system's folder for temporary files where
    /// none is given.
    pub scratch: Option<PathBuf>,
}

impl Default for CubeOptions {
    fn default() -> Self {
        Self {
            white_reading: None,
            dark_reading: DarkReading::Missing,
            tile: 1.0,
            scale: CubeScale::ByFile,
            full_scale: None,
            wavelengths: None,
            variable: None,
            scratch: None,
        }
    }
}

impl CubeOptions {
    /// Checks the range of every number; `path` is the scan's name in messages.
    pub(crate) fn check(&self, path: &Path) -> Result<(), CubeError> {
        let fault = |name: &str, found: f64| {
            let problem =
                format!("the setting `{name}` must be above 0 and finite, found `{found}`");
            CubeError::format(path, problem, format!("give a number with [{name}]"))
        };
        if !(self.tile > 0.0 && self.tile <= 1.2) {
            let problem = format!(
                "the white's reflectance must be above 0 and at most 1.2, found `{}`",
                self.tile
            );
            return Err(CubeError::format(path, problem, "give a fraction, such as [tile=0.99]"));
        }
        if let CubeScale::White(white) = self.scale
            && !(white.is_finite() && white > 0.0)
        {
            return Err(fault("scale", white));
        }
        match self.full_scale {
            Some(full) if !(full.is_finite() && full > 0.0) => Err(fault("full_scale", full)),
            _ => Ok(()),
        }
    }
}
