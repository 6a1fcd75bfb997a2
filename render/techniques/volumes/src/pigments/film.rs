//! The paint of volumes as a film on the surfaces that they hold.
//!
//! The amount of every pigment at a point is the sum over the volumes that hold it, in whole
//! quanta: paint that meets mixes wet in wet. A volume's part depends on the volume and the point
//! only. So we add it where a ray leaves a face of the volume and subtract it where the ray enters
//! one behind the point. Everything outside cancels exactly.
//!
//! This also has the height of a film from its rim inwards, samples of a surface by their place,
//! and the surface that a volume wets, by the samples that it holds.

use glam::{DVec3, Vec3};
use graphics::field::Field;
use paint::amount::{MAX_COLUMN, QUANTA_PER_CELL};
use paint::layer::{Cell, Layer, SLOTS};
use rayon::prelude::*;

use crate::containing::Inside;
use crate::volume::Volume;
use crate::wetting::SurfaceSamples;

/// Highest film of one volume in quanta, which are 32 widths of a cell of the picture.
const HIGHEST: f64 = (32 * QUANTA_PER_CELL) as f64;

/// A thread works on at least this many pixels.
const PIXELS: usize = 8192;

/// The lengths by which we measure amounts of paint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FilmScale {
    /// Volume of one quantum of a volume's paint in cubic mm.
    pub quantum_mm3: f64,
    /// Length of one unit of the scene in mm.
    pub unit_mm: f64,
    /// Width of a cell of the painting in mm.
    pub cell_mm: f64,
}

/// Heights of eight pigments and, last, of vehicle in quanta of the painting. Sums are modulo
/// 2^32, so you may see negative partial sums.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[repr(C)]
pub struct FilmHeights(pub [i32; SLOTS + 1]);

/// The film of one volume.
#[derive(Debug, Clone, Copy)]
pub struct Film {
    /// The surface on which this film lies.
    pub wetted: Wetted,
    heights: [f32; SLOTS + 1],
    profile: FilmProfile,
}

impl Film {
    /// The films of all volumes. Each is as high as its volume's paint is when you spread it over
    /// the surface that the volume holds.
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

    /// Heights at a place on a surface with this normal, if the volume holds the place. They
    /// depend only on volume and place. `None` beyond the reach of the volume, and on surfaces
    /// that face away.
    #[must_use]
    #[inline]
    pub fn at(&self, place: Vec3, normal: Vec3) -> Option<FilmHeights> {
        let share = self.wetted.relative_height(&self.profile, place, normal);
        (share > 0.0).then(|| FilmHeights(self.heights.map(|height| (height * share + 0.5) as i32)))
    }
}

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
    /// Adds the heights of a volume that the ray leaves (`sign` 1) or enters (-1) behind the
    /// point.
    #[inline]
    pub fn add(&mut self, heights: &Self, sign: i32) {
        for (sum, height) in self.0.iter_mut().zip(heights.0) {
            *sum = sum.wrapping_add(height.wrapping_mul(sign));
        }
    }

    /// A cell with paint of these heights.
    #[must_use]
    #[inline]
    pub fn cell(&self) -> Cell {
        let amounts = self.0.map(|amount| amount.max(0) as u32);
        let pigments = std::array::from_fn(|slot: usize| amounts[slot]);
        let cell = Cell { pigments, vehicle: amounts[SLOTS] };
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

    /// Makes a layer of these films.
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

/// Adds up the heights of the films of several volumes, at single points.
#[derive(Debug, Clone)]
pub struct FilmSum<'a> {
    /// The films.
    pub films: &'a [Film],
    /// The insides of the volumes, in the same order.
    pub insides: &'a [Inside],
}

impl FilmSum<'_> {
    /// Sum of the film heights at a place on a surface with this normal, over all volumes that hold
    /// the place.
    #[must_use]
    pub fn at(&self, place: Vec3, normal: Vec3) -> FilmHeights {
        self.on_body(place, normal, 0)
    }

    /// Like [`Self::at`], but only for the volumes that wet the body number `body`. If you pass 0,
    /// all volumes count.
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

