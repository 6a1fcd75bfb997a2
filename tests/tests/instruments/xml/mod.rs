//! CxF3, lamps and references: files in, spectra out.

mod counts;
mod cxf;
mod fuzz;
mod lamps;
mod referencing;

use spectra::instrument::{InstrumentError, MeasuredSpectrum, read};

/// The content of a fixture.
fn fixture(name: &str) -> Vec<u8> {
    let path = suite::program::repository(&format!("tests/fixtures/instruments_xml/{name}"));
    std::fs::read(&path).unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// The spectra in `bytes`, their format found.
fn records(file: &str, bytes: &[u8]) -> Result<Vec<MeasuredSpectrum>, InstrumentError> {
    read(file, bytes, None).map(|file| file.spectra)
}
