//! K/S of a translucent film from its reflectance over two backings.

use super::infinite_film::infinite_film_from_ratio;

/// The internal reflectances of a film over a backing and of the bare backing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OverBacking {
    /// Reflectance of the film on the backing.
    pub film: f64,
    /// Reflectance of the bare backing.
    pub backing: f64,
}

/// Optical properties of a film, computed from readings over two backings.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FilmOptics {
    /// K/S of the paint, 0 and up.
    pub ratio: f64,
    /// Scattering power S d. Infinite for an opaque film; `None` if the readings contradict
    /// each other.
    pub scattering_power: Option<f64>,
    /// Transparency: the difference of the film's two reflectances divided by that of the
    /// backings. 0 for an opaque film, 1 for no film.
    pub transparency: f64,
}

/// Computes K/S and S d of a film over two known backings, without its thickness.
///
/// From Kubelka 1948: with R over a backing g, `a (R + g) + c (R - g) = 1 + R g`, where
/// `a = 1 + K/S`, `c = b coth(b S d)` and `b = sqrt(a^2 - 1)`. Two backings give a 2 x 2 system.
/// Noisy readings that no film can have (a below 1) give K/S = 0. Returns `None` if the two backings
/// are equal, or if the film scatters nothing back over either.
#[must_use]
pub fn film_over_two_backings(first: OverBacking, second: OverBacking) -> Option<FilmOptics> {
    let r1 = first.film;
    let g1 = first.backing;
    let r2 = second.film;
    let g2 = second.backing;
    // Subtracting the equations keeps the difference of the films, which may be tiny, out of
    // the denominator.
    let determinant = (r1 + g1) * (r2 - g2) - (r2 + g2) * (r1 - g1);
    if (g1 - g2).abs() < 1e-9 || determinant == 0.0 {
        return None;
    }
    let p1 = 1.0 + r1 * g1;
    let p2 = 1.0 + r2 * g2;
    let a = (p1 * (r2 - g2) - p2 * (r1 - g1)) / determinant;
    let c = ((r1 + g1) * p2 - (r2 + g2) * p1) / determinant;
    let ratio = (a - 1.0).max(0.0);
    let b = (ratio * (ratio + 2.0)).sqrt();
    // Films with equal readings have c = b up to rounding.
    let scattering_power = if r1 == r2 { Some(f64::INFINITY) } else { scattering_power(b, c) };
    Some(FilmOptics { ratio, scattering_power, transparency: (r1 - r2) / (g1 - g2) })
}

/// S d from c = b coth(b S d); `None` if no S d gives this c.
fn scattering_power(b: f64, c: f64) -> Option<f64> {
    if !c.is_finite() || c <= 0.0 {
        None
    } else if c <= b {
        // coth is never below 1: noise on an opaque film.
        Some(f64::INFINITY)
    } else if b == 0.0 {
        Some(1.0 / c)
    } else {
        Some((b / c).atanh() / b)
    }
}

impl FilmOptics {
    /// The reflectance that the paint would have in an opaque film.
    #[must_use]
    pub fn infinite_film(&self) -> f64 {
        infinite_film_from_ratio(self.ratio)
    }
}
