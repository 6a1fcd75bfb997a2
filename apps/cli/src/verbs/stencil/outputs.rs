//! Options and files of everything that is written beside an animation.

use std::path::{Path, PathBuf};

use clap::Args;

use crate::console::Console;
use crate::failure::{Failure, Result};
use crate::output::{Output, OutputFolder};
use crate::pictures::{Exports, OpenExports};
use crate::plain_picture::refuse_same;
use crate::stages::StageFolder;

#[derive(Debug, Args)]
pub(super) struct OutputOptions {
    #[command(flatten)]
    exports: Exports,
    /// Write the picture in layers for compositing, as OpenEXR of several parts: colour, grey, count
    /// and tint of each region, ink, place, normal, and heights of pigments
    #[arg(long, value_name = "FILE", help_heading = "Exports")]
    passes: Option<PathBuf>,
    /// Write a mask as PNG or OpenEXR: white where volumes bring colour
    #[arg(long, value_name = "FILE", help_heading = "Exports")]
    mask: Option<PathBuf>,
    /// Write the steps to the picture into this folder as PNG: the colours seen, light, hatching,
    /// colour, grey, count and tint of each region, volumes, mask, picture
    #[arg(long, value_name = "FOLDER", help_heading = "Exports")]
    stages: Option<PathBuf>,
    /// Write the volumes of each frame into this folder as PLY
    #[arg(long, value_name = "FOLDER", help_heading = "Exports")]
    volumes: Option<PathBuf>,
    /// Write what is poured, with all settings that differ from the preset, as a script (.toml)
    #[arg(long, value_name = "FILE", help_heading = "Exports")]
    script_out: Option<PathBuf>,
}

/// Files of single pictures that were checked to be writable.
pub(super) struct PictureFiles {
    pub(super) exports: OpenExports,
    pub(super) passes: Option<Output>,
    pub(super) mask: Option<Output>,
    pub(super) stages: Option<StageFolder>,
}

/// Files that were checked to be writable.
pub(super) struct OpenOutputs {
    pub(super) pictures: PictureFiles,
    pub(super) script: Option<Output>,
    pub(super) volumes: Option<MeshFolder>,
}

impl OutputOptions {
    /// Whether anything is to be written.
    pub(super) fn any(&self) -> bool {
        let others = [&self.passes, &self.mask, &self.stages, &self.volumes, &self.script_out];
        self.exports.any() || others.into_iter().any(Option::is_some)
    }

    /// First option present that needs layers of pigments.
    pub(super) fn layer_option(&self) -> Option<&'static str> {
        self.exports.layer_option()
    }

    /// Folder of the script that is written, if one is.
    pub(super) fn script_folder(&self) -> Option<PathBuf> {
        self.script_out.as_ref().map(|path| path.parent().unwrap_or(Path::new("")).to_owned())
    }

    /// Checks that all files can be written, for `frames` frames, and makes none.
    pub(super) fn open(
        self,
        inputs: &[PathBuf],
        frames: usize,
        animation: Option<&Output>,
    ) -> Result<OpenOutputs> {
        let open = |path: &Option<PathBuf>, endings: &[&str]| {
            path.as_ref().map(|path| Output::with_ending(path, endings, inputs)).transpose()
        };
        let passes = open(&self.passes, &["exr"])?;
        let mask = open(&self.mask, &["png", "exr"])?;
        let script = open(&self.script_out, &["toml"])?;
        refuse_same(&[passes.as_ref(), mask.as_ref(), script.as_ref(), animation])?;
        let exports = self.exports.open(inputs)?;
        let own = [&passes, &mask, &script].into_iter().flatten().chain(animation);
        if let Some(twice) = own.into_iter().find(|output| exports.writes(output)) {
            return Err(Failure::usage(
                format!("{}: two outputs have this file name", twice.path().display()),
                "give each output its own file name",
            ));
        }
        let volumes = self.volumes.as_deref();
        let volumes = volumes.map(|folder| MeshFolder::open(folder, frames, inputs)).transpose()?;
        let stages = self.stages.as_deref();
        let stages = stages.map(|folder| StageFolder::open(folder, inputs)).transpose()?;
        let pictures = PictureFiles { exports, passes, mask, stages };
        Ok(OpenOutputs { pictures, script, volumes })
    }
}

/// A folder for the volumes of each frame.
pub(super) struct MeshFolder {
    folder: OutputFolder,
    frames: usize,
}

impl MeshFolder {
    /// Checks that `frames` files can be written, and that the folder has no frame beyond the last,
    /// which would be of another animation.
    fn open(folder: &Path, frames: usize, inputs: &[PathBuf]) -> Result<Self> {
        let folder = OutputFolder::open(folder, inputs)?;
        let beyond = folder.file(&file_name(frames));
        if beyond.exists() {
            return Err(Failure::usage(
                format!("{}: a frame of another animation", beyond.display()),
                "name an empty folder, or remove its frames",
            ));
        }
        folder.check((0..frames).map(file_name))?;
        Ok(Self { folder, frames })
    }

    /// Tells that the folder was written.
    pub(super) fn told(&self, console: &mut Console<'_>) -> Result<()> {
        self.folder.told(console)
    }

    /// One file for each frame.
    pub(super) fn outputs(&self) -> Result<Vec<Output>> {
        self.folder.outputs((0..self.frames).map(file_name))
    }
}

/// Name of the file of a frame; indices count from 0, names from 1.
fn file_name(index: usize) -> String {
    format!("frame-{:04}.ply", index + 1)
}
