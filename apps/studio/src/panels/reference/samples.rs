//! Marks of samples and guides of strokes on the picture, as data with undo. You trace lines with
//! the pointer, and we simplify them to few points.

use std::path::{Path, PathBuf};

use artmap::passages::{Mark, MarkedArea, Marks};
use painterly::guides::Guides;

use crate::files::{Drawing, DrawingKind, DrawnFile, Problem};

/// The samples marked on the picture, and the selected one.
#[derive(Debug, Default)]
pub(super) struct SampleMarks {
    marks: Edited<Vec<Mark>>,
    /// The sample that a new spacing belongs to.
    pub(super) selected: usize,
    /// Why you cannot use the marks.
    fault: Option<Problem>,
    path: Option<PathBuf>,
}

impl SampleMarks {
    pub(super) fn marks(&self) -> &[Mark] {
        self.marks.now()
    }

    /// Why you cannot use the marks, if so.
    pub(super) fn fault(&self) -> Option<&Problem> {
        self.fault.as_ref()
    }

    /// The file with these marks; `None` before you save them.
    pub(super) fn file(&self) -> Option<&Path> {
        self.path.as_deref().filter(|_| !self.marks.is_unsaved())
    }

    pub(super) fn can_undo(&self) -> bool {
        self.marks.can_undo()
    }

    /// Adds a sample grown from a line, and selects it.
    pub(super) fn add(&mut self, line: Vec<[f64; 2]>, size: [usize; 2]) {
        let names = (1..).map(|number| format!("sample {number}"));
        let name = names
            .into_iter()
            .find(|name| !self.marks().iter().any(|mark| mark.name == *name))
            .unwrap_or_default();
        let mark = Mark { name, area: MarkedArea::Scribble(line), spacing: None };
        self.marks.change(|marks| marks.push(mark));
        self.selected = self.marks().len() - 1;
        self.check(size);
    }

    /// Sets the spacing of the selected sample: two places that are one stroke apart.
    pub(super) fn set_spacing(&mut self, places: [[f64; 2]; 2], size: [usize; 2]) {
        let selected = self.selected;
        self.marks.change(|marks| {
            if let Some(mark) = marks.get_mut(selected) {
                mark.spacing = Some(places);
            }
        });
        self.check(size);
    }

    pub(super) fn remove(&mut self, index: usize, size: [usize; 2]) {
        self.marks.change(|marks| {
            marks.remove(index);
        });
        if self.selected >= index {
            self.selected = self.selected.saturating_sub(1);
        }
        self.check(size);
    }

    /// Renames a sample. Returns whether the name is free.
    pub(super) fn rename(&mut self, index: usize, name: &str, size: [usize; 2]) -> bool {
        let name = name.trim();
        let mut others = self.marks().iter().enumerate().filter(|(at, _)| *at != index);
        if name.is_empty() || others.any(|(_, other)| other.name == name) {
            return false;
        }
        self.marks.change(|marks| name.clone_into(&mut marks[index].name));
        self.check(size);
        true
    }

    /// Undoes the last change. Returns whether there was one.
    pub(super) fn undo(&mut self, size: [usize; 2]) -> bool {
        let undone = self.marks.undo();
        self.selected = self.selected.min(self.marks().len().saturating_sub(1));
        self.check(size);
        undone
    }

    /// The sample with the nearest line or rectangle, within `reach` pixels of a place.
    pub(super) fn nearest(&self, place: [f64; 2], reach: f64) -> Option<usize> {
        let all = self
            .marks()
            .iter()
            .map(|mark| {
                let lines = outlines(&mark.area);
                let segments = lines.iter().flat_map(|line| line.windows(2));
                let distances = segments.map(|ends| distance(place, [ends[0], ends[1]]));
                distances.fold(f64::INFINITY, f64::min)
            })
            .enumerate();
        let nearest = all.min_by(|one, other| one.1.total_cmp(&other.1));
        nearest.filter(|(_, far)| *far <= reach).map(|(index, _)| index)
    }

