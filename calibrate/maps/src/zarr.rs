//! Arrays of Zarr, format 3. We support the part of the format that scans and maps need.
//!
//! You find here the description `zarr.json`, the codecs, arrays read chunk by chunk, and shards,
//! which hold many chunks and an index of their places. Faults do not name a path, so add it.

use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use serde_json::{Map, Value, json};

use crate::numbers::{ByteOrder, NumberType};

#[derive(Debug)]
pub(crate) struct ZarrArray {
    pub(crate) folder: PathBuf,
    pub(crate) about: ArrayMetadata,
}

/// We cannot read a chunk.
#[derive(Debug)]
pub(crate) enum ChunkError {
    Io(PathBuf, io::Error),
    Fault(PathBuf, ZarrFault),
}

impl ZarrArray {
    /// The array in `folder`. `document` is its `zarr.json`.
    pub(crate) fn new(folder: &Path, document: &Value) -> Result<Self, ZarrFault> {
        Ok(Self { folder: folder.to_owned(), about: ArrayMetadata::of(document)? })
    }

    /// For each axis, how many numbers lie between neighbours in an unpacked chunk.
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

    /// Numbers of the chunk `at` as bytes, or `None` if it holds only the fill value.
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

/// Stored bytes of the chunk with the number `inside` in a shard. The shard has `chunks` chunks of
/// at most `most` bytes each.
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
    let index = read_part(&mut opened, if at_end { length - size } else { 0 }, size)?;
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
    read_part(&mut opened, start, bytes).map(|stored| Some(Ok(stored)))
}

fn read_part(opened: &mut File, start: u64, bytes: u64) -> io::Result<Vec<u8>> {
    opened.seek(SeekFrom::Start(start))?;
    let mut found = vec![0; usize::try_from(bytes).map_err(io::Error::other)?];
    opened.read_exact(&mut found)?;
    Ok(found)
}

/// Bytes of the place of a chunk: offset and length.
const ENTRY: usize = 16;
/// Bytes of the checksum after the index.
const SUM: usize = 4;

/// Bytes of an index of `chunks` places, checksum included.
pub(crate) fn index_bytes(chunks: usize) -> usize {
    chunks * ENTRY + SUM
}

/// Reads the places of chunks in a shard, offset and length. A chunk that holds only the fill value
/// has `None`.
pub(crate) fn places(index: Vec<u8>) -> Result<Vec<Option<(u64, u64)>>, ZarrFault> {
    let index = without_checksum(index)?;
    let (numbers, _) = index.as_chunks::<8>();
    let numbers: Vec<u64> = numbers.iter().map(|&bytes| u64::from_le_bytes(bytes)).collect();
    let (pairs, _) = numbers.as_chunks::<2>();
    Ok(pairs.iter().map(|pair| is_there(pair).then_some((pair[0], pair[1]))).collect())
}

fn is_there(pair: &[u64; 2]) -> bool {
    *pair != [u64::MAX; 2]
}

/// Builds a shard in memory. Chunks stand in the order in which you add them, and the index stands
/// at the end.
#[derive(Debug)]
pub(crate) struct ShardBuilder {
    bytes: Vec<u8>,
    places: Vec<[u64; 2]>,
}

impl ShardBuilder {
    pub(crate) fn new(chunks: usize) -> Self {
        Self { bytes: Vec::new(), places: vec![[u64::MAX; 2]; chunks] }
    }

    /// Adds the packed chunk with the number `at`. We count chunks row by row.
    pub(crate) fn add(&mut self, at: usize, packed: &[u8]) {
        self.places[at] = [self.bytes.len() as u64, packed.len() as u64];
        self.bytes.extend_from_slice(packed);
    }

    pub(crate) fn finish(mut self) -> Vec<u8> {
        let index: Vec<u8> = self.places.iter().flatten().flat_map(|n| n.to_le_bytes()).collect();
        self.bytes.extend_from_slice(&index);
        self.bytes.extend(crc32c::crc32c(&index).to_le_bytes());
        self.bytes
    }
}

/// Most bytes of an unpacked chunk, because we hold a whole chunk in memory.
const MOST_CHUNK_BYTES: usize = 1 << 29;

/// Most chunks of a shard, because we read the whole index at once.
const MOST_CHUNKS: usize = 1 << 24;

