//! Waves in a profile: filters and spectra over wavelengths in mm.

use std::f64::consts::{LN_2, PI, TAU};

use super::series::without_parabola;

/// Profile without waves shorter than `cut_mm`: the Gaussian filter of surface texture (ISO
/// 16610-21:2011, equation 1), which passes half of a wave of that length. Near the ends the
/// weights inside are normalised. `step_mm` is the distance of two values.
#[must_use]
pub fn smoothed(profile: &[f64], step_mm: f64, cut_mm: f64) -> Vec<f64> {
    let width = (LN_2 / PI).sqrt() * cut_mm;
    let reach = (2.0 * width / step_mm).ceil() as usize;
    let weight = |lag: usize| (-PI * (lag as f64 * step_mm / width).powi(2)).exp();
    let weights: Vec<f64> = (0..=reach).map(weight).collect();
    let at = |index: usize| {
        let first = index.saturating_sub(reach);
        let last = (index + reach).min(profile.len() - 1);
        let mut sum = 0.0;
        let mut whole = 0.0;
        for (other, value) in profile.iter().enumerate().take(last + 1).skip(first) {
            let weight = weights[index.abs_diff(other)];
            sum += weight * value;
            whole += weight;
        }
        sum / whole
    };
    (0..profile.len()).map(at).collect()
}

/// Profile minus [`smoothed`]: waves shorter than `cut_mm`.
#[must_use]
pub fn rough(profile: &[f64], step_mm: f64, cut_mm: f64) -> Vec<f64> {
    let smooth = smoothed(profile, step_mm, cut_mm);
    profile.iter().zip(smooth).map(|(value, smooth)| value - smooth).collect()
}

/// Power of the wave of `per_mm` waves a mm in a profile, under a Hann window.
fn power(profile: &[f64], step_mm: f64, per_mm: f64) -> f64 {
    let count = profile.len() as f64;
    let mut real = 0.0;
    let mut imaginary = 0.0;
    for (index, value) in profile.iter().enumerate() {
        let window = 0.5 - 0.5 * ((index as f64 + 0.5) / count * TAU).cos();
        let (sin, cos) = (index as f64 * step_mm * per_mm * TAU).sin_cos();
        real += window * value * cos;
        imaginary += window * value * sin;
    }
    (real * real + imaginary * imaginary) / (count * count)
}

/// Wavelength in mm at the peak of the mean power spectrum of several profiles of one length,
/// each without its parabola. Searched from two cells to the length of a profile over 1.5, in
/// steps of a quarter of a wave over the length. Not a number without profiles or relief.
#[must_use]
pub fn peak_wavelength_mm(profiles: &[Vec<f64>], step_mm: f64) -> f64 {
    let length_mm = profiles.first().map_or(0.0, |profile| profile.len() as f64 * step_mm);
    let flat: Vec<Vec<f64>> = profiles.iter().map(|profile| without_parabola(profile)).collect();
    let mut best = (0.0, f64::NAN);
    let mut waves = 1.5;
    while waves / length_mm <= 0.5 / step_mm {
        let per_mm = waves / length_mm;
        let whole: f64 = flat.iter().map(|profile| power(profile, step_mm, per_mm)).sum();
        if whole > best.0 {
            best = (whole, 1.0 / per_mm);
        }
        waves += 0.25;
    }
    best.1
}

#[cfg(test)]
mod tests {
    use super::super::series::rms;
    use super::*;
    use crate::near::assert_near;

    fn wave(length_mm: f64, wavelength_mm: f64, height_mm: f64) -> Vec<f64> {
        (0..(length_mm / 0.1) as usize)
            .map(|index: usize| height_mm * (index as f64 * 0.1 / wavelength_mm * TAU).sin())
            .collect()
    }

    #[test]
    fn the_filter_halves_a_wave_of_its_length_and_keeps_long_ones() {
        let part = |wavelength_mm: f64| {
            let wave = wave(90.0, wavelength_mm, 1.0);
            let inner = |profile: &[f64]| rms(&profile[150..750]);
            inner(&smoothed(&wave, 0.1, 3.0)) / inner(&wave)
        };
        assert_near("passed", &[part(3.0), part(30.0), part(0.6)], &[0.5, 0.993, 0.0], 0.005);
        let level = smoothed(&[2.0; 30], 0.1, 3.0);
        assert_near("a level", &level, &[2.0; 30], 1e-12);
        assert_near("nothing rough on a level", &rough(&[2.0; 30], 0.1, 3.0), &[0.0; 30], 1e-12);
    }

    #[test]
    fn the_peak_is_at_the_wavelength_of_the_strongest_wave() {
        for wavelength_mm in [0.3, 0.7, 1.2] {
            let strong = wave(6.0, wavelength_mm, 0.02);
            let weak = wave(6.0, 2.5, 0.005);
            let both: Vec<f64> = strong
                .iter()
                .zip(weak)
                .enumerate()
                .map(|(i, (a, b))| a + b + 0.01 * i as f64)
                .collect();
            let peak = peak_wavelength_mm(&[both], 0.1);
            assert!((peak / wavelength_mm - 1.0).abs() < 0.05, "{peak} for {wavelength_mm}");
        }
        assert!(peak_wavelength_mm(&[vec![0.0; 60]], 0.1).is_nan(), "no relief has no peak");
        assert!(peak_wavelength_mm(&[], 0.1).is_nan(), "no profile has no peak");
    }
}
