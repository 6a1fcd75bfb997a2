//! Results of a case: figures with the bounds that are wanted, pictures and curves. Writes the
//! table of figures as text and as JSON.

use std::fmt::Write;

use image::RgbImage;
use serde_json::{Value, json};

/// A number with four significant digits, or `-` if it is not finite.
#[must_use]
pub fn number(value: f64) -> String {
    if !value.is_finite() {
        return "-".to_owned();
    }
    let digits = if value == 0.0 { 0.0 } else { value.abs().log10().floor() };
    let decimals = (3.0 - digits).clamp(0.0, 5.0) as usize;
    format!("{value:.decimals$}")
}

/// Bounds of a figure in words. They are empty without bounds.
#[must_use]
pub fn bounds(wanted: Wanted) -> String {
    fn plain(value: f64) -> String {
        format!("{}", (value * 1e6).round() / 1e6)
    }
    match (wanted.low, wanted.high) {
        (Some(low), Some(high)) => format!("{} to {}", plain(low), plain(high)),
        (Some(low), None) => format!(">= {}", plain(low)),
        (None, Some(high)) => format!("<= {}", plain(high)),
        (None, None) => String::new(),
    }
}

/// Mark beside a figure: `ok`, `--`, or nothing without bounds.
#[must_use]
pub fn verdict(figure: &Figure) -> &'static str {
    match figure.is_met() {
        Some(true) => "ok",
        Some(false) => "--",
        None => "",
    }
}

/// All figures as lines of text, and how many of them meet their bounds.
#[must_use]
pub fn table(reports: &[CaseReport]) -> String {
    let mut text = String::new();
    let mut met = 0;
    let mut bounded = 0;
    for CaseReport { name, title, figures, .. } in reports {
        let _ = writeln!(text, "{name}: {title}");
        for figure in figures {
            let value = number(figure.value);
            let wanted = bounds(figure.wanted);
            let line = format!(
                "  {:<46} {value:>10} {:<5} {wanted:<16} {}",
                figure.name,
                figure.unit,
                verdict(figure)
            );
            let _ = writeln!(text, "{}", line.trim_end());
            bounded += usize::from(figure.is_met().is_some());
            met += usize::from(figure.is_met() == Some(true));
        }
        text.push('\n');
    }
    let _ = writeln!(text, "{met} of {bounded} figures with bounds are within them");
    text
}

/// All figures of a bench with cells of `cell_mm`, as JSON. A value that is not a number is null.
#[must_use]
pub fn json(cell_mm: f64, small: bool, reports: &[CaseReport]) -> Value {
    let figures: Vec<Value> = reports
        .iter()
        .flat_map(|report| report.figures.iter().map(move |figure| (report.name, figure)))
        .map(|(case, figure)| {
            json!({
                "case": case,
                "name": figure.name.trim(),
                "value": figure.value,
                "unit": figure.unit,
                "low": figure.wanted.low,
                "high": figure.wanted.high,
                "ok": figure.is_met(),
            })
        })
        .collect();
    json!({
        "format": "impasto-stroke-bench",
        "cell_mm": cell_mm,
        "small": small,
        "figures": figures,
    })
}

/// Wanted bounds of a figure, both inclusive.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Wanted {
    /// Lowest wanted value.
    pub low: Option<f64>,
    /// Highest wanted value.
    pub high: Option<f64>,
}

/// One measured number.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// Name, unique within its case.
    pub name: String,
    /// Value, or NaN if there was nothing to measure.
    pub value: f64,
    /// Unit, empty for a ratio.
    pub unit: &'static str,
    /// Bounds. A figure that is only for information has none.
    pub wanted: Wanted,
}

impl Figure {
    /// A figure without bounds.
    #[must_use]
    pub fn new(name: impl Into<String>, value: f64, unit: &'static str) -> Self {
        Self { name: name.into(), value, unit, wanted: Wanted::default() }
    }

    /// Sets the lower bound.
    #[must_use]
    pub fn at_least(mut self, low: f64) -> Self {
        self.wanted.low = Some(low);
        self
    }

