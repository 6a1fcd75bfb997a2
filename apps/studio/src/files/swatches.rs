//! Collections in the home folder: kept mixtures and sets of own brushes. We read them at the
//! start, write them when they change, and import and export them. This also begins new paintings,
//! e.g. the sample painting, a script that the worker plays.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use documents::Task;
use documents::file::{disk, write_whole};
use paint::document::Document;
use paint::strokes::StrokeScript;
use pigment::library::PigmentLibrary;
use session::brushes::folder::{StoredSet, free_path, read_set, read_sets, read_text, write_set};
use session::brushes::{BrushSet, MM_PER_PIXEL, brush_of_myb};
use session::swatches::{SwatchBook, SwatchChange};
use session::{Command, Origin, Pace, PaintingState, blank_canvas};
use spectra::swatch_file::SwatchFile;
use strokes::{Photograph, first_layer};

use super::asking::PICTURES;
use super::browser::{BrowserOptions, Filter};
use super::job::JobError;
use super::new_dialog::{CanvasPicture, NewDialog};
use super::problem::Problem;
use super::request::{ReadSwatches, SwatchFormat, read_swatches};
use super::state::{FilePurpose, Files, OpenDialog};
use super::work::{
    FileOrigin, Finished, JobKind, Notice, PendingAction, ReadBrushes, Replacement, file_name,
};
use crate::language::{english, tr, tr_format};

impl Files {
    /// The kept mixtures.
    #[must_use]
    pub fn swatches(&self) -> &SwatchBook {
        &self.swatches.book
    }

    /// Removes and returns colours that you imported without recipes, if there are any.
    pub fn take_colors(&mut self) -> Option<SwatchFile> {
        self.swatches.colors.take()
    }

    /// Changes the list. Its file is written later by itself.
    pub(super) fn change_swatches(&mut self, change: SwatchChange) {
        if let SwatchChange::Keep(kept) = &change {
            let text = tr_format!("kept {name}", name = kept.name);
            self.notices.push(Notice::done(&text));
        }
        self.swatches.book.apply(change);
    }

    /// Reads the list once. Starts writing it if it changed and no background job runs.
    pub(super) fn keep_swatches(&mut self) {
        if !std::mem::replace(&mut self.swatches.asked, true) {
            let path = self.home.swatches();
            self.start_job(
                JobKind::Background,
                tr("reading kept mixtures").to_owned(),
                move |_| {
                    let (book, problem) = read_own(&path);
                    Ok(Finished::SwatchesRead { book, problem })
                },
            );
        }
        let idle = self.jobs.iter().all(|job| job.kind != JobKind::Background);
        // We must not replace the file before we have read it.
        let changed = self.swatches.written.as_ref().is_some_and(|w| *w != self.swatches.book);
        if !changed || !idle {
            return;
        }
        self.swatches.written = Some(self.swatches.book.clone());
        let book = self.swatches.book.clone();
        let path = self.home.swatches();
        self.start_job(JobKind::Background, tr("writing kept mixtures").to_owned(), move |_| {
            write_own(&path, &book)?;
            Ok(Finished::Quietly)
        });
    }

    /// Call this with the list as read. Mixtures that you kept meanwhile are added at the end.
    pub(super) fn swatches_read(&mut self, book: SwatchBook, problem: Option<Problem>) {
        self.swatches.written = Some(book.clone());
        let kept = std::mem::replace(&mut self.swatches.book, book);
        self.swatches.book.apply(SwatchChange::Merge(kept));
        if let Some(problem) = problem {
            self.report(problem);
        }
    }

    pub(super) fn import_swatches(&mut self, path: PathBuf) {
        let label = tr_format!("reading {path}", path = file_name(&path));
        self.start_job(JobKind::Shown, label, move |_| {
            Ok(Finished::SwatchesImported(read_swatches(&path).map_err(JobError::from)?))
        });
    }

    /// Uses the mixtures or colours of a file.
    pub(super) fn swatches_imported(&mut self, read: ReadSwatches) {
        match read {
            ReadSwatches::Mixtures(book) => {
                let before = self.swatches.book.swatches.len();
                self.swatches.book.apply(SwatchChange::Merge(book));
                let added = self.swatches.book.swatches.len() - before;
                self.notices.push(Notice::done(&tr_format!("added {added} mixtures", added)));
            }
            ReadSwatches::Colors(colors) => {
                let text = tr_format!(
                    "{swatches} colours are in the panel Colour",
                    swatches = colors.swatches.len()
                );
                self.notices.push(Notice::done(&text));
                self.swatches.colors = Some(colors);
            }
        }
    }

