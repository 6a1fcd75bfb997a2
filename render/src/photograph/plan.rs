//! How a photograph is painted: brushes from coarse to fine, and their strokes.

use serde::{Deserialize, Serialize};

/// In which order the strokes of one level are laid.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Order {
    /// Shuffled by the seed.
    #[default]
    Shuffled,
    /// Dark before light, as oil painters do; shuffled among equals of lightness
    /// (to 5 units of L*).
    DarkToLight,
}

/// How a photograph is painted. Lengths are in sizes of the level's brush.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Plan {
    /// The brush of each level: its width in mm, coarse to fine.
    pub sizes_mm: Vec<f64>,
    /// The difference in CIELAB (CIE 1976) from which a place is painted (over).
    /// Lower paints more strokes.
    pub tolerance: f64,
    /// How far, in CIELAB, the picture may depart from a stroke's colour along
    /// the stroke.
    pub departure: f64,
    /// The least length of a stroke.
    pub shortest: f64,
    /// The greatest length.
    pub longest: f64,
    /// Sides of the squares in each of which a stroke may begin.
    pub spacing: f64,
    /// From 0, straight strokes, to 1, strokes that follow every turn.
    pub bending: f64,
    /// The most strokes of a level; those where the difference is largest are kept.
    pub most_strokes: usize,
    /// Pressure in the middle of a stroke, 0..1.
    pub pressure: f64,
    /// Pressure at both ends, as a share of that.
    pub ends: f64,
    /// How fast the brush moves, in its sizes a second.
    pub speed: f64,
    /// The order within a level.
    pub order: Order,
    /// Of everything drawn by lot.
    pub seed: u64,
}

impl Default for Plan {
    /// For a painting some 200 mm wide.
    fn default() -> Self {
        Self {
            sizes_mm: vec![16.0, 8.0, 4.0, 2.0, 1.0],
            tolerance: 6.0,
            departure: 15.0,
            shortest: 1.5,
            longest: 8.0,
            spacing: 0.5,
            bending: 0.7,
            most_strokes: 30_000,
            pressure: 0.9,
            ends: 0.25,
            speed: 10.0,
            order: Order::Shuffled,
            seed: 1,
        }
    }
}

impl Plan {
    /// The default, its brushes in proportion to a canvas of this width.
    #[must_use]
    pub fn for_width(width_mm: f64) -> Self {
        let plan = Self::default();
        let sizes_mm = plan.sizes_mm.iter().map(|size| size * width_mm / 200.0).collect();
        Self { sizes_mm, ..plan }
    }

    /// Whether every number can be used.
    ///
    /// # Errors
    /// [`PlanError`] naming the first that cannot.
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

/// A plan that cannot be carried out.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum PlanError {
    /// No level.
    #[error("a plan has at least one brush size, found `0`")]
    NoBrush,
    /// A number out of range.
    #[error("{field} is {wanted}, found `{value}`")]
    Number {
        /// Its name.
        field: &'static str,
        /// What was given.
        value: f64,
        /// What can be used.
        wanted: &'static str,
    },
}
