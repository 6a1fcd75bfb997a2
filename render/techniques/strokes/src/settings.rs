//! Settings of a photograph painted in strokes, and the plan of its strokes that follows from
//! them: brushes from coarse to fine, and rules for each of them.

use documents::hint::Explain;
use documents::settings::{OutOfRange, out_of_range};
use documents::text::{Checked, KeyPath, ValueFault};
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

documents::settings! {
    /// How to paint a photograph in strokes, or to separate it into pigments.
    pub struct StrokeSettings: File(brushes_fit) {
        title: String = String::new(), Text => "Title of the painting";
        width_mm: f64 = 200.0, Number(5.0, 5000.0), "mm" => "Width of the painting; its height follows the shape of the photograph";
        cell_mm: f64 = 0.25, Number(0.02, 5.0), "mm" => "Width and height of a cell; time grows with the square of the resolution";
        ground: GroundKind = GroundKind::Linen, Words(&["linen", "paper", "panel", "wood"]) => "Ground to paint on";
        palette: Vec<String> = Vec::new(), Texts => "Names of up to eight pigments of the library; [] chooses those that come nearest to the photograph's colours";
        brushes_mm: Vec<f64> = Vec::new(), Numbers(0.2, 100.0), "mm" => "Widths of the brushes in any order, each two cells or more and not wider than the painting; [] takes 16, 8, 4, 2 and 1 mm for a painting 200 mm wide, and in proportion";
        tolerance: f64 = 6.0, Number(0.5, 100.0), "CIELAB" => "Difference (CIE 1976) above which strokes are painted; less takes more strokes";
        seed: u64 = 1, Any => "Seed of all random choices";
        hides: bool = true, Switch => "Whether paint must hide the ground; if not, lighter and purer colours are reached, for separations only, because strokes overlap";
    }
}

documents::presets! {
    /// Settings that ship under a name. There is none: brushes and pigments follow the photograph.
    pub enum StrokePreset of StrokeSettings {}
}

/// Checks that brushes suit cells and painting.
fn brushes_fit(settings: &StrokeSettings, base: &KeyPath) -> Checked {
    let [least, most] = settings.brush_limits_mm();
    match settings.brushes_mm.iter().find(|mm| !(least..=most).contains(*mm)) {
        None => Ok(()),
        Some(mm) => Err(ValueFault::new(
            &base.key("brushes_mm"),
            format!("{least} to {most} mm in these cells on this width"),
            mm,
            "a smaller cell_mm takes narrower brushes",
        )),
    }
}

