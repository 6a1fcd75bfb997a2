//! The reflectance of every cell by wavelength, in f64: what eight wavelengths
//! stand for, for tests, for spectral files, and to look at one place.

use pigment::evaluate::Viewing;
use pigment::quadrature::Quadrature;
use rayon::prelude::*;
use spectra::color::Xyz;
use spectra::optics::{Layer as Film, Surface};

use super::{Appearance, internal_ground};
use crate::document::{Document, Slots};
use crate::layer::{Layer, SLOTS};
use crate::node_pigments::thickness_per_quantum;
use graphics::field::Field;

/// What a stack of layers over a ground is made of, by wavelength; lit flat: no
/// relief, no gloss.
#[derive(Debug, Clone)]
pub struct Films {
    surface: Surface,
    /// Internal reflectance of the ground.
    ground: Vec<f64>,
    /// Of the layers, lowest first, the wet one last.
    optics: Vec<Optics>,
}

/// K and S for one quantum, by wavelength and slot.
type Optics = Vec<[[f64; 2]; SLOTS]>;

impl Films {
    /// On all wavelengths of the library.
    #[must_use]
    pub fn full(appearance: &Appearance<'_>) -> Self {
        Self::new(appearance, |values| values.to_vec())
    }

    fn new(appearance: &Appearance<'_>, at: impl Fn(&[f64]) -> Vec<f64>) -> Self {
        let Appearance { library, medium, cell_mm, .. } = *appearance;
        let thickness = thickness_per_quantum(cell_mm, medium.scattering_per_mm);
        let ground = at(&internal_ground(library, &appearance.ground.reflectance));
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
        let dry = appearance.dry.iter().map(|(slots, opacity)| optics(slots, *opacity));
        let optics = dry.chain([optics(appearance.slots, 1.0)]).collect();
        Self { surface: library.saunderson, ground, optics }
    }

    /// How many wavelengths.
    #[must_use]
    pub fn count(&self) -> usize {
        self.ground.len()
    }

    /// Reflectance as an instrument would measure it, by wavelength, of a column
    /// of paint: what each layer holds of each pigment, in quanta, lowest first.
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

/// A painting at rest as films over its ground.
#[derive(Debug, Clone)]
pub struct Spectral<'a> {
    document: &'a Document,
    films: Films,
    /// Lowest first.
    layers: Vec<&'a Layer>,
}

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
        let dry: Vec<_> = document.dry.iter().map(|layer| (layer.slots, layer.opacity)).collect();
        let films = Films::new(&Appearance::of(document, &dry), at);
        let layers = document.dry.iter().map(|layer| &layer.paint).chain([&document.wet]);
        Self { document, films, layers: layers.collect() }
    }

    /// How many wavelengths.
    #[must_use]
    pub fn count(&self) -> usize {
        self.films.count()
    }

    /// Reflectance of the cell at column `x` of row `y` as an instrument would
    /// measure it, by wavelength.
    #[must_use]
    pub fn measured_reflectance(&self, x: usize, y: usize) -> Vec<f64> {
        self.films.measured_reflectance(self.layers.iter().map(|layer| layer.pigments[(x, y)]))
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
