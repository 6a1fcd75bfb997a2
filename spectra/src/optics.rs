//! Kubelka-Munk optics of a paint film with a surface.
//!
//! We model two diffuse fluxes and no fluorescence. Reflectances are internal (below the surface)
//! unless [`Surface`] calls them measured. An [`UnevenFilm`] varies in thickness within the
//! instrument's aperture.
//!
//! Equations 8 and 9 of Baxter, Wendt and Lin 2004 are misprinted (tanh for coth, sinh for 1/sinh,
//! according to the authors' erratum), and the textbook form fails at K = 0 and for thick films.
//! The form that we use has no special cases, see `Layer::new`.

use std::str::FromStr;

use documents::hint::Explain;
use documents::request::RequestError;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Reflectance and transmittance of a film without a backing, each 0 to 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Layer {
    /// Fraction of the light that is reflected, the same from both sides.
    pub reflectance: f64,
    /// Fraction of the light that is transmitted, the same in both directions.
    pub transmittance: f64,
}

impl Layer {
    /// A film of the given `thickness`. Its paint has the `absorption` K and the `scattering` S per unit of
    /// thickness. All arguments are 0 and up.
    ///
    /// Kubelka 1948 (hyperbolic solution), rewritten with decaying exponentials:
    /// ```text
    /// alpha = sqrt(K (K + 2 S))   x = alpha d   e = exp(-2 x)
    /// phi   = (1 - e) / alpha     (2 d as alpha goes to 0)
    /// den   = (K + S) phi + 1 + e
    /// R = S phi / den             T = 2 exp(-x) / den
    /// ```
    ///
    /// ```
    /// use spectra::optics::Layer;
    /// let glaze = Layer::new(0.5, 0.0, 2.0);
    /// assert_eq!(glaze.reflectance, 0.0);
    /// assert!((glaze.transmittance - (-1.0f64).exp()).abs() < 1e-15);
    /// ```
    #[must_use]
    pub fn new(absorption: f64, scattering: f64, thickness: f64) -> Self {
        let k = absorption;
        let s = scattering;
        let alpha = (k * (k + 2.0 * s)).sqrt();
        let x = alpha * thickness;
        let phi = if x > 0.0 { -(-2.0 * x).exp_m1() / alpha } else { 2.0 * thickness };
        let decay = (-x).exp();
        let den = (k + s) * phi + 1.0 + decay * decay;
        let reflectance = s * phi / den;
        Self { reflectance, transmittance: 2.0 * decay / den }
    }

    /// The reflectance of the film over a backing of reflectance `backing` (Kubelka 1948, eq.
    /// 34).
    #[must_use]
    pub fn over(self, backing: f64) -> f64 {
        let t = self.transmittance;
        self.reflectance + t * t * backing / (1.0 - self.reflectance * backing)
    }

    /// The derivative of [`Layer::over`] with respect to `backing`.
    #[must_use]
    pub fn over_slope(self, backing: f64) -> f64 {
        (self.transmittance / (1.0 - self.reflectance * backing)).powi(2)
    }

