//! Counting in the stencil of a graphics device, compared with the processor. Without a device
//! these tests pass, with a note on standard error.

use std::io::Write;

use glam::Vec3;
use rand::{SeedableRng, seq::SliceRandom};
use rand_chacha::ChaCha8Rng;

use super::scene::{Scene, Surfaces, camera, random_scene, wall};
use crate::compute::{Compute, Image};
use crate::field::Field;
use crate::gpu::{BackendChoice, choose};
use crate::surface::{Fragment, Gates, InsideCounter, Model, PackedMesh, VisibilityBuffer};

/// A device, hardware before software. If you set the environment variable `IMPASTO_GPU_TESTS`,
/// this appends the name of the adapter (or `none`) to the file with that name.
fn device() -> Option<Compute> {
    let device = choose(BackendChoice::Gpu).ok().flatten();
    let name = device.as_ref().map_or("none", |device| &device.adapter().name);
    if let Some(path) = std::env::var_os("IMPASTO_GPU_TESTS") {
        let mut list = std::fs::OpenOptions::new().append(true).create(true).open(path).unwrap();
        writeln!(list, "{name}").unwrap();
    }
    if device.is_none() {
        let _ = writeln!(std::io::stderr(), "no graphics adapter: not tested");
    }
    device.map(Compute::gpu)
}

impl Scene {
    fn packed(&self) -> PackedMesh {
        let mut mesh = self.mesh.clone();
        let count = mesh.positions.len();
        mesh.normals = vec![[0.0, 0.0, 1.0]; count];
        mesh.texture_coordinates = vec![[0.0; 2]; count];
        mesh.colors = vec![[1.0; 3]; count];
        PackedMesh::new(&mesh)
    }

    fn counts_of(&self, compute: &mut Compute, counter: &mut InsideCounter) -> Field<i32> {
        let Self { surfaces, camera, size, .. } = self;
        let mut model = Model::new(compute, self.packed()).unwrap();
        let visible = model.visible(compute, camera, size.0, size.1).unwrap();
        let counts = counter.counts(compute, (&model, &visible), camera, surfaces.closed());
        compute.download(&counts.unwrap()).unwrap()
    }

    fn weighed_of(&self, compute: &mut Compute, weights: &[i32]) -> Field<i32> {
        let Self { surfaces, camera, size, .. } = self;
        let mut model = Model::new(compute, self.packed()).unwrap();
        let visible = model.visible(compute, camera, size.0, size.1).unwrap();
        let weighed = (surfaces.closed(), weights);
        let sums = InsideCounter::default().weighed(compute, &visible, camera, weighed);
        compute.download(&sums.unwrap()).unwrap()
    }

    fn gated_of(
        &self,
        compute: &mut Compute,
        surfaces: &[[f32; 8]],
        normals: &[[f32; 4]],
    ) -> Field<i32> {
        let camera = &self.camera;
        let size = self.size;
        let mut model = Model::new(compute, self.packed()).unwrap();
        let visible = model.visible(compute, camera, size.0, size.1).unwrap();
        let normals = Field::from_values(normals.len(), 1, normals.to_vec());
        let gates = Gates { surfaces, normals: &compute.upload(&normals).unwrap() };
        let gated = (self.surfaces.closed(), gates);
        let counts = InsideCounter::default().gated(compute, &visible, camera, gated);
        compute.download(&counts.unwrap()).unwrap()
    }
}

/// Number of values that differ. They may differ only at edges: this panics if one differs where
/// the processor has a single value within one pixel around.
fn differing(on_cpu: &Field<i32>, on_gpu: &Field<i32>, what: &str) -> usize {
    let width = on_cpu.width();
    let height = on_cpu.height();
    assert_eq!((width, height), (on_gpu.width(), on_gpu.height()));
    let mut differ = 0;
    for (y, x) in (0..height).flat_map(|y| (0..width).map(move |x| (y, x))) {
        let found = on_gpu[(x, y)];
        if found != on_cpu[(x, y)] {
            differ += 1;
            let rows = y.saturating_sub(1)..(y + 2).min(height);
            let left = x.saturating_sub(1);
            let mut near = rows.flat_map(|row| on_cpu.row(row, left, (x + 2).min(width) - left));
            let own = on_cpu[(x, y)];
            assert!(near.any(|&count| count != own), "{what}: {x}, {y}: {found} for {own}");
        }
    }
    differ
}

