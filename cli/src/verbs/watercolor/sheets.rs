//! Single pictures: the finished one, and the stages on the way.

use std::path::{Path, PathBuf};

use anyhow::Context;
use clap::Args;
use rayon::prelude::*;
use render::export::{frame_of, frame_png};
use render::field::Field;
use render::photograph::Photograph;
use render::watercolor::Controls;
use spectra::color::Rgb;

use crate::failure::Refusal;
use crate::output::Output;
use crate::pictures::{Exports, OpenExports};

#[derive(Debug, Args)]
pub(super) struct SheetOptions {
    #[command(flatten)]
    exports: Exports,
    /// Write every stage on the way into this folder, as PNG
    #[arg(long, value_name = "FOLDER", help_heading = "Exports")]
    stages: Option<PathBuf>,
    /// Where the brush is dry: a mask laid over the picture, white where it is
    #[arg(long, value_name = "PICTURE", help_heading = "Look")]
    dry_brush_mask: Option<PathBuf>,
    /// Where density changes: a mask laid over the picture, white where it does
    #[arg(long, value_name = "PICTURE", help_heading = "Look")]
    density_mask: Option<PathBuf>,
}

/// A stage's name and its picture, encoded.
pub(super) type NamedStage = (String, Field<[f32; 4]>);

/// Files known to be writable.
pub(super) struct OpenSheets {
    pub(super) exports: OpenExports,
    stages: Option<PathBuf>,
    dry_brush_mask: Option<PathBuf>,
    density_mask: Option<PathBuf>,
    inputs: Vec<PathBuf>,
}

impl SheetOptions {
    pub(super) fn any(&self) -> bool {
        self.exports.any() || self.stages.is_some()
    }

    /// The masks.
    pub(super) fn inputs(&self) -> impl Iterator<Item = PathBuf> {
        self.dry_brush_mask.iter().chain(&self.density_mask).cloned()
    }

    /// Checks that a picture with or without `pigments` can be all that is wanted.
    pub(super) fn check(&self, pigments: bool) -> anyhow::Result<()> {
        match self.exports.of_paint().filter(|_| !pigments) {
            None => Ok(()),
            Some(option) => Err(Refusal::usage(
                format!("{option} tells of pigments, and this picture has none"),
                "add --pigments LIBRARY",
            )),
        }
    }

    /// Checks that all can be written, beside an animation and over no input.
    pub(super) fn open(
        self,
        inputs: Vec<PathBuf>,
        animation: Option<&Output>,
    ) -> anyhow::Result<OpenSheets> {
        let Self { exports, stages, dry_brush_mask, density_mask } = self;
        let exports = exports.open(&inputs)?;
        if let Some(animation) = animation.filter(|animation| exports.writes(animation)) {
            return Err(Refusal::usage(
                format!(
                    "{}: the picture and the animation would be this file",
                    animation.path().display()
                ),
                "give each a name of its own",
            ));
        }
        if let Some(folder) = &stages {
            let cannot = || format!("{}: this folder cannot be made", folder.display());
            std::fs::create_dir_all(folder).with_context(cannot)?;
            Output::open(&stage_path(folder, 1, "stage"), &inputs)?;
        }
        Ok(OpenSheets { exports, stages, dry_brush_mask, density_mask, inputs })
    }
}

fn stage_path(folder: &Path, number: usize, name: &str) -> PathBuf {
    folder.join(format!("{number:02}-{name}.png"))
}

impl OpenSheets {
    /// Whether anybody looks at the stages.
    pub(super) fn watched(&self) -> bool {
        self.stages.is_some()
    }

    /// The masks, for a picture of this size.
    pub(super) fn controls(&self, width: usize, height: usize) -> anyhow::Result<Controls> {
        let mask = |path: &Option<PathBuf>| -> anyhow::Result<_> {
            let Some(path) = path else { return Ok(None) };
            let picture = Photograph::open(path)?.on_canvas(width, height);
            let grey = |rgb: &[f32; 3]| {
                let encoded = Rgb(rgb.map(f64::from)).encoded().0;
                (encoded.iter().sum::<f64>() / 3.0) as f32
            };
            let values = picture.values().par_iter().map(grey).collect();
            Ok(Some(Field::from_values(width, height, values)))
        };
        Ok(Controls { dry_brush: mask(&self.dry_brush_mask)?, density: mask(&self.density_mask)? })
    }

    /// Writes the stages, numbered in their order.
    pub(super) fn write_stages(&self, stages: &[NamedStage]) -> anyhow::Result<()> {
        let Some(folder) = &self.stages else { return Ok(()) };
        let path = |(number, (name, _)): (usize, &NamedStage)| stage_path(folder, number, name);
        let open = |path: PathBuf| Output::open(&path, &self.inputs);
        // All of them first: nothing is written where one cannot be.
        let outputs: Vec<Output> =
            (1..).zip(stages).map(path).map(open).collect::<anyhow::Result<_>>()?;
        for (output, (_, picture)) in outputs.into_iter().zip(stages) {
            output.write(frame_png(&frame_of(&on_white(picture)))?)?;
        }
        Ok(())
    }
}

/// Paint with bare paper white.
fn on_white(picture: &Field<[f32; 4]>) -> Field<[f32; 4]> {
    let seen = |&[r, g, b, covered]: &[f32; 4]| {
        let [r, g, b] = [r, g, b].map(|value| value * covered + 1.0 - covered);
        [r, g, b, 1.0]
    };
    let values = picture.values().par_iter().map(seen).collect();
    Field::from_values(picture.width(), picture.height(), values)
}

/// Linear sRGB of an encoded picture, which files are made of.
pub(super) fn linear(picture: &Field<[f32; 4]>) -> Field<[f32; 4]> {
    let linear = |&[r, g, b, a]: &[f32; 4]| {
        let [r, g, b] = Rgb([r, g, b].map(f64::from)).linear().0.map(|value| value as f32);
        [r, g, b, a]
    };
    let values = picture.values().par_iter().map(linear).collect();
    Field::from_values(picture.width(), picture.height(), values)
}

/// Encoded sRGB of a linear picture, of which frames are made.
pub(super) fn encoded(picture: &Field<[f32; 4]>) -> Field<[f32; 4]> {
    let encoded = |&[r, g, b, a]: &[f32; 4]| {
        let inside = [r, g, b].map(|value| f64::from(value.clamp(0.0, 1.0)));
        let [r, g, b] = Rgb(inside).encoded().0.map(|value| value as f32);
        [r, g, b, a]
    };
    let values = picture.values().par_iter().map(encoded).collect();
    Field::from_values(picture.width(), picture.height(), values)
}
