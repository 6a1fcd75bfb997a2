//! An array on a disk, read chunk by chunk.

use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};

use serde_json::Value;

use super::fault::ZarrFault;
use super::metadata::ArrayMetadata;
use super::shard::{index_bytes, places};

/// An array in a folder.
#[derive(Debug)]
pub(crate) struct ZarrArray {
    pub(crate) folder: PathBuf,
    pub(crate) about: ArrayMetadata,
}

/// A chunk that cannot be read.
#[derive(Debug)]
pub(crate) enum ChunkError {
    /// The operating system cannot read it.
    Io(PathBuf, io::Error),
    /// It is damaged.
    Fault(PathBuf, ZarrFault),
}

impl ZarrArray {
    /// The array that `document`, the `zarr.json` of `folder`, describes.
    pub(crate) fn new(folder: &Path, document: &Value) -> Result<Self, ZarrFault> {
        Ok(Self { folder: folder.to_owned(), about: ArrayMetadata::of(document)? })
    }

    /// Distance in numbers between neighbours along each axis of an unpacked chunk.
    pub(crate) fn strides(&self) -> Vec<usize> {
        let axes = self.about.chunk.len();
        let order = self.about.chain.transpose.clone().unwrap_or_else(|| (0..axes).collect());
        let mut strides = vec![0; axes];
        let mut stride = 1;
        for &axis in order.iter().rev() {
            strides[axis] = stride;
            stride *= self.about.chunk[axis];
        }
        strides
    }

    fn chunk_bytes(&self) -> usize {
        self.about.chunk.iter().product::<usize>() * self.about.number_type.bytes()
    }

    fn file(&self, at: &[usize]) -> PathBuf {
        let numbers: Vec<String> = at.iter().map(usize::to_string).collect();
        let mut key = numbers.join(&self.about.separator.to_string());
        if self.about.has_prefix {
            key = if at.is_empty() {
                "c".to_owned()
            } else {
                format!("c{}{key}", self.about.separator)
            };
        }
        self.folder.join(key)
    }

    /// Numbers of the chunk `at` as bytes; `None` if it holds the fill value.
    pub(crate) fn chunk(&self, at: &[usize]) -> Result<Option<Vec<u8>>, ChunkError> {
        let Some((counts, at_end)) = &self.about.shard else {
            let file = self.file(at);
            let mut stored = Vec::new();
            let opened = File::open(&file);
            // One byte more than fits, so that a wrong file takes no memory.
            let most = self.most_stored() as u64 + 1;
            return match opened.and_then(|opened| opened.take(most).read_to_end(&mut stored)) {
                Ok(_) => self.unpacked(file, stored),
                Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
                Err(error) => Err(ChunkError::Io(file, error)),
            };
        };
        let shard: Vec<usize> = at.iter().zip(counts).map(|(at, count)| at / count).collect();
        let file = self.file(&shard);
        let inside = at.iter().zip(counts).fold(0, |sum, (at, count)| sum * count + at % count);
        let chunks = counts.iter().product();
        let most = self.most_stored() as u64;
        match stored_in_shard(&file, (chunks, most), *at_end, inside) {
            Ok(Some(Ok(stored))) => self.unpacked(file, stored),
            Ok(Some(Err(fault))) => Err(ChunkError::Fault(file, fault)),
            Ok(None) => Ok(None),
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
            Err(error) => Err(ChunkError::Io(file, error)),
        }
    }

    fn most_stored(&self) -> usize {
        self.about.chain.most_stored(self.chunk_bytes())
    }

    fn unpacked(&self, file: PathBuf, stored: Vec<u8>) -> Result<Option<Vec<u8>>, ChunkError> {
        let most = self.most_stored();
        if stored.len() > most {
            let problem = format!("a chunk has more than {most} stored bytes");
            return Err(ChunkError::Fault(file, ZarrFault::damaged(problem)));
        }
        let unpacked = self.about.chain.unpack(stored, self.chunk_bytes());
        unpacked.map(Some).map_err(|fault| ChunkError::Fault(file, fault))
    }
}

type Stored = Option<Result<Vec<u8>, ZarrFault>>;

/// Stored bytes of the chunk `inside` a shard of `chunks` chunks, of at most `most` bytes each.
fn stored_in_shard(
    file: &Path,
    (chunks, most): (usize, u64),
    at_end: bool,
    inside: usize,
) -> io::Result<Stored> {
    let mut opened = File::open(file)?;
    let length = opened.metadata()?.len();
    let size = index_bytes(chunks) as u64;
    if length < size {
        let problem = format!("has {length} bytes, fewer than its index of {size}");
        return Ok(Some(Err(ZarrFault::damaged(problem))));
    }
    let mut read = |start: u64, bytes: u64| -> io::Result<Vec<u8>> {
        opened.seek(SeekFrom::Start(start))?;
        let mut found = vec![0; usize::try_from(bytes).map_err(io::Error::other)?];
        opened.read_exact(&mut found)?;
        Ok(found)
    };
    let index = read(if at_end { length - size } else { 0 }, size)?;
    let place = match places(index) {
        Ok(places) => places.get(inside).copied().flatten(),
        Err(fault) => return Ok(Some(Err(fault))),
    };
    let Some((start, bytes)) = place else { return Ok(None) };
    if start.checked_add(bytes).is_none_or(|end| end > length) {
        let problem = format!("its index names bytes {start} to {start} + {bytes} of {length}");
        return Ok(Some(Err(ZarrFault::damaged(problem))));
    }
    if bytes > most {
        let problem = format!("its index gives a chunk {bytes} bytes, expected at most {most}");
        return Ok(Some(Err(ZarrFault::damaged(problem))));
    }
    read(start, bytes).map(|stored| Some(Ok(stored)))
}

#[cfg(test)]
mod tests {
    use std::io::Write;

    use serde_json::json;

    use super::*;

    #[test]
    fn an_index_decides_no_memory() {
        let folder = tempfile::tempdir().unwrap();
        let index = json!([{"name": "bytes", "configuration": {"endian": "little"}}, "crc32c"]);
        let settings = json!({"chunk_shape": [4], "codecs": ["bytes"], "index_codecs": index});
        let array = ZarrArray::new(
            folder.path(),
            &json!({
                "shape": [8], "data_type": "uint8",
                "chunk_grid": {"name": "regular", "configuration": {"chunk_shape": [8]}},
                "codecs": [{"name": "sharding_indexed", "configuration": settings}],
            }),
        )
        .unwrap();
        std::fs::create_dir(folder.path().join("c")).unwrap();
        let mut file = File::create(folder.path().join("c/0")).unwrap();
        file.write_all(&[1, 2, 3, 4]).unwrap();
        // The second chunk has half a terabyte by its index, and the file has it.
        file.set_len(1 << 40).unwrap();
        file.seek(SeekFrom::End(0)).unwrap();
        let places = [0_u64, 4, 8, 1 << 39].map(u64::to_le_bytes).concat();
        file.write_all(&places).unwrap();
        file.write_all(&crc32c::crc32c(&places).to_le_bytes()).unwrap();
        assert_eq!(array.chunk(&[0]).unwrap(), Some(vec![1, 2, 3, 4]));
        let Err(ChunkError::Fault(path, fault)) = array.chunk(&[1]) else { panic!("it is read") };
        assert!(path.ends_with("c/0") && fault.problem.contains("expected at most 4"), "{fault:?}");
    }
}
