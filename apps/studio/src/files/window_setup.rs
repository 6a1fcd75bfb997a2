//! The set-up of the window. We keep it with autosaves, so that you find a recovered painting as
//! you left it.

use std::path::{Path, PathBuf};

use artmap::passages::Marks;
use painterly::guides::Guides;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use super::problem::Problem;
use super::request::{Drawing, DrawingKind, DrawnFile};
use crate::language::{tr, tr_format};
use crate::pen::DrawingAids;

/// The view of the canvas, the brush and tool in hand, and the reference picture.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct WindowSetup {
    /// Name of the selected brush.
    pub brush: Option<String>,
    /// Name of the selected tool.
    pub tool: Option<String>,
    /// The view of the canvas.
    pub view: Option<CanvasView>,
    /// Ruler, perspective and symmetry.
    pub aids: Option<DrawingAids>,
    /// The picture beside the canvas.
    pub reference: Option<PinnedReference>,
}

/// A view of the canvas, see [`ViewState`](crate::view::ViewState).
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct CanvasView {
    /// The position in the middle, in cells.
    pub centre: [f64; 2],
    /// Physical pixels per cell.
    pub zoom: f64,
    /// Clockwise rotation in radians.
    pub rotation: f64,
    /// Whether left and right are exchanged.
    pub mirror: bool,
    /// Whether the canvas is fitted into the window.
    pub fitted: bool,
}

/// The reference picture and the lines drawn on it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PinnedReference {
    /// File of the picture.
    pub picture: PathBuf,
    /// SHA-256 digest of this file, in hexadecimal digits; `None` if we could not read it.
    #[serde(default)]
    pub sha256: Option<String>,
    /// Lines drawn on it.
    #[serde(default)]
    pub drawings: Vec<SavedDrawing>,
}

/// Lines drawn on the reference picture.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SavedDrawing {
    /// Whether these are marks of samples. If not, they are guides of strokes.
    pub marks: bool,
    /// The file of these lines, or the file that we suggest for them.
    pub path: PathBuf,
    /// The lines as the text of this file.
    pub toml: String,
}

impl PinnedReference {
    /// The reference picture in a file, and its drawings. We do not know its digest yet.
    #[must_use]
    pub fn new(picture: &Path, drawings: &[DrawnFile]) -> Self {
        let drawings = drawings
            .iter()
            .map(|DrawnFile { drawing, path }: &DrawnFile| SavedDrawing {
                marks: drawing.kind() == DrawingKind::Marks,
                path: path.clone(),
                toml: match drawing {
                    Drawing::Marks(marks) => marks.to_toml(),
                    Drawing::Guides(guides) => guides.to_toml(),
                },
            })
            .collect();
        Self { picture: picture.to_owned(), sha256: None, drawings }
    }

    /// The lines drawn on the picture. This leaves out lines that cannot be read.
    #[must_use]
    pub fn drawn(&self) -> Vec<DrawnFile> {
        self.drawings
            .iter()
            .filter_map(|SavedDrawing { marks, path, toml }| {
                let name = path.display().to_string();
                let drawing = if *marks {
                    Drawing::Marks(Marks::from_toml(&name, toml).ok()?)
                } else {
                    Drawing::Guides(Guides::from_toml(&name, toml).ok()?)
                };
                Some(DrawnFile { drawing, path: path.clone() })
            })
            .collect()
    }

    /// Message if the picture is gone or was replaced by another one.
    pub(super) fn remark(&self) -> Option<Problem> {
        let wanted = self.sha256.as_ref()?;
        let name = self.picture.display();
        let text = match digest_of(&self.picture) {
            Some(found) if found == *wanted => return None,
            Some(_) => {
                tr_format!("{name}: the reference picture has changed since the autosave", name)
            }
            None => tr_format!("{name}: the reference picture cannot be read any more", name),
        };
        Some(Problem::new(text, tr("its marks and guides are those of the autosave")))
    }
}

/// SHA-256 digest of a file, in hexadecimal digits; `None` if we cannot read it.
pub(super) fn digest_of(path: &Path) -> Option<String> {
    let bytes = documents::file::read(path).ok()?;
    Some(Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect())
}

#[cfg(test)]
mod tests {
    use artmap::passages::{Mark, MarkedArea};

    use super::*;

    #[test]
    fn a_window_setup_is_read_as_it_was_written_and_a_changed_picture_is_told_of() {
        let folder = tempfile::tempdir().unwrap();
        let picture = folder.path().join("orchard.png");
        std::fs::write(&picture, b"first").unwrap();
        let mark = Mark {
            name: "leaves".to_owned(),
            area: MarkedArea::Scribble(vec![[1.0, 2.0], [30.0, 4.5]]),
            spacing: None,
        };
        let marks = Marks {
            file: "orchard.marks.toml".to_owned(),
            painting: Some("orchard.png".to_owned()),
            samples: vec![mark],
        };
        let path = picture.with_extension("marks.toml");
        let drawn = DrawnFile { drawing: Drawing::Marks(marks), path };
        let mut reference = PinnedReference::new(&picture, std::slice::from_ref(&drawn));
        assert_eq!(reference.remark(), None, "nothing is known of the picture");
        reference.sha256 = digest_of(&picture);
        let view = CanvasView {
            centre: [3.5, 4.0],
            zoom: 2.0,
            rotation: 0.25,
            mirror: true,
            fitted: false,
        };
        let setup = WindowSetup {
            brush: Some("flat".to_owned()),
            tool: Some("pan".to_owned()),
            view: Some(view),
            aids: Some(DrawingAids { snaps: false, ..DrawingAids::default() }),
            reference: Some(reference),
        };
        let read: WindowSetup =
            serde_json::from_value(serde_json::to_value(&setup).unwrap()).unwrap();
        assert_eq!(read, setup);
        let reference = read.reference.unwrap();
        let Drawing::Marks(found) = &reference.drawn()[0].drawing else { panic!("marks") };
        let Drawing::Marks(wanted) = &drawn.drawing else { panic!("marks") };
        assert_eq!(found.samples, wanted.samples);
        assert_eq!(reference.remark(), None, "the picture is the same");
        std::fs::write(&picture, b"second").unwrap();
        assert!(reference.remark().unwrap().text.contains("changed"));
        std::fs::remove_file(&picture).unwrap();
        assert!(reference.remark().unwrap().text.contains("cannot be read"));
        let older: WindowSetup = serde_json::from_str("{}").unwrap();
        assert_eq!(older, WindowSetup::default());
    }
}
