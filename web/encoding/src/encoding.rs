//! Encodings and whole texts.

use std::borrow::Cow;

use crate::decoder::{Decoder, Kind, Next, next};
use crate::names::{LABELS, UTF_8, UTF_16BE, UTF_16LE};

/// An encoding of text, one for each name of the web.
#[derive(Debug, PartialEq, Eq)]
pub struct Encoding {
    name: &'static str,
    kind: Kind,
}

impl Encoding {
    pub(crate) const fn new(name: &'static str, kind: Kind) -> Self {
        Self { name, kind }
    }

    pub(crate) fn kind(&self) -> Kind {
        self.kind
    }

    /// Name of the encoding.
    #[must_use]
    pub fn name(&'static self) -> &'static str {
        self.name
    }

    /// The encoding that a file calls `label`; `None` for an unknown one.
    #[must_use]
    pub fn for_label(label: &[u8]) -> Option<&'static Self> {
        let label = label.trim_ascii();
        let known = LABELS.iter().find(|known| known.name().as_bytes().eq_ignore_ascii_case(label));
        let short = || label.eq_ignore_ascii_case(b"utf8").then_some(UTF_8);
        let plain = || label.eq_ignore_ascii_case(b"utf-16").then_some(UTF_16LE);
        known.copied().or_else(short).or_else(plain)
    }

    /// The encoding that a byte order mark tells, and the mark's length.
    #[must_use]
    pub fn for_bom(bytes: &[u8]) -> Option<(&'static Self, usize)> {
        match bytes {
            [0xef, 0xbb, 0xbf, ..] => Some((UTF_8, 3)),
            [0xff, 0xfe, ..] => Some((UTF_16LE, 2)),
            [0xfe, 0xff, ..] => Some((UTF_16BE, 2)),
            _ => None,
        }
    }

    /// Whether each byte is a character.
    #[must_use]
    pub fn is_single_byte(&'static self) -> bool {
        self.kind == Kind::Windows1252
    }

    /// A decoder of pieces.
    #[must_use]
    pub fn new_decoder_without_bom_handling(&'static self) -> Decoder {
        Decoder::new(self)
    }

    /// Decodes a whole text, in the encoding that its mark tells if it has one. Returns also the encoding, and
    /// whether characters were replaced.
    #[must_use]
    pub fn decode<'a>(&'static self, bytes: &'a [u8]) -> (Cow<'a, str>, &'static Self, bool) {
        let (encoding, mark) = Self::for_bom(bytes).unwrap_or((self, 0));
        let (text, replaced) = encoding.decode_without_bom_handling(&bytes[mark..]);
        (text, encoding, replaced)
    }

    /// Decodes a whole text. Bytes that stand for no character become U+FFFD; returns whether there are any.
    #[must_use]
    pub fn decode_without_bom_handling<'a>(&'static self, bytes: &'a [u8]) -> (Cow<'a, str>, bool) {
        if self.kind == Kind::Utf8 {
            let text = String::from_utf8_lossy(bytes);
            let replaced = matches!(text, Cow::Owned(_));
            return (text, replaced);
        }
        let (mut text, mut at, mut replaced) = (String::with_capacity(bytes.len()), 0, false);
        loop {
            let length = match next(self.kind, &bytes[at..]) {
                Next::End => return (text.into(), replaced),
                Next::Char(found, length) => {
                    text.push(found);
                    at += length;
                    continue;
                }
                Next::Malformed(length) => length,
                Next::Incomplete => bytes.len() - at,
            };
            text.push(char::REPLACEMENT_CHARACTER);
            replaced = true;
            at += length;
        }
    }

    /// Decodes a whole text; `None` if some bytes stand for no character.
    #[must_use]
    pub fn decode_without_bom_handling_and_without_replacement<'a>(
        &'static self,
        bytes: &'a [u8],
    ) -> Option<Cow<'a, str>> {
        if self.kind == Kind::Utf8 {
            return std::str::from_utf8(bytes).ok().map(Cow::Borrowed);
        }
        let (text, replaced) = self.decode_without_bom_handling(bytes);
        (!replaced).then_some(text)
    }
}
