//! Patches of colour and drawdowns, and what the sections on a palette share: cells, phrases, bars.

use calibrate::library::AmountKind;
use calibrate::palette::{Appearance, Drawdown, MeasuredSample, Palette, drawdowns};

use crate::figure::{Cell, Column, Drawing, Figure, Table, Words};
use crate::panel::Axis;
use crate::style::{Color, FAINT, GRID, HAIR, INK, PAPER, SMALL_TEXT, TEXT, WIDTH};
use crate::subject::Subject;
use crate::svg::{Anchor, Canvas};

/// Side of the notch in a patch, in px. The other sizes are in px too.
const PATCH_NOTCH: f64 = 6.0;

/// Draws a patch of colour with its upper left corner `at`, in px. The upper right corner is cut
/// out if the colour is outside sRGB.
pub(super) fn patch(
    canvas: &mut Canvas,
    at: (f64, f64),
    size: (f64, f64),
    appearance: &Appearance,
) {
    canvas.rectangle(at, size, Color::from_rgb(appearance.srgb));
    if !appearance.srgb.in_gamut() {
        canvas.rectangle((at.0 + size.0 - PATCH_NOTCH, at.1), (PATCH_NOTCH, PATCH_NOTCH), PAPER);
    }
}

/// Draws a patch like [`patch`], but cuts out the lower right corner.
pub(super) fn notched_below(
    canvas: &mut Canvas,
    at: (f64, f64),
    size: (f64, f64),
    appearance: &Appearance,
) {
    canvas.rectangle(at, size, Color::from_rgb(appearance.srgb));
    if !appearance.srgb.in_gamut() {
        let corner = (at.0 + size.0 - PATCH_NOTCH, at.1 + size.1 - PATCH_NOTCH);
        canvas.rectangle(corner, (PATCH_NOTCH, PATCH_NOTCH), PAPER);
    }
}

/// Draws a patch with a rim, so that white is visible on the paper.
pub(super) fn rimmed(
    canvas: &mut Canvas,
    at: (f64, f64),
    size: (f64, f64),
    appearance: &Appearance,
) {
    rim(canvas, at, size);
    patch(canvas, at, size, appearance);
}

/// Draws the rim of a patch. The patch is then drawn over it.
pub(super) fn rim(canvas: &mut Canvas, at: (f64, f64), size: (f64, f64)) {
    canvas.rectangle((at.0 - 1.0, at.1 - 1.0), (size.0 + 2.0, size.1 + 2.0), GRID);
}

/// The columns L*, a*, b*, sRGB, and whether the colour is outside sRGB.
pub(super) fn color_columns() -> [Column; 5] {
    [
        Column::quantity("L*", "1", 2),
        Column::quantity("a*", "1", 2),
        Column::quantity("b*", "1", 2),
        Column::text("sRGB"),
        Column::text("outside sRGB"),
    ]
}

pub(super) fn color_cells(appearance: &Appearance) -> [Cell; 5] {
    let outside = if appearance.srgb.in_gamut() { "no" } else { "yes" };
    let [l, a, b] = appearance.lab.to_array();
    [l.into(), a.into(), b.into(), Color::from_rgb(appearance.srgb).into(), outside.into()]
}

/// The figure's own columns, then the columns of a colour.
pub(super) fn columns(own: impl Into<Vec<Column>>) -> Vec<Column> {
    let mut all: Vec<Column> = own.into();
    all.extend(color_columns());
    all
}

/// A row for [`columns`]: the figure's own cells, then the cells of a colour.
pub(super) fn row(own: impl Into<Vec<Cell>>, appearance: &Appearance) -> Vec<Cell> {
    let mut all: Vec<Cell> = own.into();
    all.extend(color_cells(appearance));
    all
}

/// Text that explains the notch in a patch.
pub(super) const NOTCH: &str = "A notched corner: outside sRGB, shown clipped.";

/// The paints that you can mix, or `None` if there are none.
pub(super) fn palette<'a>(subject: &'a Subject<'_>) -> Option<Palette<'a>> {
    Palette::new(subject.library, subject.viewing, subject.cards.clone()).ok()
}

/// The measured samples that the palette can mix. This is empty without measurements.
pub(super) fn measured(subject: &Subject<'_>, palette: &Palette<'_>) -> Vec<MeasuredSample> {
    let comparison = subject.comparison.as_ref();
    comparison.map_or_else(Vec::new, |comparison| comparison.measured_samples(palette))
}

/// Name of the paint that lightens tints: the white, or water if the palette has none.
pub(super) fn thinner(palette: &Palette<'_>) -> String {
    palette.white().map_or_else(|| "water".to_owned(), |white| palette.label(white))
}

