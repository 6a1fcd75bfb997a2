//! Shards: files that hold many chunks and an index of their places.

use super::chain::without_checksum;
use super::fault::ZarrFault;

/// Bytes of the place of a chunk: offset and length.
const ENTRY: usize = 16;
/// Bytes of the checksum after the index.
const SUM: usize = 4;

/// Bytes of an index of `chunks` places, checksum included.
pub(crate) fn index_bytes(chunks: usize) -> usize {
    chunks * ENTRY + SUM
}

/// Places of chunks in a shard: offset and length, `None` for chunks that hold the fill value.
pub(crate) fn places(index: Vec<u8>) -> Result<Vec<Option<(u64, u64)>>, ZarrFault> {
    let index = without_checksum(index)?;
    let (numbers, _) = index.as_chunks::<8>();
    let numbers: Vec<u64> = numbers.iter().map(|&bytes| u64::from_le_bytes(bytes)).collect();
    let (pairs, _) = numbers.as_chunks::<2>();
    let is_there = |pair: &[u64; 2]| *pair != [u64::MAX; 2];
    Ok(pairs.iter().map(|pair| is_there(pair).then_some((pair[0], pair[1]))).collect())
}

/// A shard that is put together in memory. Chunks stand in the order in which they are added, the
/// index stands at the end.
#[derive(Debug)]
pub(crate) struct ShardBuilder {
    bytes: Vec<u8>,
    places: Vec<[u64; 2]>,
}

impl ShardBuilder {
    /// A shard of `chunks` chunks, none of which is there yet.
    pub(crate) fn new(chunks: usize) -> Self {
        Self { bytes: Vec::new(), places: vec![[u64::MAX; 2]; chunks] }
    }

    /// Adds the packed chunk with the number `at` in the order of rows.
    pub(crate) fn add(&mut self, at: usize, packed: &[u8]) {
        self.places[at] = [self.bytes.len() as u64, packed.len() as u64];
        self.bytes.extend_from_slice(packed);
    }

    /// Bytes of the file.
    pub(crate) fn finish(mut self) -> Vec<u8> {
        let index: Vec<u8> = self.places.iter().flatten().flat_map(|n| n.to_le_bytes()).collect();
        self.bytes.extend_from_slice(&index);
        self.bytes.extend(crc32c::crc32c(&index).to_le_bytes());
        self.bytes
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_index_gives_the_places_of_the_chunks() {
        let mut shard = ShardBuilder::new(3);
        shard.add(2, b"two");
        shard.add(0, b"zero");
        let bytes = shard.finish();
        assert_eq!(bytes.len(), 7 + index_bytes(3));
        let index = bytes[7..].to_vec();
        assert_eq!(places(index).unwrap(), [Some((3, 4)), None, Some((0, 3))]);
        let mut damaged = bytes[7..].to_vec();
        damaged[0] ^= 1;
        assert!(places(damaged).is_err(), "the checksum does not fit");
    }
}
