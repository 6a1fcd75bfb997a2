//! Draws marks and guides over the picture.

use artmap::passages::{Mark, MarkedArea, color_of_mark};
use eframe::egui::{Align2, Color32, FontId, Painter, Pos2, Rect, Shape, Stroke, Vec2, vec2};
use spectra::color::Rgb;

use super::samples::outlines;

/// Width of lines and of the rim around them, in points.
const LINE: f32 = 2.0;
const RIM: f32 = 1.25;

/// Half the width of the bars at both ends of a spacing, and of an arrow, in points.
const BAR: f32 = 5.0;

/// Colour of guides: white with a dark rim is seen on any picture.
const GUIDE: Color32 = Color32::WHITE;

/// Most single pixels that are drawn of a mark.
const MOST_PIXELS: usize = 4000;

/// Colour of the mark of this index on the screen.
pub(super) fn screen_color(index: usize) -> Color32 {
    let [red, green, blue] = Rgb(color_of_mark(index).map(f64::from)).encoded().to_bytes();
    Color32::from_rgb(red, green, blue)
}

/// Converts places of the picture to points of the window, and draws there.
pub(super) struct Overlay<'a> {
    pub(super) painter: Painter,
    pub(super) point: &'a dyn Fn([f64; 2]) -> Pos2,
    /// Points of the window to a pixel of the picture.
    pub(super) zoom: f32,
}

impl Overlay<'_> {
    /// Draws a mark, thicker if it is selected.
    pub(super) fn mark(&self, index: usize, mark: &Mark, selected: bool) {
        let color = screen_color(index);
        let lines = outlines(&mark.area).into_iter().map(|line| self.points(&line));
        self.lines(&lines.collect::<Vec<_>>(), color, selected);
        if let MarkedArea::Pixels(pixels) = &mark.area {
            let side = vec2(self.zoom, self.zoom).max(vec2(1.0, 1.0));
            for &[x, y] in pixels.iter().take(MOST_PIXELS) {
                let middle = (self.point)([f64::from(x) + 0.5, f64::from(y) + 0.5]);
                self.painter.rect_filled(Rect::from_center_size(middle, side), 0.0, color);
            }
        }
        if let Some(places) = mark.spacing {
            self.spacing(places.map(self.point), color);
        }
    }

    /// Draws a line that is not finished.
    pub(super) fn unfinished(&self, points: &[Pos2], color: Color32) {
        self.lines(&[points.to_vec()], color, true);
    }

    /// Draws a distance of strokes: a line with a bar across each end.
    pub(super) fn spacing(&self, [from, to]: [Pos2; 2], color: Color32) {
        let across = BAR * (to - from).normalized().rot90();
        let bar = |end: Pos2| vec![end - across, end + across];
        self.lines(&[vec![from, to], bar(from), bar(to)], color, false);
    }

    /// Draws a guide with its number and arrows along it, thicker if it is selected.
    pub(super) fn guide(&self, number: usize, places: &[[f64; 2]], selected: bool) {
        let points = self.points(places);
        let arrow = |(tip, along): (Pos2, Vec2)| {
            let back = tip - 1.5 * BAR * along;
            let side = BAR * along.rot90();
            vec![back + side, tip, back - side]
        };
        let mut lines: Vec<Vec<Pos2>> = arrows(&points).into_iter().map(arrow).collect();
        let first = points.first().copied();
        lines.push(points);
        self.lines(&lines, GUIDE, selected);
        let Some(first) = first else { return };
        self.painter.circle(first, 2.5 * RIM, GUIDE, Stroke::new(RIM, Color32::BLACK));
        let around = [[-1.0, 0.0], [1.0, 0.0], [0.0, -1.0], [0.0, 1.0]];
        let shadows = around.map(|[x, y]| (vec2(x, y), Color32::BLACK));
        for (shift, color) in shadows.into_iter().chain([(Vec2::ZERO, GUIDE)]) {
            let at = first + vec2(6.0, -6.0) + shift;
            let font = FontId::proportional(13.0);
            self.painter.text(at, Align2::LEFT_BOTTOM, number, font, color);
        }
    }

    fn points(&self, places: &[[f64; 2]]) -> Vec<Pos2> {
        places.iter().map(|place| (self.point)(*place)).collect()
    }

    /// Draws lines over one dark rim, so that none is cut by the rim of another.
    fn lines(&self, lines: &[Vec<Pos2>], color: Color32, thick: bool) {
        let width = if thick { 1.75 * LINE } else { LINE };
        for (width, color) in [(width + 2.0 * RIM, Color32::BLACK), (width, color)] {
            for line in lines {
                self.painter.add(Shape::line(line.clone(), Stroke::new(width, color)));
            }
        }
    }
}

/// Tips and directions of the arrows on a line: in the middle of its length, and at its end.
fn arrows(points: &[Pos2]) -> Vec<(Pos2, Vec2)> {
    let pieces =
        || points.windows(2).map(|ends| [ends[0], ends[1]]).filter(|[from, to]| from != to);
    let half = 0.5 * pieces().map(|[from, to]| from.distance(to)).sum::<f32>();
    let mut left = half;
    let middle = pieces().find_map(|[from, to]| {
        let before = left;
        let along = (to - from).normalized();
        left -= from.distance(to);
        (left <= 0.0).then(|| (from + before * along, along))
    });
    let last = pieces().next_back().map(|[from, to]| (to, (to - from).normalized()));
    middle.into_iter().chain(last).collect()
}

#[cfg(test)]
mod tests {
    use eframe::egui::pos2;

    use super::*;

    #[test]
    fn arrows_stand_in_the_middle_and_at_the_end() {
        let points = [pos2(0.0, 0.0), pos2(2.0, 0.0), pos2(2.0, 10.0)];
        let down = vec2(0.0, 1.0);
        assert_eq!(arrows(&points), [(pos2(2.0, 4.0), down), (pos2(2.0, 10.0), down)]);
        assert!(arrows(&points[..1]).is_empty());
    }
}
