//! Saves the work every few seconds, so that you lose only the seconds since the last autosave when
//! the program is killed.
//!
//! A generation is the set of files that one autosave writes. Each session has a folder with one
//! complete generation. A new generation is written under a hidden name, flushed to the disk and
//! renamed, and the previous one is removed only then. So the folder always holds a complete
//! generation after the first autosave, and the newest one counts.
//! The recording lies beside the generations in a file that only grows. The program keeps the file
//! `lock` locked while it runs. The system unlocks that file however the program ends, so other
//! programs can see whether the session still runs.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use documents::file::disk::File;
use documents::file::{disk, sync_folder};
use paint::document::Document;
use serde::{Deserialize, Serialize};
use web_time::{SystemTime, UNIX_EPOCH};

use crate::event::KeptPainting;
use crate::failure::FileFailure;
use work::{RecordingFile, WorkFile, describe};

mod work;

#[cfg(test)]
mod tests;

pub use work::RecoveredWork;

const PARTIAL: &str = ".partial";
const CANVAS: &str = "canvas.exr";
const PALETTE: &str = "palette.exr";
const META: &str = "session.json";
const SCRIPT: &str = "scene.toml";
const WORK: &str = "work.json";
const BRUSHES: &str = "brushes.bin";

/// Description of an autosave.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SessionMeta {
    /// Title of the painting or scene.
    pub title: String,
    /// File that the painting was opened from or saved as, if there is one. For a scene this is the
    /// folder of its subject.
    pub path: Option<PathBuf>,
    /// Time of the autosave, in seconds since 1970.
    pub seconds: u64,
    /// Any further data that the front end wants to get back, e.g. the set-up of its window.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub desk: Option<serde_json::Value>,
}

enum Content {
    Bytes(Vec<u8>),
    /// The content did not change since it was written to this file.
    Unchanged(PathBuf),
}

/// Autosave folder of the running session.
#[derive(Debug)]
pub struct Autosave {
    folder: PathBuf,
    _lock: SessionLock,
    generation: u64,
    /// Name of the autosave in messages.
    title: String,
    recording: RecordingFile,
    palette: Option<Arc<Document>>,
}

/// Seconds since 1970.
pub fn now() -> u64 {
    SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |since| since.as_secs())
}

impl Autosave {
    /// Creates the folder of a session below the folder `sessions`.
    ///
    /// # Errors
    /// [`FileFailure`] if the folder cannot be made or locked.
    pub fn begin(sessions: &Path) -> Result<Self, FileFailure> {
        let cannot = |error: std::io::Error| FileFailure::io(sessions, "used for autosave", &error);
        disk::create_dir_all(sessions).map_err(cannot)?;
        let process = disk::process_number();
        for attempt in 0..1000 {
            let name = format!("{}-{process}-{attempt}", now());
            // Locked before it is renamed, so that no program takes it for a lost session.
            let hidden = sessions.join(format!(".{name}"));
            let folder = sessions.join(name);
            if disk::exists(&folder) {
                continue;
            }
            match disk::create_dir(&hidden) {
                Err(error) if error.kind() == std::io::ErrorKind::AlreadyExists => continue,
                made => made.map_err(cannot)?,
            }
            let lock = SessionLock::create(&hidden).map_err(cannot)?;
            disk::rename(&hidden, &folder).map_err(cannot)?;
            return Ok(Self {
                folder,
                _lock: lock,
                generation: 0,
                title: "the autosave".to_owned(),
                recording: RecordingFile::default(),
                palette: None,
            });
        }
        Err(cannot(std::io::ErrorKind::AlreadyExists.into()))
    }

    /// Folder of this session.
    #[must_use]
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// Saves `painting` as a new generation and removes the previous ones. If the recording
    /// continues a painting that was saved, pass the content of that file as `start`. Returns how
    /// many actions of the recording are saved now. Your next `painting` needs only the actions
    /// after these. If the actions in `painting` do not follow the saved ones, this generation has
    /// no recording, and you get 0.
    ///
    /// # Errors
    /// [`FileFailure`]. The previous generation stays.
    pub fn keep(
        &mut self,
        painting: &KeptPainting,
        start: Option<&[u8]>,
        meta: &SessionMeta,
    ) -> Result<usize, FileFailure> {
        let folder = self.folder.clone();
        self.title = title_of(meta);
        let title = self.title.clone();
        let unusable = |error: std::io::Error| FileFailure::about(&title, "written", &error);
        fn bytes(document: &Document) -> Result<Vec<u8>, FileFailure> {
            paint::file::write(document).map_err(|error| FileFailure::explained(&error))
        }
        fn json(value: Result<Vec<u8>, serde_json::Error>) -> Result<Vec<u8>, FileFailure> {
            value.map_err(|error| FileFailure::without_hint(&error))
        }
        let recording = match &painting.recording {
            Some(tail) => self.recording.append(&folder, tail, start).map_err(unusable)?,
            None => None,
        };
        let kept = if recording.is_some() { self.recording.actions() } else { 0 };
        let (work, brushes) = describe(recording, &painting.brushes, painting.mask.as_deref());
        let canvas = &painting.snapshot.canvas;
        let palette = &painting.snapshot.palette;
        let earlier = generation_folder(&folder, self.generation).join(PALETTE);
        let unchanged = disk::is_file(&earlier) && self.palette.as_ref() == Some(palette);
        let palette_file =
            if unchanged { Content::Unchanged(earlier) } else { Content::Bytes(bytes(palette)?) };
        let files = [
            (CANVAS, Content::Bytes(bytes(canvas)?)),
            (PALETTE, palette_file),
            (BRUSHES, Content::Bytes(brushes)),
            (WORK, Content::Bytes(json(serde_json::to_vec(&work))?)),
            (META, Content::Bytes(json(serde_json::to_vec(meta))?)),
        ];
        self.keep_files(&files, &mut || Ok(())).map_err(unusable)?;
        self.palette = Some(Arc::clone(palette));
        self.recording.remove_older(&folder).map_err(unusable)?;
        Ok(kept)
    }

