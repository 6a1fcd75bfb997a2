//! From the library's f64 to the f32 of painting: the one door.

use pigment::library::PigmentLibrary;
use pigment::quadrature::Quadrature;
use spectra::Grid;
use spectra::optics::Surface;

use crate::amount::QUANTA_PER_CELL;
use crate::layer::SLOTS;
use crate::optics::{Coat, NODES, SceneSurface};

/// The thickness, in the library's unit, of one quantum over cells of `cell_mm`,
/// where a millimetre is `scattering_per_mm` thick (the reference white's S).
#[must_use]
pub fn thickness_per_quantum(cell_mm: f64, scattering_per_mm: f64) -> f64 {
    cell_mm / f64::from(QUANTA_PER_CELL) * scattering_per_mm
}

/// The values of a spectrum on `grid` at the quadrature's wavelengths, times
/// `scale`.
///
/// # Panics
/// If the quadrature has not [`NODES`] wavelengths.
#[must_use]
pub fn at_nodes(quadrature: &Quadrature, grid: Grid, values: &[f64], scale: f64) -> [f32; NODES] {
    let at_nodes = quadrature.at_nodes(grid, values);
    assert_eq!(at_nodes.len(), NODES, "painting stands on {NODES} wavelengths");
    std::array::from_fn(|i| (at_nodes[i] * scale) as f32)
}

/// K and S of a layer whose pigments are those of `library` at `slots`, for one
/// quantum of `thickness_per_quantum`; all times `opacity`.
///
/// # Panics
/// If a slot names no pigment of the library, or as [`at_nodes`].
#[must_use]
pub fn coat(
    library: &PigmentLibrary,
    slots: &[Option<usize>; SLOTS],
    quadrature: &Quadrature,
    thickness_per_quantum: f64,
    opacity: f64,
) -> Coat {
    let table = |spectrum: fn(&pigment::library::Pigment) -> &[f64]| {
        slots.map(|slot| match slot {
            Some(index) => {
                let values = spectrum(&library.pigments[index]);
                at_nodes(quadrature, library.grid, values, thickness_per_quantum * opacity)
            }
            None => [0.0; NODES],
        })
    };
    Coat { absorption: table(|p| &p.absorption), scattering: table(|p| &p.scattering) }
}

/// The surface of a library's films.
#[must_use]
pub fn scene_surface(surface: &Surface) -> SceneSurface {
    let Surface { k1, k2, .. } = *surface;
    SceneSurface { k1: k1 as f32, k2: k2 as f32, floor: surface.floor() as f32 }
}
