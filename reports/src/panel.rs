//! What a chart shows, as data: panels with axes and marks, and how several
//! panels are arranged.

use crate::axis::Axis;
use crate::style::{Color, WIDTH};

/// A point in the units of a panel's axes.
pub type Point = (f64, f64);

/// One thing drawn in a panel. What lies beyond an axis stands at its end.
#[derive(Debug, Clone, PartialEq)]
pub enum Mark {
    /// A curve.
    Line {
        /// Its points, from left to right.
        points: Vec<Point>,
        /// Its colour.
        color: Color,
        /// Its width in px.
        width: f64,
    },
    /// A broken line.
    Dashes {
        /// Its points.
        points: Vec<Point>,
        /// Its colour.
        color: Color,
    },
    /// Readings.
    Dots {
        /// Where they are.
        points: Vec<Point>,
        /// Their colour.
        color: Color,
        /// Their radius in px.
        radius: f64,
    },
    /// A closed area, translucent.
    Area {
        /// Its outline.
        points: Vec<Point>,
        /// Its colour.
        color: Color,
        /// From 0 to 1.
        opacity: f64,
    },
    /// A rectangle from one corner to the other.
    Bar {
        /// One corner.
        from: Point,
        /// The other.
        to: Point,
        /// Its colour.
        color: Color,
    },
    /// Names beside points, set so that they do not cover each other.
    Names {
        /// Points and names, the most important first.
        names: Vec<(Point, String)>,
        /// Dots that no name may cover.
        around: Vec<Point>,
        /// Their colour.
        color: Color,
    },
}

impl Mark {
    /// The band between two curves, `(x, low, high)` from left to right.
    #[must_use]
    pub fn band(edges: &[(f64, f64, f64)], color: Color) -> Self {
        let upper = edges.iter().map(|&(x, _, high)| (x, high));
        let lower = edges.iter().rev().map(|&(x, low, _)| (x, low));
        Self::Area { points: upper.chain(lower).collect(), color, opacity: crate::style::BAND }
    }
}

/// How a key shows what it names.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sign {
    /// A stroke.
    Line,
    /// A broken stroke.
    Dashes,
    /// A row of dots.
    Dots,
    /// A patch.
    Patch,
}

/// What of an axis is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shown {
    /// Grid lines only; a neighbour's labels hold for this panel too.
    Nothing,
    /// The labels of the ticks.
    Labels,
    /// Labels and name.
    All,
}

/// A rectangle in px.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Frame {
    /// Left edge.
    pub x: f64,
    /// Upper edge.
    pub y: f64,
    /// Width.
    pub width: f64,
    /// Height.
    pub height: f64,
}

/// A pair of axes with what is drawn in them.
#[derive(Debug, Clone, PartialEq)]
pub struct Panel {
    /// Where the axes stand; set by the arrangement.
    pub frame: Frame,
    /// Above the frame, on its left.
    pub title: String,
    /// Above the frame, before the patches.
    pub note: String,
    /// Patches of colour above the frame, on its right.
    pub patches: Vec<Color>,
    /// The axis below.
    pub x: Axis,
    /// The axis on the left.
    pub y: Axis,
    /// What of them is written; set by the arrangement.
    pub shown: (Shown, Shown),
    /// From back to front.
    pub marks: Vec<Mark>,
    /// What the marks are, above the frame behind the title.
    pub key: Vec<(Sign, Color, String)>,
}

impl Panel {
    /// A panel without title, patches and key.
    #[must_use]
    pub fn new(x: Axis, y: Axis, marks: Vec<Mark>) -> Self {
        Self {
            frame: Frame::default(),
            title: String::new(),
            note: String::new(),
            patches: Vec::new(),
            x,
            y,
            shown: (Shown::All, Shown::All),
            marks,
            key: Vec::new(),
        }
    }

    /// The same with a title.
    #[must_use]
    pub fn titled(mut self, title: impl Into<String>) -> Self {
        self.title = title.into();
        self
    }

    /// The same with a note before its patches.
    #[must_use]
    pub fn with_note(mut self, note: impl Into<String>) -> Self {
        self.note = note.into();
        self
    }

    /// The same with patches of colour behind the title.
    #[must_use]
    pub fn with_patches(mut self, patches: impl Into<Vec<Color>>) -> Self {
        self.patches = patches.into();
        self
    }

