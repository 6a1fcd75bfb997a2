//! Sliders: what is changed bit by bit and counts as one action.

use super::failure::SessionError;
use super::state::PaintingSession;
use crate::strokes::{Action, ActionPigments, LayerRef};

/// What is being adjusted.
#[derive(Debug)]
pub(super) struct Adjusting {
    control: Control,
    /// As it stands now.
    action: Action,
    on: [bool; 2],
}

/// What a slider changes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Control {
    Light,
    Gloss,
    Opacity(LayerRef),
}

impl Control {
    fn of(action: &Action) -> Result<Self, SessionError> {
        match action {
            Action::Light(_) => Ok(Self::Light),
            Action::Gloss { .. } => Ok(Self::Gloss),
            Action::Opacity { layer, .. } => Ok(Self::Opacity(*layer)),
            _ => Err(SessionError::NoControl { kind: action.kind() }),
        }
    }
}

impl PaintingSession {
    /// Does what [`PaintingSession::apply`] does, while a control is being dragged: all of one
    /// control until [`PaintingSession::end_adjustment`] is one action, and is recorded as it stood
    /// last. Another control begins another action.
    ///
    /// # Errors
    /// [`SessionError`] as of [`PaintingSession::apply`], and for actions other than light,
    /// gloss and opacity.
    pub fn adjust(&mut self, action: &Action) -> Result<(), SessionError> {
        let control = Control::of(action)?;
        if self.adjusting.as_ref().is_none_or(|adjusting| adjusting.control != control) {
            self.finish_open()?;
        }
        let (action, pigments) = self.understood(action)?;
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

    /// The control was let go. Without one that is being dragged nothing happens.
    pub fn end_adjustment(&mut self) {
        let Some(Adjusting { action, on, .. }) = self.adjusting.take() else { return };
        self.end_adjusting();
        self.did(&action, &ActionPigments::None, on);
    }

    /// Ends whatever is open: a stroke, or what is being adjusted.
    ///
    /// # Errors
    /// [`SessionError`] if the device was lost.
    pub fn finish_open(&mut self) -> Result<(), SessionError> {
        self.end_adjustment();
        if self.live.is_some() {
            self.end_stroke()?;
        }
        Ok(())
    }

    fn end_adjusting(&mut self) {
        self.canvas.end_adjusting();
        self.palette.iter_mut().for_each(|palette| palette.end_adjusting());
    }
}
