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
            let stored = match std::fs::read(&file) {
                Ok(stored) => stored,
                Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
                Err(error) => return Err(ChunkError::Io(file, error)),
            };
            return self.unpacked(file, stored);
        };
        let shard: Vec<usize> = at.iter().zip(counts).map(|(at, count)| at / count).collect();
        let file = self.file(&shard);
        let inside = at.iter().zip(counts).fold(0, |sum, (at, count)| sum * count + at % count);
        let chunks = counts.iter().product();
        match stored_in_shard(&file, chunks, *at_end, inside) {
            Ok(Some(Ok(stored))) => self.unpacked(file, stored),
            Ok(Some(Err(fault))) => Err(ChunkError::Fault(file, fault)),
            Ok(None) => Ok(None),
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
            Err(error) => Err(ChunkError::Io(file, error)),
        }
    }

    fn unpacked(&self, file: PathBuf, stored: Vec<u8>) -> Result<Option<Vec<u8>>, ChunkError> {
        let unpacked = self.about.chain.unpack(stored, self.chunk_bytes());
        unpacked.map(Some).map_err(|fault| ChunkError::Fault(file, fault))
    }
}

type Stored = Option<Result<Vec<u8>, ZarrFault>>;

/// Stored bytes of the chunk `inside` a shard.
fn stored_in_shard(file: &Path, chunks: usize, at_end: bool, inside: usize) -> io::Result<Stored> {
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
    read(start, bytes).map(|stored| Some(Ok(stored)))
}
