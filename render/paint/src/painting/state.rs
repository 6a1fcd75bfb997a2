//! State of a painting while it is worked on, its undo and redo, and the parts of its pictures that
//! are out of date.

use std::sync::Arc;

use graphics::tile::{Rect, Tile, TileSet};
use pigment::library::PigmentLibrary;

use super::failure::PaintingError;
use crate::amount::{MAX_COLUMN, mm_from_quanta};
use crate::brush::{Head, Relief};
use crate::document::{Document, DryLayer, LayerId, Lighting, Medium, Slots};
use crate::engine::{BrushId, PaintEngine};
use crate::ground::Ground;
use crate::history::{History, Restored};
use crate::layer::{DryLayerState, Layer, SLOTS, distinct_ids};
use crate::light::Light;
use crate::mask::Mask;
use crate::motion::MotionConstants;
use crate::shade::reach;

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

/// Tiles of one picture that are out of date or were not reported.
#[derive(Debug, Default)]
pub(super) struct PendingTiles {
    /// Tiles whose ground and dry paint must be baked again.
    pub(super) dry: TileSet,
    /// Tiles whose wet paint must be rendered.
    pub(super) wet: TileSet,
    /// Tiles rendered since changes were last reported.
    pub(super) unreported: TileSet,
}

/// A second light and the state of its picture.
#[derive(Debug)]
pub(super) struct SecondLight {
    pub(super) lighting: Lighting,
    pub(super) light: Arc<Light>,
    pub(super) pending: PendingTiles,
}

/// State of the pictures of a painting.
#[derive(Debug)]
pub(super) struct Views {
    bounds: Rect,
    /// How far shading looks, in cells.
    reach: usize,
    pub(super) first: PendingTiles,
    pub(super) second: Option<SecondLight>,
}

impl PendingTiles {
    /// All tiles of a canvas of `bounds`.
    pub(super) fn all(bounds: Rect) -> Self {
        let all = TileSet::all(bounds);
        Self { dry: all.clone(), wet: all, unreported: TileSet::default() }
    }

    /// Marks dry and wet paint of all tiles.
    pub(super) fn mark_all(&mut self, bounds: Rect) {
        self.dry = TileSet::all(bounds);
        self.wet = TileSet::all(bounds);
    }
}

impl Views {
    /// One picture that was not rendered yet.
    pub(super) fn new(bounds: Rect, cell_mm: f64) -> Self {
        Self { bounds, reach: reach(cell_mm), first: PendingTiles::all(bounds), second: None }
    }

    fn each(&mut self) -> impl Iterator<Item = &mut PendingTiles> {
        let second = self.second.as_mut().map(|second| &mut second.pending);
        std::iter::once(&mut self.first).chain(second)
    }

    /// Marks `rect` after its wet paint changed.
    pub(super) fn mark_wet(&mut self, rect: Rect) {
        let reach = rect.grown(self.reach, self.bounds);
        self.each().for_each(|pending| pending.wet.insert(reach));
    }

    /// Marks `tile` after its wet paint changed.
    pub(super) fn mark_wet_tile(&mut self, tile: Tile) {
        self.mark_wet(tile.rect(self.bounds));
    }

    /// Marks `tile` after its dry paint changed.
    pub(super) fn mark_dry_tile(&mut self, tile: Tile) {
        self.each().for_each(|pending| _ = pending.dry.insert_tile(tile));
    }

    /// Marks all tiles after dry paint or a pigment changed everywhere.
    pub(super) fn mark_all(&mut self) {
        let bounds = self.bounds;
        self.each().for_each(|pending| pending.mark_all(bounds));
    }

    /// Marks the wet paint of all tiles after the gloss changed.
    pub(super) fn mark_all_wet(&mut self) {
        let bounds = self.bounds;
        self.each().for_each(|pending| pending.wet = TileSet::all(bounds));
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
