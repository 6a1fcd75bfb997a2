//! Applying actions to a session: single actions, strokes with their samples, adjustments by a
//! slider that count as one, and undo and redo over the history of canvas and palette.

use pigment::PigmentId;

use super::history::{Carried, Entry};
use super::state::{Adjusting, Control, Outcome, PaintingSession};
use crate::engine::BrushId;
use crate::painting::{OpenStroke, Painting, PaintingError, StrokeReport};
use crate::pose::Sample;
use crate::stroke::{Path, SampleDecimals};
use crate::strokes::{
    Action, ActionPigments, CheckContext, Load, PaletteSpec, PerSurface, Recipe, Squeeze, Stroke,
    StrokeTool, SurfaceId, check_brush, check_sample, check_tool, six_digits, unknown_brush,
};

impl PaintingSession {
    /// Applies one action. Any open stroke or adjustment is finished first. Drying, layers and
    /// merging concern the canvas. Light, gloss, stiffness, pigments and a swap in the wet layer
    /// concern both surfaces.
    ///
    /// # Errors
    /// [`PaintingError`] for an action that cannot be done. Nothing is changed then. If the
    /// backend fails half way, history and recording end there.
    pub fn apply(&mut self, action: &Action) -> Result<Outcome, PaintingError> {
        self.finish_open()?;
        match action {
            Action::Undo {} => return Ok(Outcome::of(self.undo()?)),
            Action::Redo {} => return Ok(Outcome::of(self.redo()?)),
            Action::Stroke(stroke) | Action::Cut(stroke) => {
                self.check(action)?;
                let report = self.apply_stroke(stroke, matches!(action, Action::Cut(_)))?;
                return Ok(report.map_or(Outcome::Nothing, Outcome::Painted));
            }
            Action::Save { .. } => return Err(PaintingError::Save),
            _ => {}
        }
        let (action, pigments) = self.rounded(action)?;
        let label = self.label(&action, &pigments);
        let on = self.perform(&action, &pigments)?;
        if let Some(on) = on {
            self.record_done(action, &pigments, label, (on, None));
        }
        Ok(Outcome::of(on.is_some()))
    }

    /// Checks numbers and names of an action.
    fn check(&self, action: &Action) -> Result<(), PaintingError> {
        let at = CheckContext::default();
        if let Some(brush) = action.brush() {
            check_brush(&at, brush, self.brushes.named_heads().map(|(name, _)| name))?;
        }
        Ok(self.surfaces().check(&at, action)?)
    }

    /// The action with its numbers rounded as in a file, and the pigments that it names.
    fn rounded(&self, action: &Action) -> Result<(Action, ActionPigments), PaintingError> {
        self.check(action)?;
        let action = action.rounded();
        let pigments =
            self.scope.pigments_of(&CheckContext::default(), &action, self.canvas.library())?;
        Ok((action, pigments))
    }

    /// Label of an action before it is applied.
    pub(super) fn label(&self, action: &Action, pigments: &ActionPigments) -> String {
        action.label(pigments, self.canvas.library(), &self.canvas.state().dry)
    }

    /// Applies an action to the surfaces that it changes. Returns those that changed. `None` if
    /// there was nothing to do.
    fn perform(
        &mut self,
        action: &Action,
        pigments: &ActionPigments,
    ) -> Result<Option<PerSurface<bool>>, PaintingError> {
        let done = self.try_perform(action, pigments);
        self.follow_failure(done)
    }

    /// Returns `done`. If a backend failed half way, the content of the paintings' histories is
    /// unknown: the history of the session is cleared and its recording ends.
    pub(super) fn follow_failure<T>(
        &mut self,
        done: Result<T, PaintingError>,
    ) -> Result<T, PaintingError> {
        if let Err(PaintingError::Engine(error)) = &done {
            self.history = Default::default();
            if let Some(record) = &mut self.record {
                record.stop(&format!("the backend failed: {error}"));
            }
        }
        done
    }

