//! Reading an instrument's file of any format, from bytes or by path.

use std::path::Path;

use documents::file::{self, FileError};
use documents::hint::Explain;
use documents::{from_spreadsheet_cell, name_violation, plain_name};

use super::format::{ContentKind, FileText, Format};
use super::measured::{
    ChoiceError, InstrumentError, MeasuredSpectrum, choose_spectrum, split_file_and_name,
};
use super::stated::{StatedValues, bare_values};
use super::{
    avantes, cgats, columns, cxf, envi_library, field_spectrometers, jcamp, light_meters,
    long_table, ocean_optics, qtx,
};

/// The content of an instrument's file.
#[derive(Debug, Clone, PartialEq)]
pub struct InstrumentFile {
    /// Format in which the file was read.
    pub format: Format,
    /// The spectra in the order of the file, at least one.
    pub spectra: Vec<MeasuredSpectrum>,
}

/// Facts that you know about files and that they do not say, or say wrongly. The defaults read every file
/// as it describes itself.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct FileOptions {
    /// The format. Default: detected from the content.
    pub format: Option<Format>,
    /// The quantity of the values. Default: what the file states.
    pub values: Option<StatedValues>,
    /// Wavelengths in nm of values that stand without theirs. Each occurs once.
    pub wavelengths_nm: Option<Vec<f64>>,
}

/// Reads the spectra in `bytes`, the content of `file`. If you pass no format, this detects it.
pub fn read(
    file: &str,
    bytes: &[u8],
    format: Option<Format>,
) -> Result<InstrumentFile, InstrumentError> {
    read_with(file, bytes, &FileOptions { format, ..FileOptions::default() })
}

/// Reads the spectra in `bytes`, the content of `file`, with what you know about the file.
///
/// # Errors
/// [`InstrumentError`] with the line. Wavelengths are refused if the file states its own.
///
/// ```
/// use spectra::WavelengthList;
/// use spectra::instrument::{FileOptions, read_with};
///
/// let list = WavelengthList::named("400..600:100")?;
/// let options = FileOptions { wavelengths_nm: Some(list.nm), ..FileOptions::default() };
/// let found = read_with("red.txt", b"Red\t0.1\t0.2\t0.6\n", &options)?;
/// assert_eq!(found.spectra[0].name, "Red");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn read_with(
    file: &str,
    bytes: &[u8],
    options: &FileOptions,
) -> Result<InstrumentFile, InstrumentError> {
    let mut found = match &options.wavelengths_nm {
        Some(nm) => read_bare_values(file, bytes, options.format, nm)?,
        None => read_spectra(file, bytes, options.format)?,
    };
    if let Some(values) = options.values {
        found.spectra.iter_mut().for_each(|spectrum| values.apply(spectrum));
    }
    Ok(found)
}

/// Reads values whose wavelengths are `nm`.
fn read_bare_values(
    file: &str,
    bytes: &[u8],
    format: Option<Format>,
    nm: &[f64],
) -> Result<InstrumentFile, InstrumentError> {
    let has_wavelengths = || InstrumentError::NotRead {
        file: file.to_owned(),
        kind: "a file that states its own wavelengths",
        way: "leave out [wavelengths]",
    };
    let text = FileText::of(file, bytes)?.ok_or_else(has_wavelengths)?;
    let found = format.or_else(|| Format::detect(&text.file, &text.text));
    if found.is_some_and(|format| !matches!(format, Format::Columns | Format::Workbook)) {
        return Err(has_wavelengths());
    }
    let format = if text.is_sheet { Format::Workbook } else { Format::Columns };
    let mut found = checked(file, format, bare_values::read(&text.file, &text.text, nm)?)?;
    for spectrum in &mut found.spectra {
        spectrum.remarks.extend(text.remark.clone());
    }
    Ok(found)
}