    /// Shows the marks of a file.
    pub(super) fn open(&mut self, marks: Vec<Mark>, path: PathBuf, size: [usize; 2]) {
        self.marks.open(marks);
        (self.selected, self.path) = (0, Some(path));
        self.check(size);
    }

    /// Shows marks that are in no file. `path` is suggested for them.
    pub(super) fn restore(&mut self, marks: Vec<Mark>, path: PathBuf, size: [usize; 2]) {
        self.open(Vec::new(), path, size);
        self.marks.adjust(|now| *now = marks);
        self.check(size);
    }

    /// Notes that these marks were saved.
    pub(super) fn saved(&mut self, marks: Vec<Mark>, path: PathBuf) {
        self.marks.saved(marks);
        self.path = Some(path);
    }

    /// The marks as a file for `picture`.
    pub(super) fn as_file(&self, picture: &Path) -> DrawnFile {
        let path = self.path.clone().unwrap_or_else(|| DrawingKind::Marks.beside(picture));
        DrawnFile { drawing: Drawing::Marks(self.of(picture, &path)), path }
    }

    /// The marks as a file, if they are not saved.
    pub(super) fn unsaved(&self, picture: &Path) -> Option<DrawnFile> {
        let lost = self.marks.is_unsaved() && !self.marks().is_empty();
        lost.then(|| self.as_file(picture))
    }

    fn of(&self, picture: &Path, path: &Path) -> Marks {
        Marks {
            file: name_of(path).unwrap_or_default(),
            painting: name_of(picture),
            samples: self.marks().to_vec(),
        }
    }

    fn check(&mut self, [width, height]: [usize; 2]) {
        let marks = self.of(Path::new(""), Path::new("marks"));
        self.fault = marks.check(width, height).err().map(|error| Problem::from_error(&error));
    }
}

/// The name of a file without its folder.
fn name_of(path: &Path) -> Option<String> {
    path.file_name().map(|name| name.to_string_lossy().into_owned())
}

/// The lines that show an area: a scribble, or the sides of a rectangle. Single pixels have none.
pub(super) fn outlines(area: &MarkedArea) -> Vec<Vec<[f64; 2]>> {
    match area {
        MarkedArea::Scribble(points) => vec![points.clone()],
        MarkedArea::Pixels(_) => Vec::new(),
        &MarkedArea::Rectangle { x, y, width, height } => {
            let [left, top, width, height] = [x, y, width, height].map(f64::from);
            let right = left + width;
            let bottom = top + height;
            vec![vec![[left, top], [right, top], [right, bottom], [left, bottom], [left, top]]]
        }
    }
}

/// The camera that we suggest for a view of a model: degrees around it, above the horizon, and of
/// the field of view.
const USUAL_CAMERA: [f32; 3] = [30.0, 20.0, 30.0];

/// Guides, and the camera if the picture is a view of a model.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Combed {
    /// Lines that strokes follow, in pixels of the picture.
    pub(super) lines: Vec<Vec<[f64; 2]>>,
    /// Camera of a view of a model.
    pub(super) camera: Option<[f32; 3]>,
}

/// The guides drawn on the picture, and the selected one.
#[derive(Debug, Default)]
pub(super) struct Combing {
    combed: Edited<Combed>,
    pub(super) selected: usize,
    path: Option<PathBuf>,
}

impl Combing {
    pub(super) fn combed(&self) -> &Combed {
        self.combed.now()
    }

    pub(super) fn file(&self) -> Option<&Path> {
        self.path.as_deref().filter(|_| !self.combed.is_unsaved())
    }

    pub(super) fn can_undo(&self) -> bool {
        self.combed.can_undo()
    }

    /// Adds a guide, and selects it.
    pub(super) fn add(&mut self, line: Vec<[f64; 2]>) {
        self.combed.change(|combed| combed.lines.push(line));
        self.selected = self.combed().lines.len() - 1;
    }

    pub(super) fn remove(&mut self, index: usize) {
        self.combed.change(|combed| {
            combed.lines.remove(index);
        });
        if self.selected >= index {
            self.selected = self.selected.saturating_sub(1);
        }
    }

