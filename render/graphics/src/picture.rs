//! Photographs: PNG and JPEG, brought to a canvas in linear light.

use std::io::Cursor;
use std::path::Path;

use image::{ColorType, DynamicImage, ImageDecoder, ImageReader, Limits};
use rayon::prelude::*;
use spectra::color::Rgb;

use crate::field::Field;

/// Linear sRGB with white at 1, for every cell of a canvas.
pub type Picture = Field<[f32; 3]>;

/// The most pixels that are read: 2^27, some 11,500 x 11,500.
pub const MOST_PIXELS: u64 = 1 << 27;

/// The most bytes that reading may take.
const MOST_BYTES: u64 = 3 << 29;

/// How a photograph is brought to a canvas of another shape.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Framing {
    /// What goes beyond the canvas is cut off, on both sides alike.
    #[default]
    Cut,
    /// It is stretched.
    Stretched,
}

/// A photograph as it was read, upright.
#[derive(Debug, Clone, PartialEq)]
pub struct Photograph {
    image: DynamicImage,
}

impl Photograph {
    /// Reads a PNG or JPEG file: grey or colour, 8 or 16 bits a channel, as
    /// sRGB; transparent parts over white; turned as its EXIF data say.
    ///
    /// # Errors
    /// [`PhotographError`] with the path.
    pub fn open(path: &Path) -> Result<Self, PhotographError> {
        let name = path.display().to_string();
        let bytes = std::fs::read(path)
            .map_err(|error| PhotographError::Unreadable { name: name.clone(), error })?;
        Self::from_bytes(&name, &bytes)
    }

    /// The same, of a file's bytes; `name` stands in errors.
    ///
    /// # Errors
    /// [`PhotographError`].
    pub fn from_bytes(name: &str, bytes: &[u8]) -> Result<Self, PhotographError> {
        let rejected = |error: image::ImageError| PhotographError::NoPicture {
            name: name.to_owned(),
            reason: error.to_string(),
        };
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
        let orientation = decoder.orientation().map_err(rejected)?;
        let mut image = DynamicImage::from_decoder(decoder).map_err(rejected)?;
        image.apply_orientation(orientation);
        if !matches!(sample_bytes(image.color()), 1 | 2) {
            image = image.into_rgba16().into();
        }
        Ok(Self { image })
    }

    /// Width and height in pixels.
    #[must_use]
    pub fn size(&self) -> (usize, usize) {
        (self.image.width() as usize, self.image.height() as usize)
    }

    /// The photograph on a canvas of `width` x `height` cells: the mean, in
    /// linear light, of what each cell covers. Where a cell covers less than a
    /// pixel, neighbouring pixels run into each other.
    ///
    /// # Panics
    /// If the canvas has no cell.
    #[must_use]
    pub fn on_canvas(&self, width: usize, height: usize, framing: Framing) -> Picture {
        self.resampled(width, height, framing, |[r, g, b, _]| [r, g, b].map(|value| value as f32))
    }

    /// The same in encoded sRGB, with how opaque it is in 0..1; the colour is that of
    /// the opaque part, and white where there is none.
    ///
    /// # Panics
    /// If the canvas has no cell.
    #[must_use]
    pub fn with_opacity(&self, width: usize, height: usize, framing: Framing) -> Field<[f32; 4]> {
        self.resampled(width, height, framing, |[r, g, b, opacity]| {
            let opacity = opacity.clamp(0.0, 1.0);
            // What is not opaque shows white.
            let own = |value: f64| ((value + opacity - 1.0) / opacity).clamp(0.0, 1.0);
            let color = if opacity > 0.0 { [r, g, b].map(own) } else { [1.0; 3] };
            let [r, g, b] = Rgb(color).encoded().0.map(|value| value as f32);
            [r, g, b, opacity as f32]
        })
    }

