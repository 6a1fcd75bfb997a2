//! Which dry layers are chosen, to be merged or renamed.

use eframe::egui::Modifiers;
use paint::document::LayerId;
use session::LayerState;

/// The chosen layers, in the order of choosing.
#[derive(Debug, Clone, Default)]
pub(super) struct Chosen(Vec<LayerId>);

impl Chosen {
    pub(super) fn contains(&self, layer: LayerId) -> bool {
        self.0.contains(&layer)
    }

    /// Chooses a layer by a click: only this one, or, with Ctrl, this one besides the others or no
    /// longer.
    pub(super) fn click(&mut self, layer: LayerId, modifiers: Modifiers) {
        if !modifiers.command {
            self.0 = vec![layer];
        } else if self.contains(layer) {
            self.0.retain(|other| *other != layer);
        } else {
            self.0.push(layer);
        }
    }

    /// Drops layers that no longer exist.
    pub(super) fn keep(&mut self, layers: &[LayerState]) {
        self.0.retain(|chosen| layers.iter().any(|layer| layer.id == *chosen));
    }

    /// The chosen layer, if it is one alone.
    pub(super) fn one(&self) -> Option<LayerId> {
        if let [one] = self.0[..] { Some(one) } else { None }
    }

    /// Both chosen layers, if they are two.
    pub(super) fn two(&self) -> Option<[LayerId; 2]> {
        self.0[..].try_into().ok()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ctrl_adds_and_removes_and_a_plain_click_chooses_one() {
        let mut chosen = Chosen::default();
        let [a, b, c] = [1, 2, 3].map(LayerId);
        chosen.click(a, Modifiers::NONE);
        assert_eq!((chosen.one(), chosen.two()), (Some(a), None));
        chosen.click(b, Modifiers::COMMAND);
        assert_eq!((chosen.one(), chosen.two()), (None, Some([a, b])));
        chosen.click(c, Modifiers::COMMAND);
        assert_eq!(chosen.two(), None);
        chosen.click(a, Modifiers::COMMAND);
        assert_eq!(chosen.two(), Some([b, c]));
        chosen.click(c, Modifiers::NONE);
        assert_eq!(chosen.one(), Some(c));
        chosen.keep(&[]);
        assert_eq!(chosen.one(), None);
    }
}
