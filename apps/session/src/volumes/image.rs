//! A picture of a scene as it is exported.

use graphics::export::{PictureFormat, picture_file};
use graphics::field::Field;
use paint::document::Document;
use paint::engine::PaintEngine;
use paint::light::Light;
use paint::painting::Painting;

use crate::failure::FileFailure;

/// Width of a pixel of a drawing in mm: 96 to the inch, as the command line has it.
const PIXEL_MM: f64 = 25.4 / 96.0;

/// A picture of a scene with all samples. The command line makes the same bytes of the recording.
#[derive(Debug, Clone, PartialEq)]
pub struct SceneImage {
    /// Linear sRGB and opacity, row by row.
    pub pixels: Field<[f32; 4]>,
    /// Width of a pixel in mm.
    pub pixel_mm: f64,
}

impl SceneImage {
    /// A drawing in linear sRGB.
    pub(super) fn drawing(pixels: Field<[f32; 4]>) -> Self {
        Self { pixels, pixel_mm: PIXEL_MM }
    }

    /// The picture of a painting, one pixel for each of its cells.
    ///
    /// # Errors
    /// [`FileFailure`] for a light that cannot be used with its library.
    pub(super) fn of_painting(document: Document) -> Result<Self, FileFailure> {
        let lighting = &document.lighting;
        let light = Light::named(&document.library, &lighting.illuminant, &lighting.observer);
        let light = light.map_err(|error| FileFailure::explained(&error))?;
        let engine = PaintEngine::on_cpu(document.ground.height.clone());
        let pixel_mm = document.cell_mm;
        let pixels = Painting::open_under(document, light, engine, 0)
            .and_then(|mut painting| painting.picture())
            .map_err(|error| FileFailure::explained(&error))?;
        Ok(Self { pixels, pixel_mm })
    }

    /// The bytes of its file.
    ///
    /// # Errors
    /// [`FileFailure`] if it is too large for the format.
    pub fn file(&self, format: PictureFormat) -> Result<Vec<u8>, FileFailure> {
        let file = picture_file(&self.pixels, self.pixel_mm, format);
        Ok(file.map_err(|error| FileFailure::explained(&error))?.bytes)
    }
}
