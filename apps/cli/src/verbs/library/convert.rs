//! `impasto library convert` converts a library to another grid, white or kind of amounts, or makes
//! one from a table of K and S. `merge` merges libraries into one, `rename` renames pigments, and
//! `subset` keeps the pigments that you name. The options for resampling curves to another grid are
//! here too.

use std::path::{Path, PathBuf};

use calibrate::curation::{
    LibraryFrame, MergeSettings, Prefer, Source, from_csv, merged, on_grid, renamed, subset,
    with_color_indices, with_reference,
};
use calibrate::library::{AmountKind, Input, PigmentLibrary};
use clap::{Args, ValueEnum};
use documents::{counted, text::read_text};
use serde_json::json;
use spectra::{Extrapolation, Interpolation};

use crate::console::Console;
use crate::failure::{Failure, Result};
use crate::library_choice::{chosen, default_path, split};
use crate::output::Output;
use crate::readings::{ViewingOptions, library, remark_repeated};
use crate::surface::{SurfaceOptions, grid};

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
    /// [default: the one in IMPASTO_LIBRARY, else
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
    /// Title of the new library, if it is made from a table
    #[arg(long)]
    title: Option<String>,
    /// Licence of the new library, if it is made from a table
    #[arg(long)]
    licence: Option<String>,
    /// Source of the K and S, if the library is made from a table
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
        let text = read_text(path)?;
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

#[derive(Debug, Clone, Copy, ValueEnum)]
enum InterpolationName {
    /// Straight lines, which never overshoot
    Linear,
    /// Sprague's polynomial, for smooth curves; clipped at 0
    Sprague,
}

/// Options for resampling K and S to another grid.
#[derive(Debug, Clone, Copy, Args)]
pub(super) struct ResamplingOptions {
    /// Interpolation of K and S on another grid [default: sprague, linear below six wavelengths]
    #[arg(long, value_enum)]
    interpolation: Option<InterpolationName>,
    /// Continue the end values beyond a library's band instead of failing
    #[arg(long)]
    hold_ends: bool,
}

impl ResamplingOptions {
    /// Interpolation that you give by the option, `None` if it is absent.
    pub(super) fn method(self) -> Option<Interpolation> {
        self.interpolation.map(|name| match name {
            InterpolationName::Linear => Interpolation::Linear,
            InterpolationName::Sprague => Interpolation::Sprague,
        })
    }

    /// Treatment of wavelengths beyond a library's band.
    pub(super) fn ends(self) -> Extrapolation {
        if self.hold_ends { Extrapolation::Hold } else { Extrapolation::Refuse }
    }
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum PreferName {
    First,
    Last,
}

/// Merge libraries into one
///
/// K and S of relative libraries are converted to one reference white, that of the first library:
/// those of each later library are divided by its own S of this white, found there by name or by
/// --as. This keeps the K/S of every mixture. Pigments that two libraries share are compared.
/// Libraries with different surfaces, or one of shares and one of amounts, cannot be merged.
#[derive(Debug, Args)]
pub(super) struct Merge {
    /// The pigment libraries (JSON); grid and surface are those of the first
    #[arg(required = true, num_args = 2.., value_name = "LIBRARY")]
    libraries: Vec<PathBuf>,
    /// The library file to write (JSON)
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// The white that all libraries share, by its name in the first [default: its reference]
    #[arg(long, alias = "reference", value_name = "PIGMENT")]
    white: Option<String>,
    /// Name of that white in another library (may be repeated)
    #[arg(long = "as", value_name = "PIGMENT")]
    aliases: Vec<String>,
    /// Which of two different pigments with the same name to keep [default: an error; for the
    /// white, the first]
    #[arg(long, value_enum)]
    prefer: Option<PreferName>,
    /// Title of the new library [default: all titles]
    #[arg(long)]
    title: Option<String>,
    #[command(flatten)]
    resampling: ResamplingOptions,
    /// Accept pigments that were fitted under another surface, and treat them as fitted under the
    /// surface of the first library
    #[arg(long)]
    any_surface: bool,
    /// Confirm that the absolute amounts of all libraries have the same unit and area
    #[arg(long)]
    same_unit: bool,
    #[command(flatten)]
    viewing: ViewingOptions,
    /// Print JSON: pigments (how many), reference, common (those in several libraries), warnings
    #[arg(long)]
    json: bool,
    /// Print CSV of the pigments that occur in several of the libraries
    #[arg(long, conflicts_with = "json")]
    csv: bool,
}

impl Merge {
    pub(super) fn run(self, console: &mut Console<'_>) -> Result<()> {
        remark_repeated(&self.libraries, console)?;
        let output = Output::open(&self.output, &self.libraries)?;
        let sources = self
            .libraries
            .iter()
            .map(|path| Ok(Source { file: path.display().to_string(), library: library(path)? }))
            .collect::<Result<Vec<Source>>>()?;
        let settings = MergeSettings {
            reference: self.white,
            aliases: self.aliases,
            prefer: self.prefer.map(|prefer| match prefer {
                PreferName::First => Prefer::First,
                PreferName::Last => Prefer::Last,
            }),
            interpolation: self.resampling.method(),
            ends: self.resampling.ends(),
            any_surface: self.any_surface,
            same_unit: self.same_unit,
            viewing: self.viewing.viewing(console)?,
        };
        let mut found = merged(&sources[0], &sources[1..], &settings)?;
        if let Some(title) = self.title {
            found.library.title = title;
        }
        if sources.iter().any(|source| source.library.evidence.is_some()) {
            found.warnings.push(
                "the evidence of each fit is left out; its errors are in the notes of the pigments"
                    .into(),
            );
        }
        console.warnings(&found.warnings)?;
        output.write(found.library.to_json(), console)?;
        let common = found.common.iter().map(|(name, file, delta_e)| {
            json!({ "name": name, "file": file, "masstone_ciede2000": delta_e })
        });
        if self.csv {
            return console.csv_rows(&common.collect::<Vec<_>>());
        }
        if self.json {
            return console.json(&json!({
                "pigments": found.library.pigments.len(),
                "reference": found.library.reference,
                "common": common.collect::<Vec<_>>(),
                "warnings": found.warnings,
            }));
        }
        for (name, file, delta_e) in &found.common {
            console.line(format!("{name}: that of {file} differs by {delta_e:.2} CIEDE2000"))?;
        }
        console.line(format!(
            "{}: {} of {} libraries",
            self.output.display(),
            counted(found.library.pigments.len(), "pigment"),
            sources.len()
        ))
    }
}

/// Rename pigments; everything else stays the same, byte for byte
#[derive(Debug, Args)]
#[command(
    override_usage = "impasto library rename [OPTIONS] --output <FILE> [LIBRARY] [OLD=NEW]..."
)]
pub(super) struct Rename {
    /// The pigment library (JSON) [default: the one in IMPASTO_LIBRARY, else
    /// the Van Gogh oils that ship], then pairs OLD=NEW; OLD may be abbreviated. All change at the
    /// same time, so two names can be swapped
    #[arg(value_name = "[LIBRARY] OLD=NEW")]
    words: Vec<String>,
    /// Set a Colour Index name, such as "Ultramarine=PB29" (may be repeated); `NAME=` removes it
    #[arg(long = "colour-index", value_name = "NAME=INDEX")]
    color_index: Vec<String>,
    /// The library file to write (JSON)
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
}

