//! How an action names a layer.

use std::fmt;

use serde::de::{self, Deserializer, MapAccess, Visitor};
use serde::ser::SerializeMap;
use serde::{Deserialize, Serialize, Serializer};

use crate::dry_layer::LayerId;

/// One layer of a painting.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LayerRef {
    /// The wet layer.
    Wet,
    /// A dry layer by its index; 0 is the lowest.
    Dry(usize),
    /// A dry layer by its identity, wherever it lies.
    Id(LayerId),
}

/// A layer is `"wet"`, the index of a dry layer from 0, the lowest, or `{"id": 3}`.
impl Serialize for LayerRef {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Wet => serializer.serialize_str("wet"),
            Self::Dry(index) => serializer.serialize_u64(*index as u64),
            Self::Id(id) => {
                let mut map = serializer.serialize_map(Some(1))?;
                map.serialize_entry("id", id)?;
                map.end()
            }
        }
    }
}

impl<'de> Deserialize<'de> for LayerRef {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Name;

        impl<'de> Visitor<'de> for Name {
            type Value = LayerRef;

            fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
                formatter.write_str(
                    "\"wet\", the number of a dry layer, from 0, or its identity, {\"id\": 1}",
                )
            }

            fn visit_str<E: de::Error>(self, text: &str) -> Result<LayerRef, E> {
                match text {
                    "wet" => Ok(LayerRef::Wet),
                    _ => Err(E::invalid_value(de::Unexpected::Str(text), &self)),
                }
            }

            fn visit_u64<E: de::Error>(self, index: u64) -> Result<LayerRef, E> {
                let dry = usize::try_from(index).map(LayerRef::Dry);
                dry.map_err(|_| E::invalid_value(de::Unexpected::Unsigned(index), &self))
            }

            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<LayerRef, A::Error> {
                let mut id = None;
                while let Some(key) = map.next_key::<String>()? {
                    match key.as_str() {
                        "id" if id.is_none() => id = Some(map.next_value()?),
                        "id" => return Err(de::Error::duplicate_field("id")),
                        other => return Err(de::Error::unknown_field(other, &["id"])),
                    }
                }
                id.map(LayerRef::Id).ok_or_else(|| de::Error::missing_field("id"))
            }
        }

        deserializer.deserialize_any(Name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn layers_are_named_wet_by_place_or_by_identity() {
        let all = [
            (LayerRef::Wet, "\"wet\""),
            (LayerRef::Dry(2), "2"),
            (LayerRef::Id(LayerId(3)), "{\"id\":3}"),
        ];
        for (layer, text) in all {
            assert_eq!(serde_json::to_string(&layer).unwrap(), text);
            assert_eq!(serde_json::from_str::<LayerRef>(text).unwrap(), layer);
        }
        for wrong in
            ["\"dry\"", "-1", "1.5", "{}", "{\"id\":-1}", "{\"id\":1,\"id\":2}", "{\"no\":1}"]
        {
            assert!(serde_json::from_str::<LayerRef>(wrong).is_err(), "{wrong}");
        }
    }
}
