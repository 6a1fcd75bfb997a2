//! The document of a glTF file: the keys that we read, and the container of a `.glb` file. Every
//! key is optional here. We check values where we use them.

use std::collections::BTreeMap;

use serde::Deserialize;

/// The keys of a document that we read.
#[derive(Debug, Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub(super) struct Document {
    asset: Asset,
    extensions_required: Vec<String>,
    pub(super) scene: Option<usize>,
    pub(super) scenes: Vec<Scene>,
    pub(super) nodes: Vec<Node>,
    pub(super) meshes: Vec<MeshOfPrimitives>,
    pub(super) accessors: Vec<Accessor>,
    pub(super) buffer_views: Vec<BufferView>,
    pub(super) buffers: Vec<Buffer>,
    pub(super) materials: Vec<MaterialOfFile>,
    pub(super) textures: Vec<TextureOfFile>,
    pub(super) images: Vec<Image>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
struct Asset {
    version: String,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct Scene {
    pub(super) nodes: Vec<usize>,
}

/// A place in the tree of the scene. It has a matrix, or a translation, rotation and scale.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct Node {
    pub(super) children: Vec<usize>,
    pub(super) mesh: Option<usize>,
    /// Column by column.
    pub(super) matrix: Option<[f64; 16]>,
    pub(super) translation: Option<[f64; 3]>,
    /// A quaternion: x, y, z, w.
    pub(super) rotation: Option<[f64; 4]>,
    pub(super) scale: Option<[f64; 3]>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct MeshOfPrimitives {
    pub(super) primitives: Vec<Primitive>,
}

/// Triangles, lines or points with one material.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct Primitive {
    /// Accessors by their meaning, such as `POSITION`.
    pub(super) attributes: BTreeMap<String, usize>,
    pub(super) indices: Option<usize>,
    pub(super) material: Option<usize>,
    pub(super) mode: Option<u64>,
}

/// A list of numbers, or of vectors, in a buffer view.
#[derive(Debug, Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub(super) struct Accessor {
    pub(super) buffer_view: Option<usize>,
    pub(super) byte_offset: usize,
    pub(super) component_type: u64,
    pub(super) count: usize,
    #[serde(rename = "type")]
    pub(super) shape: String,
    pub(super) sparse: Option<serde_json::Value>,
}

