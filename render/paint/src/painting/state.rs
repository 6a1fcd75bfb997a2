//! A painting while it is worked on: its state and paint, its pictures, and undo and redo.

use std::sync::Arc;

use graphics::field::Field;
use graphics::tile::{Rect, TileSet};
use pigment::library::PigmentLibrary;

use super::failure::PaintingError;
use super::views::{SECOND, Views, view};
use crate::amount::{MAX_COLUMN, mm_from_quanta};
use crate::brush::{Head, Relief};
use crate::document::{Document, DryLayer, LayerId, Lighting, Medium, Slots};
use crate::engine::{BrushId, PaintEngine, View};
use crate::ground::Ground;
use crate::history::{History, Restored};
use crate::layer::{DryLayerState, Layer, SLOTS, distinct_ids};
use crate::light::Light;
use crate::mask::Mask;
use crate::motion::MotionConstants;
use crate::optics::Scene;
use crate::scene::{Appearance, PixelsPerCell, SpectralStack, fine_picture};

/// Properties of a painting besides its paint. An undo restores them with the paint.
#[derive(Debug, Clone, PartialEq)]
pub struct State {
    /// Pigment of each slot of the wet layer.
    pub slots: Slots,
    /// The dry layers, lowest first.
    pub dry: Vec<DryLayerState>,
    /// Identity of the next dry layer.
    pub next_layer: LayerId,
    /// Light that the painting is shown under.
    pub lighting: Lighting,
    /// Scattering per mm, stiffness and gloss of the binder.
    pub medium: Medium,
}

/// A brush of a painting.
#[derive(Debug)]
pub struct Brush {
    pub(super) id: BrushId,
    pub(super) head: Head,
    /// Columns and rows of the paint on the head.
    pub(super) cells: (usize, usize),
}

/// State that an undo restores besides paint.
#[derive(Debug, Clone)]
pub(super) struct UndoState {
    pub(super) state: State,
    pub(super) light: Arc<Light>,
    /// Number of brushes when this state was saved.
    pub(super) brushes: usize,
    pub(super) mask: Option<Arc<Mask>>,
}

/// Progress of an open adjustment.
#[derive(Debug, Clone, Copy)]
pub(super) enum Adjusting {
    /// Nothing was changed yet, and no action is open in the history.
    Unchanged,
    /// The changes so far are an open action of the history.
    Changed,
}

/// A painting while it is worked on: wet and dry paint, brushes, lights and undo.
#[derive(Debug)]
pub struct Painting {
    pub(super) title: String,
    pub(super) cell_mm: f64,
    pub(super) ground: Ground,
    pub(super) library: PigmentLibrary,
    pub(super) engine: PaintEngine,
    pub(super) state: State,
    pub(super) light: Arc<Light>,
    pub(super) relief: Relief,
    /// Number of times that `relief` was recomputed after dry paint changed.
    pub(super) dry_changes: u64,
    pub(super) brushes: Vec<Brush>,
    pub(super) history: History<UndoState>,
    /// Covered cells. See [`Painting::change_mask`].
    pub(super) mask: Option<Arc<Mask>>,
    /// Brush of the open stroke, if one is open.
    pub(super) stroke_brush: Option<BrushId>,
    /// The open adjustment, if one is open.
    pub(super) adjusting: Option<Adjusting>,
    /// Parts of the pictures that are out of date.
    pub(super) views: Views,
}

/// Maximum height of ground and dry paint together, and of wet paint on them, in quanta:
/// 256 cell widths each, so that no sum overflows 32 bits.
pub(super) const HIGHEST: u32 = MAX_COLUMN / 2;

/// Default of the memory for undo, in bytes: 512 MiB.
pub const UNDO_BYTES: u64 = 512 << 20;

impl Painting {
    /// Opens the painting of `document` on `engine`, which must have been made for its
    /// ground and hold no paint. Undo keeps at most `undo_bytes`.
    ///
    /// # Errors
    /// [`PaintingError`] if the light is unknown, if paint is piled too high, or if the
    /// memory of the device does not suffice.
    pub fn open(
        document: Document,
        engine: PaintEngine,
        undo_bytes: u64,
    ) -> Result<Self, PaintingError> {
        let Lighting { illuminant, observer, .. } = &document.lighting;
        let light = Light::named(&document.library, illuminant, observer)?;
        Self::open_under(document, light, engine, undo_bytes)
    }

