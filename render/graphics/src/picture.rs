//! Photographs: PNG, JPEG, TIFF and WebP files, resampled to a canvas in linear light.

use std::io::Cursor;
use std::path::Path;

use documents::file::read;
use documents::hint::{Explain, Fault, Hint};
use image::{
    ColorType, DynamicImage, ExtendedColorType, ImageDecoder, ImageFormat, ImageReader, Limits,
};
use rayon::prelude::*;
use spectra::color::Rgb;

use crate::color_profile::{ProfileError, tiff_profile, to_srgb};
use crate::field::Field;
use crate::jpeg_end::{is_cut_off_jpeg, is_of_inks};
use crate::picture_formats::NAMES;

/// A picture in linear sRGB, white at 1, one colour per cell.
pub type Picture = Field<[f32; 3]>;

/// Most pixels of a photograph that is read: 2^27, about 11,500 x 11,500.
pub const MOST_PIXELS: u64 = 1 << 27;

/// Most bytes that the decoder may allocate: 1.5 GiB.
const MOST_BYTES: u64 = 3 << 29;

/// A decoded photograph, turned upright.
#[derive(Debug, Clone, PartialEq)]
pub struct Photograph {
    image: DynamicImage,
}

/// Longest side in pixels of a painting when nobody asks for a width.
const USUAL_LONGER_SIDE_PX: usize = 1600;

impl Photograph {
    /// Reads a PNG, JPEG, TIFF or WebP file, grey or colour, with 8 or 16 bits per channel. Its
    /// colours are converted by the ICC profile that it holds, without one taken as sRGB. The
    /// orientation in its EXIF data is applied.
    ///
    /// # Errors
    /// [`PhotographError`] with the path.
    pub fn open(path: &Path) -> Result<Self, PhotographError> {
        let name = path.display().to_string();
        let bytes = read(path).map_err(|error| {
            let error = std::io::Error::new(error.reason.kind(), error.reason.to_string());
            PhotographError::Unreadable { name: name.clone(), error }
        })?;
        Self::from_bytes(&name, &bytes)
    }

    /// Decodes the content of a PNG, JPEG, TIFF or WebP file; `name` stands for the path in errors.
    ///
    /// # Errors
    /// [`PhotographError`].
    pub fn from_bytes(name: &str, bytes: &[u8]) -> Result<Self, PhotographError> {
        let rejected = |error: image::ImageError| PhotographError::NoPicture {
            name: name.to_owned(),
            reason: error.to_string(),
        };
        if is_cut_off_jpeg(bytes) {
            return Err(PhotographError::CutOff { name: name.to_owned(), bytes: bytes.len() });
        }
        let mut reader = ImageReader::new(Cursor::new(bytes))
            .with_guessed_format()
            .map_err(|error| rejected(error.into()))?;
        let mut limits = Limits::no_limits();
        limits.max_alloc = Some(MOST_BYTES);
        reader.limits(limits);
        let mut decoder = reader.into_decoder().map_err(rejected)?;
        let (width, height) = decoder.dimensions();
        if u64::from(width) * u64::from(height) > MOST_PIXELS {
            return Err(PhotographError::TooLarge { name: name.to_owned(), width, height });
        }
        let refused = |reason| PhotographError::Profile { name: name.to_owned(), reason };
        let inks = [ExtendedColorType::Cmyk8, ExtendedColorType::Cmyk16];
        if inks.contains(&decoder.original_color_type()) || is_of_inks(bytes) {
            return Err(refused(ProfileError::Inks("CMYK".to_owned())));
        }
        let orientation = decoder.orientation().map_err(rejected)?;
        let profile = match image::guess_format(bytes) {
            Ok(ImageFormat::Tiff) => tiff_profile(bytes).map_err(|error| {
                PhotographError::NoPicture { name: name.to_owned(), reason: error.to_string() }
            })?,
            _ => decoder.icc_profile().map_err(rejected)?,
        };
        let mut image = DynamicImage::from_decoder(decoder).map_err(rejected)?;
        image.apply_orientation(orientation);
        if !matches!(sample_bytes(image.color()), 1 | 2) {
            image = image.into_rgba16().into();
        }
        if let Some(profile) = profile {
            image = to_srgb(image, &profile).map_err(refused)?;
        }
        Ok(Self { image })
    }

    /// Width in pixels of a painting of this photograph when nobody asks for one: the photograph's
    /// own width, or less, so that the longer side has at most 1600 pixels.
    #[must_use]
    pub fn usual_width_px(&self) -> usize {
        let (width, height) = self.size();
        let scale = (USUAL_LONGER_SIDE_PX as f64 / width.max(height) as f64).min(1.0);
        (scale * width as f64).round().max(1.0) as usize
    }

