//! Actions of the history that are undone and repeated together, such as a stroke and its mirrored
//! twins.
//!
//! States of the painting are known by the numbers of
//! [`PaintingSession::history_numbers`](paint::session::PaintingSession::history_numbers):
//! rising, and never given twice.

/// Groups of actions of the history.
#[derive(Debug, Default)]
pub(super) struct Groups {
    /// Number of the state before the group that is being made.
    open: Option<u64>,
    /// Numbers of the states before and after each group.
    whole: Vec<(u64, u64)>,
}

impl Groups {
    /// Begins a group with the next action. `numbers` are those of all states that can be reached,
    /// and `done` is the index of the present one.
    pub(super) fn begin(&mut self, numbers: &[u64], done: usize) {
        self.open = numbers.get(done).copied();
    }

    /// Ends the group that is being made. It counts if it has two actions or more.
    pub(super) fn end(&mut self, numbers: &[u64], done: usize) {
        let (Some(before), Some(&now)) = (self.open.take(), numbers.get(done)) else { return };
        self.whole.retain(|(_, after)| numbers.contains(after));
        if numbers.iter().filter(|&&number| (before + 1..=now).contains(&number)).count() > 1 {
            self.whole.push((before, now));
        }
    }

    /// Gives up the group that is being made: another action came between its own.
    pub(super) fn give_up(&mut self) {
        self.open = None;
    }

    /// Index of the state to which one undo leads, if the last action belongs to a group.
    pub(super) fn undo_to(&self, numbers: &[u64], done: usize) -> Option<usize> {
        let now = *numbers.get(done)?;
        let (before, _) =
            self.whole.iter().find(|(before, after)| (before + 1..=*after).contains(&now))?;
        // The state before the group may be forgotten: then the first one that is known.
        Some(numbers.partition_point(|number| number < before))
    }

    /// Index of the state to which one redo leads, if the next action belongs to a group.
    pub(super) fn redo_to(&self, numbers: &[u64], done: usize) -> Option<usize> {
        let now = *numbers.get(done)?;
        let (_, after) =
            self.whole.iter().find(|(before, after)| (*before..*after).contains(&now))?;
        numbers.iter().position(|number| number == after)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// States 0 to 5, of which 2 to 4 are a group.
    fn grouped() -> Groups {
        let mut groups = Groups::default();
        groups.begin(&[0, 1], 1);
        groups.end(&[0, 1, 2, 3, 4], 4);
        groups
    }

    #[test]
    fn one_undo_and_one_redo_lead_over_a_whole_group() {
        let groups = grouped();
        let numbers = [0, 1, 2, 3, 4, 5];
        let undo = |done| groups.undo_to(&numbers, done);
        assert_eq!([undo(0), undo(1), undo(5)], [None; 3], "single actions");
        // Also from within: the history panel leads there.
        assert_eq!([undo(2), undo(3), undo(4)], [Some(1); 3]);
        let redo = |done| groups.redo_to(&numbers, done);
        assert_eq!([redo(0), redo(4), redo(5)], [None; 3]);
        assert_eq!([redo(1), redo(2), redo(3)], [Some(4); 3]);
    }

    #[test]
    fn a_group_whose_beginning_is_forgotten_is_undone_as_far_as_it_is_known() {
        let groups = grouped();
        assert_eq!(groups.undo_to(&[2, 3, 4], 2), Some(0));
        // Another action took the place of its last ones.
        assert_eq!(groups.redo_to(&[0, 1, 2, 9], 2), None);
        assert_eq!(groups.undo_to(&[0, 1, 2, 9], 3), None);
    }

    #[test]
    fn groups_of_one_action_and_those_that_were_given_up_do_not_count() {
        let mut groups = Groups::default();
        groups.begin(&[0], 0);
        groups.end(&[0, 1], 1);
        assert_eq!(groups.undo_to(&[0, 1], 1), None);
        groups.begin(&[0, 1], 1);
        groups.give_up();
        groups.end(&[0, 1, 2, 3], 3);
        assert_eq!(groups.undo_to(&[0, 1, 2, 3], 3), None);
        let mut groups = grouped();
        groups.begin(&[0, 1, 7], 2);
        groups.end(&[0, 1, 7, 8, 9], 4);
        assert_eq!(groups.whole, [(7, 9)], "one that cannot be reached any more is forgotten");
    }
}
