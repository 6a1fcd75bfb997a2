//! Relief from a picture.

use image::{ImageReader, Limits};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::{GroundError, within};
use graphics::field::Field;

/// Heights from a grey picture of 8 or 16 bits, stretched over the canvas: black
/// is 0, white is `depth_mm`, and in between the numbers count as they stand. Of
/// a coloured picture its luma is taken.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PictureRelief {
    /// The file, a PNG or JPEG.
    pub path: String,
    /// The height of white, in mm.
    #[serde(default = "usual_depth")]
    pub depth_mm: f64,
}

fn usual_depth() -> f64 {
    0.2
}

/// The most pixels on a side.
const LARGEST: u32 = 16384;

impl PictureRelief {
    /// Heights over `width` x `height` cells, in mm, by straight lines between
    /// the pixels.
    ///
    /// # Errors
    /// [`GroundError`] for a depth out of range or a picture that cannot be read.
    pub fn heights_mm(&self, width: usize, height: usize) -> Result<Field<f32>, GroundError> {
        let depth = within("depth_mm", " mm", self.depth_mm, [0.0, 20.0])? as f32;
        let picture = self.read()?;
        let (columns, rows) = (picture.width() as usize, picture.height() as usize);
        // By cell: two pixels and the share of the second.
        let between = |cells: usize, pixels: usize| -> Vec<(usize, usize, f32)> {
            let last = pixels as f64 - 1.0;
            let place = |cell: usize| {
                let place = (cell as f64 + 0.5) / cells as f64 * pixels as f64 - 0.5;
                let place = place.clamp(0.0, last);
                let first = place as usize;
                (first, (first + 1).min(pixels - 1), (place - first as f64) as f32)
            };
            (0..cells).map(place).collect()
        };
        let (across, down) = (between(width, columns), between(height, rows));
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
        let told = |reason: String| GroundError::Picture { path: self.path.clone(), reason };
        let reader = ImageReader::open(&self.path).map_err(|error| told(error.to_string()))?;
        let mut reader = reader.with_guessed_format().map_err(|error| told(error.to_string()))?;
        let mut limits = Limits::default();
        limits.max_image_width = Some(LARGEST);
        limits.max_image_height = Some(LARGEST);
        reader.limits(limits);
        let picture = reader.decode().map_err(|error| told(error.to_string()))?.into_luma16();
        if picture.is_empty() {
            return Err(told("the picture has no pixels".to_owned()));
        }
        Ok(picture)
    }
}
