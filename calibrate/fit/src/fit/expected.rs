//! Information on K and S that planned mixtures are expected to give.

use spectra::optics::Surface;

use super::color_term::ColorTerm;
use super::curves::{CurveTable, Layout, OFF_ZERO};
use super::forward::Data;
use super::noise::{ExpectedNoise, Noise};
use super::objective::RIDGE;
use super::problem::Problem;
use pigment::evaluate::Viewing;
use pigment::{Curves, PigmentId};

/// Assumed K and S of the paints.
#[derive(Debug, Clone)]
pub(crate) struct AssumedPaints {
    pub(crate) surface: Surface,
    /// Paint whose S is 1.
    pub(crate) reference: PigmentId,
    /// K and S by paint; at least one.
    pub(crate) curves: Vec<Curves>,
}

/// Derivatives of the reflectances of mixtures over the unknowns of a fit (log K of every paint and log S
/// of all except the reference), divided by the standard deviation of a reading.
#[derive(Debug, Clone)]
pub(crate) struct Slopes {
    layout: Layout,
    /// Places of each mixture's unknowns within a wavelength.
    pub(crate) places: Vec<Vec<usize>>,
    /// By mixture: for each wavelength in turn, one slope for each of its places.
    pub(crate) slopes: Vec<Vec<f64>>,
}

impl Slopes {
    /// Slopes of `recipes` as films that hide, under the noise model of the refinement. Recipes are lists
    /// of paints with their shares.
    pub(crate) fn of(
        paints: &AssumedPaints,
        recipes: Vec<Vec<(usize, f64)>>,
        noise: ExpectedNoise,
    ) -> Self {
        let curves = CurveTable::off_zero(&paints.curves, OFF_ZERO);
        let grid = paints.curves[0].grid;
        let mut problem = Problem {
            grid,
            surface: paints.surface,
            pigments: paints.curves.len(),
            reference: paints.reference,
            reading_sd: 0.0,
            recipes,
            ratio: Vec::new(),
            reflectance: Vec::new(),
        };
        problem.reflectance = problem.predicted(&curves);
        let weights = Viewing::default().weights(grid).expect("the method fits the grid");
        let term = ColorTerm::new(&weights, &problem.reflectance);
        let precision = Noise::new(&term, &problem.reflectance, 0.0).precision(noise);
        let data = Data::hiding(&problem);
        let mut slopes = data.linear(&curves).slopes;
        let places: Vec<Vec<usize>> =
            (0..problem.recipes.len()).map(|index| data.places(index).to_vec()).collect();
        for ((slopes, places), precision) in slopes.iter_mut().zip(&places).zip(&precision) {
            for (chunk, precision) in slopes.chunks_exact_mut(places.len()).zip(precision) {
                chunk.iter_mut().for_each(|slope| *slope *= precision);
            }
        }
        Self { layout: data.layout, places, slopes }
    }

    /// Number of unknowns per wavelength.
    pub(crate) fn unknowns(&self) -> usize {
        self.layout.per_wavelength()
    }

    pub(crate) fn wavelengths(&self) -> usize {
        self.layout.wavelengths
    }

    /// Place of log S of `paint` within a wavelength; `None` for the reference. The place of log K is the
    /// paint's own number.
    pub(crate) fn scattering(&self, paint: usize) -> Option<usize> {
        self.layout.scattering(paint)
    }

    /// Slopes of mixture `index` at wavelength `at`, one for each of its places.
    pub(crate) fn at(&self, index: usize, at: usize) -> &[f64] {
        let count = self.places[index].len();
        &self.slopes[index][at * count..(at + 1) * count]
    }
}

/// Information that a fit has on each log K and log S before any data: that of its prior.
pub(crate) const PRIOR_INFORMATION: f64 = RIDGE;
