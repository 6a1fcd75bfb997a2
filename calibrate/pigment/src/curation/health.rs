//! Checks of a library for faults and doubtful values. You can also compare two libraries of the same
//! pigments, as in quality control of batches.

use rand::{SeedableRng, seq::index};
use rand_chacha::ChaCha8Rng;
use spectra::TristimulusWeights;
use spectra::color::{Lab, delta_e_ciede2000};

use crate::evaluate::{BandCoverage, COARSE_STEP_NM, Viewing, lab, percentile};
use crate::library::{AmountKind, Pigment, PigmentLibrary};
use crate::recipe::{PigmentId, Recipe};
use crate::thin_films::{MOST_FILM, least_films};

/// Severity of a finding.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// The library contradicts itself.
    Fault,
    /// You should look at this value.
    Warning,
}

/// One fault or doubtful value of a library.
#[derive(Debug, Clone, PartialEq)]
pub struct Finding {
    /// Severity of the finding.
    pub severity: Severity,
    /// Name of the pigment concerned. `None` if the finding is about the whole library.
    pub pigment: Option<String>,
    /// Description of the finding.
    pub what: String,
}

/// Key figures of one pigment.
#[derive(Debug, Clone, PartialEq)]
pub struct PigmentHealth {
    /// Name of the pigment.
    pub name: String,
    /// Least and largest K.
    pub absorption: [f64; 2],
    /// Least and largest S.
    pub scattering: [f64; 2],
    /// Median over wavelength of the standard deviation of K divided by K, where K is above 0.
    pub absorption_uncertainty: Option<f64>,
    /// Median over wavelength of the standard deviation of S divided by S.
    pub scattering_uncertainty: Option<f64>,
    /// Colour of a film that hides.
    pub masstone: Lab,
}

/// Key figures of a library, with its faults and doubtful values.
#[derive(Debug, Clone, PartialEq)]
pub struct Health {
    /// Key figures by pigment, in the library's order.
    pub pigments: Vec<PigmentHealth>,
    /// Findings, faults before warnings.
    pub findings: Vec<Finding>,
}

impl Health {
    /// Whether at least one finding is a fault.
    #[must_use]
    pub fn faulty(&self) -> bool {
        self.findings.iter().any(|finding| finding.severity == Severity::Fault)
    }
}

/// A grid with steps below this, in nm, is finer than any instrument resolves, so the step is a mistake.
const FINE_STEP_NM: f64 = 0.1;
/// Surfaces of paint reflect 0.02 to 0.1 of the light that arrives. Titanium dioxide alone would reflect 0.2.
const MOST_K1: f64 = 0.2;
/// No paint has a K or S above this, and none that scatters has an S below its inverse, in any usual unit of
/// amounts. The figures that we know of are 1e-5 to 1e3.
const MOST_FIGURE: f64 = 1e9;
/// A fit with a mean CIEDE2000 above this is poor. We chose it by eye.
const POOR_FIT: f64 = 3.0;
/// Rounding to six digits in a file explains this deviation of the reference's S from 1, with some margin.
const UNIT_ROUNDING: f64 = 1e-5;
/// If a value is above or below both its neighbours by more than this factor, we count it as a jump. We
/// chose it by eye.
const JUMP: f64 = 1.5;
/// Above this median relative standard deviation of K or S, you know little more than its order of
/// magnitude. We chose it by eye.
const UNCERTAIN: f64 = 0.5;
/// Nobody can see a colour difference up to this CIEDE2000. We chose it by eye.
const ALIKE: f64 = 0.3;
/// We count a masstone as black if its reflectance exceeds the surface's own reflection by less than this.
/// We chose it by eye.
const BLACK: f64 = 0.0005;

/// Checks `library`. We compute colours under `viewing`.
#[must_use]
pub fn health(library: &PigmentLibrary, viewing: &Viewing) -> Health {
    let weights = viewing.weights(library.grid).expect("a method for the grid");
    let mut findings = of_library(library);
    for pigment in &library.pigments {
        of_pigment(library, pigment, &mut findings);
    }
    near_pairs(library, &weights, &mut findings);
    of_thin_films(library, &mut findings);
    findings.sort_by_key(|finding| finding.severity);
    let pigments = library.ids().zip(&library.pigments).map(|(id, pigment)| PigmentHealth {
        name: pigment.name.clone(),
        absorption: range(&pigment.absorption),
        scattering: range(&pigment.scattering),
        absorption_uncertainty: uncertainty(&pigment.absorption, &pigment.absorption_sd),
        scattering_uncertainty: uncertainty(&pigment.scattering, &pigment.scattering_sd),
        masstone: lab(&weights, &hiding(library, &Recipe::single(id))),
    });
    Health { pigments: pigments.collect(), findings }
}

