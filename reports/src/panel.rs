//! Charts as data: panels with axes and marks, and arrangements of several panels.

use spectra::Grid;

use crate::style::{Color, WIDTH};

/// A point (x, y) in the units of a panel's axes.
pub type Point = (f64, f64);

/// One mark in a panel. We draw points beyond the end of an axis at this end.
#[derive(Debug, Clone, PartialEq)]
pub enum Mark {
    /// A solid curve.
    Line {
        /// Points from left to right.
        points: Vec<Point>,
        /// Colour of the line.
        color: Color,
        /// Line width in px.
        width: f64,
    },
    /// A dashed line.
    Dashes {
        /// Points from left to right.
        points: Vec<Point>,
        /// Colour of the line.
        color: Color,
    },
    /// Dots, e.g. readings.
    Dots {
        /// Centres of the dots.
        points: Vec<Point>,
        /// Colour of the dots.
        color: Color,
        /// Radius in px.
        radius: f64,
    },
    /// A translucent polygon.
    Area {
        /// Corners in order. The last joins the first.
        points: Vec<Point>,
        /// Fill colour of the shape.
        color: Color,
        /// Opacity from 0 to 1.
        opacity: f64,
    },
    /// A filled rectangle.
    Bar {
        /// One corner of the rectangle.
        from: Point,
        /// The opposite corner.
        to: Point,
        /// Fill colour of the shape.
        color: Color,
    },
    /// Labels next to points, placed so that they do not overlap. We leave out labels without
    /// space.
    Names {
        /// Points and labels, the most important first.
        names: Vec<(Point, String)>,
        /// Centres of dots that no label may cover.
        around: Vec<Point>,
        /// Colour of the text.
        color: Color,
    },
}

impl Mark {
    /// The band between two curves, given as `(x, low, high)` from left to right.
    #[must_use]
    pub fn band(edges: &[(f64, f64, f64)], color: Color) -> Self {
        let upper = edges.iter().map(|&(x, _, high)| (x, high));
        let lower = edges.iter().rev().map(|&(x, low, _)| (x, low));
        Self::Area { points: upper.chain(lower).collect(), color, opacity: crate::style::BAND }
    }
}

/// Symbol of an entry in the key (legend).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum KeySymbol {
    /// A short solid line.
    Line,
    /// A short dashed line.
    Dashes,
    /// Three dots in a row.
    Dots,
    /// A filled square, as a bar is.
    Patch,
    /// A square of this many translucent bands ([`Mark::band`]) over each other.
    Bands(u8),
}

/// Labels that we write along an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AxisLabels {
    /// None, because the labels of a neighbouring panel count for this one too.
    None,
    /// Tick labels only.
    Ticks,
    /// Tick labels and the name of the axis.
    All,
}

/// A rectangle in px. Y points down.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Frame {
    /// Left edge in px.
    pub x: f64,
    /// Upper edge in px.
    pub y: f64,
    /// Width in px.
    pub width: f64,
    /// Height in px.
    pub height: f64,
}

/// A pair of axes and the marks drawn in them.
#[derive(Debug, Clone, PartialEq)]
pub struct Panel {
    /// The rectangle between the axes. You need not set this: an arrangement ([`Chart::stacked`]
    /// and others) does.
    pub frame: Frame,
    /// Title above the frame, on the left, or empty for none.
    pub title: String,
    /// Small text between title and frame, or empty for none.
    pub subtitle: String,
    /// Note above the frame, left of the patches, or empty for none.
    pub note: String,
    /// Patches of colour above the frame, on its right.
    pub patches: Vec<Color>,
    /// The horizontal axis.
    pub x: Axis,
    /// The vertical axis.
    pub y: Axis,
    /// Labels of the horizontal and vertical axis. The arrangement sets this too.
    pub labels: (AxisLabels, AxisLabels),
    /// Marks in the order of drawing, back to front.
    pub marks: Vec<Mark>,
    /// Entries of the key, above the frame to the right of the title.
    pub key: Vec<(KeySymbol, Color, String)>,
}

impl Panel {
    /// A panel without title, patches and key.
    #[must_use]
    pub fn new(x: Axis, y: Axis, marks: Vec<Mark>) -> Self {
        Self {
            frame: Frame::default(),
            title: String::new(),
            subtitle: String::new(),
            note: String::new(),
            patches: Vec::new(),
            x,
            y,
            labels: (AxisLabels::All, AxisLabels::All),
            marks,
            key: Vec::new(),
        }
    }

