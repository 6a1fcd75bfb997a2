//! Errors of a fit or of a validation as text, and warnings.
//!
//! A warning names a quantity that the data do not identify, or data that contradict each other. For
//! example, it names a pigment with an unknown S.

use std::fmt;

use documents::{column_width, name_list};
use pigment::evaluate::{Summary, delta_e, percentile};
use pigment::library::{Evidence, SampleEvidence};
use pigment::{PigmentId, digits::rounded};
use spectra::{TristimulusWeights, optics::Surface};

use crate::fit::{Condition, Unidentified, Unknown};
use crate::measurement::MeasurementError;
use crate::observation::{BelowSurface, HIDING_DIFFERENCE, Hiding, Observation, SurfaceConversion};
use crate::swatch::SwatchSet;

/// A line of samples has at most this many characters.
const LINE: usize = 96;
/// We name this many samples for their share of the error.
const NAMED: usize = 4;
/// We write at most this many samples in one line.
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
        let width = column_width(sorted.iter().map(|s| &s.sample), 0);
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

fn percent(share: f64) -> String {
    format!("{:.0} %", 100.0 * share)
}

pub(crate) fn warnings(
    set: &SwatchSet,
    observations: &[Observation],
    unknown: &[Unidentified],
    condition: &Condition,
    per_sample: &[SampleEvidence],
) -> Vec<String> {
    let mut warnings = Vec::new();
    for lone in unknown {
        let name = &set.pigments[lone.pigment.index()];
        let samples: Vec<&str> =
            lone.samples.iter().map(|&s| observations[s].sample.as_str()).collect();
        let samples = samples.join(", ");
        warnings.push(match lone.unknown {
            Unknown::Scattering => format!(
                "{name}: scattering not identified, it occurs only as a masstone ({samples}); its K/S is kept with an S assumed from its lightness, and it takes no part in fit and errors"
            ),
            Unknown::Everything => format!(
                "{name}: not identified, it occurs only in {samples}; left out (add its masstone and a tint with white)"
            ),
        });
    }
    if condition.rank < condition.unknowns {
        warnings.push(format!(
            "the mixtures determine only {} of {} unknowns at {} nm",
            condition.rank, condition.unknowns, condition.nm
        ));
    }
    if per_sample.len() <= condition.unknowns {
        warnings.push(format!(
            "{} for {} a wavelength: they are fitted exactly, so that errors and deviations tell nothing; add mixtures, and see `validate`",
            documents::counted(per_sample.len(), "sample"),
            documents::counted(condition.unknowns, "unknown")
        ));
    }
    warnings.extend(listed(READ_AS_BLACK, counted(observations, |o| o.below_surface)));
    warnings.extend(listed(
        "readings above a perfect white were read as white",
        counted(observations, |o| o.above_white),
    ));
    warnings.extend(taken_to_hide(observations));
    let uneven = set.uneven_recipes();
    let uneven = uneven.iter().map(|(sample, total)| format!("{sample} ({total:.2} %)"));
    warnings.extend(listed("recipes that do not sum to 100 %, taken as shares", uneven.collect()));
    warnings.extend(outliers(per_sample));
    warnings
}

/// Warnings of a fit of absolute amounts.
pub(crate) fn absolute_warnings(
    set: &SwatchSet,
    undetermined: &[PigmentId],
    dark: Option<String>,
    per_sample: &[SampleEvidence],
) -> Vec<String> {
    let mut warnings = Vec::new();
    for (index, pigment) in set.pigments.iter().enumerate() {
        let lone = set.swatches.iter().any(|swatch| {
            swatch.amounts[index] > 0.0 && swatch.amounts.iter().filter(|a| **a > 0.0).count() == 1
        });
        if !lone {
            warnings.push(format!("{pigment}: no film of its own, known only from mixtures"));
        }
    }
    for id in undetermined {
        warnings.push(format!(
            "{}: these films tell little of its scattering; add it over a black backing, or mixed with white and with black",
            set.pigments[id.index()]
        ));
    }
    warnings.extend(dark);
    warnings.extend(outliers(per_sample));
    warnings
}

/// Checks readings of films and bare backings for values below the surface's own reflection. You get an
/// error, or a warning if we read them as black.
pub(crate) fn below_surface(
    set: &SwatchSet,
    surface: Surface,
    below: BelowSurface,
) -> Result<Option<String>, MeasurementError> {
    let conversion = SurfaceConversion { set, surface, below };
    let mut dark = Vec::new();
    for swatch in &set.swatches {
        let mut count = 0;
        for film in &swatch.films {
            for readings in std::iter::once(&film.reflectance).chain(&film.bare) {
                conversion.internal(swatch, readings)?;
                count += readings.iter().filter(|&&r| r < surface.floor()).count();
            }
        }
        if count > 0 {
            dark.push(format!("{} ({count})", swatch.sample));
        }
    }
    Ok(listed(READ_AS_BLACK, dark))
}

const READ_AS_BLACK: &str = "readings below the surface's own reflection were read as black, a lower k1 would fit these samples";

/// Samples with a count above 0, each with the count in brackets.
fn counted(observations: &[Observation], count: impl Fn(&Observation) -> usize) -> Vec<String> {
    let some = observations.iter().filter(|o| count(o) > 0);
    some.map(|o| format!("{} ({})", o.sample, count(o))).collect()
}

/// One line for several samples, of which eight are named.
fn listed(what: &str, samples: Vec<String>) -> Option<String> {
    (!samples.is_empty()).then(|| format!("{what}: {}", name_list(&samples, 8, ", ")))
}

