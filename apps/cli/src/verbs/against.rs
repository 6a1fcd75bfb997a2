//! `impasto color --against` compares two sets of measurements sample by sample.

use std::path::PathBuf;

use calibrate::agreement::SetComparison;
use calibrate::evaluate::Viewing;
use calibrate::{CompareRequest, compare_sets};
use documents::{column_width, counted};
use serde_json::Value;

use crate::console::Console;
use crate::failure::{Failure, Result};
use crate::readings::{ReadingOptions, spectra};

/// Two sets of measurements, and how they are compared.
pub(super) struct Against<'a> {
    pub(super) files: &'a [PathBuf],
    pub(super) against: &'a [PathBuf],
    pub(super) lights: &'a [Viewing],
    pub(super) tolerance: Option<f64>,
    pub(super) reading: &'a ReadingOptions,
    pub(super) json: bool,
    pub(super) csv: bool,
}

impl Against<'_> {
    /// Compares the sets under every light. A sample that fails ends with exit status 1.
    pub(super) fn run(&self, console: &mut Console<'_>) -> Result<()> {
        let first = spectra(self.files, self.reading, console)?;
        let second = spectra(self.against, self.reading, console)?;
        let found = self.lights.iter().map(|viewing| {
            let viewing = viewing.clone();
            let request = CompareRequest { tolerance: self.tolerance, viewing };
            compare_sets(&first, &second, &request)
        });
        let found: Vec<SetComparison> = found.collect::<Result<_, _>>()?;
        console.remarks(&found[0].remarks)?;
        if self.json {
            let all: Vec<Value> = found.iter().map(SetComparison::to_json).collect();
            console.json(&Value::from(all))?;
        } else if self.csv {
            let rows = found.iter().flat_map(SetComparison::rows_under_light);
            console.csv_rows(&rows.collect::<Vec<_>>())?;
        } else {
            found.iter().try_for_each(|one| print(one, console))?;
        }
        let failed: usize = found.iter().map(|one| one.failed().count()).sum();
        let compared: usize = found.iter().map(|one| one.samples.len()).sum();
        match self.tolerance {
            Some(tolerance) if failed > 0 => Err(Failure::data(
                format!(
                    "{failed} of {} differ by more than the tolerance of {tolerance} CIEDE2000",
                    counted(compared, "sample")
                ),
                "see the list above",
            )),
            _ => Ok(()),
        }
    }
}

fn print(found: &SetComparison, console: &mut Console<'_>) -> Result<()> {
    let Viewing { illuminant, observer } = &found.viewing;
    console.line(format!("{}, observer {observer}", illuminant.name()))?;
    let width = column_width(found.samples.iter().map(|s| &s.name), 6);
    console.line(format!("{:width$}  CIEDE2000     dL*     da*     db*", "sample"))?;
    for sample in &found.samples {
        let [dl, da, db] = [0, 1, 2]
            .map(|axis: usize| sample.lab.to_array()[axis] - sample.standard.to_array()[axis]);
        let passes = match sample.passes {
            Some(true) => "  pass",
            Some(false) => "  FAIL",
            None => "",
        };
        console.line(format!(
            "{:width$}  {:9.2} {dl:7.2} {da:7.2} {db:7.2}{passes}",
            sample.name, sample.differences.ciede2000
        ))?;
    }
    let [dl, da, db] = found.shift;
    console.line(format!(
        "{}: mean {:.2}, 95 % below {:.2}, largest {:.2}; mean shift dL* {dl:.2}, da* {da:.2}, db* {db:.2}",
        counted(found.samples.len(), "sample"),
        found.mean,
        found.p95,
        found.max
    ))?;
    if let Some(tolerance) = found.tolerance {
        let failed = found.failed().count();
        let passed = found.samples.len() - failed;
        console.line(format!("{passed} pass and {failed} fail at {tolerance} CIEDE2000"))?;
    }
    Ok(())
}
