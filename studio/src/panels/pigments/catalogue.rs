//! The pigments of a library under the light, in colours and figures.

use std::sync::{Arc, OnceLock};

use pigment::library::PigmentLibrary;
use pigment::palette::{
    Appearance, Cards, Hides, Palette, TINT_PARTS, hiding_powers, tinting_strengths,
};
use render::light::Light;

use session::PaintingState;

/// How one pigment looks.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::panels) struct Look {
    /// Reflectance of a film that hides, on the library's grid.
    pub(in crate::panels) masstone: Vec<f64>,
    /// The same of one part in nine parts of white (or water); none where the
    /// scattering is not known.
    pub(in crate::panels) tint: Option<Vec<f64>>,
    /// sRGB of the first.
    pub(in crate::panels) masstone_srgb: [u8; 3],
    /// sRGB of the second.
    pub(in crate::panels) tint_srgb: Option<[u8; 3]>,
}

/// What one pigment can do.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(in crate::panels) struct Power {
    /// Where it hides; none where the scattering is not known.
    pub(in crate::panels) hides: Option<Hides>,
    /// Its tinting strength in percent of the strongest of the library; none for
    /// the white.
    pub(in crate::panels) tints_percent: Option<f64>,
}

/// A library under a light.
#[derive(Debug)]
pub(in crate::panels) struct Catalogue {
    pub(in crate::panels) library: Arc<PigmentLibrary>,
    light: Arc<Light>,
    looks: Vec<Look>,
    /// Found when they are first asked for: they take longer than the colours.
    powers: OnceLock<Vec<Power>>,
}

impl Catalogue {
    pub(super) fn new(library: &Arc<PigmentLibrary>, light: &Arc<Light>) -> Self {
        let looks = looks(library, light);
        let (library, light) = (Arc::clone(library), Arc::clone(light));
        Self { library, light, looks, powers: OnceLock::new() }
    }

    fn is_of(&self, library: &Arc<PigmentLibrary>, light: &Arc<Light>) -> bool {
        Arc::ptr_eq(&self.library, library) && Arc::ptr_eq(&self.light, light)
    }

    /// The look of a pigment, by its index in the library.
    pub(in crate::panels) fn look(&self, pigment: usize) -> &Look {
        &self.looks[pigment]
    }

    /// The name of a pigment.
    pub(in crate::panels) fn name(&self, pigment: usize) -> &str {
        &self.library.pigments[pigment].name
    }

    /// What a pigment can do.
    pub(in crate::panels) fn power(&self, pigment: usize) -> Power {
        self.powers.get_or_init(|| powers(&self.library, &self.light))[pigment]
    }

    /// From which height on a film of a pigment hides, in words.
    pub(in crate::panels) fn hiding(&self, pigment: usize, scattering_per_mm: f64) -> String {
        match self.power(pigment).hides {
            Some(Hides::From(thickness)) => {
                super::super::controls::millimetres(thickness / scattering_per_mm)
            }
            Some(Hides::Never { .. }) => "never".to_owned(),
            None => "not known".to_owned(),
        }
    }
}

fn looks(library: &PigmentLibrary, light: &Light) -> Vec<Look> {
    let weights = light.viewing.weights(library.grid).expect("the method fits the grid");
    let srgb = |reflectance: &[f64]| {
        let encoded = Appearance::of(weights.xyz(reflectance), weights.white()).srgb;
        encoded.0.map(|value| (value.clamp(0.0, 1.0) * 255.0).round() as u8)
    };
    let palette = Palette::new(library, &light.viewing, Cards::standard(library.grid)).ok();
    let look = |pigment: usize| {
        let alone = library.mix(&[(pigment, 1.0)]).expect("one part is a mixture");
        let masstone = alone.hiding(library.saunderson);
        let palette = palette.as_ref().filter(|_| library.pigments[pigment].identified);
        let tint = palette.map(|p| p.reflectance(&p.tint(pigment, TINT_PARTS)));
        let (masstone_srgb, tint_srgb) = (srgb(&masstone), tint.as_deref().map(srgb));
        Look { masstone, tint, masstone_srgb, tint_srgb }
    };
    (0..library.pigments.len()).map(look).collect()
}

fn powers(library: &PigmentLibrary, light: &Light) -> Vec<Power> {
    let mut powers = vec![Power::default(); library.pigments.len()];
    let Ok(palette) = Palette::new(library, &light.viewing, Cards::standard(library.grid)) else {
        return powers;
    };
    for power in hiding_powers(&palette) {
        powers[power.paint].hides = Some(power.hides);
    }
    for strength in tinting_strengths(&palette, None) {
        powers[strength.paint].tints_percent = Some(strength.percent);
    }
    powers
}

/// The catalogue of the easel's library and light, made anew when they change.
#[derive(Debug, Clone, Default)]
pub(in crate::panels) struct Known(Option<Arc<Catalogue>>);

impl Known {
    /// The catalogue as it is now.
    pub(in crate::panels) fn of(&mut self, easel: &PaintingState) -> Arc<Catalogue> {
        self.under(&easel.library, &easel.light)
    }

    fn under(&mut self, library: &Arc<PigmentLibrary>, light: &Arc<Light>) -> Arc<Catalogue> {
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
    fn a_catalogue_is_made_anew_only_for_another_library_or_light() {
        let library = Arc::new(PigmentLibrary::van_gogh_oils());
        let light = Arc::new(Light::named(&library, "D65", "1931-2").unwrap());
        let mut known = Known::default();
        let first = known.under(&library, &light);
        assert!(Arc::ptr_eq(&first, &known.under(&library, &light)), "nothing changed");
        let other = Arc::new(light.as_ref().clone());
        assert!(!Arc::ptr_eq(&first, &known.under(&library, &other)), "another light");

        let [white, blue] = ["Zinc White", "Prussian Blue"].map(|n| library.find(n).unwrap());
        let sums = |srgb: [u8; 3]| srgb.map(u32::from).iter().sum::<u32>();
        assert!(sums(first.look(white).masstone_srgb) > 690, "{:?}", first.look(white));
        let blue = first.look(blue);
        assert!(sums(blue.masstone_srgb) < sums(blue.tint_srgb.unwrap()), "a tint is lighter");
    }
}