/// The shape of a film across its rim. It is thin at the edge and has a ridge behind it, like
/// paint that dries from its rim.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FilmProfile {
    /// Width over which the film rises, in radii of its volume, 0 to 1.
    pub rim: f32,
    /// How much higher the film is near its rim, 0 to 4.
    pub edge: f32,
    /// The film leaves out a point if the product of the point's normal and the normal of its
    /// volume's cell is below this, -1 to 1.
    pub gate: f32,
}

impl Default for FilmProfile {
    /// A rim of 0.15 radii, an edge of 0.5 and a gate of -0.2.
    fn default() -> Self {
        Self { rim: 0.15, edge: 0.5, gate: -0.2 }
    }
}

/// Narrowest rim in radii. This keeps divisions finite.
const NARROWEST: f32 = 1e-4;

/// Height at the very edge of a film if its rim is not wider than usual.
const LEAST: f32 = 0.25;

impl FilmProfile {
    /// Height at a depth of `depth` radii inside of the farthest reach of the volume, relative to
    /// a film without rim. It is a quarter at the very edge (less if the rim is wider than usual)
    /// and 1 far inside.
    #[must_use]
    #[inline]
    pub fn height(&self, depth: f32) -> f32 {
        let rims = depth / self.rim.max(NARROWEST);
        // Most of a film lies there.
        if rims >= 3.0 {
            return 1.0;
        }
        // Volumes with wide rims blend where they meet.
        let least = LEAST * (Self::default().rim / self.rim.max(NARROWEST)).min(1.0);
        let risen = least + (1.0 - least) * smooth_step(rims);
        risen * (1.0 + self.edge * (1.0 - smooth_step(rims * (1.0 / 3.0))))
    }

    /// The most that [`Self::height`] can be.
    #[must_use]
    pub fn most(&self) -> f32 {
        1.0 + self.edge.max(0.0)
    }
}

#[inline]
pub(super) fn smooth_step(at: f32) -> f32 {
    let at = at.clamp(0.0, 1.0);
    at * at * (3.0 - 2.0 * at)
}

/// Samples spread evenly over the surface of a scene. All slices have the same length.
#[derive(Debug, Clone, Copy)]
pub struct SampledSurface<'a> {
    /// Places in the unit of the scene.
    pub places: &'a [Vec3],
    /// Normals of the triangles that they lie on, of length 1.
    pub normals: &'a [Vec3],
    /// Area that each sample stands for, in the unit of the scene squared.
    pub areas: &'a [f32],
    /// Numbers of the bodies on which they lie. On 0, volumes of all bodies have films.
    pub bodies: &'a [u32],
}

impl<'a> From<&'a SurfaceSamples> for SampledSurface<'a> {
    fn from(samples: &'a SurfaceSamples) -> Self {
        let SurfaceSamples { places, normals, areas, bodies, .. } = samples;
        Self { places, normals, areas, bodies }
    }
}

/// The samples of a surface sorted into cubes. This finds the samples near a place quickly.
#[derive(Debug, Clone)]
pub struct SampleLattice {
    side: f32,
    cubes: Vec<[i32; 3]>,
    /// Indices of the samples. Within one cube they rise.
    order: Vec<u32>,
    lowest: [i32; 3],
    highest: [i32; 3],
}

impl SampleLattice {
    /// Sorts samples into cubes with this side in the unit of the scene. Choose about the radius
    /// of most volumes. Places that are NaN count as 0.
    ///
    /// # Panics
    /// If `side` is not above 0.
    #[must_use]
    pub fn of(places: &[Vec3], side: f32) -> Self {
        assert!(side > 0.0, "cubes have a side above 0");
        let mut sorted: Vec<([i32; 3], u32)> =
            places.iter().zip(0..).map(|(&at, index)| (cube(at, side), index)).collect();
        sorted.sort_unstable();
        let [mut lowest, mut highest] = [[i32::MAX; 3], [i32::MIN; 3]];
        for (cube, _) in &sorted {
            lowest = std::array::from_fn(|axis| lowest[axis].min(cube[axis]));
            highest = std::array::from_fn(|axis| highest[axis].max(cube[axis]));
        }
        let (cubes, order) = sorted.into_iter().unzip();
        Self { side, cubes, order, lowest, highest }
    }

