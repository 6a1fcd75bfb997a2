//! Scaling a library to another reference white.

use super::error::CurationError;
use crate::digits::rounded;
use crate::library::{AmountKind, Pigment, PigmentLibrary};

/// Scales K and S to the S of `reference`, a name that [`PigmentLibrary::find`] accepts. Absolute amounts
/// become shares.
///
/// Every K and S is divided by the reference's S at that wavelength, so every mixture keeps its K/S and every
/// film that hides keeps its colour. Films that do not hide change, because thickness 1 now refers to another
/// white. Standard deviations are divided too, except those of S for the two references: the new one gets 0,
/// and the old one gets the relative deviation that S of the new one had. A pigment whose S was never known
/// keeps its K/S with S = 1. The unevenness and the evidence of absolute amounts are dropped, since they do
/// not apply to films that hide.
///
/// # Errors
/// [`CurationError`] if there is no such pigment, or its S is unknown or 0.
pub fn with_reference(
    file: &str,
    library: &PigmentLibrary,
    reference: &str,
) -> Result<PigmentLibrary, CurationError> {
    let id = library
        .find(reference)
        .map_err(|error| CurationError::Pigment { file: file.to_owned(), error })?;
    let white = &library[id];
    if library.reference.as_ref() == Some(&white.name) {
        return Ok(library.clone());
    }
    if !white.identified {
        return Err(CurationError::UnknownScattering {
            file: file.to_owned(),
            pigment: white.name.clone(),
        });
    }
    if let Some(at) = white.scattering.iter().position(|s| *s <= 0.0) {
        return Err(CurationError::NoScattering {
            file: file.to_owned(),
            pigment: white.name.clone(),
            nm: library.grid.nm(at),
            value: white.scattering[at],
        });
    }
    let absolute = library.amounts == AmountKind::Absolute;
    let divided = |curve: &[f64]| -> Vec<f64> {
        curve.iter().zip(&white.scattering).map(|(value, s)| rounded(value / s)).collect()
    };
    let rescaled = |pigment: &Pigment| {
        if !pigment.identified && !absolute {
            return pigment.clone();
        }
        let mut scattering_sd = divided(&pigment.scattering_sd);
        if pigment.name == white.name {
            scattering_sd.fill(0.0);
        } else if library.reference.as_ref() == Some(&pigment.name) {
            // The relative deviation of 1 / S is that of S.
            let pairs = white.scattering_sd.iter().zip(&white.scattering);
            scattering_sd = pairs.map(|(sd, s)| rounded(sd / (s * s))).collect();
        }
        Pigment {
            absorption: divided(&pigment.absorption),
            scattering: divided(&pigment.scattering),
            absorption_sd: divided(&pigment.absorption_sd),
            scattering_sd,
            measured_amounts: None,
            ..pigment.clone()
        }
    };
    Ok(PigmentLibrary {
        reference: Some(white.name.clone()),
        amounts: AmountKind::Relative,
        unevenness: 0.0,
        evidence: if absolute { None } else { library.evidence.clone() },
        pigments: library.pigments.iter().map(rescaled).collect(),
        ..library.clone()
    })
}
