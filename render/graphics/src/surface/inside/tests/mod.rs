//! Tests of counting on the processor, against winding numbers: hard positions of the eye and
//! planes of the camera, many surfaces, order of sums, weights and lengths of eye rays.

mod scene;
mod device;

use glam::Vec3;
use rand::{SeedableRng, seq::SliceRandom};
use rand_chacha::ChaCha8Rng;

use crate::field::Field;
use crate::mesh::Mesh;
use crate::surface::{
    Count, Crossing, CrossingSum, Crossings, Fragment, VisibilityBuffer, WeighedCount,
};
use scene::{CountErrors, Scene, Surfaces, camera, mesh_of, random_scene, wall};

fn before_wall(surfaces: Surfaces) -> Scene {
    let camera = camera(Vec3::ZERO, Vec3::NEG_Z);
    Scene { mesh: wall(-3.0, 6.0, 4), surfaces, camera, size: (97, 61) }
}

fn agreed(scene: &Scene) -> CountErrors {
    let found = scene.compared_with_winding_numbers();
    assert!(found.wrong == 0 && found.differ * 500 <= found.samples, "{found:?}");
    found
}

#[test]
fn the_eye_may_stand_in_nested_surfaces() {
    let random = &mut ChaCha8Rng::seed_from_u64(5);
    for nested in [0, 1, 2, 5] {
        let mut surfaces = Surfaces::default();
        // Every second nested surface ends before the wall, the others reach through it.
        for i in 0..nested {
            let radius = if i % 2 == 0 { 4.5 } else { 0.5 };
            surfaces.add_bumpy(Vec3::ZERO, radius * (1.0 + 0.1 * i as f32), random);
        }
        surfaces.add_bumpy(Vec3::new(0.4, 0.2, -3.0), 0.7, random);
        let found = agreed(&before_wall(surfaces));
        assert_eq!(found.most, 1 + (nested + 1) / 2, "{nested} nested: {found:?}");
    }
}

#[test]
fn the_near_plane_may_cut_a_surface() {
    let mut surfaces = Surfaces::default();
    surfaces.add_ball(Vec3::new(0.2, 0.1, -0.5), 0.47);
    surfaces.add_ball(Vec3::new(0.3, 0.0, -1.7), 1.66);
    let mut scene = before_wall(surfaces);
    for near in [0.01, 0.05, 0.3, 1.0, 2.9] {
        scene.camera.near = near;
        assert_eq!(agreed(&scene).most, 1, "near {near}");
    }
}

#[test]
fn a_surface_may_lie_beyond_the_far_plane_or_reach_there() {
    let mut surfaces = Surfaces::default();
    surfaces.add_ball(Vec3::new(0.5, 0.0, -3.0), 0.8);
    surfaces.add_ball(Vec3::new(-0.5, 0.0, -5.0), 1.0);
    surfaces.add_ball(Vec3::ZERO, 100.0);
    let mut scene = before_wall(surfaces);
    scene.camera.far = 3.01;
    assert_eq!(agreed(&scene).most, 2);
    let inside = scene.counts().values().iter().filter(|&&count| count == 2).count();
    assert!(inside > 200, "{inside}");
}

#[test]
fn three_hundred_surfaces_count_three_hundred() {
    for count in [256, 300] {
        let mut surfaces = Surfaces::default();
        for i in 0..count {
            surfaces.add_ball(Vec3::new(0.0, 0.0, -3.0), 1.0 + i as f32 * 0.003);
        }
        let counts = before_wall(surfaces).counts();
        assert_eq!(counts[(48, 30)], count);
        assert_eq!(counts.values().iter().max(), Some(&count));
        assert_eq!(counts[(0, 0)], 0);
    }
}

/// A buffer in which every pixel shows a point on the near plane, so that every face counts.
fn without_depth((width, height): (usize, usize)) -> VisibilityBuffer {
    let seen = Fragment { triangle: 0, second: 0.0, third: 0.0, depth: 0.0 };
    VisibilityBuffer::filled(width, height, seen)
}

