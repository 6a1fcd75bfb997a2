//! Coherent noise on CPU and GPU, on bare pixels, at a step in depth, and under a shift of the
//! camera.

use glam::{Vec3, Vec4};
use graphics::camera::{Camera, Framing};
use graphics::coherence::{FeatureNoise, Particles, Splat, repeating_noise};
use graphics::compute::Compute;
use graphics::field::Field;
use graphics::mesh::Mesh;
use suite::adapter::device;

use super::{Bare, Subject, anchored_on, from_front, splats_on, waves};

fn cameras(mesh: &Mesh) -> Vec<Camera> {
    let mut cameras = Framing::default().turntable(mesh.bounds(), 3);
    cameras.extend([from_front(1.3, 60.0), from_front(9.0, 10.0)]);
    cameras
}

fn compare(on_cpu: &Field<f32>, on_gpu: &Field<f32>, what: &str) {
    let all = || on_cpu.values().iter().chain(on_gpu.values());
    assert!(all().all(|value| (0.0..=1.0).contains(value)), "{what}: not in 0..1");
    let pairs = on_cpu.values().iter().zip(on_gpu.values());
    let worst = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
    // Rounding of a depth is about a thousandth of the depth range of a feature.
    assert!(worst < 2e-3, "{what}: {worst}");
}

#[test]
fn processor_and_device_draw_the_same() {
    let Some(mut gpu) = device().map(Compute::gpu) else { return };
    for mesh in [Mesh::sphere(900), Mesh::torus_knot(5000)] {
        let subject = Subject::new(mesh);
        for (camera, (width, height)) in
            cameras(&subject.mesh).iter().zip([(93, 61), (64, 64), (1, 9), (130, 40), (40, 77)])
        {
            let Bare { projection, depth } = subject.bare(camera, width, height);
            for noise in [FeatureNoise::FLOW, FeatureNoise::DISPERSION] {
                let splats = subject.features.splats(&projection, noise);
                let on_cpu = splats_on(&mut Compute::cpu(), &depth, &splats);
                compare(&on_cpu, &splats_on(&mut gpu, &depth, &splats), "features");
            }
            for count in [1, 6, 40] {
                let particles = Particles::new(&subject.hierarchy, count);
                let anchors = particles.anchors(&projection, waves(40.0));
                let draw = |compute: &mut Compute| {
                    anchored_on(compute, &depth, &subject.texture, &anchors)
                };
                compare(&draw(&mut Compute::cpu()), &draw(&mut gpu), "particles");
            }
        }
    }
    let empty = splats_on(&mut gpu, &Field::filled(20, 20, 1.0), &[]);
    assert_eq!(empty, Field::filled(20, 20, 0.5));
}

#[test]
fn bare_pixels_are_a_half_and_the_same_input_gives_the_same_noise() {
    let subject = Subject::new(Mesh::torus_knot(4000));
    let again = Subject::new(Mesh::torus_knot(4000));
    for camera in cameras(&subject.mesh) {
        let bare = subject.bare(&camera, 120, 90);
        let particles = Particles::new(&subject.hierarchy, 6);
        let noises = [
            subject.of_features(&bare, FeatureNoise::FLOW),
            subject.of_particles(&bare, &particles, 40.0),
        ];
        let others = [
            again.of_features(&bare, FeatureNoise::FLOW),
            again.of_particles(&bare, &Particles::new(&again.hierarchy, 6), 40.0),
        ];
        assert_eq!(noises, others);
        for noise in &noises {
            let mut pixels = noise.values().iter().zip(bare.depth.values());
            assert!(pixels.all(|(value, depth)| *depth < 1.0 || *value == 0.5));
        }
    }
    assert_ne!(repeating_noise(8, 1), repeating_noise(8, 2));
}

#[test]
fn a_feature_is_on_its_own_surface_only() {
    // A near surface on the left, a far one on the right, nothing at the bottom.
    let depth = |i: usize| match (i % 40, i / 40) {
        (_, 30..) => 1.0,
        (..20, _) => 0.3,
        _ => 0.6,
    };
    let depth = Field::from_values(40, 40, (0..1600).map(depth).collect());
    let splat = Splat {
        x: 20.0,
        y: 20.0,
        narrowness: 1.0 / 15.0,
        amplitude: 0.25,
        depth: 0.6,
        slope_x: 0.0,
        slope_y: 0.0,
        tightness: 20.0,
    };
    let drawn = splats_on(&mut Compute::cpu(), &depth, &[splat]);
    assert_eq!((drawn[(19, 20)], drawn[(20, 31)]), (0.5, 0.5));
    assert!((drawn[(20, 20)] - 0.75).abs() < 0.01, "{}", drawn[(20, 20)]);
    assert!((0.51..0.74).contains(&drawn[(27, 20)]), "{}", drawn[(27, 20)]);
    assert_eq!(drawn[(36, 20)], 0.5);
}

#[test]
fn one_texture_holds_on_to_its_particle() {
    let subject = Subject::new(Mesh::sphere(2000));
    let particles = Particles::new(&subject.hierarchy, 1);
    let from = |x: f32| Camera {
        eye: Vec3::new(x, 0.0, 40.0),
        target: Vec3::new(x, 0.0, 0.0),
        ..from_front(40.0, 4.0)
    };
    let width = 150;
    let height = 150;
    let [before, after] = [from(0.0), from(-0.2)].map(|camera| {
        let bare = subject.bare(&Camera { far: 60.0, ..camera }, width, height);
        let center = camera.clip_from_model(1.0) * Vec4::W;
        let center_px = 0.5 * width as f32 * (1.0 + center.x / center.w);
        (center_px, subject.of_particles(&bare, &particles, 24.0))
    });
    let moved = after.0 - before.0;
    assert!((moved.round() - moved).abs() < 0.3 && moved > 8.0, "{moved} px");
    let moved = moved.round() as usize;
    let differs = (40..100).map(|x| (before.1[(x, 75)] - after.1[(x + moved, 75)]).abs());
    let worst = differs.fold(0.0, f32::max);
    assert!(worst < 0.12, "{worst} after {moved} px");
}
