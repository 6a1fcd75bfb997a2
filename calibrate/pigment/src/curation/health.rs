//! What is good and what is doubtful in a library.

use spectra::TristimulusWeights;
use spectra::color::{Lab, delta_e_ciede2000};

use crate::evaluate::{Viewing, lab, percentile};
use crate::library::{AmountKind, Pigment, PigmentLibrary};

/// How bad a finding is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// The library does not do what it says.
    Fault,
    /// Worth a look.
    Warning,
}

/// One thing found.
#[derive(Debug, Clone, PartialEq)]
pub struct Finding {
    /// How bad it is.
    pub severity: Severity,
    /// The pigment, if it is of one.
    pub pigment: Option<String>,
    /// What was found.
    pub what: String,
}

/// One pigment in figures.
#[derive(Debug, Clone, PartialEq)]
pub struct PigmentHealth {
    /// Its name.
    pub name: String,
    /// Smallest and largest K.
    pub absorption: [f64; 2],
    /// Smallest and largest S.
    pub scattering: [f64; 2],
    /// Median of sd / K over wavelength, where K is known apart from 0.
    pub absorption_uncertainty: Option<f64>,
    /// Median of sd / S.
    pub scattering_uncertainty: Option<f64>,
    /// The colour of a film that hides.
    pub masstone: Lab,
}

/// A library in figures, and what was found in it, faults first.
#[derive(Debug, Clone, PartialEq)]
pub struct Health {
    /// By pigment.
    pub pigments: Vec<PigmentHealth>,
    /// Faults, then warnings.
    pub findings: Vec<Finding>,
}

impl Health {
    /// Whether there is a fault.
    #[must_use]
    pub fn faulty(&self) -> bool {
        self.findings.iter().any(|finding| finding.severity == Severity::Fault)
    }
}

/// A figure that stands out from both neighbours by this factor is a jump.
const JUMP: f64 = 1.5;
/// A relative deviation that leaves a figure little but its order of size.
const UNCERTAIN: f64 = 0.5;
/// Nobody sees a smaller difference, in CIEDE2000.
const ALIKE: f64 = 0.3;
/// A masstone this near to the surface's own reflection reads as black.
const BLACK: f64 = 0.0005;

/// The health of `library`; colours are told under `viewing`.
#[must_use]
pub fn health(library: &PigmentLibrary, viewing: &Viewing) -> Health {
    let weights = viewing.weights(library.grid).expect("a method for the grid");
    let mut findings = of_library(library);
    for pigment in &library.pigments {
        of_pigment(library, pigment, &mut findings);
    }
    near_pairs(library, &weights, &mut findings);
    findings.sort_by_key(|finding| finding.severity);
    let pigments = library.pigments.iter().enumerate().map(|(index, pigment)| PigmentHealth {
        name: pigment.name.clone(),
        absorption: range(&pigment.absorption),
        scattering: range(&pigment.scattering),
        absorption_uncertainty: uncertainty(&pigment.absorption, &pigment.absorption_sd),
        scattering_uncertainty: uncertainty(&pigment.scattering, &pigment.scattering_sd),
        masstone: lab(&weights, &hiding(library, &[(index, 1.0)])),
    });
    Health { pigments: pigments.collect(), findings }
}

fn of_library(library: &PigmentLibrary) -> Vec<Finding> {
    let mut findings = Vec::new();
    let mut found = |severity, what: String| {
        findings.push(Finding { severity, pigment: None, what });
    };
    let (start, end) = (library.grid.start_nm(), library.grid.end_nm());
    if end < 400.0 || start > 700.0 {
        found(Severity::Fault, format!("{start} to {end} nm is no visible light"));
    } else if start > 420.0 || end < 680.0 {
        let what = format!("{start} to {end} nm leaves out a part of the visible band");
        found(Severity::Warning, what);
    }
    if library.grid.step_nm() > 20.0 {
        let what = format!("steps of {} nm are coarse for colour", library.grid.step_nm());
        found(Severity::Warning, what);
    }
    for (what, text) in [("licence", &library.licence), ("source", &library.source)] {
        if text.trim().is_empty() {
            found(Severity::Warning, format!("no {what} is told"));
        }
    }
    let reference = library.reference.as_ref();
    let white = reference.and_then(|name| library.pigments.iter().find(|p| p.name == *name));
    match (library.amounts, white) {
        (AmountKind::Relative, None) => {
            let what = "no reference white: nothing says what S = 1 is";
            found(Severity::Warning, what.to_owned());
        }
        (AmountKind::Relative, Some(white)) => {
            let off = white.scattering.iter().position(|s| (s - 1.0).abs() > 1e-5);
            if let Some(at) = off {
                let (nm, s) = (library.grid.nm(at), white.scattering[at]);
                let what = format!("S of the reference {} is {s} at {nm} nm, not 1", white.name);
                found(Severity::Fault, what);
            }
        }
        (AmountKind::Absolute, _) => {}
    }
    match &library.evidence {
        None => found(Severity::Warning, "no evidence of how well the figures fit".to_owned()),
        Some(evidence) if evidence.delta_e.mean > 3.0 => found(
            Severity::Warning,
            format!("the fit is off by {:.2} CIEDE2000 on average", evidence.delta_e.mean),
        ),
        Some(_) => {}
    }
    findings
}