fn read_spectra(
    file: &str,
    bytes: &[u8],
    format: Option<Format>,
) -> Result<InstrumentFile, InstrumentError> {
    let Some(text) = FileText::of(file, bytes)? else { return read_binary(file, bytes, format) };
    let stated = format.filter(|format| *format != Format::Workbook);
    let found = stated
        .or_else(|| Format::detect(&text.file, &text.text))
        .ok_or_else(|| InstrumentError::Unrecognised(text.file.clone()))?;
    let file = text.file.as_str();
    let spectra = match found {
        Format::Cgats => cgats::read(file, &text.text),
        Format::Jcamp => jcamp::read(file, &text.text),
        Format::Qtx => qtx::read(file, &text.text),
        Format::OceanOptics => ocean_optics::read_text(file, &text.text),
        Format::Avantes => avantes::read_text(file, &text.text),
        Format::Bruker => columns::read_bruker(file, &text.text),
        Format::Columns | Format::Workbook if long_table::is_long_table(&text.text) => {
            long_table::read(file, &text.text)
        }
        Format::Columns | Format::Workbook => columns::read(file, &text.text),
        Format::Cxf => cxf::read(file, &text.text),
        Format::Tm27 => light_meters::read_tm27(file, &text.text),
        Format::Sekonic => light_meters::read_sekonic(file, &text.text),
        Format::Asd => field_spectrometers::read_asd_text(file, &text.text),
        Format::SpectralEvolution => field_spectrometers::read_sed(file, &text.text),
        Format::Svc => field_spectrometers::read_sig(file, &text.text),
        Format::Uprtek => light_meters::read_uprtek(file, &text.text),
        Format::EnviLibrary => envi_library::read_header(file, &text.text),
    }?;
    let format = if text.is_sheet && stated.is_none() { Format::Workbook } else { found };
    let mut found = checked(file, format, spectra)?;
    for spectrum in &mut found.spectra {
        spectrum.remarks.extend(text.remark.clone());
    }
    Ok(found)
}

/// Reads a binary file. If you pass a `format`, it must be the file's own.
fn read_binary(
    file: &str,
    bytes: &[u8],
    format: Option<Format>,
) -> Result<InstrumentFile, InstrumentError> {
    let own = match ContentKind::of(file, bytes)? {
        ContentKind::Asd => Format::Asd,
        ContentKind::ProcSpec => Format::OceanOptics,
        ContentKind::EnviLibrary => Format::EnviLibrary,
        ContentKind::AvaSoft7 | ContentKind::AvaSoft8 => Format::Avantes,
        ContentKind::Text | ContentKind::Workbook => Format::Workbook,
    };
    if format.is_some_and(|format| format != own) {
        return Err(InstrumentError::NotRead {
            file: file.to_owned(),
            kind: "a binary file of another format",
            way: "leave out [format]",
        });
    }
    let spectra = match ContentKind::of(file, bytes)? {
        ContentKind::Asd => field_spectrometers::read_asd_binary(file, bytes),
        ContentKind::ProcSpec => ocean_optics::read_procspec(file, bytes),
        ContentKind::EnviLibrary => envi_library::read_data(file, bytes),
        ContentKind::AvaSoft7 => avantes::read_avasoft7(file, bytes),
        ContentKind::AvaSoft8 => avantes::read_avasoft8(file, bytes),
        ContentKind::Text | ContentKind::Workbook => Ok(Vec::new()),
    }?;
    checked(file, own, spectra)
}

fn checked(
    file: &str,
    format: Format,
    mut spectra: Vec<MeasuredSpectrum>,
) -> Result<InstrumentFile, InstrumentError> {
    if spectra.is_empty() {
        return Err(InstrumentError::Empty { file: file.to_owned(), format: format.title() });
    }
    for spectrum in &mut spectra {
        // Only tables come from spreadsheets. In other formats an apostrophe is part of the name.
        let name = match format {
            Format::Columns | Format::Workbook => from_spreadsheet_cell(&spectrum.name),
            _ => &spectrum.name,
        };
        let name = plain_name(name);
        if let Some(wanted) = name_violation(&name).filter(|_| !name.is_empty()) {
            return Err(InstrumentError::line(file, spectrum.line, wanted, &name));
        }
        spectrum.name = name;
    }
    Ok(InstrumentFile { format, spectra })
}

