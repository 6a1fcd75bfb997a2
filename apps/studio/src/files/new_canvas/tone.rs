//! Colours of grounds: bare priming, thin films of pigments over it, and thick ones.

use paint::ground::{Primer, PrimerFilm, TonedPrimer};
use pigment::evaluate::Viewing;
use pigment::library::PigmentLibrary;
use spectra::color::{Adaptation, RgbSpace};

use crate::language::english;

/// A colour of a ground by name, made of the pigments of a library.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Tone {
    /// Name in the list.
    pub(crate) name: &'static str,
    /// Its pigments and its use, for a tooltip.
    pub(crate) description: &'static str,
    /// Pigments and their parts; none leaves the priming bare.
    parts: &'static [(&'static str, f64)],
    /// Height of the film in mm.
    height_mm: f64,
}

/// The tones that are offered. The library of the house has no earths, so that browns are mixed.
pub(crate) const TONES: [Tone; 6] = [
    Tone {
        name: english("White"),
        description: english("The white priming, bare"),
        parts: &[],
        height_mm: 0.0,
    },
    Tone {
        name: english("Warm grey"),
        description: english("White with black and a little red and yellow, thick enough to hide"),
        parts: &[
            ("Zinc White", 40.0),
            ("Bone Black", 1.5),
            ("Minium", 0.5),
            ("Chrome Yellow", 0.4),
        ],
        height_mm: 0.02,
    },
    Tone {
        name: english("Cool grey"),
        description: english("White with black and a little blue, thick enough to hide"),
        parts: &[("Zinc White", 40.0), ("Bone Black", 1.5), ("Ultramarine", 0.4)],
        height_mm: 0.02,
    },
    Tone {
        name: english("Brown imprimatura"),
        description: english("A thin film of black, yellow and red, in the place of raw umber"),
        parts: &[("Bone Black", 2.5), ("Chrome Yellow", 4.0), ("Vermilion", 2.0)],
        height_mm: 0.0008,
    },
    Tone {
        name: english("Golden imprimatura"),
        description: english(
            "A thin film of yellow with a little red and black, in the place of raw sienna",
        ),
        parts: &[("Chrome Yellow", 16.0), ("Vermilion", 3.0), ("Bone Black", 3.0)],
        height_mm: 0.0006,
    },
    Tone {
        name: english("Red ground"),
        description: english(
            "Vermilion broken with black and red lead, thick enough to hide, in the place of bole",
        ),
        parts: &[("Vermilion", 12.0), ("Bone Black", 1.0), ("Minium", 4.0)],
        height_mm: 0.02,
    },
];

impl Tone {
    /// The tone that `primer` is; `None` for one of the painter's own.
    #[must_use]
    pub(crate) fn of(primer: Option<&Primer>) -> Option<&'static Self> {
        TONES.iter().find(|tone| tone.primer().as_ref() == primer)
    }

    /// The reflectance that makes this tone; `None` for bare priming.
    #[must_use]
    pub(crate) fn primer(&self) -> Option<Primer> {
        if self.parts.is_empty() {
            return None;
        }
        let recipe = self.parts.iter().map(|(name, part)| ((*name).to_owned(), *part));
        let film = PrimerFilm { recipe: recipe.collect(), height_mm: self.height_mm };
        Some(Primer::Toned(TonedPrimer { film }))
    }

    /// Its sRGB colour as paint of `library` under `viewing`; `None` without its pigments.
    #[must_use]
    pub(crate) fn color(&self, library: &PigmentLibrary, viewing: &Viewing) -> Option<[u8; 3]> {
        let reflectance = match self.primer() {
            _ if !self.is_in(library) => return None,
            Some(primer) => primer.reflectance(library).ok()?,
            None => Primer::library_white(library),
        };
        let weights = viewing.weights(library.grid).ok()?;
        let xyz = weights.xyz(&reflectance);
        let white = weights.white();
        let rgb = RgbSpace::Srgb.encoded_from_xyz(xyz, white, Adaptation::Bradford);
        Some(rgb.to_bytes())
    }

    /// Whether `library` has all its pigments.
    #[must_use]
    pub(crate) fn is_in(&self, library: &PigmentLibrary) -> bool {
        self.parts.iter().all(|(name, _)| library.pigments.iter().any(|own| own.name == *name))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use spectra::color::Lab;

    #[test]
    fn each_tone_can_be_mixed_and_is_found_again() {
        let library = PigmentLibrary::van_gogh_oils();
        let weights = Viewing::default().weights(library.grid).unwrap();
        let lab = |tone: &Tone| {
            let primer = tone.primer().unwrap_or(Primer::Grey(0.87));
            let found = primer.reflectance(&library).unwrap();
            Lab::from_xyz(weights.xyz(&found), weights.white())
        };
        for tone in &TONES {
            assert!(tone.is_in(&library), "{}", tone.name);
            assert_eq!(Tone::of(tone.primer().as_ref()), Some(tone));
        }
        let [warm, cool, brown, golden, red] =
            [1, 2, 3, 4, 5].map(|index: usize| lab(&TONES[index]));
        assert!(warm.b > cool.b + 3.0, "{warm:?} {cool:?}");
        assert!(warm.a.hypot(warm.b) < 15.0 && cool.a.hypot(cool.b) < 15.0, "greys");
        assert!((45.0..75.0).contains(&brown.lightness) && brown.b > 15.0, "{brown:?}");
        assert!(golden.lightness > 60.0 && golden.b > 30.0, "{golden:?}");
        assert!((25.0..50.0).contains(&red.lightness) && red.a > 20.0, "{red:?}");
    }

    #[test]
    fn a_tone_needs_the_pigments_of_its_library() {
        let mut library = PigmentLibrary::van_gogh_oils();
        library.pigments.retain(|pigment| pigment.name != "Vermilion");
        let there: Vec<&str> =
            TONES.iter().filter(|tone| tone.is_in(&library)).map(|tone| tone.name).collect();
        assert_eq!(there, ["White", "Warm grey", "Cool grey"]);
        let viewing = Viewing::default();
        let white = TONES[0].color(&library, &viewing).unwrap();
        assert!(white.iter().all(|value| *value > 220), "{white:?}");
        assert_eq!(TONES[5].color(&library, &viewing), None, "a red without vermilion");
        let oils = PigmentLibrary::van_gogh_oils();
        let red = TONES[5].color(&oils, &viewing).unwrap();
        assert!(red[0] > red[1] + 30 && red[1] < 110, "{red:?}");
    }
}