    /// The reflectance of a film of unit thickness over `backing`, followed by its derivatives
    /// with respect to absorption and scattering.
    ///
    /// These are the derivatives of [`Layer::new`] and [`Layer::over`]. They satisfy Kubelka's
    /// equation, `K dR/dK + S dR/dS = S - 2 (K + S) R + S R^2`.
    #[must_use]
    pub fn over_with_slopes(absorption: f64, scattering: f64, backing: f64) -> [f64; 3] {
        let k = absorption;
        let s = scattering;
        let g = backing;
        // cosh x, sinh x / x, and the derivative of the latter with respect to y = x^2, each
        // times exp(-x). For small y a series avoids the loss of digits in the difference.
        let y = k * (k + 2.0 * s);
        let x = y.sqrt();
        let decay = (-x).exp();
        let cosh = f64::midpoint(1.0, decay * decay);
        let sinh = if x > 0.0 { -(-2.0 * x).exp_m1() / (2.0 * x) } else { 1.0 };
        let sinh_over_y = if y < 1e-2 {
            decay * (1.0 / 6.0 + y * (1.0 / 60.0 + y * (1.0 / 1680.0 + y / 90720.0)))
        } else {
            (cosh - sinh) / (2.0 * y)
        };
        let den = (k + s) * sinh + cosh;
        let r = s * sinh / den;
        let t = decay / den;
        // Derivatives by K and S: through y, and directly.
        let [over_k, over_s] = [(2.0 * (k + s), 0.0), (2.0 * k, 1.0)].map(|(y_slope, own)| {
            let den_slope = sinh + ((k + s) * sinh_over_y + sinh / 2.0) * y_slope;
            let r_slope = (own * sinh + s * sinh_over_y * y_slope - r * den_slope) / den;
            (r_slope, -t * den_slope / den)
        });
        let (r_over_k, t_over_k) = over_k;
        let (r_over_s, t_over_s) = over_s;
        let q = 1.0 / (1.0 - r * g);
        let by_r = 1.0 + (t * g * q).powi(2);
        let by_t = 2.0 * t * g * q;
        [r + t * t * g * q, by_r * r_over_k + by_t * t_over_k, by_r * r_over_s + by_t * t_over_s]
    }
}

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

/// The derivative dR/d(K/S) at the reflectance R of an opaque film. Not positive, infinite at R
/// = 1.
#[must_use]
pub fn infinite_film_slope(reflectance: f64) -> f64 {
    let r = reflectance;
    -2.0 * r * r / (1.0 - r * r)
}

/// Internal reflectance of a film over a backing, and of the bare backing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OverBacking {
    /// Reflectance of the film on the backing.
    pub film: f64,
    /// Reflectance of the bare backing.
    pub backing: f64,
}

/// Optical properties of a film that you get from readings over two backings.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FilmOptics {
    /// K/S of the paint, 0 and up.
    pub ratio: f64,
    /// Scattering power S d. Infinite for an opaque film. `None` if the readings contradict
    /// each other.
    pub scattering_power: Option<f64>,
    /// Transparency: the difference of the film's two reflectances divided by the difference of the backings.
    /// 0 for an opaque film, 1 for no film.
    pub transparency: f64,
}

/// Computes K/S and S d of a film over two known backings, without its thickness.
///
/// From Kubelka 1948: with R over a backing g, `a (R + g) + c (R - g) = 1 + R g`, where
/// `a = 1 + K/S`, `c = b coth(b S d)` and `b = sqrt(a^2 - 1)`. Two backings give a 2 x 2 system.
/// Noisy readings that no film can have (a below 1) give K/S = 0. This returns `None` if the two
/// backings are equal, or if the film scatters nothing back over either.
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

/// S d from c = b coth(b S d), or `None` if no S d gives this c.
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

/// Whether readings contain the specular reflection at the surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Specular {
    /// Included: a sphere instrument with a closed gloss trap (SCI, d/8:i).
    #[default]
    Included,
    /// Excluded: a sphere with an open gloss trap (SCE), or a 45/0 geometry.
    Excluded,
}

/// Saunderson's correction for reflection at the surface (Saunderson 1942).
///
/// | symbol | meaning                                                 | usual |
/// |--------|---------------------------------------------------------|-------|
/// | k1     | fraction of the incident light reflected at the surface | 0.03 to 0.04 |
/// | k2     | fraction of the diffuse internal light reflected back   | 0.4 to 0.6 |
///
/// If a film has the internal reflectance R, you measure
/// `k1 + (1 - k1)(1 - k2) R / (1 - k2 R)`, without the first term if you exclude the specular
/// component.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "SurfaceParts")]
pub struct Surface {
    /// Fraction of the incident light that the surface reflects, 0 to below 1.
    pub k1: f64,
    /// Fraction of the diffuse internal light that the surface reflects back, 0 to below 1.
    pub k2: f64,
    /// Whether readings contain the specular reflection.
    pub specular: Specular,
}