    /// `cell` of linear light over white and opacity, for all cells.
    fn resampled<T: Clone + Default + Send>(
        &self,
        width: usize,
        height: usize,
        framing: Framing,
        cell: impl Fn([f64; 4]) -> T + Sync,
    ) -> Field<T> {
        assert!(width > 0 && height > 0, "a canvas of {width} x {height} cells");
        let (source_width, source_height) = self.size();
        let mut scale = [source_width as f64 / width as f64, source_height as f64 / height as f64];
        if framing == Framing::Cut {
            scale = [scale[0].min(scale[1]); 2];
        }
        let columns = Spans::new(source_width, width, scale[0]);
        let rows = Spans::new(source_height, height, scale[1]);
        let linear = Linear::of(self.image.color());
        let stride = source_width * linear.pixel_bytes;
        let bytes = self.image.as_bytes();
        let mut picture = Field::filled(width, height, T::default());
        picture.values_mut().par_chunks_mut(width).enumerate().for_each(|(y, row)| {
            let mut source = vec![[0.0; 4]; source_width];
            let mut sums = vec![[0.0_f64; 4]; width];
            for (line, weight) in rows.of(y) {
                linear.row(&bytes[line * stride..][..stride], &mut source);
                for (x, sum) in sums.iter_mut().enumerate() {
                    for (pixel, share) in columns.of(x) {
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

/// Which pixels each cell covers, along one side.
struct Spans {
    pixels: usize,
    first: f64,
    scale: f64,
}

impl Spans {
    fn new(pixels: usize, cells: usize, scale: f64) -> Self {
        Self { pixels, first: (pixels as f64 - scale * cells as f64) / 2.0, scale }
    }

    /// The pixels under a cell, with weights that sum to 1.
    fn of(&self, cell: usize) -> impl Iterator<Item = (usize, f64)> + use<> {
        let width = self.scale.max(1.0);
        let middle = self.first + (cell as f64 + 0.5) * self.scale;
        let limit = self.pixels as f64;
        let (from, to) = ((middle - width / 2.0).max(0.0), (middle + width / 2.0).min(limit));
        let last = (to.ceil() as usize).clamp(1, self.pixels) - 1;
        let first = (from as usize).min(last);
        (first..=last).map(move |pixel| {
            let covered = to.min(pixel as f64 + 1.0) - from.max(pixel as f64);
            (pixel, covered.max(0.0) / (to - from))
        })
    }
}

/// How the bytes of a pixel become linear light.
struct Linear {
    channels: usize,
    sample_bytes: usize,
    pixel_bytes: usize,
    /// Linear light of each value a sample may have.
    decoded: Vec<f64>,
}

impl Linear {
    fn of(color: ColorType) -> Self {
        let sample_bytes = sample_bytes(color);
        let last = (1_usize << (8 * sample_bytes)) - 1;
        let decode = |value: usize| Rgb([value as f64 / last as f64; 3]).linear().0[0];
        Self {
            channels: usize::from(color.channel_count()),
            sample_bytes,
            pixel_bytes: usize::from(color.bytes_per_pixel()),
            decoded: (0..=last).map(decode).collect(),
        }
    }

    /// Light over white, and opacity.
    fn row(&self, bytes: &[u8], row: &mut [[f64; 4]]) {
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

/// A photograph that cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum PhotographError {
    /// The file cannot be opened.
    #[error("{name}: {error}")]
    Unreadable {
        /// The file.
        name: String,
        /// Why not.
        error: std::io::Error,
    },
    /// No PNG or JPEG, or a broken one.
    #[error("{name}: no picture that can be read: {reason}")]
    NoPicture {
        /// The file.
        name: String,
        /// As the reader tells it.
        reason: String,
    },
    /// More pixels than are read.
    #[error("{name}: a photograph has {MOST_PIXELS} pixels at most, found `{width} x {height}`")]
    TooLarge {
        /// The file.
        name: String,
        /// Pixels in a row.
        width: u32,
        /// Rows.
        height: u32,
    },
}

impl PhotographError {
    /// What to try.
    #[must_use]
    pub fn hint(&self) -> &'static str {
        match self {
            Self::Unreadable { .. } => "check the path",
            Self::NoPicture { .. } => "save it as PNG or JPEG",
            Self::TooLarge { .. } => "make it smaller; a canvas has fewer cells",
        }
    }
}
