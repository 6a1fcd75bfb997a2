//! Options and files of an animation: a folder of frames that can be resumed, and one file.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use clap::Args;
use graphics::export::{AnimationFormat, Frame, FrameRate, Sequence, SequenceSettings};
use sha2::{Digest, Sha256};

use crate::console::Console;
use crate::failure::{Context, Failure, Result};
use crate::output::{Output, OutputFolder};
use crate::progress::Progress;

#[derive(Debug, Args)]
#[command(next_help_heading = "Animation")]
pub(crate) struct AnimationOptions {
    /// Write the frames of a moving camera into one file: .gif, or .png (APNG, all colours)
    #[arg(long, value_name = "FILE")]
    animation: Option<PathBuf>,
    /// Keep each frame in this folder as PNG, from which an interrupted run continues
    /// [default: FILE.frames beside the animation]
    #[arg(long, value_name = "FOLDER")]
    frames: Option<PathBuf>,
    /// Frames per second
    #[arg(long, value_name = "RATE", default_value_t = 25.0, allow_negative_numbers = true)]
    rate: f64,
}

/// Outputs of frames: a folder, and an animation file that was checked to be writable.
pub(crate) struct Animation {
    file: Option<(Output, AnimationFormat)>,
    frames: PathBuf,
    rate: FrameRate,
}

/// A folder of frames that is being completed.
pub(crate) struct Recording {
    animation: Animation,
    sequence: Sequence,
    /// Number of frames.
    frames: usize,
}

impl AnimationOptions {
    /// Whether frames are requested.
    pub(crate) fn any(&self) -> bool {
        self.animation.is_some() || self.frames.is_some()
    }

    /// Frames per second.
    pub(crate) fn rate(&self) -> f64 {
        self.rate
    }

    /// Checks that the animation can be written. Returns `None` if no frames are requested.
    pub(crate) fn open(&self, inputs: &[PathBuf]) -> Result<Option<Animation>> {
        let rate = FrameRate::new(self.rate).context(|| "--rate takes another value")?;
        let file = match &self.animation {
            None => None,
            Some(path) => Some((Output::open(path, inputs)?, format(path)?)),
        };
        let beside = self.animation.as_ref().map(|path| path.with_extension("frames"));
        let frames = self.frames.clone().or(beside);
        if let Some(folder) = &frames {
            OutputFolder::open(folder, inputs)?;
        }
        Ok(frames.map(|frames| Animation { file, frames, rate }))
    }
}

/// Format of an animation, from the extension of `path`.
pub(crate) fn format(path: &Path) -> Result<AnimationFormat> {
    AnimationFormat::from_path(path).ok_or_else(|| {
        Failure::usage(
            format!(
                "{}: expected an animation whose name ends in .gif, .png or .apng",
                path.display()
            ),
            format!("try {}", path.with_extension("gif").display()),
        )
    })
}

/// SHA-256 digest of all inputs of the frames. Frames of another digest are painted again.
#[derive(Clone, Default)]
pub(crate) struct FramesDigest(Sha256);

impl FramesDigest {
    /// Adds an input of the frames to the digest.
    pub(crate) fn add(mut self, input: &impl std::fmt::Debug) -> Self {
        // Writing to a digest cannot fail.
        let _ = write!(self, "{input:?}");
        self.0.update([0]);
        self
    }

    /// Its hexadecimal digits.
    pub(crate) fn text(self) -> String {
        self.0.finalize().iter().map(|byte| format!("{byte:02x}")).collect()
    }
}

impl std::fmt::Write for FramesDigest {
    fn write_str(&mut self, text: &str) -> std::fmt::Result {
        self.0.update(text);
        Ok(())
    }
}

impl Animation {
    /// The animation file, if one is requested.
    pub(crate) fn file(&self) -> Option<&Output> {
        self.file.as_ref().map(|(output, _)| output)
    }

    /// The folder of frames.
    pub(crate) fn folder(&self) -> &Path {
        &self.frames
    }

    /// Opens the folder of frames. Frames of this digest are kept, all others are removed.
    pub(crate) fn begin(
        self,
        digest: FramesDigest,
        frames: usize,
        size: (usize, usize),
    ) -> Result<Recording> {
        let settings = digest.text();
        let (width, height) = size;
        let sequence =
            Sequence::open(&self.frames, SequenceSettings { settings, frames, width, height })?;
        Ok(Recording { animation: self, sequence, frames })
    }
}

impl Recording {
    /// Paints the missing frames with `picture`, then writes the animation. Returns how many
    /// frames existed already.
    pub(crate) fn paint(
        self,
        console: &mut Console<'_>,
        mut picture: impl FnMut(usize) -> Result<Frame>,
    ) -> Result<usize> {
        let Self { animation, mut sequence, frames } = self;
        let remaining = sequence.remaining().len();
        let bar = Progress::new(remaining, "painting", console.shows_progress());
        sequence.write_frames(|index| -> Result<Frame> {
            let picture = picture(index)?;
            bar.step();
            Ok(picture)
        })?;
        bar.done();
        console.wrote(&animation.frames)?;
        if let Some((output, format)) = animation.file {
            output.write(format.encode(&sequence, (animation.rate, 1))?, console)?;
        }
        Ok(frames - remaining)
    }
}
