//! Colours, hiding power and tinting strength of a library's pigments under a light.

use std::sync::{Arc, OnceLock};

use paint::light::Light;
use pigment::PigmentId;
use pigment::library::PigmentLibrary;
use pigment::palette::{
    Appearance, Cards, Hides, Palette, TINT_PARTS, hiding_powers, tinting_strengths,
};

use session::PaintingState;

use crate::language::tr;

/// Colour of one pigment, alone and as a tint.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::panels) struct PigmentColors {
    /// Reflectance of a hiding film, on the library's grid.
    pub(in crate::panels) masstone: Vec<f64>,
    /// Reflectance of one part in nine parts of white (or water); `None` if the
    /// scattering is unknown.
    pub(in crate::panels) tint: Option<Vec<f64>>,
    /// 8-bit sRGB of the masstone.
    pub(in crate::panels) masstone_srgb: [u8; 3],
    /// 8-bit sRGB of the tint.
    pub(in crate::panels) tint_srgb: Option<[u8; 3]>,
}

/// Hiding power and tinting strength of one pigment.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(in crate::panels) struct PaintStrength {
    /// Hiding power; `None` if the scattering is unknown.
    pub(in crate::panels) hides: Option<Hides>,
    /// Tinting strength in percent of the strongest in the library; `None` for the
    /// white.
    pub(in crate::panels) tints_percent: Option<f64>,
}

/// Colours and strengths of all pigments of a library under one light.
#[derive(Debug)]
pub(in crate::panels) struct Catalogue {
    pub(in crate::panels) library: Arc<PigmentLibrary>,
    light: Arc<Light>,
    colors: Vec<PigmentColors>,
    /// Strengths in the order of the library. Computed on first use, because this takes
    /// longer than the colours.
    strengths: OnceLock<Vec<PaintStrength>>,
}

impl Catalogue {
    pub(super) fn new(library: &Arc<PigmentLibrary>, light: &Arc<Light>) -> Self {
        let colors = colors(library, light);
        let library = Arc::clone(library);
        let light = Arc::clone(light);
        Self { library, light, colors, strengths: OnceLock::new() }
    }

    fn is_of(&self, library: &Arc<PigmentLibrary>, light: &Arc<Light>) -> bool {
        Arc::ptr_eq(&self.library, library) && Arc::ptr_eq(&self.light, light)
    }

    /// Colour of a pigment.
    pub(in crate::panels) fn colors(&self, pigment: PigmentId) -> &PigmentColors {
        &self.colors[pigment.index()]
    }

    /// Name of a pigment.
    pub(in crate::panels) fn name(&self, pigment: PigmentId) -> &str {
        &self.library[pigment].name
    }

    /// Strengths of a pigment.
    pub(in crate::panels) fn strength(&self, pigment: PigmentId) -> PaintStrength {
        self.strengths.get_or_init(|| strengths(&self.library, &self.light))[pigment.index()]
    }

    /// Formats the smallest height, in mm, at which a film of the pigment hides its ground;
    /// `never` or `not known` where there is none.
    pub(in crate::panels) fn hiding(&self, pigment: PigmentId, scattering_per_mm: f64) -> String {
        match self.strength(pigment).hides {
            Some(Hides::From(thickness)) => {
                super::super::controls::millimetres(thickness / scattering_per_mm)
            }
            Some(Hides::Never { .. }) => tr("never").to_owned(),
            None => tr("not known").to_owned(),
        }
    }
}

fn colors(library: &PigmentLibrary, light: &Light) -> Vec<PigmentColors> {
    let weights = light
        .viewing
        .weights(library.grid)
        .expect("the tristimulus method fits every library grid");
    let srgb = |reflectance: &[f64]| {
        let encoded = Appearance::of(weights.xyz(reflectance), weights.white()).srgb;
        encoded.0.map(|value| (value.clamp(0.0, 1.0) * 255.0).round() as u8)
    };
    let palette = Palette::new(library, &light.viewing, Cards::standard(library.grid)).ok();
    let colors_of = |pigment: PigmentId| {
        let alone = library.mix([(pigment, 1.0)]).expect("one part is a mixture");
        let masstone = alone.hiding(library.saunderson);
        let palette = palette.as_ref().filter(|_| library[pigment].identified);
        let tint = palette.map(|p| p.reflectance(&p.tint(pigment, TINT_PARTS)));
        let masstone_srgb = srgb(&masstone);
        let tint_srgb = tint.as_deref().map(srgb);
        PigmentColors { masstone, tint, masstone_srgb, tint_srgb }
    };
    library.ids().map(colors_of).collect()
}

fn strengths(library: &PigmentLibrary, light: &Light) -> Vec<PaintStrength> {
    let mut strengths = vec![PaintStrength::default(); library.pigments.len()];
    let Ok(palette) = Palette::new(library, &light.viewing, Cards::standard(library.grid)) else {
        return strengths;
    };
    for power in hiding_powers(&palette) {
        strengths[power.paint.index()].hides = Some(power.hides);
    }
    for strength in tinting_strengths(&palette, None) {
        strengths[strength.paint.index()].tints_percent = Some(strength.percent);
    }
    strengths
}

/// Cache of the catalogue for the painting's library and light.
#[derive(Debug, Clone, Default)]
pub(in crate::panels) struct CatalogueCache(Option<Arc<Catalogue>>);

impl CatalogueCache {
    /// Returns the catalogue, recomputed if library or light have changed.
    pub(in crate::panels) fn get(&mut self, painting: &PaintingState) -> Arc<Catalogue> {
        self.under(&painting.library, &painting.light)
    }

    /// The catalogue of a library under a light, recomputed if they have changed.
    pub(in crate::panels) fn under(
        &mut self,
        library: &Arc<PigmentLibrary>,
        light: &Arc<Light>,
    ) -> Arc<Catalogue> {
        match &self.0 {
            Some(known) if known.is_of(library, light) => Arc::clone(known),
            _ => Arc::clone(self.0.insert(Arc::new(Catalogue::new(library, light)))),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_catalogue_is_rebuilt_only_for_a_new_library_or_light() {
        let library = Arc::new(PigmentLibrary::van_gogh_oils());
        let light = Arc::new(Light::named(&library, "D65", "1931-2").unwrap());
        let mut known = CatalogueCache::default();
        let first = known.under(&library, &light);
        assert!(Arc::ptr_eq(&first, &known.under(&library, &light)), "nothing changed");
        let other = Arc::new(light.as_ref().clone());
        assert!(!Arc::ptr_eq(&first, &known.under(&library, &other)), "another light");

        let [white, blue] = ["Zinc White", "Prussian Blue"].map(|n| library.find(n).unwrap());
        let sums = |srgb: [u8; 3]| srgb.map(u32::from).iter().sum::<u32>();
        assert!(sums(first.colors(white).masstone_srgb) > 690, "{:?}", first.colors(white));
        let blue = first.colors(blue);
        assert!(sums(blue.masstone_srgb) < sums(blue.tint_srgb.unwrap()), "a tint is lighter");
    }
}
