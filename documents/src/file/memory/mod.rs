//! A file system in memory, with the calls of [`std::fs`] that impasto uses.
//!
//! A page has no disk, so its files lie here. The page copies files that should outlive it to the
//! browser's storage. Call [`take_changes`] to list what has changed.

mod open_file;

#[cfg(test)]
mod tests;

use std::collections::{BTreeMap, BTreeSet};
use std::io;
use std::path::{Component, Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use web_time::SystemTime;

pub use open_file::{File, OpenOptions, *};

/// Size, kind and time of what lies at a path.
#[derive(Debug, Clone)]
pub struct Metadata {
    bytes: Option<u64>,
    modified: SystemTime,
}

#[allow(clippy::len_without_is_empty, reason = "the calls of std::fs::Metadata")]
impl Metadata {
    /// Whether it is a file.
    #[must_use]
    pub fn is_file(&self) -> bool {
        self.bytes.is_some()
    }

    /// Whether it is a folder.
    #[must_use]
    pub fn is_dir(&self) -> bool {
        self.bytes.is_none()
    }

    /// Number of bytes, and 0 for a folder.
    #[must_use]
    pub fn len(&self) -> u64 {
        self.bytes.unwrap_or(0)
    }

    /// Time of the last change.
    pub fn modified(&self) -> io::Result<SystemTime> {
        Ok(self.modified)
    }
}

/// Size, kind and time of the file or folder at `path`.
pub fn metadata(path: impl AsRef<Path>) -> io::Result<Metadata> {
    let tree = tree();
    let (node, modified) = tree.find(path.as_ref())?;
    let bytes = match node {
        Node::File(bytes) => Some(bytes.len() as u64),
        Node::Folder => None,
    };
    Ok(Metadata { bytes, modified })
}

/// A file that has changed: its path, and its content, or `None` if it is gone.
pub type Change = (PathBuf, Option<Arc<Vec<u8>>>);

static TREE: Mutex<Tree> = Mutex::new(Tree::new());

fn tree() -> MutexGuard<'static, Tree> {
    TREE.lock().unwrap_or_else(PoisonError::into_inner)
}

#[derive(Debug, Clone)]
enum Node {
    Folder,
    File(Arc<Vec<u8>>),
}

/// Folders and files by their paths from the root on. This always holds the root itself.
#[derive(Debug)]
struct Tree {
    nodes: BTreeMap<PathBuf, (Node, SystemTime)>,
    changed: BTreeSet<PathBuf>,
}

/// `path` from the root on, without `.` and `..`.
pub(crate) fn from_root(path: &Path) -> PathBuf {
    let mut found = PathBuf::from("/");
    for part in path.components() {
        match part {
            Component::Normal(name) => found.push(name),
            Component::ParentDir => drop(found.pop()),
            Component::Prefix(_) | Component::RootDir | Component::CurDir => {}
        }
    }
    found
}

impl Tree {
    const fn new() -> Self {
        Self { nodes: BTreeMap::new(), changed: BTreeSet::new() }
    }

    /// The file or folder at `path`, and the time of its last change.
    fn find(&self, path: &Path) -> io::Result<(Node, SystemTime)> {
        let path = from_root(path);
        if path == Path::new("/") {
            return Ok((Node::Folder, SystemTime::UNIX_EPOCH));
        }
        self.nodes.get(&path).cloned().ok_or_else(|| io::ErrorKind::NotFound.into())
    }

    fn file(&self, path: &Path) -> io::Result<Arc<Vec<u8>>> {
        match self.find(path)?.0 {
            Node::File(bytes) => Ok(bytes),
            Node::Folder => Err(io::ErrorKind::IsADirectory.into()),
        }
    }

    fn is_folder(&self, path: &Path) -> io::Result<()> {
        match self.find(path)?.0 {
            Node::Folder => Ok(()),
            Node::File(_) => Err(io::ErrorKind::NotADirectory.into()),
        }
    }

