//! A folder of OpenEXR frames.

use std::path::{Path, PathBuf};

use crate::console::Console;
use crate::failure::{Failure, Result};
use crate::output::{Output, OutputFolder};

/// A folder that a number of frames can be written to.
pub(super) struct ExrFrames {
    folder: OutputFolder,
    frames: usize,
    inputs: Vec<PathBuf>,
}

impl ExrFrames {
    /// Checks that the frames can be written, and that the folder has none beyond them, which would be
    /// of another animation.
    pub(super) fn open(folder: &Path, frames: usize, inputs: &[PathBuf]) -> Result<Self> {
        let folder = OutputFolder::open(folder, inputs)?;
        let beyond = folder.file(&name(frames));
        if beyond.exists() {
            return Err(Failure::usage(
                format!("{}: a frame of another animation", beyond.display()),
                "name an empty folder, or remove its frames",
            ));
        }
        folder.check((0..frames).map(name))?;
        Ok(Self { folder, frames, inputs: inputs.to_vec() })
    }

    /// Writes the frames in order, each whole. The folder is made when the first is ready.
    pub(super) fn write(
        self,
        console: &mut Console<'_>,
        mut frame: impl FnMut(usize) -> Result<Vec<u8>>,
    ) -> Result<()> {
        for index in 0..self.frames {
            let content = frame(index)?;
            self.folder.make()?;
            Output::open(&self.folder.file(&name(index)), &self.inputs)?.put(content)?;
        }
        self.folder.told(console)
    }
}

/// Name of the frame with this index, counted from 1.
fn name(index: usize) -> String {
    format!("frame-{:04}.exr", index + 1)
}
