//! Output files and folders that you check before long work, so that it does not end in a file that nobody can
//! write. An output never replaces a file that the work reads.

use std::io;
use std::path::{Path, PathBuf};

use super::replace::resolved;
use super::whole::{FileAction, FileError, STANDARD_INPUT, check_writable, write_whole};
use crate::hint::Explain;

/// Splits a path of the form `FILE.xlsx#SHEET`. Any other path is only a file.
#[must_use]
pub fn split_file_and_sheet(text: &str) -> (&str, Option<&str>) {
    let lower = text.to_ascii_lowercase();
    let end = [".xlsx#", ".xlsm#"].iter().find_map(|mark| Some(lower.find(mark)? + mark.len()));
    match end {
        Some(end) if end < text.len() => (&text[..end - 1], Some(&text[end..])),
        _ => (text, None),
    }
}

/// An output file that was checked to be writable.
///
/// ```
/// use documents::file::Output;
///
/// let folder = tempfile::tempdir()?;
/// let input = folder.path().join("photo.png");
/// documents::file::write_whole(&input, b"a photograph")?;
/// let inputs = [input.clone()];
/// assert!(Output::open(&input, &inputs).is_err(), "an input is never overwritten");
///
/// let output = Output::open(&folder.path().join("painted.png"), &inputs)?;
/// output.put("a picture")?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Output {
    /// Path as the user gave it.
    path: PathBuf,
    /// Path with symbolic links resolved.
    target: PathBuf,
}

impl Output {
    /// Checks that `path` can be written and is not one of `inputs`. An input may name a sheet of its file, for
    /// example `readings.xlsx#White`. The path `-` is the output of the program.
    ///
    /// # Errors
    /// [`OutputError`] for a folder, an input, or a path that cannot be written.
    pub fn open(path: &Path, inputs: &[PathBuf]) -> Result<Self, OutputError> {
        if is_stream(path) {
            return Ok(Self { path: path.to_owned(), target: path.to_owned() });
        }
        let target = target_of(path)?;
        if target.exists() && !target.is_file() {
            return Err(OutputError::NotAFile(path.to_owned()));
        }
        for input in inputs {
            let text = input.to_str();
            let file = text.map_or(input.as_path(), |text| Path::new(split_file_and_sheet(text).0));
            if file.canonicalize().is_ok_and(|input| input == target) {
                return Err(OutputError::Input(path.to_owned()));
            }
        }
        check_writable(path)?;
        Ok(Self { path: path.to_owned(), target })
    }

    /// Checks that the file at the relative path `inside` can be written like [`Output::open`], and lies below `folder`.
    /// A link may not lead out of it. Use this for paths that a stranger's file names.
    ///
    /// # Errors
    /// [`OutputError`] in the cases of [`Output::open`], and for a file that is not below `folder`.
    pub fn below(folder: &Path, inside: &Path, inputs: &[PathBuf]) -> Result<Self, OutputError> {
        let path = folder.join(inside);
        if !target_of(&path)?.starts_with(target_of(folder)?) {
            return Err(OutputError::Outside { path, folder: folder.to_owned() });
        }
        match path.parent().zip(path.file_name()) {
            // The folder is made later.
            Some((parent, name)) if !parent.exists() && parent != Path::new("") => {
                let parent = OutputFolder::open(parent, inputs)?;
                Ok(Self { target: target_of(&path)?, path: parent.path().join(name) })
            }
            _ => Self::open(&path, inputs),
        }
    }

