//! Whether readings hold the specular reflection, by the instrument or the geometry that a file names.

use crate::instrument::measured::MeasuredSpectrum;

/// Instruments that light a sample at 45 degrees and measure at 0, in letters and digits only.
const OF_45_0: [&str; 17] = [
    "i1pro",
    "i1basic",
    "i1xtreme",
    "i1isis",
    "i1io",
    "eyeone",
    "spectrolino",
    "spectroscan",
    "exact",
    "colormunki",
    "i1studio",
    "spectrodens",
    "spectroeye",
    "spectrodensitometer",
    "fd5",
    "fd7",
    "myiro",
];

/// A key of a detail that holds one of these names the instrument or its geometry.
const KEYS: [&str; 9] = [
    "instrument",
    "device",
    "model",
    "geometry",
    "specular",
    "spectrometer",
    "measurement_source",
    "viewing",
    "manufacturer",
];

/// The geometry that a file states, or that follows from the instrument that it names.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct StatedGeometry {
    /// The words of the file, e.g. `i1Pro 2` or `SCE`.
    pub words: String,
    /// Whether the readings hold the specular reflection.
    pub includes_specular: bool,
}

impl StatedGeometry {
    /// The geometry named in `text`: `45/0`, SCE, SCI, or an instrument. A sphere measures both, so that its
    /// name alone states nothing.
    #[must_use]
    pub fn of_words(text: &str) -> Option<Self> {
        let lower = text.to_lowercase();
        let stated = |includes_specular| {
            Some(Self { words: text.trim().chars().take(60).collect(), includes_specular })
        };
        let words: Vec<&str> = lower.split(|c: char| !c.is_alphanumeric()).collect();
        let has = |word: &str| words.contains(&word);
        if has("sce") || has("spex") || (has("specular") && has("excluded")) {
            return stated(false);
        }
        if has("sci") || has("spin") || (has("specular") && has("included")) {
            return stated(true);
        }
        let compact: String =
            lower.chars().filter(|c| c.is_alphanumeric() || "/:".contains(*c)).collect();
        let angles = ["45/0", "45:0", "0/45", "0:45", "45a:0", "45c:0", "45x:0"];
        if angles.iter().any(|angle| compact.contains(angle)) {
            return stated(false);
        }
        let letters: String = compact.chars().filter(|c| c.is_alphanumeric()).collect();
        let is_named = OF_45_0.iter().any(|name| match *name {
            // `exact` is also a word.
            "exact" => has("exact") && !has("model"),
            name => letters.contains(name),
        });
        if is_named { stated(false) } else { None }
    }
}

impl MeasuredSpectrum {
    /// Whether the file says that the spectrum holds the specular reflection, by its details. `None` if it
    /// does not.
    #[must_use]
    pub fn stated_geometry(&self) -> Option<StatedGeometry> {
        let of_instruments = self.details.iter().filter(|(key, _)| {
            let key = key.to_lowercase();
            KEYS.iter().any(|known| key.contains(known))
        });
        of_instruments.into_iter().find_map(|(_, text)| StatedGeometry::of_words(text))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn instruments_and_geometries_state_the_specular_reflection() {
        for (text, wanted) in [
            ("i1Pro 2", Some(false)),
            ("GretagMacbeth Eye-One Pro", Some(false)),
            ("X-Rite eXact", Some(false)),
            ("ColorMunki", Some(false)),
            ("Spectrolino", Some(false)),
            ("45/0", Some(false)),
            ("45\u{b0}:0\u{b0}", Some(false)),
            ("CM-700d SCE", Some(false)),
            ("CM-700d SCI", Some(true)),
            ("Specular Excluded", Some(false)),
            ("Specular included (d/8)", Some(true)),
            ("CM-700d", None),
            ("Ci7860", None),
            ("science department", None),
            ("d/8", None),
        ] {
            let found = StatedGeometry::of_words(text).map(|found| found.includes_specular);
            assert_eq!(found, wanted, "{text}");
        }
    }
}
