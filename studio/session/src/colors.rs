//! Paint as it looks in a film that hides.

use std::sync::Arc;

use pigment::PigmentId;
use pigment::library::PigmentLibrary;
use pigment::palette::Appearance;
use render::layer::SLOTS;
use render::light::Light;
use render::paint::document::Slots;
use spectra::TristimulusWeights;

/// Parts of white to one of pigment in a tint.
const TINT: f64 = 9.0;

/// Colours of paint from tubes and brushes, under one light.
#[derive(Debug, Clone)]
pub(super) struct Colors {
    library: Arc<PigmentLibrary>,
    light: Arc<Light>,
    weights: TristimulusWeights,
    /// The pigment that lightens.
    white: Option<PigmentId>,
}

impl Colors {
    /// Paint of `library` under `light`.
    pub(super) fn new(library: Arc<PigmentLibrary>, light: Arc<Light>) -> Self {
        let weights = light.viewing.weights(library.grid);
        let weights = weights.expect("a light that was taken up fits its library");
        let mut colors = Self { library, light, weights, white: None };
        colors.white = colors.lightener();
        colors
    }

    /// Whether they are of this library and light.
    pub(super) fn are_of(&self, library: &Arc<PigmentLibrary>, light: &Arc<Light>) -> bool {
        Arc::ptr_eq(&self.library, library) && Arc::ptr_eq(&self.light, light)
    }

    /// The reference white, or the lightest pigment that can be mixed.
    fn lightener(&self) -> Option<PigmentId> {
        let mixed = || self.library.ids().filter(|id| self.library[*id].identified);
        let reference = self.library.reference_id();
        mixed().find(|&id| Some(id) == reference).or_else(|| {
            let luminance = |&id: &PigmentId| {
                let film = self.film(&[(id, 1.0)]);
                film.map_or(0.0, |reflectance| self.weights.xyz(&reflectance).y)
            };
            mixed().max_by(|a, b| luminance(a).total_cmp(&luminance(b)))
        })
    }

    fn film(&self, recipe: &[(PigmentId, f64)]) -> Option<Vec<f64>> {
        let mixture = self.library.mix(recipe).ok()?;
        Some(mixture.hiding(self.library.saunderson))
    }

    /// sRGB of a recipe, adapted from the light to the screen; none without
    /// parts.
    pub(super) fn of(&self, recipe: &[(PigmentId, f64)]) -> Option<[u8; 3]> {
        let xyz = self.weights.xyz(&self.film(recipe)?);
        Some(Appearance::of(xyz, self.weights.white()).srgb.to_bytes())
    }

    /// sRGB of parts by slot.
    pub(super) fn of_slots(&self, slots: &Slots, parts: &[f64; SLOTS]) -> Option<[u8; 3]> {
        let filled = slots.iter().zip(parts).filter(|(_, part)| **part > 0.0);
        let recipe: Vec<_> =
            filled.filter_map(|(slot, &part)| Some((PigmentId((*slot)?), part))).collect();
        self.of(&recipe)
    }

    /// Each slot's pigment alone.
    pub(super) fn masstones(&self, slots: &Slots) -> [Option<[u8; 3]>; SLOTS] {
        slots.map(|slot| self.of(&[(PigmentId(slot?), 1.0)]))
    }

    /// Each slot's pigment, one part in ten of white; none for one whose
    /// scattering nobody knows.
    pub(super) fn tints(&self, slots: &Slots) -> [Option<[u8; 3]>; SLOTS] {
        slots.map(|slot| {
            let (pigment, white) = (PigmentId(slot?), self.white?);
            let identified = self.library[pigment].identified;
            identified.then(|| self.of(&[(pigment, 1.0), (white, TINT)]))?
        })
    }
}

#[cfg(test)]
mod tests {
    use pigment::palette::{Cards, Palette, Recipe};

    use super::*;
    use pigment::library::PigmentLibrary;

    #[test]
    fn tubes_show_what_the_calibration_says() {
        let library = Arc::new(PigmentLibrary::van_gogh_oils());
        let light = Arc::new(Light::named(&library, "A", "1931-2").unwrap());
        let colors = Colors::new(Arc::clone(&library), Arc::clone(&light));
        let blue = library.find("Prussian Blue").unwrap();
        let unknown = library.pigments.iter().position(|pigment| !pigment.identified).unwrap();
        let mut slots = [None; SLOTS];
        (slots[2], slots[5]) = (Some(blue.index()), Some(unknown));
        let cards = Cards::standard(library.grid);
        let palette = Palette::new(&library, &light.viewing, cards).unwrap();
        let masstones = colors.masstones(&slots);
        assert_eq!(masstones[2], Some(palette.color(&Recipe::single(blue)).srgb.to_bytes()));
        assert!(masstones[5].is_some(), "a masstone is known without the scattering");
        let tints = colors.tints(&slots);
        assert_eq!(tints[2], Some(palette.color(&palette.tint(blue, TINT)).srgb.to_bytes()));
        assert_eq!((tints[0], tints[5]), (None, None), "an empty slot; no known scattering");
        let green = |color: Option<[u8; 3]>| color.map(|color| color[1]);
        assert!(green(tints[2]) > green(masstones[2]), "white lightens");
    }

    #[test]
    fn a_mixture_by_slots_counts_only_what_has_parts() {
        let library = Arc::new(PigmentLibrary::van_gogh_oils());
        let light = Arc::new(Light::named(&library, "D65", "1931-2").unwrap());
        let colors = Colors::new(library, light);
        let slots = std::array::from_fn(Some);
        let mut parts = [0.0; SLOTS];
        assert_eq!(colors.of_slots(&slots, &parts), None, "no paint has no colour");
        (parts[1], parts[4]) = (3.0, 1.0);
        assert_eq!(
            colors.of_slots(&slots, &parts),
            colors.of(&[(PigmentId(1), 0.75), (PigmentId(4), 0.25)])
        );
    }
}
