//! `impasto stencil`: pours paint over a scene drawn as a grey sketch, which turns to colour where
//! the paint spreads.

mod settings;

mod pigments;

mod pours;

mod scene;

mod outputs;

mod times;

mod stills;

mod summary;

mod job;

use std::path::PathBuf;

use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Args, value_parser};
use render::volumes::painter::Show;
use render::volumes::settings::Preset;

use crate::animation::AnimationOptions;
use crate::console::Console;
use crate::engine::BackendOption;
use crate::failure::Result;
use crate::subject::SubjectOptions;
use job::Job;
use outputs::OutputOptions;
use pigments::PigmentOptions;
use pours::PourOptions;
use settings::{SettingsOptions, preset_names};

/// Pour paint over a scene drawn in pencil: what it reaches turns to colour
///
/// Paint is held by volumes: closed meshes of particles that grow over the surfaces of a model, or
/// over a photograph, and spill from one place to the next. What they hold is shown in colour, all
/// else as a grey drawing (ten Bosch 2005). With a library of pigments they lie as films of measured
/// paint, and the result is a painting. A script (.toml) says what is poured, pushed, lifted and
/// dried, and when.
#[derive(Debug, Args)]
pub(crate) struct Stencil {
    /// A mesh (.obj, .gltf, .glb, .ply), a photograph (.png, .jpg), a built-in shape
    /// (shape:still-life, shape:village, shape:torus-knot, shape:sphere), or a script (.toml)
    #[arg(required_unless_present = "show_preset")]
    subject: Option<PathBuf>,
    /// Print the settings of a preset, each with its meaning, and do nothing else
    #[arg(long, value_name = "NAME", conflicts_with = "subject", value_parser = preset_names())]
    show_preset: Option<Preset>,
    /// What pictures show: the result, the volumes over the drawing, white where they are, the grey
    /// drawing, the scene in colour, or the pencil strokes
    #[arg(long, value_name = "WHAT", default_value = "final", value_parser = shows())]
    show: Show,
    /// Time of single pictures in seconds [default: the end]
    #[arg(long, value_name = "SECONDS", value_parser = value_parser!(f64))]
    at: Option<f64>,
    /// Print JSON: size, backend, seconds, volumes, particles, cells, paint in mm3, frames,
    /// frames_found
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    backend: BackendOption,
    #[command(flatten)]
    pours: PourOptions,
    #[command(flatten)]
    settings: SettingsOptions,
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
        if let Some(preset) = self.show_preset {
            return console.line(preset.text().trim_end());
        }
        Job::of(self, console)?.run(console)
    }
}

/// Parses what pictures show; an error lists the names.
fn shows() -> impl TypedValueParser<Value = Show> {
    let names = PossibleValuesParser::new(Show::ALL.map(Show::name));
    names.try_map(|name| name.parse::<Show>())
}
