//! What the browser shows, and what keys and clicks do to it.

use std::path::{Path, PathBuf};

use super::listing::{Entry, Filter, entries, home_folder};
use crate::files::job::{Job, Stopped};
use session::FileFailure;

/// What the browser is for.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Wanted {
    /// The head of the dialog, and its last button.
    pub title: &'static str,
    /// Whether a file is made, not read.
    pub saves: bool,
    /// The kinds of files to choose among; the first holds at first.
    pub filters: &'static [Filter],
    /// How the name of a file that is made ends; none for no ending.
    pub ending: Option<&'static str>,
    /// The name at first.
    pub name: String,
}

/// A dialog that asks for a file.
#[derive(Debug)]
pub struct Browser {
    /// What it is for.
    pub wanted: Wanted,
    /// Where it looks.
    pub(super) folder: PathBuf,
    /// The folder as it is being typed.
    pub(super) typed_folder: String,
    pub(super) recent: Vec<PathBuf>,
    entries: Vec<Entry>,
    reading: Option<Job<Vec<Entry>>>,
    /// What went wrong last, said in the dialog.
    pub(super) failure: Option<FileFailure>,
    /// The filter in force, by number.
    pub(super) filter: usize,
    /// The name of the entry that the keys are at.
    pub(super) selected: Option<String>,
    /// The name of a file to be made.
    pub(super) name: String,
    /// Whether the field of the name has had the keyboard: it begins with it.
    pub(super) named: bool,
    /// The file that would be written over, while the painter is asked.
    pub(super) replaces: Option<PathBuf>,
    /// Whether the selection moved, and must be scrolled to.
    pub(super) moved: bool,
    wake: eframe::egui::Context,
}

/// What the painter said.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Answer {
    /// This file.
    File(PathBuf),
    /// None.
    Cancelled,
}

impl Browser {
    /// A browser that looks into `folder`, or the user's own where there is none.
    #[must_use]
    pub fn new(
        wanted: Wanted,
        folder: Option<&Path>,
        recent: &[PathBuf],
        wake: &eframe::egui::Context,
    ) -> Self {
        let folder = folder.filter(|folder| folder.is_dir()).map(Path::to_owned);
        let filter = wanted.filters.first().copied().unwrap_or(Filter::ALL);
        let passes = |path: &&PathBuf| path.to_str().is_some_and(|path| filter.passes(path));
        let mut browser = Self {
            name: wanted.name.clone(),
            wanted,
            folder: PathBuf::new(),
            typed_folder: String::new(),
            recent: recent.iter().filter(passes).cloned().collect(),
            entries: Vec::new(),
            reading: None,
            failure: None,
            filter: 0,
            selected: None,
            named: false,
            replaces: None,
            moved: false,
            wake: wake.clone(),
        };
        browser.go(folder.unwrap_or_else(home_folder));
        browser
    }

    /// Where it looks.
    #[must_use]
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// Looks into another folder.
    pub fn go(&mut self, folder: PathBuf) {
        self.typed_folder = folder.display().to_string();
        self.selected = None;
        self.replaces = None;
        self.failure = None;
        self.entries.clear();
        let (wake, read) = (self.wake.clone(), folder.clone());
        let wake = move || wake.request_repaint();
        self.reading =
            Some(Job::start("reading the folder", wake, move |progress| entries(&read, progress)));
        self.folder = folder;
    }

    /// Takes up what was read since; whether reading goes on.
    pub fn update(&mut self) -> bool {
        if let Some(result) = self.reading.as_mut().and_then(Job::poll) {
            self.reading = None;
            match result {
                Ok(entries) => self.entries = entries,
                Err(Stopped::Failed(failure)) => self.failure = Some(failure),
                Err(Stopped::Cancelled) => {}
            }
        }
        self.reading.is_some()
    }

    /// The entries that the filter lets pass.
    #[must_use]
    pub fn shown(&self) -> Vec<&Entry> {
        let filter = self.wanted.filters.get(self.filter).copied().unwrap_or(Filter::ALL);
        self.entries.iter().filter(|entry| entry.folder || filter.passes(&entry.name)).collect()
    }

    /// Goes to the folder above, and stays at the one it came from.
    pub fn up(&mut self) {
        let Some(above) = self.folder.parent().map(Path::to_owned) else { return };
        let from = self.folder.file_name().map(|name| name.to_string_lossy().into_owned());
        self.go(above);
        self.selected = from;
        self.moved = true;
    }

    /// Moves the selection by `steps` entries.
    pub fn step(&mut self, steps: isize) {
        let shown = self.shown();
        let Some(last) = shown.len().checked_sub(1) else { return };
        let at = shown.iter().position(|entry| Some(&entry.name) == self.selected.as_ref());
        let next = match at {
            Some(at) => at.saturating_add_signed(steps).min(last),
            None => {
                if steps < 0 {
                    last
                } else {
                    0
                }
            }
        };
        let next = shown[next].clone();
        self.select(&next);
        self.moved = true;
    }

    /// Selects an entry; a file gives its name to one that is to be made.
    pub fn select(&mut self, entry: &Entry) {
        self.selected = Some(entry.name.clone());
        self.replaces = None;
        if self.wanted.saves && !entry.folder {
            self.name.clone_from(&entry.name);
        }
    }

    /// Goes into the selected folder, or takes the file.
    pub fn enter(&mut self) -> Option<Answer> {
        let shown = self.shown();
        let selected = shown.into_iter().find(|entry| Some(&entry.name) == self.selected.as_ref());
        match selected {
            Some(entry) if entry.folder => {
                let folder = self.folder.join(&entry.name);
                self.go(folder);
                None
            }
            _ if self.wanted.saves => self.save(),
            Some(entry) => Some(Answer::File(self.folder.join(&entry.name))),
            None => None,
        }
    }

