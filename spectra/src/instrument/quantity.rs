//! The quantity that an instrument measured, found in the words of its file.
//!
//! Headings of columns are names of paints as often as quantities. So a word decides only if a paint
//! is not called by it, as in `Reflectance of Raw Umber`, or if every word belongs to a quantity, as
//! in `raw counts`. Raw Umber, Power Pink and Microscope are names.

/// The quantity that an instrument measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MeasuredQuantity {
    /// Reflectance factor, relative to a perfect diffuser.
    Reflectance,
    /// Transmittance factor, relative to the incident light.
    Transmittance,
    /// Absorbance, also called optical density or extinction: the negative decimal logarithm of a
    /// reflectance or transmittance.
    Absorbance,
    /// Kubelka-Munk's K/S of a reflectance, also written F(R).
    KubelkaMunk,
    /// Optical constant of a material: n or k.
    OpticalConstant,
    /// Power of a light: radiance, irradiance or relative power.
    Power,
    /// Number of photons of a light.
    Photons,
    /// Counts of a detector, which give reflectance relative to a white and a dark reading.
    Counts,
    /// Standard deviations or errors of another column.
    Deviation,
    /// A quantity that the file states in a word that we do not know.
    Unknown,
    /// The file does not state the quantity.
    Unstated,
}

impl std::fmt::Display for MeasuredQuantity {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Reflectance => "reflectance",
            Self::Transmittance => "transmittance",
            Self::Absorbance => "absorbance",
            Self::KubelkaMunk => "Kubelka-Munk's K/S",
            Self::OpticalConstant => "an optical constant",
            Self::Power => "the power of a light",
            Self::Photons => "a number of photons",
            Self::Counts => "a detector's counts",
            Self::Deviation => "a deviation",
            Self::Unknown => "a quantity that we do not know",
            Self::Unstated => "an unstated quantity",
        })
    }
}

use MeasuredQuantity::{
    Absorbance, Counts, Deviation, KubelkaMunk, OpticalConstant, Photons, Power, Reflectance,
    Transmittance, Unknown, Unstated,
};

/// Beginnings of words that no paint is called by.
const PLAIN: [(&str, MeasuredQuantity); 14] = [
    ("reflectan", Reflectance),
    ("reflectiv", Reflectance),
    ("reflexion", Reflectance),
    ("remission", Reflectance),
    ("transmittan", Transmittance),
    ("transmissi", Transmittance),
    ("absorban", Absorbance),
    ("extinction", Absorbance),
    ("extinktion", Absorbance),
    ("irradian", Power),
    ("radiance", Power),
    ("counts", Counts),
    ("photon", Photons),
    ("kubelka", KubelkaMunk),
];

/// Words that state a quantity only among words that belong to one. Names of paints hold them too.
const BESIDE_OTHERS: [(&str, MeasuredQuantity); 43] = [
    ("reflect", Reflectance),
    ("reflection", Reflectance),
    ("reflected", Reflectance),
    ("refl", Reflectance),
    ("rfl", Reflectance),
    ("transmit", Transmittance),
    ("transmitted", Transmittance),
    ("trans", Transmittance),
    ("abs", Absorbance),
    ("absorption", Absorbance),
    ("absorptance", Absorbance),
    ("density", Absorbance),
    ("od", Absorbance),
    ("count", Counts),
    ("raw", Counts),
    ("scope", Counts),
    ("dn", Counts),
    ("power", Power),
    ("emission", Power),
    ("energy", Power),
    ("radiant", Power),
    ("flux", Power),
    ("spd", Power),
    ("watt", Power),
    ("watts", Power),
    ("quanta", Photons),
    ("quantum", Photons),
    ("qntm", Photons),
    ("ppfd", Photons),
    ("umol", Photons),
    ("std", Deviation),
    ("dev", Deviation),
    ("sd", Deviation),
    ("stdev", Deviation),
    ("stddev", Deviation),
    ("sigma", Deviation),
    ("err", Deviation),
    ("error", Deviation),
    ("deviation", Deviation),
    ("deviations", Deviation),
    ("variance", Deviation),
    ("uncertainty", Deviation),
    ("rmse", Deviation),
];