impl Rename {
    pub(super) fn run(self, console: &mut Console<'_>) -> Result<()> {
        let (path, names) = split(&self.words, true);
        if names.is_empty() && self.color_index.is_empty() {
            return Err(Failure::usage("nothing to rename", "give OLD=NEW, or --colour-index"));
        }
        let chosen = chosen(path.as_deref(), console)?;
        let output = Output::open(&self.output, &chosen.inputs())?;
        let file = chosen.name();
        let before = chosen.library;
        let indexed = with_color_indices(&file, &before, &pairs(&self.color_index)?)?;
        let after = renamed(&file, &indexed, &pairs(names)?)?;
        output.write(after.to_json(), console)?;
        for (old, new) in before.pigments.iter().zip(&after.pigments) {
            if old.name != new.name {
                console.line(format!("{} is now {}", old.name, new.name))?;
            }
            if old.color_index != new.color_index {
                let index = new.color_index.as_deref().unwrap_or("without a Colour Index name");
                console.line(format!("{} is {index}", new.name))?;
            }
        }
        Ok(())
    }
}

/// Parses texts `NAME=CHANGE`.
fn pairs(texts: &[String]) -> Result<Vec<(String, String)>> {
    let pairs = texts.iter().map(|text| {
        let parts = text.split_once('=').filter(|(name, _)| !name.trim().is_empty());
        let (name, value) = parts.ok_or_else(|| {
            Failure::usage(
                format!("a change takes NAME=CHANGE, found `{text}`"),
                "try \"Viridian=Viridian (batch 2)\"",
            )
        })?;
        Ok((name.to_owned(), value.to_owned()))
    });
    pairs.collect()
}

/// Keep some pigments of a library; their K and S do not change
///
/// The reference white must be among them. --white chooses another, and all K and S are then
/// divided by its S. Only the summary of the evidence is kept, marked as that of the whole fit.
#[derive(Debug, Args)]
#[command(
    override_usage = "impasto library subset [OPTIONS] --output <FILE> [LIBRARY] [PIGMENT]..."
)]
pub(super) struct Subset {
    /// The pigment library (JSON) [default: the one in IMPASTO_LIBRARY, else
    /// the Van Gogh oils that ship], then the pigments to keep; a name may be abbreviated
    /// [default: all]
    #[arg(value_name = "[LIBRARY] PIGMENT")]
    words: Vec<String>,
    /// A pigment to leave out (may be repeated)
    #[arg(long, value_name = "PIGMENT")]
    without: Vec<String>,
    /// The pigment whose S becomes 1 [default: the library's reference]
    #[arg(long, alias = "reference", value_name = "PIGMENT")]
    white: Option<String>,
    /// The library file to write (JSON)
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
}

impl Subset {
    pub(super) fn run(self, console: &mut Console<'_>) -> Result<()> {
        let (path, keep) = split(&self.words, true);
        if keep.is_empty() && self.without.is_empty() {
            return Err(Failure::usage(
                "nothing to leave out",
                "name pigments to keep, or give --without",
            ));
        }
        let chosen = chosen(path.as_deref(), console)?;
        let output = Output::open(&self.output, &chosen.inputs())?;
        let file = chosen.name();
        let mut before = chosen.library;
        if let Some(reference) = &self.white {
            before = with_reference(&file, &before, reference)?;
        }
        let after = subset(&file, &before, keep, &self.without)?;
        if after.pigments.len() < before.pigments.len() && before.evidence.is_some() {
            console.remark(
                "evidence: kept the summary of the whole fit, left out the errors of samples",
            )?;
        }
        output.write(after.to_json(), console)?;
        let names: Vec<&str> = after.pigments.iter().map(|p| p.name.as_str()).collect();
        console.line(format!("{}: {}", self.output.display(), names.join(", ")))
    }
}
