//! The kind of a file by its first bytes: text, a binary format that is read, or one that is refused by
//! name.

use super::error::InstrumentError;
use super::text::is_utf16;
use super::zip_archive::{Archive, is_zip};
use super::{asd, avasoft7, avasoft8, procspec};

/// The kind of a file's content.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ContentKind {
    Text,
    Asd,
    AvaSoft7,
    AvaSoft8,
    ProcSpec,
    Workbook,
}

/// First bytes of formats that are not read, their kind, and the way to a file that is.
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

/// Endings of binary formats without first bytes of their own, in lower case.
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

/// Bytes that are looked at to tell a binary file from text.
const LOOKED_AT: usize = 4096;
/// Share of control characters, and of zeros, above which a file is no text; chosen by eye.
const MOST_CONTROL: f64 = 0.02;
const MOST_ZEROS: f64 = 0.1;

impl ContentKind {
    /// The kind of `bytes`, the content of `file`.
    ///
    /// # Errors
    /// [`InstrumentError::NotRead`] for a binary format that is not read, [`InstrumentError::Faulty`] for an
    /// archive that cannot be opened.
    pub(super) fn of(file: &str, bytes: &[u8]) -> Result<Self, InstrumentError> {
        if asd::is_binary(bytes) {
            return Ok(Self::Asd);
        } else if avasoft7::is_binary(bytes) {
            return Ok(Self::AvaSoft7);
        } else if avasoft8::is_binary(bytes) {
            return Ok(Self::AvaSoft8);
        }
        let not_read = |kind, way| InstrumentError::NotRead { file: file.to_owned(), kind, way };
        if is_zip(bytes) {
            let archive = Archive::open(file, bytes)?;
            let has = |wanted: &str| archive.find(|name| name == wanted).is_some();
            return if has("xl/workbook.xml") {
                Ok(Self::Workbook)
            } else if archive.find(procspec::is_spectrum).is_some() {
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

/// Whether bytes are no text in any encoding.
fn is_noise(bytes: &[u8]) -> bool {
    let start = &bytes[..bytes.len().min(LOOKED_AT)];
    if is_utf16(start) {
        return false;
    }
    let share = |count: usize| count as f64 / start.len().max(1) as f64;
    share(
        start
            .iter()
            .filter(|byte: &&u8| matches!(byte, 1..=8 | 11 | 14..=26 | 28..=31 | 127))
            .count(),
    ) > MOST_CONTROL
        || share(start.iter().filter(|byte| **byte == 0).count()) > MOST_ZEROS
}

#[cfg(test)]
mod tests {
    use super::super::zip_archive::tests::archive;
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
            let InstrumentError::NotRead { kind, way: told, .. } = &error else {
                panic!("{error}")
            };
            assert!(kind.contains(words) && told.contains(way), "{error}: {told}");
            assert!(error.to_string().is_ascii() && error.to_string().starts_with(file), "{error}");
        }
    }
}
