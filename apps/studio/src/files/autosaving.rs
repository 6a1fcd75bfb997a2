//! Starts the jobs of autosaves and their recovery.

use std::path::Path;
use std::sync::{Arc, PoisonError};
use web_time::{Duration, Instant};

use serde_json::{from_value, to_value};

use super::desk::{Desk, digest_of};
use super::job::{JobError, Progress, on_one_core};
use super::problem::Problem;
use super::state::Files;
use super::tasks::read_painting;
use super::work::{Finished, JobKind, Purpose};
use crate::language::{tr, tr_format};
use paint::document::Document;
use session::{KeptPainting, SessionMeta, now};

impl Files {
    /// Starts reading the lost session in `folder`.
    pub(super) fn recover(&mut self, folder: &Path) {
        let mut sessions = self.lost_sessions.iter();
        let Some(at) = sessions.position(|lost| lost.folder() == folder) else { return };
        let lost = self.lost_sessions.remove(at);
        let label = tr_format!("recovering {title}", title = lost.meta.title);
        self.start_job(JobKind::Shown, label, move |progress| {
            let [canvas, palette] = lost.files();
            let title = &lost.meta.title;
            let canvas = read_autosaved(&canvas, title, progress)?;
            let palette = read_autosaved(&palette, title, progress)?;
            // The painting is worth more than what lies beside it.
            let mut remarks = Vec::new();
            let work = lost.work().unwrap_or_else(|failure| {
                remarks.push(failure.into());
                None
            });
            let desk: Option<Desk> = lost.meta.desk.clone().and_then(|desk| from_value(desk).ok());
            let reference = desk.and_then(|desk| desk.reference);
            remarks.extend(reference.and_then(|reference| reference.remark()));
            Ok(Finished::Recovered { canvas, palette, work: work.map(Box::new), lost, remarks })
        });
    }

    /// Requests an autosave if it is due; otherwise requests a repaint at the time when it
    /// will be.
    pub(super) fn autosave_when_due(&mut self) {
        let Some(state) = self.painting.clone() else { return };
        let busy = self.jobs.iter().any(|job| job.kind == JobKind::Autosave)
            || self.awaited.iter().any(|(_, purpose)| matches!(purpose, Purpose::Autosave));
        let changed = state.stroke_open
            || self.autosaved_revision != Some(state.revision)
            || self
                .autosaved_desk
                .as_ref()
                .is_some_and(|desk| desk.reference != self.desk.reference);
        if busy || !changed || !self.has_unsaved_changes() || self.opening.is_some() {
            return;
        }
        let interval = Duration::from_secs(self.preferences.autosave_seconds);
        match self.last_autosave.and_then(|last| interval.checked_sub(last.elapsed())) {
            Some(left) if !left.is_zero() => self.ctx.request_repaint_after(left),
            _ => {
                self.last_autosave = Some(Instant::now());
                self.request_autosave();
            }
        }
    }

    /// Starts writing an autosave.
    pub(super) fn start_autosave(&mut self, kept: &Arc<KeptPainting>) {
        let kept = kept.clone();
        let start = self.start.clone();
        let desk = self.desk.clone();
        let revision = kept.snapshot.revision;
        let epoch = self.epoch;
        let title = self.title();
        let path = self.path.clone();
        let seconds = now();
        let autosave = self.autosave.clone();
        let known = self.reference_digest.clone();
        self.start_job(JobKind::Autosave, "autosave".to_owned(), move |_| {
            let picture = desk.reference.as_ref().map(|reference| &reference.picture);
            let digest = known.filter(|(path, _)| Some(path) == picture);
            let digest = digest.or_else(|| picture.map(|path| (path.clone(), digest_of(path))));
            let mut with_digest = desk.clone();
            if let (Some(reference), Some((_, sha256))) = (&mut with_digest.reference, &digest) {
                reference.sha256.clone_from(sha256);
            }
            let meta = SessionMeta { title, path, seconds, desk: to_value(&with_digest).ok() };
            let mut autosave = autosave.lock().unwrap_or_else(PoisonError::into_inner);
            let recorded = match autosave.as_mut() {
                Some(autosave) => {
                    let start = start.as_ref().map(|bytes| bytes.as_slice());
                    let kept = on_one_core(|| autosave.keep(&kept, start, &meta));
                    kept.map_err(Problem::from)?
                }
                None => 0,
            };
            Ok(Finished::Autosaved { revision, epoch, recorded, desk: Box::new(desk), digest })
        });
    }

    /// Starts deleting the autosaves. They are not needed once the painting is saved in a
    /// file or discarded.
    pub(super) fn clear_autosaves(&mut self) {
        (self.last_autosave, self.autosaved_revision) = (Some(Instant::now()), None);
        (self.recorded, self.autosaved_desk) = (0, None);
        let autosave = self.autosave.clone();
        self.start_job(JobKind::Background, tr("clearing autosaves").to_owned(), move |_| {
            let mut autosave = autosave.lock().unwrap_or_else(PoisonError::into_inner);
            if let Some(autosave) = autosave.as_mut() {
                autosave.clear().map_err(Problem::from)?;
            }
            Ok(Finished::Quietly)
        });
    }
}

/// Reads a file of the autosave of `title`. The painter never chose the file's name, so that a
/// problem names the autosave instead.
fn read_autosaved(
    path: &Path,
    title: &str,
    progress: &Progress,
) -> Result<Box<Document>, JobError> {
    let named = |problem: Problem| {
        let autosave = tr_format!("the autosave of {title}", title);
        Problem { text: problem.text.replace(&path.display().to_string(), &autosave), ..problem }
    };
    match read_painting(path, progress) {
        Ok((document, _)) => Ok(document),
        Err(JobError::Failed(problem)) => Err(named(problem).into()),
        Err(cancelled) => Err(cancelled),
    }
}