    /// Saves the script of a scene as a new generation, and removes the previous ones.
    ///
    /// # Errors
    /// [`FileFailure`]. The previous generation stays.
    pub fn keep_script(&mut self, script: &str, meta: &SessionMeta) -> Result<(), FileFailure> {
        let text = serde_json::to_vec(meta).map_err(|error| FileFailure::without_hint(&error))?;
        let script = Content::Bytes(script.as_bytes().to_vec());
        self.title = title_of(meta);
        self.keep_files(&[(SCRIPT, script), (META, Content::Bytes(text))], &mut || Ok(()))
            .map_err(|error| FileFailure::about(&self.title, "written", &error))
    }

    /// Writes the files of a generation. Tests pass a `before` that fails, to interrupt the save
    /// before one of the changes on the disk.
    fn keep_files(
        &mut self,
        files: &[(&str, Content)],
        before: &mut dyn FnMut() -> std::io::Result<()>,
    ) -> std::io::Result<()> {
        let partial = self.folder.join(PARTIAL);
        if disk::exists(&partial) {
            before()?;
            disk::remove_dir_all(&partial)?;
        }
        before()?;
        disk::create_dir(&partial)?;
        for (name, content) in files {
            let path = partial.join(name);
            let bytes = match content {
                Content::Bytes(bytes) => bytes,
                Content::Unchanged(earlier) => {
                    before()?;
                    // Some file systems have no links.
                    disk::hard_link(earlier, &path)
                        .or_else(|_| disk::copy(earlier, &path).map(drop))?;
                    continue;
                }
            };
            before()?;
            let mut file = File::create(&path)?;
            before()?;
            file.write_all(bytes)?;
            before()?;
            file.sync_all()?;
        }
        sync_folder(&partial);
        let earlier = generations(&self.folder)?;
        self.generation = 1 + earlier.iter().copied().max().unwrap_or(self.generation);
        before()?;
        disk::rename(&partial, generation_folder(&self.folder, self.generation))?;
        before()?;
        sync_folder(&self.folder);
        for number in earlier {
            before()?;
            disk::remove_dir_all(generation_folder(&self.folder, number))?;
        }
        Ok(())
    }

    /// Removes all generations, after the painting was saved to a file of its own.
    ///
    /// # Errors
    /// [`FileFailure`] if a file cannot be removed.
    pub fn clear(&mut self) -> Result<(), FileFailure> {
        self.palette = None;
        clear(&self.folder)
            .and_then(|()| self.recording.clear(&self.folder))
            .map_err(|error| FileFailure::about(&self.title, "removed", &error))
    }

    /// Ends the session and removes its folder.
    pub fn end(self) {
        remove(&self.folder);
    }
}

/// Name of an autosave in messages, because the painter does not know its folder.
fn title_of(meta: &SessionMeta) -> String {
    format!("the autosave of {}", meta.title)
}

/// Autosave of a program that crashed or was killed. Other programs do not find it while you hold
/// this value.
#[derive(Debug)]
pub struct LostSession {
    folder: PathBuf,
    _lock: SessionLock,
    generation: u64,
    /// Description of the autosave.
    pub meta: SessionMeta,
}

impl LostSession {
    /// All lost sessions below the folder `sessions`, the newest first. This removes sessions
    /// without an autosave.
    ///
    /// # Errors
    /// [`FileFailure`] if the folder cannot be read.
    pub fn all(sessions: &Path) -> Result<Vec<Self>, FileFailure> {
        let entries = match disk::read_dir(sessions) {
            Ok(entries) => entries,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(Vec::new()),
            Err(error) => return Err(FileFailure::io(sessions, "read", &error)),
        };
        let folders = entries.filter_map(|entry| Some(entry.ok()?.path()));
        let mut folders: Vec<_> = folders
            .filter(|folder| {
                let name = folder.file_name().and_then(|name| name.to_str());
                disk::is_dir(folder) && name.is_some_and(|name| !name.starts_with('.'))
            })
            .collect();
        folders.sort();
        let mut found: Vec<Self> = folders.into_iter().filter_map(Self::claim).collect();
        found.sort_by_key(|lost| std::cmp::Reverse(lost.meta.seconds));
        Ok(found)
    }

