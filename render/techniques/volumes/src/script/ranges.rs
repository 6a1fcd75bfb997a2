//! Checks of single values.

use super::limits::MOST_SECONDS;
use crate::toml_text::{Checked, Fault, KeyPath};

/// Longest name of a region, letter of a pigment, and its name, in bytes.
const LONGEST_NAME: usize = 200;

/// Greatest coordinate or length in the unit of the scene.
pub(super) const MOST_LENGTH: f64 = 1e6;

/// Checks that `value` lies in `least..=most`.
pub(super) fn check_range(key: &KeyPath, value: f64, [least, most]: [f64; 2]) -> Checked {
    if (least..=most).contains(&value) {
        return Ok(());
    }
    let hint = match value < least {
        true => format!("the least is {least}"),
        _ if value > most => format!("the most is {most}"),
        _ => "write a number".to_owned(),
    };
    Err(Fault::new(key, format!("{least} to {most}"), shown(value), hint))
}

/// Checks that `value` is above 0 and at most `most`.
pub(super) fn check_positive(key: &KeyPath, value: f64, most: f64) -> Checked {
    if value > 0.0 && value <= most {
        return Ok(());
    }
    let hint = match value > most {
        true => format!("the most is {most}"),
        false => "write a number above 0, or leave the table out".to_owned(),
    };
    Err(Fault::new(key, format!("a number above 0, up to {most}"), shown(value), hint))
}

/// Checks a time in seconds.
pub(super) fn check_time(key: &KeyPath, seconds: f64) -> Checked {
    check_range(key, seconds, [0.0, MOST_SECONDS])
}

/// Checks the coordinates of a place in the unit of the scene.
pub(super) fn check_place(key: &KeyPath, place: [f64; 3]) -> Checked {
    for (axis, value) in place.into_iter().enumerate() {
        check_range(&key.index(axis), value, [-MOST_LENGTH, MOST_LENGTH])?;
    }
    Ok(())
}

/// Checks the coordinates of a direction, and that it is not 0.
pub(super) fn check_direction(key: &KeyPath, direction: [f64; 3]) -> Checked {
    check_place(key, direction)?;
    if direction.iter().all(|value| value.abs() < 1e-6) {
        let hint = "[0.0, 1.0, 0.0] is upwards";
        let found = format!("{direction:?}");
        return Err(Fault::new(key, "a direction longer than 0", found, hint));
    }
    Ok(())
}

/// A number as text: large ones have an exponent, as 1e300 would take 301 digits.
fn shown(value: f64) -> String {
    if value.abs() < 1e9 { value.to_string() } else { format!("{value:e}") }
}

/// Checks a name of a region or pigment.
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
