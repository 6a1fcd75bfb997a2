//! States as files. Their bytes hold every number to the bit, with a name, a version, an identity
//! and a checksum. Whole numbers have the lowest byte first, and floats are stored by their bits.
//!
//! A file has 16 bytes with the name of the format, 4 with its version, 32 with the SHA-256 digest
//! that says what the state belongs to, the state, and 32 with the digest of all this.

use documents::hint::Explain;
use glam::Vec3;
use paint::layer::Cell;
use sha2::{Digest, Sha256};

/// Stores numbers by their bytes.
macro_rules! numbers {
    ($($number:ty),*) => {$(
        impl Stored for $number {
            fn store(&self, bytes: &mut Vec<u8>) {
                bytes.extend_from_slice(&self.to_le_bytes());
            }

            fn read(from: &mut Reader<'_>) -> Option<Self> {
                from.take().map(Self::from_le_bytes)
            }
        }
    )*};
}

/// Stores a structure field by field. If you leave out a field, this does not compile.
macro_rules! stored {
    ($structure:ty { $($field:ident),* $(,)? }) => {
        impl $crate::saved::Stored for $structure {
            fn store(&self, bytes: &mut Vec<u8>) {
                let Self { $($field),* } = self;
                $($crate::saved::Stored::store($field, bytes);)*
            }

            fn read(from: &mut $crate::saved::Reader<'_>) -> Option<Self> {
                $(let $field = $crate::saved::Stored::read(from)?;)*
                Some(Self { $($field),* })
            }
        }
    };
}

pub(crate) use stored;

/// A saved state cannot be used. Whoever reads it starts from the beginning instead.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error, Explain)]
#[hint("leave the file out to start from the beginning")]
pub enum SavedError {
    /// The file holds something else.
    #[error("not a saved {0}")]
    Foreign(&'static str),
    /// The file was written by another version.
    #[error("a saved {kind} of version {found}; this program reads version {read}")]
    Version {
        /// Kind of state.
        kind: &'static str,
        /// Version of the file.
        found: u32,
        /// Version that is read.
        read: u32,
    },
    /// The state belongs to another scene or to other settings, or was saved with another `wish`.
    #[error("saved for another scene, or with other settings")]
    Other,
    /// The file was cut short or changed.
    #[error("cut short or damaged")]
    Damaged,
}

/// A value that is stored as bytes and read again to the bit.
pub(crate) trait Stored: Sized {
    fn store(&self, bytes: &mut Vec<u8>);

    /// Reads one value. `None` if the bytes end too early or do not encode such a value.
    fn read(from: &mut Reader<'_>) -> Option<Self>;
}

#[derive(Debug)]
pub(crate) struct Reader<'b> {
    rest: &'b [u8],
}

impl<'b> Reader<'b> {
    pub(crate) fn new(bytes: &'b [u8]) -> Self {
        Self { rest: bytes }
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.rest.is_empty()
    }

    fn take<const N: usize>(&mut self) -> Option<[u8; N]> {
        let (bytes, rest) = self.rest.split_first_chunk()?;
        self.rest = rest;
        Some(*bytes)
    }
}

numbers!(u8, u16, u32, u64, f32, f64);

stored!(Vec3 { x, y, z });
stored!(Cell { pigments, vehicle });

impl Stored for bool {
    fn store(&self, bytes: &mut Vec<u8>) {
        bytes.push(u8::from(*self));
    }

    fn read(from: &mut Reader<'_>) -> Option<Self> {
        match u8::read(from)? {
            0 => Some(false),
            1 => Some(true),
            _ => None,
        }
    }
}

impl<T: Stored> Stored for Option<T> {
    fn store(&self, bytes: &mut Vec<u8>) {
        self.is_some().store(bytes);
        if let Some(value) = self {
            value.store(bytes);
        }
    }

    fn read(from: &mut Reader<'_>) -> Option<Self> {
        match bool::read(from)? {
            true => T::read(from).map(Some),
            false => Some(None),
        }
    }
}

impl<A: Stored, B: Stored> Stored for (A, B) {
    fn store(&self, bytes: &mut Vec<u8>) {
        self.0.store(bytes);
        self.1.store(bytes);
    }

    fn read(from: &mut Reader<'_>) -> Option<Self> {
        Some((A::read(from)?, B::read(from)?))
    }
}

impl<T: Stored, const N: usize> Stored for [T; N] {
    fn store(&self, bytes: &mut Vec<u8>) {
        self.iter().for_each(|value| value.store(bytes));
    }

    fn read(from: &mut Reader<'_>) -> Option<Self> {
        let values: Option<Vec<T>> = (0..N).map(|_| T::read(from)).collect();
        values?.try_into().ok()
    }
}

impl<T: Stored> Stored for Vec<T> {
    fn store(&self, bytes: &mut Vec<u8>) {
        (self.len() as u64).store(bytes);
        self.iter().for_each(|value| value.store(bytes));
    }

