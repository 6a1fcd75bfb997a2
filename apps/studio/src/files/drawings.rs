//! Files of the lines drawn on the reference picture, and actions that would lose them.

use std::path::PathBuf;

use super::drawing::{Drawing, DrawingKind, DrawnFile};
use super::notice::Notice;
use super::pending::PendingAction;
use super::reference_change::ReferenceChange;
use super::state::Files;
use super::work::{Finished, JobKind, file_name};
use crate::language::tr_format;

impl Files {
    /// Takes note of the drawings on the reference picture that are in no file. To be called every
    /// frame before [`Files::update`].
    pub fn note_drawings(&mut self, unsaved: Vec<DrawnFile>) {
        self.unsaved_drawings = unsaved;
    }

    /// The unsaved drawings that an action would lose.
    pub(super) fn drawings_lost_by(&self, action: &PendingAction) -> Vec<DrawnFile> {
        let lost = |drawn: &&DrawnFile| match action {
            PendingAction::Close { drawings_given_up } => !drawings_given_up,
            PendingAction::Replace(_) | PendingAction::Reference(ReferenceChange::Saved(_)) => {
                false
            }
            PendingAction::Reference(ReferenceChange::Draw(new)) => {
                new.drawing.kind() == drawn.drawing.kind()
            }
            PendingAction::Reference(
                ReferenceChange::Open(_) | ReferenceChange::Restore { .. } | ReferenceChange::Close,
            ) => true,
        };
        self.unsaved_drawings.iter().filter(lost).cloned().collect()
    }

    /// Changes the picture beside the canvas, after asking about drawings that this loses.
    pub(super) fn change_reference(&mut self, change: ReferenceChange) {
        self.carry_out_safely(PendingAction::Reference(change));
    }

    /// Goes on with an action without the drawings that it loses.
    pub(super) fn carry_out_without_drawings(&mut self, action: PendingAction) {
        match action {
            PendingAction::Close { .. } => {
                self.carry_out_safely(PendingAction::Close { drawings_given_up: true });
            }
            other => self.carry_out(other),
        }
    }

    /// Starts writing a drawing, then carries out `next`.
    pub(super) fn save_drawing(
        &mut self,
        drawing: Drawing,
        path: PathBuf,
        next: Option<PendingAction>,
    ) {
        let label = tr_format!("saving {path}", path = file_name(&path));
        self.start_job(JobKind::Saving, label, move |_| {
            drawing.save(&path)?;
            Ok(Finished::DrawingSaved { drawn: DrawnFile { drawing, path }, next })
        });
    }

    /// Starts reading a drawing.
    pub(super) fn read_drawing(&mut self, kind: DrawingKind, path: PathBuf) {
        let label = tr_format!("reading {path}", path = file_name(&path));
        self.start_job(JobKind::Shown, label, move |_| {
            let drawing = kind.open(&path)?;
            Ok(Finished::DrawingRead(DrawnFile { drawing, path }))
        });
    }

    /// A drawing was saved.
    pub(super) fn drawing_saved(&mut self, drawn: DrawnFile, next: Option<PendingAction>) {
        self.notices.push(Notice::done(&tr_format!("saved {path}", path = drawn.path.display())));
        self.unsaved_drawings.retain(|unsaved| unsaved.drawing != drawn.drawing);
        self.reference.push_back(ReferenceChange::Saved(drawn));
        if let Some(next) = next {
            self.carry_out_safely(next);
        }
    }
}
