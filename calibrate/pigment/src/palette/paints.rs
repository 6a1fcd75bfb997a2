//! The paints of a library that you can mix, the colours of their mixtures, and the black and white cards
//! over which you draw films down.

use documents::hint::Explain;
use spectra::{Grid, TristimulusWeights};

use crate::color::Appearance;
use crate::evaluate::Viewing;
use crate::library::{AmountKind, PigmentLibrary};
use crate::recipe::{Curves, PigmentId, Recipe, film_over, hiding_film};

/// A wash goes this fraction of the way from the bare paper to a film that hides, at the wavelength of
/// greatest absorption. We chose it by eye.
const WASH_DEPTH: f64 = 0.9;

/// A library under one light and observer, with the cards on which its films lie.
#[derive(Debug, Clone)]
pub struct Palette<'a> {
    library: &'a PigmentLibrary,
    viewing: &'a Viewing,
    weights: TristimulusWeights,
    cards: Cards,
    paints: Vec<PigmentId>,
    white: Option<PigmentId>,
    washes: Vec<f64>,
}

impl<'a> Palette<'a> {
    /// Palette of the pigments of `library` with known scattering, in its order.
    ///
    /// # Errors
    /// [`PaletteError::NothingToMix`] if there are none, [`PaletteError::Cards`] if a card does not have one
    /// reflectance for each wavelength of the library.
    pub fn new(
        library: &'a PigmentLibrary,
        viewing: &'a Viewing,
        cards: Cards,
    ) -> Result<Self, PaletteError> {
        let count = library.grid.count();
        if cards.black.len() != count || cards.white.len() != count {
            let found =
                if cards.black.len() == count { cards.white.len() } else { cards.black.len() };
            return Err(PaletteError::Cards { wanted: count, found });
        }
        let weights = viewing.weights(library.grid).expect("the method fits the grid");
        let paints: Vec<PigmentId> = library.ids().filter(|&p| library[p].identified).collect();
        if paints.is_empty() {
            return Err(PaletteError::NothingToMix(library.pigments.len()));
        }
        let mut palette =
            Self { library, viewing, weights, cards, paints, white: None, washes: Vec::new() };
        match library.amounts {
            AmountKind::Relative => palette.white = Some(palette.white_paint()),
            AmountKind::Absolute => {
                palette.washes = library.ids().map(|p| palette.solve_wash(p)).collect();
            }
        }
        Ok(palette)
    }

    /// This palette with no more than these pigments, for example the tubes that you have. Without the
    /// reference white the lightest of them lightens the others.
    ///
    /// # Errors
    /// [`PaletteError::NothingToMix`] if none of them can be mixed.
    pub fn among(mut self, pigments: &[PigmentId]) -> Result<Self, PaletteError> {
        self.paints.retain(|paint| pigments.contains(paint));
        if self.paints.is_empty() {
            return Err(PaletteError::NothingToMix(pigments.len()));
        }
        self.white = self.white.map(|_| self.white_paint());
        Ok(self)
    }

