//! Options for the subject: its size, and the cameras that see it.

use clap::Args;
use pictures::{LEAST_PX, MOST_FRAMES, MOST_PX, ViewRequest};

#[derive(Debug, Args)]
#[command(next_help_heading = "Subject")]
pub(crate) struct SubjectOptions {
    /// Width of the picture in pixels [default: a photograph's own, its longer side at most 1600;
    /// of a mesh 1000]
    #[arg(long, value_name = "PX", value_parser = clap::value_parser!(u64).range(LEAST_PX..=MOST_PX))]
    width: Option<u64>,
    /// Height of the picture of a mesh in pixels [default: three quarters of the width]
    #[arg(long, value_name = "PX", value_parser = clap::value_parser!(u64).range(LEAST_PX..=MOST_PX))]
    height: Option<u64>,
    /// Camera that shows all of a mesh: degrees around it and above the horizon, and the angle of
    /// view, such as `30,20,30`; or a file of keyframes (.toml). Of a picture, where its camera
    /// may move: degrees to the right and upwards
    #[arg(long, value_name = "DEG,DEG[,DEG]|FILE", allow_hyphen_values = true)]
    camera: Option<String>,
    /// Turn the camera around a mesh in this number of frames; before a picture, where its camera
    /// may move, it swings
    #[arg(long, value_name = "FRAMES", value_parser = clap::value_parser!(u64).range(1..=MOST_FRAMES))]
    turntable: Option<u64>,
}

impl SubjectOptions {
    /// Size and cameras of these options.
    pub(crate) fn request(&self) -> ViewRequest {
        ViewRequest {
            width: self.width,
            height: self.height,
            camera: self.camera.clone(),
            turntable: self.turntable,
        }
    }
}
