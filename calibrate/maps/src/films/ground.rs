//! The bare ground of a painting, by which pixels without paint are known.

use super::bands::Bands;
use crate::map_error::MapError;

/// Standard deviation of the ground's lightness from place to place, relative to its reflectance.
const LIGHTNESS: f64 = 0.03;
/// Standard deviation of the light that the surface reflects itself, in reflectance.
const GLOSS: f64 = 0.005;
/// Standard deviation by which the bands of bare ground differ otherwise, relative to its reflectance.
const UNEVEN: f64 = 0.005;
/// Chi-square per band up to which a pixel is bare ground.
const EXPLAINED: f64 = 2.0;

/// Reflectance of the bare ground of a painting, as the scan sees it.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Ground {
    nm: Vec<f64>,
    reflectance: Vec<f64>,
}

impl Ground {
    /// Reflectances, 0 to 1.5, at the wavelengths `nm` in nm, which rise.
    ///
    /// # Errors
    /// [`MapError::Ground`] for two lists of different lengths, for wavelengths that do not rise, and for numbers
    /// that are no reflectances.
    pub fn new(nm: Vec<f64>, reflectance: Vec<f64>) -> Result<Self, MapError> {
        let fault = |problem: String| MapError::Ground { problem };
        if nm.len() != reflectance.len() || nm.len() < 2 {
            let nm = nm.len();
            let values = reflectance.len();
            return Err(fault(format!("has {nm} wavelengths and {values} reflectances")));
        }
        let rises = |pair: &[f64]| pair[0] < pair[1];
        if let Some(place) = nm.windows(2).position(|pair| !rises(pair)) {
            let before = nm[place];
            let after = nm[place + 1];
            return Err(fault(format!("has {after} nm after {before} nm")));
        }
        let is_reflectance = |value: &f64| (0.0..=1.5).contains(value);
        if let Some(place) = reflectance.iter().position(|value| !is_reflectance(value)) {
            let value = reflectance[place];
            let nm = nm[place];
            return Err(fault(format!("reflects {value} at {nm} nm")));
        }
        Ok(Self { nm, reflectance })
    }

    /// Reflectance at a wavelength, between its neighbours; `None` outside.
    fn at(&self, nm: f64) -> Option<f64> {
        let after = self.nm.iter().position(|own| *own >= nm)?;
        if self.nm[after] == nm {
            return Some(self.reflectance[after]);
        }
        let before = after.checked_sub(1)?;
        let part = (nm - self.nm[before]) / (self.nm[after] - self.nm[before]);
        Some(self.reflectance[before] * (1.0 - part) + self.reflectance[after] * part)
    }
}

/// The ground on the bands of a map, with the covariance of its differences from place to place: that of the bands
/// by themselves, of a common lightness and of a common gloss.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct BareGround {
    reflectance: Vec<f64>,
    /// 1 / variance of each band.
    weights: Vec<f64>,
    /// Weights of two sums whose squares the common differences take from chi-square.
    common: [Vec<f64>; 2],
}

