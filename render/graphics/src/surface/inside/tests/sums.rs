//! Sums of all forms: they do not depend on order and threads, weights add up, and lengths of
//! eye rays are those of a ball.

use glam::Vec3;
use rand::SeedableRng;
use rand::seq::SliceRandom;
use rand_chacha::ChaCha8Rng;

use super::random_scenes::random_scene;
use super::scene::{Scene, camera, mesh_of};
use super::shapes::Surfaces;
use crate::field::Field;
use crate::mesh::Mesh;
use crate::surface::{Count, Crossing, CrossingSum, Crossings, WeighedCount};

/// Any weight of a surface at a pixel, of either sign.
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
    // Around the eye: its entry is before the near plane, which stands for 0.
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
