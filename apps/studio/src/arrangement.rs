//! Arrangement of the panels as data: columns of groups of tabs. Functions of it select, move and
//! fold panels and share the height.

use std::ops::RangeInclusive;

use serde::{Deserialize, Serialize};

use crate::theme;

/// Range of the width of a column, in points.
pub const WIDTHS: RangeInclusive<f32> = 240.0..=720.0;

/// Range of heights that a file may give, in points.
const HEIGHTS: RangeInclusive<f32> = 60.0..=4000.0;

/// Side of the window for a column of panels.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// Beside the toolbar.
    Left,
    /// At the right edge.
    Right,
}

impl Side {
    /// Both sides of the window.
    pub const ALL: [Self; 2] = [Self::Left, Self::Right];

    /// The other side.
    #[must_use]
    pub fn other(self) -> Self {
        match self {
            Self::Left => Self::Right,
            Self::Right => Self::Left,
        }
    }
}

/// Panels that share a place. You see one of them.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Group {
    /// Keys of the panels in the order of their tabs.
    pub panels: Vec<String>,
    /// Index of the panel that you see.
    pub chosen: usize,
    /// Whether you see only the tabs.
    pub folded: bool,
    /// Height below the tabs that you chose, in points; `None` uses the height of the panel.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub height: Option<f32>,
}

/// Groups from the top down.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Column {
    /// Width in points, within [`WIDTHS`].
    pub width: f32,
    /// The groups. Without any, there is no column.
    pub groups: Vec<Group>,
}

impl Default for Column {
    fn default() -> Self {
        Self { width: theme::PANEL_WIDTH, groups: Vec::new() }
    }
}

/// The place of every panel.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Arrangement {
    /// Column beside the toolbar.
    pub left: Column,
    /// Column at the right edge.
    pub right: Column,
    /// Height of palette and tubes that you chose, in points; `None` uses a share of the window.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub palette_height: Option<f32>,
}

impl Arrangement {
    /// Groups of panels in the right column.
    #[must_use]
    pub fn in_right_column(groups: &[&[&str]]) -> Self {
        let right = Column {
            groups: groups
                .iter()
                .map(|panels: &&[&str]| Group {
                    panels: panels.iter().map(|&key| key.to_owned()).collect(),
                    ..Group::default()
                })
                .collect(),
            ..Column::default()
        };
        Self { right, ..Self::default() }
    }

    /// The column at this side.
    #[must_use]
    pub fn column(&self, side: Side) -> &Column {
        match side {
            Side::Left => &self.left,
            Side::Right => &self.right,
        }
    }

    /// The column at this side, so that you can change it.
    pub fn column_mut(&mut self, side: Side) -> &mut Column {
        match side {
            Side::Left => &mut self.left,
            Side::Right => &mut self.right,
        }
    }

    /// Side and index of the group with this panel, and the panel's index in it.
    #[must_use]
    pub fn position(&self, key: &str) -> Option<(Side, usize, usize)> {
        Side::ALL.into_iter().find_map(|side| {
            self.column(side).groups.iter().enumerate().find_map(|(group, tabs)| {
                let tab = tabs.panels.iter().position(|panel| panel == key)?;
                Some((side, group, tab))
            })
        })
    }

    /// Drops panels that `standard` does not have, and duplicates. Adds missing panels to the group
    /// of their standard neighbours. Moves all numbers into range.
    pub fn bound(&mut self, standard: &Self) {
        self.bound_numbers();
        let mut seen: Vec<String> = Vec::new();
        for side in Side::ALL {
            for group in &mut self.column_mut(side).groups {
                group.panels.retain(|key| {
                    let keep = standard.position(key).is_some() && !seen.contains(key);
                    if keep {
                        seen.push(key.clone());
                    }
                    keep
                });
            }
        }
        self.remove_empty_groups();
        for side in Side::ALL {
            for group in &standard.column(side).groups {
                for key in &group.panels {
                    if !seen.contains(key) {
                        self.append(key, group, side);
                    }
                }
            }
        }
    }

    /// Adds a panel to the group that has another one of `group`, or else to a new group.
    fn append(&mut self, key: &str, group: &Group, side: Side) {
        let neighbour = group.panels.iter().find_map(|other| self.position(other));
        match neighbour {
            Some((side, group, _)) => {
                self.column_mut(side).groups[group].panels.push(key.to_owned());
            }
            None => {
                let panels = vec![key.to_owned()];
                self.column_mut(side).groups.push(Group { panels, ..Group::default() });
            }
        }
    }

