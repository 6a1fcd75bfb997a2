//! State of the file browser: what keys and clicks change in it, and which places it offers.

use std::path::{Path, PathBuf};

#[cfg(not(target_arch = "wasm32"))]
use directories::UserDirs;
use documents::file::disk;

use super::listing::{Entry, Filter, arranged, entries};
use crate::files::job::{Job, JobError};
use crate::files::preferences::BrowserLook;
use crate::files::problem::Problem;
use crate::language::{english, tr};

#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct BrowserOptions {
    pub(crate) title: &'static str,
    /// Whether the dialog asks for a file to write, not one to read.
    pub(crate) saving: bool,
    /// Filters to choose from. The first is active when the dialog opens.
    pub(crate) filters: &'static [Filter],
    /// Extension added to the name of a new file, if any.
    pub(crate) ending: Option<&'static str>,
    /// If a new file has one of these extensions, we do not add our own.
    pub(crate) others: &'static [&'static str],
    /// Suggested name of a new file.
    pub(crate) name: String,
}

impl BrowserOptions {
    /// Options of a dialog that opens an existing file.
    pub(crate) fn open(title: &'static str, filters: &'static [Filter]) -> Self {
        Self { title, saving: false, filters, ending: None, others: &[], name: String::new() }
    }
}

/// A dialog that asks for a file.
#[derive(Debug)]
pub(crate) struct Browser {
    pub(crate) options: BrowserOptions,
    pub(super) folder: PathBuf,
    pub(super) typed_folder: String,
    pub(super) recent: Vec<PathBuf>,
    /// Folders that you open with one click, once we have found them.
    pub(super) places: Vec<PlaceFolder>,
    finding_places: Option<Job<Vec<PlaceFolder>>>,
    /// Form and order of the files.
    pub(crate) look: BrowserLook,
    /// Only names with these letters are shown.
    pub(super) typed_filter: String,
    /// Number of entries side by side.
    pub(super) columns: usize,
    entries: Vec<Entry>,
    reading: Option<Job<Vec<Entry>>>,
    /// The last problem, shown in the dialog.
    pub(super) problem: Option<Problem>,
    pub(super) filter: usize,
    pub(super) selected: Option<String>,
    pub(super) name: String,
    /// Whether we have focused the name field, which we do once.
    pub(super) name_focused: bool,
    /// The existing file to replace, while we ask.
    pub(super) replacing: Option<PathBuf>,
    /// Whether the list must scroll to the selection.
    pub(super) scroll_to_selected: bool,
    wake: eframe::egui::Context,
}

#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Answer {
    /// The chosen file.
    File(PathBuf),
    /// You closed the dialog without a file.
    Cancelled,
}

impl Browser {
    /// A browser for `folder`, or for the home folder if `folder` does not exist.
    #[must_use]
    pub(crate) fn new(
        options: BrowserOptions,
        folder: Option<&Path>,
        recent: &[PathBuf],
        look: BrowserLook,
        wake: &eframe::egui::Context,
    ) -> Self {
        let lately = folders_of(folder, recent);
        let woken = wake.clone();
        let finding_places =
            Job::start("places", move || woken.request_repaint(), move |_| Ok(places(&lately)));
        let folder = folder.filter(|folder| disk::is_dir(folder)).map(Path::to_owned);
        let filter = options.filters.first().copied().unwrap_or(Filter::ALL);
        let mut browser = Self {
            name: options.name.clone(),
            options,
            folder: PathBuf::new(),
            typed_folder: String::new(),
            recent: recent
                .iter()
                .filter(|path: &&PathBuf| path.to_str().is_some_and(|path| filter.passes(path)))
                .cloned()
                .collect(),
            places: Vec::new(),
            finding_places: Some(finding_places),
            look,
            typed_filter: String::new(),
            columns: 1,
            entries: Vec::new(),
            reading: None,
            problem: None,
            filter: 0,
            selected: None,
            name_focused: false,
            replacing: None,
            scroll_to_selected: false,
            wake: wake.clone(),
        };
        browser.go(folder.unwrap_or_else(home_folder));
        browser
    }

    #[must_use]
    pub(crate) fn folder(&self) -> &Path {
        &self.folder
    }

    /// Lists another folder.
    pub(crate) fn go(&mut self, folder: PathBuf) {
        self.typed_folder = folder.display().to_string();
        self.selected = None;
        self.replacing = None;
        self.problem = None;
        self.typed_filter.clear();
        self.entries.clear();
        let wake = self.wake.clone();
        let read = folder.clone();
        self.reading = Some(Job::start(
            tr("reading the folder"),
            move || wake.request_repaint(),
            move |task| entries(&read, task),
        ));
        self.folder = folder;
    }

