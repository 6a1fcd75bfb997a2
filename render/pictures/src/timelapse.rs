//! Options and files of a timelapse, which shows how a script is painted.

use std::{
    ops::ControlFlow,
    path::{Path, PathBuf},
};

use documents::{
    Task,
    file::{Output, OutputFolder},
};
use graphics::export::{AnimationFormat, FrameRate};
use paint::{
    session::PaintingSession,
    strokes::StrokeScript,
    timelapse::{Interval, Timelapse, TimelapseFiles, TimelapseSettings},
};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::animation::animation_format;
use crate::error::{PictureError, SettingError};
use crate::exports::{Listener, Note, OpenExports};

/// Number of frames if you do not ask for another number.
const FRAMES: usize = 250;

/// Steps of the progress.
const STEPS: u64 = 1000;

/// A timelapse of a script. We play the script once more for it. Without `file` and `frames`, we make no
/// timelapse.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
#[schemars(
    description = "A timelapse of a script. Give at most one of `count`, `every` and `seconds`"
)]
pub struct TimelapseRequest {
    /// Write how the script is painted: .gif, or .png (APNG, all colours)
    pub file: Option<PathBuf>,
    /// Keep each frame in this folder as PNG, from which an interrupted run continues
    /// [default: FILE.frames beside the timelapse]
    pub frames: Option<PathBuf>,
    /// Number of frames, spread evenly over the time that strokes on the canvas take [default: 250]
    pub count: Option<usize>,
    /// Take a frame after every so many actions that change the canvas
    pub every: Option<usize>,
    /// Take a frame after every so many seconds of strokes on the canvas
    pub seconds: Option<f64>,
    /// Longest side of a frame in pixels; a canvas with fewer cells gets one pixel for each cell
    pub size: usize,
    /// Frames per second
    pub rate: f64,
    /// How long the last frame is shown, in seconds
    pub hold: f64,
    /// Also show passages that are undone later
    pub undone: bool,
}

impl Default for TimelapseRequest {
    fn default() -> Self {
        Self {
            file: None,
            frames: None,
            count: None,
            every: None,
            seconds: None,
            size: 960,
            rate: 25.0,
            hold: 2.0,
            undone: false,
        }
    }
}

impl TimelapseRequest {
    /// How often a frame is taken.
    fn interval(&self) -> Result<Interval, SettingError> {
        match (self.count, self.every, self.seconds) {
            (None, None, None) => Ok(Interval::Frames(FRAMES)),
            (Some(count), None, None) => Ok(Interval::Frames(count)),
            (None, Some(count), None) => Ok(Interval::Actions(count)),
            (None, None, Some(seconds)) => Ok(Interval::Seconds(seconds)),
            _ => {
                let reason =
                    "is one of three keys (count, every, seconds), and only one may be there";
                Err(SettingError::of("timelapse.count", reason, "leave all but one of them out"))
            }
        }
    }

    /// Checks settings and files. Returns `None` if no timelapse is requested. The file must not be one of
    /// `exports`.
    pub(crate) fn open(
        &self,
        inputs: &[PathBuf],
        exports: &OpenExports,
    ) -> Result<Option<OpenTimelapse>, PictureError> {
        let beside = self.file.as_ref().map(|path| path.with_extension("frames"));
        let Some(frames) = self.frames.clone().or(beside) else { return Ok(None) };
        let interval = self.interval()?;
        let settings =
            TimelapseSettings { interval, longest_px: self.size, with_undone: self.undone };
        settings.check().map_err(timelapse_error)?;
        let rate = FrameRate::new(self.rate).map_err(|error| {
            SettingError::because("timelapse.rate", "takes another value", error)
        })?;
        let animation = self.file.as_deref();
        let animation = animation.map(|path| animation_of(path, inputs, exports)).transpose()?;
        OutputFolder::open(&frames, inputs)?;
        let hold_seconds = self.hold;
        let files = TimelapseFiles { animation, frames, keep_frames: true, rate, hold_seconds };
        files.check().map_err(timelapse_error)?;
        Ok(Some(OpenTimelapse { settings, files }))
    }
}

fn timelapse_error(error: paint::timelapse::TimelapseError) -> PictureError {
    PictureError::from(error).within("the timelapse")
}

fn animation_of(
    path: &Path,
    inputs: &[PathBuf],
    exports: &OpenExports,
) -> Result<(PathBuf, AnimationFormat), PictureError> {
    let format = animation_format(path)?;
    let output = Output::open(path, inputs)?;
    if exports.writes(&output) {
        return Err(output.used_twice().into());
    }
    Ok((path.to_owned(), format))
}

/// A timelapse. We have checked that you can write its files.
#[derive(Debug)]
pub(crate) struct OpenTimelapse {
    settings: TimelapseSettings,
    files: TimelapseFiles,
}

/// Figures of a timelapse that was written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct TimelapseOutcome {
    /// Number of frames.
    pub frames: usize,
    /// Number of frames that existed already.
    #[serde(rename = "frames_found")]
    pub found: usize,
    /// Width and height in pixels.
    pub size: (usize, usize),
}

impl OpenTimelapse {
    /// Plans the timelapse of `script`.
    pub(crate) fn plan<'a>(&self, script: &'a StrokeScript) -> Result<Timelapse<'a>, PictureError> {
        Timelapse::new(script, self.settings).map_err(timelapse_error)
    }

    /// Plays `script` on `session` and writes the files. The session must be in the state in which the script
    /// begins.
    pub(crate) fn write(
        &self,
        script: &StrokeScript,
        session: &mut PaintingSession,
        task: &Task,
        listener: &mut Listener<'_>,
    ) -> Result<TimelapseOutcome, PictureError> {
        let timelapse = self.plan(script)?;
        task.stage("timelapse");
        let found = timelapse.write(session, &self.files, |done| {
            task.done((done * STEPS as f64) as u64, STEPS);
            if task.is_cancelled() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        })?;
        let Some(found) = found else { return Err(documents::Cancelled.into()) };
        listener(Note::Wrote(self.files.frames.clone()));
        if let Some((path, _)) = &self.files.animation {
            listener(Note::Wrote(path.clone()));
        }
        let frames = timelapse.frames();
        Ok(TimelapseOutcome { frames, found, size: timelapse.size(session) })
    }
}