    /// Width and height in pixels.
    #[must_use]
    pub fn size(&self) -> (usize, usize) {
        (self.image.width() as usize, self.image.height() as usize)
    }

    /// Resamples the photograph to `width` x `height` cells, stretching it if the shapes
    /// differ: the mean linear light over each cell, transparent parts over white. Cells
    /// smaller than a pixel blend neighbouring pixels.
    ///
    /// # Panics
    /// If `width` or `height` is 0.
    #[must_use]
    pub fn on_canvas(&self, width: usize, height: usize) -> Picture {
        self.resampled(width, height, |[r, g, b, _]| [r, g, b].map(|value| value as f32))
    }

    /// Resamples the photograph like [`Photograph::on_canvas`], to encoded sRGB with
    /// opacity (both 0..1). The colour is that of the opaque part, white where there is none.
    ///
    /// # Panics
    /// If `width` or `height` is 0.
    #[must_use]
    pub fn with_opacity(&self, width: usize, height: usize) -> Field<[f32; 4]> {
        self.resampled(width, height, |[r, g, b, opacity]| {
            let opacity = opacity.clamp(0.0, 1.0);
            // Undo the blend with white.
            let unblended = |value: f64| ((value + opacity - 1.0) / opacity).clamp(0.0, 1.0);
            let color = if opacity > 0.0 { [r, g, b].map(unblended) } else { [1.0; 3] };
            let [r, g, b] = Rgb(color).encoded().0.map(|value| value as f32);
            [r, g, b, opacity as f32]
        })
    }

    /// Applies `cell` to the mean linear light over white, and opacity, of every cell.
    fn resampled<T: Clone + Default + Send>(
        &self,
        width: usize,
        height: usize,
        cell: impl Fn([f64; 4]) -> T + Sync,
    ) -> Field<T> {
        assert!(width > 0 && height > 0, "canvas of {width} x {height} cells");
        let (source_width, source_height) = self.size();
        let columns = Coverage::new(source_width, width);
        let rows = Coverage::new(source_height, height);
        let linear = LinearDecoder::new(self.image.color());
        let stride = source_width * linear.pixel_bytes;
        let bytes = self.image.as_bytes();
        let mut picture = Field::filled(width, height, T::default());
        picture.values_mut().par_chunks_mut(width).enumerate().for_each(|(y, row)| {
            let mut source = vec![[0.0; 4]; source_width];
            let mut sums = vec![[0.0_f64; 4]; width];
            for (line, weight) in rows.pixels_under(y) {
                linear.decode_row(&bytes[line * stride..][..stride], &mut source);
                for (x, sum) in sums.iter_mut().enumerate() {
                    for (pixel, share) in columns.pixels_under(x) {
                        for (sum, value) in sum.iter_mut().zip(source[pixel]) {
                            *sum += weight * share * value;
                        }
                    }
                }
            }
            for (found, sum) in row.iter_mut().zip(sums) {
                *found = cell(sum);
            }
        });
        picture
    }
}

/// Coverage of pixels by cells along one axis.
struct Coverage {
    pixels: usize,
    /// Pixel position of the first cell's edge: 0 up to rounding.
    first: f64,
    /// Pixels per cell.
    scale: f64,
}

impl Coverage {
    fn new(pixels: usize, cells: usize) -> Self {
        let scale = pixels as f64 / cells as f64;
        Self { pixels, first: (pixels as f64 - scale * cells as f64) / 2.0, scale }
    }

    /// Pixels under a cell with their weights, which sum to 1.
    fn pixels_under(&self, cell: usize) -> impl Iterator<Item = (usize, f64)> + use<> {
        let width = self.scale.max(1.0);
        let middle = self.first + (cell as f64 + 0.5) * self.scale;
        let limit = self.pixels as f64;
        let from = (middle - width / 2.0).max(0.0);
        let to = (middle + width / 2.0).min(limit);
        let last = (to.ceil() as usize).clamp(1, self.pixels) - 1;
        let first = (from as usize).min(last);
        (first..=last).map(move |pixel| {
            let covered = to.min(pixel as f64 + 1.0) - from.max(pixel as f64);
            (pixel, covered.max(0.0) / (to - from))
        })
    }
}

/// Decoder from the bytes of a pixel to linear light.
struct LinearDecoder {
    channels: usize,
    sample_bytes: usize,
    pixel_bytes: usize,
    /// Linear light of each possible sample value.
    decoded: Vec<f64>,
}