    /// Applies the result of listing. Returns whether this is still running.
    pub(crate) fn update(&mut self) -> bool {
        if let Some(found) = self.finding_places.as_mut().and_then(Job::poll) {
            self.finding_places = None;
            self.places = found.unwrap_or_default();
        }
        if let Some(result) = self.reading.as_mut().and_then(Job::poll) {
            self.reading = None;
            match result {
                Ok(entries) => self.entries = entries,
                Err(JobError::Failed(problem)) => self.problem = Some(problem),
                Err(JobError::Cancelled) => {}
            }
        }
        self.reading.is_some()
    }

    /// The entries that the filters accept, in the chosen order.
    #[must_use]
    pub(crate) fn shown_entries(&self) -> Vec<&Entry> {
        let filter = self.options.filters.get(self.filter).copied().unwrap_or(Filter::ALL);
        arranged(&self.entries, filter, &self.typed_filter, self.look.order)
    }

    /// Lists the folder above, with the previous one selected.
    pub(crate) fn up(&mut self) {
        let Some(above) = self.folder.parent().map(Path::to_owned) else { return };
        let from = self.folder.file_name().map(|name| name.to_string_lossy().into_owned());
        self.go(above);
        self.selected = from;
        self.scroll_to_selected = true;
    }

    /// Moves the selection by `steps` entries.
    pub(crate) fn step(&mut self, steps: isize) {
        let shown = self.shown_entries();
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
        self.scroll_to_selected = true;
    }

    /// Selects an entry. In a save dialog, the new file gets the name of a selected file.
    pub(crate) fn select(&mut self, entry: &Entry) {
        self.selected = Some(entry.name.clone());
        self.replacing = None;
        if self.options.saving && !entry.folder {
            self.name.clone_from(&entry.name);
        }
    }

    /// Opens the selected folder, or chooses the selected file.
    pub(crate) fn enter(&mut self) -> Option<Answer> {
        let shown = self.shown_entries();
        let selected = shown.into_iter().find(|entry| Some(&entry.name) == self.selected.as_ref());
        match selected {
            Some(entry) if entry.folder => {
                let folder = self.folder.join(&entry.name);
                self.go(folder);
                None
            }
            _ if self.options.saving => self.save(),
            Some(entry) => Some(Answer::File(self.folder.join(&entry.name))),
            None => None,
        }
    }

    /// Opens the typed folder, or chooses the file.
    pub(crate) fn enter_typed(&mut self) -> Option<Answer> {
        let typed = self.folder.join(self.typed_folder.trim());
        if disk::is_file(&typed) && !self.options.saving {
            return Some(Answer::File(typed));
        }
        self.go(typed);
        None
    }

    /// Chooses the file with the typed name. If it exists, this asks first.
    pub(crate) fn save(&mut self) -> Option<Answer> {
        let name = self.name.trim();
        if name.is_empty() || name.contains(['/', '\\', '\0']) || [".", ".."].contains(&name) {
            let text = format!("`{name}` is not a valid file name");
            self.problem = Some(Problem::new(text, "choose a name without / and \\"));
            return None;
        }
        let path = with_ending(self.folder.join(name), self.options.ending, self.options.others);
        if disk::exists(&path) && self.replacing.as_ref() != Some(&path) {
            self.replacing = Some(path);
            return None;
        }
        Some(Answer::File(path))
    }

    pub(crate) fn make_folder(&mut self) {
        let name = self.name.trim();
        let name = name.split('.').next().unwrap_or(name);
        let folder = self.folder.join(if name.is_empty() { tr("New folder") } else { name });
        match disk::create_dir(&folder) {
            Ok(()) => self.go(folder),
            Err(error) => self.problem = Some(Problem::io(&folder, "created", &error)),
        }
    }
}

/// Appends the extension `ending` to `path`, unless it has this or one of the `others`.
fn with_ending(path: PathBuf, ending: Option<&str>, others: &[&str]) -> PathBuf {
    let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    let small = name.to_lowercase();
    let has = |ending: &str| small.ends_with(&format!(".{ending}"));
    match ending {
        Some(ending) if !has(ending) && !others.iter().any(|other| has(other)) => {
            path.with_file_name(format!("{name}.{ending}"))
        }
        _ => path,
    }
}

const MOST_FOLDERS: usize = 6;

