//! Values as bytes: whole numbers with the lowest byte first, floats by their bits.

use glam::Vec3;
use paint::layer::Cell;

/// A value that is stored as bytes and read again to the bit.
pub(crate) trait Stored: Sized {
    /// Appends it to `bytes`.
    fn store(&self, bytes: &mut Vec<u8>);

    /// Reads one; none if the bytes end before, or are no such value.
    fn read(from: &mut Reader<'_>) -> Option<Self>;
}

/// Bytes that are read from the front.
#[derive(Debug)]
pub(crate) struct Reader<'b> {
    rest: &'b [u8],
}

impl<'b> Reader<'b> {
    pub(crate) fn new(bytes: &'b [u8]) -> Self {
        Self { rest: bytes }
    }

    /// Whether all bytes have been read.
    pub(crate) fn is_empty(&self) -> bool {
        self.rest.is_empty()
    }

    fn take<const N: usize>(&mut self) -> Option<[u8; N]> {
        let (bytes, rest) = self.rest.split_first_chunk()?;
        self.rest = rest;
        Some(*bytes)
    }
}

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

numbers!(u8, u16, u32, u64, f32, f64);

/// Stores a structure field by field; a field that is not listed does not compile.
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
        // A value has a byte at least: a wrong count does not reserve memory.
        let fits = count <= from.rest.len() as u64;
        if fits { (0..count).map(|_| T::read(from)).collect() } else { None }
    }
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
}
