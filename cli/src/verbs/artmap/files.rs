//! Output files: samples, maps, and pictures to look at.

use std::path::{Path, PathBuf};

use render::export::{PictureFormat, picture_file};
use render::field::Field;
use render::picture::Picture;

use crate::console::Console;
use crate::failure::{Failure, Result};
use crate::output::Output;
use crate::pictures::gamut_remark;

/// Width of a pixel of a picture to look at, in mm: 96 to the inch.
const PX_MM: f64 = 25.4 / 96.0;

/// Opens the output of a picture to look at.
pub(super) fn picture_output(path: Option<&Path>, inputs: &[PathBuf]) -> Result<Option<Output>> {
    path.map(|path| Output::with_ending(path, &["png", "exr"], inputs)).transpose()
}

/// Refuses two outputs of one file name.
pub(super) fn refuse_same(outputs: &[Option<&Output>]) -> Result<()> {
    let outputs: Vec<&Output> = outputs.iter().copied().flatten().collect();
    for (index, output) in outputs.iter().enumerate() {
        if outputs[..index].iter().any(|other| output.is_same_as(other)) {
            return Err(Failure::usage(
                format!("{}: two outputs have this file name", output.path().display()),
                "give each output its own file name",
            ));
        }
    }
    Ok(())
}

/// Encodes a picture of linear sRGB for `output`, with a remark on colours that it cannot hold.
pub(super) fn picture_bytes(
    picture: &Picture,
    output: &Output,
    console: &mut Console<'_>,
) -> Result<Vec<u8>> {
    let opaque = picture.values().iter().map(|&[r, g, b]| [r, g, b, 1.0]).collect();
    let opaque = Field::from_values(picture.width(), picture.height(), opaque);
    let format = PictureFormat::from_path(output.path()).unwrap_or_default();
    let file = picture_file(&opaque, PX_MM, format)?;
    if let Some(outside) = file.outside_gamut() {
        console.remark(gamut_remark(output.path(), outside))?;
    }
    Ok(file.bytes)
}

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
        self.file.write(bytes)?;
        match sheet {
            Some((bytes, output)) => output.write(bytes),
            None => Ok(()),
        }
    }

    pub(super) fn outputs(&self) -> [Option<&Output>; 2] {
        [Some(&self.file), self.sheet.as_ref()]
    }
}