    fn try_perform(
        &mut self,
        action: &Action,
        pigments: &ActionPigments,
    ) -> Result<Option<PerSurface<bool>>, PaintingError> {
        if let Some(brush) = action.brush() {
            self.change_brush(brush, action, pigments)?;
            return Ok(Some(PerSurface::default()));
        }
        let on = action.surfaces();
        let on = PerSurface::from_fn(|at| on[at] && self.painting(at).is_some());
        if let ActionPigments::Palette(slots) = pigments {
            self.wash_replaced_brushes()?;
            // The palette may refuse the pigments, which must not change the canvas.
            let pigments: Vec<PigmentId> = slots.iter().flatten().copied().collect();
            self.palette.as_mut().map(|palette| palette.slots_with(&pigments)).transpose()?;
        }
        let mut done = false;
        for surface in SurfaceId::ALL.into_iter().filter(|surface| on[*surface]) {
            match (action, surface, &mut self.palette) {
                // Both surfaces share one light.
                (Action::Light(_), SurfaceId::Palette, Some(palette)) => {
                    palette.relight_as(&self.canvas)?;
                }
                _ => done |= self.surface_mut(surface)?.change(action, pigments)?,
            }
        }
        Ok(done.then_some(on))
    }

    /// Changes the paint on a brush, on the surface that holds it. A brush that is used for
    /// the first time is added to the painting and the recording even if the change fails.
    fn change_brush(
        &mut self,
        name: &str,
        action: &Action,
        pigments: &ActionPigments,
    ) -> Result<(), PaintingError> {
        if let ActionPigments::Recipe(parts) = pigments {
            self.canvas.recipe(parts)?;
        }
        let tool = self.tool(name)?;
        let at = self.brushes.tools[tool].at;
        let fresh = self.brushes.tools[tool].ids[at].is_none();
        let id = self.brush_id(tool, at)?;
        let changed = self.surface_mut(at)?.change_brush(id, action, pigments);
        if changed.is_err() && fresh {
            self.note(Action::Wash { brush: name.to_owned() });
        }
        changed
    }

    /// Washes heads whose name now belongs to another head. They were washed when they were
    /// replaced, but an undo may have restored paint on them.
    fn wash_replaced_brushes(&mut self) -> Result<(), PaintingError> {
        for tool in self.brushes.replaced() {
            let at = self.brushes.tools[tool].at;
            let Some(id) = self.brushes.tools[tool].ids[at] else { continue };
            let painting = self.surface_mut(at)?;
            if painting.brush_paint(id)?.totals().iter().any(|total| *total > 0) {
                painting.wash(id)?;
                let brush = self.brushes.tools[tool].name.clone();
                self.note_with(Action::Wash { brush }, Some(tool));
            }
        }
        Ok(())
    }

    /// Id of a head in the painting of a surface. It is added there if it is new.
    pub(super) fn brush_id(
        &mut self,
        tool: usize,
        on: SurfaceId,
    ) -> Result<BrushId, PaintingError> {
        if let Some(id) = self.brushes.tools[tool].ids[on] {
            return Ok(id);
        }
        let spec = self.brushes.tools[tool].spec.clone();
        let id = self.surface_mut(on)?.add_brush(spec.shape, spec.size_mm)?;
        self.brushes.tools[tool].ids[on] = Some(id);
        Ok(id)
    }

    /// Adds an action that was done to the history of the surfaces that it changed, with the brush
    /// that it moved, and to the recording.
    pub(super) fn record_done(
        &mut self,
        action: Action,
        pigments: &ActionPigments,
        label: String,
        (on, carried): (PerSurface<bool>, Option<Carried>),
    ) {
        if on != PerSurface::default() {
            self.history.add(label, on, carried);
            self.limit_history();
        }
        self.scope.add_palette_of(&action, pigments);
        self.note(self.with_library_names(action, pigments));
    }

    /// Adds an action to the recording.
    pub(super) fn note(&mut self, action: Action) {
        let tool = action.brush().and_then(|name| self.brushes.find(name));
        self.note_with(action, tool);
    }

    /// Adds an action of the head `tool` to the recording, under the recorded name of the head.
    pub(super) fn note_with(&mut self, mut action: Action, tool: Option<usize>) {
        let Some(record) = &mut self.record else { return };
        let tool = tool.map(|tool| &self.brushes.tools[tool]);
        if let (Some(name), Some(tool)) = (action.brush_mut(), tool) {
            name.clone_from(&tool.recorded);
        }
        record.add(action, tool.map(|tool| (tool.recorded.as_str(), &tool.spec)));
    }