impl LinearDecoder {
    fn new(color: ColorType) -> Self {
        let sample_bytes = sample_bytes(color);
        let last = (1_usize << (8 * sample_bytes)) - 1;
        Self {
            channels: usize::from(color.channel_count()),
            sample_bytes,
            pixel_bytes: usize::from(color.bytes_per_pixel()),
            decoded: (0..=last)
                .map(|value: usize| Rgb([value as f64 / last as f64; 3]).linear().0[0])
                .collect(),
        }
    }

    /// Decodes a row to linear light over white, and opacity.
    fn decode_row(&self, bytes: &[u8], row: &mut [[f64; 4]]) {
        let last = (self.decoded.len() - 1) as f64;
        for (pixel, bytes) in row.iter_mut().zip(bytes.chunks_exact(self.pixel_bytes)) {
            let sample = |channel: usize| match self.sample_bytes {
                1 => usize::from(bytes[channel]),
                _ => usize::from(u16::from_ne_bytes([bytes[2 * channel], bytes[2 * channel + 1]])),
            };
            let color = match self.channels {
                1 | 2 => [self.decoded[sample(0)]; 3],
                _ => [0, 1, 2].map(|channel| self.decoded[sample(channel)]),
            };
            let opacity = match self.channels {
                2 => sample(1) as f64 / last,
                4 => sample(3) as f64 / last,
                _ => 1.0,
            };
            let [r, g, b] = color.map(|value| opacity * value + (1.0 - opacity));
            *pixel = [r, g, b, opacity];
        }
    }
}

fn sample_bytes(color: ColorType) -> usize {
    usize::from(color.bytes_per_pixel() / color.channel_count())
}

/// A photograph cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum PhotographError {
    /// The file cannot be opened or read.
    #[error("{name}: {error}")]
    Unreadable {
        /// Path of the file.
        name: String,
        /// Reason given by the system.
        error: std::io::Error,
    },
    /// The file is not a PNG, JPEG, TIFF or WebP picture, or is damaged.
    #[error("{name}: not a {NAMES} picture that can be read: {reason}")]
    NoPicture {
        /// Path of the file.
        name: String,
        /// Reason given by the decoder.
        reason: String,
    },
    /// The file is a JPEG picture that ends too early.
    #[error("{name}: the JPEG file is cut off after {bytes} bytes: its end marker is missing")]
    CutOff {
        /// Path of the file.
        name: String,
        /// Length of the file.
        bytes: usize,
    },
    /// The colours of the picture cannot be converted to sRGB.
    #[error("{name}: {reason}")]
    Profile {
        /// Path of the file.
        name: String,
        /// Which part cannot be converted.
        reason: ProfileError,
    },
    /// The picture has more than [`MOST_PIXELS`] pixels.
    #[error("{name}: a photograph has {MOST_PIXELS} pixels at most, found `{width} x {height}`")]
    TooLarge {
        /// Path of the file.
        name: String,
        /// Width in pixels.
        width: u32,
        /// Height in pixels.
        height: u32,
    },
}

impl Explain for PhotographError {
    fn hint(&self) -> Option<Hint> {
        Some(Hint::new(match self {
            Self::Unreadable { .. } => "check the path",
            Self::NoPicture { .. } => return Some(Hint::new(format!("save it as {NAMES}"))),
            Self::CutOff { .. } => {
                "copy or download the file again; the decoder would fill the missing part with grey"
            }
            Self::Profile { .. } => "convert it to sRGB in an image editor",
            Self::TooLarge { .. } => "make it smaller; a canvas has fewer cells",
        }))
    }

    fn fault(&self) -> Fault {
        match self {
            Self::Unreadable { .. } => Fault::Environment,
            _ => Fault::Input,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_that_is_cut_off_is_refused() {
        let picture = image::RgbImage::from_fn(90, 60, |x, y| image::Rgb([x as u8, y as u8, 200]));
        use image::ImageFormat::{Jpeg, Png, Tiff, WebP};
        for format in [Jpeg, Png, Tiff, WebP] {
            let mut whole = Cursor::new(Vec::new());
            picture.write_to(&mut whole, format).unwrap();
            let whole = whole.into_inner();
            assert!(Photograph::from_bytes("whole", &whole).is_ok(), "{format:?}");
            let cut = Photograph::from_bytes("cut", &whole[..whole.len() / 3]);
            assert!(cut.is_err(), "{format:?}");
            // A decoder fills the missing part of a JPEG with grey.
            for length in [whole.len() * 2 / 3, whole.len() - 2] {
                let cut = Photograph::from_bytes("cut", &whole[..length]);
                let told = matches!(cut, Err(PhotographError::CutOff { .. }));
                assert_eq!(told, format == Jpeg, "{format:?}, {length} bytes: {cut:?}");
            }
        }
    }
}
