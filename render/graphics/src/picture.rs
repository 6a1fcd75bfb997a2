//! Photographs: reads PNG, JPEG, TIFF and WebP files, converts them from their embedded ICC
//! profile to sRGB, and resamples them to a canvas in linear light.

use std::io::Cursor;
use std::path::Path;

use documents::file::{FileError, has_memory, read};
use documents::foreign_message;
use documents::hint::Explain;
use image::{
    ColorType, DynamicImage, ExtendedColorType, ImageBuffer, ImageDecoder, ImageFormat,
    ImageReader, Limits, Rgba,
};
use moxcms::{ColorProfile, DataColorSpace, Layout, RenderingIntent, TransformOptions};
use rayon::prelude::*;
use spectra::color::Rgb;
use tiff::TiffResult;
use tiff::decoder::{Decoder, Limits as ColorProfileLimits, ifd};
use tiff::tags::Tag;

use crate::described_colors::DescribedColors;
use crate::field::Field;
use crate::picture_formats::{
    MOST_SIDE, NAMES, damage_of_jpeg, fault_of_profile, is_cut_off_jpeg, is_of_inks,
};

/// A picture in linear sRGB, white at 1, one colour per cell.
pub type Picture = Field<[f32; 3]>;

/// We read photographs of at most this many pixels: 2^27, about 11,500 x 11,500.
pub const MOST_PIXELS: u64 = 1 << 27;

/// The decoder may allocate at most this many bytes: 1.5 GiB.
const MOST_BYTES: u64 = 3 << 29;

/// A decoded photograph. It stands upright.
#[derive(Debug, Clone, PartialEq)]
pub struct Photograph {
    image: DynamicImage,
}

/// Longest side of a painting in pixels, if the user gives no width.
const USUAL_LONGER_SIDE_PX: usize = 1600;

impl Photograph {
    /// Reads a PNG, JPEG, TIFF or WebP file, grey or colour, with 8 or 16 bits per channel. This
    /// converts its colours by the ICC profile in the file, or by the gamma and chromaticities of a
    /// PNG file. A file without either counts as sRGB. It also applies the orientation in the EXIF
    /// data. A JPEG file that is cut off or damaged is refused.
    ///
    /// # Errors
    /// [`PhotographError`] with the path.
    pub fn open(path: &Path) -> Result<Self, PhotographError> {
        let name = path.display().to_string();
        let bytes = read(path)?;
        Self::from_bytes(&name, &bytes)
    }

