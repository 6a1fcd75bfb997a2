//! The pigments of a script's palette.

use std::fmt;

use serde::de::{self, Deserializer, MapAccess, SeqAccess, Visitor};
use serde::ser::{SerializeMap, SerializeSeq};
use serde::{Deserialize, Serialize, Serializer};

use crate::layer::SLOTS;

/// Up to eight pigments in the order of their slots: a list of names, or an object of
/// short names (`{"W": "Zinc White"}`).
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct PaletteSpec {
    /// Short name, where there is one, and name in the library.
    pub pigments: Vec<(Option<String>, String)>,
}

impl PaletteSpec {
    /// A palette of pigments by their names in the library, without short names.
    pub fn from_names<'a>(names: impl IntoIterator<Item = &'a str>) -> Self {
        Self { pigments: names.into_iter().map(|name| (None, name.to_owned())).collect() }
    }

    /// Library name of the pigment with this short name.
    #[must_use]
    pub fn library_name(&self, short: &str) -> Option<&str> {
        let found = self.pigments.iter().find(|(own, _)| own.as_deref() == Some(short));
        found.map(|(_, name)| name.as_str())
    }
}

impl Serialize for PaletteSpec {
    /// Writes a list, unless every pigment has a short name.
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let short: Option<Vec<&String>> =
            self.pigments.iter().map(|(short, _)| short.as_ref()).collect();
        match short {
            Some(short) if !short.is_empty() => {
                let mut map = serializer.serialize_map(Some(short.len()))?;
                for (short, (_, name)) in short.into_iter().zip(&self.pigments) {
                    map.serialize_entry(short, name)?;
                }
                map.end()
            }
            _ => {
                let mut list = serializer.serialize_seq(Some(self.pigments.len()))?;
                for (_, name) in &self.pigments {
                    list.serialize_element(name)?;
                }
                list.end()
            }
        }
    }
}

impl<'de> Deserialize<'de> for PaletteSpec {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Pigments;

        fn push<E: de::Error>(
            palette: &mut PaletteSpec,
            short: Option<String>,
            name: String,
        ) -> Result<(), E> {
            if palette.pigments.len() == SLOTS {
                return Err(E::custom(format!("more than {SLOTS} pigments, at `{name}`")));
            }
            if short.as_ref().is_some_and(|short| palette.library_name(short).is_some()) {
                let short = short.unwrap_or_default();
                return Err(E::custom(format!("duplicate key `{short}`")));
            }
            palette.pigments.push((short, name));
            Ok(())
        }

        impl<'de> Visitor<'de> for Pigments {
            type Value = PaletteSpec;

            fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
                write!(formatter, "a list or an object of up to {SLOTS} pigments")
            }

            fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<PaletteSpec, A::Error> {
                let mut palette = PaletteSpec::default();
                while let Some(name) = list.next_element()? {
                    push(&mut palette, None, name)?;
                }
                Ok(palette)
            }

            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<PaletteSpec, A::Error> {
                let mut palette = PaletteSpec::default();
                while let Some((short, name)) = map.next_entry()? {
                    push(&mut palette, Some(short), name)?;
                }
                Ok(palette)
            }
        }

        deserializer.deserialize_any(Pigments)
    }
}
