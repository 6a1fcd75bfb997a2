//! Charts drawn as SVG. This is the only file that uses the crate plotters.
//!
//! plotters rounds to whole px, which would make curves of small panels jagged. So we draw ten
//! times as large, and the view box of the document scales this down. We place the labels
//! ourselves, because plotters without a font can only guess their size.

use plotters::chart::ChartContext;
use plotters::coord::Shift;
use plotters::coord::types::RangedCoordf64;
use plotters::element::DashedPathElement;
use plotters::prelude::{
    Cartesian2d, ChartBuilder, Circle, DrawingArea, FontTransform, IntoDrawingArea, PathElement,
    Polygon, RGBColor, Rectangle, SVGBackend, ShapeStyle, Text, TextStyle,
};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{Color as _, FontFamily, IntoFont};

use crate::panel::{AxisLabels, Chart, Frame, KeySymbol, Mark, Panel, Point, SUBTITLE};
use crate::style::{BAND, CURVE, Color, FAINT, FONTS, GRID, HAIR, INK, PAPER, SMALL_TEXT, TEXT};
use crate::svg::{Anchor, estimated_width, fitted, opening};

/// Units of plotters in one px of the figure.
const FINE: f64 = 10.0;
/// Height for the title of a panel, in px.
const TITLE: f64 = 18.0;

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Axes<'a, 'b> = ChartContext<'a, SVGBackend<'b>, Cartesian2d<RangedCoordf64, RangedCoordf64>>;

impl Chart {
    /// Draws the chart as an SVG document.
    #[must_use]
    pub fn svg(&self) -> String {
        let mut text = String::new();
        {
            let size = (self.width * FINE as u32, self.height * FINE as u32);
            let area = SVGBackend::with_string(&mut text, size).into_drawing_area();
            infallible(area.fill(&rgb(PAPER)));
            for panel in &self.panels {
                Drawing { area: &area, panel }.draw();
            }
            if let Some((below, left)) = &self.names {
                let width = f64::from(self.width);
                let height = f64::from(self.height);
                write(&area, (width / 2.0, height - 14.0), TEXT, Anchor::Middle, INK, below);
                write_upwards(&area, (14.0, height / 2.0), left);
            }
            infallible(area.present());
        }
        compact(&text, &opening(self.width, self.height, FINE as u32))
    }
}

fn infallible<T, E: std::fmt::Debug>(result: Result<T, E>) -> T {
    result.expect("drawing to memory does not fail")
}

fn rgb(color: Color) -> RGBColor {
    let [r, g, b] = color.0;
    RGBColor(r, g, b)
}

fn fine(px: f64) -> i32 {
    (px * FINE).round() as i32
}

fn stroke(color: Color, width: f64) -> ShapeStyle {
    rgb(color).stroke_width(fine(width) as u32)
}

struct Drawing<'a, 'b> {
    area: &'a Area<'b>,
    panel: &'a Panel,
}

impl Drawing<'_, '_> {
    fn draw(&self) {
        let Frame { x, y, width, height } = self.panel.frame;
        let inner = self.area.clone().shrink((fine(x), fine(y)), (fine(width), fine(height)));
        let mut axes = infallible(ChartBuilder::on(&inner).build_cartesian_2d(0.0..1.0, 0.0..1.0));
        self.grid(&mut axes);
        for mark in &self.panel.marks {
            self.mark(&mut axes, mark);
        }
        self.axis_labels();
        self.heading();
    }

    /// A point as fractions of the frame, (0, 0) at the lower left.
    fn fraction(&self, point: &Point) -> Point {
        (self.panel.x.place(point.0), self.panel.y.place(point.1))
    }

    fn fractions(&self, points: &[Point]) -> Vec<Point> {
        points.iter().map(|point| self.fraction(point)).collect()
    }

    /// A point in px of the figure.
    fn px(&self, point: &Point) -> Point {
        let Frame { x, y, width, height } = self.panel.frame;
        let (right, up) = self.fraction(point);
        (x + right * width, y + (1.0 - up) * height)
    }