/// Words that may stand beside a quantity and say nothing about it.
const NEUTRAL: [&str; 56] = [
    "a",
    "absolute",
    "arb",
    "arbitrary",
    "average",
    "averaged",
    "avg",
    "b",
    "cm",
    "corrected",
    "cps",
    "data",
    "diffuse",
    "dimensionless",
    "dt",
    "factor",
    "fraction",
    "g",
    "hemispherical",
    "hz",
    "in",
    "intensity",
    "m",
    "mean",
    "measured",
    "mw",
    "nm",
    "none",
    "of",
    "optical",
    "per",
    "percent",
    "processed",
    "ratio",
    "relative",
    "s",
    "sample",
    "samples",
    "scaled",
    "signal",
    "smoothed",
    "spectra",
    "spectral",
    "spectrum",
    "specular",
    "sr",
    "standard",
    "the",
    "total",
    "u",
    "unit",
    "unitless",
    "units",
    "uw",
    "value",
    "values",
];

/// Signs of a quantity or a unit, in a text without blanks and in small letters.
const SIGNS: [(&str, MeasuredQuantity); 5] = [
    ("f(r)", KubelkaMunk),
    ("log(1/r)", Absorbance),
    ("log1/r", Absorbance),
    ("log(1/t)", Absorbance),
    ("log10(1/r)", Absorbance),
];

impl MeasuredQuantity {
    /// The quantity named in `text`, for example in the heading of a column or in the lines above a table.
    pub(super) fn of_words(text: &str) -> Self {
        let small = text.to_lowercase();
        let words = words_of(text);
        let found = |table: &[(&str, Self)], is: fn(&str, &str) -> bool| {
            let quantities = words.iter().filter_map(|word| {
                table.iter().find(|(known, _)| is(word, known)).map(|(_, quantity)| *quantity)
            });
            quantities.collect::<Vec<Self>>()
        };
        let beside = found(&BESIDE_OTHERS, |word, known| word == known);
        let plain = found(&PLAIN, |word, known| word.starts_with(known));
        let belongs = |word: &String| {
            word.parse::<f64>().is_ok()
                || NEUTRAL.contains(&word.as_str())
                || BESIDE_OTHERS.iter().any(|(known, _)| word == known)
                || PLAIN.iter().any(|(known, _)| word.starts_with(known))
                || (small.contains('%') && ["r", "t"].contains(&word.as_str()))
        };
        let all_belong = words.iter().all(belongs);
        if all_belong && beside.contains(&Deviation) {
            return Deviation;
        }
        let compact: String = small.chars().filter(|c| !c.is_whitespace()).collect();
        let signs = SIGNS.iter().find(|(sign, _)| compact.contains(sign));
        let sign = signs.map(|(_, quantity)| *quantity);
        let sign = sign.or_else(|| (compact == "k/s").then_some(KubelkaMunk));
        let per_area = small.split_whitespace().map(per_area_or_band);
        // Photons are counted per area and band, as power is measured, and named beside it.
        if let Some(quantity) = plain.iter().find(|quantity| **quantity == Photons) {
            return *quantity;
        }
        if let Some(quantity) = plain.first().copied().or(sign) {
            return quantity;
        }
        if let Some(quantity) = per_area.flatten().next() {
            return quantity;
        }
        if all_belong {
            if let Some(quantity) = beside.first() {
                return *quantity;
            }
            if small.contains('%') && words == ["r"] {
                return Reflectance;
            }
            if small.contains('%') && words == ["t"] {
                return Transmittance;
            }
        }
        // `GR8 0+3 (QNTM)`: no name of a paint holds a unit of photons in brackets.
        let bracketed =
            text.split(['(', '[']).skip(1).filter_map(|rest| rest.split([')', ']']).next());
        let is_of_photons = |unit: &str| {
            let words = words_of(unit);
            let all = words.iter().all(|word| {
                NEUTRAL.contains(&word.as_str()) || word.parse::<f64>().is_ok() || is_photons(word)
            });
            all && words.iter().any(|word| is_photons(word))
        };
        if bracketed.into_iter().any(is_of_photons) {
            return Photons;
        }
        Unstated
    }

