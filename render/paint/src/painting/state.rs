//! State of a painting while it is worked on.

use std::sync::Arc;

use pigment::library::PigmentLibrary;

use super::failure::PaintingError;
use super::views::Views;
use crate::amount::{MAX_COLUMN, mm_from_quanta};
use crate::brush::{Head, Relief};
use crate::document::{Document, DryLayer, LayerId, Lighting, Medium, Slots};
use crate::dry_layer::{distinct_ids, layer_label, shown_opacity};
use crate::engine::{BrushId, PaintEngine};
use crate::ground::Ground;
use crate::history::History;
use crate::layer::{Layer, SLOTS};
use crate::light::Light;
use crate::mask::Mask;
use crate::motion::MotionConstants;
use graphics::tile::Rect;

/// Properties of a dry layer that can be changed later.
#[derive(Debug, Clone, PartialEq)]
pub struct DryLayerState {
    /// Its identity within the painting.
    pub id: LayerId,
    /// Its name; empty if it has none.
    pub name: String,
    /// Whether it is shown.
    pub visible: bool,
    /// Pigment of each slot, as an index into the library.
    pub slots: Slots,
    /// Factor of the optical thickness: 1 as painted, 0 clear.
    pub opacity: f64,
}

impl DryLayerState {
    /// A layer that just dried.
    pub(super) fn new(id: LayerId, slots: Slots) -> Self {
        Self { id, name: String::new(), visible: true, slots, opacity: 1.0 }
    }

    /// Opacity as it is shown: 0 for a hidden layer.
    #[must_use]
    pub fn shown_opacity(&self) -> f64 {
        shown_opacity(self.visible, self.opacity)
    }

    /// Its name, or its number if it has none.
    #[must_use]
    pub fn label(&self) -> String {
        layer_label(self.id, &self.name)
    }
}

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
    /// Number of brushes at that time.
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
    /// Covered cells; see [`Painting::change_mask`].
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
