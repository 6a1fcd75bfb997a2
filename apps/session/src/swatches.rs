//! Mixtures that a painter saves: recipes with names, their file, and their colours. The file is
//! JSON,
//! `impasto-swatches` version 1:
//!
//! ```json
//! {
//!   "format": "impasto-swatches",
//!   "version": 1,
//!   "swatches": [
//!     {
//!       "name": "Sea green",
//!       "library": "Van Gogh's oils",
//!       "recipe": {"Viridian": 2, "Zinc White": 5},
//!       "vehicle": 0.15,
//!       "color": "#8fb9a8",
//!       "light": "D65"
//!     }
//!   ]
//! }
//! ```
//!
//! You may leave out `vehicle` and `light`.

use documents::hint::Explain;
use paint::document::Slots;
use paint::layer::SLOTS;
use paint::strokes::Recipe;
use pigment::PigmentId;
use pigment::library::PigmentLibrary;
use pigment::palette::Appearance;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};
use spectra::TristimulusWeights;
use spectra::color::Rgb;
use spectra::swatch_file::{SwatchColor, SwatchEntry, SwatchFile};

/// Why a file of saved mixtures cannot be read.
#[derive(Debug, thiserror::Error, Explain)]
pub enum SwatchBookError {
    /// The file is not JSON.
    #[error("{0}: {1}")]
    #[hint("choose a file that the studio has written")]
    Json(String, #[source] serde_json::Error),
    /// The file is JSON of another kind, or of a later version.
    #[error("{file}: key `{key}`: expected {expected}, found `{found}`")]
    #[hint(if *key == "version", "a later version of the studio wrote it; use that one")]
    #[hint("choose a file of kept mixtures")]
    Kind {
        /// Name of the file.
        file: String,
        /// `format` or `version`.
        key: &'static str,
        /// Value of this version.
        expected: String,
        /// Value in the file.
        found: String,
    },
    /// A value cannot be used.
    #[error("{file}: key `{key}`: {reason}")]
    #[hint("correct this value in the file")]
    Value {
        /// Name of the file.
        file: String,
        /// Path of the key, e.g. `swatches[3].vehicle`.
        key: String,
        /// Expected value, and the one found.
        reason: String,
    },
}

const LONGEST_NAME: usize = 60;

/// A recipe that is saved under a name.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct KeptMixture {
    /// Name given by the painter.
    pub name: String,
    /// Title of the library of its pigments.
    pub library: String,
    /// Parts by pigment name. Each must be above 0.
    pub recipe: Recipe,
    /// Share of clear medium in a load of it, 0 to 1.
    #[serde(default)]
    pub vehicle: f64,
    /// Colour when it was saved, as `#rrggbb`. We show this while its pigments are missing.
    pub color: String,
    /// Light under which it had that colour.
    #[serde(default)]
    pub light: String,
}

/// Whether you can load a mixture now or, if not, which pigments are missing.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Usable {
    /// All its pigments are on the palette.
    Now,
    /// These pigments of the library are not on the palette.
    NotOnPalette(Vec<PigmentId>),
    /// The library has no pigments of these names.
    NotInLibrary(Vec<String>),
}

