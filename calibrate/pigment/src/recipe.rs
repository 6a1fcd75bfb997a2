//! Pigments by their index in a list, recipes of them, and [`Curves`]: K and S over wavelength.

use spectra::Grid;
use spectra::optics::{Surface, UnevenFilm, infinite_film};

/// Index of a pigment in a library, or in the list of pigments of a set of swatches. We count from 0.
///
/// Use it only with the library or list that you got it from. See
/// [`PigmentLibrary::find`](crate::library::PigmentLibrary::find).
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct PigmentId(pub usize);

impl PigmentId {
    /// The index as a number, counted from 0.
    #[must_use]
    pub fn index(self) -> usize {
        self.0
    }
}

/// Pigments of one library with their parts, 0 and up.
///
/// In a library of relative amounts only the ratios of the parts count, e.g. 9:1 is the same as 90:10. In
/// one of absolute amounts each part is an amount on the library's area.
///
/// ```
/// use pigment::{PigmentLibrary, Recipe};
///
/// let oils = PigmentLibrary::van_gogh_oils();
/// let white = oils.find("Zinc White")?;
/// let blue = oils.find("Cobalt Blue")?;
/// let recipe = Recipe::from([(white, 9.0), (blue, 1.0)]);
/// assert_eq!(recipe.total(), 10.0);
/// # Ok::<(), pigment::RecipeError>(())
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Recipe {
    parts: Vec<(PigmentId, f64)>,
}

impl Recipe {
    /// Recipe of a single pigment.
    #[must_use]
    pub fn single(pigment: PigmentId) -> Self {
        Self { parts: vec![(pigment, 1.0)] }
    }

    /// Pigments with their parts, in the order in which you gave them.
    #[must_use]
    pub fn parts(&self) -> &[(PigmentId, f64)] {
        &self.parts
    }

    /// Iterates over pigments and parts.
    pub fn iter(&self) -> std::slice::Iter<'_, (PigmentId, f64)> {
        self.parts.iter()
    }

    /// Pigments of the recipe, without their parts.
    pub fn pigments(&self) -> impl ExactSizeIterator<Item = PigmentId> + Clone + '_ {
        self.parts.iter().map(|(pigment, _)| *pigment)
    }

    /// Number of pigments.
    #[must_use]
    pub fn len(&self) -> usize {
        self.parts.len()
    }

    /// Whether the recipe names no pigment.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.parts.is_empty()
    }

    /// Sum of all parts.
    #[must_use]
    pub fn total(&self) -> f64 {
        self.parts.iter().map(|(_, part)| part).sum()
    }

    /// Parts of `pigment`, 0 if the recipe does not contain it.
    #[must_use]
    pub fn parts_of(&self, pigment: PigmentId) -> f64 {
        // A sum of nothing would be -0.
        self.parts.iter().filter(|(p, _)| *p == pigment).fold(0.0, |sum, (_, part)| sum + part)
    }

    /// Adds `parts` of `pigment`, to those that the recipe contains already.
    pub fn add(&mut self, pigment: PigmentId, parts: f64) {
        match self.parts.iter_mut().find(|(known, _)| *known == pigment) {
            Some((_, sum)) => *sum += parts,
            None => self.parts.push((pigment, parts)),
        }
    }

    /// Copy with every part multiplied by `factor`.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        self.parts.iter().map(|&(pigment, part)| (pigment, factor * part)).collect()
    }
}

impl FromIterator<(PigmentId, f64)> for Recipe {
    fn from_iter<I: IntoIterator<Item = (PigmentId, f64)>>(parts: I) -> Self {
        Self { parts: parts.into_iter().collect() }
    }
}

impl<const N: usize> From<[(PigmentId, f64); N]> for Recipe {
    fn from(parts: [(PigmentId, f64); N]) -> Self {
        Self { parts: parts.into() }
    }
}

impl<'a> IntoIterator for &'a Recipe {
    type Item = &'a (PigmentId, f64);
    type IntoIter = std::slice::Iter<'a, (PigmentId, f64)>;

    fn into_iter(self) -> Self::IntoIter {
        self.parts.iter()
    }
}

impl AsRef<[(PigmentId, f64)]> for Recipe {
    fn as_ref(&self) -> &[(PigmentId, f64)] {
        &self.parts
    }
}

/// Kubelka-Munk absorption K and scattering S on a wavelength grid.
///
/// You get K and S of a mixture as sums over its pigments, weighted by their shares (Duncan 1940). They are
/// relative to the S of the library's reference white, or per unit of amount for a library of absolute
/// amounts.
#[derive(Debug, Clone, PartialEq)]
pub struct Curves {
    /// Wavelengths of both curves.
    pub grid: Grid,
    /// K at each wavelength, 0 and up.
    pub absorption: Vec<f64>,
    /// S at each wavelength, 0 and up.
    pub scattering: Vec<f64>,
}

impl Curves {
    /// Adds up the K and S of several parts, each given as weight, K and S on `grid`.
    ///
    /// # Panics
    /// If a curve does not have one value for each wavelength of `grid`.
    #[must_use]
    pub fn weighted_sum<'a>(
        grid: Grid,
        parts: impl IntoIterator<Item = (f64, &'a [f64], &'a [f64])>,
    ) -> Self {
        let count = grid.count();
        let mut sum = Self { grid, absorption: vec![0.0; count], scattering: vec![0.0; count] };
        for (weight, absorption, scattering) in parts {
            assert!(
                absorption.len() == count && scattering.len() == count,
                "K and S must stand on {count} wavelengths"
            );
            for index in 0..count {
                sum.absorption[index] += weight * absorption[index];
                sum.scattering[index] += weight * scattering[index];
            }
        }
        sum
    }

    /// K and S as two slices.
    #[must_use]
    pub fn as_slices(&self) -> (&[f64], &[f64]) {
        (&self.absorption, &self.scattering)
    }

    /// Measured reflectance, under `surface`, of a film so thick that its ground does not show.
    #[must_use]
    pub fn hiding(&self, surface: Surface) -> Vec<f64> {
        hiding_film(&self.absorption, &self.scattering, surface)
    }

    /// Measured reflectance of a film of `thickness` over a backing. `backing` is its bare reflectance,
    /// which you measured under the same surface.
    ///
    /// At thickness 1 the reference white has S d = 1. Where K and S are per unit of amount, at 1 you have
    /// the amounts of the recipe. A backing darker than the surface's own reflection counts as black.
    #[must_use]
    pub fn film(&self, thickness: f64, backing: &[f64], film: UnevenFilm) -> Vec<f64> {
        film_over(&self.absorption, &self.scattering, thickness, backing, film)
    }
}

pub(crate) fn hiding_film(absorption: &[f64], scattering: &[f64], surface: Surface) -> Vec<f64> {
    let pairs = absorption.iter().zip(scattering);
    pairs.map(|(&k, &s)| surface.measured_from_internal(infinite_film(k, s))).collect()
}

pub(crate) fn film_over(
    absorption: &[f64],
    scattering: &[f64],
    thickness: f64,
    backing: &[f64],
    film: UnevenFilm,
) -> Vec<f64> {
    let pairs = absorption.iter().zip(scattering).zip(backing);
    pairs
        .map(|((&k, &s), &bare)| {
            let below = film.surface.internal_from_measured(bare).unwrap_or(0.0).min(1.0);
            film.reflectance(thickness * k, thickness * s, below)
        })
        .collect()
}
