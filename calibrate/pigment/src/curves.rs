//! Absorption and scattering over wavelength, of a pigment or of a mixture.

use spectra::Grid;
use spectra::optics::{Surface, UnevenFilm, infinite_film};

/// Kubelka-Munk absorption K and scattering S on a wavelength grid.
///
/// K and S of a mixture are sums over its pigments, weighted by their shares (Duncan 1940). They are
/// relative to the S of the library's reference white, or per unit of amount for a library of
/// absolute amounts.
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

    /// Measured reflectance of a film of `thickness` over a backing whose bare reflectance, measured
    /// under the same surface, is `backing`.
    ///
    /// Thickness 1 is the thickness at which the reference white has S d = 1, or the amounts of the
    /// recipe where K and S are per unit of amount. A backing darker than the surface's own
    /// reflection counts as black.
    #[must_use]
    pub fn film(&self, thickness: f64, backing: &[f64], film: UnevenFilm) -> Vec<f64> {
        film_over(&self.absorption, &self.scattering, thickness, backing, film)
    }
}

/// Measured reflectance of a film that hides, at any wavelengths.
pub(crate) fn hiding_film(absorption: &[f64], scattering: &[f64], surface: Surface) -> Vec<f64> {
    let pairs = absorption.iter().zip(scattering);
    pairs.map(|(&k, &s)| surface.measured_from_internal(infinite_film(k, s))).collect()
}

/// Measured reflectance of a film over a backing, at any wavelengths.
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
