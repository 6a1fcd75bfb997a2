//! `impasto stencil`: pours paint over a scene drawn as a grey sketch, which turns to colour where
//! the paint spreads.

use std::path::PathBuf;

use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use documents::counted;
use paint::ground::GroundKind;
use pictures::{
    PaintAmounts, PictureOutcome, PictureRequest, PigmentRequest, TechniqueOutcome,
    TechniqueRequest, VolumesRequest,
};
use serde_json::json;
use volumes::painter::{Show, VolumePainter};

use super::animation::{AnimationOptions, SubjectOptions};
use super::engine::BackendOption;
use super::exports::{Exports, grounds, painted};
use super::technique::{ShowPreset, StyleOptions, Styled};
use crate::console::Console;
use crate::csv_rows::at_most;
use crate::failure::Result;

/// Pour paint over a scene drawn in pencil: what it reaches turns to colour
///
/// Paint is held by volumes: closed meshes of particles that grow over the surfaces of a model, or
/// over a photograph, and spill from one place to the next. What they hold is shown in colour, all
/// else as a grey drawing (ten Bosch 2005). With a library of pigments they lie as films of measured
/// paint, and the result is a painting. A script (.toml) says what is poured, pushed, lifted and
/// dried, and when.
#[derive(Debug, Args)]
pub(crate) struct Stencil {
    /// A mesh (.obj, .gltf, .glb, .ply), a photograph (.png, .jpg, .tif, .webp), a built-in shape
    /// (shape:still-life, shape:village, shape:torus-knot, shape:sphere), or a script (.toml)
    #[arg(required_unless_present = "show_preset")]
    subject: Option<PathBuf>,
    #[command(flatten)]
    show_preset: ShowPreset<VolumePainter>,
    /// Content of pictures: `final`, the result; `volumes`, the volumes over the grey drawing; `mask`,
    /// white where volumes are and black elsewhere; `grey`, the drawing without volumes; `colour`, the
    /// scene in colour; `hatching`, the pencil strokes
    #[arg(long, value_name = "WHAT", default_value = "final", value_parser = shows())]
    show: Show,
    /// Time of single pictures in seconds [default: the end]
    #[arg(long, value_name = "SECONDS", allow_negative_numbers = true)]
    at: Option<f64>,
    /// Print JSON: size, backend, seconds, volumes, particles, cells, paint in mm3, frames,
    /// frames_found, from_seconds (of the snapshot that an interrupted run went on from),
    /// steps_computed
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    backend: BackendOption,
    #[command(flatten)]
    pours: PourOptions,
    #[command(flatten)]
    settings: StyleOptions<VolumePainter>,
    #[command(flatten)]
    subject_options: SubjectOptions,
    #[command(flatten)]
    outputs: OutputOptions,
    #[command(flatten)]
    animation: AnimationOptions,
    #[command(flatten)]
    pigments: PigmentOptions,
}

impl Stencil {
    pub(super) fn run(self, console: &mut Console<'_>) -> Result<()> {
        if self.show_preset.print(console)? {
            return Ok(());
        }
        let outcome = painted(&self.request(), console)?;
        match self.json {
            true => print_json(&outcome, console),
            false => print_line(&outcome, console),
        }
    }

    /// The picture that these options ask for.
    fn request(&self) -> PictureRequest {
        let PourOptions { pours, paints, seconds } = &self.pours;
        let PigmentOptions { pigments, pigments_before, palette, ground, over, illuminant } =
            &self.pigments;
        let OutputOptions { exports, passes, mask, stages, volumes, script_out } = &self.outputs;
        PictureRequest {
            subject: self.subject.clone().unwrap_or_default(),
            technique: TechniqueRequest::Volumes(VolumesRequest {
                show: self.show.name().to_owned(),
                at: self.at,
                pour: pours.clone(),
                paint: paints.clone(),
                seconds: *seconds,
                ground: ground.map(|kind| kind.name().to_owned()),
                over: over.clone(),
                passes: passes.clone(),
                mask: mask.clone(),
                volumes: volumes.clone(),
                script_out: script_out.clone(),
            }),
            view: self.subject_options.request(),
            style: self.settings.request(),
            pigments: PigmentRequest {
                library: pigments.as_ref().or(pigments_before.as_ref()).cloned(),
                palette: palette.clone(),
                illuminant: illuminant.clone(),
            },
            exports: exports.request(),
            stages: stages.clone(),
            animation: self.animation.request(),
            device: self.backend.device(),
        }
    }
}

/// Prints the figures of a run as JSON.
fn print_json(outcome: &PictureOutcome, console: &mut Console<'_>) -> Result<()> {
    let PictureOutcome { size: (width, height), backend, technique, .. } = outcome;
    let TechniqueOutcome::Volumes {
        seconds,
        volumes,
        particles,
        cells,
        paint_mm3,
        from_seconds,
        steps_computed,
    } = technique
    else {
        return Ok(());
    };
    console.json(&json!({
        "size": [width, height],
        "backend": backend,
        "seconds": seconds,
        "volumes": volumes,
        "particles": particles,
        "cells": cells,
        "paint_mm3": paint_mm3,
        "frames": outcome.frames,
        "frames_found": outcome.frames_found,
        "from_seconds": from_seconds,
        "steps_computed": steps_computed,
    }))
}

