//! The unit of a spectrum's abscissa.

/// The unit of an abscissa.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Axis {
    /// Wavelength in nm.
    Nanometres,
    /// Wavelength in micrometres.
    Micrometres,
    /// Waves per centimetre.
    Wavenumbers,
}

impl Axis {
    /// The unit named in `words`, such as a column heading; `None` if there is none.
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

    /// Wavelength in nm at the abscissa `x`; not finite for a wavenumber of 0.
    pub(super) fn nm(self, x: f64) -> f64 {
        match self {
            Self::Nanometres => x,
            Self::Micrometres => 1000.0 * x,
            Self::Wavenumbers => 1e7 / x,
        }
    }
}