#[derive(Debug, Clone)]
pub(crate) struct ArrayMetadata {
    pub(crate) shape: Vec<usize>,
    pub(crate) number_type: NumberType,
    /// Size of the chunks that we unpack one by one.
    pub(crate) chunk: Vec<usize>,
    pub(crate) chain: Chain,
    /// Chunks of a shard along each axis, and whether the index stands at the end. If each chunk is
    /// a file, this is `None`.
    pub(crate) shard: Option<(Vec<usize>, bool)>,
    /// Text between the numbers of a chunk's key, and whether keys begin with `c`.
    pub(crate) separator: char,
    pub(crate) has_prefix: bool,
    pub(crate) fill: f64,
    pub(crate) dimensions: Vec<String>,
    pub(crate) attributes: Map<String, Value>,
}

fn sizes(list: &Value, what: &str) -> Result<Vec<usize>, ZarrFault> {
    let sizes: Option<Vec<usize>> = list.as_array().and_then(|list| {
        list.iter().map(|size| size.as_u64().and_then(|size| usize::try_from(size).ok())).collect()
    });
    sizes.ok_or_else(|| ZarrFault::unread(format!("has no sizes in `{what}`")))
}

fn number_type(name: &Value) -> Result<NumberType, ZarrFault> {
    Ok(match name.as_str() {
        Some("int8") => NumberType::I8,
        Some("uint8" | "bool") => NumberType::U8,
        Some("int16") => NumberType::I16,
        Some("uint16") => NumberType::U16,
        Some("int32") => NumberType::I32,
        Some("uint32") => NumberType::U32,
        Some("int64") => NumberType::I64,
        Some("uint64") => NumberType::U64,
        Some("float16") => NumberType::F16,
        Some("float32") => NumberType::F32,
        Some("float64") => NumberType::F64,
        _ => return Err(ZarrFault::unread(format!("has the data type {name}, no real numbers"))),
    })
}

fn fill_value(value: &Value) -> f64 {
    match value {
        Value::Number(number) => number.as_f64().unwrap_or(f64::NAN),
        Value::Bool(set) => f64::from(u8::from(*set)),
        Value::String(name) => name.parse().unwrap_or(f64::NAN),
        _ => f64::NAN,
    }
}

impl ArrayMetadata {
    pub(crate) fn of(document: &Value) -> Result<Self, ZarrFault> {
        let shape = sizes(&document["shape"], "shape")?;
        let axes = shape.len();
        let grid = &document["chunk_grid"];
        if grid["name"] != "regular" {
            return Err(ZarrFault::unread(format!("has the chunk grid {}", grid["name"])));
        }
        let outer = sizes(&grid["configuration"]["chunk_shape"], "chunk_shape")?;
        let none = Vec::new();
        let codecs = document["codecs"].as_array().unwrap_or(&none);
        let number_type = number_type(&document["data_type"])?;
        let (chunk, chain, shard) = match codecs.first().map(named) {
            Some(("sharding_indexed", settings)) if codecs.len() == 1 => {
                let inner = sizes(&settings["chunk_shape"], "chunk_shape")?;
                let codecs = settings["codecs"].as_array().unwrap_or(&none);
                let chain = Chain::of(codecs, axes)?;
                let at_end = check_index(settings)?;
                let is_whole = inner.len() == axes
                    && outer.len() == axes
                    && !inner.contains(&0)
                    && !outer.contains(&0)
                    && outer.iter().zip(&inner).all(|(outer, inner)| outer % inner == 0);
                if !is_whole {
                    let problem = format!("has shards of {outer:?} and chunks of {inner:?}");
                    return Err(ZarrFault::unread(problem));
                }
                let counts: Vec<usize> =
                    outer.iter().zip(&inner).map(|(outer, inner)| outer / inner).collect();
                let chunks = counts.iter().try_fold(1_usize, |all, count| all.checked_mul(*count));
                if chunks.is_none_or(|chunks| chunks > MOST_CHUNKS) {
                    let problem =
                        format!("has {counts:?} chunks in a shard, more than {MOST_CHUNKS}");
                    return Err(ZarrFault::unread(problem));
                }
                (inner, chain, Some((counts, at_end)))
            }
            _ => (outer, Chain::of(codecs, axes)?, None),
        };
        if chunk.len() != axes || chunk.contains(&0) || shape.contains(&0) {
            let problem = format!("has the shape {shape:?} and chunks of {chunk:?}");
            return Err(ZarrFault::unread(problem));
        }
        let [of_chunk, of_shape] = [&chunk, &shape].map(|sizes| {
            sizes.iter().try_fold(number_type.bytes(), |a: usize, b| a.checked_mul(*b))
        });
        if of_chunk.is_none_or(|bytes| bytes > MOST_CHUNK_BYTES) || of_shape.is_none() {
            return Err(ZarrFault {
                problem: format!("has chunks of {chunk:?} numbers, more than 512 MB"),
                way_out: "save it with smaller chunks: xarray's chunk({\"y\": 128, \"x\": 128})",
            });
        }
        let keys = &document["chunk_key_encoding"];
        let is_v2 = keys["name"] == "v2";
        let separator = match keys["configuration"]["separator"].as_str() {
            Some(".") => '.',
            None if is_v2 => '.',
            _ => '/',
        };
        let names = document["dimension_names"].as_array().unwrap_or(&none);
        Ok(Self {
            shape,
            number_type,
            chunk,
            chain,
            shard,
            separator,
            has_prefix: !is_v2,
            fill: fill_value(&document["fill_value"]),
            dimensions: names
                .iter()
                .map(|name| name.as_str().unwrap_or_default().to_owned())
                .collect(),
            attributes: document["attributes"].as_object().cloned().unwrap_or_default(),
        })
    }
}