    /// Removes groups without panels, and keeps the chosen tabs within their groups.
    fn remove_empty_groups(&mut self) {
        for side in Side::ALL {
            let groups = &mut self.column_mut(side).groups;
            groups.retain(|group| !group.panels.is_empty());
            for group in groups {
                group.chosen = group.chosen.min(group.panels.len() - 1);
            }
        }
    }

    fn bound_numbers(&mut self) {
        self.palette_height = self.palette_height.filter(|height| HEIGHTS.contains(height));
        for side in Side::ALL {
            let column = self.column_mut(side);
            // NaN lies in no range.
            if !WIDTHS.contains(&column.width) {
                column.width = theme::PANEL_WIDTH;
            }
            for group in &mut column.groups {
                group.height = group.height.filter(|height| HEIGHTS.contains(height));
            }
        }
    }

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

    /// The place to which this step moves the panel. `None` if the panel is there already or there
    /// is no such place.
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

    /// Moves a panel to a place and shows it. This does nothing if there is no such panel or place,
    /// or if the panel is there already.
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

/// A place for a panel. Indices count the groups of the column before the move.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// Among the tabs of a group.
    Tab(Side, usize),
    /// In its own group, before the group with this index, or after the last one.
    Before(Side, usize),
}

/// A step that the menu of a panel offers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Move {
    /// To a group of its own above its present group. If it is alone in its group, it goes above
    /// the group before.
    Up,
    /// To a group of its own below its present group. If it is alone in its group, it goes below
    /// the group after.
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

/// Height below its tabs that a group needs, in points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HeightRequest {
    /// Whether you folded it.
    pub folded: bool,
    /// Height that shows all of it, or the height that you chose.
    pub wanted: f32,
    /// Whether you should see all of it, rather than a part that scrolls.
    pub whole: bool,
    /// Counter of the last use. The group used last stays open longest.
    pub last_used: u64,
}

/// A panel that scrolls may shrink to this height, in points.
const LEAST: f32 = 192.0;

/// Shares `room` points among groups from the top down. A panel with `whole` gets its wanted
/// height, at most all of `room`. Others may scroll. If they do not fit, this folds the groups that
/// you have not used for longest. Returns the height of each, `None` for a folded one. The last
/// open group gets the remaining height.
#[must_use]
pub fn heights(requests: &[HeightRequest], room: f32) -> Vec<Option<f32>> {
    let least =
        |request: &HeightRequest| request.wanted.min(if request.whole { room } else { LEAST });
    let mut open: Vec<bool> = requests.iter().map(|request| !request.folded).collect();
    let opened = loop {
        let opened: Vec<usize> = (0..requests.len()).filter(|&index| open[index]).collect();
        let needed: f32 = opened.iter().map(|&index| least(&requests[index])).sum();
        // If several were never used, we fold the lowest.
        let oldest = opened.iter().copied().rev().min_by_key(|&index| requests[index].last_used);
        match oldest {
            Some(oldest) if needed > room && opened.len() > 1 => open[oldest] = false,
            _ => break opened,
        }
    };
    let mut shared: Vec<Option<f32>> = vec![None; requests.len()];
    let mut left = room - opened.iter().map(|&index| least(&requests[index])).sum::<f32>();
    for &index in &opened {
        let least = least(&requests[index]);
        let more = (requests[index].wanted - least).min(left).max(0.0);
        left -= more;
        shared[index] = Some(least + more);
    }
    if let Some(&last) = opened.last() {
        shared[last] = shared[last].map(|height| (height + left).max(0.0));
    }
    shared
}

#[cfg(test)]
mod moves_tests {
    use super::*;

    fn standard() -> Arrangement {
        Arrangement::in_right_column(&[&["brush", "layers"], &["light", "color"], &["files"]])
    }

