//! The numbers of a glTF file: buffers, and the accessors that read vectors from them.

use std::borrow::Cow;

use base64::Engine;
use base64::alphabet::STANDARD;
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};
use documents::counted;
use documents::file::NamedFiles;

use super::document::{Document, entry};
use crate::mesh::file::part::MeshError;

/// Reads a file that a URI names, or decodes a URI that holds the data itself. `place` is the place
/// of the URI in the document.
pub(super) fn content_of(
    uri: &str,
    place: &str,
    files: &mut NamedFiles,
) -> Result<Vec<u8>, MeshError> {
    let path = match uri.strip_prefix("data:") {
        Some(data) => {
            return decoded(data)
                .map_err(|reason| MeshError::malformed(files.file(), place, reason));
        }
        None => uri.strip_prefix("file://").unwrap_or(uri),
    };
    let path = match path.contains("://") {
        true => Err(format!("`{uri}` is no file, and nothing is loaded from a network")),
        false => path_of(path),
    };
    let path = path.map_err(|reason| MeshError::malformed(files.file(), place, reason))?;
    Ok(files.read(place, &path)?)
}

/// Decodes the part of a data URI after `data:`.
fn decoded(data: &str) -> Result<Vec<u8>, String> {
    let Some((_, text)) = data.split_once(";base64,") else {
        return Err("a data URI that is not in base64".to_owned());
    };
    // Some programs leave out the padding at the end.
    let lenient = GeneralPurposeConfig::new()
        .with_decode_padding_mode(DecodePaddingMode::Indifferent)
        .with_decode_allow_trailing_bits(true);
    let decoded = GeneralPurpose::new(&STANDARD, lenient).decode(text);
    decoded.map_err(|error| format!("the base64 of a data URI is damaged: {error}"))
}

/// Decodes the percent escapes of a relative reference (e.g. `%20`) into a path.
fn path_of(reference: &str) -> Result<String, String> {
    let mut bytes = Vec::with_capacity(reference.len());
    let mut rest = reference.as_bytes();
    while let [first, after @ ..] = rest {
        let coded = (*first == b'%').then(|| std::str::from_utf8(after.get(..2)?).ok()).flatten();
        match coded.and_then(|digits| u8::from_str_radix(digits, 16).ok()) {
            Some(byte) => {
                bytes.push(byte);
                rest = &after[2..];
            }
            None => {
                bytes.push(*first);
                rest = after;
            }
        }
    }
    String::from_utf8(bytes).map_err(|_| format!("not a reference: `{reference}`"))
}

/// The content of the buffers of a document.
#[derive(Debug)]
pub(super) struct Buffers<'a>(Vec<Cow<'a, [u8]>>);

impl<'a> Buffers<'a> {
    /// Reads all buffers. The first may be the `binary` chunk of a `.glb` file.
    pub(super) fn read(
        document: &Document,
        binary: Option<&'a [u8]>,
        files: &mut NamedFiles,
    ) -> Result<Self, MeshError> {
        let mut all = Vec::new();
        for (index, buffer) in document.buffers.iter().enumerate() {
            let place = format!("buffers[{index}]");
            let content = match (&buffer.uri, binary) {
                (Some(uri), _) => {
                    Cow::from(content_of(uri, &format!("buffers[{index}].uri"), files)?)
                }
                (None, Some(binary)) if index == 0 => Cow::from(binary),
                (None, _) => {
                    let reason = "it has neither a uri nor a chunk";
                    return Err(MeshError::malformed(files.file(), place, reason));
                }
            };
            if content.len() < buffer.byte_length {
                let wanted = counted(buffer.byte_length, "byte");
                let reason = format!("it has {} of {wanted}", content.len());
                return Err(MeshError::malformed(files.file(), place, reason));
            }
            all.push(content);
        }
        Ok(Self(all))
    }

    /// The bytes of a buffer view.
    pub(super) fn view(&self, document: &Document, index: usize) -> Result<&[u8], String> {
        let view = entry("bufferViews", &document.buffer_views, index)?;
        let buffer = entry("buffers", &self.0, view.buffer)?;
        let end = view.byte_offset.checked_add(view.byte_length);
        let within = end.and_then(|end| buffer.get(view.byte_offset..end));
        within.ok_or_else(|| format!("bufferViews[{index}] ends after buffers[{}]", view.buffer))
    }
}