impl KeptMixture {
    /// Makes a mixture of pigments of `library` and names it after its two largest parts. Returns
    /// `None` for a recipe without pigment.
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
        kept.color = screen_rgb(kept.appearance(library, light.0)?).to_hex();
        Some(kept)
    }

    /// Pigments with their parts.
    ///
    /// # Errors
    /// The names that `library` does not have.
    pub fn pigments(&self, library: &PigmentLibrary) -> Result<Vec<(PigmentId, f64)>, Vec<String>> {
        let find = |name: &String| library.ids().find(|id| library[*id].name == *name);
        let missing = self.recipe.keys().filter(|name| find(name).is_none());
        let missing: Vec<String> = missing.cloned().collect();
        if !missing.is_empty() {
            return Err(missing);
        }
        Ok(self.recipe.iter().filter_map(|(name, part)| Some((find(name)?, *part))).collect())
    }

    /// Whether you can load it now or, if not, what is missing.
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

    /// Colour of an opaque film under the light of `weights`. Returns `None` if `library` cannot
    /// mix it.
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

    /// Colour of the mixture on the screen. If `library` can mix it, this is its colour under the
    /// light of `weights`, else the colour that was saved.
    #[must_use]
    pub fn screen_color(&self, library: &PigmentLibrary, weights: &TristimulusWeights) -> [u8; 3] {
        let now = self.appearance(library, weights).map(screen_rgb);
        now.or_else(|| Rgb::from_hex(&self.color)).unwrap_or(Rgb([0.5; 3])).to_bytes()
    }

    /// Key and problem of the first value that cannot be used.
    fn fault(&self) -> Option<(String, String)> {
        fn fault(key: &str, reason: String) -> Option<(String, String)> {
            Some((key.to_owned(), reason))
        }
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

fn screen_rgb(appearance: Appearance) -> Rgb {
    appearance.srgb.linear().mapped_into_gamut().encoded()
}

/// Saved mixtures in the painter's order.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SwatchBook {
    /// Mixtures of all libraries.
    pub swatches: Vec<KeptMixture>,
}

/// A change of the list. An index beyond its end changes nothing.
#[derive(Debug, Clone, PartialEq)]
pub enum SwatchChange {
    /// Adds a mixture at the end. If its name is taken, it gets a number.
    Keep(Box<KeptMixture>),
    /// Gives another name to the mixture at an index. An empty name changes nothing.
    Rename(usize, String),
    /// Moves the mixture at the first index to the second.
    Move(usize, usize),
    /// Removes the mixture at an index.
    Remove(usize),
    /// Adds the mixtures of another list that this one lacks.
    Merge(SwatchBook),
}

impl SwatchBook {
    /// Applies a change.
    pub fn apply(&mut self, change: SwatchChange) {
        let count = self.swatches.len();
        match change {
            SwatchChange::Keep(mut kept) => {
                kept.name = self.free_name(&kept.name, None);
                self.swatches.push(*kept);
            }
            SwatchChange::Rename(index, name) => {
                let name = name.trim();
                if index < count && !name.is_empty() {
                    self.swatches[index].name = self.free_name(name, Some(index));
                }
            }
            SwatchChange::Move(from, to) => {
                if from < count && to < count {
                    let moved = self.swatches.remove(from);
                    self.swatches.insert(to, moved);
                }
            }
            SwatchChange::Remove(index) => {
                if index < count {
                    self.swatches.remove(index);
                }
            }
            SwatchChange::Merge(other) => {
                for kept in other.swatches {
                    if !self.swatches.contains(&kept) {
                        self.apply(SwatchChange::Keep(Box::new(kept)));
                    }
                }
            }
        }
    }

    /// The colours of the mixtures for other painting programs, in sRGB. If `library` can mix one,
    /// this is its colour under the light of `weights`, else the colour that was saved.
    #[must_use]
    pub fn colors(&self, library: &PigmentLibrary, weights: &TristimulusWeights) -> SwatchFile {
        let swatches = self
            .swatches
            .iter()
            .map(|kept: &KeptMixture| {
                let bytes = kept.screen_color(library, weights);
                let color = SwatchColor::Rgb(Rgb(bytes.map(|byte| f64::from(byte) / 255.0)));
                SwatchEntry { name: kept.name.clone(), group: String::new(), color }
            })
            .collect();
        SwatchFile { name: format!("{}: kept mixtures", library.title), swatches }
    }