    /// Turns the direction of a guide around.
    pub(super) fn reverse(&mut self, index: usize) {
        self.combed.change(|combed| combed.lines[index].reverse());
    }

    /// Sets whether the picture is a view of a model.
    pub(super) fn set_view(&mut self, is_view: bool) {
        self.combed.change(|combed| combed.camera = is_view.then_some(USUAL_CAMERA));
    }

    pub(super) fn set_camera(&mut self, camera: [f32; 3]) {
        self.combed.adjust(|combed| combed.camera = Some(camera));
    }

    /// Undoes the last change. Returns whether there was one.
    pub(super) fn undo(&mut self) -> bool {
        let undone = self.combed.undo();
        self.selected = self.selected.min(self.combed().lines.len().saturating_sub(1));
        undone
    }

    /// The guide nearest to a place, within `reach` pixels.
    pub(super) fn nearest(&self, place: [f64; 2], reach: f64) -> Option<usize> {
        let all = self
            .combed()
            .lines
            .iter()
            .map(|line| {
                let distances = line.windows(2).map(|ends| distance(place, [ends[0], ends[1]]));
                distances.fold(f64::INFINITY, f64::min)
            })
            .enumerate();
        let nearest = all.min_by(|one, other| one.1.total_cmp(&other.1));
        nearest.filter(|(_, far)| *far <= reach).map(|(index, _)| index)
    }

    /// Shows the guides of a file.
    pub(super) fn open(&mut self, combed: Combed, path: PathBuf) {
        self.combed.open(combed);
        (self.selected, self.path) = (0, Some(path));
    }

    /// Shows guides that are in no file. `path` is suggested for them.
    pub(super) fn restore(&mut self, combed: Combed, path: PathBuf) {
        self.open(Combed::default(), path);
        self.combed.adjust(|now| *now = combed);
    }

    /// Notes that these guides were saved.
    pub(super) fn saved(&mut self, combed: Combed, path: PathBuf) {
        self.combed.saved(combed);
        self.path = Some(path);
    }

    /// The guides as a file for `picture` of this width and height.
    pub(super) fn as_file(&self, picture: &Path, size: [usize; 2]) -> DrawnFile {
        let path = self.path.clone().unwrap_or_else(|| DrawingKind::Guides.beside(picture));
        let Combed { lines, camera } = self.combed().clone();
        let guides = Guides {
            file: name_of(&path).unwrap_or_default(),
            picture: name_of(picture),
            size_px: size.map(|side| u32::try_from(side).unwrap_or(u32::MAX)),
            camera,
            lines,
        };
        DrawnFile { drawing: Drawing::Guides(guides), path }
    }

    /// The guides as a file, if they are not saved.
    pub(super) fn unsaved(&self, picture: &Path, size: [usize; 2]) -> Option<DrawnFile> {
        let lost = self.combed.is_unsaved() && !self.combed().lines.is_empty();
        lost.then(|| self.as_file(picture, size))
    }
}

/// We round places to multiples of this, in pixels.
const ROUNDED_TO: f64 = 0.1;

/// The part of a traced line before it first leaves a picture of this width and height, in pixels.
/// It has points only where the line bends by more than `tolerance` pixels. If nothing lies on the
/// picture, this returns fewer than two points.
pub(super) fn traced(points: &[[f64; 2]], size: [usize; 2], tolerance: f64) -> Vec<[f64; 2]> {
    // A place exactly at the far edge would be outside the last pixel.
    let most = size.map(|side| side as f64 - ROUNDED_TO);
    fn rounded(place: f64, most: f64) -> f64 {
        // We divide, because a tenth is not exact in binary.
        ((place / ROUNDED_TO).round() / ROUNDED_TO.recip()).clamp(0.0, most.max(0.0))
    }
    let piece = first_piece(points, most);
    let mut line: Vec<[f64; 2]> = simplified(&piece, tolerance)
        .into_iter()
        .map(|[x, y]| [rounded(x, most[0]), rounded(y, most[1])])
        .collect();
    line.dedup();
    line
}

