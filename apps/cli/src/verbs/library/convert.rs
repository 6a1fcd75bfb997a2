//! `impasto library convert`: converts a library to another grid, white or kind of amounts, or
//! makes one from a table of K and S.

use std::path::{Path, PathBuf};

use calibrate::curation::{LibraryFrame, from_csv, on_grid, with_reference};
use calibrate::library::{AmountKind, Input, PigmentLibrary};
use clap::{Args, ValueEnum};
use documents::counted;
use spectra::Interpolation;

use super::resampling::ResamplingOptions;
use crate::console::Console;
use crate::failure::{Failure, Result};
use crate::grid_option::grid;
use crate::input::text;
use crate::library_choice::{chosen, default_path};
use crate::output::Output;
use crate::surface::SurfaceOptions;

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Amounts {
    /// Relative to a white
    Relative,
    /// Per unit of amount
    Absolute,
}

/// Convert a library to another grid or reference white, or make one from a table of K and S
///
/// The title, the licence, the source and the surface of a table (CSV: pigment, quantity,
/// wavelengths) come from the options; a pigment for which it has only K/S gets an unknown S.
///
/// With --white, a library of absolute amounts becomes one of shares; the colours of its films
/// that do not hide are then lost. Shares cannot become amounts, since the amount spread is not
/// known.
#[derive(Debug, Args)]
pub(super) struct Convert {
    /// The pigment library (JSON), or a table of K and S (CSV) as `export --to csv` writes it
    /// [default: that of IMPASTO_LIBRARY, else
    /// the Van Gogh oils that ship]
    library: Option<PathBuf>,
    /// The library file to write (JSON)
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// The new wavelengths in nm, such as 400,700,5
    #[arg(long, value_name = "FIRST,LAST,STEP")]
    grid: Option<String>,
    /// The pigment whose S becomes 1
    #[arg(long, alias = "reference", value_name = "PIGMENT")]
    white: Option<String>,
    #[command(flatten)]
    resampling: ResamplingOptions,
    /// Unit of the K and S of a table [default: relative]
    #[arg(long, value_enum)]
    amounts: Option<Amounts>,
    #[command(flatten)]
    surface: SurfaceOptions,
    /// Title of a library from a table
    #[arg(long)]
    title: Option<String>,
    /// Licence of a library from a table
    #[arg(long)]
    licence: Option<String>,
    /// Source of the K and S of a table
    #[arg(long)]
    source: Option<String>,
}

impl Convert {
    pub(super) fn run(self, console: &mut Console<'_>) -> Result<()> {
        let path = self.library.clone().or_else(default_path);
        let output = Output::open(&self.output, path.as_slice())?;
        let grid = self.grid.as_deref().map(grid).transpose()?;
        let table = path.as_ref().filter(|path| is_table(path));
        let (before, file) = if let Some(path) = table {
            let file = path.display().to_string();
            (self.table(path, &file)?, file)
        } else {
            self.refuse_table_options()?;
            if grid.is_none() && self.white.is_none() {
                return Err(Failure::usage(
                    "nothing to convert to",
                    "give --grid FIRST,LAST,STEP or --white PIGMENT",
                ));
            }
            let chosen = chosen(self.library.as_deref(), console)?;
            let file = chosen.name();
            (chosen.library, file)
        };
        let mut after = before.clone();
        if let Some(reference) = &self.white {
            after = with_reference(&file, &after, reference)?;
            remark_reference(&before, &after, console)?;
        }
        if let Some(grid) = grid {
            let best = Interpolation::best_for(before.grid);
            let method = self.resampling.method().unwrap_or(best);
            after = on_grid(&file, &after, grid, method, self.resampling.ends())?;
            console.remark(format!(
                "resampled from {} to {grid} ({})",
                before.grid,
                method.name()
            ))?;
        }
        output.write(after.to_json(), console)?;
        console.line(format!(
            "{}: {}, {}{}",
            self.output.display(),
            counted(after.pigments.len(), "pigment"),
            after.grid,
            after.reference.map_or_else(String::new, |name| format!(", S = 1 for {name}"))
        ))
    }

    /// Reads a library from a table of K and S.
    fn table(&self, path: &Path, file: &str) -> Result<PigmentLibrary> {
        let text = text(path)?;
        let frame = LibraryFrame {
            title: self.title.clone().unwrap_or_default(),
            licence: self.licence.clone().unwrap_or_default(),
            source: self.source.clone().unwrap_or_default(),
            amounts: match self.amounts {
                Some(Amounts::Absolute) => AmountKind::Absolute,
                Some(Amounts::Relative) | None => AmountKind::Relative,
            },
            reference: self.white.clone(),
            saunderson: self.surface.surface_or_usual()?,
        };
        let mut library = from_csv(file, &text, frame)?;
        library.inputs = vec![Input::new(file, text.as_bytes())];
        Ok(library)
    }

    /// Fails if an option is present that applies to tables only.
    fn refuse_table_options(&self) -> Result<()> {
        let options = [
            ("--amounts", self.amounts.is_some()),
            ("--saunderson", self.surface.is_present()),
            ("--title", self.title.is_some()),
            ("--licence", self.licence.is_some()),
            ("--source", self.source.is_some()),
        ];
        match options.into_iter().find(|(_, present)| *present) {
            None => Ok(()),
            Some((option, _)) => Err(Failure::usage(
                format!("{option} applies to tables (CSV) only; a library states its own"),
                "leave it out; to change amounts or surface, fit again",
            )),
        }
    }
}

/// Whether `path` is a table by its extension.
fn is_table(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("csv"))
}

/// Warns of the consequences of another reference white.
fn remark_reference(
    before: &PigmentLibrary,
    after: &PigmentLibrary,
    console: &mut Console<'_>,
) -> Result<()> {
    if before.reference == after.reference {
        return Ok(());
    }
    let white = after.reference.as_deref().unwrap_or_default();
    console.warnings(&[format!(
        "films that hide keep their colour; the thickness of others is now relative to {white}"
    )])?;
    if before.amounts == AmountKind::Absolute {
        let lost = "amounts became shares: the unevenness of films and the evidence of the fit are left out";
        console.warnings(&[lost.to_owned()])?;
    }
    let stand_ins = after.pigments.iter().filter(|pigment| !pigment.identified);
    let kept: Vec<String> =
        stand_ins.map(|pigment| format!("{}: S is not known and stays 1", pigment.name)).collect();
    console.warnings(if before.amounts == AmountKind::Relative { &kept } else { &[] })
}
