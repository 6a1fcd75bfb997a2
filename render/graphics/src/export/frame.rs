//! Frames of an animation: encoded sRGB with 8 bits per channel. Frames can also be kept
//! compressed, as PNG and animated PNG store them.

use std::io::{BufRead, Seek};

use documents::{counted, hint::Explain};
use png::{BitDepth, ColorType, Compression, Decoder, Encoder, SrgbRenderingIntent};
use rayon::prelude::*;

use crate::field::Field;

/// A frame: encoded sRGB of every pixel.
pub type Frame = Field<[u8; 3]>;

/// A frame or animation cannot be made or read.
#[derive(Debug, Clone, PartialEq, thiserror::Error, Explain)]
#[fault(Setting)]
pub enum FrameError {
    /// The picture is empty or larger than the format allows.
    #[error("a frame of {format} has 1 to {limit} pixels a side, found `{width} x {height}`")]
    #[hint(if *format == "GIF", "write APNG, or a smaller picture")]
    #[hint("ask for a smaller picture")]
    Size {
        /// Name of the format.
        format: &'static str,
        /// Greatest width and height of the format, in pixels.
        limit: usize,
        /// Width in pixels.
        width: usize,
        /// Height in pixels.
        height: usize,
    },
    /// A frame has another size than the animation.
    #[error("all frames have {} x {} pixels, found `{} x {}`", .wanted[0], .wanted[1], .found[0], .found[1])]
    Differs {
        /// Width and height of the animation in pixels.
        wanted: [usize; 2],
        /// Width and height of the frame in pixels.
        found: [usize; 2],
    },
    /// You gave more or fewer frames than announced.
    #[error("an animation of {}, found `{found}`", counted(*wanted, "frame"))]
    Count {
        /// Number of frames announced in advance.
        wanted: usize,
        /// Number of frames given.
        found: usize,
    },
    /// The frame rate is out of range.
    #[error("0.1 to 100 frames a second, found `{0}`")]
    #[hint("25 is usual")]
    Rate(f64),
    /// The file is not a frame that [`frame_png`] wrote.
    #[error("no frame: {0}")]
    #[hint("remove the file, and it is rendered again")]
    Unreadable(String),
    /// The encoder or the writer failed.
    #[error("no {format} could be made: {reason}")]
    Encoder {
        /// Name of the format.
        format: &'static str,
        /// Reason given by the encoder.
        reason: String,
    },
}

/// Frame rate of an animation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FrameRate(f64);

impl FrameRate {
    /// Creates a rate of `per_second` frames per second, 0.1 to 100.
    ///
    /// # Errors
    /// [`FrameError::Rate`] outside that range.
    pub fn new(per_second: f64) -> Result<Self, FrameError> {
        match (0.1..=100.0).contains(&per_second) {
            true => Ok(Self(per_second)),
            false => Err(FrameError::Rate(per_second)),
        }
    }

    /// Start of frame `index` in whole parts of a second (`parts` per second). Each frame ends
    /// where the next one starts, so rounding does not accumulate.
    fn start(self, index: usize, parts: f64) -> u64 {
        (index as f64 * parts / self.0).round() as u64
    }

    /// Length of `durations` frames after `elapsed` others, in whole parts of a second. This
    /// shortens a length that a file cannot state.
    pub(super) fn duration(self, elapsed: usize, durations: usize, parts: f64) -> u16 {
        let length = self.start(elapsed + durations, parts) - self.start(elapsed, parts);
        u16::try_from(length).unwrap_or(u16::MAX)
    }

    /// Number of whole frames nearest to `seconds`.
    #[must_use]
    pub fn frames_in(self, seconds: f64) -> usize {
        (seconds * self.0).round() as usize
    }
}

/// Converts encoded sRGB in 0..1 to a frame. The fourth value is ignored.
#[must_use]
pub fn frame_of(picture: &Field<[f32; 4]>) -> Frame {
    let pixels = picture.values().par_iter().map(|&[r, g, b, _]| {
        [r, g, b].map(|value: f32| (value.clamp(0.0, 1.0) * 255.0).round() as u8)
    });
    Field::from_values(picture.width(), picture.height(), pixels.collect())
}

