//! State of the reference panel, and the marks and guides drawn over the picture.

use std::fmt;
use std::path::{Path, PathBuf};

use artmap::passages::{Mark, MarkedArea, color_of_mark};
use eframe::egui::{
    Align2, Color32, Context, Event, FontId, Painter, PointerButton, Pos2, Rect, Response, Shape,
    Stroke, TextureHandle, Ui, Vec2, vec2,
};
use spectra::color::Rgb;

use super::picture::{OverCanvas, PendingPicture, Picture, PictureView, ReferenceMode};
use super::samples::{Combed, Combing, SampleMarks, outlines};
use crate::files::{Drawing, DrawnFile, Problem, ReferenceChange};
use crate::language::{tr, tr_format};

/// Default radius of the averaged disc, in pixels of the picture.
const RADIUS: f32 = 2.0;

/// State of the reference panel: the picture, its view, and what is drawn on it.
pub struct Reference {
    pub(super) path: Option<PathBuf>,
    pub(super) reading: Option<PendingPicture>,
    pub(super) picture: Option<Picture>,
    pub(super) texture: Option<TextureHandle>,
    pub(super) view: Option<PictureView>,
    pub(super) error: Option<String>,
    pub(super) grey: bool,
    pub(super) flipped: bool,
    pub(super) radius: f32,
    pub(super) mode: ReferenceMode,
    pub(super) samples: SampleMarks,
    pub(super) combing: Combing,
    /// Lines that we show once the picture is read.
    pub(super) restoring: Vec<DrawnFile>,
    /// Whether the pointer marks the distance between strokes rather than a sample.
    pub(super) spacing: bool,
    /// The first of the two clicks that give the distance between strokes.
    pub(super) first_place: Option<[f64; 2]>,
    pub(super) line: PointerLine,
    /// Index and new name of a sample while you type it.
    pub(super) renaming: Option<(usize, String)>,
    pub(super) hovered: bool,
    pub(super) over: OverCanvas,
    pub(super) exposure: f32,
}

impl fmt::Debug for Reference {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.debug_struct("Reference").field("path", &self.path).finish_non_exhaustive()
    }
}

impl Default for Reference {
    fn default() -> Self {
        Self {
            path: None,
            reading: None,
            picture: None,
            texture: None,
            view: None,
            error: None,
            grey: false,
            flipped: false,
            radius: RADIUS,
            mode: ReferenceMode::default(),
            samples: SampleMarks::default(),
            combing: Combing::default(),
            restoring: Vec::new(),
            spacing: false,
            first_place: None,
            line: PointerLine::default(),
            renaming: None,
            hovered: false,
            over: OverCanvas::default(),
            exposure: 0.0,
        }
    }
}

impl Reference {
    /// Starts to read a photograph, linear OpenEXR or painting on another thread. This replaces the
    /// current picture and its drawings. The panel shows an error.
    pub fn open(&mut self, context: &Context, path: &Path) {
        let context = context.clone();
        let reading = PendingPicture::start(path, move || context.request_repaint());
        let grey = self.grey;
        let radius = self.radius;
        let mode = self.mode;
        let path = Some(path.to_owned());
        *self = Self { path, reading: Some(reading), grey, radius, mode, ..Self::default() };
    }

    /// Closes the picture.
    pub fn close(&mut self) {
        *self = Self { radius: self.radius, ..Self::default() };
    }

    /// Whether there is a picture. It may be shown, or still being read, or we could not read it.
    #[must_use]
    pub fn is_open(&self) -> bool {
        self.path.is_some()
    }

    /// Call this if the panel is not shown in this frame.
    pub fn hide(&mut self) {
        self.hovered = false;
        self.line.clear();
    }

    /// Carries out a change. Returns a message for the painter, if any.
    pub fn apply(&mut self, change: ReferenceChange, context: &Context) -> Option<Problem> {
        match change {
            ReferenceChange::Open(path) => self.open(context, &path),
            ReferenceChange::Restore { picture, drawings } => {
                self.open(context, &picture);
                self.restoring = drawings;
            }
            ReferenceChange::Close => self.close(),
            ReferenceChange::Draw(drawn) => return self.show_drawing(drawn),
            ReferenceChange::Saved(DrawnFile { drawing, path }) => match drawing {
                Drawing::Marks(marks) => self.samples.saved(marks.samples, path),
                Drawing::Guides(guides) => {
                    let combed = Combed { lines: guides.lines, camera: guides.camera };
                    self.combing.saved(combed, path);
                }
            },
        }
        None
    }

