//! Reflection at the surface of a film, between air and paint.

use serde::{Deserialize, Serialize};

use documents::hint::{Explain, Fault};

/// Whether readings contain the specular reflection at the surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Specular {
    /// Included: a sphere instrument with a closed gloss trap (SCI, d/8:i).
    #[default]
    Included,
    /// Excluded: a sphere with an open gloss trap (SCE), or a 45/0 geometry.
    Excluded,
}

/// Saunderson's correction for reflection at the surface (Saunderson 1942).
///
/// | symbol | meaning                                                 | usual |
/// |--------|---------------------------------------------------------|-------|
/// | k1     | fraction of the incident light reflected at the surface | 0.03 to 0.04 |
/// | k2     | fraction of the diffuse internal light reflected back   | 0.4 to 0.6 |
///
/// A film of internal reflectance R has the measured reflectance `k1 + (1 - k1)(1 - k2) R / (1
/// - k2 R)`, without the first term if the specular component is excluded.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "SurfaceParts")]
pub struct Surface {
    /// Fraction of the incident light that the surface reflects, 0 to below 1.
    pub k1: f64,
    /// Fraction of the diffuse internal light that the surface reflects back, 0 to below 1.
    pub k2: f64,
    /// Whether readings contain the specular reflection.
    pub specular: Specular,
}

impl Surface {
    /// No surface: measured and internal reflectance are equal.
    pub const NONE: Self = Self { k1: 0.0, k2: 0.0, specular: Specular::Included };

    /// A surface with the coefficients k1 and k2.
    ///
    /// # Errors
    /// [`SurfaceError`] unless both are at least 0 and below 1.
    pub fn new(k1: f64, k2: f64, specular: Specular) -> Result<Self, SurfaceError> {
        for (name, value) in [("k1", k1), ("k2", k2)] {
            if !(0.0..1.0).contains(&value) {
                return Err(SurfaceError::Share { name, value });
            }
        }
        Ok(Self { k1, k2, specular })
    }

    /// The surface of most paints: k1 = 0.03 and k2 = 0.6, within the usual ranges of
    /// Saunderson's correction.
    #[must_use]
    pub fn of_most_paints(specular: Specular) -> Self {
        Self { k1: 0.03, k2: 0.6, specular }
    }

    /// The smallest possible measured reflectance: that of a perfectly black film.
    #[must_use]
    pub fn floor(&self) -> f64 {
        match self.specular {
            Specular::Included => self.k1,
            Specular::Excluded => 0.0,
        }
    }

    /// The measured reflectance of a film with the given internal reflectance.
    #[must_use]
    pub fn measured_from_internal(&self, internal: f64) -> f64 {
        self.floor() + (1.0 - self.k1) * (1.0 - self.k2) * internal / (1.0 - self.k2 * internal)
    }

    /// The derivative of [`Surface::measured_from_internal`].
    #[must_use]
    pub fn measured_slope(&self, internal: f64) -> f64 {
        (1.0 - self.k1) * (1.0 - self.k2) / (1.0 - self.k2 * internal).powi(2)
    }

    /// The internal reflectance of a film from its measured reflectance.
    ///
    /// # Errors
    /// [`SurfaceError::BelowFloor`] for a reading below what the surface alone reflects.
    pub fn internal_from_measured(&self, measured: f64) -> Result<f64, SurfaceError> {
        let above = measured - self.floor();
        if above < 0.0 {
            return Err(SurfaceError::BelowFloor { measured, floor: self.floor() });
        }
        Ok(above / ((1.0 - self.k1) * (1.0 - self.k2) + self.k2 * above))
    }
}

/// The fields of a surface in a file.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct SurfaceParts {
    k1: f64,
    k2: f64,
    specular: Specular,
}

impl TryFrom<SurfaceParts> for Surface {
    type Error = SurfaceError;

    fn try_from(parts: SurfaceParts) -> Result<Self, SurfaceError> {
        Self::new(parts.k1, parts.k2, parts.specular)
    }
}

/// Coefficients or a reading that are physically impossible.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum SurfaceError {
    /// A coefficient is outside 0 to 1.
    #[error("{name} is a fraction from 0 to below 1, found `{value}`")]
    Share {
        /// Name of the coefficient, `k1` or `k2`.
        name: &'static str,
        /// The value that was given.
        value: f64,
    },
    /// A reading is below what the surface alone reflects.
    #[error("a reading below what the surface alone reflects (k1 = {floor}), found `{measured}`")]
    BelowFloor {
        /// The measured reflectance.
        measured: f64,
        /// The reflectance of the surface alone.
        floor: f64,
    },
}

impl Explain for SurfaceError {
    fn fault(&self) -> Fault {
        match self {
            Self::Share { .. } => Fault::Setting,
            Self::BelowFloor { .. } => Fault::Input,
        }
    }
}
