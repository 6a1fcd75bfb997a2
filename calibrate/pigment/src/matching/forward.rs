//! From shares of pigments to colour differences, with their derivatives.

use spectra::color::{Lab, Xyz, ciede2000_residuals};
use spectra::optics::UnevenFilm;
use spectra::{InterpolateError, TristimulusWeights};

use super::limits::{FilmKind, RecipeLimits};
use super::target::{Metric, SpectralTarget, Target};
use crate::least_squares::{Cost, UNKNOWNS};
use crate::library::PigmentLibrary;
use crate::recipe::PigmentId;

/// A library, a film and viewing conditions, prepared for many recipes.
pub(super) struct Forward<'a> {
    pub(super) library: &'a PigmentLibrary,
    film: UnevenFilm,
    metric: Metric,
    /// Internal reflectance of the ground. `None` for a film that hides.
    ground: Option<Vec<f64>>,
    pub(super) weights: Vec<TristimulusWeights>,
    /// Square root of each condition's weight divided by the sum of weights.
    roots: Vec<f64>,
}

/// Buffers that one evaluation reuses.
#[derive(Debug, Clone, Default)]
pub(super) struct Scratch {
    reflectance: Vec<f64>,
    over_absorption: Vec<f64>,
    over_scattering: Vec<f64>,
    by_unknown: Vec<f64>,
}

/// Derivatives of one residual of a target with respect to K and S of a mixture at each wavelength.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Slopes {
    pub(super) over_absorption: Vec<f64>,
    pub(super) over_scattering: Vec<f64>,
}

impl<'a> Forward<'a> {
    pub(super) fn new(
        library: &'a PigmentLibrary,
        limits: &RecipeLimits,
    ) -> Result<Self, InterpolateError> {
        let conditions = &limits.conditions;
        let ground = match &limits.film {
            FilmKind::Hiding => None,
            FilmKind::Over { ground, .. } => {
                let surface = library.saunderson;

                Some(
                    ground
                        .iter()
                        .map(|bare| surface.internal_from_measured(*bare).unwrap_or(0.0).min(1.0))
                        .collect(),
                )
            }
        };
        let total: f64 = conditions.iter().map(|condition| condition.weight).sum();
        Ok(Self {
            library,
            film: library.film(),
            metric: limits.metric,
            ground,
            weights: conditions
                .iter()
                .map(|condition| condition.viewing.weights(library.grid))
                .collect::<Result<_, _>>()?,
            roots: conditions.iter().map(|condition| (condition.weight / total).sqrt()).collect(),
        })
    }

    /// Computes the measured reflectance of `shares` of `pigments` at a thickness. You find it in
    /// `scratch`, with its derivatives with respect to K d and S d (K and S for a film that hides).
    fn reflect(
        &self,
        pigments: &[PigmentId],
        shares: &[f64],
        thickness: f64,
        scratch: &mut Scratch,
    ) {
        let count = self.library.grid.count();
        let Scratch { reflectance, over_absorption, over_scattering, .. } = scratch;
        for plane in [&mut *reflectance, &mut *over_absorption, &mut *over_scattering] {
            plane.clear();
            plane.resize(count, 0.0);
        }
        for (&pigment, &share) in pigments.iter().zip(shares) {
            let pigment = &self.library[pigment];
            let amount = share * thickness;
            for (sum, k) in over_absorption.iter_mut().zip(&pigment.absorption) {
                *sum += amount * k;
            }
            for (sum, s) in over_scattering.iter_mut().zip(&pigment.scattering) {
                *sum += amount * s;
            }
        }
        let surface = self.film.surface;
        for at in 0..count {
            let k = over_absorption[at];
            let s = over_scattering[at];
            let [value, by_k, by_s] = match &self.ground {
                Some(ground) => self.film.reflectance_with_slopes(k, s, ground[at]),
                None => {
                    let [internal, by_k, by_s] = infinite_film_with_slopes(k, s);
                    let slope = surface.measured_slope(internal);
                    [surface.measured_from_internal(internal), slope * by_k, slope * by_s]
                }
            };
            (reflectance[at], over_absorption[at], over_scattering[at]) = (value, by_k, by_s);
        }
    }