/// Kinds of places. Each has a heading.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum PlaceKind {
    Own,
    /// Folders in which you chose files lately.
    Lately,
    Drive,
}

#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct PlaceFolder {
    pub(super) kind: PlaceKind,
    pub(super) name: String,
    pub(super) path: PathBuf,
}

/// The user's home folder, or the root folder if unknown.
#[must_use]
#[cfg(not(target_arch = "wasm32"))]
pub(super) fn home_folder() -> PathBuf {
    UserDirs::new().map_or_else(|| PathBuf::from("/"), |dirs| dirs.home_dir().to_owned())
}

/// The folder of files that you opened or saved in this page.
#[must_use]
#[cfg(target_arch = "wasm32")]
pub(super) fn home_folder() -> PathBuf {
    PathBuf::from("/files")
}

/// The folders for desktop, documents, pictures and downloads.
fn own_folders() -> [Option<PathBuf>; 4] {
    #[cfg(not(target_arch = "wasm32"))]
    if let Some(dirs) = UserDirs::new() {
        return [dirs.desktop_dir(), dirs.document_dir(), dirs.picture_dir(), dirs.download_dir()]
            .map(|path| path.map(Path::to_owned));
    }
    [const { None }; 4]
}

/// The places that exist now. `lately` lists the folders of the last file and of recent ones, the
/// latest first. This reads the disk.
#[must_use]
pub(super) fn places(lately: &[PathBuf]) -> Vec<PlaceFolder> {
    let mut found = Vec::new();
    let home = home_folder();
    add(&mut found, PlaceKind::Own, english("Home"), &home);
    for (name, path) in
        [english("Desktop"), english("Documents"), english("Pictures"), english("Downloads")]
            .into_iter()
            .zip(own_folders())
    {
        if let Some(path) = path {
            add(&mut found, PlaceKind::Own, name, &path);
        }
    }
    let mut left = MOST_FOLDERS;
    for path in lately {
        let name = path.file_name().map_or_else(|| path.to_string_lossy(), |n| n.to_string_lossy());
        if left > 0 && add(&mut found, PlaceKind::Lately, &name, path) {
            left -= 1;
        }
    }
    for path in drives(&home) {
        let name = path.file_name().map_or_else(|| path.to_string_lossy(), |n| n.to_string_lossy());
        add(&mut found, PlaceKind::Drive, &name, &path);
    }
    found
}

/// Adds a folder if it exists and is not listed yet. Returns whether this added it.
fn add(found: &mut Vec<PlaceFolder>, kind: PlaceKind, name: &str, path: &Path) -> bool {
    if !disk::is_dir(path) || found.iter().any(|place| place.path == path) {
        return false;
    }
    found.push(PlaceFolder { kind, name: name.to_owned(), path: path.to_owned() });
    true
}

/// Drives as the system shows them: letters, or the folders that they are mounted in.
fn drives(home: &Path) -> Vec<PathBuf> {
    if cfg!(target_arch = "wasm32") {
        return Vec::new();
    }
    if cfg!(windows) {
        return ('A'..='Z').map(|letter| PathBuf::from(format!("{letter}:\\"))).collect();
    }
    let user = home.file_name().unwrap_or_default();
    let bases = [
        PathBuf::from("/Volumes"),
        Path::new("/media").join(user),
        Path::new("/run/media").join(user),
    ];
    let mut drives = vec![PathBuf::from("/")];
    for base in bases {
        let Ok(entries) = disk::read_dir(base) else { continue };
        let mut mounted: Vec<_> = entries.filter_map(|entry| Some(entry.ok()?.path())).collect();
        mounted.sort();
        drives.extend(mounted);
    }
    drives
}

/// The folders of `last` and of the recent files, without duplicates, the latest first.
#[must_use]
pub(super) fn folders_of(last: Option<&Path>, recent: &[PathBuf]) -> Vec<PathBuf> {
    let mut folders: Vec<PathBuf> = Vec::new();
    for folder in last.into_iter().chain(recent.iter().filter_map(|path| path.parent())) {
        if !folders.iter().any(|other| other == folder) {
            folders.push(folder.to_owned());
        }
    }
    folders
}

#[cfg(test)]
mod tests {
    use super::*;

    const PAINTINGS: Filter = Filter { label: "Paintings", endings: &["exr"] };

