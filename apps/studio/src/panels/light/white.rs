//! The white point of a light in numbers.

use std::sync::Arc;

use eframe::egui::{Grid, Ui, vec2};
use paint::light::Light;
use spectra::ColorTemperature;

use crate::language::tr;

/// Chromaticity and correlated colour temperature of a light.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::panels) struct White {
    light: Arc<Light>,
    /// CIE x, y for the light's observer.
    pub(super) chromaticity: [f64; 2],
    /// Correlated colour temperature, if defined.
    pub(super) temperature: Option<ColorTemperature>,
}

impl White {
    /// Computes the white point of `light`.
    pub(in crate::panels) fn of(light: &Arc<Light>) -> Self {
        let white = light.quadrature.rule.white;
        let xyy = white.to_xyy(white);
        Self {
            light: Arc::clone(light),
            chromaticity: [xyy.x, xyy.y],
            temperature: ColorTemperature::of(&light.viewing.illuminant),
        }
    }

    /// Whether this was computed for the same `light` object.
    pub(in crate::panels) fn is_of(&self, light: &Arc<Light>) -> bool {
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
            || tr("none: too far from any black body").to_owned(),
            |temperature| format!("{:.0} K  Duv {:+.4}", temperature.kelvin, temperature.duv),
        )
    }

    /// Draws the white point in two lines.
    pub(in crate::panels) fn show(&self, ui: &mut Ui) {
        Grid::new("white").num_columns(2).spacing(vec2(10.0, 2.0)).show(ui, |ui| {
            ui.weak(tr("White")).on_hover_text(tr("Chromaticity of the light for the observer"));
            ui.monospace(self.chromaticity_text());
            ui.end_row();
            ui.weak(tr("Looks like")).on_hover_text(tr(
                "Correlated colour temperature, and distance from the black body of \
                 that temperature: above 0 greener, below 0 pinker",
            ));
            ui.monospace(self.temperature_text());
            ui.end_row();
        });
    }
}
