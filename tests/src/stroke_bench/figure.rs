//! Results of a case: figures with the bounds that are wanted, pictures and curves.

use image::RgbImage;

/// Bounds that a figure is wanted in, both inclusive.
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
    /// Value; not a number where there was nothing to measure.
    pub value: f64,
    /// Unit, empty for a ratio.
    pub unit: &'static str,
    /// Bounds; none for a figure that is told for information.
    pub wanted: Wanted,
}

impl Figure {
    /// A figure without bounds.
    #[must_use]
    pub fn new(name: impl Into<String>, value: f64, unit: &'static str) -> Self {
        Self { name: name.into(), value, unit, wanted: Wanted::default() }
    }

    /// A figure wanted at `low` or above.
    #[must_use]
    pub fn at_least(mut self, low: f64) -> Self {
        self.wanted.low = Some(low);
        self
    }

    /// A figure wanted at `high` or below.
    #[must_use]
    pub fn at_most(mut self, high: f64) -> Self {
        self.wanted.high = Some(high);
        self
    }

    /// Whether the value lies within its bounds; `None` without bounds. A value that is not a
    /// number lies within none.
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
    /// Lines of heights in mm: at one place, and the mean over several.
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
    /// Magnification on the sheet; 1 for whole strokes.
    pub zoom: f64,
    /// Pictures from above, one pixel a cell.
    pub pictures: Vec<RgbImage>,
    /// Sections through the paint.
    pub curves: Vec<Curve>,
}

impl Panel {
    /// The panel with its pictures `zoom` times as large as those of whole strokes.
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
    fn bounds_are_met_within_and_never_by_no_number() {
        let figure = |value: f64| Figure::new("film", value, "mm");
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