impl Surface {
    /// No surface: measured and internal reflectance are equal.
    pub const NONE: Self = Self { k1: 0.0, k2: 0.0, specular: Specular::Included };

    /// A surface with the coefficients k1 and k2.
    ///
    /// # Errors
    /// [`SurfaceError`] unless both are at least 0 and below 1.
    pub fn new(k1: f64, k2: f64, specular: Specular) -> Result<Self, SurfaceError> {
        for (name, value) in [("k1", k1), ("k2", k2)] {
            if !(0.0..1.0).contains(&value) {
                return Err(SurfaceError::Share { name, value });
            }
        }
        Ok(Self { k1, k2, specular })
    }

    /// The surface of most paints: k1 = 0.03 and k2 = 0.6. Use this if you know nothing better.
    #[must_use]
    pub fn of_most_paints(specular: Specular) -> Self {
        Self { k1: 0.03, k2: 0.6, specular }
    }

    /// The smallest possible measured reflectance, which a perfectly black film has.
    #[must_use]
    pub fn floor(&self) -> f64 {
        match self.specular {
            Specular::Included => self.k1,
            Specular::Excluded => 0.0,
        }
    }

    /// The measured reflectance of a film with the given internal reflectance.
    #[must_use]
    pub fn measured_from_internal(&self, internal: f64) -> f64 {
        self.floor() + (1.0 - self.k1) * (1.0 - self.k2) * internal / (1.0 - self.k2 * internal)
    }

    /// The derivative of [`Surface::measured_from_internal`].
    #[must_use]
    pub fn measured_slope(&self, internal: f64) -> f64 {
        (1.0 - self.k1) * (1.0 - self.k2) / (1.0 - self.k2 * internal).powi(2)
    }

    /// The internal reflectance of a film from its measured reflectance.
    ///
    /// # Errors
    /// [`SurfaceError::BelowFloor`] for a reading below what the surface alone reflects.
    pub fn internal_from_measured(&self, measured: f64) -> Result<f64, SurfaceError> {
        let above = measured - self.floor();
        if above < 0.0 {
            return Err(SurfaceError::BelowFloor { measured, floor: self.floor() });
        }
        Ok(above / ((1.0 - self.k1) * (1.0 - self.k2) + self.k2 * above))
    }
}

impl FromStr for Surface {
    type Err = RequestError;

    /// Reads `K1,K2` or `none`; the readings include the specular reflection.
    fn from_str(text: &str) -> Result<Self, RequestError> {
        if text == "none" {
            return Ok(Self::NONE);
        }
        let parts = text.split_once(',').map(|(k1, k2)| [k1, k2]);
        let numbers = parts.map(|parts| parts.map(|part| part.trim().parse::<f64>()));
        let Some([Ok(k1), Ok(k2)]) = numbers else {
            let reason = format!("takes K1,K2 or none, found `{text}`");
            return Err(RequestError::value(reason, "try [saunderson=0.03,0.6]"));
        };
        Self::new(k1, k2, Specular::Included).map_err(|error| RequestError::of(&error))
    }
}

/// The fields of a surface in a file.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct SurfaceParts {
    k1: f64,
    k2: f64,
    specular: Specular,
}

impl TryFrom<SurfaceParts> for Surface {
    type Error = SurfaceError;

    fn try_from(parts: SurfaceParts) -> Result<Self, SurfaceError> {
        Self::new(parts.k1, parts.k2, parts.specular)
    }
}

/// Coefficients or a reading that are physically impossible.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error, Explain)]
pub enum SurfaceError {
    /// A coefficient is outside 0 to 1.
    #[error("{name} is a fraction from 0 to below 1, found `{value}`")]
    #[fault(Setting)]
    Share {
        /// Name of the coefficient, `k1` or `k2`.
        name: &'static str,
        /// The value that was given.
        value: f64,
    },
    /// A reading is below what the surface alone reflects.
    #[error("a reading below what the surface alone reflects (k1 = {floor}), found `{measured}`")]
    BelowFloor {
        /// The measured reflectance.
        measured: f64,
        /// The reflectance of the surface alone.
        floor: f64,
    },
}

