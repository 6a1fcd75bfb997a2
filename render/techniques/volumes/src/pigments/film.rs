//! The paint of volumes as a film on the surfaces that they hold.
//!
//! The amount of every pigment at a point is the sum over the volumes that hold it, in whole
//! quanta: paint that meets mixes wet in wet. A volume's part depends on the volume and the point
//! only, so it is added where a face of the volume is left and taken away where one is entered
//! behind the point, and everything outside cancels exactly.

use glam::Vec3;
use graphics::field::Field;
use paint::amount::{MAX_COLUMN, QUANTA_PER_CELL};
use paint::layer::{Cell, Layer, SLOTS};
use rayon::prelude::*;

use super::film_profile::FilmProfile;
use super::lattice::{SampleLattice, SampledSurface};
use super::wetted::Wetted;
use crate::containing::Inside;
use crate::volume::Volume;

/// Highest film of one volume, in quanta: 32 widths of a cell of the picture.
const HIGHEST: f64 = (32 * QUANTA_PER_CELL) as f64;

/// Pixels that share the work of one thread at least.
const PIXELS: usize = 8192;

/// The lengths that amounts of paint are measured by.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FilmScale {
    /// Volume of one quantum of a volume's paint in cubic mm.
    pub quantum_mm3: f64,
    /// Length of one unit of the scene in mm.
    pub unit_mm: f64,
    /// Width of a cell of the painting in mm.
    pub cell_mm: f64,
}

/// Heights of eight pigments and, last, of vehicle in quanta of the painting. Sums are modulo 2^32,
/// so partial sums may be negative.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[repr(C)]
pub struct FilmHeights(pub [i32; SLOTS + 1]);

/// The film of one volume.
#[derive(Debug, Clone, Copy)]
pub struct Film {
    /// Where it lies.
    pub wetted: Wetted,
    /// Heights far inside, in quanta of the painting, by slot and of vehicle.
    heights: [f32; SLOTS + 1],
    profile: FilmProfile,
}

impl Film {
    /// The films of all volumes: as high as spreads each volume's paint over the surface that it
    /// holds.
    #[must_use]
    pub fn of_volumes(
        volumes: &[Volume],
        profile: FilmProfile,
        (surface, lattice): (&SampledSurface<'_>, &SampleLattice),
        scale: &FilmScale,
    ) -> Vec<Self> {
        let films = volumes.par_iter().map(|volume| {
            let inside = Inside::of(volume);
            let wetted = Wetted::of(volume, &inside);
            if volume.paint == Cell::default() {
                return Self { wetted, heights: [0.0; SLOTS + 1], profile };
            }
            let area = wetted.film_area(&inside, &profile, surface, lattice);
            Self { wetted, heights: heights(&volume.paint, area, &profile, scale), profile }
        });
        films.collect()
    }

    /// Heights at a place on a surface with this normal, if the volume holds the place: a function
    /// of volume and place alone. None beyond the reach of the volume, and on surfaces that face
    /// away.
    #[must_use]
    #[inline]
    pub fn at(&self, place: Vec3, normal: Vec3) -> Option<FilmHeights> {
        let share = self.wetted.relative_height(&self.profile, place, normal);
        let heights = || self.heights.map(|height| (height * share + 0.5) as i32);
        (share > 0.0).then(|| FilmHeights(heights()))
    }
}

/// Heights in quanta far inside of a film that fills `area`.
fn heights(paint: &Cell, area: f64, profile: &FilmProfile, scale: &FilmScale) -> [f32; SLOTS + 1] {
    if area <= 0.0 {
        return [0.0; SLOTS + 1];
    }
    let mm_per_quantum = scale.quantum_mm3 / (area * scale.unit_mm * scale.unit_mm);
    let per_quantum = mm_per_quantum / scale.cell_mm * f64::from(QUANTA_PER_CELL);
    let whole = f64::from(paint.volume()) * per_quantum * f64::from(profile.most());
    let lowered = per_quantum * (HIGHEST / whole).min(1.0);
    std::array::from_fn(|slot| {
        let quanta = if slot < SLOTS { paint.pigments[slot] } else { paint.vehicle };
        (f64::from(quanta) * lowered) as f32
    })
}

impl FilmHeights {
    /// Adds the heights of a volume that is left (`sign` 1) or entered (-1) behind the point.
    #[inline]
    pub fn add(&mut self, heights: &Self, sign: i32) {
        for (sum, height) in self.0.iter_mut().zip(heights.0) {
            *sum = sum.wrapping_add(height.wrapping_mul(sign));
        }
    }

    /// The paint of a cell with these heights.
    #[must_use]
    #[inline]
    pub fn cell(&self) -> Cell {
        let amount = |slot: usize| self.0[slot].max(0) as u32;
        let cell = Cell { pigments: std::array::from_fn(amount), vehicle: amount(SLOTS) };
        let bits = cell.pigments.iter().fold(cell.vehicle, |bits, amount| bits | amount);
        if bits < MAX_COLUMN / (SLOTS as u32 + 1) {
            return cell;
        }
        let pigments = cell.pigments.iter().map(|&amount| u64::from(amount)).sum::<u64>();
        let whole = u64::from(cell.vehicle) + pigments;
        if whole <= u64::from(MAX_COLUMN) {
            return cell;
        }
        let share = |amount: u32| (u64::from(amount) * u64::from(MAX_COLUMN) / whole) as u32;
        Cell { pigments: cell.pigments.map(share), vehicle: share(cell.vehicle) }
    }

    /// The layer of these films.
    #[must_use]
    pub fn layer(heights: &Field<Self>) -> Layer {
        let mut layer = Layer::empty(heights.width(), heights.height());
        let cells = layer.pigments.values_mut().par_iter_mut().zip(layer.vehicle.values_mut());
        let laid = cells.zip(heights.values()).with_min_len(PIXELS);
        laid.for_each(|((pigments, vehicle), heights)| {
            let cell = heights.cell();
            (*pigments, *vehicle) = (cell.pigments, cell.vehicle);
        });
        layer
    }
}

/// Films of volumes with their insides, for points one by one.
#[derive(Debug, Clone)]
pub struct FilmSum<'a> {
    /// The films.
    pub films: &'a [Film],
    /// The insides of the volumes, in the same order.
    pub insides: &'a [Inside],
}

impl FilmSum<'_> {
    /// Heights at a place on a surface with this normal: the sum over all volumes that hold it.
    #[must_use]
    pub fn at(&self, place: Vec3, normal: Vec3) -> FilmHeights {
        self.on_body(place, normal, 0)
    }

    /// Heights at a place on a surface with this normal, of the body with this number; 0 is that of
    /// all volumes.
    #[must_use]
    pub fn on_body(&self, place: Vec3, normal: Vec3, body: u32) -> FilmHeights {
        let mut sum = FilmHeights::default();
        for (film, inside) in self.films.iter().zip(self.insides) {
            if let Some(heights) = film.at(place, normal)
                && !film.wetted.is_foreign(body)
                && inside.holds(place)
            {
                sum.add(&heights, 1);
            }
        }
        sum
    }
}

#[cfg(test)]
mod tests;
