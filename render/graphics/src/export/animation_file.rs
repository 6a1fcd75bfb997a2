//! Animations of a folder of frames: the formats to choose from.

use std::path::Path;

use super::animation::{Apng, Gif};
use super::color_table::ColorTable;
use super::frame::FrameRate;
use super::sequence::{Sequence, SequenceSettings};
use super::sequence_error::SequenceError;

/// File format of an animation.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum AnimationFormat {
    /// GIF, of 255 colours chosen for all its frames.
    Gif,
    /// An animated PNG, with all colours.
    Apng,
}

impl AnimationFormat {
    /// Format for a file extension: GIF for `.gif`, animated PNG for `.png` and `.apng`.
    #[must_use]
    pub fn from_path(path: &Path) -> Option<Self> {
        match path.extension()?.to_str()?.to_ascii_lowercase().as_str() {
            "gif" => Some(Self::Gif),
            "png" | "apng" => Some(Self::Apng),
            _ => None,
        }
    }

    /// Joins all frames of a folder at `rate`. The last one is shown for `last` durations of a
    /// frame, at least one.
    ///
    /// # Errors
    /// [`SequenceError`] if a frame cannot be read, the format allows no such frames, or the
    /// encoder fails.
    pub fn encode(
        self,
        sequence: &Sequence,
        (rate, last): (FrameRate, usize),
    ) -> Result<Vec<u8>, SequenceError> {
        let SequenceSettings { frames, width, height, .. } = *sequence.settings();
        let durations = |index: usize| if index + 1 == frames { last.max(1) } else { 1 };
        match self {
            Self::Gif => {
                let table = ColorTable::of(sequence.frames())?;
                let mut gif = Gif::new(Vec::new(), (width, height), rate, &table)?;
                for (index, frame) in sequence.frames().enumerate() {
                    gif.push_held(&frame?, durations(index))?;
                }
                Ok(gif.finish()?)
            }
            Self::Apng => {
                let mut bytes = Vec::new();
                let mut apng = Apng::new(&mut bytes, (width, height), rate, frames)?;
                for (index, frame) in sequence.compressed().enumerate() {
                    apng.push_held(&frame?, durations(index))?;
                }
                apng.finish()?;
                Ok(bytes)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use std::io::Cursor;

    use image::AnimationDecoder;
    use image::codecs::gif::GifDecoder;
    use image::codecs::png::PngDecoder;

    use super::*;
    use crate::field::Field;

    fn encoded(format: AnimationFormat, last: usize) -> Vec<u8> {
        let folder = tempfile::tempdir().unwrap();
        let settings =
            SequenceSettings { settings: "a".to_owned(), frames: 4, width: 6, height: 5 };
        let mut sequence = Sequence::open(folder.path(), settings).unwrap();
        for index in 0..4 {
            let frame = Field::filled(6, 5, [40 * index as u8, 90, 200]);
            sequence.write_frame(index, &frame).unwrap();
        }
        format.encode(&sequence, (FrameRate::new(10.0).unwrap(), last)).unwrap()
    }

    /// Durations of the frames in ms.
    fn durations(frames: image::Frames<'_>) -> Vec<u32> {
        let frames = frames.collect_frames().unwrap();
        frames.iter().map(|frame| frame.delay().numer_denom_ms()).map(|(n, d)| n / d).collect()
    }

    #[test]
    fn formats_are_known_by_their_extension() {
        let format = |name: &str| AnimationFormat::from_path(Path::new(name));
        assert_eq!(format("a.GIF"), Some(AnimationFormat::Gif));
        assert_eq!(format("a.png"), Some(AnimationFormat::Apng));
        assert_eq!(format("a.apng"), Some(AnimationFormat::Apng));
        assert_eq!((format("a.mp4"), format("a")), (None, None));
    }

    #[test]
    fn the_last_frame_is_held() {
        let gif = encoded(AnimationFormat::Gif, 15);
        let decoder = GifDecoder::new(Cursor::new(&gif)).unwrap();
        assert_eq!(durations(decoder.into_frames()), [100, 100, 100, 1500]);
        let apng = encoded(AnimationFormat::Apng, 15);
        let decoder = PngDecoder::new(Cursor::new(&apng)).unwrap().apng().unwrap();
        assert_eq!(durations(decoder.into_frames()), [100, 100, 100, 1500]);
        assert_eq!(gif, encoded(AnimationFormat::Gif, 15), "the same bytes every time");
        let decoder = GifDecoder::new(Cursor::new(encoded(AnimationFormat::Gif, 0))).unwrap();
        assert_eq!(durations(decoder.into_frames()), [100; 4], "each is shown once at least");
    }
}
