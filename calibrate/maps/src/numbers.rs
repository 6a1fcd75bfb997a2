//! Numbers as files store them, and their conversion to f32.

/// Type of the numbers of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NumberType {
    /// Unsigned, 8 bits.
    U8,
    /// Signed, 8 bits.
    I8,
    /// Signed, 16 bits.
    I16,
    /// Signed, 32 bits.
    I32,
    /// Signed, 64 bits.
    I64,
    /// Unsigned, 16 bits.
    U16,
    /// Unsigned, 32 bits.
    U32,
    /// Unsigned, 64 bits.
    U64,
    /// IEEE 754, 16 bits.
    F16,
    /// IEEE 754, 32 bits.
    F32,
    /// IEEE 754, 64 bits.
    F64,
}

/// Order of the bytes of a number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ByteOrder {
    /// The least significant byte comes first.
    Little,
    /// The most significant byte comes first.
    Big,
}

impl NumberType {
    /// Bytes of a number.
    #[must_use]
    pub const fn bytes(self) -> usize {
        match self {
            Self::U8 | Self::I8 => 1,
            Self::I16 | Self::U16 | Self::F16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::I64 | Self::U64 | Self::F64 => 8,
        }
    }

    /// Whether the numbers are integers.
    #[must_use]
    pub const fn is_whole(self) -> bool {
        !matches!(self, Self::F16 | Self::F32 | Self::F64)
    }

    /// Largest number of an unsigned type of at most 16 bits. Detectors saturate there.
    #[must_use]
    pub const fn full_scale(self) -> Option<f64> {
        match self {
            Self::U8 => Some(255.0),
            Self::U16 => Some(65535.0),
            _ => None,
        }
    }

    /// Converts the numbers in `bytes` and writes them to `values[0]`, `values[stride]` and so on.
    /// This rounds numbers that f32 does not hold, and stops when `bytes` or `values` end.
    pub(crate) fn convert(self, order: ByteOrder, bytes: &[u8], values: &mut [f32], stride: usize) {
        macro_rules! convert {
            ($type:ty) => {
                match order {
                    ByteOrder::Little => {
                        each(bytes, values, stride, |b| <$type>::from_le_bytes(b) as f32)
                    }
                    ByteOrder::Big => {
                        each(bytes, values, stride, |b| <$type>::from_be_bytes(b) as f32)
                    }
                }
            };
        }
        match self {
            Self::U8 => each(bytes, values, stride, |[byte]: [u8; 1]| f32::from(byte)),
            Self::I8 => convert!(i8),
            Self::I16 => convert!(i16),
            Self::I32 => convert!(i32),
            Self::I64 => convert!(i64),
            Self::U16 => convert!(u16),
            Self::U32 => convert!(u32),
            Self::U64 => convert!(u64),
            Self::F32 => convert!(f32),
            Self::F64 => convert!(f64),
            Self::F16 => match order {
                ByteOrder::Little => {
                    each(bytes, values, stride, |b| half::f16::from_le_bytes(b).to_f32());
                }
                ByteOrder::Big => {
                    each(bytes, values, stride, |b| half::f16::from_be_bytes(b).to_f32());
                }
            },
        }
    }

    /// Converts `bytes` to f64 without rounding integers below 2^53. Use this for coordinates.
    #[cfg(feature = "files")]
    pub(crate) fn convert_exactly(self, order: ByteOrder, bytes: &[u8]) -> Vec<f64> {
        macro_rules! convert {
            ($type:ty) => {
                bytes
                    .as_chunks()
                    .0
                    .iter()
                    .map(|&b| match order {
                        ByteOrder::Little => <$type>::from_le_bytes(b) as f64,
                        ByteOrder::Big => <$type>::from_be_bytes(b) as f64,
                    })
                    .collect()
            };
        }
        match self {
            Self::I32 => convert!(i32),
            Self::I64 => convert!(i64),
            Self::U32 => convert!(u32),
            Self::U64 => convert!(u64),
            Self::F64 => convert!(f64),
            // The others fit into f32.
            Self::U8 | Self::I8 | Self::I16 | Self::U16 | Self::F16 | Self::F32 => {
                let mut values = vec![0.0; bytes.len() / self.bytes()];
                self.convert(order, bytes, &mut values, 1);
                values.into_iter().map(f64::from).collect()
            }
        }
    }
}

fn each<const N: usize>(
    bytes: &[u8],
    values: &mut [f32],
    stride: usize,
    number: impl Fn([u8; N]) -> f32,
) {
    let (numbers, _) = bytes.as_chunks::<N>();
    if stride == 1 {
        for (value, &bytes) in values.iter_mut().zip(numbers) {
            *value = number(bytes);
        }
    } else {
        for (value, &bytes) in values.iter_mut().step_by(stride).zip(numbers) {
            *value = number(bytes);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_type_is_converted_in_both_orders() {
        macro_rules! check {
            ($kind:expr, $type:ty, $values:expr) => {
                let values: &[$type] = &$values;
                for order in [ByteOrder::Little, ByteOrder::Big] {
                    let bytes: Vec<u8> = values
                        .iter()
                        .flat_map(|value| match order {
                            ByteOrder::Little => value.to_le_bytes().to_vec(),
                            ByteOrder::Big => value.to_be_bytes().to_vec(),
                        })
                        .collect();
                    assert_eq!(bytes.len(), values.len() * $kind.bytes(), "{:?}", $kind);
                    let mut found = vec![0.0; values.len()];
                    $kind.convert(order, &bytes, &mut found, 1);
                    let expected: Vec<f32> = values.iter().map(|&value| value as f32).collect();
                    assert_eq!(found, expected, "{:?} {order:?}", $kind);
                    let exact = $kind.convert_exactly(order, &bytes);
                    let expected: Vec<f64> = values.iter().map(|&value| value as f64).collect();
                    assert_eq!(exact, expected, "{:?} {order:?}", $kind);
                }
            };
        }
        check!(NumberType::U8, u8, [0, 7, 255]);
        check!(NumberType::I8, i8, [-128, 7, 127]);
        check!(NumberType::I16, i16, [-32768, -2, 300]);
        check!(NumberType::I32, i32, [i32::MIN, -70_000, 9]);
        check!(NumberType::I64, i64, [-5_000_000_000, 16_777_217, 2]);
        check!(NumberType::U16, u16, [0, 258, 65535]);
        check!(NumberType::U32, u32, [0, 70_000, u32::MAX]);
        check!(NumberType::U64, u64, [1, 1 << 52, 3]);
        check!(NumberType::F32, f32, [0.25, -1e-3, 3.5e8]);
        check!(NumberType::F64, f64, [0.25, -1.5, 400.5]);
    }

    #[test]
    fn half_numbers_are_converted() {
        let mut found = [0.0; 2];
        NumberType::F16.convert(ByteOrder::Little, &[0x00, 0x38, 0x00, 0xc0], &mut found, 1);
        assert_eq!(found, [0.5, -2.0]);
        NumberType::F16.convert(ByteOrder::Big, &[0x38, 0x00, 0xc0, 0x00], &mut found, 1);
        assert_eq!(found, [0.5, -2.0]);
    }

    #[test]
    fn a_stride_leaves_what_lies_between() {
        let mut found = [9.0; 5];
        NumberType::U16.convert(ByteOrder::Little, &[1, 0, 2, 0, 3, 0], &mut found, 2);
        assert_eq!(found, [1.0, 9.0, 2.0, 9.0, 3.0]);
    }
}
