//! The number that a white reads in whole numbers that a file calls reflectance, guessed where the file states
//! no scale factor.
//!
//! Archives multiply reflectance by 10,000, or write it in 8, 12 or 16 bits of white. Counts of a detector look
//! alike, so we only guess if a header or a name says that the values are reflectances.

use std::path::Path;

use super::error::shortened;

/// Numbers that archives give to a white.
const WHITES: [f64; 12] = [
    100.0, 255.0, 1000.0, 1023.0, 1024.0, 4095.0, 4096.0, 10_000.0, 16_383.0, 32_767.0, 65_535.0,
    65_536.0,
];

/// Greatest reflectance of the brightest pixels that a guess may lead to.
const MOST_REFLECTANCE: f64 = 1.2;

/// Whole words of a header or a file name that say that values are reflectances.
const WORDS: [&str; 9] = [
    "reflectance",
    "reflectances",
    "reflectivity",
    "refl",
    "reflektanz",
    "remission",
    "reflectancia",
    "riflettanza",
    "albedo",
];

/// Whole words that say that values are something else, or were not divided by a white.
const OTHERS: [&str; 7] =
    ["radiance", "counts", "dn", "raw", "uncalibrated", "whiteref", "darkref"];

/// A white that was guessed, with the reason.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct GuessedWhite {
    pub(crate) white: f64,
    /// Why the values are reflectances, and why the white reads this number, as parts of a sentence.
    pub(crate) reason: String,
}

fn words(text: &str) -> impl Iterator<Item = String> + '_ {
    let parts = text.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty());
    parts.map(str::to_lowercase)
}

fn says(text: &str) -> bool {
    let is_other = words(text).any(|word| OTHERS.contains(&word.as_str()));
    !is_other && words(text).any(|word| WORDS.contains(&word.as_str()))
}

/// The white that the words of a header state, for example `10000` in `Reflectance x 10000`.
fn stated(text: &str) -> Option<f64> {
    if text.contains('%') || words(text).any(|word| ["percent", "pct"].contains(&word.as_str())) {
        return Some(100.0);
    }
    // A sign of multiplication may stand at its number.
    let numbers = words(text).filter_map(|word| word.trim_start_matches('x').parse::<f64>().ok());
    let mut known = numbers.filter(|number| *number > 100.0 && WHITES.contains(number));
    known.next().filter(|first| known.all(|other| other == *first))
}

/// Guesses the number of a white. `told` holds texts of the header on the values, each with the name of its key.
/// `most` is the largest value of bright pixels and `largest` the largest of all.
pub(crate) fn guessed_white(
    path: &Path,
    told: &[(String, String)],
    most: f64,
    largest: f64,
) -> Option<GuessedWhite> {
    if told.iter().any(|(_, text)| words(text).any(|word| OTHERS.contains(&word.as_str()))) {
        return None;
    }
    let name = path.file_stem().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    let key = told.iter().find(|(_, text)| says(text));
    let why = match key {
        Some((key, text)) => format!("`{key}` says `{}`", shortened(text)),
        None if says(&name) => "the name of the file says reflectance".to_owned(),
        None => return None,
    };
    if let Some(white) = told.iter().find_map(|(_, text)| stated(text))
        && most <= MOST_REFLECTANCE * white
    {
        return Some(GuessedWhite { white, reason: format!("{why}, with a white of {white}") });
    }
    // A maximum that is a full scale shows that the values were cut off there.
    let full =
        [255.0, 1023.0, 4095.0, 16_383.0, 65_535.0].into_iter().find(|full| *full == largest);
    let white = full.or_else(|| {
        let usual = [255.0, 1000.0, 10_000.0, 65_535.0];
        usual.into_iter().find(|white| most <= MOST_REFLECTANCE * white)
    })?;
    Some(GuessedWhite { white, reason: format!("{why}, and bright pixels read {most}") })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn units(text: &str) -> Vec<(&str, &str)> {
        vec![("data units", text)]
    }

    fn white(file: &str, told: &[(&str, &str)], most: f64, largest: f64) -> Option<f64> {
        let told: Vec<_> = told.iter().map(|(k, v)| ((*k).to_owned(), (*v).to_owned())).collect();
        guessed_white(Path::new(file), &told, most, largest).map(|guessed| guessed.white)
    }

    #[test]
    fn a_white_is_guessed_by_words_and_values_together() {
        for (file, told, most, largest, expected) in [
            ("a.hdr", units("Reflectance"), 8700.0, 9400.0, Some(10_000.0)),
            ("a.hdr", units("Reflectance"), 11_900.0, 14_000.0, Some(10_000.0)),
            ("a.hdr", units("reflectance (0-65535)"), 3000.0, 3500.0, Some(65_535.0)),
            ("a.hdr", units("Reflectance x10000"), 900.0, 990.0, Some(10_000.0)),
            ("a.hdr", units("Surface Reflectance * 4096"), 3500.0, 3900.0, Some(4096.0)),
            ("a.hdr", units("Reflectance [%]"), 88.0, 95.0, Some(100.0)),
            ("a.hdr", units("Reflectance"), 51_000.0, 60_000.0, Some(65_535.0)),
            ("a.hdr", units("Reflectance"), 3600.0, 4095.0, Some(4095.0)),
            ("a.hdr", units("Reflectance"), 230.0, 255.0, Some(255.0)),
            ("REFLECTANCE_12.hdr", vec![], 8700.0, 9400.0, Some(10_000.0)),
            ("panel-3_refl.tif", vec![], 870.0, 940.0, Some(1000.0)),
            // Neither header nor name says so, or one of them says otherwise.
            ("scan.hdr", vec![], 8700.0, 9400.0, None),
            ("scan.hdr", units("DN"), 8700.0, 9400.0, None),
            ("reflectance.hdr", units("Radiance"), 8700.0, 9400.0, None),
            ("raw_reflectance.hdr", vec![], 8700.0, 9400.0, None),
            ("reflectometer.hdr", vec![], 8700.0, 9400.0, None),
            // No white of an archive reads so much.
            ("a.hdr", units("Reflectance"), 900_000.0, 990_000.0, None),
        ] {
            assert_eq!(white(file, &told, most, largest), expected, "{file} {told:?} {most}");
        }
    }

    #[test]
    fn the_reason_names_key_and_values() {
        let told = [("data units".to_owned(), "Reflectance".to_owned())];
        let found = guessed_white(Path::new("a.hdr"), &told, 8700.0, 9400.0).unwrap();
        assert_eq!(found.reason, "`data units` says `Reflectance`, and bright pixels read 8700");
    }
}
