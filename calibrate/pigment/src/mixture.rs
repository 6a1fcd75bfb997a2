//! Mixing forward: from a recipe to a reflectance.

use spectra::optics::{Surface, UnevenFilm, infinite_film};

/// K and S of a mixture of pigments, at each wavelength of its library.
///
/// Kubelka-Munk mixing (Duncan 1940): both add up, weighted by the shares.
#[derive(Debug, Clone, PartialEq)]
pub struct Mixture {
    /// K, 0 and up.
    pub absorption: Vec<f64>,
    /// S, 0 and up.
    pub scattering: Vec<f64>,
}

impl Mixture {
    /// The sum of `(weight, absorption, scattering)` of each part.
    ///
    /// # Panics
    /// If the parts do not stand on `count` wavelengths.
    #[must_use]
    pub fn of<'a>(
        count: usize,
        parts: impl IntoIterator<Item = (f64, &'a [f64], &'a [f64])>,
    ) -> Self {
        let mut mixture = Self { absorption: vec![0.0; count], scattering: vec![0.0; count] };
        for (weight, absorption, scattering) in parts {
            assert!(
                absorption.len() == count && scattering.len() == count,
                "K and S must stand on {count} wavelengths"
            );
            for index in 0..count {
                mixture.absorption[index] += weight * absorption[index];
                mixture.scattering[index] += weight * scattering[index];
            }
        }
        mixture
    }

    /// Measured reflectance of a film that hides, under `surface`.
    #[must_use]
    pub fn hiding(&self, surface: Surface) -> Vec<f64> {
        let pairs = self.absorption.iter().zip(&self.scattering);
        pairs.map(|(&k, &s)| surface.measured_from_internal(infinite_film(k, s))).collect()
    }

    /// Measured reflectance of a film of `thickness` over a backing whose bare
    /// reflectance, measured under the same surface, is `backing`.
    ///
    /// Thickness is in the library's unit: 1 is the thickness in which the
    /// reference white has S d = 1, or 1 where K and S are per unit of amount.
    /// A backing darker than the surface's own reflection counts as black.
    #[must_use]
    pub fn film(&self, thickness: f64, backing: &[f64], film: UnevenFilm) -> Vec<f64> {
        let pairs = self.absorption.iter().zip(&self.scattering).zip(backing);
        pairs
            .map(|((&k, &s), &bare)| {
                let below = film.surface.internal_from_measured(bare).unwrap_or(0.0).min(1.0);
                film.reflectance(thickness * k, thickness * s, below)
            })
            .collect()
    }
}
