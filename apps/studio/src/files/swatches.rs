//! The kept mixtures: read at the start, written when they change, imported and exported.

use std::path::{Path, PathBuf};

use documents::file::disk;
use session::PaintingState;
use session::swatches::{SwatchBook, SwatchChange};
use spectra::swatch_file::SwatchFile;

use super::job::JobError;
use super::notice::Notice;
use super::problem::Problem;
use super::state::Files;
use super::swatch_format::{ReadSwatches, SwatchFormat, read_swatches};
use super::work::{Finished, JobKind, file_name};
use crate::language::{tr, tr_format};
use documents::file::write_whole;

impl Files {
    /// The kept mixtures.
    #[must_use]
    pub fn swatches(&self) -> &SwatchBook {
        &self.swatches.book
    }

    /// Removes and returns colours that were imported without recipes, if there are any.
    pub fn take_colors(&mut self) -> Option<SwatchFile> {
        self.swatches.colors.take()
    }

    /// Changes the list; its file follows by itself.
    pub(super) fn change_swatches(&mut self, change: SwatchChange) {
        if let SwatchChange::Keep(kept) = &change {
            let text = tr_format!("kept {name}", name = kept.name);
            self.notices.push(Notice::done(&text));
        }
        self.swatches.book.apply(change);
    }

    /// Reads the list once, and starts writing it if it changed and no background job runs.
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
        // Before the file was read, it must not be replaced.
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

    /// The list was read; mixtures kept in the meantime follow.
    pub(super) fn swatches_read(&mut self, book: SwatchBook, problem: Option<Problem>) {
        self.swatches.written = Some(book.clone());
        let kept = std::mem::replace(&mut self.swatches.book, book);
        self.swatches.book.apply(SwatchChange::Merge(kept));
        if let Some(problem) = problem {
            self.report(problem);
        }
    }

    /// Starts reading mixtures or colours from a file.
    pub(super) fn import_swatches(&mut self, path: PathBuf) {
        let label = tr_format!("reading {path}", path = file_name(&path));
        self.start_job(JobKind::Shown, label, move |_| {
            Ok(Finished::SwatchesImported(read_swatches(&path).map_err(JobError::from)?))
        });
    }

    /// A file of mixtures or colours was read.
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
}

fn write_own(path: &Path, book: &SwatchBook) -> Result<(), Problem> {
    if let Some(folder) = path.parent() {
        disk::create_dir_all(folder).map_err(|error| Problem::io(folder, "created", &error))?;
    }
    Ok(write_whole(path, book.to_json().as_bytes())?)
}

/// Reads the list of the home folder. No file is an empty list; a file that cannot be read is put
/// aside, so that it is not overwritten.
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

#[cfg(test)]
mod tests {
    use super::*;

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
}