    /// The quantity named in the heading of a column. If it is the only column of values, or one of n and
    /// k, a letter states a quantity too.
    pub(super) fn of_heading(heading: &str, headings_of_values: &[&str]) -> Self {
        let are_constants = headings_of_values.iter().all(|heading| ["n", "k"].contains(heading));
        let is_field = headings_of_values.len() == 1 || are_constants;
        match Self::of_words(heading) {
            Unstated if is_field => match Self::of_field(heading) {
                Unknown => Unstated,
                stated => stated,
            },
            stated => stated,
        }
    }

    /// The quantity that a field such as YUNITS of JCAMP-DX names. This field holds nothing but a quantity, so
    /// single letters count too: `A` is absorbance and `T` transmittance.
    pub(super) fn of_field(text: &str) -> Self {
        let known = match text.trim().to_lowercase().as_str() {
            "" | "intensity" | "none" => Some(Unstated),
            "r" => Some(Reflectance),
            "t" => Some(Transmittance),
            "a" | "au" | "o.d." => Some(Absorbance),
            "k-m" | "km" => Some(KubelkaMunk),
            "n" | "k" => Some(OpticalConstant),
            _ => None,
        };
        known.unwrap_or_else(|| match Self::of_words(text) {
            // A percentage without a word is relative to a white.
            Unstated if words_of(text).iter().all(|word| word == "percent") => Unstated,
            Unstated => Unknown,
            stated => stated,
        })
    }
}

fn is_photons(word: &str) -> bool {
    BESIDE_OTHERS.iter().any(|(known, quantity)| word == *known && *quantity == Photons)
}

/// Whether a text states that values are in percent: by a word or a sign that does not follow a number, as
/// in `50% tint` or `100 % abundance`.
pub(super) fn states_percent(text: &str) -> bool {
    let lower = text.to_lowercase();
    let mut signs = lower.match_indices('%').chain(lower.match_indices("percent"));
    signs.any(|(at, _)| {
        let before = lower[..at].trim_end().chars().last();
        !before.is_some_and(|letter| letter.is_ascii_digit())
    })
}

/// Whether a line above a table states that its values are in percent. It must speak of a quantity, or of
/// units only.
pub(super) fn line_states_percent(line: &str) -> bool {
    let is_of_units = |word: &String| NEUTRAL.contains(&word.as_str()) || word == "y";
    states_percent(line)
        && (MeasuredQuantity::of_words(line) != Unstated || words_of(line).iter().all(is_of_units))
}

/// The words of `text` in small letters. `SpectralReflectance` and `spectral_reflectance` have two.
fn words_of(text: &str) -> Vec<String> {
    let mut words = vec![String::new()];
    let mut was_small = false;
    for letter in text.chars() {
        if !letter.is_alphanumeric() || (was_small && letter.is_uppercase()) {
            words.push(String::new());
        }
        if letter.is_alphanumeric() {
            words.last_mut().expect("there is a word").extend(letter.to_lowercase());
        }
        was_small = letter.is_lowercase();
    }
    words.retain(|word| !word.is_empty());
    // `StdDev` is one word.
    let joined = words.join("");
    match joined.as_str() {
        "stddev" | "stdev" => vec![joined],
        _ => words,
    }
}

