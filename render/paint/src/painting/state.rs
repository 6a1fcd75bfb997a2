//! What a painting consists of while it is worked on.

use std::sync::Arc;

use pigment::library::PigmentLibrary;

use super::brushes::Brush;
use super::failure::PaintingError;
use super::strokes::OpenStroke;
use super::undoing::{Adjusting, Before};
use super::views::Views;
use crate::amount::{MAX_COLUMN, mm_from_quanta};
use crate::brush::Relief;
use crate::document::{Document, DryLayer, Lighting, Medium, Slots};
use crate::engine::PaintEngine;
use crate::ground::Ground;
use crate::history::History;
use crate::layer::{Layer, SLOTS};
use crate::light::Light;
use crate::motion::MotionConstants;
use graphics::tile::Rect;

/// How a dry layer is seen: what can be changed of it later.
#[derive(Debug, Clone, PartialEq)]
pub struct DryLayerState {
    /// Its pigments.
    pub slots: Slots,
    /// What its optical thickness is multiplied with.
    pub opacity: f64,
}

/// All of a painting that is no paint; an undo brings it back with the paint.
#[derive(Debug, Clone, PartialEq)]
pub struct State {
    /// The pigments of the wet layer.
    pub slots: Slots,
    /// The dry layers, lowest first.
    pub dry: Vec<DryLayerState>,
    /// The light.
    pub lighting: Lighting,
    /// The binder.
    pub medium: Medium,
}

/// A painting at work.
#[derive(Debug)]
pub struct Painting {
    pub(super) title: String,
    pub(super) cell_mm: f64,
    pub(super) ground: Ground,
    pub(super) library: PigmentLibrary,
    pub(super) motion: MotionConstants,
    pub(super) engine: PaintEngine,
    pub(super) state: State,
    pub(super) light: Arc<Light>,
    pub(super) relief: Relief,
    /// How often the floor was felt anew.
    pub(super) dry_changes: u64,
    pub(super) brushes: Vec<Brush>,
    pub(super) history: History<Before>,
    /// The stroke that is being drawn, if one is.
    pub(super) stroke: Option<OpenStroke>,
    /// The adjustment that is open, if one is.
    pub(super) adjusting: Option<Adjusting>,
    /// What of its pictures is out of date.
    pub(super) views: Views,
}

/// The most that ground and dry paint rise together, and wet paint on them, in
/// quanta: 512 cell widths, so that no sum passes 32 bits.
pub(super) const HIGHEST: u32 = MAX_COLUMN / 2;

/// The bytes that undo may keep unless told otherwise: 512 MiB.
pub const UNDO_BYTES: u64 = 512 << 20;

impl Painting {
    /// Takes up the painting of `document` with a backend made for its ground
    /// (`engine`, without paint yet); undo keeps at most `undo_bytes`.
    ///
    /// # Errors
    /// [`PaintingError`] if the light is unknown, for paint piled too high, or if
    /// the device has no room.
    pub fn open(
        document: Document,
        engine: PaintEngine,
        undo_bytes: u64,
    ) -> Result<Self, PaintingError> {
        let Lighting { illuminant, observer, .. } = &document.lighting;
        let light = Light::named(&document.library, illuminant, observer)?;
        Self::open_under(document, light, engine, undo_bytes)
    }

    /// The same under a light that is known already, made for the document's
    /// library, such as a measured one; the document calls it by some name.
    ///
    /// # Errors
    /// [`PaintingError`] for paint piled too high, or if the device has no room.
    pub fn open_under(
        document: Document,
        light: impl Into<Arc<Light>>,
        mut engine: PaintEngine,
        undo_bytes: u64,
    ) -> Result<Self, PaintingError> {
        check_heights(&document)?;
        let Document { title, cell_mm, ground, library, medium, dry, slots, wet, lighting } =
            document;
        let mut states = Vec::with_capacity(dry.len());
        for DryLayer { slots, opacity, paint } in dry {
            engine.push_dry_layer(&paint)?;
            states.push(DryLayerState { slots, opacity });
        }
        engine.set_wet(&wet)?;
        let relief = Relief::from_floor(&engine.floor()?, cell_mm);
        let views = Views::new(engine.bounds());
        Ok(Self {
            title,
            cell_mm,
            ground,
            library,
            motion: MotionConstants::default(),
            engine,
            state: State { slots, dry: states, lighting, medium },
            light: light.into(),
            relief,
            dry_changes: 0,
            brushes: Vec::new(),
            history: History::new(undo_bytes),
            stroke: None,
            adjusting: None,
            views,
        })
    }

