use paint::amount::mm_from_quanta;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::*;
use crate::test_volumes::bumpy;

const SCALE: FilmScale = FilmScale { quantum_mm3: 3e-7, unit_mm: 20.0, cell_mm: 0.2 };

/// Side of a cell of the grid, of which each holds 64 samples.
const CELL: f32 = 1.0 / 3.0;

/// A plane from 0 to 4 along x and y with a sample somewhere in each of its squares.
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
        let mut within = |square: usize| (square as f32 + random.random_range(0.0_f32..1.0)) * side;
        let places: Vec<Vec3> = (0..count * count)
            .map(|at| Vec3::new(within(at % count), within(at / count), 0.0))
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

/// Quanta of all volumes by slot, and those of the film over a square of the plane.
fn poured_and_laid(volumes: &[Volume], plane: &Plane, corner: Vec3, side: f32) -> [[f64; 9]; 2] {
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
    let mm3 = |quanta: f64| quanta * mm_from_quanta(1, SCALE.cell_mm) * pixel_mm * pixel_mm;
    let mut poured = [0.0; 9];
    for volume in volumes {
        let amounts = volume.paint.pigments.into_iter().chain([volume.paint.vehicle]);
        poured.iter_mut().zip(amounts).for_each(|(sum, quanta)| *sum += f64::from(quanta));
    }
    [poured.map(|quanta| quanta * SCALE.quantum_mm3), laid.map(mm3)]
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
    // A single one, which may hit more or fewer samples.
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
        let place = Vec3::new(1.2 + 0.05 * (at % 30) as f32, 1.2 + 0.05 * (at / 30) as f32, 0.0);
        let one = |i: usize| {
            FilmSum { films: &films[i..=i], insides: &insides[i..=i] }.at(place, Vec3::Z).0
        };
        let [first, second] = [one(0), one(1)];
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
    let at = |normal: Vec3| film.at(place, normal.normalize()).map_or(0, |heights| heights.0[0]);
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
