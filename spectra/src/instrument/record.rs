//! One spectrum out of an instrument's file.

/// What an instrument says that it measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MeasuredQuantity {
    /// Reflectance factor.
    Reflectance,
    /// Transmittance.
    Transmittance,
    /// Power of a light: radiance, irradiance or relative power.
    Power,
    /// A detector's counts, to be set against a white and a dark reading.
    Counts,
    /// The file does not say.
    Unstated,
}

/// The unit of a [`Record`]'s values.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unit {
    /// White near 100.
    Percent,
    /// White near 1.
    Fraction,
    /// Anything else, or nothing said.
    Unstated,
}

/// One spectrum, as the file has it.
#[derive(Debug, Clone, PartialEq)]
pub struct Record {
    /// The sample's name; the file's own word for it, else its place in the file.
    pub name: String,
    /// What was measured.
    pub quantity: MeasuredQuantity,
    /// The unit of `values`.
    pub unit: Unit,
    /// Wavelengths in nm, rising strictly; at least one.
    pub wavelengths_nm: Vec<f64>,
    /// One value for each wavelength, finite, otherwise as written.
    pub values: Vec<f64>,
    /// The line on which the record begins, counted from 1.
    pub line: usize,
    /// What else the file says of it (geometry, instrument, integration time ..), in its own
    /// words and order.
    pub details: Vec<(String, String)>,
}