fn of_library(library: &PigmentLibrary) -> Vec<Finding> {
    let mut findings = Vec::new();
    let mut found = |severity, what: String| {
        findings.push(Finding { severity, pigment: None, what });
    };
    let start = library.grid.start_nm();
    let end = library.grid.end_nm();
    match BandCoverage::of(library.grid) {
        BandCoverage::Full => {}
        BandCoverage::Partial => found(
            Severity::Warning,
            format!("{start} to {end} nm leaves out a part of the visible band"),
        ),
        BandCoverage::Missing => {
            found(Severity::Fault, format!("{start} to {end} nm is not visible light"));
        }
    }
    if library.grid.step_nm() > COARSE_STEP_NM {
        let what = format!("steps of {} nm are coarse for colour", library.grid.step_nm());
        found(Severity::Warning, what);
    }
    if library.grid.step_nm() < FINE_STEP_NM {
        let what =
            format!("steps of {:e} nm are finer than any instrument reads", library.grid.step_nm());
        found(Severity::Fault, what);
    }
    let k1 = library.saunderson.k1;
    if k1 > MOST_K1 {
        let what = format!("k1 is {k1}, but surfaces of paint reflect 0.02 to 0.1");
        found(Severity::Fault, what);
    }
    for (what, text) in [("licence", &library.licence), ("source", &library.source)] {
        if is_not_stated(text) {
            found(Severity::Warning, format!("no {what} is stated"));
        }
    }
    if !states_geometry(library) {
        let what = "the geometry of the instrument is not stated (d:8 or 45:0, in the source)";
        found(Severity::Warning, what.to_owned());
    }
    if library.inputs.is_empty() {
        found(Severity::Warning, "no measurement file is stated".to_owned());
    }
    let white = library.reference_id().map(|id| &library[id]);
    match (library.amounts, white) {
        (AmountKind::Relative, None) => {
            let what = "no reference white: nothing says what S = 1 is";
            found(Severity::Warning, what.to_owned());
        }
        (AmountKind::Relative, Some(white)) => {
            let off = white.scattering.iter().position(|s| (s - 1.0).abs() > UNIT_ROUNDING);
            if let Some(at) = off {
                let nm = library.grid.nm(at);
                let s = white.scattering[at];
                let what = format!("S of the reference {} is {s} at {nm} nm, not 1", white.name);
                found(Severity::Fault, what);
            }
        }
        (AmountKind::Absolute, _) => {}
    }
    match &library.evidence {
        None => found(Severity::Warning, "no evidence of how well the figures fit".to_owned()),
        Some(evidence) if evidence.delta_e.mean > POOR_FIT => found(
            Severity::Warning,
            format!("the fit is off by {:.2} CIEDE2000 on average", evidence.delta_e.mean),
        ),
        Some(_) => {}
    }
    findings
}

/// Whether a text is empty or has the words of a fit whose options did not state it.
fn is_not_stated(text: &str) -> bool {
    let text = text.trim();
    text.is_empty() || text.eq_ignore_ascii_case("not stated")
}

/// Words for the geometries of instruments, in upper case.
const GEOMETRIES: [&str; 14] = [
    "D:8", "D/8", "8:D", "8/D", "DI:8", "DE:8", "45:0", "45/0", "0:45", "0/45", "SCI", "SCE",
    "SPHERE", "FIBRE",
];

