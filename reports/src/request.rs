//! Which report to draw: the options of a report, which every program fills in its own way, and the steps from
//! a library and readings to the subject of the report.
//!
//! Comments of the fields are the help texts of the command line and the descriptions of the schema.

use std::ops::RangeInclusive;

use calibrate::calibration::CalibrationError;
use calibrate::comparison::{Comparable, Comparison, ComparisonError};
use calibrate::evaluate::Viewing;
use calibrate::library::{PigmentLibrary, RecipeError};
use calibrate::measurement::MeasurementError;
use calibrate::quadrature::{QuadratureFailure, QuadratureTrial};
use calibrate::{PigmentId, Readings};
use documents::hint::Explain;
use documents::request::RequestError;
use documents::{Cancelled, Task};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use spectra::InterpolateError;

#[cfg(feature = "pictures")]
use crate::picture::PictureError;
use crate::subject::Subject;

/// Options of a report. [`Self::run`] makes its subject.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
#[schemars(description = "Options of a report")]
pub struct ReportRequest {
    /// Two pigments whose graded mixture is drawn [default: chosen from the library]
    pub pair: Option<(String, String)>,
    /// Skip leaving mixtures out, which takes most of the time
    pub no_validation: bool,
    /// Light and observer
    pub viewing: Viewing,
    /// The report tries every quadrature method with each of these numbers of wavelengths. We chose the default,
    /// 3 to 16, by eye. A program that people wait for may try fewer.
    #[serde(skip)]
    pub wavelengths: RangeInclusive<usize>,
}

impl Default for ReportRequest {
    fn default() -> Self {
        Self { pair: None, no_validation: false, viewing: Viewing::default(), wavelengths: 3..=16 }
    }
}

impl ReportRequest {
    /// Makes the subject of a report on a library. With readings, this compares every sample with the library
    /// and leaves out each mixture in turn, as the validation of a fit does. We print `command` with each
    /// figure. You see the stages in `task` and may cancel it.
    ///
    /// ```
    /// use calibrate::PigmentLibrary;
    /// use documents::Task;
    /// use reports::ReportRequest;
    ///
    /// let request = ReportRequest {
    ///     pair: Some(("Zinc White".to_owned(), "Cobalt Blue".to_owned())),
    ///     wavelengths: 8..=8,
    ///     ..ReportRequest::default()
    /// };
    /// let oils = PigmentLibrary::van_gogh_oils();
    /// let subject = request.run(&oils, None, "my program", &Task::default())?;
    /// let page = reports::page_alone(&subject, &Task::default());
    /// assert!(page.contains("Zinc White to Cobalt Blue"));
    /// # Ok::<(), reports::ReportError>(())
    /// ```
    ///
    /// # Errors
    /// [`ReportError`] for a name that the library does not have, readings that cannot be compared with it, a fit
    /// that fails, or if `task` was cancelled.
    pub fn run<'a>(
        &'a self,
        library: &'a PigmentLibrary,
        readings: Option<&Readings>,
        command: impl Into<String>,
        task: &Task,
    ) -> Result<Subject<'a>, ReportError> {
        self.prepare(library, readings, command)?.subject(task)
    }

    /// Does the quick part of [`Self::run`]: finds the pigments and compares the readings with the library. Use
    /// this if you want to show what is missing, or the number of mixtures, before the slow part begins.
    ///
    /// # Errors
    /// [`ReportError`] for a name that the library does not have, or readings that cannot be compared with it.
    pub fn prepare<'a>(
        &'a self,
        library: &'a PigmentLibrary,
        readings: Option<&Readings>,
        command: impl Into<String>,
    ) -> Result<PreparedReport<'a>, ReportError> {
        let mut subject = Subject::of_library(library, &self.viewing, command)?;
        subject.pair = self.pigments(library)?;
        let mut measured = None;
        if let Some(readings) = readings {
            let comparable = Comparable::of(&readings.swatches()?, library)?;
            subject.comparison = Some(comparable.with(library, &self.viewing)?);
            subject.cards = comparable.set.cards(&subject.weights);
            measured = Some(comparable);
        }
        let left_out = measured.filter(|_| !self.no_validation);
        Ok(PreparedReport { subject, left_out, wavelengths: &self.wavelengths })
    }

    /// The pigments of `pair` in the library.
    fn pigments(
        &self,
        library: &PigmentLibrary,
    ) -> Result<Option<(PigmentId, PigmentId)>, ReportError> {
        let Some((first, second)) = &self.pair else { return Ok(None) };
        let pair = (library.find(first)?, library.find(second)?);
        if pair.0 == pair.1 {
            let name = &library[pair.0].name;
            let reason = format!("takes two different pigments, found `{name}` twice");
            let error = RequestError::value(reason, "replace one of them by another pigment");
            return Err(error.at("pair").into());
        }
        Ok(Some(pair))
    }
}

/// A report of which only the slow part is left to do.
#[derive(Debug)]
pub struct PreparedReport<'a> {
    subject: Subject<'a>,
    /// Readings for leaving out each mixture in turn. `None` if this is not wanted or not possible.
    left_out: Option<Comparable>,
    wavelengths: &'a RangeInclusive<usize>,
}

impl<'a> PreparedReport<'a> {
    /// The library compared with the readings. `None` without readings.
    #[must_use]
    pub fn comparison(&self) -> Option<&Comparison> {
        self.subject.comparison.as_ref()
    }

