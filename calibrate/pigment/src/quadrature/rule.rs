//! Nodes, three weights each, and what they cost in colour.

use serde::Serialize;
use spectra::color::{Lab, Xyz, delta_e_ciede2000};
use spectra::{Grid, TristimulusWeights};

use super::fitted::fitted;
use super::gauss::GaussRule;
use super::mixtures::MixtureSet;
use crate::evaluate::{Viewing, percentile};
use crate::library::PigmentLibrary;

/// A few wavelengths with the weights that turn reflectances there into XYZ.
#[derive(Debug, Clone, PartialEq)]
pub struct Quadrature {
    /// The wavelengths in nm, rising.
    pub nodes_nm: Vec<f64>,
    /// Weights of X, Y and Z at each; each channel sums to the white's.
    pub weights: Vec<[f64; 3]>,
    /// The white of light and observer, Y = 100.
    pub white: Xyz,
}

/// CIEDE2000 of a quadrature against full integration.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct QuadratureError {
    /// Mean.
    pub mean: f64,
    /// 95th percentile.
    pub p95: f64,
    /// Largest.
    pub max: f64,
}

/// The seed of the mixtures a library quadrature is fitted to.
pub(super) const FITTING_SEED: u64 = 2004;

impl Quadrature {
    /// The paper's rule of `count` nodes: Gaussian nodes of the nonnegative
    /// weight (x + y + z) E at 1 nm; at each node its weight is shared among
    /// the channels as x, y and z are there (Baxter, Wendt and Lin 2004, 5.3).
    ///
    /// # Errors
    /// [`QuadratureFailure::Count`] for 0 nodes, or more than 32.
    pub fn gauss(viewing: &Viewing, count: usize) -> Result<Self, QuadratureFailure> {
        let light = Light::of(viewing);
        let rule = light.rule(count)?;
        let weights = rule
            .nodes
            .iter()
            .zip(&rule.weights)
            .map(|(&nm, weight)| {
                let channels = light.at(nm);
                let sum: f64 = channels.iter().sum();
                channels.map(|c| weight * c / sum)
            })
            .collect();
        Ok(Self { nodes_nm: rule.nodes, weights, white: light.white })
    }

    /// The same nodes, with weights exact for polynomials of degree n - 1 in
    /// each channel.
    ///
    /// # Errors
    /// As [`Quadrature::gauss`].
    pub fn moments(viewing: &Viewing, count: usize) -> Result<Self, QuadratureFailure> {
        let light = Light::of(viewing);
        let rule = light.rule(count)?;
        let [x, y, z] = [0, 1, 2].map(|channel: usize| {
            let weight: Vec<f64> = light.channels.iter().map(|c| c[channel]).collect();
            rule.weights_from_moments(&weight)
        });
        let weights = (0..count).map(|i| [x[i], y[i], z[i]]).collect();
        Ok(Self { nodes_nm: rule.nodes, weights, white: light.white })
    }

    /// Nodes and weights fitted so that everything `library` can mix keeps its
    /// colour: least squares in CIEDE2000 over its masstones and seeded random
    /// mixtures, from several starts.
    ///
    /// # Errors
    /// As [`Quadrature::gauss`].
    pub fn library(
        viewing: &Viewing,
        library: &PigmentLibrary,
        count: usize,
    ) -> Result<Self, QuadratureFailure> {
        let start = Self::moments(viewing, count)?;
        let weights = viewing.weights(library.grid).expect("the method fits the grid");
        let training = MixtureSet::masstones(library, &weights).joined(MixtureSet::for_fitting(
            library,
            &weights,
            700,
            FITTING_SEED,
        ));
        Ok(fitted(&start, &training))
    }

    /// XYZ of a reflectance given at the nodes.
    ///
    /// # Panics
    /// If there is not one value for each node.
    #[must_use]
    pub fn xyz(&self, reflectance: &[f64]) -> Xyz {
        assert_eq!(reflectance.len(), self.weights.len(), "one reflectance for each node");
        let mut xyz = [0.0; 3];
        for (value, weights) in reflectance.iter().zip(&self.weights) {
            for (sum, weight) in xyz.iter_mut().zip(weights) {
                *sum += value * weight;
            }
        }
        xyz.into()
    }

    /// K or S of a spectrum on `grid` at the nodes, by straight lines; end
    /// values held.
    #[must_use]
    pub fn at_nodes(&self, grid: Grid, values: &[f64]) -> Vec<f64> {
        self.nodes_nm.iter().map(|&nm| on_line(grid, values, nm).0).collect()
    }

    /// CIEDE2000 against full integration over `mixtures`.
    #[must_use]
    pub fn error(&self, mixtures: &MixtureSet) -> QuadratureError {
        let errors: Vec<f64> = mixtures
            .mixtures
            .iter()
            .zip(&mixtures.xyz)
            .map(|(mixture, &exact)| {
                let at_nodes = crate::mixture::Mixture {
                    absorption: self.at_nodes(mixtures.grid, &mixture.absorption),
                    scattering: self.at_nodes(mixtures.grid, &mixture.scattering),
                };
                let found = self.xyz(&at_nodes.hiding(mixtures.surface));
                delta_e_ciede2000(
                    Lab::from_xyz(found, self.white),
                    Lab::from_xyz(exact, mixtures.white),
                )
            })
            .collect();
        QuadratureError {
            mean: errors.iter().sum::<f64>() / errors.len().max(1) as f64,
            p95: percentile(&errors, 95.0),
            max: percentile(&errors, 100.0),
        }
    }
}

/// The value and the slope at `nm` of the line through values on a grid; end
/// values held.
pub(super) fn on_line(grid: Grid, values: &[f64], nm: f64) -> (f64, f64) {
    let last = values.len() - 1;
    let position = (nm - grid.start_nm()) / grid.step_nm();
    if last == 0 || position <= 0.0 {
        return (values[0], 0.0);
    }
    if position >= last as f64 {
        return (values[last], 0.0);
    }
    let index = position as usize;
    let rise = values[index + 1] - values[index];
    (values[index] + rise * (position - index as f64), rise / grid.step_nm())
}

/// The light as the observer sees it, at 1 nm.
struct Light {
    nm: Vec<f64>,
    channels: Vec<[f64; 3]>,
    white: Xyz,
}

impl Light {
    fn of(viewing: &Viewing) -> Self {
        // On the CIE's own grid nothing is interpolated.
        let weights = TristimulusWeights::new(
            Grid::cie(),
            &viewing.illuminant,
            viewing.observer,
            spectra::Interpolation::Linear,
        )
        .expect("linear interpolation fits any grid");
        Self {
            nm: Grid::cie().wavelengths_nm().collect(),
            channels: weights.weights().to_vec(),
            white: weights.white(),
        }
    }

    fn rule(&self, count: usize) -> Result<GaussRule, QuadratureFailure> {
        let weight: Vec<f64> = self.channels.iter().map(|c| c.iter().sum()).collect();
        (count <= 32)
            .then(|| GaussRule::new(&self.nm, &weight, count))
            .flatten()
            .ok_or(QuadratureFailure::Count { count })
    }

    fn at(&self, nm: f64) -> [f64; 3] {
        std::array::from_fn(|channel| {
            let values: Vec<f64> = self.channels.iter().map(|c| c[channel]).collect();
            on_line(Grid::cie(), &values, nm).0
        })
    }
}

/// Why there is no such quadrature.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum QuadratureFailure {
    /// Too few or too many nodes.
    #[error("a quadrature has 1 to 32 wavelengths, found `{count}`")]
    Count {
        /// What was asked for.
        count: usize,
    },
}
