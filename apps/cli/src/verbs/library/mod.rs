//! `impasto library` inspects, merges and changes pigment libraries. For example, `list` prints the
//! pigments with their colours, and `show` prints the curves of the pigment that you name.

mod convert;
mod export;
mod check;

use std::path::PathBuf;

use calibrate::PigmentId;
use calibrate::library::{AmountKind, PigmentLibrary};
use clap::{Args, Subcommand};
use serde_json::{Value, json};
use spectra::color::{Lab, RgbSpace};

use crate::console::Console;
use crate::csv_rows::TableColors;
use crate::failure::{Failure, Result};
use crate::library_choice::{ChosenLibrary, chosen, split};
use crate::readings::{ViewingOptions, srgb};

/// Inspect, merge and change pigment libraries
#[derive(Debug, Args)]
pub(crate) struct Library {
    #[command(subcommand)]
    verb: LibraryVerb,
}

#[derive(Debug, Subcommand)]
enum LibraryVerb {
    List(List),
    Show(Show),
    Check(check::Check),
    Diff(check::Diff),
    Merge(convert::Merge),
    Convert(convert::Convert),
    Rename(convert::Rename),
    Subset(convert::Subset),
    Export(export::Export),
    FromRgb(export::FromRgb),
}

impl Library {
    pub(super) fn run(self, console: &mut Console<'_>) -> Result<()> {
        match self.verb {
            LibraryVerb::List(verb) => verb.run(console),
            LibraryVerb::Show(verb) => verb.run(console),
            LibraryVerb::Check(verb) => verb.run(console),
            LibraryVerb::Diff(verb) => verb.run(console),
            LibraryVerb::Merge(verb) => verb.run(console),
            LibraryVerb::Convert(verb) => verb.run(console),
            LibraryVerb::Rename(verb) => verb.run(console),
            LibraryVerb::Subset(verb) => verb.run(console),
            LibraryVerb::Export(verb) => verb.run(console),
            LibraryVerb::FromRgb(verb) => verb.run(console),
        }
    }
}

/// List the pigments, each with its masstone and a tint in the reference white
#[derive(Debug, Args)]
struct List {
    /// The pigment library (JSON) [default: the one in IMPASTO_LIBRARY, else
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
    fn run(self, console: &mut Console<'_>) -> Result<()> {
        let viewing = self.viewing.viewing(console)?;
        let ChosenLibrary { library, .. } = chosen(self.library.as_deref(), console)?;
        if !self.json && !self.csv {
            let evidence = library.evidence.as_ref();
            let stated = [&library.title, &library.source, &library.licence];
            let [title, source, licence] =
                stated.map(|text| if text.is_empty() { "not stated" } else { text.as_str() });
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
    let width = documents::column_width(library.pigments.iter().map(|p| &p.name), 0);
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

/// Show K and S of one pigment, with their standard deviations
#[derive(Debug, Args)]
#[command(override_usage = "impasto library show [OPTIONS] [LIBRARY] <PIGMENT>")]
struct Show {
    /// The pigment library (JSON) [default: the one in IMPASTO_LIBRARY, else
    /// the Van Gogh oils that ship], then the pigment, whose name may be abbreviated
    #[arg(required = true, num_args = 1..=2, value_name = "[LIBRARY] PIGMENT")]
    words: Vec<String>,
    /// Print JSON: the pigment as in the library, and wavelengths_nm
    #[arg(long)]
    json: bool,
    /// Print the curves as CSV
    #[arg(long, conflicts_with = "json")]
    csv: bool,
}

impl Show {
    fn run(self, console: &mut Console<'_>) -> Result<()> {
        let (path, names) = split(&self.words, true);
        let [name] = names else {
            return Err(Failure::usage(
                format!("expected a library and one pigment, found `{}`", self.words.join(" ")),
                "try impasto library show oils.json Viridian",
            ));
        };
        let ChosenLibrary { library, .. } = chosen(path.as_deref(), console)?;
        let pigment = &library[library.find(name)?];
        if self.json {
            let mut value = serde_json::to_value(pigment).expect("a pigment serializes to JSON");
            let wavelengths: Vec<f64> = library.grid.wavelengths_nm().collect();
            value["wavelengths_nm"] = json!(wavelengths);
            return console.json(&value);
        }
        if self.csv {
            let rows = library.grid.wavelengths_nm().enumerate().map(|(index, nm)| {
                json!({
                    "nm": nm,
                    "K": pigment.absorption[index],
                    "K_sd": pigment.absorption_sd.get(index),
                    "S": pigment.scattering[index],
                    "S_sd": pigment.scattering_sd.get(index),
                })
            });
            return console.csv_rows(&rows.collect::<Vec<_>>());
        }
        let mark = if pigment.guessed { " (guessed)" } else { "" };
        console.line(format!("{}{mark}", pigment.name))?;
        for note in &pigment.notes {
            console.line(format!("note: {note}"))?;
        }
        console.line("    nm            K       +-            S       +-")?;
        for (index, nm) in library.grid.wavelengths_nm().enumerate() {
            let [k_sd, s_sd] = [&pigment.absorption_sd, &pigment.scattering_sd].map(|curve| {
                curve.get(index).map_or_else(|| "-".to_owned(), |v| format!("{v:.2e}"))
            });
            let k = pigment.absorption[index];
            let s = pigment.scattering[index];
            console.line(format!("{nm:6} {k:12.6} {k_sd:>8} {s:12.6} {s_sd:>8}"))?;
        }
        Ok(())
    }
}
