//! The file formats: their names, detection by content, and the text of a file or of a workbook's
//! sheet.
//!
//! The first bytes decide whether a file is text, a binary format that we read, or one that we
//! refuse by name.

use super::decode::{Archive, decode_text, is_utf16, is_zip, lines};
use super::measured::InstrumentError;
use super::{
    avantes, columns, envi_library, field_spectrometers, light_meters, long_table, ocean_optics,
    workbook,
};

/// A file format of measuring instruments.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// CGATS.17 and related formats: Argyll .ti3, .sp and .cie, text files of X-Rite and
    /// GretagMacbeth.
    Cgats,
    /// Datacolor QTX: text with sections in square brackets.
    Qtx,
    /// Ocean Optics: SpectraSuite, OceanView, Jaz, binary `.ProcSpec`.
    OceanOptics,
    /// JCAMP-DX, a labelled text format of spectroscopy.
    Jcamp,
    /// Avantes AvaSoft: text, or binary files, for example `.ROH`, `.TRM` and `.RFL8`.
    Avantes,
    /// Bruker OPUS data point table.
    Bruker,
    /// Columns of numbers: wavelength and one or more spectra.
    Columns,
    /// CxF3, the Color Exchange Format (XML).
    Cxf,
    /// IES TM-27, spectra of lamps (XML).
    Tm27,
    /// Sekonic SpectroMaster CSV.
    Sekonic,
    /// ASD FieldSpec: binary `.asd`, or the text converted from it.
    Asd,
    /// Spectral Evolution `.sed`.
    SpectralEvolution,
    /// Spectra Vista `.sig`.
    Svc,
    /// UPRtek's light meters and the LI-COR LI-180.
    Uprtek,
    /// ENVI spectral library: a header `.hdr` and its data `.sli`.
    EnviLibrary,
    /// Excel workbook `.xlsx`: a table or columns in one of its sheets.
    Workbook,
}

impl Format {
    /// All formats, for lists of choices.
    pub const ALL: [Self; 16] = [
        Self::Cgats,
        Self::Qtx,
        Self::OceanOptics,
        Self::Jcamp,
        Self::Avantes,
        Self::Bruker,
        Self::Columns,
        Self::Cxf,
        Self::Tm27,
        Self::Sekonic,
        Self::Asd,
        Self::SpectralEvolution,
        Self::Svc,
        Self::Uprtek,
        Self::EnviLibrary,
        Self::Workbook,
    ];