    /// Library of the palette.
    #[must_use]
    pub fn library(&self) -> &'a PigmentLibrary {
        self.library
    }

    /// Light and observer of all colours.
    #[must_use]
    pub fn viewing(&self) -> &'a Viewing {
        self.viewing
    }

    /// Tristimulus weights of light and observer on the library's grid.
    #[must_use]
    pub fn weights(&self) -> &TristimulusWeights {
        &self.weights
    }

    /// Black and white card.
    #[must_use]
    pub fn cards(&self) -> &Cards {
        &self.cards
    }

    /// Pigments that you can mix, in the library's order.
    #[must_use]
    pub fn paints(&self) -> &[PigmentId] {
        &self.paints
    }

    /// Pigments that we leave out because their scattering is not identified.
    #[must_use]
    pub fn left_out(&self) -> Vec<PigmentId> {
        self.library.ids().filter(|&p| !self.library[p].identified).collect()
    }

    /// Name of a pigment. It has a mark if you guessed its K and S.
    #[must_use]
    pub fn label(&self, pigment: PigmentId) -> String {
        let pigment = &self.library[pigment];
        let mark = if pigment.guessed { " (guessed)" } else { "" };
        format!("{}{mark}", pigment.name)
    }

    /// Recipe of shares in words: percentages with names, or only the name for a single pigment.
    #[must_use]
    pub fn recipe_label(&self, recipe: &Recipe) -> String {
        if let [(only, share)] = recipe.parts()
            && (share - 1.0).abs() < 1e-9
        {
            return self.label(*only);
        }
        let parts = recipe.iter().filter(|(_, share)| *share > 0.0);
        let words = parts.map(|(p, share)| {
            let percent = (1000.0 * share).round() / 10.0;
            format!("{percent} % {}", self.label(*p))
        });
        words.collect::<Vec<_>>().join(" + ")
    }

    /// Paint that lightens others. It is the reference white, or the lightest paint of a library without
    /// one. `None` for absolute amounts, where you use the paper instead.
    #[must_use]
    pub fn white(&self) -> Option<PigmentId> {
        self.white
    }

    /// Darkest paint by the luminance of its film.
    #[must_use]
    pub fn black(&self) -> PigmentId {
        self.by_luminance(|a, b| b < a)
    }

    /// Amount of a pigment in its own wash. 1 for relative amounts.
    ///
    /// For absolute amounts we choose the amount so that the reflectance over the white card, at the
    /// wavelength of greatest absorption, is nine tenths of the way from the bare card to a film that
    /// hides. You thus get equally deep washes of strong and weak pigments. It is 1 for a pigment without K
    /// and S.
    #[must_use]
    pub fn wash(&self, pigment: PigmentId) -> f64 {
        self.washes.get(pigment.index()).copied().unwrap_or(1.0)
    }

    /// Recipe of one paint with `parts` parts of white (or water) to one part of it.
    #[must_use]
    pub fn tint(&self, paint: PigmentId, parts: f64) -> Recipe {
        self.thinned(&Recipe::single(paint), parts)
    }

    /// Recipe with `parts` parts of white (or water) to one part of `recipe`. The shares of `recipe` sum to
    /// 1.
    #[must_use]
    pub fn thinned(&self, recipe: &Recipe, parts: f64) -> Recipe {
        let own = 1.0 / (1.0 + parts);
        let mut thinned = recipe.scaled(own);
        if let Some(white) = self.white.filter(|_| parts > 0.0) {
            thinned.add(white, parts * own);
        }
        thinned
    }

    /// K and S of a recipe. In a library of absolute amounts a share of 1 is one wash of the pigment.
    ///
    /// # Panics
    /// If a share is negative, or all are 0.
    #[must_use]
    pub fn mixture(&self, recipe: &Recipe) -> Curves {
        let dosed: Recipe = recipe.iter().map(|&(p, share)| (p, share * self.wash(p))).collect();
        self.library.mix(dosed).expect("a recipe has parts above 0")
    }

    /// Measured reflectance of a recipe: of a film that hides or, for absolute amounts, of a wash over
    /// the white card.
    ///
    /// # Panics
    /// If a share is negative, or all are 0.
    #[must_use]
    pub fn reflectance(&self, recipe: &Recipe) -> Vec<f64> {
        let curves = self.mixture(recipe);
        self.film_reflectance(curves.as_slices(), &self.cards.white)
    }

    /// Measured reflectance of a film from its K and S at any wavelengths. `card` is the reflectance
    /// of the white card at these.
    pub(super) fn film_reflectance(&self, (k, s): (&[f64], &[f64]), card: &[f64]) -> Vec<f64> {
        match self.library.amounts {
            AmountKind::Relative => hiding_film(k, s, self.library.saunderson),
            AmountKind::Absolute => film_over(k, s, 1.0, card, self.library.film()),
        }
    }

    /// Colour of a measured reflectance.
    #[must_use]
    pub fn appearance(&self, reflectance: &[f64]) -> Appearance {
        Appearance::of(self.weights.xyz(reflectance), self.weights.white())
    }

    /// Colour of a recipe.
    ///
    /// # Panics
    /// If a share is negative, or all are 0.
    #[must_use]
    pub fn color(&self, recipe: &Recipe) -> Appearance {
        self.appearance(&self.reflectance(recipe))
    }

    /// Every pair of different paints, in the library's order.
    pub fn pairs(&self) -> impl Iterator<Item = (PigmentId, PigmentId)> + '_ {
        let paints = &self.paints;
        paints.iter().enumerate().flat_map(|(i, &a)| paints[i + 1..].iter().map(move |&b| (a, b)))
    }

    /// Largest K + S of any paint, which sets the scale of thickness.
    pub(super) fn strongest(&self) -> f64 {
        self.paints
            .iter()
            .map(|&p| {
                let pigment = &self.library[p];
                let pairs = pigment.absorption.iter().zip(&pigment.scattering);
                pairs.map(|(k, s)| k + s).fold(0.0, f64::max)
            })
            .fold(0.0, f64::max)
    }

    fn white_paint(&self) -> PigmentId {
        let reference = self.library.reference_id().filter(|id| self.paints.contains(id));
        reference.unwrap_or_else(|| self.by_luminance(|a, b| b > a))
    }

    /// Paint with the best luminance of its film. `better` says whether its second luminance is better than
    /// the first.
    fn by_luminance(&self, better: impl Fn(f64, f64) -> bool) -> PigmentId {
        let all = self.paints.iter().map(|&p| (p, self.color(&Recipe::single(p)).xyz.y));
        all.reduce(|a, b| if better(a.1, b.1) { b } else { a }).expect("a palette has a paint").0
    }

    fn solve_wash(&self, pigment: PigmentId) -> f64 {
        let pigment = &self.library[pigment];
        let absorption = pigment.absorption.iter().enumerate();
        let (at, k) =
            absorption.fold((0, 0.0), |most, (i, &k)| if k > most.1 { (i, k) } else { most });
        let s = pigment.scattering[at];
        if k + s <= 0.0 {
            return 1.0;
        }
        let film = self.library.film();
        let bare = self.cards.white[at];
        let card = film.surface.internal_from_measured(bare).unwrap_or(0.0).min(1.0);
        let reading = |amount: f64| film.reflectance(amount * k, amount * s, card);
        let thin = 1e-6 / (k + s);
        let thick = 1e6 / (k + s);
        let start = reading(0.0);
        let end = reading(thick);
        let wanted = start + WASH_DEPTH * (end - start);
        crossing(thin, thick, |amount| (reading(amount) - wanted) * (end - start) >= 0.0)
    }
}

