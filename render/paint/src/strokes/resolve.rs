//! Lookup of pigment names in a library.

use documents::hint::{Explain, Hint};
use pigment::PigmentId;
use pigment::library::{PigmentLibrary, RecipeError};

use super::action::{Action, Load, Recipe, Squeeze};
use super::check_context::{CheckContext, did_you_mean};
use super::error::{InvalidValue, ScriptError};
use super::palette::PaletteSpec;
use super::script::StrokeScript;
use crate::document::Slots;
use crate::layer::SLOTS;

/// The pigments of a script.
#[derive(Debug, Clone, PartialEq)]
pub struct Resolved {
    /// Pigments of the wet layer before the first action.
    pub slots: Slots,
    /// Pigments that each action names, in the order of the actions.
    pub actions: Vec<ActionPigments>,
}

/// The pigments that an action names.
#[derive(Debug, Clone, PartialEq)]
pub enum ActionPigments {
    /// The action names no pigment.
    None,
    /// Pigments and parts of a load or a heap, in the order of the library. Parts are
    /// above 0.
    Recipe(Vec<(PigmentId, f64)>),
    /// Pigments of a palette by slot.
    Palette(Slots),
    /// Pigments of a swap.
    Swap {
        /// Pigment to replace.
        from: PigmentId,
        /// Pigment that takes its place.
        to: PigmentId,
    },
}

impl StrokeScript {
    /// Checks the script and looks its pigments up in `library`. A short name means the
    /// pigment of the latest palette that has it.
    ///
    /// A recipe may only name pigments of the first palette or of a palette that an
    /// earlier action sets. Whether that palette is still set depends on what was undone,
    /// so it is checked when the action is applied.
    ///
    /// # Errors
    /// [`ScriptError::Invalid`] for values out of range (see [`StrokeScript::check`]),
    /// names that match no pigment or several, a pigment named twice in a palette or a
    /// recipe, and recipes with pigments of no palette.
    pub fn resolve(&self, library: &PigmentLibrary) -> Result<Resolved, ScriptError> {
        self.check()?;
        let (mut names, slots) = PigmentNames::new(&self.palette, library)?;
        let mut actions = Vec::with_capacity(self.actions.len());
        for (index, action) in self.actions.iter().enumerate() {
            let at = CheckContext::action(index, action.kind());
            let pigments = names.pigments_of(&at, action, library)?;
            names.add_palette_of(action, &pigments);
            actions.push(pigments);
        }
        Ok(Resolved { slots, actions })
    }
}

/// Meaning of pigment names at one action of a script.
#[derive(Debug)]
pub(crate) struct PigmentNames {
    /// Palettes set so far, with their slots.
    palettes: Vec<(PaletteSpec, Slots)>,
}

impl PigmentNames {
    /// The names before the first action, and the slots of `palette`.
    pub(crate) fn new(
        palette: &PaletteSpec,
        library: &PigmentLibrary,
    ) -> Result<(Self, Slots), Box<InvalidValue>> {
        let slots = slots(&CheckContext::default(), palette, library)?;
        Ok((Self { palettes: vec![(palette.clone(), slots)] }, slots))
    }

    /// Adds the palette that an action sets, if it sets one.
    pub(crate) fn add_palette_of(&mut self, action: &Action, pigments: &ActionPigments) {
        if let (Action::Palette(palette), ActionPigments::Palette(slots)) = (action, pigments) {
            self.palettes.push((palette.clone(), *slots));
        }
    }

    /// Looks up the pigments that an action names.
    pub(crate) fn pigments_of(
        &self,
        at: &CheckContext,
        action: &Action,
        library: &PigmentLibrary,
    ) -> Result<ActionPigments, Box<InvalidValue>> {
        Ok(match action {
            Action::Load(Load { recipe, .. }) | Action::Squeeze(Squeeze { recipe, .. }) => {
                ActionPigments::Recipe(self.recipe(at, recipe, library)?)
            }
            Action::Palette(palette) => ActionPigments::Palette(slots(at, palette, library)?),
            Action::Swap { from, to, .. } => ActionPigments::Swap {
                from: self.pigment(at, "from", from, library)?,
                to: self.pigment(at, "to", to, library)?,
            },
            _ => ActionPigments::None,
        })
    }

    fn recipe(
        &self,
        at: &CheckContext,
        recipe: &Recipe,
        library: &PigmentLibrary,
    ) -> Result<Vec<(PigmentId, f64)>, Box<InvalidValue>> {
        let mut parts: Vec<(PigmentId, f64)> = Vec::new();
        for (name, &part) in recipe {
            let index = self.pigment(at, "recipe", name, library)?;
            if !self.palettes.iter().any(|(_, slots)| slots.contains(&Some(index))) {
                let known = self.palettes.iter().flat_map(|(palette, _)| &palette.pigments);
                let known: Vec<_> = known.map(|(_, name)| name.as_str()).collect();
                let hint = Hint::new(format!("the palette has {}", known.join(", ")));
                return Err(at.invalid("recipe", "pigments of the palette", name, Some(hint)));
            }
            if parts.iter().any(|(other, _)| *other == index) {
                return Err(at.invalid("recipe", "each pigment once", name, None));
            }
            if part > 0.0 {
                parts.push((index, part));
            }
        }
        parts.sort_by_key(|(index, _)| *index);
        Ok(parts)
    }

    /// Pigment with a short name or a name of the library.
    fn pigment(
        &self,
        at: &CheckContext,
        field: &str,
        name: &str,
        library: &PigmentLibrary,
    ) -> Result<PigmentId, Box<InvalidValue>> {
        let short = self.palettes.iter().rev().find_map(|(palette, _)| palette.library_name(name));
        find_pigment(at, field, short.unwrap_or(name), library)
    }
}

fn slots(
    at: &CheckContext,
    palette: &PaletteSpec,
    library: &PigmentLibrary,
) -> Result<Slots, Box<InvalidValue>> {
    let mut slots = [None; SLOTS];
    for (slot, (_, name)) in palette.pigments.iter().enumerate() {
        let index = find_pigment(at, "palette", name, library)?;
        if slots.contains(&Some(index)) {
            return Err(at.invalid("palette", "each pigment once", name, None));
        }
        slots[slot] = Some(index);
    }
    Ok(slots)
}

fn find_pigment(
    at: &CheckContext,
    field: &str,
    name: &str,
    library: &PigmentLibrary,
) -> Result<PigmentId, Box<InvalidValue>> {
    library.find(name).map_err(|error| {
        let known = library.pigments.iter().map(|pigment| pigment.name.as_str());
        let hint = match &error {
            RecipeError::UnknownPigment { .. } => {
                did_you_mean(name, known).or_else(|| error.hint())
            }
            _ => error.hint(),
        };
        at.invalid(field, "a pigment of the library", &name, hint)
    })
}
