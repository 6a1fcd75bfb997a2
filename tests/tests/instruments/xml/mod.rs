//! CxF3 files, lamps, and counts referenced to a white and a dark.

mod counts;
mod cxf;
mod fuzz;
mod lamps;
mod referencing;

use spectra::instrument::{InstrumentError, MeasuredSpectrum, read};

/// Content of a file in tests/fixtures/instruments_xml.
fn fixture(name: &str) -> Vec<u8> {
    let path = suite::program::repository(&format!("tests/fixtures/instruments_xml/{name}"));
    std::fs::read(&path).unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// Reads the spectra in `bytes` with detection of the format.
fn records(file: &str, bytes: &[u8]) -> Result<Vec<MeasuredSpectrum>, InstrumentError> {
    read(file, bytes, None).map(|file| file.spectra)
}
