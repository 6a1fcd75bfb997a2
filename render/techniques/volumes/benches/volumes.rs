//! Benchmarks of paint volumes: how long particles take to move for a second, with all forces and
//! the guard.

#![expect(clippy::unwrap_used, reason = "a bench may panic")]

use std::fmt;
use std::sync::Arc;

use divan::Bencher;
use divan::counter::ItemsCount;
use glam::Vec3;
use graphics::gpu::{BackendChoice, choose};
use volumes::motion::{DeviceMotion, MotionSettings, SurfaceLattice, Surroundings, advance, kick};
use volumes::volume::Volume;

const STEP: f32 = 1.0 / 120.0;

#[derive(Clone, Copy)]
struct Crowd {
    count: usize,
    detail: u8,
}

const CROWDS: [Crowd; 5] = [
    Crowd { count: 64, detail: 3 },
    Crowd { count: 256, detail: 2 },
    Crowd { count: 1, detail: 4 },
    Crowd { count: 1000, detail: 3 },
    Crowd { count: 4000, detail: 2 },
];

impl fmt::Display for Crowd {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} of detail {}", self.count, self.detail)
    }
}

impl Crowd {
    /// Volumes on the plane y = 0, one per cell. They keep growing and so never rest.
    fn volumes(self) -> Vec<Volume> {
        let side = (self.count as f64).sqrt().ceil() as usize;
        (0..self.count)
            .map(|i: usize| {
                let center = Vec3::new((i % side) as f32 + 0.5, 0.0, (i / side) as f32 + 0.5);
                let mut ball = Volume::ball(center, 0.6, self.detail, i as u64);
                ball.target_radius = 1e6;
                kick(&mut ball, 0.3, 0);
                ball
            })
            .collect()
    }

    fn floor(self) -> Vec<Vec3> {
        let side = 8 * (self.count as f64).sqrt().ceil() as usize;
        (0..side * side)
            .map(|i: usize| Vec3::new((i % side) as f32, 0.0, (i / side) as f32) / 8.0)
            .collect()
    }

    fn run(self, bencher: Bencher, surroundings: &Surroundings) {
        // Growth is so slow that the shapes stay similar through the bench.
        let settings = MotionSettings { fastest: 0.002, ..MotionSettings::default() };
        let mut volumes = self.volumes();
        let particles: usize = volumes.iter().map(|v| v.particles.places[0].len()).sum();
        bencher
            .counter(ItemsCount::new(particles))
            .bench_local(|| advance(&mut volumes, &settings, surroundings, STEP).unwrap());
    }
}

/// Pressure, elastic force, cohesion, friction, microstructure and the guard.
#[divan::bench(args = CROWDS)]
fn free(bencher: Bencher, crowd: Crowd) {
    crowd.run(bencher, &Surroundings::new(1.0, 1));
}

/// All forces of [`free`], and the pull to a surface.
#[divan::bench(args = CROWDS)]
fn on_a_surface(bencher: Bencher, crowd: Crowd) {
    let surface = SurfaceLattice::of(&crowd.floor(), 1.0).unwrap();
    let surroundings =
        Surroundings { surface: Some(Arc::new(surface)), ..Surroundings::new(1.0, 1) };
    crowd.run(bencher, &surroundings);
}

/// Builds the look-up of the nearest sample, which you need once for a scene of about 1000 cells.
#[divan::bench]
fn surface_lattice(bencher: Bencher) {
    let places = Crowd { count: 1000, detail: 2 }.floor();
    bencher.bench(|| SurfaceLattice::of(&places, 1.0).unwrap());
}

/// Moves particles on any graphics device, and copies them there and back. Without a device, this
/// does nothing.
#[divan::bench(args = CROWDS)]
fn on_a_device(bencher: Bencher, crowd: Crowd) {
    let Ok(Some(mut device)) = choose(BackendChoice::Gpu) else { return };
    let settings = MotionSettings { fastest: 0.002, ..MotionSettings::default() };
    let surface = SurfaceLattice::of(&crowd.floor(), 1.0).unwrap();
    let surroundings =
        Surroundings { surface: Some(Arc::new(surface)), ..Surroundings::new(1.0, 1) };
    let mut volumes = crowd.volumes();
    let particles: usize = volumes.iter().map(|v| v.particles.places[0].len()).sum();
    let mut motion = DeviceMotion::default();
    bencher.counter(ItemsCount::new(particles)).bench_local(|| {
        motion.advance(&mut device, &mut volumes, &settings, &surroundings, STEP).unwrap()
    });
}

fn main() {
    divan::main();
}
