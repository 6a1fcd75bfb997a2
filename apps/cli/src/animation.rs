//! Options for the cameras that see a subject, for an animation, and for a timelapse of a script. This
//! file also opens and writes the files of a timelapse.

use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

use clap::Args;
use graphics::export::{AnimationFormat, FrameRate};
use paint::session::PaintingSession;
use paint::strokes::StrokeScript;
use paint::timelapse::{Interval, Timelapse, TimelapseFiles, TimelapseSettings};
use pictures::{AnimationRequest, LEAST_PX, MOST_FRAMES, MOST_PX, ViewRequest, animation_format};

use crate::console::Console;
use crate::failure::{Context, Result};
use crate::output::{Output, OutputFolder};
use crate::progress::Progress;

#[derive(Debug, Args)]
#[command(next_help_heading = "Subject")]
pub(crate) struct SubjectOptions {
    /// Width of the picture in pixels [default: for a photograph its own width, but its longer side at
    /// most 1600; for a mesh 1000]
    #[arg(long, value_name = "PX", value_parser = clap::value_parser!(u64).range(LEAST_PX..=MOST_PX))]
    width: Option<u64>,
    /// Height of the picture of a mesh in pixels [default: three quarters of the width]
    #[arg(long, value_name = "PX", value_parser = clap::value_parser!(u64).range(LEAST_PX..=MOST_PX))]
    height: Option<u64>,
    /// Camera. For a mesh: degrees around it, degrees above the horizon, and the angle of view, such
    /// as `30,20,30`, at a distance that shows the whole mesh; or a file of keyframes (.toml). For a
    /// picture that can be turned (in `stencil`, and in `painterly` with a depth map): degrees to the
    /// right and upwards, such as `8,4`
    #[arg(long, value_name = "DEG,DEG[,DEG]|FILE", allow_hyphen_values = true)]
    camera: Option<String>,
    /// Turn the camera around a mesh in this number of frames. In front of a picture that can be
    /// turned, the camera swings from side to side
    #[arg(long, value_name = "FRAMES", value_parser = clap::value_parser!(u64).range(1..=MOST_FRAMES))]
    turntable: Option<u64>,
}

impl SubjectOptions {
    /// The size and the cameras that these options ask for.
    pub(crate) fn request(&self) -> ViewRequest {
        ViewRequest {
            width: self.width,
            height: self.height,
            camera: self.camera.clone(),
            turntable: self.turntable,
        }
    }
}

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

impl AnimationOptions {
    /// The animation that these options ask for.
    pub(crate) fn request(&self) -> AnimationRequest {
        AnimationRequest {
            animation: self.animation.clone(),
            frames: self.frames.clone(),
            rate: self.rate,
        }
    }
}

/// Steps of the progress bar.
const STEPS: usize = 1000;

#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "Timelapse")]
pub(crate) struct TimelapseOptions {
    /// Write how the script is painted: .gif, or .png (APNG, all colours). The script is played once
    /// more for it
    #[arg(long, value_name = "FILE", conflicts_with = "from")]
    timelapse: Option<PathBuf>,
    /// Keep each frame in this folder as PNG, from which an interrupted run continues
    /// [default: FILE.frames beside the timelapse]
    #[arg(long, value_name = "FOLDER", conflicts_with = "from")]
    timelapse_frames: Option<PathBuf>,
    /// Number of frames, spread evenly over the time that strokes on the canvas take
    #[arg(long, value_name = "N", default_value_t = 250)]
    timelapse_count: usize,
    /// Take a frame after every N actions that change the canvas
    #[arg(long, value_name = "N", conflicts_with = "timelapse_count")]
    timelapse_every: Option<usize>,
    /// Take a frame after every so many seconds of strokes on the canvas
    #[arg(
        long,
        value_name = "SECONDS",
        allow_negative_numbers = true,
        conflicts_with_all = ["timelapse_count", "timelapse_every"]
    )]
    timelapse_seconds: Option<f64>,
    /// Longest side of a frame in pixels; a canvas with fewer cells gets one pixel for each cell
    #[arg(long, value_name = "PX", default_value_t = 960)]
    timelapse_size: usize,
    /// Frames per second
    #[arg(long, value_name = "RATE", default_value_t = 25.0, allow_negative_numbers = true)]
    timelapse_rate: f64,
    /// How long the last frame is shown, in seconds
    #[arg(long, value_name = "SECONDS", default_value_t = 2.0, allow_negative_numbers = true)]
    timelapse_hold: f64,
    /// Also show passages that are undone later
    #[arg(long)]
    timelapse_undone: bool,
}

