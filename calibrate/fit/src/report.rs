//! Errors of a fit or of a validation, as text.

use std::fmt;

use crate::scores::shares_of_squares;
use pigment::evaluate::Summary;
use pigment::library::{Evidence, SampleEvidence};

/// Characters of a line of samples.
const LINE: usize = 96;
/// Samples that are named for their share of the error.
const NAMED: usize = 4;
/// Most samples in one line.
const COLUMNS: usize = 8;

/// Report of colour errors: a title, a summary and the samples, worst first.
#[derive(Debug, Clone, PartialEq)]
pub struct ErrorReport<'a> {
    title: String,
    delta_e: Summary,
    rms: f64,
    illuminant: String,
    observer: String,
    samples: &'a [SampleEvidence],
    shown: usize,
    /// Further findings, below the summary.
    lines: Vec<String>,
}

impl<'a> ErrorReport<'a> {
    /// Report of a library's `evidence`.
    #[must_use]
    pub fn of_evidence(title: impl Into<String>, evidence: &'a Evidence) -> Self {
        let Evidence { illuminant, observer, rms, delta_e, per_sample, .. } = evidence;
        Self::new(title, delta_e, *rms, [illuminant, observer], per_sample)
    }

    /// Report of errors under `[illuminant, observer]`.
    pub(crate) fn new(
        title: impl Into<String>,
        delta_e: &Summary,
        rms: f64,
        [illuminant, observer]: [&str; 2],
        samples: &'a [SampleEvidence],
    ) -> Self {
        Self {
            title: title.into(),
            delta_e: *delta_e,
            rms,
            illuminant: illuminant.to_owned(),
            observer: observer.to_owned(),
            samples,
            shown: usize::MAX,
            lines: Vec::new(),
        }
    }

    /// The report with further findings below its summary.
    pub(crate) fn with_lines(self, lines: Vec<String>) -> Self {
        Self { lines, ..self }
    }

    /// The report with only the `count` worst samples.
    #[must_use]
    pub fn with_samples(self, count: usize) -> Self {
        Self { shown: count, ..self }
    }
}

impl fmt::Display for ErrorReport<'_> {
    /// Writes the report in lines of up to 96 characters, without a line break at the end.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Summary { mean, median, p90, max } = self.delta_e;
        let Self { title, rms, illuminant, observer, .. } = self;
        writeln!(f, "{title}")?;
        writeln!(
            f,
            "colour error: mean {mean:.2}, median {median:.2}, 90 % below {p90:.2}, largest {max:.2}; rms {rms:.4}"
        )?;
        write!(f, "(CIEDE2000 under {illuminant}, observer {observer}; rms of reflectance)")?;
        let shares = shares_of_squares(self.samples);
        if shares.len() > NAMED {
            let percent = |share: f64| format!("{:.0} %", 100.0 * share);
            let named = &shares[..NAMED];
            let each: Vec<String> = named
                .iter()
                .map(|(sample, share)| format!("{sample} {}", percent(*share)))
                .collect();
            let all = percent(named.iter().map(|(_, share)| share).sum());
            let each = each.join(", ");
            write!(f, "\n{NAMED} of {} samples carry {all} of the squares: {each}", shares.len())?;
        }
        for line in &self.lines {
            write!(f, "\n{line}")?;
        }
        let mut sorted: Vec<&SampleEvidence> = self.samples.iter().collect();
        sorted.sort_by(|a, b| b.delta_e.total_cmp(&a.delta_e));
        let width = sorted.iter().map(|s| s.sample.chars().count()).max().unwrap_or(0);
        let cells: Vec<String> = sorted
            .iter()
            .take(self.shown)
            .map(|s| format!("{:width$} {:5.2}", s.sample, s.delta_e))
            .collect();
        let columns = (LINE / (width + 9)).clamp(1, COLUMNS);
        let rows = cells.len().div_ceil(columns);
        for row in 0..rows {
            let line: Vec<&str> =
                cells.iter().skip(row).step_by(rows).map(String::as_str).collect();
            write!(f, "\n  {}", line.join("   "))?;
        }
        match self.samples.len() - cells.len() {
            0 => Ok(()),
            rest => write!(f, "\n  and {} with less", documents::counted(rest, "sample")),
        }
    }
}
