//! Actions carried out.

use super::failure::SessionError;
use super::history::Entry;
use super::label::label;
use super::state::{Outcome, PaintingSession};
use crate::layer::SLOTS;
use crate::painting::{LayerRef, Painting, PaintingError};
use crate::strokes::{
    Action, ActionPigments, CheckContext, Load, PaletteSpec, Recipe, Squeeze, Stroke, SurfaceId,
    check_brush,
};

/// On the canvas alone.
pub(super) const CANVAS: [bool; 2] = [true, false];

/// On no surface: of a brush alone.
const NOWHERE: [bool; 2] = [false, false];

impl PaintingSession {
    /// Carries out one action; what is open, a stroke or what is being adjusted,
    /// ends first. Drying, layers and a merge are the canvas's; light, gloss,
    /// pigments and a swap in the wet layer are those of both surfaces.
    ///
    /// # Errors
    /// [`SessionError`] for what cannot be done; nothing is changed then, unless the
    /// backend fails half way: the history and the recording end there.
    pub fn apply(&mut self, action: &Action) -> Result<Outcome, SessionError> {
        self.finish_open()?;
        match action {
            Action::Undo {} => return Ok(nothing_unless(self.undo()?)),
            Action::Redo {} => return Ok(nothing_unless(self.redo()?)),
            Action::Stroke(Stroke { brush, on, samples }) => {
                self.check(action)?;
                self.begin_stroke(*on, brush)?;
                let told = self.extend(samples);
                let report = self.end_stroke()?;
                told?;
                return Ok(report.map_or(Outcome::Nothing, Outcome::Painted));
            }
            Action::Save { .. } => return Err(SessionError::Save),
            _ => {}
        }
        let (action, pigments) = self.understood(action)?;
        let Some(on) = self.perform(&action, &pigments)? else { return Ok(Outcome::Nothing) };
        self.did(&action, &pigments, on);
        Ok(Outcome::Done)
    }

    /// Whether numbers and names of an action will do.
    pub(super) fn check(&self, action: &Action) -> Result<(), SessionError> {
        let at = CheckContext::default();
        if let Some(brush) = action.brush() {
            check_brush(&at, brush, self.brushes.names().map(|(name, _)| name))?;
        }
        self.surfaces().check(&at, action)?;
        Ok(())
    }

    /// The action as a file has it, and the pigments that it names.
    pub(super) fn understood(
        &self,
        action: &Action,
    ) -> Result<(Action, ActionPigments), SessionError> {
        self.check(action)?;
        let action = action.rounded();
        let pigments =
            self.scope.pigments_of(&CheckContext::default(), &action, self.canvas.library())?;
        Ok((action, pigments))
    }

    /// Does it; tells of which surfaces' histories it is part, nothing if there
    /// was nothing to do.
    pub(super) fn perform(
        &mut self,
        action: &Action,
        pigments: &ActionPigments,
    ) -> Result<Option<[bool; 2]>, SessionError> {
        let done = self.try_to(action, pigments);
        self.followed(done)
    }

    /// Hands `done` on; where a backend failed half way nobody knows what the
    /// paintings' histories hold of it, so that nothing before it can be taken
    /// back, and nothing after it be recorded.
    pub(super) fn followed<T>(&mut self, done: Result<T, SessionError>) -> Result<T, SessionError> {
        if let Err(SessionError::Painting(PaintingError::Engine(error))) = &done {
            self.history = Default::default();
            if let Some(record) = &mut self.record {
                record.stop(&format!("the backend failed: {error}"));
            }
        }
        done
    }

