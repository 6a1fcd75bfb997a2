//! The steps of the pictures of a run.

use volumes::script::{frames_fit, steps_of};
use volumes::toml_text::Fault;

use super::scene::OpenScript;
use crate::failure::{Failure, Result};

/// Steps of a world at which pictures are made.
pub(super) struct Times {
    /// Step of single pictures.
    pub(super) still: u64,
    /// Steps of the frames.
    pub(super) frames: Vec<u64>,
}

impl Times {
    /// The step of a still at `at` seconds, the end without it, and those of `frames` frames at
    /// `rate` frames a second, of which late ones show the end of a script of `seconds`.
    pub(super) fn of(seconds: f64, at: Option<f64>, rate: f64, frames: usize) -> Result<Self> {
        let at = at.unwrap_or(seconds);
        if !(0.0..=seconds).contains(&at) {
            return Err(Failure::usage(
                format!("--at takes 0 to {seconds} s, found `{at}`"),
                "leave it out for the end, or give more --seconds",
            ));
        }
        let step = |seconds: f64| u64::from(steps_of(seconds));
        let frames = (0..frames).map(|frame| step((frame as f64 / rate).min(seconds)));
        Ok(Self { still: step(at), frames: frames.collect() })
    }

    /// Number of frames of a script at `rate` frames a second.
    pub(super) fn frames(script: &OpenScript, rate: f64) -> Result<usize, Box<Fault>> {
        frames_fit(script.script.seconds, rate).map(|frames| frames as usize)
    }

    /// The last step of all.
    pub(super) fn last(&self) -> u64 {
        self.frames.iter().copied().fold(self.still, u64::max)
    }
}
