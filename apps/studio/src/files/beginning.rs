//! Begins a painting as the dialog describes it.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use paint::document::Document;
use paint::strokes::StrokeScript;
use pigment::library::PigmentLibrary;
use strokes::{Photograph, first_layer};

use super::asking::PICTURES;
use super::browser::{BrowserOptions, Filter};
use super::job::{JobError, Progress};
use super::new_dialog::{CanvasPicture, NewDialog};
use super::open_dialog::{FilePurpose, OpenDialog};
use super::problem::Problem;
use super::state::Files;
use super::work::{Finished, JobKind, file_name};
use crate::language::{tr, tr_format};
use session::{Origin, PaintingState, blank_canvas};

impl Files {
    /// Opens the dialog of a new painting, which begins with the canvas of the last.
    pub(super) fn ask_for_new(&mut self, state: &PaintingState) {
        let last = self.preferences.new_painting.last.clone();
        let dialog = NewDialog::new(state, last, &self.ctx);
        self.dialogs.push(OpenDialog::New(Box::new(dialog)));
    }

    /// Asks for a picture of the canvas; the dialog stays open below.
    pub(super) fn ask_for_canvas_picture(&mut self, picture: CanvasPicture) {
        const KINDS: [Filter; 2] = [PICTURES, Filter::ALL];
        let title = match picture {
            CanvasPicture::Relief => tr("Picture of the relief"),
            CanvasPicture::FirstLayer => tr("Picture of the first layer"),
        };
        self.browse(BrowserOptions::open(title, &KINDS), FilePurpose::Canvas(picture));
    }

    /// Gives a picture to the dialog that asked for it.
    pub(super) fn use_canvas_picture(&mut self, picture: CanvasPicture, path: PathBuf) {
        if let Some(OpenDialog::New(dialog)) = self.dialogs.last_mut() {
            dialog.set_picture(picture, path);
        }
    }

    /// Opens the painting that the dialog describes, with the current palette and library
    /// if the painter chose so.
    pub(super) fn begin_new(&mut self, dialog: &NewDialog) {
        let new = dialog.new.clone();
        self.preferences.new_painting.last = new.clone();
        let canvas = new.canvas;
        let library = PigmentLibrary::clone(dialog.own_library());
        let Origin::Blank { mut script, library } =
            blank_canvas(library, canvas.width_mm, canvas.height_mm, canvas.cell_mm)
        else {
            return;
        };
        script.canvas = canvas;
        if new.same_pigments && !dialog.palette.pigments.is_empty() {
            script.palette = dialog.palette.clone();
        }
        match new.first_layer {
            None => self.begin_painting(*script, *library),
            Some(path) => self.begin_on_picture(path, script, library),
        }
    }

    /// Starts to lay the first layer from the picture in `path`.
    fn begin_on_picture(
        &mut self,
        path: PathBuf,
        script: Box<StrokeScript>,
        library: Box<PigmentLibrary>,
    ) {
        let label = tr_format!("mixing the colours of {path}", path = file_name(&path));
        self.start_job(JobKind::Shown, label, move |progress| {
            let document = on_picture(&path, &script, &library, progress)?;
            let bytes =
                paint::file::write(&document).map_err(|error| Problem::from_error(&error))?;
            Ok(Finished::Begun(Box::new(document), Arc::new(bytes)))
        });
    }
}

/// The canvas of `script` with the picture in `path` as its first dry layer.
fn on_picture(
    path: &Path,
    script: &StrokeScript,
    library: &PigmentLibrary,
    progress: &Progress,
) -> Result<Document, JobError> {
    let photograph = Photograph::open(path).map_err(|error| Problem::from_error(&error))?;
    progress.report(0.1)?;
    let surfaces = script.surfaces(library, None);
    let (mut document, _) = surfaces.map_err(|error| Problem::from_error(&error))?;
    progress.report(0.3)?;
    let layer = first_layer(&photograph, &document).map_err(|error| Problem::from_error(&error))?;
    progress.report(0.9)?;
    document.push_dry(document.slots, layer);
    Ok(document)
}
