//! What the data cannot tell, in words.

use crate::evaluate::percentile;
use crate::fit::{Condition, Unidentified, Unknown};
use crate::library::SampleEvidence;
use crate::measurement::MeasurementError;
use crate::observation::{BelowSurface, Door, Hiding, Observation};
use crate::swatch::SwatchSet;
use spectra::optics::Surface;

/// Every warning a fit should carry, in order of weight.
pub(crate) fn warnings(
    set: &SwatchSet,
    observations: &[Observation],
    unknown: &[Unidentified],
    condition: &Condition,
    per_sample: &[SampleEvidence],
) -> Vec<String> {
    let mut warnings = Vec::new();
    for lone in unknown {
        let name = &set.pigments[lone.pigment];
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
    warnings.extend(below_surface(observations));
    warnings.extend(assumed_to_hide(observations));
    for (sample, total) in set.uneven_recipes() {
        warnings.push(format!("{sample}: the recipe sums to {total:.2} %, taken as shares"));
    }
    warnings.extend(outliers(per_sample));
    warnings
}

/// Every warning of a fit of absolute amounts.
pub(crate) fn absolute_warnings(
    set: &SwatchSet,
    undetermined: &[usize],
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
    for &index in undetermined {
        warnings.push(format!(
            "{}: these films tell little of its scattering; add it over a black backing, or mixed with white and with black",
            set.pigments[index]
        ));
    }
    warnings.extend(outliers(per_sample));
    warnings
}

/// Refuses readings below the surface's own reflection, unless they may be read
/// as black.
pub(crate) fn refuse_below_surface(
    set: &SwatchSet,
    surface: Surface,
    below: BelowSurface,
) -> Result<(), MeasurementError> {
    let door = Door { set, surface, below };
    for swatch in &set.swatches {
        for film in &swatch.films {
            door.internal(swatch, &film.reflectance)?;
        }
    }
    Ok(())
}

fn below_surface(observations: &[Observation]) -> Option<String> {
    let dark: Vec<String> = observations
        .iter()
        .filter(|o| o.below_surface > 0)
        .map(|o| format!("{} ({})", o.sample, o.below_surface))
        .collect();
    (!dark.is_empty()).then(|| {
        format!(
            "readings below the surface's own reflection were read as black: {}; a lower k1 would fit these samples",
            dark.join(", ")
        )
    })
}

fn assumed_to_hide(observations: &[Observation]) -> Option<String> {
    let assumed: Vec<&str> = observations
        .iter()
        .filter(|o| o.hiding == Hiding::Assumed)
        .map(|o| o.sample.as_str())
        .collect();
    let shown = assumed.iter().take(6).copied().collect::<Vec<_>>().join(", ");
    let more = assumed.len().saturating_sub(6);
    let rest = if more > 0 { format!(" and {more} more") } else { String::new() };
    (!assumed.is_empty()).then(|| {
        format!("taken to hide, for want of a second backing with its bare reading: {shown}{rest}")
    })
}

/// Samples whose error stands far out: above the median by five times the
/// spread (1.4826 x the median deviation), and above 2.
fn outliers(per_sample: &[SampleEvidence]) -> Vec<String> {
    let errors: Vec<f64> = per_sample.iter().map(|s| s.delta_e).collect();
    let median = percentile(&errors, 50.0);
    let deviations: Vec<f64> = errors.iter().map(|e| (e - median).abs()).collect();
    let limit = (median + 5.0 * 1.4826 * percentile(&deviations, 50.0)).max(2.0);
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
