//! Headings of tables in the languages of laboratories: English, German, French, Spanish, Italian and
//! Dutch.
//!
//! A heading is compared without case, accents, blanks and signs, so `Wellenl\u{e4}nge [nm]` and
//! `WELLENLAENGE_nm` are one.

use crate::csv_table::wavelength_of_header;

/// Units that stand in brackets behind a name, in small letters and without blanks.
const UNITS: [&str; 36] = [
    "%", "%r", "r%", "wt%", "wt.%", "wt-%", "w/w", "%w/w", "m%", "mass%", "gew%", "gew.%",
    "gew.-%", "ma.-%", "masse%", "vol%", "vol.%", "vol.-%", "v/v", "%v/v", "g", "mg", "kg", "gram",
    "grams", "gramm", "ml", "l", "cc", "drops", "parts", "teile", "parties", "partes", "parti",
    "delen",
];

/// `heading` in small letters without accents, blanks and signs. Each vowel with a diaeresis gives the
/// plain vowel.
#[must_use]
pub fn plain(heading: &str) -> String {
    let mut plain = String::new();
    for letter in heading.chars().flat_map(char::to_lowercase) {
        match letter {
            '\u{e0}'..='\u{e5}' => plain.push('a'),
            '\u{e7}' => plain.push('c'),
            '\u{e8}'..='\u{eb}' => plain.push('e'),
            '\u{ec}'..='\u{ef}' => plain.push('i'),
            '\u{f1}' => plain.push('n'),
            '\u{f2}'..='\u{f6}' => plain.push('o'),
            '\u{f9}'..='\u{fc}' => plain.push('u'),
            '\u{df}' => plain.push_str("ss"),
            '\u{153}' => plain.push_str("oe"),
            letter if letter.is_alphanumeric() => plain.push(letter),
            _ => {}
        }
    }
    plain
}

/// `heading` without a unit in brackets at its end, and the unit, e.g. `Red` and `g` of `Red (g)`. Other
/// words in brackets belong to the name, e.g. `Red (PR101)`.
#[must_use]
pub fn without_unit(heading: &str) -> (&str, Option<&str>) {
    let heading = heading.trim();
    let parts = [('(', ')'), ('[', ']'), ('{', '}')].into_iter().find_map(|(open, close)| {
        let (name, unit) = heading.strip_suffix(close)?.rsplit_once(open)?;
        let compact: String = unit.chars().filter(|c| !c.is_whitespace()).collect();
        let is_unit = UNITS.contains(&compact.to_lowercase().as_str());
        (is_unit && !name.trim().is_empty()).then_some((name.trim(), Some(unit.trim())))
    });
    parts.unwrap_or((heading, None))
}

/// Headings of columns of names as [`plain`] gives them, the most specific first. A table uses a later one
/// only if it has none of the earlier ones. The last ones are numbers of samples.
const NAMES: [&[&str]; 12] = [
    &["sample", "probe", "echantillon", "muestra", "campione", "monster"],
    &[
        "samplename",
        "probenname",
        "probename",
        "probenbezeichnung",
        "nomechantillon",
        "nomdechantillon",
        "nomdelechantillon",
        "nombremuestra",
        "nombredemuestra",
        "nombredelamuestra",
        "nomecampione",
        "nomedelcampione",
        "monsternaam",
        "naammonster",
    ],
    &["dataname", "usercolorname", "usercolourname"],
    &[
        "colorname",
        "colourname",
        "farbname",
        "nomdelacouleur",
        "nombredelcolor",
        "nomecolore",
        "kleurnaam",
    ],
    &["name", "bezeichnung", "nom", "nombre", "nome", "naam"],
    &["originalcolorname", "originalcolourname"],
    &["specimen", "swatch", "patch", "label", "muster", "provino", "staal", "etikett"],
    &[
        "sampleid",
        "sampleno",
        "samplenumber",
        "probenid",
        "probennr",
        "probennummer",
        "numechantillon",
        "monsternummer",
    ],
    &[
        "pigment", "paint", "material", "color", "colour", "farbe", "farbton", "peinture",
        "couleur", "pigmento", "pintura", "pittura", "colore", "verf", "kleur",
    ],
    &["title", "titel", "titre", "titulo", "titolo", "spectrum", "spectrumname", "spektrum"],
    &[
        "filename",
        "file",
        "dateiname",
        "datei",
        "nomdufichier",
        "fichier",
        "nombredearchivo",
        "archivo",
        "nomefile",
        "bestandsnaam",
        "bestand",
    ],
    &["code", "codigo", "codice", "id", "number", "nummer", "numero", "no", "nr"],
];

