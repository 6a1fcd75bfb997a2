//! What a palette can do, drawn: see `calibrate::palette`.

mod bars;

mod card;

mod cells;

mod graded;

mod patch;

mod lights;

mod mixing;

mod gamut;

mod strength;

use calibrate::library::AmountKind;
use calibrate::palette::{MeasuredSample, Palette};

pub(crate) use gamut::section as gamut;
pub(crate) use graded::section as graded;
pub(crate) use lights::section as lights;
pub(crate) use mixing::section as mixing;
pub(crate) use strength::section as strength;

use crate::subject::Subject;

/// The paints that can be mixed, if there are any.
fn palette<'a>(subject: &'a Subject<'_>) -> Option<Palette<'a>> {
    Palette::new(subject.library, subject.viewing, subject.cards.clone()).ok()
}

fn measured(subject: &Subject<'_>, palette: &Palette<'_>) -> Vec<MeasuredSample> {
    let comparison = subject.comparison.as_ref();
    comparison.map_or_else(Vec::new, |comparison| comparison.measured_samples(palette))
}

/// What is called the lightening part of a tint.
fn thinner(palette: &Palette<'_>) -> String {
    palette.white().map_or_else(|| "water".to_owned(), |white| palette.label(white))
}

/// Which mixtures are meant, in a sentence.
fn films(palette: &Palette<'_>) -> &'static str {
    match palette.library().amounts {
        AmountKind::Relative => "Films that hide.",
        AmountKind::Absolute => {
            "Washes over the white card, each pigment in the amount that takes it nine tenths of the way to hiding where it absorbs most."
        }
    }
}

/// What the notch in a patch means.
const NOTCH: &str = "A notched corner: outside sRGB, the nearest is shown.";