/// Encodes a frame as a PNG file.
///
/// # Errors
/// [`FrameError::Size`], [`FrameError::Encoder`].
pub fn frame_png(frame: &Frame) -> Result<Vec<u8>, FrameError> {
    check_size("PNG", (1 << 30) - 2, frame.width(), frame.height())?;
    let mut bytes = Vec::new();
    let mut encoder = Encoder::new(&mut bytes, frame.width() as u32, frame.height() as u32);
    encoder.set_color(ColorType::Rgb);
    encoder.set_depth(BitDepth::Eight);
    // This makes files of painted frames an eighth larger, and writes them in a fifth of the time.
    encoder.set_compression(Compression::Fast);
    encoder.set_source_srgb(SrgbRenderingIntent::RelativeColorimetric);
    let written = encoder.write_header().and_then(|mut writer| {
        writer.write_image_data(frame.values().as_flattened())?;
        writer.finish()
    });
    written.map_err(|error| encoder_failed("PNG", &error))?;
    Ok(bytes)
}

/// Decodes a frame written by [`frame_png`].
///
/// # Errors
/// [`FrameError::Unreadable`] for any other file: truncated, not PNG, other channels.
pub fn read_frame(file: impl BufRead + Seek) -> Result<Frame, FrameError> {
    fn broken(reason: String) -> FrameError {
        FrameError::Unreadable(reason)
    }
    let mut reader = Decoder::new(file).read_info().map_err(|error| broken(error.to_string()))?;
    let kind = reader.output_color_type();
    if kind != (ColorType::Rgb, BitDepth::Eight) {
        return Err(broken(format!("expected 8 bits of red, green and blue, found `{kind:?}`")));
    }
    let width = reader.info().width as usize;
    let height = reader.info().height as usize;
    let bytes = reader.output_buffer_size().ok_or_else(|| broken("it is too large".to_owned()))?;
    let mut samples = vec![0; bytes];
    reader.next_frame(&mut samples).map_err(|error| broken(error.to_string()))?;
    reader.finish().map_err(|error| broken(error.to_string()))?;
    let (pixels, _) = samples.as_chunks::<3>();
    Ok(Field::from_values(width, height, pixels.to_vec()))
}

/// Checks that a format allows pictures of this size.
pub(super) fn check_size(
    format: &'static str,
    limit: usize,
    width: usize,
    height: usize,
) -> Result<(), FrameError> {
    match (1..=limit).contains(&width) && (1..=limit).contains(&height) {
        true => Ok(()),
        false => Err(FrameError::Size { format, limit, width, height }),
    }
}

pub(super) fn encoder_failed(format: &'static str, error: &dyn std::error::Error) -> FrameError {
    FrameError::Encoder { format, reason: error.to_string() }
}

const SIGNATURE: [u8; 8] = *b"\x89PNG\r\n\x1a\n";

/// How the chunk IHDR of a frame ends: 8 bits of red, green and blue, the only methods of
/// compression and filters, not interlaced.
const KIND: [u8; 5] = [8, ColorType::Rgb as u8, 0, 0, 0];

/// The pixels of a frame, filtered and compressed as in its PNG file. Use this to join frames
/// without unpacking them.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CompressedFrame {
    width: u32,
    height: u32,
    zlib: Vec<u8>,
}

impl CompressedFrame {
    /// Compresses a frame.
    ///
    /// # Errors
    /// [`FrameError::Size`], [`FrameError::Encoder`].
    pub fn new(frame: &Frame) -> Result<Self, FrameError> {
        Self::from_png(&frame_png(frame)?).ok_or_else(|| FrameError::Encoder {
            format: "PNG",
            reason: "the encoder wrote another kind of picture".to_owned(),
        })
    }