/// Place in [`NAMES`] from which headings also stand above other things than names.
const GUESSED: usize = 8;

/// How surely a column with this heading holds the names of samples: 0 for the surest heading, such as
/// `Sample name`, and more for others, such as `Code`. `None` for a heading that does not name samples.
#[must_use]
pub fn name_rank(heading: &str) -> Option<usize> {
    let plain = plain(heading);
    NAMES.iter().position(|names| names.contains(&plain.as_str()))
}

/// Whether a column headed `heading` may hold something else than the names of samples, e.g. `Code`.
#[must_use]
pub fn is_guessed_name(heading: &str) -> bool {
    name_rank(heading).is_some_and(|rank| rank >= GUESSED)
}

/// Beginnings of words for a wavelength, as [`plain`] gives them.
const WAVELENGTH: [&str; 11] = [
    "wavelength",
    "wellenlange",
    "wellenlaenge",
    "longueurdonde",
    "longitudonda",
    "longitudesdeonda",
    "longituddeonda",
    "lunghezzadonda",
    "lunghezzedonda",
    "golflengte",
    "lambda",
];

/// Whether a heading names wavelengths, e.g. `Wavelength (nm)`, `Wellenl\u{e4}nge` or `nm`.
#[must_use]
pub fn is_wavelength(heading: &str) -> bool {
    if heading.contains(|letter: char| letter.is_ascii_digit()) {
        return false;
    }
    let plain = plain(heading);
    let is_lambda = heading.trim().starts_with('\u{3bb}');
    is_lambda
        || ["nm", "wl", "wlnm", "wavenm", "wave", "nanometer", "nanometers"]
            .contains(&plain.as_str())
        || WAVELENGTH.iter().any(|word| plain.starts_with(word))
}

/// Words for a property under which one sample is read several times, as [`plain`] gives them.
const CONDITIONS: [&str; 56] = [
    // Where light comes from and where it goes.
    "geometry",
    "geometries",
    "geometrie",
    "geometria",
    "angle",
    "angles",
    "winkel",
    "angulo",
    "angolo",
    "hoek",
    "aspecular",
    "illumination",
    "polarisation",
    "polarization",
    "polarizer",
    "specular",
    "sci",
    "sce",
    "filter",
    "mode",
    "modus",
    "measurementmode",
    "condition",
    "measurementcondition",
    "direction",
    "orientation",
    // Where a sample is read.
    "side",
    "seite",
    "cote",
    "lado",
    "lato",
    "zijde",
    "kant",
    // What was done to it.
    "dose",
    "doses",
    "dosis",
    "exposure",
    "exposition",
    "exposicion",
    "esposizione",
    "belichtung",
    "belichting",
    "aging",
    "ageing",
    "alterung",
    "vieillissement",
    "envejecimiento",
    "invecchiamento",
    "veroudering",
    "cycle",
    "cycles",
    "zyklus",
    "stage",
    "state",
    "treatment",
    "behandlung",
];

/// Which property a heading names, if it is one under which a sample is read several times.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ConditionKind {
    /// The directions of light and view. Readings of several are never one calibration.
    Geometry,
    /// A side, a dose, a mode of measurement and the like.
    Other,
}

/// The property that `heading` names, such as a geometry, an angle, a side or a dose. Readings of one sample
/// that differ in it are no repeated readings.
#[must_use]
pub fn condition(heading: &str) -> Option<ConditionKind> {
    // `SCI 400 nm` is a wavelength.
    if wavelength_of_header(&heading.to_lowercase()).is_some() {
        return None;
    }
    // The words of `Dose [MJ/m2]` and `exposure_h`.
    let words = heading.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty());
    let mut words = words.map(plain);
    let first = words.next()?;
    let compact = plain(heading);
    let known = |word: &String| CONDITIONS.iter().position(|known| known == word);
    let last = words.next_back();
    let found = [Some(compact), Some(first), last].into_iter().flatten().find_map(|w| known(&w));
    found.map(|at| match CONDITIONS[at] {
        "geometry" | "geometries" | "geometrie" | "geometria" | "angle" | "angles" | "winkel"
        | "angulo" | "angolo" | "hoek" | "aspecular" => ConditionKind::Geometry,
        _ => ConditionKind::Other,
    })
}