    pub(super) fn reflectance(
        &self,
        pigments: &[PigmentId],
        shares: &[f64],
        thickness: f64,
        scratch: &mut Scratch,
    ) -> Vec<f64> {
        self.reflect(pigments, shares, thickness, scratch);
        scratch.reflectance.clone()
    }

    /// Weighted root mean square of the colour differences over all viewing conditions, or of the
    /// differences of reflectance.
    pub(super) fn distance(
        &self,
        target: &Target,
        pigments: &[PigmentId],
        shares: &[f64],
        thickness: f64,
        scratch: &mut Scratch,
    ) -> f64 {
        self.reflect(pigments, shares, thickness, scratch);
        if self.metric.spectrum_weights().is_some() {
            return spectrum_of(target).rms_percent(&scratch.reflectance);
        }
        let lights = self.weights.iter().zip(&self.roots).zip(&target.lab);
        let squares = lights.map(|((weights, root), &wanted)| {
            let lab = Lab::from_xyz(weights.xyz(&scratch.reflectance), weights.white());
            let residuals = residuals(self.metric, wanted, lab);
            residuals.iter().map(|r| (root * r).powi(2)).sum::<f64>()
        });
        squares.sum::<f64>().sqrt()
    }

    /// Cost at `unknowns`. Pass a share for each of `pigments`, followed by the logarithm of the thickness
    /// if `chooses_thickness`.
    pub(super) fn cost(
        &self,
        target: &Target,
        pigments: &[PigmentId],
        unknowns: &[f64],
        thickness: f64,
        chooses_thickness: bool,
        scratch: &mut Scratch,
    ) -> Cost {
        let shares = &unknowns[..pigments.len()];
        self.reflect(pigments, shares, thickness, scratch);
        let count = self.library.grid.count();
        let columns = pigments.len() + usize::from(chooses_thickness);
        let Scratch { reflectance, over_absorption, over_scattering, by_unknown } = scratch;
        by_unknown.clear();
        by_unknown.resize(columns * count, 0.0);
        for (column, &pigment) in by_unknown.chunks_exact_mut(count).zip(pigments) {
            let pigment = &self.library[pigment];
            for (at, value) in column.iter_mut().enumerate() {
                *value = thickness
                    * (over_absorption[at] * pigment.absorption[at]
                        + over_scattering[at] * pigment.scattering[at]);
            }
        }
        if chooses_thickness {
            // The slope over log t is the sum of shares times their own slopes.
            let (by_share, by_thickness) = by_unknown.split_at_mut(pigments.len() * count);
            for (column, share) in by_share.chunks_exact(count).zip(shares) {
                for (sum, value) in by_thickness.iter_mut().zip(column) {
                    *sum += share * value;
                }
            }
        }
        if self.metric.spectrum_weights().is_some() {
            return spectrum_of(target).cost(reflectance, by_unknown);
        }
        let mut cost =
            Cost { value: 0.0, gradient: [0.0; UNKNOWNS], matrix: [[0.0; UNKNOWNS]; UNKNOWNS] };
        for ((weights, root), &wanted) in self.weights.iter().zip(&self.roots).zip(&target.lab) {
            let xyz = weights.xyz(reflectance);
            let (residuals, over_xyz) =
                residuals_with_slopes(self.metric, wanted, xyz, weights.white());
            let mut slopes = [[0.0; UNKNOWNS]; 3];
            for (unknown, column) in by_unknown.chunks_exact(count).enumerate() {
                let moved = weights.xyz(column).to_array();
                for (row, over) in slopes.iter_mut().zip(&over_xyz) {
                    row[unknown] = root * (0..3).map(|c| over[c] * moved[c]).sum::<f64>();
                }
            }
            for (residual, row) in residuals.iter().zip(&slopes) {
                let residual = root * residual;
                cost.value += 0.5 * residual * residual;
                for i in 0..columns {
                    cost.gradient[i] += residual * row[i];
                    for j in 0..columns {
                        cost.matrix[i][j] += row[i] * row[j];
                    }
                }
            }
        }
        cost
    }
}

