//! Films along eye rays. They are as high as the ray is long inside of a volume before it meets
//! the scene.
//!
//! If a ray enters a closed surface at the distances `f` and leaves it at the distances `b`, it is
//! inside for the sum of all `min(b, t)` less the sum of all `min(f, t)`. Here `t` is the distance
//! of the scene. Entries before the near plane, which cuts them off, count as 0.

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
    /// The paint of a volume spread evenly over its inside, in quanta of the painting per unit of
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
    volume
        .mesh()
        .faces
        .iter()
        .map(|face: &[u32; 3]| {
            let [a, b, c] = face
                .map(|i: u32| Vec3::new(x[i as usize], y[i as usize], z[i as usize]).as_dvec3());
            a.cross(b).dot(c) / 6.0
        })
        .sum()
}

/// The heights of the films along the eye ray of each pixel. Pass the surfaces of the volumes, in
/// the order of the volumes.
#[derive(Debug, Clone)]
pub struct FilmThrough<'a> {
    /// The density of each volume.
    pub densities: &'a [Density],
    /// Distances from the eye at which rays end, in the unit of the scene.
    pub ends: Field<f32>,
    /// Tangents of half the angle of view, across and upwards.
    tangents: [f32; 2],
}

impl<'a> FilmThrough<'a> {
    /// Films along the rays from `camera` to the places that pixels show. Rays that meet nothing
    /// have no film. If you set `beyond`, they go on without end.
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

