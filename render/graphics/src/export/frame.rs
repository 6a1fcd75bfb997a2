//! One picture of an animation: 8 bits a channel, encoded sRGB.

use std::io::{BufRead, Seek};

use png::{BitDepth, ColorType, Decoder, Encoder, SrgbRenderingIntent};
use rayon::prelude::*;

use crate::field::Field;

/// Encoded sRGB of every pixel.
pub type Frame = Field<[u8; 3]>;

/// What no frame or animation can be made of.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum FrameError {
    /// A size that the format has not.
    #[error("a frame of {format} has 1 to {limit} pixels a side, found `{width} x {height}`")]
    Size {
        /// The format.
        format: &'static str,
        /// Its longest side.
        limit: usize,
        /// Pixels in a row.
        width: usize,
        /// Rows.
        height: usize,
    },
    /// A frame unlike the others.
    #[error("all frames have {} x {} pixels, found `{} x {}`", .wanted[0], .wanted[1], .found[0], .found[1])]
    Differs {
        /// Width and height of the animation.
        wanted: [usize; 2],
        /// Those of the frame.
        found: [usize; 2],
    },
    /// Other frames than were announced.
    #[error("an animation of {wanted} frames, found `{found}`")]
    Count {
        /// How many were announced.
        wanted: usize,
        /// How many came.
        found: usize,
    },
    /// A rate at which nothing can be shown.
    #[error("0.1 to 100 frames a second, found `{found}`")]
    Rate {
        /// Frames a second.
        found: f64,
    },
    /// The file is no frame.
    #[error("no frame: {reason}")]
    Unreadable {
        /// As the decoder tells it.
        reason: String,
    },
    /// The encoder gave up, or what it writes to.
    #[error("no {format} could be made: {reason}")]
    Encoder {
        /// The format.
        format: &'static str,
        /// As the encoder tells it.
        reason: String,
    },
}

impl FrameError {
    /// A way out, if there is one.
    #[must_use]
    pub fn hint(&self) -> Option<&'static str> {
        match self {
            Self::Size { format: "GIF", .. } => Some("write APNG, or a smaller picture"),
            Self::Size { .. } => Some("ask for a smaller picture"),
            Self::Rate { .. } => Some("25 is usual"),
            Self::Unreadable { .. } => Some("remove the file, and it is made anew"),
            _ => None,
        }
    }
}

/// How fast frames follow each other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FrameRate(f64);

impl FrameRate {
    /// `per_second` frames a second, 0.1 to 100.
    ///
    /// # Errors
    /// [`FrameError::Rate`] outside.
    pub fn new(per_second: f64) -> Result<Self, FrameError> {
        match (0.1..=100.0).contains(&per_second) {
            true => Ok(Self(per_second)),
            false => Err(FrameError::Rate { found: per_second }),
        }
    }

    /// Frames a second.
    #[must_use]
    pub fn per_second(self) -> f64 {
        self.0
    }

    /// When frame `index` begins, in whole parts of a second: frames then end
    /// where the next begin, and none drifts.
    pub(super) fn start(self, index: usize, parts: f64) -> u64 {
        (index as f64 * parts / self.0).round() as u64
    }
}

/// The frame of a picture of encoded sRGB in 0..1; the fourth value is not used.
#[must_use]
pub fn frame_of(picture: &Field<[f32; 4]>) -> Frame {
    let byte = |value: f32| (value.clamp(0.0, 1.0) * 255.0).round() as u8;
    let pixels = picture.values().par_iter().map(|&[r, g, b, _]| [r, g, b].map(byte));
    Field::from_values(picture.width(), picture.height(), pixels.collect())
}

/// The frame as a PNG file.
///
/// # Errors
/// [`FrameError::Size`], [`FrameError::Encoder`].
pub fn frame_png(frame: &Frame) -> Result<Vec<u8>, FrameError> {
    check_size("PNG", (1 << 30) - 2, frame.width(), frame.height())?;
    let mut bytes = Vec::new();
    let mut encoder = Encoder::new(&mut bytes, frame.width() as u32, frame.height() as u32);
    encoder.set_color(ColorType::Rgb);
    encoder.set_depth(BitDepth::Eight);
    encoder.set_source_srgb(SrgbRenderingIntent::RelativeColorimetric);
    let written = encoder.write_header().and_then(|mut writer| {
        writer.write_image_data(frame.values().as_flattened())?;
        writer.finish()
    });
    written.map_err(|error| encoder_failed("PNG", &error))?;
    Ok(bytes)
}

/// The frame of a file that [`frame_png`] made.
///
/// # Errors
/// [`FrameError::Unreadable`] for any other: cut off, not PNG, other channels.
pub fn read_frame(file: impl BufRead + Seek) -> Result<Frame, FrameError> {
    let broken = |reason: String| FrameError::Unreadable { reason };
    let mut reader = Decoder::new(file).read_info().map_err(|error| broken(error.to_string()))?;
    let kind = reader.output_color_type();
    if kind != (ColorType::Rgb, BitDepth::Eight) {
        return Err(broken(format!("8 bits of red, green and blue are wanted, found `{kind:?}`")));
    }
    let (width, height) = (reader.info().width as usize, reader.info().height as usize);
    let bytes = reader.output_buffer_size().ok_or_else(|| broken("it is too large".to_owned()))?;
    let mut samples = vec![0; bytes];
    reader.next_frame(&mut samples).map_err(|error| broken(error.to_string()))?;
    reader.finish().map_err(|error| broken(error.to_string()))?;
    let (pixels, _) = samples.as_chunks::<3>();
    Ok(Field::from_values(width, height, pixels.to_vec()))
}

/// Whether a format has pictures of this size.
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

#[cfg(test)]
mod tests {
    use std::io::Cursor;

    use super::*;

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
            assert!(matches!(part, Err(FrameError::Unreadable { .. })), "{length} bytes");
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
}
