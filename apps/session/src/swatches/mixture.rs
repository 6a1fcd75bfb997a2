//! One kept mixture.

use paint::document::Slots;
use paint::layer::SLOTS;
use paint::strokes::Recipe;
use pigment::PigmentId;
use pigment::library::PigmentLibrary;
use pigment::palette::Appearance;
use serde::{Deserialize, Serialize};
use spectra::TristimulusWeights;
use spectra::color::Rgb;

/// Longest name of a mixture, in characters.
pub(super) const LONGEST_NAME: usize = 60;

/// A recipe with a name, kept for later.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct KeptMixture {
    /// Name given by the painter.
    pub name: String,
    /// Title of the library of its pigments.
    pub library: String,
    /// Parts by the names of the pigments, each above 0.
    pub recipe: Recipe,
    /// Share of clear medium in a load of it, 0 to 1.
    #[serde(default)]
    pub vehicle: f64,
    /// Colour when it was kept, as `#rrggbb`: shown while its pigments are not at hand.
    pub color: String,
    /// Light under which it had that colour.
    #[serde(default)]
    pub light: String,
}

/// Whether a mixture can be loaded, and if not, for lack of which pigments.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Usable {
    /// Nothing: all its pigments are on the palette.
    Now,
    /// These pigments of the library are not on the palette.
    NotOnPalette(Vec<PigmentId>),
    /// The library has no pigments of these names.
    NotInLibrary(Vec<String>),
}

impl KeptMixture {
    /// A mixture of pigments of `library`, named after the two of which it has most; `None` for a
    /// recipe without pigment.
    #[must_use]
    pub fn of(
        library: &PigmentLibrary,
        recipe: Recipe,
        vehicle: f64,
        light: (&TristimulusWeights, &str),
    ) -> Option<Self> {
        let mut parts: Vec<(&String, f64)> =
            recipe.iter().map(|(name, part)| (name, *part)).collect();
        parts.sort_by(|a, b| b.1.total_cmp(&a.1));
        let first = parts.first()?.0;
        let name = match parts.get(1) {
            Some((second, _)) => format!("{first} and {second}"),
            None => first.clone(),
        };
        let name = name.chars().take(LONGEST_NAME).collect();
        let title = library.title.clone();
        let color = String::new();
        let light_name = light.1.to_owned();
        let mut kept = Self { name, library: title, recipe, vehicle, color, light: light_name };
        kept.color = shown(kept.appearance(library, light.0)?).to_hex();
        Some(kept)
    }

    /// Pigments with their parts; the names that `library` does not have.
    ///
    /// # Errors
    /// The names that are missing.
    pub fn pigments(&self, library: &PigmentLibrary) -> Result<Vec<(PigmentId, f64)>, Vec<String>> {
        let find = |name: &String| library.ids().find(|id| library[*id].name == *name);
        let missing = self.recipe.keys().filter(|name| find(name).is_none());
        let missing: Vec<String> = missing.cloned().collect();
        if !missing.is_empty() {
            return Err(missing);
        }
        Ok(self.recipe.iter().filter_map(|(name, part)| Some((find(name)?, *part))).collect())
    }

    /// Whether it can be loaded now, and if not, what is missing.
    #[must_use]
    pub fn usable(&self, library: &PigmentLibrary, slots: &Slots) -> Usable {
        match self.pigments(library) {
            Err(names) => Usable::NotInLibrary(names),
            Ok(pigments) => {
                let away = pigments.into_iter().map(|(pigment, _)| pigment);
                let away: Vec<_> =
                    away.filter(|pigment| !slots.contains(&Some(*pigment))).collect();
                if away.is_empty() { Usable::Now } else { Usable::NotOnPalette(away) }
            }
        }
    }

    /// Colour of a film that hides, under the light of `weights`; `None` if `library` cannot mix
    /// it.
    #[must_use]
    pub fn appearance(
        &self,
        library: &PigmentLibrary,
        weights: &TristimulusWeights,
    ) -> Option<Appearance> {
        let pigments = self.pigments(library).ok()?;
        let film = library.mix(pigments).ok()?.hiding(library.saunderson);
        Some(Appearance::of(weights.xyz(&film), weights.white()))
    }