/// The type of the numbers of an accessor.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Component {
    U8,
    U16,
    U32,
    F32,
}

impl Component {
    fn bytes(self) -> usize {
        match self {
            Self::U8 => 1,
            Self::U16 => 2,
            Self::U32 | Self::F32 => 4,
        }
    }

    fn name(self) -> &'static str {
        match self {
            Self::U8 => "UNSIGNED_BYTE",
            Self::U16 => "UNSIGNED_SHORT",
            Self::U32 => "UNSIGNED_INT",
            Self::F32 => "FLOAT",
        }
    }
}

/// Types of numbers and vectors that an attribute may have.
#[derive(Debug)]
pub(super) struct Kind {
    types: &'static [Component],
    shapes: &'static [(&'static str, usize)],
}

/// Positions and normals.
pub(super) const VECTORS: Kind = Kind { types: &[Component::F32], shapes: &[("VEC3", 3)] };

const FRACTIONS: &[Component] = &[Component::F32, Component::U8, Component::U16];

/// Sets of texture coordinates.
pub(super) const COORDINATES: Kind = Kind { types: FRACTIONS, shapes: &[("VEC2", 2)] };

/// Colours of vertices.
pub(super) const COLORS: Kind = Kind { types: FRACTIONS, shapes: &[("VEC3", 3), ("VEC4", 4)] };

/// Indices of vertices.
pub(super) const CORNERS: Kind =
    Kind { types: &[Component::U8, Component::U16, Component::U32], shapes: &[("SCALAR", 1)] };

/// The vectors of an accessor. All of them lie within its buffer view.
#[derive(Debug, Clone, Copy)]
pub(super) struct Values<'a> {
    bytes: &'a [u8],
    stride: usize,
    component: Component,
    count: usize,
}

impl<'a> Values<'a> {
    /// Finds the vectors of an accessor, and checks that their type is of this `kind`.
    pub(super) fn of(
        document: &Document,
        buffers: &'a Buffers<'_>,
        index: usize,
        kind: &Kind,
    ) -> Result<Self, String> {
        let name = format!("accessors[{index}]");
        let accessor = entry("accessors", &document.accessors, index)?;
        let found =
            kind.types.iter().find(|component| code(**component) == accessor.component_type);
        let shape = kind.shapes.iter().find(|(shape, _)| *shape == accessor.shape);
        let (Some(&component), Some(&(_, length))) = (found, shape) else {
            let types: Vec<&str> = kind.types.iter().map(|component| component.name()).collect();
            let shapes: Vec<&str> = kind.shapes.iter().map(|(shape, _)| *shape).collect();
            return Err(format!(
                "{name} has componentType {} in {}, not {} in {}",
                accessor.component_type,
                accessor.shape,
                types.join(" or "),
                shapes.join(" or ")
            ));
        };
        if accessor.sparse.is_some() {
            return Err(format!("{name} has sparse values, which are not read"));
        }
        let Some(view) = accessor.buffer_view else {
            return Err(format!("{name} has no bufferView"));
        };
        let bytes = buffers.view(document, view)?;
        let size = component.bytes() * length;
        let stride = document.buffer_views[view].byte_stride.unwrap_or(size);
        if stride < size {
            return Err(format!("bufferViews[{view}] has a byteStride of {stride}, not {size}"));
        }
        let count = accessor.count;
        let Some(last) = count.checked_sub(1) else {
            return Err(format!("{name} has no values"));
        };
        let end = last
            .checked_mul(stride)
            .and_then(|end| end.checked_add(accessor.byte_offset)?.checked_add(size))
            .filter(|end| *end <= bytes.len());
        match end {
            Some(end) => {
                let bytes = &bytes[accessor.byte_offset..end];
                Ok(Self { bytes, stride, component, count })
            }
            None => {
                let values = counted(count, "value");
                Err(format!("{name} with {values} ends after bufferViews[{view}]"))
            }
        }
    }

    pub(super) fn count(&self) -> usize {
        self.count
    }

