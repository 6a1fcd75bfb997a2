//! `impasto watercolor`: photographs and meshes as watercolors.

mod look;

mod pigments;

mod subject;

mod sheets;

mod moving;

mod photograph;

mod mesh;

use std::path::PathBuf;

use clap::Args;
use render::watercolor::{Morphology, MovingBackend, OnCpu, OnGpu, Preset, Settings};
use serde_json::json;

use crate::console::Console;
use crate::engine::BackendOption;
use crate::failure::Refusal;
use look::{LookOptions, preset_names};
use moving::{Moving, MovingOptions};
use pigments::{Glazing, PigmentOptions};
use sheets::{OpenSheets, SheetOptions};
use subject::{Subject, SubjectOptions};

/// Paint a photograph or a 3D model as a watercolor
///
/// A photograph becomes flat regions (mean shift, then smoothed outlines), a mesh is lit in a few
/// steps; then both go the same way: edges wobble with the paper's grain, pigment gathers at the
/// rims of washes, clouds and grains of pigment change its density, and a dry brush leaves the
/// hollows of the paper bare (Bousseau, Kaplan, Thollot and Sillion 2006). While a camera moves,
/// clouds and grains stay on the object.
#[derive(Debug, Args)]
pub(crate) struct Watercolor {
    /// A photograph (.png, .jpg), a mesh (.obj, .gltf, .glb, .ply), or a shape that is made here
    /// (shape:still-life, shape:village, shape:torus-knot, shape:sphere)
    #[arg(required_unless_present = "show_preset")]
    subject: Option<PathBuf>,
    /// Print a preset's settings, each with its meaning, and do nothing else
    #[arg(long, value_name = "NAME", conflicts_with = "subject", value_parser = preset_names())]
    show_preset: Option<Preset>,
    #[command(flatten)]
    backend: BackendOption,
    /// Print JSON: size, backend, regions, frames, pigments
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    sheets: SheetOptions,
    #[command(flatten)]
    subject_options: SubjectOptions,
    #[command(flatten)]
    look: LookOptions,
    #[command(flatten)]
    moving: MovingOptions,
    #[command(flatten)]
    pigments: PigmentOptions,
}

/// What is to be made of a subject.
struct Work {
    title: String,
    settings: Settings,
    glazing: Option<Glazing>,
    sheets: OpenSheets,
    moving: Option<Moving>,
}

/// What was made.
struct Made {
    size: (usize, usize),
    backend: String,
    /// Of a photograph.
    regions: Option<usize>,
    /// Of an animation, and how many were there already.
    frames: Option<(usize, usize)>,
    pigments: Vec<String>,
}

impl Watercolor {
    pub(super) fn run(self, console: &mut Console<'_>) -> anyhow::Result<()> {
        if let Some(preset) = self.show_preset {
            return console.line(preset.text().trim_end());
        }
        let path = self.subject.clone().unwrap_or_default();
        if !self.sheets.any() && !self.moving.any() {
            return Err(Refusal::usage(
                "nothing would be written",
                "add --picture watercolor.png, --stages FOLDER, or --animation turning.gif",
            ));
        }
        let (settings, mut inputs) = self.look.settings()?;
        inputs.extend(self.pigments.input().cloned());
        let (subject, files) = self.subject_options.subject(&path)?;
        inputs.extend(files);
        inputs.extend(self.sheets.inputs());
        let still = match &subject {
            Subject::Photograph(..) => true,
            Subject::Mesh(_, cameras, _) => cameras.len() < 2,
        };
        if still && self.moving.any() {
            return Err(Refusal::usage(
                "--animation and --frames need a mesh and a camera that moves",
                "add --turntable 60, or --camera path.toml with keyframes",
            ));
        }
        self.sheets.check(self.pigments.input().is_some())?;
        let glazing = self.pigments.glazing(&settings, console)?;
        let moving = self.moving.open(&inputs)?;
        // The last of these, as it makes folders.
        let sheets = self.sheets.open(inputs, moving.as_ref().and_then(Moving::animation))?;
        let title = path.file_stem().map(|stem| stem.to_string_lossy().into_owned());
        let title = title.unwrap_or_default();
        let work = Work { title, settings, glazing, sheets, moving };
        let made = match self.backend.device()? {
            Some(device) => work.done(&mut OnGpu::new(device), subject, console)?,
            None => work.done(&mut OnCpu, subject, console)?,
        };
        tell(&made, self.json, console)
    }
}

impl Work {
    fn done<B: MovingBackend + Morphology>(
        self,
        backend: &mut B,
        subject: Subject,
        console: &mut Console<'_>,
    ) -> anyhow::Result<Made> {
        match subject {
            Subject::Photograph(photograph, width) => {
                photograph::paint(backend, self, &photograph, width, console)
            }
            Subject::Mesh(mesh, cameras, size) => {
                mesh::paint(backend, self, *mesh, &cameras, size, console)
            }
        }
    }
}

fn tell(made: &Made, as_json: bool, console: &mut Console<'_>) -> anyhow::Result<()> {
    let Made { size: (width, height), backend, regions, frames, pigments } = made;
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
        line += &format!(", {regions} regions");
    }
    if let Some((frames, found)) = frames {
        line += &format!(", {frames} frames");
        if *found > 0 {
            line += &format!(" ({found} of them found)");
        }
    }
    if !pigments.is_empty() {
        line += &format!(", painted with {}", pigments.join(", "));
    }
    console.line(line)
}
