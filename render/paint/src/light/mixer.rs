//! Fast mixing of two paints in any ratio.

use pigment::PigmentId;
use pigment::library::{PigmentLibrary, RecipeError};
use pulp::Simd;

use super::node_light::Light;
use crate::node_pigments::{scaled, scene_surface};
use crate::optics::{NODES, SceneSurface};
use graphics::lanes::{greater, lesser, multiply_add};

/// Two paints of a library under one light. K and S at the light's wavelengths are
/// precomputed, so that a mixture costs eight square roots and eight divisions.
#[derive(Debug, Clone, PartialEq)]
pub struct Mixer {
    /// K of the first paint, then K of the second minus that of the first.
    absorption: [[f32; NODES]; 2],
    /// S of the first paint, then S of the second minus that of the first.
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
        let [k_first, s_first] = light.quadrature.mixed(&first);
        let [k_second, s_second] = light.quadrature.mixed(&second);
        let pair = |first: &[f64], second: &[f64]| {
            let more: Vec<f64> = second.iter().zip(first).map(|(b, a)| b - a).collect();
            [scaled(first, 1.0), scaled(&more, 1.0)]
        };
        Ok(Self {
            absorption: pair(&k_first, &k_second),
            scattering: pair(&s_first, &s_second),
            surface: scene_surface(&library.saunderson),
            rgb_from_nodes: light.rgb_from_nodes,
        })
    }

    /// Linear sRGB of an opaque mixture; `share` in 0..=1 is the part of the second paint.
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