    /// The action with short names of pigments replaced by the names of the library, which do
    /// not depend on the palette.
    fn with_library_names(&self, action: Action, pigments: &ActionPigments) -> Action {
        let library = self.canvas.library();
        let name = |pigment: PigmentId| library[pigment].name.clone();
        let recipe = |parts: &[(PigmentId, f64)]| -> Recipe {
            parts.iter().map(|(pigment, part)| (name(*pigment), *part)).collect()
        };
        match (action, pigments) {
            (Action::Load(load), ActionPigments::Recipe(parts)) => {
                Action::Load(Load { recipe: recipe(parts), ..load })
            }
            (Action::Squeeze(squeeze), ActionPigments::Recipe(parts)) => {
                Action::Squeeze(Squeeze { recipe: recipe(parts), ..squeeze })
            }
            (Action::Palette(_), ActionPigments::Palette(slots)) => {
                let pigments = slots.iter().flatten().map(|&pigment| (None, name(pigment)));
                Action::Palette(PaletteSpec { pigments: pigments.collect() })
            }
            (Action::Swap { layer, .. }, ActionPigments::Swap { from, to }) => {
                Action::Swap { layer, from: name(*from), to: name(*to) }
            }
            (action, _) => action,
        }
    }
}

impl PaintingSession {
    /// Sets a brush down on a surface. Samples follow. Any open stroke or adjustment is
    /// finished first. Samples are rounded to [`SampleDecimals::RECORDING`].
    ///
    /// # Errors
    /// [`PaintingError`] if there is no such brush or surface, or if the device was lost.
    pub fn begin_stroke(&mut self, on: SurfaceId, brush: &str) -> Result<(), PaintingError> {
        self.begin_stroke_as(StrokeTool::Paint, on, brush, SampleDecimals::RECORDING)
    }

    /// Sets the head of a brush down as `tool`, like [`PaintingSession::begin_stroke`], for samples
    /// that are rounded to `decimals`, at most the decimals of a recording. The number of the tool
    /// is rounded to six digits.
    ///
    /// # Errors
    /// [`PaintingError`] if there is no such brush or surface, if the number of the tool is out of
    /// range, or if the device was lost.
    pub fn begin_stroke_as(
        &mut self,
        tool: StrokeTool,
        on: SurfaceId,
        brush: &str,
        decimals: SampleDecimals,
    ) -> Result<(), PaintingError> {
        let tool = tool.map(six_digits);
        check_tool(&CheckContext::default(), tool)?;
        self.finish_open()?;
        self.surface_mut(on)?;
        let size_mm = self.brushes.tools[self.tool(brush)?].spec.size_mm;
        let stroke = Stroke { brush: brush.to_owned(), on, tool, samples: Vec::new() };
        self.stroke = Some(OpenStroke::new(self.canvas.cell_mm(), size_mm, stroke, decimals)?);
        Ok(())
    }

    /// Index of the head that has a name now.
    pub(super) fn tool(&self, brush: &str) -> Result<usize, PaintingError> {
        let names = self.brushes.named_heads().map(|(name, _)| name);
        let found = self.brushes.find(brush);
        Ok(found.ok_or_else(|| unknown_brush(&CheckContext::default(), brush, names))?)
    }

    /// Rounds samples and adds them to the open stroke. [`PaintingSession::advance`] paints them.
    /// If we refuse a sample, the samples before it count, and the stroke stays open.
    ///
    /// # Errors
    /// [`PaintingError`] for an impossible sample (its index counts from the first of the
    /// stroke), if no stroke is open or it was lifted, and if the device was lost.
    pub fn extend(&mut self, samples: &[Sample]) -> Result<(), PaintingError> {
        let surfaces = self.surfaces();
        for sample in samples {
            let open = self.stroke.as_mut().filter(|open| !open.is_lifted());
            let open = open.ok_or(PaintingError::NoStroke)?;
            let Stroke { on, samples: before, .. } = open.stroke();
            let at = CheckContext::default().sample(before.len());
            let far_mm = surfaces.reach_mm(&at, *on)?;
            let before = before.last().map_or(0.0, |sample| sample.seconds);
            let sample = open.decimals.round(sample);
            check_sample(&at, &sample, before, far_mm)?;
            open.extend(&[sample])?;
            // A stroke becomes an action with its first sample.
            if !open.is_open() {
                let opened = self.open_in_painting();
                self.follow_failure(opened)?;
            }
        }
        Ok(())
    }

