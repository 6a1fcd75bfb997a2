//! Optics of a paint film of finite thickness.
//!
//! Equations 8 and 9 of Baxter, Wendt and Lin 2004 are misprinted (tanh for coth, sinh for
//! 1/sinh, according to the authors' erratum), and the textbook form fails at K = 0 and for
//! thick films. The form used here has no special cases, see `Layer::new`.

/// Reflectance and transmittance of a film without a backing, each 0 to 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Layer {
    /// Fraction of the light that is reflected, the same from both sides.
    pub reflectance: f64,
    /// Fraction of the light that is transmitted, the same in both directions.
    pub transmittance: f64,
}

impl Layer {
    /// A film of the given `thickness` whose paint has the `absorption` K and the `scattering`
    /// S per unit of thickness. All arguments are 0 and up.
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
        let slopes = |y_slope: f64, own: f64| {
            let den_slope = sinh + ((k + s) * sinh_over_y + sinh / 2.0) * y_slope;
            let r_slope = (own * sinh + s * sinh_over_y * y_slope - r * den_slope) / den;
            (r_slope, -t * den_slope / den)
        };
        let (r_over_k, t_over_k) = slopes(2.0 * (k + s), 0.0);
        let (r_over_s, t_over_s) = slopes(2.0 * k, 1.0);
        let q = 1.0 / (1.0 - r * g);
        let by_r = 1.0 + (t * g * q).powi(2);
        let by_t = 2.0 * t * g * q;
        [r + t * t * g * q, by_r * r_over_k + by_t * t_over_k, by_r * r_over_s + by_t * t_over_s]
    }
}