/// Checks that the index of shards holds plain numbers with a checksum. Returns whether it stands
/// at the end.
fn check_index(settings: &Value) -> Result<bool, ZarrFault> {
    let none = Vec::new();
    let codecs = settings["index_codecs"].as_array().unwrap_or(&none);
    let names: Vec<&str> = codecs.iter().map(|codec| named(codec).0).collect();
    let is_big = codecs.first().is_some_and(|codec| named(codec).1["endian"] == "big");
    if names != ["bytes", "crc32c"] || is_big {
        return Err(ZarrFault::unread(format!("has shards with an index packed by {names:?}")));
    }
    Ok(settings["index_location"] != "start")
}

#[derive(Debug, Clone)]
pub(crate) struct ArrayDocument<'d> {
    pub(crate) shape: &'d [usize],
    /// Name of the data type, e.g. `float16`, `uint8` or `string`.
    pub(crate) data_type: &'d str,
    /// Size of a shard, or of a chunk if there are no shards.
    pub(crate) outer: &'d [usize],
    /// Size of the chunks of a shard, or `None` if each chunk is a file.
    pub(crate) inner: Option<&'d [usize]>,
    pub(crate) fill: Value,
    pub(crate) dimensions: &'d [&'d str],
    pub(crate) attributes: Map<String, Value>,
}

impl<'d> ArrayDocument<'d> {
    /// Describes the array of coordinates along the dimension `name`, in one chunk.
    pub(crate) fn coordinate(
        name: &'d &'d str,
        length: &'d usize,
        data_type: &'d str,
        attributes: Map<String, Value>,
    ) -> Self {
        let length = std::slice::from_ref(length);
        Self {
            shape: length,
            data_type,
            outer: length,
            inner: None,
            fill: if data_type == "string" { json!("") } else { json!(0) },
            dimensions: std::slice::from_ref(name),
            attributes,
        }
    }

    pub(crate) fn json(&self) -> Value {
        let bytes = match self.data_type {
            "string" => json!({"name": "vlen-utf8"}),
            "uint8" => json!({"name": "bytes"}),
            _ => json!({"name": "bytes", "configuration": {"endian": "little"}}),
        };
        let packing = json!({"name": "gzip", "configuration": {"level": GZIP_LEVEL}});
        let codecs = match self.inner {
            None => json!([bytes]),
            Some(inner) => json!([{
                "name": "sharding_indexed",
                "configuration": {
                    "chunk_shape": inner,
                    "codecs": [bytes, packing],
                    "index_codecs": [
                        {"name": "bytes", "configuration": {"endian": "little"}},
                        {"name": "crc32c"}
                    ],
                    "index_location": "end"
                }
            }]),
        };
        json!({
            "shape": self.shape,
            "data_type": self.data_type,
            "chunk_grid": {"name": "regular", "configuration": {"chunk_shape": self.outer}},
            "chunk_key_encoding": {"name": "default", "configuration": {"separator": "/"}},
            "fill_value": self.fill,
            "codecs": codecs,
            "attributes": self.attributes,
            "dimension_names": self.dimensions,
            "zarr_format": 3,
            "node_type": "array",
            "storage_transformers": []
        })
    }
}