    fn grid(&self, axes: &mut Axes<'_, '_>) {
        let thin = stroke(GRID, HAIR);
        for (value, _) in &self.panel.x.ticks {
            let at = self.panel.x.place(*value);
            infallible(axes.draw_series([PathElement::new(vec![(at, 0.0), (at, 1.0)], thin)]));
        }
        for (value, _) in &self.panel.y.ticks {
            let at = self.panel.y.place(*value);
            infallible(axes.draw_series([PathElement::new(vec![(0.0, at), (1.0, at)], thin)]));
        }
        let foot = vec![(0.0, 1.0), (0.0, 0.0), (1.0, 0.0)];
        infallible(axes.draw_series([PathElement::new(foot, stroke(FAINT, HAIR))]));
    }

    fn mark(&self, axes: &mut Axes<'_, '_>, mark: &Mark) {
        match mark {
            Mark::Line { points, color, width } => {
                let path = PathElement::new(self.fractions(points), stroke(*color, *width));
                infallible(axes.draw_series([path]));
            }
            Mark::Dashes { points, color } => {
                let style = stroke(*color, CURVE);
                let path =
                    DashedPathElement::new(self.fractions(points), fine(6.0), fine(4.0), style);
                infallible(axes.draw_series([path]));
            }
            Mark::Dots { points, color, radius } => {
                let style = rgb(*color).filled();
                let dots = self.fractions(points).into_iter();
                infallible(axes.draw_series(dots.map(|p| Circle::new(p, fine(*radius), style))));
            }
            Mark::Area { points, color, opacity } => {
                let style = rgb(*color).mix(*opacity).filled();
                infallible(axes.draw_series([Polygon::new(self.fractions(points), style)]));
            }
            Mark::Bar { from, to, color } => {
                let corners = [self.fraction(from), self.fraction(to)];
                infallible(axes.draw_series([Rectangle::new(corners, rgb(*color).filled())]));
            }
            Mark::Names { names, around, color } => {
                let dots: Vec<Point> = around.iter().map(|at| self.px(at)).collect();
                let points: Vec<(Point, &str)> =
                    names.iter().map(|(at, name)| (self.px(at), name.as_str())).collect();
                for Placed { at, anchor, text } in
                    place_labels(&points, &dots, SMALL_TEXT, self.panel.frame)
                {
                    write(self.area, at, SMALL_TEXT, anchor, *color, text);
                }
            }
        }
    }

    fn axis_labels(&self) {
        let Panel { x, y, frame, labels, .. } = self.panel;
        let foot = frame.y + frame.height;
        if labels.0 != AxisLabels::None {
            for (value, label) in &x.ticks {
                let at = (self.px(&(*value, y.low)).0, foot + 10.0);
                write(self.area, at, SMALL_TEXT, Anchor::Middle, FAINT, label);
            }
        }
        if labels.1 != AxisLabels::None {
            for (value, label) in &y.ticks {
                let at = (frame.x - 6.0, self.px(&(x.low, *value)).1);
                write(self.area, at, SMALL_TEXT, Anchor::End, FAINT, label);
            }
        }
        if labels.0 == AxisLabels::All {
            let at = (frame.x + frame.width / 2.0, foot + 28.0);
            write(self.area, at, TEXT, Anchor::Middle, INK, &x.name);
        }
        if labels.1 == AxisLabels::All {
            write_upwards(self.area, (frame.x - 46.0, frame.y + frame.height / 2.0), &y.name);
        }
    }

    /// Draws title and key on the left, and note and patches on the right, above the frame.
    fn heading(&self) {
        let Panel { frame, title, subtitle, note, patches, key, .. } = self.panel;
        // A title of several lines ends where the subtitle begins.
        let middle = match subtitle.is_empty() {
            true => frame.y - 9.0,
            false => self.subtitle() - TITLE / 2.0,
        };
        let side = 11.0;
        let mut right = frame.x + frame.width;
        for patch in patches.iter().rev() {
            let corners = [(right - side, middle - side / 2.0), (right, middle + side / 2.0)];
            let corners = corners.map(|(x, y)| (fine(x), fine(y)));
            infallible(self.area.draw(&Rectangle::new(corners, rgb(*patch).filled())));
            right -= side;
        }
        if !note.is_empty() {
            right -= if patches.is_empty() { 0.0 } else { 5.0 };
            write(self.area, (right, middle), SMALL_TEXT, Anchor::End, FAINT, note);
            right -= estimated_width(note, SMALL_TEXT);
        }
        let mut x = frame.x;
        if !title.is_empty() {
            let space = (right - x - 2.0, TITLE);
            x += 18.0 + self.lines((x, middle), space, SMALL_TEXT, INK, title);
        }
        for (symbol, color, name) in key {
            self.key_symbol(*symbol, *color, (x, middle));
            write(self.area, (x + 24.0, middle), SMALL_TEXT, Anchor::Start, INK, name);
            x += 24.0 + estimated_width(name, SMALL_TEXT) + 18.0;
        }
    }

