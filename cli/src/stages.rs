//! A folder of intermediate stages as PNG.

use std::path::{Path, PathBuf};

use render::encoding::over_white;
use render::export::{frame_of, frame_png};
use render::field::Field;

use crate::failure::Result;
use crate::output::{Output, create_folder};

/// The name of a stage and its picture, encoded sRGB with coverage.
pub(crate) type NamedStage = (String, Field<[f32; 4]>);

/// A folder that stages can be written to.
pub(crate) struct StageFolder {
    folder: PathBuf,
    inputs: Vec<PathBuf>,
}

impl StageFolder {
    /// Makes the folder, and checks that files in it can be written.
    pub(crate) fn open(folder: &Path, inputs: &[PathBuf]) -> Result<Self> {
        create_folder(folder)?;
        let own = Self { folder: folder.to_owned(), inputs: inputs.to_vec() };
        own.output(1, "stage")?;
        Ok(own)
    }

    /// Outputs of stages of these names, numbered from 1. All are opened first, so that nothing is
    /// written if one cannot be.
    pub(crate) fn outputs<'a>(&self, names: impl Iterator<Item = &'a str>) -> Result<Vec<Output>> {
        (1..).zip(names).map(|(number, name)| self.output(number, name)).collect()
    }

    /// Writes the stages.
    pub(crate) fn write(&self, stages: &[NamedStage]) -> Result<()> {
        let outputs = self.outputs(stages.iter().map(|(name, _)| name.as_str()))?;
        for (output, (_, picture)) in outputs.into_iter().zip(stages) {
            output.write(frame_png(&frame_of(&over_white(picture)))?)?;
        }
        Ok(())
    }

    fn output(&self, number: usize, name: &str) -> Result<Output> {
        Output::open(&self.folder.join(format!("{number:02}-{name}.png")), &self.inputs)
    }
}
