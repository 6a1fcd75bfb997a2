//! The report on a library.

use std::sync::atomic::{AtomicUsize, Ordering};

use calibrate::Viewing;
use calibrate::comparison::Comparable;
use calibrate::fit::{FitStage, Watch};
use calibrate::palette::Cards;
use calibrate::quadrature::QuadratureTrial;
use reports::{STEPS, Subject, page_alone};
use wasm_bindgen::prelude::*;

use crate::failure::{Result, Told, request};
use crate::library::Library;
use crate::readings::Readings;

/// Numbers of wavelengths of the quadratures in a report.
const COUNTS: std::ops::RangeInclusive<usize> = 3..=12;

#[wasm_bindgen]
impl Library {
    /// The report on the library alone, as one HTML page. The page hears each step.
    pub fn report(&self, viewing: &str) -> Result<String> {
        let viewing = request::<Viewing>(viewing)?;
        drawn(self.subject(&viewing)?)
    }

    /// The report that also compares each sample with the library; with `validate` each mixture is left out
    /// in turn too.
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
            let done = AtomicUsize::new(0);
            let of = comparable.mixtures(library);
            let told = |_: FitStage| {
                let done = done.fetch_add(1, Ordering::Relaxed) + 1;
                told::stage(&format!("mixture left out, {} of {of}", done.min(of)));
            };
            subject.validation =
                comparable.left_out(library, &viewing, Watch::new(&told)).told()?;
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
    let done = AtomicUsize::new(0);
    let step = || {
        let done = done.fetch_add(1, Ordering::Relaxed) + 1;
        told::stage(&format!("figures, {done} of {STEPS} sections"));
    };
    Ok(page_alone(&subject, &step))
}