/// Points of the first piece of a line inside a rectangle of this size.
fn first_piece(points: &[[f64; 2]], most: [f64; 2]) -> Vec<[f64; 2]> {
    let mut piece: Vec<[f64; 2]> = Vec::new();
    for ends in points.windows(2) {
        match inside(ends[0], ends[1], most) {
            Some([from, to]) => {
                if piece.is_empty() {
                    piece.push(from);
                }
                piece.push(to);
                if to != ends[1] {
                    break;
                }
            }
            None if piece.is_empty() => {}
            None => break,
        }
    }
    piece
}

/// The part of a segment inside a rectangle from the origin (Liang and Barsky, "A new concept and
/// method for line clipping", 1984).
fn inside(from: [f64; 2], to: [f64; 2], most: [f64; 2]) -> Option<[[f64; 2]; 2]> {
    let mut first = 0.0_f64;
    let mut last = 1.0_f64;
    for axis in 0..2 {
        let step = to[axis] - from[axis];
        for (toward, room) in [(-step, from[axis]), (step, most[axis] - from[axis])] {
            if toward == 0.0 && room < 0.0 {
                return None;
            }
            let at = room / toward;
            if toward < 0.0 {
                first = first.max(at);
            } else if toward > 0.0 {
                last = last.min(at);
            }
        }
    }
    let [start, end] = [first, last]
        .map(|share| [0, 1].map(|axis: usize| from[axis] + share * (to[axis] - from[axis])));
    (first <= last).then_some([start, if last == 1.0 { to } else { end }])
}

/// A simplified line: its ends, and each point between them that would otherwise be farther than
/// `tolerance` from the line (Douglas and Peucker, "Algorithms for the reduction of the number of
/// points required to represent a digitized line", 1973).
fn simplified(points: &[[f64; 2]], tolerance: f64) -> Vec<[f64; 2]> {
    let Some(last) = points.len().checked_sub(1) else { return Vec::new() };
    let mut kept = vec![false; points.len()];
    (kept[0], kept[last]) = (true, true);
    let mut pieces = vec![(0, last)];
    while let Some((from, to)) = pieces.pop() {
        let distances =
            (from + 1..to).map(|at| (distance(points[at], [points[from], points[to]]), at));
        let farthest = distances.max_by(|one, other| one.0.total_cmp(&other.0));
        if let Some((_, at)) = farthest.filter(|(far, _)| *far > tolerance) {
            kept[at] = true;
            pieces.extend([(from, at), (at, to)]);
        }
    }
    points.iter().zip(kept).filter(|(_, kept)| *kept).map(|(point, _)| *point).collect()
}

/// Distance of a point from a segment.
pub(super) fn distance([x, y]: [f64; 2], [from, to]: [[f64; 2]; 2]) -> f64 {
    let right = to[0] - from[0];
    let down = to[1] - from[1];
    let square = right * right + down * down;
    let along = (x - from[0]) * right + (y - from[1]) * down;
    let share = if square > 0.0 { (along / square).clamp(0.0, 1.0) } else { 0.0 };
    (x - from[0] - share * right).hypot(y - from[1] - share * down)
}

const MOST_PAST: usize = 200;

/// A value with its past states, and the state last saved or opened.
#[derive(Debug, Clone, Default)]
pub(super) struct Edited<T> {
    now: T,
    past: Vec<T>,
    saved: T,
}

impl<T: Clone + PartialEq> Edited<T> {
    pub(super) fn now(&self) -> &T {
        &self.now
    }

    /// Changes the value, as one step of undo.
    pub(super) fn change(&mut self, change: impl FnOnce(&mut T)) {
        let before = self.now.clone();
        change(&mut self.now);
        if self.now != before {
            self.past.push(before);
            let excess = self.past.len().saturating_sub(MOST_PAST);
            self.past.drain(..excess);
        }
    }

    /// Changes the value without a step of undo.
    pub(super) fn adjust(&mut self, change: impl FnOnce(&mut T)) {
        change(&mut self.now);
    }

    /// Whether there is a change to undo.
    pub(super) fn can_undo(&self) -> bool {
        !self.past.is_empty()
    }

