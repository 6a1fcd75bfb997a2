//! The optical data that rendering reads: K and S, surface and lamp at eight wavelengths, in f32.
//!
//! This is the only place where we convert the library's f64 to the f32 of painting.

use pigment::quadrature::{EffectiveQuadrature, Quadrature};
use spectra::{Grid, optics::Surface};

use crate::amount::QUANTA_PER_CELL;
use crate::layer::{SLOTS, Slots};

/// Number of wavelengths that represent the spectrum: the nodes of a
/// [`pigment::quadrature::Quadrature`].
pub const NODES: usize = 8;

/// K and S of the pigments of one layer at the eight wavelengths, per quantum of height
/// and multiplied by the layer's opacity. 0 for empty slots.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LayerOptics {
    /// Absorption K per quantum, by slot and wavelength.
    pub absorption: [[f32; NODES]; SLOTS],
    /// Scattering S per quantum, by slot and wavelength.
    pub scattering: [[f32; NODES]; SLOTS],
    /// Shares of a cell that a quantum covers, see [`covers`].
    pub covers: [f32; SLOTS + 1],
}

impl LayerOptics {
    /// Optics of a layer without pigments.
    pub const EMPTY: Self = Self {
        absorption: [[0.0; NODES]; SLOTS],
        scattering: [[0.0; NODES]; SLOTS],
        covers: [1.0; SLOTS + 1],
    };
}

/// A cell with this height of vehicle in mm has an even film, however little pigment is in it. We chose it by eye.
pub const LEVELLING_MM: f64 = 0.01;

/// Share of its cell, 0 to 1, that a quantum covers: for the paint of each slot, and last for vehicle. Where the
/// shares of a cell sum to 1 or more, the film covers all of it. `least_films` holds the thickness at which the film of
/// each pigment does so ([`pigment::thin_films::least_films`]), 0 for films that are even however thin they are.
/// `thickness_per_quantum` comes from [`thickness_per_quantum`], and `cell_mm` is the width of a cell.
#[must_use]
pub fn covers(
    slots: &Slots,
    least_films: &[f64],
    thickness_per_quantum: f64,
    cell_mm: f64,
) -> [f64; SLOTS + 1] {
    let vehicle = cell_mm / f64::from(QUANTA_PER_CELL) / LEVELLING_MM;
    let mut covers = [vehicle.min(1.0); SLOTS + 1];
    for (share, slot) in covers.iter_mut().zip(slots) {
        let least = slot.map_or(0.0, |pigment| least_films[pigment.index()]);
        *share = (thickness_per_quantum / least).min(1.0);
    }
    covers
}

/// Specular highlight of one material (Blinn 1977).
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Gloss {
    /// Light of the highlight relative to a perfect white, at no ambient light. 0 and up.
    pub strength: f32,
    /// Blinn's exponent. For example, 10 is satin and 100 is the gloss of wet paint.
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
    /// Linear sRGB of a reflectance of 1 at one wavelength and 0 at the others, by wavelength. They
    /// sum to (1, 1, 1), the colour of the perfect diffuser.
    pub rgb_from_nodes: [[f32; 3]; NODES],
    /// Direction of the light, relief and gloss.
    pub lamp: Lamp,
    /// Width and height of a cell in mm, above 0. Shading needs this to find the surface within
    /// some tenths of a mm.
    pub cell_mm: f32,
}

/// The surface between paint and air in f32 (Saunderson 1942). See
/// [`spectra::optics::Surface`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SceneSurface {
    /// Share of the arriving light that the surface reflects, 0 to 1.
    pub k1: f32,
    /// Share of the diffuse light inside that the surface reflects back, 0 to 1.
    pub k2: f32,
    /// Surface reflection that the measured reflectance includes. If the readings include the
    /// specular component, this is k1, else 0.
    pub specular: f32,
}

/// Thickness of one quantum in the library's unit. `cell_mm` is the width of a cell in
/// mm, `scattering_per_mm` the S of the reference white per mm.
#[must_use]
pub fn thickness_per_quantum(cell_mm: f64, scattering_per_mm: f64) -> f64 {
    cell_mm / f64::from(QUANTA_PER_CELL) * scattering_per_mm
}

/// Samples a spectrum, `values` on `grid`, at the quadrature's nodes and multiplies it
/// by `scale`.
///
/// # Panics
/// If the quadrature does not have [`NODES`] nodes.
#[must_use]
pub fn at_nodes(quadrature: &Quadrature, grid: Grid, values: &[f64], scale: f64) -> [f32; NODES] {
    scaled(&quadrature.at_nodes(grid, values), scale)
}

/// Values at the nodes times `scale`.
///
/// # Panics
/// If there are not [`NODES`] values.
#[must_use]
pub(crate) fn scaled(at_nodes: &[f64], scale: f64) -> [f32; NODES] {
    assert_eq!(at_nodes.len(), NODES, "painting needs a quadrature of {NODES} nodes");
    std::array::from_fn(|i| (at_nodes[i] * scale) as f32)
}

/// Computes K and S of a layer per quantum. `slots` holds pigments of the library that
/// `quadrature` was made for, `thickness_per_quantum` comes from [`thickness_per_quantum`],
/// and `opacity` multiplies all K and S (1 leaves them as measured). The films are even.
///
/// # Panics
/// If a slot holds a pigment that the quadrature lacks, or if the quadrature does not have
/// [`NODES`] nodes.
#[must_use]
pub fn layer_optics(
    slots: &Slots,
    quadrature: &EffectiveQuadrature,
    thickness_per_quantum: f64,
    opacity: f64,
) -> LayerOptics {
    let [absorption, scattering] = [&quadrature.absorption, &quadrature.scattering].map(|curves| {
        slots.map(|slot| match slot {
            Some(pigment) => scaled(&curves[pigment.index()], thickness_per_quantum * opacity),
            None => [0.0; NODES],
        })
    });
    LayerOptics { absorption, scattering, covers: [1.0; SLOTS + 1] }
}

/// Converts the surface of a library's films to f32.
#[must_use]
pub fn scene_surface(surface: &Surface) -> SceneSurface {
    let Surface { k1, k2, .. } = *surface;
    SceneSurface { k1: k1 as f32, k2: k2 as f32, specular: surface.floor() as f32 }
}
