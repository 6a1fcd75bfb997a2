//! Reading and writing big-endian values, with the offset of every error.

use super::error::SwatchFileError;

/// The unread part of a file, or of a block in it.
pub(super) struct Bytes<'a> {
    pub(super) file: &'a str,
    pub(super) rest: &'a [u8],
    /// Offset of `rest` in the file, in bytes.
    pub(super) offset: usize,
}

impl<'a> Bytes<'a> {
    pub(super) fn wrong(
        &self,
        offset: usize,
        expected: &'static str,
        found: impl ToString,
    ) -> SwatchFileError {
        let file = self.file.to_owned();
        let found = found.to_string();
        SwatchFileError::Bytes { file, offset, expected, found }
    }

    /// Splits off the next `count` bytes.
    pub(super) fn part(
        &mut self,
        count: usize,
        expected: &'static str,
    ) -> Result<Self, SwatchFileError> {
        let Some((head, rest)) = self.rest.split_at_checked(count) else {
            let found = format!("{} bytes before the end", self.rest.len());
            return Err(self.wrong(self.offset, expected, found));
        };
        let part = Bytes { file: self.file, rest: head, offset: self.offset };
        self.rest = rest;
        self.offset += count;
        Ok(part)
    }

    fn array<const N: usize>(
        &mut self,
        expected: &'static str,
    ) -> Result<[u8; N], SwatchFileError> {
        let part = self.part(N, expected)?;
        Ok(part.rest.try_into().expect("a part has the requested length"))
    }

    pub(super) fn u16(&mut self, expected: &'static str) -> Result<u16, SwatchFileError> {
        Ok(u16::from_be_bytes(self.array(expected)?))
    }

    pub(super) fn u32(&mut self, expected: &'static str) -> Result<u32, SwatchFileError> {
        Ok(u32::from_be_bytes(self.array(expected)?))
    }

    pub(super) fn f32(&mut self, expected: &'static str) -> Result<f64, SwatchFileError> {
        let offset = self.offset;
        let value = f32::from_be_bytes(self.array(expected)?);
        if value.is_finite() { Ok(value.into()) } else { Err(self.wrong(offset, expected, value)) }
    }

    /// Reads text of `count` UTF-16 units, including a closing zero.
    pub(super) fn text(&mut self, count: usize) -> Result<String, SwatchFileError> {
        let expected = "a name in UTF-16";
        let mut part = self.part(count.saturating_mul(2), expected)?;
        let offset = part.offset;
        let mut units = Vec::with_capacity(count);
        while !part.rest.is_empty() {
            units.push(part.u16(expected)?);
        }
        if units.last() == Some(&0) {
            units.pop();
        }
        String::from_utf16(&units)
            .map_err(|_| self.wrong(offset, expected, "half a surrogate pair"))
    }
}

/// `text` as UTF-16 units with a closing zero.
pub(super) fn units(format: &'static str, text: &str) -> Result<Vec<u16>, SwatchFileError> {
    let mut units: Vec<u16> = text.encode_utf16().collect();
    units.push(0);
    if units.len() > usize::from(u16::MAX) {
        let what = "letters of a name";
        return Err(SwatchFileError::TooMany { format, what, found: units.len() });
    }
    Ok(units)
}

pub(super) fn put_units(bytes: &mut Vec<u8>, units: &[u16]) {
    bytes.extend(units.iter().flat_map(|unit| unit.to_be_bytes()));
}
