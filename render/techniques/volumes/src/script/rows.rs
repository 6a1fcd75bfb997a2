//! Rows of numbers in a script.

use std::fmt;

use serde::de::{self, Deserializer, IgnoredAny, SeqAccess, Visitor};
use serde::ser::SerializeTuple;
use serde::{Deserialize, Serialize, Serializer};

/// A list of exactly `N` numbers. (An array of serde takes longer lists as well.)
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Vec<f64>", into = "Vec<f64>")]
pub struct Row<const N: usize>(pub [f64; N]);

impl<const N: usize> TryFrom<Vec<f64>> for Row<N> {
    type Error = String;

    fn try_from(numbers: Vec<f64>) -> Result<Self, String> {
        numbers
            .try_into()
            .map(Self)
            .map_err(|numbers: Vec<f64>| format!("expected {N} numbers, found `{}`", numbers.len()))
    }
}

impl<const N: usize> From<Row<N>> for Vec<f64> {
    fn from(row: Row<N>) -> Self {
        row.0.to_vec()
    }
}

impl<const N: usize> From<[f64; N]> for Row<N> {
    fn from(numbers: [f64; N]) -> Self {
        Self(numbers)
    }
}

impl<const N: usize> fmt::Display for Row<N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let numbers: Vec<String> = self.0.iter().map(f64::to_string).collect();
        write!(f, "[{}]", numbers.join(", "))
    }
}

/// Exactly two rows of three numbers, written `[[x, y, z], [x, y, z]]`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Vec<Row<3>>", into = "Vec<Row<3>>")]
pub struct Pair(pub [[f64; 3]; 2]);

impl TryFrom<Vec<Row<3>>> for Pair {
    type Error = String;

    fn try_from(rows: Vec<Row<3>>) -> Result<Self, String> {
        match rows[..] {
            [Row(first), Row(second)] => Ok(Self([first, second])),
            _ => Err(format!("expected 2 rows of 3 numbers, found `{}`", rows.len())),
        }
    }
}

impl From<Pair> for Vec<Row<3>> {
    fn from(pair: Pair) -> Self {
        pair.0.map(Row).to_vec()
    }
}

/// A ball, written `[[x, y, z], radius]`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ball {
    /// Centre in the unit of the scene.
    pub center: [f64; 3],
    /// Radius in the unit of the scene, above 0.
    pub radius: f64,
}

impl Serialize for Ball {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut pair = serializer.serialize_tuple(2)?;
        pair.serialize_element(&Row(self.center))?;
        pair.serialize_element(&self.radius)?;
        pair.end()
    }
}

impl<'de> Deserialize<'de> for Ball {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Pair;

        impl<'de> Visitor<'de> for Pair {
            type Value = Ball;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("[[x, y, z], radius]")
            }

            fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Ball, A::Error> {
                let short = || de::Error::custom("expected [[x, y, z], radius]");
                let Row(center) = list.next_element()?.ok_or_else(short)?;
                let radius = list.next_element()?.ok_or_else(short)?;
                match list.next_element::<IgnoredAny>()? {
                    None => Ok(Ball { center, radius }),
                    Some(_) => Err(short()),
                }
            }
        }

        deserializer.deserialize_seq(Pair)
    }
}