    /// Opens the painting of `document` under a light that was made for its library, such as
    /// a measured one, in place of the light that the document names.
    ///
    /// # Errors
    /// [`PaintingError`] if paint is piled too high, or if the memory of the device does not
    /// suffice.
    pub fn open_under(
        document: Document,
        light: impl Into<Arc<Light>>,
        mut engine: PaintEngine,
        undo_bytes: u64,
    ) -> Result<Self, PaintingError> {
        check_heights(&document)?;
        let Document { title, cell_mm, ground, library, medium, mut dry, slots, .. } = document;
        let wet = document.wet;
        let lighting = document.lighting;
        let ids = dry.iter_mut().map(|layer| &mut layer.id);
        let next_layer = distinct_ids(ids, document.next_layer);
        let mut states = Vec::with_capacity(dry.len());
        for DryLayer { id, name, visible, slots, opacity, paint } in dry {
            engine.push_dry_layer(&paint)?;
            states.push(DryLayerState { id, name, visible, slots, opacity });
        }
        engine.set_wet(&wet)?;
        let relief = Relief::from_floor(&engine.floor()?, cell_mm);
        let views = Views::new(engine.bounds(), cell_mm);
        Ok(Self {
            title,
            cell_mm,
            ground,
            library,
            engine,
            state: State { slots, dry: states, next_layer, lighting, medium },
            light: light.into(),
            relief,
            dry_changes: 0,
            brushes: Vec::new(),
            history: History::new(undo_bytes),
            mask: None,
            stroke_brush: None,
            adjusting: None,
            views,
        })
    }

    /// The painting with all its paint, as a file stores it.
    ///
    /// # Errors
    /// [`PaintingError`] if the device was lost.
    pub fn document(&mut self) -> Result<Document, PaintingError> {
        let mut dry = Vec::with_capacity(self.state.dry.len());
        for (index, state) in self.state.dry.iter().enumerate() {
            let paint = self.engine.dry_layer(index)?;
            let DryLayerState { id, name, visible, slots, opacity } = state.clone();
            dry.push(DryLayer { id, name, visible, slots, opacity, paint });
        }
        Ok(Document {
            title: self.title.clone(),
            cell_mm: self.cell_mm,
            ground: self.ground.clone(),
            library: self.library.clone(),
            medium: self.state.medium.clone(),
            dry,
            next_layer: self.state.next_layer,
            slots: self.state.slots,
            wet: self.engine.wet()?,
            lighting: self.state.lighting.clone(),
        })
    }

    /// Rectangle of all cells of the canvas.
    #[must_use]
    pub fn bounds(&self) -> Rect {
        self.engine.bounds()
    }

    /// Width and height of a cell in mm.
    #[must_use]
    pub fn cell_mm(&self) -> f64 {
        self.cell_mm
    }

    /// Properties besides paint.
    #[must_use]
    pub fn state(&self) -> &State {
        &self.state
    }

    /// Library that the slots refer to.
    #[must_use]
    pub fn library(&self) -> &PigmentLibrary {
        &self.library
    }

    /// Title of the painting.
    #[must_use]
    pub fn title(&self) -> &str {
        &self.title
    }

    /// Light that the picture is computed for.
    #[must_use]
    pub fn light(&self) -> &Arc<Light> {
        &self.light
    }

    /// Counter of changes of dry paint, including undo. While it stays the same, so does the
    /// paint of the dry layers.
    #[must_use]
    pub fn dry_changes(&self) -> u64 {
        self.dry_changes
    }

    /// Scattering per mm, stiffness and gloss of the binder.
    #[must_use]
    pub fn medium(&self) -> &Medium {
        &self.state.medium
    }

    /// Constants of motion of the wet paint.
    pub(super) fn motion(&self) -> MotionConstants {
        MotionConstants::new(self.cell_mm, self.state.medium.stiffness)
    }

