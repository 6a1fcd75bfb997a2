//! Frames of a moving camera: a folder from which an interrupted run continues, and one file.

use std::{
    fmt::{self, Debug, Write as _},
    path::{Path, PathBuf},
};

use documents::{
    Task,
    file::{Output, OutputFolder},
};
use graphics::export::{
    AnimationFormat, Frame, FrameRate, Sequence, SequenceError, SequenceSettings,
};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use crate::error::{PictureError, SettingError};
use crate::exports::{Listener, Note, write};

/// The file of an animation and its frames.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct AnimationRequest {
    /// Write the frames of a moving camera into one file: .gif, or .png (APNG, all colours)
    pub animation: Option<PathBuf>,
    /// Keep each frame in this folder as PNG, from which an interrupted run continues
    /// [default: FILE.frames beside the animation]
    pub frames: Option<PathBuf>,
    /// Frames per second
    pub rate: f64,
}

impl Default for AnimationRequest {
    fn default() -> Self {
        Self { animation: None, frames: None, rate: 25.0 }
    }
}

/// Outputs of frames: a folder, and an animation file that was checked to be writable.
#[derive(Debug)]
pub struct Animation {
    file: Option<(Output, AnimationFormat)>,
    frames: PathBuf,
    rate: FrameRate,
}

/// A folder of frames that is being completed.
#[derive(Debug)]
pub struct Recording {
    animation: Animation,
    sequence: Sequence,
    frames: usize,
}

impl AnimationRequest {
    /// Whether frames are requested.
    #[must_use]
    pub fn any(&self) -> bool {
        self.animation.is_some() || self.frames.is_some()
    }

    /// Checks that the animation can be written. Returns `None` if no frames are requested.
    ///
    /// # Errors
    /// [`PictureError`] for a frame rate or a file ending that no animation has, or a file or
    /// folder that cannot be written.
    pub fn open(&self, inputs: &[PathBuf]) -> Result<Option<Animation>, PictureError> {
        let rate = FrameRate::new(self.rate)
            .map_err(|error| SettingError::because("rate", "takes another value", error))?;
        let file = match &self.animation {
            None => None,
            Some(path) => Some((Output::open(path, inputs)?, animation_format(path)?)),
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
///
/// # Errors
/// [`SettingError`] if the path has another extension than .gif, .png or .apng.
pub fn animation_format(path: &Path) -> Result<AnimationFormat, SettingError> {
    AnimationFormat::from_path(path).ok_or_else(|| {
        let message = format!(
            "{}: expected an animation whose name ends in .gif, .png or .apng",
            path.display()
        );
        let hint = format!("try {}", path.with_extension("gif").display());
        SettingError::whole(message, "").verbatim(hint)
    })
}

/// SHA-256 digest of all inputs of the frames. Frames of another digest are painted again.
#[derive(Debug, Clone, Default)]
pub struct FramesDigest(Sha256);

impl FramesDigest {
    /// Adds an input of the frames to the digest.
    #[must_use]
    pub fn with(mut self, input: &impl Debug) -> Self {
        // Writing to a digest cannot fail.
        let _ = write!(self, "{input:?}");
        self.0.update([0]);
        self
    }

    /// The digest in hexadecimal digits.
    #[must_use]
    pub fn text(self) -> String {
        self.0.finalize().iter().map(|byte| format!("{byte:02x}")).collect()
    }
}

impl fmt::Write for FramesDigest {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        self.0.update(text);
        Ok(())
    }
}

impl Animation {
    /// The animation file, if one is requested.
    #[must_use]
    pub fn file(&self) -> Option<&Output> {
        self.file.as_ref().map(|(output, _)| output)
    }

    /// The folder of frames.
    #[must_use]
    pub fn folder(&self) -> &Path {
        &self.frames
    }

    /// Opens the folder of frames. It keeps the frames painted from inputs of this digest and
    /// removes all others.
    ///
    /// # Errors
    /// [`SequenceError`] if the folder holds frames but no valid manifest, or cannot be written.
    pub fn begin(
        self,
        digest: FramesDigest,
        frames: usize,
        (width, height): (usize, usize),
    ) -> Result<Recording, SequenceError> {
        let settings = digest.text();
        let sequence =
            Sequence::open(&self.frames, SequenceSettings { settings, frames, width, height })?;
        Ok(Recording { animation: self, sequence, frames })
    }
}

impl Recording {
    /// Paints the missing frames with `picture`, then writes the animation. Returns how many
    /// frames existed already.
    ///
    /// # Errors
    /// The errors of `picture`, and [`PictureError`] if a file cannot be written or `task` is cancelled.
    pub fn paint<E: From<PictureError> + From<SequenceError>>(
        self,
        task: &Task,
        listener: &mut Listener<'_>,
        mut picture: impl FnMut(usize) -> Result<Frame, E>,
    ) -> Result<usize, E> {
        let Self { animation, mut sequence, frames } = self;
        let remaining = sequence.remaining().len();
        task.stage("painting");
        let steps = task.steps(remaining);
        sequence.write_frames(|index| -> Result<Frame, E> {
            task.check().map_err(PictureError::from)?;
            let picture = picture(index)?;
            steps.step();
            Ok(picture)
        })?;
        listener(Note::Wrote(animation.frames));
        if let Some((output, format)) = animation.file {
            write(&output, format.encode(&sequence, (animation.rate, 1))?, listener)?;
        }
        Ok(frames - remaining)
    }
}
