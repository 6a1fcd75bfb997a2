//! Files that the scene makes: asks the worker for their content, and has them written.

use std::path::PathBuf;
use std::sync::Arc;

use documents::file::disk;
use documents::file::write_whole;
use graphics::export::PictureFormat;
use paint::document::{Document, Lighting};
use paint::light::Light;

use super::workspace::Volumes;
use crate::files::{self, Files, Problem, SceneAnswer, SceneExport};
use crate::language::tr_format;
use session::volumes::{SceneImage, SceneRecording, Subject, VolumeCommand};

/// Number of the request for the recording of an autosave.
const AUTOSAVE: u64 = 0;

impl Volumes {
    /// Carries out what the painter chose for a scene.
    pub(in crate::app) fn answer(&mut self, answer: SceneAnswer, files: &mut Files) {
        match answer {
            SceneAnswer::Open(path) => self.open(Subject::of_file(&path)),
            SceneAnswer::Library(path) => self.ask(VolumeCommand::Library(path)),
            SceneAnswer::Export(export, path) => self.export(export, path),
            SceneAnswer::Recover(lost) => {
                let folder = lost.meta.path.clone().unwrap_or_default();
                match disk::read_to_string(lost.script()) {
                    Ok(text) => {
                        self.open(Subject::Text { text, folder });
                        files.recovering_scene(lost);
                    }
                    Err(error) => {
                        let text = tr_format!(
                            "the autosave of {title}: cannot be read: {error}",
                            title = lost.meta.title,
                            error
                        );
                        files.report(Problem { text, hint: None });
                    }
                }
            }
        }
    }

    /// Asks for the recording if an autosave is due.
    pub(in crate::app) fn autosave(&mut self, files: &mut Files) {
        if files.wants_scene_recording() {
            self.worker.ask(VolumeCommand::Recording(AUTOSAVE));
        }
    }

    /// Asks the worker for the content of a file.
    fn export(&mut self, export: SceneExport, path: PathBuf) {
        let size = self.told.1;
        let number = self.await_file(export, path);
        self.ask(match export {
            SceneExport::Picture => VolumeCommand::Draw(number, size),
            SceneExport::Painting | SceneExport::OfPainting(_) => {
                VolumeCommand::Paint(number, size)
            }
            SceneExport::Script | SceneExport::Animation => VolumeCommand::Recording(number),
        });
    }

    /// Removes and returns the file that a request was for.
    fn take_awaited(&mut self, number: u64) -> Option<(SceneExport, PathBuf)> {
        let at = self.awaited.iter().position(|(own, ..)| *own == number)?;
        let (_, export, path) = self.awaited.remove(at);
        Some((export, path))
    }

    /// Writes the recording where it was asked for.
    pub(super) fn write_recording(
        &mut self,
        number: u64,
        recording: &Arc<SceneRecording>,
        files: &mut Files,
    ) {
        if number == AUTOSAVE {
            return files.autosave_scene(recording);
        }
        match self.take_awaited(number) {
            Some((SceneExport::Script, path)) => files.save_scene(recording, path),
            Some((SceneExport::Animation, path)) => {
                let recording = Arc::clone(recording);
                let size = self.told.1;
                files.export_scene(path, move |path, progress| {
                    session::volumes::animation(&recording, size, path, |share| {
                        progress.report(share).is_ok()
                    })
                    .map_err(Problem::from)?;
                    // Nothing was written if it was cancelled.
                    progress.report(1.0)?;
                    Ok(None)
                });
            }
            _ => {}
        }
    }

    /// Writes a picture where it was asked for.
    pub(super) fn write_picture(
        &mut self,
        number: u64,
        picture: Arc<SceneImage>,
        files: &mut Files,
    ) {
        let Some((_, path)) = self.take_awaited(number) else { return };
        files.export_scene(path, move |path, _| {
            let format = PictureFormat::from_path(path).unwrap_or(PictureFormat::Png8);
            let bytes = picture.file(format).map_err(Problem::from)?;
            write_whole(path, &bytes).map_err(Problem::from)?;
            Ok(None)
        });
    }

    /// Writes a painting, or an export of it, where it was asked for.
    pub(super) fn write_painting(
        &mut self,
        number: u64,
        document: Arc<Document>,
        files: &mut Files,
    ) {
        let Some((export, path)) = self.take_awaited(number) else { return };
        files.export_scene(path, move |path, progress| {
            if let SceneExport::OfPainting(export) = export {
                let Lighting { illuminant, observer, .. } = &document.lighting;
                let light = Light::named(&document.library, illuminant, observer);
                let light = light.map_err(|error| Problem::from_error(&error))?;
                return files::export(export, &document, &light, path, progress);
            }
            let bytes = paint::file::write(&document);
            let bytes = bytes.map_err(|error| Problem::from_error(&error))?;
            progress.report(0.8)?;
            write_whole(path, &bytes).map_err(Problem::from)?;
            Ok(None)
        });
    }
}