    /// Relief and reflectance under the paint.
    #[must_use]
    pub fn ground(&self) -> &Ground {
        &self.ground
    }

    /// Name of the backend: the processor or a graphics device.
    #[must_use]
    pub fn backend(&self) -> String {
        self.engine.name()
    }

    /// Name of the device that computes the light. Pictures of two devices may differ in their last digits. On
    /// the processor the number of threads changes nothing, so the name does not hold it.
    pub(crate) fn device_name(&self) -> String {
        self.engine.device_name()
    }

    /// Wet paint on the canvas and on all brushes: the height in mm of each slot and, last, of
    /// the vehicle, summed over cells.
    ///
    /// # Errors
    /// [`PaintingError`] if the device was lost.
    pub fn wet_totals_mm(&mut self) -> Result<[f64; SLOTS + 1], PaintingError> {
        let mut totals = self.engine.wet()?.totals();
        for brush in &self.brushes {
            for (total, more) in totals.iter_mut().zip(self.engine.brush_paint(brush.id)?.totals())
            {
                *total += more;
            }
        }
        Ok(totals.map(|quanta| quanta as f64 * mm_from_quanta(1, self.cell_mm)))
    }

    /// Wet paint of the whole canvas.
    ///
    /// # Errors
    /// [`PaintingError`] if the device was lost.
    pub fn wet(&mut self) -> Result<Layer, PaintingError> {
        Ok(self.engine.wet()?)
    }

    /// Wet paint in `rect`. Only these cells are read from the device.
    ///
    /// # Errors
    /// [`PaintingError`] if the device was lost.
    ///
    /// # Panics
    /// If `rect` is not within the canvas.
    pub fn wet_in(&mut self, rect: Rect) -> Result<Layer, PaintingError> {
        Ok(self.engine.wet_in(rect)?)
    }

    /// Paint of the dry layer `index` (0 is the lowest) in `rect`. Only these cells are read
    /// from the device.
    ///
    /// # Errors
    /// [`PaintingError`] if there is no such layer, or if the device was lost.
    ///
    /// # Panics
    /// If `rect` is not within the canvas.
    pub fn dry_in(&mut self, index: usize, rect: Rect) -> Result<Layer, PaintingError> {
        let count = self.state.dry.len();
        if index >= count {
            return Err(PaintingError::NoLayer { index, count });
        }
        Ok(self.engine.dry_layer_in(index, rect)?)
    }
}

/// Refuses paint higher than [`HIGHEST`].
fn check_heights(document: &Document) -> Result<(), PaintingError> {
    let width = document.wet.width();
    let lowest = -i64::from(HIGHEST);
    for (index, &ground) in document.ground.height.values().iter().enumerate() {
        let dry = document.dry.iter().map(|layer| i64::from(layer.paint.cell(index).volume()));
        let floor = i64::from(ground) + dry.sum::<i64>();
        let wet = document.wet.cell(index).volume();
        if !(lowest..=i64::from(HIGHEST)).contains(&floor) || wet > HIGHEST {
            return Err(PaintingError::TooHigh { x: index % width, y: index / width });
        }
    }
    Ok(())
}

impl Painting {
    /// Renders the parts of the picture that are out of date, and returns the tiles rendered since
    /// the last call. If `second` is true, this is the picture under the second light.
    ///
    /// # Errors
    /// [`PaintingError`] if the device was lost, or its memory does not suffice for a second
    /// picture.
    ///
    /// # Panics
    /// With `second`, if there is no second light.
    pub fn refresh(&mut self, second: bool) -> Result<TileSet, PaintingError> {
        let view = view(second);
        let scene = self.scene(view);
        self.views.render(&mut self.engine, view, &scene)?;
        Ok(self.views.pending_of(view).unreported.take())
    }

    /// The picture in `rect` as last rendered, in linear sRGB. With `second`, the picture
    /// under the second light. Only these cells are read from the device.
    ///
    /// # Errors
    /// [`PaintingError`] if the device was lost.
    ///
    /// # Panics
    /// If `rect` is not within the canvas or, with `second`, if there is no second light.
    pub fn picture_in(
        &mut self,
        second: bool,
        rect: Rect,
    ) -> Result<Field<[f32; 4]>, PaintingError> {
        assert!(!second || self.views.second.is_some(), "{SECOND}");
        Ok(self.engine.picture_in(view(second), rect)?)
    }

