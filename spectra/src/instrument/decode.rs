//! Text, numbers, little-endian binary fields and zip entries out of the bytes of a file, with errors that name
//! the place.

use std::io::{Cursor, Read};

use documents::excerpt;
use encoding_rs::{Encoding, UTF_8, UTF_16BE, UTF_16LE, WINDOWS_1252};
use zip::ZipArchive;

use super::measured::InstrumentError;

/// Decodes the text of a file and names its encoding. A byte order mark decides between UTF-8 and
/// UTF-16. Without one, zero bytes mean UTF-16, valid bytes UTF-8, and anything else is
/// Windows-1252 (which contains Latin-1). This never fails: invalid characters become U+FFFD.
#[must_use]
pub fn decode_text(bytes: &[u8]) -> (String, &'static str) {
    let (encoding, bytes) = match Encoding::for_bom(bytes) {
        Some((encoding, length)) => (encoding, &bytes[length..]),
        None => (guess_encoding(bytes), bytes),
    };
    let (text, _) = encoding.decode_without_bom_handling(bytes);
    (text.into_owned(), encoding.name())
}

/// Whether bytes are UTF-16, by their mark or their zeros.
pub(super) fn is_utf16(bytes: &[u8]) -> bool {
    let marked = Encoding::for_bom(bytes).map(|(encoding, _)| encoding);
    let encoding = marked.unwrap_or_else(|| guess_encoding(bytes));
    encoding == UTF_16LE || encoding == UTF_16BE
}

/// Instrument files are mostly ASCII, of which every second byte is zero in UTF-16.
fn guess_encoding(bytes: &[u8]) -> &'static Encoding {
    let start = &bytes[..bytes.len().min(200)];
    let [even, odd] =
        [0, 1].map(|from| start.iter().skip(from).step_by(2).filter(|&&b| b == 0).count());
    let most = start.len() * 2 / 5;
    if start.len() >= 8 && odd >= most && even == 0 {
        UTF_16LE
    } else if start.len() >= 8 && even >= most && odd == 0 {
        UTF_16BE
    } else if std::str::from_utf8(bytes).is_ok() {
        UTF_8
    } else {
        WINDOWS_1252
    }
}

/// The lines of a text, numbered from 1. A line ends with LF, CR LF or CR. LF CR also counts as
/// one end (OceanView writes it).
pub(super) fn lines(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let mut rest = Some(text);
    std::iter::from_fn(move || {
        let whole = rest?;
        let Some(at) = whole.find(['\n', '\r']) else {
            rest = None;
            return (!whole.is_empty()).then_some(whole);
        };
        let end = &whole.as_bytes()[at..];
        let pair =
            end.starts_with(b"\r\n") || (end.starts_with(b"\n\r") && !end.starts_with(b"\n\r\n"));
        rest = Some(&whole[at + 1 + usize::from(pair)..]);
        Some(&whole[..at])
    })
    .zip(1..)
    .map(|(line, number)| (number, line))
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Decimal {
    Point,
    Comma,
}

impl Decimal {
    /// The decimal sign of `cells`: a comma if any cell contains one. If a file has both signs, the
    /// first point is an error, because we cannot tell a separator of thousands from a decimal
    /// sign.
    pub(super) fn of<'a>(mut cells: impl Iterator<Item = &'a str>) -> Self {
        if cells.any(|cell| cell.contains(',')) { Self::Comma } else { Self::Point }
    }
}

/// Parses a finite number. Anything else gives `None`.
pub(super) fn number(text: &str, decimal: Decimal) -> Option<f64> {
    let text = text.trim();
    // `inf`, `nan` and the like count as words.
    if !text.bytes().all(|b| b.is_ascii_digit() || b"+-.,eE".contains(&b)) {
        return None;
    }
    let value = match decimal {
        Decimal::Point => text.parse().ok(),
        // `400,` is the start of `400, 0.5`.
        Decimal::Comma if text.contains('.') || text.ends_with(',') => None,
        Decimal::Comma => text.replace(',', ".").parse().ok(),
    };
    value.filter(|value: &f64| value.is_finite())
}

