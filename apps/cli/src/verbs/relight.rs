//! `impasto relight`: shows a painting under another light or with other pigments.

use std::path::PathBuf;

use clap::Args;
use paint::document::{Document, Lighting};
use paint::layer::{DryLayerState, LayerRef};
use paint::light::Light;
use paint::painting::Painting;
use serde_json::json;

use crate::console::Console;
use crate::csv_rows::at_most;
use crate::engine::EngineOptions;
use crate::failure::{Failure, Result};
use crate::pictures::Exports;
use crate::progress::waited;
use crate::readings::viewing;

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
        let form = match (self.json, self.csv) {
            (true, _) => Form::Json,
            (_, true) => Form::Csv,
            _ => Form::Text,
        };
        let mut document =
            waited("reading the painting", console, || Document::open(&self.painting))?;
        document.lighting = self.lighting(&document.lighting)?;
        let Lighting { illuminant, observer, .. } = &document.lighting;
        let light = Light::new(&document.library, &viewing(illuminant, observer)?)?;
        let exports = self.exports.open(std::slice::from_ref(&self.painting))?;
        let engine = self.engine.engine(&document.ground.height, console)?;
        let undo_bytes = self.engine.undo_bytes();
        let mut painting = waited("lighting the painting", console, || -> Result<Painting> {
            let mut painting = Painting::open_under(document, light, engine, undo_bytes)?;
            self.swap.iter().try_for_each(|text| swap(&mut painting, text))?;
            self.opacity.iter().try_for_each(|text| opacity(&mut painting, text))?;
            Ok(painting)
        })?;
        exports.write(&mut painting, console)?;
        print(&painting, form, console)
    }

    /// Lighting of the painting with the given options in place of the `saved` values.
    fn lighting(&self, saved: &Lighting) -> Result<Lighting> {
        Ok(Lighting {
            illuminant: self.illuminant.clone().unwrap_or_else(|| saved.illuminant.clone()),
            observer: self.observer.clone().unwrap_or_else(|| saved.observer.clone()),
            azimuth_deg: number("azimuth", self.azimuth, saved.azimuth_deg, [-360.0, 360.0])?,
            elevation_deg: number("elevation", self.elevation, saved.elevation_deg, [1.0, 90.0])?,
            ambient: number("ambient", self.ambient, saved.ambient, [0.0, 1.0])?,
            relief: number("relief", self.relief, saved.relief, [0.0, 10.0])?,
            adaptation: number("adaptation", self.adaptation, saved.adaptation, [0.0, 1.0])?,
        })
    }
}

/// Number of the option `name`, or the saved one without it.
fn number(name: &str, option: Option<f64>, saved: f64, [least, most]: [f64; 2]) -> Result<f64> {
    match option {
        Some(value) if !(least..=most).contains(&value) => Err(Failure::usage(
            format!("--{name} takes {least} to {most}, found `{value}`"),
            "see impasto relight --help",
        )),
        option => Ok(option.unwrap_or(saved)),
    }
}

/// Replaces a pigment by another as `LAYER:FROM=TO` says.
fn swap(painting: &mut Painting, text: &str) -> Result<()> {
    let wrong = || {
        Failure::usage(
            format!("--swap takes LAYER:FROM=TO, found `{text}`"),
            "try --swap \"all:Emerald Green=Viridian\"",
        )
    };
    let (layer, names) = text.split_once(':').ok_or_else(wrong)?;
    let (from, to) = names.split_once('=').ok_or_else(wrong)?;
    let from = painting.library().find(from)?;
    let to = painting.library().find(to)?;
    let layers = match layer.trim() {
        "wet" => vec![LayerRef::Wet],
        "all" => {
            let dry = (0..painting.state().dry.len()).map(LayerRef::Dry);
            let all: Vec<LayerRef> = dry.chain([LayerRef::Wet]).collect();
            let found = all.into_iter().filter(|layer| {
                painting.slots(*layer).is_ok_and(|slots| slots.contains(&Some(from)))
            });
            let found: Vec<LayerRef> = found.collect();
            if found.is_empty() {
                return Err(Failure::data(
                    format!("no layer has {}", painting.library()[from].name),
                    "impasto relight PAINTING lists the pigments of each layer",
                ));
            }
            found
        }
        number => vec![LayerRef::Dry(number.parse().map_err(|_| wrong())?)],
    };
    for layer in layers {
        painting.swap_pigment(layer, from, to)?;
    }
    Ok(())
}

