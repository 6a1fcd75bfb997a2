//! Output files and folders of output. We check them before the slow part of a verb, and write a
//! file whole or not at all.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use documents::file::{FileAction, FileError, STANDARD_INPUT, check_writable, write_whole};
use graphics::encoding::over_white;
use graphics::export::{frame_of, frame_png};
use paint::technique::Stage;

use crate::console::Console;
use crate::failure::{Context, Failure, Result};

/// Creates `folder` and its missing parents.
pub(crate) fn create_folder(folder: &Path) -> Result<()> {
    std::fs::create_dir_all(folder)
        .context(|| format!("{}: this folder cannot be created", folder.display()))
}

/// A folder for outputs, checked to be writable. It is made when the first of them is written, so
/// that a failure before leaves nothing behind.
pub(crate) struct OutputFolder {
    folder: PathBuf,
    inputs: Vec<PathBuf>,
}

impl OutputFolder {
    /// Checks that `folder` can be written to, or can be made where it is missing.
    pub(crate) fn open(folder: &Path, inputs: &[PathBuf]) -> Result<Self> {
        let whole = std::path::absolute(folder).unwrap_or_else(|_| folder.to_owned());
        let there = whole.ancestors().find(|part| part.exists()).unwrap_or(&whole);
        let words = match there == whole && there.is_dir() {
            true => format!("{}: nothing can be written into this folder", folder.display()),
            false => format!("{}: this folder cannot be created", folder.display()),
        };
        if there.is_file() {
            let reason = format!("{words}: {} is a file", there.display());
            return Err(Failure::usage(reason, "name another folder"));
        }
        // The file that the check names is not one of the user's.
        if let Err(error) = check_writable(&there.join(".impasto")) {
            return Err(Failure::from(std::io::Error::from(error.reason.kind())).within(words));
        }
        Ok(Self { folder: folder.to_owned(), inputs: inputs.to_vec() })
    }

    /// Reports that the folder was written.
    pub(crate) fn told(&self, console: &mut Console<'_>) -> Result<()> {
        console.wrote(&self.folder)
    }

    /// Path of a file in it.
    pub(crate) fn file(&self, name: &str) -> PathBuf {
        self.folder.join(name)
    }

    /// Checks that files of these names can be written.
    pub(crate) fn check(&self, names: impl IntoIterator<Item = String>) -> Result<()> {
        if !self.folder.exists() {
            return Ok(());
        }
        names.into_iter().try_for_each(|name| self.output(&name).map(drop))
    }

    /// Makes the folder.
    pub(crate) fn make(&self) -> Result<()> {
        create_folder(&self.folder)
    }

    /// Makes the folder and returns outputs of these names. We open all of them first. If one
    /// cannot be opened, nothing is written.
    pub(crate) fn outputs(&self, names: impl IntoIterator<Item = String>) -> Result<Vec<Output>> {
        self.make()?;
        names.into_iter().map(|name| self.output(&name)).collect()
    }

    fn output(&self, name: &str) -> Result<Output> {
        Output::open(&self.file(name), &self.inputs)
    }
}

/// An output file that was checked to be writable.
pub(crate) struct Output {
    /// Path as the user gave it.
    path: PathBuf,
    /// Path with symbolic links resolved.
    target: PathBuf,
}

impl Output {
    /// Checks that `path` can be written and is not one of `inputs`. The path `-` is the output of the
    /// results.
    pub(crate) fn open(path: &Path, inputs: &[PathBuf]) -> Result<Self> {
        if is_stream(path) {
            return Ok(Self { path: path.to_owned(), target: path.to_owned() });
        }
        let target = path.canonicalize().or_else(|_| std::path::absolute(path));
        let target = target.map_err(|reason| FileError {
            path: path.to_owned(),
            action: FileAction::Write,
            reason: Arc::new(reason),
        })?;
        if target.exists() && !target.is_file() {
            return Err(Failure::usage(
                format!("{}: expected a regular file", path.display()),
                "name a file, or - to write to the output",
            ));
        }
        let is_target = |input: &PathBuf| {
            // An input may name a sheet of its file.
            let file = input.to_str().map_or(input.as_path(), |text| {
                Path::new(spectra::instrument::split_file_and_sheet(text).0)
            });
            file.canonicalize().is_ok_and(|input| input == target)
        };
        if inputs.iter().any(is_target) {
            return Err(Failure::usage(
                format!("{}: is an input file, which is never overwritten", path.display()),
                "give the output another file name",
            ));
        }
        check_writable(path)?;
        Ok(Self { path: path.to_owned(), target })
    }

