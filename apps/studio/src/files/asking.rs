//! Opens and shows the dialogs, and does what the painter answers. This also crops the painting,
//! saves lines drawn on the reference picture, and handles the files of scenes.
//!
//! The history of a painting keeps pieces of a canvas of one size. If you crop, this history
//! ends, and a new recording begins with the part that stays.
//!
//! The script of a scene is small. If you open another scene or close the window without saving,
//! the autosave of the scene stays, and the next start offers to recover it.

use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

use documents::Task;
use eframe::egui::Ui;
use graphics::export::PictureFormat;
use graphics::picture_formats;
use graphics::tile::Rect;
use paint::document::Document;
use paint::scene::PixelsPerCell;
use session::volumes::{SceneRecording, SceneState};
use session::{Autosave, Command, LostSession, Origin, SessionMeta, Snapshot, now};
use web_time::{Duration, Instant};

use super::browser::{Answer, Browser, BrowserOptions, Filter, pictures_and};
use super::dialogs::{self, Choice};
use super::exporting::{
    Export, ExportKind, SceneAnswer, SceneExport, ScenePurpose, TimelapseExport,
};
use super::job::JobError;
use super::new_dialog::NewAnswer;
use super::opened;
use super::preferences::Preferences;
use super::problem::Problem;
use super::request::{Drawing, DrawingKind, DrawnFile, ReferenceChange, SwatchFormat};
use super::state::{FilePurpose, Files, OpenDialog};
use super::work::{
    FileOrigin, Finished, JobKind, Notice, PendingAction, Purpose, Replacement, file_name,
};
use crate::language::{english, tr, tr_format};

const PAINTINGS: Filter = Filter { label: english("Paintings"), endings: &["exr"] };
pub(super) const PICTURES: Filter =
    Filter { label: english("Pictures"), endings: &picture_formats::ENDINGS };
const REFERENCES: Filter =
    Filter { label: english("Pictures and paintings"), endings: &pictures_and::<7>(&["exr"]) };
const SCRIPTS: Filter = Filter { label: english("Recordings and libraries"), endings: &["json"] };
const DRAWINGS: Filter = Filter { label: english("Marks and guides"), endings: &["toml"] };
const SWATCHES: Filter =
    Filter { label: english("Mixtures and swatches"), endings: &["json", "gpl", "ase", "aco"] };
const LAMPS: Filter = Filter {
    label: english("Spectra"),
    endings: &["csv", "txt", "tsv", "cgats", "it8", "cxf", "json"],
};
const OPENABLE: Filter = Filter {
    label: english("All that can be opened"),
    endings: &pictures_and::<8>(&["exr", "json"]),
};

