//! A folder of intermediate stages as PNG.

use std::path::{Path, PathBuf};

use graphics::encoding::over_white;
use graphics::export::{frame_of, frame_png};
use graphics::field::Field;

use crate::console::Console;
use crate::failure::Result;
use crate::output::{Output, OutputFolder};

/// The name of a stage and its picture, encoded sRGB with coverage.
pub(crate) type NamedStage = (String, Field<[f32; 4]>);

/// A folder that stages can be written to; it is made with the first.
pub(crate) struct StageFolder(OutputFolder);

impl StageFolder {
    /// Checks that files in the folder can be written.
    pub(crate) fn open(folder: &Path, inputs: &[PathBuf]) -> Result<Self> {
        let folder = OutputFolder::open(folder, inputs)?;
        folder.check([file_name(1, "stage")])?;
        Ok(Self(folder))
    }

    /// Outputs of stages of these names, numbered from 1. All are opened first, so that nothing is
    /// written if one cannot be.
    pub(crate) fn outputs<'a>(&self, names: impl Iterator<Item = &'a str>) -> Result<Vec<Output>> {
        self.0.outputs((1..).zip(names).map(|(number, name)| file_name(number, name)))
    }

    /// Tells that the folder was written.
    pub(crate) fn told(&self, console: &mut Console<'_>) -> Result<()> {
        self.0.told(console)
    }

    /// Writes the stages.
    pub(crate) fn write(&self, stages: &[NamedStage], console: &mut Console<'_>) -> Result<()> {
        let outputs = self.outputs(stages.iter().map(|(name, _)| name.as_str()))?;
        for (output, (_, picture)) in outputs.into_iter().zip(stages) {
            output.put(frame_png(&frame_of(&over_white(picture)))?)?;
        }
        self.told(console)
    }
}

fn file_name(number: usize, name: &str) -> String {
    format!("{number:02}-{name}.png")
}
