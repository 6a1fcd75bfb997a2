//! Codecs that turn the numbers of a chunk into stored bytes and back.

use std::io::{Read, Write};

use serde_json::Value;

use super::fault::ZarrFault;
use crate::numbers::ByteOrder;

/// Level at which chunks are packed: higher ones take longer and save little.
pub(crate) const GZIP_LEVEL: u32 = 4;

/// A step from bytes to bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Step {
    Gzip,
    Zstd,
    Crc32c,
}

/// Codecs of a chunk that end in plain numbers.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Chain {
    /// Order of the axes in the stored chunk, where it differs.
    pub(crate) transpose: Option<Vec<usize>>,
    pub(crate) byte_order: ByteOrder,
    steps: Vec<Step>,
}

/// Name and settings of a codec, which may be written as a name alone.
pub(crate) fn named(codec: &Value) -> (&str, &Value) {
    match codec {
        Value::String(name) => (name, &Value::Null),
        other => (other["name"].as_str().unwrap_or_default(), &other["configuration"]),
    }
}

impl Chain {
    /// Reads a list of codecs for numbers of `axes` axes.
    pub(crate) fn of(codecs: &[Value], axes: usize) -> Result<Self, ZarrFault> {
        let mut chain = Self { transpose: None, byte_order: ByteOrder::Little, steps: Vec::new() };
        let mut are_bytes = false;
        for codec in codecs {
            let (name, settings) = named(codec);
            match (name, are_bytes) {
                ("transpose", false) => chain.transpose = Some(axes_of(&settings["order"], axes)?),
                ("bytes", false) => {
                    are_bytes = true;
                    chain.byte_order = match settings["endian"].as_str() {
                        Some("big") => ByteOrder::Big,
                        Some("little") | None => ByteOrder::Little,
                        Some(other) => {
                            return Err(ZarrFault::unread(format!("has the byte order `{other}`")));
                        }
                    };
                }
                ("gzip", true) => chain.steps.push(Step::Gzip),
                ("zstd", true) => chain.steps.push(Step::Zstd),
                ("crc32c", true) => chain.steps.push(Step::Crc32c),
                _ => {
                    let problem = format!(
                        "is packed by `{name}`, expected bytes, gzip, zstd, crc32c or sharding_indexed"
                    );
                    return Err(ZarrFault::unread(problem));
                }
            }
        }
        match are_bytes {
            true => Ok(chain),
            false => Err(ZarrFault::unread("has no codec `bytes`")),
        }
    }

    /// Most bytes that a stored chunk of `expected` bytes can have: packing may make noise larger.
    pub(crate) fn most_stored(&self, expected: usize) -> usize {
        self.steps.iter().fold(expected, |most, _| most.saturating_add(most / 8 + 4096))
    }

    /// Unpacks a stored chunk of `expected` bytes.
    pub(crate) fn unpack(&self, stored: Vec<u8>, expected: usize) -> Result<Vec<u8>, ZarrFault> {
        let mut bytes = stored;
        for (index, step) in self.steps.iter().enumerate().rev() {
            // Only the last step is known to give `expected` bytes; others are larger by a checksum
            // or by what packing adds to noise.
            let most = if index == 0 { expected } else { expected + expected / 8 + 4096 };
            bytes = match step {
                Step::Crc32c => without_checksum(bytes)?,
                Step::Gzip => read_all(flate2::read::MultiGzDecoder::new(&bytes[..]), most)?,
                Step::Zstd => {
                    let decoder = ruzstd::decoding::StreamingDecoder::new(&bytes[..]);
                    let decoder = decoder.map_err(|error| {
                        ZarrFault::damaged(format!("a chunk cannot be unpacked: {error}"))
                    })?;
                    read_all(decoder, most)?
                }
            };
        }
        match bytes.len() == expected {
            true => Ok(bytes),
            false => Err(ZarrFault::damaged(format!(
                "a chunk has {} bytes of numbers, expected {expected}",
                bytes.len()
            ))),
        }
    }
}

