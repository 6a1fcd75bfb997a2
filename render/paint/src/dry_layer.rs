//! Dry layers of a painting: their paint, and properties that can be changed later.

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::layer::{Layer, Slots};

/// Most characters in the name of a layer.
pub const MAX_LAYER_NAME: usize = 80;

/// Identity of a dry layer: a number from 1 that stays with the layer when it is moved, renamed or
/// saved, and that no other layer of the painting gets. Only an undo, which takes the layer away
/// as well, gives its number back.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(transparent)]
pub struct LayerId(pub u32);

impl LayerId {
    /// Identity of the first layer of a painting.
    pub const FIRST: Self = Self(1);

    /// Identity of a layer of a file that stores none: its place, `index`, counted from 1.
    #[must_use]
    pub fn by_place(index: usize) -> Self {
        Self(u32::try_from(index).map_or(u32::MAX, |index| index.saturating_add(1)))
    }

    /// The next identity after this one.
    #[must_use]
    pub fn next(self) -> Self {
        Self(self.0.saturating_add(1))
    }
}

impl fmt::Display for LayerId {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(formatter)
    }
}

/// A dry layer of paint.
#[derive(Debug, Clone, PartialEq)]
pub struct DryLayer {
    /// Its identity within the painting.
    pub id: LayerId,
    /// Its name, up to [`MAX_LAYER_NAME`] characters; empty if it has none.
    pub name: String,
    /// Whether it is shown. A hidden layer keeps its opacity and its height.
    pub visible: bool,
    /// Pigments of the layer.
    pub slots: Slots,
    /// Factor on the optical thickness of the paint: 1 as painted, 0 clear.
    pub opacity: f64,
    /// Amounts of paint in every cell.
    pub paint: Layer,
}

impl DryLayer {
    /// A layer as it was painted: visible and without a name.
    #[must_use]
    pub fn new(id: LayerId, slots: Slots, paint: Layer) -> Self {
        Self { id, name: String::new(), visible: true, slots, opacity: 1.0, paint }
    }

    /// Factor on the optical thickness as it is shown: 0 for a hidden layer.
    #[must_use]
    pub fn shown_opacity(&self) -> f64 {
        shown_opacity(self.visible, self.opacity)
    }
}

/// Opacity of a layer as it is shown: 0 if it is hidden.
#[must_use]
pub fn shown_opacity(visible: bool, opacity: f64) -> f64 {
    if visible { opacity } else { 0.0 }
}

/// Label of a layer: its name, or its number if it has none.
#[must_use]
pub fn layer_label(id: LayerId, name: &str) -> String {
    if name.is_empty() { format!("Layer {id}") } else { name.to_owned() }
}

/// `None` if a layer can have this name, else a description of the names allowed.
#[must_use]
pub fn layer_name_violation(name: &str) -> Option<&'static str> {
    if name.chars().count() > MAX_LAYER_NAME {
        return Some("a name of at most 80 characters");
    }
    if name.chars().any(char::is_control) {
        return Some("a name on one line, without control characters");
    }
    (name.trim() != name).then_some("a name without spaces at its ends")
}

/// Gives layers whose identity is 0 or taken another one, and returns the identity of the next
/// new layer, at least `next`.
pub fn distinct_ids<'a>(ids: impl Iterator<Item = &'a mut LayerId>, next: LayerId) -> LayerId {
    let ids: Vec<&mut LayerId> = ids.collect();
    let highest = ids.iter().map(|id| **id).filter(|id| id.0 < u32::MAX).max();
    let mut next = highest.map_or(LayerId::FIRST, LayerId::next).max(next).max(LayerId::FIRST);
    let mut taken = Vec::with_capacity(ids.len());
    for id in ids {
        if id.0 == 0 || id.0 == u32::MAX || taken.contains(id) {
            *id = next;
            next = next.next();
        }
        taken.push(*id);
    }
    next
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn taken_identities_are_replaced_by_new_ones() {
        let mut ids = [3, 0, 3, 1, u32::MAX].map(LayerId);
        assert_eq!(distinct_ids(ids.iter_mut(), LayerId(2)), LayerId(7));
        assert_eq!(ids, [3, 4, 5, 1, 6].map(LayerId));
        assert_eq!(distinct_ids(ids.iter_mut(), LayerId(20)), LayerId(20), "the count goes on");
        assert_eq!(ids, [3, 4, 5, 1, 6].map(LayerId));
        assert_eq!(distinct_ids([].iter_mut(), LayerId(0)), LayerId::FIRST);
    }

    #[test]
    fn names_are_one_short_line() {
        let longest = "\u{e9}".repeat(MAX_LAYER_NAME);
        for name in ["", "sky", "second glaze, 2", longest.as_str()] {
            assert_eq!(layer_name_violation(name), None, "{name}");
        }
        for name in [" sky", "sky ", "a\nb", "\u{7}", &"x".repeat(MAX_LAYER_NAME + 1)] {
            assert!(layer_name_violation(name).is_some(), "{name:?}");
        }
        assert_eq!(layer_label(LayerId(3), ""), "Layer 3");
        assert_eq!(layer_label(LayerId(3), "sky"), "sky");
    }
}