    /// Decodes the content of a PNG, JPEG, TIFF or WebP file. `name` stands for the path in errors.
    ///
    /// # Errors
    /// [`PhotographError`].
    pub fn from_bytes(name: &str, bytes: &[u8]) -> Result<Self, PhotographError> {
        let rejected = |error: image::ImageError| PhotographError::NoPicture {
            name: name.to_owned(),
            reason: foreign_message(&error),
        };
        if is_cut_off_jpeg(bytes) {
            return Err(PhotographError::CutOff { name: name.to_owned(), bytes: bytes.len() });
        }
        let refused = |reason| PhotographError::Profile { name: name.to_owned(), reason };
        if let Some(reason) = fault_of_profile(bytes) {
            return Err(refused(ProfileError::Unusable(reason)));
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
        if width.max(height) > MOST_SIDE {
            return Err(PhotographError::TooLong { name: name.to_owned(), width, height });
        }
        // The decoded picture, and a row of it in f64.
        let mb = (decoder.total_bytes() + 32 * u64::from(width)) >> 20;
        if !has_memory(mb << 20) {
            return Err(PhotographError::Memory { name: name.to_owned(), mb });
        }
        let inks = [ExtendedColorType::Cmyk8, ExtendedColorType::Cmyk16];
        if inks.contains(&decoder.original_color_type()) || is_of_inks(bytes) {
            return Err(refused(ProfileError::Inks("CMYK".to_owned())));
        }
        if let Some(reason) = damage_of_jpeg(bytes) {
            return Err(PhotographError::Damaged { name: name.to_owned(), reason });
        }
        let described = DescribedColors::of_png(bytes)
            .map_err(|reason| refused(ProfileError::Unusable(reason)))?;
        let orientation = decoder.orientation().map_err(rejected)?;
        let profile = match image::guess_format(bytes) {
            Ok(ImageFormat::Tiff) => {
                tiff_profile(bytes).map_err(|error| PhotographError::NoPicture {
                    name: name.to_owned(),
                    reason: foreign_message(&error),
                })?
            }
            _ => decoder.icc_profile().map_err(rejected)?,
        };
        let mut image = DynamicImage::from_decoder(decoder).map_err(rejected)?;
        image.apply_orientation(orientation);
        if !matches!(sample_bytes(image.color()), 1 | 2) {
            image = image.into_rgba16().into();
        }
        image = match (described, profile) {
            (Some(colors), None) => converted(image, &colors.profile).map_err(refused)?,
            (Some(colors), _) if colors.before_icc => {
                converted(image, &colors.profile).map_err(refused)?
            }
            (_, Some(profile)) => to_srgb(image, &profile).map_err(refused)?,
            (_, None) => image,
        };
        Ok(Self { image })
    }

    /// Width in pixels of a painting of this photograph, if the user does not ask for one. This is
    /// the photograph's own width, or less: the longer side has at most 1600 pixels.
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

    /// Resamples the photograph to `width` x `height` cells, and stretches it if the shapes
    /// differ. A cell has the mean linear light over its area, with transparent parts over white.
    /// If you ask for cells smaller than a pixel, they blend neighbouring pixels.
    ///
    /// # Panics
    /// If `width` or `height` is 0.
    #[must_use]
    pub fn on_canvas(&self, width: usize, height: usize) -> Picture {
        self.resampled(width, height, |[r, g, b, _]| [r, g, b].map(|value| value as f32))
    }

    /// Resamples the photograph like [`Photograph::on_canvas`], but to encoded sRGB with opacity
    /// (both 0..1). The colour belongs to the opaque part. It is white where there is none.
    ///
    /// # Panics
    /// If `width` or `height` is 0.
    #[must_use]
    pub fn with_opacity(&self, width: usize, height: usize) -> Field<[f32; 4]> {
        self.resampled(width, height, |[r, g, b, opacity]| {
            let opacity = opacity.clamp(0.0, 1.0);
            // Undo the blend with white.
            let color = if opacity > 0.0 {
                [r, g, b].map(|value: f64| ((value + opacity - 1.0) / opacity).clamp(0.0, 1.0))
            } else {
                [1.0; 3]
            };
            let [r, g, b] = Rgb(color).encoded().0.map(|value| value as f32);
            [r, g, b, opacity as f32]
        })
    }

    /// Applies `cell` to the mean linear light over white, and the opacity, of every cell.
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

/// How cells cover pixels along one axis.
struct Coverage {
    pixels: usize,
    /// Pixel position of the first cell's edge: 0 up to rounding.
    first: f64,
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

struct LinearDecoder {
    channels: usize,
    sample_bytes: usize,
    pixel_bytes: usize,
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
#[derive(Debug, thiserror::Error, Explain)]
pub enum PhotographError {
    /// The file cannot be opened or read.
    #[error(transparent)]
    Unreadable(#[from] FileError),
    /// The file is not a PNG, JPEG, TIFF or WebP picture, or it is damaged.
    #[error("{name}: not a {NAMES} picture that can be read: {reason}")]
    #[hint("save it as {NAMES}")]
    NoPicture {
        /// Path of the file.
        name: String,
        /// Reason given by the decoder.
        reason: String,
    },
    /// The file is a JPEG picture that ends too early.
    #[error("{name}: the JPEG file is cut off after {bytes} bytes: its end marker is missing")]
    #[hint("copy or download the file again; the decoder would fill the missing part with grey")]
    CutOff {
        /// Path of the file.
        name: String,
        /// Length of the file.
        bytes: usize,
    },
    /// The coded data of a JPEG picture are damaged.
    #[error("{name}: the JPEG file is damaged: {reason}")]
    #[hint(
        "copy or download the file again, or repair it in an image editor; the decoder would fill what follows the damage with grey"
    )]
    Damaged {
        /// Path of the file.
        name: String,
        /// Reason given by the decoder.
        reason: String,
    },
    /// We cannot convert the colours of the picture to sRGB.
    #[error("{name}: {reason}")]
    #[hint("convert it to sRGB in an image editor")]
    Profile {
        /// Path of the file.
        name: String,
        /// The property that we cannot convert.
        reason: ProfileError,
    },
    /// The picture has more than [`MOST_PIXELS`] pixels.
    #[error("{name}: a photograph has {MOST_PIXELS} pixels at most, found `{width} x {height}`")]
    #[hint("make it smaller; a canvas has fewer cells")]
    TooLarge {
        /// Path of the file.
        name: String,
        /// Width in pixels.
        width: u32,
        /// Height in pixels.
        height: u32,
    },
    /// The system does not give the memory that the picture needs.
    #[error("{name}: the picture needs `{mb}` MB of memory, which the system does not give")]
    #[hint("close other programs, or raise the limit of memory")]
    #[fault(Environment)]
    Memory {
        /// Path of the file.
        name: String,
        /// Memory in MB.
        mb: u64,
    },
    /// A side of the picture has more than [`MOST_SIDE`] pixels.
    #[error(
        "{name}: a photograph has {MOST_SIDE} pixels a side at most, found `{width} x {height}`"
    )]
    #[hint("cut it into parts, or make it smaller")]
    TooLong {
        /// Path of the file.
        name: String,
        /// Width in pixels.
        width: u32,
        /// Height in pixels.
        height: u32,
    },
}

/// Why we cannot convert a picture.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum ProfileError {
    /// The file holds inks. Their colours depend on a press.
    #[error("its colours are inks ({0})")]
    Inks(String),
    /// The profile cannot be read, or does not suit the picture.
    #[error("its colour profile cannot be used: {0}")]
    Unusable(String),
}