#[test]
fn the_device_counts_as_the_processor_does() {
    let Some(mut on_gpu) = device() else { return };
    let mut counter = InsideCounter::default();
    let mut differ = 0;
    let mut all = 0;
    let mut most = 0;
    for (seed, size) in (60..72).zip([(97, 61), (256, 40), (1, 1), (8, 8), (67, 33)].iter().cycle())
    {
        let mut scene = random_scene(seed);
        scene.size = *size;
        let on_cpu = scene.counts_of(&mut Compute::cpu(), &mut InsideCounter::default());
        let found = scene.counts_of(&mut on_gpu, &mut counter);
        let here = differing(&on_cpu, &found, &format!("scene {seed}"));
        differ += here;
        all += on_cpu.values().len();
        most = most.max(*on_cpu.values().iter().max().unwrap());
        scene.surfaces.triangles.shuffle(&mut ChaCha8Rng::seed_from_u64(seed));
        assert_eq!(scene.counts_of(&mut on_gpu, &mut counter), found, "scene {seed} shuffled");
    }
    assert!(differ * 500 <= all && most > 2, "{differ} of {all}, up to {most}");
}

#[test]
fn nothing_holds_what_is_not_seen_on_the_device() {
    let Some(mut on_gpu) = device() else { return };
    let mut surfaces = Surfaces::default();
    // The depths do not resolve the far sides of these.
    for radius in [1.0, 100.0, 1e7] {
        surfaces.add_ball(Vec3::new(0.1, 0.0, 0.0), radius);
    }
    let camera = camera(Vec3::ZERO, Vec3::NEG_Z);
    let scene = Scene { mesh: wall(-3.0, 0.7, 2), surfaces, camera, size: (97, 61) };
    let [counts, weighed] = [
        scene.counts_of(&mut on_gpu, &mut InsideCounter::default()),
        match on_gpu.device().is_some_and(crate::gpu::Device::scatters) {
            true => scene.weighed_of(&mut on_gpu, &[1; 3]),
            false => scene.counts(),
        },
    ];
    let mut shown = 0;
    for ((seen, count), weighed) in
        scene.visible().values().iter().zip(counts.values()).zip(weighed.values())
    {
        let wanted = if *seen == Fragment::EMPTY { 0 } else { 2 };
        assert_eq!((*count, *weighed), (wanted, wanted));
        shown += usize::from(wanted > 0);
    }
    assert!((300..3000).contains(&shown), "{shown}");
}

#[test]
fn the_device_weighs_as_the_processor_does() {
    let Some(mut on_gpu) = device() else { return };
    let scatters = on_gpu.device().is_some_and(crate::gpu::Device::scatters);
    if !scatters {
        return;
    }
    let mut held = 0;
    for seed in 80..84 {
        let scene = random_scene(seed);
        let weights: Vec<i32> =
            (0..scene.surfaces.count as i32).map(|i| (i - 7) * 1_000_003).collect();
        let on_cpu = scene.weighed_of(&mut Compute::cpu(), &weights);
        let found = scene.weighed_of(&mut on_gpu, &weights);
        let differ = differing(&on_cpu, &found, &format!("scene {seed}"));
        assert!(differ * 500 <= on_cpu.values().len(), "scene {seed}: {differ}");
        held += on_cpu.values().iter().filter(|&&sum| sum != 0).count();
    }
    assert!(held > 1000, "{held}");
}

#[test]
fn the_device_gates_as_the_processor_does() {
    let Some(mut on_gpu) = device() else { return };
    if !on_gpu.device().is_some_and(crate::gpu::Device::scatters) {
        return;
    }
    fn turned(i: usize) -> Vec3 {
        Vec3::new(i as f32 * 0.7 - 3.0, 1.3 - (i % 5) as f32, (i % 3) as f32)
    }
    let mut held = 0;
    let mut kept_out = 0;
    for seed in 90..94 {
        let scene = random_scene(seed);
        let gates: Vec<[f32; 8]> = (0..scene.surfaces.count as usize)
            .map(|i: usize| {
                let [x, y, z] = turned(i).normalize().to_array();
                [x, y, z, [-2.0, -0.2, 0.3][i % 3], (i % 4) as f32, 9.0, 9.0, 9.0]
            })
            .collect();
        let normals: Vec<[f32; 4]> = (0..scene.mesh.triangles.len())
            .map(|i: usize| turned(7 * i).normalize().extend((i / 50 % 4) as f32).to_array())
            .collect();
        let on_cpu = scene.gated_of(&mut Compute::cpu(), &gates, &normals);
        let found = scene.gated_of(&mut on_gpu, &gates, &normals);
        let differ = differing(&on_cpu, &found, &format!("scene {seed}"));
        assert!(differ * 500 <= on_cpu.values().len(), "scene {seed}: {differ}");
        let all = scene.counts();
        held += on_cpu.values().iter().filter(|&&count| count != 0).count();
        kept_out += on_cpu.values().iter().zip(all.values()).filter(|(a, b)| a < b).count();
    }
    assert!(held > 1000 && kept_out > 500, "{held} {kept_out}");
}