    /// Starts writing all mixtures to a file, with their colours under the light of the painting.
    pub(super) fn export_swatches(&mut self, format: SwatchFormat, path: PathBuf) {
        let Some(PaintingState { library, light, .. }) = self.painting.as_deref() else { return };
        let library = library.clone();
        let light = light.clone();
        let book = self.swatches.book.clone();
        let label = tr_format!("writing {path}", path = file_name(&path));
        self.start_job(JobKind::Shown, label, move |_| {
            let weights =
                light.viewing.weights(library.grid).map_err(|error| Problem::from_error(&error))?;
            format.write(&path, &book, (&library, &weights))?;
            Ok(Finished::Exported { path, remark: None })
        });
    }

    /// Writes the list if it changed, when the window closes.
    pub(super) fn finish_swatches(&mut self) {
        let changed = self.swatches.written.as_ref().is_some_and(|w| *w != self.swatches.book);
        if changed {
            let _ = write_own(&self.home.swatches(), &self.swatches.book);
        }
    }

    /// Adds a set and shows it. If another set has this name, it gets a number.
    pub fn add_brush_set(&mut self, set: BrushSet) {
        let mut name = set.name().to_owned();
        let mut number = 2;
        while self.brush_sets.sets.iter().any(|own| own.set.name() == name) {
            name = format!("{} {number}", set.name());
            number += 1;
        }
        let set = set.named(&name);
        let path = free_path(&self.home.brushes(), set.name(), &self.brush_sets.sets);
        self.brush_sets.sets.push(StoredSet { path, set });
        self.brush_sets.shown = self.brush_sets.sets.len() - 1;
    }

    /// The shown set, so that you can change it. If there is none, this adds one.
    pub fn brush_set(&mut self) -> &mut BrushSet {
        if self.brush_sets.sets.is_empty() {
            self.add_brush_set(BrushSet::new(tr("My brushes")));
        }
        let shown = self.brush_sets.shown.min(self.brush_sets.sets.len() - 1);
        &mut self.brush_sets.sets[shown].set
    }

    /// Starts reading the sets of the home folder, unless this was done.
    pub(super) fn read_brush_sets_once(&mut self) {
        if std::mem::replace(&mut self.brush_sets.is_asked, true) {
            return;
        }
        let folder = self.home.brushes();
        self.start_job(JobKind::Background, tr("reading own brushes").to_owned(), move |_| {
            let (sets, failures) = read_sets(&folder);
            Ok(Finished::BrushSetsRead(sets, failures.into_iter().map(Problem::from).collect()))
        });
    }

    pub(super) fn brush_sets_read(&mut self, sets: Vec<StoredSet>, problems: Vec<Problem>) {
        self.brush_sets.written.clone_from(&sets);
        self.brush_sets.sets = sets;
        self.brush_sets.is_read = true;
        problems.into_iter().for_each(|problem| self.report(problem));
    }

    /// Starts writing the changed sets, if no background job runs.
    pub(super) fn write_changed_brush_sets(&mut self) {
        let idle = self.jobs.iter().all(|job| job.kind != JobKind::Background);
        let own = &mut self.brush_sets;
        if !own.is_read || own.sets == own.written || !idle {
            return;
        }
        let before = std::mem::replace(&mut own.written, own.sets.clone());
        let now = own.sets.clone();
        self.start_job(JobKind::Background, tr("writing own brushes").to_owned(), move |_| {
            write_sets(&before, &now)?;
            Ok(Finished::Quietly)
        });
    }

    /// Writes the changed sets when the session ends.
    pub(super) fn finish_brush_sets(&mut self) {
        let own = &self.brush_sets;
        if own.is_read && own.sets != own.written {
            let _ = write_sets(&own.written, &own.sets);
        }
    }

    pub(super) fn ask_for_brushes(&mut self) {
        const KINDS: [Filter; 3] = [IMPORTED, SETS, Filter::ALL];
        self.browse(BrowserOptions::open(tr("Import brushes"), &KINDS), FilePurpose::ImportBrushes);
    }

    pub(super) fn ask_where_to_export_brushes(&mut self) {
        let Some(set) = self.brush_sets.set().cloned() else { return };
        let options = BrowserOptions {
            title: tr("Export the set of brushes"),
            saving: true,
            filters: &[SETS, Filter::ALL],
            ending: Some("json"),
            others: &[],
            name: format!("{}.json", set.name()),
        };
        self.browse(options, FilePurpose::ExportBrushes(Box::new(set)));
    }

