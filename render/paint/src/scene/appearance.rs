//! Everything except the paint itself that decides how a painting looks, and the parameters
//! of its [`Scene`].

use crate::document::{Document, Lighting, Medium, Slots};
use crate::ground::Ground;
use crate::light::Light;
use crate::node_pigments::{at_nodes, layer_optics, scene_surface, thickness_per_quantum};
use crate::optics::{Lamp, Scene};
use pigment::library::PigmentLibrary;

/// Least elevation of the light in degrees. Colours are relative to the light on a level
/// surface, which is 0 at elevation 0.
const LOWEST_DEG: f64 = 1.0;

/// Everything except the paint itself that decides how a painting looks.
#[derive(Debug, Clone, Copy)]
pub struct Appearance<'a> {
    /// Library that the slots refer to.
    pub library: &'a PigmentLibrary,
    /// Binder of the paint.
    pub medium: &'a Medium,
    /// Ground of the painting.
    pub ground: &'a Ground,
    /// Width and height of a cell in mm.
    pub cell_mm: f64,
    /// Pigments and opacity of the dry layers, lowest first.
    pub dry: &'a [(Slots, f64)],
    /// Pigments of the wet layer.
    pub slots: &'a Slots,
    /// Direction and kind of the light.
    pub lighting: &'a Lighting,
}

/// Parameters that convert the paint of `document` to linear sRGB under `light`.
///
/// `light` must have been made for the document's library. A ground darker than its
/// surface reflection counts as black.
#[must_use]
pub fn scene(document: &Document, light: &Light) -> Scene {
    let dry: Vec<_> =
        document.dry.iter().map(|layer| (layer.slots, layer.shown_opacity())).collect();
    Appearance::of(document, &dry).scene(light)
}

impl<'a> Appearance<'a> {
    /// Appearance of a document. `dry` holds the pigments and opacities of its dry layers.
    pub(crate) fn of(document: &'a Document, dry: &'a [(Slots, f64)]) -> Self {
        let Document { library, medium, ground, cell_mm, slots, lighting, .. } = document;
        Self { library, medium, ground, cell_mm: *cell_mm, dry, slots, lighting }
    }

    /// Parameters that convert paint to linear sRGB under `light`, see [`scene`].
    #[must_use]
    pub fn scene(&self, light: &Light) -> Scene {
        let Self { library, medium, ground, lighting, .. } = *self;
        let thickness = thickness_per_quantum(self.cell_mm, medium.scattering_per_mm);
        let optics = |slots, opacity| layer_optics(slots, &light.quadrature, thickness, opacity);
        let below = internal_ground(library, &ground.reflectance);
        Scene {
            ground: at_nodes(&light.quadrature.rule, library.grid, &below, 1.0),
            dry: self.dry.iter().map(|(slots, opacity)| optics(slots, *opacity)).collect(),
            wet: optics(self.slots, 1.0),
            surface: scene_surface(&library.saunderson),
            rgb_from_nodes: light.rgb_at_degree(lighting.adaptation),
            lamp: Lamp {
                direction: direction(lighting),
                relief: lighting.relief as f32,
                ambient: lighting.ambient as f32,
                wet: medium.wet,
                dry: medium.dry,
                ground: ground.gloss,
            },
            cell_mm: self.cell_mm as f32,
        }
    }
}

/// Internal reflectance of a ground with the given measured reflectance.
pub(super) fn internal_ground(library: &PigmentLibrary, reflectance: &[f64]) -> Vec<f64> {
    reflectance
        .iter()
        .map(|&measured: &f64| {
            library.saunderson.internal_from_measured(measured).unwrap_or(0.0).min(1.0)
        })
        .collect()
}

/// Unit vector towards the light: x right, y down, z towards the viewer.
fn direction(lighting: &Lighting) -> [f32; 3] {
    let azimuth = lighting.azimuth_deg.to_radians();
    let elevation = lighting.elevation_deg.clamp(LOWEST_DEG, 90.0).to_radians();
    let level = elevation.cos();
    [azimuth.sin() * level, -azimuth.cos() * level, elevation.sin()].map(|v| v as f32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn azimuth_runs_clockwise_from_the_top() {
        let towards = |azimuth_deg, elevation_deg| {
            direction(&Lighting { azimuth_deg, elevation_deg, ..Lighting::default() })
        };
        for (azimuth, elevation, wanted) in [
            (0.0, 45.0, [0.0, -0.5f32.sqrt(), 0.5f32.sqrt()]),
            (90.0, 45.0, [0.5f32.sqrt(), 0.0, 0.5f32.sqrt()]),
            (315.0, 90.0, [0.0, 0.0, 1.0]),
        ] {
            let found = towards(azimuth, elevation);
            for (found, wanted) in found.iter().zip(wanted) {
                assert!((found - wanted).abs() < 1e-6, "{azimuth} {elevation}: {found}");
            }
        }
        assert!(towards(0.0, 0.0)[2] > 0.01, "a lamp at the horizon stays above it");
    }
}
