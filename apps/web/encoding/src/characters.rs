//! Finds the characters in bytes.

/// How bytes encode characters.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    Utf8,
    Utf16Le,
    Utf16Be,
    Windows1252,
    /// An encoding without tables here.
    Unknown,
}

/// Characters of the bytes 80 to 9F in Windows-1252 (WHATWG Encoding Standard, index windows-1252).
const WINDOWS_1252: [u16; 32] = [
    0x20ac, 0x81, 0x201a, 0x192, 0x201e, 0x2026, 0x2020, 0x2021, 0x2c6, 0x2030, 0x160, 0x2039,
    0x152, 0x8d, 0x17d, 0x8f, 0x90, 0x2018, 0x2019, 0x201c, 0x201d, 0x2022, 0x2013, 0x2014, 0x2dc,
    0x2122, 0x161, 0x203a, 0x153, 0x9d, 0x17e, 0x178,
];

/// The first character of some bytes, or why there is none.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Next {
    /// A character, and its length in bytes.
    Char(char, usize),
    /// This many bytes do not encode a character.
    Malformed(usize),
    /// The beginning of a character.
    Incomplete,
    /// No byte is left.
    End,
}

/// The first character of `bytes`.
pub(crate) fn next(kind: Kind, bytes: &[u8]) -> Next {
    let Some(&first) = bytes.first() else { return Next::End };
    match kind {
        Kind::Utf8 => next_utf8(bytes),
        Kind::Utf16Le => next_utf16(bytes, u16::from_le_bytes),
        Kind::Utf16Be => next_utf16(bytes, u16::from_be_bytes),
        Kind::Windows1252 => {
            let high = first.checked_sub(0x80).and_then(|at| WINDOWS_1252.get(usize::from(at)));
            let code = high.map_or(u32::from(first), |code| u32::from(*code));
            Next::Char(char::from_u32(code).unwrap_or(char::REPLACEMENT_CHARACTER), 1)
        }
        Kind::Unknown => Next::Malformed(bytes.len()),
    }
}

fn next_utf8(bytes: &[u8]) -> Next {
    let start = &bytes[..bytes.len().min(4)];
    let (valid, fault) = match std::str::from_utf8(start) {
        Ok(text) => (text, None),
        Err(error) => {
            let valid = std::str::from_utf8(&start[..error.valid_up_to()]);
            (valid.unwrap_or_default(), Some(error.error_len()))
        }
    };
    match (valid.chars().next(), fault) {
        (Some(first), _) => Next::Char(first, first.len_utf8()),
        (None, Some(Some(length))) => Next::Malformed(length),
        (None, _) => Next::Incomplete,
    }
}

fn next_utf16(bytes: &[u8], unit: fn([u8; 2]) -> u16) -> Next {
    let at = |place: usize| bytes.get(place..place + 2).map(|pair| unit([pair[0], pair[1]]));
    let Some(first) = at(0) else { return Next::Incomplete };
    let is_high = (0xd800..0xdc00).contains(&first);
    if is_high && at(2).is_none() {
        return Next::Incomplete;
    }
    let units = [first, at(2).unwrap_or_default()];
    match char::decode_utf16(units).next() {
        Some(Ok(found)) => Next::Char(found, 2 * found.len_utf16()),
        _ => Next::Malformed(2),
    }
}
