//! Bars in the colours of their paints.

use calibrate::palette::Appearance;

use super::patch::rimmed;
use crate::axis::Axis;
use crate::style::{FAINT, GRID, HAIR, INK, SMALL_TEXT, TEXT, WIDTH};
use crate::svg::{Anchor, Canvas, shortened};

const NAME: f64 = 190.0;
const VALUE: f64 = 200.0;
const ROW: f64 = 24.0;
const HEAD: f64 = 8.0;
const FOOT: f64 = 48.0;

/// One bar.
pub(super) struct Bar {
    /// On its left.
    pub(super) name: String,
    /// On the axis; none if there is nothing to draw.
    pub(super) value: Option<f64>,
    /// On its right.
    pub(super) told: String,
    /// Its colour.
    pub(super) look: Appearance,
}

/// Bars one below the other, from the low end of `axis`.
pub(super) fn bars(axis: &Axis, bars: &[Bar]) -> Canvas {
    let foot = HEAD + ROW * bars.len() as f64;
    let mut canvas = Canvas::new(WIDTH, (foot + FOOT).ceil() as u32);
    let room = f64::from(WIDTH) - NAME - VALUE;
    for (value, label) in &axis.ticks {
        let x = NAME + room * axis.place(*value);
        canvas.line((x, HEAD), (x, foot), HAIR, GRID);
        canvas.text((x, foot + 12.0), SMALL_TEXT, Anchor::Middle, FAINT, label);
    }
    canvas.text((NAME + room / 2.0, foot + 34.0), TEXT, Anchor::Middle, INK, &axis.name);
    for (index, bar) in bars.iter().enumerate() {
        let y = HEAD + ROW * index as f64;
        let middle = y + ROW / 2.0;
        let name = shortened(&bar.name, TEXT, NAME - 12.0);
        canvas.text((NAME - 8.0, middle), TEXT, Anchor::End, INK, &name);
        let length = bar.value.map(|value| room * axis.place(value));
        if let Some(length) = length.filter(|length| *length > 0.0) {
            rimmed(&mut canvas, (NAME, y + 4.0), (length, ROW - 8.0), &bar.look);
        }
        let end = NAME + length.unwrap_or(0.0) + 8.0;
        canvas.text((end, middle), SMALL_TEXT, Anchor::Start, FAINT, &bar.told);
    }
    canvas
}
