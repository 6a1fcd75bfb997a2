//! The paints of a library that can be mixed, and how mixtures of them look.

use spectra::TristimulusWeights;
use spectra::color::{Adaptation, Lab, Rgb, RgbSpace, Xyz};

use super::cards::Cards;
use crate::evaluate::Viewing;
use crate::library::{AmountKind, PigmentLibrary};
use crate::mixture::Mixture;

/// How far a wash goes from the paper to hiding, where it absorbs most.
const WASH_DEPTH: f64 = 0.9;

/// Pigments of a library by index, with their shares.
pub type Recipe = Vec<(usize, f64)>;

/// A colour under one light.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Appearance {
    /// Tristimulus values, Y = 100 for the white.
    pub xyz: Xyz,
    /// CIELAB under the light's own white.
    pub lab: Lab,
    /// Encoded sRGB, adapted from the light to the display (Bradford); outside
    /// 0..1 where sRGB cannot show the colour.
    pub srgb: Rgb,
}

impl Appearance {
    /// The appearance of `xyz` under the white `white`.
    #[must_use]
    pub fn of(xyz: Xyz, white: Xyz) -> Self {
        Self {
            xyz,
            lab: Lab::from_xyz(xyz, white),
            srgb: RgbSpace::Srgb.encoded_from_xyz(xyz, white, Adaptation::Bradford),
        }
    }
}

/// A library under one light and observer, with the cards its films lie on.
#[derive(Debug, Clone)]
pub struct Palette<'a> {
    library: &'a PigmentLibrary,
    viewing: &'a Viewing,
    weights: TristimulusWeights,
    cards: Cards,
    paints: Vec<usize>,
    white: Option<usize>,
    washes: Vec<f64>,
}

