//! What mixtures that nobody has made yet would tell of K and S.

use spectra::Grid;
use spectra::optics::Surface;

use super::color_term::ColorTerm;
use super::curves::{Curves, Layout};
use super::forward::Data;
use super::noise::Noise;
use super::objective::RIDGE;
use super::problem::Problem;
use pigment::evaluate::Viewing;

/// How far a swatch's reflectance is expected to be off, as standard
/// deviations in measured reflectance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ExpectedNoise {
    /// The same at every reflectance: the instrument's.
    pub constant: f64,
    /// Even to the eye, so less in the dark: weighing, mixing and the film.
    /// Told for a typical swatch.
    pub even: f64,
}

/// Paint as it is believed to be.
#[derive(Debug, Clone)]
pub(crate) struct Belief<'a> {
    pub(crate) grid: Grid,
    pub(crate) surface: Surface,
    /// The pigment whose S is 1.
    pub(crate) reference: usize,
    /// K by pigment and wavelength.
    pub(crate) absorption: Vec<&'a [f64]>,
    /// S by pigment and wavelength.
    pub(crate) scattering: Vec<&'a [f64]>,
}

/// The slopes of mixtures over the unknowns of a fit, log K of every pigment
/// and log S of all but the reference, in standard deviations of a reading.
#[derive(Debug, Clone)]
pub(crate) struct Slopes {
    layout: Layout,
    /// By mixture: the unknowns it depends on, as places in a wavelength.
    pub(crate) places: Vec<Vec<usize>>,
    /// By mixture: by wavelength, one slope for each of its places.
    pub(crate) slopes: Vec<Vec<f64>>,
}

impl Slopes {
    /// Those of `recipes`, films that hide, under the noise model of the
    /// refinement with its two parts as `noise` has them.
    pub(crate) fn of(
        belief: &Belief<'_>,
        recipes: &[Vec<(usize, f64)>],
        noise: ExpectedNoise,
    ) -> Self {
        // At 0 a logarithm has no slope.
        let off_zero = |curves: &[&[f64]], least: f64| -> Vec<Vec<f64>> {
            curves.iter().map(|curve| curve.iter().map(|v| v.max(least)).collect()).collect()
        };
        let curves = Curves {
            absorption: off_zero(&belief.absorption, 1e-4),
            scattering: off_zero(&belief.scattering, 1e-3),
        };
        let mut problem = Problem {
            grid: belief.grid,
            surface: belief.surface,
            pigments: belief.absorption.len(),
            reference: belief.reference,
            reading_sd: 0.0,
            recipes: recipes.to_vec(),
            ratio: Vec::new(),
            reflectance: Vec::new(),
        };
        problem.reflectance = problem.predicted(&curves);
        let weights = Viewing::default().weights(belief.grid).expect("the method fits the grid");
        let term = ColorTerm::new(&weights, &problem.reflectance);
        let precision = Noise::new(&term, &problem.reflectance, 0.0).precision(noise);
        let data = Data::hiding(&problem);
        let mut slopes = data.linear(&curves).slopes;
        let places: Vec<Vec<usize>> =
            (0..recipes.len()).map(|index| data.places(index).to_vec()).collect();
        for ((slopes, places), precision) in slopes.iter_mut().zip(&places).zip(&precision) {
            for (chunk, precision) in slopes.chunks_exact_mut(places.len()).zip(precision) {
                chunk.iter_mut().for_each(|slope| *slope *= precision);
            }
        }
        Self { layout: data.layout, places, slopes }
    }

    /// Unknowns a wavelength.
    pub(crate) fn unknowns(&self) -> usize {
        self.layout.per_wavelength()
    }

    pub(crate) fn wavelengths(&self) -> usize {
        self.layout.wavelengths
    }

    /// Where log S of `pigment` stands; `None` for the reference. Log K stands
    /// at its own number.
    pub(crate) fn scattering(&self, pigment: usize) -> Option<usize> {
        self.layout.scattering(pigment)
    }

    /// The slopes of mixture `index` at wavelength `at`, by its places.
    pub(crate) fn at(&self, index: usize, at: usize) -> &[f64] {
        let count = self.places[index].len();
        &self.slopes[index][at * count..(at + 1) * count]
    }
}

/// What a fit knows of each log K and log S before any data.
pub(crate) const PRIOR_INFORMATION: f64 = RIDGE;
