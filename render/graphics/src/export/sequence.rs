//! A folder of frames that can be left and taken up again.
//!
//! Beside the frames, `frame-0001.png` and on, lies `animation.json`: what they
//! were asked for with. Frames are kept if they are whole and of the same wish;
//! those of another are removed before the first new one is written, so that a
//! folder never holds frames of two wishes.

use std::fs::{self, File};
use std::io::{BufReader, ErrorKind, Write};
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::frame::{Frame, FrameError, frame_png, read_frame};

const MANIFEST: &str = "animation.json";
const FORMAT: &str = "impasto-animation";
const VERSION: u32 = 1;
/// More frames than this nobody asked for: ten hours at 25 a second.
const MOST: usize = 900_000;

/// What frames are asked for; the content of `animation.json`.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Shots {
    /// A digest of all that the frames depend on: settings and inputs.
    pub settings: String,
    /// How many frames.
    pub frames: usize,
    /// Pixels in a row.
    pub width: usize,
    /// Rows.
    pub height: usize,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Manifest {
    format: String,
    version: u32,
    shots: Shots,
}

/// Why a folder of frames cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum SequenceError {
    /// Reading or writing did not work.
    #[error("{}: {source}", .path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// Frames are there and nothing says whose.
    #[error("{}: here already, and no {MANIFEST} beside it says what for", .path.display())]
    Foreign {
        /// The first of them.
        path: PathBuf,
    },
    /// The manifest is none.
    #[error("{}: {reason}", .path.display())]
    Manifest {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        reason: String,
    },
    /// A frame cannot be made or read.
    #[error("{}: {source}", .path.display())]
    Frame {
        /// Its file.
        path: PathBuf,
        /// Why.
        source: FrameError,
    },
}

impl SequenceError {
    /// A way out, if there is one.
    #[must_use]
    pub fn hint(&self) -> Option<&'static str> {
        match self {
            Self::Io { .. } => Some("is the folder writable, and is there room?"),
            Self::Foreign { .. } => Some("name an empty folder, or move the frames away"),
            Self::Manifest { .. } => Some("name an empty folder, or remove this one"),
            Self::Frame { source, .. } => source.hint(),
        }
    }
}

/// A folder, and which of its frames are still to be made.
#[derive(Debug)]
pub struct Sequence {
    folder: PathBuf,
    shots: Shots,
    remaining: Vec<usize>,
}

impl Sequence {
    /// Opens `folder`, made where there is none, for `shots`. Frames of another
    /// wish are removed; no other file is touched.
    ///
    /// # Errors
    /// [`SequenceError`]: what cannot be read or written, frames without a
    /// manifest, a manifest that is none.
    pub fn open(folder: &Path, shots: Shots) -> Result<Self, SequenceError> {
        fs::create_dir_all(folder).map_err(at(folder))?;
        let mut sequence = Self { folder: folder.to_owned(), shots, remaining: Vec::new() };
        match read_manifest(&folder.join(MANIFEST))? {
            Some(before) if before == sequence.shots => {}
            Some(before) => {
                for index in 0..before.frames {
                    remove(&sequence.path(index))?;
                }
                sequence.write_manifest()?;
            }
            None => {
                let paths = (0..sequence.shots.frames).map(|index| sequence.path(index));
                if let Some(path) = paths.into_iter().find(|path| path.exists()) {
                    return Err(SequenceError::Foreign { path });
                }
                sequence.write_manifest()?;
            }
        }
        let missing = |index: &usize| !sequence.is_whole(*index);
        sequence.remaining = (0..sequence.shots.frames).filter(missing).collect();
        Ok(sequence)
    }

    /// The frames to be made, from 0 on, in order.
    #[must_use]
    pub fn remaining(&self) -> &[usize] {
        &self.remaining
    }

    /// The file of frame `index`, which counts from 0 while names count from 1.
    #[must_use]
    pub fn path(&self, index: usize) -> PathBuf {
        self.folder.join(format!("frame-{:04}.png", index + 1))
    }

    /// Writes frame `index`, whole or not at all.
    ///
    /// # Errors
    /// [`SequenceError::Frame`] for one of another size,
    /// [`SequenceError::Io`].
    pub fn keep(&mut self, index: usize, frame: &Frame) -> Result<(), SequenceError> {
        let path = self.path(index);
        let told = |source| SequenceError::Frame { path: path.clone(), source };
        self.check_size(frame).map_err(told)?;
        write_whole(&path, &frame_png(frame).map_err(told)?)?;
        self.remaining.retain(|&other| other != index);
        Ok(())
    }

    /// All frames in order, each read when it is asked for.
    pub fn frames(&self) -> impl Iterator<Item = Result<Frame, SequenceError>> {
        (0..self.shots.frames).map(|index| {
            let path = self.path(index);
            let file = File::open(&path).map_err(at(&path))?;
            let frame = read_frame(BufReader::new(file));
            let checked = frame.and_then(|frame| self.check_size(&frame).map(|()| frame));
            checked.map_err(|source| SequenceError::Frame { path, source })
        })
    }

    fn check_size(&self, frame: &Frame) -> Result<(), FrameError> {
        let wanted = [self.shots.width, self.shots.height];
        let found = [frame.width(), frame.height()];
        if wanted == found { Ok(()) } else { Err(FrameError::Differs { wanted, found }) }
    }

    fn is_whole(&self, index: usize) -> bool {
        let Ok(file) = File::open(self.path(index)) else { return false };
        read_frame(BufReader::new(file)).is_ok_and(|frame| self.check_size(&frame).is_ok())
    }

