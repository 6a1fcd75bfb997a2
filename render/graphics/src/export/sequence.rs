//! A folder of numbered frames, and the animation made of it. You can interrupt the work and
//! resume it.
//!
//! Next to the frames (`frame-0001.png` and so on) lies `animation.json` with a digest of the
//! settings they were rendered with. We keep complete frames of the same settings. We remove
//! frames of other settings before we write the first new one, so a folder never mixes two
//! animations.

use std::fs::{self, File};
use std::io::{BufReader, Cursor, ErrorKind};
use std::path::{Path, PathBuf};

use documents::file::{FileError, write_whole};
use documents::hint::Explain;
use serde::{Deserialize, Serialize};

use super::animation::{Apng, ColorTable, Gif};
use super::frame::{CompressedFrame, Frame, FrameError, FrameRate, frame_png, read_frame};

const FORMAT: &str = "impasto-animation";
const VERSION: u32 = 1;
const MOST_FRAMES: usize = 900_000;

/// Settings of a sequence, stored in `animation.json`.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SequenceSettings {
    /// Digest of everything that the frames depend on, e.g. settings and inputs.
    pub settings: String,
    /// Number of frames.
    pub frames: usize,
    /// Width in pixels.
    pub width: usize,
    /// Height in pixels.
    pub height: usize,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Manifest {
    format: String,
    version: u32,
    #[serde(rename = "shots")]
    settings: SequenceSettings,
}

/// A folder of frames. It knows which frames are still missing.
#[derive(Debug)]
pub struct Sequence {
    folder: PathBuf,
    settings: SequenceSettings,
    remaining: Vec<usize>,
}

impl Sequence {
    /// Opens a folder of frames, or creates it. This removes frames rendered with other settings
    /// and touches no other file.
    ///
    /// # Errors
    /// [`SequenceError`] if a file cannot be read or written, if frames lack a manifest, or if the
    /// manifest is invalid.
    pub fn open(folder: &Path, settings: SequenceSettings) -> Result<Self, SequenceError> {
        fs::create_dir_all(folder).map_err(at(folder))?;
        let mut sequence = Self { folder: folder.to_owned(), settings, remaining: Vec::new() };
        match read_manifest(&folder.join(MANIFEST))? {
            Some(previous) if previous == sequence.settings => {}
            Some(previous) => {
                for index in 0..previous.frames {
                    remove(&sequence.path(index))?;
                }
                sequence.write_manifest()?;
            }
            None => {
                let paths = (0..sequence.settings.frames).map(|index| sequence.path(index));
                if let Some(path) = paths.into_iter().find(|path| path.exists()) {
                    return Err(SequenceError::Foreign(path));
                }
                sequence.write_manifest()?;
            }
        }
        sequence.remaining = (0..sequence.settings.frames)
            .filter(|index: &usize| !sequence.is_complete(*index))
            .collect();
        Ok(sequence)
    }

    /// Indices (from 0) of the frames that you still have to render, rising.
    #[must_use]
    pub fn remaining(&self) -> &[usize] {
        &self.remaining
    }

    /// Path of frame `index`. Indices count from 0, file names from 1.
    #[must_use]
    pub fn path(&self, index: usize) -> PathBuf {
        self.folder.join(format!("frame-{:04}.png", index + 1))
    }

    /// Writes frame `index`, as a whole or not at all.
    ///
    /// # Errors
    /// [`SequenceError::Frame`] for a frame of another size, or the reason why it cannot be
    /// written.
    pub fn write_frame(&mut self, index: usize, frame: &Frame) -> Result<(), SequenceError> {
        let path = self.path(index);
        let png = self.check_size(frame).and_then(|()| frame_png(frame));
        let png = png.map_err(|source| SequenceError::Frame(path.clone(), source))?;
        write_whole(&path, &png)?;
        self.remaining.retain(|&other| other != index);
        Ok(())
    }

    /// Makes the frames that remain by calling `picture` in order, and writes them. This
    /// compresses and writes each frame while you make the next one.
    ///
    /// # Errors
    /// An error of `picture`, after the frames before it were written, or an error of
    /// [`Self::write_frame`].
    pub fn write_frames<E: From<SequenceError>>(
        &mut self,
        mut picture: impl FnMut(usize) -> Result<Frame, E>,
    ) -> Result<(), E> {
        let mut made: Option<(usize, Frame)> = None;
        for index in self.remaining.clone() {
            let mut written = Ok(());
            let before = made.take();
            let sequence = &mut *self;
            let result = &mut written;
            let next = rayon::in_place_scope(|scope| {
                if let Some((index, frame)) = before {
                    scope.spawn(move |_| *result = sequence.write_frame(index, &frame));
                }
                picture(index)
            });
            written?;
            made = Some((index, next?));
        }
        if let Some((index, frame)) = made {
            self.write_frame(index, &frame)?;
        }
        Ok(())
    }