/// Returns the value between `thin` and `thick` at which `reached` turns true. We bisect the logarithm 60
/// times, so the error is far below the rounding of values in a file.
pub(super) fn crossing(thin: f64, thick: f64, reached: impl Fn(f64) -> bool) -> f64 {
    let mut below = thin.ln();
    let mut above = thick.ln();
    for _ in 0..60 {
        let middle = f64::midpoint(below, above);
        if reached(middle.exp()) {
            above = middle;
        } else {
            below = middle;
        }
    }
    above.exp()
}

/// A library from which you cannot make a palette.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error, Explain)]
pub enum PaletteError {
    /// No pigment has an identified scattering.
    #[error("none of the library's pigments can be mixed: scattering is identified of `0` of {0}")]
    #[hint("measure mixtures of each pigment with the white, and fit again")]
    NothingToMix(usize),
    /// The number of reflectances of a card differs from the number of wavelengths of the library.
    #[error(
        "a card has one reflectance for each of the library's {wanted} wavelengths, found `{found}`"
    )]
    #[hint("read the bare cards on the wavelengths of the films")]
    Cards {
        /// Wavelengths of the library.
        wanted: usize,
        /// Wavelengths of the card.
        found: usize,
    },
}

/// Measured reflectance of the two bare cards.
#[derive(Debug, Clone, PartialEq)]
pub struct Cards {
    /// Reflectance of the black card, as a fraction at each wavelength.
    pub black: Vec<f64>,
    /// Reflectance of the white card, as a fraction at each wavelength.
    pub white: Vec<f64>,
    /// Whether you measured the black card. If not, it is the standard's.
    pub black_measured: bool,
    /// Whether you measured the white card. If not, it is the standard's.
    pub white_measured: bool,
}

/// Reflectance of the standard black card: ISO 6504-3 allows Y up to 5.
const BLACK: f64 = 0.05;
/// Reflectance of the standard white card: ISO 6504-3 asks for Y = 80 within 2.
const WHITE: f64 = 0.80;
/// A measured backing counts as a black card up to this Y. We chose it by eye.
const DARKEST_CARD: f64 = 10.0;
/// A measured backing counts as a white card from this Y on. We chose it by eye.
const LIGHTEST_CARD: f64 = 60.0;

impl Cards {
    /// Cards at the limits of ISO 6504-3: 0.05 and 0.80 at every wavelength of `grid`.
    #[must_use]
    pub fn standard(grid: Grid) -> Self {
        Self {
            black: vec![BLACK; grid.count()],
            white: vec![WHITE; grid.count()],
            black_measured: false,
            white_measured: false,
        }
    }

    /// Chooses the cards among measured bare backings. Give each as a reflectance on the grid of `weights`.
    /// We take the darkest if its Y is 10 or less, and the lightest if its Y is 60 or more. The standard's
    /// card replaces a missing one.
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

/// A measured swatch. All of its pigments are in the palette.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasuredSample {
    /// Name of the sample.
    pub sample: String,
    /// Pigments of the library with their shares, sum 1.
    pub recipe: Recipe,
    /// Measured reflectance of a film that hides, surface included, on the library's grid.
    pub reflectance: Vec<f64>,
}
