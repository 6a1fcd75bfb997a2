//! Search of recipes for a colour: distance, films, limits, order, progress and cancelling.

#![expect(clippy::unwrap_used, reason = "a test may panic")]
mod corrections;
mod exhaustive;
mod films;
mod masstones;
mod spectrum;

use calibrate::evaluate::{Viewing, lab};
use calibrate::library::PigmentLibrary;
use calibrate::matching::{ColorTarget, MatchRequest, Target, ViewingCondition};
use documents::Task;
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

/// Pale and middle colours: L*, chroma and hue in degrees. Four of these colours need shares below 2 %, and the last two are out of reach.
const COLORS: [[f64; 3]; 12] = [
    [45.0, 5.0, 60.0],
    [52.0, 15.0, 0.0],
    [58.0, 25.0, 90.0],
    [65.0, 15.0, 180.0],
    [72.0, 5.0, 270.0],
    [79.0, 25.0, 90.0],
    [79.0, 25.0, 0.0],
    [86.0, 5.0, 120.0],
    [92.0, 5.0, 180.0],
    [86.0, 25.0, 120.0],
    [65.0, 45.0, 330.0],
    [79.0, 35.0, 300.0],
];

#[test]
fn no_colour_is_told_out_of_reach_that_small_shares_reach() {
    let library = oils();
    let usual = MatchRequest::default();
    let small = MatchRequest { least_share: Some(0.001), ..MatchRequest::default() };
    let mut below = 0;
    let mut out = 0;
    for [lightness, chroma, hue] in COLORS {
        let hue = hue.to_radians();
        let text = format!("{lightness},{:.2},{:.2}", chroma * hue.cos(), chroma * hue.sin());
        let target: ColorTarget = text.parse().unwrap();
        let found = usual.run(&library, &target, &Task::default()).unwrap();
        let nearest = small.run(&library, &target, &Task::default()).unwrap().nearest();
        let is_reached = found.is_reached() || found.is_reached_below_least();
        assert!(is_reached || nearest > 0.5, "{text}: {nearest} away with small shares");
        below += usize::from(found.is_reached_below_least());
        out += usize::from(!is_reached);
        // Whoever is told how far the nearest recipe is also sees the nearer one with small shares.
        if found.nearest() > nearest + 1.0 && !found.is_reached() {
            assert!(!found.below_least.is_empty(), "{text}: {} and {nearest}", found.nearest());
        }
    }
    assert!(below >= 3 && out == 2, "{below} with small shares, {out} out of reach");
}