    /// Short name of the format, as a setting takes it.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Cgats => "cgats",
            Self::Qtx => "qtx",
            Self::OceanOptics => "ocean-optics",
            Self::Jcamp => "jcamp-dx",
            Self::Avantes => "avantes",
            Self::Bruker => "bruker",
            Self::Columns => "columns",
            Self::Cxf => "cxf",
            Self::Tm27 => "tm27",
            Self::Sekonic => "sekonic",
            Self::Asd => "asd",
            Self::SpectralEvolution => "sed",
            Self::Svc => "svc",
            Self::Uprtek => "uprtek",
            Self::EnviLibrary => "envi",
            Self::Workbook => "xlsx",
        }
    }

    /// Name of the format for people.
    #[must_use]
    pub fn title(self) -> &'static str {
        match self {
            Self::Cgats => "CGATS",
            Self::Qtx => "Datacolor QTX",
            Self::OceanOptics => "Ocean Optics",
            Self::Jcamp => "JCAMP-DX",
            Self::Avantes => "Avantes",
            Self::Bruker => "Bruker OPUS",
            Self::Columns => "columns of text",
            Self::Cxf => "CxF3",
            Self::Tm27 => "IES TM-27",
            Self::Sekonic => "Sekonic",
            Self::Asd => "ASD FieldSpec",
            Self::SpectralEvolution => "Spectral Evolution",
            Self::Svc => "Spectra Vista",
            Self::Uprtek => "UPRtek or LI-180",
            Self::EnviLibrary => "ENVI spectral library",
            Self::Workbook => "Excel workbook",
        }
    }

    /// The format with the given short name, ignoring case.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|format| format.name().eq_ignore_ascii_case(name))
    }

    /// Detects the format of a text file from its content. Bruker OPUS files contain only numbers
    /// and are recognised by the ending `.dpt` of `file`.
    #[must_use]
    pub fn detect(file: &str, text: &str) -> Option<Self> {
        let start = text.trim_start();
        if start.starts_with('<') {
            let head: String = text.chars().take(4000).collect::<String>().to_lowercase();

            return if head.contains("cxf") {
                Some(Self::Cxf)
            } else {
                (head.contains("iestm27") || head.contains("spectraldistribution"))
                    .then_some(Self::Tm27)
            };
        }
        if start.starts_with("##") {
            return Some(Self::Jcamp);
        } else if envi_library::is_header(text) {
            return Some(Self::EnviLibrary);
        } else if field_spectrometers::is_sig(text) {
            return Some(Self::Svc);
        } else if field_spectrometers::is_asd_text(text) {
            return Some(Self::Asd);
        }
        let mut before = "";
        for (_, line) in lines(text) {
            let line = line.trim();
            if line.starts_with("[STANDARD_DATA") || line.starts_with("[BATCH_DATA") {
                return Some(Self::Qtx);
            } else if line.starts_with(">>>>>Begin") {
                return Some(Self::OceanOptics);
            } else if line == "BEGIN_DATA_FORMAT" {
                return Some(Self::Cgats);
            } else if line.starts_with("Spectral Data ") && line.contains("[nm]") {
                return Some(Self::Sekonic);
            } else if before.starts_with("Wave") && line.starts_with("[nm]") {
                return Some(Self::Avantes);
            } else if field_spectrometers::is_heading(before, line) {
                return Some(Self::SpectralEvolution);
            }
            before = line;
        }
        if file.to_ascii_lowercase().ends_with(".dpt") {
            return Some(Self::Bruker);
        }
        if light_meters::is_uprtek(text) {
            return Some(Self::Uprtek);
        }
        let is_table = long_table::is_long_table(text) || columns::is_column_text(text);
        is_table.then_some(Self::Columns)
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ContentKind {
    Text,
    Asd,
    AvaSoft7,
    AvaSoft8,
    ProcSpec,
    EnviLibrary,
    Workbook,
}

/// First bytes of formats that we do not read, their kind, and advice on how you get a file that we
/// read.
const NOT_READ: [(&[u8], &str, &str); 13] = [
    (b"\xd0\xcf\x11\xe0", "an old Excel workbook (.xls), or one with a password", SHEET),
    (b"\x0a\x0a\xfe\xfe", "a binary file of Bruker OPUS", "save it as a data point table (.dpt)"),
    (b"Spectral Data File", "a binary file of Thermo OMNIC (.spa)", "save it as CSV or JCAMP-DX"),
    (b"PEPE", "a binary file of PerkinElmer", "save it as ASCII (.asc) or JCAMP-DX"),
    (b"%PDF", "a PDF", TEXT),
    (b"\x89PNG", "a picture", TEXT),
    (b"\xff\xd8\xff", "a picture", TEXT),
    (b"GIF8", "a picture", TEXT),
    (b"II*\0", "a picture", TEXT),
    (b"MM\0*", "a picture", TEXT),
    (b"\x1f\x8b", "a packed file (gzip)", "unpack it"),
    (b"7z\xbc\xaf", "a packed file (7z)", "unpack it"),
    (b"Rar!", "a packed file (RAR)", "unpack it"),
];

/// Endings of binary formats that we do not read and that have no fixed first bytes, in lower case.
const NOT_READ_ENDINGS: [(&str, &str, &str); 5] = [
    ("spc", "a binary file of GRAMS (.spc)", "save it as JCAMP-DX or CSV"),
    ("mes", "a file of Konica Minolta SpectraMagic NX", MINOLTA),
    ("mesx", "a file of Konica Minolta SpectraMagic DX", MINOLTA),
    ("mdl", "a file of Konica Minolta ColorManager", "export CGATS from ColorManager"),
    ("icc", "a colour profile", TEXT),
];

const TEXT: &str = "export text or CSV from the instrument's program";
const SHEET: &str = "save it as .xlsx without a password, or as CSV";
const MINOLTA: &str = "export text or CSV from SpectraMagic";

/// We look at this many first bytes to decide whether a file is binary or text.
const LOOKED_AT: usize = 4096;
/// A file with a larger share of control characters, or of zeros, is not text (chosen by eye).
const MOST_CONTROL: f64 = 0.02;
const MOST_ZEROS: f64 = 0.1;

impl ContentKind {
    /// The kind of `bytes`, the content of `file`.
    ///
    /// # Errors
    /// [`InstrumentError::NotRead`] for a binary format that we do not read,
    /// [`InstrumentError::Faulty`] for an archive that cannot be opened.
    pub(super) fn of(file: &str, bytes: &[u8]) -> Result<Self, InstrumentError> {
        if field_spectrometers::is_asd_binary(bytes) {
            return Ok(Self::Asd);
        } else if avantes::is_avasoft7(bytes) {
            return Ok(Self::AvaSoft7);
        } else if avantes::is_avasoft8(bytes) {
            return Ok(Self::AvaSoft8);
        } else if envi_library::is_data(file) {
            return Ok(Self::EnviLibrary);
        }
        let not_read = |kind, way| InstrumentError::NotRead { file: file.to_owned(), kind, way };
        if is_zip(bytes) {
            let archive = Archive::open(file, bytes)?;
            let has = |wanted: &str| archive.find(|name| name == wanted).is_some();
            return if has("xl/workbook.xml") {
                Ok(Self::Workbook)
            } else if archive.find(ocean_optics::is_spectrum).is_some() {
                Ok(Self::ProcSpec)
            } else if has("xl/workbook.bin") || has("content.xml") {
                Err(not_read("a sheet of another kind than .xlsx", SHEET))
            } else {
                Err(not_read("a zip archive without readings", "unpack it"))
            };
        }
        if let Some((_, kind, way)) = NOT_READ.iter().find(|(first, ..)| bytes.starts_with(first)) {
            return Err(not_read(kind, way));
        }
        if !is_noise(bytes) {
            return Ok(Self::Text);
        }
        let ending = file.rsplit_once('.').map_or("", |(_, ending)| ending).to_ascii_lowercase();
        let known = NOT_READ_ENDINGS.iter().find(|(known, ..)| *known == ending);
        let (kind, way) = known
            .map_or(("a binary file of no known format", TEXT), |(_, kind, way)| (*kind, *way));
        Err(not_read(kind, way))
    }
}

/// Whether bytes are not text in any encoding.
fn is_noise(bytes: &[u8]) -> bool {
    let start = &bytes[..bytes.len().min(LOOKED_AT)];
    if is_utf16(start) {
        return false;
    }
    let controls = start.iter().filter(|byte| matches!(byte, 1..=8 | 11 | 14..=26 | 28..=31 | 127));
    let zeros = start.iter().filter(|byte| **byte == 0);
    let [controls, zeros] =
        [controls.count(), zeros.count()].map(|count| count as f64 / start.len().max(1) as f64);
    controls > MOST_CONTROL || zeros > MOST_ZEROS
}

/// Text that a file holds.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FileText {
    /// Path of the file, followed by the name of the sheet if it is a workbook.
    pub file: String,
    /// The text. A sheet gives one line a row, with tabs between the cells.
    pub text: String,
    /// Name of the encoding.
    pub encoding: &'static str,
    /// Whether the text is a sheet of a workbook.
    pub is_sheet: bool,
    /// Message about sheets that we do not read.
    pub remark: Option<String>,
}