/// A part of a buffer.
#[derive(Debug, Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub(super) struct BufferView {
    pub(super) buffer: usize,
    pub(super) byte_offset: usize,
    pub(super) byte_length: usize,
    pub(super) byte_stride: Option<usize>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub(super) struct Buffer {
    pub(super) uri: Option<String>,
    pub(super) byte_length: usize,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub(super) struct MaterialOfFile {
    pub(super) name: Option<String>,
    pub(super) pbr_metallic_roughness: Option<BaseColor>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub(super) struct BaseColor {
    /// Linear red, green, blue, and opacity.
    pub(super) base_color_factor: Option<[f64; 4]>,
    pub(super) base_color_texture: Option<TextureInfo>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub(super) struct TextureInfo {
    pub(super) index: usize,
    /// The number of the set of texture coordinates.
    pub(super) tex_coord: u32,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct TextureOfFile {
    pub(super) source: Option<usize>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub(super) struct Image {
    pub(super) uri: Option<String>,
    pub(super) buffer_view: Option<usize>,
}

/// Reads a document, and the binary chunk of a `.glb` file.
///
/// # Errors
/// The reason why it cannot be read, in words.
pub(super) fn parsed(bytes: &[u8]) -> Result<(Document, Option<&[u8]>), String> {
    let (json, binary) = match bytes.starts_with(b"glTF") {
        true => chunks(bytes)?,
        false => (bytes, None),
    };
    let document: Document = serde_json::from_slice(json).map_err(|error| error.to_string())?;
    let version = &document.asset.version;
    if !version.starts_with("2.") {
        return Err(format!("asset.version is `{version}`, not 2.0"));
    }
    match document.extensions_required.first() {
        Some(name) => Err(format!("it needs the extension `{name}`, which is not read")),
        None => Ok((document, binary)),
    }
}

/// Splits a `.glb` file into the text of its document and its binary chunk.
fn chunks(bytes: &[u8]) -> Result<(&[u8], Option<&[u8]>), String> {
    /// The little-endian number at `at`.
    fn number(bytes: &[u8], at: usize) -> Result<usize, String> {
        let four = bytes.get(at..at + 4).and_then(|four| <[u8; 4]>::try_from(four).ok());
        four.map(|four| u32::from_le_bytes(four) as usize)
            .ok_or_else(|| format!("the file ends after {} bytes", bytes.len()))
    }
    let version = number(bytes, 4)?;
    if version != 2 {
        return Err(format!("the container has version {version}, not 2"));
    }
    let length = number(bytes, 8)?;
    let Some(whole) = bytes.get(..length) else {
        return Err(format!("the file has {} of {length} bytes", bytes.len()));
    };
    let mut chunks = Vec::new();
    let mut at = 12;
    // A document is followed by one binary chunk. We ignore others.
    while at < length && chunks.len() < 2 {
        let size = number(whole, at)?;
        let kind = whole.get(at + 4..at + 8).unwrap_or_default();
        let Some(content) = (at + 8).checked_add(size).and_then(|end| whole.get(at + 8..end))
        else {
            return Err(format!("the chunk at byte {at} has {size} bytes, more than the file"));
        };
        chunks.push((kind, content));
        at += 8 + size;
    }
    match chunks[..] {
        [(b"JSON", json)] => Ok((json, None)),
        [(b"JSON", json), (kind, binary)] => Ok((json, (kind == b"BIN\0").then_some(binary))),
        _ => Err("the first chunk is not a document in JSON".to_owned()),
    }
}

/// The entry `index` of a list of the document. `list` is its name for the error.
pub(super) fn entry<'a, T>(list: &str, all: &'a [T], index: usize) -> Result<&'a T, String> {
    all.get(index).ok_or_else(|| match all.len() {
        0 => format!("{list}[{index}] does not exist, there are none"),
        count => format!("{list}[{index}] does not exist, the last is {list}[{}]", count - 1),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn glb(version: u32, length: u32, chunks: &[(&[u8; 4], &[u8])]) -> Vec<u8> {
        let mut bytes =
            [b"glTF".as_slice(), &version.to_le_bytes(), &length.to_le_bytes()].concat();
        for (kind, content) in chunks {
            bytes.extend((content.len() as u32).to_le_bytes());
            bytes.extend(kind.as_slice());
            bytes.extend(*content);
        }
        bytes
    }

    const JSON: &[u8] = br#"{"asset":{"version":"2.0"}}"#;

    #[test]
    fn containers_of_any_length_are_read_or_refused_with_words() {
        let whole = glb(2, 12 + 8 + 27 + 8 + 2, &[(b"JSON", JSON), (b"BIN\0", b"ab")]);
        assert_eq!(parsed(&whole).unwrap().1, Some(&b"ab"[..]));
        let other = glb(2, 12 + 8 + 27 + 8 + 2, &[(b"JSON", JSON), (b"XYZ ", b"ab")]);
        assert_eq!(parsed(&other).unwrap().1, None);
        for end in 0..whole.len() {
            let reason = parsed(&whole[..end]).unwrap_err();
            assert!(!reason.contains('\n'), "{reason}");
        }
        for length in 0..whole.len() as u32 {
            let fails = parsed(&glb(2, length, &[(b"JSON", JSON), (b"BIN\0", b"ab")])).is_err();
            // The binary chunk may be missing as a whole.
            assert_eq!(fails, length != 12 + 8 + 27, "{length}");
        }
        let reason = parsed(&glb(1, 47, &[(b"JSON", JSON)])).unwrap_err();
        assert_eq!(reason, "the container has version 1, not 2");
        assert!(parsed(&glb(2, 22, &[(b"BIN\0", b"ab")])).unwrap_err().contains("JSON"));
        assert!(parsed(&glb(2, 20, &[(b"JSON", b"")])).is_err());
    }

    #[test]
    fn other_versions_and_needed_extensions_are_refused() {
        let reason = parsed(br#"{"asset":{"version":"1.0"}}"#).unwrap_err();
        assert_eq!(reason, "asset.version is `1.0`, not 2.0");
        let text = r#"{"asset":{"version":"2.0"},"extensionsRequired":["KHR_draco"]}"#;
        assert!(parsed(text.as_bytes()).unwrap_err().contains("`KHR_draco`"));
        for deep in [r#"{"accessors":[{"sparse":"#, r#"{"other":"#] {
            let deep = deep.to_owned() + &"[".repeat(100_000);
            parsed(deep.as_bytes()).unwrap_err();
        }
    }
}
