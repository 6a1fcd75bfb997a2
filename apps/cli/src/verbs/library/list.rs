//! `impasto library list`: lists the pigments with their colours.

use std::path::PathBuf;

use calibrate::PigmentId;
use calibrate::library::{AmountKind, PigmentLibrary};
use clap::Args;
use serde_json::{Value, json};
use spectra::color::{Lab, RgbSpace};

use crate::console::Console;
use crate::failure::Result;
use crate::input::{ViewingOptions, srgb};
use crate::library_choice::{ChosenLibrary, chosen};
use crate::shown_color::TableColors;

/// List the pigments, each with its masstone and a tint in the reference white
#[derive(Debug, Args)]
pub(super) struct List {
    /// The pigment library (JSON) [default: that of IMPASTO_LIBRARY, else
    /// the Van Gogh oils that ship]
    library: Option<PathBuf>,
    #[command(flatten)]
    viewing: ViewingOptions,
    /// Print JSON: a list of name, colour_index, identified, guessed, lab, hex, in_gamut, notes
    #[arg(long)]
    json: bool,
    /// Print the table as CSV
    #[arg(long, conflicts_with = "json")]
    csv: bool,
}

impl List {
    pub(super) fn run(self, console: &mut Console<'_>) -> Result<()> {
        let viewing = self.viewing.viewing()?;
        let ChosenLibrary { library, .. } = chosen(self.library.as_deref(), console)?;
        if !self.json && !self.csv {
            let evidence = library.evidence.as_ref();
            let stated = |text: &str| if text.is_empty() { "not stated" } else { text }.to_owned();
            let title = stated(&library.title);
            let source = stated(&library.source);
            let licence = stated(&library.licence);
            console.line(format!("{title}, {}", library.grid))?;
            console.line(format!("source: {source}; licence: {licence}"))?;
            let unit = match &library.reference {
                Some(white) => format!("S = 1 for {white}"),
                None => "K and S per unit of amount".to_owned(),
            };
            let error = evidence.map_or_else(String::new, |evidence| {
                let errors = &evidence.delta_e;
                format!(
                    "; colour error of the fit: mean {:.2}, largest {:.2}",
                    errors.mean, errors.max
                )
            });
            console.line(unit + &error)?;
            return print_pigments(&library, &viewing, console);
        }
        let weights = viewing.weights(library.grid)?;
        let rows = library
            .ids()
            .map(|id| {
                let pigment = &library[id];
                let xyz = weights.xyz(&library.mix([(id, 1.0)])?.hiding(library.saunderson));
                let rgb = srgb(xyz, weights.white());
                Ok(json!({
                    "name": pigment.name,
                    "colour_index": pigment.color_index,
                    "identified": pigment.identified,
                    "guessed": pigment.guessed,
                    "lab": Lab::from_xyz(xyz, weights.white()).to_array(),
                    "hex": rgb.to_hex(),
                    "in_gamut": rgb.in_gamut(),
                    "notes": pigment.notes,
                }))
            })
            .collect::<Result<Vec<Value>>>()?;
        match self.csv {
            true => console.csv_rows(&rows),
            false => console.json(&Value::from(rows)),
        }
    }
}

/// Prints one line per pigment: its masstone, and a tint with nine parts of the reference white.
pub(crate) fn print_pigments(
    library: &PigmentLibrary,
    viewing: &calibrate::evaluate::Viewing,
    console: &mut Console<'_>,
) -> Result<()> {
    let weights = viewing.weights(library.grid)?;
    let white = library.reference.as_deref().and_then(|name| library.find(name).ok());
    let width = library.pigments.iter().map(|p| p.name.chars().count()).max().unwrap_or(0);
    let tints = white.is_some() && library.amounts == AmountKind::Relative;
    // A colour patch takes seven more columns.
    let column = if console.screen.colors { 21 } else { 14 };
    let heading = format!("{:column$}{}", "masstone", if tints { "tint 1:9" } else { "" });
    console.line(format!("{:width$}  {}", "pigment", heading.trim_end()))?;
    let mut colors = TableColors::of(RgbSpace::Srgb);
    for (index, pigment) in library.ids().zip(&library.pigments) {
        let mut color = |recipe: &[(PigmentId, f64)]| -> Result<String> {
            let xyz = weights.xyz(&library.mix(recipe)?.hiding(library.saunderson));
            let rgb = srgb(xyz, weights.white());
            Ok(colors.cell(rgb, console))
        };
        let mut line = format!("{:width$}  {}", pigment.name, color(&[(index, 1.0)])?);
        match white {
            Some(white) if tints && pigment.identified => {
                line += &format!("      {}", color(&[(index, 1.0), (white, 9.0)])?);
            }
            _ if tints => line += "      S unknown",
            _ => {}
        }
        if pigment.guessed {
            line += "  guessed";
        }
        console.line(line.trim_end())?;
    }
    colors.note("", console)
}