    /// Takes the pixels out of a whole PNG file that [`frame_png`] wrote. `None` for any other
    /// file. This does not check the pixels themselves.
    #[must_use]
    pub fn from_png(bytes: &[u8]) -> Option<Self> {
        let mut rest = bytes.strip_prefix(&SIGNATURE)?;
        let mut size = None;
        let mut zlib = Vec::new();
        loop {
            let (name, content);
            (name, content, rest) = chunk(rest)?;
            match name {
                b"IHDR" => {
                    let (width, after) = content.split_first_chunk()?;
                    let (height, kind) = after.split_first_chunk()?;
                    let own = kind == KIND;
                    size = own.then(|| [*width, *height].map(u32::from_be_bytes));
                }
                b"IDAT" => zlib.extend_from_slice(content),
                b"IEND" => {
                    let [width, height] = size?;
                    return Some(Self { width, height, zlib });
                }
                _ => {}
            }
        }
    }

    /// Width in pixels.
    #[must_use]
    pub fn width(&self) -> usize {
        self.width as usize
    }

    /// Height in pixels.
    #[must_use]
    pub fn height(&self) -> usize {
        self.height as usize
    }

    pub(super) fn zlib(&self) -> &[u8] {
        &self.zlib
    }
}

/// Splits the name and the content of the first chunk off a file. `None` if the chunk is cut off.
fn chunk(bytes: &[u8]) -> Option<(&[u8; 4], &[u8], &[u8])> {
    let (length, rest) = bytes.split_first_chunk()?;
    let (name, rest) = rest.split_first_chunk()?;
    let (content, rest) = rest.split_at_checked(u32::from_be_bytes(*length) as usize)?;
    let (_checksum, rest) = rest.split_first_chunk::<4>()?;
    Some((name, content, rest))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::field::Field;
    use png::{BitDepth, Encoder};
    use std::io::Cursor;

    #[test]
    fn a_frame_comes_back_and_a_part_of_it_does_not() {
        let picture = Field::from_values(
            3,
            2,
            (0..6).map(|i| [i as f32 / 5.0, 1.5, -1.0, 0.3]).collect::<Vec<_>>(),
        );
        let frame = frame_of(&picture);
        assert_eq!(frame[(0, 0)], [0, 255, 0]);
        assert_eq!(frame[(2, 1)], [255, 255, 0]);
        let file = frame_png(&frame).unwrap();
        assert_eq!(read_frame(Cursor::new(&file)).unwrap(), frame);
        for length in 0..file.len() {
            let part = read_frame(Cursor::new(&file[..length]));
            assert!(matches!(part, Err(FrameError::Unreadable(..))), "{length} bytes");
        }
    }

    #[test]
    fn frames_begin_without_drift() {
        let rate = FrameRate::new(24.0).unwrap();
        let starts: Vec<u64> = (0..=24).map(|i| rate.start(i, 100.0)).collect();
        assert_eq!(starts[..4], [0, 4, 8, 13]);
        assert_eq!(starts[24], 100);
        for found in [0.0, -1.0, f64::NAN, 1000.0] {
            assert!(FrameRate::new(found).is_err_and(|error| error.hint().is_some()));
        }
    }

    #[test]
    fn only_whole_files_of_frames_are_taken() {
        let frame = Field::from_values(5, 3, (0..15).map(|i| [i, 99, 255 - i]).collect());
        let file = frame_png(&frame).unwrap();
        let compressed = CompressedFrame::from_png(&file).unwrap();
        assert_eq!((compressed.width(), compressed.height()), (5, 3));
        for length in 0..file.len() {
            assert_eq!(CompressedFrame::from_png(&file[..length]), None, "{length} bytes");
        }
        for (color, depth, samples) in [
            (ColorType::Rgba, BitDepth::Eight, 4),
            (ColorType::Grayscale, BitDepth::Eight, 1),
            (ColorType::Rgb, BitDepth::Sixteen, 6),
        ] {
            let mut bytes = Vec::new();
            let mut encoder = Encoder::new(&mut bytes, 5, 3);
            encoder.set_color(color);
            encoder.set_depth(depth);
            let mut writer = encoder.write_header().unwrap();
            writer.write_image_data(&vec![7; 15 * samples]).unwrap();
            writer.finish().unwrap();
            assert_eq!(CompressedFrame::from_png(&bytes), None, "{color:?} {depth:?}");
        }
    }
}
