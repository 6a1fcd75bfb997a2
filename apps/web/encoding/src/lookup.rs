//! Encodings by label and by byte order mark.

use std::borrow::Cow;

use crate::encoding::Encoding;
use crate::names::{LABELS, UTF_8, UTF_16BE, UTF_16LE};

impl Encoding {
    /// The encoding that a file calls `label`, if it is known.
    #[must_use]
    pub fn for_label(label: &[u8]) -> Option<&'static Self> {
        let label = label.trim_ascii();
        let known = LABELS.iter().find(|known| known.name().as_bytes().eq_ignore_ascii_case(label));
        known
            .copied()
            .or_else(|| label.eq_ignore_ascii_case(b"utf8").then_some(UTF_8))
            .or_else(|| label.eq_ignore_ascii_case(b"utf-16").then_some(UTF_16LE))
    }

    /// The encoding of a byte order mark, and the length of the mark.
    #[must_use]
    pub fn for_bom(bytes: &[u8]) -> Option<(&'static Self, usize)> {
        match bytes {
            [0xef, 0xbb, 0xbf, ..] => Some((UTF_8, 3)),
            [0xff, 0xfe, ..] => Some((UTF_16LE, 2)),
            [0xfe, 0xff, ..] => Some((UTF_16BE, 2)),
            _ => None,
        }
    }

    /// Decodes a whole text. If it has a byte order mark, the mark decides the encoding. Also
    /// returns the encoding, and whether characters were replaced.
    #[must_use]
    pub fn decode<'a>(&'static self, bytes: &'a [u8]) -> (Cow<'a, str>, &'static Self, bool) {
        let (encoding, mark) = Self::for_bom(bytes).unwrap_or((self, 0));
        let (text, replaced) = encoding.decode_without_bom_handling(&bytes[mark..]);
        (text, encoding, replaced)
    }
}