    /// The painting as a file keeps it.
    ///
    /// # Errors
    /// [`PaintingError`] if the device was lost.
    pub fn document(&mut self) -> Result<Document, PaintingError> {
        let mut dry = Vec::with_capacity(self.state.dry.len());
        for (index, state) in self.state.dry.iter().enumerate() {
            let paint = self.engine.dry_layer(index)?;
            dry.push(DryLayer { slots: state.slots, opacity: state.opacity, paint });
        }
        Ok(Document {
            title: self.title.clone(),
            cell_mm: self.cell_mm,
            ground: self.ground.clone(),
            library: self.library.clone(),
            medium: self.state.medium.clone(),
            dry,
            slots: self.state.slots,
            wet: self.engine.wet()?,
            lighting: self.state.lighting.clone(),
        })
    }

    /// The cells of the canvas.
    #[must_use]
    pub fn bounds(&self) -> Rect {
        self.engine.bounds()
    }

    /// Width and height of a cell in mm.
    #[must_use]
    pub fn cell_mm(&self) -> f64 {
        self.cell_mm
    }

    /// What is no paint.
    #[must_use]
    pub fn state(&self) -> &State {
        &self.state
    }

    /// The pigments that the slots name.
    #[must_use]
    pub fn library(&self) -> &PigmentLibrary {
        &self.library
    }

    /// What it is called.
    #[must_use]
    pub fn title(&self) -> &str {
        &self.title
    }

    /// The light that the picture is computed for.
    #[must_use]
    pub fn light(&self) -> &Arc<Light> {
        &self.light
    }

    /// Counts how often dry paint came or went, by undo too: while it stays, the
    /// paint of the dry layers is the same.
    #[must_use]
    pub fn dry_changes(&self) -> u64 {
        self.dry_changes
    }

    /// The binder.
    #[must_use]
    pub fn medium(&self) -> &Medium {
        &self.state.medium
    }

    /// What is painted on.
    #[must_use]
    pub fn ground(&self) -> &Ground {
        &self.ground
    }

    /// What computes.
    #[must_use]
    pub fn backend(&self) -> String {
        self.engine.name()
    }

    /// All wet paint, on the canvas and on the brushes: the height in mm of each
    /// slot and of vehicle last, summed over cells.
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

    /// The wet paint.
    ///
    /// # Errors
    /// [`PaintingError`] if the device was lost.
    pub fn wet(&mut self) -> Result<Layer, PaintingError> {
        Ok(self.engine.wet()?)
    }

    /// The wet paint in `rect`; costs no more than `rect` holds, as the next.
    ///
    /// # Errors
    /// [`PaintingError`] if the device was lost.
    ///
    /// # Panics
    /// If `rect` has cells that the canvas has not.
    pub fn wet_in(&mut self, rect: Rect) -> Result<Layer, PaintingError> {
        Ok(self.engine.wet_in(rect)?)
    }

    /// The dry layer `index`, counted from the lowest, in `rect`.
    ///
    /// # Errors
    /// [`PaintingError`] for a layer that is not there, or if the device was lost.
    ///
    /// # Panics
    /// If `rect` has cells that the canvas has not.
    pub fn dry_in(&mut self, index: usize, rect: Rect) -> Result<Layer, PaintingError> {
        let count = self.state.dry.len();
        if index >= count {
            return Err(PaintingError::NoLayer { index, count });
        }
        Ok(self.engine.dry_layer_in(index, rect)?)
    }
}

/// Refuses paint that rises above [`HIGHEST`].
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