    /// Indices of the samples in all cubes that the box around a ball touches, always in the same
    /// order. Some may lie outside of the ball.
    pub fn near(&self, center: Vec3, reach: f32) -> impl Iterator<Item = usize> + '_ {
        let low = cube(center - reach, self.side);
        let high = cube(center + reach, self.side);
        let [z, y, x] = std::array::from_fn(|axis| {
            (low[axis].max(self.lowest[axis]), high[axis].min(self.highest[axis]))
        });
        let rows = (z.0..=z.1).flat_map(move |z| (y.0..=y.1).map(move |y| [z, y]));
        rows.flat_map(move |[z, y]| {
            let from = self.cubes.partition_point(|cube| *cube < [z, y, x.0]);
            let row = self.cubes[from..].iter().zip(&self.order[from..]);
            row.take_while(move |(cube, _)| **cube <= [z, y, x.1]).map(|(_, &index)| index as usize)
        })
    }
}

fn cube(at: Vec3, side: f32) -> [i32; 3] {
    let [x, y, z] = (at / side).floor().to_array();
    [z, y, x].map(|along| along as i32)
}

/// If a volume holds fewer samples than this, the surface counts as its tangent plane. From this
/// number on the samples alone count.
const FEW: f64 = 8.0;
const MANY: f64 = 24.0;

/// We measure a tangent plane over this many rings and directions.
const RINGS: usize = 12;
const DIRECTIONS: usize = 32;

/// The reach of a volume over surfaces.
#[derive(Debug, Clone, Copy)]
pub struct Wetted {
    /// Centre in the unit of the scene.
    pub center: Vec3,
    /// Distance of the farthest vertex from the centre, in the unit of the scene.
    pub reach: f32,
    /// 1 / radius.
    pub per_radius: f32,
    /// Mean normal of the surface that the volume lies on. It does not wet surfaces that face away
    /// from this. Zero for a volume that wets all that it holds.
    pub facing: Vec3,
    /// Number of the only body that it wets. 0 means all.
    pub body: u32,
}

impl Wetted {
    /// The reach of `volume`. Pass its inside too.
    #[must_use]
    pub fn of(volume: &Volume, inside: &Inside) -> Self {
        let reach = inside.farthest() as f32;
        let Volume { center, radius, normal, body, .. } = *volume;
        Self { center, reach, per_radius: 1.0 / radius, facing: normal, body }
    }

    /// Height of the film of `profile` at a place on a surface with this normal, relative to the
    /// height far inside. It is 0 beyond the reach of the volume and where the surface faces away.
    /// It depends only on volume and place, whether or not the volume holds the place.
    #[must_use]
    #[inline]
    pub fn relative_height(&self, profile: &FilmProfile, place: Vec3, normal: Vec3) -> f32 {
        let from = place - self.center;
        let distance = from.length_squared();
        // This is also false for NaN.
        let near = distance < self.reach * self.reach && !self.faces_away(profile, normal);
        if !near {
            return 0.0;
        }
        profile.height((self.reach - distance.sqrt()) * self.per_radius)
    }

    /// Whether it never wets surface of this body. 0 may be any body.
    #[must_use]
    #[inline]
    pub fn is_foreign(&self, body: u32) -> bool {
        self.body != 0 && body != 0 && body != self.body
    }

    #[inline]
    fn faces_away(&self, profile: &FilmProfile, normal: Vec3) -> bool {
        self.facing != Vec3::ZERO && normal.dot(self.facing) < profile.gate
    }