    /// Opens the stroke in its painting, and moves the brush there with its paint.
    fn open_in_painting(&mut self) -> Result<(), PaintingError> {
        let Stroke { brush, on, .. } =
            self.stroke.as_ref().ok_or(PaintingError::NoStroke)?.stroke();
        let on = *on;
        let tool = self.tool(brush)?;
        let from = self.brushes.tools[tool].at;
        let id = self.brush_id(tool, on)?;
        let paint = if from == on {
            None
        } else {
            let away = self.brush_id(tool, from)?;
            Some(self.surface_mut(from)?.take_brush_paint(away)?)
        };
        let (open, painting) = self.stroke_and_painting()?;
        open.open(painting, id, paint.as_ref())?;
        open.from = from;
        self.brushes.tools[tool].at = on;
        Ok(())
    }

    /// The open stroke and the painting that it is on.
    fn stroke_and_painting(&mut self) -> Result<(&mut OpenStroke, &mut Painting), PaintingError> {
        let open = self.stroke.as_mut().ok_or(PaintingError::NoStroke)?;
        let painting = match (open.stroke().on, &mut self.palette) {
            (SurfaceId::Palette, Some(palette)) => palette,
            _ => &mut self.canvas,
        };
        Ok((open, painting))
    }

    /// Paints at most `most_substeps` sub-steps of the open stroke, and returns the number
    /// of known sub-steps that remain. The paint lags one sample behind until the brush is
    /// lifted. With `most_substeps` 0 it only counts.
    ///
    /// # Errors
    /// [`PaintingError`] if no stroke is open, or if the device was lost.
    pub fn advance(&mut self, most_substeps: usize) -> Result<usize, PaintingError> {
        let (open, painting) = self.stroke_and_painting()?;
        let waiting = open.advance(painting, most_substeps);
        self.follow_failure(waiting)
    }

    /// Lifts the brush: no more samples come, so that [`PaintingSession::advance`] can paint
    /// up to the last one.
    ///
    /// # Errors
    /// [`PaintingError::NoStroke`] if no stroke is open.
    pub fn lift(&mut self) -> Result<(), PaintingError> {
        self.stroke.as_mut().ok_or(PaintingError::NoStroke)?.lift();
        Ok(())
    }

    /// The open stroke, if one is open.
    #[must_use]
    pub fn open_stroke(&self) -> Option<&OpenStroke> {
        self.stroke.as_ref()
    }

    /// Paints a whole stroke. If it is `cut`, we do not lift the brush at its end. We refuse a
    /// stroke that is too long before we paint any of it.
    pub(super) fn apply_stroke(
        &mut self,
        Stroke { brush, on, tool, samples }: &Stroke,
        cut: bool,
    ) -> Result<Option<StrokeReport>, PaintingError> {
        let samples: Vec<_> =
            samples.iter().map(|sample| SampleDecimals::RECORDING.round(sample)).collect();
        let size_mm = self.brushes.tools[self.tool(brush)?].spec.size_mm;
        let mut path = Path::new(self.canvas.cell_mm(), size_mm)?;
        samples.iter().try_for_each(|sample| path.push(sample))?;
        self.begin_stroke_as(*tool, *on, brush, SampleDecimals::RECORDING)?;
        let extended = self.extend(&samples);
        let report = self.close_stroke(cut)?;
        extended?;
        Ok(report)
    }

    /// An action that paints what we have painted of the open stroke so far. Call this when no
    /// known sample waits (see [`PaintingSession::advance`]). It has the recorded name of the
    /// brush. `None` if the stroke has no sample.
    pub(super) fn cut_so_far(&self) -> Option<Action> {
        let mut stroke = self.stroke.as_ref().filter(|open| open.is_open())?.stroke().clone();
        let tool = self.brushes.find(&stroke.brush)?;
        stroke.brush.clone_from(&self.brushes.tools[tool].recorded);
        Some(Action::Cut(stroke))
    }

    /// Paints the rest of the open stroke and closes it, as one action. Returns `None` if it
    /// had no sample.
    ///
    /// # Errors
    /// [`PaintingError`] if no stroke is open, or if the device was lost.
    pub fn end_stroke(&mut self) -> Result<Option<StrokeReport>, PaintingError> {
        self.close_stroke(false)
    }

