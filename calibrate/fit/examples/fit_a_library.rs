//! Fits a pigment library to a measurement file and saves it:
//! `cargo run --release -p impasto-calibrate --example fit_a_library [READINGS [LIBRARY.json]]`.

use std::error::Error;
use std::io::Write;

use calibrate::{FitRequest, Readings};

fn main() -> Result<(), Box<dyn Error>> {
    let oils = concat!(env!("CARGO_MANIFEST_DIR"), "/../../measurements/van-gogh-oils.csv");
    let mut arguments = std::env::args().skip(1);
    let readings = Readings::open(arguments.next().unwrap_or_else(|| oils.to_owned()))?;
    let fit = calibrate::fit(&readings, &FitRequest::default())?;

    let mut out = std::io::stdout().lock();
    for remark in readings.remarks.iter().chain(&fit.remarks) {
        writeln!(out, "{remark}")?;
    }
    writeln!(out, "{}", fit.report().with_samples(12))?;
    for warning in fit.warnings() {
        writeln!(out, "warning: {warning}")?;
    }
    if let Some(path) = arguments.next() {
        fit.library.save(&path)?;
        writeln!(out, "Wrote {path}")?;
    }
    Ok(())
}
