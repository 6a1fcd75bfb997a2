//! Options and files of single pictures: the finished one, and the stages before it.

use std::path::PathBuf;

use clap::Args;
use graphics::picture::Photograph;
use watercolor::Masks;

use crate::console::Console;
use crate::failure::{Failure, Result};
use crate::output::Output;
use crate::pictures::{Exports, OpenExports};
use crate::stages::{NamedStage, StageFolder};

#[derive(Debug, Args)]
pub(super) struct OutputOptions {
    #[command(flatten)]
    exports: Exports,
    /// Write every intermediate stage into this folder, as PNG
    #[arg(long, value_name = "FOLDER", help_heading = "Exports")]
    stages: Option<PathBuf>,
    /// Mask of the dry brush, stretched over the picture: white where the brush is dry
    #[arg(long, value_name = "PICTURE", help_heading = "Style")]
    dry_brush_mask: Option<PathBuf>,
    /// Mask of the density changes, stretched over the picture: white where density changes
    #[arg(long, value_name = "PICTURE", help_heading = "Style")]
    density_mask: Option<PathBuf>,
}

/// Output files that were checked to be writable, and the masks.
pub(super) struct OpenOutputs {
    pub(super) exports: OpenExports,
    stages: Option<StageFolder>,
    dry_brush_mask: Option<PathBuf>,
    density_mask: Option<PathBuf>,
}

impl OutputOptions {
    /// Whether any output is requested.
    pub(super) fn any(&self) -> bool {
        self.exports.any() || self.stages.is_some()
    }

    /// Paths of the masks.
    pub(super) fn inputs(&self) -> impl Iterator<Item = PathBuf> {
        self.dry_brush_mask.iter().chain(&self.density_mask).cloned()
    }

    /// Refuses options that need pigments if the picture is painted without them.
    pub(super) fn check(&self, pigments: bool) -> Result<()> {
        match self.exports.layer_option().filter(|_| !pigments) {
            None => Ok(()),
            Some(option) => Err(Failure::usage(
                format!("{option} needs pigments, but no library is given"),
                "name a LIBRARY after the subject, such as oils.json; for a linear picture --picture FILE.exr",
            )),
        }
    }

    /// Checks that all files can be written and overwrite neither the animation nor an input.
    pub(super) fn open(
        self,
        inputs: Vec<PathBuf>,
        animation: Option<&Output>,
    ) -> Result<OpenOutputs> {
        let Self { exports, stages, dry_brush_mask, density_mask } = self;
        let exports = exports.open(&inputs)?;
        if let Some(animation) = animation.filter(|animation| exports.writes(animation)) {
            return Err(Failure::usage(
                format!(
                    "{}: the picture and the animation have this file name",
                    animation.path().display()
                ),
                "give each its own file name",
            ));
        }
        let stages = stages.map(|folder| StageFolder::open(&folder, &inputs)).transpose()?;
        Ok(OpenOutputs { exports, stages, dry_brush_mask, density_mask })
    }
}

impl OpenOutputs {
    /// Whether the stages are to be written.
    pub(super) fn wants_stages(&self) -> bool {
        self.stages.is_some()
    }

    /// Reads the masks.
    pub(super) fn masks(&self) -> Result<Masks> {
        let open = |path: &Option<PathBuf>| path.as_deref().map(Photograph::open).transpose();
        Ok(Masks { dry_brush: open(&self.dry_brush_mask)?, density: open(&self.density_mask)? })
    }

    /// Writes the stages, numbered from 1 in their order.
    pub(super) fn write_stages(
        &self,
        stages: &[NamedStage],
        console: &mut Console<'_>,
    ) -> Result<()> {
        self.stages.as_ref().map_or(Ok(()), |folder| folder.write(stages, console))
    }
}
