//! A folder of stages: pictures in order, numbered from 1.

use std::path::{Path, PathBuf};

use crate::failure::Result;
use crate::output::{Output, create_folder};

/// A folder that stages can be written into.
pub(crate) struct StageFolder {
    folder: PathBuf,
    inputs: Vec<PathBuf>,
}

impl StageFolder {
    /// Creates the folder and checks that a stage can be written there.
    pub(crate) fn open(folder: &Path, inputs: &[PathBuf]) -> Result<Self> {
        create_folder(folder)?;
        let own = Self { folder: folder.to_owned(), inputs: inputs.to_vec() };
        own.output((1, "stage"))?;
        Ok(own)
    }

    /// Outputs of stages of these names, numbered from 1. All are opened first, so that nothing is
    /// written if one cannot be.
    pub(crate) fn outputs<'a>(&self, names: impl Iterator<Item = &'a str>) -> Result<Vec<Output>> {
        (1..).zip(names).map(|stage| self.output(stage)).collect()
    }

    fn output(&self, (number, name): (usize, &str)) -> Result<Output> {
        Output::open(&self.folder.join(format!("{number:02}-{name}.png")), &self.inputs)
    }
}
