//! Options for measurement files (format, units, references of counts), and reading them. This file
//! also holds what several verbs share: light, observer and pigment library, the white, dark and
//! tile that convert the counts of a spectrometer to reflectance, spectra that you name as `FILE`
//! or `FILE#NAME`, target colours (for example `#rrggbb`, CIELAB, or measured spectra), and prices.

use std::path::{Path, PathBuf};

use calibrate::Readings;
use calibrate::evaluate::Viewing;
use calibrate::library::PigmentLibrary;
use calibrate::matching::{ColorTarget, PriceList, ViewingCondition, parse_price};
use calibrate::measurement::{
    AveragedSpectra, AveragedSpectrum, Film, MeasurementTable, Scale, ScaleChoice,
};
use calibrate::visible_band::check_visible_band;
use clap::builder::PossibleValuesParser;
use clap::{Arg, Args};
use documents::counted_as;
use documents::file::is_there;

use crate::console::Console;
use crate::failure::{Failure, Result};
use crate::request_options::{CommandLine, RequestOptions};
use spectra::color::{Adaptation, Rgb, RgbSpace, Xyz};
use spectra::instrument::split_file_and_name;
use spectra::referencing::{DarkFiles, ReferenceFiles, TileSource};
use spectra::{Grid, Observer, Reflectance, Spectrum, ViewingNames, light_from_text};

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
    /// svc: Spectra Vista .sig. uprtek: UPRtek or LI-180. envi: a spectral library, .hdr
    /// or .sli with the other beside it. xlsx: columns in a workbook; FILE.xlsx#SHEET
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

    /// The options with `white` as white reading, unless they name one. For verbs that also take it by
    /// another option.
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

/// Warns of files that you name twice, since we then count their readings twice.
pub(crate) fn remark_repeated(paths: &[PathBuf], console: &mut Console<'_>) -> Result<()> {
    let all: Vec<PathBuf> =
        paths.iter().map(|path| path.canonicalize().unwrap_or_else(|_| path.clone())).collect();
    for (index, path) in paths.iter().enumerate() {
        if all[..index].contains(&all[index]) {
            console.warnings(&[format!("{}: this file is named twice", path.display())])?;
        }
    }
    Ok(())
}

/// Options for the light and the observer.
pub(crate) type ViewingOptions = RequestOptions<ViewingNames>;

impl CommandLine for ViewingNames {
    fn adapted(key: &str, option: Arg) -> Arg {
        option.value_name(if key == "illuminant" { "LIGHT" } else { "NAME" })
    }
}

impl ViewingOptions {
    pub(crate) fn viewing(&self) -> Result<Viewing> {
        let ViewingNames { illuminant, observer } = self.request()?;
        viewing(&illuminant, &observer)
    }
}

/// Reads the light and looks up the observer that the texts of two options name.
pub(crate) fn viewing(illuminant: &str, observer: &str) -> Result<Viewing> {
    Ok(Viewing { illuminant: light_from_text(illuminant)?, observer: Observer::named(observer)? })
}

/// Reads a light with its weight among several, `LIGHT` or `LIGHT=WEIGHT`.
pub(crate) fn condition(text: &str, observer: &str) -> Result<ViewingCondition> {
    let weighted = text.rsplit_once('=').and_then(|(light, weight)| {
        let weight: f64 = weight.parse().ok()?;
        Some((light, weight))
    });
    let (light, weight) = weighted.unwrap_or((text, 1.0));
    Ok(ViewingCondition { viewing: viewing(light, observer)?, weight })
}

/// Converts a colour to encoded sRGB, adapted from `white` by Bradford's transform.
pub(crate) fn srgb(xyz: Xyz, white: Xyz) -> Rgb {
    RgbSpace::Srgb.encoded_from_xyz(xyz, white, Adaptation::Bradford)
}

/// Warns if `grid` covers only a part of the visible band. Without any visible wavelength this
/// fails.
pub(crate) fn remark_coverage(grid: Grid, console: &mut Console<'_>) -> Result<()> {
    console.remarks(&check_visible_band(grid)?)
}

/// Reads a pigment library from a file.
pub(crate) fn library(path: &Path) -> Result<PigmentLibrary> {
    Ok(PigmentLibrary::open(path)?)
}

/// References that convert counts to reflectance.
#[derive(Debug, Clone, Default, Args)]
pub(crate) struct ReferencingOptions {
    /// White reading, FILE or FILE#NAME, for measurement files that hold counts
    ///
    /// Reflectance = tile x (sample - dark) / (white - dark), sample and white each divided by their
    /// integration time where the files state it. Saturated counts or too little light from 380 to
    /// 730 nm are an error; outside this range such wavelengths are left out.
    #[arg(long, value_name = "FILE")]
    white_reading: Option<String>,
    /// Dark reading of sample and white, FILE or FILE#NAME; 0 if subtracted already
    ///
    /// Dark counts are not scaled by time: if sample and white have different integration times,
    /// give a dark reading for each.
    #[arg(long, alias = "dark", value_name = "FILE")]
    dark_reading: Vec<String>,
    /// Reflectance of the white itself: FILE, FILE#NAME or a fraction [default: 1]
    #[arg(long, value_name = "FILE|0.99")]
    tile: Option<String>,
    /// Largest count of the detector, such as 65535 [default: guessed]
    ///
    /// Guessed from a maximum of 4095, 16383 or 65535, or from neighbouring values that share the
    /// maximum.
    #[arg(long, value_name = "COUNT")]
    full_scale: Option<f64>,
    /// Least signal of the white at every wavelength, as a fraction of its peak [default: 0.01]
    #[arg(long, value_name = "SHARE")]
    least_light: Option<f64>,
}