impl Files {
    /// Shows the topmost dialog, which takes all input, and carries out its answer.
    pub(super) fn show_dialog(&mut self, ui: &mut Ui) {
        let ctx = ui.ctx().clone();
        let Some(mut dialog) = self.dialogs.pop() else { return };
        let below = self.dialogs.len();
        let stays = match &mut dialog {
            OpenDialog::Browser(browser, _) => match browser.show(&ctx, &mut self.thumbnails) {
                None => {
                    self.preferences.browser = browser.look;
                    true
                }
                Some(answer) => {
                    let folder = Some(browser.folder().to_owned());
                    if let (OpenDialog::Browser(_, purpose), Answer::File(path)) = (dialog, answer)
                    {
                        self.preferences.last_folder = folder;
                        self.use_file(purpose, path);
                    }
                    return;
                }
            },
            OpenDialog::Unsaved(_) => {
                let choice = dialogs::unsaved(&ctx, &self.title());
                match (choice, dialog) {
                    (Some(Choice::Yes), OpenDialog::Unsaved(next)) => match self.path.clone() {
                        Some(path) => self.save(path, Some(next)),
                        None => self.ask_where_to_save(Some(next), false),
                    },
                    (Some(Choice::No), OpenDialog::Unsaved(next)) => self.carry_out(next),
                    (None, unanswered) => self.dialogs.insert(below, unanswered),
                    _ => {}
                }
                return;
            }
            OpenDialog::UnsavedDrawings(action) => {
                let lost = self.drawings_lost_by(action);
                let choice = dialogs::unsaved_drawings(&ctx, &lost);
                match (choice, dialog) {
                    (Some(Choice::Yes), OpenDialog::UnsavedDrawings(next)) => {
                        match lost.into_iter().next() {
                            Some(drawn) => self.ask_where_to_draw(drawn, Some(next)),
                            None => self.carry_out_safely(next),
                        }
                    }
                    (Some(Choice::No), OpenDialog::UnsavedDrawings(next)) => {
                        self.carry_out_without_drawings(next);
                    }
                    (None, unanswered) => self.dialogs.insert(below, unanswered),
                    _ => {}
                }
                return;
            }
            OpenDialog::DeleteRevision(path) => {
                let choice = dialogs::delete(&ctx, path);
                if choice == Some(Choice::Yes) {
                    self.delete_revision(path.clone());
                }
                choice.is_none()
            }
            OpenDialog::Export(export) => {
                let choice = dialogs::export(&ctx, export);
                if choice == Some(Choice::Yes) {
                    let export = *export;
                    self.ask_where_to_export(export);
                    return;
                }
                choice.is_none()
            }
            OpenDialog::ExportOfScene(export) => {
                let choice = dialogs::export(&ctx, export);
                if choice == Some(Choice::Yes) {
                    let export = SceneExport::OfPainting(*export);
                    self.ask_where_to_export_scene(export);
                    return;
                }
                choice.is_none()
            }
            OpenDialog::Timelapse(export) => {
                let choice = dialogs::timelapse(&ctx, export);
                if choice == Some(Choice::Yes) {
                    let export = *export;
                    self.ask_where_to_film(export);
                    return;
                }
                choice.is_none()
            }
            OpenDialog::New(new) => match new.show(&ctx, &mut self.preferences.new_painting) {
                Some(NewAnswer::Begin) => return self.begin_new(new),
                Some(NewAnswer::Cancelled) => false,
                Some(NewAnswer::Choose(picture)) => {
                    self.ask_for_canvas_picture(picture);
                    true
                }
                None => true,
            },
            OpenDialog::Preferences => dialogs::preferences(&ctx, &mut self.preferences),
        };
        if stays {
            // The answer may have opened other dialogs, which stay above this one.
            self.dialogs.insert(below, dialog);
        }
    }

    fn use_file(&mut self, purpose: FilePurpose, path: PathBuf) {
        match purpose {
            FilePurpose::Open | FilePurpose::Lamp => self.read(path),
            FilePurpose::Save { next, keep_revision } => {
                self.request_snapshot(Purpose::Save { path, next, keep_revision });
            }
            FilePurpose::Export(export) => {
                self.request_snapshot(Purpose::Export { export, path });
            }
            FilePurpose::Timelapse(export) => {
                self.request_recording(Purpose::Timelapse { export, path });
            }
            FilePurpose::Recording => self.request_recording(Purpose::Recording { path }),
            FilePurpose::Canvas(picture) => self.use_canvas_picture(picture, path),
            FilePurpose::Reference => self.change_reference(ReferenceChange::Open(path)),
            FilePurpose::SaveDrawing { drawing, next } => self.save_drawing(*drawing, path, next),
            FilePurpose::OpenDrawing(kind) => self.read_drawing(kind, path),
            FilePurpose::ImportBrushes => self.import_brushes(path),
            FilePurpose::ExportBrushes(set) => self.export_brushes(*set, path),
            FilePurpose::ImportSwatches => self.import_swatches(path),
            FilePurpose::ExportSwatches(format) => self.export_swatches(format, path),
            FilePurpose::Scene(purpose) => self.choose_for_scene(purpose, path),
        }
    }

