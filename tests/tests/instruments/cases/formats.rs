//! Files of formats with fields of their own, one row a case.

use super::Gives::{self, Refused, Spectra};

/// YUNITS of a JCAMP-DX file, the value of a white, and what the file gives.
#[rustfmt::skip]
pub(super) const JCAMP: &[(&str, f64, Gives)] = &[
    ("REFLECTANCE", 1.0, Spectra("Made")),
    ("% REFLECTANCE", 100.0, Spectra("Made")),
    ("%R", 100.0, Spectra("Made")),
    ("PERCENT REFLECTANCE", 100.0, Spectra("Made")),
    ("Reflectance factor", 1.0, Spectra("Made")),
    ("TRANSMITTANCE", 1.0, Refused("transmittance")),
    ("% TRANSMITTANCE", 100.0, Refused("transmittance")),
    ("%T", 100.0, Refused("transmittance")),
    ("T", 1.0, Refused("transmittance")),
    ("ABSORBANCE", 1.0, Refused("absorbance")),
    ("A", 1.0, Refused("absorbance")),
    ("Abs", 1.0, Refused("absorbance")),
    ("OD", 1.0, Refused("absorbance")),
    ("LOG(1/R)", 1.0, Refused("absorbance")),
    ("LOG 1/R", 1.0, Refused("absorbance")),
    ("EXTINCTION", 1.0, Refused("absorbance")),
    ("KUBELKA-MUNK", 1.0, Refused("K/S")),
    ("K/S", 1.0, Refused("K/S")),
    ("F(R)", 1.0, Refused("K/S")),
    ("COUNTS", 1000.0, Refused("counts")),
    ("VARIANCE", 1.0, Refused("deviation")),
    ("STANDARD DEVIATION", 1.0, Refused("deviation")),
    ("ARBITRARY UNITS", 1.0, Refused("ARBITRARY UNITS")),
    ("VOLTS", 1.0, Refused("VOLTS")),
    ("FROBS", 1.0, Refused("FROBS")),
    ("IRRADIANCE", 1.0, Refused("power")),
    ("W/M2/NM", 1.0, Refused("power")),
    ("PHOTONS", 1.0, Refused("photons")),
];

/// Heading before the wavelength, the value of a white, the last patch's factor, and what the file gives.
#[rustfmt::skip]
pub(super) const CGATS: &[(&str, f64, f64, Gives)] = &[
    ("SPECTRAL_NM", 100.0, 0.01, Spectra("A|B|C|D|Black")),
    ("SPECTRAL_NM", 1.0, 0.01, Spectra("A|B|C|D|Black")),
    ("SPECTRAL_NM_", 100.0, 0.01, Spectra("A|B|C|D|Black")),
    ("SPECTRAL_", 100.0, 0.01, Spectra("A|B|C|D|Black")),
    ("SPEC_", 100.0, 0.01, Spectra("A|B|C|D|Black")),
    ("NM_", 100.0, 0.01, Spectra("A|B|C|D|Black")),
    ("nm", 100.0, 0.01, Spectra("A|B|C|D|Black")),
    ("R_", 1.0, 1.0, Spectra("A|B|C|D|Black")),
];