impl Forward<'_> {
    /// Derivatives of all residuals of a mixture that hides. Their sum of squares is the square of
    /// [`Self::distance`].
    pub(super) fn slopes(
        &self,
        target: &Target,
        pigments: &[PigmentId],
        shares: &[f64],
        scratch: &mut Scratch,
    ) -> Vec<Slopes> {
        self.reflect(pigments, shares, 1.0, scratch);
        let Scratch { reflectance, over_absorption, over_scattering, .. } = scratch;
        let row = |of_reflectance: &dyn Fn(usize) -> f64| {
            let along = |over: &[f64]| {
                over.iter().enumerate().map(|(at, slope)| of_reflectance(at) * slope).collect()
            };
            Slopes {
                over_absorption: along(over_absorption),
                over_scattering: along(over_scattering),
            }
        };
        if self.metric.spectrum_weights().is_some() {
            let roots = spectrum_of(target).roots_percent();
            let each = roots.iter().enumerate().filter(|(_, root)| **root > 0.0);
            return each
                .map(|(node, root)| row(&|at| if at == node { *root } else { 0.0 }))
                .collect();
        }
        let mut rows = Vec::new();
        for ((weights, root), &wanted) in self.weights.iter().zip(&self.roots).zip(&target.lab) {
            let xyz = weights.xyz(reflectance);
            let (_, over_xyz) = residuals_with_slopes(self.metric, wanted, xyz, weights.white());
            rows.extend(over_xyz.iter().map(|over| {
                row(&|at| root * (0..3).map(|c| over[c] * weights.weights()[at][c]).sum::<f64>())
            }));
        }
        rows
    }
}

/// The spectrum of a target, for a search by spectrum.
fn spectrum_of(target: &Target) -> &SpectralTarget {
    target.spectrum.as_ref().expect("a search by spectrum was checked for one")
}

/// Three numbers with squares that sum to the square of a colour difference.
fn residuals(metric: Metric, wanted: Lab, found: Lab) -> [f64; 3] {
    match metric {
        Metric::Ciede2000 | Metric::Spectrum(_) => ciede2000_residuals(wanted, found),
        Metric::Cie1976 => {
            [found.lightness - wanted.lightness, found.a - wanted.a, found.b - wanted.b]
        }
    }
}

/// Residuals of a colour difference and their derivatives with respect to X, Y and Z (rows by residual).
/// We compute the derivatives of CIELAB exactly, and the derivatives of the difference formula by
/// difference quotients.
fn residuals_with_slopes(
    metric: Metric,
    wanted: Lab,
    xyz: Xyz,
    white: Xyz,
) -> ([f64; 3], [[f64; 3]; 3]) {
    /// Step of the difference quotients in units of CIELAB: small against any colour difference,
    /// large against rounding.
    const STEP: f64 = 1e-3;
    let lab = Lab::from_xyz(xyz, white);
    let here = residuals(metric, wanted, lab);
    let moved = [
        Lab { lightness: lab.lightness + STEP, ..lab },
        Lab { a: lab.a + STEP, ..lab },
        Lab { b: lab.b + STEP, ..lab },
    ];
    let moved = moved.map(|near| residuals(metric, wanted, near));
    let over_lab: [[f64; 3]; 3] =
        std::array::from_fn(|i| std::array::from_fn(|j| (moved[j][i] - here[i]) / STEP));
    let lab_over_xyz = Lab::slopes_over_xyz(xyz, white).0;
    let over_xyz = std::array::from_fn(|i| {
        std::array::from_fn(|c| (0..3).map(|j| over_lab[i][j] * lab_over_xyz[j][c]).sum())
    });
    (here, over_xyz)
}

