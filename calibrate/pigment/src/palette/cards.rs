//! The black and the white card that films are drawn down over.

use spectra::{Grid, TristimulusWeights};

/// Measured reflectance of the two bare cards.
#[derive(Debug, Clone, PartialEq)]
pub struct Cards {
    /// Reflectance of the black card, as a fraction at each wavelength.
    pub black: Vec<f64>,
    /// Reflectance of the white card, as a fraction at each wavelength.
    pub white: Vec<f64>,
    /// Whether the black card was measured; if not, it is the standard's.
    pub black_measured: bool,
    /// Whether the white card was measured; if not, it is the standard's.
    pub white_measured: bool,
}

/// Reflectance of the standard black card: ISO 6504-3 allows Y up to 5.
const BLACK: f64 = 0.05;
/// Reflectance of the standard white card: ISO 6504-3 asks for Y = 80 within 2.
const WHITE: f64 = 0.80;
/// Greatest Y of a measured backing that counts as a black card; chosen by eye.
const DARKEST_CARD: f64 = 10.0;
/// Least Y of a measured backing that counts as a white card; chosen by eye.
const LIGHTEST_CARD: f64 = 60.0;

impl Cards {
    /// Cards at the limits of ISO 6504-3: 0.05 and 0.80 at every wavelength of `grid`.
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

    /// Chooses the cards among measured bare backings, each a reflectance on the grid of `weights`:
    /// the darkest if its Y is 10 or less, the lightest if its Y is 60 or more. A missing card is
    /// replaced by the standard's.
    #[must_use]
    pub fn among(bare: impl IntoIterator<Item = Vec<f64>>, weights: &TristimulusWeights) -> Self {
        let mut bare: Vec<Vec<f64>> = bare.into_iter().collect();
        let mut cards = Self::standard(weights.grid());
        let luminance = |card: &[f64]| weights.xyz(card).y;
        bare.sort_by(|a, b| luminance(a).total_cmp(&luminance(b)));
        if let Some(black) = bare.first().filter(|card| luminance(card) <= DARKEST_CARD) {
            (cards.black, cards.black_measured) = (black.clone(), true);
        }
        if let Some(white) = bare.last().filter(|card| luminance(card) >= LIGHTEST_CARD) {
            (cards.white, cards.white_measured) = (white.clone(), true);
        }
        cards
    }
}