/// Warnings about films that we assume to hide. Films with readings that contradict this come first.
fn taken_to_hide(observations: &[Observation]) -> impl Iterator<Item = String> {
    let assumed: Vec<(&Observation, f64)> =
        observations.iter().filter_map(|o| Some((o, difference(o)?))).collect();
    let (denied, plain): (Vec<_>, Vec<_>) =
        assumed.into_iter().partition(|(_, d)| *d > HIDING_DIFFERENCE);
    let denied = denied.iter().map(|(o, d)| format!("{} (by {d:.2})", o.sample)).collect();
    let plain = plain.iter().map(|(o, _)| o.sample.clone()).collect();
    [
        listed(
            "taken to hide though their readings over different backings differ (K/S needs two backings of different reflectance, each read bare, under films of one thickness)",
            denied,
        ),
        listed(
            "taken to hide, for want of a second backing (the columns `film` and `backing` tell cards; washes that never hide take absolute amounts)",
            plain,
        ),
    ]
    .into_iter()
    .flatten()
}

fn difference(o: &Observation) -> Option<f64> {
    match o.hiding {
        Hiding::Assumed(difference) => Some(difference.unwrap_or(0.0)),
        Hiding::Difference(_) => None,
    }
}

/// An error is outlying if it is above the median by this many spreads (chosen by eye).
const OUTLYING: f64 = 5.0;
/// Standard deviation over median absolute deviation for normal errors.
const SD_OVER_MEDIAN: f64 = 1.4826;
/// An error below this CIEDE2000 is not outlying. It is just above what you plainly see (chosen by eye).
const LEAST_OUTLIER: f64 = 2.0;
/// Samples with an outlying error: above the median by five times the spread (1.4826 x the median absolute
/// deviation), and above 2.
fn outliers(per_sample: &[SampleEvidence]) -> Vec<String> {
    let errors: Vec<f64> = per_sample.iter().map(|s| s.delta_e).collect();
    let median = percentile(&errors, 50.0);
    let deviations: Vec<f64> = errors.iter().map(|e| (e - median).abs()).collect();
    let limit =
        (median + OUTLYING * SD_OVER_MEDIAN * percentile(&deviations, 50.0)).max(LEAST_OUTLIER);
    let mut far: Vec<&SampleEvidence> = per_sample.iter().filter(|s| s.delta_e > limit).collect();
    far.sort_by(|a, b| b.delta_e.total_cmp(&a.delta_e));
    far.into_iter()
        .map(|s| {
            format!(
                "{} disagrees with its recipe by {:.1} CIEDE2000 (median of all: {median:.1})",
                s.sample, s.delta_e
            )
        })
        .collect()
}

pub(crate) struct Scores {
    pub(crate) rms: f64,
    pub(crate) delta_e: Summary,
    pub(crate) per_sample: Vec<SampleEvidence>,
}

impl Scores {
    /// Errors of films, each given as name of the sample, measured and predicted reflectance.
    pub(crate) fn of<'a>(
        weights: &TristimulusWeights,
        films: impl IntoIterator<Item = (String, &'a [f64], Vec<f64>)>,
    ) -> Self {
        let mut squares = 0.0;
        let mut count = 0.0;
        let mut per_sample = Vec::new();
        for (sample, measured, predicted) in films {
            squares += predicted.iter().zip(measured).map(|(p, m)| (p - m).powi(2)).sum::<f64>();
            count += measured.len() as f64;
            let delta_e = delta_e(weights, measured, &predicted);
            per_sample.push(SampleEvidence { sample, delta_e });
        }
        let rms = f64::sqrt(squares / f64::max(count, 1.0));
        Self { rms, delta_e: summary(&per_sample), per_sample }
    }

    pub(crate) fn rounded(mut self) -> Self {
        self.per_sample.iter_mut().for_each(|s| s.delta_e = rounded(s.delta_e));
        Self {
            rms: rounded(self.rms),
            delta_e: summary(&self.per_sample).rounded(),
            per_sample: self.per_sample,
        }
    }
}

fn summary(per_sample: &[SampleEvidence]) -> Summary {
    let errors: Vec<f64> = per_sample.iter().map(|s| s.delta_e).collect();
    Summary::of(&errors)
}

/// Share of each sample in the sum of all squared colour errors, 0 to 1, the greatest first. Samples of
/// equal shares stay in their order. You get an empty list if all errors are 0.
#[must_use]
pub fn shares_of_squares(per_sample: &[SampleEvidence]) -> Vec<(&str, f64)> {
    let total: f64 = per_sample.iter().map(|s| s.delta_e * s.delta_e).sum();
    if total <= 0.0 {
        return Vec::new();
    }
    let shares = per_sample.iter().map(|s| (s.sample.as_str(), s.delta_e * s.delta_e / total));
    let mut shares: Vec<(&str, f64)> = shares.collect();
    shares.sort_by(|a, b| b.1.total_cmp(&a.1));
    shares
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_of_squares_sum_to_one_and_fall() {
        let samples = [("a", 1.0), ("b", 3.0), ("c", 0.0)]
            .map(|(name, delta_e)| SampleEvidence { sample: name.to_owned(), delta_e });
        let shares = shares_of_squares(&samples);
        assert_eq!(shares, [("b", 0.9), ("a", 0.1), ("c", 0.0)]);
        assert!(shares_of_squares(&samples[2..]).is_empty());
    }
}