    fn close_stroke(&mut self, cut: bool) -> Result<Option<StrokeReport>, PaintingError> {
        let open = self.stroke.take().ok_or(PaintingError::NoStroke)?;
        if !open.is_open() {
            return Ok(None);
        }
        let from = open.from;
        let on = open.stroke().on;
        let (stroke, finished) = open.end(self.surface_mut(on)?, !cut);
        let report = self.follow_failure(finished)?;
        let tool = self.tool(&stroke.brush)?;
        let action = if cut { Action::Cut(stroke) } else { Action::Stroke(stroke) };
        let touched = PerSurface::from_fn(|surface| surface == on || surface == from);
        let carried = Some(Carried { tool, from, to: on });
        let label = self.label(&action, &ActionPigments::None);
        self.record_done(action, &ActionPigments::None, label, (touched, carried));
        Ok(Some(report))
    }
}

impl Control {
    fn of(action: &Action) -> Result<Self, PaintingError> {
        match action {
            Action::Light(_) => Ok(Self::Light),
            Action::Gloss { .. } => Ok(Self::Gloss),
            Action::Stiffness { .. } => Ok(Self::Stiffness),
            Action::Opacity { layer, .. } => Ok(Self::Opacity(*layer)),
            _ => Err(PaintingError::NoControl(action.kind())),
        }
    }
}

impl PaintingSession {
    /// Applies an action of light, gloss, stiffness or opacity while its slider is dragged. All
    /// changes of one property until [`PaintingSession::end_adjustment`] count as one action,
    /// which is recorded with its last values. A change of another property begins another
    /// action.
    ///
    /// # Errors
    /// [`PaintingError`] for other actions, and the errors of [`PaintingSession::apply`].
    pub fn adjust(&mut self, action: &Action) -> Result<(), PaintingError> {
        let control = Control::of(action)?;
        if self.adjusting.as_ref().is_none_or(|adjusting| adjusting.control != control) {
            self.finish_open()?;
        }
        let (action, pigments) = self.rounded(action)?;
        if self.adjusting.is_none() {
            self.paintings_mut().for_each(Painting::begin_adjusting);
        }
        match self.perform(&action, &pigments) {
            Ok(changed) => {
                let changed = changed.unwrap_or_default();
                self.adjusting = Some(Adjusting { control, action, changed });
                Ok(())
            }
            Err(error) => {
                if self.adjusting.is_none() {
                    self.end_adjusting();
                }
                Err(error)
            }
        }
    }

    /// Ends the open adjustment. Does nothing if none is open.
    pub fn end_adjustment(&mut self) {
        let Some(Adjusting { action, changed, .. }) = self.adjusting.take() else { return };
        self.end_adjusting();
        let label = self.label(&action, &ActionPigments::None);
        self.record_done(action, &ActionPigments::None, label, (changed, None));
    }

    /// Finishes the open stroke or adjustment, if there is one.
    pub(crate) fn finish_open(&mut self) -> Result<(), PaintingError> {
        self.end_adjustment();
        if self.stroke.is_some() {
            self.end_stroke()?;
        }
        Ok(())
    }

    fn end_adjusting(&mut self) {
        self.paintings_mut().for_each(Painting::end_adjusting);
    }
}

/// We reserve one part in this many of the memory for the surface that uses less of it.
const RESERVED: u64 = 8;

impl PaintingSession {
    /// Undoes the last action on either surface. Returns whether there was one. An open stroke
    /// or adjustment is finished first, and is then the last action.
    ///
    /// # Errors
    /// [`PaintingError`] if the device was lost.
    pub fn undo(&mut self) -> Result<bool, PaintingError> {
        self.finish_open()?;
        let Some(entry) = self.history.done.pop_back() else { return Ok(false) };
        let exchanged = self.exchange(&entry, Painting::undo);
        self.follow_failure(exchanged)?;
        if let Some(carried) = entry.carried {
            self.brushes.tools[carried.tool].at = carried.from;
        }
        self.history.undone.push_back(entry);
        self.limit_history();
        self.note(Action::Undo {});
        Ok(true)
    }

