//! `impasto library show`: prints the curves of one pigment.

use std::path::PathBuf;

use clap::Args;
use serde_json::json;

use crate::console::Console;
use crate::failure::Result;
use crate::input::library;

/// Show K and S of one pigment, with their standard deviations
#[derive(Debug, Args)]
pub(super) struct Show {
    /// The pigment library (JSON)
    library: PathBuf,
    /// The pigment; the name may be abbreviated
    pigment: String,
    /// Print JSON: the pigment as in the library, and wavelengths_nm
    #[arg(long)]
    json: bool,
}

impl Show {
    pub(super) fn run(self, console: &mut Console<'_>) -> Result<()> {
        let library = library(&self.library)?;
        let pigment = &library[library.find(&self.pigment)?];
        if self.json {
            let mut value = serde_json::to_value(pigment).expect("a pigment serializes to JSON");
            let wavelengths: Vec<f64> = library.grid.wavelengths_nm().collect();
            value["wavelengths_nm"] = json!(wavelengths);
            return console.json(&value);
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
