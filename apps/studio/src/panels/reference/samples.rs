//! Marks of samples on the picture, as data.

use std::path::{Path, PathBuf};

use artmap::passages::{Mark, MarkedArea, Marks};

use super::edited::Edited;
use super::traced::distance;
use crate::files::{Drawing, DrawingKind, DrawnFile, Problem};

/// The samples marked on the picture, and which is selected.
#[derive(Debug, Default)]
pub(super) struct SampleMarks {
    marks: Edited<Vec<Mark>>,
    /// Index of the sample that a spacing belongs to.
    pub(super) selected: usize,
    /// Why the marks cannot be used.
    fault: Option<Problem>,
    /// The file that they were read from or saved in.
    path: Option<PathBuf>,
}

impl SampleMarks {
    /// The marks.
    pub(super) fn marks(&self) -> &[Mark] {
        self.marks.now()
    }

    /// The fault of the marks, if they have one.
    pub(super) fn fault(&self) -> Option<&Problem> {
        self.fault.as_ref()
    }

    /// The file of the marks as they are; `None` before they are saved.
    pub(super) fn file(&self) -> Option<&Path> {
        self.path.as_deref().filter(|_| !self.marks.is_unsaved())
    }

    /// Whether there is a mark to undo.
    pub(super) fn can_undo(&self) -> bool {
        self.marks.can_undo()
    }

    /// Adds a sample grown from a line, and selects it.
    pub(super) fn add(&mut self, line: Vec<[f64; 2]>, size: [usize; 2]) {
        let taken = |name: &String| self.marks().iter().any(|mark| mark.name == *name);
        let names = (1..).map(|number| format!("sample {number}"));
        let name = names.into_iter().find(|name| !taken(name)).unwrap_or_default();
        let mark = Mark { name, area: MarkedArea::Scribble(line), spacing: None };
        self.marks.change(|marks| marks.push(mark));
        self.selected = self.marks().len() - 1;
        self.check(size);
    }

    /// Sets the two places of the selected sample that are one stroke apart.
    pub(super) fn set_spacing(&mut self, places: [[f64; 2]; 2], size: [usize; 2]) {
        let selected = self.selected;
        self.marks.change(|marks| {
            if let Some(mark) = marks.get_mut(selected) {
                mark.spacing = Some(places);
            }
        });
        self.check(size);
    }

    /// Removes a sample.
    pub(super) fn remove(&mut self, index: usize, size: [usize; 2]) {
        self.marks.change(|marks| {
            marks.remove(index);
        });
        if self.selected >= index {
            self.selected = self.selected.saturating_sub(1);
        }
        self.check(size);
    }

    /// Renames a sample; whether the name is one that no other sample has.
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

    /// Undoes the last change; whether there was one.
    pub(super) fn undo(&mut self, size: [usize; 2]) -> bool {
        let undone = self.marks.undo();
        self.selected = self.selected.min(self.marks().len().saturating_sub(1));
        self.check(size);
        undone
    }

    /// The sample whose line or rectangle is nearest to a place, within `reach` pixels.
    pub(super) fn nearest(&self, place: [f64; 2], reach: f64) -> Option<usize> {
        let far = |mark: &Mark| {
            let lines = outlines(&mark.area);
            let segments = lines.iter().flat_map(|line| line.windows(2));
            let distances = segments.map(|ends| distance(place, [ends[0], ends[1]]));
            distances.fold(f64::INFINITY, f64::min)
        };
        let all = self.marks().iter().map(far).enumerate();
        let nearest = all.min_by(|one, other| one.1.total_cmp(&other.1));
        nearest.filter(|(_, far)| *far <= reach).map(|(index, _)| index)
    }

    /// Shows the marks of a file.
    pub(super) fn open(&mut self, marks: Vec<Mark>, path: PathBuf, size: [usize; 2]) {
        self.marks.open(marks);
        (self.selected, self.path) = (0, Some(path));
        self.check(size);
    }

    /// Shows marks that are in no file; `path` is suggested for them.
    pub(super) fn restore(&mut self, marks: Vec<Mark>, path: PathBuf, size: [usize; 2]) {
        self.open(Vec::new(), path, size);
        self.marks.adjust(|now| *now = marks);
        self.check(size);
    }

    /// Takes note of marks that were saved.
    pub(super) fn saved(&mut self, marks: Vec<Mark>, path: PathBuf) {
        self.marks.saved(marks);
        self.path = Some(path);
    }

    /// The marks as a file for `picture`.
    pub(super) fn drawn(&self, picture: &Path) -> DrawnFile {
        let path = self.path.clone().unwrap_or_else(|| DrawingKind::Marks.beside(picture));
        DrawnFile { drawing: Drawing::Marks(self.of(picture, &path)), path }
    }

    /// The marks as a file, if they are in none.
    pub(super) fn unsaved(&self, picture: &Path) -> Option<DrawnFile> {
        let lost = self.marks.is_unsaved() && !self.marks().is_empty();
        lost.then(|| self.drawn(picture))
    }

    fn of(&self, picture: &Path, path: &Path) -> Marks {
        let name = |path: &Path| path.file_name().map(|name| name.to_string_lossy().into_owned());
        Marks {
            file: name(path).unwrap_or_default(),
            painting: name(picture),
            samples: self.marks().to_vec(),
        }
    }

    fn check(&mut self, [width, height]: [usize; 2]) {
        let marks = self.of(Path::new(""), Path::new("marks"));
        self.fault = marks.check(width, height).err().map(|error| Problem::from_error(&error));
    }
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
