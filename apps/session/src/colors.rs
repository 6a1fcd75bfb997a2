//! Colours of opaque films of paint.

use std::sync::Arc;

use paint::document::Slots;
use paint::layer::SLOTS;
use paint::light::Light;
use pigment::PigmentId;
use pigment::library::PigmentLibrary;
use pigment::palette::Appearance;
use spectra::TristimulusWeights;

/// Parts of white to one part of pigment in a tint.
const TINT: f64 = 9.0;

/// Colours of the paint of tubes and brushes under one light.
#[derive(Debug, Clone)]
pub(super) struct Colors {
    pub(super) library: Arc<PigmentLibrary>,
    light: Arc<Light>,
    pub(super) weights: TristimulusWeights,
    /// Pigment used to lighten.
    white: Option<PigmentId>,
}

impl Colors {
    /// Colours of the paint of `library` under `light`.
    pub(super) fn new(library: Arc<PigmentLibrary>, light: Arc<Light>) -> Self {
        let weights = light.viewing.weights(library.grid);
        let weights = weights.expect("the light was made for this library");
        let mut colors = Self { library, light, weights, white: None };
        colors.white = colors.lightener();
        colors
    }

    /// Whether these are the colours of this library and light.
    pub(super) fn is_for(&self, library: &Arc<PigmentLibrary>, light: &Arc<Light>) -> bool {
        Arc::ptr_eq(&self.library, library) && Arc::ptr_eq(&self.light, light)
    }

    /// The reference white, or else the lightest pigment whose scattering is known.
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

    /// sRGB of a recipe, adapted from the light to the screen; `None` for a recipe without
    /// parts.
    pub(super) fn of(&self, recipe: &[(PigmentId, f64)]) -> Option<[u8; 3]> {
        let xyz = self.weights.xyz(&self.film(recipe)?);
        let srgb = Appearance::of(xyz, self.weights.white()).srgb;
        Some(srgb.linear().mapped_into_gamut().encoded().to_bytes())
    }

    /// sRGB of a mixture with these parts by slot.
    pub(super) fn of_slots(&self, slots: &Slots, parts: &[f64; SLOTS]) -> Option<[u8; 3]> {
        let filled = slots.iter().zip(parts).filter(|(_, part)| **part > 0.0);
        let recipe: Vec<_> = filled.filter_map(|(slot, &part)| Some(((*slot)?, part))).collect();
        self.of(&recipe)
    }

    /// sRGB of the pigment of each slot alone.
    pub(super) fn masstones(&self, slots: &Slots) -> [Option<[u8; 3]>; SLOTS] {
        slots.map(|slot| self.of(&[(slot?, 1.0)]))
    }

    /// sRGB of one part of the pigment of each slot in nine parts of white; `None` for a
    /// pigment whose scattering is unknown.
    pub(super) fn tints(&self, slots: &Slots) -> [Option<[u8; 3]>; SLOTS] {
        slots.map(|slot| {
            let pigment = slot?;
            let white = self.white?;
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
    fn masstones_and_tints_are_those_of_the_library() {
        let library = Arc::new(PigmentLibrary::van_gogh_oils());
        let light = Arc::new(Light::named(&library, "A", "1931-2").unwrap());
        let colors = Colors::new(Arc::clone(&library), Arc::clone(&light));
        let blue = library.find("Prussian Blue").unwrap();
        let unknown = library.ids().find(|&pigment| !library[pigment].identified).unwrap();
        let mut slots = [None; SLOTS];
        (slots[2], slots[5]) = (Some(blue), Some(unknown));
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
        let slots = std::array::from_fn(|slot| Some(PigmentId(slot)));
        let mut parts = [0.0; SLOTS];
        assert_eq!(colors.of_slots(&slots, &parts), None, "no paint has no colour");
        (parts[1], parts[4]) = (3.0, 1.0);
        assert_eq!(
            colors.of_slots(&slots, &parts),
            colors.of(&[(PigmentId(1), 0.75), (PigmentId(4), 0.25)])
        );
    }
}