/// The ICC profile in a TIFF file. We read it here because the decoder of pictures silently leaves
/// out a profile that is large compared to its picture. This takes memory in proportion to the
/// file at most.
pub(crate) fn tiff_profile(file: &[u8]) -> TiffResult<Option<Vec<u8>>> {
    let mut limits = ColorProfileLimits::default();
    limits.decoding_buffer_size = file.len().saturating_mul(size_of::<ifd::Value>());
    let mut decoder = Decoder::new(Cursor::new(file))?.with_limits(limits);
    decoder.find_tag(Tag::IccProfile)?.map(ifd::Value::into_u8_vec).transpose()
}

/// Converts a picture of encoded samples to encoded sRGB with 16 bits per channel. `profile` is
/// the content of an ICC file. Colours are relative to white. This clips colours outside sRGB
/// channel by channel, and keeps opacity.
///
/// # Errors
/// [`ProfileError`] for a damaged profile, one of inks, and one for another number of channels.
pub fn to_srgb(image: DynamicImage, profile: &[u8]) -> Result<DynamicImage, ProfileError> {
    converted(image, &ColorProfile::new_from_slice(profile).map_err(unusable)?)
}

fn unusable(error: moxcms::CmsError) -> ProfileError {
    ProfileError::Unusable(foreign_message(&error))
}