/// Power or photons if `word` is a unit per area, angle or band, such as `(uW/cm2/nm)`.
fn per_area_or_band(word: &str) -> Option<MeasuredQuantity> {
    let unit = word.trim_start_matches(['(', '[', '{']);
    let (first, rest) = unit.split_once(['/', '*', '.', '\u{b7}'])?;
    let is_per = ["m", "cm", "nm", "sr", "s"].iter().any(|per| rest.starts_with(per));
    let is_of = |names: &[&str]| {
        names.iter().any(|name| {
            first.strip_suffix(name).is_some_and(|prefix| {
                ["", "u", "\u{b5}", "\u{3bc}", "m", "k", "n", "p"].contains(&prefix)
            })
        })
    };
    match is_per {
        true if is_of(&["w", "watt", "watts"]) => Some(Power),
        true if is_of(&["mol", "mole", "moles"]) => Some(Photons),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_paints_state_no_quantity() {
        for name in [
            "Raw Umber",
            "Raw Sienna (PBr7)",
            "Drawdown",
            "Straw Yellow",
            "Microscope",
            "Radiant Turquoise",
            "Absorbing Black",
            "Power Pink",
            "Countess Rose",
            "Transparent Oxide",
            "Energy Green 3",
            "Reflex Blue",
            "Error Red",
            "Density test 4",
            "Yellow/Magenta",
            "Std White",
            "A",
            "R",
            "T1",
            "K/S lab card",
            "",
        ] {
            assert_eq!(MeasuredQuantity::of_words(name), Unstated, "{name}");
        }
    }

    #[test]
    fn words_and_units_state_quantities() {
        for (text, wanted) in [
            ("Reflectance", Reflectance),
            ("SpectralReflectance", Reflectance),
            ("reflectance_factor of Raw Umber", Reflectance),
            ("% Reflectance", Reflectance),
            ("Reflect. %", Reflectance),
            ("%R", Reflectance),
            ("R%", Reflectance),
            ("Refl.", Reflectance),
            ("Remission [%]", Reflectance),
            ("%T", Transmittance),
            ("T%", Transmittance),
            ("T (%)", Transmittance),
            ("Transmission", Transmittance),
            ("Abs", Absorbance),
            ("Abs.", Absorbance),
            ("Absorbance (AU)", Absorbance),
            ("Optical density", Absorbance),
            ("Extinction", Absorbance),
            ("log(1/R)", Absorbance),
            ("LOG (1/R)", Absorbance),
            ("K/S", KubelkaMunk),
            ("F(R)", KubelkaMunk),
            ("Kubelka-Munk", KubelkaMunk),
            ("Irradiance", Power),
            ("uW/cm2/nm", Power),
            ("lamp (W/m2/nm)", Power),
            ("\u{b5}W/cm^2/nm", Power),
            ("Energy", Power),
            ("Radiant flux", Power),
            ("SPD", Power),
            ("Emission", Power),
            ("PPFD", Photons),
            ("Quantum", Photons),
            ("umol/m2/s/nm", Photons),
            ("Photon irradiance", Photons),
            ("raw counts", Counts),
            ("Raw", Counts),
            ("Scope", Counts),
            ("Counts of Raw Umber", Counts),
            ("DN", Counts),
            ("StdDev", Deviation),
            ("Std. Dev.", Deviation),
            ("Error", Deviation),
            ("Reflectance std", Deviation),
            ("value", Unstated),
            ("intensity", Unstated),
        ] {
            assert_eq!(MeasuredQuantity::of_words(text), wanted, "{text}");
        }
    }

    #[test]
    fn percent_is_a_unit_only_where_no_number_stands_before_it() {
        for (text, wanted) in [
            ("Reflectance[%]", true),
            ("%R", true),
            ("Red %", true),
            ("Reflectance (percent)", true),
            ("Y Units: %", true),
            ("50% tint", false),
            ("100 % abundance", false),
            ("Reflectance", false),
        ] {
            assert_eq!(states_percent(text), wanted, "{text}");
        }
        for (text, wanted) in [
            ("Y Units: Reflectance (percent)", true),
            ("Units: %", true),
            ("100% abundance of quartz", false),
            ("humidity in %", false),
            ("Reflectance of 100% cotton", false),
        ] {
            assert_eq!(line_states_percent(text), wanted, "{text}");
        }
    }

    #[test]
    fn photons_are_found_in_brackets() {
        for (text, wanted) in [
            ("REM: GR8 0+3           (QNTM)", Photons),
            ("lamp [umol m-2 s-1]", Photons),
            ("Cadmium Red (quantum dots)", Unstated),
            ("Blue (raw)", Unstated),
        ] {
            assert_eq!(MeasuredQuantity::of_words(text), wanted, "{text}");
        }
    }

    #[test]
    fn the_unit_of_a_field_is_known_or_refused() {
        for (text, wanted) in [
            ("REFLECTANCE", Reflectance),
            ("%R", Reflectance),
            ("R", Reflectance),
            ("TRANSMITTANCE", Transmittance),
            ("%T", Transmittance),
            ("A", Absorbance),
            ("ABSORBANCE", Absorbance),
            ("LOG(1/R)", Absorbance),
            ("KUBELKA-MUNK", KubelkaMunk),
            ("COUNTS", Counts),
            ("VARIANCE", Deviation),
            ("ARBITRARY UNITS", Unknown),
            ("mV", Unknown),
            ("PERCENT", Unstated),
            ("%", Unstated),
            ("", Unstated),
        ] {
            assert_eq!(MeasuredQuantity::of_field(text), wanted, "{text}");
        }
    }
}