    fn written(arrangement: &Arrangement) -> String {
        let [left, right] = [Side::Left, Side::Right].map(|side| {
            let groups = arrangement.column(side).groups.iter();
            groups.map(|group| group.panels.join("+")).collect::<Vec<_>>().join(" ")
        });
        format!("{left}|{right}")
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
        for (key, step, wanted) in [
            ("files", Move::Down, None),
            ("files", Move::JoinBelow, None),
            ("layers", Move::JoinAbove, None),
            ("files", Move::Up, Some("|brush+layers files light+color")),
            ("brush", Move::Down, Some("|layers brush light+color files")),
            ("color", Move::OtherColumn, Some("color|brush+layers light files")),
        ] {
            let arrangement = standard().place_after(key, step).map(|place| moved(key, place));
            assert_eq!(arrangement.as_deref(), wanted, "{key} {step:?}");
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn standard() -> Arrangement {
        Arrangement::in_right_column(&[&["brush", "layers"], &["light", "color", "files"]])
    }

    fn keys(arrangement: &Arrangement, side: Side) -> Vec<Vec<&str>> {
        let groups = arrangement.column(side).groups.iter();
        groups.map(|group| group.panels.iter().map(String::as_str).collect()).collect()
    }

    #[test]
    fn unknown_panels_are_dropped_and_missing_ones_join_their_neighbours() {
        let mut read: Arrangement = serde_json::from_str(
            r#"{"left": {"width": 300, "groups": [{"panels": ["color", "oracle"], "chosen": 1}]},
                "right": {"groups": [{"panels": ["oracle"]}, {"panels": ["layers", "layers"]}]}}"#,
        )
        .unwrap();
        read.bound(&standard());
        assert_eq!(keys(&read, Side::Left), [["color", "light", "files"]]);
        assert_eq!(keys(&read, Side::Right), [["layers", "brush"]]);
        assert_eq!(read.left.groups[0].chosen, 0, "the chosen tab is no longer there");
        assert_eq!(read.left.width, 300.0);
    }

    #[test]
    fn an_empty_file_gives_the_standard() {
        let mut read: Arrangement = serde_json::from_str("{}").unwrap();
        read.bound(&standard());
        assert_eq!(read, standard());
    }

    #[test]
    fn sizes_out_of_range_are_replaced() {
        let mut read = standard();
        read.left.width = f32::NAN;
        read.right.width = 9e9;
        read.right.groups[0].height = Some(-3.0);
        read.palette_height = Some(f32::INFINITY);
        read.bound(&standard());
        assert_eq!(read, standard());
    }

    #[test]
    fn an_arrangement_survives_writing_and_reading() {
        let mut written = standard();
        written.right.groups[1] = Group {
            chosen: 2,
            folded: true,
            height: Some(320.0),
            ..written.right.groups[1].clone()
        };
        written.palette_height = Some(300.0);
        let text = serde_json::to_string(&written).unwrap();
        let mut read: Arrangement = serde_json::from_str(&text).unwrap();
        read.bound(&standard());
        assert_eq!(read, written);
    }

    fn request(wanted: f32, whole: bool, last_used: u64) -> HeightRequest {
        HeightRequest { folded: false, wanted, whole, last_used }
    }

    #[test]
    fn a_panel_that_should_be_whole_is_and_another_takes_the_rest() {
        let brush = request(510.0, true, 0);
        let light = request(560.0, false, 1);
        assert_eq!(heights(&[brush, light], 880.0), [Some(510.0), Some(370.0)]);
        assert_eq!(heights(&[light, brush], 880.0), [Some(370.0), Some(510.0)]);
        // In a column too low for it, it gets all of the room while you use it.
        let brush = request(510.0, true, 2);
        assert_eq!(heights(&[brush, light], 480.0), [Some(480.0), None]);
    }

    #[test]
    fn without_room_the_group_used_last_stays_open() {
        fn share(uses: [u64; 2]) -> Vec<Option<f32>> {
            let brush = request(510.0, true, uses[0]);
            let light = request(800.0, false, uses[1]);
            heights(&[brush, light], 680.0)
        }
        assert_eq!(share([2, 1]), [Some(680.0), None]);
        assert_eq!(share([1, 2]), [None, Some(680.0)]);
        assert_eq!(share([0, 0]), [Some(680.0), None], "the upper one is open at first");
        // One group stays open, however low the column is.
        assert_eq!(heights(&[request(510.0, true, 1)], 90.0), [Some(90.0)]);
    }

    #[test]
    fn folded_groups_take_nothing_and_the_last_open_one_fills_the_column() {
        let folded = HeightRequest { folded: true, ..request(300.0, true, 9) };
        let open = [request(100.0, true, 0), request(200.0, true, 1), folded];
        assert_eq!(heights(&open, 1000.0), [Some(100.0), Some(900.0), None]);
        assert_eq!(heights(&[folded, folded], 1000.0), [None, None]);
        assert!(heights(&[], 1000.0).is_empty());
    }

    #[test]
    fn heights_fill_the_room_and_none_is_negative() {
        for room in [0.0, 150.0, 500.0, 900.0, 2000.0] {
            for wanted in [[50.0, 400.0, 900.0], [900.0, 900.0, 900.0], [10.0, 10.0, 10.0]] {
                let [a, b, c] = wanted;
                let requests = [request(a, true, 3), request(b, false, 1), request(c, true, 2)];
                let shared = heights(&requests, room);
                let sum: f32 = shared.iter().flatten().sum();
                assert!((sum - room).abs() < 1e-3, "{wanted:?} in {room}: {shared:?}");
                assert!(shared.iter().flatten().all(|&height| height >= 0.0), "{shared:?}");
            }
        }
    }
}