    /// Shows lines from a file.
    fn show_drawing(&mut self, DrawnFile { drawing, path }: DrawnFile) -> Option<Problem> {
        let size = self.picture.as_ref()?.file_size();
        let own = self.path.as_deref().and_then(Path::file_name)?.to_string_lossy().into_owned();
        let file = path.display().to_string();
        match drawing {
            Drawing::Marks(marks) => {
                self.mode = ReferenceMode::Mark;
                self.renaming = None;
                self.samples.open(marks.samples, path, size);
                let other = marks.painting.filter(|painting| !is_named(painting, &own))?;
                let text =
                    tr_format!("{file} marks the picture {other}, not {own}", file, other, own);
                Some(Problem::new(text, tr("look whether the lines are where they should be")))
            }
            Drawing::Guides(guides) => {
                let wanted = guides.size_px.map(|side| side as usize);
                if wanted != size {
                    let [[width, height], [own_width, own_height]] = [wanted, size];
                    let text = tr_format!(
                        "{file}: guides of a picture of {width} x {height} pixels, but {own} has \
                         {own_width} x {own_height}",
                        file,
                        width,
                        height,
                        own,
                        own_width,
                        own_height
                    );
                    return Some(Problem::new(
                        text,
                        tr("open the picture that they were drawn on"),
                    ));
                }
                self.mode = ReferenceMode::Comb;
                let combed = Combed { lines: guides.lines, camera: guides.camera };
                self.combing.open(combed, path);
                None
            }
        }
    }

    /// Shows the lines that waited for the picture. They count as unsaved.
    pub(super) fn restore_drawings(&mut self) {
        let Some(size) = self.picture.as_ref().map(Picture::file_size) else { return };
        for DrawnFile { drawing, path } in std::mem::take(&mut self.restoring) {
            match drawing {
                Drawing::Marks(marks) => self.samples.restore(marks.samples, path, size),
                Drawing::Guides(guides) => {
                    let combed = Combed { lines: guides.lines, camera: guides.camera };
                    self.combing.restore(combed, path);
                }
            }
        }
    }

    /// File of the picture, and all its lines, saved or not.
    #[must_use]
    pub fn pinned(&self) -> Option<(&Path, Vec<DrawnFile>)> {
        let path = self.path.as_deref()?;
        let Some(picture) = &self.picture else { return Some((path, self.restoring.clone())) };
        let marks = (!self.samples.marks().is_empty()).then(|| self.samples.as_file(path));
        let guides = !self.combing.combed().lines.is_empty();
        let guides = guides.then(|| self.combing.as_file(path, picture.file_size()));
        Some((path, marks.into_iter().chain(guides).collect()))
    }

    /// The unsaved drawings.
    #[must_use]
    pub fn unsaved_drawings(&self) -> Vec<DrawnFile> {
        let (Some(path), Some(picture)) = (&self.path, &self.picture) else { return Vec::new() };
        let marks = self.samples.unsaved(path);
        marks.into_iter().chain(self.combing.unsaved(path, picture.file_size())).collect()
    }

    /// Undoes the last line if the pointer is over a picture that you draw on. Returns whether it
    /// is.
    pub fn undo_under_pointer(&mut self) -> bool {
        let draws = self.hovered && self.mode != ReferenceMode::Pick;
        if draws {
            self.undo();
        }
        draws
    }

    /// Undoes the last change of the drawing of this mode.
    pub(super) fn undo(&mut self) {
        (self.renaming, self.first_place) = (None, None);
        let Some(size) = self.picture.as_ref().map(Picture::file_size) else { return };
        match self.mode {
            ReferenceMode::Pick => {}
            ReferenceMode::Mark => {
                self.samples.undo(size);
            }
            ReferenceMode::Comb => {
                self.combing.undo();
            }
        }
    }
}

/// Whether a path ends with this file name.
fn is_named(path: &str, name: &str) -> bool {
    Path::new(path).file_name().is_some_and(|own| own.to_string_lossy() == name)
}

/// Up to this distance in points, a press and release is a click, not a line.
const CLICK_POINTS: f32 = 4.0;

/// The points of the window that the pointer passed with the primary button held.
#[derive(Debug, Default)]
pub(super) struct PointerLine {
    points: Vec<Pos2>,
}

/// A finished movement of the pointer.
#[derive(Debug, PartialEq)]
pub(super) enum Drawn {
    /// A line through these points of the window.
    Line(Vec<Pos2>),
    /// A click at a point of the window.
    Click(Pos2),
}