/// Parses the number in `text`, a cell of `line` in `file`. `expected` describes it in the
/// error.
pub(super) fn required_number(
    file: &str,
    line: usize,
    expected: &'static str,
    text: &str,
    decimal: Decimal,
) -> Result<f64, InstrumentError> {
    number(text, decimal).ok_or_else(|| InstrumentError::line(file, line, expected, text))
}

pub(super) struct BinaryBytes<'a> {
    file: &'a str,
    format: &'static str,
    bytes: &'a [u8],
    at: usize,
}

impl<'a> BinaryBytes<'a> {
    pub(super) fn new(file: &'a str, format: &'static str, bytes: &'a [u8]) -> Self {
        Self { file, format, bytes, at: 0 }
    }

    /// An error about the file, with `fault` as its reason.
    pub(super) fn faulty(&self, fault: impl Into<String>) -> InstrumentError {
        InstrumentError::faulty(self.file, self.format, fault)
    }

    /// Goes on at byte `at`, counted from 0.
    pub(super) fn seek(&mut self, at: usize) -> &mut Self {
        self.at = at;
        self
    }

    pub(super) fn left(&self) -> usize {
        self.bytes.len().saturating_sub(self.at)
    }

    pub(super) fn take(&mut self, count: usize) -> Result<&'a [u8], InstrumentError> {
        let end = self.at.checked_add(count).filter(|end| *end <= self.bytes.len());
        let Some(end) = end else {
            let has = self.bytes.len();
            let at = self.at;
            return Err(self.faulty(format!("it has {has} bytes, and {count} are needed at {at}")));
        };
        let found = &self.bytes[self.at..end];
        self.at = end;
        Ok(found)
    }

    fn array<const N: usize>(&mut self) -> Result<[u8; N], InstrumentError> {
        let mut found = [0; N];
        found.copy_from_slice(self.take(N)?);
        Ok(found)
    }

    pub(super) fn u8(&mut self) -> Result<u8, InstrumentError> {
        Ok(self.array::<1>()?[0])
    }

    pub(super) fn u16(&mut self) -> Result<u16, InstrumentError> {
        self.array().map(u16::from_le_bytes)
    }

    pub(super) fn u32(&mut self) -> Result<u32, InstrumentError> {
        self.array().map(u32::from_le_bytes)
    }

    pub(super) fn f32(&mut self) -> Result<f64, InstrumentError> {
        self.array().map(|bytes| f64::from(f32::from_le_bytes(bytes)))
    }

    pub(super) fn f64(&mut self) -> Result<f64, InstrumentError> {
        self.array().map(f64::from_le_bytes)
    }

    /// The next `count` numbers of 4 bytes.
    pub(super) fn f32s(&mut self, count: usize) -> Result<Vec<f64>, InstrumentError> {
        self.check_left(count, 4)?;
        (0..count).map(|_| self.f32()).collect()
    }

    /// The next `count` numbers of 8 bytes.
    pub(super) fn f64s(&mut self, count: usize) -> Result<Vec<f64>, InstrumentError> {
        self.check_left(count, 8)?;
        (0..count).map(|_| self.f64()).collect()
    }

    /// The ASCII text in the next `count` bytes, up to the first zero.
    pub(super) fn text(&mut self, count: usize) -> Result<String, InstrumentError> {
        let bytes = self.take(count)?.split(|byte| *byte == 0).next().unwrap_or_default();
        let printable = bytes.iter().filter(|byte| byte.is_ascii_graphic() || **byte == b' ');
        Ok(printable.map(|byte| char::from(*byte)).collect::<String>().trim().to_owned())
    }

    /// Checks the length before we allocate memory for the numbers.
    fn check_left(&self, count: usize, size: usize) -> Result<(), InstrumentError> {
        if count.saturating_mul(size) <= self.left() {
            return Ok(());
        }
        let left = self.left() / size;
        let at = self.at;
        Err(self.faulty(format!("{count} numbers are needed at byte {at}, and {left} follow")))
    }
}

