//! Selecting, folding and moving of panels.

use super::groups::{Arrangement, Group, Side};

/// A place for a panel. Indices count the groups of the column before the move.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// Among the tabs of a group.
    Tab(Side, usize),
    /// In a group of its own, before the group with this index, or after the last one.
    Before(Side, usize),
}

/// A step that the menu of a panel offers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Move {
    /// Above the group, or above the one before.
    Up,
    /// Below the group, or below the one after.
    Down,
    /// To the end of the other column.
    OtherColumn,
    /// Among the tabs of the group above.
    JoinAbove,
    /// Among the tabs of the group below.
    JoinBelow,
}

impl Move {
    /// All moves in the order of the menu.
    pub const ALL: [Self; 5] =
        [Self::Up, Self::Down, Self::OtherColumn, Self::JoinAbove, Self::JoinBelow];
}

impl Arrangement {
    /// Shows a panel: selects its tab and unfolds its group.
    pub fn select(&mut self, key: &str) {
        if let Some((side, group, tab)) = self.position(key) {
            let group = &mut self.column_mut(side).groups[group];
            group.chosen = tab;
            group.folded = false;
        }
    }

    /// Folds or unfolds the group of a panel.
    pub fn fold(&mut self, key: &str, folded: bool) {
        if let Some((side, group, _)) = self.position(key) {
            self.column_mut(side).groups[group].folded = folded;
        }
    }

    /// The place to which a move brings a panel; `None` if it is there already or there is
    /// no such place.
    #[must_use]
    pub fn place_after(&self, key: &str, step: Move) -> Option<Place> {
        let (side, group, _) = self.position(key)?;
        let groups = &self.column(side).groups;
        let first = group == 0;
        let last = group + 1 == groups.len();
        let alone = groups[group].panels.len() == 1;
        match step {
            Move::Up if alone => (!first).then(|| Place::Before(side, group - 1)),
            Move::Up => Some(Place::Before(side, group)),
            Move::Down if alone => (!last).then_some(Place::Before(side, group + 2)),
            Move::Down => Some(Place::Before(side, group + 1)),
            Move::OtherColumn => {
                let other = side.other();
                Some(Place::Before(other, self.column(other).groups.len()))
            }
            Move::JoinAbove => (!first).then(|| Place::Tab(side, group - 1)),
            Move::JoinBelow => (!last).then_some(Place::Tab(side, group + 1)),
        }
    }

    /// Moves a panel and shows it there. Does nothing if there is no such panel or place, or
    /// if it is there already.
    pub fn move_to(&mut self, key: &str, place: Place) {
        let Some((side, group, tab)) = self.position(key) else { return };
        let (Place::Tab(to, at) | Place::Before(to, at)) = place;
        let count = self.column(to).groups.len();
        let exists = at < count || (at == count && matches!(place, Place::Before(..)));
        if !exists || place == Place::Tab(side, group) {
            return;
        }
        // The emptied group stays until the end, so that indices remain valid.
        let from = &mut self.column_mut(side).groups[group];
        let panel = from.panels.remove(tab);
        from.chosen = from.chosen.saturating_sub(usize::from(tab < from.chosen));
        let groups = &mut self.column_mut(to).groups;
        match place {
            Place::Tab(..) => groups[at].panels.push(panel),
            Place::Before(..) => {
                groups.insert(at, Group { panels: vec![panel], ..Group::default() });
            }
        }
        self.remove_empty_groups();
        self.select(key);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn standard() -> Arrangement {
        Arrangement::in_right_column(&[&["brush", "layers"], &["light", "color"], &["files"]])
    }

    fn written(arrangement: &Arrangement) -> String {
        let side = |side| {
            let groups = arrangement.column(side).groups.iter();
            groups.map(|group| group.panels.join("+")).collect::<Vec<_>>().join(" ")
        };
        format!("{}|{}", side(Side::Left), side(Side::Right))
    }

    fn moved(key: &str, place: Place) -> String {
        let mut arrangement = standard();
        arrangement.move_to(key, place);
        written(&arrangement)
    }

    #[test]
    fn panels_move_between_groups_and_columns() {
        use Place::{Before, Tab};
        use Side::{Left, Right};
        assert_eq!(moved("layers", Before(Right, 0)), "|layers brush light+color files");
        assert_eq!(moved("layers", Before(Right, 3)), "|brush light+color files layers");
        assert_eq!(moved("files", Tab(Right, 0)), "|brush+layers+files light+color");
        assert_eq!(moved("files", Before(Right, 1)), "|brush+layers files light+color");
        assert_eq!(moved("color", Before(Left, 0)), "color|brush+layers light files");
        let unchanged = written(&standard());
        for (key, place) in [
            ("oracle", Tab(Right, 0)),
            ("files", Tab(Right, 3)),
            ("files", Tab(Left, 0)),
            ("files", Before(Left, 1)),
            ("brush", Tab(Right, 0)),
            ("files", Before(Right, 2)),
        ] {
            assert_eq!(moved(key, place), unchanged, "{key} to {place:?}");
        }
    }

    #[test]
    fn a_moved_panel_is_shown_and_the_others_stay_chosen() {
        let mut arrangement = standard();
        arrangement.select("layers");
        arrangement.fold("files", true);
        arrangement.move_to("brush", Place::Tab(Side::Right, 2));
        let groups = &arrangement.right.groups;
        assert_eq!(groups[0].panels[groups[0].chosen], "layers");
        assert_eq!(groups[2].panels[groups[2].chosen], "brush");
        assert!(!groups[2].folded, "what was moved is seen");
    }

    #[test]
    fn steps_of_the_menu_lead_to_places_that_exist() {
        let all = ["brush", "layers", "light", "color", "files"];
        for key in all {
            for step in Move::ALL {
                let Some(place) = standard().place_after(key, step) else { continue };
                assert_ne!(moved(key, place), written(&standard()), "{key} {step:?}");
            }
        }
        let place = |key, step| standard().place_after(key, step);
        assert_eq!(place("files", Move::Down), None);
        assert_eq!(place("files", Move::JoinBelow), None);
        assert_eq!(place("layers", Move::JoinAbove), None);
        assert_eq!(
            moved("files", place("files", Move::Up).unwrap()),
            "|brush+layers files light+color"
        );
        assert_eq!(
            moved("brush", place("brush", Move::Down).unwrap()),
            "|layers brush light+color files"
        );
        let other = place("color", Move::OtherColumn).unwrap();
        assert_eq!(moved("color", other), "color|brush+layers light files");
    }
}
