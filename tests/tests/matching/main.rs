//! Search of recipes for a colour: distance, films, limits, order, progress and cancelling.

#![expect(clippy::unwrap_used, reason = "a test may panic")]
mod exhaustive;
mod films;
mod reach;
mod spectrum;

use calibrate::evaluate::{Viewing, lab};
use calibrate::library::PigmentLibrary;
use calibrate::matching::{Target, ViewingCondition};
use spectra::{Illuminant, Observer};
use suite::oils::library as oils;

fn conditions(lights: &[&str]) -> Vec<ViewingCondition> {
    lights
        .iter()
        .map(|name: &&str| ViewingCondition {
            viewing: Viewing {
                illuminant: Illuminant::named(name).unwrap(),
                observer: Observer::default(),
            },
            weight: 1.0,
        })
        .collect()
}

/// The colour of a reflectance on the library's grid under each condition.
fn target_of(
    library: &PigmentLibrary,
    reflectance: &[f64],
    conditions: &[ViewingCondition],
) -> Target {
    let colors = conditions
        .iter()
        .map(|condition| lab(&condition.viewing.weights(library.grid).unwrap(), reflectance));
    let lab = colors.collect();
    Target { name: "a mixture".to_owned(), lab, spectrum: None }
}
