//! From a painting at rest to what is seen: the numbers of a [`Scene`], the
//! picture without a backend, and the exact spectrum of every cell.

mod picture;

mod spectral;

pub use picture::picture;
pub use spectral::{Films, Spectral};

use crate::document::{Document, Ground, Lighting, Medium, Slots};
use crate::light::Light;
use crate::node_pigments::{at_nodes, layer_optics, scene_surface, thickness_per_quantum};
use crate::optics::{Lamp, Scene};
use pigment::library::PigmentLibrary;

/// The lowest that a lamp may stand, in degrees; colours are told relative to
/// what a level surface gets, which at 0 is nothing.
const LOWEST_DEG: f64 = 1.0;

/// What of a painting decides how its paint is seen; all but the paint.
#[derive(Debug, Clone, Copy)]
pub struct Appearance<'a> {
    /// The pigments that slots name.
    pub library: &'a PigmentLibrary,
    /// The binder.
    pub medium: &'a Medium,
    /// What is painted on.
    pub ground: &'a Ground,
    /// Width and height of a cell in mm.
    pub cell_mm: f64,
    /// Pigments and opacity of the dry layers, lowest first.
    pub dry: &'a [(Slots, f64)],
    /// The pigments of the wet layer.
    pub slots: &'a Slots,
    /// Where the light stands.
    pub lighting: &'a Lighting,
}

/// All that turns the paint of `document` into linear light under `light`.
///
/// `light` must be made for the document's library. A ground darker than the
/// surface's own reflection counts as black below it.
#[must_use]
pub fn scene(document: &Document, light: &Light) -> Scene {
    let dry: Vec<_> = document.dry.iter().map(|layer| (layer.slots, layer.opacity)).collect();
    Appearance::of(document, &dry).scene(light)
}

impl<'a> Appearance<'a> {
    /// That of a painting at rest, whose dry layers have the pigments and
    /// opacities `dry`.
    pub(super) fn of(document: &'a Document, dry: &'a [(Slots, f64)]) -> Self {
        let Document { library, medium, ground, cell_mm, slots, lighting, .. } = document;
        Self { library, medium, ground, cell_mm: *cell_mm, dry, slots, lighting }
    }

    /// The same of a painting at work.
    #[must_use]
    pub fn scene(&self, light: &Light) -> Scene {
        let Self { library, medium, ground, lighting, .. } = *self;
        let thickness = thickness_per_quantum(self.cell_mm, medium.scattering_per_mm);
        let optics =
            |slots, opacity| layer_optics(library, slots, &light.quadrature, thickness, opacity);
        let below = internal_ground(library, &ground.reflectance);
        Scene {
            ground: at_nodes(&light.quadrature, library.grid, &below, 1.0),
            dry: self.dry.iter().map(|(slots, opacity)| optics(slots, *opacity)).collect(),
            wet: optics(self.slots, 1.0),
            surface: scene_surface(&library.saunderson),
            rgb_from_nodes: light.rgb_from_nodes,
            lamp: Lamp {
                direction: direction(lighting),
                relief: lighting.relief as f32,
                ambient: lighting.ambient as f32,
                wet: medium.wet,
                dry: medium.dry,
                ground: ground.gloss,
            },
        }
    }
}

/// The reflectance below the surface of a ground that measures `reflectance`.
fn internal_ground(library: &PigmentLibrary, reflectance: &[f64]) -> Vec<f64> {
    let internal = |&measured: &f64| {
        library.saunderson.internal_from_measured(measured).unwrap_or(0.0).min(1.0)
    };
    reflectance.iter().map(internal).collect()
}

/// The unit vector towards the lamp: x right, y down, z to the viewer.
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
