//! Drawdowns: stripes of paint over a black-and-white card.

use calibrate::palette::{Drawdown, Palette, drawdowns};

use super::cells::{columns, row};
use super::context::{NOTCH, thickness_unit};
use super::patch::{notched_below, patch, rim};
use crate::figure::{Drawing, Figure, Words};
use crate::style::{FAINT, INK, SMALL_TEXT, TEXT, WIDTH};
use crate::subject::Subject;
use crate::svg::{Anchor, Canvas};
use crate::table::{Column, Table};

/// Thicknesses of the stripes, in the unit of [`thickness_unit`]; chosen by eye.
const THICKNESSES: [f64; 5] = [0.3, 1.0, 3.0, 10.0, 30.0];
/// Cards in a row.
const COLUMNS: usize = 6;
/// Width and height of a card, in px.
const CARD: (f64, f64) = (140.0, 84.0);
/// Width of a stripe, in px.
const STRIPE: f64 = 20.0;
/// Space between cards, in px.
const GAP: f64 = 18.0;
/// Height of the name above a card, in px: two lines.
const NAME: f64 = 28.0;
/// Height above a card, in px.
const HEAD: f64 = NAME + 6.0;
/// Height for the thicknesses below a card, in px.
const FOOT: f64 = 20.0;

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
        data.push(row(
            [name.as_str().into(), crate::table::Cell::Empty, "hidden".into()],
            &drawdown.masstone,
        ));
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
    let height = HEAD + CARD.1 + FOOT;
    let mut canvas = Canvas::new(WIDTH, (height * rows as f64 + 6.0).ceil() as u32);
    let white = palette.appearance(&palette.cards().white);
    let black = palette.appearance(&palette.cards().black);
    let margin = (f64::from(WIDTH) - COLUMNS as f64 * (CARD.0 + GAP) + GAP) / 2.0;
    for (index, drawdown) in drawn.iter().enumerate() {
        let x = margin + (index % COLUMNS) as f64 * (CARD.0 + GAP);
        let y = (index / COLUMNS) as f64 * height + HEAD;
        let middle = (x, y - 2.0 - NAME / 2.0);
        let space = (CARD.0, NAME);
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
