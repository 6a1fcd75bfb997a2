//! The white point of a light in numbers.

use std::sync::Arc;

use render::light::Light;
use spectra::ColorTemperature;

/// Chromaticity and correlated colour temperature of a light.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct White {
    light: Arc<Light>,
    /// CIE x, y for the light's observer.
    pub(super) chromaticity: [f64; 2],
    /// Correlated colour temperature, if defined.
    pub(super) temperature: Option<ColorTemperature>,
}

impl White {
    /// Computes the white point of `light`.
    pub(super) fn of(light: &Arc<Light>) -> Self {
        let white = light.quadrature.rule.white;
        let xyy = white.to_xyy(white);
        Self {
            light: Arc::clone(light),
            chromaticity: [xyy.x, xyy.y],
            temperature: ColorTemperature::of(&light.viewing.illuminant),
        }
    }

    /// Whether this was computed for the same `light` object.
    pub(super) fn is_of(&self, light: &Arc<Light>) -> bool {
        Arc::ptr_eq(&self.light, light)
    }

    /// Formats the chromaticity: `x 0.3127  y 0.3290`.
    pub(super) fn chromaticity_text(&self) -> String {
        let [x, y] = self.chromaticity;
        format!("x {x:.4}  y {y:.4}")
    }

    /// Formats the temperature: `6504 K  Duv +0.0032`.
    pub(super) fn temperature_text(&self) -> String {
        self.temperature.map_or_else(
            || "none: too far from any black body".to_owned(),
            |temperature| format!("{:.0} K  Duv {:+.4}", temperature.kelvin, temperature.duv),
        )
    }
}
