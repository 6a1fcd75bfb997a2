//! Reading a file of any format.

use super::error::InstrumentError;
use super::format::Format;
use super::measured::MeasuredSpectrum;
use super::text::decode_text;
use super::{avantes, bruker, cgats, columns, cxf, jcamp, ocean_optics, qtx, sekonic, tm27};

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
/// [`InstrumentError`] with the line.
pub fn read(
    file: &str,
    bytes: &[u8],
    format: Option<Format>,
) -> Result<InstrumentFile, InstrumentError> {
    let (text, _) = decode_text(bytes);
    let format = format
        .or_else(|| Format::detect(file, &text))
        .ok_or_else(|| InstrumentError::Unrecognised { file: file.to_owned() })?;
    let spectra = match format {
        Format::Cgats => cgats::read(file, &text),
        Format::Jcamp => jcamp::read(file, &text),
        Format::Qtx => qtx::read(file, &text),
        Format::OceanOptics => ocean_optics::read(file, &text),
        Format::Avantes => avantes::read(file, &text),
        Format::Bruker => bruker::read(file, &text),
        Format::Columns => columns::read(file, &text),
        Format::Cxf => cxf::read(file, &text),
        Format::Tm27 => tm27::read(file, &text),
        Format::Sekonic => sekonic::read(file, &text),
    }?;
    if spectra.is_empty() {
        return Err(InstrumentError::Empty { file: file.to_owned(), format: format.title() });
    }
    Ok(InstrumentFile { format, spectra })
}
