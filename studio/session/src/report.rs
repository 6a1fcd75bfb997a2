//! State of the painting besides its pixels, for the front end.

use std::collections::BTreeMap;
use std::sync::Arc;

use render::amount::mm_from_quanta;
use render::layer::SLOTS;
use render::light::Light;
use render::paint::session::{PaintingSession, SessionError};
use render::paint::strokes::{BrushSpec, SurfaceId};

use super::colors::Colors;
use super::layers::Layers;
use super::prepare::PreparedPainting;
use super::srgb::SrgbBytes;
use super::state::{BrushState, PaintingState};

/// Makes the reports, and caches what is slow to compute.
#[derive(Debug)]
pub(super) struct Reporter {
    colors: Colors,
    pub(super) layers: Layers,
    /// Mean heights of the paint on brushes in mm, by name. Entries that may have changed are
    /// removed.
    pub(super) brushes: BTreeMap<String, [f64; SLOTS + 1]>,
}

/// State that the worker adds to each report.
#[derive(Debug, Clone)]
pub(super) struct WorkerStatus {
    /// Counter of changes of the painting.
    pub(super) revision: u64,
    /// Whether a stroke is open.
    pub(super) stroke_open: bool,
}

impl Reporter {
    pub(super) fn new(prepared: &PreparedPainting) -> Self {
        let light = Arc::clone(prepared.session.canvas().light());
        let colors = Colors::new(Arc::clone(&prepared.library), light);
        Self { colors, layers: Layers::default(), brushes: BTreeMap::new() }
    }

    /// The whole state as it is now.
    ///
    /// # Errors
    /// [`SessionError`] if the device was lost.
    pub(super) fn state(
        &mut self,
        prepared: &mut PreparedPainting,
        status: &WorkerStatus,
        bytes: &SrgbBytes,
    ) -> Result<PaintingState, SessionError> {
        let PreparedPainting { session, library, ground, .. } = prepared;
        let light: Arc<Light> = Arc::clone(session.canvas().light());
        if !self.colors.is_for(library, &light) {
            self.colors = Colors::new(Arc::clone(library), Arc::clone(&light));
        }
        let brushes = self.brush_states(session)?;
        let palette = session.painting(SurfaceId::Palette).map(|palette| palette.bounds());
        let (history, done) = session.history();
        let history = history.into_iter().map(str::to_owned).collect();
        let undo_bytes = session.undo_bytes();
        let canvas = session.canvas();
        let slots = canvas.state().slots;
        let bounds = canvas.bounds();
        Ok(PaintingState {
            title: canvas.title().to_owned(),
            canvas_cells: (bounds.width, bounds.height),
            palette_cells: palette.map_or((0, 0), |bounds| (bounds.width, bounds.height)),
            cell_mm: canvas.cell_mm(),
            library: Arc::clone(library),
            slots,
            masstones: self.colors.masstones(&slots),
            tints: self.colors.tints(&slots),
            layers: self.layers.states(canvas, bytes),
            lighting: canvas.state().lighting.clone(),
            light,
            second_lighting: canvas.second_light().cloned(),
            medium: canvas.medium().clone(),
            ground_reflectance: Arc::clone(ground),
            history,
            history_done: done,
            undo_bytes,
            brushes,
            backend: canvas.backend(),
            revision: status.revision,
            stroke_open: status.stroke_open,
        })
    }

    /// States of all brushes, in the order of their names.
    fn brush_states(
        &mut self,
        session: &mut PaintingSession,
    ) -> Result<Vec<BrushState>, SessionError> {
        let slots = session.canvas().state().slots;
        let specs: Vec<(String, BrushSpec)> =
            session.brushes().map(|(name, spec)| (name.to_owned(), spec.clone())).collect();
        let mut states = Vec::with_capacity(specs.len());
        for (name, spec) in specs {
            let heights = match self.brushes.get(&name) {
                Some(heights) => *heights,
                None => {
                    let heights = heights_mm(session, &name)?;
                    self.brushes.insert(name.clone(), heights);
                    heights
                }
            };
            let amount_mm: f64 = heights.iter().sum();
            let pigments: f64 = heights[..SLOTS].iter().sum();
            let share = |whole: f64, part: f64| if whole > 0.0 { part / whole } else { 0.0 };
            let parts = std::array::from_fn(|slot| share(pigments, heights[slot]));
            states.push(BrushState {
                color: self.colors.of_slots(&slots, &parts),
                vehicle: share(amount_mm, heights[SLOTS]),
                name,
                spec,
                amount_mm,
                parts,
            });
        }
        Ok(states)
    }
}

/// Mean height of each slot and, last, of the vehicle on a brush, in mm.
fn heights_mm(session: &mut PaintingSession, name: &str) -> Result<[f64; SLOTS + 1], SessionError> {
    let cell_mm = session.canvas().cell_mm();
    let Some(paint) = session.brush_paint(name)? else { return Ok([0.0; SLOTS + 1]) };
    let cells = (paint.width() * paint.height()).max(1) as f64;
    Ok(paint.totals().map(|total| total as f64 / cells * mm_from_quanta(1, cell_mm)))
}