    /// Checks that `path` has one of `endings` and can be written, like [`Output::open`].
    ///
    /// # Errors
    /// [`OutputError`] in the cases of [`Output::open`], and for another ending.
    pub fn with_ending(
        path: &Path,
        endings: &[&'static str],
        inputs: &[PathBuf],
    ) -> Result<Self, OutputError> {
        if is_stream(path) {
            return Self::open(path, inputs);
        }
        let extension = path.extension().map(|e| e.to_string_lossy().to_lowercase());
        if !endings.iter().any(|ending| extension.as_deref() == Some(ending)) {
            return Err(OutputError::Ending { path: path.to_owned(), endings: endings.to_vec() });
        }
        Self::open(path, inputs)
    }

    /// Path as the user gave it.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The error for an output that has the same file as another one.
    #[must_use]
    pub fn used_twice(&self) -> OutputError {
        OutputError::UsedTwice(self.path.clone())
    }

    /// Whether a file lies there already, which the output replaces.
    #[must_use]
    pub fn replaces(&self) -> bool {
        self.target.exists()
    }

    /// Whether both outputs are the same file.
    #[must_use]
    pub fn is_same_as(&self, other: &Self) -> bool {
        self.target == other.target
    }

    /// Whether this is the output of the program: `-`.
    #[must_use]
    pub fn is_stream(&self) -> bool {
        is_stream(&self.path)
    }

    /// Replaces the file by `content`, or creates it. Do not call this for the output of the program.
    ///
    /// # Errors
    /// [`FileError`] as from [`write_whole`].
    pub fn put(&self, content: impl AsRef<[u8]>) -> Result<(), FileError> {
        write_whole(&self.path, content.as_ref())
    }
}

/// `path` with its links resolved.
fn target_of(path: &Path) -> Result<PathBuf, FileError> {
    resolved(path).map_err(|reason| FileError {
        path: path.to_owned(),
        action: FileAction::Write,
        reason: reason.into(),
    })
}

/// Refuses two outputs of one file. `None` stands for an output that is not wanted.
///
/// # Errors
/// [`OutputError::UsedTwice`] with the second of them.
pub fn refuse_same(outputs: &[Option<&Output>]) -> Result<(), OutputError> {
    let outputs: Vec<&Output> = outputs.iter().copied().flatten().collect();
    for (index, output) in outputs.iter().enumerate() {
        if outputs[..index].iter().any(|other| output.is_same_as(other)) {
            return Err(output.used_twice());
        }
    }
    Ok(())
}

/// Whether `path` is the output of the program: `-`.
#[must_use]
pub fn is_stream(path: &Path) -> bool {
    path == Path::new(STANDARD_INPUT)
}

/// A folder for outputs, checked to be writable. We make it only when the first output is written, so
/// that an earlier failure leaves nothing behind.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct OutputFolder {
    folder: PathBuf,
    inputs: Vec<PathBuf>,
}

impl OutputFolder {
    /// Checks that `folder` can be written to, or can be made where it is missing.
    ///
    /// # Errors
    /// [`OutputError`] if it cannot.
    pub fn open(folder: &Path, inputs: &[PathBuf]) -> Result<Self, OutputError> {
        let whole = std::path::absolute(folder).unwrap_or_else(|_| folder.to_owned());
        let there = whole.ancestors().find(|part| part.exists()).unwrap_or(&whole);
        let words = match there == whole && there.is_dir() {
            true => format!("{}: nothing can be written into this folder", folder.display()),
            false => cannot_be_created(folder),
        };
        if there.is_file() {
            return Err(OutputError::FileForFolder { words, file: there.to_owned() });
        }
        // The file that the check names is not one of the user's.
        if let Err(error) = check_writable(&there.join(".impasto")) {
            let reason = io::Error::from(error.reason.kind());
            return Err(OutputError::Folder(words, reason));
        }
        Ok(Self { folder: folder.to_owned(), inputs: inputs.to_vec() })
    }

    /// The folder as the user gave it.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.folder
    }

    /// Path of a file in it.
    #[must_use]
    pub fn file(&self, name: &str) -> PathBuf {
        self.folder.join(name)
    }

    /// Checks that files of these names can be written.
    ///
    /// # Errors
    /// The errors of [`Output::open`].
    pub fn check(&self, names: impl IntoIterator<Item = String>) -> Result<(), OutputError> {
        if !self.folder.exists() {
            return Ok(());
        }
        names.into_iter().try_for_each(|name| self.output(&name).map(drop))
    }

    /// Makes the folder.
    ///
    /// # Errors
    /// [`OutputError::Folder`] if it cannot be made.
    pub fn make(&self) -> Result<(), OutputError> {
        create_folder(&self.folder)
    }

    /// The output of this name in the folder.
    ///
    /// # Errors
    /// The errors of [`Output::open`].
    pub fn output(&self, name: &str) -> Result<Output, OutputError> {
        Output::open(&self.file(name), &self.inputs)
    }

    /// Makes the folder and returns outputs of these names. All are opened first, so that nothing
    /// is written if one cannot be.
    ///
    /// # Errors
    /// The errors of [`Self::make`] and [`Output::open`].
    pub fn outputs(
        &self,
        names: impl IntoIterator<Item = String>,
    ) -> Result<Vec<Output>, OutputError> {
        self.make()?;
        names.into_iter().map(|name| self.output(&name)).collect()
    }
}

/// Creates `folder` and its missing parents.
///
/// # Errors
/// [`OutputError::Folder`] if it cannot be made.
pub fn create_folder(folder: &Path) -> Result<(), OutputError> {
    std::fs::create_dir_all(folder)
        .map_err(|reason| OutputError::Folder(cannot_be_created(folder), reason))
}

fn cannot_be_created(folder: &Path) -> String {
    format!("{}: this folder cannot be created", folder.display())
}

