//! A value under the painter's hand, shown at once.

use eframe::egui::Response;

/// Seconds after which what the worker tells is shown again.
const PATIENCE: f64 = 3.0;

/// What a control did to its value in a frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) enum Touch {
    /// Nothing.
    #[default]
    None,
    /// It is being dragged, and moved.
    Dragged,
    /// It was let go.
    LetGo,
    /// It was set by a key, or a number was typed.
    Set,
}

impl Touch {
    /// What `response`, of a slider or the like, was.
    pub(super) fn of(response: &Response) -> Self {
        if response.drag_stopped() {
            Self::LetGo
        } else if !response.changed() {
            Self::None
        } else if response.dragged() {
            Self::Dragged
        } else {
            Self::Set
        }
    }

    /// The one of two controls of one value that was touched.
    pub(super) fn or(self, other: Self) -> Self {
        if self == Self::None { other } else { self }
    }
}

/// A value that was asked of the worker, until the worker tells the same.
#[derive(Debug)]
pub(super) struct Draft<T> {
    value: Option<T>,
    let_go_at: Option<f64>,
}

impl<T> Default for Draft<T> {
    fn default() -> Self {
        Self { value: None, let_go_at: None }
    }
}

impl<T: Clone> Draft<T> {
    /// What to show at `now`, in seconds: what was asked for, until the worker has
    /// told something `near` it or has told otherwise for long.
    pub(super) fn shown(&mut self, told: &T, near: impl Fn(&T, &T) -> bool, now: f64) -> T {
        let (Some(value), Some(let_go_at)) = (&self.value, self.let_go_at) else {
            return self.value.as_ref().unwrap_or(told).clone();
        };
        if near(value, told) || now > let_go_at + PATIENCE {
            *self = Self::default();
            return told.clone();
        }
        value.clone()
    }

    /// The value is dragged to here.
    pub(super) fn drag(&mut self, value: T) {
        *self = Self { value: Some(value), let_go_at: None };
    }

    /// The value was set, or let go, at `now`.
    pub(super) fn set(&mut self, value: T, now: f64) {
        *self = Self { value: Some(value), let_go_at: Some(now) };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shown(draft: &mut Draft<i32>, told: i32, now: f64) -> i32 {
        draft.shown(&told, |a, b| a == b, now)
    }

    #[test]
    fn what_is_dragged_is_shown_until_the_worker_tells_the_same() {
        let mut draft = Draft::default();
        assert_eq!(shown(&mut draft, 1, 0.0), 1);
        draft.drag(5);
        assert_eq!(shown(&mut draft, 1, 90.0), 5, "as long as it is held");
        assert_eq!(shown(&mut draft, 5, 91.0), 5);
        draft.drag(7);
        draft.set(7, 92.0);
        assert_eq!(shown(&mut draft, 5, 92.1), 7, "an older state comes late");
        assert_eq!(shown(&mut draft, 7, 92.2), 7);
        assert_eq!(shown(&mut draft, 2, 92.3), 2, "another change counts again");
    }

    #[test]
    fn a_wish_that_is_not_granted_is_given_up() {
        let mut draft = Draft::default();
        draft.set(7, 10.0);
        assert_eq!(shown(&mut draft, 1, 12.9), 7);
        assert_eq!(shown(&mut draft, 1, 13.1), 1);
    }
}
