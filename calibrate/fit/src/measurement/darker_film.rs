//! A film that is darker over the brighter of two cards.

use std::fmt;

/// Where a film of paint is darker over the brighter of two cards, which no paint can be.
#[derive(Debug, Clone, PartialEq)]
pub struct DarkerFilm {
    /// File name as the caller gave it.
    pub file: String,
    /// Row of the first reading of the sample, the header being row 1.
    pub row: u64,
    /// Name of the sample.
    pub sample: String,
    /// Backing whose bare card is the brighter.
    pub bright: String,
    /// Backing whose bare card is the darker.
    pub dark: String,
    /// Largest difference of reflectance.
    pub by: f64,
    /// Wavelength of the largest difference, in nm.
    pub nm: f64,
    /// First and last wavelength at which the film is too dark, in nm.
    pub band_nm: [f64; 2],
    /// Number of further samples with this fault.
    pub others: usize,
}

impl fmt::Display for DarkerFilm {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { file, row, sample, bright, dark, by, nm, band_nm: [first, last], others } = self;
        write!(
            f,
            "{file}, row {row}: sample {sample} is darker over the brighter card {bright} than over {dark}, by {by:.3} at {nm} nm (too dark from {first} to {last} nm)"
        )?;
        match others {
            0 => Ok(()),
            1 => f.write_str("; one more sample is"),
            _ => write!(f, "; {others} more samples are"),
        }
    }
}
