//! Linear methods in common use, for comparison.

use spectra::optics::absorption_over_scattering;

use crate::films::paints::Paints;

/// A linear method.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Baseline {
    /// Nonnegative least squares on reflectance, shares of sum 1.
    Reflectance,
    /// Nonnegative least squares on -ln of reflectance, shares of sum 1.
    Absorbance,
    /// Nonnegative least squares on K/S with one constant.
    Ratio,
    /// Spectral angle to the masstones: the nearest one alone.
    Angle,
}

/// Shares by a baseline.
#[derive(Debug, Clone, PartialEq)]
pub struct Unmixed {
    /// Share of each pigment, sum 1.
    pub shares: Vec<f64>,
}

/// Weight of the equation that makes the shares sum to 1.
const SUM: f64 = 100.0;
/// Sweeps of coordinate descent.
const SWEEPS: usize = 20_000;

impl Baseline {
    /// All baselines in the order of a table.
    pub const ALL: [Self; 4] = [Self::Reflectance, Self::Absorbance, Self::Ratio, Self::Angle];

    /// Name for a table.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Reflectance => "linear R, NNLS sum 1",
            Self::Absorbance => "-log R, NNLS sum 1",
            Self::Ratio => "K/S one constant, NNLS",
            Self::Angle => "spectral angle",
        }
    }

    /// Shares of the pigments of `paints` in a film of this reflectance on their bands.
    #[must_use]
    pub fn unmix(self, paints: &Paints, reflectance: &[f64]) -> Unmixed {
        let space = |reflectance: &[f64]| -> Vec<f64> {
            reflectance
                .iter()
                .map(|&r: &f64| match self {
                    Self::Reflectance | Self::Angle => r,
                    Self::Absorbance => -r.max(1e-3).ln(),
                    Self::Ratio => {
                        let internal = paints.surface.internal_from_measured(r).unwrap_or(0.0);
                        absorption_over_scattering(internal.clamp(1e-3, 1.0))
                    }
                })
                .collect()
        };
        let mut target = space(reflectance);
        let masstones = (0..paints.count()).map(|p| space(&paints.reflectance(&[(p, 1.0)])));
        let mut columns: Vec<Vec<f64>> = masstones.collect();
        if self == Self::Angle {
            let cosine = |column: &Vec<f64>| dot(column, &target) / dot(column, column).sqrt();
            let nearest = (0..columns.len())
                .reduce(
                    |a: usize, b: usize| {
                        if cosine(&columns[b]) > cosine(&columns[a]) { b } else { a }
                    },
                )
                .unwrap_or(0);
            let shares = (0..columns.len()).map(|p| f64::from(u8::from(p == nearest))).collect();
            return Unmixed { shares };
        }
        if self != Self::Ratio {
            target.push(SUM);
            columns.iter_mut().for_each(|column| column.push(SUM));
        }
        let mut shares = nonnegative(&columns, &target);
        let sum: f64 = shares.iter().sum::<f64>().max(1e-12);
        shares.iter_mut().for_each(|share| *share /= sum);
        Unmixed { shares }
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Nonnegative least squares by coordinate descent, which converges for every start.
fn nonnegative(columns: &[Vec<f64>], target: &[f64]) -> Vec<f64> {
    let count = columns.len();
    let gram: Vec<Vec<f64>> =
        columns.iter().map(|a| columns.iter().map(|b| dot(a, b)).collect()).collect();
    let mut slope: Vec<f64> = columns.iter().map(|column| -dot(column, target)).collect();
    let mut x = vec![0.0f64; count];
    for _ in 0..SWEEPS {
        let mut largest = 0.0f64;
        for i in 0..count {
            let next = (x[i] - slope[i] / gram[i][i].max(1e-12)).max(0.0);
            let change = next - x[i];
            if change != 0.0 {
                x[i] = next;
                slope.iter_mut().zip(&gram[i]).for_each(|(slope, g)| *slope += change * g);
                largest = largest.max(change.abs());
            }
        }
        if largest < 1e-9 {
            break;
        }
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn least_squares_meet_the_conditions_of_an_optimum() {
        let columns = [vec![1.0, 0.2, 0.1], vec![0.9, 0.3, 0.1], vec![0.1, 0.4, 1.0]];
        let target = [0.5, 0.1, 0.7];
        let x = nonnegative(&columns, &target);
        for (column, x) in columns.iter().zip(&x) {
            let rest: Vec<f64> = (0..3)
                .map(|row| {
                    target[row]
                        - columns
                            .iter()
                            .zip(&*nonnegative(&columns, &target))
                            .map(|(c, x)| c[row] * x)
                            .sum::<f64>()
                })
                .collect();
            let slope = dot(column, &rest);
            assert!(slope < 1e-6 && (slope.abs() < 1e-6 || *x == 0.0), "{x} {slope}");
        }
    }
}