/// Reflectance of a film that hides, with its derivatives with respect to K and S.
fn infinite_film_with_slopes(k: f64, s: f64) -> [f64; 3] {
    // At K = 0 the slope over K is infinite. Slightly above, it is finite and steep.
    let k = k.max(1e-9 * s).max(1e-300);
    let alpha = (k * (k + 2.0 * s)).sqrt();
    let rest = k + s + alpha;
    [s / rest, -s / (rest * alpha), k / (rest * alpha)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::evaluate::Viewing;
    use crate::library::Pigment;
    use crate::matching::limits::Thickness;
    use crate::matching::target::{SpectrumWeights, ViewingCondition};
    use spectra::{Grid, Illuminant, Observer, Reflectance, Spectrum};

    fn pigment(grid: Grid, name: &str, k: &dyn Fn(f64) -> f64, s: f64) -> Pigment {
        Pigment {
            name: name.to_owned(),
            color_index: None,
            absorption: grid.wavelengths_nm().map(k).collect(),
            scattering: vec![s; 16],
            absorption_sd: Vec::new(),
            scattering_sd: Vec::new(),
            identified: true,
            guessed: false,
            measured_amounts: None,
            notes: Vec::new(),
        }
    }

    fn library() -> PigmentLibrary {
        let grid = Grid::from_nm(400.0, 20.0, 16).unwrap();
        PigmentLibrary {
            title: String::new(),
            licence: String::new(),
            source: String::new(),
            grid,
            amounts: crate::library::AmountKind::Relative,
            reference: Some("white".to_owned()),
            saunderson: spectra::optics::Surface::new(
                0.03,
                0.6,
                spectra::optics::Specular::Included,
            )
            .unwrap(),
            unevenness: 0.0,
            inputs: Vec::new(),
            settings: None,
            pigments: vec![
                pigment(grid, "white", &|_| 0.002, 1.0),
                pigment(grid, "red", &|nm| if nm < 580.0 { 2.0 } else { 0.02 }, 0.3),
                pigment(grid, "blue", &|nm| (nm / 500.0).powi(8), 0.1),
            ],
            evidence: None,
        }
    }

    #[test]
    fn slopes_of_the_cost_agree_with_difference_quotients() {
        let library = library();
        let conditions = vec![condition("D65", 1.0), condition("A", 0.5)];
        let wanted = Lab { lightness: 48.0, a: 22.0, b: -9.0 };
        let curve = library.grid.wavelengths_nm().map(|nm| 0.2 + 0.3 * ((nm - 400.0) / 300.0));
        let measured = Spectrum::<Reflectance>::new(library.grid, curve.collect()).unwrap();
        let thickness = Thickness::Between(0.1, 9.0);
        let over = FilmKind::Over { ground: vec![0.7; 16], thickness };
        for (film, count) in [(FilmKind::Hiding, 3), (over, 4)] {
            let [even, seen] =
                [SpectrumWeights::Even, SpectrumWeights::Observer].map(Metric::Spectrum);
            for metric in [Metric::Ciede2000, Metric::Cie1976, even, seen] {
                let limits = RecipeLimits {
                    metric,
                    ..RecipeLimits::new(&library, conditions.clone(), film.clone())
                };
                let forward = Forward::new(&library, &limits).unwrap();
                let weights = metric.spectrum_weights().unwrap_or_default();
                let spectrum =
                    SpectralTarget::new(&measured, library.grid, weights, &conditions).unwrap();
                let target = Target { spectrum, ..Target::from_lab("", wanted, &conditions) };
                let mut scratch = Scratch::default();
                let pigments = [0, 1, 2].map(PigmentId);
                let point = [0.5, 0.2, 0.3, 0.4];
                let mut cost = |point: &[f64]| {
                    let thickness = if count == 4 { point[3].exp() } else { 1.0 };
                    let chooses = count == 4;
                    let unknowns = &point[..count];
                    forward.cost(&target, &pigments, unknowns, thickness, chooses, &mut scratch)
                };
                let slopes = cost(&point).gradient;
                for unknown in 0..count {
                    let [above, below] = [1e-5, -1e-5].map(|by| {
                        let mut near = point;
                        near[unknown] += by;
                        cost(&near).value
                    });
                    let quotient = (above - below) / 2e-5;
                    let off = (slopes[unknown] - quotient).abs() / quotient.abs().max(1.0);
                    assert!(off < 1e-3, "{metric:?} {unknown}: {} for {quotient}", slopes[unknown]);
                }
            }
        }
    }

    fn condition(name: &str, weight: f64) -> ViewingCondition {
        ViewingCondition {
            viewing: Viewing {
                illuminant: Illuminant::named(name).unwrap(),
                observer: Observer::default(),
            },
            weight,
        }
    }
}
