//! Tests of the arithmetic of one pixel against dense matrices and difference quotients.

use std::collections::BTreeMap;

use calibrate::{LeftOutMixture, Residuals};
use nalgebra::{Cholesky, DMatrix, DVector};

use super::bands::Bands;
use super::film::{Films, Work};
use super::noise::{ModelError, Noise, Scale};
use super::paints::Paints;
use super::whitening::WhiteningNoise;

struct Oils {
    paints: Paints,
    bands: Bands,
    films: Films,
}

fn oils(nm: &[f64]) -> Oils {
    let library = pigment::PigmentLibrary::van_gogh_oils();
    let bands = Bands::new(nm, library.grid).unwrap();
    let paints = Paints::new(&library, &[], &bands).unwrap();
    Oils { films: Films::new(&paints), paints, bands }
}

fn even(count: usize) -> Vec<f64> {
    (0..count).map(|i| 400.0 + 300.0 * i as f64 / (count - 1) as f64).collect()
}

/// The covariance that the noise describes near a reflectance.
fn covariance(oils: &Oils, noise: &Noise, reflectance: &[f64]) -> DMatrix<f64> {
    let surface = oils.paints.surface;
    let scale = |r: f64| match noise.scale {
        Scale::FourthRoot => 4.0 * r.powf(0.75),
        Scale::LogRatio => oils.paints.log_slope(surface.internal_from_measured(r).unwrap()).abs(),
    };
    DMatrix::from_fn(reflectance.len(), reflectance.len(), |i, j| {
        let common: f64 = noise.curves[i].iter().zip(&noise.curves[j]).map(|(a, b)| a * b).sum();
        let both = scale(reflectance[i]) * scale(reflectance[j]);
        let own = if i == j { noise.own[i] } else { 0.0 };
        both * (common + own) + if i == j { noise.sensor[i] } else { 0.0 }
    })
}

/// Errors of invented mixtures.
fn residuals() -> Residuals {
    let curve = |number: usize, scale: f64| -> Vec<f64> {
        let wave = |i: usize| (0.3 * (i * (1 + number % 5)) as f64 + number as f64).sin();
        (0..31).map(|i| scale * (1.1 + wave(i))).collect()
    };
    let mixture = |number: usize| {
        let measured = curve(number, 0.3);
        let error = curve(number + 3, 0.01);
        LeftOutMixture {
            sample: number.to_string(),
            shares: BTreeMap::new(),
            predicted: measured.iter().zip(&error).map(|(m, e)| m - e).collect(),
            measured,
        }
    };
    Residuals { mixtures: (0..12).map(mixture).collect(), ..Residuals::van_gogh_oils() }
}

#[test]
fn chi_square_is_that_of_the_whole_covariance() {
    // 29 bands leave a part of the last block empty.
    for (count, model) in [
        (31, ModelError::Stated(0.1)),
        (29, ModelError::Residuals(residuals())),
        (5, ModelError::Stated(0.3)),
    ] {
        let oils = oils(&even(count));
        let noise = Noise::new(&oils.bands, 0.003, &model);
        let shares = [(1, 0.7), (4, 0.05), (10, 0.25)];
        let film = oils.paints.reflectance(&shares);
        let seen: Vec<f64> = film
            .iter()
            .enumerate()
            .map(|(band, r)| r * (1.0 + 0.05 * (band as f64).sin()))
            .collect();
        let difference = DVector::from_fn(film.len(), |band, _| seen[band] - film[band]);
        let whole = Cholesky::new(covariance(&oils, &noise, &seen)).unwrap();
        let expected = difference.dot(&whole.solve(&difference));
        let narrow: Vec<f32> = seen.iter().map(|r| *r as f32).collect();
        let pixel = oils.films.pixel(&WhiteningNoise::new(&noise), &narrow);
        let found = oils.films.difference(&pixel, [1, 4, 10], [0.7, 0.05, 0.25]);
        let chi2 = f64::from(found.chi2);
        assert!((chi2 / expected - 1.0).abs() < 1e-3, "{count}: {chi2} {expected}");
        let squares = difference.norm_squared();
        assert!((f64::from(found.squares) / squares - 1.0).abs() < 1e-3, "{count}: squares");
    }
}

#[test]
fn slopes_are_those_of_chi_square() {
    let oils = oils(&even(31));
    let noise = WhiteningNoise::new(&Noise::new(&oils.bands, 0.003, &ModelError::Stated(0.1)));
    let seen: Vec<f32> =
        oils.paints.reflectance(&[(1, 0.6), (10, 0.4)]).iter().map(|r| *r as f32).collect();
    let pixel = oils.films.pixel(&noise, &seen);
    let at = |shares: [f32; 3]| oils.films.difference(&pixel, [1, 4, 10], shares);
    let shares = [0.7, 0.05, 0.25];
    let found = at(shares);
    for i in 0..3 {
        let step = 0.01 * shares[i];
        let moved = |sign: f32| {
            let mut moved = shares;
            moved[i] += sign * step;
            f64::from(at(moved).chi2)
        };
        let quotient = (moved(1.0) - moved(-1.0)) / (2.0 * f64::from(step));
        let slope = -2.0 * f64::from(found.right[i]);
        assert!((quotient / slope - 1.0).abs() < 0.02, "{i}: {quotient} {slope}");
    }
}

#[test]
fn linearised_rows_are_zero_in_sum_at_the_truth() {
    let oils = oils(&even(31));
    let noise = WhiteningNoise::new(&Noise::new(&oils.bands, 0.003, &ModelError::Stated(0.1)));
    let truth = [(1, 0.5), (4, 0.1), (10, 0.4)];
    let seen: Vec<f32> = oils.paints.reflectance(&truth).iter().map(|r| *r as f32).collect();
    let pixel = oils.films.pixel(&noise, &seen);
    let (internal, inverse) = oils.films.film(&[(4, 0.5), (13, 0.5)]);
    let mut work = Work::new(&oils.films);
    oils.films.products(&pixel, (&internal, &inverse), &mut work);
    let parts = truth.map(|(pigment, share)| share * f64::from(work.size(pigment)));
    let mut sums = [0.0; 2];
    for (i, (a, _)) in truth.iter().enumerate() {
        for (j, (b, _)) in truth.iter().enumerate() {
            let product = f64::from(work.product(*a.min(b), *a.max(b)));
            sums[0] += parts[i] * parts[j] * product;
            sums[1] += (parts[i] * parts[j] * product).abs();
        }
    }
    assert!(sums[0].abs() < 1e-5 * sums[1], "{sums:?}");
}