    /// Writes a file to a folder, which must exist.
    fn put(&mut self, path: &Path, bytes: Arc<Vec<u8>>) -> io::Result<()> {
        let path = from_root(path);
        let folder = path.parent().ok_or(io::ErrorKind::IsADirectory)?;
        self.is_folder(folder)?;
        if self.is_folder(&path).is_ok() {
            return Err(io::ErrorKind::IsADirectory.into());
        }
        self.nodes.insert(path.clone(), (Node::File(bytes), SystemTime::now()));
        self.changed.insert(path);
        Ok(())
    }

    /// Makes a folder in one that exists.
    fn make_folder(&mut self, path: &Path) -> io::Result<()> {
        let path = from_root(path);
        if self.find(&path).is_ok() {
            return Err(io::ErrorKind::AlreadyExists.into());
        }
        self.is_folder(path.parent().unwrap_or(Path::new("/")))?;
        self.nodes.insert(path, (Node::Folder, SystemTime::now()));
        Ok(())
    }

    /// Makes a folder and those above it.
    fn make_folders(&mut self, path: &Path) -> io::Result<()> {
        let path = from_root(path);
        let above: Vec<PathBuf> = path.ancestors().map(Path::to_owned).collect();
        for folder in above.iter().rev() {
            match self.find(folder) {
                Ok((Node::Folder, _)) => {}
                Ok((Node::File(_), _)) => return Err(io::ErrorKind::NotADirectory.into()),
                Err(_) => self.make_folder(folder)?,
            }
        }
        Ok(())
    }

    fn entries(&self, path: &Path) -> io::Result<Vec<PathBuf>> {
        self.is_folder(path)?;
        let path = from_root(path);
        let inside = self.nodes.keys().filter(|found| found.parent() == Some(&path));
        Ok(inside.cloned().collect())
    }

    fn remove_file(&mut self, path: &Path) -> io::Result<()> {
        self.file(path)?;
        let path = from_root(path);
        self.nodes.remove(&path);
        self.changed.insert(path);
        Ok(())
    }

    fn remove_folder(&mut self, path: &Path) -> io::Result<()> {
        self.is_folder(path)?;
        for path in self.below(&from_root(path)) {
            if let Some((Node::File(_), _)) = self.nodes.remove(&path) {
                self.changed.insert(path);
            }
        }
        Ok(())
    }

    /// The path and all paths below it.
    fn below(&self, path: &Path) -> Vec<PathBuf> {
        self.nodes.keys().filter(|found| found.starts_with(path)).cloned().collect()
    }

    fn rename(&mut self, from: &Path, to: &Path) -> io::Result<()> {
        let from = from_root(from);
        let to = from_root(to);
        let (node, _) = self.find(&from)?;
        self.is_folder(to.parent().ok_or(io::ErrorKind::AlreadyExists)?)?;
        match (node, self.find(&to)) {
            (Node::File(bytes), _) => {
                self.put(&to, bytes)?;
                if from != to {
                    self.remove_file(&from)?;
                }
            }
            (Node::Folder, Ok(_)) => return Err(io::ErrorKind::AlreadyExists.into()),
            (Node::Folder, Err(_)) if to.starts_with(&from) => {
                return Err(io::ErrorKind::InvalidInput.into());
            }
            (Node::Folder, Err(_)) => {
                for path in self.below(&from) {
                    let Some(found) = self.nodes.remove(&path) else { continue };
                    let rest = path.strip_prefix(&from).unwrap_or(Path::new(""));
                    // Joining nothing would add a slash.
                    let path_then = if rest == Path::new("") { to.clone() } else { to.join(rest) };
                    if matches!(found.0, Node::File(_)) {
                        self.changed.extend([path, path_then.clone()]);
                    }
                    self.nodes.insert(path_then, found);
                }
            }
        }
        Ok(())
    }

    /// Files that have changed since the last call.
    fn take_changes(&mut self) -> Vec<Change> {
        let changed = std::mem::take(&mut self.changed);
        changed.into_iter().map(|path| (path.clone(), self.file(&path).ok())).collect()
    }
}