impl PointerLine {
    /// Reads the pointer events of this frame over an area. Returns a movement that has ended.
    pub(super) fn update(&mut self, ui: &Ui, area: &Response) -> Option<Drawn> {
        let own = area.is_pointer_button_down_on() || area.clicked() || area.drag_stopped();
        let mut ended = None;
        ui.input(|input| {
            for event in &input.events {
                match *event {
                    Event::PointerButton {
                        pos,
                        button: PointerButton::Primary,
                        pressed: true,
                        ..
                    } if own && area.rect.contains(pos) => self.points = vec![pos],
                    Event::PointerMoved(pos) if !self.points.is_empty() => self.points.push(pos),
                    Event::PointerButton {
                        pos,
                        button: PointerButton::Primary,
                        pressed: false,
                        ..
                    } if !self.points.is_empty() => {
                        self.points.push(pos);
                        ended = Some(click_or_line(std::mem::take(&mut self.points)));
                    }
                    _ => {}
                }
            }
        });
        ended
    }

    pub(super) fn clear(&mut self) {
        self.points.clear();
    }

    pub(super) fn points(&self) -> &[Pos2] {
        &self.points
    }
}

fn click_or_line(points: Vec<Pos2>) -> Drawn {
    let first = points[0];
    if points.iter().all(|point| point.distance(first) <= CLICK_POINTS) {
        Drawn::Click(first)
    } else {
        Drawn::Line(points)
    }
}

/// Width of lines and of the rim around them, in points.
const LINE: f32 = 2.0;
const RIM: f32 = 1.25;

/// Half the width of the bars at both ends of a spacing, and of an arrow, in points.
const BAR: f32 = 5.0;

/// Colour of guides. You see white with a dark rim on any picture.
const GUIDE: Color32 = Color32::WHITE;

/// We draw at most this many single pixels of a mark.
const MOST_PIXELS: usize = 4000;

/// Colour of the mark with this index.
pub(super) fn screen_color(index: usize) -> Color32 {
    let [red, green, blue] = Rgb(color_of_mark(index).map(f64::from)).encoded().to_bytes();
    Color32::from_rgb(red, green, blue)
}

/// Converts places of the picture to points of the window, and draws there.
pub(super) struct Overlay<'a> {
    pub(super) painter: Painter,
    pub(super) point: &'a dyn Fn([f64; 2]) -> Pos2,
    /// Points of the window per pixel of the picture.
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

    /// Draws the distance between two strokes: a line with a bar across each end.
    pub(super) fn spacing(&self, [from, to]: [Pos2; 2], color: Color32) {
        let across = BAR * (to - from).normalized().rot90();
        let [first, last] = [from, to].map(|end| vec![end - across, end + across]);
        self.lines(&[vec![from, to], first, last], color, false);
    }

    /// Draws a guide with its number and arrows along it, thicker if it is selected.
    pub(super) fn guide(&self, number: usize, places: &[[f64; 2]], selected: bool) {
        let points = self.points(places);
        let mut lines: Vec<Vec<Pos2>> = arrows(&points)
            .into_iter()
            .map(|(tip, along)| {
                let back = tip - 1.5 * BAR * along;
                let side = BAR * along.rot90();
                vec![back + side, tip, back - side]
            })
            .collect();
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

    /// Draws lines over one dark rim, so that no rim cuts another line.
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
    let pieces = points.windows(2).map(|ends| [ends[0], ends[1]]);
    let pieces: Vec<[Pos2; 2]> = pieces.filter(|[from, to]| from != to).collect();
    let mut left = 0.5 * pieces.iter().map(|[from, to]| from.distance(*to)).sum::<f32>();
    let middle = pieces.iter().find_map(|&[from, to]| {
        let before = left;
        let along = (to - from).normalized();
        left -= from.distance(to);
        (left <= 0.0).then(|| (from + before * along, along))
    });
    let last = pieces.last().map(|&[from, to]| (to, (to - from).normalized()));
    middle.into_iter().chain(last).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use eframe::egui::pos2;

    #[test]
    fn arrows_stand_in_the_middle_and_at_the_end() {
        let points = [pos2(0.0, 0.0), pos2(2.0, 0.0), pos2(2.0, 10.0)];
        let down = vec2(0.0, 1.0);
        assert_eq!(arrows(&points), [(pos2(2.0, 4.0), down), (pos2(2.0, 10.0), down)]);
        assert!(arrows(&points[..1]).is_empty());
    }
}