    /// Sets the title.
    #[must_use]
    pub fn with_title(mut self, title: impl Into<String>) -> Self {
        self.title = title.into();
        self
    }

    /// Sets the small text between title and frame.
    #[must_use]
    pub fn with_subtitle(mut self, subtitle: impl Into<String>) -> Self {
        self.subtitle = subtitle.into();
        self
    }

    /// Sets the note left of the patches.
    #[must_use]
    pub fn with_note(mut self, note: impl Into<String>) -> Self {
        self.note = note.into();
        self
    }

    /// Sets the patches of colour above the frame.
    #[must_use]
    pub fn with_patches(mut self, patches: impl Into<Vec<Color>>) -> Self {
        self.patches = patches.into();
        self
    }

    /// Adds an entry to the key.
    #[must_use]
    pub fn with_key(mut self, symbol: KeySymbol, color: Color, name: impl Into<String>) -> Self {
        self.key.push((symbol, color, name.into()));
        self
    }
}

/// A drawing that consists of panels.
#[derive(Debug, Clone, PartialEq)]
pub struct Chart {
    /// Width in px.
    pub width: u32,
    /// Height in px.
    pub height: u32,
    /// The panels, each with its frame in the chart.
    pub panels: Vec<Panel>,
    /// Names of a horizontal and a vertical axis that hold for all panels, or `None` if each panel
    /// names its own.
    pub names: Option<(String, String)>,
}

const LEFT: f64 = 62.0;
const RIGHT: f64 = 18.0;
const TOP: f64 = 26.0;
const BOTTOM: f64 = 44.0;
/// Height for the subtitle of a panel in px: two lines.
pub(crate) const SUBTITLE: f64 = 23.0;

impl Chart {
    /// A chart with one panel. Its frame is `height` px high.
    #[must_use]
    pub fn single(panel: Panel, height: f64) -> Self {
        Self::stacked(vec![(panel, height)])
    }

    /// Panels below each other, each with the height of its frame in px.
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

    /// Panels of equal width side by side, each with its own axes. Frames are `height` px high.
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

    /// Small multiples in `columns`, filled row by row, with frames `height` px high. All share the
    /// axes of the first panel. You see tick labels on the left and below the last panel of each
    /// column, and the names of the axes once.
    #[must_use]
    pub fn small_multiples(panels: Vec<Panel>, columns: usize, height: f64) -> Self {
        let names = panels.first().map(|panel| (panel.x.name.clone(), panel.y.name.clone()));
        let subtitled = panels.iter().any(|panel| !panel.subtitle.is_empty());
        let subtitle = if subtitled { SUBTITLE } else { 0.0 };
        let gap = 10.0;
        let title = 18.0 + subtitle;
        let top = TOP + subtitle;
        let columns = columns.clamp(1, panels.len().max(1));
        let free_width = f64::from(WIDTH) - LEFT - RIGHT - gap * (columns - 1) as f64;
        let width = free_width / columns as f64;
        let count = panels.len();
        let placed = panels.into_iter().enumerate().map(|(index, mut panel)| {
            let row = index / columns;
            let column = index % columns;
            panel.frame = Frame {
                x: LEFT + column as f64 * (width + gap),
                y: top + row as f64 * (height + gap + title),
                width,
                height,
            };
            let [x, y] = [index + columns >= count, column == 0]
                .map(|ticks| if ticks { AxisLabels::Ticks } else { AxisLabels::None });
            panel.labels = (x, y);
            panel
        });
        let panels = placed.collect();
        let rows = count.div_ceil(columns) as f64;
        let total = top + rows * (height + gap + title) - gap - title + BOTTOM;
        Self { width: WIDTH, height: total.ceil() as u32, panels, names }
    }
}

/// Mapping of values to positions along an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scale {
    /// Position proportional to the value.
    Linear,
    /// Position proportional to the logarithm of the value.
    Log,
}

/// One axis of a chart.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// Quantity and unit, e.g. `Wavelength (nm)`.
    pub name: String,
    /// Value at the low end.
    pub low: f64,
    /// Value at the high end.
    pub high: f64,
    /// Linear or logarithmic scale.
    pub scale: Scale,
    /// Values of the ticks, with their labels.
    pub ticks: Vec<(f64, String)>,
}

