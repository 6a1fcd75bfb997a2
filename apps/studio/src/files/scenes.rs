//! Scenes: their files, and autosaves of what was done to them.
//!
//! A scene is small on the disk: its script. A scene that was not saved when another is opened or
//! the window closes keeps its autosave, which the next start offers to recover.

use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};
use web_time::{Duration, Instant};

use super::asking::export_options;
use super::browser::{BrowserOptions, Filter, pictures_and};
use super::exporting::{Export, ExportKind};
use super::job::{JobError, Progress};
use super::open_dialog::{FilePurpose, OpenDialog};
use super::problem::Problem;
use super::scene_file::{SceneAnswer, SceneExport, ScenePurpose};
use super::state::Files;
use super::work::{Finished, JobKind, file_name};
use crate::language::{english, tr, tr_format};
use paint::scene::PixelsPerCell;
use session::volumes::{SceneRecording, SceneState};
use session::{Autosave, LostSession, SessionMeta, now};

const SCENES: Filter = Filter {
    label: english("Models, photographs and scripts"),
    endings: &pictures_and::<11>(&["glb", "gltf", "obj", "ply", "toml"]),
};
const LIBRARIES: Filter = Filter { label: english("Pigment libraries"), endings: &["json"] };
const SCRIPTS: Filter = Filter { label: english("Scripts"), endings: &["toml"] };
const PICTURES: Filter = Filter { label: english("Pictures"), endings: &["png", "exr"] };
const PAINTINGS: Filter = Filter { label: english("Paintings"), endings: &["exr"] };
const ANIMATIONS: Filter =
    Filter { label: english("Animations"), endings: &["gif", "png", "apng"] };

/// Longest time between a change and its autosave: a script is written in no time.
const INTERVAL: Duration = Duration::from_secs(2);

impl Files {
    /// Removes and returns the oldest answer of the painter about scenes.
    pub fn take_scene_answer(&mut self) -> Option<SceneAnswer> {
        self.scenes.answers.pop_front()
    }

    /// Asks for the file of a scene.
    pub fn ask_for_scene(&mut self) {
        const KINDS: [Filter; 3] = [SCENES, SCRIPTS, Filter::ALL];
        let options = BrowserOptions::open(tr("Open a scene"), &KINDS);
        self.browse(options, FilePurpose::Scene(ScenePurpose::Open));
    }

    /// Asks for the library of a scene's tubes.
    pub fn ask_for_scene_library(&mut self) {
        const KINDS: [Filter; 2] = [LIBRARIES, Filter::ALL];
        let options = BrowserOptions::open(tr("Open a pigment library"), &KINDS);
        self.browse(options, FilePurpose::Scene(ScenePurpose::Library));
    }

    /// Asks where to write a file of the scene.
    pub fn ask_where_to_export_scene(&mut self, export: SceneExport) {
        let (title, filters, ending): (_, &[Filter; 2], _) = match export {
            SceneExport::Picture => (tr("Save the picture"), &[PICTURES, Filter::ALL], "png"),
            SceneExport::Painting => (tr("Save the painting"), &[PAINTINGS, Filter::ALL], "exr"),
            SceneExport::Script => (tr("Save the script"), &[SCRIPTS, Filter::ALL], "toml"),
            SceneExport::Animation => (tr("Save the animation"), &[ANIMATIONS, Filter::ALL], "gif"),
            SceneExport::OfPainting(Export { kind, .. }) => {
                let options = export_options(kind, &self.scene_stem());
                return self.browse(options, FilePurpose::Scene(ScenePurpose::Export(export)));
            }
        };
        let name = format!("{}.{ending}", self.scene_stem());
        let ending = Some(ending);
        let others = filters[0].endings;
        let options = BrowserOptions { title, saving: true, filters, ending, others, name };
        self.browse(options, FilePurpose::Scene(ScenePurpose::Export(export)));
    }

    /// Asks what to export of the painting that the scene makes.
    pub fn ask_what_to_export_of_scene(&mut self) {
        let export = Export { kind: ExportKind::Layers, pixels: PixelsPerCell::default() };
        self.dialogs.push(OpenDialog::ExportOfScene(export));
    }

    /// The name of the scene's files, without an ending.
    fn scene_stem(&self) -> String {
        file_stem(self.scenes.open.as_ref().map_or("scene", |(title, _)| title))
    }

    /// Notes the painter's choice of a file.
    pub(super) fn choose_for_scene(&mut self, purpose: ScenePurpose, path: PathBuf) {
        self.scenes.answers.push_back(match purpose {
            ScenePurpose::Open => {
                self.preferences.remember(&path);
                SceneAnswer::Open(path)
            }
            ScenePurpose::Library => SceneAnswer::Library(path),
            ScenePurpose::Export(export) => SceneAnswer::Export(export, path),
        });
    }

