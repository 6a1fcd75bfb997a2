//! Bounds checks of glTF accessors, buffer views and references, made before the glTF
//! reader follows them.

use gltf::accessor::{Accessor, DataType, Dimensions};

/// Component types and dimensions that an attribute may have.
pub(super) struct Kind {
    pub(super) name: &'static str,
    pub(super) types: &'static [DataType],
    pub(super) dimensions: &'static [Dimensions],
}

pub(super) const POSITIONS: Kind =
    Kind { name: "POSITION", types: &[DataType::F32], dimensions: &[Dimensions::Vec3] };

pub(super) const NORMALS: Kind =
    Kind { name: "NORMAL", types: &[DataType::F32], dimensions: &[Dimensions::Vec3] };

const FRACTIONS: &[DataType] = &[DataType::F32, DataType::U8, DataType::U16];

pub(super) const COORDINATES: Kind =
    Kind { name: "TEXCOORD", types: FRACTIONS, dimensions: &[Dimensions::Vec2] };

pub(super) const COLORS: Kind =
    Kind { name: "COLOR", types: FRACTIONS, dimensions: &[Dimensions::Vec3, Dimensions::Vec4] };

pub(super) const CORNERS: Kind = Kind {
    name: "indices",
    types: &[DataType::U8, DataType::U16, DataType::U32],
    dimensions: &[Dimensions::Scalar],
};

/// Checks that an accessor has an allowed type and that all of its values lie within its
/// buffer. The error is the reason as text.
pub(super) fn check(
    accessor: &Accessor<'_>,
    kind: &Kind,
    buffers: &[gltf::buffer::Data],
) -> Result<(), String> {
    let found = accessor.data_type();
    let dimensions = accessor.dimensions();
    if !kind.types.contains(&found) || !kind.dimensions.contains(&dimensions) {
        return Err(format!("{} of `{found:?}` in `{dimensions:?}`", kind.name));
    }
    if accessor.sparse().is_some() {
        return Err("sparse values are not read".to_owned());
    }
    let view = accessor.view().ok_or_else(|| "it has no buffer view".to_owned())?;
    slice(&view, buffers)?;
    let count = accessor.count();
    let stride = view.stride().unwrap_or(accessor.size());
    let last = count.checked_sub(1).ok_or_else(|| "it has no values".to_owned())?;
    let end = last
        .checked_mul(stride)
        .and_then(|end| end.checked_add(accessor.offset())?.checked_add(accessor.size()));
    match end.is_some_and(|end| end <= view.length()) {
        true => Ok(()),
        false => Err(format!("{count} values are more than its buffer view has")),
    }
}

/// Bytes of a buffer view, or the reason why it is out of bounds.
pub(super) fn slice<'a>(
    view: &gltf::buffer::View<'_>,
    buffers: &'a [gltf::buffer::Data],
) -> Result<&'a [u8], String> {
    let buffer: &[u8] = &buffers[view.buffer().index()];
    let end = view.offset().checked_add(view.length());
    let within = end.and_then(|end| buffer.get(view.offset()..end));
    within.ok_or_else(|| format!("buffer view {} reaches beyond its buffer", view.index()))
}

/// Decodes the percent escapes of a relative reference (`%20`) into a path.
pub(super) fn path_of(reference: &str) -> Result<String, String> {
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
}
