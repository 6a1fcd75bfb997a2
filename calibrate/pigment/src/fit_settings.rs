//! Settings of a fit. They are in this crate because a library's file contains the settings of its fit.

use serde::{Deserialize, Serialize};

/// Method by which K and S are found; the crate `calibrate` describes each.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Method {
    /// The quadratic program as published (Baxter, Wendt and Lin 2004, section 5.2).
    Qp,
    /// The quadratic program with rows weighted into errors of reflectance.
    Weighted,
    /// Nonlinear refinement in measured reflectance, started from `Weighted`.
    #[default]
    Refined,
}

/// Strength of the smoothing of K and S over wavelength.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Smoothness {
    /// No smoothing: every wavelength is fitted by itself.
    None,
    /// The weight under which the data are most likely (MacKay 1992, eq. 2.18).
    #[default]
    Auto,
    /// A given weight, 0 and up, on the squared second differences of log K and log S, in units of
    /// the residual's variance, for a wavelength step of 10 nm.
    Fixed(f64),
}

/// Treatment of a reading below the surface's own reflection k1.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum BelowSurface {
    /// Return an error that names sample and wavelength: k1 is too high for this paint.
    #[default]
    Refuse,
    /// Replace it with an internal reflectance of 0.001, which stands for black.
    Floor,
}

/// Every setting that changes the result of a fit; kept in the library's file.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FitSettings {
    /// Method of the fit; absolute amounts always take their own.
    pub method: Method,
    /// Smoothing over wavelength; only `refined` and absolute amounts use it.
    pub smoothness: Smoothness,
    /// Treatment of readings below the surface's own reflection.
    pub below_surface: BelowSurface,
    /// Names of the samples that were left out.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub excluded: Vec<String>,
}
