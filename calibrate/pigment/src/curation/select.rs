//! Other names, and fewer pigments.

use super::error::CurationError;
use crate::library::PigmentLibrary;

/// The library with each `(old, new)` name changed, all at once, so that two may
/// be exchanged; everything else is as it was, the words of the evidence too.
///
/// # Errors
/// [`CurationError`] for an unknown name, and for a new one that is empty or taken.
pub fn renamed(
    file: &str,
    library: &PigmentLibrary,
    names: &[(String, String)],
) -> Result<PigmentLibrary, CurationError> {
    let mut result = library.clone();
    for (old, new) in names {
        let index = find(file, library, old)?;
        let new = new.trim();
        if new.is_empty() || new.contains(char::is_control) {
            let name = new.escape_default().to_string();
            return Err(CurationError::Name { file: file.to_owned(), name });
        }
        new.clone_into(&mut result.pigments[index].name);
        if library.reference.as_ref() == Some(&library.pigments[index].name) {
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

/// The library with the Colour Index name of each `(pigment, name)`; an empty name
/// takes it away.
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
        result.pigments[find(file, library, pigment)?].color_index = color_index;
    }
    Ok(result)
}

/// The library with the pigments of `keep` alone (all, if empty) but for those of
/// `without`, in the library's order.
///
/// The errors of single samples go, since no library says what was in a sample;
/// the summary stays, with a word that it is of the whole fit.
///
/// # Errors
/// [`CurationError`] for an unknown name, if nothing is left, and if the reference
/// would go.
pub fn subset(
    file: &str,
    library: &PigmentLibrary,
    keep: &[String],
    without: &[String],
) -> Result<PigmentLibrary, CurationError> {
    let found = |names: &[String]| -> Result<Vec<usize>, CurationError> {
        names.iter().map(|name| find(file, library, name)).collect()
    };
    let (kept, dropped) = (found(keep)?, found(without)?);
    let stays =
        |index: &usize| (keep.is_empty() || kept.contains(index)) && !dropped.contains(index);
    let indices: Vec<usize> = (0..library.pigments.len()).filter(stays).collect();
    if indices.is_empty() {
        return Err(CurationError::Empty { file: file.to_owned() });
    }
    if let Some(reference) = &library.reference
        && !indices.iter().any(|&index| library.pigments[index].name == *reference)
    {
        return Err(CurationError::ReferenceLeftOut {
            file: file.to_owned(),
            reference: reference.clone(),
        });
    }
    let mut evidence = library.evidence.clone();
    if let Some(evidence) = &mut evidence
        && indices.len() < library.pigments.len()
    {
        evidence.per_sample.clear();
        evidence.warnings.push(format!(
            "{} of {} pigments: the errors are those of the whole fit",
            indices.len(),
            library.pigments.len()
        ));
    }
    let pigments = indices.iter().map(|&index| library.pigments[index].clone()).collect();
    Ok(PigmentLibrary { pigments, evidence, ..library.clone() })
}

fn find(file: &str, library: &PigmentLibrary, name: &str) -> Result<usize, CurationError> {
    library.find(name).map_err(|error| CurationError::Pigment { file: file.to_owned(), error })
}