#[test]
fn a_surface_wholly_before_the_camera_sums_to_nothing() {
    let random = &mut ChaCha8Rng::seed_from_u64(6);
    let size = (203, 121);
    for eye in [Vec3::new(0.0, 0.0, 3.0), Vec3::new(1.5, 0.7, 1.9), Vec3::new(0.1, 2.6, 0.2)] {
        let mut surfaces = Surfaces::default();
        for _ in 0..20 {
            surfaces.add_bumpy(Vec3::ZERO, 1.0, random);
        }
        for size in [size, (1, 1), (8, 8), (67, 33)] {
            let seen = without_depth(size);
            let camera = camera(eye, Vec3::new(0.2, 0.1, 0.0));
            let sums = Crossings::default().sum(&Count, surfaces.closed(), &camera, &seen);
            assert!(sums.values().iter().all(|&sum| sum == 0), "{eye}: {size:?}");
        }
    }
}

#[test]
fn the_skin_itself_counts_from_the_side_of_the_eye() {
    // Faces with the corners of the wall have its depth, bit for bit. One box begins on the wall
    // and lies behind it, so it does not hold the wall. The other ends on the wall and holds it.
    let mut scene = before_wall(Surfaces::default());
    scene.mesh = wall(-3.0, 1.0, 1);
    scene.surfaces.add_box(Vec3::new(-1.0, -1.0, -4.0), Vec3::new(1.0, 1.0, -3.0));
    assert!(scene.counts().values().iter().all(|&count| count == 0));
    scene.surfaces.add_box(Vec3::new(-1.0, -1.0, -3.0), Vec3::new(1.0, 1.0, -2.0));
    let counts = scene.counts();
    let visible = scene.visible();
    let inside = counts.values().iter().zip(visible.values());
    assert!(inside.clone().all(|(&count, seen)| count == i32::from(*seen != Fragment::EMPTY)));
    assert!(inside.filter(|(count, _)| **count == 1).count() > 300);
}

#[test]
fn counts_do_not_depend_on_the_tessellation_of_the_scene() {
    let random = &mut ChaCha8Rng::seed_from_u64(7);
    let mut surfaces = Surfaces::default();
    for i in 0..12 {
        let at = Vec3::new(0.5 * (i % 4) as f32 - 0.8, 0.6 * (i / 4) as f32 - 0.5, -3.0);
        surfaces.add_bumpy(at, 0.5, random);
    }
    let mut scene = before_wall(surfaces);
    scene.camera = camera(Vec3::new(1.0, 0.6, 0.0), Vec3::new(0.0, 0.0, -3.0));
    scene.size = (250, 190);
    let [few, many] = [1, 100].map(|cells| {
        scene.mesh = wall(-3.0, 6.0, cells);
        scene.counts()
    });
    let differ = few.values().iter().zip(many.values()).filter(|(a, b)| a != b).count();
    assert!(few.values().contains(&3));
    assert!(differ * 2000 <= few.values().len(), "{differ}");
}

fn weight(surface: u32, pixel: usize) -> i32 {
    (surface.wrapping_mul(2_654_435_761) ^ (pixel as u32).wrapping_mul(40_503)) as i32 >> 12
}

fn weighed(scene: &Scene) -> Field<i32> {
    let Scene { surfaces, camera, .. } = scene;
    let visible = scene.visible();
    Crossings::default().sum(&WeighedCount(weight), surfaces.closed(), camera, &visible)
}

