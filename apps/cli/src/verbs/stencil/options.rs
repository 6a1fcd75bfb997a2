//! All options of the verb.

use std::path::PathBuf;

use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use volumes::painter::Show;
use volumes::settings::Preset;

use super::outputs::OutputOptions;
use super::pigments::PigmentOptions;
use super::pours::PourOptions;
use super::settings::{SettingsOptions, preset_names};
use crate::animation::AnimationOptions;
use crate::engine::BackendOption;
use crate::subject::SubjectOptions;

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
    pub(super) subject: Option<PathBuf>,
    /// Print the settings of a preset, each with its meaning, and do nothing else
    #[arg(long, value_name = "NAME", conflicts_with = "subject", value_parser = preset_names())]
    pub(super) show_preset: Option<Preset>,
    /// Subject of pictures: the result, the volumes over the drawing, white where they are, the grey
    /// drawing, the scene in colour, or the pencil strokes
    #[arg(long, value_name = "WHAT", default_value = "final", value_parser = shows())]
    pub(super) show: Show,
    /// Time of single pictures in seconds [default: the end]
    #[arg(long, value_name = "SECONDS", allow_negative_numbers = true)]
    pub(super) at: Option<f64>,
    /// Print JSON: size, backend, seconds, volumes, particles, cells, paint in mm3, frames,
    /// frames_found, from_seconds (of the snapshot that an interrupted run went on from),
    /// steps_computed
    #[arg(long)]
    pub(super) json: bool,
    #[command(flatten)]
    pub(super) backend: BackendOption,
    #[command(flatten)]
    pub(super) pours: PourOptions,
    #[command(flatten)]
    pub(super) settings: SettingsOptions,
    #[command(flatten)]
    pub(super) subject_options: SubjectOptions,
    #[command(flatten)]
    pub(super) outputs: OutputOptions,
    #[command(flatten)]
    pub(super) animation: AnimationOptions,
    #[command(flatten)]
    pub(super) pigments: PigmentOptions,
}

/// Parses what pictures show; an error lists the names.
fn shows() -> impl TypedValueParser<Value = Show> {
    let names = PossibleValuesParser::new(Show::ALL.map(Show::name));
    names.try_map(|name| name.parse::<Show>())
}
