//! The reflectance of every cell by wavelength, in f64: what eight wavelengths
//! stand for, for tests and for spectral files.

use calibrate::evaluate::Viewing;
use calibrate::quadrature::Quadrature;
use rayon::prelude::*;
use spectra::color::Xyz;
use spectra::optics::{Layer as Film, Surface};

use super::internal_ground;
use crate::field::Field;
use crate::layer::{Layer, SLOTS};
use crate::paint::document::{Document, Slots};
use crate::palette::thickness_per_quantum;

/// A painting as a stack of films over its ground, lit flat: no relief, no gloss.
#[derive(Debug, Clone)]
pub struct Spectral<'a> {
    document: &'a Document,
    surface: Surface,
    /// Internal reflectance of the ground.
    ground: Vec<f64>,
    /// The layers, lowest first.
    films: Vec<(&'a Layer, Optics)>,
}

/// K and S for one quantum, by wavelength and slot.
type Optics = Vec<[[f64; 2]; SLOTS]>;

impl<'a> Spectral<'a> {
    /// On all wavelengths of the painting's library.
    #[must_use]
    pub fn full(document: &'a Document) -> Self {
        Self::new(document, |values| values.to_vec())
    }

    /// At the wavelengths of `quadrature`.
    #[must_use]
    pub fn at_nodes(document: &'a Document, quadrature: &Quadrature) -> Self {
        Self::new(document, |values| quadrature.at_nodes(document.library.grid, values))
    }

    fn new(document: &'a Document, at: impl Fn(&[f64]) -> Vec<f64>) -> Self {
        let library = &document.library;
        let thickness = thickness_per_quantum(document.cell_mm, document.medium.scattering_per_mm);
        let ground = at(&internal_ground(library, &document.ground.reflectance));
        let optics = |slots: &Slots, opacity: f64| {
            let mut optics = vec![[[0.0; 2]; SLOTS]; ground.len()];
            for (slot, index) in slots.iter().enumerate() {
                let Some(index) = *index else { continue };
                let pigment = &library.pigments[index];
                let both = at(&pigment.absorption).into_iter().zip(at(&pigment.scattering));
                for (optics, (k, s)) in optics.iter_mut().zip(both) {
                    optics[slot] = [k, s].map(|v| v * thickness * opacity);
                }
            }
            optics
        };
        let dry = document.dry.iter();
        let dry = dry.map(|layer| (&layer.paint, optics(&layer.slots, layer.opacity)));
        let wet = std::iter::once((&document.wet, optics(&document.slots, 1.0)));
        let films = dry.chain(wet).collect();
        Self { document, surface: library.saunderson, ground, films }
    }

    /// How many wavelengths.
    #[must_use]
    pub fn count(&self) -> usize {
        self.ground.len()
    }

    /// Reflectance of the cell at column `x` of row `y` as an instrument would
    /// measure it, by wavelength.
    #[must_use]
    pub fn measured_reflectance(&self, x: usize, y: usize) -> Vec<f64> {
        let index = y * self.document.wet.width() + x;
        let mut internal = self.ground.clone();
        for (layer, optics) in &self.films {
            let amounts = layer.cell(index).pigments.map(f64::from);
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

    /// The same of all cells of row `y`, on all cores.
    #[must_use]
    pub fn measured_row(&self, y: usize) -> Vec<Vec<f64>> {
        let columns = (0..self.document.wet.width()).into_par_iter();
        columns.map(|x| self.measured_reflectance(x, y)).collect()
    }

    /// XYZ (Y of the white 100) of every cell under `viewing`; of a painting on
    /// all wavelengths ([`Spectral::full`]).
    ///
    /// # Panics
    /// If it stands on other wavelengths than its library.
    #[must_use]
    pub fn xyz(&self, viewing: &Viewing) -> Field<Xyz> {
        let weights = viewing.weights(self.document.library.grid);
        let weights = weights.expect("the method fits the grid");
        let (width, height) = (self.document.wet.width(), self.document.wet.height());
        let cells = (0..width * height).into_par_iter();
        let xyz = cells.map(|i| weights.xyz(&self.measured_reflectance(i % width, i / width)));
        Field::from_values(width, height, xyz.collect())
    }
}