#[test]
fn order_and_threads_do_not_change_a_bit() {
    for seed in [2, 5] {
        let mut scene = random_scene(seed);
        scene.size = (160, 203);
        let counts = scene.counts();
        let sums = weighed(&scene);
        for threads in [1, 2, 8] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let again = pool.install(|| scene.counts());
            assert_eq!(counts, again, "{threads} threads");
        }
        let random = &mut ChaCha8Rng::seed_from_u64(seed);
        scene.surfaces.triangles.shuffle(random);
        assert_eq!(counts, scene.counts(), "shuffled");
        assert_eq!(sums, weighed(&scene), "weighed and shuffled");
        assert!(counts.values().iter().any(|&count| count > 1));
    }
}

#[test]
fn memory_of_an_earlier_picture_leaves_no_trace() {
    let mut crossings = Crossings::default();
    for seed in [31, 32, 33] {
        let scene = random_scene(seed);
        let Scene { surfaces, camera, .. } = &scene;
        let found = crossings.sum(&Count, surfaces.closed(), camera, &scene.visible());
        assert_eq!(found, scene.counts());
    }
}

#[test]
fn weights_are_summed_over_the_surfaces_that_hold_a_point() {
    let scene = random_scene(41);
    let Surfaces { triangles, count, .. } = &scene.surfaces;
    let sums = weighed(&scene);
    let mut expected = Field::filled(scene.size.0, scene.size.1, 0_i32);
    for surface in 0..*count {
        let own: Vec<_> = triangles.iter().filter(|one| one.material == surface).copied().collect();
        let only = Surfaces { triangles: own, ..scene.surfaces.clone() };
        let alone = Scene { surfaces: only, mesh: scene.mesh.clone(), ..scene };
        let counts = alone.counts();
        assert!(counts.values().iter().all(|count| [0, 1].contains(count)), "{surface}");
        for (pixel, (sum, count)) in
            expected.values_mut().iter_mut().zip(counts.values()).enumerate()
        {
            *sum += count * weight(surface, pixel);
        }
    }
    assert_eq!(sums, expected);
    assert!(sums.values().iter().any(|&sum| sum != 0));
}

/// Length of the eye ray inside surfaces, along the viewing direction and up to a limit.
struct Length {
    up_to: f32,
}

impl CrossingSum for Length {
    type Sum = f32;

    const EVERY_CROSSING: bool = true;

    fn add(&self, sum: &mut f32, crossing: &Crossing) {
        *sum += crossing.sign as f32 * crossing.view_depth().min(self.up_to);
    }
}

#[test]
fn every_crossing_gives_the_length_inside_a_ball() {
    let mut surfaces = Surfaces::default();
    surfaces.add_ball(Vec3::new(0.0, 0.0, -3.0), 1.0);
    // This ball is around the eye. Its entry is before the near plane, so the length starts at 0.
    surfaces.add_ball(Vec3::ZERO, 0.5);
    let nothing = mesh_of(&[]);
    let camera = camera(Vec3::ZERO, Vec3::NEG_Z);
    let scene = Scene { mesh: nothing, surfaces, camera, size: (121, 121) };
    let length = |up_to: f32| {
        let visible = scene.visible();
        Crossings::default().sum(&Length { up_to }, scene.surfaces.closed(), &camera, &visible)
    };
    // Faces of the balls lie up to 5 % inside of them.
    for (up_to, expected) in [(f32::INFINITY, 2.5), (3.0, 1.5), (1.5, 0.5), (0.2, 0.2)] {
        let found = length(up_to)[(60, 60)];
        assert!((found / expected - 1.0).abs() < 0.05, "{up_to}: {found}");
    }
    let corner = length(f32::INFINITY)[(0, 0)];
    assert!((0.35..0.5).contains(&corner), "{corner}");
}

#[test]
fn pictures_and_surfaces_may_be_empty() {
    let scene = random_scene(51);
    let nothing = Surfaces::default();
    let none = Scene { surfaces: nothing, mesh: scene.mesh.clone(), ..scene };
    assert!(none.counts().values().iter().all(|&count| count == 0));
    let empty = Scene { size: (0, 7), mesh: Mesh::default(), ..none };
    assert!(empty.counts().values().is_empty());
}
