//! The picture that samples are taken from: a photograph, or a painting of impasto.

use std::path::Path;

use artmap::passages::SourcePicture;
use artmap::sample::WholePainting;
use graphics::picture::Photograph;
use paint::document::Document;

use crate::console::Console;
use crate::failure::Result;

/// Last part of a path, as text.
pub(super) fn file_name(path: &Path) -> String {
    path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
}

/// Reads the picture at `path`. A painting (.exr) keeps its paint and relief; with `merge_minor`,
/// pigments below 1 % count as others if there are more than eight.
pub(super) fn source(
    path: &Path,
    merge_minor: bool,
    console: &mut Console<'_>,
) -> Result<SourcePicture> {
    if path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("exr")) {
        let painting = WholePainting::of(&Document::open(path)?, merge_minor)?;
        for [minor, into] in &painting.merged {
            console.remark(format!("{minor} is below 1 % of the pigment and counts as {into}"))?;
        }
        return Ok(SourcePicture::of_painting(painting));
    }
    let photograph = Photograph::open(path)?;
    let (width, height) = photograph.size();
    let provenance = format!("picture {}", file_name(path));
    Ok(SourcePicture::of_colors(photograph.on_canvas(width, height), provenance))
}