    /// Recovers a lost scene, by its place in the list.
    pub(super) fn recover_scene(&mut self, index: usize) {
        let lost = self.scenes.lost.remove(index);
        self.scenes.answers.push_back(SceneAnswer::Recover(lost));
    }

    /// Keeps the lost scene that is being opened until it is autosaved again.
    pub fn recovering_scene(&mut self, lost: LostSession) {
        self.scenes.opening = Some(lost);
    }

    /// The worker has opened a scene.
    pub fn scene_opened(&mut self, state: &SceneState) {
        self.scenes.end();
        let begun = Autosave::begin(&self.home.scenes());
        let autosave = begun.map_err(|failure| self.report(failure.into())).ok();
        self.scenes.autosave = Arc::new(Mutex::new(autosave));
        self.scenes.open = Some((state.title.clone(), state.revision));
        self.scenes.recovered = self.scenes.opening.take();
        // A recovered scene is in no file.
        let in_file = self.scenes.recovered.is_none();
        self.scenes.saved = if in_file { state.revision } else { u64::MAX };
        self.scenes.autosaved = self.scenes.saved;
        (self.scenes.awaited, self.scenes.last_autosave) = (false, Instant::now());
    }

    /// The state of the scene changed.
    pub fn scene_changed(&mut self, state: &SceneState) {
        if let Some((_, revision)) = &mut self.scenes.open {
            *revision = state.revision;
        }
    }

    /// Whether the recording is wanted now, for an autosave; otherwise the window is drawn again
    /// when it will be.
    pub fn wants_scene_recording(&mut self) -> bool {
        let Some((_, revision)) = &self.scenes.open else { return false };
        let changed = self.scenes.is_changed() && self.scenes.autosaved != *revision;
        if !changed || self.scenes.awaited {
            return false;
        }
        let interval = Duration::from_secs(self.preferences.autosave_seconds).min(INTERVAL);
        match interval.checked_sub(self.scenes.last_autosave.elapsed()) {
            Some(left) if !left.is_zero() => {
                self.ctx.request_repaint_after(left);
                false
            }
            _ => {
                (self.scenes.awaited, self.scenes.last_autosave) = (true, Instant::now());
                true
            }
        }
    }

    /// Writes the autosave of a scene.
    pub fn autosave_scene(&mut self, recording: &SceneRecording) {
        self.scenes.awaited = false;
        let Some((title, _)) = self.scenes.open.clone() else { return };
        self.scenes.autosaved = recording.revision;
        let path = Some(recording.folder.clone());
        let meta = SessionMeta { title, path, seconds: now(), desk: None };
        let autosave = self.scenes.autosave.clone();
        let text = recording.text.clone();
        self.start_job(JobKind::Autosave, "autosave".to_owned(), move |_| {
            let mut autosave = autosave.lock().unwrap_or_else(PoisonError::into_inner);
            if let Some(autosave) = autosave.as_mut() {
                autosave.keep_script(&text, &meta).map_err(Problem::from)?;
            }
            Ok(Finished::SceneAutosaved)
        });
    }

    /// An autosave of the scene was written: it holds what the scene was recovered from.
    pub(super) fn scene_autosaved(&mut self) {
        if let Some(lost) = self.scenes.recovered.take() {
            lost.discard();
        }
    }

    /// Saves the script of a scene in a file.
    pub fn save_scene(&mut self, recording: &SceneRecording, path: PathBuf) {
        let recording = recording.clone();
        let label = tr_format!("saving {path}", path = file_name(&path));
        self.start_job(JobKind::Saving, label, move |_| {
            recording.save(&path).map_err(Problem::from)?;
            Ok(Finished::SceneSaved { path, revision: recording.revision })
        });
    }

    /// The script of the scene was saved.
    pub(super) fn scene_saved(&mut self, path: &Path, revision: u64) {
        self.scenes.saved = revision;
        self.preferences.remember(path);
        self.preferences.last_folder = path.parent().map(ToOwned::to_owned);
    }

    /// Writes a file of the scene on a thread of its own.
    pub(crate) fn export_scene(
        &mut self,
        path: PathBuf,
        work: impl FnOnce(&Path, &Progress) -> Result<Option<Problem>, JobError> + Send + 'static,
    ) {
        let label = tr_format!("exporting {path}", path = file_name(&path));
        self.start_job(JobKind::Shown, label, move |progress| {
            let remark = work(&path, progress)?;
            Ok(Finished::Exported { path, remark })
        });
    }
}

/// The name of a file without what cannot be in one.
fn file_stem(title: &str) -> String {
    title.chars().map(|letter: char| if letter.is_alphanumeric() { letter } else { '-' }).collect()
}