impl BareGround {
    /// `ground` on `bands` of a scan at the wavelengths `wavelengths`, whose bands have the variances `sensor`.
    pub(crate) fn new(
        ground: &Ground,
        wavelengths: &[f64],
        bands: &Bands,
        sensor: &[f64],
    ) -> Result<Self, MapError> {
        let needed = bands.from_scan.iter().flat_map(|row| row.terms.iter().map(|term| term.0));
        let mut of_scan = vec![0.0; wavelengths.len()];
        for band in needed {
            let nm = wavelengths[band];
            of_scan[band] = ground
                .at(nm)
                .ok_or_else(|| MapError::Ground { problem: format!("tells nothing of {nm} nm") })?;
        }
        let reflectance = bands.fold_scan(&of_scan);
        let own = reflectance.iter().zip(sensor);
        let weights: Vec<f64> =
            own.map(|(r, sensor)| 1.0 / (sensor + (UNEVEN * r).powi(2) + 1e-8)).collect();
        let curves = [
            reflectance.iter().map(|r| LIGHTNESS * r).collect::<Vec<f64>>(),
            vec![GLOSS; reflectance.len()],
        ];
        // Woodbury: V^-1 = W - W C (I + C^T W C)^-1 C^T W, whose middle is L^-T L^-1.
        let product = |a: &[f64], b: &[f64]| -> f64 {
            a.iter().zip(b).zip(&weights).map(|((a, b), w)| a * b * w).sum()
        };
        let first = (1.0 + product(&curves[0], &curves[0])).sqrt();
        let below = product(&curves[0], &curves[1]) / first;
        let second = (1.0 + product(&curves[1], &curves[1]) - below * below).sqrt();
        let of_first: Vec<f64> =
            curves[0].iter().zip(&weights).map(|(c, w)| c * w / first).collect();
        let of_second = (curves[1].iter().zip(&weights).zip(&of_first))
            .map(|((c, w), first)| (c * w - below * first) / second)
            .collect();
        Ok(Self { reflectance, weights, common: [of_first, of_second] })
    }

    /// Chi-square per band of a pixel, if it is bare ground.
    pub(crate) fn chi2(&self, reflectance: &[f32]) -> f64 {
        let mut sum = 0.0;
        let mut common = [0.0; 2];
        for (band, (own, value)) in self.reflectance.iter().zip(reflectance).enumerate() {
            let difference = f64::from(*value) - own;
            sum += difference * difference * self.weights[band];
            common[0] += difference * self.common[0][band];
            common[1] += difference * self.common[1][band];
        }
        (sum - common[0] * common[0] - common[1] * common[1]) / self.reflectance.len() as f64
    }

