//! The actions of a script that are left at its end.

use crate::strokes::{Action, Squeeze, Stroke, SurfaceId};

/// Which actions change the canvas and are shown: all, or those that are left at the end. An
/// action that was undone is left if it was done again.
pub(super) fn shown(actions: &[Action], with_undone: bool) -> Vec<bool> {
    let changes = actions.iter().map(changes_canvas);
    if with_undone {
        return changes.collect();
    }
    let mut left = vec![false; actions.len()];
    for index in done_at_end(actions) {
        left[index] = true;
    }
    changes.zip(left).map(|(changes, left)| changes && left).collect()
}

/// Indices of the actions of the history that are done at the end of a script.
fn done_at_end(actions: &[Action]) -> Vec<usize> {
    let mut done = Vec::new();
    let mut undone = Vec::new();
    for (index, action) in actions.iter().enumerate() {
        match action {
            Action::Undo {} => undone.extend(done.pop()),
            Action::Redo {} => done.extend(undone.pop()),
            // These are not actions of the history.
            Action::Load(_) | Action::Wipe { .. } | Action::Wash { .. } | Action::Save { .. } => {}
            _ => {
                done.push(index);
                undone.clear();
            }
        }
    }
    done
}

/// Whether an action can change what the canvas shows.
fn changes_canvas(action: &Action) -> bool {
    match action {
        Action::Stroke(Stroke { on, .. })
        | Action::Cut(Stroke { on, .. })
        | Action::Squeeze(Squeeze { on, .. })
        | Action::Scrape { on } => *on == SurfaceId::Canvas,
        Action::Load(_)
        | Action::Wipe { .. }
        | Action::Wash { .. }
        | Action::Palette(_)
        | Action::Stiffness { .. }
        | Action::Save { .. } => false,
        _ => true,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const UNDO: Action = Action::Undo {};
    const REDO: Action = Action::Redo {};

    fn dry(fraction: f64) -> Action {
        Action::Dry { fraction }
    }

    #[test]
    fn what_was_undone_for_good_is_not_left() {
        let wash = Action::Wash { brush: "a".to_owned() };
        let actions =
            [dry(0.1), dry(0.2), UNDO, dry(0.3), wash, UNDO, REDO, dry(0.4), dry(0.5), UNDO, UNDO];
        assert_eq!(done_at_end(&actions), [0, 3]);
        let found = shown(&actions, false);
        let wanted = [true, false, false, true];
        assert_eq!(found[..4], wanted);
        assert_eq!(found[4..], [false; 7]);
        assert_eq!(shown(&actions, true).iter().filter(|shown| **shown).count(), 10);
    }

    #[test]
    fn the_palette_is_not_shown() {
        let scrape = |on| Action::Scrape { on };
        let found = shown(&[scrape(SurfaceId::Palette), scrape(SurfaceId::Canvas)], true);
        assert_eq!(found, [false, true]);
    }
}