    fn try_to(
        &mut self,
        action: &Action,
        pigments: &ActionPigments,
    ) -> Result<Option<[bool; 2]>, SessionError> {
        let both = [true, self.palette.is_some()];
        let on = match (action, pigments) {
            (Action::Load(load), ActionPigments::Recipe(parts)) => {
                let recipe = recipe(&self.canvas, parts)?;
                self.with_brush(&load.brush, |painting, number| {
                    painting.load(number, &recipe, load.vehicle, load.amount_mm)
                })?;
                NOWHERE
            }
            (Action::Wipe { brush, keep }, _) => {
                self.with_brush(brush, |painting, number| painting.wipe(number, *keep))?;
                NOWHERE
            }
            (Action::Wash { brush }, _) => {
                self.with_brush(brush, Painting::wash)?;
                NOWHERE
            }
            (Action::Dry { fraction }, _) => {
                if !self.canvas.dry(*fraction)? {
                    return Ok(None);
                }
                CANVAS
            }
            (Action::Palette(_), ActionPigments::Palette(slots)) => {
                self.wash_what_was_put_away()?;
                let pigments: Vec<usize> = slots.iter().flatten().copied().collect();
                if let Some(palette) = &mut self.palette {
                    palette.slots_with(&pigments)?;
                }
                self.canvas.set_palette(&pigments)?;
                if let Some(palette) = &mut self.palette {
                    palette.set_palette(&pigments)?;
                }
                both
            }
            (Action::Light(lighting), _) => {
                self.canvas.relight(lighting.clone())?;
                if let Some(palette) = &mut self.palette {
                    palette.relight_as(&self.canvas)?;
                }
                both
            }
            (Action::Gloss { wet, dry }, _) => {
                self.canvas.set_gloss(*wet, *dry)?;
                if let Some(palette) = &mut self.palette {
                    palette.set_gloss(*wet, *dry)?;
                }
                both
            }
            (Action::Opacity { layer, value }, _) => {
                self.canvas.set_opacity(*layer, *value)?;
                CANVAS
            }
            (Action::Swap { layer, .. }, ActionPigments::Swap { from, to }) => {
                self.canvas.swap_pigment(*layer, *from, *to)?;
                match (layer, &mut self.palette) {
                    (LayerRef::Wet, Some(palette)) => {
                        palette.swap_pigment(LayerRef::Wet, *from, *to)?;
                        both
                    }
                    _ => CANVAS,
                }
            }
            (Action::Merge { layer }, _) => {
                self.canvas.merge(layer.saturating_sub(1))?;
                CANVAS
            }
            (Action::Squeeze(squeeze), ActionPigments::Recipe(parts)) => {
                let recipe = recipe(&self.canvas, parts)?;
                let Squeeze { on, vehicle, x_mm, y_mm, volume_mm3, .. } = *squeeze;
                self.surface_mut(on)?.squeeze(&recipe, vehicle, x_mm, y_mm, volume_mm3)?;
                [on.is_canvas(), !on.is_canvas()]
            }
            (Action::Scrape { on }, _) => {
                if !self.surface_mut(*on)?.scrape()? {
                    return Ok(None);
                }
                [on.is_canvas(), !on.is_canvas()]
            }
            (action, _) => unreachable!("{} is done elsewhere", action.kind()),
        };
        Ok(Some(on))
    }

    /// Does something to the paint on a brush, where that is. A brush that is used
    /// for the first time is there from then on, even if that is refused; the
    /// recording knows as well.
    fn with_brush(
        &mut self,
        name: &str,
        change: impl FnOnce(&mut Painting, usize) -> Result<(), PaintingError>,
    ) -> Result<(), SessionError> {
        check_brush(&CheckContext::default(), name, self.brushes.names().map(|(name, _)| name))?;
        let Some(tool) = self.brushes.find(name) else { return Ok(()) };
        let at = self.brushes.tools[tool].at;
        let fresh = self.brushes.tools[tool].numbers[at as usize].is_none();
        let number = self.number(tool, at)?;
        let changed = change(self.surface_mut(at)?, number);
        if changed.is_err() && fresh {
            self.note(Action::Wash { brush: name.to_owned() });
        }
        Ok(changed?)
    }

