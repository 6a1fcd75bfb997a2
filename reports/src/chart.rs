//! Charts as SVG; the only file that names plotters.
//!
//! plotters counts whole px, which would make curves of small panels jagged: it
//! draws ten times as large, and the document says so in its view box. Labels
//! are set here, since without a font plotters can only guess their size.

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

use crate::names::{Placed, placed};
use crate::panel::{Chart, Frame, Mark, Panel, Point, Shown, Sign};
use crate::style::{CURVE, Color, FAINT, FONTS, GRID, HAIR, INK, PAPER, SMALL_TEXT, TEXT};
use crate::svg::{Anchor, estimated_width, opening, shortened};

const FINE: f64 = 10.0;

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Axes<'a, 'b> = ChartContext<'a, SVGBackend<'b>, Cartesian2d<RangedCoordf64, RangedCoordf64>>;

impl Chart {
    /// The chart as a document.
    ///
    /// # Panics
    /// Never: memory takes any drawing.
    #[must_use]
    pub fn svg(&self) -> String {
        let mut text = String::new();
        {
            let size = (self.width * FINE as u32, self.height * FINE as u32);
            let area = SVGBackend::with_string(&mut text, size).into_drawing_area();
            drawn(area.fill(&rgb(PAPER)));
            for panel in &self.panels {
                Drawing { area: &area, panel }.draw();
            }
            if let Some((below, left)) = &self.names {
                let (width, height) = (f64::from(self.width), f64::from(self.height));
                write(&area, (width / 2.0, height - 14.0), TEXT, Anchor::Middle, INK, below);
                write_upwards(&area, (14.0, height / 2.0), left);
            }
            drawn(area.present());
        }
        compact(&text, &opening(self.width, self.height, FINE as u32))
    }
}

