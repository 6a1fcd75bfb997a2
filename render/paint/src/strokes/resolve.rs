//! Names of pigments become those of a library.

use pigment::library::{PigmentLibrary, RecipeError};

use super::action::{Action, Load, Recipe, Squeeze};
use super::at::{At, near};
use super::error::{InvalidValue, ScriptError};
use super::palette::PaletteSpec;
use super::script::StrokeScript;
use crate::document::Slots;
use crate::layer::SLOTS;

/// The pigments of a script, by index into a library.
#[derive(Debug, Clone, PartialEq)]
pub struct Resolved {
    /// The palette at first.
    pub slots: Slots,
    /// What each action names, action by action.
    pub actions: Vec<ActionPigments>,
}

/// The pigments that an action names.
#[derive(Debug, Clone, PartialEq)]
pub enum ActionPigments {
    /// It names none.
    None,
    /// Of a load or a heap: pigment and parts, in order of the library; parts above 0.
    Recipe(Vec<(usize, f64)>),
    /// Of a palette.
    Palette(Slots),
    /// Of a swap.
    Swap {
        /// The pigment that goes.
        from: usize,
        /// The one that takes its place.
        to: usize,
    },
}

impl StrokeScript {
    /// The pigments that the script names, looked up in `library` after it was
    /// checked. Short names are those of the latest palette that has them.
    ///
    /// A recipe may only name pigments of the first palette or of one that an
    /// earlier action sets; whether it is the palette of that moment depends on
    /// what was undone, so the painter sees to it.
    ///
    /// # Errors
    /// [`ScriptError::Invalid`] for values out of range (see [`StrokeScript::check`]),
    /// names that the library has not or that fit several, a pigment named twice
    /// in a palette or a recipe, and recipes beyond the palettes.
    pub fn resolve(&self, library: &PigmentLibrary) -> Result<Resolved, ScriptError> {
        self.check()?;
        let (mut scope, slots) = Scope::new(&self.palette, library)?;
        let mut actions = Vec::with_capacity(self.actions.len());
        for (index, action) in self.actions.iter().enumerate() {
            let at = At::action(index, action.kind());
            let pigments = scope.action(&at, action, library)?;
            scope.learn(action, &pigments);
            actions.push(pigments);
        }
        Ok(Resolved { slots, actions })
    }
}

/// What names mean at some action.
#[derive(Debug)]
pub(crate) struct Scope {
    /// Those set so far.
    palettes: Vec<(PaletteSpec, Slots)>,
}

impl Scope {
    /// Before the first action, with the pigments that there are at first.
    pub(crate) fn new(
        palette: &PaletteSpec,
        library: &PigmentLibrary,
    ) -> Result<(Self, Slots), Box<InvalidValue>> {
        let slots = slots(&At::default(), palette, library)?;
        Ok((Self { palettes: vec![(palette.clone(), slots)] }, slots))
    }

    /// After an action that may have set a palette.
    pub(crate) fn learn(&mut self, action: &Action, pigments: &ActionPigments) {
        if let (Action::Palette(palette), ActionPigments::Palette(slots)) = (action, pigments) {
            self.palettes.push((palette.clone(), *slots));
        }
    }

    /// The pigments that an action names.
    pub(crate) fn action(
        &self,
        at: &At,
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
        at: &At,
        recipe: &Recipe,
        library: &PigmentLibrary,
    ) -> Result<Vec<(usize, f64)>, Box<InvalidValue>> {
        let mut parts: Vec<(usize, f64)> = Vec::new();
        for (name, &part) in recipe {
            let index = self.pigment(at, "recipe", name, library)?;
            if !self.palettes.iter().any(|(_, slots)| slots.contains(&Some(index))) {
                let known = self.palettes.iter().flat_map(|(palette, _)| &palette.pigments);
                let known: Vec<_> = known.map(|(_, name)| name.as_str()).collect();
                let hint = format!("the palette has {}", known.join(", "));
                return Err(at.fault("recipe", "pigments of the palette", name, Some(hint)));
            }
            if parts.iter().any(|(other, _)| *other == index) {
                return Err(at.fault("recipe", "each pigment once", name, None));
            }
            if part > 0.0 {
                parts.push((index, part));
            }
        }
        parts.sort_by_key(|(index, _)| *index);
        Ok(parts)
    }

    /// The pigment behind a short name, or a name of the library.
    fn pigment(
        &self,
        at: &At,
        field: &str,
        name: &str,
        library: &PigmentLibrary,
    ) -> Result<usize, Box<InvalidValue>> {
        let short = self.palettes.iter().rev().find_map(|(palette, _)| palette.behind(name));
        named(at, field, short.unwrap_or(name), library)
    }
}

fn slots(
    at: &At,
    palette: &PaletteSpec,
    library: &PigmentLibrary,
) -> Result<Slots, Box<InvalidValue>> {
    let mut slots = [None; SLOTS];
    for (slot, (_, name)) in palette.pigments.iter().enumerate() {
        let index = named(at, "palette", name, library)?;
        if slots.contains(&Some(index)) {
            return Err(at.fault("palette", "each pigment once", name, None));
        }
        slots[slot] = Some(index);
    }
    Ok(slots)
}

fn named(
    at: &At,
    field: &str,
    name: &str,
    library: &PigmentLibrary,
) -> Result<usize, Box<InvalidValue>> {
    library.find(name).map_err(|error| {
        let known = library.pigments.iter().map(|pigment| pigment.name.as_str());
        let hint = match &error {
            RecipeError::UnknownPigment { .. } => near(name, known).or_else(|| error.hint()),
            _ => error.hint(),
        };
        at.fault(field, "a pigment of the library", &name, hint)
    })
}
