//! Options for the cameras that see a subject, for an animation, and for a timelapse of a script.

use std::path::PathBuf;

use clap::Args;
use pictures::{AnimationRequest, LEAST_PX, MOST_FRAMES, MOST_PX, TimelapseRequest, ViewRequest};

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
    /// Let a model, a file of settings and a file of regions name files outside of their own folders.
    /// Without this, materials, textures, buffers, pictures and maps must lie in the folder of the file
    /// that names them, or below
    #[arg(long)]
    allow_outside: bool,
}

impl SubjectOptions {
    /// The size and the cameras that these options ask for.
    pub(crate) fn request(&self) -> ViewRequest {
        ViewRequest {
            width: self.width,
            height: self.height,
            camera: self.camera.clone(),
            turntable: self.turntable,
            allow_outside: self.allow_outside,
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

impl TimelapseOptions {
    /// The timelapse that these options ask for.
    pub(crate) fn request(&self) -> TimelapseRequest {
        let another = self.timelapse_every.is_some() || self.timelapse_seconds.is_some();
        TimelapseRequest {
            file: self.timelapse.clone(),
            frames: self.timelapse_frames.clone(),
            count: (!another).then_some(self.timelapse_count),
            every: self.timelapse_every,
            seconds: self.timelapse_seconds,
            size: self.timelapse_size,
            rate: self.timelapse_rate,
            hold: self.timelapse_hold,
            undone: self.timelapse_undone,
        }
    }
}
