//! `impasto library from-rgb`: guesses a pigment from a colour.

use std::path::PathBuf;

use calibrate::curation::{Body, add_guessed};
use calibrate::library::PigmentLibrary;
use clap::Args;
use spectra::Grid;
use spectra::color::Rgb;

use crate::console::Console;
use crate::failure::{Failure, Result};
use crate::input::library;
use crate::output::Output;
use crate::surface::SurfaceOptions;

/// Add a plausible pigment of a colour, marked as guessed
///
/// K and S come from the smoothest reflectance that has exactly this colour under D65 for the 1931
/// observer (Burns 2020). A hiding paint has S = 1, as the reference white; a glaze has S = 0.02
/// and the colour at unit thickness over white. How such a paint mixes is a guess, since many
/// reflectances have the same colour.
/// Without LIBRARY a new one is made, from 400 to 700 nm in steps of 10. Its first hiding paint
/// becomes its reference, so begin with the white.
#[derive(Debug, Args)]
#[command(
    override_usage = "impasto library from-rgb [OPTIONS] --name <NAME> --output <FILE> [LIBRARY] <COLOUR>"
)]
pub(super) struct FromRgb {
    /// The pigment library (JSON) to add it to [default: a new one], and the colour: #rrggbb, or
    /// L,a,b under D65
    // Not two arguments: the first, optional, would take the colour's place before an option.
    #[arg(required = true, value_name = "[LIBRARY] COLOUR")]
    library_and_color: Vec<String>,
    /// Name of the pigment
    #[arg(long)]
    name: String,
    /// The colour is that of a paint that hides (the default)
    #[arg(long, conflicts_with = "glaze")]
    hiding: bool,
    /// The colour is that of a glaze over white
    #[arg(long)]
    glaze: bool,
    /// Use the nearest colour that a paint can have
    #[arg(long)]
    nearest: bool,
    /// The library file to write (JSON)
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    #[command(flatten)]
    surface: SurfaceOptions,
}

impl FromRgb {
    pub(super) fn run(self, console: &mut Console<'_>) -> Result<()> {
        let (path, color) = self.library_and_color()?;
        let inputs: Vec<PathBuf> = path.iter().cloned().collect();
        let output = Output::open(&self.output, &inputs)?;
        let mut library = match &path {
            Some(_) if self.surface.is_present() => {
                return Err(Failure::usage(
                    "--saunderson applies to new libraries only; this one states its surface",
                    "leave out --saunderson",
                ));
            }
            Some(path) => library(path)?,
            None => self.new_library()?,
        };
        let name = self.name.trim();
        let body = if self.glaze { Body::Glaze } else { Body::Hiding };
        let guess = add_guessed(&mut library, name, color, body, self.nearest)?;
        output.write(library.to_json(), console)?;
        if guess.delta_e >= 0.05 {
            let hex = &guess.hex;
            let off = guess.delta_e;
            let warning = format!("{color} is out of reach; {hex} is {off:.2} CIEDE2000 off");
            console.warnings(&[warning])?;
        }
        let patch = match Rgb::from_hex(&guess.hex) {
            Some(rgb) => console.patch(rgb),
            None => String::new(),
        };
        console.line(format!(
            "{}: {name} {patch}{}, {:.3} CIEDE2000 from {color}, guessed",
            self.output.display(),
            guess.hex,
            guess.delta_e
        ))
    }

    /// Splits the positional arguments into library and colour.
    fn library_and_color(&self) -> Result<(Option<PathBuf>, &str)> {
        match self.library_and_color.as_slice() {
            [color] => Ok((None, color.trim())),
            [library, color] => Ok((Some(PathBuf::from(library)), color.trim())),
            more => Err(Failure::usage(
                format!("expected a library and one colour, found `{}` arguments", more.len()),
                "quote a colour that holds spaces: \"40, 5, -45\"",
            )),
        }
    }

    /// Makes an empty library.
    fn new_library(&self) -> Result<PigmentLibrary> {
        let grid = Grid::from_nm(400.0, 10.0, 31)?;
        let library = PigmentLibrary::empty(grid, self.surface.surface_or_usual()?);
        Ok(PigmentLibrary { source: "guessed from colours".to_owned(), ..library })
    }
}
