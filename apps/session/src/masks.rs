//! The mask of the canvas, for the front end.

use std::sync::Arc;

use paint::mask::Mask;

use super::state::MaskState;

/// Most lines of an outline: more would be slow to draw.
const MOST_LINES: usize = 20_000;

/// The state of the mask, made anew only when the mask is another one.
#[derive(Debug, Default)]
pub(super) struct Masks {
    made: Option<(Arc<Mask>, Arc<MaskState>)>,
}

impl Masks {
    /// State of `mask`.
    pub(super) fn state(&mut self, mask: Option<&Arc<Mask>>) -> Option<Arc<MaskState>> {
        let mask = mask?;
        if let Some((of, state)) = &self.made
            && Arc::ptr_eq(of, mask)
        {
            return Some(Arc::clone(state));
        }
        let state = Arc::new(state_of(mask));
        self.made = Some((Arc::clone(mask), Arc::clone(&state)));
        Some(state)
    }
}

fn state_of(mask: &Mask) -> MaskState {
    let bounds = mask.bounds();
    let cells = (bounds.width * bounds.height).max(1);
    let mut step = 1;
    let mut outline = mask.outline(step);
    while outline.len() > MOST_LINES {
        step *= 2;
        outline = mask.outline(step);
    }
    MaskState { outline, covered: mask.covered() as f64 / cells as f64 }
}

#[cfg(test)]
mod tests {
    use graphics::tile::Rect;

    use super::*;

    #[test]
    fn the_outline_of_a_speckled_mask_stays_short() {
        let bounds = Rect { x: 0, y: 0, width: 401, height: 300 };
        let mask = Arc::new(Mask::with_open(bounds, |cell| (cell * 7919) % 5 == 0));
        assert!(mask.outline(1).len() > MOST_LINES);
        let mut masks = Masks::default();
        let state = masks.state(Some(&mask)).unwrap();
        assert!((1..=MOST_LINES).contains(&state.outline.len()), "{}", state.outline.len());
        assert!((state.covered - 0.8).abs() < 0.01, "{}", state.covered);
        let again = masks.state(Some(&mask)).unwrap();
        assert!(Arc::ptr_eq(&state, &again), "it is made once");
        assert!(masks.state(None).is_none());
    }
}
