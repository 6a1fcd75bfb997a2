//! Decodes text that arrives in pieces.

use crate::characters::{Next, next};
use crate::encoding::Encoding;

/// How a call of a [`Decoder`] ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DecoderResult {
    /// All bytes were read.
    InputEmpty,
    /// The output has no room for the next character.
    OutputFull,
    /// Bytes that do not encode a character: their number, and how many bytes were read after them.
    Malformed(u8, u8),
}

/// Decodes text that arrives in pieces.
#[derive(Debug)]
pub struct Decoder {
    encoding: &'static Encoding,
    /// The beginning of a character, read from an earlier piece.
    begun: Vec<u8>,
}

impl Decoder {
    fn new(encoding: &'static Encoding) -> Self {
        Self { encoding, begun: Vec::new() }
    }

    /// Encoding of the text.
    #[must_use]
    pub fn encoding(&self) -> &'static Encoding {
        self.encoding
    }

    /// Most bytes of UTF-8 that `length` bytes can become, or `None` if that overflows.
    #[must_use]
    pub fn max_utf8_buffer_length_without_replacement(&self, length: usize) -> Option<usize> {
        length.checked_add(self.begun.len())?.checked_mul(3)?.checked_add(3)
    }

    /// Decodes `source` to the end of `text`, up to its capacity. Returns how it ended and the
    /// number of bytes read. Pass `last` if no more bytes follow.
    pub fn decode_to_string_without_replacement(
        &mut self,
        source: &[u8],
        text: &mut String,
        last: bool,
    ) -> (DecoderResult, usize) {
        let room = text.capacity() - text.len();
        self.decode(source, last, room, |found| text.push(found))
    }

    /// Decodes `source` to UTF-8 in `target`. Returns how it ended, and the numbers of bytes read
    /// and written. Pass `last` if no more bytes follow.
    pub fn decode_to_utf8_without_replacement(
        &mut self,
        source: &[u8],
        target: &mut [u8],
        last: bool,
    ) -> (DecoderResult, usize, usize) {
        let room = target.len();
        let mut written = 0;
        let (result, read) = self.decode(source, last, room, |found| {
            written += found.encode_utf8(&mut target[written..]).len();
        });
        (result, read, written)
    }

    fn decode(
        &mut self,
        source: &[u8],
        last: bool,
        mut room: usize,
        mut put: impl FnMut(char),
    ) -> (DecoderResult, usize) {
        let before = self.begun.len();
        let bytes = [self.begun.as_slice(), source].concat();
        let mut at = 0;
        let result = loop {
            match next(self.encoding.kind(), &bytes[at..]) {
                Next::End => break DecoderResult::InputEmpty,
                Next::Char(found, _) if found.len_utf8() > room => break DecoderResult::OutputFull,
                Next::Char(found, length) => {
                    put(found);
                    room -= found.len_utf8();
                    at += length;
                }
                Next::Malformed(length) => {
                    at += length;
                    break DecoderResult::Malformed(u8::try_from(length).unwrap_or(u8::MAX), 0);
                }
                Next::Incomplete if last => {
                    let length = bytes.len() - at;
                    at = bytes.len();
                    break DecoderResult::Malformed(u8::try_from(length).unwrap_or(u8::MAX), 0);
                }
                Next::Incomplete => {
                    self.begun = bytes[at..].to_vec();
                    return (DecoderResult::InputEmpty, source.len());
                }
            }
        };
        // Keep what was begun and is not read yet.
        self.begun = bytes[at.min(before)..before].to_vec();
        (result, at.max(before) - before)
    }
}

impl Encoding {
    /// A decoder for text that arrives in pieces. It does not look for a byte order mark.
    #[must_use]
    pub fn new_decoder_without_bom_handling(&'static self) -> Decoder {
        Decoder::new(self)
    }
}

#[cfg(test)]
mod tests {
    use crate::{DecoderResult, Encoding, UTF_8, UTF_16BE, UTF_16LE, WINDOWS_1252};

    const TEXT: &str = "a\u{b0}\u{20ac}\u{1f3a8} z";

    fn bytes(encoding: &'static Encoding) -> Vec<u8> {
        match encoding.name() {
            "UTF-8" => TEXT.as_bytes().to_vec(),
            "UTF-16LE" => TEXT.encode_utf16().flat_map(u16::to_le_bytes).collect(),
            _ => TEXT.encode_utf16().flat_map(u16::to_be_bytes).collect(),
        }
    }

    #[test]
    fn text_is_read_whole_and_in_pieces_of_any_size() {
        for encoding in [UTF_8, UTF_16LE, UTF_16BE] {
            let bytes = bytes(encoding);
            assert_eq!(encoding.decode_without_bom_handling(&bytes), (TEXT.into(), false));
            for size in 1..bytes.len() {
                let mut decoder = encoding.new_decoder_without_bom_handling();
                let mut found = Vec::new();
                let mut target = [0; 5];
                for piece in bytes.chunks(size) {
                    let mut rest = piece;
                    loop {
                        let (result, read, written) =
                            decoder.decode_to_utf8_without_replacement(rest, &mut target, false);
                        found.extend_from_slice(&target[..written]);
                        rest = &rest[read..];
                        if result == DecoderResult::InputEmpty {
                            break;
                        }
                        assert_eq!(result, DecoderResult::OutputFull, "{encoding:?} by {size}");
                    }
                }
                assert_eq!(String::from_utf8(found).as_deref(), Ok(TEXT), "{encoding:?} by {size}");
            }
        }
    }

    #[test]
    fn windows_1252_has_a_character_for_every_byte() {
        let all: Vec<u8> = (0..=255).collect();
        let (text, faulty) = WINDOWS_1252.decode_without_bom_handling(&all);
        let found: Vec<char> = text.chars().collect();
        assert_eq!((found.len(), faulty), (256, false));
        assert_eq!((found[0x80], found[0x9f], found[0xb0]), ('\u{20ac}', '\u{178}', '\u{b0}'));
    }

    #[test]
    fn faulty_bytes_are_replaced_or_refused() {
        let (text, faulty) = UTF_8.decode_without_bom_handling(b"a\xffb\xe2\x82");
        assert_eq!((&*text, faulty), ("a\u{fffd}b\u{fffd}", true));
        let (text, faulty) = UTF_16LE.decode_without_bom_handling(b"a\x00\x00\xdcb\x00c");
        assert_eq!((&*text, faulty), ("a\u{fffd}b\u{fffd}", true));
        assert_eq!(UTF_8.decode_without_bom_handling_and_without_replacement(b"\xff"), None);
        let cyrillic = Encoding::for_label(b"koi8-r").map(Encoding::name);
        assert_eq!(cyrillic, Some("KOI8-R"));
        assert_eq!(crate::KOI8_R.decode_without_bom_handling_and_without_replacement(b"a"), None);
    }
}