    /// Tells whether a pixel is bare ground.
    pub(crate) fn explains(&self, reflectance: &[f32]) -> bool {
        self.chi2(reflectance) <= EXPLAINED
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{DMatrix, DVector};
    use spectra::Grid;

    use super::*;

    fn linen() -> (Vec<f64>, Vec<f64>) {
        let nm: Vec<f64> = (0..31).map(|i| 400.0 + 10.0 * f64::from(i)).collect();
        let reflectance = nm.iter().map(|nm| 0.2 + 0.001 * (nm - 400.0)).collect();
        (nm, reflectance)
    }

    fn bare() -> BareGround {
        let (nm, reflectance) = linen();
        let bands = Bands::new(&nm, Grid::from_nm(400.0, 10.0, 31).unwrap()).unwrap();
        let ground = Ground::new(nm.clone(), reflectance).unwrap();
        BareGround::new(&ground, &nm, &bands, &[9e-6; 31]).unwrap()
    }

    #[test]
    fn chi_square_is_that_of_the_dense_covariance() {
        let (_, ground) = linen();
        let pixel: Vec<f32> =
            (0..31).map(|i| (1.03 * ground[i] + 0.004 * (i as f64).sin() + 0.003) as f32).collect();
        let mean = DVector::from_vec(ground.clone());
        let covariance = DMatrix::from_fn(31, 31, |i, j| {
            let own = if i == j { 9e-6 + (UNEVEN * ground[i]).powi(2) + 1e-8 } else { 0.0 };
            own + LIGHTNESS * LIGHTNESS * ground[i] * ground[j] + GLOSS * GLOSS
        });
        let difference = DVector::from_iterator(31, pixel.iter().map(|v| f64::from(*v))) - mean;
        let solved = covariance.cholesky().unwrap().solve(&difference);
        let expected = difference.dot(&solved) / 31.0;
        let found = bare().chi2(&pixel);
        assert!((found / expected - 1.0).abs() < 1e-6, "{found} {expected}");
    }

    #[test]
    fn lighter_and_glossier_ground_is_ground_and_other_colours_are_not() {
        let (_, ground) = linen();
        let bare = bare();
        let of = |change: &dyn Fn(usize, f64) -> f64| -> Vec<f32> {
            ground.iter().enumerate().map(|(i, r)| change(i, *r) as f32).collect()
        };
        assert!(bare.explains(&of(&|_, r| r)));
        assert!(bare.explains(&of(&|_, r| 0.95 * r)), "darker");
        assert!(bare.explains(&of(&|_, r| r + 0.008)), "glossier");
        assert!(!bare.explains(&of(&|_, r| 0.6 * r)), "much darker");
        let bent = |i: usize, r: f64| r + 0.03 * (i as f64 / 10.0).sin();
        assert!(!bare.explains(&of(&bent)), "of another colour");
    }

    #[test]
    fn ground_that_cannot_be_used_is_refused() {
        let (nm, reflectance) = linen();
        let refused = |nm: Vec<f64>, reflectance: Vec<f64>, words: &str| {
            let error = Ground::new(nm, reflectance).unwrap_err();
            assert!(error.to_string().contains(words), "{error}");
        };
        refused(nm.clone(), vec![0.2; 30], "31 wavelengths and 30 reflectances");
        refused(vec![500.0, 400.0], vec![0.2; 2], "400 nm after 500 nm");
        refused(vec![500.0, f64::NAN], vec![0.2; 2], "NaN nm after 500 nm");
        refused(vec![500.0, 500.0], vec![0.2; 2], "500 nm after 500 nm");
        refused(vec![500.0], vec![0.2], "1 wavelengths and 1 reflectances");
        refused(vec![400.0, 500.0], vec![0.2, 42.0], "reflects 42 at 500 nm");
        refused(vec![400.0, 500.0], vec![-0.1, 0.2], "reflects -0.1 at 400 nm");
        refused(vec![400.0, 500.0], vec![f64::NAN, 0.2], "reflects NaN at 400 nm");
        let bands = Bands::new(&nm, Grid::from_nm(400.0, 10.0, 31).unwrap()).unwrap();
        let short = Ground::new(nm[..30].to_vec(), reflectance[..30].to_vec()).unwrap();
        let error = BareGround::new(&short, &nm, &bands, &[9e-6; 31]).unwrap_err();
        assert!(error.to_string().contains("700 nm"), "{error}");
        let late = Ground::new(nm[1..].to_vec(), reflectance[1..].to_vec()).unwrap();
        let error = BareGround::new(&late, &nm, &bands, &[9e-6; 31]).unwrap_err();
        assert!(error.to_string().contains("400 nm"), "{error}");
    }

    #[test]
    fn ground_of_other_wavelengths_is_interpolated() {
        let (nm, reflectance) = linen();
        let bands = Bands::new(&nm, Grid::from_nm(400.0, 10.0, 31).unwrap()).unwrap();
        let interpolated = |of_few: Vec<f64>| {
            let ground = Ground::new(vec![375.0, 505.0, 565.0, 725.0], of_few).unwrap();
            BareGround::new(&ground, &nm, &bands, &[9e-6; 31]).unwrap().reflectance
        };
        for (found, expected) in
            interpolated(vec![0.175, 0.305, 0.365, 0.525]).iter().zip(&reflectance)
        {
            assert!((found - expected).abs() < 1e-9, "{found} {expected}");
        }
        // A ground that bends between the bands lies between its neighbours everywhere.
        let bent = interpolated(vec![0.1, 0.36, 0.24, 0.56]);
        let expected = nm.iter().map(|nm| match nm {
            ..505.0 => 0.1 + 0.002 * (nm - 375.0),
            ..565.0 => 0.36 - 0.002 * (nm - 505.0),
            _ => 0.24 + 0.002 * (nm - 565.0),
        });
        let off = bent.iter().zip(expected).map(|(found, expected)| (found - expected).abs());
        let off: Vec<usize> =
            off.enumerate().filter(|(_, off)| *off > 1e-9).map(|(band, _)| band).collect();
        assert!(off.is_empty(), "{off:?} {bent:?}");
    }
}
