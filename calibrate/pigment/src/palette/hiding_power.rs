//! How thick a film must be to hide its ground.

use super::paints::{Palette, crossing};

/// The contrast ratio at which a film is said to hide (ISO 6504-3).
pub const HIDING_CONTRAST: f64 = 0.98;

/// And the difference of luminance factors that no eye sees: 0.02 of Y = 100 is
/// 0.2 of L* where a film is black, and a ratio says nothing there.
const UNSEEN: f64 = 0.02;

/// Films from here on are called too thick to be a film: K d + S d of the
/// strongest paint is this.
const THICKEST: f64 = 1e5;
/// Thicknesses tried, this many to each tenfold.
const STEPS: usize = 8;
/// Tenfolds tried.
const DECADES: usize = 9;

/// Whether a film can hide.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Hides {
    /// From this thickness on, in the library's unit (an amount, for absolute
    /// amounts).
    From(f64),
    /// At no thickness that is still a film; the contrast ratio of the thickest.
    Never {
        /// Yb / Yw there.
        contrast: f64,
    },
}

/// The hiding power of one paint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HidingPower {
    /// The paint.
    pub paint: usize,
    /// The thickness that hides.
    pub hides: Hides,
}

impl Hides {
    /// The thickness, if there is one.
    #[must_use]
    pub fn thickness(self) -> Option<f64> {
        match self {
            Self::From(thickness) => Some(thickness),
            Self::Never { .. } => None,
        }
    }
}

/// The hiding power of every paint: the least thickness from which on the film
/// over the black card has at least 0.98 of its luminance over the white card,
/// Yb / Yw (ISO 6504-3:2019), under the palette's light and observer.
///
/// A film so dark that the two differ by less than 0.02 of Y hides as well.
/// Thicknesses are tried from the thickest down, eight to a tenfold, then the
/// crossing is halved: the ratio need not rise all the way in a film that is
/// clear at some wavelengths.
#[must_use]
pub fn hiding_powers(palette: &Palette<'_>) -> Vec<HidingPower> {
    let power = |&paint: &usize| HidingPower { paint, hides: hides(palette, paint) };
    palette.paints().iter().map(power).collect()
}

fn hides(palette: &Palette<'_>, paint: usize) -> Hides {
    let library = palette.library();
    let mixture = library.mix(&[(paint, 1.0)]).expect("one part is a mixture");
    let film = library.film();
    let luminance = |thickness: f64, card: &[f64]| {
        palette.weights().xyz(&mixture.film(thickness, card, film)).y
    };
    let over_cards = |thickness: f64| {
        let cards = palette.cards();
        [luminance(thickness, &cards.black), luminance(thickness, &cards.white)]
    };
    let contrast = |thickness: f64| {
        let [black, white] = over_cards(thickness);
        if white > 0.0 { black / white } else { 1.0 }
    };
    let strongest = palette.strongest();
    if strongest <= 0.0 {
        return Hides::Never { contrast: contrast(0.0) };
    }
    let thickest = THICKEST / strongest;
    let step = |index: usize| thickest * 10f64.powf(-(index as f64) / STEPS as f64);
    let hiding = |thickness: f64| {
        let [black, white] = over_cards(thickness);
        black >= HIDING_CONTRAST * white || white - black <= UNSEEN
    };
    match (0..=STEPS * DECADES).find(|&index| !hiding(step(index))) {
        Some(0) => Hides::Never { contrast: contrast(thickest) },
        Some(index) => Hides::From(crossing(step(index), step(index - 1), hiding)),
        // The cards themselves are alike.
        None => Hides::From(0.0),
    }
}