    /// Writes the subtitle and returns where it begins, in px.
    fn subtitle(&self) -> f64 {
        let Panel { frame, subtitle, .. } = self.panel;
        let at = (frame.x, frame.y - 4.0 - SUBTITLE / 2.0);
        self.lines(at, (frame.width, SUBTITLE), SMALL_TEXT - 1.0, FAINT, subtitle);
        frame.y - 4.0 - SUBTITLE
    }

    /// Writes a text around the height of `at`, in as many lines as `space` allows. Returns their
    /// width in px.
    fn lines(&self, at: Point, space: (f64, f64), size: f64, color: Color, text: &str) -> f64 {
        let text = fitted(text, size, space);
        for (line, below) in text.lines.iter().zip(text.offsets()) {
            write(self.area, (at.0, at.1 + below), text.size, Anchor::Start, color, line);
        }
        text.width()
    }

    fn key_symbol(&self, symbol: KeySymbol, color: Color, at: Point) {
        let (x, y) = at;
        let point = |dx: f64, dy: f64| (fine(x + dx), fine(y + dy));
        let path = vec![point(0.0, 0.0), point(18.0, 0.0)];
        match symbol {
            KeySymbol::Line => {
                infallible(self.area.draw(&PathElement::new(path, stroke(color, CURVE))));
            }
            KeySymbol::Dashes => {
                let style = stroke(color, CURVE);
                let dashes = DashedPathElement::new(path, fine(5.0), fine(3.0), style);
                infallible(self.area.draw(&dashes));
            }
            KeySymbol::Dots => {
                for dx in [2.0, 9.0, 16.0] {
                    let dot = Circle::new(point(dx, 0.0), fine(1.8), rgb(color).filled());
                    infallible(self.area.draw(&dot));
                }
            }
            KeySymbol::Bands(count) => {
                // This is not a rectangle, so that a dark page swaps its colour with the bands.
                let style = rgb(color).mix(BAND).filled();
                let corners = [(4.0, -5.0), (16.0, -5.0), (16.0, 5.0), (4.0, 5.0)];
                let corners = corners.map(|(dx, dy)| point(dx, dy));
                for _ in 0..count {
                    infallible(self.area.draw(&Polygon::new(corners, style)));
                }
            }
            KeySymbol::Patch => {
                let corners = [point(4.0, -5.0), point(16.0, 5.0)];
                infallible(self.area.draw(&Rectangle::new(corners, rgb(color).filled())));
            }
        }
    }
}

/// Draws a line of text, vertically centred at `at` in px.
fn write(area: &Area<'_>, at: Point, size: f64, anchor: Anchor, color: Color, text: &str) {
    let pos = match anchor {
        Anchor::Start => HPos::Left,
        Anchor::Middle => HPos::Center,
        Anchor::End => HPos::Right,
    };
    let style = style(size, color).pos(Pos::new(pos, VPos::Center));
    infallible(area.draw(&Text::new(text.to_owned(), (fine(at.0), fine(at.1)), style)));
}

/// Draws the name of a vertical axis, reading upwards and centred at `at` in px.
fn write_upwards(area: &Area<'_>, at: Point, text: &str) {
    let style = style(TEXT, INK)
        .transform(FontTransform::Rotate270)
        .pos(Pos::new(HPos::Center, VPos::Center));
    infallible(area.draw(&Text::new(text.to_owned(), (fine(at.0), fine(at.1)), style)));
}

fn style(size: f64, color: Color) -> TextStyle<'static> {
    // The SVG backend divides sizes by 1.24.
    let font = (FontFamily::Name(FONTS), size * FINE * 1.24).into_font();
    font.color(&rgb(color))
}

