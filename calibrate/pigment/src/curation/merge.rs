//! Merging several libraries into one.

use spectra::{Extrapolation, Interpolation};

use super::change::{CurationError, on_grid, renamed, with_reference};
use crate::evaluate::{Viewing, delta_e};
use crate::library::{AmountKind, Pigment, PigmentLibrary};
use crate::recipe::hiding_film;

/// Two batches of one white differ by less than this, in CIEDE2000. We chose it by eye.
const SAME_WHITE: f64 = 1.0;

/// A library with the name of its file.
#[derive(Debug, Clone, PartialEq)]
pub struct Source {
    /// File name as the caller gave it.
    pub file: String,
    /// Content of the file.
    pub library: PigmentLibrary,
}

/// Choice between two different pigments of one name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Prefer {
    /// Keep the pigment of the library named first.
    First,
    /// Keep the pigment of the library named last.
    Last,
}

/// Settings of a merge.
#[derive(Debug, Clone, PartialEq)]
pub struct MergeSettings {
    /// Name of the white that all libraries share, as the first library spells it. By default the
    /// reference of the first.
    pub reference: Option<String>,
    /// Names of that white in other libraries.
    pub aliases: Vec<String>,
    /// Choice between two different pigments of one name. Without a choice they are an error, except
    /// for the white, of which the first is kept.
    pub prefer: Option<Prefer>,
    /// Interpolation from other grids to the first's. By default the best one for each grid.
    pub interpolation: Option<Interpolation>,
    /// Treatment of wavelengths beyond another library's band.
    pub ends: Extrapolation,
    /// Accept K and S that were found under another surface as if it were the first library's.
    pub any_surface: bool,
    /// Assume that the absolute amounts of all libraries have the same unit and refer to the same area.
    pub same_unit: bool,
    /// Light and observer of colour differences.
    pub viewing: Viewing,
}

/// Result of a merge.
#[derive(Debug, Clone, PartialEq)]
pub struct Merged {
    /// Merged library on the first's grid and relative to its reference. It has no evidence, because
    /// evidence belongs to a single fit.
    pub library: PigmentLibrary,
    /// Pigments found in two libraries: name, file of the second, CIEDE2000 between the masstones.
    pub common: Vec<(String, String, f64)>,
    /// Reservations about the merged library, in words for you.
    pub warnings: Vec<String>,
}

/// Merges the pigments of `first` and `others` into one library.
///
/// We scale relative libraries to one reference white ([`with_reference`]), so that one paint has S = 1 in
/// all of them. Each pigment gets a note that names its library and the error of that fit. We unite inputs,
/// licences and sources.
///
/// # Errors
/// [`CurationError`] where libraries cannot be combined, or one name stands for two pigments and
/// [`MergeSettings::prefer`] is `None`.
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
        return Err(CurationError::NoReference(first.file.clone()));
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
    /// `other` scaled to the reference and resampled to the grid of the merged library.
    fn fitted(
        &mut self,
        first: &Source,
        other: &Source,
        settings: &MergeSettings,
    ) -> Result<PigmentLibrary, CurationError> {
        let base = &self.library;
        let file = &other.file;
        check_amounts(base, first, other, settings.same_unit)?;
        self.warnings.extend(check_surface(base, first, other, settings.any_surface)?);
        let mut library = other.library.clone();
        if let Some(reference) = &base.reference {
            let lower = reference.to_lowercase();
            let same = library.pigments.iter().find(|p| p.name.to_lowercase() == lower);
            let name = same.map(|pigment| pigment.name.clone());
            let name = name.or_else(|| {
                settings
                    .aliases
                    .iter()
                    .find_map(|alias| library.find(alias).ok())
                    .map(|id| library[id].name.clone())
            });
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
        let weights =
            settings.viewing.weights(self.library.grid).expect("the method fits the grid");
        for mut pigment in pigments {
            pigment.notes.push(origin(other));
            let stands = self.library.pigments.iter().position(|p| p.name == pigment.name);
            let Some(index) = stands else {
                self.library.pigments.push(pigment);
                continue;
            };
            let before = &mut self.library.pigments[index];
            let [a, b] = [before, &pigment].map(|pigment| {
                hiding_film(&pigment.absorption, &pigment.scattering, first.library.saunderson)
            });
            let delta_e = delta_e(&weights, &a, &b);
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
    if base.amounts != other.library.amounts {
        return Err(CurationError::Amounts {
            first: first.file.clone(),
            wanted: amount_word(base.amounts),
            file: other.file.clone(),
            found: amount_word(other.library.amounts),
        });
    }
    if base.amounts == AmountKind::Absolute && !same_unit {
        return Err(CurationError::Units { first: first.file.clone(), file: other.file.clone() });
    }
    Ok(())
}

fn amount_word(kind: AmountKind) -> &'static str {
    match kind {
        AmountKind::Relative => "relative",
        AmountKind::Absolute => "absolute",
    }
}

/// Checks that `other` has the surface and unevenness of the first library. If `any` accepts others, you
/// get a warning.
fn check_surface(
    base: &PigmentLibrary,
    first: &Source,
    other: &Source,
    any: bool,
) -> Result<Option<String>, CurationError> {
    let (what, wanted, found) = if base.saunderson != other.library.saunderson {
        ("the surface", surface_text(base), surface_text(&other.library))
    } else if base.unevenness != other.library.unevenness {
        ("the unevenness", base.unevenness.to_string(), other.library.unevenness.to_string())
    } else {
        return Ok(None);
    };
    if any {
        return Ok(Some(format!(
            "{}: {what} differs ({found} for {wanted}); its K and S do not hold under the first's",
            other.file
        )));
    }
    let keeps_first = base.saunderson.k1 <= other.library.saunderson.k1;
    let first = first.file.clone();
    let file = other.file.clone();
    Err(CurationError::Surface { what, keeps_first, first, wanted, file, found })
}

fn surface_text(library: &PigmentLibrary) -> String {
    let surface = library.saunderson;
    let specular = serde_json::json!(surface.specular);
    format!("k1 = {}, k2 = {}, specular {specular}", surface.k1, surface.k2).replace('"', "")
}

/// Whether K and S are equal to the rounding of a file.
fn same_figures(a: &Pigment, b: &Pigment) -> bool {
    nearly_equal(&a.absorption, &b.absorption) && nearly_equal(&a.scattering, &b.scattering)
}

fn nearly_equal(a: &[f64], b: &[f64]) -> bool {
    a.iter().zip(b).all(|(a, b)| (a - b).abs() <= 2e-5 * a.abs().max(b.abs()))
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

/// Appends `part` to a list separated by semicolons, unless it is there already.
fn unite(whole: &mut String, part: &str) {
    if whole.is_empty() {
        part.clone_into(whole);
    } else if !part.is_empty() && !whole.split("; ").any(|known| known == part) {
        *whole += "; ";
        *whole += part;
    }
}