impl<'a> Palette<'a> {
    /// The paints of `library` whose scattering is identified, in its order.
    ///
    /// # Errors
    /// [`PaletteError::NothingToMix`] if there is none,
    /// [`PaletteError::Cards`] if the cards stand on another grid.
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
        let all = 0..library.pigments.len();
        let paints: Vec<usize> = all.filter(|&p| library.pigments[p].identified).collect();
        if paints.is_empty() {
            return Err(PaletteError::NothingToMix { pigments: library.pigments.len() });
        }
        let mut palette =
            Self { library, viewing, weights, cards, paints, white: None, washes: Vec::new() };
        match library.amounts {
            AmountKind::Relative => palette.white = Some(palette.white_paint()),
            AmountKind::Absolute => {
                palette.washes =
                    (0..library.pigments.len()).map(|p| palette.solve_wash(p)).collect();
            }
        }
        Ok(palette)
    }

    /// The library.
    #[must_use]
    pub fn library(&self) -> &'a PigmentLibrary {
        self.library
    }

    /// Light and observer.
    #[must_use]
    pub fn viewing(&self) -> &'a Viewing {
        self.viewing
    }

    /// The weights of light and observer on the library's grid.
    #[must_use]
    pub fn weights(&self) -> &TristimulusWeights {
        &self.weights
    }

    /// The cards.
    #[must_use]
    pub fn cards(&self) -> &Cards {
        &self.cards
    }

    /// The pigments that can be mixed, by their index in the library.
    #[must_use]
    pub fn paints(&self) -> &[usize] {
        &self.paints
    }

    /// The pigments left out, whose scattering is not identified.
    #[must_use]
    pub fn left_out(&self) -> Vec<usize> {
        let all = 0..self.library.pigments.len();
        all.filter(|&p| !self.library.pigments[p].identified).collect()
    }

    /// The name of a pigment, with a mark if its K and S are guessed.
    #[must_use]
    pub fn label(&self, pigment: usize) -> String {
        let pigment = &self.library.pigments[pigment];
        let mark = if pigment.guessed { " (guessed)" } else { "" };
        format!("{}{mark}", pigment.name)
    }

    /// A recipe in words: parts in percent, or by name alone for one pigment.
    #[must_use]
    pub fn recipe_label(&self, recipe: &[(usize, f64)]) -> String {
        if let [(only, share)] = recipe
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

    /// The paint that lightens: the reference white, or the lightest paint of a
    /// library without one. None for absolute amounts: there the paper is.
    #[must_use]
    pub fn white(&self) -> Option<usize> {
        self.white
    }

    /// The darkest paint.
    #[must_use]
    pub fn black(&self) -> usize {
        self.by_luminance(|a, b| b < a)
    }

    /// The amount of a pigment in its own wash; 1 for relative amounts.
    ///
    /// For absolute amounts, the amount at which the reflectance over the white
    /// card, where the pigment absorbs most, has gone nine tenths of the way
    /// from the bare card to a film that hides: 1 for a pigment that does
    /// nothing. A depth that is alike for strong pigments and weak ones.
    #[must_use]
    pub fn wash(&self, pigment: usize) -> f64 {
        self.washes.get(pigment).copied().unwrap_or(1.0)
    }

    /// One paint with `parts` parts of white, or thinned so with water.
    #[must_use]
    pub fn tint(&self, paint: usize, parts: f64) -> Recipe {
        self.thinned(&[(paint, 1.0)], parts)
    }

    /// A recipe of shares that sum to 1 with `parts` parts of white (or water)
    /// to one of it.
    #[must_use]
    pub fn thinned(&self, recipe: &[(usize, f64)], parts: f64) -> Recipe {
        let own = 1.0 / (1.0 + parts);
        let mut thinned: Recipe = recipe.iter().map(|&(p, share)| (p, own * share)).collect();
        if let Some(white) = self.white.filter(|_| parts > 0.0) {
            match thinned.iter_mut().find(|(p, _)| *p == white) {
                Some((_, share)) => *share += parts * own,
                None => thinned.push((white, parts * own)),
            }
        }
        thinned
    }

    /// K and S of a recipe, the amounts of washes counted in.
    ///
    /// # Panics
    /// If a share is negative, or all are 0.
    #[must_use]
    pub fn mixture(&self, recipe: &[(usize, f64)]) -> Mixture {
        let dosed: Recipe = recipe.iter().map(|&(p, share)| (p, share * self.wash(p))).collect();
        self.library.mix(&dosed).expect("a recipe has parts above 0")
    }

    /// Measured reflectance of a recipe: a film that hides, or for absolute
    /// amounts a wash over the white card.
    ///
    /// # Panics
    /// As [`Palette::mixture`].
    #[must_use]
    pub fn reflectance(&self, recipe: &[(usize, f64)]) -> Vec<f64> {
        self.seen(&self.mixture(recipe), &self.cards.white)
    }

    /// Measured reflectance of a mixture, at any wavelengths; `card` is the
    /// white card's there.
    pub(super) fn seen(&self, mixture: &Mixture, card: &[f64]) -> Vec<f64> {
        match self.library.amounts {
            AmountKind::Relative => mixture.hiding(self.library.saunderson),
            AmountKind::Absolute => mixture.film(1.0, card, self.library.film()),
        }
    }

    /// The colour of a measured reflectance.
    #[must_use]
    pub fn appearance(&self, reflectance: &[f64]) -> Appearance {
        Appearance::of(self.weights.xyz(reflectance), self.weights.white())
    }

    /// The colour of a recipe.
    ///
    /// # Panics
    /// As [`Palette::mixture`].
    #[must_use]
    pub fn look(&self, recipe: &[(usize, f64)]) -> Appearance {
        self.appearance(&self.reflectance(recipe))
    }

    /// Every two different paints, in the library's order.
    pub fn pairs(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        let paints = &self.paints;
        paints.iter().enumerate().flat_map(|(i, &a)| paints[i + 1..].iter().map(move |&b| (a, b)))
    }

    /// The largest K + S of any paint: the scale of thickness.
    pub(super) fn strongest(&self) -> f64 {
        let both = |&p: &usize| {
            let pigment = &self.library.pigments[p];
            let pairs = pigment.absorption.iter().zip(&pigment.scattering);
            pairs.map(|(k, s)| k + s).fold(0.0, f64::max)
        };
        self.paints.iter().map(both).fold(0.0, f64::max)
    }

    fn white_paint(&self) -> usize {
        let named = self.library.reference.as_ref().and_then(|name| {
            self.paints.iter().copied().find(|&p| self.library.pigments[p].name == *name)
        });
        named.unwrap_or_else(|| self.by_luminance(|a, b| b > a))
    }

    /// The paint that comes first by the luminance of its film.
    fn by_luminance(&self, better: impl Fn(f64, f64) -> bool) -> usize {
        let luminance = |&p: &usize| (p, self.look(&[(p, 1.0)]).xyz.y);
        let all = self.paints.iter().map(luminance);
        all.reduce(|a, b| if better(a.1, b.1) { b } else { a }).expect("a palette has a paint").0
    }

    fn solve_wash(&self, pigment: usize) -> f64 {
        let pigment = &self.library.pigments[pigment];
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
        let (thin, thick) = (1e-6 / (k + s), 1e6 / (k + s));
        let (start, end) = (reading(0.0), reading(thick));
        let wanted = start + WASH_DEPTH * (end - start);
        crossing(thin, thick, |amount| (reading(amount) - wanted) * (end - start) >= 0.0)
    }
}

/// Where `reached` turns true between `thin` and `thick`, in 60 halvings of the
/// logarithm: far below any rounding of a file.
pub(super) fn crossing(thin: f64, thick: f64, reached: impl Fn(f64) -> bool) -> f64 {
    let (mut below, mut above) = (thin.ln(), thick.ln());
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

/// Why there is no palette.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum PaletteError {
    /// No pigment has an identified scattering.
    #[error(
        "none of the library's pigments can be mixed: scattering is identified of `0` of {pigments}"
    )]
    NothingToMix {
        /// How many pigments there are.
        pigments: usize,
    },
    /// Cards on other wavelengths.
    #[error(
        "a card has one reflectance for each of the library's {wanted} wavelengths, found `{found}`"
    )]
    Cards {
        /// How many the library has.
        wanted: usize,
        /// How many were given.
        found: usize,
    },
}

impl PaletteError {
    /// What to try.
    #[must_use]
    pub fn hint(&self) -> &'static str {
        match self {
            Self::NothingToMix { .. } => {
                "measure mixtures of each pigment with the white, and fit again"
            }
            Self::Cards { .. } => "read the bare cards on the wavelengths of the films",
        }
    }
}