    /// Colour of the mixture on the screen: under the light of `weights` if `library` can mix it,
    /// else as it was when it was kept.
    #[must_use]
    pub fn screen_color(&self, library: &PigmentLibrary, weights: &TristimulusWeights) -> [u8; 3] {
        let now = self.appearance(library, weights).map(shown);
        now.or_else(|| Rgb::from_hex(&self.color)).unwrap_or(Rgb([0.5; 3])).to_bytes()
    }

    /// Key and fault of the first value that cannot be used.
    pub(super) fn fault(&self) -> Option<(String, String)> {
        let fault = |key: &str, reason: String| Some((key.to_owned(), reason));
        let name = self.name.trim();
        if name.is_empty() || name.chars().count() > LONGEST_NAME {
            return fault(
                "name",
                format!("expected 1 to {LONGEST_NAME} characters, found `{name}`"),
            );
        }
        let count = self.recipe.len();
        if count == 0 || count > SLOTS {
            return fault("recipe", format!("expected 1 to {SLOTS} pigments, found {count}"));
        }
        let wrong = self.recipe.iter().find(|(_, part)| !(part.is_finite() && **part > 0.0));
        if let Some((pigment, part)) = wrong {
            let reason = format!("expected parts above 0, found `{part}`");
            return fault(&format!("recipe.{pigment}"), reason);
        }
        if !(0.0..=1.0).contains(&self.vehicle) {
            return fault("vehicle", format!("expected 0 to 1, found `{}`", self.vehicle));
        }
        if Rgb::from_hex(&self.color).is_none() {
            return fault("color", format!("expected #rrggbb, found `{}`", self.color));
        }
        None
    }
}

fn shown(appearance: Appearance) -> Rgb {
    appearance.srgb.linear().mapped_into_gamut().encoded()
}

#[cfg(test)]
mod tests {
    use pigment::evaluate::Viewing;

    use super::*;

    fn weights(library: &PigmentLibrary) -> TristimulusWeights {
        Viewing::default().weights(library.grid).unwrap()
    }

    fn green(library: &PigmentLibrary) -> KeptMixture {
        let recipe =
            [("Viridian", 2.0), ("Zinc White", 5.0)].map(|(name, part)| (name.to_owned(), part));
        KeptMixture::of(library, recipe.into(), 0.15, (&weights(library), "D65")).unwrap()
    }

    #[test]
    fn a_mixture_is_named_after_its_pigments_and_has_the_colour_of_the_library() {
        let library = PigmentLibrary::van_gogh_oils();
        let kept = green(&library);
        assert_eq!(kept.name, "Zinc White and Viridian");
        let wanted =
            library.color([("Viridian", 2.0), ("Zinc White", 5.0)], &Viewing::default()).unwrap();
        let found = kept.appearance(&library, &weights(&library)).unwrap();
        assert_eq!((found.lab, kept.color.as_str()), (wanted.lab, wanted.hex().as_str()));
        assert_eq!(kept.fault(), None);
        assert_eq!(KeptMixture::of(&library, Recipe::new(), 0.0, (&weights(&library), "")), None);
    }

    #[test]
    fn what_is_missing_is_told_by_name() {
        let library = PigmentLibrary::van_gogh_oils();
        let kept = green(&library);
        let id = |name: &str| library.find(name).unwrap();
        let mut slots = [None; SLOTS];
        slots[3] = Some(id("Zinc White"));
        let away = Usable::NotOnPalette(vec![id("Viridian")]);
        assert_eq!(kept.usable(&library, &slots), away);
        slots[0] = Some(id("Viridian"));
        assert_eq!(kept.usable(&library, &slots), Usable::Now);
        let mut other = library.clone();
        other.pigments.retain(|pigment| pigment.name != "Viridian");
        let missing = Usable::NotInLibrary(vec!["Viridian".to_owned()]);
        assert_eq!(kept.usable(&other, &[None; SLOTS]), missing);
        assert_eq!(kept.appearance(&other, &weights(&other)), None);
        let then = Rgb::from_hex(&kept.color).unwrap().to_bytes();
        assert_eq!(kept.screen_color(&other, &weights(&other)), then, "as it was kept");
    }
}