    /// Sets the upper bound.
    #[must_use]
    pub fn at_most(mut self, high: f64) -> Self {
        self.wanted.high = Some(high);
        self
    }

    /// Whether the value is within its bounds, or `None` without bounds. NaN is never within
    /// bounds.
    #[must_use]
    pub fn is_met(&self) -> Option<bool> {
        let Wanted { low, high } = self.wanted;
        let above = low.is_none_or(|low| self.value >= low);
        let below = high.is_none_or(|high| self.value <= high);
        (low.is_some() || high.is_some()).then_some(above && below)
    }
}

/// A section through the paint.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// Direction of the section: `across` or `along`.
    pub caption: &'static str,
    /// Distance of two heights in mm.
    pub step_mm: f64,
    /// Heights in mm along the section. The first line is a single section through the middle, the
    /// second is the mean of many parallel sections.
    pub lines: Vec<Vec<f64>>,
}

/// One stroke of the sheet: pictures of the same part of a canvas under several lights, with
/// sections through its paint.
#[derive(Debug, Clone)]
pub struct Panel {
    /// Description of the stroke.
    pub caption: String,
    /// Width and height of the part in mm.
    pub size_mm: (f64, f64),
    /// Magnification on the sheet. Whole strokes have 1.
    pub zoom: f64,
    /// Pictures from above, one pixel a cell.
    pub pictures: Vec<RgbImage>,
    /// Sections through the paint.
    pub curves: Vec<Curve>,
}

impl Panel {
    /// The panel with its pictures enlarged by `zoom`.
    #[must_use]
    pub fn zoomed(self, zoom: f64) -> Self {
        Self { zoom, ..self }
    }
}

/// Results of a case.
#[derive(Debug, Clone)]
pub struct CaseReport {
    /// Name of the case, one word.
    pub name: &'static str,
    /// Title of the case: its strokes in a sentence.
    pub title: &'static str,
    /// Figures, in order.
    pub figures: Vec<Figure>,
    /// Strokes to show.
    pub panels: Vec<Panel>,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_and_bounds_read_well() {
        assert_eq!(
            [0.0, 0.009_123, 12.345, 1234.5].map(number),
            ["0.000", "0.00912", "12.35", "1234"]
        );
        assert_eq!(number(f64::NAN), "-");
        let figure = Figure::new("film", 0.2, "mm").at_least(0.14).at_most(0.26);
        assert_eq!(bounds(figure.wanted), "0.14 to 0.26");
        assert_eq!(bounds(Wanted { low: None, high: Some(5.0) }), "<= 5");
    }

    #[test]
    fn the_table_counts_what_is_met_and_json_tells_every_figure() {
        let figures = vec![
            Figure::new("film", 0.2, "mm").at_least(0.14).at_most(0.26),
            Figure::new("lip", f64::NAN, "").at_least(1.3),
            Figure::new("volume", 3.0, "mm3"),
        ];
        let report = CaseReport { name: "one", title: "One stroke", figures, panels: Vec::new() };
        let text = table(std::slice::from_ref(&report));
        assert!(text.contains("1 of 2 figures"), "{text}");
        let json = json(0.25, true, &[report]);
        let verdicts = [0, 1, 2].map(|at: usize| json["figures"][at]["ok"].clone());
        assert_eq!(verdicts, [json!(true), json!(false), Value::Null]);
        assert_eq!(json["figures"][1]["value"], Value::Null);
    }

    #[test]
    fn bounds_are_met_within_and_never_by_no_number() {
        fn figure(value: f64) -> Figure {
            Figure::new("film", value, "mm")
        }
        assert_eq!(figure(0.1).is_met(), None);
        assert_eq!(
            [0.09, 0.1, 0.2, 0.21]
                .map(|value: f64| figure(value).at_least(0.1).at_most(0.2).is_met()),
            [false, true, true, false].map(Some)
        );
        assert_eq!(figure(f64::NAN).at_most(1.0).is_met(), Some(false));
        assert_eq!(figure(3.0).at_least(1.0).is_met(), Some(true));
    }
}