    /// The first `N` numbers of each vector. Whole numbers become fractions of the greatest one.
    pub(super) fn floats<const N: usize>(self) -> impl Iterator<Item = [f32; N]> + use<'a, N> {
        let size = self.component.bytes();
        self.bytes.chunks(self.stride).map(move |vector| {
            std::array::from_fn(|i| match (self.component, &vector[i * size..(i + 1) * size]) {
                (Component::U8, [byte]) => f32::from(*byte) / 255.0,
                (Component::U16, &[a, b]) => f32::from(u16::from_le_bytes([a, b])) / 65535.0,
                (Component::F32, &[a, b, c, d]) => f32::from_le_bytes([a, b, c, d]),
                _ => 0.0,
            })
        })
    }

    /// The whole number of each entry.
    pub(super) fn indices(self) -> impl Iterator<Item = u32> + use<'a> {
        let size = self.component.bytes();
        self.bytes.chunks(self.stride).map(move |entry| match &entry[..size] {
            [byte] => u32::from(*byte),
            &[a, b] => u32::from(u16::from_le_bytes([a, b])),
            &[a, b, c, d] => u32::from_le_bytes([a, b, c, d]),
            _ => 0,
        })
    }
}

/// The number by which a file names this type of numbers (glTF 2.0, section 3.6.2.2).
fn code(component: Component) -> u64 {
    match component {
        Component::U8 => 5121,
        Component::U16 => 5123,
        Component::U32 => 5125,
        Component::F32 => 5126,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn references_are_decoded() {
        assert_eq!(path_of("a%20b%2Fc.png").as_deref(), Ok("a b/c.png"));
        assert_eq!(path_of("100%").as_deref(), Ok("100%"));
        assert_eq!(path_of("%zz").as_deref(), Ok("%zz"));
        assert!(path_of("%ff").is_err());
    }

    #[test]
    fn data_of_the_document_is_decoded() {
        let media = "application/octet-stream;base64,";
        assert_eq!(decoded(&format!("{media}AAEC")).as_deref(), Ok(&[0, 1, 2][..]));
        assert_eq!(decoded(&format!("{media}AA==")).as_deref(), Ok(&[0][..]));
        assert_eq!(decoded(&format!("{media}AA")).as_deref(), Ok(&[0][..]));
        assert!(decoded(&format!("{media}A*")).unwrap_err().contains("damaged"));
        assert!(decoded("text/plain,abc").unwrap_err().contains("base64"));
    }

    #[test]
    fn strides_leave_room_for_the_last_value() {
        let text = r#"{"asset": {"version": "2.0"},
            "bufferViews": [{"byteLength": 7, "byteStride": 4}, {"byteLength": 8, "byteStride": 1}],
            "accessors": [
                {"bufferView": 0, "componentType": 5123, "count": 2, "type": "SCALAR"},
                {"bufferView": 0, "componentType": 5123, "count": 3, "type": "SCALAR"},
                {"bufferView": 0, "componentType": 5121, "byteOffset": 3, "count": 1,
                 "type": "SCALAR"},
                {"bufferView": 1, "componentType": 5123, "count": 2, "type": "SCALAR"},
                {"bufferView": 0, "componentType": 5123, "byteOffset": 18446744073709551615,
                 "count": 2, "type": "SCALAR"}]}"#;
        let (document, _) = super::super::document::parsed(text.as_bytes()).unwrap();
        let buffers = Buffers(vec![Cow::from(vec![1, 0, 9, 9, 2, 1, 9, 9])]);
        let read = [0, 1, 2, 3, 4, 5].map(|i: usize| Values::of(&document, &buffers, i, &CORNERS));
        assert_eq!(read[0].as_ref().unwrap().indices().collect::<Vec<_>>(), [1, 258]);
        assert_eq!(read[2].as_ref().unwrap().indices().collect::<Vec<_>>(), [9]);
        for (index, words) in [
            (1, "accessors[1] with 3 values ends after bufferViews[0]"),
            (3, "bufferViews[1] has a byteStride of 1, not 2"),
            (4, "accessors[4] with 2 values ends after bufferViews[0]"),
            (5, "accessors[5] does not exist, the last is accessors[4]"),
        ] {
            assert_eq!(read[index].as_ref().unwrap_err(), words);
        }
    }
}