    /// Returns to the value before the last change. Returns whether there was one.
    pub(super) fn undo(&mut self) -> bool {
        let before = self.past.pop();
        let undone = before.is_some();
        self.now = before.unwrap_or_else(|| self.now.clone());
        undone
    }

    /// Starts with a value from a file.
    pub(super) fn open(&mut self, value: T) {
        *self = Self { now: value.clone(), past: Vec::new(), saved: value };
    }

    /// Notes that `value` is in a file.
    pub(super) fn saved(&mut self, value: T) {
        self.saved = value;
    }

    /// Whether the value differs from its file.
    pub(super) fn is_unsaved(&self) -> bool {
        self.now != self.saved
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZE: [usize; 2] = [100, 50];

    #[test]
    fn a_straight_line_keeps_its_ends_and_a_bend_its_corner() {
        let points: Vec<[f64; 2]> = (0..=20).map(|step| [f64::from(step) * 2.0, 10.04]).collect();
        assert_eq!(traced(&points, SIZE, 0.5), [[0.0, 10.0], [40.0, 10.0]]);
        let down = (1..=10).map(|step| [40.0, 10.04 + f64::from(step)]);
        let bent: Vec<[f64; 2]> = points.into_iter().chain(down).collect();
        assert_eq!(traced(&bent, SIZE, 0.5), [[0.0, 10.0], [40.0, 10.0], [40.0, 20.0]]);
    }

    #[test]
    fn a_line_ends_where_it_leaves_the_picture() {
        let out = [[50.0, 25.0], [90.0, 25.0], [110.0, 25.0], [60.0, 40.0]];
        assert_eq!(traced(&out, SIZE, 0.5), [[50.0, 25.0], [99.9, 25.0]]);
        let into = [[50.0, -10.0], [50.0, 10.0], [60.0, 10.0]];
        assert_eq!(traced(&into, SIZE, 0.5), [[50.0, 0.0], [50.0, 10.0], [60.0, 10.0]]);
        assert_eq!(traced(&[[-5.0, 60.0], [120.0, 70.0]], SIZE, 0.5), [] as [[f64; 2]; 0]);
        let across = [[-50.0, 25.0], [150.0, 25.0], [150.0, 45.0], [-50.0, 45.0]];
        assert_eq!(traced(&across, SIZE, 0.5), [[0.0, 25.0], [99.9, 25.0]], "the first part alone");
    }

    #[test]
    fn a_line_without_length_has_one_point_or_none() {
        assert_eq!(traced(&[[3.0, 4.0]], SIZE, 0.5).len(), 0);
        assert_eq!(traced(&[[3.0, 4.0], [3.02, 4.0]], SIZE, 0.5), [[3.0, 4.0]]);
    }

    #[test]
    fn the_distance_from_a_segment_is_that_from_its_nearest_point() {
        let segment = [[0.0, 0.0], [10.0, 0.0]];
        assert_eq!(distance([5.0, 3.0], segment), 3.0);
        assert_eq!(distance([13.0, 4.0], segment), 5.0);
        assert_eq!(distance([3.0, 4.0], [[0.0, 0.0]; 2]), 5.0);
    }

    #[test]
    fn undo_returns_to_each_state_and_tells_what_is_saved() {
        let mut lines: Edited<Vec<u8>> = Edited::default();
        lines.change(|lines| lines.push(1));
        lines.change(|_| {});
        lines.change(|lines| lines.push(2));
        assert!(lines.is_unsaved() && lines.can_undo());
        lines.saved(vec![1, 2]);
        assert!(!lines.is_unsaved());
        assert!(lines.undo());
        assert_eq!(lines.now(), &[1]);
        assert!(lines.is_unsaved(), "the file has more");
        assert!(lines.undo() && !lines.undo(), "there were two changes");
        lines.open(vec![7]);
        assert!(!lines.is_unsaved() && !lines.can_undo());
        for number in 0..300 {
            lines.change(|lines| lines[0] = (number % 250) as u8);
        }
        assert_eq!((0..400).filter(|_| lines.undo()).count(), MOST_PAST);
    }
}
