//! The black and the white card that a film is drawn down over.

use spectra::{Grid, TristimulusWeights};

use crate::swatch::SwatchSet;

/// Measured reflectance of the two cards, bare.
#[derive(Debug, Clone, PartialEq)]
pub struct Cards {
    /// The black card, as a fraction at each wavelength.
    pub black: Vec<f64>,
    /// The white card.
    pub white: Vec<f64>,
    /// Whether the black card was measured; else it is the standard's.
    pub black_measured: bool,
    /// Whether the white card was measured.
    pub white_measured: bool,
}

/// Y of the black card of ISO 6504-3 is at most 5.
const BLACK: f64 = 0.05;
/// Y of the white card of ISO 6504-3 is 80, within 2.
const WHITE: f64 = 0.80;

impl Cards {
    /// Cards at the limits of ISO 6504-3: 0.05 and 0.80 at every wavelength.
    #[must_use]
    pub fn standard(grid: Grid) -> Self {
        let even = |value| vec![value; grid.count()];
        Self {
            black: even(BLACK),
            white: even(WHITE),
            black_measured: false,
            white_measured: false,
        }
    }

    /// The cards under the films of `set`: the darkest backing read bare if its
    /// Y is 10 or less, the lightest if its Y is 60 or more; the standard's for
    /// what is not there, or where the set stands on another grid than
    /// `weights`.
    #[must_use]
    pub fn of(set: &SwatchSet, weights: &TristimulusWeights) -> Self {
        let mut cards = Self::standard(weights.grid());
        if set.grid != weights.grid() {
            return cards;
        }
        let mut bare = bare_backings(set);
        let luminance = |card: &[f64]| weights.xyz(card).y;
        bare.sort_by(|a, b| luminance(a).total_cmp(&luminance(b)));
        if let Some(black) = bare.first().filter(|card| luminance(card) <= 10.0) {
            (cards.black, cards.black_measured) = (black.clone(), true);
        }
        if let Some(white) = bare.last().filter(|card| luminance(card) >= 60.0) {
            (cards.white, cards.white_measured) = (white.clone(), true);
        }
        cards
    }
}

/// Mean bare reflectance of each backing, over the films that lie on it.
fn bare_backings(set: &SwatchSet) -> Vec<Vec<f64>> {
    let films = || set.swatches.iter().flat_map(|swatch| &swatch.films);
    let mut names: Vec<&str> = films().map(|film| film.backing.as_str()).collect();
    names.sort_unstable();
    names.dedup();
    let mean = |name: &str| {
        let bare: Vec<&[f64]> = films()
            .filter(|film| film.backing == name)
            .filter_map(|film| film.bare.as_deref())
            .collect();
        let sum = |at: usize| bare.iter().map(|card| card[at]).sum::<f64>();
        let values = (0..set.grid.count()).map(|at| sum(at) / bare.len() as f64).collect();
        (!bare.is_empty()).then_some(values)
    };
    names.into_iter().filter_map(mean).collect()
}
