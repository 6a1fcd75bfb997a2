//! Wavelengths with their weights for X, Y and Z, and their colour error.

use documents::Cancelled;
use documents::hint::{Explain, Fault, Hint};
use serde::Serialize;
use spectra::color::{Lab, Xyz, delta_e_ciede2000};
use spectra::{Grid, TristimulusWeights};

use super::gauss::GaussRule;
use super::mixtures::MixtureSet;
use crate::curves::hiding_film;
use crate::evaluate::{Viewing, percentile};

/// A few wavelengths with the weights that turn reflectances at them into XYZ.
#[derive(Debug, Clone, PartialEq)]
pub struct Quadrature {
    /// Wavelengths in nm, in rising order.
    pub nodes_nm: Vec<f64>,
    /// Weights of X, Y and Z at each wavelength; each channel sums to that of the white.
    pub weights: Vec<[f64; 3]>,
    /// White of the light for the observer, Y = 100.
    pub white: Xyz,
}

/// Colour error of a quadrature against full integration, in CIEDE2000.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct QuadratureError {
    /// Mean of the errors.
    pub mean: f64,
    /// 95th percentile of the errors.
    pub p95: f64,
    /// Largest of the errors.
    pub max: f64,
}

/// Limits of fitted nodes in nm: the band of the CIE's observers.
pub(super) const NODE_BAND_NM: [f64; 2] = [360.0, 830.0];

/// Most nodes of a quadrature, about as many as a library has wavelengths. Chosen by eye.
const MAX_NODES: usize = 32;

impl Quadrature {
    /// Computes the published rule of `count` nodes: Gaussian nodes of the nonnegative weight
    /// (x + y + z) E at 1 nm. The weight of each node is divided among the channels in the ratio of
    /// x, y and z there (Baxter, Wendt and Lin 2004, section 5.3).
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

    /// Computes the nodes of [`Quadrature::gauss`] with weights that are exact for polynomials of
    /// degree n - 1 in each channel.
    ///
    /// # Errors
    /// [`QuadratureFailure::Count`] for 0 nodes, or more than 32.
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

    /// XYZ of a reflectance given at each node.
    ///
    /// # Panics
    /// If the number of values is not the number of nodes.
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

    /// Interpolates values on `grid`, such as K or S, linearly at the nodes; end values are held
    /// beyond the grid.
    #[must_use]
    pub fn at_nodes(&self, grid: Grid, values: &[f64]) -> Vec<f64> {
        self.nodes_nm.iter().map(|&nm| on_line(grid, values, nm).0).collect()
    }

    /// Colour error against full integration over `mixtures`.
    #[must_use]
    pub fn error(&self, mixtures: &MixtureSet) -> QuadratureError {
        let errors: Vec<f64> = mixtures
            .mixtures
            .iter()
            .zip(&mixtures.xyz)
            .map(|(mixture, &exact)| {
                let absorption = self.at_nodes(mixtures.grid, &mixture.absorption);
                let scattering = self.at_nodes(mixtures.grid, &mixture.scattering);
                let found = self.xyz(&hiding_film(&absorption, &scattering, mixtures.surface));
                delta_e_ciede2000(
                    Lab::from_xyz(found, self.white),
                    Lab::from_xyz(exact, mixtures.white),
                )
            })
            .collect();
        QuadratureError::of(&errors)
    }
}

impl QuadratureError {
    /// Summary of the errors of several colours.
    pub(super) fn of(errors: &[f64]) -> Self {
        Self {
            mean: errors.iter().sum::<f64>() / errors.len().max(1) as f64,
            p95: percentile(errors, 95.0),
            max: percentile(errors, 100.0),
        }
    }
}

/// Value and slope at `nm` of the piecewise linear curve through values on a grid; end values are held
/// beyond the grid.
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

/// Tristimulus weights of a light at 1 nm.
struct Light {
    nm: Vec<f64>,
    channels: Vec<[f64; 3]>,
    white: Xyz,
}

impl Light {
    fn of(viewing: &Viewing) -> Self {
        // On the grid of the CIE tables nothing is interpolated.
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
        (count <= MAX_NODES)
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

/// A quadrature that cannot be computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum QuadratureFailure {
    /// The number of nodes is 0 or above 32.
    #[error("a quadrature has 1 to 32 wavelengths, found `{count}`")]
    Count {
        /// Number of nodes that was requested.
        count: usize,
    },
    /// The fit was asked to end before its time.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl Explain for QuadratureFailure {
    fn hint(&self) -> Option<Hint> {
        match self {
            Self::Count { .. } => {
                Some(Hint::new("eight wavelengths are enough for most paints: [nodes=8]"))
            }
            Self::Cancelled(error) => error.hint(),
        }
    }

    fn fault(&self) -> Fault {
        match self {
            Self::Count { .. } => Fault::Setting,
            Self::Cancelled(error) => error.fault(),
        }
    }
}