/// Sets the opacity of a dry layer as `LAYER=X` says.
fn opacity(painting: &mut Painting, text: &str) -> Result<()> {
    let wrong = || {
        Failure::usage(format!("--opacity takes LAYER=X, found `{text}`"), "try --opacity 0=0.5")
    };
    let (layer, value) = text.split_once('=').ok_or_else(wrong)?;
    let layer = layer.trim().parse().map_err(|_| wrong())?;
    let value = value.trim().parse().map_err(|_| wrong())?;
    Ok(painting.set_opacity(LayerRef::Dry(layer), value)?)
}

/// Opacity, visibility and name of a dry layer, where they are not as painted.
fn about(dry: &DryLayerState) -> String {
    let mut about = String::new();
    if dry.opacity != 1.0 {
        about += &format!(", opacity {}", dry.opacity);
    }
    if !dry.visible {
        about += ", hidden";
    }
    if !dry.name.is_empty() {
        about += &format!(" ({})", dry.name);
    }
    about
}

/// Form of what is printed.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Form {
    Text,
    Json,
    Csv,
}

/// Prints size, layers and lighting of a painting.
fn print(painting: &Painting, form: Form, console: &mut Console<'_>) -> Result<()> {
    let bounds = painting.bounds();
    let names = |layer| -> Result<Vec<String>> {
        let slots = painting.slots(layer)?;
        Ok(slots
            .iter()
            .flatten()
            .map(|&pigment| painting.library()[pigment].name.clone())
            .collect())
    };
    let mut layers = Vec::new();
    for (index, dry) in painting.state().dry.iter().enumerate() {
        let dry = (format!("dry {index}"), Some(dry), names(LayerRef::Dry(index))?);
        layers.push(dry);
    }
    layers.push(("wet".to_owned(), None, names(LayerRef::Wet)?));
    let lighting = &painting.state().lighting;
    let nodes = &painting.light().quadrature.rule.nodes_nm;
    let rows = layers.iter().map(|(layer, dry, pigments)| match dry {
        None => json!({"layer": layer, "opacity": 1.0, "pigments": pigments}),
        Some(dry) => json!({
            "layer": layer, "opacity": dry.opacity, "pigments": pigments,
            "id": dry.id.0, "name": dry.name, "visible": dry.visible,
        }),
    });
    if form == Form::Csv {
        return console.csv_rows(&rows.collect::<Vec<_>>());
    }
    if form == Form::Json {
        return console.json(&json!({
            "canvas": [bounds.width, bounds.height],
            "cell_mm": painting.cell_mm(),
            "layers": rows.collect::<Vec<_>>(),
            "lighting": serde_json::to_value(lighting).expect("a lighting serializes to JSON"),
            "wavelengths_nm": nodes,
        }));
    }
    let width = bounds.width;
    let height = bounds.height;
    let cell = at_most(painting.cell_mm(), 4);
    console.line(format!("{width} x {height} cells of {cell} mm"))?;
    for (layer, dry, pigments) in &layers {
        let about = dry.map_or_else(String::new, about);
        console.line(format!("{layer:>7}: {}{about}", pigments.join(", ")))?;
    }
    let nodes: Vec<String> = nodes.iter().map(|nm| format!("{nm:.0}")).collect();
    console.line(format!(
        "light {}, observer {}, at {} nm",
        lighting.illuminant,
        lighting.observer,
        nodes.join(" ")
    ))
}
