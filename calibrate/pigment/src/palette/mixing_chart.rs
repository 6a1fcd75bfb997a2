//! Mixtures that painters chart: every two paints, tints, drawdowns.

use super::paints::{Appearance, Palette};

/// Parts of white (or of water) to one of paint in a ladder of tints.
pub const TINTS: [f64; 5] = [0.0, 1.0, 3.0, 9.0, 27.0];

/// Parts of white (or of water) to one of the mixture in the tinted half of a
/// chart, where dark mixtures show their hue.
pub const CHART_TINT: f64 = 3.0;

/// Every paint with every other, one part to one.
#[derive(Debug, Clone, PartialEq)]
pub struct MixingChart {
    /// The paints, in the library's order.
    pub paints: Vec<usize>,
    /// By row and column of `paints`; symmetric, the masstones on the diagonal.
    pub colors: Vec<Vec<Appearance>>,
    /// The same, each with [`CHART_TINT`] parts of white to one.
    pub tinted: Vec<Vec<Appearance>>,
}

/// The chart of a palette.
#[must_use]
pub fn mixing_chart(palette: &Palette<'_>) -> MixingChart {
    MixingChart {
        paints: palette.paints().to_vec(),
        colors: every_pair(palette, 0.0),
        tinted: every_pair(palette, CHART_TINT),
    }
}

fn every_pair(palette: &Palette<'_>, whites: f64) -> Vec<Vec<Appearance>> {
    let paints = palette.paints();
    let mut colors: Vec<Vec<Appearance>> = Vec::with_capacity(paints.len());
    for (row, &first) in paints.iter().enumerate() {
        let mut line: Vec<Appearance> = colors.iter().map(|above| above[row]).collect();
        line.push(palette.look(&palette.tint(first, whites)));
        line.extend(
            paints[row + 1..].iter().map(|&second| {
                palette.look(&palette.thinned(&[(first, 0.5), (second, 0.5)], whites))
            }),
        );
        colors.push(line);
    }
    colors
}

/// One paint from the masstone to its palest tint.
#[derive(Debug, Clone, PartialEq)]
pub struct TintLadder {
    /// The paint.
    pub paint: usize,
    /// By step of [`TINTS`].
    pub colors: Vec<Appearance>,
}

/// The tints of every paint but the white.
#[must_use]
pub fn tint_ladders(palette: &Palette<'_>) -> Vec<TintLadder> {
    let paints = palette.paints().iter().filter(|&&p| Some(p) != palette.white());
    let ladder = |&paint: &usize| TintLadder {
        paint,
        colors: TINTS.iter().map(|&parts| palette.look(&palette.tint(paint, parts))).collect(),
    };
    paints.map(ladder).collect()
}

/// A film of one thickness over both cards.
#[derive(Debug, Clone, PartialEq)]
pub struct DrawdownStep {
    /// In the library's unit; for absolute amounts, in washes of that paint.
    pub thickness: f64,
    /// Over the black card.
    pub over_black: Appearance,
    /// Over the white card.
    pub over_white: Appearance,
}

/// A paint drawn down over a black-and-white card.
#[derive(Debug, Clone, PartialEq)]
pub struct Drawdown {
    /// The paint.
    pub paint: usize,
    /// Thin to thick: from the undertone to the masstone.
    pub steps: Vec<DrawdownStep>,
    /// The film that hides.
    pub masstone: Appearance,
}

/// Every paint at each of `thicknesses` (0 and up, in the library's unit; for
/// absolute amounts, in washes of that paint).
#[must_use]
pub fn drawdowns(palette: &Palette<'_>, thicknesses: &[f64]) -> Vec<Drawdown> {
    let film = palette.library().film();
    let cards = palette.cards();
    let drawdown = |&paint: &usize| {
        let mixture = palette.mixture(&[(paint, 1.0)]);
        let over =
            |thickness: f64, card: &[f64]| palette.appearance(&mixture.film(thickness, card, film));
        let step = |&thickness: &f64| DrawdownStep {
            thickness,
            over_black: over(thickness, &cards.black),
            over_white: over(thickness, &cards.white),
        };
        Drawdown {
            paint,
            steps: thicknesses.iter().map(step).collect(),
            masstone: palette.appearance(&mixture.hiding(film.surface)),
        }
    };
    palette.paints().iter().map(drawdown).collect()
}
