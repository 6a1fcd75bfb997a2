//! Chart of the spectral power of lights.

use eframe::egui::{Color32, Ui, vec2};
use paint::light::Light;
use spectra::Illuminant;

use crate::chart::{BAND_NM, Chart, Curve};
use crate::language::{tr, tr_format};

/// Distance of the points of a curve, in nm.
const STEP_NM: usize = 2;

/// Heights of the chart in a low and in a high panel, in points.
const LOW: f32 = 76.0;
const HIGH: f32 = 120.0;

/// Height from which a panel is high, in points.
const ROOMY: f32 = 520.0;

/// Draws the current light with its quadrature wavelengths, and other lights in their
/// colours. All curves are scaled to mean 1.
pub(in crate::panels) fn power_chart(ui: &mut Ui, light: &Light, others: &[(Illuminant, Color32)]) {
    let mut curves: Vec<Curve> =
        others.iter().map(|(other, color)| curve(other, Some(*color))).collect();
    curves.push(curve(&light.viewing.illuminant, None));
    let marks = &light.quadrature.rule.nodes_nm;
    let chart = Chart { curves: &curves, marks, quantity: tr("relative power"), max: None };
    let nodes: Vec<String> = marks.iter().map(|nm| format!("{nm:.0}")).collect();
    // In a low panel the chart leaves its room to the controls.
    let high = if ui.clip_rect().height() < ROOMY { LOW } else { HIGH };
    let size = vec2(ui.available_width(), high);
    chart.show(ui, size).on_hover_text(tr_format!(
        "Power over wavelength, mean 1. Paint is computed at {nodes} nm",
        nodes = nodes.join(", ")
    ));
}

fn curve(light: &Illuminant, color: Option<Color32>) -> Curve {
    let grid = light.power().grid();
    let shown = |point: &(f64, f64)| BAND_NM.contains(&point.0);
    let values = light.power().values().iter().copied();
    let mut points: Vec<(f64, f64)> = grid.wavelengths_nm().zip(values).filter(shown).collect();
    let mean = points.iter().map(|point| point.1).sum::<f64>() / points.len().max(1) as f64;
    points = points.into_iter().step_by(STEP_NM).map(|(nm, power)| (nm, power / mean)).collect();
    Curve { name: light.name().to_owned(), points, color }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_curve_is_scaled_to_mean_one() {
        let light = Illuminant::d65();
        let shown = curve(&light, None);
        let power = |nm: f64| light.power().values()[(nm - 360.0) as usize];
        let first = shown.points[0];
        let last = *shown.points.last().unwrap();
        assert_eq!((first.0, last.0), (380.0, 730.0));
        let ratio = first.1 / last.1;
        assert!((ratio - power(380.0) / power(730.0)).abs() < 1e-12, "{ratio}");
        let mean = shown.points.iter().map(|point| point.1).sum::<f64>() / 176.0;
        assert!((mean - 1.0).abs() < 0.01, "{mean}");
    }
}