/// We unpack at most this many MB of a file in an archive, and of all files in a workbook. Spectra are far
/// smaller.
pub(super) const MOST_MB: usize = 64;
/// [`MOST_MB`] in bytes.
pub(super) const MOST_BYTES: usize = MOST_MB << 20;

pub(super) struct Archive<'a> {
    file: &'a str,
    archive: ZipArchive<Cursor<&'a [u8]>>,
}

pub(super) fn is_zip(bytes: &[u8]) -> bool {
    bytes.starts_with(b"PK\x03\x04") || bytes.starts_with(b"PK\x05\x06")
}

impl<'a> Archive<'a> {
    pub(super) fn open(file: &'a str, bytes: &'a [u8]) -> Result<Self, InstrumentError> {
        let archive = ZipArchive::new(Cursor::new(bytes));
        let archive = archive
            .map_err(|_| InstrumentError::faulty(file, "zip", "its directory is missing"))?;
        Ok(Self { file, archive })
    }

    /// The first name of a file for which `is_wanted` holds.
    pub(super) fn find(&self, is_wanted: impl Fn(&str) -> bool) -> Option<String> {
        self.archive.file_names().find(|name| is_wanted(name)).map(str::to_owned)
    }

    /// The names of all files for which `is_wanted` holds.
    pub(super) fn all(&self, is_wanted: impl Fn(&str) -> bool) -> Vec<String> {
        let names = self.archive.file_names();
        names.filter(|name| is_wanted(name)).map(str::to_owned).collect()
    }

    pub(super) fn read(&mut self, name: &str) -> Result<Vec<u8>, InstrumentError> {
        let faulty = |fault: String| InstrumentError::faulty(self.file, "zip", fault);
        let entry = self.archive.by_name(name);
        let entry = entry.map_err(|_| faulty(format!("`{}` cannot be unpacked", excerpt(name))))?;
        let mut bytes = Vec::new();
        let read = entry.take(MOST_BYTES as u64 + 1).read_to_end(&mut bytes);
        read.map_err(|_| faulty(format!("`{}` cannot be unpacked", excerpt(name))))?;
        if bytes.len() > MOST_BYTES {
            return Err(faulty(format!("`{}` unpacks to more than {MOST_MB} MB", excerpt(name))));
        }
        Ok(bytes)
    }

