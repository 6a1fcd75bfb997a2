//! `impasto watercolor`: paints photographs and meshes as watercolors.

mod style;
mod pigments;
mod outputs;
mod job;
mod photograph;
mod mesh;

use std::path::PathBuf;

use clap::Args;
use serde_json::json;
use watercolor::Preset;

use crate::animation::{Animation, AnimationOptions};
use crate::console::Console;
use crate::engine::BackendOption;
use crate::failure::{Failure, Result};
use crate::subject::{PictureViews, Subject, SubjectOptions};
use job::{Job, Summary};
use outputs::OutputOptions;
use pigments::PigmentOptions;
use style::{StyleOptions, preset_names};

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
    /// Print the settings of a preset, each with its meaning, and do nothing else
    #[arg(long, value_name = "NAME", conflicts_with = "subject", value_parser = preset_names())]
    show_preset: Option<Preset>,
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
    style: StyleOptions,
    #[command(flatten)]
    animation: AnimationOptions,
    #[command(flatten)]
    pigments: PigmentOptions,
}

impl Watercolor {
    pub(super) fn run(self, console: &mut Console<'_>) -> Result<()> {
        if let Some(preset) = self.show_preset {
            return console.line(preset.text().trim_end());
        }
        let path = self.subject.clone().unwrap_or_default();
        if !self.outputs.any() && !self.animation.any() {
            return Err(Failure::usage(
                "nothing would be written",
                "add --picture watercolor.png, --stages FOLDER, or --animation turning.gif",
            ));
        }
        let (settings, mut inputs) = self.style.settings()?;
        inputs.extend(self.pigments.input().cloned());
        let (subject, files) = self.subject_options.subject(&path, PictureViews::Front)?;
        inputs.extend(files);
        inputs.extend(self.outputs.inputs());
        let still = match &subject {
            Subject::Photograph(..) => true,
            Subject::Mesh(_, cameras, _) => cameras.len() < 2,
        };
        if still && self.animation.any() {
            return Err(Failure::usage(
                "--animation and --frames need a mesh and a camera that moves",
                "add --turntable 60, or --camera path.toml with keyframes",
            ));
        }
        self.outputs.check(self.pigments.input().is_some())?;
        let glazes = self.pigments.glaze_painter(&settings, console)?;
        let animation = self.animation.open(&inputs)?;
        // Last, because it creates folders.
        let outputs = self.outputs.open(inputs, animation.as_ref().and_then(Animation::file))?;
        let title = path.file_stem().map(|stem| stem.to_string_lossy().into_owned());
        let title = title.unwrap_or_default();
        let job = Job { title, settings, glazes, outputs, animation };
        let compute = self.backend.compute(console)?;
        let summary = match subject {
            Subject::Photograph(photograph, width) => {
                photograph::paint(compute, job, &photograph, width, console)?
            }
            Subject::Mesh(mesh, cameras, size) => {
                mesh::paint(compute, job, *mesh, &cameras, size, console)?
            }
        };
        print(&summary, self.json, console)
    }
}

/// Prints the summary of a run.
fn print(summary: &Summary, as_json: bool, console: &mut Console<'_>) -> Result<()> {
    let Summary { size: (width, height), backend, regions, frames, pigments } = summary;
    if as_json {
        return console.json(&json!({
            "size": [width, height],
            "backend": backend,
            "regions": regions,
            "frames": frames.map(|(frames, _)| frames),
            "frames_found": frames.map(|(_, found)| found),
            "pigments": pigments,
        }));
    }
    let mut line = format!("{width} x {height} pixels on {backend}");
    if let Some(regions) = regions {
        line += &format!(", {}", documents::counted(*regions, "region"));
    }
    if let Some((frames, found)) = frames {
        line += &format!(", {}", documents::counted(*frames, "frame"));
        if *found > 0 {
            line += &format!(" ({found} of them existed already)");
        }
    }
    if !pigments.is_empty() {
        line += &format!(", painted with {}", pigments.join(", "));
    }
    console.line(line)
}
