//! Options for directions of strokes and the depth of a picture.

use std::path::{Path, PathBuf};

use clap::Args;
use render::painterly::{FlowPicture, PictureForm};

use crate::failure::{Failure, Result};

#[derive(Debug, Args)]
#[command(next_help_heading = "Subject")]
pub(super) struct FormOptions {
    /// Directions and flow of strokes on a picture: a PNG whose red (to the right) and green
    /// (upwards) point about one half, and whose blue is the strength
    #[arg(long, value_name = "FILE")]
    directions: Option<PathBuf>,
    /// Depth of a picture, which makes a relief of it: white is near, black is far (.png, .jpg)
    #[arg(long, value_name = "FILE")]
    depth: Option<PathBuf>,
}

impl FormOptions {
    /// Files of the form.
    pub(super) fn inputs(&self) -> impl Iterator<Item = PathBuf> {
        self.directions.iter().chain(&self.depth).cloned()
    }

    /// Whether a camera may turn a picture.
    pub(super) fn has_depth(&self) -> bool {
        self.depth.is_some()
    }

    /// The form of a picture.
    pub(super) fn of_picture(&self) -> Result<PictureForm> {
        let depth = self.depth.as_deref().map(PictureForm::depth_of).transpose()?;
        let flow = self.directions.as_deref().map(FlowPicture::open).transpose()?;
        Ok(PictureForm { depth, flow, ..PictureForm::default() })
    }

    /// Refuses what only a picture can have.
    pub(super) fn refuse_on_models(&self, subject: &Path) -> Result<()> {
        let options = [("--directions", &self.directions), ("--depth", &self.depth)];
        match options.into_iter().find(|(_, file)| file.is_some()) {
            Some((option, _)) => Err(Failure::usage(
                format!("{option} is for pictures, and {} is a model", subject.display()),
                format!("leave out {option}: a model has its own form"),
            )),
            None => Ok(()),
        }
    }
}