    /// Whether all files together unpack to at most `most` bytes. We unpack them without keeping them, because
    /// an archive may state any size. A file that cannot be unpacked counts up to its fault.
    pub(super) fn fits(&mut self, most: usize) -> bool {
        let mut left = most as u64;
        let mut buffer = vec![0; 64 << 10];
        for index in 0..self.archive.len() {
            let Ok(entry) = self.archive.by_index(index) else { continue };
            let mut entry = entry.take(left + 1);
            while let Ok(count @ 1..) = entry.read(&mut buffer) {
                match left.checked_sub(count as u64) {
                    Some(rest) => left = rest,
                    None => return false,
                }
            }
        }
        true
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use std::io::Write;
    use zip::write::SimpleFileOptions;
    use zip::{CompressionMethod, ZipWriter};

    #[test]
    fn every_encoding_gives_the_same_text() {
        let text = "10\u{b0} Gr\u{fc}n;400;0,5\n";
        let latin: Vec<u8> = text.chars().map(|c| c as u8).collect();
        let utf16: Vec<u16> = text.encode_utf16().collect();
        let little: Vec<u8> = utf16.iter().flat_map(|u| u.to_le_bytes()).collect();
        let big: Vec<u8> = utf16.iter().flat_map(|u| u.to_be_bytes()).collect();
        for (bytes, name) in [
            (text.as_bytes().to_vec(), "UTF-8"),
            (marked(b"\xef\xbb\xbf", text.as_bytes()), "UTF-8"),
            (latin, "windows-1252"),
            (marked(b"\xff\xfe", &little), "UTF-16LE"),
            (marked(b"\xfe\xff", &big), "UTF-16BE"),
            (little, "UTF-16LE"),
            (big, "UTF-16BE"),
        ] {
            assert_eq!(decode_text(&bytes), (text.to_owned(), name), "{name}");
        }
    }

    #[test]
    fn every_kind_of_line_end_is_recognised() {
        let found: Vec<_> = lines("a\nb\r\nc\rd\n\re\n\r\nf").collect();
        assert_eq!(found, [(1, "a"), (2, "b"), (3, "c"), (4, "d"), (5, "e"), (6, ""), (7, "f")]);
        assert_eq!(lines("").count(), 0);
        assert_eq!(lines("a\n").count(), 1);
    }

    #[test]
    fn only_finite_numbers_are_numbers() {
        assert_eq!(number(" 1.8792E2 ", Decimal::Point), Some(187.92));
        assert_eq!(number("-0,5", Decimal::Comma), Some(-0.5));
        assert_eq!(number("7", Decimal::Comma), Some(7.0));
        for text in ["", "inf", "NaN", "1e999", "1,5", "0x1", "1.2.3", "-"] {
            assert_eq!(number(text, Decimal::Point), None, "{text}");
        }
        assert_eq!(number("1.234,5", Decimal::Comma), None);
    }

    #[test]
    fn numbers_and_text_are_read_and_the_end_is_reported() {
        let bytes = [1, 2, 0, 0, 0, 128, 63, b'A', b'S', 0, 7];
        let mut reader = BinaryBytes::new("f", "test", &bytes);
        assert_eq!((reader.u8().unwrap(), reader.u16().unwrap()), (1, 2));
        assert_eq!((reader.f32().unwrap(), reader.text(3).unwrap()), (1.0, "AS".to_owned()));
        assert_eq!(
            reader.u32().unwrap_err().to_string(),
            "f: faulty test file: it has 11 bytes, and 4 are needed at 10"
        );
        let error = reader.f64s(usize::MAX).unwrap_err().to_string();
        assert!(error.ends_with("are needed at byte 10, and 0 follow"), "{error}");
    }

    /// An archive of these files, compressed.
    pub(in super::super) fn archive(files: &[(&str, &[u8])]) -> Vec<u8> {
        let mut writer = ZipWriter::new(Cursor::new(Vec::new()));
        let options = SimpleFileOptions::default().compression_method(CompressionMethod::Deflated);
        for (name, bytes) in files {
            writer.start_file(*name, options).unwrap();
            writer.write_all(bytes).unwrap();
        }
        writer.finish().unwrap().into_inner()
    }

    #[test]
    fn files_are_found_and_unpacked() {
        let bytes = archive(&[("a.txt", b"one"), ("b.xml", b"two")]);
        assert!(is_zip(&bytes));
        let mut found = Archive::open("f", &bytes).unwrap();
        let name = found.find(|name| name.ends_with(".xml")).unwrap();
        assert_eq!((name.as_str(), found.read(&name).unwrap()), ("b.xml", b"two".to_vec()));
        assert!(found.read("c").unwrap_err().to_string().contains("`c` cannot be unpacked"));
        for length in 4..bytes.len() {
            assert!(Archive::open("f", &bytes[..length]).is_err(), "{length}");
        }
    }

    #[test]
    fn a_file_unpacks_to_64_mb_at_most() {
        let zeros = vec![0; (64 << 20) + 1];
        let bytes = archive(&[("whole", &zeros[1..]), ("more", &zeros)]);
        assert!(bytes.len() < 1 << 20, "a small archive: {} bytes", bytes.len());
        let mut found = Archive::open("f", &bytes).unwrap();
        assert_eq!(found.read("whole").unwrap().len(), 64 << 20);
        let error = found.read("more").map(|bytes| bytes.len()).unwrap_err().to_string();
        assert_eq!(error, "f: faulty zip file: `more` unpacks to more than 64 MB");
        assert!(found.fits((128 << 20) + 1), "just as large");
        assert!(!found.fits(128 << 20), "one byte more");
    }

    fn marked(mark: &[u8], bytes: &[u8]) -> Vec<u8> {
        [mark, bytes].concat()
    }
}