    /// Locks the session in `folder`, if its program has ended and it has an autosave.
    fn claim(folder: PathBuf) -> Option<Self> {
        let lock = SessionLock::open(&folder).ok()?;
        let mut numbers = generations(&folder).ok()?;
        numbers.sort_unstable();
        if numbers.is_empty() {
            remove(&folder);
            return None;
        }
        let (generation, meta) = numbers.iter().rev().find_map(|number: &u64| {
            let bytes = disk::read(generation_folder(&folder, *number).join(META)).ok()?;
            Some((*number, serde_json::from_slice(&bytes).ok()?))
        })?;
        Some(Self { folder, _lock: lock, generation, meta })
    }

    /// Folder of the lost session.
    #[must_use]
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// Paths of the files of canvas and palette.
    #[must_use]
    pub fn files(&self) -> [PathBuf; 2] {
        let folder = generation_folder(&self.folder, self.generation);
        [CANVAS, PALETTE].map(|name| folder.join(name))
    }

    /// Recording, brushes with their paint, and mask. Autosaves of earlier versions did not save
    /// them: you get `None` then.
    ///
    /// # Errors
    /// [`FileFailure`] if a file is missing or was changed.
    pub fn work(&self) -> Result<Option<RecoveredWork>, FileFailure> {
        let folder = generation_folder(&self.folder, self.generation);
        let path = folder.join(WORK);
        let brushes = folder.join(BRUSHES);
        if !disk::exists(&path) {
            return Ok(None);
        }
        fn read(path: &Path) -> Result<Vec<u8>, FileFailure> {
            documents::file::read(path).map_err(|error| FileFailure::explained(&error))
        }
        let work: WorkFile = serde_json::from_slice(&read(&path)?)
            .map_err(|error| FileFailure::io(&path, "read", &error.into()))?;
        work.read(&self.folder, (&brushes, &read(&brushes)?)).map(Some)
    }

    /// Path of the script of a scene.
    #[must_use]
    pub fn script(&self) -> PathBuf {
        generation_folder(&self.folder, self.generation).join(SCRIPT)
    }

    /// Removes the session.
    pub fn discard(self) {
        remove(&self.folder);
    }
}

fn generation_folder(folder: &Path, number: u64) -> PathBuf {
    folder.join(format!("generation-{number}"))
}

/// Numbers of the generations in `folder`, in increasing order.
fn generations(folder: &Path) -> std::io::Result<Vec<u64>> {
    let mut numbers = Vec::new();
    for entry in disk::read_dir(folder)? {
        let name = entry?.file_name();
        let number = name.to_str().and_then(|name| name.strip_prefix("generation-"));
        numbers.extend(number.and_then(|number| number.parse::<u64>().ok()));
    }
    numbers.sort_unstable();
    Ok(numbers)
}

/// Removes all generations, the newest first, so that a crash leaves an older one or none,
/// but never part of one.
fn clear(folder: &Path) -> std::io::Result<()> {
    let gone = folder.join(PARTIAL);
    for number in generations(folder)?.into_iter().rev() {
        if disk::exists(&gone) {
            disk::remove_dir_all(&gone)?;
        }
        disk::rename(generation_folder(folder, number), &gone)?;
    }
    if disk::exists(&gone) { disk::remove_dir_all(&gone) } else { Ok(()) }
}

/// Removes the folder of a session. The lock file is removed last.
fn remove(folder: &Path) {
    let _ = clear(folder);
    let _ = disk::remove_dir_all(folder);
}

const LOCK: &str = "lock";

/// Lock of a session, held while this value exists.
#[derive(Debug)]
struct SessionLock(File);

impl SessionLock {
    /// Makes and locks the file of the session in `folder`.
    fn create(folder: &Path) -> std::io::Result<Self> {
        Self::of(File::create(folder.join(LOCK))?)
    }

    /// Locks the file of the session in `folder`.
    fn open(folder: &Path) -> std::io::Result<Self> {
        Self::of(File::options().read(true).write(true).open(folder.join(LOCK))?)
    }

    fn of(file: File) -> std::io::Result<Self> {
        file.try_lock()?;
        Ok(Self(file))
    }
}

impl Drop for SessionLock {
    fn drop(&mut self) {
        // It is not enough to close the file: when another thread starts a process, that process
        // holds copies of all open files, and so the lock, until it runs its own program.
        let _ = self.0.unlock();
    }
}

#[cfg(test)]
mod session_lock_tests {
    use super::*;

    #[test]
    fn a_copy_of_the_open_file_does_not_keep_the_lock() {
        let folder = tempfile::tempdir().unwrap();
        let lock = SessionLock::create(folder.path()).unwrap();
        assert!(SessionLock::open(folder.path()).is_err(), "it is held");
        let copy = lock.0.try_clone().unwrap();
        drop(lock);
        assert!(SessionLock::open(folder.path()).is_ok(), "it was given up");
        drop(copy);
    }
}
