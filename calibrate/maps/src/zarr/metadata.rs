//! The description of an array, `zarr.json`.

use serde_json::{Map, Value};

use super::chain::{Chain, named};
use super::fault::ZarrFault;
use crate::numbers::NumberType;

/// Most bytes of an unpacked chunk: a chunk is held in memory as a whole.
const MOST_CHUNK_BYTES: usize = 1 << 29;

/// Most chunks of a shard, whose index is read as a whole.
const MOST_CHUNKS: usize = 1 << 24;

/// Description of an array of numbers.
#[derive(Debug, Clone)]
pub(crate) struct ArrayMetadata {
    pub(crate) shape: Vec<usize>,
    pub(crate) number_type: NumberType,
    /// Size of the chunks that are unpacked one by one.
    pub(crate) chunk: Vec<usize>,
    pub(crate) chain: Chain,
    /// Chunks of a shard along each axis, and whether the index stands at the end; `None` where each
    /// chunk is a file.
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
    /// Reads the description of an array.
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
                if inner.len() != axes
                    || outer.len() != axes
                    || !outer
                        .iter()
                        .zip(&inner)
                        .all(|(outer, inner): (&usize, &usize)| *inner > 0 && outer % inner == 0)
                {
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
        let bytes =
            |sizes: &[usize]| sizes.iter().try_fold(number_type.bytes(), |a, b| a.checked_mul(*b));
        if bytes(&chunk).is_none_or(|bytes| bytes > MOST_CHUNK_BYTES) || bytes(&shape).is_none() {
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

/// Checks that the index of shards is one of plain numbers with a checksum; tells whether it stands
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

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

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
    }
}
