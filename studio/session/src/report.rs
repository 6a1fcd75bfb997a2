//! What the window is told of the painting besides its pixels.

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

/// What is kept from one telling to the next.
#[derive(Debug)]
pub(super) struct Reporter {
    colors: Colors,
    pub(super) layers: Layers,
    /// Paint on brushes by name, as heights in mm; cleared when it may have
    /// changed.
    pub(super) brushes: BTreeMap<String, [f64; SLOTS + 1]>,
}

/// What of a telling the session does not know.
#[derive(Debug, Clone)]
pub(super) struct WorkerStatus {
    pub(super) revision: u64,
    /// Whether a stroke is open.
    pub(super) stroke_open: bool,
}

impl Reporter {
    pub(super) fn new(opened: &PreparedPainting) -> Self {
        let light = Arc::clone(opened.session.canvas().light());
        let colors = Colors::new(Arc::clone(&opened.library), light);
        Self { colors, layers: Layers::default(), brushes: BTreeMap::new() }
    }

    /// All of it, as it is now.
    ///
    /// # Errors
    /// [`SessionError`] if the device was lost.
    pub(super) fn state(
        &mut self,
        opened: &mut PreparedPainting,
        beside: &WorkerStatus,
        bytes: &SrgbBytes,
    ) -> Result<PaintingState, SessionError> {
        let PreparedPainting { session, library, ground, .. } = opened;
        let light: Arc<Light> = Arc::clone(session.canvas().light());
        if !self.colors.are_of(library, &light) {
            self.colors = Colors::new(Arc::clone(library), Arc::clone(&light));
        }
        let brushes = self.stand(session)?;
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
            revision: beside.revision,
            stroke_open: beside.stroke_open,
        })
    }

    /// The brushes, in the order of their names.
    fn stand(&mut self, session: &mut PaintingSession) -> Result<Vec<BrushState>, SessionError> {
        let slots = session.canvas().state().slots;
        let specs: Vec<(String, BrushSpec)> =
            session.brushes().map(|(name, spec)| (name.to_owned(), spec.clone())).collect();
        let mut stand = Vec::with_capacity(specs.len());
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
            stand.push(BrushState {
                color: self.colors.of_slots(&slots, &parts),
                vehicle: share(amount_mm, heights[SLOTS]),
                name,
                spec,
                amount_mm,
                parts,
            });
        }
        Ok(stand)
    }
}

/// Mean heights of the paint on a brush: of each slot, and of vehicle last.
fn heights_mm(session: &mut PaintingSession, name: &str) -> Result<[f64; SLOTS + 1], SessionError> {
    let cell_mm = session.canvas().cell_mm();
    let Some(paint) = session.brush_paint(name)? else { return Ok([0.0; SLOTS + 1]) };
    let cells = (paint.width() * paint.height()).max(1) as f64;
    Ok(paint.totals().map(|total| total as f64 / cells * mm_from_quanta(1, cell_mm)))
}
