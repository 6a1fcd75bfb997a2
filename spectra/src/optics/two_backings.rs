//! K/S of a film that does not hide, from its reflectance over two backings.

use super::infinite_film::infinite_film_from_ratio;

/// A film's reflectance over a backing, and the backing's own; both internal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OverBacking {
    /// The film lying on the backing.
    pub film: f64,
    /// The bare backing.
    pub backing: f64,
}

/// What two backings tell of a film.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FilmOptics {
    /// K/S, 0 and up.
    pub ratio: f64,
    /// S d, the scattering power. Infinite where the film hides, `None` where
    /// the readings contradict each other.
    pub scattering_power: Option<f64>,
    /// How much the backing shows: the difference of the film's reflectances
    /// over that of the backings. 0 hides, 1 is no film.
    pub transparency: f64,
}

/// K/S and S d from a film over two known backings, without its thickness.
///
/// From Kubelka 1948: with R over a backing g,
/// `a (R + g) + c (R - g) = 1 + R g`, where `a = 1 + K/S` and
/// `c = b coth(b S d)`, `b = sqrt(a^2 - 1)`. Two backings make a 2 x 2 system.
/// Readings that noise has pushed past what a film can do (a below 1) give
/// K/S = 0. Returns `None` if the two backings are the same, or if the film
/// scatters nothing back over either.
#[must_use]
pub fn film_over_two_backings(first: OverBacking, second: OverBacking) -> Option<FilmOptics> {
    let (r1, g1) = (first.film, first.backing);
    let (r2, g2) = (second.film, second.backing);
    // Subtracting the equations keeps the difference of the films, however
    // small, out of the denominator.
    let determinant = (r1 + g1) * (r2 - g2) - (r2 + g2) * (r1 - g1);
    if (g1 - g2).abs() < 1e-9 || determinant == 0.0 {
        return None;
    }
    let (p1, p2) = (1.0 + r1 * g1, 1.0 + r2 * g2);
    let a = (p1 * (r2 - g2) - p2 * (r1 - g1)) / determinant;
    let c = ((r1 + g1) * p2 - (r2 + g2) * p1) / determinant;
    let ratio = (a - 1.0).max(0.0);
    let b = (ratio * (ratio + 2.0)).sqrt();
    // Where the films read the same, c = b but for rounding.
    let scattering_power = if r1 == r2 { Some(f64::INFINITY) } else { scattering_power(b, c) };
    Some(FilmOptics { ratio, scattering_power, transparency: (r1 - r2) / (g1 - g2) })
}

/// S d from c = b coth(b S d).
fn scattering_power(b: f64, c: f64) -> Option<f64> {
    if !c.is_finite() || c <= 0.0 {
        None
    } else if c <= b {
        // coth never falls below 1; noise on a film that hides.
        Some(f64::INFINITY)
    } else if b == 0.0 {
        Some(1.0 / c)
    } else {
        Some((b / c).atanh() / b)
    }
}

impl FilmOptics {
    /// The reflectance the paint would have in a film that hides.
    #[must_use]
    pub fn infinite_film(&self) -> f64 {
        infinite_film_from_ratio(self.ratio)
    }
}
