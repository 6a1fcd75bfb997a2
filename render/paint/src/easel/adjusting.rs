//! Sliders: what is changed bit by bit and counts as one action.

use super::failure::EaselError;
use super::state::Easel;
use crate::strokes::{Action, ActionPigments, LayerName};

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
    Opacity(LayerName),
}

impl Control {
    fn of(action: &Action) -> Result<Self, EaselError> {
        match action {
            Action::Light(_) => Ok(Self::Light),
            Action::Gloss { .. } => Ok(Self::Gloss),
            Action::Opacity { layer, .. } => Ok(Self::Opacity(*layer)),
            _ => Err(EaselError::NoControl { kind: action.kind() }),
        }
    }
}

impl Easel {
    /// Does what [`Easel::act`] does, while a control is being dragged: all of one
    /// control until [`Easel::settle`] is one action, and is recorded as it stood
    /// last. Another control begins another action.
    ///
    /// # Errors
    /// [`EaselError`] as of [`Easel::act`], and for actions other than light,
    /// gloss and opacity.
    pub fn adjust(&mut self, action: &Action) -> Result<(), EaselError> {
        let control = Control::of(action)?;
        if self.adjusting.as_ref().is_none_or(|adjusting| adjusting.control != control) {
            self.settle_all()?;
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
    pub fn settle(&mut self) {
        let Some(Adjusting { action, on, .. }) = self.adjusting.take() else { return };
        self.end_adjusting();
        self.did(&action, &ActionPigments::None, on);
    }

    /// Ends whatever is open: a stroke, or what is being adjusted.
    ///
    /// # Errors
    /// [`EaselError`] if the device was lost.
    pub fn settle_all(&mut self) -> Result<(), EaselError> {
        self.settle();
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
