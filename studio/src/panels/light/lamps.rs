//! The CIE's illuminants for people: what kind of light each is.

use spectra::Illuminant;

/// Kinds of light.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Kind {
    /// Of sun and sky.
    Daylight,
    /// Glowing.
    Incandescent,
    /// Tubes.
    Fluorescent,
    /// High-pressure lamps of streets and halls.
    Discharge,
    /// Light-emitting diodes.
    Led,
    /// Of no lamp.
    Reference,
}

impl Kind {
    /// Every kind, in the order of the list.
    pub(super) const ALL: [Self; 6] = [
        Self::Daylight,
        Self::Incandescent,
        Self::Fluorescent,
        Self::Discharge,
        Self::Led,
        Self::Reference,
    ];

    /// Its name.
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
pub(super) struct Lamp {
    /// As `spectra` names it.
    pub(super) name: &'static str,
    /// What kind it is.
    pub(super) kind: Kind,
    /// What it stands for (CIE 15:2018).
    pub(super) note: &'static str,
}

impl Lamp {
    /// Whether every word of `search`, in any case, is in name, kind or note.
    pub(super) fn answers(&self, search: &str) -> bool {
        let told = format!("{} {} {}", self.name, self.kind.name(), self.note).to_lowercase();
        search.to_lowercase().split_whitespace().all(|word| told.contains(word))
    }
}

/// All that `spectra` has, by kind, each kind in the CIE's order.
pub(super) fn lamps() -> Vec<Lamp> {
    let lamp = |name: &'static str| {
        let (kind, note) = described(name);
        Lamp { name, kind, note }
    };
    let mut lamps: Vec<Lamp> = Illuminant::names().map(lamp).collect();
    lamps.sort_by_key(|lamp| lamp.kind);
    lamps
}

fn described(name: &str) -> (Kind, &'static str) {
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

    #[test]
    fn every_illuminant_stands_in_the_list_once_and_is_described() {
        let listed = lamps();
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
        let listed = lamps();
        assert!(listed.is_sorted_by_key(|lamp| lamp.kind), "{listed:?}");
        let of = |kind| listed.iter().filter(|lamp| lamp.kind == kind).count();
        assert_eq!(Kind::ALL.map(of), [9, 1, 27, 5, 9, 1]);
    }

    #[test]
    fn the_search_takes_words_of_name_kind_and_note_in_any_case() {
        let found = |search: &str| -> Vec<&str> {
            lamps().into_iter().filter(|lamp| lamp.answers(search)).map(|lamp| lamp.name).collect()
        };
        assert_eq!(found("window PANE"), ["ID50", "ID65"]);
        assert_eq!(found("violet"), ["LED-V1", "LED-V2"]);
        assert_eq!(found("led-rgb"), ["LED-RGB1"]);
        assert_eq!(found("").len(), Illuminant::names().count());
        assert!(found("candle").is_empty(), "there is no candle");
    }
}
