//! Crops the painting: the part that stays is opened in its place.
//!
//! The history of a painting keeps pieces of a canvas of one size, so it ends here, and the
//! recording begins anew with the part that stays.

use std::sync::Arc;

use graphics::tile::Rect;
use paint::document::Document;

use super::notice::Notice;
use super::pending::{FileOrigin, PendingAction, Replacement};
use super::problem::Problem;
use super::state::Files;
use super::work::{Finished, JobKind};
use crate::language::{tr, tr_format};
use session::{Command, Origin, Snapshot};

impl Files {
    /// Starts to crop the painting of `snapshot`.
    pub(super) fn start_crop(&mut self, rect: Rect, snapshot: &Snapshot) {
        let canvas = Arc::clone(&snapshot.canvas);
        let palette = Arc::clone(&snapshot.palette);
        let revision = snapshot.revision;
        let epoch = self.epoch;
        self.start_job(JobKind::Shown, tr("cropping the painting").to_owned(), move |progress| {
            let cropped = canvas.cropped(rect);
            progress.report(0.2)?;
            let bytes =
                paint::file::write(&cropped).map_err(|error| Problem::from_error(&error))?;
            let canvas = Box::new(cropped);
            let start = Arc::new(bytes);
            Ok(Finished::Cropped { canvas, palette, start, revision, epoch })
        });
    }

    /// Opens the part that stays, unless something was painted meanwhile.
    pub(super) fn continue_cropped(
        &mut self,
        canvas: Box<Document>,
        palette: Arc<Document>,
        start: Arc<Vec<u8>>,
        revision: u64,
    ) {
        let changed =
            |state: &Arc<session::PaintingState>| state.stroke_open || state.revision != revision;
        if self.painting.as_ref().is_none_or(changed) {
            let text = tr("the painting changed while it was cropped");
            return self.report(Problem::new(text, tr("crop it again")));
        }
        let [width, height] = [canvas.wet.width(), canvas.wet.height()]
            .map(|cells: usize| cells as f64 * canvas.cell_mm);
        let size = tr_format!("cropped to {width:.1} x {height:.1} mm", width, height);
        let mixed = palette.wet.totals().iter().any(|total| *total > 0);
        let (origin, start, text) = if mixed {
            // A recording begins with a clean palette, so that there is none here.
            let palette = Box::new(Arc::unwrap_or_clone(palette));
            let text =
                tr_format!("{size}; without a recording, as the palette keeps its paint", size);
            (Origin::Recovered { canvas, palette, kept: None }, None, text)
        } else {
            (Origin::Painting(canvas), Some(start), size)
        };
        let commands = vec![Command::Open(origin)];
        let files =
            FileOrigin { path: self.path.clone(), start, changed: true, ..FileOrigin::default() };
        self.notices.push(Notice::done(&text));
        // Nothing is lost, so nothing is asked.
        self.carry_out(PendingAction::Replace(Replacement { commands, origin: files }));
    }
}
