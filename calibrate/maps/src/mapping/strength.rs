//! How far the strengths of paints are off, told by the errors of mixtures that a library had not seen.

use calibrate::{LeftOutMixture, Residuals};

use super::prepared::Prepared;
use crate::search::set_fit::SetFit;

/// Gauss-Newton steps of a mixture's own pigments.
const STEPS: usize = 12;
/// Part of a normal distribution within one standard deviation.
const WITHIN: f64 = 0.6827;
/// Least predicted reflectance by which a measured one is divided.
const LEAST: f64 = 1e-3;

/// Standard deviation of the logarithm of a paint's strength with which one deviation covers 68 % of the shares
/// of the mixtures in `residuals`, when their own pigments are fitted to them; 0 without such mixtures.
///
/// A paint whose strength is off looks like a paint with another share: the spectrum does not tell.
pub(crate) fn strength_sd(prepared: &Prepared, residuals: &Residuals) -> f64 {
    let of_mixture = |mixture| needed(prepared, mixture).unwrap_or_default();
    let mut needed: Vec<f64> = residuals.mixtures.iter().flat_map(of_mixture).collect();
    needed.sort_by(f64::total_cmp);
    let place = (WITHIN * needed.len() as f64) as usize;
    needed.get(place).map_or(0.0, |variance| variance.sqrt())
}

/// Variance of the logarithm of strengths that explains the error of each share of a mixture; `None` for a
/// mixture of one pigment, of more than four, and of pigments that take no part.
fn needed(prepared: &Prepared, mixture: &LeftOutMixture) -> Option<Vec<f64>> {
    let place = |(name, share): (&String, &f64)| Some((prepared.paints.place(name)?, *share));
    let parts: Vec<(usize, f64)> = mixture.shares.iter().map(place).collect::<Option<_>>()?;
    let start: Vec<(usize, f32)> = parts.iter().map(|&(p, share)| (p, share as f32)).collect();
    let mut set = SetFit::of_parts(&start).filter(|set| set.len() > 1)?;
    let fold = |values: &[f64]| prepared.bands.fold_library(values);
    let measured = fold(&mixture.measured);
    let predicted = fold(&mixture.predicted);
    // This library's film, off as that of the fit without the mixture was.
    let film = prepared.paints.reflectance(&parts);
    let ratios = measured.iter().zip(&predicted).map(|(m, p)| m / p.max(LEAST));
    let off: Vec<f32> =
        film.iter().zip(ratios).map(|(film, ratio)| (film * ratio) as f32).collect();
    let engine = &prepared.engine;
    let pixel = engine.films.pixel(&engine.noise, &off);
    let truth = set.shares;
    let difference = set.refine(&engine.films, &pixel, STEPS);
    let excess = engine.scores.excess(set.chi2);
    let covariance = set.covariance(&difference);
    let shares: Vec<f64> = set.parts().map(|(_, share)| f64::from(share)).collect();
    let needed = (0..shares.len()).map(|i| {
        let slope = |(j, share): (usize, &f64)| {
            let own = f64::from(u8::from(i == j));
            (share * (own - shares[i])).powi(2)
        };
        let slopes: f64 = shares.iter().enumerate().map(slope).sum();
        let square = (shares[i] - f64::from(truth[i])).powi(2);
        (square - covariance[i][i] * excess).max(0.0) / slopes.max(1e-9)
    });
    Some(needed.collect())
}

#[cfg(test)]
mod tests {
    use pigment::PigmentLibrary;

    use super::*;
    use crate::films::noise::ModelError;
    use crate::films::settings::MapSettings;

    /// Error that is told of mixtures whose second paint is `factor` times as strong as the library has it.
    fn told(factor: f64) -> f64 {
        let oils = PigmentLibrary::van_gogh_oils();
        let nm: Vec<f64> = oils.grid.wavelengths_nm().collect();
        let settings = MapSettings { sensor_noise: 0.0, ..MapSettings::default() };
        let exact = ModelError::Stated(0.001);
        let prepared = Prepared::new(&oils, &nm, &settings, &exact).unwrap();
        let place = |name: &str| prepared.paints.place(name).unwrap();
        let white = place("Zinc White");
        let mut residuals = Residuals::van_gogh_oils();
        residuals.mixtures.truncate(4);
        let names = ["Viridian", "Cobalt Blue", "Vermilion", "Bone Black"];
        for (mixture, name) in residuals.mixtures.iter_mut().zip(names) {
            let film =
                |part: f64| prepared.paints.reflectance(&[(white, 0.6), (place(name), part)]);
            mixture.shares = [("Zinc White".to_owned(), 0.6), (name.to_owned(), 0.4)].into();
            mixture.predicted = film(0.4);
            mixture.measured = film(0.4 * factor);
        }
        strength_sd(&prepared, &residuals)
    }

    #[test]
    fn a_strength_that_is_off_is_told() {
        let exact = told(1.0);
        assert!(exact < 0.01, "{exact}");
        // Two paints share the error: each is off by its square root of a half.
        let off = told(1.3);
        let expected = 1.3f64.ln() / 2f64.sqrt();
        assert!((off / expected - 1.0).abs() < 0.15, "{off} {expected}");
    }

    #[test]
    fn pigments_that_take_no_part_tell_nothing() {
        let oils = PigmentLibrary::van_gogh_oils();
        let nm: Vec<f64> = oils.grid.wavelengths_nm().collect();
        let palette = vec!["Viridian".to_owned()];
        let settings = MapSettings { palette, ..MapSettings::default() };
        let prepared = Prepared::new(&oils, &nm, &settings, &ModelError::Stated(0.1)).unwrap();
        let mut residuals = Residuals::van_gogh_oils();
        assert_eq!(strength_sd(&prepared, &residuals), 0.0);
        // Two pigments of three tell no more than one of two.
        for mixture in &mut residuals.mixtures {
            mixture.shares.insert("Viridian".to_owned(), 0.3);
            mixture.shares.insert("Zinc White".to_owned(), 0.3);
        }
        residuals.mixtures.retain(|mixture| mixture.shares.len() > 2);
        assert!(residuals.mixtures.len() > 50, "{} of three or four", residuals.mixtures.len());
        let palette = vec!["Viridian".to_owned(), "Zinc White".to_owned()];
        let settings = MapSettings { palette, ..MapSettings::default() };
        let prepared = Prepared::new(&oils, &nm, &settings, &ModelError::Stated(0.1)).unwrap();
        assert_eq!(strength_sd(&prepared, &residuals), 0.0);
    }
}