#[test]
fn the_device_counts_beyond_the_stencil() {
    let Some(mut on_gpu) = device() else { return };
    for (count, shuffled) in [(255, false), (256, false), (300, true), (600, false)] {
        let mut surfaces = Surfaces::default();
        for i in 0..count {
            surfaces.add_ball(Vec3::new(0.0, 0.0, -3.0), 1.0 + i as f32 * 0.001);
        }
        if shuffled {
            surfaces.triangles.shuffle(&mut ChaCha8Rng::seed_from_u64(10));
        }
        let camera = camera(Vec3::ZERO, Vec3::NEG_Z);
        let scene = Scene { mesh: wall(-3.0, 6.0, 4), surfaces, camera, size: (97, 61) };
        let found = scene.counts_of(&mut on_gpu, &mut InsideCounter::default());
        assert_eq!((found[(48, 30)], found[(0, 0)]), (count, 0));
        assert_eq!(found.values().iter().max(), Some(&count));
        let on_cpu = scene.counts();
        let differ = differing(&on_cpu, &found, &format!("{count} balls"));
        // Six hundred outlines lie close together.
        assert!(differ * 50 <= on_cpu.values().len(), "{count}: {differ}");
    }
}

#[test]
fn planes_of_the_camera_do_not_change_what_the_device_counts() {
    let Some(mut on_gpu) = device() else { return };
    let random = &mut ChaCha8Rng::seed_from_u64(8);
    let mut surfaces = Surfaces::default();
    surfaces.add_bumpy(Vec3::new(0.0, 0.0, -0.2), 3.1, random);
    surfaces.add_bumpy(Vec3::ZERO, 0.5, random);
    surfaces.add_bumpy(Vec3::new(0.5, 0.0, -3.0), 0.8, random);
    surfaces.add_bumpy(Vec3::new(-0.5, 0.0, -5.0), 1.0, random);
    surfaces.add_bumpy(Vec3::ZERO, 100.0, random);
    let camera = camera(Vec3::ZERO, Vec3::NEG_Z);
    let mut scene = Scene { mesh: wall(-3.0, 6.0, 4), surfaces, camera, size: (97, 61) };
    for (near, far) in [(0.05, 20.0), (0.3, 3.01), (0.01, 4.0), (2.0, 3.5)] {
        (scene.camera.near, scene.camera.far) = (near, far);
        let on_cpu = scene.counts();
        let found = scene.counts_of(&mut on_gpu, &mut InsideCounter::default());
        let differ = differing(&on_cpu, &found, &format!("{near} to {far}"));
        assert!(differ * 500 <= found.values().len(), "{near} to {far}: {differ}");
        assert!(found.values().iter().all(|count| (1..=3).contains(count)));
    }
}

#[test]
fn without_depth_the_device_sums_a_whole_surface_to_nothing() {
    let Some(mut on_gpu) = device() else { return };
    if !on_gpu.device().is_some_and(crate::gpu::Device::scatters) {
        return;
    }
    let random = &mut ChaCha8Rng::seed_from_u64(9);
    let mut surfaces = Surfaces::default();
    for _ in 0..20 {
        surfaces.add_bumpy(Vec3::ZERO, 1.0, random);
    }
    let camera = camera(Vec3::new(1.5, 0.7, 1.9), Vec3::new(0.2, 0.1, 0.0));
    let weights: Vec<i32> = (1..=20).map(|i| i * i).collect();
    // We see it on the near plane, so that no face is before it.
    let seen = Fragment { triangle: 0, second: 0.0, third: 0.0, depth: 0.0 };
    let seen = VisibilityBuffer::filled(203, 121, seen);
    let visible: Image<Fragment> = on_gpu.upload(&seen).unwrap();
    let weighed = (surfaces.closed(), &weights[..]);
    let sums = InsideCounter::default().weighed(&mut on_gpu, &visible, &camera, weighed).unwrap();
    assert!(on_gpu.download(&sums).unwrap().values().iter().all(|&sum| sum == 0));
    let near_wall = wall(1.0, 0.5, 1);
    let mut scene = Scene { mesh: near_wall, surfaces, camera, size: (203, 121) };
    scene.camera = super::scene::camera(Vec3::new(0.0, 0.0, 1.06), Vec3::ZERO);
    scene.surfaces.vertices.iter_mut().for_each(|at| at[2] -= 2.0);
    let counts = scene.counts_of(&mut on_gpu, &mut InsideCounter::default());
    assert!(counts.values().iter().all(|&count| count == 0));
}

#[test]
fn surfaces_may_be_absent_and_sizes_are_checked() {
    let Some(mut on_gpu) = device() else { return };
    let camera = camera(Vec3::ZERO, Vec3::NEG_Z);
    let surfaces = Surfaces::default();
    let scene = Scene { mesh: wall(-3.0, 6.0, 4), surfaces, camera, size: (31, 7) };
    let counts = scene.counts_of(&mut on_gpu, &mut InsideCounter::default());
    assert!(counts.values().iter().all(|&count| count == 0));
    let Compute::Gpu(gpu) = &on_gpu else { panic!("a device") };
    for size in [(0, 4), (4, 0), (1 << 20, 4)] {
        let refused = gpu.device().stencil_target(size.0, size.1);
        assert!(refused.unwrap_err().to_string().contains("its sides may be of 1 to"));
    }
}