    /// The settings of these frames, with their number and size.
    #[must_use]
    pub fn settings(&self) -> &SequenceSettings {
        &self.settings
    }

    /// Reads all frames in order, one at a time.
    pub fn frames(&self) -> impl Iterator<Item = Result<Frame, SequenceError>> {
        (0..self.settings.frames).map(|index| {
            let path = self.path(index);
            let file = File::open(&path).map_err(at(&path))?;
            let frame = read_frame(BufReader::new(file));
            let checked = frame.and_then(|frame| self.check_size(&frame).map(|()| frame));
            checked.map_err(|source| SequenceError::Frame(path, source))
        })
    }

    /// Reads all frames in order, one at a time. This does not unpack those that
    /// [`Self::write_frame`] wrote.
    pub fn compressed(&self) -> impl Iterator<Item = Result<CompressedFrame, SequenceError>> {
        (0..self.settings.frames).map(|index| {
            let path = self.path(index);
            let bytes = fs::read(&path).map_err(at(&path))?;
            let frame = CompressedFrame::from_png(&bytes)
                .map_or_else(|| CompressedFrame::new(&read_frame(Cursor::new(&bytes))?), Ok);
            frame.map_err(|source| SequenceError::Frame(path, source))
        })
    }

    /// Removes all its frames and the manifest. This also removes the folder if nothing else is in
    /// it.
    ///
    /// # Errors
    /// [`SequenceError::Io`] if a file cannot be removed.
    pub fn remove(self) -> Result<(), SequenceError> {
        (0..self.settings.frames).try_for_each(|index| remove(&self.path(index)))?;
        remove(&self.folder.join(MANIFEST))?;
        let mut left = fs::read_dir(&self.folder).map_err(at(&self.folder))?;
        if left.next().is_none() {
            fs::remove_dir(&self.folder).map_err(at(&self.folder))?;
        }
        Ok(())
    }

    fn check_size(&self, frame: &Frame) -> Result<(), FrameError> {
        let wanted = [self.settings.width, self.settings.height];
        let found = [frame.width(), frame.height()];
        if wanted == found { Ok(()) } else { Err(FrameError::Differs { wanted, found }) }
    }

    fn is_complete(&self, index: usize) -> bool {
        let Ok(file) = File::open(self.path(index)) else { return false };
        read_frame(BufReader::new(file)).is_ok_and(|frame| self.check_size(&frame).is_ok())
    }

    fn write_manifest(&self) -> Result<(), SequenceError> {
        let path = self.folder.join(MANIFEST);
        let settings = self.settings.clone();
        let manifest = Manifest { format: FORMAT.to_owned(), version: VERSION, settings };
        let mut text = serde_json::to_vec_pretty(&manifest)
            .map_err(|error| SequenceError::Io(path.clone(), error.into()))?;
        text.push(b'\n');
        Ok(write_whole(&path, &text)?)
    }
}

fn at(path: &Path) -> impl Fn(std::io::Error) -> SequenceError {
    move |source| SequenceError::Io(path.to_owned(), source)
}

fn read_manifest(path: &Path) -> Result<Option<SequenceSettings>, SequenceError> {
    let text = match fs::read(path) {
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
        read => read.map_err(at(path))?,
    };
    let invalid = |reason| SequenceError::Manifest { path: path.to_owned(), reason };
    let manifest: Manifest =
        serde_json::from_slice(&text).map_err(|error| invalid(error.to_string()))?;
    if manifest.format != FORMAT || manifest.version != VERSION {
        let Manifest { format, version, .. } = manifest;
        return Err(invalid(format!("expected {FORMAT} {VERSION}, found `{format} {version}`")));
    }
    match manifest.settings.frames {
        0..=MOST_FRAMES => Ok(Some(manifest.settings)),
        frames => Err(invalid(format!("expected at most {MOST_FRAMES} frames, found `{frames}`"))),
    }
}

fn remove(path: &Path) -> Result<(), SequenceError> {
    match fs::remove_file(path) {
        Err(error) if error.kind() != ErrorKind::NotFound => Err(at(path)(error)),
        _ => Ok(()),
    }
}