    /// Integral of [`Self::relative_height`] over the surface that the volume holds, in the unit
    /// of the scene squared. If the volume holds few samples, we measure on the tangent plane of
    /// the nearest one. If it holds no surface, this is 0.
    #[must_use]
    pub fn film_area(
        &self,
        inside: &Inside,
        profile: &FilmProfile,
        surface: &SampledSurface<'_>,
        lattice: &SampleLattice,
    ) -> f64 {
        let mut count = 0.0;
        let mut area = 0.0;
        for index in lattice
            .near(self.center, self.reach)
            .filter(|index: &usize| !self.is_foreign(surface.bodies[*index]))
        {
            let place = surface.places[index];
            let normal = surface.normals[index];
            let patch = surface.areas[index];
            let height = self.relative_height(profile, place, normal);
            if height > 0.0 {
                let share = held_share(inside, place, normal, f64::from(patch.sqrt()));
                count += share;
                area += share * f64::from(patch * height);
            }
        }
        if count >= MANY {
            return area;
        }
        let Some(on_plane) = self.area_on_plane(inside, profile, surface, lattice) else {
            return area;
        };
        let share = f64::from(smooth_step(((count - FEW) / (MANY - FEW)) as f32));
        on_plane + share * (area - on_plane)
    }

    /// The integral on the tangent plane of the nearest sample. `None` if no sample is near, or if
    /// the plane misses the volume.
    fn area_on_plane(
        &self,
        inside: &Inside,
        profile: &FilmProfile,
        surface: &SampledSurface<'_>,
        lattice: &SampleLattice,
    ) -> Option<f64> {
        let away = |&index: &usize| surface.places[index].distance_squared(self.center);
        let near = lattice.near(self.center, self.reach).filter(|&index: &usize| {
            !self.faces_away(profile, surface.normals[index])
                && !self.is_foreign(surface.bodies[index])
        });
        let nearest = near.min_by(|a, b| away(a).total_cmp(&away(b)))?;
        let normal = surface.normals[nearest];
        let above = (self.center - surface.places[nearest]).dot(normal);
        let foot = self.center - above * normal;
        let most = self.reach * self.reach - above * above;
        if most <= 0.0 {
            return None;
        }
        let (u, v) = normal.any_orthonormal_pair();
        let step = most.sqrt() / RINGS as f32;
        let mut area = 0.0;
        for ring in 0..RINGS {
            let radius = (ring as f32 + 0.5) * step;
            let piece = std::f64::consts::TAU * f64::from(radius * step) / DIRECTIONS as f64;
            for direction in 0..DIRECTIONS {
                let turn = (direction as f64 + 0.5) / DIRECTIONS as f64 * std::f64::consts::TAU;
                let (sin, cos) = turn.sin_cos();
                let place = foot + radius * (u * cos as f32 + v * sin as f32);
                let height = self.relative_height(profile, place, normal);
                let share = held_share(inside, place, normal, f64::from(step));
                area += piece * share * f64::from(height);
            }
        }
        Some(area)
    }
}

