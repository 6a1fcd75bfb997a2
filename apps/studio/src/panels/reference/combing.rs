//! Guides of strokes on the picture, as data.

use std::path::{Path, PathBuf};

use painterly::guides::Guides;

use super::edited::Edited;
use super::traced::distance;
use crate::files::{Drawing, DrawingKind, DrawnFile};

/// The camera of a view of a model that is suggested: degrees around it, above the horizon, and of
/// the field of view.
const USUAL_CAMERA: [f32; 3] = [30.0, 20.0, 30.0];

/// Guides and the camera of the view that they are drawn on.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Combed {
    /// Lines along which strokes run, in pixels of the picture.
    pub(super) lines: Vec<Vec<[f64; 2]>>,
    /// Camera of a view of a model.
    pub(super) camera: Option<[f32; 3]>,
}

/// The guides drawn on the picture, and which is selected.
#[derive(Debug, Default)]
pub(super) struct Combing {
    combed: Edited<Combed>,
    /// Index of the selected guide.
    pub(super) selected: usize,
    path: Option<PathBuf>,
}

impl Combing {
    /// The guides.
    pub(super) fn combed(&self) -> &Combed {
        self.combed.now()
    }

    /// The file of the guides as they are; `None` before they are saved.
    pub(super) fn file(&self) -> Option<&Path> {
        self.path.as_deref().filter(|_| !self.combed.is_unsaved())
    }

    /// Whether there is a change to undo.
    pub(super) fn can_undo(&self) -> bool {
        self.combed.can_undo()
    }

    /// Adds a guide, and selects it.
    pub(super) fn add(&mut self, line: Vec<[f64; 2]>) {
        self.combed.change(|combed| combed.lines.push(line));
        self.selected = self.combed().lines.len() - 1;
    }

    /// Removes a guide.
    pub(super) fn remove(&mut self, index: usize) {
        self.combed.change(|combed| {
            combed.lines.remove(index);
        });
        if self.selected >= index {
            self.selected = self.selected.saturating_sub(1);
        }
    }

    /// Lets a guide run the other way.
    pub(super) fn reverse(&mut self, index: usize) {
        self.combed.change(|combed| combed.lines[index].reverse());
    }

    /// Sets whether the picture is a view of a model.
    pub(super) fn set_view(&mut self, is_view: bool) {
        self.combed.change(|combed| combed.camera = is_view.then_some(USUAL_CAMERA));
    }

    /// Sets the camera of a view of a model.
    pub(super) fn set_camera(&mut self, camera: [f32; 3]) {
        self.combed.adjust(|combed| combed.camera = Some(camera));
    }

    /// Undoes the last change; whether there was one.
    pub(super) fn undo(&mut self) -> bool {
        let undone = self.combed.undo();
        self.selected = self.selected.min(self.combed().lines.len().saturating_sub(1));
        undone
    }

    /// The guide nearest to a place, within `reach` pixels.
    pub(super) fn nearest(&self, place: [f64; 2], reach: f64) -> Option<usize> {
        let far = |line: &Vec<[f64; 2]>| {
            let distances = line.windows(2).map(|ends| distance(place, [ends[0], ends[1]]));
            distances.fold(f64::INFINITY, f64::min)
        };
        let all = self.combed().lines.iter().map(far).enumerate();
        let nearest = all.min_by(|one, other| one.1.total_cmp(&other.1));
        nearest.filter(|(_, far)| *far <= reach).map(|(index, _)| index)
    }

    /// Shows the guides of a file.
    pub(super) fn open(&mut self, combed: Combed, path: PathBuf) {
        self.combed.open(combed);
        (self.selected, self.path) = (0, Some(path));
    }

    /// Shows guides that are in no file; `path` is suggested for them.
    pub(super) fn restore(&mut self, combed: Combed, path: PathBuf) {
        self.open(Combed::default(), path);
        self.combed.adjust(|now| *now = combed);
    }

    /// Takes note of guides that were saved.
    pub(super) fn saved(&mut self, combed: Combed, path: PathBuf) {
        self.combed.saved(combed);
        self.path = Some(path);
    }

    /// The guides as a file for `picture` of this width and height.
    pub(super) fn drawn(&self, picture: &Path, size: [usize; 2]) -> DrawnFile {
        let path = self.path.clone().unwrap_or_else(|| DrawingKind::Guides.beside(picture));
        let name = |path: &Path| path.file_name().map(|name| name.to_string_lossy().into_owned());
        let Combed { lines, camera } = self.combed().clone();
        let guides = Guides {
            file: name(&path).unwrap_or_default(),
            picture: name(picture),
            size_px: size.map(|side| u32::try_from(side).unwrap_or(u32::MAX)),
            camera,
            lines,
        };
        DrawnFile { drawing: Drawing::Guides(guides), path }
    }

    /// The guides as a file, if they are in none.
    pub(super) fn unsaved(&self, picture: &Path, size: [usize; 2]) -> Option<DrawnFile> {
        let lost = self.combed.is_unsaved() && !self.combed().lines.is_empty();
        lost.then(|| self.drawn(picture, size))
    }
}
