//! A film so thick that its backing does not show.

/// Reflectance of a film that hides, 0..1 (Kubelka and Munk 1931).
///
/// | symbol | here         | unit       | range   |
/// |--------|--------------|------------|---------|
/// | K      | `absorption` | per length | 0..     |
/// | S      | `scattering` | per length | 0..     |
///
/// With neither K nor S there is no film; the limit K = 0 is taken, 1.
///
/// ```
/// use spectra::optics::{absorption_over_scattering, infinite_film};
/// let r = infinite_film(0.2, 1.0);
/// assert!((absorption_over_scattering(r) - 0.2).abs() < 1e-12);
/// ```
#[must_use]
pub fn infinite_film(absorption: f64, scattering: f64) -> f64 {
    // S / (K + S + sqrt(K (K + 2 S))): no difference of near values.
    let (k, s) = (absorption, scattering);
    if k == 0.0 { 1.0 } else { s / (k + s + (k * (k + 2.0 * s)).sqrt()) }
}

/// Reflectance of a film that hides, from `ratio` = K/S, 0 and up.
#[must_use]
pub fn infinite_film_from_ratio(ratio: f64) -> f64 {
    1.0 / (1.0 + ratio + (ratio * (ratio + 2.0)).sqrt())
}

/// K/S of a film that hides, from its reflectance in 0..=1: (1 - R)^2 / (2 R),
/// infinite at 0.
#[must_use]
pub fn absorption_over_scattering(reflectance: f64) -> f64 {
    (1.0 - reflectance).powi(2) / (2.0 * reflectance)
}

/// The slope dR/d(K/S) at the reflectance R of a film that hides: 0 or below.
/// At R = 1 the slope is infinite.
#[must_use]
pub fn infinite_film_slope(reflectance: f64) -> f64 {
    let r = reflectance;
    -2.0 * r * r / (1.0 - r * r)
}
