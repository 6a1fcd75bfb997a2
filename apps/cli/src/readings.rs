//! Options for measurement files (format, units, references of counts), and reading them. This file
//! also holds what several verbs share: light, observer and pigment library, the white, dark and
//! tile that convert the counts of a spectrometer to reflectance, spectra that you name as `FILE`
//! or `FILE#NAME`, target colours (for example `#rrggbb`, CIELAB, or measured spectra), and prices.

use std::path::{Path, PathBuf};

use calibrate::Readings;
use calibrate::evaluate::Viewing;
use calibrate::library::PigmentLibrary;
use calibrate::matching::{ColorTarget, PriceList, TargetBook, ViewingCondition, parse_price};
use calibrate::measurement::{
    AveragedSpectra, AveragedSpectrum, Film, MeasurementTable, Scale, ScaleChoice,
};
use calibrate::visible_band::{check_has_color, check_visible_band};
use clap::builder::PossibleValuesParser;
use clap::{Arg, Args};
use documents::counted_as;
use documents::file::{is_there, looks_like_path, read};

use crate::console::Console;
use crate::failure::{Failure, Result};
use crate::request_options::{CommandLine, RequestOptions};
use spectra::color::{Adaptation, Rgb, RgbSpace, Xyz};
use spectra::instrument::{FileOptions, StatedValues, split_file_and_name};
use spectra::referencing::{DarkFiles, ReferenceFiles, TileSource};
use spectra::{
    Grid, Illuminant, Observer, Reflectance, Spectrum, ViewingNames, WavelengthList,
    light_from_text_with,
};

/// Heading of the options for measurement files.
const FILES: &str = "Files of instruments";

/// Options for how measurement files are read.
#[derive(Debug, Clone, Default, Args)]
#[command(next_help_heading = FILES)]
pub(crate) struct ReadingOptions {
    /// Readings are in percent [default: guessed]
    ///
    /// Guessed from all readings of a file.
    #[arg(long, conflicts_with = "fraction")]
    percent: bool,
    /// Readings are fractions, white near 1
    #[arg(long)]
    fraction: bool,
    /// Format of the files [default: by content]
    ///
    /// csv: a column `sample` (or Name, Sample ID ..), then optionally film, backing, thickness_mm, one
    /// per pigment, then the wavelengths; commas, semicolons or tabs, or a sheet of .xlsx. cgats:
    /// CGATS.17, Argyll .ti3 and .sp, X-Rite and GretagMacbeth text. qtx: Datacolor. ocean-optics:
    /// SpectraSuite, OceanView, Jaz, .ProcSpec. jcamp-dx. avantes: AvaSoft text, .TRM, .ROH, .RFL8 and
    /// others. bruker: OPUS .dpt. columns: wavelength, then one or more spectra, or one row a reading
    /// with wavelength, value and name. cxf: CxF3. tm27: IES TM-27 .spdx. sekonic: SpectroMaster CSV.
    /// asd: FieldSpec .asd or text. sed: Spectral Evolution. svc: Spectra Vista .sig. uprtek: UPRtek or
    /// LI-180. envi: a spectral library, .hdr or .sli with the other beside it. xlsx: columns in a
    /// workbook; FILE.xlsx#SHEET names the sheet.
    #[arg(long, value_name = "NAME", value_parser = format_names(), hide_possible_values = true)]
    format: Option<String>,
    /// Read transmittance as reflectance
    ///
    /// Takes values that an instrument's file calls transmittance. For spectrometers whose program measured in transmission mode over a white tile. Counts and
    /// the power of lamps are never read as reflectance.
    #[arg(long)]
    as_reflectance: bool,
    #[command(flatten)]
    known: KnownOptions,
    #[command(flatten)]
    referencing: ReferencingOptions,
}

/// Options that tell what a file does not say, or says wrongly.
#[derive(Debug, Clone, Default, Args)]
pub(crate) struct KnownOptions {
    /// Quantity of the values, where headings mislead: reflectance, percent, fraction, absorbance, k/s,
    /// counts, power or photons
    ///
    /// We turn absorbance A into the reflectance 10^-A, and K/S into the reflectance of a film that hides its
    /// ground. For lamps, we divide numbers of photons by the wavelength.
    #[arg(long, value_name = "QUANTITY", value_parser = quantity_names(), hide_possible_values = true, ignore_case = true)]
    values: Option<String>,
    /// Wavelengths of files that hold values only: a file of them, or FIRST..LAST:STEP in nm
    ///
    /// For lines `name<tab>36 values`, a title above one column of values (USGS), or one list of numbers.
    #[arg(long, value_name = "FILE|380..730:10")]
    wavelengths: Option<String>,
}