/// The share, 0 to 1, of a patch of surface that a volume holds. The patch is `width` wide. The
/// share is 0 or 1, except for patches that the skin of the volume crosses.
fn held_share(inside: &Inside, place: Vec3, normal: Vec3, width: f64) -> f64 {
    let ray: DVec3 = place.as_dvec3() - inside.center();
    let distance = ray.length();
    let rest = inside.exit(place).distance - distance;
    // If the ray is steep over the surface, the skin crosses the surface farther from the place.
    let steep = ray.dot(normal.as_dvec3()) / distance;
    let along = (1.0 - steep * steep).max(0.01).sqrt();
    let share = 0.5 + rest / (along * width);
    if share.is_nan() { 1.0 } else { share.clamp(0.0, 1.0) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::test_volumes::bumpy;
    use paint::amount::mm_from_quanta;
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    #[test]
    fn films_rise_over_the_rim_stand_higher_behind_it_and_are_level_inside() {
        let profile = FilmProfile::default();
        assert_eq!([0.0, 0.45, 2.0].map(|radii| profile.height(radii)), [0.25 * 1.5, 1.0, 1.0]);
        let [first, second, third] = [0.05, 0.1, 0.15].map(|radii| profile.height(radii));
        assert!(third > 1.25 && first < second, "{third}");
        let most = (0..1000).map(|i| profile.height(i as f32 / 1000.0)).fold(0.0, f32::max);
        assert!(most <= profile.most() && most > 1.2, "{most}");
        let wide = FilmProfile { rim: 1.0, edge: 0.0, ..profile };
        assert!(wide.height(0.0) < 0.04 && wide.height(1.0) == 1.0, "{}", wide.height(0.0));
        let hard = FilmProfile { rim: 0.0, edge: 0.0, ..profile };
        assert_eq!(hard.height(0.01), 1.0);
        assert!(hard.height(0.0).is_finite());
    }

    #[test]
    fn every_sample_in_a_ball_is_found_once() {
        let random = &mut ChaCha8Rng::seed_from_u64(3);
        let mut axis = || random.random_range(-2.0_f32..3.0);
        let places: Vec<Vec3> = (0..3000).map(|_| Vec3::new(axis(), axis(), axis())).collect();
        let lattice = SampleLattice::of(&places, 0.4);
        for reach in [0.0, 0.1, 0.5, 2.0, 100.0] {
            let center = Vec3::new(axis(), axis(), axis());
            let mut found: Vec<usize> = lattice.near(center, reach).collect();
            let held = (0..places.len()).filter(|&i| places[i].distance(center) <= reach);
            for index in held {
                assert!(found.contains(&index), "{reach}: {index}");
            }
            assert!(
                !found
                    .iter()
                    .any(|&i: &usize| (places[i] - center).abs().max_element() > reach + 0.4001),
                "{reach}"
            );
            let count = found.len();
            found.sort_unstable();
            found.dedup();
            assert_eq!(found.len(), count);
        }
        assert_eq!(SampleLattice::of(&[], 1.0).near(Vec3::ZERO, 9.0).count(), 0);
    }

    const SCALE: FilmScale = FilmScale { quantum_mm3: 3e-7, unit_mm: 20.0, cell_mm: 0.2 };

    const CELL: f32 = 1.0 / 3.0;

    /// A plane from 0 to 4 along x and y. Each of its squares has a sample somewhere.
    struct Plane {
        places: Vec<Vec3>,
        normals: Vec<Vec3>,
        areas: Vec<f32>,
        lattice: SampleLattice,
    }

    impl Plane {
        fn new() -> Self {
            let random = &mut ChaCha8Rng::seed_from_u64(11);
            let count = 96;
            let side = CELL / 8.0;
            let places: Vec<Vec3> = (0..count * count)
                .map(|at: usize| {
                    let [x, y] = [at % count, at / count]
                        .map(|square| (square as f32 + random.random_range(0.0_f32..1.0)) * side);
                    Vec3::new(x, y, 0.0)
                })
                .collect();
            let normals = vec![Vec3::Z; places.len()];
            let areas = vec![side * side; places.len()];
            let lattice = SampleLattice::of(&places, CELL);
            Self { places, normals, areas, lattice }
        }

        fn films(&self, volumes: &[Volume], profile: FilmProfile) -> Vec<Film> {
            let Self { places, normals, areas, lattice } = self;
            let surface = SampledSurface { places, normals, areas, bodies: &vec![0; places.len()] };
            Film::of_volumes(volumes, profile, (&surface, lattice), &SCALE)
        }
    }

    fn painted(mut volume: Volume, pigments: [u32; SLOTS], vehicle: u32) -> Volume {
        volume.paint = Cell { pigments, vehicle };
        volume.normal = Vec3::Z;
        volume
    }

    fn insides(volumes: &[Volume]) -> Vec<Inside> {
        volumes.iter().map(Inside::of).collect()
    }

    /// Quanta of all volumes by slot, and quanta of the film over a square of the plane.
    fn poured_and_laid(
        volumes: &[Volume],
        plane: &Plane,
        corner: Vec3,
        side: f32,
    ) -> [[f64; 9]; 2] {
        let films = plane.films(volumes, FilmProfile::default());
        let insides = insides(volumes);
        let sum = FilmSum { films: &films, insides: &insides };
        let count = 400;
        let mut laid = [0.0; 9];
        for at in 0..count * count {
            let [x, y] = [at % count, at / count].map(|at| (at as f32 + 0.5) / count as f32 * side);
            let heights = sum.at(corner + Vec3::new(x, y, 0.0), Vec3::Z);
            laid.iter_mut().zip(heights.0).for_each(|(laid, height)| *laid += f64::from(height));
        }
        let pixel_mm = f64::from(side) / count as f64 * SCALE.unit_mm;
        let mut poured = [0.0; 9];
        for volume in volumes {
            let amounts = volume.paint.pigments.into_iter().chain([volume.paint.vehicle]);
            poured.iter_mut().zip(amounts).for_each(|(sum, quanta)| *sum += f64::from(quanta));
        }
        [
            poured.map(|quanta| quanta * SCALE.quantum_mm3),
            laid.map(|quanta: f64| quanta * mm_from_quanta(1, SCALE.cell_mm) * pixel_mm * pixel_mm),
        ]
    }

    #[test]
    fn the_film_on_a_plane_is_the_paint_poured() {
        let plane = Plane::new();
        let random = &mut ChaCha8Rng::seed_from_u64(2);
        let mut volumes = Vec::new();
        for seed in 0..12 {
            let mut within = |low: f32, high: f32| random.random_range(low..high);
            let center = Vec3::new(within(0.8, 3.2), within(0.8, 3.2), within(-0.1, 0.1));
            let volume = bumpy(center, within(0.2, 0.5), 2, seed);
            let mut pigments = [0; SLOTS];
            pigments[seed as usize % 4] = (within(1.0, 4.0) * 1e6) as u32;
            volumes.push(painted(volume, pigments, 400_000));
        }
        let [poured, laid] = poured_and_laid(&volumes, &plane, Vec3::ZERO, 4.0);
        for slot in [0, 1, 2, 3, 8] {
            let ratio = laid[slot] / poured[slot];
            assert!((0.98..1.02).contains(&ratio), "{slot}: {ratio}");
        }
        assert_eq!((poured[5], laid[5]), (0.0, 0.0));
        // This one is single, so it may hit more or fewer samples.
        for volume in &volumes {
            let alone = std::slice::from_ref(volume);
            let corner = Vec3::new(volume.center.x - 0.7, volume.center.y - 0.7, 0.0);
            let [poured, laid] = poured_and_laid(alone, &plane, corner, 1.4);
            let ratio = laid[8] / poured[8];
            assert!((0.96..1.04).contains(&ratio), "{}: {ratio}", volume.radius);
        }
    }

    #[test]
    fn volumes_between_the_samples_lay_their_paint_as_well() {
        let plane = Plane::new();
        for (radius, detail) in [(0.02, 2), (0.05, 2), (0.08, 3), (0.1, 2), (0.13, 2), (0.16, 2)] {
            let center = Vec3::new(1.51, 2.03, 0.2 * radius);
            let volume = painted(bumpy(center, radius, detail, 4), [90_000; SLOTS], 0);
            let corner = center.with_z(0.0) - 1.4 * radius * Vec3::new(1.0, 1.0, 0.0);
            let [poured, laid] = poured_and_laid(&[volume], &plane, corner, 2.8 * radius);
            let ratio = laid[0] / poured[0];
            assert!((0.94..1.06).contains(&ratio), "{radius}: {ratio}");
        }
    }

    #[test]
    fn paint_of_overlapping_volumes_adds_up() {
        let plane = Plane::new();
        let [a, b] = [Vec3::new(1.8, 2.0, 0.0), Vec3::new(2.2, 2.1, 0.0)];
        let first = painted(bumpy(a, 0.5, 3, 1), [700_000, 0, 0, 0, 0, 0, 0, 9], 5);
        let second = painted(bumpy(b, 0.5, 3, 2), [0, 500_000, 0, 0, 0, 0, 0, 0], 0);
        let volumes = [first, second];
        let films = plane.films(&volumes, FilmProfile::default());
        let insides = insides(&volumes);
        let both = FilmSum { films: &films, insides: &insides };
        let mut shared = 0;
        for at in 0..900 {
            let place =
                Vec3::new(1.2 + 0.05 * (at % 30) as f32, 1.2 + 0.05 * (at / 30) as f32, 0.0);
            let [first, second] = [0, 1].map(|i: usize| {
                FilmSum { films: &films[i..=i], insides: &insides[i..=i] }.at(place, Vec3::Z).0
            });
            let sum: [i32; 9] = std::array::from_fn(|slot| first[slot] + second[slot]);
            assert_eq!(both.at(place, Vec3::Z).0, sum);
            shared += usize::from(first[0] > 0 && second[1] > 0);
        }
        assert!(shared > 50, "{shared}");
    }

    #[test]
    fn surfaces_that_face_away_from_the_cell_stay_bare() {
        let plane = Plane::new();
        let volume = painted(bumpy(Vec3::new(2.0, 2.0, 0.0), 0.5, 2, 1), [100_000; SLOTS], 0);
        let film = plane.films(&[volume], FilmProfile::default())[0];
        let place = Vec3::new(2.1, 2.0, 0.05);
        let at =
            |normal: Vec3| film.at(place, normal.normalize()).map_or(0, |heights| heights.0[0]);
        let up = at(Vec3::Z);
        assert!(up > 0);
        assert_eq!(at(Vec3::new(1.0, 0.0, -0.15)), up);
        assert_eq!(at(Vec3::new(1.0, 0.0, -0.25)), 0);
        assert_eq!(at(-Vec3::Z), 0);
        let mut single = film;
        single.wetted.facing = Vec3::ZERO;
        assert_eq!(single.at(place, -Vec3::Z).unwrap().0[0], up);
        assert!(single.at(Vec3::splat(f32::NAN), Vec3::Z).is_none());
    }

    #[test]
    fn a_volume_that_holds_no_surface_shows_no_paint() {
        let plane = Plane::new();
        let volume = painted(bumpy(Vec3::new(2.0, 2.0, 1.4), 0.5, 2, 1), [u32::MAX / 16; SLOTS], 7);
        let film = plane.films(&[volume], FilmProfile::default())[0];
        assert_eq!(film.at(Vec3::new(2.0, 2.0, 1.4), Vec3::Z), Some(FilmHeights::default()));
    }

    #[test]
    fn entering_and_leaving_behind_a_point_cancel() {
        let plane = Plane::new();
        let volume = painted(bumpy(Vec3::new(2.0, 2.0, 0.0), 0.5, 2, 1), [900_000; SLOTS], 3);
        let film = plane.films(&[volume], FilmProfile::default())[0];
        let heights = film.at(Vec3::new(2.2, 2.1, 0.0), Vec3::Z).unwrap();
        assert!(heights.0[0] > 0);
        let mut sum = FilmHeights::default();
        for sign in [-1, 1, -1, 1] {
            sum.add(&heights, sign);
        }
        assert_eq!(sum, FilmHeights::default());
    }

    #[test]
    fn columns_stay_within_the_range_of_a_layer() {
        let full = FilmHeights([i32::MAX; 9]).cell();
        assert!(full.volume() <= MAX_COLUMN && full.volume() > MAX_COLUMN - 16);
        assert_eq!(full.pigments[0], full.vehicle);
        assert_eq!(FilmHeights([-5, 3, 0, 0, 0, 0, 0, 0, 2]).cell().pigments[..2], [0, 3]);
        let heights = Field::filled(3, 2, FilmHeights([1, 2, 3, 4, 5, 6, 7, 8, 9]));
        assert_eq!(FilmHeights::layer(&heights).totals(), [6, 12, 18, 24, 30, 36, 42, 48, 54]);
    }
}
