//! Files that another file names, for example the textures of a model. A file may come from anyone,
//! so it may name only regular files, and only in its own folder or below.

use std::io;
use std::path::{Path, PathBuf};

use super::disk;
use crate::hint::Explain;

/// Whether a file may name files outside its own folder.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Outside {
    /// It may name files in its own folder and below.
    #[default]
    Refused,
    /// It may name any file, for example because the user wrote it.
    Allowed,
}

impl Outside {
    /// The rule for the setting `allow_outside`.
    #[must_use]
    pub fn allowed_if(allow_outside: bool) -> Self {
        if allow_outside { Self::Allowed } else { Self::Refused }
    }
}

/// Finds the files that one file names, and remembers them, because they are inputs too.
///
/// ```
/// use documents::file::{NamedFiles, Outside, write_whole};
///
/// let folder = tempfile::tempdir()?;
/// let model = folder.path().join("jug.obj");
/// write_whole(&folder.path().join("jug.mtl"), b"newmtl clay")?;
///
/// let mut files = NamedFiles::of(&model, Outside::Refused);
/// assert_eq!(files.read("mtllib", "jug.mtl")?, b"newmtl clay");
/// assert!(files.read("mtllib", "../jug.mtl").is_err());
/// assert_eq!(files.found(), [folder.path().join("jug.mtl")]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct NamedFiles {
    file: PathBuf,
    outside: Outside,
    found: Vec<PathBuf>,
}

impl NamedFiles {
    /// Prepares to find the files that `file` names. Their paths are relative to its folder. For
    /// standard input this is the current folder.
    #[must_use]
    pub fn of(file: &Path, outside: Outside) -> Self {
        Self { file: file.to_owned(), outside, found: Vec::new() }
    }

    /// The path of a file that is named at `place`, for example `mtllib` or `images[0].uri`. This
    /// looks at the file but does not open it.
    ///
    /// # Errors
    /// [`NamedFileError`] if there is no such file, if it is a folder, a device or a pipe, and if
    /// it lies outside the folder although [`Outside`] refuses this.
    pub fn find(&mut self, place: &str, named: &str) -> Result<PathBuf, NamedFileError> {
        let folder = self.file.parent().unwrap_or(Path::new(""));
        let path = folder.join(named);
        let metadata =
            disk::metadata(&path).map_err(|reason| self.missing(place, named, reason))?;
        if !metadata.is_file() {
            let [file, place, named] = self.names(place, named);
            return Err(NamedFileError::NotRegular { file, place, named });
        }
        if self.outside == Outside::Refused {
            let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
            let resolved = [folder, &path].map(disk::canonicalize);
            let [folder, whole] = resolved.map(|found| found.map_err(|e| e.to_string()));
            let below =
                matches!((folder, whole), (Ok(folder), Ok(whole)) if whole.starts_with(&folder));
            if !below {
                let [file, place, named] = self.names(place, named);
                return Err(NamedFileError::Outside { file, place, named });
            }
        }
        if !self.found.contains(&path) {
            self.found.push(path.clone());
        }
        Ok(path)
    }

    /// The content of a file that is named at `place`.
    ///
    /// # Errors
    /// The errors of [`Self::find`], and if the file cannot be read.
    pub fn read(&mut self, place: &str, named: &str) -> Result<Vec<u8>, NamedFileError> {
        let path = self.find(place, named)?;
        disk::read(&path).map_err(|reason| self.missing(place, named, reason))
    }

    /// The file that names them, as you gave it.
    #[must_use]
    pub fn file(&self) -> &Path {
        &self.file
    }

    /// Paths of all files that were found so far, each once.
    #[must_use]
    pub fn found(&self) -> &[PathBuf] {
        &self.found
    }

    fn missing(&self, place: &str, named: &str, reason: io::Error) -> NamedFileError {
        let [file, place, named] = self.names(place, named);
        NamedFileError::Unreadable { file, place, named, reason }
    }

    fn names(&self, place: &str, named: &str) -> [String; 3] {
        [self.file.display().to_string(), place.to_owned(), named.to_owned()]
    }
}

