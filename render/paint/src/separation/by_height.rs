//! Films of a colour and of a height: a table for each of a few heights.
//!
//! Where a film is as high as its relief demands, only its mixture is free: thin paint over a
//! light ground takes more colour than thick paint does. Recipes change little from height to
//! height, so they are interpolated between the tables, evenly in the logarithm of the height.

use super::film::PaintFilm;
use super::table::{Separation, SeparationError, SeparationSettings};
use crate::layer::SLOTS;

/// Ratio of the heights of neighbouring tables, at most.
const RATIO: f64 = 2.0;

/// Tables from colours to mixtures of a palette's pigments, by the height of the film.
#[derive(Debug, Clone, PartialEq)]
pub struct SeparationByHeight {
    /// From the thinnest film to the highest.
    tables: Vec<Separation>,
    /// Height of the films of each table in mm.
    heights_mm: Vec<f64>,
}

impl SeparationByHeight {
    /// Computes tables for films from `settings.least_mm` to `settings.most_mm`, at least one for
    /// each doubling of the height. Takes seconds.
    ///
    /// # Errors
    /// [`SeparationError`] for an empty palette or settings out of range.
    pub fn new(film: PaintFilm, settings: &SeparationSettings) -> Result<Self, SeparationError> {
        settings.check()?;
        let SeparationSettings { least_mm, most_mm, .. } = *settings;
        let steps = (most_mm / least_mm).ln() / RATIO.ln();
        let steps = (steps - 1e-9).ceil().max(0.0) as usize;
        let height = |step: usize| {
            let share = if steps == 0 { 0.0 } else { step as f64 / steps as f64 };
            least_mm * (most_mm / least_mm).powf(share)
        };
        let heights_mm: Vec<f64> = (0..=steps).map(height).collect();
        // Recipes spread from the middle, where a film hides and is not yet a masstone.
        let middle = steps / 2;
        let least_mm = heights_mm[middle];
        let most_mm = heights_mm[middle];
        let first = Separation::new(film, &SeparationSettings { least_mm, most_mm, ..*settings })?;
        let mut tables = vec![first.clone()];
        for &height_mm in &heights_mm[middle + 1..] {
            let next = tables.last().unwrap_or(&first).at_height(height_mm);
            tables.push(next);
        }
        for &height_mm in heights_mm[..middle].iter().rev() {
            let next = tables.first().unwrap_or(&first).at_height(height_mm);
            tables.insert(0, next);
        }
        Ok(Self { tables, heights_mm })
    }

    /// The films that the tables were computed for.
    #[must_use]
    pub fn film(&self) -> &PaintFilm {
        self.tables[0].film()
    }

    /// Heights in mm by slot of the film of a linear sRGB colour that is `height_mm` high: their
    /// sum is that height. Films beyond the tables have the recipe of the nearest.
    #[must_use]
    pub fn heights_mm(&self, rgb: [f32; 3], height_mm: f32) -> [f32; SLOTS] {
        let last = self.tables.len() - 1;
        let above = self.heights_mm.partition_point(|mm| *mm < f64::from(height_mm));
        let lower = above.saturating_sub(1).min(last);
        let upper = above.min(last);
        let shares = |at: usize| (self.tables[at].heights_mm(rgb), self.heights_mm[at]);
        let (thin, thin_mm) = shares(lower);
        let own = f64::from(height_mm);
        if lower == upper {
            return thin.map(|mm| (f64::from(mm) * own / thin_mm) as f32);
        }
        let (thick, thick_mm) = shares(upper);
        let share = (own / thin_mm).ln() / (thick_mm / thin_mm).ln();
        let [thin_share, thick_share] = [(1.0 - share) / thin_mm, share / thick_mm];
        std::array::from_fn(|slot| {
            let [thin, thick] = [thin[slot], thick[slot]].map(f64::from);
            (own * (thin * thin_share + thick * thick_share)) as f32
        })
    }

    /// Luminance, 0..1, of the darkest grey that films of any height reproduce, in the worst case.
    #[must_use]
    pub fn black(&self) -> f32 {
        self.tables.iter().map(Separation::black).fold(0.0, f32::max)
    }

    /// Whether the nearest colour that films of the height of the nearest table reproduce differs
    /// by more than [`OUT_OF_GAMUT`](super::OUT_OF_GAMUT).
    #[must_use]
    pub fn is_out_of_gamut(&self, rgb: [f32; 3], height_mm: f32) -> bool {
        let off = |mm: f64| (mm / f64::from(height_mm)).ln().abs();
        let nearest = (0..self.tables.len())
            .min_by(|a, b| off(self.heights_mm[*a]).total_cmp(&off(self.heights_mm[*b])));
        self.tables[nearest.unwrap_or(0)].is_out_of_gamut(rgb)
    }
}