    /// Checks that `path` has one of `endings` and can be written, like [`Output::open`].
    pub(crate) fn with_ending(path: &Path, endings: &[&str], inputs: &[PathBuf]) -> Result<Self> {
        if is_stream(path) {
            return Self::open(path, inputs);
        }
        let extension = path.extension().map(|e| e.to_string_lossy().to_lowercase());
        if !endings.iter().any(|ending| extension.as_deref() == Some(ending)) {
            return Err(Failure::usage(
                format!(
                    "{}: expected a file name that ends in .{}",
                    path.display(),
                    endings.join(" or .")
                ),
                format!("try {}", path.with_extension(endings[0]).display()),
            ));
        }
        Self::open(path, inputs)
    }

    /// Path as the user gave it.
    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// Failure for an output that has the same file as another one.
    pub(crate) fn used_twice(&self) -> Failure {
        Failure::usage(
            format!("{}: two outputs have this file name", self.path.display()),
            "give each output its own file name",
        )
    }

    /// Whether both outputs are the same file.
    pub(crate) fn is_same_as(&self, other: &Self) -> bool {
        self.target == other.target
    }

    /// Replaces the file by `content`, or creates it, and reports this.
    pub(crate) fn write(self, content: impl AsRef<[u8]>, console: &mut Console<'_>) -> Result<()> {
        if is_stream(&self.path) {
            return console.stream(content.as_ref());
        }
        self.put(content)?;
        console.wrote(&self.path)
    }

    /// Replaces the file by `content`, or creates it. Use this for files of a folder that we report
    /// as one.
    pub(crate) fn put(&self, content: impl AsRef<[u8]>) -> Result<()> {
        Ok(write_whole(&self.path, content.as_ref())?)
    }
}

/// Whether `path` is the output of the results: `-`.
pub(crate) fn is_stream(path: &Path) -> bool {
    path == Path::new(STANDARD_INPUT)
}

/// A folder that you can write stages to. We make it with the first stage.
pub(crate) struct StageFolder(OutputFolder);

impl StageFolder {
    /// Checks that files in the folder can be written.
    pub(crate) fn open(folder: &Path, inputs: &[PathBuf]) -> Result<Self> {
        let folder = OutputFolder::open(folder, inputs)?;
        folder.check([file_name(1, "stage")])?;
        Ok(Self(folder))
    }

    /// Outputs for stages of these names, numbered from 1. We open all of them first. If one cannot
    /// be opened, nothing is written.
    pub(crate) fn outputs<'a>(&self, names: impl Iterator<Item = &'a str>) -> Result<Vec<Output>> {
        self.0.outputs((1..).zip(names).map(|(number, name)| file_name(number, name)))
    }

    /// Reports that the folder was written.
    pub(crate) fn told(&self, console: &mut Console<'_>) -> Result<()> {
        self.0.told(console)
    }

    /// Writes the stages.
    pub(crate) fn write(&self, stages: &[Stage], console: &mut Console<'_>) -> Result<()> {
        let outputs = self.outputs(stages.iter().map(|stage| stage.name.as_str()))?;
        for (output, stage) in outputs.into_iter().zip(stages) {
            output.put(frame_png(&frame_of(&over_white(&stage.picture)))?)?;
        }
        self.told(console)
    }
}

fn file_name(number: usize, name: &str) -> String {
    format!("{number:02}-{name}.png")
}
