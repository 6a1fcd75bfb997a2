//! Temporary files beside the files that they become. We list them while they live, so that a
//! program that has to end can remove them. We can also recognise them later by their names, so
//! that the next program can remove what is left.

use std::collections::BTreeSet;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, OnceLock, PoisonError};
use std::time::{Duration, SystemTime};

use tempfile::{Builder, NamedTempFile};

pub(super) const PREFIX: &str = ".impasto-";
const SUFFIX: &str = ".tmp";
/// A temporary file of this age is left over, whoever wrote it.
const OLD: Duration = Duration::from_secs(3600);

/// Temporary files of writes under way, and folders that we have cleaned.
#[derive(Debug, Default)]
struct Known {
    files: BTreeSet<PathBuf>,
    cleaned: BTreeSet<PathBuf>,
}

static KNOWN: Mutex<Known> = Mutex::new(Known { files: BTreeSet::new(), cleaned: BTreeSet::new() });

fn known() -> MutexGuard<'static, Known> {
    KNOWN.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A temporary file. If you drop this value, the file goes away.
#[derive(Debug)]
pub(super) struct Temporary {
    /// The file, or `None` once we renamed or removed it.
    file: Option<NamedTempFile>,
    path: PathBuf,
}

impl Temporary {
    pub(super) fn new(folder: &Path) -> io::Result<Self> {
        let beginning = format!("{PREFIX}{}-{}-", machine(), std::process::id());
        let mut builder = Builder::new();
        builder.prefix(&beginning).suffix(SUFFIX);
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            // The permissions of a newly created file, to which the user's umask applies.
            builder.permissions(std::fs::Permissions::from_mode(0o666));
        }
        // Created while the list is locked, so that no file exists that is not in it.
        let mut known = known();
        let file = builder.tempfile_in(folder)?;
        let path = file.path().to_owned();
        known.files.insert(path.clone());
        Ok(Self { file: Some(file), path })
    }

    pub(super) fn file(&mut self) -> io::Result<&mut std::fs::File> {
        self.file
            .as_mut()
            .map(NamedTempFile::as_file_mut)
            .ok_or_else(|| io::ErrorKind::NotFound.into())
    }

    pub(super) fn persist(mut self, target: &Path) -> io::Result<()> {
        let Some(file) = self.file.take() else { return Err(io::ErrorKind::NotFound.into()) };
        let mut known = known();
        let renamed = file.persist(target).map(drop).map_err(|error| error.error);
        known.files.remove(&self.path);
        renamed
    }
}

impl Drop for Temporary {
    fn drop(&mut self) {
        let Some(file) = self.file.take() else { return };
        let mut known = known();
        drop(file);
        known.files.remove(&self.path);
    }
}

/// Removes the temporary files of all writes under way. No further write begins or ends, because
/// threads that write wait for ever. Call this only if you end the program right after.
///
/// You lose no file that was written whole, because we rename a file before or after this call.
pub fn abandon_writes() {
    let known = known();
    for file in &known.files {
        let _ = std::fs::remove_file(file);
    }
    // Never unlocked again.
    std::mem::forget(known);
}

/// Removes temporary files that earlier runs left in `folder`, once for each folder. We call a file
/// left over if its process has ended, or after an hour.
pub(super) fn clean(folder: &Path) {
    if !known().cleaned.insert(folder.to_owned()) {
        return;
    }
    let Ok(entries) = std::fs::read_dir(folder) else { return };
    let now = SystemTime::now();
    for entry in entries.filter_map(Result::ok) {
        let name = entry.file_name();
        let Some(writer) = name.to_str().and_then(Writer::of) else { continue };
        let Ok(about) = entry.metadata() else { continue };
        let age = about.modified().ok().and_then(|time| now.duration_since(time).ok());
        if about.is_file() && writer.has_left(age.unwrap_or_default()) {
            let _ = std::fs::remove_file(entry.path());
        }
    }
}

#[derive(Debug, PartialEq, Eq)]
struct Writer<'n> {
    machine: &'n str,
    process: u32,
}

