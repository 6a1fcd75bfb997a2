//! Output files: samples or a map, and their sheet.

use std::path::{Path, PathBuf};

use graphics::picture::Picture;

use crate::console::Console;
use crate::failure::Result;
use crate::output::Output;
use crate::plain_picture::{picture_bytes, picture_output, refuse_same};

/// A file of samples or a map and its sheet, checked to be writable.
pub(super) struct FileAndSheet {
    file: Output,
    sheet: Option<Output>,
}

impl FileAndSheet {
    /// Checks, before the slow part of a verb, that both files can be written.
    pub(super) fn open(file: &Path, sheet: Option<&Path>, inputs: &[PathBuf]) -> Result<Self> {
        let file = Output::with_ending(file, &["exr"], inputs)?;
        let sheet = picture_output(sheet, inputs)?;
        refuse_same(&[Some(&file), sheet.as_ref()])?;
        Ok(Self { file, sheet })
    }

    /// Writes both files, once both are encoded. `sheet` draws the sheet if one is wanted.
    pub(super) fn write(
        self,
        bytes: Vec<u8>,
        sheet: impl FnOnce() -> Picture,
        console: &mut Console<'_>,
    ) -> Result<()> {
        let sheet = match self.sheet {
            Some(output) => Some((picture_bytes(&sheet(), &output, console)?, output)),
            None => None,
        };
        self.file.write(bytes, console)?;
        match sheet {
            Some((bytes, output)) => output.write(bytes, console),
            None => Ok(()),
        }
    }

    pub(super) fn outputs(&self) -> [Option<&Output>; 2] {
        [Some(&self.file), self.sheet.as_ref()]
    }
}