    pub(super) fn import_brushes(&mut self, path: PathBuf) {
        let label = tr_format!("reading {path}", path = file_name(&path));
        self.start_job(JobKind::Shown, label, move |_| {
            let brushes = read_brushes(&path)?;
            Ok(Finished::BrushesRead { path, brushes })
        });
    }

    /// Imports the brushes of a file. If it is a set, we add it to the other sets. If it is a
    /// single brush, we add it to the shown set.
    pub(super) fn brushes_read(&mut self, path: &Path, brushes: ReadBrushes) {
        self.preferences.last_folder = path.parent().map(Path::to_owned);
        let notice = match brushes {
            ReadBrushes::Set(set) => {
                let count = match set.presets().len() {
                    1 => tr("1 brush").to_owned(),
                    count => tr_format!("{count} brushes", count),
                };
                let notice = tr_format!("imported {name}, {count}", name = set.name(), count);
                self.add_brush_set(set);
                self.brush_sets.imported = None;
                notice
            }
            ReadBrushes::Myb(mut imported) => {
                let Some(name) = self.brush_set().add(imported.preset.clone()) else {
                    let hint = tr("import it into another set");
                    return self.report(Problem::new(tr("the set of brushes is full"), hint));
                };
                imported.preset.name.clone_from(&name);
                self.brush_sets.imported = Some(*imported);
                tr_format!("imported {name}", name)
            }
        };
        self.notices.push(Notice::done(&notice));
    }

    pub(super) fn export_brushes(&mut self, set: BrushSet, path: PathBuf) {
        let label = tr_format!("exporting {path}", path = file_name(&path));
        self.start_job(JobKind::Shown, label, move |_| {
            write_whole(&path, set.to_json().as_bytes()).map_err(Problem::from)?;
            Ok(Finished::Exported { path, remark: None })
        });
    }

    /// Opens the sample painting in place of the open one. If there are unsaved changes, this asks
    /// first.
    pub(super) fn open_sample(&mut self) {
        match script() {
            Ok(script) => {
                let script = Box::new(script);
                let library = Box::new(PigmentLibrary::van_gogh_oils());
                let commands = vec![Command::Replay { script, library, pace: Pace::Fast }];
                let origin = FileOrigin { sample: true, ..FileOrigin::default() };
                self.carry_out_safely(PendingAction::Replace(Replacement { commands, origin }));
            }
            Err(problem) => self.report(problem),
        }
    }

    /// Call this when the replay of a recording has ended. If it was the sample painting, its next
    /// state counts as saved.
    pub(super) fn sample_played(&mut self) {
        self.sample_settles = std::mem::take(&mut self.sample);
    }

    /// If the sample painting was just played, its present state counts as saved.
    pub(super) fn settle_sample(&mut self) {
        if std::mem::take(&mut self.sample_settles)
            && let Some(state) = self.painting.as_ref().filter(|state| !state.stroke_open)
        {
            self.saved_revision = Some(state.revision);
        }
    }

    /// Opens the dialog of a new painting. It starts with the last canvas.
    pub(super) fn ask_for_new(&mut self, state: &PaintingState) {
        let last = self.preferences.new_painting.last.clone();
        let dialog = NewDialog::new(state, last, &self.ctx);
        self.dialogs.push(OpenDialog::New(Box::new(dialog)));
    }

    /// Asks for a picture of the canvas. The dialog below stays open.
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

    /// Opens the painting that the dialog describes. It has the current palette and library if you
    /// chose so.
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
        self.start_job(JobKind::Shown, label, move |task| {
            let document = on_picture(&path, &script, &library, task)?;
            let bytes =
                paint::file::write(&document).map_err(|error| Problem::from_error(&error))?;
            Ok(Finished::Begun(Box::new(document), Arc::new(bytes)))
        });
    }
}

fn write_own(path: &Path, book: &SwatchBook) -> Result<(), Problem> {
    if let Some(folder) = path.parent() {
        disk::create_dir_all(folder).map_err(|error| Problem::io(folder, "created", &error))?;
    }
    Ok(write_whole(path, book.to_json().as_bytes())?)
}