    /// Goes where was typed: into a folder, or to a file that is there.
    pub fn enter_typed(&mut self) -> Option<Answer> {
        let typed = self.folder.join(self.typed_folder.trim());
        if typed.is_file() && !self.wanted.saves {
            return Some(Answer::File(typed));
        }
        self.go(typed);
        None
    }

    /// Takes the file of the name, after a question if it is there.
    pub fn save(&mut self) -> Option<Answer> {
        let name = self.name.trim();
        if name.is_empty() || name.contains(['/', '\\', '\0']) || [".", ".."].contains(&name) {
            let what = format!("`{name}` is no name of a file");
            self.failure = Some(FileFailure::new(what, "give a name without / and \\"));
            return None;
        }
        let path = with_ending(self.folder.join(name), self.wanted.ending);
        if path.exists() && self.replaces.as_ref() != Some(&path) {
            self.replaces = Some(path);
            return None;
        }
        Some(Answer::File(path))
    }

    /// Makes a folder of the name that is typed, and goes into it.
    pub fn make_folder(&mut self) {
        let name = self.name.trim();
        let name = name.split('.').next().unwrap_or(name);
        let folder = self.folder.join(if name.is_empty() { "New folder" } else { name });
        match std::fs::create_dir(&folder) {
            Ok(()) => self.go(folder),
            Err(error) => self.failure = Some(FileFailure::io(&folder, "made", &error)),
        }
    }
}

/// `path` with `ending`, unless it ends so.
fn with_ending(path: PathBuf, ending: Option<&str>) -> PathBuf {
    let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    match ending {
        Some(ending) if !name.to_lowercase().ends_with(&format!(".{ending}")) => {
            path.with_file_name(format!("{name}.{ending}"))
        }
        _ => path,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PAINTINGS: Filter = Filter { label: "Paintings", endings: &["exr"] };

    fn browser(saves: bool) -> (Browser, tempfile::TempDir) {
        let folder = tempfile::tempdir().unwrap();
        std::fs::create_dir(folder.path().join("sub")).unwrap();
        for name in ["a.exr", "b.exr", "notes.txt"] {
            std::fs::write(folder.path().join(name), "x").unwrap();
        }
        let wanted = Wanted {
            title: "Open",
            saves,
            filters: &[PAINTINGS, Filter::ALL],
            ending: Some("exr"),
            name: "study".to_owned(),
        };
        let mut browser = Browser::new(wanted, Some(folder.path()), &[], &Default::default());
        read(&mut browser);
        (browser, folder)
    }

    fn read(browser: &mut Browser) {
        while browser.update() {
            std::thread::yield_now();
        }
    }

    #[test]
    fn keys_walk_through_what_the_filter_shows() {
        let (mut browser, folder) = browser(false);
        let names = |browser: &Browser| {
            browser.shown().iter().map(|entry| entry.name.clone()).collect::<Vec<_>>()
        };
        assert_eq!(names(&browser), ["sub", "a.exr", "b.exr"]);
        assert_eq!(browser.enter(), None, "nothing is selected");
        for (steps, wanted) in [(1, "sub"), (1, "a.exr"), (9, "b.exr"), (-1, "a.exr"), (-9, "sub")]
        {
            browser.step(steps);
            assert_eq!(browser.selected.as_deref(), Some(wanted));
        }
        assert_eq!(browser.enter(), None);
        read(&mut browser);
        assert_eq!(browser.folder(), folder.path().join("sub"));
        browser.step(1);
        assert_eq!(browser.selected, None, "it is empty");
        browser.up();
        read(&mut browser);
        assert_eq!(browser.selected.as_deref(), Some("sub"), "where it came from");
        browser.filter = 1;
        browser.step(9);
        assert_eq!(browser.enter(), Some(Answer::File(folder.path().join("notes.txt"))));
    }

    #[test]
    fn a_file_that_is_there_is_replaced_after_a_question_only() {
        let (mut browser, folder) = browser(true);
        assert_eq!(browser.save(), Some(Answer::File(folder.path().join("study.exr"))));
        browser.name = "a".to_owned();
        assert_eq!(browser.save(), None);
        assert_eq!(browser.replaces, Some(folder.path().join("a.exr")));
        browser.step(-1);
        assert_eq!((browser.name.as_str(), &browser.replaces), ("b.exr", &None));
        assert_eq!(browser.save(), None, "another file, another question");
        assert_eq!(browser.save(), Some(Answer::File(folder.path().join("b.exr"))));
    }

    #[test]
    fn a_name_that_leads_elsewhere_is_refused() {
        let (mut browser, _folder) = browser(true);
        for name in ["", "..", "a/b", "  "] {
            browser.name = name.to_owned();
            browser.failure = None;
            assert_eq!(browser.save(), None, "{name:?}");
            assert!(browser.failure.is_some(), "{name:?}");
        }
    }

    #[test]
    fn what_is_typed_is_a_folder_or_a_file() {
        let (mut browser, folder) = browser(false);
        browser.typed_folder = "sub".to_owned();
        assert_eq!(browser.enter_typed(), None);
        assert_eq!(browser.folder(), folder.path().join("sub"));
        browser.typed_folder = folder.path().join("a.exr").display().to_string();
        assert_eq!(browser.enter_typed(), Some(Answer::File(folder.path().join("a.exr"))));
        browser.go(folder.path().join("gone"));
        read(&mut browser);
        assert!(browser.failure.is_some(), "it is not there");
    }

    #[test]
    fn a_folder_is_made_and_gone_into() {
        let (mut browser, folder) = browser(true);
        browser.make_folder();
        assert_eq!(browser.folder(), folder.path().join("study"));
        assert!(browser.folder().is_dir(), "it was not made");
    }
}
