//! `impasto relight`: shows a painting under another light or with other pigments.

use std::path::PathBuf;

use clap::Args;
use pictures::{LayerOutcome, PictureError, RelightOutcome, RelightRequest};

use super::engine::EngineOptions;
use super::exports::{Exports, heard};
use crate::console::Console;
use crate::csv_rows::at_most;
use crate::failure::{Failure, Result, option_of};

/// Show a painting under another light, or as if painted with other pigments
///
/// Every layer keeps its pigments, so a new light is computed from their K and S, not from colours.
/// Without options the painting is shown as it was saved.
#[derive(Debug, Args)]
pub(crate) struct Relight {
    /// The painting (.exr, as `impasto paint --output` writes it)
    painting: PathBuf,
    /// Light: D65, A, FL11, 5600K, or the file of a lamp [default: the painting's]
    #[arg(long, value_name = "LIGHT")]
    illuminant: Option<String>,
    /// Observer: 1931-2, 1964-10, 2015-2, 2015-10 [default: the painting's]
    #[arg(long, value_name = "NAME")]
    observer: Option<String>,
    /// Direction of the light, in degrees clockwise from the top of the canvas
    #[arg(long, value_name = "DEG", allow_hyphen_values = true)]
    azimuth: Option<f64>,
    /// Elevation of the light above the canvas in degrees, 1 to 90
    #[arg(long, value_name = "DEG")]
    elevation: Option<f64>,
    /// Fraction of the light that is ambient, from all sides, 0 to 1
    #[arg(long, value_name = "SHARE")]
    ambient: Option<f64>,
    /// Factor on the heights of the relief, 0 to 10: 0 shades it flat, 1 leaves it unchanged
    #[arg(long, value_name = "X")]
    relief: Option<f64>,
    /// How far the eye adapted to the light, 0 to 1: with 1 white paint is white under every
    /// light, as an instrument measures; with 0 the light keeps its colour, so that evening looks
    /// like evening [default: the painting's, 1 unless it says so]
    #[arg(long, value_name = "DEGREE")]
    adaptation: Option<f64>,
    /// Exchange a pigment: LAYER:FROM=TO, LAYER being `wet`, a number from 0 (the lowest dry
    /// layer), or `all`; may be repeated
    #[arg(long, value_name = "LAYER:FROM=TO")]
    swap: Vec<String>,
    /// Multiply a dry layer's optical thickness: LAYER=X, 0 hides it; may be repeated
    #[arg(long, value_name = "LAYER=X")]
    opacity: Vec<String>,
    #[command(flatten)]
    engine: EngineOptions,
    #[command(flatten)]
    exports: Exports,
    /// Print JSON: canvas, cell_mm, layers with their pigments, lighting, wavelengths_nm
    #[arg(long)]
    json: bool,
    /// Print the layers as CSV, the lowest first
    #[arg(long, conflicts_with = "json")]
    csv: bool,
}

impl Relight {
    pub(super) fn run(self, console: &mut Console<'_>) -> Result<()> {
        let request = self.request();
        let job = heard(console, |task, _| request.open(task).map_err(refusal))?;
        let engine = self.engine.engine(job.floor(), console)?;
        let outcome = heard(console, |task, listener| Ok(job.relight(engine, task, listener)?))?;
        match (self.json, self.csv) {
            (true, _) => console.json(&serde_json::to_value(&outcome).expect("JSON holds it")),
            (_, true) => {
                let rows = outcome.layers.iter().map(serde_json::to_value);
                let rows: std::result::Result<Vec<_>, _> = rows.collect();
                console.csv_rows(&rows.expect("JSON holds a layer"))
            }
            _ => print(&outcome, console),
        }
    }

    /// The request of these options.
    fn request(&self) -> RelightRequest {
        RelightRequest {
            painting: self.painting.clone(),
            illuminant: self.illuminant.clone(),
            observer: self.observer.clone(),
            azimuth: self.azimuth,
            elevation: self.elevation,
            ambient: self.ambient,
            relief: self.relief,
            adaptation: self.adaptation,
            swap: self.swap.clone(),
            opacity: self.opacity.clone(),
            exports: self.exports.request(),
            undo_memory: self.engine.undo_memory(),
            device: self.engine.device(),
        }
    }
}

/// Converts an error of the request. If it is a number of the light, the hint names the help.
fn refusal(error: PictureError) -> Failure {
    match &error {
        PictureError::Setting(setting) if setting.key().is_some_and(is_of_light) => {
            Failure::usage(setting.message(option_of), "see impasto relight --help")
        }
        _ => error.into(),
    }
}

fn is_of_light(key: &str) -> bool {
    ["azimuth", "elevation", "ambient", "relief", "adaptation"].contains(&key)
}

/// Opacity, visibility and name of a layer, where they are not as painted.
fn about(layer: &LayerOutcome) -> String {
    let mut about = String::new();
    if layer.opacity != 1.0 {
        about += &format!(", opacity {}", layer.opacity);
    }
    if let Some(dry) = &layer.dry {
        if !dry.visible {
            about += ", hidden";
        }
        if !dry.name.is_empty() {
            about += &format!(" ({})", dry.name);
        }
    }
    about
}

/// Prints size, layers and lighting of a painting.
fn print(outcome: &RelightOutcome, console: &mut Console<'_>) -> Result<()> {
    let RelightOutcome { canvas: (width, height), cell_mm, layers, lighting, .. } = outcome;
    let cell = at_most(*cell_mm, 4);
    console.line(format!("{width} x {height} cells of {cell} mm"))?;
    for layer in layers {
        let LayerOutcome { layer: name, pigments, .. } = layer;
        console.line(format!("{name:>7}: {}{}", pigments.join(", "), about(layer)))?;
    }
    let nodes: Vec<String> = outcome.wavelengths_nm.iter().map(|nm| format!("{nm:.0}")).collect();
    console.line(format!(
        "light {}, observer {}, at {} nm",
        lighting.illuminant,
        lighting.observer,
        nodes.join(" ")
    ))
}
