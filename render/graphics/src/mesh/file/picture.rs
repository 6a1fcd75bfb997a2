//! Texture images of models.

use std::io::Cursor;

use image::{ImageReader, Limits};

use crate::jpeg_end::{CUT_OFF, is_cut_off_jpeg};
use crate::mesh::model::Texture;

/// Longest side of an accepted texture, in texels: the usual limit of graphics devices.
const LONGEST: u32 = 16_384;

impl Texture {
    /// Decodes a PNG, JPEG, TIFF or WebP image; the error is the decoder's reason.
    pub(super) fn from_bytes(bytes: &[u8]) -> Result<Self, String> {
        if is_cut_off_jpeg(bytes) {
            return Err(CUT_OFF.to_owned());
        }
        let mut reader = ImageReader::new(Cursor::new(bytes))
            .with_guessed_format()
            .map_err(|error| error.to_string())?;
        let mut limits = Limits::default();
        limits.max_image_width = Some(LONGEST);
        limits.max_image_height = Some(LONGEST);
        reader.limits(limits);
        let picture = reader.decode().map_err(|error| error.to_string())?.into_rgba8();
        let (width, height) = picture.dimensions();
        let texels = picture.pixels().map(|pixel| u32::from_le_bytes(pixel.0)).collect();
        Ok(Self { width, height, texels })
    }
}