/// Bytes of the file that you name as `FILE` or `FILE.xlsx#SHEET`.
pub fn bytes_of(path: impl AsRef<Path>) -> Result<Vec<u8>, FileError> {
    let path = path.as_ref();
    let sheet = path.to_str().map(file::split_file_and_sheet).filter(|(_, sheet)| sheet.is_some());
    file::read(sheet.map_or(path, |(file, _)| Path::new(file)))
}

/// Reads all spectra of an instrument's file, or of the sheet `FILE.xlsx#SHEET`. This detects the
/// format from the content.
pub fn open(path: impl AsRef<Path>) -> Result<InstrumentFile, OpenError> {
    let path = path.as_ref();
    Ok(read(&path.display().to_string(), &bytes_of(path)?, None)?)
}

/// One spectrum of a file, with the content of that file.
#[derive(Debug, Clone, PartialEq)]
pub struct OpenedSpectrum {
    /// Path of the file as you gave it.
    pub file: String,
    /// All bytes of the file, for a checksum.
    pub bytes: Vec<u8>,
    /// The selected spectrum.
    pub spectrum: MeasuredSpectrum,
}

/// Reads one spectrum, which you name as `FILE` or `FILE#NAME`. For one sheet of a workbook write
/// `FILE.xlsx#SHEET#NAME`.
///
/// # Errors
/// [`OpenError`] if we cannot read the file, if it has no spectrum of this name, or if it has
/// several and you give no name.
pub fn open_spectrum(file_and_name: &str) -> Result<OpenedSpectrum, OpenError> {
    let (file, name) = split_file_and_name(file_and_name);
    let bytes = bytes_of(file)?;
    let found = read(file, &bytes, None)?.spectra;
    let spectrum = choose_spectrum(file, &found, name)?.clone();
    Ok(OpenedSpectrum { file: file.to_owned(), bytes, spectrum })
}

