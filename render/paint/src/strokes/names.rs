//! JSON objects with free names: duplicate keys are refused, and a misspelt name gets
//! suggestions.

use std::collections::BTreeMap;
use std::fmt;
use std::marker::PhantomData;

use serde::de::{self, Deserialize, Deserializer, MapAccess, Visitor};

use super::limits::MAX_NAMES;

/// Deserializes an object and refuses duplicate keys, of which a plain map would silently
/// keep the last. At most [`MAX_NAMES`] keys.
pub(super) fn distinct_keys<'de, T: Deserialize<'de>, D: Deserializer<'de>>(
    deserializer: D,
) -> Result<BTreeMap<String, T>, D::Error> {
    struct Entries<T>(PhantomData<T>);

    impl<'de, T: Deserialize<'de>> Visitor<'de> for Entries<T> {
        type Value = BTreeMap<String, T>;

        fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
            formatter.write_str("an object")
        }

        fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Self::Value, A::Error> {
            let mut entries = BTreeMap::new();
            while let Some(key) = map.next_key::<String>()? {
                if entries.contains_key(&key) {
                    return Err(de::Error::custom(format!("duplicate key `{key}`")));
                }
                if entries.len() == MAX_NAMES {
                    return Err(de::Error::custom(format!(
                        "more than {MAX_NAMES} keys, at `{key}`"
                    )));
                }
                entries.insert(key, map.next_value()?);
            }
            Ok(entries)
        }
    }

    deserializer.deserialize_map(Entries(PhantomData))
}

/// Up to three of `known` that are spelt like `name`, the most similar first.
///
/// ```
/// use paint::strokes::similar_names;
/// assert_eq!(similar_names("viridan", ["Viridian", "Zinc White"]), ["Viridian"]);
/// ```
#[must_use]
pub fn similar_names<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Vec<&'a str> {
    let name: Vec<char> = name.to_lowercase().chars().take(100).collect();
    let mut ranked: Vec<_> = known
        .into_iter()
        .map(|other| {
            let letters: Vec<char> = other.to_lowercase().chars().collect();
            (edit_distance(&name, &letters), other)
        })
        .filter(|(edits, other)| *edits <= (name.len().max(other.len()) / 3).max(1))
        .collect();
    ranked.sort_unstable();
    ranked.into_iter().take(3).map(|(_, other)| other).collect()
}

/// Edit distance between `a` and `b` (Levenshtein 1966): insertions, deletions and
/// substitutions of letters.
fn edit_distance(a: &[char], b: &[char]) -> usize {
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, left) in a.iter().enumerate() {
        let mut diagonal = std::mem::replace(&mut row[0], i + 1);
        for (j, right) in b.iter().enumerate() {
            let substituted = diagonal + usize::from(left != right);
            diagonal = row[j + 1];
            row[j + 1] = substituted.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_misspelt_pigment_finds_its_name() {
        let known = ["Zinc White", "Prussian Blue", "Viridian", "Cobalt Blue"];
        assert_eq!(similar_names("prusian blue", known), ["Prussian Blue"]);
        assert_eq!(similar_names("Viridan", known), ["Viridian"]);
        assert!(similar_names("Octarine", known).is_empty(), "no similar name");
        assert_eq!(edit_distance(&['a', 'b'], &['b', 'a', 'c']), 2);
    }
}
