//! Hiding power: how thick a film must be to hide its ground.

use super::cards::Cards;
use super::paints::{Palette, crossing};
use crate::evaluate::Viewing;
use crate::library::PigmentLibrary;
use crate::recipe::PigmentId;

/// Contrast ratio Yb / Yw from which a film is said to hide (ISO 6504-3).
pub const HIDING_CONTRAST: f64 = 0.98;

/// A film also hides if the luminance factors Y over both cards differ by at most this. For a black film the
/// ratio is meaningless, and a difference of 0.02 (Y = 100 for white) is 0.2 of L*, which is invisible.
const UNSEEN: f64 = 0.02;

/// Value of K d + S d of the strongest paint at the greatest thickness that is tried; chosen by eye.
const THICKEST: f64 = 1e5;
/// Number of thicknesses tried per decade.
const STEPS: usize = 8;
/// Number of decades tried.
const DECADES: usize = 9;

/// Thickness in mm from which on a film of white oil paint hides; a brush lays 0.05 mm at least.
const WHITE_HIDES_MM: f64 = 0.05;

/// Whether a film can hide its ground.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Hides {
    /// It hides from this thickness on, in the library's unit (for absolute amounts, an amount).
    From(f64),
    /// It does not hide at any thickness that is tried.
    Never {
        /// Contrast ratio Yb / Yw of the thickest film.
        contrast: f64,
    },
}

/// Hiding power of one paint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HidingPower {
    /// Pigment of the library.
    pub paint: PigmentId,
    /// Least thickness that hides.
    pub hides: Hides,
}

impl Hides {
    /// Thickness from which on the film hides, if there is one.
    #[must_use]
    pub fn thickness(self) -> Option<f64> {
        match self {
            Self::From(thickness) => Some(thickness),
            Self::Never { .. } => None,
        }
    }
}

/// Computes the hiding power of every paint: the least thickness from which on the luminance of the
/// film over the black card is at least 0.98 of that over the white card, Yb / Yw (ISO 6504-3:2019),
/// under the palette's light and observer.
///
/// A film so dark that Y over the two cards differs by at most 0.02 (Y = 100 for white) hides as well.
/// Thicknesses are tried from the thickest down, eight per decade, and the crossing is then bisected, because
/// the ratio may fall with thickness in a film that is clear at some wavelengths.
#[must_use]
pub fn hiding_powers(palette: &Palette<'_>) -> Vec<HidingPower> {
    palette
        .paints()
        .iter()
        .map(|&paint: &PigmentId| HidingPower { paint, hides: hides(palette, paint) })
        .collect()
}

/// S of the library's reference white per mm of height with which its film hides from 0.05 mm on
/// under D65 (see [`hiding_powers`]), rounded to a whole number. `None` if no pigment is the reference
/// white, or it does not hide at any thickness.
#[must_use]
pub fn scattering_per_mm(library: &PigmentLibrary) -> Option<f64> {
    let white = library.reference_id().filter(|&white| library[white].identified)?;
    let viewing = Viewing::default();
    let palette = Palette::new(library, &viewing, Cards::standard(library.grid)).ok()?;
    let per_mm = (hides(&palette, white).thickness()? / WHITE_HIDES_MM).round();
    (per_mm >= 1.0).then_some(per_mm)
}

fn hides(palette: &Palette<'_>, paint: PigmentId) -> Hides {
    let library = palette.library();
    let mixture = library.mix([(paint, 1.0)]).expect("one part is a mixture");
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
        // The film hides at every thickness: the two cards themselves are alike.
        None => Hides::From(0.0),
    }
}
