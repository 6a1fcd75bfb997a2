//! A value that a control shows before the worker has confirmed it.

use eframe::egui::{Response, Ui};
use paint::strokes::Action;

use super::context::PanelContext;
use session::Command;

/// Time after which an unconfirmed value is dropped, in seconds.
const TIMEOUT_SECONDS: f64 = 3.0;

/// Change of a control's value in one frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) enum Edit {
    /// The value did not change.
    #[default]
    None,
    /// The control is being dragged and its value changed.
    Dragged,
    /// A drag ended.
    Released,
    /// The value was set by a key or by typing.
    Set,
}

impl Edit {
    /// Reads the change from the response of a slider or similar control.
    pub(super) fn of(response: &Response) -> Self {
        if response.drag_stopped() {
            Self::Released
        } else if !response.changed() {
            Self::None
        } else if response.dragged() {
            Self::Dragged
        } else {
            Self::Set
        }
    }

    /// Combines the changes made by two controls of one value: returns `other` if `self` is
    /// `None`.
    pub(super) fn or(self, other: Self) -> Self {
        if self == Self::None { other } else { self }
    }
}

/// A requested value, kept until the worker reports it.
#[derive(Debug, Clone)]
pub(super) struct PendingValue<T> {
    value: Option<T>,
    released_at: Option<f64>,
}

impl<T> Default for PendingValue<T> {
    fn default() -> Self {
        Self { value: None, released_at: None }
    }
}

impl<T: Clone> PendingValue<T> {
    /// Value to show at time `now` in seconds: the requested one until the worker
    /// reports a value `near` it, at most three seconds after the release.
    pub(super) fn shown(&mut self, reported: &T, near: impl Fn(&T, &T) -> bool, now: f64) -> T {
        let (Some(value), Some(released_at)) = (&self.value, self.released_at) else {
            return self.value.as_ref().unwrap_or(reported).clone();
        };
        if near(value, reported) || now > released_at + TIMEOUT_SECONDS {
            *self = Self::default();
            return reported.clone();
        }
        value.clone()
    }

    /// Stores a value during a drag.
    pub(super) fn drag(&mut self, value: T) {
        *self = Self { value: Some(value), released_at: None };
    }

    /// Stores a value set or released at time `now` in seconds.
    pub(super) fn set(&mut self, value: T, now: f64) {
        *self = Self { value: Some(value), released_at: Some(now) };
    }

    /// Queues `action` for a change of the control to `value`, and stores `value`. All actions
    /// of one drag become one action of the history.
    pub(super) fn request(
        &mut self,
        ui: &Ui,
        cx: &mut PanelContext<'_>,
        edit: Edit,
        action: Action,
        value: T,
    ) {
        match edit {
            Edit::None => return,
            Edit::Dragged => {
                cx.command(Command::Adjust(action));
                return self.drag(value);
            }
            Edit::Released => {
                cx.command(Command::Adjust(action));
                cx.command(Command::EndAdjustment);
            }
            Edit::Set => cx.command(Command::Apply(action)),
        }
        self.set(value, ui.input(|input| input.time));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shown(draft: &mut PendingValue<i32>, reported: i32, now: f64) -> i32 {
        draft.shown(&reported, |a, b| a == b, now)
    }

    #[test]
    fn a_dragged_value_is_shown_until_the_worker_reports_it() {
        let mut draft = PendingValue::default();
        assert_eq!(shown(&mut draft, 1, 0.0), 1);
        draft.drag(5);
        assert_eq!(shown(&mut draft, 1, 90.0), 5, "during the drag");
        assert_eq!(shown(&mut draft, 5, 91.0), 5);
        draft.drag(7);
        draft.set(7, 92.0);
        assert_eq!(shown(&mut draft, 5, 92.1), 7, "an older state arrives late");
        assert_eq!(shown(&mut draft, 7, 92.2), 7);
        assert_eq!(shown(&mut draft, 2, 92.3), 2, "a later change is shown");
    }

    #[test]
    fn an_unconfirmed_value_is_dropped_after_the_timeout() {
        let mut draft = PendingValue::default();
        draft.set(7, 10.0);
        assert_eq!(shown(&mut draft, 1, 12.9), 7);
        assert_eq!(shown(&mut draft, 1, 13.1), 1);
    }
}