    /// The same with one more entry of its key.
    #[must_use]
    pub fn with_key(mut self, sign: Sign, color: Color, name: impl Into<String>) -> Self {
        self.key.push((sign, color, name.into()));
        self
    }
}

/// A figure of panels.
#[derive(Debug, Clone, PartialEq)]
pub struct Chart {
    /// Width in px.
    pub width: u32,
    /// Height in px.
    pub height: u32,
    /// Its panels.
    pub panels: Vec<Panel>,
    /// Names of axes that hold for all panels: below, and on the left.
    pub names: Option<(String, String)>,
}

const LEFT: f64 = 62.0;
const RIGHT: f64 = 18.0;
const TOP: f64 = 26.0;
const BOTTOM: f64 = 44.0;

impl Chart {
    /// One panel, its frame `height` px high.
    #[must_use]
    pub fn single(panel: Panel, height: f64) -> Self {
        Self::stacked(vec![(panel, height)])
    }

    /// Panels one below the other, each with the height of its frame in px.
    #[must_use]
    pub fn stacked(panels: Vec<(Panel, f64)>) -> Self {
        let mut y = 0.0;
        let width = f64::from(WIDTH) - LEFT - RIGHT;
        let placed = panels.into_iter().map(|(mut panel, height)| {
            panel.frame = Frame { x: LEFT, y: y + TOP, width, height };
            y += TOP + height + BOTTOM;
            panel
        });
        let panels = placed.collect();
        Self { width: WIDTH, height: y.ceil() as u32, panels, names: None }
    }

    /// Panels side by side, of one width, each with its own axes.
    #[must_use]
    pub fn row(panels: Vec<Panel>, height: f64) -> Self {
        let count = panels.len().max(1) as f64;
        let each = f64::from(WIDTH) / count;
        let placed = panels.into_iter().enumerate().map(|(index, mut panel)| {
            let x = index as f64 * each + LEFT;
            panel.frame = Frame { x, y: TOP, width: each - LEFT - RIGHT, height };
            panel
        });
        let panels = placed.collect();
        Self { width: WIDTH, height: (TOP + height + BOTTOM).ceil() as u32, panels, names: None }
    }

    /// Small multiples in `columns`, row by row, all on the axes of the first:
    /// labels stand on the left and below the last of each column, names once.
    #[must_use]
    pub fn small_multiples(panels: Vec<Panel>, columns: usize, height: f64) -> Self {
        let names = panels.first().map(|panel| (panel.x.name.clone(), panel.y.name.clone()));
        let (gap, title) = (10.0, 18.0);
        let columns = columns.clamp(1, panels.len().max(1));
        let room = f64::from(WIDTH) - LEFT - RIGHT - gap * (columns - 1) as f64;
        let width = room / columns as f64;
        let count = panels.len();
        let placed = panels.into_iter().enumerate().map(|(index, mut panel)| {
            let (row, column) = (index / columns, index % columns);
            panel.frame = Frame {
                x: LEFT + column as f64 * (width + gap),
                y: TOP + row as f64 * (height + gap + title),
                width,
                height,
            };
            let shown = |some: bool| if some { Shown::Labels } else { Shown::Nothing };
            panel.shown = (shown(index + columns >= count), shown(column == 0));
            panel
        });
        let panels = placed.collect();
        let rows = count.div_ceil(columns) as f64;
        let total = TOP + rows * (height + gap + title) - gap - title + BOTTOM;
        Self { width: WIDTH, height: total.ceil() as u32, panels, names }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_multiples_are_labelled_on_the_left_and_at_each_foot() {
        let axis = Axis::linear("x", "1", 0.0, 1.0, 2);
        let panel = Panel::new(axis.clone(), axis, Vec::new());
        let chart = Chart::small_multiples(vec![panel; 5], 3, 80.0);
        let x: Vec<bool> = chart.panels.iter().map(|p| p.shown.0 == Shown::Labels).collect();
        let y: Vec<bool> = chart.panels.iter().map(|p| p.shown.1 == Shown::Labels).collect();
        assert_eq!(x, [false, false, true, true, true]);
        assert_eq!(y, [true, false, false, true, false]);
        for panel in &chart.panels {
            let Frame { x, y, width, height } = panel.frame;
            assert!(x + width <= f64::from(chart.width), "{:?}", panel.frame);
            assert!(y + height <= f64::from(chart.height), "{:?}", panel.frame);
        }
    }
}
