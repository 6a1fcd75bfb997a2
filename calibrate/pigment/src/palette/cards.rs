//! The black and the white card that a film is drawn down over.

use spectra::{Grid, TristimulusWeights};

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

    /// The cards among measured `bare` backings, each a reflectance on the grid of
    /// `weights`: the darkest if its Y is 10 or less, the lightest if its Y is 60 or
    /// more. The standard's reflectance stands for a card that is not there.
    #[must_use]
    pub fn among(mut bare: Vec<Vec<f64>>, weights: &TristimulusWeights) -> Self {
        let mut cards = Self::standard(weights.grid());
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