    /// Removes and returns the extensions that the open dialog asks for, or `None` if no dialog was
    /// opened since the last call. An empty list means all files. A page uses this to ask with the
    /// browser's own dialog.
    pub fn take_wanted(&mut self) -> Option<Vec<&'static str>> {
        self.wanted.take()
    }

    /// Answers the topmost dialog with the file at `path`, if it asks for a file to open. Returns
    /// whether it did.
    pub fn choose(&mut self, path: &Path) -> bool {
        if !self.dialogs.last().is_some_and(|dialog: &OpenDialog| match dialog {
            OpenDialog::Browser(browser, _) => !browser.is_saving(),
            _ => false,
        }) {
            return false;
        }
        if let Some(OpenDialog::Browser(_, purpose)) = self.dialogs.pop() {
            self.use_file(purpose, path.to_owned());
        }
        true
    }

    fn delete_revision(&mut self, path: PathBuf) {
        match opened::delete(&path) {
            Ok(()) => {
                let text = tr_format!("deleted {path}", path = file_name(&path));
                self.notices.push(Notice::done(&text));
            }
            Err(problem) => self.report(problem),
        }
        self.list_revisions();
    }

    pub(super) fn browse(&mut self, options: BrowserOptions, purpose: FilePurpose) {
        let beside = self.path.clone();
        self.browse_beside(beside.as_deref(), options, purpose);
    }

    /// Asks for a file in the folder of another one.
    fn browse_beside(
        &mut self,
        beside: Option<&Path>,
        options: BrowserOptions,
        purpose: FilePurpose,
    ) {
        let beside = beside.and_then(|path| path.parent());
        let folder = beside.or(self.preferences.last_folder.as_deref());
        let Preferences { recent, browser: look, .. } = &self.preferences;
        if !options.saving {
            let endings = options.filters.iter().flat_map(|filter| filter.endings);
            self.wanted = Some(endings.copied().collect());
        }
        let browser = Browser::new(options, folder, recent, *look, &self.ctx);
        self.dialogs.push(OpenDialog::Browser(Box::new(browser), purpose));
    }

    pub(super) fn ask_for_file(&mut self) {
        const KINDS: [Filter; 5] = [OPENABLE, PAINTINGS, SCRIPTS, PICTURES, Filter::ALL];
        self.browse(BrowserOptions::open(tr("Open"), &KINDS), FilePurpose::Open);
    }

    pub(super) fn ask_for_reference(&mut self) {
        const KINDS: [Filter; 2] = [REFERENCES, Filter::ALL];
        let options = BrowserOptions::open(tr("Picture beside the canvas"), &KINDS);
        self.browse(options, FilePurpose::Reference);
    }

    pub(super) fn ask_for_lamp(&mut self) {
        const KINDS: [Filter; 2] = [LAMPS, Filter::ALL];
        self.browse(BrowserOptions::open(tr("Measured lamp"), &KINDS), FilePurpose::Lamp);
    }

    pub(super) fn ask_where_to_save(&mut self, next: Option<PendingAction>, keep_revision: bool) {
        let options = BrowserOptions {
            title: tr("Save the painting"),
            saving: true,
            filters: &[PAINTINGS, Filter::ALL],
            ending: Some("exr"),
            others: &[],
            name: format!("{}.exr", self.title()),
        };
        self.browse(options, FilePurpose::Save { next, keep_revision });
    }

    pub(super) fn ask_where_to_record(&mut self) {
        let options = BrowserOptions {
            title: tr("Save the recording"),
            saving: true,
            filters: &[SCRIPTS, Filter::ALL],
            ending: Some("json"),
            others: &[],
            name: format!("{}.json", self.title()),
        };
        self.browse(options, FilePurpose::Recording);
    }

    pub(super) fn ask_for_drawing(&mut self, kind: DrawingKind, picture: &Path) {
        const KINDS: [Filter; 2] = [DRAWINGS, Filter::ALL];
        let title = match kind {
            DrawingKind::Marks => tr("Open marks"),
            DrawingKind::Guides => tr("Open guides"),
        };
        let options = BrowserOptions::open(title, &KINDS);
        self.browse_beside(Some(picture), options, FilePurpose::OpenDrawing(kind));
    }

    pub(super) fn ask_where_to_draw(
        &mut self,
        DrawnFile { drawing, path }: DrawnFile,
        next: Option<PendingAction>,
    ) {
        let options = BrowserOptions {
            title: match drawing.kind() {
                DrawingKind::Marks => tr("Save the marks"),
                DrawingKind::Guides => tr("Save the guides"),
            },
            saving: true,
            filters: &[DRAWINGS, Filter::ALL],
            ending: Some("toml"),
            others: &[],
            name: file_name(&path),
        };
        let purpose = FilePurpose::SaveDrawing { drawing: Box::new(drawing), next };
        self.browse_beside(Some(&path), options, purpose);
    }

    pub(super) fn ask_for_swatches(&mut self) {
        const KINDS: [Filter; 2] = [SWATCHES, Filter::ALL];
        let options = BrowserOptions::open(tr("Import mixtures or colours"), &KINDS);
        self.browse(options, FilePurpose::ImportSwatches);
    }

    pub(super) fn ask_where_to_keep_swatches(&mut self, format: SwatchFormat) {
        let options = BrowserOptions {
            title: tr("Export the kept mixtures"),
            saving: true,
            filters: &[SWATCHES, Filter::ALL],
            ending: Some(format.ending()),
            others: &[],
            name: format!("mixtures.{}", format.ending()),
        };
        self.browse(options, FilePurpose::ExportSwatches(format));
    }

    pub(super) fn ask_what_to_export(&mut self) {
        let kind = ExportKind::Picture(PictureFormat::Png8);
        let export = Export { kind, pixels: PixelsPerCell::default() };
        self.dialogs.push(OpenDialog::Export(export));
    }

    fn ask_where_to_export(&mut self, export: Export) {
        let options = export_options(export.kind, &self.title());
        self.browse(options, FilePurpose::Export(export));
    }

    pub(super) fn ask_for_timelapse(&mut self) {
        self.dialogs.push(OpenDialog::Timelapse(TimelapseExport::default()));
    }

    fn ask_where_to_film(&mut self, export: TimelapseExport) {
        let ending = export.ending();
        let options = BrowserOptions {
            title: tr("Export the timelapse"),
            saving: true,
            filters: &[Filter::ALL],
            ending: Some(ending),
            others: &[],
            // The plain name may belong to a picture already.
            name: format!("{}-timelapse.{ending}", self.title()),
        };
        self.browse(options, FilePurpose::Timelapse(export));
    }

    /// Notes the drawings on the reference picture that are in no file. Call this every frame
    /// before [`Files::update`].
    pub fn note_drawings(&mut self, unsaved: Vec<DrawnFile>) {
        self.unsaved_drawings = unsaved;
    }

    /// The unsaved drawings that this action would lose.
    pub(super) fn drawings_lost_by(&self, action: &PendingAction) -> Vec<DrawnFile> {
        self.unsaved_drawings
            .iter()
            .filter(|drawn| match action {
                PendingAction::Close { drawings_given_up } => !drawings_given_up,
                PendingAction::Replace(_) | PendingAction::Reference(ReferenceChange::Saved(_)) => {
                    false
                }
                PendingAction::Reference(ReferenceChange::Draw(new)) => {
                    new.drawing.kind() == drawn.drawing.kind()
                }
                PendingAction::Reference(
                    ReferenceChange::Open(_)
                    | ReferenceChange::Restore { .. }
                    | ReferenceChange::Close,
                ) => true,
            })
            .cloned()
            .collect()
    }

    /// Changes the picture beside the canvas. If this loses drawings, it asks first.
    pub(super) fn change_reference(&mut self, change: ReferenceChange) {
        self.carry_out_safely(PendingAction::Reference(change));
    }

    /// Continues an action, although it loses the drawings.
    pub(super) fn carry_out_without_drawings(&mut self, action: PendingAction) {
        match action {
            PendingAction::Close { .. } => {
                self.carry_out_safely(PendingAction::Close { drawings_given_up: true });
            }
            other => self.carry_out(other),
        }
    }

    pub(super) fn save_drawing(
        &mut self,
        drawing: Drawing,
        path: PathBuf,
        next: Option<PendingAction>,
    ) {
        let label = tr_format!("saving {path}", path = file_name(&path));
        self.start_job(JobKind::Saving, label, move |_| {
            drawing.save(&path)?;
            Ok(Finished::DrawingSaved { drawn: DrawnFile { drawing, path }, next })
        });
    }

    pub(super) fn read_drawing(&mut self, kind: DrawingKind, path: PathBuf) {
        let label = tr_format!("reading {path}", path = file_name(&path));
        self.start_job(JobKind::Shown, label, move |_| {
            let drawing = kind.open(&path)?;
            Ok(Finished::DrawingRead(DrawnFile { drawing, path }))
        });
    }

    pub(super) fn drawing_saved(&mut self, drawn: DrawnFile, next: Option<PendingAction>) {
        self.notices.push(Notice::done(&tr_format!("saved {path}", path = drawn.path.display())));
        self.unsaved_drawings.retain(|unsaved| unsaved.drawing != drawn.drawing);
        self.reference.push_back(ReferenceChange::Saved(drawn));
        if let Some(next) = next {
            self.carry_out_safely(next);
        }
    }

    pub(super) fn start_crop(&mut self, rect: Rect, snapshot: &Snapshot) {
        let canvas = Arc::clone(&snapshot.canvas);
        let palette = Arc::clone(&snapshot.palette);
        let revision = snapshot.revision;
        let epoch = self.epoch;
        self.start_job(JobKind::Shown, tr("cropping the painting").to_owned(), move |task| {
            let cropped = canvas.cropped(rect);
            task.reach(0.2)?;
            let bytes =
                paint::file::write(&cropped).map_err(|error| Problem::from_error(&error))?;
            let canvas = Box::new(cropped);
            let start = Arc::new(bytes);
            Ok(Finished::Cropped { canvas, palette, start, revision, epoch })
        });
    }

    /// Opens the part that stays, unless you painted something meanwhile.
    pub(super) fn continue_cropped(
        &mut self,
        canvas: Box<Document>,
        palette: Arc<Document>,
        start: Arc<Vec<u8>>,
        revision: u64,
    ) {
        let state = self.painting.as_ref();
        if state.is_none_or(|state| state.stroke_open || state.revision != revision) {
            let text = tr("the painting changed while it was cropped");
            return self.report(Problem::new(text, tr("crop it again")));
        }
        let [width, height] = [canvas.wet.width(), canvas.wet.height()]
            .map(|cells: usize| cells as f64 * canvas.cell_mm);
        let size = tr_format!("cropped to {width:.1} x {height:.1} mm", width, height);
        let mixed = palette.wet.totals().iter().any(|total| *total > 0);
        let (origin, start, text) = if mixed {
            // A recording begins with a clean palette, so we drop the palette here.
            let palette = Box::new(Arc::unwrap_or_clone(palette));
            let text =
                tr_format!("{size}; without a recording, as the palette keeps its paint", size);
            (Origin::Recovered { canvas, palette, kept: None }, None, text)
        } else {
            (Origin::Painting(canvas), Some(start), size)
        };
        let commands = vec![Command::Open(origin)];
        let files =
            FileOrigin { path: self.path.clone(), start, changed: true, ..FileOrigin::default() };
        self.notices.push(Notice::done(&text));
        // We lose nothing, so we do not ask.
        self.carry_out(PendingAction::Replace(Replacement { commands, origin: files }));
    }

    /// Removes and returns the oldest answer of the painter about scenes.
    pub fn take_scene_answer(&mut self) -> Option<SceneAnswer> {
        self.scenes.answers.pop_front()
    }

    /// Asks for the file of a scene.
    pub fn ask_for_scene(&mut self) {
        const KINDS: [Filter; 3] = [SCENES, SCENES_SCRIPTS, Filter::ALL];
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
            SceneExport::Picture => {
                (tr("Save the picture"), &[SCENES_PICTURES, Filter::ALL], "png")
            }
            SceneExport::Painting => {
                (tr("Save the painting"), &[SCENES_PAINTINGS, Filter::ALL], "exr")
            }
            SceneExport::Script => (tr("Save the script"), &[SCENES_SCRIPTS, Filter::ALL], "toml"),
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

    fn scene_stem(&self) -> String {
        file_stem(self.scenes.open.as_ref().map_or("scene", |(title, _)| title))
    }

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

    pub(super) fn recover_scene(&mut self, index: usize) {
        let lost = self.scenes.lost.remove(index);
        self.scenes.answers.push_back(SceneAnswer::Recover(lost));
    }

    /// Call this before a lost scene is opened. We keep its autosave until the opened scene has its
    /// own.
    pub fn recovering_scene(&mut self, lost: LostSession) {
        self.scenes.opening = Some(lost);
    }

    /// Call this when the worker has opened a scene.
    pub fn scene_opened(&mut self, state: &SceneState) {
        self.scenes.end();
        let begun = Autosave::begin(&self.home.scenes());
        let autosave = begun.map_err(|failure| self.report(failure.into())).ok();
        self.scenes.autosave = Arc::new(Mutex::new(autosave));
        self.scenes.open = Some((state.title.clone(), state.revision));
        self.scenes.recovered = self.scenes.opening.take();
        // A recovered scene is in no file yet.
        let in_file = self.scenes.recovered.is_none();
        self.scenes.saved = if in_file { state.revision } else { u64::MAX };
        self.scenes.autosaved = self.scenes.saved;
        (self.scenes.awaited, self.scenes.last_autosave) = (false, Instant::now());
    }

    /// Call this when the state of the scene has changed.
    pub fn scene_changed(&mut self, state: &SceneState) {
        if let Some((_, revision)) = &mut self.scenes.open {
            *revision = state.revision;
        }
    }

    /// Whether you should ask for the recording now, for an autosave. If not, this asks for a frame
    /// at the time when it is due.
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

    /// Call this when an autosave of the scene was written. If the scene was recovered, this
    /// deletes the autosave that it came from.
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

    pub(super) fn scene_saved(&mut self, path: &Path, revision: u64) {
        self.scenes.saved = revision;
        self.preferences.remember(path);
        self.preferences.last_folder = path.parent().map(ToOwned::to_owned);
    }

    /// Writes a file of the scene on its own thread.
    pub(crate) fn export_scene(
        &mut self,
        path: PathBuf,
        work: impl FnOnce(&Path, &Task) -> Result<Option<Problem>, JobError> + Send + 'static,
    ) {
        let label = tr_format!("exporting {path}", path = file_name(&path));
        self.start_job(JobKind::Shown, label, move |task| {
            let remark = work(&path, task)?;
            Ok(Finished::Exported { path, remark })
        });
    }
}