    /// Heads that gave their name to another were washed, but an undo may have
    /// given them paint back, which nobody could wash off.
    fn wash_what_was_put_away(&mut self) -> Result<(), SessionError> {
        for tool in self.brushes.put_away() {
            let at = self.brushes.tools[tool].at;
            let Some(number) = self.brushes.tools[tool].numbers[at as usize] else { continue };
            let painting = self.surface_mut(at)?;
            if painting.brush_paint(number)?.totals().iter().any(|total| *total > 0) {
                painting.wash(number)?;
                let brush = self.brushes.tools[tool].name.clone();
                self.note_with(Action::Wash { brush }, Some(tool));
            }
        }
        Ok(())
    }

    /// The number of a head in the painting of a surface; made where it is new.
    pub(super) fn number(&mut self, tool: usize, on: SurfaceId) -> Result<usize, SessionError> {
        if let Some(number) = self.brushes.tools[tool].numbers[on as usize] {
            return Ok(number);
        }
        let spec = self.brushes.tools[tool].spec.clone();
        let number = self.surface_mut(on)?.add_brush(spec.shape, spec.size_mm)?;
        self.brushes.tools[tool].numbers[on as usize] = Some(number);
        Ok(number)
    }

    /// Tells history and recording of an action that was done.
    pub(super) fn did(&mut self, action: &Action, pigments: &ActionPigments, on: [bool; 2]) {
        if on != NOWHERE {
            let label = label(action, pigments, self.canvas.library());
            self.history.add(Entry { label, on, carried: None });
            self.follow();
        }
        self.scope.add_palette_of(action, pigments);
        self.note(self.named_in_full(action, pigments));
    }

    /// Adds to the recording.
    pub(super) fn note(&mut self, action: Action) {
        let tool = action.brush().and_then(|name| self.brushes.find(name));
        self.note_with(action, tool);
    }

    /// The same with a head that may have given its name away.
    pub(super) fn note_with(&mut self, mut action: Action, tool: Option<usize>) {
        let Some(record) = &mut self.record else { return };
        let tool = tool.map(|tool| &self.brushes.tools[tool]);
        if let (Some(name), Some(tool)) = (action.brush_mut(), tool) {
            name.clone_from(&tool.recorded);
        }
        record.add(action, tool.map(|tool| (tool.recorded.as_str(), &tool.spec)));
    }

    /// The action with the library's names of its pigments, which mean the same
    /// at any time.
    fn named_in_full(&self, action: &Action, pigments: &ActionPigments) -> Action {
        let library = self.canvas.library();
        let name = |pigment: usize| library.pigments[pigment].name.clone();
        let recipe = |parts: &[(usize, f64)]| -> Recipe {
            parts.iter().map(|(pigment, part)| (name(*pigment), *part)).collect()
        };
        match (action, pigments) {
            (Action::Load(load), ActionPigments::Recipe(parts)) => {
                Action::Load(Load { recipe: recipe(parts), ..load.clone() })
            }
            (Action::Squeeze(squeeze), ActionPigments::Recipe(parts)) => {
                Action::Squeeze(Squeeze { recipe: recipe(parts), ..squeeze.clone() })
            }
            (Action::Palette(_), ActionPigments::Palette(slots)) => {
                let pigments = slots.iter().flatten().map(|&pigment| (None, name(pigment)));
                Action::Palette(PaletteSpec { pigments: pigments.collect() })
            }
            (Action::Swap { layer, .. }, ActionPigments::Swap { from, to }) => {
                Action::Swap { layer: *layer, from: name(*from), to: name(*to) }
            }
            _ => action.clone(),
        }
    }
}

pub(super) fn nothing_unless(done: bool) -> Outcome {
    if done { Outcome::Done } else { Outcome::Nothing }
}

/// Parts by slot of the palette of this moment.
fn recipe(painting: &Painting, parts: &[(usize, f64)]) -> Result<[f64; SLOTS], PaintingError> {
    let mut recipe = [0.0; SLOTS];
    for &(pigment, part) in parts {
        recipe[painting.slot_of(pigment)?] = part;
    }
    Ok(recipe)
}
