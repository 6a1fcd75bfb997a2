//! Light for painting: we represent a light's spectrum by eight wavelengths, convert them to sRGB,
//! and mix two paints in any ratio fast.
//!
//! We keep the quadratures that we fitted, because a program asks for the same few lights again and
//! again.

use std::sync::{Mutex, PoisonError};

use documents::{Task, hint::Explain};
use graphics::lanes::{greater, lesser, multiply_add};
use pigment::library::{PigmentLibrary, RecipeError};
use pigment::quadrature::{EffectiveQuadrature, Quadrature, QuadratureFailure};
use pigment::thin_films::least_films;
use pigment::{PigmentId, evaluate::Viewing};
use pulp::Simd;
use spectra::color::{Adaptation, RgbSpace};
use spectra::{LightError, Observer, ObserverError, light_from_text};

use crate::optics::{NODES, SceneSurface, scaled, scene_surface};

/// Number of quadratures that we keep: those used most recently. For example, a split view needs
/// two, and a painter compares a few.
const KEPT: usize = 8;

static QUADRATURES: KeptQuadratures = KeptQuadratures(Mutex::new(Vec::new()));

/// The quadrature of a light for a library. A first call fits it, which takes about a second.
fn quadrature(
    library: &PigmentLibrary,
    viewing: &Viewing,
) -> Result<EffectiveQuadrature, QuadratureFailure> {
    QUADRATURES.get(library, viewing, || {
        EffectiveQuadrature::of(viewing, library, NODES, &Task::default())
    })
}

/// A quadrature and all that it depends on.
#[derive(Debug)]
struct Kept {
    library: PigmentLibrary,
    viewing: Viewing,
    quadrature: EffectiveQuadrature,
}

/// Quadratures in order of use: you find the one used last at the end.
#[derive(Debug)]
struct KeptQuadratures(Mutex<Vec<Kept>>);

