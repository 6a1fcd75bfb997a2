//! Timelapses as files.

use std::ops::ControlFlow;
use std::path::PathBuf;

use documents::file::write_whole;
use graphics::export::{AnimationFormat, FrameRate, Sequence, SequenceSettings};
use sha2::{Digest, Sha256};

use super::error::TimelapseError;
use super::plan::Timelapse;
use crate::session::PaintingSession;

/// Share of the work that is playing the script; the rest is joining the frames.
const PLAYING: f64 = 0.9;

/// Files of a timelapse.
#[derive(Debug, Clone, PartialEq)]
pub struct TimelapseFiles {
    /// The file of all frames and its format; `None` writes frames only.
    pub animation: Option<(PathBuf, AnimationFormat)>,
    /// Folder of the frames. Those of the same script and settings are kept from an interrupted
    /// run; see [`Sequence`].
    pub frames: PathBuf,
    /// Whether the frames stay once the animation is written or the work is ended. If the program
    /// itself is ended they stay in any case.
    pub keep_frames: bool,
    /// Frames a second.
    pub rate: FrameRate,
    /// Seconds for which the animation shows its last frame, 0 to 60; at least one frame.
    pub hold_seconds: f64,
}

impl TimelapseFiles {
    /// Checks the ranges.
    ///
    /// # Errors
    /// [`TimelapseError::Setting`].
    pub fn check(&self) -> Result<(), TimelapseError> {
        let found = self.hold_seconds;
        if (0.0..=60.0).contains(&found) {
            return Ok(());
        }
        let name = "hold";
        let wanted = "0 to 60 s";
        Err(TimelapseError::Setting { name, wanted, found })
    }
}

impl Timelapse<'_> {
    /// Plays the script on `session`, which must be as the script begins, and writes the files.
    /// `report` is told the share that is done, 0 to 1, and can end the work. Frames that stayed
    /// from an earlier run are not taken again. Returns how many did, or `None` if the work was
    /// ended.
    ///
    /// # Errors
    /// [`TimelapseError`] if the script cannot be played, or a file cannot be written.
    pub fn write(
        &self,
        session: &mut PaintingSession,
        files: &TimelapseFiles,
        mut report: impl FnMut(f64) -> ControlFlow<()>,
    ) -> Result<Option<usize>, TimelapseError> {
        files.check()?;
        let (width, height) = self.size(session);
        let frames = self.frames();
        let settings = self.digest(session)?;
        let settings = SequenceSettings { settings, frames, width, height };
        let mut sequence = Sequence::open(&files.frames, settings)?;
        let missing = sequence.remaining().to_vec();
        let played = self.play(
            session,
            &missing,
            |done: f64| report(PLAYING * done),
            |index, frame| Ok(sequence.write_frame(index, &frame)?),
        )?;
        if played.is_break() || report(PLAYING).is_break() {
            if !files.keep_frames {
                sequence.remove()?;
            }
            return Ok(None);
        }
        if let Some((path, format)) = &files.animation {
            let held = files.rate.frames_in(files.hold_seconds);
            write_whole(path, &format.encode(&sequence, (files.rate, held))?)?;
            if !files.keep_frames {
                sequence.remove()?;
            }
        }
        Ok(Some(frames - missing.len()))
    }

    /// SHA-256 digest of all that the frames depend on.
    fn digest(&self, session: &mut PaintingSession) -> Result<String, TimelapseError> {
        let mut digest = Sha256::new();
        digest.update(self.script.to_json()?);
        digest.update(format!("{:?}", self.settings));
        digest.update(session.canvas().library().to_json());
        // Light is computed in f32, which differs between backends.
        digest.update(session.canvas().backend());
        if self.script.start.is_some() {
            digest.update(crate::file::write(&session.canvas_mut().document()?)?);
        }
        Ok(digest.finalize().iter().map(|byte| format!("{byte:02x}")).collect())
    }
}