/// The browser for an export of a painting with this title.
pub(super) fn export_options(kind: ExportKind, title: &str) -> BrowserOptions {
    let ending = kind.ending();
    let filters: &[Filter] = match kind {
        ExportKind::Picture(PictureFormat::Png8 | PictureFormat::Png16) => &[PICTURES, Filter::ALL],
        ExportKind::Picture(PictureFormat::Tiff16) | ExportKind::Layers => &[Filter::ALL],
        ExportKind::PigmentMaps => &[Filter::ALL],
        _ => &[PAINTINGS, Filter::ALL],
    };
    // A linear EXR must not get the name of the painting's own file.
    let linear = kind == ExportKind::Picture(PictureFormat::LinearExr);
    let mark = if linear { ".linear" } else { "" };
    let name = format!("{title}{mark}.{ending}");
    let title = tr("Export");
    let ending = Some(ending);
    let others = &[][..];
    BrowserOptions { title, saving: true, filters, ending, others, name }
}

const SCENES: Filter = Filter {
    label: english("Models, photographs and scripts"),
    endings: &pictures_and::<11>(&["glb", "gltf", "obj", "ply", "toml"]),
};
const LIBRARIES: Filter = Filter { label: english("Pigment libraries"), endings: &["json"] };
const SCENES_SCRIPTS: Filter = Filter { label: english("Scripts"), endings: &["toml"] };
const SCENES_PICTURES: Filter = Filter { label: english("Pictures"), endings: &["png", "exr"] };
const SCENES_PAINTINGS: Filter = Filter { label: english("Paintings"), endings: &["exr"] };
const ANIMATIONS: Filter =
    Filter { label: english("Animations"), endings: &["gif", "png", "apng"] };

/// Longest time between a change and its autosave. A script is small, so this can be short.
const INTERVAL: Duration = Duration::from_secs(2);

/// The title without characters that a file name cannot contain.
fn file_stem(title: &str) -> String {
    title.chars().map(|letter: char| if letter.is_alphanumeric() { letter } else { '-' }).collect()
}
