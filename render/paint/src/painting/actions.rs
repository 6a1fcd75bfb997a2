//! The one place where actions change a painting.

use pigment::PigmentId;

use super::failure::PaintingError;
use super::state::Painting;
use crate::engine::BrushId;
use crate::layer::{LayerRef, SLOTS};
use crate::strokes::{
    Action, ActionLimits, ActionPigments, CheckContext, Load, PaletteSpec, PigmentNames, Squeeze,
    pigment_names,
};

impl Painting {
    /// Applies an action of paint, layers or light, in which pigments have their names in the
    /// library. Returns whether there was anything to do.
    ///
    /// # Errors
    /// [`PaintingError`] for an action that cannot be done, or that only a
    /// [`PaintingSession`](crate::PaintingSession) does.
    ///
    /// # Panics
    /// If a stroke is open.
    pub fn apply(&mut self, action: &Action) -> Result<bool, PaintingError> {
        let at = CheckContext::default();
        let limits = ActionLimits { canvas_mm: self.longer_side_mm(), palette_mm: None };
        limits.check(&at, action)?;
        let own = PaletteSpec::from_names(pigment_names(&self.state.slots, &self.library));
        let (names, _) = PigmentNames::new(&own, &self.library)?;
        let pigments = names.pigments_of(&at, action, &self.library)?;
        self.change(action, &pigments)
    }

    /// Longer side of the canvas in mm.
    pub(crate) fn longer_side_mm(&self) -> f64 {
        let bounds = self.bounds();
        bounds.width.max(bounds.height) as f64 * self.cell_mm
    }

    /// Applies an action that was checked. Returns whether there was anything to do.
    pub(crate) fn change(
        &mut self,
        action: &Action,
        pigments: &ActionPigments,
    ) -> Result<bool, PaintingError> {
        match (action, pigments) {
            (Action::Dry { fraction }, _) => return self.dry(*fraction),
            (Action::Scrape { .. }, _) => return self.scrape(),
            (Action::Mask(change), _) => return self.change_mask(change),
            (Action::Palette(_), ActionPigments::Palette(slots)) => {
                let pigments: Vec<PigmentId> = slots.iter().flatten().copied().collect();
                self.set_palette(&pigments)?;
            }
            (Action::Light(lighting), _) => self.relight(lighting.clone())?,
            (Action::Gloss { wet, dry }, _) => self.apply_action(|painting| {
                let medium = &mut painting.state.medium;
                (medium.wet, medium.dry) = (*wet, *dry);
                painting.views.mark_all_wet();
                Ok(())
            })?,
            // Paint levels by it after the next stroke.
            (Action::Stiffness { value }, _) => self.apply_action(|painting| {
                painting.state.medium.stiffness = *value;
                Ok(())
            })?,
            (Action::Opacity { layer, value }, _) => self.set_opacity(*layer, *value)?,
            (Action::Swap { layer, .. }, ActionPigments::Swap { from, to }) => {
                self.swap_pigment(*layer, *from, *to)?;
            }
            (Action::Name { layer, name }, _) => {
                let index = self.dry_layer(*layer, "name")?;
                self.apply_action(|painting| {
                    painting.state.dry[index].name.clone_from(name);
                    Ok(())
                })?;
            }
            (Action::Visible { layer, value }, _) => {
                let index = self.dry_layer(*layer, "visibility")?;
                self.apply_action(|painting| {
                    painting.state.dry[index].visible = *value;
                    painting.views.mark_all();
                    Ok(())
                })?;
            }
            // Layers between the two places move by one.
            (&Action::Order { layer, to }, _) => {
                let from = self.dry_layer(layer, "place")?;
                self.dry_index(LayerRef::Dry(to))?;
                if from == to {
                    return Ok(false);
                }
                self.apply_action(|painting| {
                    painting.history.move_dry_layer(&mut painting.engine, from, to);
                    let moved = painting.state.dry.remove(from);
                    painting.state.dry.insert(to, moved);
                    painting.floor_changed()
                })?;
            }
            (&Action::Merge { layer, with: Some(with) }, _) => self.merge(layer, with)?,
            (&Action::Merge { layer, with: None }, _) => {
                match self.dry_layer(layer, "layer to merge with")? {
                    0 => return Err(PaintingError::NothingBelow),
                    index => self.merge(layer, LayerRef::Dry(index - 1))?,
                }
            }
            (Action::Squeeze(squeeze), ActionPigments::Recipe(parts)) => {
                let recipe = self.recipe(parts)?;
                let Squeeze { vehicle, x_mm, y_mm, volume_mm3, .. } = *squeeze;
                self.squeeze(&recipe, vehicle, x_mm, y_mm, volume_mm3)?;
            }
            (action, _) => return Err(PaintingError::NoSession { kind: action.kind() }),
        }
        Ok(true)
    }

    /// Applies an action that was checked to the paint on a brush.
    pub(crate) fn change_brush(
        &mut self,
        brush: BrushId,
        action: &Action,
        pigments: &ActionPigments,
    ) -> Result<(), PaintingError> {
        match (action, pigments) {
            (Action::Load(Load { vehicle, amount_mm, .. }), ActionPigments::Recipe(parts)) => {
                self.load(brush, &self.recipe(parts)?, *vehicle, *amount_mm)
            }
            (Action::Wipe { keep, .. }, _) => self.wipe(brush, *keep),
            (Action::Wash { .. }, _) => self.wash(brush),
            (action, _) => Err(PaintingError::NoSession { kind: action.kind() }),
        }
    }

    /// Index of a dry layer. An error for the wet one, which has no `what`.
    fn dry_layer(&self, layer: LayerRef, what: &'static str) -> Result<usize, PaintingError> {
        self.dry_index(layer)?.ok_or(PaintingError::WetLayer { what })
    }

    /// Parts of a recipe by slot of the palette.
    pub(crate) fn recipe(&self, parts: &[(PigmentId, f64)]) -> Result<[f64; SLOTS], PaintingError> {
        let mut recipe = [0.0; SLOTS];
        for &(pigment, part) in parts {
            recipe[self.slot_of(pigment)?] = part;
        }
        Ok(recipe)
    }
}
