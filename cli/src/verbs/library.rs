//! `impasto library`: look into a pigment library.

use std::path::PathBuf;

use calibrate::library::{AmountKind, PigmentLibrary};
use clap::{Args, Subcommand};
use serde_json::{Value, json};
use spectra::color::Lab;

use crate::console::Console;
use crate::input::{ViewingOptions, library, srgb};

/// Look into a pigment library
#[derive(Debug, Args)]
pub(crate) struct Library {
    #[command(subcommand)]
    what: What,
}

#[derive(Debug, Subcommand)]
enum What {
    List(List),
    Show(Show),
}

/// The pigments, each with its masstone and a tint in the reference white
#[derive(Debug, Args)]
struct List {
    /// The pigment library (JSON)
    library: PathBuf,
    #[command(flatten)]
    viewing: ViewingOptions,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

/// K and S of one pigment, with their standard deviations
#[derive(Debug, Args)]
struct Show {
    /// The pigment library (JSON)
    library: PathBuf,
    /// The pigment; the name may be cut short
    pigment: String,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

impl Library {
    pub(super) fn run(self, console: &mut Console<'_>) -> anyhow::Result<()> {
        match self.what {
            What::List(verb) => verb.run(console),
            What::Show(verb) => verb.run(console),
        }
    }
}

impl List {
    fn run(self, console: &mut Console<'_>) -> anyhow::Result<()> {
        let viewing = self.viewing.viewing()?;
        let library = library(&self.library)?;
        if !self.json {
            let evidence = library.evidence.as_ref();
            console.line(format!("{}, {}", library.title, library.grid))?;
            console.line(format!("source: {}; licence: {}", library.source, library.licence))?;
            match (&library.reference, evidence) {
                (Some(white), Some(e)) => console.line(format!(
                    "S = 1 for {white}; colour error of the fit: mean {:.2}, largest {:.2}",
                    e.delta_e.mean, e.delta_e.max
                ))?,
                (None, Some(e)) => console.line(format!(
                    "K and S per unit of amount; colour error of the fit: mean {:.2}, largest {:.2}",
                    e.delta_e.mean, e.delta_e.max
                ))?,
                _ => {}
            }
            return print_pigments(&library, &viewing, console);
        }
        let weights = viewing.weights(library.grid)?;
        let rows = (0..library.pigments.len())
            .map(|index| {
                let pigment = &library.pigments[index];
                let xyz = weights.xyz(&library.mix(&[(index, 1.0)])?.hiding(library.saunderson));
                Ok(json!({
                    "name": pigment.name,
                    "colour_index": pigment.colour_index,
                    "identified": pigment.identified,
                    "lab": Lab::from_xyz(xyz, weights.white()).to_array(),
                    "hex": srgb(xyz, weights.white()).to_hex(),
                    "notes": pigment.notes,
                }))
            })
            .collect::<anyhow::Result<Vec<Value>>>()?;
        console.json(&Value::from(rows))
    }
}

/// A line for each pigment: masstone, and one part in ten of the reference.
pub(super) fn print_pigments(
    library: &PigmentLibrary,
    viewing: &calibrate::evaluate::Viewing,
    console: &mut Console<'_>,
) -> anyhow::Result<()> {
    let weights = viewing.weights(library.grid)?;
    let white = library.reference.as_deref().and_then(|name| library.find(name).ok());
    let width = library.pigments.iter().map(|p| p.name.chars().count()).max().unwrap_or(0);
    let tints = white.is_some() && library.amounts == AmountKind::Relative;
    // A patch of colour takes seven columns more.
    let column = if console.screen.colours { 21 } else { 14 };
    let heading = format!("{:column$}{}", "masstone", if tints { "tint 1:9" } else { "" });
    console.line(format!("{:width$}  {}", "pigment", heading.trim_end()))?;
    for (index, pigment) in library.pigments.iter().enumerate() {
        let colour = |recipe: &[(usize, f64)]| -> anyhow::Result<String> {
            let xyz = weights.xyz(&library.mix(recipe)?.hiding(library.saunderson));
            let rgb = srgb(xyz, weights.white());
            Ok(format!("{}{}", console.patch(rgb), rgb.to_hex()))
        };
        let mut line = format!("{:width$}  {}", pigment.name, colour(&[(index, 1.0)])?);
        match white {
            Some(white) if tints && pigment.identified => {
                line += &format!("       {}", colour(&[(index, 1.0), (white, 9.0)])?);
            }
            _ if tints => line += "       S unknown",
            _ => {}
        }
        console.line(line)?;
    }
    Ok(())
}

impl Show {
    fn run(self, console: &mut Console<'_>) -> anyhow::Result<()> {
        let library = library(&self.library)?;
        let pigment = &library.pigments[library.find(&self.pigment)?];
        if self.json {
            let mut value = serde_json::to_value(pigment)?;
            let wavelengths: Vec<f64> = library.grid.wavelengths_nm().collect();
            value["wavelengths_nm"] = json!(wavelengths);
            return console.json(&value);
        }
        console.line(&pigment.name)?;
        for note in &pigment.notes {
            console.line(format!("note: {note}"))?;
        }
        console.line("    nm            K       +-            S       +-")?;
        let deviation = |curve: &[f64], at: usize| {
            curve.get(at).map_or_else(|| "-".to_owned(), |v| format!("{v:.2e}"))
        };
        for (at, nm) in library.grid.wavelengths_nm().enumerate() {
            console.line(format!(
                "{nm:6} {:12.6} {:>8} {:12.6} {:>8}",
                pigment.absorption[at],
                deviation(&pigment.absorption_sd, at),
                pigment.scattering[at],
                deviation(&pigment.scattering_sd, at),
            ))?;
        }
        Ok(())
    }
}