/// Whether title, source or a note of a pigment name the geometry of the instrument.
fn states_geometry(library: &PigmentLibrary) -> bool {
    let notes = library.pigments.iter().flat_map(|pigment| &pigment.notes);
    let mut texts = [&library.title, &library.source].into_iter().chain(notes);
    texts.any(|text| {
        let plain = text.to_uppercase().replace(['\u{b0}', '*'], "");
        let is_inside = |c: char| c.is_alphanumeric() || c == ':' || c == '/';
        let mut words =
            plain.split(|c: char| !is_inside(c)).map(|word| word.trim_matches([':', '/']));
        words.any(|word| GEOMETRIES.contains(&word))
    })
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
    if let Some(at) =
        pigment.absorption.iter().zip(&pigment.scattering).position(|(k, s)| *k == 0.0 && *s == 0.0)
    {
        let what = format!("K and S are both 0 at {} nm, which is not paint", grid.nm(at));
        found(Severity::Fault, what);
    }
    let least_s = if pigment.scattering.iter().any(|s| *s > 0.0) { 1.0 / MOST_FIGURE } else { 0.0 };
    for (letter, curve, least) in
        [("K", &pigment.absorption, 0.0), ("S", &pigment.scattering, least_s)]
    {
        let wrong = curve.iter().position(|value| !(least..=MOST_FIGURE).contains(value));
        if let Some(at) = wrong {
            let what =
                format!("{letter} is {:e} at {} nm, which is not paint", curve[at], grid.nm(at));
            found(Severity::Fault, what);
        }
    }
    let surface = library.saunderson;
    let film: Vec<f64> = pigment
        .absorption
        .iter()
        .zip(&pigment.scattering)
        .map(|(k, s)| surface.measured_from_internal(spectra::optics::infinite_film(*k, *s)))
        .collect();
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
                found(Severity::Warning, format!("no deviation of {letter} is stated"));
            }
            Some(share) if share > UNCERTAIN => {
                let what = format!("{letter} is uncertain by {:.0} % (median)", 100.0 * share);
                found(Severity::Warning, what);
            }
            _ => {}
        }
    }
}

/// Adds a finding if the library does not know how thin films of some pigments look.
fn of_thin_films(library: &PigmentLibrary, findings: &mut Vec<Finding>) {
    let films = library.pigments.iter().zip(least_films(library));
    let names: Vec<&str> = films
        .filter(|(_, least)| *least >= MOST_FILM)
        .map(|(pigment, _)| pigment.name.as_str())
        .collect();
    if !names.is_empty() {
        let what = format!(
            "S was fitted to films that hide, and by it thin films of {} have more chroma than their tints: measure drawdowns over black and white to know",
            names.join(", ")
        );
        findings.push(Finding { severity: Severity::Warning, pigment: None, what });
    }
}

