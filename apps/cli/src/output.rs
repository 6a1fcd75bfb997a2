//! Output files and folders as verbs use them. Errors become failures of the verb, and we report what
//! was written.

use std::{
    ops::Deref,
    path::{Path, PathBuf},
};

use documents::file;

use crate::console::Console;
use crate::failure::Result;

/// A folder for outputs, checked to be writable ([`file::OutputFolder`]).
pub(crate) struct OutputFolder(file::OutputFolder);

impl OutputFolder {
    pub(crate) fn open(folder: &Path, inputs: &[PathBuf]) -> Result<Self> {
        Ok(Self(file::OutputFolder::open(folder, inputs)?))
    }

    /// Reports that the folder was written.
    pub(crate) fn told(&self, console: &mut Console<'_>) -> Result<()> {
        console.wrote(self.0.path())
    }

    pub(crate) fn check(&self, names: impl IntoIterator<Item = String>) -> Result<()> {
        Ok(self.0.check(names)?)
    }

    /// Makes the folder.
    pub(crate) fn make(&self) -> Result<()> {
        Ok(self.0.make()?)
    }

    /// Makes the folder and returns outputs of these names.
    pub(crate) fn outputs(&self, names: impl IntoIterator<Item = String>) -> Result<Vec<Output>> {
        Ok(self.0.outputs(names)?.into_iter().map(Output).collect())
    }
}

impl Deref for OutputFolder {
    type Target = file::OutputFolder;

    fn deref(&self) -> &file::OutputFolder {
        &self.0
    }
}

/// An output file that was checked to be writable ([`file::Output`]).
pub(crate) struct Output(file::Output);

impl Output {
    pub(crate) fn open(path: &Path, inputs: &[PathBuf]) -> Result<Self> {
        Ok(Self(file::Output::open(path, inputs)?))
    }

    pub(crate) fn with_ending(
        path: &Path,
        endings: &[&'static str],
        inputs: &[PathBuf],
    ) -> Result<Self> {
        Ok(Self(file::Output::with_ending(path, endings, inputs)?))
    }

    /// Replaces the file by `content`, or creates it, and reports this.
    pub(crate) fn write(self, content: impl AsRef<[u8]>, console: &mut Console<'_>) -> Result<()> {
        if self.is_stream() {
            return console.stream(content.as_ref());
        }
        self.put(content)?;
        console.wrote(self.path())
    }

    /// Replaces the file by `content`, or creates it. Use this for files of a folder that we report
    /// as one.
    pub(crate) fn put(&self, content: impl AsRef<[u8]>) -> Result<()> {
        Ok(self.0.put(content)?)
    }
}

impl Deref for Output {
    type Target = file::Output;

    fn deref(&self) -> &file::Output {
        &self.0
    }
}
