//! `impasto watercolor` paints photographs and meshes as watercolors. You can paint with calibrated
//! pigments instead of the colour model of Bousseau et al. (2006), write the stages before a
//! picture, or the frames of a moving camera.

use std::path::PathBuf;

use clap::Args;
use pictures::{
    PictureOutcome, PictureRequest, PigmentRequest, TechniqueOutcome, TechniqueRequest,
    WatercolorRequest,
};
use serde_json::json;
use watercolor::WatercolorPainter;

use super::animation::{AnimationOptions, SubjectOptions};
use super::engine::BackendOption;
use super::exports::{Exports, frames_text, painted};
use super::technique::{ShowPreset, StyleOptions, Styled};
use crate::console::Console;
use crate::failure::Result;

/// Paint a photograph or a 3D model as a watercolor
///
/// A photograph becomes flat regions (mean shift, then smoothed outlines), a mesh is shaded in a few
/// tones. Both are then painted alike: edges wobble with the paper's grain, pigment gathers at the
/// edges of washes, clouds and grains of pigment change its density, and a dry brush leaves the
/// hollows of the paper bare (Bousseau, Kaplan, Thollot and Sillion 2006). While a camera moves,
/// clouds and grains stay on the object.
#[derive(Debug, Args)]
pub(crate) struct Watercolor {
    /// A photograph (.png, .jpg, .tif, .webp), a mesh (.obj, .gltf, .glb, .ply), or a built-in shape
    /// (shape:still-life, shape:village, shape:torus-knot, shape:sphere)
    #[arg(required_unless_present = "show_preset")]
    subject: Option<PathBuf>,
    #[command(flatten)]
    show_preset: ShowPreset<WatercolorPainter>,
    #[command(flatten)]
    backend: BackendOption,
    /// Print JSON: size, backend, regions, frames, pigments
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    outputs: OutputOptions,
    #[command(flatten)]
    subject_options: SubjectOptions,
    #[command(flatten)]
    style: StyleOptions<WatercolorPainter>,
    #[command(flatten)]
    animation: AnimationOptions,
    #[command(flatten)]
    pigments: PigmentOptions,
}

impl Watercolor {
    pub(super) fn run(self, console: &mut Console<'_>) -> Result<()> {
        if self.show_preset.print(console)? {
            return Ok(());
        }
        let outcome = painted(&self.request(), console)?;
        print(&outcome, self.json, console)
    }

    /// The picture of these options.
    fn request(&self) -> PictureRequest {
        let PigmentOptions { pigments, pigments_before, palette, over, illuminant } =
            &self.pigments;
        let OutputOptions { exports, stages, dry_brush_mask, density_mask } = &self.outputs;
        PictureRequest {
            subject: self.subject.clone().unwrap_or_default(),
            technique: TechniqueRequest::Watercolor(WatercolorRequest {
                over: over.clone(),
                dry_brush_mask: dry_brush_mask.clone(),
                density_mask: density_mask.clone(),
            }),
            view: self.subject_options.request(),
            style: self.style.request(),
            pigments: PigmentRequest {
                library: pigments.as_ref().or(pigments_before.as_ref()).cloned(),
                palette: palette.clone(),
                illuminant: Some(illuminant.clone()),
            },
            exports: exports.request(),
            stages: stages.clone(),
            animation: self.animation.request(),
            device: self.backend.device(),
        }
    }
}

/// Prints the summary of a run.
fn print(outcome: &PictureOutcome, as_json: bool, console: &mut Console<'_>) -> Result<()> {
    let PictureOutcome { size: (width, height), backend, technique, pigments, .. } = outcome;
    let regions = match technique {
        TechniqueOutcome::Watercolor { regions } => *regions,
        _ => None,
    };
    if as_json {
        return console.json(&json!({
            "size": [width, height],
            "backend": backend,
            "regions": regions,
            "frames": outcome.frames,
            "frames_found": outcome.frames_found,
            "pigments": pigments,
        }));
    }
    let mut line = format!("{width} x {height} pixels on {backend}");
    if let Some(regions) = regions {
        line += &format!(", {}", documents::counted(regions, "region"));
    }
    line += &frames_text(outcome);
    if !pigments.is_empty() {
        line += &format!(", painted with {}", pigments.join(", "));
    }
    console.line(line)
}

impl Styled for WatercolorPainter {
    const USUAL: &'static str = "settings between the presets";
}

#[derive(Debug, Args)]
#[command(next_help_heading = "Pigments")]
struct PigmentOptions {
    /// Paint with this library: every colour is matched by a glaze over the paper, and density
    /// becomes its thickness
    #[arg(value_name = "LIBRARY", group = "library_of_paint")]
    pigments: Option<PathBuf>,
    /// Old name of LIBRARY
    #[arg(long = "pigments", value_name = "LIBRARY", hide = true, group = "library_of_paint")]
    pigments_before: Option<PathBuf>,
    /// Up to eight pigments of the library, separated by commas [default: the ones nearest to the
    /// picture's colours]
    #[arg(long, value_name = "PIGMENTS", requires = "library_of_paint")]
    palette: Vec<String>,
    /// Reflectance of the paper as measured: 0 to 1, or a file of spectra (FILE#SAMPLE)
    /// [default: computed from the setting paper.colour]
    #[arg(long, value_name = "PAPER", requires = "library_of_paint")]
    over: Option<String>,
    /// Light: D65, A, FL11, 5600K, or the file of a lamp
    #[arg(long, value_name = "LIGHT", default_value = "D65", requires = "library_of_paint")]
    illuminant: String,
}

#[derive(Debug, Args)]
struct OutputOptions {
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
