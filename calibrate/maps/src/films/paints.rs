//! K and S of the pigments that take part in a map, on its bands.

use pigment::library::PigmentLibrary;
use pigment::{PigmentId, RecipeError};
use spectra::optics::{Surface, infinite_film};

use super::bands::Bands;
use crate::map_error::MapError;
use crate::pixel_maps::BlockMaps;

/// Least K and S relative to the greatest of its pigment; below it the optics have no slope.
const LEAST: f64 = 1e-7;

/// Pigments on the bands of a map.
#[derive(Debug, Clone, PartialEq)]
pub struct Paints {
    /// Names of the pigments, as the library has them.
    pub names: Vec<String>,
    /// K by pigment and band, above 0.
    pub absorption: Vec<Vec<f64>>,
    /// S by pigment and band, above 0.
    pub scattering: Vec<Vec<f64>>,
    /// Surface of the paint.
    pub surface: Surface,
}

impl Paints {
    /// Pigments of `library` that are called one of `palette`; of an empty palette all whose K and S are
    /// measured.
    ///
    /// # Errors
    /// [`MapError::Name`] for a name that matches no pigment or several, [`MapError::Pigments`] unless 1 to
    /// 64 take part.
    pub fn new(
        library: &PigmentLibrary,
        palette: &[String],
        bands: &Bands,
    ) -> Result<Self, MapError> {
        let mut chosen: Vec<PigmentId> = if palette.is_empty() {
            library
                .ids()
                .filter(|id: &PigmentId| library[*id].identified && !library[*id].guessed)
                .collect()
        } else {
            palette.iter().map(|name| library.find(name)).collect::<Result<_, RecipeError>>()?
        };
        chosen.sort_unstable();
        chosen.dedup();
        if !(1..=BlockMaps::MOST_PIGMENTS).contains(&chosen.len()) {
            let found = chosen.len();
            let most = BlockMaps::MOST_PIGMENTS;
            return Err(MapError::Pigments { found, most });
        }
        let folded = |values: &[f64]| {
            let folded = bands.fold_library(values);
            let greatest = folded.iter().copied().fold(0.0, f64::max).max(1e-6);
            folded.into_iter().map(|value| value.max(LEAST * greatest)).collect::<Vec<f64>>()
        };
        Ok(Self {
            names: chosen.iter().map(|&id| library[id].name.clone()).collect(),
            absorption: chosen.iter().map(|&id| folded(&library[id].absorption)).collect(),
            scattering: chosen.iter().map(|&id| folded(&library[id].scattering)).collect(),
            surface: library.saunderson,
        })
    }

    /// Number of pigments.
    #[must_use]
    pub fn count(&self) -> usize {
        self.names.len()
    }

    /// Number of bands.
    #[must_use]
    pub fn bands(&self) -> usize {
        self.absorption.first().map_or(0, Vec::len)
    }

    /// Place of the pigment called `name`; `None` if none is.
    #[must_use]
    pub fn place(&self, name: &str) -> Option<usize> {
        self.names.iter().position(|known| known == name)
    }

    /// K and S of a mixture by band, from pigments with their shares.
    #[must_use]
    pub fn mixed(&self, shares: &[(usize, f64)]) -> (Vec<f64>, Vec<f64>) {
        let sum = |curves: &[Vec<f64>], band: usize| -> f64 {
            shares.iter().map(|&(pigment, share)| share * curves[pigment][band]).sum()
        };
        let of = |curves: &[Vec<f64>]| (0..self.bands()).map(|band| sum(curves, band)).collect();
        (of(&self.absorption), of(&self.scattering))
    }

    /// Measured reflectance of a mixture in a film that hides, by band.
    #[must_use]
    pub fn reflectance(&self, shares: &[(usize, f64)]) -> Vec<f64> {
        let (absorption, scattering) = self.mixed(shares);
        let pairs = absorption.iter().zip(&scattering);
        pairs.map(|(&k, &s)| self.surface.measured_from_internal(infinite_film(k, s))).collect()
    }

    /// Slope dR/d ln(K/S) of the measured reflectance, 0 or below, at an internal reflectance.
    #[must_use]
    pub fn log_slope(&self, internal: f64) -> f64 {
        -self.surface.measured_slope(internal) * internal * (1.0 - internal) / (1.0 + internal)
    }

    /// Optical strength of a pigment: the mean of K + S over the bands.
    #[must_use]
    pub fn strength(&self, pigment: usize) -> f64 {
        let sum = |curve: &[f64]| curve.iter().sum::<f64>();
        (sum(&self.absorption[pigment]) + sum(&self.scattering[pigment])) / self.bands() as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn oils() -> (PigmentLibrary, Bands) {
        let library = PigmentLibrary::van_gogh_oils();
        let nm: Vec<f64> = library.grid.wavelengths_nm().collect();
        let bands = Bands::new(&nm, library.grid).unwrap();
        (library, bands)
    }

    #[test]
    fn reflectances_are_those_of_the_library() {
        let (library, bands) = oils();
        let paints = Paints::new(&library, &[], &bands).unwrap();
        assert_eq!(paints.count(), 18, "two pigments have no known S");
        let recipe = library.recipe([("Zinc White", 0.8), ("Viridian", 0.2)]).unwrap();
        let expected = library.mix(recipe).unwrap().hiding(library.saunderson);
        let place = |name| paints.place(name).unwrap();
        let found = paints.reflectance(&[(place("Zinc White"), 0.8), (place("Viridian"), 0.2)]);
        for (a, b) in found.iter().zip(&expected) {
            assert!((a - b).abs() < 1e-12, "{a} {b}");
        }
    }

    #[test]
    fn the_slope_is_that_of_the_reflectance() {
        let (library, bands) = oils();
        let paints = Paints::new(&library, &[], &bands).unwrap();
        for q in [1e-3, 0.1, 1.0, 30.0] {
            let at =
                |log: f64| paints.surface.measured_from_internal(infinite_film(f64::exp(log), 1.0));
            let log = f64::ln(q);
            let quotient = (at(log + 1e-5) - at(log - 1e-5)) / 2e-5;
            let slope = paints.log_slope(infinite_film(q, 1.0));
            assert!((quotient - slope).abs() < 1e-7, "{q}: {quotient} {slope}");
        }
    }

    #[test]
    fn a_palette_is_looked_up_by_name() {
        let (library, bands) = oils();
        let palette = ["viridian".to_owned(), "Zinc White".to_owned(), "Viridian".to_owned()];
        let paints = Paints::new(&library, &palette, &bands).unwrap();
        assert_eq!(paints.names, ["Zinc White", "Viridian"]);
        let error = Paints::new(&library, &["Viridium".to_owned()], &bands).unwrap_err();
        assert!(matches!(error, MapError::Name(_)), "{error}");
    }
}