impl ReferencingOptions {
    /// The options with `white` as white reading, unless they name one. For verbs that also take it by
    /// another option.
    pub(crate) fn with_white_reading(&self, white: Option<String>) -> Self {
        Self { white_reading: self.white_reading.clone().or(white), ..self.clone() }
    }

    /// Refuses options that need a white reading if there is none.
    pub(crate) fn check(&self) -> Result<()> {
        let present = [
            ("--dark-reading", !self.dark_reading.is_empty()),
            ("--tile", self.tile.is_some()),
            ("--full-scale", self.full_scale.is_some()),
            ("--least-light", self.least_light.is_some()),
        ];
        match present.into_iter().find(|(_, present)| *present && self.white_reading.is_none()) {
            None => Ok(()),
            Some((option, _)) => Err(Failure::usage(
                format!("{option} needs the white reading of the same counts"),
                "add --white-reading FILE",
            )),
        }
    }

    /// Paths of all reference files.
    pub(crate) fn files(&self) -> Vec<PathBuf> {
        self.reference_files().map_or_else(Vec::new, |files| files.paths())
    }

    /// Reference files for `calibrate` to open. `None` without a white reading.
    pub(crate) fn reference_files(&self) -> Option<ReferenceFiles> {
        let mut files = ReferenceFiles::new(self.white_reading.as_ref()?);
        files.dark = match self.dark_reading.as_slice() {
            [zero] if zero == "0" => DarkFiles::Subtracted,
            darks => DarkFiles::Files(darks.to_vec()),
        };
        if let Some(tile) = &self.tile {
            let fraction = tile.parse().map(TileSource::Fraction);
            files.tile = fraction.unwrap_or_else(|_| TileSource::File(tile.clone()));
        }
        files.full_scale = self.full_scale;
        files.least_light = self.least_light.unwrap_or(files.least_light);
        Some(files)
    }
}

/// Spectra of one file.
pub(crate) struct SelectedSpectra {
    /// Path of the file.
    pub(crate) file: String,
    /// One or more spectra, in the order of the file.
    pub(crate) averaged: AveragedSpectra,
}

/// Reads the spectra that `text` selects: all of `FILE`, or those of `FILE#NAME`. Returns `None` if
/// there is no such file.
pub(crate) fn select_spectra(
    text: &str,
    reading: &ReadingOptions,
    console: &mut Console<'_>,
) -> Result<Option<SelectedSpectra>> {
    let (file, name) = split_file_and_name(text);
    if !is_there(Path::new(file)) {
        return Ok(None);
    }
    let mut averaged = spectra(&[PathBuf::from(file)], reading, console)?.averaged();
    if let Some(name) = name {
        averaged.spectra = averaged.find(name)?.into_iter().cloned().collect();
    }
    Ok(Some(SelectedSpectra { file: file.to_owned(), averaged }))
}

/// Parses a target: one colour as `#rrggbb` or `L,a,b`, or the spectra of `FILE` or `FILE#SAMPLE`.
pub(crate) fn targets(
    text: &str,
    reading: &ReadingOptions,
    console: &mut Console<'_>,
) -> Result<Vec<ColorTarget>> {
    if let Some(selected) = select_spectra(text, reading, console)? {
        return measured(selected, console);
    }
    let target = text.parse().map_err(|_| {
        Failure::usage(
            format!("a target takes #rrggbb, L,a,b or an existing file of spectra, found `{text}`"),
            "try \"#4a7d8c\", 52,-10.5,8 or swatches.csv#NAME",
        )
    })?;
    Ok(vec![target])
}

/// Makes targets of the spectra of paint in `selected`. Spectra of bare cards are skipped unless
/// nothing else was selected.
fn measured(selected: SelectedSpectra, console: &mut Console<'_>) -> Result<Vec<ColorTarget>> {
    let SelectedSpectra { file, averaged: AveragedSpectra { grid, mut spectra } } = selected;
    remark_coverage(grid, console)?;
    let count = spectra.len();
    if spectra.iter().any(|spectrum| spectrum.film == Film::Paint) {
        spectra.retain(|spectrum| spectrum.film == Film::Paint);
    }
    if spectra.len() < count {
        let bare = count - spectra.len();
        console.remark(format!(
            "{file}: skipped {} only if selected by name",
            counted_as(bare, "bare card, which is a target", "bare cards, which are targets")
        ))?;
    }
    spectra
        .into_iter()
        .map(|spectrum: AveragedSpectrum| {
            let reflectance = Spectrum::<Reflectance>::new(grid, spectrum.reflectance)?;
            Ok(ColorTarget::measured(spectrum.name, reflectance))
        })
        .collect()
}

/// Reads prices from texts `NAME=PRICE` and from CSV files with the columns `pigment` and `price`.
pub(crate) fn prices(texts: &[String]) -> Result<PriceList> {
    let mut prices = PriceList::default();
    for text in texts {
        if is_there(Path::new(text)) {
            prices.add_file(text)?;
            continue;
        }
        let (name, price) = text.rsplit_once('=').ok_or_else(|| {
            Failure::usage(
                format!("--cost takes NAME=PRICE or an existing CSV file, found `{text}`"),
                "try --cost \"Cobalt Blue=0.9\" or --cost prices.csv",
            )
        })?;
        prices.set(name, parse_price(price, text)?)?;
    }
    Ok(prices)
}
