//! Reflectance of a ground. You choose its priming, and may put an imprimatura over it, which is a
//! thin dry film of paint.
//!
//! We give the film one thickness everywhere, so ground and film together have one reflectance.
//! This equals a dry layer of this height over this priming, at all wavelengths of the library.

use std::collections::BTreeMap;

use pigment::library::PigmentLibrary;
use pigment::palette::scattering_per_mm;
use pigment::smooth_reflectance::smoothest_reflectance;
use pigment::{PigmentId, evaluate::Viewing};
use serde::{Deserialize, Serialize};
use spectra::color::{Adaptation, Rgb, RgbSpace};
use spectra::optics::UnevenFilm;
use spectra::{Extrapolation, Grid, Interpolation, Reflectance, Spectrum};

use super::{GroundError, check_range};

/// Measured reflectance of a ground. You write it as `0.87`, `{"rgb": "#f4f1e8"}`, `{"spectrum":
/// {"grid": {..}, "values": [..]}}`, or as a film of paint over the library's white, `{"film":
/// {"recipe": {"Bone Black": 1}, "height_mm": 0.003}}`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(
    untagged,
    expecting = "reflectance is a number 0 to 1, {rgb: #rrggbb}, {spectrum: {grid, values}} or \
                 {film: {recipe, height_mm}}"
)]
pub enum Primer {
    /// One reflectance for all wavelengths, 0 to 1.
    Grey(f64),
    /// The smoothest reflectance that has a given colour.
    Color(ColorPrimer),
    /// A measured spectrum.
    Measured(MeasuredPrimer),
    /// The white of the library under a thin dry film of paint.
    Toned(TonedPrimer),
}

/// Colour of a ground.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ColorPrimer {
    /// sRGB colour under D65, written `#rrggbb`. If paint with the library's surface cannot have
    /// this colour, we take a near one.
    pub rgb: String,
}

/// Measured reflectance of a ground, as a file stores it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MeasuredPrimer {
    /// Reflectance by wavelength.
    pub spectrum: PrimerSpectrum,
}

/// Reflectance on a wavelength grid of its own.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PrimerSpectrum {
    /// Wavelengths of the values.
    pub grid: Grid,
    /// Measured reflectance for each wavelength, 0 to 1.
    pub values: Vec<f64>,
}

/// Reflectance of a white priming for libraries without a reference white (an assumption).
const WHITE: f64 = 0.87;

impl Primer {
    /// Measured reflectance of an opaque film of the library's reference white, on its
    /// grid. 0.87 throughout if it has none.
    #[must_use]
    pub fn library_white(library: &PigmentLibrary) -> Vec<f64> {
        let reference = library.reference.as_deref().and_then(|name| library.find(name).ok());
        let film = reference.and_then(|index| library.mix([(index, 1.0)]).ok());
        film.map_or_else(
            || vec![WHITE; library.grid.count()],
            |film| film.hiding(library.saunderson),
        )
    }

    /// Measured reflectance on the grid of `library`. If a spectrum covers less, we extend it by
    /// its end values.
    ///
    /// # Errors
    /// [`GroundError`] for a value out of range, or an invalid colour or spectrum.
    pub fn reflectance(&self, library: &PigmentLibrary) -> Result<Vec<f64>, GroundError> {
        let grid = library.grid;
        match self {
            Self::Grey(value) => {
                Ok(vec![check_range("reflectance", "", *value, [0.0, 1.0])?; grid.count()])
            }
            Self::Color(ColorPrimer { rgb }) => {
                let color = Rgb::from_hex(rgb).ok_or_else(|| GroundError::Color(rgb.clone()))?;
                let weights = Viewing::default().weights(grid)?;
                let white = weights.white();
                let surface = library.saunderson;
                let xyz = RgbSpace::Srgb.xyz_from_encoded(color, white, Adaptation::Bradford);
                let found = smoothest_reflectance(&weights, surface, xyz).internal;
                Ok(found.into_iter().map(|r| surface.measured_from_internal(r)).collect())
            }
            Self::Toned(toned) => toned.over(&Self::library_white(library), library),
            Self::Measured(MeasuredPrimer { spectrum }) => {
                let PrimerSpectrum { grid: own, values } = spectrum;
                let start_nm = own.start_nm();
                let end_nm = own.end_nm();
                if start_nm > grid.end_nm() || end_nm < grid.start_nm() {
                    let library = grid.to_string();
                    return Err(GroundError::Band { start_nm, end_nm, library });
                }
                let spectrum = Spectrum::<Reflectance>::new(*own, values.clone())?;
                let method = Interpolation::best_for(*own);
                Ok(spectrum.resampled(grid, method, Extrapolation::Hold)?.into_values())
            }
        }
    }
}

/// Scattering per mm of a library that does not have a white that hides, as in
/// [`Medium`](crate::document::Medium).
const USUAL_SCATTERING_PER_MM: f64 = 50.0;

/// A film of paint over the library's white. You write it as `{"film": {"recipe": {"Bone Black": 1,
/// "Vermilion": 2}, "height_mm": 0.003}}`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TonedPrimer {
    /// Pigments and height of the film.
    pub film: PrimerFilm,
}

/// A thin film of paint of even thickness.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PrimerFilm {
    /// Parts by volume of each pigment, by its name in the library.
    pub recipe: BTreeMap<String, f64>,
    /// Height of the paint in mm without the medium that thinned it, 0 to 0.5.
    pub height_mm: f64,
}