    fn browser(saving: bool) -> (Browser, tempfile::TempDir) {
        let folder = tempfile::tempdir().unwrap();
        std::fs::create_dir(folder.path().join("sub")).unwrap();
        for name in ["a.exr", "b.exr", "notes.txt"] {
            std::fs::write(folder.path().join(name), "x").unwrap();
        }
        let options = BrowserOptions {
            title: "Open",
            saving,
            filters: &[PAINTINGS, Filter::ALL],
            ending: Some("exr"),
            others: &[],
            name: "study".to_owned(),
        };
        let mut browser = Browser::new(
            options,
            Some(folder.path()),
            &[],
            BrowserLook::default(),
            &Default::default(),
        );
        read(&mut browser);
        (browser, folder)
    }

    fn read(browser: &mut Browser) {
        while browser.update() {
            std::thread::yield_now();
        }
    }

    #[test]
    fn keys_move_through_the_filtered_entries() {
        let (mut browser, folder) = browser(false);
        assert_eq!(
            browser.shown_entries().iter().map(|entry| entry.name.clone()).collect::<Vec<_>>(),
            ["sub", "a.exr", "b.exr"]
        );
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
    fn an_existing_file_is_replaced_only_after_asking() {
        let (mut browser, folder) = browser(true);
        assert_eq!(browser.save(), Some(Answer::File(folder.path().join("study.exr"))));
        browser.name = "a".to_owned();
        assert_eq!(browser.save(), None);
        assert_eq!(browser.replacing, Some(folder.path().join("a.exr")));
        browser.step(-1);
        assert_eq!((browser.name.as_str(), &browser.replacing), ("b.exr", &None));
        assert_eq!(browser.save(), None, "another file, another question");
        assert_eq!(browser.save(), Some(Answer::File(folder.path().join("b.exr"))));
    }

    #[test]
    fn a_name_of_another_folder_is_rejected() {
        let (mut browser, _folder) = browser(true);
        for name in ["", "..", "a/b", "  "] {
            browser.name = name.to_owned();
            browser.problem = None;
            assert_eq!(browser.save(), None, "{name:?}");
            assert!(browser.problem.is_some(), "{name:?}");
        }
    }

    #[test]
    fn a_name_keeps_an_extension_that_the_file_may_have() {
        let (mut browser, folder) = browser(true);
        browser.options.others = &["exr", "apng"];
        for (name, wanted) in [
            ("b2", "b2.exr"),
            ("b2.EXR", "b2.EXR"),
            ("b2.apng", "b2.apng"),
            ("b2.txt", "b2.txt.exr"),
        ] {
            browser.name = name.to_owned();
            assert_eq!(browser.save(), Some(Answer::File(folder.path().join(wanted))));
        }
    }

    #[test]
    fn a_typed_path_is_a_folder_or_a_file() {
        let (mut browser, folder) = browser(false);
        browser.typed_folder = "sub".to_owned();
        assert_eq!(browser.enter_typed(), None);
        assert_eq!(browser.folder(), folder.path().join("sub"));
        browser.typed_folder = folder.path().join("a.exr").display().to_string();
        assert_eq!(browser.enter_typed(), Some(Answer::File(folder.path().join("a.exr"))));
        browser.go(folder.path().join("gone"));
        read(&mut browser);
        assert!(browser.problem.is_some(), "it is not there");
    }

    #[test]
    fn a_new_folder_is_created_and_listed() {
        let (mut browser, folder) = browser(true);
        browser.make_folder();
        assert_eq!(browser.folder(), folder.path().join("study"));
        assert!(browser.folder().is_dir(), "it was not made");
    }

    #[test]
    fn places_that_exist_are_listed_once_in_their_order() {
        let folder = tempfile::tempdir().unwrap();
        let studies = folder.path().join("studies");
        std::fs::create_dir(&studies).unwrap();
        let lately = folders_of(
            Some(&studies),
            &[folder.path().join("a.exr"), studies.join("b.exr"), PathBuf::from("/gone/c.exr")],
        );
        assert_eq!(lately[..2], [studies.clone(), folder.path().to_owned()]);
        let found = places(&lately);
        assert_eq!((found[0].name.as_str(), &found[0].path), ("Home", &home_folder()));
        let late: Vec<_> = found.iter().filter(|p| p.kind == PlaceKind::Lately).collect();
        assert_eq!(late.len(), 2, "the folder that is gone is left out: {late:?}");
        assert_eq!((late[0].name.as_str(), &late[0].path), ("studies", &studies));
        let root = found.iter().any(|p| p.kind == PlaceKind::Drive && p.path == Path::new("/"));
        assert!(root || cfg!(windows) || home_folder() == Path::new("/"), "{found:?}");
    }
}