impl Axis {
    /// A linear axis from `low` to `high` with about `count` ticks at round numbers.
    #[must_use]
    pub fn linear(quantity: &str, unit: &str, low: f64, high: f64, count: usize) -> Self {
        let high = if high > low { high } else { low + 1.0 };
        let step = round_step((high - low) / count.max(1) as f64);
        let digits = (-step.log10().floor()).max(0.0) as usize;
        let first = (low / step - 1e-9).ceil() as i64;
        let last = (high / step + 1e-9).floor() as i64;
        let ticks = (first..=last).map(|i| {
            let value = i as f64 * step;
            (value, format!("{value:.digits$}"))
        });
        Self {
            name: named(quantity, unit),
            low,
            high,
            scale: Scale::Linear,
            ticks: ticks.collect(),
        }
    }

    /// A linear axis that includes `low` to `high` and ends at ticks.
    #[must_use]
    pub fn around(quantity: &str, unit: &str, low: f64, high: f64, count: usize) -> Self {
        let high = if high > low { high } else { low + 1.0 };
        let step = round_step((high - low) / count.max(1) as f64);
        let low = (low / step + 1e-9).floor() * step;
        let high = (high / step - 1e-9).ceil() * step;
        Self::linear(quantity, unit, low, high, count)
    }

    /// A logarithmic axis of whole decades that includes `low` to `high`, but only the uppermost
    /// `decades` of them. We draw values below the axis, including 0, at its low end.
    #[must_use]
    pub fn log(quantity: &str, unit: &str, low: f64, high: f64, decades: i32) -> Self {
        let top = if high > 0.0 { (high.log10() - 1e-9).ceil() as i32 } else { 0 };
        let foot = if low > 0.0 { (low.log10() + 1e-9).floor() as i32 } else { top - decades };
        let foot = foot.clamp(top - decades, top - 1);
        let stride = if top - foot > 4 { 2 } else { 1 };
        let ticks = (foot..=top).filter(|power| (top - power) % stride == 0).map(|power| {
            let value = 10_f64.powi(power);
            let label =
                if (-3..=4).contains(&power) { format!("{value}") } else { format!("1e{power}") };
            (value, label)
        });
        Self {
            name: named(quantity, unit),
            low: 10_f64.powi(foot),
            high: 10_f64.powi(top),
            scale: Scale::Log,
            ticks: ticks.collect(),
        }
    }

    /// A logarithmic axis that includes `low` to `high` and ends at 1, 2 or 5 times a power of ten,
    /// with ticks at all of these. Use this if the values span little more than a decade.
    #[must_use]
    pub fn log_close(quantity: &str, unit: &str, low: f64, high: f64) -> Self {
        let round: Vec<f64> = (-9..=9)
            .flat_map(|power| [1.0, 2.0, 5.0].map(|step| step * 10_f64.powi(power)))
            .collect();
        let below = round.iter().rposition(|v| *v <= low.max(1e-9) * (1.0 + 1e-9)).unwrap_or(0);
        let above = round.iter().position(|v| *v >= high * (1.0 - 1e-9));
        let above = above.unwrap_or(round.len() - 1).clamp(1, round.len() - 1).max(below + 1);
        let below = below.min(above - 1);
        let ticks = round[below..=above].iter().map(|&value| {
            let digits = (-value.log10() - 1e-9).ceil().max(0.0) as usize;
            (value, format!("{value:.digits$}"))
        });
        let low = round[below];
        let high = round[above];
        let ticks = ticks.collect();
        Self { name: named(quantity, unit), low, high, scale: Scale::Log, ticks }
    }

    /// The wavelength axis of all figures: 380 to 730 nm, extended if `grid` reaches further, with
    /// a tick every `every_nm`.
    #[must_use]
    pub fn wavelength(grid: Grid, every_nm: u32) -> Self {
        let low = 10.0 * (grid.start_nm().min(380.0) / 10.0).floor();
        let high = 10.0 * (grid.end_nm().max(730.0) / 10.0).ceil();
        let every = f64::from(every_nm);
        let ticks = ((low / every).ceil() as i64..=(high / every).floor() as i64)
            .map(|i| (i as f64 * every, format!("{}", i as f64 * every)));
        let ticks = ticks.collect();
        Self { name: named("Wavelength", "nm"), low, high, scale: Scale::Linear, ticks }
    }

