//! The report on a library.

use calibrate::Viewing;
use calibrate::comparison::Comparable;
use calibrate::palette::Cards;
use calibrate::quadrature::QuadratureTrial;
use reports::{Subject, page_alone};
use wasm_bindgen::prelude::*;

use crate::failure::{Result, Told, request};
use crate::library::Library;
use crate::readings::Readings;

/// How many wavelengths the quadratures in a report have.
const COUNTS: std::ops::RangeInclusive<usize> = 3..=12;

#[wasm_bindgen]
impl Library {
    /// The report on the library alone, as one HTML page. The page hears each step.
    pub fn report(&self, viewing: &str) -> Result<String> {
        let viewing = request::<Viewing>(viewing)?;
        drawn(self.subject(&viewing)?)
    }

    /// The report that also compares each sample with the library. With `validate` it also leaves
    /// out each mixture in turn.
    pub fn report_with(
        &self,
        readings: &Readings,
        validate: bool,
        viewing: &str,
    ) -> Result<String> {
        let viewing = request::<Viewing>(viewing)?;
        let library = &self.0;
        let mut subject = self.subject(&viewing)?;
        let comparable = Comparable::of(&readings.0.swatches().told()?, library).told()?;
        subject.comparison = Some(comparable.with(library, &viewing).told()?);
        subject.cards = comparable.set.cards(&subject.weights);
        if validate {
            let of = comparable.mixtures(library);
            let task = told::task(move |progress| {
                format!("{}, {} of {of}", progress.stage, progress.done)
            });
            subject.validation = comparable.left_out(library, &viewing, &task).told()?;
        }
        drawn(subject)
    }
}

impl Library {
    fn subject<'a>(&'a self, viewing: &'a Viewing) -> Result<Subject<'a>> {
        let mut subject = Subject::of_library(&self.0, viewing, "calibration page of impasto");
        if let Ok(subject) = &mut subject {
            subject.cards = Cards::standard(self.0.grid);
        }
        subject.told()
    }
}

fn drawn(mut subject: Subject<'_>) -> Result<String> {
    told::stage("few wavelengths instead of many");
    subject.quadratures = QuadratureTrial::all(subject.viewing, subject.library, &COUNTS).told()?;
    let task =
        told::task(|progress| format!("figures, {} of {} sections", progress.done, progress.of));
    Ok(page_alone(&subject, &task))
}