/// `name` with what tells a reading of it from the others: `Blue 45as15`, or `Blue Angle 45` for a plain
/// number.
#[must_use]
pub fn with_condition(name: &str, heading: &str, value: &str) -> String {
    if value.chars().any(char::is_alphabetic) {
        return format!("{name} {value}");
    }
    let heading = heading.split(['(', '[', '{']).next().unwrap_or(heading).trim();
    format!("{name} {heading} {value}")
}

/// Words of which one stands in the names of most whites, as [`plain`] gives them.
const WHITE: [&str; 7] = ["weiss", "blanc", "blanco", "blanca", "bianco", "bianca", "wit"];

/// Whether the name of a paint says that it is a white, e.g. `Titanwei\u{df}` or `blanc de titane`.
#[must_use]
pub fn is_white(name: &str) -> bool {
    let lower = name.to_lowercase();
    lower.contains("white")
        || name.split(|c: char| !c.is_alphanumeric()).map(plain).any(|word| {
            WHITE.contains(&word.as_str())
                || word.ends_with("weiss")
                || word.ends_with("titaanwit")
                || word.ends_with("zinkwit")
        })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_in_brackets_are_no_part_of_a_name() {
        for (heading, name, unit) in [
            ("Red [%]", "Red", Some("%")),
            ("Red (g)", "Red", Some("g")),
            ("Rouge ( wt % )", "Rouge", Some("wt %")),
            ("Red (PR101)", "Red (PR101)", None),
            ("Eosin Lake (wax)", "Eosin Lake (wax)", None),
            ("(g)", "(g)", None),
            ("Red", "Red", None),
        ] {
            assert_eq!(without_unit(heading), (name, unit), "{heading}");
        }
    }

    #[test]
    fn wavelengths_are_known_in_six_languages() {
        for heading in [
            "Wavelength (nm)",
            "wavelength_nm",
            "nm",
            "Wellenl\u{e4}nge [nm]",
            "WELLENLAENGE",
            "Longueur d'onde (nm)",
            "Longitud de onda",
            "lunghezza d\u{2019}onda",
            "Golflengte",
            "\u{3bb} (nm)",
            "WL",
        ] {
            assert!(is_wavelength(heading), "{heading}");
        }
        for heading in ["", "Wave Blue", "Red", "nm2", "lambda_400", "name", "white"] {
            assert!(!is_wavelength(heading), "{heading}");
        }
    }

    #[test]
    fn conditions_tell_readings_of_one_sample_apart() {
        use ConditionKind::{Geometry, Other};
        for (heading, wanted) in [
            ("Geometry", Some(Geometry)),
            ("Angle (deg)", Some(Geometry)),
            ("Winkel", Some(Geometry)),
            ("Measurement geometry", Some(Geometry)),
            ("Side", Some(Other)),
            ("Dose [MJ/m2]", Some(Other)),
            ("exposure_h", Some(Other)),
            ("C\u{f4}t\u{e9}", Some(Other)),
            ("Mode", Some(Other)),
            ("Model", None),
            ("SCI 400nm", None),
            ("Rectangle Red", None),
            ("Date", None),
            ("", None),
        ] {
            assert_eq!(condition(heading), wanted, "{heading}");
        }
        assert_eq!(with_condition("Blue", "Geometry", "45as15"), "Blue 45as15");
        assert_eq!(with_condition("Blue", "Dose [%]", "0.1"), "Blue Dose 0.1");
    }

    #[test]
    fn whites_are_known_in_six_languages() {
        for name in [
            "Zinc White (linseed)",
            "Titanwei\u{df}",
            "TITANWEISS",
            "blanc de titane",
            "Blanco de titanio",
            "Bianco di zinco",
            "Titaanwit",
            "Wit",
        ] {
            assert!(is_white(name), "{name}");
        }
        for name in ["With Red", "Switch", "Weissenberg Blue", "Blancmange", "Red"] {
            assert!(!is_white(name), "{name}");
        }
    }
}
