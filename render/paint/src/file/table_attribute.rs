//! The palette and the brushes beside a canvas: a file of their own in an attribute of part `wet`.

use exr::meta::attribute::{AttributeValue, Text};
use exr::meta::header::Header;

/// Attribute of part `wet` with the bytes of the file of palette and brushes.
pub(super) const TABLE_ATTRIBUTE: &str = "impasto.table";

/// Type of the attribute. Programs that do not know it keep its bytes or drop them.
const KIND: &str = "impasto-table";

/// The attribute with these bytes.
pub(super) fn table_attribute(bytes: Vec<u8>) -> AttributeValue {
    AttributeValue::Custom { kind: Text::from(KIND), bytes: bytes.into() }
}

/// Bytes of the file of palette and brushes, if one of the parts holds it.
pub(super) fn table_bytes(parts: &[Header]) -> Option<&[u8]> {
    let key = Text::from(TABLE_ATTRIBUTE);
    parts.iter().find_map(|part| match part.own_attributes.other.get(&key) {
        Some(AttributeValue::Custom { kind, bytes }) if kind.eq(KIND) => Some(&bytes[..]),
        _ => None,
    })
}