    /// The picture in linear sRGB, white at 1. Only the parts that are out of date are
    /// rendered.
    ///
    /// # Errors
    /// [`PaintingError`] if the device was lost.
    pub fn picture(&mut self) -> Result<Field<[f32; 4]>, PaintingError> {
        let scene = self.scene(View::First);
        self.views.render(&mut self.engine, View::First, &scene)?;
        Ok(self.engine.picture()?)
    }

    /// The picture in linear sRGB with several pixels a cell, see [`fine_picture`]. With one
    /// pixel a cell it is [`Painting::picture`].
    ///
    /// # Errors
    /// [`PaintingError`] if the device was lost.
    pub fn fine_picture(
        &mut self,
        pixels: PixelsPerCell,
    ) -> Result<Field<[f32; 4]>, PaintingError> {
        if pixels == PixelsPerCell::default() {
            return self.picture();
        }
        let scene = self.scene(View::First);
        Ok(fine_picture(&self.document()?, &scene, pixels))
    }

    /// The picture in linear sRGB without shading of the relief and without gloss.
    ///
    /// # Errors
    /// [`PaintingError`] if the device was lost.
    pub fn flat_picture(&mut self) -> Result<Field<[f32; 4]>, PaintingError> {
        let mut scene = self.scene(View::First);
        let lamp = &mut scene.lamp;
        lamp.relief = 0.0;
        for gloss in [&mut lamp.wet, &mut lamp.dry, &mut lamp.ground] {
            gloss.strength = 0.0;
        }
        let all = TileSet::all(self.engine.bounds());
        self.views.first.wet = all.clone();
        let rendered = self.views.render(&mut self.engine, View::First, &scene);
        self.views.first.wet = all;
        rendered?;
        Ok(self.engine.picture()?)
    }

    /// Mean reflectance of the cells of `rect` on the grid of the library, as an instrument
    /// would measure it: in f64, without relief and gloss.
    ///
    /// # Errors
    /// [`PaintingError`] if the device was lost.
    ///
    /// # Panics
    /// If `rect` is empty or not within the canvas.
    pub fn reflectance_in(&mut self, rect: Rect) -> Result<Vec<f64>, PaintingError> {
        assert!(!rect.is_empty(), "a reflectance of no cells");
        let dry = (0..self.state.dry.len()).map(|index| self.engine.dry_layer_in(index, rect));
        let mut layers = dry.collect::<Result<Vec<_>, _>>()?;
        layers.push(self.engine.wet_in(rect)?);
        let dry = self.dry_states();
        let stack = SpectralStack::full(&self.appearance(&dry, &self.state.lighting));
        let cells = rect.width * rect.height;
        let mut mean = vec![0.0; stack.count()];
        for index in 0..cells {
            let films = layers.iter().map(|layer| layer.films(index));
            for (mean, one) in mean.iter_mut().zip(stack.measured_reflectance(films)) {
                *mean += one / cells as f64;
            }
        }
        Ok(mean)
    }

    fn dry_states(&self) -> Vec<(Slots, f64)> {
        self.state.dry.iter().map(|dry| (dry.slots, dry.shown_opacity())).collect()
    }

    fn appearance<'a>(&'a self, dry: &'a [(Slots, f64)], lighting: &'a Lighting) -> Appearance<'a> {
        Appearance {
            library: &self.library,
            medium: &self.state.medium,
            ground: &self.ground,
            cell_mm: self.cell_mm,
            dry,
            slots: &self.state.slots,
            lighting,
        }
    }

    fn scene(&self, view: View) -> Scene {
        let (lighting, light) = match (view, &self.views.second) {
            (View::First, _) => (&self.state.lighting, &self.light),
            (View::Second, second) => {
                let second = second.as_ref().expect(SECOND);
                (&second.lighting, &second.light)
            }
        };
        self.appearance(&self.dry_states(), lighting).scene(light)
    }
}

