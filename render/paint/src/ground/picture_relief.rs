//! Relief taken from the grey values of a picture.

use std::io::Cursor;

use image::{ImageReader, Limits};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::error::{GroundError, check_range};
use graphics::field::Field;
use graphics::picture_formats::{CUT_OFF, is_cut_off_jpeg};

/// Relief from a grey picture with 8 or 16 bits, stretched over the canvas. Heights are
/// proportional to the stored values: black is 0, white is `depth_mm`. Coloured pictures
/// are converted to luma.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PictureRelief {
    /// Path of the picture, a PNG, JPEG, TIFF or WebP file.
    pub path: String,
    /// Height of white in mm, 0 to 20; 0.2 by default.
    #[serde(default = "default_depth_mm")]
    pub depth_mm: f64,
}

fn default_depth_mm() -> f64 {
    0.2
}

/// Greatest width and height of the picture, in pixels.
const LARGEST: u32 = 16384;

impl PictureRelief {
    /// Heights in mm of `width` x `height` cells, by bilinear interpolation.
    ///
    /// # Errors
    /// [`GroundError`] for a depth out of range or a picture that cannot be read.
    pub fn heights_mm(&self, width: usize, height: usize) -> Result<Field<f32>, GroundError> {
        let depth = check_range("depth_mm", " mm", self.depth_mm, [0.0, 20.0])? as f32;
        let picture = self.read()?;
        let columns = picture.width() as usize;
        let rows = picture.height() as usize;
        // For each cell: two neighbouring pixels, and the share of the second.
        let interpolation = |cells: usize, pixels: usize| -> Vec<(usize, usize, f32)> {
            let last = pixels as f64 - 1.0;
            (0..cells)
                .map(|cell: usize| {
                    let place = (cell as f64 + 0.5) / cells as f64 * pixels as f64 - 0.5;
                    let place = place.clamp(0.0, last);
                    let first = place as usize;
                    (first, (first + 1).min(pixels - 1), (place - first as f64) as f32)
                })
                .collect()
        };
        let across = interpolation(width, columns);
        let down = interpolation(height, rows);
        let values = picture.as_raw();
        let scale = depth / f32::from(u16::MAX);
        let mut heights = Field::filled(width, height, 0.0);
        heights.values_mut().par_iter_mut().enumerate().for_each(|(index, out)| {
            let (left, right, share_x) = across[index % width];
            let (top, bottom, share_y) = down[index / width];
            let row = |y: usize| {
                let [a, b] = [left, right].map(|x| f32::from(values[y * columns + x]));
                a + (b - a) * share_x
            };
            *out = scale * (row(top) + (row(bottom) - row(top)) * share_y);
        });
        Ok(heights)
    }

    fn read(&self) -> Result<image::ImageBuffer<image::Luma<u16>, Vec<u16>>, GroundError> {
        let rejected = |reason: String| GroundError::Picture { path: self.path.clone(), reason };
        let bytes =
            documents::file::disk::read(&self.path).map_err(|error| rejected(error.to_string()))?;
        if is_cut_off_jpeg(&bytes) {
            return Err(rejected(CUT_OFF.to_owned()));
        }
        let mut reader = ImageReader::new(Cursor::new(bytes))
            .with_guessed_format()
            .map_err(|error| rejected(error.to_string()))?;
        let mut limits = Limits::default();
        limits.max_image_width = Some(LARGEST);
        limits.max_image_height = Some(LARGEST);
        reader.limits(limits);
        let picture = reader.decode().map_err(|error| rejected(error.to_string()))?.into_luma16();
        if picture.is_empty() {
            return Err(rejected("the picture has no pixels".to_owned()));
        }
        Ok(picture)
    }
}
