//! Pictures that are no painting: sheets, pictures with marks, pictures in a map's brushwork.

use std::path::{Path, PathBuf};

use graphics::export::{PictureFormat, picture_file};
use graphics::field::Field;
use graphics::picture::Picture;

use crate::console::Console;
use crate::failure::{Failure, Result};
use crate::output::Output;
use crate::pictures::gamut_remark;

/// Width of a pixel of a picture to look at, in mm: 96 to the inch.
pub(crate) const PX_MM: f64 = 25.4 / 96.0;

/// Opens the output of a picture to look at.
pub(crate) fn picture_output(path: Option<&Path>, inputs: &[PathBuf]) -> Result<Option<Output>> {
    path.map(|path| Output::with_ending(path, &["png", "exr"], inputs)).transpose()
}

/// Refuses two outputs of one file name.
pub(crate) fn refuse_same(outputs: &[Option<&Output>]) -> Result<()> {
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
pub(crate) fn picture_bytes(
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