/// Adds findings for pigments that look alike, alone and with the white.
fn near_pairs(library: &PigmentLibrary, weights: &TristimulusWeights, findings: &mut Vec<Finding>) {
    let white = library.reference_id();
    let colors: Vec<[Lab; 2]> = library
        .ids()
        .map(|id| {
            let masstone = Recipe::single(id);
            let tint =
                white.map_or(masstone.clone(), |white| Recipe::from([(id, 1.0), (white, 9.0)]));
            [masstone, tint].map(|recipe| lab(weights, &hiding(library, &recipe)))
        })
        .collect();
    for (second, pigment) in library.pigments.iter().enumerate() {
        for (first, other) in library.pigments[..second].iter().enumerate() {
            let apart = (colors[first].iter().zip(&colors[second]))
                .map(|(a, b)| delta_e_ciede2000(*a, *b))
                .fold(0.0, f64::max);
            let what = if letters_and_digits(&pigment.name) == letters_and_digits(&other.name) {
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

fn letters_and_digits(name: &str) -> String {
    name.chars().filter(|c| c.is_alphanumeric()).collect::<String>().to_lowercase()
}

fn hiding(library: &PigmentLibrary, recipe: &Recipe) -> Vec<f64> {
    library.mix(recipe).expect("parts above 0").hiding(library.saunderson)
}

fn range(curve: &[f64]) -> [f64; 2] {
    [curve.iter().copied().fold(f64::INFINITY, f64::min), curve.iter().copied().fold(0.0, f64::max)]
}

/// Median of standard deviation divided by value. `None` without deviations.
fn uncertainty(curve: &[f64], sd: &[f64]) -> Option<f64> {
    let pairs = curve.iter().zip(sd).filter(|(value, _)| **value > 0.0);
    let shares: Vec<f64> = pairs.map(|(value, sd)| sd / value).collect();
    (!shares.is_empty()).then(|| percentile(&shares, 50.0))
}

/// Index of the first value that differs from both its neighbours by more than [`JUMP`].
fn jump(curve: &[f64]) -> Option<usize> {
    // Near 0 a factor is meaningless.
    let least = 1e-3 * range(curve)[1];
    let log: Vec<f64> = curve.iter().map(|value| value.max(least).ln()).collect();
    (1..curve.len().saturating_sub(1)).find(|&at| {
        let left = log[at] - log[at - 1];
        let right = log[at] - log[at + 1];
        left * right > 0.0 && left.abs().min(right.abs()) > JUMP.ln()
    })
}

/// Parts of the pigment and of the white in a tint.
const TINT: [f64; 2] = [1.0, 9.0];

/// Colour difference of one pigment between two libraries, in CIEDE2000.
#[derive(Debug, Clone, PartialEq)]
pub struct PigmentDifference {
    /// Name of the pigment, equal in both libraries.
    pub name: String,
    /// Difference of the masstones.
    pub masstone: f64,
    /// Difference of the tints 1:9 in the common white. `None` where S is unknown or the libraries share no
    /// white.
    pub tint: Option<f64>,
}

/// Colour difference of a mixture of two pigments between two libraries.
#[derive(Debug, Clone, PartialEq)]
pub struct PigmentPair {
    /// Names of the two pigments.
    pub names: [String; 2],
    /// CIEDE2000 of the mixture 1:1, or 1:1:1 with the common white.
    pub delta_e: f64,
}

/// Differences between two libraries under one light, for films that hide.
#[derive(Debug, Clone, PartialEq)]
pub struct Difference {
    /// White of the tints and pairs: the reference of the first library, if both have it.
    pub white: Option<String>,
    /// Differences by pigment, in the order of the first library.
    pub pigments: Vec<PigmentDifference>,
    /// Differences of pairs of common pigments with known S.
    pub pairs: Vec<PigmentPair>,
    /// Names of pigments that only the first library has.
    pub only_first: Vec<String>,
    /// Names of pigments that only the second library has.
    pub only_second: Vec<String>,
}

impl Difference {
    /// Largest of all differences, 0 if the libraries share no pigment.
    #[must_use]
    pub fn largest(&self) -> f64 {
        let of_pigments = self.pigments.iter().flat_map(|p| [Some(p.masstone), p.tint]);
        let of_pairs = self.pairs.iter().map(|pair| Some(pair.delta_e));
        of_pigments.chain(of_pairs).flatten().fold(0.0, f64::max)
    }
}

/// Compares pigments of equal name, and up to `pairs` mixtures of two, which we draw with `seed` from all
/// possible pairs. We evaluate each library on its own grid and under its own surface.
#[must_use]
pub fn difference(
    first: &PigmentLibrary,
    second: &PigmentLibrary,
    viewing: &Viewing,
    pairs: usize,
    seed: u64,
) -> Difference {
    let sides = [Side::new(first, viewing), Side::new(second, viewing)];
    let in_first = names(first);
    let in_second = names(second);
    let white = first.reference.clone().filter(|name| in_second.contains(name));
    let apart = |recipe: &[(&str, f64)]| {
        let [a, b] = [&sides[0], &sides[1]].map(|side| side.lab(recipe));
        delta_e_ciede2000(a, b)
    };
    let known = |name: &str| sides.iter().all(|side| side.identified(name));
    let common: Vec<&String> = in_first.iter().filter(|name| in_second.contains(name)).collect();
    let pigments = common
        .iter()
        .map(|name| PigmentDifference {
            name: (*name).clone(),
            masstone: apart(&[(name, 1.0)]),
            tint: white
                .as_deref()
                .filter(|white| known(name) && *white != name.as_str())
                .map(|white| apart(&[(name, TINT[0]), (white, TINT[1])])),
        })
        .collect();
    let mixed: Vec<&str> = (common.iter().map(|name| name.as_str()))
        .filter(|name| known(name) && white.as_deref() != Some(name))
        .collect();
    let all: Vec<[&str; 2]> = (0..mixed.len())
        .flat_map(|a| (a + 1..mixed.len()).map(move |b| (a, b)))
        .map(|(a, b)| [mixed[a], mixed[b]])
        .collect();
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut drawn = index::sample(&mut random, all.len(), pairs.min(all.len())).into_vec();
    drawn.sort_unstable();
    let pairs = drawn.into_iter().map(|index| {
        let [a, b] = all[index];
        let mut recipe = vec![(a, 1.0), (b, 1.0)];
        recipe.extend(white.as_deref().map(|white| (white, 1.0)));
        PigmentPair { names: [a.to_owned(), b.to_owned()], delta_e: apart(&recipe) }
    });
    Difference {
        pairs: pairs.collect(),
        pigments,
        only_first: names_without(&in_first, &in_second),
        only_second: names_without(&in_second, &in_first),
        white,
    }
}

fn names_without(names: &[String], others: &[String]) -> Vec<String> {
    names.iter().filter(|name| !others.contains(name)).cloned().collect()
}

fn names(library: &PigmentLibrary) -> Vec<String> {
    library.pigments.iter().map(|pigment| pigment.name.clone()).collect()
}

/// One of the two libraries, with the weights for its grid.
struct Side<'a> {
    library: &'a PigmentLibrary,
    weights: TristimulusWeights,
}

impl<'a> Side<'a> {
    fn new(library: &'a PigmentLibrary, viewing: &Viewing) -> Self {
        let weights = viewing.weights(library.grid).expect("the method fits the grid");
        Self { library, weights }
    }

    fn id(&self, name: &str) -> PigmentId {
        let mut ids = self.library.ids();
        ids.find(|id| self.library[*id].name == name).expect("both libraries have the pigment")
    }

    fn identified(&self, name: &str) -> bool {
        self.library[self.id(name)].identified
    }

    fn lab(&self, recipe: &[(&str, f64)]) -> Lab {
        let parts: Recipe = recipe.iter().map(|(name, part)| (self.id(name), *part)).collect();
        let mixture = self.library.mix(parts).expect("parts above 0");
        lab(&self.weights, &mixture.hiding(self.library.saunderson))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pigments_with_unknown_thin_films_are_named() {
        let mut oils = PigmentLibrary::van_gogh_oils();
        let [relative, absolute] = [AmountKind::Relative, AmountKind::Absolute].map(|amounts| {
            oils.amounts = amounts;
            let findings = health(&oils, &Viewing::default()).findings;
            findings.into_iter().find(|finding| finding.what.contains("thin films of"))
        });
        let found = relative.expect("a finding");
        assert_eq!(found.severity, Severity::Warning);
        assert!(found.what.contains("Ultramarine") && !found.what.contains("Lead White"));
        assert_eq!(absolute, None, "thin films of absolute amounts were measured");
    }

    fn faults(library: &PigmentLibrary) -> Vec<String> {
        let found = health(library, &Viewing::default()).findings;
        let faults = found.into_iter().filter(|finding| finding.severity == Severity::Fault);
        faults.map(|finding| finding.what).collect()
    }

    #[test]
    fn figures_that_no_paint_has_are_faults() {
        let sound = PigmentLibrary::van_gogh_oils();
        assert!(faults(&sound).is_empty(), "{:?}", faults(&sound));
        type Change = fn(&mut PigmentLibrary);
        let changes: [(Change, &str); 4] = [
            (|l| l.pigments[3].absorption[2] = 1e300, "K is 1e300 at 420 nm, which is not paint"),
            (|l| l.pigments[3].scattering[2] = 1e-300, "S is 1e-300 at 420 nm, which is not paint"),
            (|l| l.saunderson.k1 = 0.999, "k1 is 0.999, but surfaces of paint reflect 0.02 to 0.1"),
            (
                |l| l.grid = spectra::Grid::from_nm(400.0, 1e-9, l.grid.count()).unwrap(),
                "steps of 1e-9 nm are finer than any instrument reads",
            ),
        ];
        for (change, what) in changes {
            let mut library = sound.clone();
            change(&mut library);
            assert!(faults(&library).contains(&what.to_owned()), "{what}: {:?}", faults(&library));
        }
    }

    #[test]
    fn conditions_that_nobody_stated_are_found() {
        let mut library = PigmentLibrary::van_gogh_oils();
        for (source, is_stated) in [
            ("read with a d:8 sphere", true),
            ("45\u{b0}:0\u{b0}, black backing", true),
            ("SCI, aperture 8 mm", true),
            ("Konica CM-700d (SCE)", true),
            ("samples 145:07 of the archive", false),
            ("science of paint", false),
            ("not stated", false),
        ] {
            source.clone_into(&mut library.source);
            assert_eq!(states_geometry(&library), is_stated, "{source}");
        }
        let found = |library: &PigmentLibrary| -> Vec<String> {
            of_library(library).into_iter().map(|finding| finding.what).collect()
        };
        assert!(found(&library).contains(&"no source is stated".to_owned()));
        library.licence = "Not stated ".to_owned();
        library.inputs.clear();
        let found = found(&library);
        for what in ["no licence is stated", "no measurement file is stated"] {
            assert!(found.contains(&what.to_owned()), "{found:?}");
        }
    }
}
