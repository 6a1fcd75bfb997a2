//! K and S of pigments at the quadrature's nodes in f32: the only place where the
//! library's f64 becomes the f32 of painting.

use pigment::quadrature::{EffectiveQuadrature, Quadrature};
use spectra::Grid;
use spectra::optics::Surface;

use crate::amount::QUANTA_PER_CELL;
use crate::layer::Slots;
use crate::optics::{LayerOptics, NODES, SceneSurface};

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
/// `quadrature` was made for, `thickness_per_quantum` is that of [`thickness_per_quantum`],
/// and `opacity` multiplies all K and S (1 leaves them as measured).
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
    let table = |curves: &[Vec<f64>]| {
        slots.map(|slot| match slot {
            Some(pigment) => scaled(&curves[pigment.index()], thickness_per_quantum * opacity),
            None => [0.0; NODES],
        })
    };
    LayerOptics {
        absorption: table(&quadrature.absorption),
        scattering: table(&quadrature.scattering),
    }
}

/// Converts the surface of a library's films to f32.
#[must_use]
pub fn scene_surface(surface: &Surface) -> SceneSurface {
    let Surface { k1, k2, .. } = *surface;
    SceneSurface { k1: k1 as f32, k2: k2 as f32, specular: surface.floor() as f32 }
}
