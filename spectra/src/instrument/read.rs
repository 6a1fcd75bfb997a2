//! Reading a file of any format.

use super::content_kind::ContentKind;
use super::error::InstrumentError;
use super::file_text::FileText;
use super::format::Format;
use super::measured::MeasuredSpectrum;
use super::{asd, avantes, avasoft7, avasoft8, bruker, cgats, columns, cxf, jcamp, ocean_optics};
use super::{procspec, qtx, sekonic, spectral_evolution, svc, tm27, uprtek};

/// The content of an instrument's file.
#[derive(Debug, Clone, PartialEq)]
pub struct InstrumentFile {
    /// Format as which the file was read.
    pub format: Format,
    /// The spectra in the order of the file; at least one.
    pub spectra: Vec<MeasuredSpectrum>,
}

/// Reads the spectra in `bytes`, the content of `file`, in the given format or in the one
/// detected.
///
/// # Errors
/// [`InstrumentError`] with the line, or with the place in a binary file.
pub fn read(
    file: &str,
    bytes: &[u8],
    format: Option<Format>,
) -> Result<InstrumentFile, InstrumentError> {
    let Some(text) = FileText::of(file, bytes)? else { return read_binary(file, bytes, format) };
    let told = format.filter(|format| *format != Format::Workbook);
    let found = told
        .or_else(|| Format::detect(&text.file, &text.text))
        .ok_or_else(|| InstrumentError::Unrecognised { file: text.file.clone() })?;
    let file = text.file.as_str();
    let spectra = match found {
        Format::Cgats => cgats::read(file, &text.text),
        Format::Jcamp => jcamp::read(file, &text.text),
        Format::Qtx => qtx::read(file, &text.text),
        Format::OceanOptics => ocean_optics::read(file, &text.text),
        Format::Avantes => avantes::read(file, &text.text),
        Format::Bruker => bruker::read(file, &text.text),
        Format::Columns | Format::Workbook => columns::read(file, &text.text),
        Format::Cxf => cxf::read(file, &text.text),
        Format::Tm27 => tm27::read(file, &text.text),
        Format::Sekonic => sekonic::read(file, &text.text),
        Format::Asd => asd::read_text(file, &text.text),
        Format::SpectralEvolution => spectral_evolution::read(file, &text.text),
        Format::Svc => svc::read(file, &text.text),
        Format::Uprtek => uprtek::read(file, &text.text),
    }?;
    let format = if text.is_sheet && told.is_none() { Format::Workbook } else { found };
    let mut found = checked(file, format, spectra)?;
    for spectrum in &mut found.spectra {
        spectrum.remarks.extend(text.remark.clone());
    }
    Ok(found)
}

/// Reads a binary file, in which `format` must be its own if it is given.
fn read_binary(
    file: &str,
    bytes: &[u8],
    format: Option<Format>,
) -> Result<InstrumentFile, InstrumentError> {
    let own = match ContentKind::of(file, bytes)? {
        ContentKind::Asd => Format::Asd,
        ContentKind::ProcSpec => Format::OceanOptics,
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
        ContentKind::Asd => asd::read_binary(file, bytes),
        ContentKind::ProcSpec => procspec::read(file, bytes),
        ContentKind::AvaSoft7 => avasoft7::read(file, bytes),
        ContentKind::AvaSoft8 => avasoft8::read(file, bytes),
        ContentKind::Text | ContentKind::Workbook => Ok(Vec::new()),
    }?;
    checked(file, own, spectra)
}

fn checked(
    file: &str,
    format: Format,
    spectra: Vec<MeasuredSpectrum>,
) -> Result<InstrumentFile, InstrumentError> {
    if spectra.is_empty() {
        return Err(InstrumentError::Empty { file: file.to_owned(), format: format.title() });
    }
    Ok(InstrumentFile { format, spectra })
}
