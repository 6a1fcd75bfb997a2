//! Settings that are numbers, with their ranges.

/// A number of the settings and its range.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Figure {
    /// Group and key: `strokes.width_px`.
    pub(super) key: &'static str,
    pub(super) value: f64,
    pub(super) least: f64,
    pub(super) most: f64,
}

impl Figure {
    pub(super) fn new(key: &'static str, value: impl Into<f64>, [least, most]: [f64; 2]) -> Self {
        Self { key, value: value.into(), least, most }
    }

    /// Whether the value is a number within the range.
    pub(super) fn fits(&self) -> bool {
        (self.least..=self.most).contains(&self.value)
    }
}
