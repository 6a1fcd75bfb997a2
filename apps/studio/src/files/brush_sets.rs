//! Sets of own brushes in the home folder: reading, writing, importing and exporting.

use std::path::{Path, PathBuf};

use documents::file::disk;
use documents::file::write_whole;

use super::browser::{BrowserOptions, Filter};
use super::job::JobError;
use super::notice::Notice;
use super::open_dialog::FilePurpose;
use super::own_brushes::ReadBrushes;
use super::problem::Problem;
use super::state::Files;
use super::work::{Finished, JobKind, file_name};
use crate::language::{english, tr, tr_format};
use session::brushes::folder::{StoredSet, free_path, read_set, read_sets, read_text, write_set};
use session::brushes::{BrushSet, MM_PER_PIXEL, brush_of_myb};

const SETS: Filter = Filter { label: english("Own brushes"), endings: &["json"] };
const IMPORTED: Filter =
    Filter { label: english("Own brushes and MyPaint's"), endings: &["json", "myb"] };

impl Files {
    /// Adds a set and shows it. A name that another set has is numbered.
    pub fn add_brush_set(&mut self, set: BrushSet) {
        let taken = |name: &str| self.brush_sets.sets.iter().any(|own| own.set.name() == name);
        let mut name = set.name().to_owned();
        let mut number = 2;
        while taken(&name) {
            name = format!("{} {number}", set.name());
            number += 1;
        }
        let set = set.named(&name);
        let path = free_path(&self.home.brushes(), set.name(), &self.brush_sets.sets);
        self.brush_sets.sets.push(StoredSet { path, set });
        self.brush_sets.shown = self.brush_sets.sets.len() - 1;
    }

    /// The set that is shown, to change it; a new one if there is none.
    pub fn brush_set(&mut self) -> &mut BrushSet {
        if self.brush_sets.sets.is_empty() {
            self.add_brush_set(BrushSet::new(tr("My brushes")));
        }
        let shown = self.brush_sets.shown.min(self.brush_sets.sets.len() - 1);
        &mut self.brush_sets.sets[shown].set
    }

    /// Starts reading the sets of the home folder, if that was not done.
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

    /// Starts writing the sets that changed, if no background job runs.
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

    /// Writes the sets that changed, when the session ends.
    pub(super) fn finish_brush_sets(&mut self) {
        let own = &self.brush_sets;
        if own.is_read && own.sets != own.written {
            let _ = write_sets(&own.written, &own.sets);
        }
    }

    /// Asks for a file of brushes.
    pub(super) fn ask_for_brushes(&mut self) {
        const KINDS: [Filter; 3] = [IMPORTED, SETS, Filter::ALL];
        self.browse(BrowserOptions::open(tr("Import brushes"), &KINDS), FilePurpose::ImportBrushes);
    }

    /// Asks where to export the set that is shown.
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

    /// Starts reading a file of brushes.
    pub(super) fn import_brushes(&mut self, path: PathBuf) {
        let label = tr_format!("reading {path}", path = file_name(&path));
        self.start_job(JobKind::Shown, label, move |_| {
            let brushes = read_brushes(&path)?;
            Ok(Finished::BrushesRead { path, brushes })
        });
    }

    /// Takes the brushes of a file over: a set beside the others, a single one into the set shown.
    pub(super) fn brushes_read(&mut self, path: &Path, brushes: ReadBrushes) {
        self.preferences.last_folder = path.parent().map(Path::to_owned);
        let told = match brushes {
            ReadBrushes::Set(set) => {
                let count = match set.presets().len() {
                    1 => tr("1 brush").to_owned(),
                    count => tr_format!("{count} brushes", count),
                };
                let told = tr_format!("imported {name}, {count}", name = set.name(), count);
                self.add_brush_set(set);
                self.brush_sets.imported = None;
                told
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
        self.notices.push(Notice::done(&told));
    }

    /// Starts writing a set to a file beside the home folder.
    pub(super) fn export_brushes(&mut self, set: BrushSet, path: PathBuf) {
        let label = tr_format!("exporting {path}", path = file_name(&path));
        self.start_job(JobKind::Shown, label, move |_| {
            write_whole(&path, set.to_json().as_bytes()).map_err(Problem::from)?;
            Ok(Finished::Exported { path, remark: None })
        });
    }
}

/// Writes the sets that differ, and deletes the files of those that are gone.
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