    /// Number of mixtures that [`Self::subject`] leaves out.
    #[must_use]
    pub fn mixtures(&self) -> usize {
        self.left_out.as_ref().map_or(0, |measured| measured.mixtures(self.subject.library))
    }

    /// Leaves out each mixture in turn, and chooses few wavelengths by every method. `task` counts the mixtures.
    ///
    /// # Errors
    /// [`ReportError`] if a fit fails, or if `task` was cancelled.
    pub fn subject(self, task: &Task) -> Result<Subject<'a>, ReportError> {
        let Self { mut subject, left_out, wavelengths } = self;
        let library = subject.library;
        let viewing = subject.viewing;
        // In parallel, so that cores that finish one task help with the other.
        let (validation, quadratures) = rayon::join(
            || left_out.map(|measured| measured.left_out(library, viewing, task)).transpose(),
            || {
                task.check()?;
                task.stage("few wavelengths instead of many");
                Ok::<_, ReportError>(QuadratureTrial::all(viewing, library, wavelengths)?)
            },
        );
        subject.validation = validation?.flatten();
        subject.quadratures = quadratures?;
        task.check()?;
        Ok(subject)
    }
}

/// A report that cannot be drawn.
#[derive(Debug, thiserror::Error, Explain)]
pub enum ReportError {
    /// The request holds a value that cannot be used.
    #[error(transparent)]
    Request(#[from] RequestError),
    /// A pigment of the pair is not in the library.
    #[error(transparent)]
    Pigment(#[from] RecipeError),
    /// The library has no visible wavelength.
    #[error(transparent)]
    Interpolate(#[from] InterpolateError),
    /// The readings cannot be used.
    #[error(transparent)]
    Measurement(#[from] MeasurementError),
    /// The readings cannot be compared with the library.
    #[error(transparent)]
    Comparison(#[from] ComparisonError),
    /// A fit without a mixture fails.
    #[error(transparent)]
    Calibration(#[from] CalibrationError),
    /// A number of wavelengths is not 1 to 32.
    #[error(transparent)]
    Quadrature(#[from] QuadratureFailure),
    /// A figure cannot be rendered as PNG.
    #[cfg(feature = "pictures")]
    #[error(transparent)]
    Picture(#[from] PictureError),
    /// The work was asked to end before its time.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

#[cfg(test)]
mod tests {
    use super::*;
    use documents::hint::Fault;
    use documents::request::request_from_json;

    fn of_pair(first: &str, second: &str) -> ReportRequest {
        let pair = Some((first.to_owned(), second.to_owned()));
        ReportRequest { pair, ..ReportRequest::default() }
    }

    #[test]
    fn a_request_is_the_same_after_json() {
        let request = ReportRequest { no_validation: true, ..of_pair("Zinc White", "Viridian") };
        for request in [request, ReportRequest::default()] {
            let json = serde_json::to_string(&request).unwrap();
            assert_eq!(request_from_json::<ReportRequest>(&json).unwrap(), request, "{json}");
        }
        assert_eq!(request_from_json::<ReportRequest>("{}").unwrap(), ReportRequest::default());
    }

    #[test]
    fn what_a_key_does_not_take_is_refused_with_a_way_out() {
        for (json, message, hint) in [
            (r#"{"pairs": null, "par": 1}"#, "unknown key `par`", "did you mean pair?"),
            (
                r#"{"no_validation": 1}"#,
                "no_validation: invalid type: number `1`, expected true or false",
                "write a value of the kind that the key takes",
            ),
            (
                r#"{"pair": ["Viridian"]}"#,
                "pair: invalid length 1, expected a tuple of size 2",
                "write a value of the kind that the key takes",
            ),
        ] {
            let error = request_from_json::<ReportRequest>(json).unwrap_err();
            assert_eq!(
                (error.to_string().as_str(), error.hint().unwrap().to_string().as_str()),
                (message, hint)
            );
        }
    }

    #[test]
    fn a_pair_is_two_pigments_of_the_library() {
        let library = PigmentLibrary::van_gogh_oils();
        let of = |first, second| of_pair(first, second).pigments(&library);
        let pair = of("virid", "cobalt blue").unwrap().unwrap();
        assert_eq!(
            (library[pair.0].name.as_str(), library[pair.1].name.as_str()),
            ("Viridian", "Cobalt Blue")
        );
        for (error, message, hint, fault) in [
            (
                of("Viridian", "virid").unwrap_err(),
                "pair takes two different pigments, found `Viridian` twice",
                "replace one of them by another pigment",
                Fault::Setting,
            ),
            (
                of("Viridan", "Minium").unwrap_err(),
                "the library has no pigment called `Viridan`",
                "did you mean Viridian? pigments: ",
                Fault::Input,
            ),
        ] {
            assert_eq!((error.to_string().as_str(), error.fault()), (message, fault));
            assert!(error.hint().unwrap().to_string().starts_with(hint), "{error:?}");
        }
    }

    #[test]
    fn a_cancelled_task_ends_a_report() {
        let task = Task::default();
        task.cancel();
        let library = PigmentLibrary::van_gogh_oils();
        let request = ReportRequest::default();
        let ended = request.run(&library, None, "test", &task);
        assert!(matches!(ended, Err(ReportError::Cancelled(_))), "{ended:?}");
    }
}
