//! What an abscissa counts.

/// The unit of an abscissa.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Axis {
    Nanometres,
    Micrometres,
    /// Waves in a centimetre.
    Wavenumbers,
}

impl Axis {
    /// The unit that `words` name, if they do.
    pub(super) fn of_words(words: &str) -> Option<Self> {
        let lower = words.to_lowercase();
        let has = |stems: &[&str]| stems.iter().any(|stem| lower.contains(stem));
        if has(&["1/cm", "cm-1", "cm^-1", "wavenumber", "wave number"]) {
            Some(Self::Wavenumbers)
        } else if has(&["micromet", "micron", "\u{b5}m", "\u{3bc}m"]) || lower.trim() == "um" {
            Some(Self::Micrometres)
        } else if has(&["nm", "nanomet", "wavelength"]) {
            Some(Self::Nanometres)
        } else {
            None
        }
    }

    /// The wavelength in nm at `x`; not finite where there is none.
    pub(super) fn nm(self, x: f64) -> f64 {
        match self {
            Self::Nanometres => x,
            Self::Micrometres => 1000.0 * x,
            Self::Wavenumbers => 1e7 / x,
        }
    }
}