    /// `name`, or `name 2` and so on if a mixture at another index than `own` has it.
    fn free_name(&self, name: &str, own: Option<usize>) -> String {
        let short: String = name.chars().take(LONGEST_NAME).collect();
        let stem: String = name.chars().take(LONGEST_NAME - 6).collect();
        let numbered = (2..=self.swatches.len() + 1).map(|number| format!("{stem} {number}"));
        let mut names = std::iter::once(short.clone()).chain(numbered);
        let free = names.find(|name| {
            let mut others = self.swatches.iter().enumerate();
            !others.any(|(index, kept)| Some(index) != own && kept.name == *name)
        });
        free.unwrap_or(short)
    }
}

/// Value of the key `format`.
const FORMAT: &str = "impasto-swatches";

/// Value of the key `version`.
const VERSION: u64 = 1;

impl SwatchBook {
    /// The list as JSON.
    #[must_use]
    pub fn to_json(&self) -> String {
        pigment::library::to_text(&json!({
            "format": FORMAT,
            "version": VERSION,
            "swatches": self.swatches,
        }))
    }

    /// Reads a list. Errors call the file `file`.
    ///
    /// # Errors
    /// [`SwatchBookError`] naming the file and the key.
    pub fn from_json(file: &str, text: &str) -> Result<Self, SwatchBookError> {
        let read: Map<String, Value> = serde_json::from_str(text)
            .map_err(|source| SwatchBookError::Json(file.to_owned(), source))?;
        let found = |key: &str| read.get(key).cloned().unwrap_or(Value::Null);
        for (key, expected) in [("format", json!(FORMAT)), ("version", json!(VERSION))] {
            if found(key) != expected {
                let expected = expected.to_string();
                let found = found(key).to_string();
                let file = file.to_owned();
                return Err(SwatchBookError::Kind { file, key, expected, found });
            }
        }
        let fault = |key: String, reason: String| SwatchBookError::Value {
            file: file.to_owned(),
            key,
            reason,
        };
        let Value::Array(listed) = found("swatches") else {
            let reason = format!("expected a list, found `{}`", found("swatches"));
            return Err(fault("swatches".to_owned(), reason));
        };
        let mut swatches = Vec::with_capacity(listed.len());
        for (index, value) in listed.into_iter().enumerate() {
            let kept: KeptMixture = serde_json::from_value(value)
                .map_err(|error| fault(format!("swatches[{index}]"), error.to_string()))?;
            if let Some((key, reason)) = kept.fault() {
                return Err(fault(format!("swatches[{index}].{key}"), reason));
            }
            swatches.push(kept);
        }
        Ok(Self { swatches })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pigment::evaluate::Viewing;
    use spectra::swatch_file::{read_gpl, write_gpl};

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

    fn kept(name: &str) -> KeptMixture {
        KeptMixture {
            name: name.to_owned(),
            library: "Oils".to_owned(),
            recipe: [("Vermilion".to_owned(), 1.0)].into(),
            vehicle: 0.0,
            color: "#102030".to_owned(),
            light: "D65".to_owned(),
        }
    }

    fn names(book: &SwatchBook) -> Vec<&str> {
        book.swatches.iter().map(|kept| kept.name.as_str()).collect()
    }

    #[test]
    fn changes_keep_order_and_names_apart() {
        let mut book = SwatchBook::default();
        for name in ["sky", "sea", "sky"] {
            book.apply(SwatchChange::Keep(Box::new(kept(name))));
        }
        assert_eq!(names(&book), ["sky", "sea", "sky 2"]);
        book.apply(SwatchChange::Move(2, 0));
        assert_eq!(names(&book), ["sky 2", "sky", "sea"]);
        book.apply(SwatchChange::Rename(1, "  dusk ".to_owned()));
        book.apply(SwatchChange::Rename(2, "dusk".to_owned()));
        book.apply(SwatchChange::Rename(0, " ".to_owned()));
        book.apply(SwatchChange::Rename(1, "dusk".to_owned()));
        assert_eq!(names(&book), ["sky 2", "dusk", "dusk 2"], "its own name is not taken");
        for change in [SwatchChange::Remove(7), SwatchChange::Move(0, 7), SwatchChange::Move(7, 0)]
        {
            book.apply(change);
        }
        book.apply(SwatchChange::Remove(1));
        assert_eq!(names(&book), ["sky 2", "dusk 2"]);
    }

    #[test]
    fn merging_adds_what_is_new_once() {
        let mut book = SwatchBook { swatches: vec![kept("sky"), kept("sea")] };
        let other = SwatchBook { swatches: vec![kept("sea"), kept("earth")] };
        book.apply(SwatchChange::Merge(other.clone()));
        book.apply(SwatchChange::Merge(other));
        assert_eq!(names(&book), ["sky", "sea", "earth"]);
    }

    #[test]
    fn colours_are_those_under_the_light_or_as_kept_and_survive_a_gpl() {
        let library = PigmentLibrary::van_gogh_oils();
        let weights = Viewing::default().weights(library.grid).unwrap();
        let mut unknown = kept("unknown");
        unknown.recipe = [("Moon Dust".to_owned(), 1.0)].into();
        let book = SwatchBook { swatches: vec![kept("red"), unknown] };
        let colors = book.colors(&library, &weights);
        let wanted = library.color([("Vermilion", 1.0)], &Viewing::default()).unwrap().hex();
        let text = write_gpl(&colors).unwrap();
        let read = read_gpl("a.gpl", text.as_bytes()).unwrap();
        let hex = read
            .swatches
            .iter()
            .map(|entry| (entry.name.as_str(), entry.color.srgb().expect("sRGB").to_hex()));
        let wanted = [("red", wanted), ("unknown", "#102030".to_owned())];
        assert_eq!(hex.collect::<Vec<_>>(), wanted);
    }

    fn text(entry: &str) -> String {
        format!(r#"{{"format": "impasto-swatches", "version": 1, "swatches": [{entry}]}}"#)
    }

    const GREEN: &str = r##"{"name": "Sea green", "library": "Oils",
        "recipe": {"Viridian": 2, "Zinc White": 5}, "color": "#8fb9a8"}"##;

    #[test]
    fn a_list_survives_writing_and_reading() {
        let book = SwatchBook::from_json("a.json", &text(GREEN)).unwrap();
        let kept = &book.swatches[0];
        assert_eq!((kept.name.as_str(), kept.vehicle, kept.recipe.len()), ("Sea green", 0.0, 2));
        let again = SwatchBook::from_json("b.json", &book.to_json()).unwrap();
        assert_eq!(again, book);
        let empty = SwatchBook::default();
        assert_eq!(SwatchBook::from_json("c.json", &empty.to_json()).unwrap(), empty);
    }

    #[test]
    fn faults_name_the_file_and_the_key() {
        let wrong = |from: &str, to: &str| text(&format!("{GREEN}, {}", GREEN.replace(from, to)));
        let cases = [
            ("[1]".to_owned(), "kept.json: "),
            (r#"{"format": "impasto-paint"}"#.to_owned(), "kept.json: key `format`"),
            (text(GREEN).replace(": 1,", ": 2,"), "kept.json: key `version`"),
            (text(GREEN).replace("\"swatches\"", "\"swotches\""), "kept.json: key `swatches`"),
            (wrong("\"Viridian\": 2", "\"Viridian\": -2"), "key `swatches[1].recipe.Viridian`"),
            (wrong("#8fb9a8", "green"), "key `swatches[1].color`"),
            (wrong("Sea green", " "), "key `swatches[1].name`"),
            (wrong("\"library\"", "\"librory\""), "key `swatches[1]`: unknown field `librory`"),
            (wrong("\"color\"", "\"vehicle\": 1.5, \"color\""), "key `swatches[1].vehicle`"),
        ];
        for (text, wanted) in cases {
            let error = SwatchBook::from_json("kept.json", &text).unwrap_err();
            assert!(error.to_string().contains(wanted), "{error}, not {wanted}");
            assert!(Explain::hint(&error).is_some());
        }
    }
}