/// Prints the summary of a run.
fn print_line(outcome: &PictureOutcome, console: &mut Console<'_>) -> Result<()> {
    let PictureOutcome { size: (width, height), backend, technique, .. } = outcome;
    let TechniqueOutcome::Volumes { seconds, volumes, paint_mm3, from_seconds, .. } = technique
    else {
        return Ok(());
    };
    let PaintAmounts { on_scene, lifted, in_tube } = *paint_mm3;
    let volumes = counted(*volumes, "volume");
    let mut line = format!(
        "{width} x {height} pixels on {backend}: {volumes} after {} s, {on_scene:.1} mm3 of paint",
        at_most(*seconds, 2)
    );
    if lifted > 0.0 {
        line += &format!(", {lifted:.1} mm3 taken up");
    }
    if in_tube > 0.0 {
        line += &format!(", {in_tube:.1} mm3 had no room and stayed in the tube");
    }
    if let Some(frames) = outcome.frames {
        line += &format!(", {}", counted(frames, "frame"));
        let found = outcome.frames_found.unwrap_or(0);
        if found > 0 {
            let from =
                from_seconds.map_or("the beginning".to_owned(), |s| format!("{} s", at_most(s, 2)));
            line += &format!(" ({found} of them existed already; played from {from})");
        }
    }
    console.line(line)
}

/// Parses the content of pictures. Errors list the names.
fn shows() -> impl TypedValueParser<Value = Show> {
    let names = PossibleValuesParser::new(Show::ALL.map(Show::name));
    names.try_map(|name| name.parse::<Show>())
}

impl Styled for VolumePainter {
    const USUAL: &'static str =
        "the one in the script, or sketch; with a LIBRARY and no script, grisaille";
}

#[derive(Debug, Args)]
#[command(next_help_heading = "Paint")]
struct PourOptions {
    /// Pour paint at a place of the first picture: shares of its width and height, and the amount in
    /// mm3 [default: 60], such as `0.5,0.6` or `0.5,0.6,200`; may be repeated
    #[arg(long = "pour", value_name = "X,Y[,MM3]", allow_hyphen_values = true)]
    pours: Vec<String>,
    /// Paint of the pours, as pigments with their parts, such as `Ultramarine=2,White=1`: one for all
    /// of them, or one for each [default: the pigments of --palette, or of the script, in turn]
    #[arg(long = "paint", value_name = "RECIPE", requires = "pigments")]
    paints: Vec<String>,
    /// How long paint spreads, in seconds [default: 4, or as the script says]
    #[arg(long, value_name = "SECONDS", allow_negative_numbers = true)]
    seconds: Option<f64>,
}

#[derive(Debug, Args)]
#[command(next_help_heading = "Pigments")]
struct PigmentOptions {
    /// Paint with this library: volumes become films of measured pigments, and the picture a painting.
    /// The setting drawing.inside is then glaze or both, as in the preset grisaille [default: the
    /// library that a script names, if its volumes show glazes]
    #[arg(value_name = "LIBRARY", group = "library_of_paint")]
    pigments: Option<PathBuf>,
    /// Old name of LIBRARY
    #[arg(long = "pigments", value_name = "LIBRARY", hide = true, group = "library_of_paint")]
    pigments_before: Option<PathBuf>,
    /// Up to eight pigments of the volumes, separated by commas
    #[arg(long, value_name = "PIGMENTS", requires = "library_of_paint")]
    palette: Vec<String>,
    /// Ground: linen, paper or panel [default: the one in the script, or panel]
    #[arg(long, value_name = "KIND", value_parser = grounds())]
    ground: Option<GroundKind>,
    /// Reflectance of the ground as measured, 0 to 1, white or black, or one spectrum of a file
    /// [default: the one in the script, or the white of the library]
    #[arg(long, value_name = "GROUND")]
    over: Option<String>,
    /// Light: D65, A, FL11, 5600K, or the file of a lamp [default: the one in the script, or D65]
    #[arg(long, value_name = "LIGHT")]
    illuminant: Option<String>,
}

#[derive(Debug, Args)]
struct OutputOptions {
    #[command(flatten)]
    exports: Exports,
    /// Write the picture in layers for compositing, as OpenEXR of several parts: colour, grey, count
    /// and tint of each region, ink, place, normal, and heights of pigments
    #[arg(long, value_name = "FILE", help_heading = "Exports")]
    passes: Option<PathBuf>,
    /// Write a mask as PNG or OpenEXR: white where volumes bring colour
    #[arg(long, value_name = "FILE", help_heading = "Exports")]
    mask: Option<PathBuf>,
    /// Write intermediate stages of the picture into this folder as PNG: the colours seen, light, hatching,
    /// colour, grey, count and tint of each region, volumes, mask, picture
    #[arg(long, value_name = "FOLDER", help_heading = "Exports")]
    stages: Option<PathBuf>,
    /// Write the volumes of each frame into this folder as PLY
    #[arg(long, value_name = "FOLDER", help_heading = "Exports")]
    volumes: Option<PathBuf>,
    /// Write the pours and other events of the scene, and all settings that differ from the preset, as a
    /// script (.toml)
    #[arg(long, value_name = "FILE", help_heading = "Exports")]
    script_out: Option<PathBuf>,
}
