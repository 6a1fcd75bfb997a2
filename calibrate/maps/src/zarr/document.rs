//! Descriptions of arrays and groups that this program writes.

use serde_json::{Map, Value, json};

use super::chain::GZIP_LEVEL;

/// An array to be described.
#[derive(Debug, Clone)]
pub(crate) struct ArrayDocument<'d> {
    pub(crate) shape: &'d [usize],
    /// Name of the data type: `float16`, `uint8` and so on, or `string`.
    pub(crate) data_type: &'d str,
    /// Size of a shard, or of the chunk where there are no shards.
    pub(crate) outer: &'d [usize],
    /// Size of the chunks of a shard; `None` where each chunk is a file.
    pub(crate) inner: Option<&'d [usize]>,
    pub(crate) fill: Value,
    pub(crate) dimensions: &'d [&'d str],
    pub(crate) attributes: Map<String, Value>,
}

impl<'d> ArrayDocument<'d> {
    /// The array of the places along the dimension `name`, in one chunk.
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

    /// The `zarr.json` of the array.
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

/// The `zarr.json` of a group with the descriptions of its arrays, so that readers open one file.
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