    /// An axis of reflectance from 0 to 1, or to `high` rounded up to 0.2 if that is larger.
    #[must_use]
    pub fn reflectance(high: f64, count: usize) -> Self {
        let high = if high <= 1.0 { 1.0 } else { (high * 5.0).ceil() / 5.0 };
        Self::linear("Reflectance", "white = 1", 0.0, high, count)
    }

    /// Position of `value` along the axis, 0 at the low and 1 at the high end. This clamps values
    /// beyond an end to it.
    #[must_use]
    pub fn place(&self, value: f64) -> f64 {
        let along = |v: f64| match self.scale {
            Scale::Linear => v,
            Scale::Log => v.max(self.low).log10(),
        };
        let low = along(self.low);
        let high = along(self.high);
        ((along(value) - low) / (high - low)).clamp(0.0, 1.0)
    }
}

fn named(quantity: &str, unit: &str) -> String {
    format!("{quantity} ({unit})")
}

/// The smallest of 1, 2 or 5 times a power of ten that is at least `rough`.
fn round_step(rough: f64) -> f64 {
    let power = 10_f64.powf(rough.log10().floor());
    let steps = [1.0, 2.0, 5.0, 10.0].map(|step| step * power);
    steps.into_iter().find(|step| *step >= rough * (1.0 - 1e-9)).unwrap_or(10.0 * power)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_multiples_have_tick_labels_on_the_left_and_below_each_column() {
        let axis = Axis::linear("x", "1", 0.0, 1.0, 2);
        let panel = Panel::new(axis.clone(), axis, Vec::new());
        let chart = Chart::small_multiples(vec![panel; 5], 3, 80.0);
        let x: Vec<bool> = chart.panels.iter().map(|p| p.labels.0 == AxisLabels::Ticks).collect();
        let y: Vec<bool> = chart.panels.iter().map(|p| p.labels.1 == AxisLabels::Ticks).collect();
        assert_eq!(x, [false, false, true, true, true]);
        assert_eq!(y, [true, false, false, true, false]);
        for panel in &chart.panels {
            let Frame { x, y, width, height } = panel.frame;
            assert!(x + width <= f64::from(chart.width), "{:?}", panel.frame);
            assert!(y + height <= f64::from(chart.height), "{:?}", panel.frame);
        }
    }

    fn labels(axis: &Axis) -> Vec<&str> {
        axis.ticks.iter().map(|(_, label)| label.as_str()).collect()
    }

    #[test]
    fn ticks_are_round_and_within() {
        assert_eq!(labels(&Axis::linear("x", "1", 0.0, 1.0, 4)), ["0.0", "0.5", "1.0"]);
        assert_eq!(labels(&Axis::linear("x", "1", -0.03, 0.03, 3)), ["-0.02", "0.00", "0.02"]);
        let around = Axis::around("x", "1", 0.0, 20.9, 5);
        assert_eq!((around.low, around.high), (0.0, 25.0));
        assert_eq!(labels(&around), ["0", "5", "10", "15", "20", "25"]);
    }

    #[test]
    fn a_log_axis_spans_whole_decades_and_places_zero_at_its_low_end() {
        let axis = Axis::log("K", "1", 0.0, 70.0, 4);
        assert_eq!((axis.low, axis.high), (0.01, 100.0));
        assert_eq!(labels(&axis), ["0.01", "0.1", "1", "10", "100"]);
        assert_eq!(axis.place(0.0), 0.0);
        assert!((axis.place(1.0) - 0.5).abs() < 1e-12);
        assert_eq!(axis.place(1e9), 1.0);
    }

    #[test]
    fn a_close_log_axis_ends_at_one_two_or_five() {
        let axis = Axis::log_close("x", "1", 0.19, 20.9);
        assert_eq!(labels(&axis), ["0.1", "0.2", "0.5", "1", "2", "5", "10", "20", "50"]);
        let axis = Axis::log_close("x", "1", 0.0, 0.0);
        assert!(axis.low > 0.0 && axis.high > axis.low, "{axis:?}");
    }

    #[test]
    fn libraries_share_one_wavelength_axis_unless_they_reach_further() {
        let of = |start, count| Axis::wavelength(Grid::from_nm(start, 10.0, count).unwrap(), 100);
        assert_eq!(of(400.0, 31), of(380.0, 36));
        assert_eq!(of(360.0, 48).low, 360.0);
        assert_eq!(labels(&of(400.0, 31)), ["400", "500", "600", "700"]);
    }
}
