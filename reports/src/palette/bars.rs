//! Bar charts whose bars have the colours of paints.

use calibrate::palette::Appearance;

use super::patch::rimmed;
use crate::axis::Axis;
use crate::style::{FAINT, GRID, HAIR, INK, SMALL_TEXT, TEXT, WIDTH};
use crate::svg::{Anchor, Canvas};

/// Width for the names, in px.
const NAME: f64 = 190.0;
/// Width for the values, in px.
const VALUE: f64 = 200.0;
/// Height of a row, in px.
const ROW: f64 = 24.0;
/// Height above the first row, in px.
const HEAD: f64 = 8.0;
/// Height for the axis below the last row, in px.
const FOOT: f64 = 48.0;

/// One bar with its texts.
pub(super) struct Bar {
    /// Name, written on the left.
    pub(super) name: String,
    /// Value on the axis; `None` for no bar.
    pub(super) value: Option<f64>,
    /// Value as text, written on the right.
    pub(super) label: String,
    /// Colour of the bar.
    pub(super) appearance: Appearance,
}

/// Draws bars below each other, from the low end of `axis`.
pub(super) fn bars(axis: &Axis, bars: &[Bar]) -> Canvas {
    let foot = HEAD + ROW * bars.len() as f64;
    let mut canvas = Canvas::new(WIDTH, (foot + FOOT).ceil() as u32);
    let length_px = f64::from(WIDTH) - NAME - VALUE;
    for (value, label) in &axis.ticks {
        let x = NAME + length_px * axis.place(*value);
        canvas.line((x, HEAD), (x, foot), HAIR, GRID);
        canvas.text((x, foot + 12.0), SMALL_TEXT, Anchor::Middle, FAINT, label);
    }
    canvas.text((NAME + length_px / 2.0, foot + 34.0), TEXT, Anchor::Middle, INK, &axis.name);
    for (index, bar) in bars.iter().enumerate() {
        let y = HEAD + ROW * index as f64;
        let middle = y + ROW / 2.0;
        let space = (NAME - 12.0, ROW);
        canvas.name((NAME - 8.0, middle), space, TEXT, Anchor::End, INK, &bar.name);
        let length = bar.value.map(|value| length_px * axis.place(value));
        if let Some(length) = length.filter(|length| *length > 0.0) {
            rimmed(&mut canvas, (NAME, y + 4.0), (length, ROW - 8.0), &bar.appearance);
        }
        let end = NAME + length.unwrap_or(0.0) + 8.0;
        canvas.text((end, middle), SMALL_TEXT, Anchor::Start, FAINT, &bar.label);
    }
    canvas
}