impl Painting {
    /// Undoes the last action. Returns whether there was one.
    ///
    /// Loading, wiping and washing are not actions of their own: the undo of a stroke
    /// restores the paint that its brush held before. If the undo changes the palette,
    /// brushes that were added since are washed, as their paint is of the other palette.
    ///
    /// # Errors
    /// [`PaintingError`] if the device was lost.
    ///
    /// # Panics
    /// If a stroke or an adjustment is open.
    pub fn undo(&mut self) -> Result<bool, PaintingError> {
        self.assert_idle("an undo");
        let now = self.undo_state();
        match self.history.undo(&mut self.engine, now)? {
            Some(restored) => self.restore(restored).map(|()| true),
            None => Ok(false),
        }
    }

    /// Repeats the action that was undone last. Returns whether there was one.
    ///
    /// # Errors
    /// [`PaintingError`] if the device was lost.
    ///
    /// # Panics
    /// If a stroke or an adjustment is open.
    pub fn redo(&mut self) -> Result<bool, PaintingError> {
        self.assert_idle("a redo");
        let now = self.undo_state();
        match self.history.redo(&mut self.engine, now)? {
            Some(restored) => self.restore(restored).map(|()| true),
            None => Ok(false),
        }
    }

    /// Begins an adjustment, for example when a slider is dragged. All actions until
    /// [`Painting::end_adjusting`] count as one action in the history, but each takes effect at
    /// once. If there are none, the history stays as it is.
    ///
    /// # Panics
    /// If a stroke or an adjustment is open.
    pub fn begin_adjusting(&mut self) {
        self.assert_idle("an adjustment");
        self.adjusting = Some(Adjusting::Unchanged);
    }

    /// Ends the adjustment.
    ///
    /// # Panics
    /// If none is open.
    pub fn end_adjusting(&mut self) {
        if let Adjusting::Changed = self.adjusting.take().expect("an adjustment is open") {
            self.history.commit();
        }
    }

    /// Number of actions that can be undone.
    #[must_use]
    pub fn undo_count(&self) -> usize {
        self.history.undo_count()
    }

    /// Number of actions that can be repeated.
    #[must_use]
    pub fn redo_count(&self) -> usize {
        self.history.redo_count()
    }

    /// Memory that undo takes now, and its limit, both in bytes.
    #[must_use]
    pub fn undo_bytes(&self) -> (u64, u64) {
        (self.history.bytes(), self.history.limit_bytes())
    }

    /// Sets the limit of the memory for undo, in bytes. The actions furthest from the present
    /// are dropped until the rest fits.
    pub fn set_undo_bytes(&mut self, limit: u64) {
        self.history.set_limit_bytes(limit);
    }

    /// Forgets all but the last `undo` actions that can be undone, and all but the next `redo`
    /// that can be repeated, to use their memory for others.
    pub(crate) fn keep_actions(&mut self, undo: usize, redo: usize) {
        self.history.keep_only(undo, redo);
    }

    /// Applies `change` as one action of the history, or as part of the open adjustment. A
    /// change that fails half way can be undone as well.
    ///
    /// # Panics
    /// If a stroke is open.
    pub(super) fn apply_action<T>(
        &mut self,
        change: impl FnOnce(&mut Self) -> Result<T, PaintingError>,
    ) -> Result<T, PaintingError> {
        assert!(self.stroke_brush.is_none(), "a stroke is open; it ends before another action");
        if let Some(Adjusting::Changed) = self.adjusting {
            return change(self);
        }
        self.history.begin(self.undo_state());
        let result = change(self);
        match &mut self.adjusting {
            Some(adjusting) => *adjusting = Adjusting::Changed,
            None => _ = self.history.commit(),
        }
        result
    }

    /// Panics if a stroke or an adjustment is open. `what` names the next action.
    pub(super) fn assert_idle(&self, what: &str) {
        assert!(self.stroke_brush.is_none(), "a stroke is open; it ends before {what}");
        assert!(self.adjusting.is_none(), "an adjustment is open; it ends before {what}");
    }

    /// State for the next entry of the history.
    pub(super) fn undo_state(&self) -> UndoState {
        UndoState {
            state: self.state.clone(),
            light: Arc::clone(&self.light),
            brushes: self.brushes.len(),
            mask: self.mask.clone(),
        }
    }

