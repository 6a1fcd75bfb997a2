//! One library of several.

use spectra::{Extrapolation, Interpolation};

use super::error::CurationError;
use super::resample::on_grid;
use super::rescale::with_reference;
use super::select::renamed;
use crate::evaluate::{Viewing, delta_e};
use crate::library::{AmountKind, Pigment, PigmentLibrary};

/// Two batches of one white are nearer than this, in CIEDE2000.
const SAME_WHITE: f64 = 1.0;

/// A library and the file that it stands in.
#[derive(Debug, Clone, PartialEq)]
pub struct Source {
    /// As the user named it.
    pub file: String,
    /// What stands in it.
    pub library: PigmentLibrary,
}

/// Which of two different pigments of one name stays.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Prefer {
    /// That of the library named first.
    First,
    /// That of the library named last.
    Last,
}

/// How libraries are joined.
#[derive(Debug, Clone, PartialEq)]
pub struct MergeSettings {
    /// The white that all libraries share, as the first calls it; its reference
    /// if not told.
    pub reference: Option<String>,
    /// What other libraries call that white.
    pub aliases: Vec<String>,
    /// Which of two different pigments of one name stays; if not told, two such
    /// pigments are an error, but for the white, of which the first stays.
    pub prefer: Option<Prefer>,
    /// How other grids are brought to the first's; the best for each if not told.
    pub interpolation: Option<Interpolation>,
    /// What stands beyond another library's band.
    pub ends: Extrapolation,
    /// Take pigments found under another surface, as if it were the first's.
    pub any_surface: bool,
    /// Absolute amounts are in one unit on one area.
    pub same_unit: bool,
    /// The light and observer of differences.
    pub viewing: Viewing,
}

/// Several libraries as one.
#[derive(Debug, Clone, PartialEq)]
pub struct Merged {
    /// On the first's grid, relative to its reference; without evidence, which is
    /// that of one fit.
    pub library: PigmentLibrary,
    /// Pigments that stood in two libraries: name, file of the second, CIEDE2000
    /// between the masstones.
    pub common: Vec<(String, String, f64)>,
    /// What a user must know of it.
    pub warnings: Vec<String>,
}

/// The pigments of `first` and `others` as one library.
///
/// Relative libraries are scaled to one reference white ([`with_reference`]): the
/// same paint has S = 1 in all. Each pigment gets a note of where it is from and
/// how well that fit did; inputs, licences and sources are united.
///
/// # Errors
/// [`CurationError`] where libraries cannot stand side by side, or one name means
/// two pigments and neither is preferred.
pub fn merged(
    first: &Source,
    others: &[Source],
    settings: &MergeSettings,
) -> Result<Merged, CurationError> {
    let mut base = first.library.clone();
    if let Some(reference) = &settings.reference {
        base = with_reference(&first.file, &base, reference)?;
    }
    if base.amounts == AmountKind::Relative && base.reference.is_none() {
        return Err(CurationError::NoReference { file: first.file.clone() });
    }
    for pigment in &mut base.pigments {
        pigment.notes.push(origin(first));
    }
    base.evidence = None;
    let mut merged = Merged { library: base, common: Vec::new(), warnings: Vec::new() };
    for other in others {
        let fitted = merged.fitted(first, other, settings)?;
        merged.add(first, other, fitted.pigments, settings)?;
        let base = &mut merged.library;
        for (whole, part) in [
            (&mut base.title, &other.library.title),
            (&mut base.licence, &other.library.licence),
            (&mut base.source, &other.library.source),
        ] {
            unite(whole, part);
        }
        for input in &other.library.inputs {
            if !base.inputs.contains(input) {
                base.inputs.push(input.clone());
            }
        }
        if base.settings != other.library.settings {
            base.settings = None;
        }
    }
    Ok(merged)
}

impl Merged {
    /// `other` with the reference and the grid of what there is.
    fn fitted(
        &mut self,
        first: &Source,
        other: &Source,
        settings: &MergeSettings,
    ) -> Result<PigmentLibrary, CurationError> {
        let (base, file) = (&self.library, &other.file);
        check_amounts(base, first, other, settings.same_unit)?;
        self.warnings.extend(check_surface(base, first, other, settings.any_surface)?);
        let mut library = other.library.clone();
        if let Some(reference) = &base.reference {
            let lower = reference.to_lowercase();
            let same = library.pigments.iter().find(|p| p.name.to_lowercase() == lower);
            let alias = || settings.aliases.iter().find_map(|alias| library.find(alias).ok());
            let name = same.map(|pigment| pigment.name.clone());
            let name = name.or_else(|| alias().map(|index| library.pigments[index].name.clone()));
            let name = name.ok_or_else(|| CurationError::NoCommonPigment {
                first: first.file.clone(),
                file: file.clone(),
                reference: reference.clone(),
            })?;
            if library.reference.as_ref() != Some(&name) {
                self.warnings.push(format!("{file}: K and S divided by the S of {name}"));
            }
            library = with_reference(file, &library, &name)?;
            if name != *reference {
                library = renamed(file, &library, &[(name, reference.clone())])?;
            }
        }
        if library.grid != base.grid {
            let best = Interpolation::best_for(library.grid);
            let method = settings.interpolation.unwrap_or(best);
            self.warnings.push(format!(
                "{file}: {} brought to {} ({})",
                library.grid,
                base.grid,
                method.name()
            ));
            library = on_grid(file, &library, base.grid, method, settings.ends)?;
        }
        Ok(library)
    }