    fn write_manifest(&self) -> Result<(), SequenceError> {
        let path = self.folder.join(MANIFEST);
        let manifest =
            Manifest { format: FORMAT.to_owned(), version: VERSION, shots: self.shots.clone() };
        let mut text = serde_json::to_vec_pretty(&manifest)
            .map_err(|error| SequenceError::Io { path: path.clone(), source: error.into() })?;
        text.push(b'\n');
        write_whole(&path, &text)
    }
}

fn at(path: &Path) -> impl Fn(std::io::Error) -> SequenceError {
    move |source| SequenceError::Io { path: path.to_owned(), source }
}

fn read_manifest(path: &Path) -> Result<Option<Shots>, SequenceError> {
    let text = match fs::read(path) {
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
        read => read.map_err(at(path))?,
    };
    let told = |reason| SequenceError::Manifest { path: path.to_owned(), reason };
    let manifest: Manifest =
        serde_json::from_slice(&text).map_err(|error| told(error.to_string()))?;
    if manifest.format != FORMAT || manifest.version != VERSION {
        let Manifest { format, version, .. } = manifest;
        return Err(told(format!("{FORMAT} {VERSION} is wanted, found `{format} {version}`")));
    }
    match manifest.shots.frames {
        0..=MOST => Ok(Some(manifest.shots)),
        frames => Err(told(format!("at most {MOST} frames are wanted, found `{frames}`"))),
    }
}

fn remove(path: &Path) -> Result<(), SequenceError> {
    match fs::remove_file(path) {
        Err(error) if error.kind() != ErrorKind::NotFound => Err(at(path)(error)),
        _ => Ok(()),
    }
}

/// Through a file beside it, which then takes its name.
fn write_whole(path: &Path, bytes: &[u8]) -> Result<(), SequenceError> {
    let beside = path.with_extension("partial");
    let write = || {
        let mut file = File::create(&beside)?;
        file.write_all(bytes)?;
        file.sync_all()?;
        fs::rename(&beside, path)
    };
    write().map_err(|error| {
        // What is left of it is of no use; the first error is the one to tell.
        let _ = fs::remove_file(&beside);
        at(path)(error)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::field::Field;

    fn shots(settings: &str) -> Shots {
        Shots { settings: settings.to_owned(), frames: 3, width: 4, height: 2 }
    }

    fn frame(value: u8) -> Frame {
        Field::filled(4, 2, [value, 0, 255])
    }

    #[test]
    fn whole_frames_are_kept_and_broken_ones_made_anew() {
        let folder = tempfile::tempdir().unwrap();
        let mut first = Sequence::open(folder.path(), shots("a")).unwrap();
        assert_eq!(first.remaining(), [0, 1, 2]);
        (0..3).for_each(|i| first.keep(i, &frame(i as u8)).unwrap());
        assert_eq!(first.remaining(), [0; 0]);
        let second = folder.path().join("frame-0002.png");
        let bytes = fs::read(&second).unwrap();
        fs::write(&second, &bytes[..bytes.len() - 5]).unwrap();
        let mut again = Sequence::open(folder.path(), shots("a")).unwrap();
        assert_eq!(again.remaining(), [1]);
        again.keep(1, &frame(9)).unwrap();
        let all: Vec<Frame> = again.frames().map(Result::unwrap).collect();
        assert_eq!(all, [frame(0), frame(9), frame(2)]);
        let names = fs::read_dir(folder.path()).unwrap().count();
        assert_eq!(names, 4, "three frames and a manifest");
    }

    #[test]
    fn frames_of_another_wish_are_removed_and_other_files_are_not() {
        let folder = tempfile::tempdir().unwrap();
        let mut first = Sequence::open(folder.path(), shots("a")).unwrap();
        (0..3).for_each(|i| first.keep(i, &frame(0)).unwrap());
        fs::write(folder.path().join("mine.png"), b"mine").unwrap();
        let other = Sequence::open(folder.path(), shots("b")).unwrap();
        assert_eq!(other.remaining(), [0, 1, 2]);
        assert!(!other.path(0).exists());
        assert!(folder.path().join("mine.png").exists());
    }

    #[test]
    fn frames_of_nobody_and_manifests_that_are_none_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("frame-0002.png"), b"whose?").unwrap();
        let error = Sequence::open(folder.path(), shots("a")).unwrap_err();
        assert!(matches!(error, SequenceError::Foreign { .. }) && error.hint().is_some());
        for text in ["", "{}", r#"{"format":"x","version":1,"shots":{}}"#] {
            fs::write(folder.path().join(MANIFEST), text).unwrap();
            let error = Sequence::open(folder.path(), shots("a")).unwrap_err();
            assert!(matches!(error, SequenceError::Manifest { .. }), "{error}");
        }
        let endless = r#"{"format":"impasto-animation","version":1,
            "shots":{"settings":"a","frames":1000000000,"width":4,"height":2}}"#;
        fs::write(folder.path().join(MANIFEST), endless).unwrap();
        let error = Sequence::open(folder.path(), shots("a")).unwrap_err();
        assert!(error.to_string().contains("`1000000000`"), "{error}");
        let newer = r#"{"format":"impasto-animation","version":2,
            "shots":{"settings":"a","frames":3,"width":4,"height":2}}"#;
        fs::write(folder.path().join(MANIFEST), newer).unwrap();
        let error = Sequence::open(folder.path(), shots("a")).unwrap_err();
        assert!(error.to_string().contains("`impasto-animation 2`"), "{error}");
    }

    #[test]
    fn a_frame_of_another_size_is_told() {
        let folder = tempfile::tempdir().unwrap();
        let mut sequence = Sequence::open(folder.path(), shots("a")).unwrap();
        let error = sequence.keep(0, &Field::filled(2, 2, [0; 3])).unwrap_err();
        assert!(error.to_string().contains("frame-0001.png"), "{error}");
        assert_eq!(sequence.remaining(), [0, 1, 2]);
    }
}
