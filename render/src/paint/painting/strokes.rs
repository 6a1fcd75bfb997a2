//! Strokes on the canvas.

use super::failure::PaintingError;
use super::state::Painting;
use crate::paint::contact::Contact;
use crate::paint::history::Kept;
use crate::paint::pose::{Pose, Sample};
use crate::paint::stroke::substeps;
use crate::tile::Rect;

/// Sub-steps that go to the backend together: enough to hide what a call costs,
/// few enough that the contacts stay in the cache.
const BATCH: usize = 32;

/// What a stroke was.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct StrokeReport {
    /// Sub-steps in which the head was over the canvas.
    pub substeps: u64,
    /// Cells of all their rectangles.
    pub cells: u64,
    /// Whether it fits what undo may keep.
    pub undoable: bool,
}

impl Painting {
    /// Draws a stroke. One undo takes it back, with the paint that it took from
    /// the brush or gave to it.
    ///
    /// While the backend moves the paint of some sub-steps, the head bends
    /// through the next ones on another thread.
    ///
    /// # Errors
    /// [`PaintingError`] for impossible samples, before anything is painted, or
    /// if the device was lost.
    ///
    /// # Panics
    /// If there is no such brush.
    pub fn stroke(
        &mut self,
        brush: usize,
        samples: &[Sample],
    ) -> Result<StrokeReport, PaintingError> {
        let poses = substeps(samples, self.cell_mm)?;
        let (mut report, kept) = self.acting(|painting| painting.draw(brush, poses))?;
        report.undoable = kept == Kept::Undoable;
        Ok(report)
    }

    fn draw(
        &mut self,
        brush: usize,
        poses: impl Iterator<Item = Pose> + Send,
    ) -> Result<StrokeReport, PaintingError> {
        let mut poses = poses.peekable();
        let bounds = self.engine.bounds();
        let tool = &mut self.brushes[brush];
        self.history.touch_brush(self.engine.as_mut(), tool.id)?;
        if let Some(first) = poses.next() {
            let next = poses.peek().unwrap_or(&first);
            let heading = (next.x - first.x, next.y - first.y);
            tool.head.set_down(&first, heading, &self.relief);
        }
        let mut report = StrokeReport::default();
        let empty = Contact { rect: Rect::default(), touches: Vec::new() };
        let mut next = vec![empty; BATCH];
        let mut current = next.clone();
        let mut ready = 0;
        loop {
            let mut made = 0;
            let (head, relief) = (&mut tool.head, &self.relief);
            let (engine, history, motion) = (&mut self.engine, &mut self.history, &self.motion);
            let id = tool.id;
            let playing = &current[..ready];
            let (played, ()) = rayon::join(
                || {
                    for contact in playing {
                        history.touch(engine.as_mut(), contact.rect.grown(2, bounds))?;
                    }
                    engine.play(id, motion, playing)
                },
                || {
                    while let Some(contact) = next.get_mut(made) {
                        let Some(pose) = poses.next() else { break };
                        head.advance(&pose, relief, bounds, contact);
                        made += usize::from(!contact.rect.is_empty());
                    }
                },
            );
            played?;
            for contact in playing {
                self.unshown.insert(contact.rect.grown(2, bounds));
                report.substeps += 1;
                report.cells += (contact.rect.width * contact.rect.height) as u64;
            }
            if made == 0 {
                break;
            }
            std::mem::swap(&mut current, &mut next);
            ready = made;
        }
        Ok(report)
    }
}