impl TonedPrimer {
    /// Measured reflectance of the film over `priming`, both on the grid of `library`. We assume
    /// that its reference white hides from 0.05 mm on.
    ///
    /// # Errors
    /// [`GroundError`] for a height out of range, and for pigments or parts that the library
    /// cannot mix.
    pub fn over(&self, priming: &[f64], library: &PigmentLibrary) -> Result<Vec<f64>, GroundError> {
        let PrimerFilm { recipe, height_mm } = &self.film;
        let height_mm = check_range("height_mm", " mm", *height_mm, [0.0, 0.5])?;
        let parts = library.recipe(recipe.iter().map(|(name, part)| (name, *part)))?;
        let parts = parts.as_ref();
        let sum: f64 = parts.iter().map(|(_, part)| part).sum();
        // The height counts all pigments together. This also holds where a library gives parts as
        // amounts.
        let shares: Vec<(PigmentId, f64)> =
            parts.iter().map(|&(pigment, part)| (pigment, part / sum.max(1e-12))).collect();
        let mixture = library.mix(shares)?;
        let per_mm = scattering_per_mm(library).unwrap_or(USUAL_SCATTERING_PER_MM);
        // The unevenness of a library belongs to its measured films.
        let even = UnevenFilm { unevenness: 0.0, ..library.film() };
        Ok(mixture.film(height_mm * per_mm, priming, even))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::amount::QUANTA_PER_CELL;
    use crate::ground::{GroundRelief, GroundSpec, Panel, Primer};
    use crate::layer::{Cell, Layer};
    use crate::scene::SpectralDocument;
    use crate::strokes::{Canvas, PaletteSpec, StrokeScript};

    fn toned(recipe: &[(&str, f64)], height_mm: f64) -> TonedPrimer {
        let recipe = recipe.iter().map(|(name, part)| ((*name).to_owned(), *part)).collect();
        TonedPrimer { film: PrimerFilm { recipe, height_mm } }
    }

    #[test]
    fn a_toned_ground_has_the_color_of_a_dry_layer_of_its_film() {
        let library = PigmentLibrary::van_gogh_oils();
        let ground = GroundSpec {
            relief: GroundRelief::Panel(Panel::default()),
            reflectance: None,
            gloss: None,
        };
        let canvas = Canvas { width_mm: 1.0, height_mm: 1.0, cell_mm: 0.5, ground };
        let palette = PaletteSpec::from_names(["Vermilion", "Bone Black"]);
        let script = StrokeScript::new("toned", "", canvas, palette);
        let (mut layered, _) = script.surfaces(&library, None).unwrap();
        let quanta = QUANTA_PER_CELL / 64;
        let mut paint = Layer::empty(2, 2);
        let mut cell = Cell::default();
        (cell.pigments[0], cell.pigments[1]) = (3 * quanta, quanta);
        (0..4).for_each(|index| paint.set_cell(index, cell));
        let slots = layered.slots;
        layered.push_dry(slots, paint);
        let height_mm = 0.5 / 16.0;
        let film = toned(&[("Vermilion", 3.0), ("Bone Black", 1.0)], height_mm);
        let found = film.over(&Primer::library_white(&library), &library).unwrap();
        let wanted = SpectralDocument::full(&layered).measured_reflectance(0, 0);
        for (found, wanted) in found.iter().zip(&wanted) {
            assert!((found - wanted).abs() < 1e-9, "{found} {wanted}");
        }
    }

    #[test]
    fn a_ground_without_a_film_is_white_and_a_thicker_film_is_darker() {
        let library = PigmentLibrary::van_gogh_oils();
        let white = Primer::library_white(&library);
        let mean = |height_mm: f64| {
            let found = toned(&[("Bone Black", 1.0)], height_mm).over(&white, &library).unwrap();
            found.iter().sum::<f64>() / found.len() as f64
        };
        let bare = white.iter().sum::<f64>() / white.len() as f64;
        assert!((mean(0.0) - bare).abs() < 1e-12, "{} {bare}", mean(0.0));
        assert!(mean(0.002) < bare && mean(0.01) < mean(0.002), "{}", mean(0.01));
    }

    #[test]
    fn a_film_is_part_of_a_script_and_its_faults_are_told() {
        let text = r#"{"kind": "panel", "reflectance": {"film": {"recipe": {"Minium": 2}, "height_mm": 0.004}}}"#;
        let spec: GroundSpec = serde_json::from_str(text).unwrap();
        assert_eq!(spec.reflectance, Some(Primer::Toned(toned(&[("Minium", 2.0)], 0.004))));
        let written = serde_json::to_string(&spec).unwrap();
        assert_eq!(serde_json::from_str::<GroundSpec>(&written).unwrap(), spec);
        let library = PigmentLibrary::van_gogh_oils();
        for (film, wanted) in [
            (toned(&[("Snow", 1.0)], 0.01), "Snow"),
            (toned(&[("Minium", 1.0)], 9.0), "height_mm"),
            (toned(&[], 0.01), "sum"),
        ] {
            let error = film.over(&Primer::library_white(&library), &library).unwrap_err();
            assert!(error.to_string().contains(wanted), "{error}");
        }
    }
}