    #[inline]
    fn distance(&self, crossing: &Crossing) -> f32 {
        let width = self.ends.width();
        let height = self.ends.height();
        let column = crossing.pixel % width;
        let row = crossing.pixel / width;
        fn share(at: usize, count: usize) -> f32 {
            (2 * at + 1) as f32 / count as f32 - 1.0
        }
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
        // Partial sums may leave the range, because sums are modulo 2^32.
        let heights = density.0.map(|density| match density > 0.0 {
            true => (length * density + 0.5) as i64 as i32,
            false => 0,
        });
        sum.add(&FilmHeights(heights), crossing.sign);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pigments::{Facets, SeenPlaces};
    use crate::surfaces::VolumeSurfaces;
    use crate::test_volumes::{bumpy, camera, plane};
    use graphics::surface::{Crossings, PackedMesh, VisibilityBuffer, visible};
    use paint::amount::mm_from_quanta;
    use paint::layer::Cell;

    const SIZE: (usize, usize) = (121, 97);

    const UNITS: f32 = 1e6;

    fn lengths(volumes: &[Volume], camera: &Camera, beyond: bool) -> (Field<f32>, Field<Vec3>) {
        let mesh = plane(3);
        let seen: VisibilityBuffer = visible(&mesh, camera, SIZE.0, SIZE.1);
        let mesh = PackedMesh::new(&mesh);
        let facets = Facets::of(&mesh);
        let places = SeenPlaces::of(&mesh, &facets, &seen).places;
        let mut density = Density([0.0; SLOTS + 1]);
        density.0[2] = UNITS;
        let densities = vec![density; volumes.len()];
        let through = FilmThrough::new(&densities, camera, &places, beyond);
        let surfaces = VolumeSurfaces::of(volumes);
        let sums = Crossings::default().sum(&through, surfaces.closed(), camera, &seen);
        (
            Field::from_values(
                SIZE.0,
                SIZE.1,
                sums.values()
                    .iter()
                    .map(|heights: &FilmHeights| {
                        assert_eq!((heights.0[0], heights.0[SLOTS]), (0, 0));
                        heights.0[2] as f32 / UNITS
                    })
                    .collect(),
            ),
            places,
        )
    }

    fn ray(camera: &Camera, pixel: usize) -> Vec3 {
        let [right, up, back] = camera.axes();
        let column = pixel % SIZE.0;
        let row = pixel / SIZE.0;
        let tangent = (camera.field_of_view_deg.to_radians() / 2.0).tan() / SIZE.1 as f32;
        let x = ((2 * column + 1) as f32 - SIZE.0 as f32) * tangent;
        let y = (SIZE.1 as f32 - (2 * row + 1) as f32) * tangent;
        (x * right + y * up - back).normalize()
    }

    fn in_ball(eye: Vec3, ray: Vec3, (center, radius): (Vec3, f32), end: f32) -> f32 {
        let middle = (center - eye).dot(ray);
        let from_center = (eye + middle * ray).distance(center);
        if from_center >= radius {
            return 0.0;
        }
        let half = (radius * radius - from_center * from_center).sqrt();
        (middle + half).clamp(0.0, end) - (middle - half).clamp(0.0, end)
    }

    /// Sums over all pixels: what we find, what we expect, and their differences.
    fn compared(ball: (Vec3, f32), camera: &Camera, beyond: bool) -> [f64; 3] {
        let volume = Volume::ball(ball.0, ball.1, 4, 0);
        let (lengths, places) = lengths(&[volume], camera, beyond);
        let mut sums = [0.0; 3];
        for (pixel, &length) in lengths.values().iter().enumerate() {
            let seen = places.values()[pixel].distance(camera.eye);
            let nothing = if beyond { f32::INFINITY } else { 0.0 };
            let end = if seen.is_nan() { nothing } else { seen };
            let wanted = in_ball(camera.eye, ray(camera, pixel), ball, end);
            sums[0] += f64::from(length);
            sums[1] += f64::from(wanted);
            sums[2] += f64::from((length - wanted).abs());
        }
        sums
    }

    #[test]
    fn rays_through_a_resting_ball_have_the_length_of_its_chords() {
        // In the air, half sunk into the plane, around the eye, and beside the plane.
        let cases = [
            (Vec3::new(2.1, 2.0, 1.5), 0.7, camera(10.0, 6.0), false),
            (Vec3::new(2.0, 1.8, 0.1), 0.9, camera(40.0, 6.0), false),
            (camera(30.0, 6.0).eye + Vec3::new(0.1, 0.0, 0.0), 1.5, camera(30.0, 6.0), false),
            (Vec3::new(5.0, 2.0, 0.0), 1.5, camera(0.0, 8.0), true),
        ];
        for (center, radius, camera, beyond) in cases {
            let [found, wanted, off] = compared((center, radius), &camera, beyond);
            assert!(wanted > 300.0, "{wanted}");
            assert!(off <= 0.01 * wanted, "{found} for {wanted}, {off} off");
        }
    }

    #[test]
    fn rays_that_miss_or_end_before_a_volume_have_no_film_at_all() {
        // Behind the plane, and before it.
        let hidden = [bumpy(Vec3::new(2.0, 2.0, -1.0), 0.6, 3, 1)];
        let (hidden_lengths, _) = lengths(&hidden, &camera(0.0, 6.0), false);
        assert!(hidden_lengths.values().iter().all(|&length| length == 0.0));
        let shown = [bumpy(Vec3::new(2.0, 2.0, 1.0), 0.6, 3, 1)];
        let (lengths, places) = lengths(&shown, &camera(0.0, 6.0), false);
        let zero = lengths.values().iter().filter(|&&length| length == 0.0).count();
        assert!((6000..11_000).contains(&zero), "{zero}");
        assert!(places.values().iter().any(|place| place.is_nan()));
        assert!(lengths.values().iter().all(|&length| (0.0..2.0).contains(&length)));
    }

    #[test]
    fn densities_spread_the_paint_over_the_inside() {
        let mut volume = Volume::ball(Vec3::ZERO, 0.5, 4, 0);
        let scale = FilmScale { quantum_mm3: 2e-6, unit_mm: 10.0, cell_mm: 0.1 };
        volume.paint = Cell { pigments: [0, 5_000_000, 0, 0, 0, 0, 0, 0], vehicle: 1000 };
        let ball = 4.0 / 3.0 * std::f64::consts::PI * 0.125;
        assert!((enclosed(&volume) / ball - 1.0).abs() < 0.003, "{}", enclosed(&volume));
        let Density(density) = Density::of(&volume, &scale);
        let mm_per_mm = 5e6 * 2e-6 / (ball * 1000.0);
        let found = f64::from(density[1]) * mm_from_quanta(1, 0.1) / 10.0;
        assert!((found / mm_per_mm - 1.0).abs() < 0.003, "{found} {mm_per_mm}");
        assert_eq!((density[0], density[8] > 0.0), (0.0, true));
    }
}