    /// Repeats the action that was undone last. Returns whether there was one.
    ///
    /// # Errors
    /// [`PaintingError`] if the device was lost.
    pub fn redo(&mut self) -> Result<bool, PaintingError> {
        self.finish_open()?;
        let Some(entry) = self.history.undone.pop_back() else { return Ok(false) };
        let exchanged = self.exchange(&entry, Painting::redo);
        self.follow_failure(exchanged)?;
        if let Some(carried) = entry.carried {
            self.brushes.tools[carried.tool].at = carried.to;
        }
        self.history.done.push_back(entry);
        self.limit_history();
        self.note(Action::Redo {});
        Ok(true)
    }

    /// Undoes or repeats actions until `done` actions of [`PaintingSession::history`] are done,
    /// or as near as can be reached.
    ///
    /// # Errors
    /// [`PaintingError`] if the device was lost.
    pub fn go_to(&mut self, done: usize) -> Result<(), PaintingError> {
        self.finish_open()?;
        let (_, now) = self.history();
        for _ in done..now {
            self.undo()?;
        }
        for _ in now..done {
            if !self.redo()? {
                break;
            }
        }
        Ok(())
    }

    /// Labels of all actions, the oldest first, and the number of those that are done. The
    /// others were undone. Actions that can no longer be reached are left out.
    #[must_use]
    pub fn history(&self) -> (Vec<&str>, usize) {
        (self.history.labels(), self.history.done.len())
    }

    /// Number of the state before the actions of [`PaintingSession::history`], then of the state
    /// after each. Each action of the session has a number of its own, rising from 1, which it
    /// keeps while others are dropped. The state before the first has 0.
    #[must_use]
    pub fn history_numbers(&self) -> Vec<u64> {
        self.history.numbers()
    }

    /// Memory that undo takes now, and its limit, both in bytes for both surfaces.
    #[must_use]
    pub fn undo_bytes(&self) -> (u64, u64) {
        let used = PerSurface::from_fn(|surface| self.used_bytes(surface));
        (used.iter().sum(), self.undo_limit)
    }

    /// Sets the limit of the memory for undo, in bytes, which canvas and palette share: each may
    /// take what the other leaves, except for an eighth. Actions that do not fit are dropped.
    pub fn set_undo_bytes(&mut self, bytes: u64) {
        self.undo_limit = bytes;
        self.limit_history();
    }

    /// Drops the actions that you can no longer reach: done ones before an action that a painting
    /// has dropped, and undone ones after such an action. Then divides the memory anew.
    pub(super) fn limit_history(&mut self) {
        self.drop_unreachable();
        let reserved = if self.palette.is_some() { self.undo_limit / RESERVED } else { 0 };
        let canvas = self.used_bytes(SurfaceId::Canvas);
        let palette = self.used_bytes(SurfaceId::Palette);
        let for_canvas = self.undo_limit.saturating_sub(palette.max(reserved));
        let for_palette = self.undo_limit.saturating_sub(canvas.max(reserved));
        self.canvas.set_undo_bytes(for_canvas);
        if let Some(palette) = &mut self.palette {
            palette.set_undo_bytes(for_palette);
        }
        self.drop_unreachable();
    }

    fn drop_unreachable(&mut self) {
        let count = |of: fn(&Painting) -> usize| {
            PerSurface::from_fn(|surface| self.painting(surface).map_or(0, of))
        };
        let undo = count(Painting::undo_count);
        let redo = count(Painting::redo_count);
        self.history.limit_to(undo, redo);
        if self.stroke.is_some() {
            // The move of its brush is in a painting's history already, and in this one later.
            return;
        }
        let (undo, redo) = self.history.counts();
        for surface in SurfaceId::ALL {
            if let Some(painting) = self.painting_mut(surface) {
                painting.keep_actions(undo[surface], redo[surface]);
            }
        }
    }

    fn used_bytes(&self, surface: SurfaceId) -> u64 {
        self.painting(surface).map_or(0, |painting| painting.undo_bytes().0)
    }

    /// Undoes or repeats an action on the surfaces whose histories have it.
    fn exchange(
        &mut self,
        entry: &Entry,
        exchange: impl Fn(&mut Painting) -> Result<bool, PaintingError>,
    ) -> Result<(), PaintingError> {
        for surface in SurfaceId::ALL {
            if entry.changed[surface] {
                let done = exchange(self.surface_mut(surface)?)?;
                assert!(done, "the history of the painting has `{}`", entry.label);
            }
        }
        Ok(())
    }
}
