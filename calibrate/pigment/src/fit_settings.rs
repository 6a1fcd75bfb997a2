//! Settings of a fit, which the library that it makes keeps in its file.

use serde::{Deserialize, Serialize};

/// How K and S are found; see the module.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Method {
    /// The published quadratic program.
    Qp,
    /// The program, weighted.
    Weighted,
    /// Nonlinear refinement in measured reflectance.
    #[default]
    Refined,
}

/// How strongly K and S are kept smooth over wavelength.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Smoothness {
    /// Not at all: every wavelength by itself.
    None,
    /// As strongly as the data themselves ask for (MacKay 1992).
    #[default]
    Auto,
    /// This weight on the squared second differences of log K and log S, in
    /// units of the residual's variance, for a step of 10 nm.
    Fixed(f64),
}

/// What to do with a reading below what the surface alone reflects.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum BelowSurface {
    /// Refuse, naming sample and wavelength: k1 is too high for this paint.
    #[default]
    Refuse,
    /// Read it as a reflectance of 0.001 below the surface.
    Floor,
}

/// Everything that changes the result of a fit.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FitSettings {
    /// The method.
    pub method: Method,
    /// Smoothness over wavelength; only `refined` and absolute amounts have it.
    pub smoothness: Smoothness,
    /// Readings below the surface's own reflection.
    pub below_surface: BelowSurface,
    /// Samples left out by name.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub excluded: Vec<String>,
}
