//! State of the reference panel.

use std::fmt;
use std::path::{Path, PathBuf};

use eframe::egui::{Context, TextureHandle};

use super::combing::{Combed, Combing};
use super::mode::ReferenceMode;
use super::picture::{PendingPicture, Picture};
use super::picture_view::PictureView;
use super::place::OverCanvas;
use super::pointer_line::PointerLine;
use super::samples::SampleMarks;
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
    /// Lines to be shown once the picture is read.
    pub(super) restoring: Vec<DrawnFile>,
    /// Whether the pointer marks the distance of strokes, not a sample.
    pub(super) spacing: bool,
    /// First of the two places that are clicked for a distance of strokes.
    pub(super) first_place: Option<[f64; 2]>,
    pub(super) line: PointerLine,
    /// Index and new name of a sample while it is typed.
    pub(super) renaming: Option<(usize, String)>,
    /// Whether the pointer is over the picture.
    pub(super) hovered: bool,
    /// How the picture lies over the canvas.
    pub(super) over: OverCanvas,
    /// Exposure of a picture of a scene, in stops.
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
    /// Starts to read a photograph, linear OpenEXR or painting on another thread, replacing the current picture and what is
    /// drawn on it. An error is shown in the panel.
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

    /// Whether a picture is shown, being read, or failed to be read.
    #[must_use]
    pub fn is_open(&self) -> bool {
        self.path.is_some()
    }

    /// Takes note that the panel is not shown in this frame.
    pub fn hide(&mut self) {
        self.hovered = false;
        self.line.clear();
    }

    /// Carries out a change. Returns what the painter should know of it.
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

    /// Shows the lines that waited for the picture, as lines that are in no file.
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

    /// File of the picture, and all lines drawn on it, whether they are in a file or not.
    #[must_use]
    pub fn pinned(&self) -> Option<(&Path, Vec<DrawnFile>)> {
        let path = self.path.as_deref()?;
        let Some(picture) = &self.picture else { return Some((path, self.restoring.clone())) };
        let marks = (!self.samples.marks().is_empty()).then(|| self.samples.drawn(path));
        let guides = !self.combing.combed().lines.is_empty();
        let guides = guides.then(|| self.combing.drawn(path, picture.file_size()));
        Some((path, marks.into_iter().chain(guides).collect()))
    }

    /// The drawings that are in no file.
    #[must_use]
    pub fn unsaved_drawings(&self) -> Vec<DrawnFile> {
        let (Some(path), Some(picture)) = (&self.path, &self.picture) else { return Vec::new() };
        let marks = self.samples.unsaved(path);
        marks.into_iter().chain(self.combing.unsaved(path, picture.file_size())).collect()
    }

    /// Undoes the last line if the pointer is over a picture that is drawn on. Returns whether it
    /// is.
    pub fn undo_under_pointer(&mut self) -> bool {
        let draws = self.hovered && self.mode != ReferenceMode::Pick;
        if draws {
            self.undo();
        }
        draws
    }

    /// Undoes the last change of the drawing that the mode is for.
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
