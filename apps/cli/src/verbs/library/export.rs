//! `impasto library export` writes a library in formats of other programs, and `impasto library
//! from-rgb` guesses a pigment from a colour, e.g. `#c9a227`.

use std::path::PathBuf;

use calibrate::curation::{Body, SwatchSpace, Swatches, add_guessed, to_csv};
use calibrate::library::PigmentLibrary;
use clap::{Args, ValueEnum};
use documents::{counted, counted_as};
use spectra::color::Rgb;
use spectra::instrument::{CxfHead, write_cxf};
use spectra::swatch_file::{write_aco, write_ase, write_gpl};
use spectra::{Grid, Reflectance, Spectrum};

use crate::console::Console;
use crate::failure::{Failure, Result};
use crate::library_choice::chosen;
use crate::output::Output;
use crate::readings::{ViewingOptions, library, remark_coverage};
use crate::surface::SurfaceOptions;

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Format {
    /// GIMP palette: sRGB and names
    Gpl,
    /// Adobe Swatch Exchange: sRGB or Lab, and names
    Ase,
    /// Photoshop swatches: sRGB or Lab, and names
    Aco,
    /// K and S with their standard deviations, one row per curve
    Csv,
    /// CxF3: predicted reflectance spectra of the swatches
    Cxf,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Space {
    /// sRGB, clipped to its gamut
    Rgb,
    /// CIELAB under D50, as in graphic arts
    Lab,
}

/// Export a library to other programs: palettes, spectra, or a table of K and S
///
/// A swatch is the masstone of a pigment under the chosen light. Palettes of Adobe programs may hold
/// Lab under D50, to which colours under another light are adapted (Bradford).
#[derive(Debug, Args)]
pub(super) struct Export {
    /// The pigment library (JSON) [default: the one in IMPASTO_LIBRARY, else
    /// the Van Gogh oils that ship]
    library: Option<PathBuf>,
    /// Format of the output file [default: by its ending]
    #[arg(long, value_enum)]
    to: Option<Format>,
    /// The file to write
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// Add tints in the reference white, as parts of white to one of the pigment, such as 1,4,9
    #[arg(long, value_name = "PARTS", value_delimiter = ',', num_args = 0..=1,
          default_missing_value = "1,4,9", require_equals = true)]
    tints: Vec<String>,
    /// Colour space of .ase and .aco files
    #[arg(long, value_enum, default_value = "rgb")]
    space: Space,
    #[command(flatten)]
    viewing: ViewingOptions,
}

impl Export {
    /// The format that you give by `--to`, else the format that follows from the output's ending.
    fn format(&self, console: &mut Console<'_>) -> Result<Format> {
        let ending = self.output.extension().map(|ending| ending.to_string_lossy().to_lowercase());
        let named = ending.as_deref().and_then(|ending| Format::from_str(ending, true).ok());
        let output = self.output.display();
        match (self.to, named) {
            (Some(to), Some(named)) if to != named => {
                let [to, named] = [to, named].map(|format| format!("{format:?}").to_lowercase());
                console.warnings(&[format!(
                    "{output} is written as {to}, although its name ends in .{named}"
                )])?;
            }
            _ => {}
        }
        self.to.or(named).ok_or_else(|| {
            Failure::usage(
                format!("{output}: the ending names no format"),
                "add --to gpl, ase, aco, csv or cxf",
            )
        })
    }

    pub(super) fn run(self, console: &mut Console<'_>) -> Result<()> {
        let to = self.format(console)?;
        if self.space == Space::Lab && !matches!(to, Format::Ase | Format::Aco) {
            return Err(Failure::usage("only .ase and .aco hold Lab", "leave out --space"));
        }
        if to == Format::Csv && !self.tints.is_empty() {
            return Err(Failure::usage("a table of K and S has no tints", "leave out --tints"));
        }
        let tints = tints(&self.tints)?;
        let viewing = self.viewing.viewing(console)?;
        let chosen = chosen(self.library.as_deref(), console)?;
        let output = Output::open(&self.output, &chosen.inputs())?;
        let library = chosen.library;
        if to == Format::Csv {
            remark_csv_omissions(&library, console)?;
            output.write(to_csv(&library), console)?;
            let pigments = counted(library.pigments.len(), "pigment");
            return console.line(format!("{}: {pigments}", self.output.display()));
        }
        remark_coverage(library.grid, console)?;
        let swatches = Swatches::new(&library, &viewing, &tints)?;
        let number = swatches.swatches.len();
        if to == Format::Cxf {
            output.write(cxf(&library, &swatches)?, console)?;
            let spectra = if number == 1 { "spectrum" } else { "spectra" };
            return console.line(format!("{}: {number} {spectra}", self.output.display()));
        }
        let clipped = swatches.outside_srgb();
        if self.space == Space::Rgb && !clipped.is_empty() {
            let names = clipped.join(", ");
            console.warnings(&[format!("outside sRGB, clipped to its gamut: {names}")])?;
        }
        let palette = swatches.palette(match self.space {
            Space::Rgb => SwatchSpace::Srgb,
            Space::Lab => SwatchSpace::LabD50,
        });
        let bytes = match to {
            Format::Ase => write_ase(&palette)?,
            Format::Aco => write_aco(&palette)?,
            Format::Gpl | Format::Csv | Format::Cxf => write_gpl(&palette)?.into_bytes(),
        };
        output.write(bytes, console)?;
        console.line(format!(
            "{}: {}",
            self.output.display(),
            counted_as(number, "swatch", "swatches")
        ))
    }
}

/// Encodes the spectra of the swatches as CxF3.
fn cxf(library: &PigmentLibrary, swatches: &Swatches) -> Result<String> {
    let swatches = &swatches.swatches;
    let spectra = swatches
        .iter()
        .map(|swatch| Ok(Spectrum::new(library.grid, swatch.reflectance.clone())?))
        .collect::<Result<Vec<Spectrum<Reflectance>>>>()?;
    let named: Vec<(&str, &Spectrum<Reflectance>)> =
        swatches.iter().map(|swatch| swatch.name.as_str()).zip(&spectra).collect();
    let head = CxfHead {
        creator: "impasto",
        description: &library.title,
        geometry: "predicted",
        creation_date: None,
    };
    Ok(write_cxf(&head, &named))
}

/// Parses the parts of white of `--tints`.
fn tints(texts: &[String]) -> Result<Vec<f64>> {
    let parts = texts.iter().map(|text| {
        text.trim().parse().ok().filter(|v: &f64| *v > 0.0 && *v <= 1e6).ok_or_else(|| {
            Failure::usage(
                format!("--tints takes parts of white above 0 and up to 1e6, found `{text}`"),
                "try --tints=1,4,9",
            )
        })
    });
    parts.collect()
}

/// Prints the parts of a library that a table cannot hold.
fn remark_csv_omissions(library: &PigmentLibrary, console: &mut Console<'_>) -> Result<()> {
    let guessed = library.pigments.iter().filter(|pigment| pigment.guessed);
    let guessed: Vec<String> = guessed
        .map(|pigment| format!("{} is guessed, which the table cannot state", pigment.name))
        .collect();
    console.warnings(&guessed)?;
    let surface = library.saunderson;
    console.remark(format!(
        "the table does not hold: k1 = {}, k2 = {}, titles, notes, evidence{}",
        surface.k1,
        surface.k2,
        library
            .reference
            .as_ref()
            .map_or_else(String::new, |name| format!(", the reference {name}"))
    ))
}

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