fn drawn<T, E: std::fmt::Debug>(result: Result<T, E>) -> T {
    result.expect("memory takes any drawing")
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
        let mut axes = drawn(ChartBuilder::on(&inner).build_cartesian_2d(0.0..1.0, 0.0..1.0));
        self.grid(&mut axes);
        for mark in &self.panel.marks {
            self.mark(&mut axes, mark);
        }
        self.axis_labels();
        self.heading();
    }

    /// A point as shares of the frame.
    fn share(&self, point: &Point) -> Point {
        (self.panel.x.place(point.0), self.panel.y.place(point.1))
    }

    fn shares(&self, points: &[Point]) -> Vec<Point> {
        points.iter().map(|point| self.share(point)).collect()
    }

    /// A point in px.
    fn px(&self, point: &Point) -> Point {
        let (Frame { x, y, width, height }, share) = (self.panel.frame, self.share(point));
        (x + share.0 * width, y + (1.0 - share.1) * height)
    }

    fn grid(&self, axes: &mut Axes<'_, '_>) {
        let thin = stroke(GRID, HAIR);
        let path = |from: Point, to: Point| PathElement::new(vec![from, to], thin);
        for (value, _) in &self.panel.x.ticks {
            let at = self.panel.x.place(*value);
            drawn(axes.draw_series([path((at, 0.0), (at, 1.0))]));
        }
        for (value, _) in &self.panel.y.ticks {
            let at = self.panel.y.place(*value);
            drawn(axes.draw_series([path((0.0, at), (1.0, at))]));
        }
        let foot = vec![(0.0, 1.0), (0.0, 0.0), (1.0, 0.0)];
        drawn(axes.draw_series([PathElement::new(foot, stroke(FAINT, HAIR))]));
    }

    fn mark(&self, axes: &mut Axes<'_, '_>, mark: &Mark) {
        match mark {
            Mark::Line { points, color, width } => {
                let path = PathElement::new(self.shares(points), stroke(*color, *width));
                drawn(axes.draw_series([path]));
            }
            Mark::Dashes { points, color } => {
                let style = stroke(*color, CURVE);
                let path = DashedPathElement::new(self.shares(points), fine(6.0), fine(4.0), style);
                drawn(axes.draw_series([path]));
            }
            Mark::Dots { points, color, radius } => {
                let style = rgb(*color).filled();
                let dots = self.shares(points).into_iter();
                drawn(axes.draw_series(dots.map(|p| Circle::new(p, fine(*radius), style))));
            }
            Mark::Area { points, color, opacity } => {
                let style = rgb(*color).mix(*opacity).filled();
                drawn(axes.draw_series([Polygon::new(self.shares(points), style)]));
            }
            Mark::Bar { from, to, color } => {
                let corners = [self.share(from), self.share(to)];
                drawn(axes.draw_series([Rectangle::new(corners, rgb(*color).filled())]));
            }
            Mark::Names { names, around, color } => {
                let dots: Vec<Point> = around.iter().map(|at| self.px(at)).collect();
                let points: Vec<(Point, &str)> =
                    names.iter().map(|(at, name)| (self.px(at), name.as_str())).collect();
                for Placed { at, anchor, text } in
                    placed(&points, &dots, SMALL_TEXT, self.panel.frame)
                {
                    write(self.area, at, SMALL_TEXT, anchor, *color, text);
                }
            }
        }
    }

    fn axis_labels(&self) {
        let Panel { x, y, frame, shown, .. } = self.panel;
        let foot = frame.y + frame.height;
        if shown.0 != Shown::Nothing {
            for (value, label) in &x.ticks {
                let at = (self.px(&(*value, y.low)).0, foot + 10.0);
                write(self.area, at, SMALL_TEXT, Anchor::Middle, FAINT, label);
            }
        }
        if shown.1 != Shown::Nothing {
            for (value, label) in &y.ticks {
                let at = (frame.x - 6.0, self.px(&(x.low, *value)).1);
                write(self.area, at, SMALL_TEXT, Anchor::End, FAINT, label);
            }
        }
        if shown.0 == Shown::All {
            let at = (frame.x + frame.width / 2.0, foot + 28.0);
            write(self.area, at, TEXT, Anchor::Middle, INK, &x.name);
        }
        if shown.1 == Shown::All {
            write_upwards(self.area, (frame.x - 46.0, frame.y + frame.height / 2.0), &y.name);
        }
    }

    /// Title on the left, then the key; note and patches on the right.
    fn heading(&self) {
        let Panel { frame, title, note, patches, key, .. } = self.panel;
        let middle = frame.y - 9.0;
        let (side, mut right) = (11.0, frame.x + frame.width);
        for patch in patches.iter().rev() {
            let corners = [(right - side, middle - side / 2.0), (right, middle + side / 2.0)];
            let corners = corners.map(|(x, y)| (fine(x), fine(y)));
            drawn(self.area.draw(&Rectangle::new(corners, rgb(*patch).filled())));
            right -= side;
        }
        if !note.is_empty() {
            right -= if patches.is_empty() { 0.0 } else { 5.0 };
            write(self.area, (right, middle), SMALL_TEXT, Anchor::End, FAINT, note);
            right -= estimated_width(note, SMALL_TEXT);
        }
        let mut x = frame.x;
        if !title.is_empty() {
            let title = shortened(title, SMALL_TEXT, right - x - 2.0);
            write(self.area, (x, middle), SMALL_TEXT, Anchor::Start, INK, &title);
            x += estimated_width(&title, SMALL_TEXT) + 18.0;
        }
        for (sign, color, name) in key {
            self.sign(*sign, *color, (x, middle));
            write(self.area, (x + 24.0, middle), SMALL_TEXT, Anchor::Start, INK, name);
            x += 24.0 + estimated_width(name, SMALL_TEXT) + 18.0;
        }
    }

    fn sign(&self, sign: Sign, color: Color, at: Point) {
        let (x, y) = at;
        let point = |dx: f64, dy: f64| (fine(x + dx), fine(y + dy));
        let path = vec![point(0.0, 0.0), point(18.0, 0.0)];
        match sign {
            Sign::Line => drawn(self.area.draw(&PathElement::new(path, stroke(color, CURVE)))),
            Sign::Dashes => {
                let style = stroke(color, CURVE);
                let dashes = DashedPathElement::new(path, fine(5.0), fine(3.0), style);
                drawn(self.area.draw(&dashes));
            }
            Sign::Dots => {
                for dx in [2.0, 9.0, 16.0] {
                    let dot = Circle::new(point(dx, 0.0), fine(1.8), rgb(color).filled());
                    drawn(self.area.draw(&dot));
                }
            }
            Sign::Patch => {
                let corners = [point(4.0, -5.0), point(16.0, 5.0)];
                drawn(self.area.draw(&Rectangle::new(corners, rgb(color).filled())));
            }
        }
    }
}

/// A line of text, `at` its middle height, in px.
fn write(area: &Area<'_>, at: Point, size: f64, anchor: Anchor, color: Color, text: &str) {
    let pos = match anchor {
        Anchor::Start => HPos::Left,
        Anchor::Middle => HPos::Center,
        Anchor::End => HPos::Right,
    };
    let style = style(size, color).pos(Pos::new(pos, VPos::Center));
    drawn(area.draw(&Text::new(text.to_owned(), (fine(at.0), fine(at.1)), style)));
}

/// The name of an axis on the left, `at` its middle.
fn write_upwards(area: &Area<'_>, at: Point, text: &str) {
    let style = style(TEXT, INK)
        .transform(FontTransform::Rotate270)
        .pos(Pos::new(HPos::Center, VPos::Center));
    drawn(area.draw(&Text::new(text.to_owned(), (fine(at.0), fine(at.1)), style)));
}

fn style(size: f64, color: Color) -> TextStyle<'static> {
    // The SVG backend divides sizes by 1.24.
    let font = (FontFamily::Name(FONTS), size * FINE * 1.24).into_font();
    font.color(&rgb(color))
}

/// The document with its own opening, and without what goes without saying.
fn compact(text: &str, opening: &str) -> String {
    let body = text.split_once(">\n").map_or(text, |(_, body)| body);
    let mut out = String::with_capacity(text.len());
    out.push_str(opening);
    let family = format!(" font-family=\"{FONTS}\"");
    out.push_str(&body.replace(" opacity=\"1\"", "").replace(&family, ""));
    out
}
