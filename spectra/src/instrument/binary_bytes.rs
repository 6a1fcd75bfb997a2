//! Numbers at known places of a binary file, little-endian, with an error where the file ends.

use super::error::InstrumentError;

/// The bytes of a file, read from its start.
pub(super) struct BinaryBytes<'a> {
    file: &'a str,
    format: &'static str,
    bytes: &'a [u8],
    /// Number of the next byte, from 0.
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

    /// Number of bytes from here to the end.
    pub(super) fn left(&self) -> usize {
        self.bytes.len().saturating_sub(self.at)
    }

    /// The next `count` bytes.
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

    /// Checks the length before memory for the numbers is asked for.
    fn check_left(&self, count: usize, size: usize) -> Result<(), InstrumentError> {
        if count.saturating_mul(size) <= self.left() {
            return Ok(());
        }
        let left = self.left() / size;
        let at = self.at;
        Err(self.faulty(format!("{count} numbers are needed at byte {at}, and {left} follow")))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_and_text_are_read_and_the_end_is_told() {
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
}