impl KnownOptions {
    /// Prints a remark if wavelengths are guessed to be in micrometres.
    pub(crate) fn options(&self, console: &mut Console<'_>) -> Result<FileOptions> {
        let list = self.wavelengths.as_deref().map(WavelengthList::named).transpose()?;
        if let Some(WavelengthList { factor, remark: Some(remark), .. }) = &list
            && *factor != 1.0
        {
            console.remark(remark)?;
        }
        Ok(FileOptions {
            format: None,
            values: self.values.as_deref().and_then(StatedValues::named),
            wavelengths_nm: list.map(|list| list.nm),
        })
    }
}

fn quantity_names() -> PossibleValuesParser {
    PossibleValuesParser::new(StatedValues::ALL.map(StatedValues::name))
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

    fn options(&self, console: &mut Console<'_>) -> Result<calibrate::ReadingOptions> {
        self.referencing.check()?;
        let FileOptions { values, wavelengths_nm, .. } = self.known.options(console)?;
        Ok(calibrate::ReadingOptions {
            format: self.format.as_deref().and_then(calibrate::ReadingFormat::named),
            scale: match (self.percent, self.fraction) {
                (true, _) => ScaleChoice::Known(Scale::Percent),
                (_, true) => ScaleChoice::Known(Scale::Fraction),
                _ => ScaleChoice::ByFile,
            },
            pigments: None,
            transmittance_is_reflectance: self.as_reflectance,
            values,
            wavelengths_nm,
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
    let options = calibrate::ReadingOptions { pigments: named, ..options.options(console)? };
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
    Ok(spectra_readings(paths, options, console)?.table)
}

/// Reads the spectra of measurement files with films, backings and thicknesses, but without recipes. Prints
/// remarks on them.
pub(crate) fn spectra_readings(
    paths: &[PathBuf],
    options: &ReadingOptions,
    console: &mut Console<'_>,
) -> Result<Readings> {
    remark_repeated(paths, console)?;
    let readings = Readings::open_spectra(paths, &options.options(console)?)?;
    console.remarks(&readings.remarks)?;
    Ok(readings)
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
    pub(crate) fn viewing(&self, console: &mut Console<'_>) -> Result<Viewing> {
        let ViewingNames { illuminant, observer } = self.request()?;
        viewing(&illuminant, &observer, console)
    }
}

/// Reads the light and looks up the observer that the texts of two options name.
pub(crate) fn viewing(
    illuminant: &str,
    observer: &str,
    console: &mut Console<'_>,
) -> Result<Viewing> {
    let known = FileOptions::default();
    Ok(Viewing {
        illuminant: light(illuminant, &known, console)?,
        observer: Observer::named(observer)?,
    })
}

/// Reads the light that `text` names, and prints remarks on the file of a lamp.
pub(crate) fn light(
    text: &str,
    known: &FileOptions,
    console: &mut Console<'_>,
) -> Result<Illuminant> {
    let light = light_from_text_with(text, known)?;
    for remark in light.remarks() {
        console.remark(remark)?;
    }
    Ok(light)
}

/// Reads a light with its weight among several, `LIGHT` or `LIGHT=WEIGHT`.
pub(crate) fn condition(
    text: &str,
    observer: &str,
    console: &mut Console<'_>,
) -> Result<ViewingCondition> {
    let weighted = text.rsplit_once('=').and_then(|(light, weight)| {
        let weight: f64 = weight.parse().ok()?;
        Some((light, weight))
    });
    let (light, weight) = weighted.unwrap_or((text, 1.0));
    Ok(ViewingCondition { viewing: viewing(light, observer, console)?, weight })
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

/// Warns if measurements on `grid` lack a part of the visible band. If they lack more than a quarter, this
/// fails.
pub(crate) fn remark_color(grid: Grid, console: &mut Console<'_>) -> Result<()> {
    console.remarks(&check_has_color(grid)?)
}

/// Reads a pigment library from a file.
pub(crate) fn library(path: &Path) -> Result<PigmentLibrary> {
    Ok(PigmentLibrary::open(path)?)
}

/// References that convert counts to reflectance.
#[derive(Debug, Clone, Default, Args)]
#[command(next_help_heading = FILES)]
pub(crate) struct ReferencingOptions {
    /// White reading for counts, FILE or FILE#NAME
    ///
    /// For measurement files that hold the counts of a detector.
    ///
    /// Reflectance = tile x (sample - dark) / (white - dark), sample and white each divided by their
    /// integration time where the files state it. Saturated counts or too little light from 380 to
    /// 730 nm are an error; outside this range such wavelengths are left out.
    #[arg(long, value_name = "FILE")]
    white_reading: Option<String>,
    /// Dark reading, FILE or FILE#NAME, or 0
    ///
    /// Dark reading of sample and white, 0 if it is subtracted already. Dark counts are not scaled by time: if sample and white have different integration times,
    /// give a dark reading for each.
    #[arg(long, alias = "dark", value_name = "FILE")]
    dark_reading: Vec<String>,
    /// Reflectance of the white [default: 1]
    ///
    /// FILE, FILE#NAME or a fraction.
    #[arg(long, value_name = "FILE|0.99")]
    tile: Option<String>,
    /// Largest count, such as 65535 [default: guessed]
    ///
    /// Largest count of the detector. Guessed from a maximum of 4095, 16383 or 65535, or from neighbouring values that share the
    /// maximum.
    #[arg(long, value_name = "COUNT", hide_short_help = true)]
    full_scale: Option<f64>,
    /// Least signal of the white at every wavelength, as a fraction of its peak [default: 0.01]
    #[arg(long, value_name = "SHARE", hide_short_help = true)]
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

/// Options for target colours.
#[derive(Debug, Clone, Default, Args)]
pub(crate) struct TargetOptions {
    /// Light of a table of target colours (L, a, b or X, Y, Z), LIGHT or LIGHT/OBSERVER, such as D50/2
    /// [default: the one that its headings name, else D65/2]
    #[arg(long, value_name = "LIGHT")]
    target_light: Option<String>,
}

/// Reads the light and, if it is named, the observer of `LIGHT` or `LIGHT/OBSERVER`.
fn light_and_observer(text: &str) -> Result<Viewing> {
    let pair = text.rsplit_once('/').and_then(|(light, observer)| {
        let observer = Observer::named(observer).ok()?;
        Some((light, observer))
    });
    let (light, observer) = pair.unwrap_or((text, Observer::default()));
    Ok(Viewing { illuminant: light_from_text_with(light, &FileOptions::default())?, observer })
}

/// Parses a target: one colour as `#rrggbb` or `L,a,b`, or the named colours or spectra of `FILE` or
/// `FILE#NAME`.
pub(crate) fn targets(
    text: &str,
    options: &TargetOptions,
    reading: &ReadingOptions,
    console: &mut Console<'_>,
) -> Result<Vec<ColorTarget>> {
    let (file, name) = split_file_and_name(text);
    let path = Path::new(file);
    let light = options.target_light.as_deref().map(light_and_observer).transpose()?;
    if is_there(path)
        && let Some(book) = TargetBook::read(file, &read(path)?, name, light.as_ref())?
    {
        console.remarks(&book.remarks)?;
        return Ok(book.targets);
    }
    if let Some(selected) = select_spectra(text, reading, console)? {
        return measured(selected, console);
    }
    if let Ok(target) = text.parse() {
        return Ok(vec![target]);
    }
    if looks_like_path(text) {
        read(path)?;
    }
    Err(Failure::usage(
        format!("a target takes #rrggbb, L,a,b or a file of colours or spectra, found `{text}`"),
        "try \"#4a7d8c\", 52,-10.5,8, swatches.csv#NAME or book.ase",
    ))
}

/// Makes targets of the spectra of paint in `selected`. Spectra of bare cards are skipped unless
/// nothing else was selected.
fn measured(selected: SelectedSpectra, console: &mut Console<'_>) -> Result<Vec<ColorTarget>> {
    let SelectedSpectra { file, averaged: AveragedSpectra { grid, mut spectra } } = selected;
    remark_color(grid, console)?;
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
        if is_there(Path::new(text)) || !text.contains('=') && looks_like_path(text) {
            prices.add_file(text)?;
            continue;
        }
        let (name, price) = text.rsplit_once('=').ok_or_else(|| {
            Failure::usage(
                format!("--cost takes NAME=PRICE or a CSV file, found `{text}`"),
                "try --cost \"Cobalt Blue=0.9\" or --cost prices.csv",
            )
        })?;
        prices.set(name, parse_price(price, text)?)?;
    }
    Ok(prices)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_light_may_name_its_observer() {
        let names = |text: &str| {
            let viewing = light_and_observer(text).unwrap();
            (viewing.illuminant.name().to_owned(), viewing.observer.name())
        };
        assert_eq!(names("D50"), ("D50".to_owned(), "1931-2"));
        assert_eq!(names("D65/10"), ("D65".to_owned(), "1964-10"));
        assert!(light_and_observer("D64/2x").is_err());
    }
}