    fn read(from: &mut Reader<'_>) -> Option<Self> {
        let count = u64::read(from)?;
        // A value has at least one byte, so a wrong count does not reserve memory.
        let fits = count <= from.rest.len() as u64;
        if fits { (0..count).map(|_| T::read(from)).collect() } else { None }
    }
}

const DIGEST: usize = 32;

#[derive(Debug, Clone, Copy)]
pub(crate) struct Kind {
    /// Name of the format. A file begins with these bytes.
    pub(crate) format: &'static [u8; 16],
    pub(crate) version: u32,
    /// Name of the state. Errors show this.
    pub(crate) name: &'static str,
}

/// The digest of texts that say what a state belongs to.
pub(crate) fn identity<'t>(texts: impl IntoIterator<Item = &'t str>) -> [u8; DIGEST] {
    let mut digest = Sha256::new();
    for text in texts {
        digest.update(text);
        digest.update([0]);
    }
    digest.finalize().into()
}

/// Puts the bytes of a state into a file of this `identity`.
pub(crate) fn file_of_state(kind: Kind, identity: &[u8; DIGEST], state: &[u8]) -> Vec<u8> {
    let mut file = Vec::with_capacity(kind.format.len() + 4 + 2 * DIGEST + state.len());
    file.extend_from_slice(kind.format);
    kind.version.store(&mut file);
    file.extend_from_slice(identity);
    file.extend_from_slice(state);
    let digest = Sha256::digest(&file);
    file.extend_from_slice(&digest);
    file
}

/// Takes the bytes of the state out of a file. It must be undamaged, and of this kind and
/// `identity`.
pub(crate) fn state_of_file<'f>(
    kind: Kind,
    identity: &[u8; DIGEST],
    file: &'f [u8],
) -> Result<&'f [u8], SavedError> {
    let named = kind.format.len().min(file.len());
    if file[..named] != kind.format[..named] {
        return Err(SavedError::Foreign(kind.name));
    }
    let part = file.get(named..).and_then(<[u8]>::split_first_chunk);
    let (version, rest) = part.ok_or(SavedError::Damaged)?;
    match u32::from_le_bytes(*version) {
        found if found == kind.version => {}
        found => {
            return Err(SavedError::Version { kind: kind.name, found, read: kind.version });
        }
    }
    let (state, digest) = rest.split_last_chunk::<DIGEST>().ok_or(SavedError::Damaged)?;
    let (of, state) = state.split_first_chunk::<DIGEST>().ok_or(SavedError::Damaged)?;
    let whole = &file[..file.len() - DIGEST];
    if Sha256::digest(whole)[..] != digest[..] {
        return Err(SavedError::Damaged);
    }
    if of == identity { Ok(state) } else { Err(SavedError::Other) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_read_to_the_bit_and_never_from_too_few_bytes() {
        type Values = (Vec<(f32, Option<u64>)>, ([f64; 2], (bool, Vec3)));
        let list = vec![(f32::from_bits(0x7fc0_1234), Some(7)), (-0.0, None)];
        let values: Values = (list, ([1e-300, -2.5], (true, Vec3::new(1.0, -0.0, 1e-40))));
        let mut bytes = Vec::new();
        values.store(&mut bytes);
        let mut again = Vec::new();
        let mut reader = Reader::new(&bytes);
        Values::read(&mut reader).unwrap().store(&mut again);
        assert!(reader.is_empty());
        assert_eq!(bytes, again);
        for short in 0..bytes.len() {
            assert!(Values::read(&mut Reader::new(&bytes[..short])).is_none(), "{short}");
        }
        let endless = [u64::MAX.to_le_bytes(), [1; 8]].concat();
        assert!(Vec::<u8>::read(&mut Reader::new(&endless)).is_none());
        assert!(bool::read(&mut Reader::new(&[2])).is_none());
    }

    #[test]
    fn a_file_is_opened_only_as_it_was_sealed() {
        let kind = Kind { format: b"impasto-of-tests", version: 3, name: "test" };
        let own = identity(["mine", "too"]);
        assert_ne!(own, identity(["minetoo"]));
        let file = file_of_state(kind, &own, b"state");
        assert_eq!(state_of_file(kind, &own, &file), Ok(&b"state"[..]));
        assert_eq!(state_of_file(kind, &identity(["yours"]), &file), Err(SavedError::Other));
        let newer = Kind { version: 4, ..kind };
        let version = SavedError::Version { kind: "test", found: 3, read: 4 };
        assert_eq!(state_of_file(newer, &own, &file), Err(version));
        for cut in 0..file.len() {
            assert_eq!(state_of_file(kind, &own, &file[..cut]), Err(SavedError::Damaged), "{cut}");
        }
        for at in 0..file.len() {
            let mut changed = file.clone();
            changed[at] ^= 4;
            assert!(state_of_file(kind, &own, &changed).is_err(), "{at}");
        }
        let foreign = SavedError::Foreign("test");
        assert_eq!(state_of_file(kind, &own, b"a picture"), Err(foreign));
    }
}
