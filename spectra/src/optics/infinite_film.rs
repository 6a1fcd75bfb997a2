//! Optics of a paint film so thick that its backing is invisible.

/// Reflectance of an opaque film, 0 to 1 (Kubelka and Munk 1931).
///
/// | symbol | argument     | unit       | range    |
/// |--------|--------------|------------|----------|
/// | K      | `absorption` | per length | 0 and up |
/// | S      | `scattering` | per length | 0 and up |
///
/// K = 0 gives 1, also for S = 0, where the limit is undefined.
///
/// ```
/// use spectra::optics::{absorption_over_scattering, infinite_film};
/// let r = infinite_film(0.2, 1.0);
/// assert!((absorption_over_scattering(r) - 0.2).abs() < 1e-12);
/// ```
#[must_use]
pub fn infinite_film(absorption: f64, scattering: f64) -> f64 {
    // S / (K + S + sqrt(K (K + 2 S))) has no difference of nearly equal values.
    let k = absorption;
    let s = scattering;
    if k == 0.0 { 1.0 } else { s / (k + s + (k * (k + 2.0 * s)).sqrt()) }
}

/// Reflectance of an opaque film from `ratio` = K/S, 0 and up.
#[must_use]
pub fn infinite_film_from_ratio(ratio: f64) -> f64 {
    1.0 / (1.0 + ratio + (ratio * (ratio + 2.0)).sqrt())
}

/// K/S of an opaque film from its reflectance, 0 to 1: (1 - R)^2 / (2 R). Infinite at 0.
#[must_use]
pub fn absorption_over_scattering(reflectance: f64) -> f64 {
    (1.0 - reflectance).powi(2) / (2.0 * reflectance)
}

/// The derivative dR/d(K/S) at the reflectance R of an opaque film. Not positive; infinite at R
/// = 1.
#[must_use]
pub fn infinite_film_slope(reflectance: f64) -> f64 {
    let r = reflectance;
    -2.0 * r * r / (1.0 - r * r)
}
