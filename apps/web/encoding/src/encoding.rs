//! Encodings and whole texts.

use std::borrow::Cow;

use crate::characters::{Kind, Next, next};

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

    /// Whether each byte is a character.
    #[must_use]
    pub fn is_single_byte(&'static self) -> bool {
        self.kind == Kind::Windows1252
    }

    /// Decodes a whole text. Bytes that do not encode a character become U+FFFD, and you learn
    /// whether there are any.
    #[must_use]
    pub fn decode_without_bom_handling<'a>(&'static self, bytes: &'a [u8]) -> (Cow<'a, str>, bool) {
        if self.kind == Kind::Utf8 {
            let text = String::from_utf8_lossy(bytes);
            let replaced = matches!(text, Cow::Owned(_));
            return (text, replaced);
        }
        let mut text = String::with_capacity(bytes.len());
        let mut at = 0;
        let mut replaced = false;
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

    /// Decodes a whole text. Returns `None` if some bytes do not encode a character.
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