#[cfg(test)]
mod tests {
    use pigment::PigmentLibrary;
    use spectra::color::delta_e_ciede2000;

    use super::*;
    use crate::document::{Lighting, Medium};
    use crate::ground::GroundKind;
    use crate::light::Light;
    use crate::palette::palette_slots;
    use crate::separation::FilmMaterials;

    const SETTINGS: SeparationSettings = SeparationSettings {
        lattice: 13,
        least_mm: 0.03,
        most_mm: 0.48,
        hides: true,
        refined: false,
    };

    /// Films of oil thinned until a film of 0.03 mm hides nothing and one of 0.5 mm does.
    fn film() -> PaintFilm {
        let library = PigmentLibrary::van_gogh_oils();
        let names = ["Lead White", "Vermilion", "Chrome Yellow", "Ultramarine", "Bone Black"];
        let slots = palette_slots(&names.map(str::to_owned), &library).unwrap();
        let Lighting { illuminant, observer, .. } = Lighting::default();
        let light = Light::named(&library, &illuminant, &observer).unwrap();
        let ground = GroundKind::Panel.spec(1).reflectance(&library).unwrap();
        let scattering_per_mm = Medium::of(&library).scattering_per_mm / 30.0;
        let library = &library;
        let slots = &slots;
        let ground = &ground[..];
        let materials = FilmMaterials { library, slots, ground, scattering_per_mm };
        PaintFilm::at_nodes(materials, &light.quadrature)
    }

    /// Mean difference of colours that the palette mixes at a height, painted with the recipes of
    /// films `recipe_mm` high.
    fn difference(films: &SeparationByHeight, height_mm: f32, recipe_mm: f32) -> f64 {
        let film = films.film();
        let mixed = |at: usize| {
            let parts = [7, 5, 3, 2, 1].map(|step| 0.02 + ((at * step) % 11) as f32);
            let total: f32 = parts.iter().sum();
            std::array::from_fn(|slot| parts.get(slot).map_or(0.0, |part| part / total * height_mm))
        };
        (0..100)
            .map(|at: usize| {
                let rgb = film.rgb(&mixed(at));
                let scale = f64::from(height_mm / recipe_mm);
                let found = films.heights_mm(rgb, recipe_mm).map(|mm| scale * f64::from(mm));
                delta_e_ciede2000(film.lab_from_rgb(rgb), film.lab(&found))
            })
            .sum::<f64>()
            / 100.0
    }

    #[test]
    fn films_have_the_height_asked_for_and_the_colour_at_every_height() {
        let films = SeparationByHeight::new(film(), &SETTINGS).unwrap();
        assert_eq!(films.heights_mm.len(), 5, "{:?}", films.heights_mm);
        for height_mm in [0.03_f32, 0.043, 0.1, 0.3, 0.48, 1.7] {
            let heights = films.heights_mm([0.3, 0.25, 0.1], height_mm);
            let sum: f32 = heights.iter().sum();
            assert!((sum / height_mm - 1.0).abs() < 1e-5, "{sum} for {height_mm}");
            assert!(heights.iter().all(|mm| *mm >= 0.0), "{heights:?}");
            let mean = difference(&films, height_mm, height_mm);
            assert!(mean < 2.5, "{height_mm} mm: {mean}");
        }
        let [own, other] = [0.03, 0.48].map(|recipe_mm| difference(&films, 0.03, recipe_mm));
        assert!(other > 3.0 * own, "recipes of thick films suit thin ones: {own} {other}");
    }

    #[test]
    fn one_height_makes_one_table() {
        let settings = SeparationSettings { most_mm: 0.03, ..SETTINGS };
        let films = SeparationByHeight::new(film(), &settings).unwrap();
        let table = Separation::new(film(), &settings).unwrap();
        let rgb = [0.2, 0.4, 0.3];
        let doubled = table.heights_mm(rgb).map(|mm| 2.0 * mm);
        let found = films.heights_mm(rgb, 0.06);
        for (found, wanted) in found.iter().zip(doubled) {
            assert!((found - wanted).abs() < 1e-7, "{found} {wanted}");
        }
        let wrong = SeparationSettings { least_mm: 0.0, ..SETTINGS };
        assert!(SeparationByHeight::new(film(), &wrong).is_err());
    }
}