/// A sentence that says whether we draw mixtures as opaque films or as washes.
pub(super) fn films(palette: &Palette<'_>) -> &'static str {
    match palette.library().amounts {
        AmountKind::Relative => "Films that hide.",
        AmountKind::Absolute => {
            "Washes over the white card, each pigment in the amount that takes it nine tenths of the way to hiding where it absorbs most."
        }
    }
}

pub(super) fn thickness_unit(palette: &Palette<'_>) -> String {
    match palette.white() {
        Some(white) => format!("S d of {} = 1", palette.label(white)),
        None => "washes".to_owned(),
    }
}

const NAME: f64 = 190.0;
const VALUE: f64 = 200.0;
const ROW: f64 = 24.0;
const HEAD: f64 = 8.0;
/// Height for the axis below the last row, in px.
const FOOT: f64 = 48.0;

pub(super) struct Bar {
    pub(super) name: String,
    /// Value on the axis, or `None` for no bar.
    pub(super) value: Option<f64>,
    /// Value as text, written on the right.
    pub(super) label: String,
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

/// Thicknesses of the stripes, in the unit of [`thickness_unit`] (chosen by eye).
const THICKNESSES: [f64; 5] = [0.3, 1.0, 3.0, 10.0, 30.0];
const COLUMNS: usize = 6;
/// Width and height of a card.
const CARD: (f64, f64) = (140.0, 84.0);
const STRIPE: f64 = 20.0;
const GAP: f64 = 18.0;
/// Height of the name above a card: two lines.
const CARD_NAME: f64 = 28.0;
/// Height above a card.
const CARD_HEAD: f64 = CARD_NAME + 6.0;
/// Height for the thicknesses below a card.
const CARD_FOOT: f64 = 20.0;

pub(super) fn figure(subject: &Subject<'_>, palette: &Palette<'_>) -> Figure {
    let drawn = drawdowns(palette, &THICKNESSES);
    let unit = thickness_unit(palette);
    let own =
        [Column::text("pigment"), Column::quantity("thickness", &unit, 1), Column::text("card")];
    let mut data = Table::new(columns(own));
    for drawdown in &drawn {
        let name = subject.label(drawdown.paint);
        for step in &drawdown.steps {
            for (card, look) in [("black", &step.over_black), ("white", &step.over_white)] {
                data.push(row([name.as_str().into(), step.thickness.into(), card.into()], look));
            }
        }
        data.push(row([name.as_str().into(), Cell::Empty, "hidden".into()], &drawdown.masstone));
    }
    let caption = format!(
        "Stripes of the thickness below them ({unit}) over the white and the black half of a card, and at the right end the film that hides: undertone to masstone. {NOTCH}"
    );
    let words = Words {
        name: "drawdowns",
        title: "Drawdowns over black and white",
        caption: &caption,
        alt: "For each pigment a card, half white and half black, with stripes of paint of growing thickness.",
    };
    subject.figure(words, Drawing::Canvas(cards(subject, palette, &drawn)), data)
}

fn cards(subject: &Subject<'_>, palette: &Palette<'_>, drawn: &[Drawdown]) -> Canvas {
    let rows = drawn.len().div_ceil(COLUMNS);
    let height = CARD_HEAD + CARD.1 + CARD_FOOT;
    let mut canvas = Canvas::new(WIDTH, (height * rows as f64 + 6.0).ceil() as u32);
    let white = palette.appearance(&palette.cards().white);
    let black = palette.appearance(&palette.cards().black);
    let margin = (f64::from(WIDTH) - COLUMNS as f64 * (CARD.0 + GAP) + GAP) / 2.0;
    for (index, drawdown) in drawn.iter().enumerate() {
        let x = margin + (index % COLUMNS) as f64 * (CARD.0 + GAP);
        let y = (index / COLUMNS) as f64 * height + CARD_HEAD;
        let middle = (x, y - 2.0 - CARD_NAME / 2.0);
        let space = (CARD.0, CARD_NAME);
        let name = subject.label(drawdown.paint);
        canvas.name(middle, space, TEXT, Anchor::Start, INK, &name);
        let half = CARD.1 / 2.0;
        rim(&mut canvas, (x, y), CARD);
        patch(&mut canvas, (x, y), (CARD.0, half), &white);
        patch(&mut canvas, (x, y + half), (CARD.0, half), &black);
        // A drawdown leaves the edge of the card free.
        let top = y + 8.0;
        let length = half - 8.0;
        let step_width = CARD.0 / (THICKNESSES.len() + 1) as f64;
        for (place, step) in drawdown.steps.iter().enumerate() {
            let left = x + place as f64 * step_width + (step_width - STRIPE) / 2.0;
            patch(&mut canvas, (left, top), (STRIPE, length), &step.over_white);
            notched_below(&mut canvas, (left, y + half), (STRIPE, length), &step.over_black);
            let at = (left + STRIPE / 2.0, y + CARD.1 + 9.0);
            let label = format!("{}", step.thickness);
            canvas.text(at, SMALL_TEXT, Anchor::Middle, FAINT, &label);
        }
        let left = x + THICKNESSES.len() as f64 * step_width + (step_width - STRIPE) / 2.0;
        patch(&mut canvas, (left, top), (STRIPE, 2.0 * length), &drawdown.masstone);
        let at = (left + STRIPE / 2.0, y + CARD.1 + 9.0);
        canvas.text(at, SMALL_TEXT, Anchor::Middle, FAINT, "hides");
    }
    canvas
}