impl StrokeSettings {
    /// Checks the ranges of all numbers.
    ///
    /// # Errors
    /// [`StrokeSettingsError::OutOfRange`] for the first number out of range.
    pub fn check(&self) -> Result<(), StrokeSettingsError> {
        if let Some(OutOfRange { row, value, least, most, .. }) = out_of_range(self) {
            return Err(StrokeSettingsError::OutOfRange { setting: row.key, value, least, most });
        }
        let [least, most] = self.brush_limits_mm();
        match self.brushes_mm.iter().find(|mm| !(least..=most).contains(*mm)) {
            None => Ok(()),
            Some(&value) => {
                let setting = "brushes_mm";
                Err(StrokeSettingsError::OutOfRange { setting, value, least, most })
            }
        }
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

    /// Least and greatest width of a brush.
    fn brush_limits_mm(&self) -> [f64; 2] {
        [self.narrowest_mm(), self.width_mm.min(BROADEST_MM)]
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
        "brushes are at least two cells wide, at most 100 mm, and no wider than the painting; for narrower ones set smaller cells with [cell_mm]"
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

documents::settings! {
    /// Plan for painting a photograph, one level per brush, by default for a painting about 200 mm wide.
    /// Lengths without a unit are in widths of the level's brush.
    pub struct Plan {
        sizes_mm: Vec<f64> = vec![16.0, 8.0, 4.0, 2.0, 1.0], Numbers(0.05, 1000.0), "mm" => "Width of the brush of each level, coarse to fine";
        tolerance: f64 = 6.0, Number(0.0, 200.0) => "Difference in CIELAB (CIE 1976) above which strokes are painted; less takes more strokes";
        departure: f64 = 12.0, Number(0.0, 1000.0) => "Greatest difference in CIELAB (CIE 1976) between a stroke's colour and the picture along the stroke";
        shortest: f64 = 3.0, Number(0.0, 1000.0), "brush sizes" => "Least length of a stroke";
        longest: f64 = 12.0, Number(0.0, 1000.0), "brush sizes" => "Greatest length of a stroke, not below the least";
        spacing: f64 = 0.5, Number(0.1, 100.0), "brush sizes" => "Side of the squares in each of which one stroke may begin";
        bending: f64 = 0.7, Number(0.0, 1.0) => "Curvature of strokes: 0 straight, 1 along the structure of the picture";
        most_strokes: usize = 30_000, Any => "Most strokes of a level; those with the largest difference are painted";
        darks_mm: f64 = 0.04, Number(0.001, 10.0), "mm" => "Thickness that black strokes have at least";
        lights_mm: f64 = 0.35, Number(0.001, 10.0), "mm" => "Thickness that white strokes have at least; a brush lays at most 0.06 of its width";
        pressure: f64 = 0.6, Number(0.0, 1.0) => "Pressure of the brush in the middle of a stroke";
        ends: f64 = 0.15, Number(0.0, 1.0) => "Pressure at both ends of a stroke relative to its middle";
        speed: f64 = 10.0, Number(0.001, 1e6), "brush sizes a second" => "Speed of the brush";
        order: Order = Order::DarkToLight, Words(&["shuffled", "dark-to-light"]) => "Order of the strokes of a level";
        seed: u64 = 1, Any => "Seed of all random choices";
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
            let wanted = "0.05 to 1000 mm".to_owned();
            return Err(PlanError::Number { field: "sizes_mm", value: size, wanted });
        }
        let longest = self.longest;
        match out_of_range(self) {
            Some(OutOfRange { row, value, .. }) if row.key != "longest" => {
                let wanted = format!("{} {}", row.takes, row.unit).trim_end().to_owned();
                return Err(PlanError::Number { field: row.key, value, wanted });
            }
            _ if (self.shortest..=1000.0).contains(&longest) => {}
            _ => {
                let wanted = "from `shortest` to 1000 brush sizes".to_owned();
                return Err(PlanError::Number { field: "longest", value: longest, wanted });
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
        wanted: String,
    },
}

#[cfg(test)]
mod tests {
    use documents::settings::differences;

    use super::*;

    #[test]
    fn settings_of_a_file_are_checked_like_those_of_code() {
        let settings = StrokeSettings {
            width_mm: 60.0,
            palette: vec!["Vermilion".to_owned()],
            brushes_mm: vec![8.0, 1.0],
            ..StrokeSettings::default()
        };
        let changes = differences(&settings, &StrokeSettings::default());
        let text = "width_mm = 60.0\npalette = [\"Vermilion\"]\nbrushes_mm = [8.0, 1.0]\n";
        assert_eq!(changes, text);
        assert_eq!(StrokeSettings::from_toml("mine.toml", text).unwrap(), settings);
        let all = settings.documented("Mine");
        assert_eq!(StrokeSettings::from_toml("mine.toml", &all).unwrap(), settings);
        assert_eq!((settings.check(), settings.valid().is_ok()), (Ok(()), true));
        for (text, by_code, by_file) in [
            ("cell_mm = 9", "cell_mm is 0.02 to 5, found `9`", "cell_mm takes 0.02 to 5"),
            (
                "brushes_mm = [1.0, 0.4]",
                "brushes_mm is 0.5 to 60, found `0.4`",
                "brushes_mm takes 0.5 to 60 mm in these cells on this width, found `0.4`",
            ),
        ] {
            let mut settings = StrokeSettings { width_mm: 60.0, ..StrokeSettings::default() };
            match text {
                "cell_mm = 9" => settings.cell_mm = 9.0,
                _ => settings.brushes_mm = vec![1.0, 0.4],
            }
            assert_eq!(settings.check().unwrap_err().to_string(), by_code);
            let text = format!("width_mm = 60\n{text}");
            let error = StrokeSettings::from_toml("mine.toml", &text).unwrap_err().to_string();
            assert!(error.starts_with(&format!("mine.toml, line 2: {by_file}")), "{error}");
        }
    }

    #[test]
    fn numbers_of_a_plan_are_refused_by_their_rows() {
        fn with(change: fn(&mut Plan)) -> String {
            let mut plan = Plan::default();
            change(&mut plan);
            plan.check().unwrap_err().to_string()
        }
        let wide = with(|plan| plan.speed = 1e7);
        assert_eq!(wide, "speed is 0.001 to 1000000 brush sizes a second, found `10000000`");
        assert_eq!(with(|plan| plan.bending = f64::NAN), "bending is 0 to 1, found `NaN`");
        let short = with(|plan| plan.longest = 1.0);
        assert_eq!(short, "longest is from `shortest` to 1000 brush sizes, found `1`");
    }
}