fn of_pigment(library: &PigmentLibrary, pigment: &Pigment, findings: &mut Vec<Finding>) {
    let mut found = |severity, what: String| {
        findings.push(Finding { severity, pigment: Some(pigment.name.clone()), what });
    };
    let grid = library.grid;
    if pigment.guessed {
        found(Severity::Warning, "guessed from a colour, not measured".into());
    }
    if !pigment.identified {
        found(Severity::Warning, "S is not known, so its mixtures are a guess".into());
    }
    let both = || pigment.absorption.iter().zip(&pigment.scattering);
    if let Some(at) = both().position(|(k, s)| *k == 0.0 && *s == 0.0) {
        let what = format!("K and S are both 0 at {} nm, which is no paint", grid.nm(at));
        found(Severity::Fault, what);
    }
    let surface = library.saunderson;
    let film = |(k, s): (&f64, &f64)| {
        surface.measured_from_internal(spectra::optics::infinite_film(*k, *s))
    };
    let film: Vec<f64> = both().map(film).collect();
    let dark = film.iter().filter(|r| **r < surface.floor() + BLACK).count();
    if dark > 0 {
        found(
            Severity::Warning,
            format!(
                "its masstone is as dark as the surface itself (k1 = {}) at {dark} of {} wavelengths: K is at least what stands here",
                surface.floor(),
                grid.count()
            ),
        );
    }
    let clear = pigment.absorption.iter().filter(|k| **k == 0.0).count();
    if clear > 0 {
        let what = format!("K is 0 at {clear} of {} wavelengths", grid.count());
        found(Severity::Warning, what);
    }
    for (letter, curve) in [("K", &pigment.absorption), ("S", &pigment.scattering)] {
        if let Some(at) = jump(curve) {
            let what = format!("{letter} jumps at {} nm: `{}`", grid.nm(at), curve[at]);
            found(Severity::Warning, what);
        }
    }
    if pigment.guessed || !pigment.identified {
        return;
    }
    for (letter, curve, sd) in [
        ("K", &pigment.absorption, &pigment.absorption_sd),
        ("S", &pigment.scattering, &pigment.scattering_sd),
    ] {
        match uncertainty(curve, sd) {
            None if sd.is_empty() => {
                found(Severity::Warning, format!("no deviation of {letter} is told"));
            }
            Some(share) if share > UNCERTAIN => {
                let what = format!("{letter} is known to {:.0} % only (median)", 100.0 * share);
                found(Severity::Warning, what);
            }
            _ => {}
        }
    }
}

/// Pigments that look alike, alone and with the white.
fn near_pairs(library: &PigmentLibrary, weights: &TristimulusWeights, findings: &mut Vec<Finding>) {
    let white = library.reference.as_deref();
    let white = white.and_then(|name| library.pigments.iter().position(|p| p.name == name));
    let colors: Vec<[Lab; 2]> = (0..library.pigments.len())
        .map(|index| {
            let tint = white.map_or(vec![(index, 1.0)], |white| vec![(index, 1.0), (white, 9.0)]);
            [vec![(index, 1.0)], tint].map(|recipe| lab(weights, &hiding(library, &recipe)))
        })
        .collect();
    for (second, pigment) in library.pigments.iter().enumerate() {
        for (first, other) in library.pigments[..second].iter().enumerate() {
            let plain = |name: &str| {
                name.chars().filter(|c| c.is_alphanumeric()).collect::<String>().to_lowercase()
            };
            let apart = (colors[first].iter().zip(&colors[second]))
                .map(|(a, b)| delta_e_ciede2000(*a, *b))
                .fold(0.0, f64::max);
            let what = if plain(&pigment.name) == plain(&other.name) {
                format!("is spelled almost as {}", other.name)
            } else if pigment.absorption == other.absorption
                && pigment.scattering == other.scattering
            {
                format!("has the same figures as {}", other.name)
            } else if apart < ALIKE {
                format!("looks like {}: {apart:.2} CIEDE2000 at most, tint included", other.name)
            } else {
                continue;
            };
            let pigment = Some(pigment.name.clone());
            findings.push(Finding { severity: Severity::Warning, pigment, what });
        }
    }
}

fn hiding(library: &PigmentLibrary, recipe: &[(usize, f64)]) -> Vec<f64> {
    library.mix(recipe).expect("parts above 0").hiding(library.saunderson)
}

fn range(curve: &[f64]) -> [f64; 2] {
    [curve.iter().copied().fold(f64::INFINITY, f64::min), curve.iter().copied().fold(0.0, f64::max)]
}

/// The median of deviation over figure; none without deviations.
fn uncertainty(curve: &[f64], sd: &[f64]) -> Option<f64> {
    let pairs = curve.iter().zip(sd).filter(|(value, _)| **value > 0.0);
    let shares: Vec<f64> = pairs.map(|(value, sd)| sd / value).collect();
    (!shares.is_empty()).then(|| percentile(&shares, 50.0))
}

/// Where a figure stands out from both its neighbours.
fn jump(curve: &[f64]) -> Option<usize> {
    // Near 0 a factor means nothing.
    let least = 1e-3 * range(curve)[1];
    let log = |index: usize| curve[index].max(least).ln();
    (1..curve.len().saturating_sub(1)).find(|&at| {
        let (left, right) = (log(at) - log(at - 1), log(at) - log(at + 1));
        left * right > 0.0 && left.abs().min(right.abs()) > JUMP.ln()
    })
}
