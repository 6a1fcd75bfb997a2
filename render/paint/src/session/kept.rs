//! State of a session besides its documents, from which another session can go on.
//!
//! A session restored from its documents and a [`KeptSession`] paints the same bits as the session
//! itself would have: its brushes are the same heads with the same paint, and its recording goes
//! on. Its history is empty; a recording that goes on undoes nothing older.

use std::sync::Arc;

use super::brushes::Tool;
use super::failure::SessionError;
use super::record::Record;
use super::state::PaintingSession;
use crate::layer::Layer;
use crate::mask::Mask;
use crate::painting::Painting;
use crate::strokes::{Action, BrushSpec, PerSurface, StrokeScript, SurfaceId};

/// A head of a session.
#[derive(Debug, Clone, PartialEq)]
pub struct KeptHead {
    /// Name under which it was added.
    pub name: String,
    /// Its name in the recording.
    pub recorded: String,
    /// Shape and size.
    pub spec: BrushSpec,
    /// Whether it has its name now; another head may have taken it.
    pub named: bool,
    /// Surface that its paint belongs to.
    pub at: SurfaceId,
    /// Its number among the heads used on each surface, from 0, if it was used there.
    pub numbers: PerSurface<Option<usize>>,
    /// The paint on it, by slots of the palette; `None` if it is clean.
    pub paint: Option<Layer>,
}

/// The end of a recording, from some action on.
#[derive(Debug, Clone, PartialEq)]
pub struct RecordingTail {
    /// The recording without its actions, with all its brushes.
    pub header: StrokeScript,
    /// Number of actions before those of this end.
    pub from: usize,
    /// The actions from there.
    pub actions: Vec<Action>,
    /// The open stroke as far as it is painted, or the open adjustment. The recording holds it once
    /// it is finished, perhaps with more samples or other values.
    pub open: Option<Action>,
}

/// All that a session holds besides its documents and its history.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct KeptSession {
    /// All heads, in the order in which they were added.
    pub brushes: Vec<KeptHead>,
    /// The whole recording; `None` if the session records nothing.
    pub recording: Option<StrokeScript>,
    /// The mask of the canvas, if one is set.
    pub mask: Option<Arc<Mask>>,
}

impl PaintingSession {
    /// All heads with the paint on them.
    ///
    /// # Errors
    /// [`SessionError`] if the device was lost.
    pub fn kept_heads(&mut self) -> Result<Vec<KeptHead>, SessionError> {
        let named: Vec<usize> =
            self.brushes.names().filter_map(|(name, _)| self.brushes.find(name)).collect();
        let mut kept = Vec::with_capacity(self.brushes.tools.len());
        for index in 0..self.brushes.tools.len() {
            let Tool { name, recorded, spec, ids, at } = &self.brushes.tools[index];
            let numbers = PerSurface::from_fn(|surface| ids[surface].map(|id| id.0));
            let (at, id) = (*at, ids[*at]);
            let mut brush = KeptHead {
                name: name.clone(),
                recorded: recorded.clone(),
                spec: spec.clone(),
                named: named.contains(&index),
                at,
                numbers,
                paint: None,
            };
            if let Some(id) = id {
                let paint = self.surface_mut(at)?.brush_paint(id)?;
                brush.paint = paint.totals().iter().any(|total| *total > 0).then_some(paint);
            }
            kept.push(brush);
        }
        Ok(kept)
    }

    /// The recording from action `from` on; `None` if the session records nothing or the recording
    /// ended early. While a stroke is open, nothing known of it may wait (see
    /// [`PaintingSession::advance`]), so that the end agrees with the documents.
    #[must_use]
    pub fn recording_from(&self, from: usize) -> Option<RecordingTail> {
        let record = self.record.as_ref().filter(|record| record.stopped.is_none())?;
        let mut header = record.script.header();
        let open = match &self.adjusting {
            Some(adjusting) => Some(adjusting.action.clone()),
            None => self.cut_so_far(),
        };
        if let (Some(_), Some(stroke)) = (&open, &self.stroke) {
            let tool = &self.brushes.tools[stroke.tool];
            header.brushes.entry(tool.recorded.clone()).or_insert_with(|| tool.spec.clone());
        }
        let actions = record.script.actions.get(from..).unwrap_or_default().to_vec();
        let from = from.min(record.script.actions.len());
        Some(RecordingTail { header, from, actions, open })
    }

    /// Starts a session like [`PaintingSession::new`] that goes on from `kept`, which belongs to
    /// these surfaces.
    ///
    /// # Errors
    /// [`SessionError`] if canvas, palette, brushes and mask do not go together, or if the device
    /// was lost.
    pub fn restored(
        canvas: Painting,
        palette: Option<Painting>,
        kept: KeptSession,
    ) -> Result<Self, SessionError> {
        let mut session = Self::new(canvas, palette)?;
        if kept.mask.as_ref().is_some_and(|mask| mask.bounds() != session.canvas.bounds()) {
            return Err(SessionError::Unlike { what: "masks" });
        }
        session.canvas.hold_mask(kept.mask)?;
        for surface in SurfaceId::ALL {
            let mut used: Vec<(usize, &KeptHead)> = kept
                .brushes
                .iter()
                .filter_map(|brush| Some((brush.numbers[surface]?, brush)))
                .collect();
            used.sort_by_key(|(number, _)| *number);
            for (expected, (number, brush)) in used.into_iter().enumerate() {
                if number != expected {
                    return Err(SessionError::Unlike { what: "brushes" });
                }
                let painting = session.surface_mut(surface)?;
                painting.add_brush(brush.spec.shape, brush.spec.size_mm)?;
            }
        }
        for brush in kept.brushes {
            session.restore_brush(brush)?;
        }
        session.record = kept.recording.map(Record::resumed);
        Ok(session)
    }

    fn restore_brush(&mut self, brush: KeptHead) -> Result<(), SessionError> {
        let KeptHead { name, recorded, spec, named, at, numbers, paint } = brush;
        let ids = PerSurface::from_fn(|surface| numbers[surface].map(crate::engine::BrushId));
        if let (Some(id), Some(paint)) = (ids[at], &paint) {
            let painting = self.surface_mut(at)?;
            let (width, height) = painting.head(id).paint_grid();
            if (paint.width(), paint.height()) != (width, height) {
                return Err(SessionError::Unlike { what: "brushes" });
            }
            painting.set_brush_paint(id, paint)?;
        }
        self.brushes.restore(Tool { name, recorded, spec, ids, at }, named);
        Ok(())
    }
}
