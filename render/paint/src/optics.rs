//! What light needs to know of paint: eight wavelengths, in f32.

use crate::layer::SLOTS;

/// How many wavelengths stand for the spectrum.
pub const NODES: usize = 8;

/// K and S of a layer's pigments at the eight wavelengths, each for one quantum
/// of height and times the layer's optical thickness; 0 for empty slots.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Coat {
    /// K by slot and wavelength.
    pub absorption: [[f32; NODES]; SLOTS],
    /// S by slot and wavelength.
    pub scattering: [[f32; NODES]; SLOTS],
}

/// Mirror reflection of one surface (Blinn 1977).
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Gloss {
    /// Linear light of the highlight, as a share of a perfect white, where no
    /// light is ambient; 0 and up.
    pub strength: f32,
    /// The exponent: 10 is satin, 100 a wet gloss.
    pub exponent: f32,
}

/// Where the light comes from and how the surface takes it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lamp {
    /// Unit vector towards the light: x right, y down, z to the viewer.
    pub direction: [f32; 3],
    /// How much the relief counts: 0 flat, 1 as it is.
    pub relief: f32,
    /// Share of the light that comes from all sides, 0..1.
    pub ambient: f32,
    /// Of wet paint.
    pub wet: Gloss,
    /// Of dry paint.
    pub dry: Gloss,
    /// Of the bare ground.
    pub ground: Gloss,
}

/// All that turns amounts of paint into linear light.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// Internal reflectance of the ground at the wavelengths.
    pub ground: [f32; NODES],
    /// The dry layers, lowest first.
    pub dry: Vec<Coat>,
    /// The wet layer.
    pub wet: Coat,
    /// Saunderson's shares, and what the surface itself sends to the eye (k1
    /// where the readings hold the mirror reflection, else 0).
    pub surface: SceneSurface,
    /// Linear sRGB of a unit reflectance at each wavelength; a perfect diffuse
    /// is (1, 1, 1).
    pub rgb_from_nodes: [[f32; 3]; NODES],
    /// Direction, relief and gloss.
    pub lamp: Lamp,
}

/// The surface between paint and air, see `spectra::optics::Surface`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SceneSurface {
    /// Share of the arriving light reflected.
    pub k1: f32,
    /// Share of the diffuse light turned back inside.
    pub k2: f32,
    /// Share of white light that the surface adds to what is seen.
    pub floor: f32,
}
