//! Numbers with their nouns in messages.

use std::fmt::Display;

/// A number with its noun, in the plural unless it is one: `1 pigment`, `3 pigments`.
///
/// ```
/// use documents::counted;
/// assert_eq!([counted(1, "pigment"), counted(0, "pigment")], ["1 pigment", "0 pigments"]);
/// ```
#[must_use]
pub fn counted<N: Display + PartialEq + From<u8>>(number: N, noun: &str) -> String {
    counted_as(number, noun, &format!("{noun}s"))
}

/// A number with a noun whose plural is `many`.
///
/// ```
/// assert_eq!(documents::counted_as(2, "swatch", "swatches"), "2 swatches");
/// ```
#[must_use]
pub fn counted_as<N: Display + PartialEq + From<u8>>(number: N, one: &str, many: &str) -> String {
    let noun = if number == N::from(1) { one } else { many };
    format!("{number} {noun}")
}
