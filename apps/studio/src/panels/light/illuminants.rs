//! The CIE illuminants with their kinds and descriptions.

use spectra::Illuminant;

/// Kind of light source.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Kind {
    /// Daylight phases and their indoor versions.
    Daylight,
    /// Incandescent (tungsten) lamps.
    Incandescent,
    /// Fluorescent tubes of the FL series.
    Fluorescent,
    /// High-pressure discharge lamps.
    Discharge,
    /// White LED lamps.
    Led,
    /// Theoretical illuminants such as E.
    Reference,
}

impl Kind {
    /// Name shown in the list.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Daylight => "Daylight",
            Self::Incandescent => "Incandescent",
            Self::Fluorescent => "Fluorescent",
            Self::Discharge => "High-pressure discharge",
            Self::Led => "LED",
            Self::Reference => "Reference",
        }
    }
}

/// An illuminant of the list.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct ListedIlluminant {
    /// Name of the illuminant in `spectra`.
    pub(super) name: &'static str,
    /// Kind of light source.
    pub(super) kind: Kind,
    /// Short description, from CIE 15:2018.
    pub(super) note: &'static str,
}

impl ListedIlluminant {
    /// Whether name, kind or note contain every word of `search`, ignoring case.
    pub(super) fn matches(&self, search: &str) -> bool {
        let text = format!("{} {} {}", self.name, self.kind.name(), self.note).to_lowercase();
        search.to_lowercase().split_whitespace().all(|word| text.contains(word))
    }
}

/// All illuminants of `spectra`, grouped by kind, each group in the CIE's order.
pub(super) fn listed_illuminants() -> Vec<ListedIlluminant> {
    let lamp = |name: &'static str| {
        let (kind, note) = description(name);
        ListedIlluminant { name, kind, note }
    };
    let mut lamps: Vec<ListedIlluminant> = Illuminant::names().map(lamp).collect();
    lamps.sort_by_key(|lamp| lamp.kind);
    lamps
}

fn description(name: &str) -> (Kind, &'static str) {
    let number = |prefix: &str| name.strip_prefix(prefix).and_then(|rest| rest.parse::<u32>().ok());
    if let Some(of_third_set) = number("FL3.") {
        let note = match of_third_set {
            1..=3 => "halophosphate tube",
            4..=6 => "de luxe tube",
            7..=11 => "three-band tube",
            12..=14 => "multi-band tube",
            _ => "daylight simulator tube",
        };
        return (Kind::Fluorescent, note);
    }
    if let Some(of_first_set) = number("FL") {
        let note = match of_first_set {
            1..=6 => "standard tube",
            7..=9 => "broad-band tube",
            _ => "three-band tube",
        };
        return (Kind::Fluorescent, note);
    }
    match name {
        "A" => (Kind::Incandescent, "tungsten filament, 2856 K"),
        "B" => (Kind::Daylight, "noon sun, withdrawn"),
        "C" => (Kind::Daylight, "average daylight, withdrawn"),
        "D50" => (Kind::Daylight, "horizon light, graphic arts"),
        "D55" => (Kind::Daylight, "mid-morning, photography"),
        "D60" => (Kind::Daylight, "cinema white"),
        "D65" => (Kind::Daylight, "noon daylight, the usual reference"),
        "D75" => (Kind::Daylight, "north sky"),
        "ID50" => (Kind::Daylight, "D50 through a window pane"),
        "ID65" => (Kind::Daylight, "D65 through a window pane"),
        "E" => (Kind::Reference, "equal power at every wavelength"),
        "HP1" => (Kind::Discharge, "high-pressure sodium"),
        "HP2" => (Kind::Discharge, "colour-enhanced high-pressure sodium"),
        "HP3" | "HP4" | "HP5" => (Kind::Discharge, "metal halide"),
        "LED-BH1" => (Kind::Led, "blue LED with phosphor, and a red LED"),
        "LED-RGB1" => (Kind::Led, "red, green and blue LEDs"),
        "LED-V1" | "LED-V2" => (Kind::Led, "violet LED with phosphors"),
        _ if name.starts_with("LED-B") => (Kind::Led, "blue LED with phosphor"),
        _ => (Kind::Reference, ""),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const KINDS: [Kind; 6] = [
        Kind::Daylight,
        Kind::Incandescent,
        Kind::Fluorescent,
        Kind::Discharge,
        Kind::Led,
        Kind::Reference,
    ];

    #[test]
    fn every_illuminant_is_listed_once_with_a_note() {
        let listed = listed_illuminants();
        let mut names: Vec<&str> = listed.iter().map(|lamp| lamp.name).collect();
        let mut known: Vec<&str> = Illuminant::names().collect();
        names.sort_unstable();
        known.sort_unstable();
        assert_eq!(names, known);
        for lamp in &listed {
            assert!(!lamp.note.is_empty(), "{} has no description", lamp.name);
        }
    }

    #[test]
    fn lamps_are_grouped_by_kind() {
        let listed = listed_illuminants();
        assert!(listed.is_sorted_by_key(|lamp| lamp.kind), "{listed:?}");
        assert_eq!(
            KINDS.map(|kind| listed.iter().filter(|lamp| lamp.kind == kind).count()),
            [9, 1, 27, 5, 9, 1]
        );
    }

    #[test]
    fn the_search_matches_words_of_name_kind_and_note() {
        let found = |search: &str| -> Vec<&str> {
            listed_illuminants()
                .into_iter()
                .filter(|lamp| lamp.matches(search))
                .map(|lamp| lamp.name)
                .collect()
        };
        assert_eq!(found("window PANE"), ["ID50", "ID65"]);
        assert_eq!(found("violet"), ["LED-V1", "LED-V2"]);
        assert_eq!(found("led-rgb"), ["LED-RGB1"]);
        assert_eq!(found("").len(), Illuminant::names().count());
        assert!(found("candle").is_empty(), "there is no candle");
    }
}
