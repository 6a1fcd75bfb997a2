//! Reflectance of every cell by wavelength in f64: the reference for the eight
//! wavelengths of the engine, used for spectral files and the eyedropper; and which paint is seen.

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

    /// Part of the ground, then of each layer, in what is seen of a column of paint: sum 1.
    ///
    /// A film hides the part of the contrast between a white and a black below it that is lost, at each
    /// wavelength; all wavelengths count alike. What it does not hide is left to the films below it.
    pub fn seen(&self, pigments: impl IntoIterator<Item = [u32; SLOTS]>) -> Vec<f64> {
        let columns: Vec<[f64; SLOTS]> =
            pigments.into_iter().map(|amounts| amounts.map(f64::from)).collect();
        let mut parts = vec![0.0; columns.len() + 1];
        let mut rest = vec![1.0; self.count()];
        for (index, (amounts, optics)) in columns.iter().zip(&self.optics).enumerate().rev() {
            for (rest, optics) in rest.iter_mut().zip(optics) {
                let sum = |part: usize| amounts.iter().zip(optics).map(|(a, o)| a * o[part]).sum();
                let film = Film::new(sum(0), sum(1), 1.0);
                let passed = *rest * (film.over(1.0) - film.over(0.0)).clamp(0.0, 1.0);
                parts[index + 1] += *rest - passed;
                *rest = passed;
            }
        }
        parts[0] = rest.iter().sum();
        let count = self.count().max(1) as f64;
        parts.into_iter().map(|part| part / count).collect()
    }
}

/// Which paint shows at a cell.
#[derive(Debug, Clone, PartialEq)]
pub struct SeenPaint {
    /// Part of the ground, 0 where the paint hides it.
    pub ground: f64,
    /// Part of each layer, lowest first, the wet layer last. With the ground they sum to 1.
    pub layers: Vec<f64>,
    /// Part of each pigment of the library. With the ground they sum to 1.
    pub pigments: Vec<f64>,
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

    /// Paint that shows at the cell in column `x` and row `y`: each layer by what it hides of those below
    /// (see [`SpectralStack::seen`]), each pigment by its part of the layer's paint, by volume.
    #[must_use]
    pub fn seen(&self, x: usize, y: usize) -> SeenPaint {
        let parts = self.stack.seen(self.layers.iter().map(|layer| layer.pigments[(x, y)]));
        let mut pigments = vec![0.0; self.document.library.pigments.len()];
        let dry = self.document.dry.iter().map(|layer| &layer.slots);
        let slots = dry.chain([&self.document.slots]);
        for ((layer, slots), part) in self.layers.iter().zip(slots).zip(&parts[1..]) {
            let amounts = layer.pigments[(x, y)];
            let all: f64 = amounts.iter().map(|&amount| f64::from(amount)).sum();
            for (amount, pigment) in amounts.iter().zip(slots) {
                if let Some(pigment) = pigment
                    && *amount > 0
                {
                    pigments[pigment.index()] += part * f64::from(*amount) / all;
                }
            }
        }
        SeenPaint { ground: parts[0], layers: parts[1..].to_vec(), pigments }
    }

    /// Measured reflectance of all cells as 32-bit planes, one per wavelength. Rows are
    /// computed on all CPU cores. After each row `go_on` is called with the number of rows
    /// done; if it returns `false`, the result is `None`.
    pub fn planes(&self, mut go_on: impl FnMut(usize) -> bool) -> Option<Vec<Field<f32>>> {
        let width = self.document.wet.width();
        let height = self.document.wet.height();
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
