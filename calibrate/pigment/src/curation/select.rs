//! Renaming pigments and selecting a subset.

use super::error::CurationError;
use crate::library::PigmentLibrary;
use crate::recipe::PigmentId;

/// Renames pigments by `(old, new)` pairs, all at once, so that two names can be exchanged. Everything
/// else stays, including the words of the evidence.
///
/// # Errors
/// [`CurationError`] for an unknown name, and for a new name that is empty or taken.
pub fn renamed(
    file: &str,
    library: &PigmentLibrary,
    names: &[(String, String)],
) -> Result<PigmentLibrary, CurationError> {
    let mut result = library.clone();
    for (old, new) in names {
        let id = find(file, library, old)?;
        let new = new.trim();
        if new.is_empty() || new.contains(char::is_control) {
            let name = new.escape_default().to_string();
            return Err(CurationError::Name { file: file.to_owned(), name });
        }
        new.clone_into(&mut result.pigments[id.index()].name);
        if library.reference.as_ref() == Some(&library[id].name) {
            result.reference = Some(new.to_owned());
        }
    }
    for (index, pigment) in result.pigments.iter().enumerate() {
        if result.pigments[..index].iter().any(|other| other.name == pigment.name) {
            let name = pigment.name.clone();
            return Err(CurationError::Name { file: file.to_owned(), name });
        }
    }
    Ok(result)
}

/// Sets the Colour Index name of pigments by `(pigment, name)` pairs; an empty name removes it.
///
/// # Errors
/// [`CurationError`] for an unknown pigment.
pub fn with_color_indices(
    file: &str,
    library: &PigmentLibrary,
    indices: &[(String, String)],
) -> Result<PigmentLibrary, CurationError> {
    let mut result = library.clone();
    for (pigment, index_name) in indices {
        let name = index_name.trim();
        let color_index = (!name.is_empty()).then(|| name.to_owned());
        result.pigments[find(file, library, pigment)?.index()].color_index = color_index;
    }
    Ok(result)
}

/// Selects the pigments of `keep` (all, if empty) except those of `without`, in the library's order.
///
/// The errors of single samples are dropped, since no library records what a sample contained. The
/// summary stays, with a note that it belongs to the whole fit.
///
/// # Errors
/// [`CurationError`] for an unknown name, if no pigment is left, and if the reference would be left out.
pub fn subset(
    file: &str,
    library: &PigmentLibrary,
    keep: &[String],
    without: &[String],
) -> Result<PigmentLibrary, CurationError> {
    let found = |names: &[String]| -> Result<Vec<PigmentId>, CurationError> {
        names.iter().map(|name| find(file, library, name)).collect()
    };
    let kept = found(keep)?;
    let dropped = found(without)?;
    let stays = |id: &PigmentId| (keep.is_empty() || kept.contains(id)) && !dropped.contains(id);
    let ids: Vec<PigmentId> = library.ids().filter(stays).collect();
    if ids.is_empty() {
        return Err(CurationError::Empty { file: file.to_owned() });
    }
    if let Some(reference) = &library.reference
        && !ids.iter().any(|&id| library[id].name == *reference)
    {
        return Err(CurationError::ReferenceLeftOut {
            file: file.to_owned(),
            reference: reference.clone(),
        });
    }
    let mut evidence = library.evidence.clone();
    if let Some(evidence) = &mut evidence
        && ids.len() < library.pigments.len()
    {
        evidence.per_sample.clear();
        evidence.warnings.push(format!(
            "{} of {} pigments: the errors are those of the whole fit",
            ids.len(),
            library.pigments.len()
        ));
    }
    let pigments = ids.iter().map(|&id| library[id].clone()).collect();
    Ok(PigmentLibrary { pigments, evidence, ..library.clone() })
}

fn find(file: &str, library: &PigmentLibrary, name: &str) -> Result<PigmentId, CurationError> {
    library.find(name).map_err(|error| CurationError::Pigment { file: file.to_owned(), error })
}
