//! Settings of a photograph painted in strokes, and the plan of its strokes that follows from
//! them: brushes from coarse to fine, and rules for each of them.

use documents::hint::Explain;
use paint::document::Canvas;
use paint::ground::GroundKind;
use paint::strokes::MAX_CELLS;
use serde::{Deserialize, Serialize};

/// Least width of a brush in cells. A narrower one lays no even line.
const NARROWEST_CELLS: f64 = 2.0;
/// Least width of a brush in mm.
const NARROWEST_MM: f64 = 0.2;
/// Greatest width of a brush in mm.
const BROADEST_MM: f64 = 100.0;

/// How to paint a photograph in strokes, or to separate it into pigments.
#[derive(Debug, Clone, PartialEq)]
pub struct StrokeSettings {
    /// Title of the painting, empty by default.
    pub title: String,
    /// Width of the painting in mm, 5 to 5000, by default 200. Its height follows the shape
    /// of the photograph.
    pub width_mm: f64,
    /// Width and height of a cell in mm, 0.02 to 5, by default 0.25. Time grows with the
    /// square of the resolution.
    pub cell_mm: f64,
    /// Ground to paint on, by default linen.
    pub ground: GroundKind,
    /// Names of up to eight pigments of the library. If empty (the default), those are chosen
    /// that come nearest to the photograph's colours.
    pub palette: Vec<String>,
    /// Widths of the brushes in mm in any order: two cells or more, 0.2 to 100 mm, and not
    /// wider than the painting. If empty (the default), 16, 8, 4, 2 and 1 mm for a painting
    /// 200 mm wide, and in proportion.
    pub brushes_mm: Vec<f64>,
    /// Difference in CIELAB (CIE 1976) above which strokes are painted, 0.5 to 100, by
    /// default 6. Less takes more strokes.
    pub tolerance: f64,
    /// Seed of all random choices, by default 1.
    pub seed: u64,
    /// Whether paint must hide the ground, by default true. If false, the ground may show
    /// through, which reaches lighter and more saturated colours. That is for separations
    /// only: strokes overlap, so their paint must hide.
    pub hides: bool,
}

impl Default for StrokeSettings {
    fn default() -> Self {
        Self {
            title: String::new(),
            width_mm: 200.0,
            cell_mm: 0.25,
            ground: GroundKind::Linen,
            palette: Vec::new(),
            brushes_mm: Vec::new(),
            tolerance: 6.0,
            seed: 1,
            hides: true,
        }
    }
}

impl StrokeSettings {
    /// Checks the ranges of all numbers.
    ///
    /// # Errors
    /// [`StrokeSettingsError::OutOfRange`] for the first number out of range.
    pub fn check(&self) -> Result<(), StrokeSettingsError> {
        let broadest = self.width_mm.min(BROADEST_MM);
        let numbers = [
            ("width_mm", self.width_mm, 5.0, 5000.0),
            ("cell_mm", self.cell_mm, 0.02, 5.0),
            ("tolerance", self.tolerance, 0.5, 100.0),
        ];
        let brushes =
            self.brushes_mm.iter().map(|&mm| ("brushes_mm", mm, self.narrowest_mm(), broadest));
        for (setting, value, least, most) in numbers.into_iter().chain(brushes) {
            if !(least..=most).contains(&value) {
                return Err(StrokeSettingsError::OutOfRange { setting, value, least, most });
            }
        }
        Ok(())
    }

    /// Canvas for a photograph of this width and height in pixels.
    ///
    /// # Errors
    /// [`StrokeSettingsError`] for a number out of range, and a canvas of too many cells.
    pub fn canvas(&self, (width, height): (usize, usize)) -> Result<Canvas, StrokeSettingsError> {
        self.check()?;
        let columns = (self.width_mm / self.cell_mm).round().max(1.0);
        let rows = (columns * height as f64 / width as f64).round().max(1.0);
        if columns * rows > MAX_CELLS as f64 {
            return Err(StrokeSettingsError::TooManyCells { columns, rows });
        }
        Ok(Canvas {
            width_mm: columns * self.cell_mm,
            height_mm: rows * self.cell_mm,
            cell_mm: self.cell_mm,
            ground: self.ground.spec(1),
        })
    }

    /// Plan of the strokes, its brushes from coarse to fine.
    pub(super) fn plan(&self) -> Plan {
        let mut plan = Plan::for_width(self.width_mm);
        plan.sizes_mm.retain(|size| *size >= self.narrowest_mm());
        if !self.brushes_mm.is_empty() || plan.sizes_mm.is_empty() {
            plan.sizes_mm.clone_from(&self.brushes_mm);
        }
        plan.sizes_mm.sort_by(|a, b| b.total_cmp(a));
        Plan { tolerance: self.tolerance, seed: self.seed, ..plan }
    }

    fn narrowest_mm(&self) -> f64 {
        (NARROWEST_CELLS * self.cell_mm).max(NARROWEST_MM)
    }
}

/// The settings of a photograph in strokes are invalid.
#[derive(Debug, Clone, PartialEq, thiserror::Error, Explain)]
#[fault(Setting)]
pub enum StrokeSettingsError {
    /// A number is out of its range.
    #[error("{setting} is {least} to {most}, found `{value}`")]
    #[hint(if *setting == "width_mm", "200 mm is usual")]
    #[hint(if *setting == "cell_mm", "0.25 mm is usual, 0.1 mm is fine")]
    #[hint(if *setting == "tolerance", "6 is usual; 3 paints more strokes")]
    #[hint(
        "brushes are two cells wide or more, at most 100 mm, none wider than the painting; [cell_mm] takes smaller cells"
    )]
    OutOfRange {
        /// Field of [`StrokeSettings`], for example `width_mm`.
        setting: &'static str,
        /// Value of the field.
        value: f64,
        /// Least value allowed.
        least: f64,
        /// Greatest value allowed.
        most: f64,
    },
    /// The canvas has more cells than a script of strokes allows.
    #[error("a canvas has at most {MAX_CELLS} cells, found `{columns} x {rows}`")]
    #[hint("take larger cells ([cell_mm]) or a smaller painting ([width_mm])")]
    TooManyCells {
        /// Columns of cells, a whole number.
        columns: f64,
        /// Rows of cells, a whole number.
        rows: f64,
    },
}

/// Order of the strokes of one brush.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Order {
    /// Random order, from the seed.
    #[default]
    Shuffled,
    /// Dark before light, like oil painters. Random among strokes within the same 5 units
    /// of L*.
    DarkToLight,
}

/// Plan for painting a photograph, one level per brush. Lengths without a unit are in widths
/// of the level's brush.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Plan {
    /// Width of the brush of each level in mm, coarse to fine, 0.05 to 1000.
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
    /// Thickness in mm that white strokes have at least, 0.001 to 10. A brush lays at most
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
        if self.sizes_mm.is_empty() {
            return Err(PlanError::NoBrush);
        }
        if let Some(&size) = self.sizes_mm.iter().find(|size| !(0.05..=1000.0).contains(*size)) {
            let wanted = "0.05 to 1000 mm";
            return Err(PlanError::Number { field: "sizes_mm", value: size, wanted });
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
                return Err(PlanError::Number { field, value, wanted });
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