    fn restore(&mut self, restored: Restored<UndoState>) -> Result<(), PaintingError> {
        let UndoState { state, light, brushes, mask } = restored.caller;
        self.hold_mask(mask)?;
        let palette_changed = state.slots != self.state.slots;
        let look = |state: &State| -> Vec<_> {
            state.dry.iter().map(|layer| (layer.slots, layer.shown_opacity())).collect()
        };
        let paint_changed = palette_changed || look(&state) != look(&self.state);
        let light_changed = !Arc::ptr_eq(&light, &self.light);
        let lighting_changed = state.lighting != self.state.lighting;
        let medium_changed = state.medium != self.state.medium;
        (self.state, self.light) = (state, light);
        if palette_changed {
            for brush in &self.brushes[brushes.min(self.brushes.len())..] {
                let clean = Layer::empty(brush.cells.0, brush.cells.1);
                self.engine.set_brush_paint(brush.id, &clean)?;
            }
        }
        if restored.dry_changed {
            self.floor_changed()?;
        }
        let bounds = self.engine.bounds();
        if paint_changed {
            self.views.mark_all();
        }
        if medium_changed {
            self.views.mark_all_wet();
        }
        if light_changed {
            self.views.first.mark_all(bounds);
        } else if lighting_changed {
            self.views.first.wet = TileSet::all(bounds);
        }
        restored.tiles.iter().for_each(|tile| self.views.mark_wet_tile(tile));
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::brush::HeadShape;
    use crate::document::{Document, Medium};
    use crate::engine::PaintEngine;
    use crate::ground::GroundSpec;
    use crate::layer::SLOTS;
    use crate::pose::Sample;
    use pigment::PigmentId;
    use pigment::library::PigmentLibrary;

    fn opened(document: Document) -> Painting {
        let engine = PaintEngine::on_cpu(document.ground.height.clone());
        Painting::open(document, engine, 1 << 24).unwrap()
    }

    fn bare() -> Painting {
        let library = PigmentLibrary::van_gogh_oils();
        let ground = GroundSpec::default().build(300, 200, 0.1, &library).unwrap();
        let medium = Medium::default();
        let lighting = Lighting::default();
        let slots = std::array::from_fn(|slot| Some(PigmentId(slot)));
        opened(Document::bare("", 0.1, ground, library, medium, slots, lighting))
    }

    /// Asserts that the picture equals the picture of the same painting opened anew.
    fn assert_picture(painting: &mut Painting, after: &str) {
        let shown = painting.picture().unwrap();
        let whole = opened(painting.document().unwrap()).picture().unwrap();
        assert!(shown == whole, "after {after}");
    }

    #[test]
    fn an_updated_picture_equals_a_new_one() {
        let mut painting = bare();
        assert_picture(&mut painting, "nothing");
        let brush = painting.add_brush(HeadShape::Flat, 3.0).unwrap();
        for end_mm in [14.0, 25.0] {
            painting.load(brush, &[1.0; SLOTS], 0.1, 0.3).unwrap();
            painting.stroke(brush, &[sample(0.0, 3.0), sample(1.0, end_mm)]).unwrap();
            assert_picture(&mut painting, "a stroke");
            assert!(painting.dry(0.5).unwrap(), "there is paint to dry");
            assert_picture(&mut painting, "drying");
        }
        let turned = Lighting { azimuth_deg: 90.0, ..Lighting::default() };
        painting.relight(turned).unwrap();
        assert_picture(&mut painting, "turning the lamp");
        for undone in ["the lamp", "the drying", "the stroke", "the first drying"] {
            assert!(painting.undo().unwrap(), "{undone}");
            assert_picture(&mut painting, &format!("undoing {undone}"));
        }
    }

    fn sample(seconds: f64, x_mm: f64) -> Sample {
        Sample {
            seconds,
            x_mm,
            y_mm: 6.0,
            pressure: 0.7,
            tilt_x_deg: 10.0,
            tilt_y_deg: 0.0,
            twist_deg: 90.0,
        }
    }
}
