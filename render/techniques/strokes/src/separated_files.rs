//! Files of a separation: a map of each pigment, and the picture that they make.

use graphics::export::{ExportError, png8};
use graphics::field::Field;
use paint::export::{NamedFile, PigmentMap, pigment_maps};
use paint::separation::{ColorErrors, rebuild_picture};
use pigment::library::to_text;
use serde_json::json;

use super::stroke_painter::StrokePainter;

/// Start of the file names.
const STEM: &str = "separation";

/// A photograph separated into pigments, as files in memory.
#[derive(Debug, Clone, PartialEq)]
pub struct SeparatedFiles {
    /// The files of [`pigment_maps`]; `separation.rebuilt.png`, the picture that the
    /// pigments make together; and `separation.errors.json`, its colour error.
    pub files: Vec<NamedFile>,
    /// Colour error of the rebuilt picture.
    pub error: ColorErrors,
}

impl StrokePainter {
    /// Separates the photograph into a map of each pigment. Write the files with
    /// [`save_files`](paint::export::save_files).
    ///
    /// # Errors
    /// [`ExportError`] if a file cannot be encoded.
    pub fn separate(&self) -> Result<SeparatedFiles, ExportError> {
        let separation = self.separation();
        let target = self.target();
        let heights = separation.separate(target);
        let width = target.width();
        let height = target.height();
        let map = |(slot, name): (usize, &String)| {
            let values = heights.values().iter().map(|cell| cell[slot]).collect();
            PigmentMap { name: name.clone(), height_mm: Field::from_values(width, height, values) }
        };
        let maps: Vec<PigmentMap> = self.pigments().iter().enumerate().map(map).collect();
        let picture = rebuild_picture(separation.film(), &heights);
        let error = ColorErrors::between(separation, target, &picture);
        let opaque = picture.values().iter().map(|&[red, green, blue]| [red, green, blue, 1.0]);
        let opaque = Field::from_values(width, height, opaque.collect());
        let mut files = pigment_maps(STEM, &maps, self.cell_mm())?;
        let errors = to_text(&json!({"palette": self.pigments(), "error": error}));
        files.extend([
            NamedFile {
                name: format!("{STEM}.rebuilt.png"),
                bytes: png8(&opaque, self.cell_mm())?.bytes,
            },
            NamedFile { name: format!("{STEM}.errors.json"), bytes: errors.into_bytes() },
        ]);
        Ok(SeparatedFiles { files, error })
    }
}
