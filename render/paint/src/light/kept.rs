//! Quadratures that were fitted before: a program asks for the same few lights again and again.

use std::sync::{Mutex, PoisonError};

use pigment::evaluate::Viewing;
use pigment::library::PigmentLibrary;
use pigment::quadrature::{EffectiveQuadrature, QuadratureFailure};

use crate::optics::NODES;

/// Quadratures that are kept, those used last: two of a split view, and a few that a painter compares.
const KEPT: usize = 8;

static QUADRATURES: KeptQuadratures = KeptQuadratures(Mutex::new(Vec::new()));

/// The quadrature of a light for a library; fitted, which takes about a second, unless it was before.
pub(super) fn quadrature(
    library: &PigmentLibrary,
    viewing: &Viewing,
) -> Result<EffectiveQuadrature, QuadratureFailure> {
    QUADRATURES.get(library, viewing, || EffectiveQuadrature::of(viewing, library, NODES))
}

/// All that a quadrature depends on, and the quadrature.
#[derive(Debug)]
struct Kept {
    library: PigmentLibrary,
    viewing: Viewing,
    quadrature: EffectiveQuadrature,
}

/// Quadratures, the one used last at the end.
#[derive(Debug)]
struct KeptQuadratures(Mutex<Vec<Kept>>);

impl KeptQuadratures {
    fn get(
        &self,
        library: &PigmentLibrary,
        viewing: &Viewing,
        fit: impl FnOnce() -> Result<EffectiveQuadrature, QuadratureFailure>,
    ) -> Result<EffectiveQuadrature, QuadratureFailure> {
        let lock = || self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let place = |kept: &[Kept]| {
            kept.iter().position(|one| one.viewing == *viewing && one.library == *library)
        };
        let mut kept = lock();
        if let Some(place) = place(&kept) {
            let used = kept.remove(place);
            let quadrature = used.quadrature.clone();
            kept.push(used);
            return Ok(quadrature);
        }
        // The fit runs without the lock: a thread that waits in it may take up work that needs the lock.
        drop(kept);
        let quadrature = fit()?;
        let mut kept = lock();
        if place(&kept).is_none() {
            let library = library.clone();
            let viewing = viewing.clone();
            kept.push(Kept { library, viewing, quadrature: quadrature.clone() });
            let more = kept.len().saturating_sub(KEPT);
            kept.drain(..more);
        }
        Ok(quadrature)
    }
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;

    use super::*;

    fn viewing(light: &str) -> Viewing {
        let illuminant = spectra::light_from_text(light).unwrap();
        Viewing { illuminant, ..Viewing::default() }
    }

    #[test]
    fn a_quadrature_is_fitted_once_and_forgotten_when_many_others_were_used() {
        let kept = KeptQuadratures(Mutex::new(Vec::new()));
        let oils = PigmentLibrary::van_gogh_oils();
        let mut tinted = oils.clone();
        tinted.pigments[0].absorption[3] *= 1.01;
        let model = EffectiveQuadrature::of(&viewing("D65"), &oils, NODES).unwrap();
        let fits = Cell::new(0);
        let ask = |library: &PigmentLibrary, light: &str| {
            let mut own = model.clone();
            own.rule.weights[0][0] = library.pigments[0].absorption[3] + light.len() as f64;
            assert_eq!(
                kept.get(library, &viewing(light), || {
                    fits.set(fits.get() + 1);
                    Ok(own.clone())
                })
                .as_ref(),
                Ok(&own),
                "{light}"
            );
            fits.get()
        };
        assert_eq!([ask(&oils, "D65"), ask(&oils, "D65")], [1, 1]);
        assert_eq!(ask(&tinted, "D65"), 2, "another library");
        assert_eq!(ask(&oils, "A"), 3, "another light");
        for light in ["D50", "FL1", "FL2", "FL3", "FL4", "FL5", "FL6"] {
            ask(&oils, light);
            // Used again and again, so it is kept.
            ask(&oils, "D65");
        }
        let before = fits.get();
        assert_eq!(ask(&oils, "D65"), before);
        assert_eq!(ask(&tinted, "D65"), before + 1, "forgotten");
    }

    #[test]
    fn what_cannot_be_fitted_is_tried_again() {
        let kept = KeptQuadratures(Mutex::new(Vec::new()));
        let oils = PigmentLibrary::van_gogh_oils();
        let viewing = viewing("D65");
        let fault = EffectiveQuadrature::of(&viewing, &oils, 0).unwrap_err();
        assert_eq!(kept.get(&oils, &viewing, || Err(fault)), Err(fault));
        let fitted = EffectiveQuadrature::of(&viewing, &oils, 3).unwrap();
        assert_eq!(kept.get(&oils, &viewing, || Ok(fitted.clone())), Ok(fitted));
    }
}