/// File format of an animation.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum AnimationFormat {
    /// GIF, with 255 colours chosen for all its frames.
    Gif,
    /// Animated PNG, with all colours.
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

    /// Joins all frames of a folder at `rate`. It shows the last one for `last` frames, at least
    /// one.
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
        fn durations(index: usize, frames: usize, last: usize) -> usize {
            if index + 1 == frames { last.max(1) } else { 1 }
        }
        match self {
            Self::Gif => {
                let table = ColorTable::of(sequence.frames())?;
                let mut gif = Gif::new(Vec::new(), (width, height), rate, &table)?;
                for (index, frame) in sequence.frames().enumerate() {
                    gif.push_held(&frame?, durations(index, frames, last))?;
                }
                Ok(gif.finish()?)
            }
            Self::Apng => {
                let mut bytes = Vec::new();
                let mut apng = Apng::new(&mut bytes, (width, height), rate, frames)?;
                for (index, frame) in sequence.compressed().enumerate() {
                    apng.push_held(&frame?, durations(index, frames, last))?;
                }
                apng.finish()?;
                Ok(bytes)
            }
        }
    }
}

/// Name of the manifest. It states the settings of the frames in this folder.
pub(super) const MANIFEST: &str = "animation.json";

/// A folder of frames cannot be used.
#[derive(Debug, thiserror::Error, Explain)]
#[fault(Environment)]
pub enum SequenceError {
    /// A frame or the manifest cannot be written.
    #[error(transparent)]
    #[hint("is the folder writable, and is there room?")]
    #[fault(Environment)]
    File(#[from] FileError),
    /// A file or folder cannot be read or changed.
    #[error("{}: {source}", .0.display(), source = .1)]
    #[hint("is the folder writable, and is there room?")]
    Io(PathBuf, #[source] std::io::Error),
    /// The folder holds frames but no manifest with their settings.
    #[error("{}: the folder holds frames but no {MANIFEST}", .0.display())]
    #[hint("name an empty folder, or move the frames away")]
    Foreign(PathBuf),
    /// `animation.json` is not a manifest of this version.
    #[error("{}: {reason}", .path.display())]
    #[hint("name an empty folder, or remove this one")]
    Manifest {
        /// Path of the manifest.
        path: PathBuf,
        /// Reason why it is rejected.
        reason: String,
    },
    /// A frame cannot be encoded or decoded.
    #[error("{}: {source}", .0.display(), source = .1)]
    #[hint(inner)]
    Frame(PathBuf, #[source] FrameError),
    /// The frames cannot be joined to an animation.
    #[error(transparent)]
    Animation(#[from] FrameError),
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::field::Field;
    use documents::hint::Explain;
    use image::AnimationDecoder;
    use image::codecs::gif::GifDecoder;
    use image::codecs::png::PngDecoder;
    use std::io::Cursor;

    fn settings(digest: &str) -> SequenceSettings {
        SequenceSettings { settings: digest.to_owned(), frames: 3, width: 4, height: 2 }
    }

    fn frame(value: u8) -> Frame {
        Field::filled(4, 2, [value, 0, 255])
    }

    #[test]
    fn complete_frames_are_kept_and_broken_ones_rendered_again() {
        let folder = tempfile::tempdir().unwrap();
        let mut first = Sequence::open(folder.path(), settings("a")).unwrap();
        assert_eq!(first.remaining(), [0, 1, 2]);
        (0..3).for_each(|i| first.write_frame(i, &frame(i as u8)).unwrap());
        assert_eq!(first.remaining(), [0; 0]);
        let second = folder.path().join("frame-0002.png");
        let bytes = fs::read(&second).unwrap();
        fs::write(&second, &bytes[..bytes.len() - 5]).unwrap();
        let mut again = Sequence::open(folder.path(), settings("a")).unwrap();
        assert_eq!(again.remaining(), [1]);
        again.write_frame(1, &frame(9)).unwrap();
        let all: Vec<Frame> = again.frames().map(Result::unwrap).collect();
        assert_eq!(all, [frame(0), frame(9), frame(2)]);
        let names = fs::read_dir(folder.path()).unwrap().count();
        assert_eq!(names, 4, "three frames and a manifest");
    }

    #[test]
    fn frames_of_other_settings_are_removed_and_other_files_stay() {
        let folder = tempfile::tempdir().unwrap();
        let mut first = Sequence::open(folder.path(), settings("a")).unwrap();
        (0..3).for_each(|i| first.write_frame(i, &frame(0)).unwrap());
        fs::write(folder.path().join("mine.png"), b"mine").unwrap();
        let other = Sequence::open(folder.path(), settings("b")).unwrap();
        assert_eq!(other.remaining(), [0, 1, 2]);
        assert!(!other.path(0).exists());
        assert!(folder.path().join("mine.png").exists());
    }

    #[test]
    fn a_removed_sequence_leaves_what_is_not_its_own() {
        let folder = tempfile::tempdir().unwrap();
        let empty = folder.path().join("empty");
        let shared = folder.path().join("shared");
        for path in [&empty, &shared] {
            let mut sequence = Sequence::open(path, settings("a")).unwrap();
            sequence.write_frame(1, &frame(3)).unwrap();
            if path == &shared {
                fs::write(shared.join("mine.txt"), b"mine").unwrap();
            }
            sequence.remove().unwrap();
        }
        assert!(!empty.exists());
        let left: Vec<_> = fs::read_dir(&shared).unwrap().map(|e| e.unwrap().file_name()).collect();
        assert_eq!(left, ["mine.txt"]);
    }

    #[test]
    fn frames_without_manifest_and_invalid_manifests_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("frame-0002.png"), b"whose?").unwrap();
        let error = Sequence::open(folder.path(), settings("a")).unwrap_err();
        assert!(matches!(error, SequenceError::Foreign(..)) && error.hint().is_some());
        for text in ["", "{}", r#"{"format":"x","version":1,"shots":{}}"#] {
            fs::write(folder.path().join(MANIFEST), text).unwrap();
            let error = Sequence::open(folder.path(), settings("a")).unwrap_err();
            assert!(matches!(error, SequenceError::Manifest { .. }), "{error}");
        }
        let endless = r#"{"format":"impasto-animation","version":1,
            "shots":{"settings":"a","frames":1000000000,"width":4,"height":2}}"#;
        fs::write(folder.path().join(MANIFEST), endless).unwrap();
        let error = Sequence::open(folder.path(), settings("a")).unwrap_err();
        assert!(error.to_string().contains("`1000000000`"), "{error}");
        let newer = r#"{"format":"impasto-animation","version":2,
            "shots":{"settings":"a","frames":3,"width":4,"height":2}}"#;
        fs::write(folder.path().join(MANIFEST), newer).unwrap();
        let error = Sequence::open(folder.path(), settings("a")).unwrap_err();
        assert!(error.to_string().contains("`impasto-animation 2`"), "{error}");
    }

