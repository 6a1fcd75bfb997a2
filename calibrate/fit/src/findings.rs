//! Warnings about quantities that the data do not identify, and about inconsistent data.

use crate::fit::{Condition, Unidentified, Unknown};
use crate::measurement::MeasurementError;
use crate::observation::{BelowSurface, HIDING_DIFFERENCE, Hiding, Observation, SurfaceConversion};
use crate::swatch::SwatchSet;
use documents::name_list;
use pigment::PigmentId;
use pigment::evaluate::percentile;
use pigment::library::SampleEvidence;
use spectra::optics::Surface;

/// All warnings of a fit of shares, the most important first.
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
                "{name}: scattering not identified, it occurs only as a masstone ({samples}); its K/S is kept with S = 1, and it takes no part in fit and errors"
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

/// All warnings of a fit of absolute amounts.
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

/// Checks readings of films and bare backings for values below the surface's own reflection: an error, or a
/// warning where they are read as black.
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

/// Warnings about films that are assumed to hide; those whose readings contradict this come first.
fn taken_to_hide(observations: &[Observation]) -> impl Iterator<Item = String> {
    let difference = |o: &Observation| match o.hiding {
        Hiding::Assumed(difference) => Some(difference.unwrap_or(0.0)),
        Hiding::Difference(_) => None,
    };
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

/// Spreads above the median from which an error is outlying; chosen by eye.
const OUTLYING: f64 = 5.0;
/// Standard deviation over median absolute deviation for normal errors.
const SD_OVER_MEDIAN: f64 = 1.4826;
/// Least CIEDE2000 of an outlying error, just above what is plainly visible; chosen by eye.
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
