//! Settings of a photograph painted in strokes.

use documents::hint::{Explain, Fault, Hint};

use super::plan::Plan;
use paint::canvas::Canvas;
use paint::ground::GroundKind;
use paint::strokes::MAX_CELLS;

/// Least width of a brush in cells; a narrower one lays no even line.
const NARROWEST_CELLS: f64 = 2.0;
/// Least width of a brush in mm.
const NARROWEST_MM: f64 = 0.2;
/// Greatest width of a brush in mm.
const BROADEST_MM: f64 = 100.0;

/// How to paint a photograph in strokes, or to separate it into pigments.
#[derive(Debug, Clone, PartialEq)]
pub struct StrokeSettings {
    /// Title of the painting; empty by default.
    pub title: String,
    /// Width of the painting in mm, 5 to 5000; 200 by default. Its height follows the shape
    /// of the photograph.
    pub width_mm: f64,
    /// Width and height of a cell in mm, 0.02 to 5; 0.25 by default. Time grows with the
    /// square of the resolution.
    pub cell_mm: f64,
    /// Ground to paint on; linen by default.
    pub ground: GroundKind,
    /// Names of up to eight pigments of the library. If empty (the default), those are chosen
    /// that come nearest to the photograph's colours.
    pub palette: Vec<String>,
    /// Widths of the brushes in mm in any order: two cells or more, 0.2 to 100 mm, and not
    /// wider than the painting. If empty (the default), 16, 8, 4, 2 and 1 mm for a painting
    /// 200 mm wide, and in proportion.
    pub brushes_mm: Vec<f64>,
    /// Difference in CIELAB (CIE 1976) above which strokes are painted, 0.5 to 100; 6 by
    /// default. Less takes more strokes.
    pub tolerance: f64,
    /// Seed of all random choices; 1 by default.
    pub seed: u64,
    /// Whether paint must hide the ground; true by default. If false, the ground may show
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
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum StrokeSettingsError {
    /// A number is out of its range.
    #[error("{setting} is {least} to {most}, found `{value}`")]
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
    TooManyCells {
        /// Columns of cells; a whole number.
        columns: f64,
        /// Rows of cells; a whole number.
        rows: f64,
    },
}

impl Explain for StrokeSettingsError {
    fn hint(&self) -> Option<Hint> {
        Some(Hint::new(match self {
            Self::OutOfRange { setting: "width_mm", .. } => "200 mm is usual",
            Self::OutOfRange { setting: "cell_mm", .. } => "0.25 mm is usual, 0.1 mm is fine",
            Self::OutOfRange { setting: "tolerance", .. } => "6 is usual; 3 paints more strokes",
            Self::OutOfRange { .. } => {
                "brushes are two cells wide or more, at most 100 mm, none wider than the painting; [cell_mm] takes smaller cells"
            }
            Self::TooManyCells { .. } => {
                "take larger cells ([cell_mm]) or a smaller painting ([width_mm])"
            }
        }))
    }

    fn fault(&self) -> Fault {
        Fault::Setting
    }
}