/// A file names another file that cannot be read, or that it must not name.
#[derive(Debug, thiserror::Error, Explain)]
pub enum NamedFileError {
    /// The named file cannot be read.
    #[error("{file}: {place} `{named}`: cannot be read")]
    #[hint("put this file where it is named, or correct the name")]
    #[fault(Environment)]
    Unreadable {
        /// Path of the file that names it.
        file: String,
        /// The place in that file, for example `mtllib`.
        place: String,
        /// The named file, as it stands there.
        named: String,
        /// The error of the operating system.
        #[source]
        reason: io::Error,
    },
    /// The named file is a folder, a device or a pipe.
    #[error("{file}: {place} `{named}`: is not a regular file")]
    #[hint("name a file that holds the data; devices, pipes and folders are not opened")]
    NotRegular {
        /// Path of the file that names it.
        file: String,
        /// The place in that file.
        place: String,
        /// The named file, as it stands there.
        named: String,
    },
    /// The named file lies outside the folder of the file that names it.
    #[error("{file}: {place} `{named}`: lies outside the folder of {file}")]
    #[hint("copy it into that folder, or give [allow_outside] if you trust the file that names it")]
    Outside {
        /// Path of the file that names it.
        file: String,
        /// The place in that file.
        place: String,
        /// The named file, as it stands there.
        named: String,
    },
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_of_the_folder_and_below_are_found_once() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::create_dir(folder.path().join("below")).unwrap();
        std::fs::write(folder.path().join("below/a.png"), b"one").unwrap();
        let mut files = NamedFiles::of(&folder.path().join("m.obj"), Outside::Refused);
        assert_eq!(files.read("map_Kd", "below/a.png").unwrap(), b"one");
        assert_eq!(files.read("map_Kd", "below/a.png").unwrap(), b"one");
        assert_eq!(files.found(), [folder.path().join("below/a.png")]);
        let error = files.find("map_Kd", "b.png").unwrap_err();
        assert!(error.to_string().ends_with("m.obj: map_Kd `b.png`: cannot be read"), "{error}");
        assert!(matches!(files.find("map_Kd", "below"), Err(NamedFileError::NotRegular { .. })));
    }

    #[test]
    fn files_outside_need_leave() {
        let folder = tempfile::tempdir().unwrap();
        let inner = folder.path().join("inner");
        std::fs::create_dir(&inner).unwrap();
        let secret = folder.path().join("secret");
        std::fs::write(&secret, b"one").unwrap();
        let whole = secret.to_str().unwrap();
        for named in ["../secret", "../inner/../secret", whole] {
            let mut files = NamedFiles::of(&inner.join("m.obj"), Outside::Refused);
            let error = files.read("mtllib", named).unwrap_err();
            assert!(matches!(error, NamedFileError::Outside { .. }), "{error}");
            assert!(error.hint().unwrap().to_string().contains("`allow_outside`"));
            assert!(files.found().is_empty());
            let mut files = NamedFiles::of(&inner.join("m.obj"), Outside::allowed_if(true));
            assert_eq!(files.read("mtllib", named).unwrap(), b"one");
        }
    }

    #[cfg(unix)]
    #[test]
    fn links_are_followed_and_devices_never_opened() {
        let folder = tempfile::tempdir().unwrap();
        let inner = folder.path().join("inner");
        std::fs::create_dir(&inner).unwrap();
        std::fs::write(folder.path().join("secret"), b"one").unwrap();
        std::fs::write(inner.join("own"), b"two").unwrap();
        std::os::unix::fs::symlink("../secret", inner.join("away")).unwrap();
        std::os::unix::fs::symlink("own", inner.join("near")).unwrap();
        std::os::unix::fs::symlink("/dev/zero", inner.join("zero")).unwrap();
        let mut files = NamedFiles::of(&inner.join("m.obj"), Outside::Refused);
        assert_eq!(files.read("uri", "near").unwrap(), b"two");
        assert!(matches!(files.find("uri", "away"), Err(NamedFileError::Outside { .. })));
        for outside in [Outside::Refused, Outside::Allowed] {
            let mut files = NamedFiles::of(&inner.join("m.obj"), outside);
            for named in ["/dev/zero", "zero"] {
                let error = files.read("uri", named).unwrap_err();
                assert!(matches!(error, NamedFileError::NotRegular { .. }), "{error}");
            }
        }
    }
}
