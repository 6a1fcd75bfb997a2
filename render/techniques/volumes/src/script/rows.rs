//! Rows of numbers in a script, and checks of single values. It also limits what a script may ask
//! for, and says what would fit if you ask for more.

use std::fmt;

use documents::counted_as;
use serde::de::{self, Deserializer, IgnoredAny, SeqAccess, Visitor};
use serde::ser::SerializeTuple;
use serde::{Deserialize, Serialize, Serializer};

use crate::toml_text::{Checked, Fault, KeyPath};
use crate::volume::MOST_DETAIL;
use crate::wetting::MOST_CELLS;
use crate::world::MOST_PARTICLES;

/// A list of exactly `N` numbers. We need this because an array of serde takes longer lists as
/// well.
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

/// An animation has at most this many frames.
pub const MOST_FRAMES: u64 = 100_000;

/// A script has at most this many tables that do something: pours, volumes, pushes, walls, lifts,
/// splits and dryings.
pub const MOST_EVENTS: usize = 10_000;

/// Longest script in seconds.
pub const MOST_SECONDS: f64 = 3600.0;

/// The paths of all pours and lifts have at most this many points.
pub(super) const MOST_POINTS: usize = 1_000_000;

/// Number of frames of `seconds` at `rate` frames per second. This includes the first and the last
/// one.
///
/// # Errors
/// [`Fault`] of `seconds` for more than [`MOST_FRAMES`], with seconds and rate that fit.
pub fn frames_fit(seconds: f64, rate: f64) -> Result<u64, Box<Fault>> {
    let count = (seconds * rate).floor().max(0.0) + 1.0;
    if count <= MOST_FRAMES as f64 {
        return Ok(count as u64);
    }
    let most = (MOST_FRAMES - 1) as f64;
    let hint = format!(
        "{} seconds fit at {rate} frames a second, or {} frames a second",
        floored(most / rate),
        floored(most / seconds)
    );
    let wanted = format!("at most {MOST_FRAMES} frames");
    Err(Fault::new(&KeyPath::of("seconds"), wanted, format!("{count} frames"), hint))
}

/// The fault of cells that are too narrow. `cell` is their width as a share of the scene's longest
/// side. Cells of the width `fits` are possible.
#[must_use]
pub fn cells_too_small(cell: f64, fits: f64) -> Box<Fault> {
    let wanted = format!("a width of at most {MOST_CELLS} cells");
    let hint = format!("cell = {} fits", (fits * 1e5).ceil() / 1e5);
    Fault::new(&KeyPath::of("grid.cell"), wanted, cell as f32, hint)
}

/// The fault of too many samples in a cell: `found`, of which only `fits` are possible.
#[must_use]
pub fn samples_too_many(found: usize, fits: usize) -> Box<Fault> {
    let wanted = format!("1 to {fits} for cells of this width");
    let hint = format!("samples = {fits} fits, or larger cells (grid.cell)");
    Fault::new(&KeyPath::of("grid.samples"), wanted, found, hint)
}

pub(super) fn check_count(key: &str, count: usize, most: usize) -> Checked {
    if count <= most {
        return Ok(());
    }
    let hint = format!("the first {most} fit; leave out the others, or divide the script");
    let key = KeyPath::of(key).index(most);
    Err(Fault::new(&key, format!("at most {most} tables"), count, hint))
}

pub(super) fn check_particles(details: &[u8]) -> Checked {
    fn of(detail: u8) -> usize {
        10 * 4_usize.pow(detail.into()) + 2
    }
    let mut total = 0;
    for (index, &detail) in details.iter().enumerate() {
        total += of(detail);
        if total > MOST_PARTICLES {
            let mut finest = (0..=MOST_DETAIL).rev();
            let fits = finest.find(|&detail| of(detail) * details.len() <= MOST_PARTICLES);
            let hint = match fits {
                Some(fits) => format!("detail = {fits} fits for all {}", details.len()),
                None => counted_as(index, "volume fits", "volumes fit"),
            };
            let key = KeyPath::of("volume").index(index).key("detail");
            let wanted = format!("at most {MOST_PARTICLES} particles in all volumes");
            return Err(Fault::new(&key, wanted, format!("{detail}: {total} so far"), hint));
        }
    }
    Ok(())
}

