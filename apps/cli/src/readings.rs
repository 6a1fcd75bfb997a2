//! Options for measurement files (format, units, references of counts), and reading them.

use std::path::{Path, PathBuf};

use calibrate::Readings;
use calibrate::measurement::{MeasurementTable, Scale, ScaleChoice};
use clap::Args;
use clap::builder::PossibleValuesParser;

use crate::console::Console;
use crate::failure::Result;
use crate::referencing::ReferencingOptions;

/// Options for how measurement files are read.
#[derive(Debug, Clone, Default, Args)]
pub(crate) struct ReadingOptions {
    /// Readings are in percent [default: guessed from all readings of a file]
    #[arg(long, conflicts_with = "fraction")]
    percent: bool,
    /// Readings are fractions, white near 1
    #[arg(long)]
    fraction: bool,
    /// Format of the measurement files [default: found by content]
    ///
    /// csv: a column `sample` (or Name, Sample ID ..), then optionally film, backing, thickness_mm, one
    /// per pigment, then the wavelengths; commas, semicolons or tabs, or a sheet of .xlsx. cgats:
    /// CGATS.17, Argyll .ti3 and .sp, X-Rite and GretagMacbeth text. qtx: Datacolor. ocean-optics:
    /// SpectraSuite, OceanView, Jaz, .ProcSpec. jcamp-dx. avantes: AvaSoft text, .TRM, .ROH, .RFL8 and
    /// others. bruker: OPUS .dpt. columns: wavelength, then one or more spectra. cxf: CxF3. tm27: IES
    /// TM-27 .spdx. sekonic: SpectroMaster CSV. asd: FieldSpec .asd or text. sed: Spectral Evolution.
    /// svc: Spectra Vista .sig. uprtek: UPRtek or LI-180. xlsx: columns in a workbook; FILE.xlsx#SHEET
    /// names the sheet.
    #[arg(long, value_name = "NAME", value_parser = format_names(), hide_possible_values = true)]
    format: Option<String>,
    /// Read values that an instrument's file calls transmittance as reflectance
    ///
    /// For spectrometers whose program measured in transmission mode over a white tile. Counts and
    /// the power of lamps are never read as reflectance.
    #[arg(long)]
    as_reflectance: bool,
    #[command(flatten)]
    referencing: ReferencingOptions,
}

fn format_names() -> PossibleValuesParser {
    PossibleValuesParser::new(calibrate::ReadingFormat::names())
}

impl ReadingOptions {
    /// Paths of the reference files, which are read in addition to the measurements.
    pub(crate) fn files(&self) -> Vec<PathBuf> {
        self.referencing.files()
    }

    /// The options with a white reading, for verbs that also take it by another option.
    pub(crate) fn with_white_reading(&self, white: Option<String>) -> Self {
        Self { referencing: self.referencing.with_white_reading(white), ..self.clone() }
    }

    fn options(&self) -> Result<calibrate::ReadingOptions> {
        self.referencing.check()?;
        Ok(calibrate::ReadingOptions {
            format: self.format.as_deref().and_then(calibrate::ReadingFormat::named),
            scale: match (self.percent, self.fraction) {
                (true, _) => ScaleChoice::Known(Scale::Percent),
                (_, true) => ScaleChoice::Known(Scale::Fraction),
                _ => ScaleChoice::ByFile,
            },
            pigments: None,
            transmittance_is_reflectance: self.as_reflectance,
            references: self.referencing.reference_files(),
        })
    }
}

/// Reads measurement files and, if given, a separate file of recipes. If `pigments` are named, no other
/// columns are pigments. Prints remarks on the files.
pub(crate) fn measurements(
    paths: &[PathBuf],
    recipes: Option<&Path>,
    pigments: &[String],
    options: &ReadingOptions,
    console: &mut Console<'_>,
) -> Result<Readings> {
    remark_repeated(paths, console)?;
    let named = (!pigments.is_empty()).then(|| pigments.to_vec());
    let options = calibrate::ReadingOptions { pigments: named, ..options.options()? };
    let mut readings = Readings::open_all(paths, &options)?;
    if let Some(recipes) = recipes {
        readings = readings.with_recipes_of(recipes, options.pigments.as_deref())?;
    }
    readings.check_has_pigments(pigments)?;
    console.remarks(&readings.remarks)?;
    Ok(readings)
}

/// Reads only the spectra of measurement files, not their recipes. Prints remarks on them.
pub(crate) fn spectra(
    paths: &[PathBuf],
    options: &ReadingOptions,
    console: &mut Console<'_>,
) -> Result<MeasurementTable> {
    remark_repeated(paths, console)?;
    let readings = Readings::open_spectra(paths, &options.options()?)?;
    console.remarks(&readings.remarks)?;
    Ok(readings.table)
}

/// Warns of files that are named twice, whose readings count twice.
pub(crate) fn remark_repeated(paths: &[PathBuf], console: &mut Console<'_>) -> Result<()> {
    let whole = |path: &PathBuf| path.canonicalize().unwrap_or_else(|_| path.clone());
    let all: Vec<PathBuf> = paths.iter().map(whole).collect();
    for (index, path) in paths.iter().enumerate() {
        if all[..index].contains(&all[index]) {
            console.warnings(&[format!("{}: this file is named twice", path.display())])?;
        }
    }
    Ok(())
}
