//! Reflectance of every cell by wavelength in f64: the reference for the eight
//! wavelengths of the engine, used for spectral files and the eyedropper.

use pigment::PigmentId;
use pigment::quadrature::EffectiveQuadrature;
use rayon::prelude::*;
use spectra::optics::{Layer as Film, Surface};

use super::appearance::{Appearance, internal_ground};
use crate::document::{Document, Slots};
use crate::layer::{Layer, SLOTS};
use crate::node_pigments::thickness_per_quantum;
use graphics::field::Field;

/// Optics of a stack of layers over a ground, by wavelength, without relief and gloss.
#[derive(Debug, Clone)]
pub struct SpectralStack {
    surface: Surface,
    /// Internal reflectance of the ground, by wavelength.
    ground: Vec<f64>,
    /// K and S of the layers, lowest first, the wet layer last.
    optics: Vec<Optics>,
}

/// K and S per quantum, by wavelength and slot.
type Optics = Vec<[[f64; 2]; SLOTS]>;

impl SpectralStack {
    /// The stack at all wavelengths of the library.
    #[must_use]
    pub fn full(appearance: &Appearance<'_>) -> Self {
        let library = appearance.library;
        Self::new(
            appearance,
            |ground| ground,
            |pigment| [&library[pigment].absorption, &library[pigment].scattering],
        )
    }

    /// The stack at the nodes of `quadrature`.
    fn at_nodes(appearance: &Appearance<'_>, quadrature: &EffectiveQuadrature) -> Self {
        let grid = appearance.library.grid;
        Self::new(
            appearance,
            |ground| quadrature.rule.at_nodes(grid, &ground),
            |pigment| {
                [&quadrature.absorption, &quadrature.scattering]
                    .map(|curves| &curves[pigment.index()])
            },
        )
    }

    fn new<'a>(
        appearance: &Appearance<'_>,
        ground_at: impl Fn(Vec<f64>) -> Vec<f64>,
        curves: impl Fn(PigmentId) -> [&'a Vec<f64>; 2],
    ) -> Self {
        let Appearance { library, medium, cell_mm, .. } = *appearance;
        let thickness = thickness_per_quantum(cell_mm, medium.scattering_per_mm);
        let ground = ground_at(internal_ground(library, &appearance.ground.reflectance));
        let optics = |slots: &Slots, opacity: f64| {
            let mut optics = vec![[[0.0; 2]; SLOTS]; ground.len()];
            for (slot, pigment) in slots.iter().enumerate() {
                let Some(pigment) = *pigment else { continue };
                let [absorption, scattering] = curves(pigment);
                let both = absorption.iter().zip(scattering);
                for (optics, (&k, &s)) in optics.iter_mut().zip(both) {
                    optics[slot] = [k, s].map(|v| v * thickness * opacity);
                }
            }
            optics
        };
        let dry = appearance.dry.iter().map(|(slots, opacity)| optics(slots, *opacity));
        let optics = dry.chain([optics(appearance.slots, 1.0)]).collect();
        Self { surface: library.saunderson, ground, optics }
    }

    /// Number of wavelengths.
    #[must_use]
    pub fn count(&self) -> usize {
        self.ground.len()
    }

    /// Measured reflectance (0..1) by wavelength of a column of paint, given the quanta of
    /// each pigment in each layer, lowest first.
    pub fn measured_reflectance(
        &self,
        pigments: impl IntoIterator<Item = [u32; SLOTS]>,
    ) -> Vec<f64> {
        let mut internal = self.ground.clone();
        for (amounts, optics) in pigments.into_iter().zip(&self.optics) {
            let amounts = amounts.map(f64::from);
            if amounts == [0.0; SLOTS] {
                continue;
            }
            for (reflectance, optics) in internal.iter_mut().zip(optics) {
                let mut sum = [0.0; 2];
                for (amount, [k, s]) in amounts.iter().zip(optics) {
                    sum[0] += amount * k;
                    sum[1] += amount * s;
                }
                *reflectance = Film::new(sum[0], sum[1], 1.0).over(*reflectance);
            }
        }
        internal.into_iter().map(|r| self.surface.measured_from_internal(r)).collect()
    }
}

/// A document whose reflectance can be computed cell by cell.
#[derive(Debug, Clone)]
pub struct SpectralDocument<'a> {
    document: &'a Document,
    stack: SpectralStack,
    /// Layers, lowest first.
    layers: Vec<&'a Layer>,
}

impl<'a> SpectralDocument<'a> {
    /// Reflectance at all wavelengths of the document's library.
    #[must_use]
    pub fn full(document: &'a Document) -> Self {
        Self::new(document, SpectralStack::full)
    }

    /// Reflectance at the nodes of `quadrature`, as pictures are computed. With K and S that stand
    /// for bands, it is near the reflectance at these wavelengths, but has the colour of the whole.
    #[must_use]
    pub fn at_nodes(document: &'a Document, quadrature: &EffectiveQuadrature) -> Self {
        Self::new(document, |appearance| SpectralStack::at_nodes(appearance, quadrature))
    }

    fn new(document: &'a Document, stack: impl Fn(&Appearance<'_>) -> SpectralStack) -> Self {
        let dry: Vec<_> =
            document.dry.iter().map(|layer| (layer.slots, layer.shown_opacity())).collect();
        let stack = stack(&Appearance::of(document, &dry));
        let layers = document.dry.iter().map(|layer| &layer.paint).chain([&document.wet]);
        Self { document, stack, layers: layers.collect() }
    }

    /// Number of wavelengths.
    #[must_use]
    pub fn count(&self) -> usize {
        self.stack.count()
    }

    /// Measured reflectance (0..1) by wavelength of the cell in column `x` and row `y`.
    #[must_use]
    pub fn measured_reflectance(&self, x: usize, y: usize) -> Vec<f64> {
        self.stack.measured_reflectance(self.layers.iter().map(|layer| layer.pigments[(x, y)]))
    }

    /// Measured reflectance of all cells as 32-bit planes, one per wavelength. Rows are
    /// computed on all CPU cores. After each row `go_on` is called with the number of rows
    /// done; if it returns `false`, the result is `None`.
    pub fn planes(&self, mut go_on: impl FnMut(usize) -> bool) -> Option<Vec<Field<f32>>> {
        let (width, height) = (self.document.wet.width(), self.document.wet.height());
        let mut planes = vec![Field::filled(width, height, 0.0); self.count()];
        for y in 0..height {
            let columns = (0..width).into_par_iter();
            let row: Vec<Vec<f64>> = columns.map(|x| self.measured_reflectance(x, y)).collect();
            for (x, spectrum) in row.into_iter().enumerate() {
                for (plane, value) in planes.iter_mut().zip(spectrum) {
                    plane[(x, y)] = value as f32;
                }
            }
            if !go_on(y + 1) {
                return None;
            }
        }
        Some(planes)
    }
}
