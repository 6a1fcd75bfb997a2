//! Columns, groups and panels, and reading them from a file.

use std::ops::RangeInclusive;

use serde::{Deserialize, Serialize};

use crate::theme;

/// Range of the width of a column, in points.
pub const WIDTHS: RangeInclusive<f32> = 240.0..=720.0;

/// Range of heights that a file may give, in points.
const HEIGHTS: RangeInclusive<f32> = 60.0..=4000.0;

/// Side of the window at which a column of panels stands.
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

/// Panels that share a place; one of them is shown.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Group {
    /// Keys of the panels in the order of their tabs.
    pub panels: Vec<String>,
    /// Index of the panel that is shown.
    pub chosen: usize,
    /// Whether only the tabs are shown.
    pub folded: bool,
    /// Height below the tabs that the painter chose, in points; `None` is that of the panel.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub height: Option<f32>,
}

/// Groups from the top down.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Column {
    /// Width in points, within [`WIDTHS`].
    pub width: f32,
    /// The groups; none if the column is not shown.
    pub groups: Vec<Group>,
}

impl Default for Column {
    fn default() -> Self {
        Self { width: theme::PANEL_WIDTH, groups: Vec::new() }
    }
}

/// Where all panels stand.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Arrangement {
    /// Column beside the toolbar.
    pub left: Column,
    /// Column at the right edge.
    pub right: Column,
    /// Height of palette and tubes that the painter chose, in points; `None` is a share of
    /// the window.
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

    /// The column of a side.
    #[must_use]
    pub fn column(&self, side: Side) -> &Column {
        match side {
            Side::Left => &self.left,
            Side::Right => &self.right,
        }
    }

    /// The column of a side, to be changed.
    pub fn column_mut(&mut self, side: Side) -> &mut Column {
        match side {
            Side::Left => &mut self.left,
            Side::Right => &mut self.right,
        }
    }

    /// Side and index of the group that holds a panel, and the panel's index in it.
    #[must_use]
    pub fn position(&self, key: &str) -> Option<(Side, usize, usize)> {
        Side::ALL.into_iter().find_map(|side| {
            self.column(side).groups.iter().enumerate().find_map(|(group, tabs)| {
                let tab = tabs.panels.iter().position(|panel| panel == key)?;
                Some((side, group, tab))
            })
        })
    }

    /// Drops panels that `standard` does not have, and the second of two; adds missing panels
    /// to the group of their standard neighbours; brings all numbers into range.
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

    /// Adds a panel to the group that holds another one of `group`, or else to a new one.
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
    pub(super) fn remove_empty_groups(&mut self) {
        for side in Side::ALL {
            let groups = &mut self.column_mut(side).groups;
            groups.retain(|group| !group.panels.is_empty());
            for group in groups {
                group.chosen = group.chosen.min(group.panels.len() - 1);
            }
        }
    }

    fn bound_numbers(&mut self) {
        let in_range = |height: &f32| HEIGHTS.contains(height);
        self.palette_height = self.palette_height.filter(in_range);
        for side in Side::ALL {
            let column = self.column_mut(side);
            // NaN is in no range.
            if !WIDTHS.contains(&column.width) {
                column.width = theme::PANEL_WIDTH;
            }
            for group in &mut column.groups {
                group.height = group.height.filter(in_range);
            }
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
}
