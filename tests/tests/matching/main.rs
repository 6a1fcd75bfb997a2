//! Recipes for a colour: nearness, limits, order.

#![expect(clippy::unwrap_used, reason = "a test may panic")]

mod exhaustive;

mod films;

mod limits;

mod order;

mod watched;

use calibrate::evaluate::{Viewing, lab};
use calibrate::library::PigmentLibrary;
use calibrate::matching::{Sight, Target};
use spectra::color::Lab;
use spectra::{Illuminant, Observer};
use suite::oils::library as oils;

/// Lights by name, counting alike.
fn sights(lights: &[&str]) -> Vec<Sight> {
    let sight = |name: &&str| Sight {
        viewing: Viewing {
            illuminant: Illuminant::named(name).unwrap(),
            observer: Observer::default(),
        },
        weight: 1.0,
    };
    lights.iter().map(sight).collect()
}

/// The colour of a reflectance on the library's grid under each sight.
fn target_of(library: &PigmentLibrary, reflectance: &[f64], sights: &[Sight]) -> Target {
    let color =
        |sight: &Sight| -> Lab { lab(&sight.viewing.weights(library.grid).unwrap(), reflectance) };
    Target { name: "a mixture".to_owned(), lab: sights.iter().map(color).collect() }
}
