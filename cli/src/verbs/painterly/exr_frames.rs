//! A folder of OpenEXR frames.

use std::path::{Path, PathBuf};

use crate::console::Console;
use crate::failure::{Failure, Result};
use crate::output::{Output, create_folder};

/// A folder that a number of frames can be written to.
pub(super) struct ExrFrames {
    folder: PathBuf,
    outputs: Vec<Output>,
}

impl ExrFrames {
    /// Makes the folder, and checks that it has no frames beyond those that are to be written, which
    /// would be of another animation.
    pub(super) fn open(folder: &Path, frames: usize, inputs: &[PathBuf]) -> Result<Self> {
        create_folder(folder)?;
        let path = |index: usize| folder.join(format!("frame-{:04}.exr", index + 1));
        let beyond = path(frames);
        if beyond.exists() {
            return Err(Failure::usage(
                format!("{}: a frame of another animation", beyond.display()),
                "name an empty folder, or remove its frames",
            ));
        }
        let outputs = (0..frames).map(|index| Output::open(&path(index), inputs));
        Ok(Self { folder: folder.to_owned(), outputs: outputs.collect::<Result<_>>()? })
    }

    /// Writes the frames in order, each whole.
    pub(super) fn write(
        self,
        console: &mut Console<'_>,
        mut frame: impl FnMut(usize) -> Result<Vec<u8>>,
    ) -> Result<()> {
        for (index, output) in self.outputs.into_iter().enumerate() {
            output.put(frame(index)?)?;
        }
        console.wrote(&self.folder)
    }
}
