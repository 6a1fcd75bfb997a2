//! The pigments of a script.

use documents::hint::Explain;
use documents::similar_names;
use paint::document::Slots;
use paint::layer::SLOTS;
use pigment::PigmentLibrary;

use super::action::Recipe;
use super::file::Script;
use crate::toml_text::{Fault, KeyPath};

impl Script {
    /// The pigments of the palette in `library`, by slots in the order of their letters.
    ///
    /// # Errors
    /// [`Fault`] of the letter whose pigment the library does not have, or has twice, and of one
    /// that means the same pigment as another. [`super::ScriptError::located`] adds its line.
    pub fn slots(&self, library: &PigmentLibrary) -> Result<Slots, Box<Fault>> {
        let mut slots = Slots::default();
        for (slot, (letter, name)) in self.palette.iter().enumerate() {
            let key = KeyPath::of("palette").key(letter);
            if slot == SLOTS {
                let wanted = format!("at most {SLOTS} pigments");
                return Err(Fault::new(&key, wanted, self.palette.len(), "leave this one out"));
            }
            let found = library.find(name).map_err(|error| {
                let known = library.pigments.iter().map(|pigment| pigment.name.as_str());
                let similar = similar_names(name, known);
                let hint = match similar.is_empty() {
                    true => error.hint().map_or_else(|| error.to_string(), |hint| hint.to_string()),
                    false => format!("did you mean {}?", similar.join(" or ")),
                };
                Fault::new(&key, "a pigment of the library", name, hint)
            })?;
            if slots.contains(&Some(found)) {
                let hint = "leave one of the two out";
                return Err(Fault::new(&key, "a pigment that no other letter has", name, hint));
            }
            slots[slot] = Some(found);
        }
        Ok(slots)
    }

    /// Shares of the slots in a recipe of this script: sum 1, or all 0 for a recipe without
    /// pigments.
    #[must_use]
    pub fn shares(&self, recipe: &Recipe) -> [f64; SLOTS] {
        let total: f64 = recipe.values().sum();
        let mut shares = [0.0; SLOTS];
        for (share, letter) in shares.iter_mut().zip(self.palette.keys()) {
            let part = recipe.get(letter).copied().unwrap_or(0.0);
            *share = if total > 0.0 { part / total } else { 0.0 };
        }
        shares
    }
}
