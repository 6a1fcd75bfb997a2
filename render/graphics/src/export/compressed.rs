//! The compressed pixels of a frame, which PNG and animated PNG hold alike.

use png::ColorType;

use super::frame::{Frame, FrameError, frame_png};

/// First bytes of every PNG file.
const SIGNATURE: [u8; 8] = *b"\x89PNG\r\n\x1a\n";

/// End of the chunk IHDR of a frame: 8 bits of red, green and blue, the only methods of
/// compression and filters, not interlaced.
const KIND: [u8; 5] = [8, ColorType::Rgb as u8, 0, 0, 0];

/// The pixels of a frame, filtered and compressed as in its PNG file.
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

    /// The pixels of a whole PNG file as [`frame_png`] writes it. `None` for any other file; the
    /// pixels themselves are not checked.
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

    /// The stream that the chunks of the file hold together.
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
    use png::{BitDepth, Encoder};

    use super::*;
    use crate::field::Field;

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