impl KeptQuadratures {
    fn get(
        &self,
        library: &PigmentLibrary,
        viewing: &Viewing,
        fit: impl FnOnce() -> Result<EffectiveQuadrature, QuadratureFailure>,
    ) -> Result<EffectiveQuadrature, QuadratureFailure> {
        let place = |kept: &[Kept]| {
            kept.iter().position(|one| one.viewing == *viewing && one.library == *library)
        };
        let mut kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(place) = place(&kept) {
            let used = kept.remove(place);
            let quadrature = used.quadrature.clone();
            kept.push(used);
            return Ok(quadrature);
        }
        // We fit without the lock: a thread that waits in the fit may take up work that needs this
        // lock.
        drop(kept);
        let quadrature = fit()?;
        let mut kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
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

/// An illuminant with an observer, prepared for painting with one library.
#[derive(Debug, Clone, PartialEq)]
pub struct Light {
    /// Illuminant and observer.
    pub viewing: Viewing,
    /// Wavelengths, their weights in XYZ, and K and S of every pigment, fitted to films of the
    /// library ([`EffectiveQuadrature::of`]). Their white equals the white of the full spectrum.
    pub quadrature: EffectiveQuadrature,
    /// Linear sRGB of reflectance 1 at each wavelength, adapted from the light's white to D65
    /// by Bradford's transform. They sum to (1, 1, 1) up to rounding.
    pub rgb_from_nodes: [[f32; 3]; NODES],
    /// Thickness at which a film of each pigment covers its cell, see [`least_films`]. It is the same under every light.
    pub least_films: Vec<f64>,
}

impl Light {
    /// Prepares the light of `viewing` for painting with `library`. This takes up to a second,
    /// unless your program prepared this light before and used few others since.
    ///
    /// # Errors
    /// [`PaintLightError::Quadrature`] if the light has fewer than eight usable wavelengths.
    pub fn new(library: &PigmentLibrary, viewing: &Viewing) -> Result<Self, PaintLightError> {
        let quadrature = quadrature(library, viewing)?;
        let rgb_from_nodes = rgb_from_nodes(&quadrature.rule, 1.0).map(|rgb| rgb.map(|v| v as f32));
        let least_films = least_films(library);
        Ok(Self { viewing: viewing.clone(), quadrature, rgb_from_nodes, least_films })
    }

    /// Linear sRGB of reflectance 1 at each wavelength, for an eye that adapted to the light by
    /// `degree`. At 0 you see the light's own colour beside D65. At 1 every light's white is white,
    /// as in `rgb_from_nodes`.
    ///
    /// Below 1 we lower the exposure until white stays within sRGB: the greatest channel of the
    /// perfect diffuser is 1.
    #[must_use]
    pub fn rgb_at_degree(&self, degree: f64) -> [[f32; 3]; NODES] {
        if degree >= 1.0 {
            return self.rgb_from_nodes;
        }
        let rgb = rgb_from_nodes(&self.quadrature.rule, degree);
        let greatest = (0..3)
            .map(|channel: usize| rgb.iter().map(|rgb| rgb[channel]).sum::<f64>())
            .fold(f64::MIN_POSITIVE, f64::max);
        rgb.map(|rgb| rgb.map(|value| (value / greatest) as f32))
    }

    /// Prepares a light by names: `illuminant` as [`light_from_text`] reads it, `observer` as
    /// [`Observer::named`] does.
    ///
    /// # Errors
    /// [`PaintLightError`] for an unknown name, or a light with fewer than eight usable
    /// wavelengths.
    pub fn named(
        library: &PigmentLibrary,
        illuminant: &str,
        observer: &str,
    ) -> Result<Self, PaintLightError> {
        let illuminant = light_from_text(illuminant)?;
        Self::new(library, &Viewing { illuminant, observer: Observer::named(observer)? })
    }
}

/// Linear sRGB of reflectance 1 at each wavelength, adapted to D65 by `degree`.
fn rgb_from_nodes(quadrature: &Quadrature, degree: f64) -> [[f64; 3]; NODES] {
    let space = RgbSpace::Srgb;
    let white = quadrature.white;
    let adapted = Adaptation::Bradford.partial_matrix(white, space.white(), degree);
    let from_xyz = space.xyz_from_linear().inverse();
    std::array::from_fn(|i| from_xyz.apply(adapted.apply(quadrature.weights[i])))
}

/// A light cannot be used for painting.
#[derive(Debug, Clone, PartialEq, thiserror::Error, Explain)]
pub enum PaintLightError {
    /// The name of the illuminant is unknown, or its file is invalid.
    #[error(transparent)]
    #[fault(Setting)]
    Light(#[from] LightError),
    /// The name of the observer is unknown.
    #[error(transparent)]
    #[fault(Setting)]
    Observer(#[from] ObserverError),
    /// The light has too few usable wavelengths, for example a laser.
    #[error(transparent)]
    #[hint("painting needs a light that the observer sees at {NODES} wavelengths or more")]
    #[fault(Setting)]
    Quadrature(#[from] QuadratureFailure),
}

/// Two paints of a library under one light. K and S at the light's wavelengths are
/// precomputed, so that a mixture costs eight square roots and eight divisions.
#[derive(Debug, Clone, PartialEq)]
pub struct Mixer {
    /// K of the first paint, then K of the second minus K of the first.
    absorption: [[f32; NODES]; 2],
    /// S of the first paint, then S of the second minus S of the first.
    scattering: [[f32; NODES]; 2],
    surface: SceneSurface,
    rgb_from_nodes: [[f32; 3]; NODES],
}

/// Mixtures computed together in SIMD lanes.
const BLOCK: usize = 16;

impl Mixer {
    /// Makes a mixer of two recipes, given as pigments of `library` with their parts.
    ///
    /// # Errors
    /// [`RecipeError`] if [`PigmentLibrary::mix`] rejects a recipe.
    pub fn new(
        library: &PigmentLibrary,
        light: &Light,
        first: &[(PigmentId, f64)],
        second: &[(PigmentId, f64)],
    ) -> Result<Self, RecipeError> {
        let first = library.parts(first)?;
        let second = library.parts(second)?;
        let first = light.quadrature.mixed(&first);
        let second = light.quadrature.mixed(&second);
        let [absorption, scattering] = [0, 1].map(|part| {
            let pairs = second[part].iter().zip(&first[part]);
            let more: Vec<f64> = pairs.map(|(b, a)| b - a).collect();
            [scaled(&first[part], 1.0), scaled(&more, 1.0)]
        });
        Ok(Self {
            absorption,
            scattering,
            surface: scene_surface(&library.saunderson),
            rgb_from_nodes: light.rgb_from_nodes,
        })
    }

    /// Linear sRGB of an opaque mixture. `share` in 0..=1 is the part of the second paint.
    #[must_use]
    pub fn mix(&self, share: f32) -> [f32; 3] {
        let mut out = [[0.0; 3]];
        self.mix_into(&[share], &mut out);
        out[0]
    }

    /// Computes the mixture for each of `shares` into `out`, like [`Mixer::mix`].
    ///
    /// # Panics
    /// If `shares` and `out` differ in length.
    pub fn mix_into(&self, shares: &[f32], out: &mut [[f32; 3]]) {
        assert_eq!(shares.len(), out.len(), "one colour for each share");
        graphics::lanes::vectorized(MixInto { mixer: self, shares, out });
    }

    /// Linear sRGB of a block of mixtures, one array per channel.
    #[inline(always)]
    fn block<S: Simd>(&self, shares: &[f32; BLOCK]) -> [[f32; BLOCK]; 3] {
        let SceneSurface { k1, k2, specular } = self.surface;
        let through = (1.0 - k1) * (1.0 - k2);
        let mut rgb = [[0.0; BLOCK]; 3];
        for node in 0..NODES {
            let [k_first, k_more] = [self.absorption[0][node], self.absorption[1][node]];
            let [s_first, s_more] = [self.scattering[0][node], self.scattering[1][node]];
            let mut measured = [0.0; BLOCK];
            for (measured, &share) in measured.iter_mut().zip(shares) {
                let k = greater(multiply_add::<S>(share, k_more, k_first), 0.0);
                let s = greater(multiply_add::<S>(share, s_more, s_first), 0.0);
                // Opaque film R = S / den and Saunderson's correction with one division.
                let den = (k + s) + (k * multiply_add::<S>(2.0, s, k)).sqrt();
                let den = greater(multiply_add::<S>(-k2, s, den), f32::MIN_POSITIVE);
                *measured = specular + through * s / den;
            }
            for (channel, weight) in rgb.iter_mut().zip(self.rgb_from_nodes[node]) {
                for (sum, &measured) in channel.iter_mut().zip(&measured) {
                    *sum = multiply_add::<S>(measured, weight, *sum);
                }
            }
        }
        rgb
    }
}

struct MixInto<'a> {
    mixer: &'a Mixer,
    shares: &'a [f32],
    out: &'a mut [[f32; 3]],
}

impl pulp::WithSimd for MixInto<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        for (shares, out) in self.shares.chunks(BLOCK).zip(self.out.chunks_mut(BLOCK)) {
            let mut block = [0.0; BLOCK];
            for (block, &share) in block.iter_mut().zip(shares) {
                *block = lesser(greater(share, 0.0), 1.0);
            }
            let [red, green, blue] = self.mixer.block::<S>(&block);
            for (i, out) in out.iter_mut().enumerate() {
                *out = [red[i], green[i], blue[i]];
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::cell::Cell;

    fn viewing(light: &str) -> Viewing {
        let illuminant = light_from_text(light).unwrap();
        Viewing { illuminant, ..Viewing::default() }
    }

    #[test]
    fn a_quadrature_is_fitted_once_and_forgotten_when_many_others_were_used() {
        let kept = KeptQuadratures(Mutex::new(Vec::new()));
        let oils = PigmentLibrary::van_gogh_oils();
        let mut tinted = oils.clone();
        tinted.pigments[0].absorption[3] *= 1.01;
        let model =
            EffectiveQuadrature::of(&viewing("D65"), &oils, NODES, &Task::default()).unwrap();
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
            // The light is in use again and again, so the list keeps it.
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
        let fault = EffectiveQuadrature::of(&viewing, &oils, 0, &Task::default()).unwrap_err();
        assert_eq!(kept.get(&oils, &viewing, || Err(fault)), Err(fault));
        let fitted = EffectiveQuadrature::of(&viewing, &oils, 3, &Task::default()).unwrap();
        assert_eq!(kept.get(&oils, &viewing, || Ok(fitted.clone())), Ok(fitted));
    }
}