/// A film of uneven thickness over a backing and under a surface. The thickness is lognormal with
/// mean 1.
///
/// A wash is never even: pigment collects in the hollows of the paper and at edges, and an
/// instrument reads the mean. We compute this mean from three thicknesses (Gauss-Hermite
/// quadrature, exact for polynomials of degree 5 in the logarithm).
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct UnevenFilm {
    /// The surface of the film and of the bare backing.
    pub surface: Surface,
    /// Standard deviation of the logarithm of thickness: 0 for an even film, about 0.5 for a
    /// granulating wash.
    pub unevenness: f64,
}

impl UnevenFilm {
    /// Measured reflectance of a film with K d = `absorption` and S d = `scattering` at its
    /// mean thickness, over a backing with the internal reflectance `backing`.
    #[must_use]
    pub fn reflectance(&self, absorption: f64, scattering: f64, backing: f64) -> f64 {
        let at = |factor: f64| {
            let internal = Layer::new(factor * absorption, factor * scattering, 1.0).over(backing);
            self.surface.measured_from_internal(internal)
        };
        if self.unevenness == 0.0 {
            return at(1.0);
        }
        self.thicknesses().iter().map(|(factor, weight)| weight * at(*factor)).sum()
    }

    /// The value of [`UnevenFilm::reflectance`], followed by its derivatives with respect to
    /// `absorption` and `scattering`.
    #[must_use]
    pub fn reflectance_with_slopes(
        &self,
        absorption: f64,
        scattering: f64,
        backing: f64,
    ) -> [f64; 3] {
        let at = |factor: f64| {
            let [internal, over_k, over_s] =
                Layer::over_with_slopes(factor * absorption, factor * scattering, backing);
            let slope = factor * self.surface.measured_slope(internal);
            [self.surface.measured_from_internal(internal), slope * over_k, slope * over_s]
        };
        if self.unevenness == 0.0 {
            return at(1.0);
        }
        let mut sum = [0.0; 3];
        for (factor, weight) in self.thicknesses() {
            for (total, value) in sum.iter_mut().zip(at(factor)) {
                *total += weight * value;
            }
        }
        sum
    }

    /// Thicknesses relative to the mean, with their quadrature weights.
    fn thicknesses(&self) -> [(f64, f64); 3] {
        let sd = self.unevenness;
        let z = 3f64.sqrt();
        [(-z, 1.0 / 6.0), (0.0, 2.0 / 3.0), (z, 1.0 / 6.0)]
            .map(|(z, weight)| ((sd * z - 0.5 * sd * sd).exp(), weight))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::optics::Specular;

    #[test]
    fn slopes_agree_with_difference_quotients() {
        let surface = Surface::new(0.03, 0.5, Specular::Included).unwrap();
        for unevenness in [0.0, 0.4] {
            let film = UnevenFilm { surface, unevenness };
            for k in [1e-4, 0.02, 0.7, 5.0] {
                for s in [1e-4, 0.03, 0.9, 6.0] {
                    for g in [0.0, 0.1, 0.9] {
                        let [value, over_k, over_s] = film.reflectance_with_slopes(k, s, g);
                        assert!((value - film.reflectance(k, s, g)).abs() < 1e-12, "{k} {s} {g}");
                        let h = 1e-6;
                        let by_k = quotient(
                            h,
                            film.reflectance(k * (1.0 - h), s, g),
                            film.reflectance(k * (1.0 + h), s, g),
                        );
                        let by_s = quotient(
                            h,
                            film.reflectance(k, s * (1.0 - h), g),
                            film.reflectance(k, s * (1.0 + h), g),
                        );
                        assert!((by_k - k * over_k).abs() < 1e-8, "{k} {s} {g}: {by_k}");
                        assert!((by_s - s * over_s).abs() < 1e-8, "{k} {s} {g}: {by_s}");
                    }
                }
            }
        }
    }

    fn quotient(h: f64, low: f64, high: f64) -> f64 {
        (high - low) / (2.0 * h)
    }
}