    fn add(
        &mut self,
        first: &Source,
        other: &Source,
        pigments: Vec<Pigment>,
        settings: &MergeSettings,
    ) -> Result<(), CurationError> {
        let weights = settings.viewing.weights(self.library.grid).expect("a method for the grid");
        for mut pigment in pigments {
            pigment.notes.push(origin(other));
            let stands = self.library.pigments.iter().position(|p| p.name == pigment.name);
            let Some(index) = stands else {
                self.library.pigments.push(pigment);
                continue;
            };
            let before = &mut self.library.pigments[index];
            let hiding = |pigment: &Pigment| {
                let part = (1.0, pigment.absorption.as_slice(), pigment.scattering.as_slice());
                crate::mixture::Mixture::of(pigment.absorption.len(), [part])
                    .hiding(first.library.saunderson)
            };
            let delta_e = delta_e(&weights, &hiding(before), &hiding(&pigment));
            self.common.push((pigment.name.clone(), other.file.clone(), delta_e));
            if same_figures(before, &pigment) {
                continue;
            }
            let white = self.library.reference.as_ref() == Some(&pigment.name);
            if white && delta_e > SAME_WHITE {
                self.warnings.push(format!(
                    "{}: its {} is {delta_e:.2} CIEDE2000 from the first's; is it the same paint?",
                    other.file, pigment.name
                ));
            }
            match settings.prefer {
                Some(Prefer::Last) => *before = pigment,
                None if !white => {
                    return Err(CurationError::Clash {
                        first: first.file.clone(),
                        file: other.file.clone(),
                        pigment: pigment.name,
                        delta_e,
                    });
                }
                Some(Prefer::First) | None => {}
            }
        }
        Ok(())
    }
}

fn check_amounts(
    base: &PigmentLibrary,
    first: &Source,
    other: &Source,
    same_unit: bool,
) -> Result<(), CurationError> {
    let word = |kind| match kind {
        AmountKind::Relative => "relative",
        AmountKind::Absolute => "absolute",
    };
    if base.amounts != other.library.amounts {
        return Err(CurationError::Amounts {
            first: first.file.clone(),
            wanted: word(base.amounts),
            file: other.file.clone(),
            found: word(other.library.amounts),
        });
    }
    if base.amounts == AmountKind::Absolute && !same_unit {
        return Err(CurationError::Units { first: first.file.clone(), file: other.file.clone() });
    }
    Ok(())
}

/// A warning where another surface is taken for the first's.
fn check_surface(
    base: &PigmentLibrary,
    first: &Source,
    other: &Source,
    any: bool,
) -> Result<Option<String>, CurationError> {
    let surface = |library: &PigmentLibrary| {
        let surface = library.saunderson;
        let specular = serde_json::json!(surface.specular);
        format!("k1 = {}, k2 = {}, specular {specular}", surface.k1, surface.k2).replace('"', "")
    };
    let (what, wanted, found) = if base.saunderson != other.library.saunderson {
        ("the surface", surface(base), surface(&other.library))
    } else if base.unevenness != other.library.unevenness {
        let unevenness = |library: &PigmentLibrary| library.unevenness.to_string();
        ("the unevenness", unevenness(base), unevenness(&other.library))
    } else {
        return Ok(None);
    };
    if any {
        return Ok(Some(format!(
            "{}: {what} differs ({found} for {wanted}); its K and S do not hold under the first's",
            other.file
        )));
    }
    let (first, file) = (first.file.clone(), other.file.clone());
    Err(CurationError::Surface { what, first, wanted, file, found })
}

/// Alike to the rounding of a file.
fn same_figures(a: &Pigment, b: &Pigment) -> bool {
    let near = |a: &[f64], b: &[f64]| {
        a.iter().zip(b).all(|(a, b)| (a - b).abs() <= 2e-5 * a.abs().max(b.abs()))
    };
    near(&a.absorption, &b.absorption) && near(&a.scattering, &b.scattering)
}

fn origin(source: &Source) -> String {
    let library = &source.library;
    let name = if library.title.is_empty() { &source.file } else { &library.title };
    match &library.evidence {
        None => format!("from {name}"),
        Some(evidence) => format!(
            "from {name}, whose fit is off by {:.2} CIEDE2000 on average and {:.2} at most",
            evidence.delta_e.mean, evidence.delta_e.max
        ),
    }
}

/// Adds `part` to a list parted by semicolons, once.
fn unite(whole: &mut String, part: &str) {
    if whole.is_empty() {
        part.clone_into(whole);
    } else if !part.is_empty() && !whole.split("; ").any(|known| known == part) {
        *whole += "; ";
        *whole += part;
    }
}