    #[test]
    fn frames_are_written_while_the_next_are_made_and_up_to_an_error() {
        let folder = tempfile::tempdir().unwrap();
        let mut sequence = Sequence::open(folder.path(), settings("a")).unwrap();
        let fail = FrameError::Rate(0.0);
        let made = sequence.write_frames(|index| match index {
            2 => Err(SequenceError::Animation(fail.clone())),
            _ => Ok(frame(index as u8)),
        });
        assert!(matches!(made, Err(SequenceError::Animation(_))), "{made:?}");
        assert_eq!(sequence.remaining(), [2]);
        let mut asked = Vec::new();
        let made: Result<(), SequenceError> = sequence.write_frames(|index| {
            asked.push(index);
            Ok(frame(index as u8))
        });
        made.unwrap();
        assert_eq!((asked, sequence.remaining()), (vec![2], &[][..]));
        let all: Vec<Frame> = sequence.frames().map(Result::unwrap).collect();
        assert_eq!(all, [frame(0), frame(1), frame(2)]);
        let wanted = all.iter().map(|frame| CompressedFrame::new(frame).unwrap());
        assert!(sequence.compressed().map(Result::unwrap).eq(wanted));
        fs::remove_file(sequence.path(1)).unwrap();
        let mut again = Sequence::open(folder.path(), settings("a")).unwrap();
        let small: Result<(), SequenceError> =
            again.write_frames(|_| Ok(Field::filled(1, 1, [0; 3])));
        assert!(small.unwrap_err().to_string().contains("frame-0002.png"));
    }

    #[test]
    fn a_frame_of_another_size_is_refused_with_its_path() {
        let folder = tempfile::tempdir().unwrap();
        let mut sequence = Sequence::open(folder.path(), settings("a")).unwrap();
        let error = sequence.write_frame(0, &Field::filled(2, 2, [0; 3])).unwrap_err();
        assert!(error.to_string().contains("frame-0001.png"), "{error}");
        assert_eq!(sequence.remaining(), [0, 1, 2]);
    }

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

    fn durations(frames: image::Frames<'_>) -> Vec<u32> {
        let frames = frames.collect_frames().unwrap();
        frames.iter().map(|frame| frame.delay().numer_denom_ms()).map(|(n, d)| n / d).collect()
    }

    #[test]
    fn formats_are_known_by_their_extension() {
        fn format(name: &str) -> Option<AnimationFormat> {
            AnimationFormat::from_path(Path::new(name))
        }
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