/// Converts a picture like [`to_srgb`], from the profile `source`.
fn converted(image: DynamicImage, source: &ColorProfile) -> Result<DynamicImage, ProfileError> {
    let grey =
        matches!(image.color(), ColorType::L8 | ColorType::La8 | ColorType::L16 | ColorType::La16);
    match (source.color_space, grey) {
        (DataColorSpace::Rgb, _) | (DataColorSpace::Gray, true) => {}
        (DataColorSpace::Cmyk | DataColorSpace::Cmy, _) => {
            return Err(ProfileError::Inks("CMYK".to_owned()));
        }
        (space, _) => {
            let channels = if grey { "grey" } else { "RGB" };
            let reason = format!("it is for {space:?}, the picture is {channels}");
            return Err(ProfileError::Unusable(reason));
        }
    }
    let options = TransformOptions {
        rendering_intent: RenderingIntent::RelativeColorimetric,
        prefer_fixed_point: false,
        ..TransformOptions::default()
    };
    let srgb = ColorProfile::new_srgb();
    let wide = image.into_rgba16();
    let (width, height) = wide.dimensions();
    let mut from = wide.into_raw();
    let mut to = vec![0_u16; from.len()];
    let layout = if source.color_space == DataColorSpace::Gray {
        from = from.chunks_exact(4).flat_map(|pixel| [pixel[0], pixel[3]]).collect();
        Layout::GrayAlpha
    } else {
        Layout::Rgba
    };
    let transform =
        source.create_transform_16bit(layout, &srgb, Layout::Rgba, options).map_err(unusable)?;
    let channels = if layout == Layout::Rgba { 4 } else { 2 };
    let row = width.max(1) as usize;
    let rows = from.par_chunks(channels * row).zip(to.par_chunks_mut(4 * row));
    rows.try_for_each(|(from, to)| transform.transform(from, to)).map_err(unusable)?;
    let converted = ImageBuffer::<Rgba<u16>, _>::from_raw(width, height, to);
    converted
        .map(DynamicImage::ImageRgba16)
        .ok_or_else(|| ProfileError::Unusable("the picture has another size".to_owned()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::Photograph;
    use documents::hint::{Explain, Fault};
    use image::codecs::png::PngEncoder;
    use image::codecs::tiff::TiffEncoder;
    use image::{ExtendedColorType, ImageEncoder};
    use spectra::color::Rgb;

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
                let is_reported = matches!(cut, Err(PhotographError::CutOff { .. }));
                assert_eq!(is_reported, format == Jpeg, "{format:?}, {length} bytes: {cut:?}");
            }
        }
    }

    fn linear(bytes: &[u8]) -> [f32; 3] {
        Photograph::from_bytes("made", bytes).unwrap().on_canvas(1, 1)[(0, 0)]
    }

    fn near(found: [f32; 3], wanted: [f64; 3], tolerance: f64) {
        let far = found.iter().zip(wanted).map(|(f, w)| (f64::from(*f) - w).abs());
        assert!(far.fold(0.0, f64::max) < tolerance, "{found:?} for {wanted:?}");
    }

    fn deep_tiff(values: [u16; 3], profile: &ColorProfile) -> Vec<u8> {
        let mut bytes = Cursor::new(Vec::new());
        let mut encoder = TiffEncoder::new(&mut bytes);
        encoder.set_icc_profile(profile.encode().unwrap()).unwrap();
        let samples = values.map(u16::to_ne_bytes).concat().repeat(64);
        encoder.write_image(&samples, 8, 8, ExtendedColorType::Rgb16).unwrap();
        bytes.into_inner()
    }

    #[test]
    fn sixteen_bits_of_a_tiff_survive_its_profile() {
        let p3 = [
            [1.224_940, -0.224_940, 0.0],
            [-0.042_057, 1.042_057, 0.0],
            [-0.019_638, -0.078_636, 1.098_274],
        ];
        // Steps below the 257 of a picture with 8 bits.
        for step in 0..8 {
            let values = [30_000 + 31 * step, 27_000 - 17 * step, 25_000 + 5 * step];
            let light = values.map(|v| Rgb([f64::from(v) / 65_535.0; 3]).linear().0[0]);
            let wanted = p3.map(|row| row.iter().zip(light).map(|(m, l)| m * l).sum::<f64>());
            near(linear(&deep_tiff(values, &ColorProfile::new_display_p3())), wanted, 2e-4);
            near(linear(&deep_tiff(values, &ColorProfile::new_srgb())), light, 2e-4);
        }
    }

    #[test]
    fn the_curve_of_a_grey_profile_is_that_of_the_picture() {
        let profile = ColorProfile::new_gray_with_gamma(1.8).encode().unwrap();
        fn light(file: &[u8]) -> f64 {
            let [r, g, b] = linear(file);
            assert!(r == g && g == b, "grey stays grey: {r} {g} {b}");
            f64::from(r)
        }
        for value in [40_u8, 128, 220] {
            let wanted = (f64::from(value) / 255.0).powf(1.8);
            let mut png = Vec::new();
            let mut encoder = PngEncoder::new(&mut png);
            encoder.set_icc_profile(profile.clone()).unwrap();
            encoder.write_image(&[value; 64], 8, 8, ExtendedColorType::L8).unwrap();
            let found = light(&png);
            assert!((found - wanted).abs() < 5e-4, "{found} for {wanted}");
            let mut clear = Vec::new();
            let mut encoder = PngEncoder::new(&mut clear);
            encoder.set_icc_profile(profile.clone()).unwrap();
            encoder.write_image(&[value, 51].repeat(64), 8, 8, ExtendedColorType::La8).unwrap();
            let found = light(&clear);
            let wanted = 0.2 * wanted + 0.8;
            assert!((found - wanted).abs() < 5e-4, "over white: {found} for {wanted}");
        }
        let mut colored = Vec::new();
        let mut encoder = PngEncoder::new(&mut colored);
        encoder.set_icc_profile(profile).unwrap();
        encoder.write_image(&[1, 2, 3], 1, 1, ExtendedColorType::Rgb8).unwrap();
        let error = Photograph::from_bytes("grey.png", &colored).unwrap_err().to_string();
        assert!(error.contains("Gray") && error.contains("the picture is RGB"), "{error}");
    }

    /// A JPEG of 8 x 8 pixels of middle grey with this number of components. Its tables hold one
    /// code each, so that the coded data are zeros.
    fn small_jpeg(components: u8) -> Vec<u8> {
        let mut file = vec![0xff, 0xd8, 0xff, 0xdb, 0, 67, 0];
        file.extend([1; 64]);
        file.extend([0xff, 0xc0, 0, 8 + 3 * components, 8, 0, 8, 0, 8, components]);
        file.extend((1..=components).flat_map(|id| [id, 0x11, 0]));
        for class in [0x00, 0x10] {
            file.extend([0xff, 0xc4, 0, 20, class, 1]);
            file.extend([0; 16]);
        }
        file.extend([0xff, 0xda, 0, 6 + 2 * components, components]);
        file.extend((1..=components).flat_map(|id| [id, 0]));
        file.extend([0, 63, 0]);
        // The data have one bit for the mean and one for the end of each block, then ones up to a
        // whole byte.
        file.extend([if components == 4 { 0 } else { 0xff >> (2 * components) }, 0xff, 0xd9]);
        file
    }

    #[test]
    fn a_jpeg_of_inks_is_refused_and_one_of_light_is_read() {
        for components in [1, 3] {
            let grey = linear(&small_jpeg(components));
            near(grey, [Rgb([128.0 / 255.0; 3]).linear().0[0]; 3], 1e-3);
        }
        let inks = small_jpeg(4);
        assert!(image::load_from_memory(&inks).is_ok(), "a decoder makes some colour of it");
        let error = Photograph::from_bytes("press.jpg", &inks).unwrap_err();
        assert_eq!(error.to_string(), "press.jpg: its colours are inks (CMYK)");
        assert_eq!(error.fault(), Fault::Input);
    }
}