/// An output that cannot be written, or that must not be.
#[derive(Debug, thiserror::Error, Explain)]
#[fault(Setting)]
pub enum OutputError {
    /// There is a folder or a device at this path.
    #[error("{}: expected a regular file", .0.display())]
    #[hint("name a file, or - to write to the output")]
    NotAFile(PathBuf),
    /// The work reads this file.
    #[error("{}: is an input file, which is never overwritten", .0.display())]
    #[hint("give the output another file name")]
    Input(PathBuf),
    /// A link leads out of the folder that holds the files of a stranger.
    #[error("{}: a link leads out of the folder {}", path.display(), folder.display())]
    #[hint("remove the link, or name a file below the folder")]
    #[fault(Input)]
    Outside {
        /// Path of the file.
        path: PathBuf,
        /// The folder below which it must lie.
        folder: PathBuf,
    },
    /// The name of the file has another ending.
    #[error("{}: expected a file name that ends in .{}", path.display(), endings.join(" or ."))]
    #[hint(verbatim, "try {}", path.with_extension(endings.first().unwrap_or(&"")).display())]
    Ending {
        /// Path as the user gave it.
        path: PathBuf,
        /// Endings without their dot, the usual one first.
        endings: Vec<&'static str>,
    },
    /// Another output has this file.
    #[error("{}: two outputs have this file name", .0.display())]
    #[hint("give each output its own file name")]
    UsedTwice(PathBuf),
    /// A part of the path of a folder is a file.
    #[error("{words}: {} is a file", file.display())]
    #[hint("name another folder")]
    FileForFolder {
        /// The folder, and what cannot be done.
        words: String,
        /// The file.
        file: PathBuf,
    },
    /// A folder cannot be made, or nothing can be written into it.
    #[error("{0}")]
    #[hint(inner = 1)]
    #[fault(Environment)]
    Folder(String, #[source] io::Error),
    /// The file cannot be written.
    #[error(transparent)]
    File(#[from] FileError),
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_input_is_not_overwritten_by_any_of_its_names() {
        let folder = tempfile::tempdir().unwrap();
        let input = folder.path().join("a.xlsx");
        std::fs::write(&input, b"one").unwrap();
        let sheet = PathBuf::from(format!("{}#White", input.display()));
        let other_name = folder.path().join(".").join("a.xlsx");
        for inputs in [[sheet], [input.clone()]] {
            let error = Output::open(&other_name, &inputs).unwrap_err();
            assert!(error.to_string().ends_with("is an input file, which is never overwritten"));
        }
        let named = Output::with_ending(&folder.path().join("b.jpg"), &["png", "tif"], &[]);
        let error = named.unwrap_err();
        assert!(error.to_string().ends_with("that ends in .png or .tif"), "{error}");
        assert!(error.hint().unwrap().to_string().ends_with("b.png"), "{error:?}");
    }

    #[cfg(unix)]
    #[test]
    fn links_are_followed_and_stay_below_a_folder() {
        use std::os::unix::fs::symlink;

        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        std::fs::create_dir_all(at("inside/deep")).unwrap();
        for (link, to) in [
            ("inside/dangling.png", "deep/new.png"),
            ("inside/again.png", "dangling.png"),
            ("inside/out.png", "../victim.png"),
            ("inside/up", ".."),
            ("inside/gone", "../missing"),
            ("inside/circle.png", "circle.png"),
        ] {
            symlink(to, at(link)).unwrap();
        }
        let again = Output::open(&at("inside/again.png"), &[]).unwrap();
        let new = Output::open(&at("inside/deep/new.png"), &[]).unwrap();
        assert!(again.is_same_as(&new) && !again.replaces());
        again.put("one").unwrap();
        assert!(new.replaces() && at("inside/again.png").is_symlink());
        assert!(at("inside/dangling.png").is_symlink());
        assert_eq!(std::fs::read(at("inside/deep/new.png")).unwrap(), b"one");
        assert!(Output::open(&at("inside/circle.png"), &[]).is_err(), "links in a circle");

        let inside = at("inside");
        for name in ["a.png", "deep/b.png", "new/c.png", "dangling.png", "again.png"] {
            Output::below(&inside, Path::new(name), &[]).unwrap();
        }
        for name in ["out.png", "up/d.png", "gone/e.png", "up/new/f.png", "../g.png"] {
            let error = Output::below(&inside, Path::new(name), &[]).unwrap_err();
            assert!(matches!(error, OutputError::Outside { .. }), "{name}: {error}");
        }
        assert!(!at("inside/new").exists(), "the check makes no folder");
    }

    #[test]
    fn a_folder_is_made_with_its_first_file() {
        let folder = tempfile::tempdir().unwrap();
        let inner = OutputFolder::open(&folder.path().join("a/b"), &[]).unwrap();
        inner.check(["c".to_owned()]).unwrap();
        assert!(!inner.path().exists(), "the check leaves nothing behind");
        inner.outputs(["c".to_owned()]).unwrap()[0].put("text").unwrap();
        let below = OutputFolder::open(&inner.file("c"), &[]).unwrap_err();
        assert!(below.to_string().ends_with("c is a file"), "{below}");
    }
}
