//! The palette of a report, and phrases that several of its figures share.

use calibrate::library::AmountKind;
use calibrate::palette::{MeasuredSample, Palette};

use crate::subject::Subject;

/// Explanation of the notch in a patch.
pub(super) const NOTCH: &str = "A notched corner: outside sRGB, shown clipped.";

/// The paints that can be mixed; `None` if there are none.
pub(super) fn palette<'a>(subject: &'a Subject<'_>) -> Option<Palette<'a>> {
    Palette::new(subject.library, subject.viewing, subject.cards.clone()).ok()
}

/// The measured samples that the palette can mix; empty without measurements.
pub(super) fn measured(subject: &Subject<'_>, palette: &Palette<'_>) -> Vec<MeasuredSample> {
    let comparison = subject.comparison.as_ref();
    comparison.map_or_else(Vec::new, |comparison| comparison.measured_samples(palette))
}

/// Name of the paint that lightens tints: the white, or water where the palette has none.
pub(super) fn thinner(palette: &Palette<'_>) -> String {
    palette.white().map_or_else(|| "water".to_owned(), |white| palette.label(white))
}

/// A sentence that says whether mixtures are drawn as opaque films or as washes.
pub(super) fn films(palette: &Palette<'_>) -> &'static str {
    match palette.library().amounts {
        AmountKind::Relative => "Films that hide.",
        AmountKind::Absolute => {
            "Washes over the white card, each pigment in the amount that takes it nine tenths of the way to hiding where it absorbs most."
        }
    }
}

/// The unit of film thickness, as text.
pub(super) fn thickness_unit(palette: &Palette<'_>) -> String {
    match palette.white() {
        Some(white) => format!("S d of {} = 1", palette.label(white)),
        None => "washes".to_owned(),
    }
}
