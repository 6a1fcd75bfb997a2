//! The optical data that rendering reads: K and S, surface and lamp at eight
//! wavelengths, in f32.

use crate::layer::SLOTS;

/// Number of wavelengths that represent the spectrum: the nodes of a
/// [`pigment::quadrature::Quadrature`].
pub const NODES: usize = 8;

/// K and S of the pigments of one layer at the eight wavelengths, per quantum of height
/// and multiplied by the layer's opacity; 0 for empty slots.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LayerOptics {
    /// Absorption K per quantum, by slot and wavelength.
    pub absorption: [[f32; NODES]; SLOTS],
    /// Scattering S per quantum, by slot and wavelength.
    pub scattering: [[f32; NODES]; SLOTS],
}

/// Specular highlight of one material (Blinn 1977).
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Gloss {
    /// Light of the highlight relative to a perfect white, at no ambient light; 0 and up.
    pub strength: f32,
    /// Blinn's exponent; 10 is satin, 100 the gloss of wet paint.
    pub exponent: f32,
}

/// The lamp, and how relief and gloss respond to it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lamp {
    /// Unit vector towards the light: x right, y down, z to the viewer.
    pub direction: [f32; 3],
    /// Factor on the heights of the surface: 0 renders it flat, 1 as it is.
    pub relief: f32,
    /// Share of the light that is ambient, 0 to 1.
    pub ambient: f32,
    /// Gloss of wet paint.
    pub wet: Gloss,
    /// Gloss of dry paint.
    pub dry: Gloss,
    /// Gloss of the bare ground.
    pub ground: Gloss,
}

/// Everything that turns amounts of paint into linear light.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// Internal reflectance of the ground at the eight wavelengths, 0 to 1.
    pub ground: [f32; NODES],
    /// K and S of the dry layers, lowest first.
    pub dry: Vec<LayerOptics>,
    /// K and S of the wet layer.
    pub wet: LayerOptics,
    /// The surface between paint and air.
    pub surface: SceneSurface,
    /// Linear sRGB of a reflectance of 1 at one wavelength and 0 at the others, by
    /// wavelength. The sum, for the perfect diffuser, is (1, 1, 1).
    pub rgb_from_nodes: [[f32; 3]; NODES],
    /// Direction of the light, relief and gloss.
    pub lamp: Lamp,
    /// Width and height of a cell in mm, above 0: shading looks some tenths of a mm far.
    pub cell_mm: f32,
}

/// The surface between paint and air in f32 (Saunderson 1942); see
/// [`spectra::optics::Surface`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SceneSurface {
    /// Share of the arriving light that the surface reflects, 0 to 1.
    pub k1: f32,
    /// Share of the diffuse light inside that the surface reflects back, 0 to 1.
    pub k2: f32,
    /// Surface reflection included in the measured reflectance: k1 where the readings
    /// include the specular component, else 0.
    pub specular: f32,
}
