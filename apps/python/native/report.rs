//! The report on a library.

use std::sync::Arc;

use calibrate::comparison::Comparable;
use calibrate::palette::Cards;
use calibrate::quadrature::QuadratureTrial;
use documents::hint::Explain;
use pyo3::prelude::*;
use reports::{Report, Subject};

use crate::failure::{Exception, Raised};
use crate::library::Library;
use crate::light::{Light, viewing};
use crate::readings::Readings;
use crate::running::run;

/// How many wavelengths the quadratures in a report have.
const COUNTS: std::ops::RangeInclusive<usize> = 3..=12;

/// Draws the page and its figures. Returns the path inside the report's folder and the bytes of
/// each file.
#[pyfunction]
#[pyo3(signature = (library, readings, light, observer, pair, validate, progress))]
#[expect(clippy::too_many_arguments, reason = "the public face has them by name")]
pub(crate) fn report(
    py: Python<'_>,
    library: &Library,
    readings: Option<&Readings>,
    light: &Light,
    observer: &str,
    pair: Option<(String, String)>,
    validate: bool,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<Vec<(String, Vec<u8>)>> {
    let viewing = viewing(py, light, observer)?;
    let library = library.0.clone();
    let pair = match &pair {
        None => None,
        Some((first, second)) => {
            let find = |name: &str| library.find(name).raised(py, Exception::Recipe);
            Some((find(first)?, find(second)?))
        }
    };
    let readings = readings.map(|readings| Arc::clone(&readings.0));
    let drawn = run(py, progress, move |task| {
        let mut subject =
            Subject::of_library(&library, &viewing, "impasto.report").map_err(boxed)?;
        if let Some(readings) = readings {
            let set = readings.swatches().map_err(boxed)?;
            let comparable = Comparable::of(&set, &library).map_err(boxed)?;
            let comparison = comparable.with(&library, &viewing).map_err(boxed)?;
            subject.cards = comparable.set.cards(&subject.weights);
            subject.comparison = Some(comparison);
            if validate {
                let left_out = comparable.left_out(&library, &viewing, task).map_err(boxed)?;
                subject.validation = left_out;
            }
        }
        task.check().map_err(boxed)?;
        subject.quadratures = QuadratureTrial::all(&viewing, &library, &COUNTS).map_err(boxed)?;
        task.check().map_err(boxed)?;
        subject.pair = pair;
        subject.cards = match subject.comparison {
            Some(_) => subject.cards,
            None => Cards::standard(library.grid),
        };
        let report = Report::draw(&subject, task).map_err(boxed)?;
        Ok::<_, Box<dyn Explain + Send>>(report.files())
    })?;
    drawn.map_err(|error| Exception::Fit.of(py, &*error))
}

fn boxed<E: Explain + Send + 'static>(error: E) -> Box<dyn Explain + Send> {
    Box::new(error)
}
