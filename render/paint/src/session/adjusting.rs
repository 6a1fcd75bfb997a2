//! Adjustments: changes by a slider that count as one action.

use super::failure::SessionError;
use super::label::label;
use super::state::{Adjusting, Control, PaintingSession};
use crate::strokes::{Action, ActionPigments};

impl Control {
    fn of(action: &Action) -> Result<Self, SessionError> {
        match action {
            Action::Light(_) => Ok(Self::Light),
            Action::Gloss { .. } => Ok(Self::Gloss),
            Action::Stiffness { .. } => Ok(Self::Stiffness),
            Action::Opacity { layer, .. } => Ok(Self::Opacity(*layer)),
            _ => Err(SessionError::NoControl { kind: action.kind() }),
        }
    }
}

impl PaintingSession {
    /// Applies an action of light, gloss, stiffness or opacity while its slider is dragged. All
    /// changes of one property until [`PaintingSession::end_adjustment`] count as one action,
    /// which is recorded with its last values. A change of another property begins another
    /// action.
    ///
    /// # Errors
    /// [`SessionError`] for other actions, and the errors of [`PaintingSession::apply`].
    pub fn adjust(&mut self, action: &Action) -> Result<(), SessionError> {
        let control = Control::of(action)?;
        if self.adjusting.as_ref().is_none_or(|adjusting| adjusting.control != control) {
            self.finish_open()?;
        }
        let (action, pigments) = self.rounded(action)?;
        if self.adjusting.is_none() {
            self.canvas.begin_adjusting();
            self.palette.iter_mut().for_each(|palette| palette.begin_adjusting());
        }
        match self.perform(&action, &pigments) {
            Ok(on) => {
                let on = on.unwrap_or_default();
                self.adjusting = Some(Adjusting { control, action, on });
                Ok(())
            }
            Err(error) => {
                if self.adjusting.is_none() {
                    self.end_adjusting();
                }
                Err(error)
            }
        }
    }

    /// Ends the open adjustment; does nothing if none is open.
    pub fn end_adjustment(&mut self) {
        let Some(Adjusting { action, on, .. }) = self.adjusting.take() else { return };
        self.end_adjusting();
        let label = label(&action, &ActionPigments::None, &self.canvas);
        self.record_done(&action, &ActionPigments::None, (label, on));
    }

    /// Finishes the open stroke or adjustment, if there is one.
    ///
    /// # Errors
    /// [`SessionError`] if the device was lost.
    pub fn finish_open(&mut self) -> Result<(), SessionError> {
        self.end_adjustment();
        if self.stroke.is_some() {
            self.end_stroke()?;
        }
        Ok(())
    }

    fn end_adjusting(&mut self) {
        self.canvas.end_adjusting();
        self.palette.iter_mut().for_each(|palette| palette.end_adjusting());
    }
}