fn floored(number: f64) -> f64 {
    (number * 10.0).floor() / 10.0
}

/// Names of regions, letters of pigments and names of pigments have at most this many bytes.
const LONGEST_NAME: usize = 200;

/// Greatest coordinate or length in the unit of the scene.
pub(super) const MOST_LENGTH: f64 = 1e6;

pub(super) fn check_range(key: &KeyPath, value: f64, [least, most]: [f64; 2]) -> Checked {
    if (least..=most).contains(&value) {
        return Ok(());
    }
    let hint = match value < least {
        true => format!("the least is {least}"),
        _ if value > most => format!("the most is {most}"),
        _ => "write a number".to_owned(),
    };
    Err(Fault::new(key, format!("{least} to {most}"), number_text(value), hint))
}

pub(super) fn check_positive(key: &KeyPath, value: f64, most: f64) -> Checked {
    if value > 0.0 && value <= most {
        return Ok(());
    }
    let hint = match value > most {
        true => format!("the most is {most}"),
        false => "write a number above 0, or leave the table out".to_owned(),
    };
    Err(Fault::new(key, format!("a number above 0, up to {most}"), number_text(value), hint))
}

pub(super) fn check_time(key: &KeyPath, seconds: f64) -> Checked {
    check_range(key, seconds, [0.0, MOST_SECONDS])
}

pub(super) fn check_place(key: &KeyPath, place: [f64; 3]) -> Checked {
    for (axis, value) in place.into_iter().enumerate() {
        check_range(&key.index(axis), value, [-MOST_LENGTH, MOST_LENGTH])?;
    }
    Ok(())
}

/// Checks the coordinates of a direction. It must not be 0.
pub(super) fn check_direction(key: &KeyPath, direction: [f64; 3]) -> Checked {
    check_place(key, direction)?;
    if direction.iter().all(|value| value.abs() < 1e-6) {
        let hint = "[0.0, 1.0, 0.0] is upwards";
        let found = format!("{direction:?}");
        return Err(Fault::new(key, "a direction longer than 0", found, hint));
    }
    Ok(())
}

/// A number as text. Large ones have an exponent: for example, 1e300 would take 301 digits.
fn number_text(value: f64) -> String {
    if value.abs() < 1e9 { value.to_string() } else { format!("{value:e}") }
}

pub(super) fn check_name(key: &KeyPath, name: &str) -> Checked {
    let fits = (1..=LONGEST_NAME).contains(&name.len()) && !name.contains(char::is_control);
    match fits {
        true => Ok(()),
        false => Err(Fault::new(
            key,
            format!("a name of 1 to {LONGEST_NAME} bytes on one line"),
            name.escape_debug(),
            "a short word will do",
        )),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use documents::hint::Explain;

    #[test]
    fn refusals_say_what_would_fit() {
        assert_eq!(frames_fit(6.0, 24.0), Ok(145));
        let fault = frames_fit(3600.0, 30.0).unwrap_err();
        let hint = fault.hint().unwrap().to_string();
        assert_eq!(hint, "3333.3 seconds fit at 30 frames a second, or 27.7 frames a second");
        assert!(frames_fit(3333.3, 30.0).is_ok() && frames_fit(3600.0, 27.7).is_ok());
        let fault = cells_too_small(0.001, 0.002_105_3);
        assert_eq!(fault.hint().unwrap().to_string(), "cell = 0.00211 fits");
        let message = "grid.cell takes a width of at most 1048576 cells, found `0.001`";
        assert_eq!(fault.to_string(), message);
        assert_eq!(check_particles(&[3; 3000]), Ok(()));
        let fault = check_particles(&[5; 300]).unwrap_err();
        assert_eq!(fault.key.to_string(), "[[volume]] 196, detail");
        assert_eq!(fault.hint().unwrap().to_string(), "detail = 4 fits for all 300");
    }
}
