//! Plan for painting a photograph: brushes from coarse to fine, and rules for strokes.

use serde::{Deserialize, Serialize};

/// Order of the strokes of one brush.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Order {
    /// Random order, from the seed.
    #[default]
    Shuffled,
    /// Dark before light, like oil painters; random among strokes within the same 5 units
    /// of L*.
    DarkToLight,
}

/// Plan for painting a photograph, one level per brush. Lengths without a unit are in widths
/// of the level's brush.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Plan {
    /// Width of the brush of each level in mm, coarse to fine; 0.05 to 1000.
    pub sizes_mm: Vec<f64>,
    /// Difference in CIELAB (CIE 1976) above which strokes are painted, 0 to 200. Less takes
    /// more strokes.
    pub tolerance: f64,
    /// Greatest difference in CIELAB (CIE 1976), 0 to 1000, between a stroke's colour and the
    /// picture along the stroke.
    pub departure: f64,
    /// Least length of a stroke in brush widths, 0 to 1000.
    pub shortest: f64,
    /// Greatest length of a stroke in brush widths, `shortest` to 1000.
    pub longest: f64,
    /// Side of the squares in each of which one stroke may begin, in brush widths, 0.1 to 100.
    pub spacing: f64,
    /// Curvature of strokes: 0 straight, 1 along the structure of the picture.
    pub bending: f64,
    /// Most strokes of a level. Those with the largest difference are kept.
    pub most_strokes: usize,
    /// Thickness in mm that black strokes have at least, 0.001 to 10.
    pub darks_mm: f64,
    /// Thickness in mm that white strokes have at least, 0.001 to 10; a brush lays at most
    /// 0.06 of its width.
    pub lights_mm: f64,
    /// Pressure of the brush in the middle of a stroke, 0..1.
    pub pressure: f64,
    /// Pressure at both ends of a stroke relative to its middle, 0..1.
    pub ends: f64,
    /// Speed of the brush in brush widths per second, 0.001 to 1e6.
    pub speed: f64,
    /// Order of the strokes of a level.
    pub order: Order,
    /// Seed of all random choices.
    pub seed: u64,
}

impl Default for Plan {
    /// Plan for a painting about 200 mm wide.
    fn default() -> Self {
        Self {
            sizes_mm: vec![16.0, 8.0, 4.0, 2.0, 1.0],
            tolerance: 6.0,
            departure: 12.0,
            shortest: 3.0,
            longest: 12.0,
            spacing: 0.5,
            bending: 0.7,
            most_strokes: 30_000,
            darks_mm: 0.04,
            lights_mm: 0.35,
            pressure: 0.6,
            ends: 0.15,
            speed: 10.0,
            order: Order::DarkToLight,
            seed: 1,
        }
    }
}

impl Plan {
    /// The default plan with brushes in proportion to a canvas of this width in mm.
    #[must_use]
    pub fn for_width(width_mm: f64) -> Self {
        let plan = Self::default();
        let sizes_mm = plan.sizes_mm.iter().map(|size| size * width_mm / 200.0).collect();
        Self { sizes_mm, ..plan }
    }

    /// Checks the ranges of all numbers.
    ///
    /// # Errors
    /// [`PlanError`] for the first number out of range, and for a plan without brushes.
    pub fn check(&self) -> Result<(), PlanError> {
        let fault = |field, value, wanted| Err(PlanError::Number { field, value, wanted });
        if self.sizes_mm.is_empty() {
            return Err(PlanError::NoBrush);
        }
        if let Some(&size) = self.sizes_mm.iter().find(|size| !(0.05..=1000.0).contains(*size)) {
            return fault("sizes_mm", size, "0.05 to 1000 mm");
        }
        for (field, value, least, most, wanted) in [
            ("tolerance", self.tolerance, 0.0, 200.0, "0 to 200"),
            ("departure", self.departure, 0.0, 1000.0, "0 to 1000"),
            ("shortest", self.shortest, 0.0, 1000.0, "0 to 1000 brush sizes"),
            ("longest", self.longest, self.shortest, 1000.0, "from `shortest` to 1000 brush sizes"),
            ("spacing", self.spacing, 0.1, 100.0, "0.1 to 100 brush sizes"),
            ("bending", self.bending, 0.0, 1.0, "0 to 1"),
            ("darks_mm", self.darks_mm, 0.001, 10.0, "0.001 to 10 mm"),
            ("lights_mm", self.lights_mm, 0.001, 10.0, "0.001 to 10 mm"),
            ("pressure", self.pressure, 0.0, 1.0, "0 to 1"),
            ("ends", self.ends, 0.0, 1.0, "0 to 1"),
            ("speed", self.speed, 1e-3, 1e6, "0.001 to 1000000 brush sizes a second"),
        ] {
            if !(least..=most).contains(&value) {
                return fault(field, value, wanted);
            }
        }
        Ok(())
    }
}

/// The numbers of a plan are invalid.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum PlanError {
    /// The plan has no brush.
    #[error("a plan has at least one brush size, found `0`")]
    NoBrush,
    /// A number is out of its range.
    #[error("{field} is {wanted}, found `{value}`")]
    Number {
        /// Name of the field.
        field: &'static str,
        /// Value of the field.
        value: f64,
        /// Human-readable range of the field.
        wanted: &'static str,
    },
}
