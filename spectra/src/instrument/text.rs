//! Decoding the bytes of a file, and splitting text into lines.

use encoding_rs::{Encoding, UTF_8, UTF_16BE, UTF_16LE, WINDOWS_1252};

/// Decodes the text of a file and names its encoding: UTF-8 or UTF-16 by byte order mark,
/// UTF-16 by its zero bytes, UTF-8 if the bytes are valid, otherwise Windows-1252 (which
/// contains Latin-1). Never fails: invalid characters become U+FFFD.
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
    let zeros = |odd: usize| start.iter().skip(odd).step_by(2).filter(|&&b| b == 0).count();
    let most = start.len() * 2 / 5;
    if start.len() >= 8 && zeros(1) >= most && zeros(0) == 0 {
        UTF_16LE
    } else if start.len() >= 8 && zeros(0) >= most && zeros(1) == 0 {
        UTF_16BE
    } else if std::str::from_utf8(bytes).is_ok() {
        UTF_8
    } else {
        WINDOWS_1252
    }
}

/// The lines of a text, numbered from 1. A line ends with LF, CR LF or CR; LF CR also counts as
/// one end (OceanView writes it).
pub(super) fn lines(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let mut rest = Some(text);
    let next = move || {
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
    };
    std::iter::from_fn(next).zip(1..).map(|(line, number)| (number, line))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_encoding_gives_the_same_text() {
        let text = "10\u{b0} Gr\u{fc}n;400;0,5\n";
        let latin: Vec<u8> = text.chars().map(|c| c as u8).collect();
        let utf16: Vec<u16> = text.encode_utf16().collect();
        let little: Vec<u8> = utf16.iter().flat_map(|u| u.to_le_bytes()).collect();
        let big: Vec<u8> = utf16.iter().flat_map(|u| u.to_be_bytes()).collect();
        let marked = |mark: &[u8], bytes: &[u8]| [mark, bytes].concat();
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
}
