//! Charts of mixtures as painters make them: mixing charts, tints, drawdowns.

use super::paints::Palette;
use crate::appearance::Appearance;
use crate::recipe::{PigmentId, Recipe};

/// Parts of white (or of water) to one of paint in a ladder of tints.
pub const TINTS: [f64; 5] = [0.0, 1.0, 3.0, 9.0, 27.0];

/// Parts of white (or of water) to one of the mixture in the tinted half of a chart, where dark
/// mixtures show their hue.
pub const CHART_TINT: f64 = 3.0;

/// Colours of every paint mixed with every other, one part to one.
#[derive(Debug, Clone, PartialEq)]
pub struct MixingChart {
    /// The paints, in the library's order.
    pub paints: Vec<PigmentId>,
    /// Colours by row and column of `paints`; symmetric, with the masstones on the diagonal.
    pub colors: Vec<Vec<Appearance>>,
    /// Colours of the same mixtures with [`CHART_TINT`] parts of white to one.
    pub tinted: Vec<Vec<Appearance>>,
}

/// Computes the mixing chart of a palette.
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
        line.push(palette.color(&palette.tint(first, whites)));
        line.extend(paints[row + 1..].iter().map(|&second| {
            palette.color(&palette.thinned(&Recipe::from([(first, 0.5), (second, 0.5)]), whites))
        }));
        colors.push(line);
    }
    colors
}

/// Tints of one paint from the masstone to the palest.
#[derive(Debug, Clone, PartialEq)]
pub struct TintLadder {
    /// Pigment of the library.
    pub paint: PigmentId,
    /// Colours by step of [`TINTS`].
    pub colors: Vec<Appearance>,
}

/// Computes the tints of every paint but the white.
#[must_use]
pub fn tint_ladders(palette: &Palette<'_>) -> Vec<TintLadder> {
    let paints = palette.paints().iter().filter(|&&p| Some(p) != palette.white());
    paints
        .map(|&paint: &PigmentId| TintLadder {
            paint,
            colors: TINTS.iter().map(|&parts| palette.color(&palette.tint(paint, parts))).collect(),
        })
        .collect()
}

/// A film of one thickness over both cards.
#[derive(Debug, Clone, PartialEq)]
pub struct DrawdownStep {
    /// Thickness in the library's unit; for absolute amounts, in washes of the paint.
    pub thickness: f64,
    /// Colour over the black card.
    pub over_black: Appearance,
    /// Colour over the white card.
    pub over_white: Appearance,
}

/// A paint drawn down in several thicknesses over a black-and-white card.
#[derive(Debug, Clone, PartialEq)]
pub struct Drawdown {
    /// Pigment of the library.
    pub paint: PigmentId,
    /// Films from thin to thick, that is from undertone to masstone.
    pub steps: Vec<DrawdownStep>,
    /// Colour of the film that hides.
    pub masstone: Appearance,
}

/// Computes drawdowns of every paint at each of `thicknesses` (0 and up, in the library's unit; for
/// absolute amounts, in washes of the paint).
#[must_use]
pub fn drawdowns(palette: &Palette<'_>, thicknesses: &[f64]) -> Vec<Drawdown> {
    let film = palette.library().film();
    let cards = palette.cards();
    let drawdown = |&paint: &PigmentId| {
        let mixture = palette.mixture(&Recipe::single(paint));
        let over =
            |thickness: f64, card: &[f64]| palette.appearance(&mixture.film(thickness, card, film));
        Drawdown {
            paint,
            steps: thicknesses
                .iter()
                .map(|&thickness: &f64| DrawdownStep {
                    thickness,
                    over_black: over(thickness, &cards.black),
                    over_white: over(thickness, &cards.white),
                })
                .collect(),
            masstone: palette.appearance(&mixture.hiding(film.surface)),
        }
    };
    palette.paints().iter().map(drawdown).collect()
}