fn axes_of(order: &Value, axes: usize) -> Result<Vec<usize>, ZarrFault> {
    let order: Option<Vec<usize>> = order.as_array().and_then(|order| {
        order.iter().map(|axis| axis.as_u64().and_then(|axis| usize::try_from(axis).ok())).collect()
    });
    let order = order.unwrap_or_default();
    let mut sorted = order.clone();
    sorted.sort_unstable();
    match sorted.into_iter().eq(0..axes) {
        true => Ok(order),
        false => Err(ZarrFault::unread(format!("has the order of axes {order:?}"))),
    }
}

/// Reads at most one byte more than `most`, so that damage takes no memory.
fn read_all(reader: impl Read, most: usize) -> Result<Vec<u8>, ZarrFault> {
    let mut bytes = Vec::new();
    reader
        .take(most as u64 + 1)
        .read_to_end(&mut bytes)
        .map_err(|error| ZarrFault::damaged(format!("a chunk cannot be unpacked: {error}")))?;
    Ok(bytes)
}

/// Bytes without the CRC-32C at their end, which must fit.
pub(crate) fn without_checksum(mut bytes: Vec<u8>) -> Result<Vec<u8>, ZarrFault> {
    let Some((data, sum)) = bytes.split_last_chunk::<4>() else {
        return Err(ZarrFault::damaged("a chunk is too short for its checksum"));
    };
    if crc32c::crc32c(data) != u32::from_le_bytes(*sum) {
        return Err(ZarrFault::damaged("the checksum of a chunk does not fit its bytes"));
    }
    bytes.truncate(bytes.len() - 4);
    Ok(bytes)
}

/// Bytes packed by gzip, always to the same bytes: the head holds no time and no name.
pub(crate) fn packed(bytes: &[u8]) -> std::io::Result<Vec<u8>> {
    let level = flate2::Compression::new(GZIP_LEVEL);
    let mut encoder = flate2::GzBuilder::new().operating_system(255).write(Vec::new(), level);
    encoder.write_all(bytes)?;
    encoder.finish()
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    fn chain(codecs: Value) -> Result<Chain, ZarrFault> {
        Chain::of(codecs.as_array().unwrap(), 2)
    }

    #[test]
    fn packed_bytes_are_unpacked_and_damage_is_seen() {
        let chain = chain(json!([{"name": "bytes"}, {"name": "gzip"}, "crc32c"])).unwrap();
        let bytes: Vec<u8> = (0..4000_u32).map(|at| (at / 7 % 251) as u8).collect();
        let mut stored = packed(&bytes).unwrap();
        assert!(stored.len() < bytes.len() / 2, "packing saves space");
        let sum = crc32c::crc32c(&stored).to_le_bytes();
        stored.extend(sum);
        assert_eq!(chain.unpack(stored.clone(), 4000).unwrap(), bytes);
        let fault = chain.unpack(stored.clone(), 3999).unwrap_err();
        assert_eq!(fault.problem, "a chunk has 4000 bytes of numbers, expected 3999");
        stored[20] ^= 1;
        let fault = chain.unpack(stored, 4000).unwrap_err();
        assert!(fault.problem.contains("checksum"), "{fault:?}");
        assert!(chain.unpack(vec![1, 2], 4000).unwrap_err().problem.contains("too short"));
    }

    #[test]
    fn other_codecs_are_refused_by_name() {
        let fault = chain(json!([{"name": "bytes"}, {"name": "blosc"}])).unwrap_err();
        assert!(fault.problem.starts_with("is packed by `blosc`"), "{fault:?}");
        assert!(chain(json!([{"name": "gzip"}])).is_err(), "gzip packs bytes, not numbers");
        let order = json!([{"name": "transpose", "configuration": {"order": [0, 0]}}, "bytes"]);
        assert!(chain(order).is_err(), "an axis twice");
    }
}
