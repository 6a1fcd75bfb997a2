//! Options for directions of strokes and the depth of a picture.

use std::path::PathBuf;

use clap::Args;
use graphics::mesh::{Guide, Mesh};
use painterly::guides::Guides;
use painterly::{FlowPicture, PictureForm};

use crate::failure::{Failure, Result};
use crate::input::is_toml;

#[derive(Debug, Args)]
#[command(next_help_heading = "Subject")]
pub(super) struct FormOptions {
    /// Directions of strokes: guides drawn as lines (.toml); or of a picture a PNG whose red (to the
    /// right) and green (upwards) point about one half, and whose blue is the strength of flow
    #[arg(long, value_name = "FILE")]
    directions: Option<PathBuf>,
    /// Depth of a picture, which makes a relief of it, before which --camera and --turntable move:
    /// white is near, black is far (.png, .jpg, .tif, .webp)
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
        let mut form = PictureForm { depth, ..PictureForm::default() };
        match &self.directions {
            Some(path) if is_toml(path) => form.guides = PictureForm::guides_of(path)?,
            Some(path) => form.flow = Some(FlowPicture::open(path)?),
            None => {}
        }
        Ok(form)
    }

    /// The guides of a model.
    pub(super) fn of_model(&self, mesh: &Mesh) -> Result<Vec<Guide>> {
        if let Some(path) = &self.depth {
            return Err(Failure::usage(
                format!("--depth {} is for pictures, and this is a model", path.display()),
                "leave out --depth: a model has its own",
            ));
        }
        let Some(path) = &self.directions else { return Ok(Vec::new()) };
        if !is_toml(path) {
            return Err(Failure::usage(
                format!("--directions {} is for pictures, and this is a model", path.display()),
                "draw guides over a view of the model: guides.toml",
            ));
        }
        let guides = Guides::open(path)?;
        let Some(camera) = guides.camera_around(&mesh.positions) else {
            return Err(Failure::data(
                format!("{}: the guides do not tell the camera of their view", path.display()),
                "add camera = [30.0, 20.0, 30.0] with the degrees of --camera",
            ));
        };
        Ok(guides.on_mesh(mesh, &camera)?)
    }
}