impl FileText {
    /// The text in `bytes`, the content of `file`. You get `None` for a binary file that
    /// [`read`](super::read) knows.
    ///
    /// # Errors
    /// [`InstrumentError::NotRead`] for other binary files, [`InstrumentError::Faulty`] for a
    /// damaged workbook.
    pub fn of(file: &str, bytes: &[u8]) -> Result<Option<Self>, InstrumentError> {
        match ContentKind::of(file, bytes)? {
            ContentKind::Text => {
                let (text, encoding) = decode_text(bytes);
                let file = file.to_owned();
                let is_sheet = false;
                let remark = None;
                Ok(Some(Self { file, text, encoding, is_sheet, remark }))
            }
            ContentKind::Workbook => {
                let sheet = workbook::sheet(file, bytes)?;
                let others = sheet.others.join("`, `");
                let (path, wanted) = documents::file::split_file_and_sheet(file);
                Ok(Some(Self {
                    file: format!("{path}, sheet `{}`", sheet.name),
                    text: sheet.text.clone(),
                    encoding: "UTF-8",
                    is_sheet: true,
                    remark: (wanted.is_none() && !sheet.others.is_empty()).then(|| {
                        format!(
                            "sheet `{}` is read, not `{others}`; FILE.xlsx#SHEET names another",
                            sheet.name
                        )
                    }),
                }))
            }
            _ => Ok(None),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::decode::tests::archive;
    use super::*;

    #[test]
    fn text_in_any_encoding_is_text() {
        let utf16: Vec<u8> =
            "400\t0,5\n".repeat(9).encode_utf16().flat_map(u16::to_le_bytes).collect();
        for bytes in [
            b"".to_vec(),
            b"nm\0\0 400,0.5\n".repeat(9)[..7].to_vec(),
            utf16,
            b"Gr\xfcn;1\r\n".to_vec(),
        ] {
            let is_text = ContentKind::of("f", &bytes) == Ok(ContentKind::Text);
            assert_eq!(is_text, bytes.len() != 7, "{bytes:?}");
        }
        assert_eq!(ContentKind::of("f", b"ASD ASCII export, no zeros"), Ok(ContentKind::Text));
    }

    #[test]
    fn binary_formats_are_refused_by_name_with_the_way_out() {
        let ods = archive(&[("mimetype", b"x"), ("content.xml", b"<a/>")]);
        let other = archive(&[("a.txt", b"x")]);
        let noise: Vec<u8> = (0..200).collect();
        for (file, bytes, words, way) in [
            ("a.xls", &b"\xd0\xcf\x11\xe0\xa1\xb1"[..], "old Excel", ".xlsx"),
            ("a.0", b"\x0a\x0a\xfe\xfe\x00", "Bruker OPUS", ".dpt"),
            ("a.ods", &ods, "another kind than .xlsx", "CSV"),
            ("a.zip", &other, "zip archive", "unpack"),
            ("a.spc", &noise, "GRAMS", "JCAMP-DX"),
            ("a.MES", &noise, "SpectraMagic", "export text"),
            ("a.bin", &noise, "no known format", "export text"),
        ] {
            let error = ContentKind::of(file, bytes).unwrap_err();
            let InstrumentError::NotRead { kind, way: advice, .. } = &error else {
                panic!("{error}")
            };
            assert!(kind.contains(words) && advice.contains(way), "{error}: {advice}");
            assert!(error.to_string().is_ascii() && error.to_string().starts_with(file), "{error}");
        }
    }
}
