//! Films of the paint that a brush holds: what it covers, and what it would lay now.

use std::sync::Arc;

use paint::document::Slots;
use paint::layer::SLOTS;
use pigment::PigmentId;
use pigment::curves::Curves;
use pigment::palette::{Appearance, Cards};

use super::colors::Colors;
use super::state::{BrushSwatch, FilmColor};

/// Ground and paint that films of a painting are made of.
#[derive(Debug, Clone)]
pub(super) struct FilmSetting {
    /// Measured reflectance of the ground on the grid of the library.
    pub(super) ground: Arc<Vec<f64>>,
    /// S of the reference white per mm.
    pub(super) scattering_per_mm: f64,
}

impl Colors {
    /// Films of paint with these heights in mm by slot, of which the last is the vehicle. There
    /// is none without pigment.
    pub(super) fn swatch(
        &self,
        slots: &Slots,
        heights_mm: &[f64; SLOTS + 1],
        setting: &FilmSetting,
    ) -> Option<BrushSwatch> {
        let filled = slots.iter().zip(heights_mm).filter(|(_, mm)| **mm > 0.0);
        let recipe: Vec<(PigmentId, f64)> =
            filled.filter_map(|(slot, &mm)| Some(((*slot)?, mm))).collect();
        let pigment_mm: f64 = recipe.iter().map(|(_, mm)| mm).sum();
        let shares: Vec<_> = recipe.iter().map(|&(id, mm)| (id, mm / pigment_mm)).collect();
        let mixture: Curves = self.library.mix(&shares).ok()?;
        let cards = Cards::standard(self.library.grid);
        let thickness = pigment_mm * setting.scattering_per_mm;
        let over = |backing: &[f64]| mixture.film(thickness, backing, self.library.film());
        let [black, white] = [over(&cards.black), over(&cards.white)];
        let luminance = |reflectance: &[f64]| self.weights.xyz(reflectance).y;
        Some(BrushSwatch {
            opaque: self.film_color(&mixture.hiding(self.library.saunderson)),
            ground: self.film_color(&setting.ground),
            over_ground: self.film_color(&over(&setting.ground)),
            cards: [&cards.black, &cards.white].map(|card| self.film_color(card)),
            contrast: luminance(&black) / luminance(&white).max(f64::MIN_POSITIVE),
            over_cards: [black, white].map(|film| self.film_color(&film)),
            thickness_mm: heights_mm.iter().sum(),
        })
    }

    fn film_color(&self, reflectance: &[f64]) -> FilmColor {
        let Appearance { lab, srgb, .. } =
            Appearance::of(self.weights.xyz(reflectance), self.weights.white());
        FilmColor { lab, srgb: srgb.linear().mapped_into_gamut().encoded().to_bytes() }
    }
}

#[cfg(test)]
mod tests {
    use graphics::field::Field;
    use paint::amount::mm_from_quanta;
    use paint::document::{Document, Lighting, Medium};
    use paint::ground::Ground;
    use paint::light::Light;
    use paint::scene::SpectralDocument;
    use pigment::library::PigmentLibrary;

    use super::*;

    fn colors(illuminant: &str) -> (Colors, Slots) {
        let library = Arc::new(PigmentLibrary::van_gogh_oils());
        let light = Arc::new(Light::named(&library, illuminant, "1931-2").unwrap());
        let mut slots = [None; SLOTS];
        slots[1] = library.find("Zinc White").ok();
        slots[4] = library.find("Ultramarine").ok();
        (Colors::new(library, light), slots)
    }

    fn setting(reflectance: f64) -> FilmSetting {
        let count = PigmentLibrary::van_gogh_oils().grid.count();
        FilmSetting { ground: Arc::new(vec![reflectance; count]), scattering_per_mm: 50.0 }
    }

    fn heights(white: f64, blue: f64, vehicle: f64) -> [f64; SLOTS + 1] {
        let mut heights = [0.0; SLOTS + 1];
        (heights[1], heights[4], heights[SLOTS]) = (white, blue, vehicle);
        heights
    }

    #[test]
    fn a_thin_film_shows_what_is_below_and_a_thick_one_hides_it() {
        let (colors, slots) = colors("D65");
        let swatch = |scale: f64| {
            let paint = heights(0.01 * scale, 0.02 * scale, 0.005 * scale);
            colors.swatch(&slots, &paint, &setting(0.7)).unwrap()
        };
        let thin = swatch(0.1);
        let thick = swatch(400.0);
        assert!(thin.contrast < 0.5 && thick.contrast > 0.999, "{thin:?} {thick:?}");
        assert!((thin.thickness_mm - 0.0035).abs() < 1e-12, "{}", thin.thickness_mm);
        let apart = (thick.over_cards[0].lab.lightness - thick.opaque.lab.lightness).abs();
        assert!(apart < 0.01, "{apart}");
        assert_eq!(thin.opaque, thick.opaque, "an opaque film has no thickness");
        let between = thin.over_ground.lab.lightness;
        assert!(between > thin.opaque.lab.lightness && between < thin.ground.lab.lightness);
    }

    #[test]
    fn a_film_over_the_ground_is_the_one_that_the_painting_shows() {
        let (colors, slots) = colors("A");
        let library = PigmentLibrary::van_gogh_oils();
        let quanta = [300_u32, 900];
        let cell_mm = 0.1;
        let setting = setting(0.62);
        let medium = Medium { scattering_per_mm: setting.scattering_per_mm, ..Medium::default() };
        let ground = Ground {
            name: "test".to_owned(),
            height: Field::filled(1, 1, 0),
            reflectance: setting.ground.to_vec(),
            gloss: paint::optics::Gloss { strength: 0.0, exponent: 10.0 },
        };
        let mut document =
            Document::bare("", cell_mm, ground, library, medium, slots, Lighting::default());
        let mut cell = document.wet.cell(0);
        (cell.pigments[1], cell.pigments[4]) = (quanta[0], quanta[1]);
        document.wet.set_cell(0, cell);
        let wanted = SpectralDocument::full(&document).measured_reflectance(0, 0);
        let mm = quanta.map(|quanta| mm_from_quanta(1, cell_mm) * f64::from(quanta));
        let swatch = colors.swatch(&slots, &heights(mm[0], mm[1], 0.2), &setting).unwrap();
        let wanted = colors.film_color(&wanted).lab.to_array();
        for (found, wanted) in swatch.over_ground.lab.to_array().into_iter().zip(wanted) {
            assert!((found - wanted).abs() < 1e-6, "{swatch:?} {wanted:?}");
        }
    }

    #[test]
    fn the_swatch_follows_the_light_and_medium_alone_has_none() {
        let paint = heights(0.02, 0.01, 0.0);
        let under = |light: &str| {
            let (colors, slots) = colors(light);
            colors.swatch(&slots, &paint, &setting(0.7)).unwrap().opaque.lab
        };
        assert_ne!(under("D65"), under("A"));
        let (colors, slots) = colors("D65");
        assert_eq!(colors.swatch(&slots, &heights(0.0, 0.0, 0.3), &setting(0.7)), None);
    }
}
