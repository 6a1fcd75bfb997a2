//! Tinting strength: how strongly a paint colours white.

use super::paints::Palette;
use crate::library::AmountKind;
use crate::recipe::{PigmentId, Recipe};

/// Parts of white to one of paint in the tints that are compared: 10 % of paint, which most sets of
/// swatches contain.
pub const TINT_PARTS: f64 = 9.0;

/// K/S of a tint that has [`TintingStrength::white_parts`] parts of white, at the wavelength where it absorbs
/// most: 1, which is an internal reflectance of 0.27.
pub const TINT_DEPTH: f64 = 1.0;

/// Tinting strength of one paint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TintingStrength {
    /// Pigment of the library.
    pub paint: PigmentId,
    /// Wavelength in nm at which K/S of the tint exceeds that of the white most; for absolute amounts, at
    /// which K is greatest.
    pub wavelength_nm: f64,
    /// Increase of K/S over that of the white at that wavelength; for absolute amounts, K per unit of amount.
    /// 0 if K/S rises at no wavelength.
    pub strength: f64,
    /// `strength` in percent of that of the standard paint.
    pub percent: f64,
    /// Parts of white to one of paint that make a tint of K/S = 1 at that wavelength; `None` for a
    /// paint that is lighter than that by itself, or for absolute amounts.
    pub white_parts: Option<f64>,
}

/// Computes the tinting strength of every paint but the white, relative to `standard` (by default
/// the strongest paint).
///
/// ISO 787-24 compares tints by K/S where the tint of one part in nine parts of the reference white
/// absorbs most. The white's own K/S is subtracted, so that a paint of twice the absorption has
/// twice the strength. A library of absolute amounts has no white paint; there K of one unit of
/// amount is the strength.
#[must_use]
pub fn tinting_strengths(
    palette: &Palette<'_>,
    standard: Option<PigmentId>,
) -> Vec<TintingStrength> {
    let paints = palette.paints().iter().filter(|&&p| Some(p) != palette.white());
    let mut strengths: Vec<TintingStrength> = paints.map(|&p| strength(palette, p)).collect();
    let named = standard.and_then(|wanted| strengths.iter().find(|s| s.paint == wanted));
    let strongest = strengths.iter().map(|s| s.strength).fold(0.0, f64::max);
    let whole = named.map_or(strongest, |s| s.strength);
    for strength in &mut strengths {
        strength.percent = if whole > 0.0 { 100.0 * strength.strength / whole } else { 0.0 };
    }
    strengths
}

fn strength(palette: &Palette<'_>, paint: PigmentId) -> TintingStrength {
    let library = palette.library();
    let pigment = &library[paint];
    let added: Vec<f64> = match (library.amounts, palette.white()) {
        (AmountKind::Relative, Some(white)) => {
            let tint = palette.mixture(&palette.tint(paint, TINT_PARTS));
            let white = palette.mixture(&Recipe::single(white));
            let ratio = |k: f64, s: f64| if s > 0.0 { k / s } else { 0.0 };
            (0..library.grid.count())
                .map(|i| {
                    ratio(tint.absorption[i], tint.scattering[i])
                        - ratio(white.absorption[i], white.scattering[i])
                })
                .collect()
        }
        _ => pigment.absorption.clone(),
    };
    let most = added.iter().enumerate();
    let (at, most) =
        most.fold((0, f64::NEG_INFINITY), |m, (i, &v)| if v > m.1 { (i, v) } else { m });
    let white_parts = palette.white().and_then(|white| {
        let white = &library[white];
        // (K + n Kw) / (S + n Sw) = depth, solved for n.
        let own = pigment.absorption[at] - TINT_DEPTH * pigment.scattering[at];
        let per_part = TINT_DEPTH * white.scattering[at] - white.absorption[at];
        (own >= 0.0 && per_part > 0.0).then(|| own / per_part)
    });
    TintingStrength {
        paint,
        wavelength_nm: library.grid.nm(at),
        strength: most.max(0.0),
        percent: 0.0,
        white_parts,
    }
}