/// A timelapse. We have checked that you can write its files.
pub(crate) struct OpenTimelapse {
    settings: TimelapseSettings,
    files: TimelapseFiles,
}

/// Figures of a timelapse that was written.
pub(crate) struct TimelapseReport {
    pub(crate) frames: usize,
    /// Number of frames that existed already.
    pub(crate) found: usize,
    /// Width and height in pixels.
    pub(crate) size: (usize, usize),
}

impl TimelapseOptions {
    /// Checks settings and files. Returns `None` if no timelapse is requested. `writes` says
    /// whether another output of the verb already writes this file.
    pub(crate) fn open(
        &self,
        inputs: &[PathBuf],
        writes: impl Fn(&Output) -> bool,
    ) -> Result<Option<OpenTimelapse>> {
        let beside = self.timelapse.as_ref().map(|path| path.with_extension("frames"));
        let Some(frames) = self.timelapse_frames.clone().or(beside) else { return Ok(None) };
        let interval = match (self.timelapse_every, self.timelapse_seconds) {
            (Some(count), _) => Interval::Actions(count),
            (None, Some(seconds)) => Interval::Seconds(seconds),
            (None, None) => Interval::Frames(self.timelapse_count),
        };
        let longest_px = self.timelapse_size;
        let with_undone = self.timelapse_undone;
        let settings = TimelapseSettings { interval, longest_px, with_undone };
        settings.check().context(|| "the timelapse")?;
        let rate = FrameRate::new(self.timelapse_rate)
            .context(|| "--timelapse-rate takes another value")?;
        let animation = self.timelapse.as_deref();
        let animation = animation.map(|path| file(path, inputs, writes)).transpose()?;
        OutputFolder::open(&frames, inputs)?;
        let hold_seconds = self.timelapse_hold;
        let files = TimelapseFiles { animation, frames, keep_frames: true, rate, hold_seconds };
        files.check().context(|| "the timelapse")?;
        Ok(Some(OpenTimelapse { settings, files }))
    }
}

fn file(
    path: &Path,
    inputs: &[PathBuf],
    writes: impl Fn(&Output) -> bool,
) -> Result<(PathBuf, AnimationFormat)> {
    let format = animation_format(path)?;
    let output = Output::open(path, inputs)?;
    if writes(&output) {
        return Err(output.used_twice().into());
    }
    Ok((path.to_owned(), format))
}

impl OpenTimelapse {
    /// Plans the timelapse of `script`.
    pub(crate) fn plan<'a>(&self, script: &'a StrokeScript) -> Result<Timelapse<'a>> {
        Timelapse::new(script, self.settings).context(|| "the timelapse")
    }

    /// Plays `timelapse` on `session`, which must be as its script begins, and writes the files.
    pub(crate) fn write(
        &self,
        timelapse: &Timelapse<'_>,
        session: &mut PaintingSession,
        console: &mut Console<'_>,
    ) -> Result<TimelapseReport> {
        let bar = Progress::new(STEPS, "timelapse", console.shows_progress());
        let mut shown = 0;
        let found = timelapse.write(session, &self.files, |done| {
            while shown < (done * STEPS as f64) as usize {
                bar.step();
                shown += 1;
            }
            ControlFlow::Continue(())
        });
        bar.done();
        let found = found?.unwrap_or(0);
        console.wrote(&self.files.frames)?;
        if let Some((path, _)) = &self.files.animation {
            console.wrote(path)?;
        }
        let frames = timelapse.frames();
        let size = timelapse.size(session);
        Ok(TimelapseReport { frames, found, size })
    }
}
