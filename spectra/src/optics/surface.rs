//! The surface of a film: what air and paint reflect between them.

use serde::{Deserialize, Serialize};

use crate::hint::Explain;

/// Whether the instrument catches the mirror reflection of the surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Specular {
    /// Sphere with the specular component included (SCI, d/8:i).
    #[default]
    Included,
    /// Excluded (SCE), or a 45/0 geometry.
    Excluded,
}

/// Saunderson's correction for reflection at the surface (Saunderson 1942).
///
/// | symbol | meaning                                          | usual |
/// |--------|--------------------------------------------------|-------|
/// | k1     | share of the arriving light the surface reflects | 0.03 to 0.04 |
/// | k2     | share of the diffuse light turned back inside    | 0.4 to 0.6 |
///
/// Measured from internal R: `k1 + (1 - k1)(1 - k2) R / (1 - k2 R)`, the first
/// term missing where the specular component is excluded.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "SurfaceParts")]
pub struct Surface {
    /// Share of the arriving light reflected, 0..1.
    pub k1: f64,
    /// Share of the diffuse light turned back inside, 0..1.
    pub k2: f64,
    /// Whether the readings hold the mirror reflection.
    pub specular: Specular,
}

impl Surface {
    /// No surface: measured is internal.
    pub const NONE: Self = Self { k1: 0.0, k2: 0.0, specular: Specular::Included };

    /// A surface with these shares.
    ///
    /// # Errors
    /// [`SurfaceError`] unless both lie in 0..1 (1 excluded).
    pub fn new(k1: f64, k2: f64, specular: Specular) -> Result<Self, SurfaceError> {
        for (name, value) in [("k1", k1), ("k2", k2)] {
            if !(0.0..1.0).contains(&value) {
                return Err(SurfaceError::Share { name, value });
            }
        }
        Ok(Self { k1, k2, specular })
    }

    /// The least that can be measured: that of a black body below the surface.
    #[must_use]
    pub fn floor(&self) -> f64 {
        match self.specular {
            Specular::Included => self.k1,
            Specular::Excluded => 0.0,
        }
    }

    /// What an instrument reads of the internal reflectance.
    #[must_use]
    pub fn measured_from_internal(&self, internal: f64) -> f64 {
        self.floor() + (1.0 - self.k1) * (1.0 - self.k2) * internal / (1.0 - self.k2 * internal)
    }

    /// The slope of [`Surface::measured_from_internal`].
    #[must_use]
    pub fn measured_slope(&self, internal: f64) -> f64 {
        (1.0 - self.k1) * (1.0 - self.k2) / (1.0 - self.k2 * internal).powi(2)
    }

    /// The reflectance below the surface, from what an instrument read.
    ///
    /// # Errors
    /// [`SurfaceError::BelowFloor`] for a reading below what the surface alone
    /// reflects.
    pub fn internal_from_measured(&self, measured: f64) -> Result<f64, SurfaceError> {
        let above = measured - self.floor();
        if above < 0.0 {
            return Err(SurfaceError::BelowFloor { measured, floor: self.floor() });
        }
        Ok(above / ((1.0 - self.k1) * (1.0 - self.k2) + self.k2 * above))
    }
}

/// The form in which a surface is read from a file.
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

/// A surface or a reading that cannot be.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum SurfaceError {
    /// A share outside 0..1.
    #[error("{name} is a share from 0 to below 1, found `{value}`")]
    Share {
        /// `k1` or `k2`.
        name: &'static str,
        /// What was given.
        value: f64,
    },
    /// A reading below k1.
    #[error("a reading below what the surface alone reflects (k1 = {floor}), found `{measured}`")]
    BelowFloor {
        /// The reading.
        measured: f64,
        /// What the surface reflects.
        floor: f64,
    },
}

impl Explain for SurfaceError {}
