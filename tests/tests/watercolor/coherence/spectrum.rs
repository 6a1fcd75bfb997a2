//! Spectrum of coherent noise, and its independence of the distance of the camera.

use std::f64::consts::TAU;

use graphics::coherence::{FeatureNoise, Features, Particles, SPREAD, repeating_noise};
use graphics::compute::Compute;
use graphics::field::Field;
use graphics::mesh::Mesh;

use super::{Subject, anchored_on, from_front, splats_on, spread, wall, waves};

/// Side of the square in the middle of the picture whose spectrum is computed, in pixels.
const SIDE: usize = 128;

/// Power of the square by radial frequency, in cycles per [`SIDE`] pixels, under a Hann window.
fn spectrum(noise: &Field<f32>) -> Vec<f64> {
    let left = (noise.width() - SIDE) / 2;
    let top = (noise.height() - SIDE) / 2;
    let hann = |i: usize| 0.5 - 0.5 * (TAU * (i as f64 + 0.5) / SIDE as f64).cos();
    let value =
        |x: usize, y: usize| (f64::from(noise[(left + x, top + y)]) - 0.5) * hann(x) * hann(y);
    let waves: Vec<[f64; 2]> = (0..SIDE)
        .map(|i| TAU * i as f64 / SIDE as f64)
        .map(|angle| [angle.cos(), -angle.sin()])
        .collect();
    let wave = |i: usize| waves[i % SIDE];
    // Fourier transform of the rows, then of the columns.
    let half = SIDE / 2;
    let mut rows = vec![[0.0; 2]; SIDE * half];
    for y in 0..SIDE {
        let row: Vec<f64> = (0..SIDE).map(|x| value(x, y)).collect();
        for k in 0..half {
            let sum = &mut rows[y * half + k];
            for (x, value) in row.iter().enumerate() {
                let [cos, sin] = wave(k * x);
                *sum = [sum[0] + value * cos, sum[1] + value * sin];
            }
        }
    }
    let mut power = vec![0.0; SIDE];
    for k in 0..half {
        for l in 0..SIDE {
            let mut sum = [0.0; 2];
            for y in 0..SIDE {
                let [re, im] = rows[y * half + k];
                let [cos, sin] = wave(l * y);
                sum = [sum[0] + re * cos - im * sin, sum[1] + re * sin + im * cos];
            }
            let down = if l < half { l as f64 } else { l as f64 - SIDE as f64 };
            let frequency = (k as f64).hypot(down).round() as usize;
            power[frequency] += sum[0] * sum[0] + sum[1] * sum[1];
        }
    }
    power
}

/// Mean frequency in cycles per pixel, and the share of the power above `limit` cycles per
/// pixel.
fn told(power: &[f64], limit: f64) -> [f64; 2] {
    let all: f64 = power.iter().sum();
    let at = |i: usize| i as f64 / SIDE as f64;
    let mean = power.iter().enumerate().map(|(i, power)| at(i) * power).sum::<f64>() / all;
    let above = power.iter().enumerate().filter(|(i, _)| at(*i) > limit);
    [mean, above.map(|(_, power)| power).sum::<f64>() / all]
}

#[test]
fn noise_of_features_has_no_wave_shorter_than_its_finest_octave() {
    let (mesh, camera) = wall();
    let subject = Subject::new(mesh);
    let bare = subject.bare(&camera, 256, 256);
    for (largest_px, octaves) in [(16.0, 1), (24.0, 3), (10.0, 2)] {
        let noise = FeatureNoise { largest_px, octaves, persistence: 0.8, coverage: 4.0 };
        let field = subject.of_features(&bare, noise);
        let finest = f64::from(largest_px) / f64::from(1 << (octaves - 1));
        let [_, above] = told(&spectrum(&field), 1.5 / finest);
        assert!(above < 0.01, "{noise:?}: {above}");
        let [mean, spread] = spread(&field, &bare.depth);
        assert!((mean - 0.5).abs() < 0.06, "{noise:?}: mean {mean}");
        assert!((spread / f64::from(SPREAD) - 1.0).abs() < 0.15, "{noise:?}: spread {spread}");
    }
}

/// Mean frequency and share above `limit` (see [`told`]) at nine zooms from 1 to 16, each for the
/// summed spectra of six seeds. `noise` makes a picture from a zoom and a seed.
fn under_zoom(noise: impl Fn(f32, u64) -> Field<f32>, limit: f64) -> Vec<[f64; 2]> {
    let zooms = (0..9).map(|step| 2.0f32.powf(step as f32 / 2.0));
    zooms
        .map(|zoom: f32| {
            let mut power = vec![0.0; SIDE];
            for seed in 0..6 {
                let other = spectrum(&noise(zoom, seed));
                power.iter_mut().zip(other).for_each(|(power, other)| *power += other);
            }
            told(&power, limit)
        })
        .collect()
}

#[test]
fn frequency_holds_while_the_model_comes_nearer() {
    // Triangles smaller than any feature, and some that are larger than the picture.
    for triangles in [40_000, 500] {
        let subject = Subject::new(Mesh::sphere(triangles));
        let particles = Particles::new(&subject.hierarchy, 6);
        let strewn: Vec<Features> =
            (0..6).map(|seed| Features::new(subject.hierarchy.clone(), seed)).collect();
        let textures: Vec<Field<f32>> = (0..6).map(|seed| repeating_noise(32, seed)).collect();
        let bare = |subject: &Subject, zoom: f32| {
            subject.bare(&from_front(1.0 + 2.0 / zoom, 20.0), 192, 192)
        };
        let noise = FeatureNoise { largest_px: 12.0, octaves: 3, persistence: 0.7, coverage: 4.0 };
        let features = |zoom: f32, seed: u64| {
            let bare = bare(&subject, zoom);
            let splats = strewn[seed as usize].splats(&bare.projection, noise);
            splats_on(&mut Compute::cpu(), &bare.depth, &splats)
        };
        let of_features = under_zoom(features, 1.5 / 3.0);
        let of_particles = under_zoom(
            |zoom, seed| {
                let bare = bare(&subject, zoom);
                let anchors = particles.anchors(&bare.projection, waves(32.0));
                anchored_on(&mut Compute::cpu(), &bare.depth, &textures[seed as usize], &anchors)
            },
            0.5,
        );
        for (name, all, tolerance) in
            [("features", of_features, 0.08), ("particles", of_particles, 0.15)]
        {
            let mean = all.iter().map(|told| told[0]).sum::<f64>() / all.len() as f64;
            let worst = all.iter().map(|told| (told[0] / mean - 1.0).abs()).fold(0.0, f64::max);
            // Measured 0.04 and 0.09.
            assert!(worst < tolerance, "{triangles}, {name}: {worst} {all:?}");
            assert!(all.iter().all(|told| told[1] < 0.01), "{triangles}, {name}: {all:?}");
        }
    }
}
