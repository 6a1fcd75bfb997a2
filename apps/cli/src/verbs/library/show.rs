//! `impasto library show`: prints the curves of one pigment.

use clap::Args;
use serde_json::json;

use crate::console::Console;
use crate::failure::{Failure, Result};
use crate::library_choice::{ChosenLibrary, chosen, split};

/// Show K and S of one pigment, with their standard deviations
#[derive(Debug, Args)]
#[command(override_usage = "impasto library show [OPTIONS] [LIBRARY] <PIGMENT>")]
pub(super) struct Show {
    /// The pigment library (JSON) [default: that of IMPASTO_LIBRARY, else
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
    pub(super) fn run(self, console: &mut Console<'_>) -> Result<()> {
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
        let deviation = |curve: &[f64], index: usize| {
            curve.get(index).map_or_else(|| "-".to_owned(), |v| format!("{v:.2e}"))
        };
        for (index, nm) in library.grid.wavelengths_nm().enumerate() {
            console.line(format!(
                "{nm:6} {:12.6} {:>8} {:12.6} {:>8}",
                pigment.absorption[index],
                deviation(&pigment.absorption_sd, index),
                pigment.scattering[index],
                deviation(&pigment.scattering_sd, index),
            ))?;
        }
        Ok(())
    }
}