/// A file of an instrument that cannot be opened.
#[derive(Debug, Clone, PartialEq, thiserror::Error, Explain)]
pub enum OpenError {
    /// The file cannot be read from the disk.
    #[error(transparent)]
    File(#[from] FileError),
    /// The content is faulty or of no known format.
    #[error(transparent)]
    Instrument(#[from] InstrumentError),
    /// The text does not name exactly one spectrum.
    #[error(transparent)]
    Choice(#[from] ChoiceError),
}

#[cfg(test)]
mod tests {
    use super::super::{avantes, field_spectrometers, ocean_optics, workbook};
    use super::*;

    /// Name, bytes and format of a small file of every binary format.
    fn samples() -> Vec<(&'static str, Vec<u8>, Format)> {
        let counts = [100.0, 200.0, 600.0, 700.0];
        let pixels = [30.0, 110.0, 10.0, 20.0, 90.0, 10.0, 60.0, 110.0, 10.0];
        vec![
            (
                "some.asd",
                field_spectrometers::tests::asd(0, &counts, Some(&[1000.0; 4])),
                Format::Asd,
            ),
            ("some.trm", avantes::tests::avasoft7(70.0, &pixels), Format::Avantes),
            ("some.rfl8", avantes::avasoft8_tests::avasoft8(b"AVS82", 2, 4), Format::Avantes),
            ("some.ProcSpec", ocean_optics::tests::procspec("x"), Format::OceanOptics),
            (
                "some.xlsx",
                workbook::tests::workbook(&[("A", workbook::tests::ROWS)]),
                Format::Workbook,
            ),
        ]
    }

    #[test]
    fn binary_files_are_known_by_their_content_in_their_own_format_only() {
        for (file, bytes, format) in samples().into_iter().take(4) {
            let found = read(file, &bytes, None).unwrap();
            assert_eq!(found.format, format, "{file}");
            assert_eq!(read("other.txt", &bytes, Some(format)).unwrap().format, format, "{file}");
            let stated = read(file, &bytes, Some(Format::Cgats)).unwrap_err();
            assert!(matches!(stated, InstrumentError::NotRead { .. }), "{stated}");
        }
    }

    #[test]
    fn columns_in_a_workbook_are_read() {
        let heading = "<row r=\"1\"><c r=\"A1\" t=\"str\"><v>nm</v></c><c r=\"B1\" t=\"str\"><v>Reflectance</v></c></row>";
        let rows = format!(
            "{heading}{}{}{}",
            row(2, "400", "0.25"),
            row(4, "410", "0.5"),
            row(5, "420", "1")
        );
        let book = workbook::tests::workbook(&[("Data", &rows), ("Notes", heading)]);
        let found = read("a/red.xlsx", &book, None).unwrap();
        assert_eq!(
            (found.format, &found.spectra[0].values),
            (Format::Workbook, &vec![0.25, 0.5, 1.0])
        );
        assert!(found.spectra[0].remarks[0].contains("`Data` is read, not `Notes`"));
        let bad = workbook::tests::workbook(&[(
            "Data",
            &rows.replace("0.5<", "x<").replace("r=\"B4\"", "r=\"B4\" t=\"str\""),
        )]);
        let error = read("a/red.xlsx", &bad, None).unwrap_err().to_string();
        assert!(error.starts_with("a/red.xlsx, sheet `Data`, line 4: "), "{error}");
    }

    fn row(row: usize, nm: &str, value: &str) -> String {
        let nm = cell(&format!("A{row}"), nm);
        let value = cell(&format!("B{row}"), value);
        format!("<row r=\"{row}\">{nm}{value}</row>")
    }

    fn cell(name: &str, value: &str) -> String {
        format!("<c r=\"{name}\"><v>{value}</v></c>")
    }

    #[test]
    fn damaged_binary_files_never_panic_and_no_error_holds_their_bytes() {
        let mut state = 1_u64;
        let mut random = |below: usize| {
            // Multiplier of Knuth's MMIX.
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) as usize % below
        };
        for (file, bytes, _) in samples() {
            let mut damaged: Vec<Vec<u8>> =
                (0..bytes.len()).map(|end| bytes[..end].to_vec()).collect();
            for _ in 0..1500 {
                let mut copy = bytes.clone();
                for _ in 0..=random(4) {
                    let at = random(copy.len());
                    copy[at] = random(256) as u8;
                }
                copy.truncate(copy.len() - random(3) * random(copy.len()) / 4);
                damaged.push(copy);
            }
            for copy in damaged {
                if let Err(error) = read(file, &copy, None) {
                    let stated = error.to_string();
                    assert!(stated.contains(file), "{stated}");
                    assert!(stated.chars().all(|c: char| !c.is_control()), "{stated:?}");
                }
            }
        }
    }

    #[test]
    fn a_file_that_names_its_instrument_states_its_geometry() {
        let text = "CGATS.17\nORIGINATOR \"i1Pro lab\"\nINSTRUMENTATION \"i1Pro\"\n\
            NUMBER_OF_FIELDS 4\nBEGIN_DATA_FORMAT\nSAMPLE_ID SPEC_400 SPEC_500 SPEC_600\n\
            END_DATA_FORMAT\nNUMBER_OF_SETS 1\nBEGIN_DATA\nA 0.1 0.2 0.3\nEND_DATA\n";
        let of =
            |text: &str| read("f", text.as_bytes(), None).unwrap().spectra[0].stated_geometry();
        assert_eq!(of(text).unwrap().words, "i1Pro");
        // Who measured says nothing.
        assert_eq!(of(&text.replace("INSTRUMENTATION \"i1Pro\"", "DESCRIPTOR \"i1Pro\"")), None);
    }
}
