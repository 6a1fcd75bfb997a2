//! Films along eye rays: as high as the ray is long inside of a volume before it meets the scene.
//!
//! A ray that enters a closed surface at the distances `f` and leaves it at the distances `b` is
//! inside for the sum of all `min(b, t)` less that of all `min(f, t)`, with `t` the distance of the
//! scene. Entries before the near plane, which cuts them off, count as 0.

use glam::Vec3;
use graphics::camera::Camera;
use graphics::field::Field;
use graphics::surface::{Crossing, CrossingSum};
use paint::amount::QUANTA_PER_CELL;
use paint::layer::SLOTS;
use rayon::prelude::*;

use super::film::{FilmHeights, FilmScale};
use crate::volume::Volume;

/// Heights of films for a ray of length 1 in the unit of the scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Density(pub [f32; SLOTS + 1]);

impl Density {
    /// The paint of a volume spread evenly over its inside, in quanta of the painting for a unit of
    /// the scene.
    #[must_use]
    pub fn of(volume: &Volume, scale: &FilmScale) -> Self {
        let whole = enclosed(volume) * scale.unit_mm.powi(3);
        if whole <= 0.0 {
            return Self([0.0; SLOTS + 1]);
        }
        let per_unit = scale.quantum_mm3 / whole * scale.unit_mm / scale.cell_mm;
        let per_unit = per_unit * f64::from(QUANTA_PER_CELL);
        let paint = &volume.paint;
        Self(std::array::from_fn(|slot| {
            let quanta = if slot < SLOTS { paint.pigments[slot] } else { paint.vehicle };
            (f64::from(quanta) * per_unit) as f32
        }))
    }
}

/// Volume that the faces enclose, in the unit of the scene cubed.
#[must_use]
pub fn enclosed(volume: &Volume) -> f64 {
    let [x, y, z] = &volume.particles.places;
    let place = |i: u32| Vec3::new(x[i as usize], y[i as usize], z[i as usize]).as_dvec3();
    volume
        .mesh()
        .faces
        .iter()
        .map(|face: &[u32; 3]| {
            let [a, b, c] = face.map(place);
            a.cross(b).dot(c) / 6.0
        })
        .sum()
}

/// The heights of the films along the eye ray of each pixel. The surfaces that are crossed are those
/// of the volumes, in their order.
#[derive(Debug, Clone)]
pub struct FilmThrough<'a> {
    /// The density of each volume.
    pub densities: &'a [Density],
    /// Distances from the eye at which rays end, in the unit of the scene.
    pub ends: Field<f32>,
    /// Length of a ray for each unit along the viewing direction, by half the columns and rows.
    tangents: [f32; 2],
}

impl<'a> FilmThrough<'a> {
    /// Films along the rays from `camera` to the places that pixels show. Rays that meet nothing
    /// have no film, or go on without end if `beyond` is set.
    #[must_use]
    pub fn new(
        densities: &'a [Density],
        camera: &Camera,
        places: &Field<Vec3>,
        beyond: bool,
    ) -> Self {
        let width = places.width();
        let height = places.height();
        let nothing = if beyond { f32::INFINITY } else { 0.0 };
        let ends = places
            .values()
            .par_iter()
            .with_min_len(8192)
            .map(|place: &Vec3| {
                let distance = place.distance(camera.eye);
                if distance.is_nan() { nothing } else { distance }
            })
            .collect();
        let up = (camera.field_of_view_deg.to_radians() / 2.0).tan();
        let tangents = [up * width as f32 / height.max(1) as f32, up];
        Self { densities, ends: Field::from_values(width, height, ends), tangents }
    }

    /// Distance from the eye of a crossing.
    #[inline]
    fn distance(&self, crossing: &Crossing) -> f32 {
        let width = self.ends.width();
        let height = self.ends.height();
        let column = crossing.pixel % width;
        let row = crossing.pixel / width;
        let share = |at: usize, count: usize| (2 * at + 1) as f32 / count as f32 - 1.0;
        let x = share(column, width) * self.tangents[0];
        let y = share(row, height) * self.tangents[1];
        crossing.view_depth() * (1.0 + x * x + y * y).sqrt()
    }
}

impl CrossingSum for FilmThrough<'_> {
    type Sum = FilmHeights;

    const EVERY_CROSSING: bool = true;

    #[inline]
    fn add(&self, sum: &mut FilmHeights, crossing: &Crossing) {
        let end = self.ends.values()[crossing.pixel];
        if end <= 0.0 {
            return;
        }
        let length = self.distance(crossing).min(end);
        let density = &self.densities[crossing.surface as usize];
        // Partial sums may leave the range; sums are modulo 2^32.
        let heights = density.0.map(|density| match density > 0.0 {
            true => (length * density + 0.5) as i64 as i32,
            false => 0,
        });
        sum.add(&FilmHeights(heights), crossing.sign);
    }
}

#[cfg(test)]
mod tests;