/// Reads the list of the home folder. If there is no file, the list is empty. If the file cannot be
/// read, we rename it, so that it is not overwritten.
fn read_own(path: &Path) -> (SwatchBook, Option<Problem>) {
    if !disk::exists(path) {
        return (SwatchBook::default(), None);
    }
    match read_swatches(path) {
        Ok(ReadSwatches::Mixtures(book)) => (book, None),
        Ok(ReadSwatches::Colors(_)) => (SwatchBook::default(), None),
        Err(Problem { text, .. }) => {
            let aside = path.with_extension("broken.json");
            let hint = match disk::rename(path, &aside) {
                Ok(()) => {
                    tr_format!(
                        "a new list is begun; the file was renamed to {aside}",
                        aside = aside.display()
                    )
                }
                Err(error) => {
                    tr_format!("a new list is begun; the file cannot be renamed: {error}", error)
                }
            };
            (SwatchBook::default(), Some(Problem::new(text, hint)))
        }
    }
}

const SETS: Filter = Filter { label: english("Own brushes"), endings: &["json"] };
const IMPORTED: Filter =
    Filter { label: english("Own brushes and MyPaint's"), endings: &["json", "myb"] };

/// Writes the sets that differ, and deletes the files of removed ones.
fn write_sets(before: &[StoredSet], now: &[StoredSet]) -> Result<(), JobError> {
    for stored in now.iter().filter(|stored| !before.contains(stored)) {
        write_set(stored).map_err(Problem::from)?;
    }
    for gone in before.iter().filter(|old| !now.iter().any(|stored| stored.path == old.path)) {
        disk::remove_file(&gone.path)
            .map_err(|error| Problem::io(&gone.path, "deleted", &error))?;
    }
    Ok(())
}

fn read_brushes(path: &Path) -> Result<ReadBrushes, Problem> {
    if path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("myb")) {
        let text = read_text(path)?;
        let imported = brush_of_myb(&text, &path.display().to_string(), MM_PER_PIXEL);
        let imported = imported.map_err(|error| Problem::from_error(&error))?;
        return Ok(ReadBrushes::Myb(Box::new(imported)));
    }
    Ok(ReadBrushes::Set(read_set(path)?))
}

/// Two oranges and a lemon, in the Van Gogh oils.
const ORANGES: &[u8] = include_bytes!("sample/oranges.json");

fn script() -> Result<StrokeScript, Problem> {
    let read = StrokeScript::from_json(tr("the sample painting"), ORANGES);
    read.map_err(|error| Problem::from_error(&error))
}

/// The canvas of `script` with the picture in `path` as its first dry layer.
fn on_picture(
    path: &Path,
    script: &StrokeScript,
    library: &PigmentLibrary,
    task: &Task,
) -> Result<Document, JobError> {
    let photograph = Photograph::open(path).map_err(|error| Problem::from_error(&error))?;
    task.reach(0.1)?;
    let surfaces = script.surfaces(library, None);
    let (mut document, _) = surfaces.map_err(|error| Problem::from_error(&error))?;
    task.reach(0.3)?;
    let layer = first_layer(&photograph, &document).map_err(|error| Problem::from_error(&error))?;
    task.reach(0.9)?;
    document.push_dry(document.slots, layer);
    Ok(document)
}

#[cfg(test)]
mod tests {
    use super::*;
    use paint::strokes::Action;

    #[test]
    fn a_list_that_cannot_be_read_is_put_aside() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("swatches.json");
        assert_eq!(read_own(&path), (SwatchBook::default(), None));
        write_own(&path, &SwatchBook::default()).unwrap();
        assert_eq!(read_own(&path), (SwatchBook::default(), None));
        std::fs::write(&path, "[").unwrap();
        let (book, problem) = read_own(&path);
        let problem = problem.unwrap();
        assert!(book.swatches.is_empty() && problem.text.contains("swatches.json"), "{problem:?}");
        assert!(!path.exists() && folder.path().join("swatches.broken.json").exists());
    }

    #[test]
    fn the_sample_painting_has_dry_layers_glazes_and_wet_paint() {
        let script = script().unwrap();
        script.resolve(&PigmentLibrary::van_gogh_oils()).unwrap();
        let layers: Vec<&[Action]> =
            script.actions.split(|action| matches!(action, Action::Dry { .. })).collect();
        assert!(layers.len() >= 4, "{} layers", layers.len());
        assert!(
            layers.iter().all(|layer| layer
                .iter()
                .filter(|action| matches!(action, Action::Stroke(_)))
                .count()
                > 2),
            "a layer has no strokes"
        );
        assert!(
            script
                .actions
                .iter()
                .any(|action| matches!(action, Action::Load(load) if load.vehicle > 0.9)),
            "there is no glaze"
        );
        assert!(ORANGES.len() < 60_000, "{} bytes", ORANGES.len());
    }
}