/// Replaces the opening element of the document and drops attributes that have their default.
fn compact(text: &str, opening: &str) -> String {
    let body = text.split_once(">\n").map_or(text, |(_, body)| body);
    let mut out = String::with_capacity(text.len());
    out.push_str(opening);
    let family = format!(" font-family=\"{FONTS}\"");
    out.push_str(&body.replace(" opacity=\"1\"", "").replace(&family, ""));
    out
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Placed<'a> {
    pub(crate) at: (f64, f64),
    pub(crate) anchor: Anchor,
    pub(crate) text: &'a str,
}

/// Half the side of the square kept free for a dot, in px.
const DOT: f64 = 3.5;

/// Left, top, right and bottom of a box in px.
type Edges = [f64; 4];

/// Places each label to the right, left, above or below its point, where it covers no dot and no
/// earlier label and stays in the frame. If there is no such place, this tries the part before a
/// colon alone. If that fails too, it leaves the label out.
pub(crate) fn place_labels<'a>(
    names: &[((f64, f64), &'a str)],
    dots: &[(f64, f64)],
    size: f64,
    frame: Frame,
) -> Vec<Placed<'a>> {
    let mut occupied: Vec<Edges> =
        dots.iter().map(|&(x, y)| [x - DOT, y - DOT, x + DOT, y + DOT]).collect();
    let mut placed = Vec::new();
    for &(at, text) in names {
        let short = text.split(": ").next().unwrap_or(text);
        let mut places = [text, short]
            .into_iter()
            .filter_map(|text| free_place(at, text, size, frame, &occupied));
        if let Some((edges, name)) = places.next() {
            occupied.push(edges);
            placed.push(name);
        }
    }
    placed
}

fn free_place<'a>(
    (x, y): (f64, f64),
    text: &'a str,
    size: f64,
    frame: Frame,
    occupied: &[Edges],
) -> Option<(Edges, Placed<'a>)> {
    let width = estimated_width(text, size);
    let tries = [
        (x + 6.0, y, Anchor::Start),
        (x - 6.0, y, Anchor::End),
        (x, y - size, Anchor::Middle),
        (x, y + size, Anchor::Middle),
        (x + 6.0, y - size, Anchor::Start),
        (x - 6.0, y - size, Anchor::End),
        (x + 6.0, y + size, Anchor::Start),
        (x - 6.0, y + size, Anchor::End),
    ];
    tries.into_iter().find_map(|(x, y, anchor)| {
        let left = match anchor {
            Anchor::Start => x,
            Anchor::Middle => x - width / 2.0,
            Anchor::End => x - width,
        };
        let edges = [left, y - 0.6 * size, left + width, y + 0.6 * size];
        let [left, top, right, bottom] = edges;
        let inside = left >= frame.x
            && right <= frame.x + frame.width + 10.0
            && top >= frame.y - 4.0
            && bottom <= frame.y + frame.height;
        let free = inside
            && !occupied
                .iter()
                .any(|[l, t, r, b]: &Edges| left < *r && *l < right && top < *b && *t < bottom);
        free.then_some((edges, Placed { at: (x, y), anchor, text }))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_do_not_overlap_and_stay_in_the_frame() {
        let frame = Frame { x: 0.0, y: 0.0, width: 100.0, height: 50.0 };
        let points = [((50.0, 25.0), "one"), ((51.0, 25.0), "two"), ((99.0, 5.0), "edge")];
        let placed = place_labels(&points, &[], 10.0, frame);
        assert_eq!(placed.len(), 3);
        assert_eq!(placed[0].anchor, Anchor::Start);
        assert_eq!(placed[1].anchor, Anchor::End);
        assert_eq!(placed[2].anchor, Anchor::End);
        let narrow = Frame { width: 50.0, ..frame };
        let cut = place_labels(&[((40.0, 25.0), "17F: a long recipe")], &[], 10.0, narrow);
        assert_eq!((cut[0].text, cut.len()), ("17F", 1));
        let next_to_dot = place_labels(&points[..1], &[(60.0, 25.0)], 10.0, frame);
        assert_eq!(next_to_dot[0].anchor, Anchor::End);
    }
}