/// The `zarr.json` of a group with the descriptions of its arrays, so that readers need only this
/// file.
pub(crate) fn group_document(
    attributes: Map<String, Value>,
    arrays: impl IntoIterator<Item = (String, Value)>,
) -> Value {
    let members: Map<String, Value> = arrays.into_iter().collect();
    json!({
        "attributes": attributes,
        "zarr_format": 3,
        "node_type": "group",
        "consolidated_metadata": {
            "kind": "inline",
            "must_understand": false,
            "metadata": members
        }
    })
}

/// We pack chunks at this level, because higher ones take longer and save little.
pub(crate) const GZIP_LEVEL: u32 = 4;

/// A codec that turns bytes into other bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Step {
    Gzip,
    Zstd,
    Crc32c,
}

/// Codecs that turn a stored chunk into plain numbers.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Chain {
    /// Order of the axes in the stored chunk, if it differs.
    pub(crate) transpose: Option<Vec<usize>>,
    pub(crate) byte_order: ByteOrder,
    steps: Vec<Step>,
}

/// Name and settings of a codec. A file may also state the name alone.
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

    /// Most bytes that a stored chunk of `expected` bytes can have. This allows a little more,
    /// because packing may make noise larger.
    pub(crate) fn most_stored(&self, expected: usize) -> usize {
        self.steps.iter().fold(expected, |most, _| most.saturating_add(most / 8 + 4096))
    }

    pub(crate) fn unpack(&self, stored: Vec<u8>, expected: usize) -> Result<Vec<u8>, ZarrFault> {
        let mut bytes = stored;
        for (index, step) in self.steps.iter().enumerate().rev() {
            // Only the last step is known to give `expected` bytes. Others are larger by a checksum or by
            // what packing adds to noise.
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

/// Checks the CRC-32C at the end of the bytes and removes it.
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

/// Packs bytes by gzip. The same bytes always give the same result, because the head holds no time
/// and no name.
pub(crate) fn packed(bytes: &[u8]) -> io::Result<Vec<u8>> {
    let level = flate2::Compression::new(GZIP_LEVEL);
    let mut encoder = flate2::GzBuilder::new().operating_system(255).write(Vec::new(), level);
    encoder.write_all(bytes)?;
    encoder.finish()
}

/// A fault and a remedy.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct ZarrFault {
    pub(crate) problem: String,
    pub(crate) way_out: &'static str,
}

/// Advice for arrays of a kind that we do not read. Without `drop_encoding` xarray would pack the
/// copy like the original.
const SAVE_AGAIN: &str =
    "copy it in Python: xarray.open_zarr(\"OLD\").drop_encoding().to_zarr(\"NEW\", zarr_format=3)";
/// Advice for arrays that are damaged.
const COPY_AGAIN: &str = "copy or write the array again";

impl ZarrFault {
    /// A kind of array that we do not read.
    pub(crate) fn unread(problem: impl Into<String>) -> Self {
        Self { problem: problem.into(), way_out: SAVE_AGAIN }
    }

    pub(crate) fn damaged(problem: impl Into<String>) -> Self {
        Self { problem: problem.into(), way_out: COPY_AGAIN }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;
    use std::io::Write;

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

    fn sharded(outer: &[u64], inner: &[u64]) -> Result<ArrayMetadata, ZarrFault> {
        let index = json!([{"name": "bytes", "configuration": {"endian": "little"}}, "crc32c"]);
        let settings = json!({"chunk_shape": inner, "codecs": ["bytes"], "index_codecs": index});
        ArrayMetadata::of(&json!({
            "shape": [9, 9, 9],
            "data_type": "uint8",
            "chunk_grid": {"name": "regular", "configuration": {"chunk_shape": outer}},
            "codecs": [{"name": "sharding_indexed", "configuration": settings}],
        }))
    }

    #[test]
    fn shards_of_too_many_chunks_are_refused() {
        let array = sharded(&[8, 8, 4], &[4, 8, 4]).unwrap();
        assert_eq!(array.shard, Some((vec![2, 1, 1], true)));
        for outer in [[1 << 33, 1 << 33, 1], [1 << 25, 1, 1]] {
            let fault = sharded(&outer, &[1, 1, 1]).unwrap_err();
            assert!(fault.problem.contains("chunks in a shard"), "{fault:?}");
        }
        for [outer, inner] in [[0, 4], [4, 0], [6, 4]] {
            let fault = sharded(&[8, 8, outer], &[4, 8, inner]).unwrap_err();
            assert!(fault.problem.contains("has shards of [8, 8, "), "{fault:?}");
        }
    }

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