impl<'n> Writer<'n> {
    /// Finds the writer from the name of a file, or `None` for any other file.
    fn of(name: &'n str) -> Option<Self> {
        let inside = name.strip_prefix(PREFIX)?.strip_suffix(SUFFIX)?;
        let mut parts = inside.split('-');
        let writer = Self { machine: parts.next()?, process: parts.next()?.parse().ok()? };
        let is_ours = writer.machine.len() == 8
            && writer.machine.bytes().all(|byte| byte.is_ascii_hexdigit());
        (is_ours && parts.next()?.len() == 6 && parts.next().is_none()).then_some(writer)
    }

    /// Whether a temporary file of this writer and age is left over: its process has ended, or the
    /// file is old.
    fn has_left(&self, age: Duration) -> bool {
        age > OLD || self.machine == machine() && is_running(self.process) == Some(false)
    }
}

/// Eight digits that differ between machines, between starts of one machine, and between its
/// containers. Process numbers are unique only within one of these.
fn machine() -> &'static str {
    static MACHINE: OnceLock<String> = OnceLock::new();
    MACHINE.get_or_init(|| {
        let start = std::fs::read_to_string("/proc/sys/kernel/random/boot_id").unwrap_or_default();
        let container = std::fs::read_link("/proc/self/ns/pid").unwrap_or_default();
        let text = format!("{start}{}", container.display());
        // FNV-1a (Fowler, Noll, Vo 1991), the same in every version of the program.
        let digest = text.bytes().fold(0x811c_9dc5_u32, |digest, byte| {
            (digest ^ u32::from(byte)).wrapping_mul(0x0100_0193)
        });
        format!("{digest:08x}")
    })
}

/// Whether a process of this machine runs, or `None` if we cannot find out.
fn is_running(process: u32) -> Option<bool> {
    let processes = Path::new("/proc");
    // Without the folder of this process there is no list of processes.
    if !processes.join("self").exists() {
        return None;
    }
    Some(processes.join(process.to_string()).exists())
}

#[cfg(test)]
mod tests {
    use std::fs::{File, FileTimes};

    use super::*;

    fn place(folder: &Path, machine: &str, process: u32) -> PathBuf {
        let path = folder.join(format!("{PREFIX}{machine}-{process}-aBc123{SUFFIX}"));
        std::fs::write(&path, "half").unwrap();
        path
    }

    /// No Linux system gives a process this number.
    const NOBODY: u32 = 1 << 30;

    #[test]
    fn files_of_ended_processes_and_old_ones_are_cleaned_once() {
        let folder = tempfile::tempdir().unwrap();
        let folder = folder.path();
        let own = place(folder, machine(), std::process::id());
        let elsewhere = place(folder, "0123abcd", NOBODY);
        let ended = place(folder, machine(), NOBODY);
        let old = place(folder, "fedc9876", 7);
        let before = SystemTime::now() - 2 * OLD;
        let times = FileTimes::new().set_modified(before);
        File::options().write(true).open(&old).unwrap().set_times(times).unwrap();
        let mine = folder.join(".impasto-notes.tmp");
        std::fs::write(&mine, "mine").unwrap();
        clean(folder);
        assert!(own.exists() && elsewhere.exists() && mine.exists(), "these are not left over");
        assert!(!old.exists(), "an hour is over");
        assert_eq!(ended.exists(), !Path::new("/proc/self").exists(), "its process has ended");
        let again = place(folder, "fedc9876", 7);
        clean(folder);
        assert!(again.exists(), "a folder is cleaned once");
    }

    #[test]
    fn only_names_of_temporary_files_are_taken_for_them() {
        let own = format!("{PREFIX}{}-17-aBc123{SUFFIX}", machine());
        assert_eq!(Writer::of(&own), Some(Writer { machine: machine(), process: 17 }));
        for other in
            [".impasto-backup", ".impasto-x.tmp", ".impasto-0123abcd-17-.tmp", "a.tmp", ".impasto-"]
        {
            assert_eq!(Writer::of(other), None, "{other}");
        }
    }

    #[test]
    fn a_temporary_file_is_known_while_it_lives() {
        let folder = tempfile::tempdir().unwrap();
        let file = Temporary::new(folder.path()).unwrap();
        let path = file.path.clone();
        assert!(known().files.contains(&path) && path.exists());
        drop(file);
        assert!(!known().files.contains(&path) && !path.exists());
        let target = folder.path().join("a.txt");
        let file = Temporary::new(folder.path()).unwrap();
        let path = file.path.clone();
        file.persist(&target).unwrap();
        assert!(!known().files.contains(&path) && target.exists());
    }
}
