//! Visibility of meshes (rasterising compared with ray casting), cameras that frame a mesh, and
//! camera paths: interpolation of keyframes, closed paths, and invalid files.

use std::collections::BTreeSet;

use documents::hint::{Explain, Fault};
use glam::Vec3;
use graphics::camera::{Camera, CameraPath, Framing};
use graphics::mesh::{Material, Mesh, SampleModel, Triangle};
use graphics::surface::{
    Fragment, NO_TRIANGLE, Rasteriser, Sides, VisibilityBuffer, position_at, visible,
};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// A mesh of triangles without shared vertices.
pub(crate) fn loose(triangles: &[[Vec3; 3]]) -> Mesh {
    let corners = triangles.iter().flatten();
    let count = triangles.len() as u32;
    let normals = triangles.iter().flat_map(|[a, b, c]| {
        [(*b - *a).cross(*c - *a).try_normalize().unwrap_or(Vec3::Y).into(); 3]
    });
    Mesh {
        positions: corners.map(|&place| place.into()).collect(),
        normals: normals.collect(),
        texture_coordinates: vec![[0.0; 2]; 3 * triangles.len()],
        colors: vec![[1.0; 3]; 3 * triangles.len()],
        triangles: (0..count)
            .map(|i| Triangle { corners: [3 * i, 3 * i + 1, 3 * i + 2], material: 0 })
            .collect(),
        materials: vec![Material::plain([0.5; 3])],
    }
}

/// Random triangles around the origin. Some reach behind the camera of [`inside_them`].
pub(crate) fn random_triangles(count: usize, seed: u64) -> Mesh {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut place = |size: f32| Vec3::from([0, 1, 2].map(|_| rng.random_range(-size..size)));
    let triangles: Vec<_> = (0..count)
        .map(|i| {
            let middle = place(2.0);
            let size = if i % 5 == 0 { 4.0 } else { 0.6 };
            [0, 1, 2].map(|_| middle + place(size))
        })
        .collect();
    loose(&triangles)
}

pub(crate) fn inside_them() -> Camera {
    Camera {
        eye: Vec3::new(0.3, 0.4, 2.2),
        target: Vec3::new(0.0, 0.1, 0.0),
        up: Vec3::Y,
        field_of_view_deg: 60.0,
        near: 0.1,
        far: 6.0,
    }
}

type Exact = [f64; 3];

fn exact(place: Vec3) -> Exact {
    place.to_array().map(f64::from)
}

fn sum<const N: usize>(terms: [(Exact, f64); N]) -> Exact {
    [0, 1, 2].map(|axis| terms.iter().map(|(vector, by)| vector[axis] * by).sum())
}

fn dot(a: Exact, b: Exact) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: Exact, b: Exact) -> Exact {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// Index of the nearest triangle on the ray through `at`, a position in the picture in pixels, or
/// [`NO_TRIANGLE`]. Computes in f64.
fn cast(mesh: &Mesh, camera: &Camera, (width, height): (usize, usize), at: [f64; 2]) -> u32 {
    fn unit(vector: Exact) -> Exact {
        sum([(vector, 1.0 / dot(vector, vector).sqrt())])
    }
    fn minus(a: Exact, b: Exact) -> Exact {
        sum([(a, 1.0), (b, -1.0)])
    }
    let eye = exact(camera.eye);
    let forward = unit(minus(exact(camera.target), eye));
    let right = unit(cross(forward, exact(camera.up)));
    let up = cross(right, forward);
    let high = (f64::from(camera.field_of_view_deg) / 2.0).to_radians().tan();
    let wide = high * width as f64 / height as f64;
    let [x, y] = [at[0] / width as f64 * 2.0 - 1.0, 1.0 - at[1] / height as f64 * 2.0];
    let ray = sum([(forward, 1.0), (right, x * wide), (up, y * high)]);
    let mut nearest = (f64::from(camera.far), NO_TRIANGLE);
    for (triangle, number) in mesh.triangles.iter().zip(0..) {
        let places = triangle.corners.map(|corner| Vec3::from(mesh.positions[corner as usize]));
        let [a, b, c] = places.map(|place| minus(exact(place), eye));
        let normal = cross(minus(b, a), minus(c, a));
        // Depth along the viewing direction. `ray` has the component 1 there.
        let distance = dot(a, normal) / dot(ray, normal);
        let hit = sum([(ray, distance)]);
        let near = distance > f64::from(camera.near) && distance < nearest.0;
        if near
            && [[a, b], [b, c], [c, a]].into_iter().all(|[from, to]: [Exact; 2]| {
                dot(cross(minus(to, from), minus(hit, from)), normal) >= 0.0
            })
        {
            nearest = (distance, number);
        }
    }
    nearest.1
}

#[test]
fn every_pixel_shows_the_triangle_that_a_ray_meets_first() {
    let size = (97, 61);
    let mut agreeing = 0;
    let mut empty = 0;
    for seed in 0..6 {
        let mesh = random_triangles(60, seed);
        let camera = inside_them();
        let found = visible(&mesh, &camera, size.0, size.1);
        for y in 0..size.1 {
            for x in 0..size.0 {
                let ray = |dx: f64, dy: f64| {
                    cast(&mesh, &camera, size, [x as f64 + 0.5 + dx, y as f64 + 0.5 + dy])
                };
                let around = [[0.02, 0.0], [-0.02, 0.0], [0.0, 0.02], [0.0, -0.02]];
                let wanted = ray(0.0, 0.0);
                if around.iter().all(|&[dx, dy]| ray(dx, dy) == wanted) {
                    assert_eq!(found[(x, y)].triangle, wanted, "seed {seed}, {x}, {y}");
                    agreeing += 1;
                    empty += usize::from(wanted == NO_TRIANGLE);
                }
            }
        }
    }
    let all = 6 * size.0 * size.1;
    assert!(
        agreeing > all * 9 / 10 && empty > 10 && empty < all / 2,
        "{agreeing} {empty} of {all}"
    );
}

#[test]
fn a_pixel_tells_the_place_that_it_sees() {
    let mesh = random_triangles(60, 9);
    let camera = inside_them();
    let found = visible(&mesh, &camera, 96, 64);
    let clip_from_model = camera.clip_from_model(1.5);
    let mut seen = 0;
    for y in 0..64 {
        for x in 0..96 {
            let pixel = found[(x, y)];
            if pixel.triangle == NO_TRIANGLE {
                assert_eq!(pixel, Fragment::EMPTY, "{x}, {y}");
                continue;
            }
            let clip = clip_from_model * position_at(&mesh, pixel).extend(1.0);
            let at = [(clip.x / clip.w + 1.0) * 48.0, (1.0 - clip.y / clip.w) * 32.0];
            let off = (at[0] - x as f32 - 0.5).hypot(at[1] - y as f32 - 0.5);
            // Vertices are rounded to 1/256 of a pixel. This changes the weights in a slim
            // triangle.
            assert!(off < 0.05, "{x}, {y}: {off} pixels off: {pixel:?}");
            assert!((clip.z / clip.w - pixel.depth).abs() < 1e-3, "{x}, {y}: {pixel:?}");
            seen += 1;
        }
    }
    assert!(seen > 2000, "{seen}");
}

/// A closed fan of triangles around a point that is not at the centre of a pixel.
fn fan(spokes: usize) -> Mesh {
    let rim: Vec<Vec3> = (0..=spokes)
        .map(|i| {
            let angle = (i % spokes) as f32 / spokes as f32 * std::f32::consts::TAU;
            Vec3::new(angle.cos(), angle.sin(), 0.0)
        })
        .collect();
    let middle = Vec3::new(0.013, -0.027, 0.0);
    let triangles: Vec<_> = rim.windows(2).map(|pair| [middle, pair[0], pair[1]]).collect();
    loose(&triangles)
}

/// 15 x 15 squares in clip coordinates with corners at the centres of pixels of a picture of 128 x
/// 128. Each is two triangles with alternating diagonals.
fn squares_on_middles() -> Mesh {
    fn place(x: usize, y: usize) -> Vec3 {
        let [x, y] = [x, y].map(|i| (8 * i) as f32 / 64.0 + 4.5 / 64.0 - 1.0);
        Vec3::new(x, y, 0.5)
    }
    let squares = (0..15 * 15).map(|i| (i % 15, i / 15));
    let triangles: Vec<_> = squares
        .flat_map(|(x, y)| {
            let [a, b] = [place(x, y), place(x + 1, y)];
            let [c, d] = [place(x, y + 1), place(x + 1, y + 1)];
            if (x + y) % 2 == 0 { [[a, b, c], [b, d, c]] } else { [[a, b, d], [a, c, d]] }
        })
        .collect();
    loose(&triangles)
}

#[test]
fn edges_that_are_shared_are_drawn_once_and_leave_no_hole() {
    let disc = fan(89);
    let camera = Camera::framing(disc.bounds(), 0.0, 0.0, 40.0);
    let cases = [
        (disc, camera.clip_from_model(1.0), 8000),
        (squares_on_middles(), glam::Mat4::IDENTITY, 120 * 120),
    ];
    for (mesh, clip_from_model, least) in cases {
        let drawn_by = |triangles: &[Triangle]| {
            let mut visible = VisibilityBuffer::filled(128, 128, Fragment::EMPTY);
            let mut rasteriser = Rasteriser::default();
            let places = &mesh.positions;
            rasteriser.draw(clip_from_model, places, triangles, Sides::Both, &mut visible);
            visible
                .values()
                .iter()
                .enumerate()
                .filter_map(|(pixel, seen): (usize, &Fragment)| {
                    (seen.triangle != NO_TRIANGLE).then_some(pixel)
                })
                .collect::<BTreeSet<usize>>()
        };
        let whole = drawn_by(&mesh.triangles);
        let alone: Vec<_> = mesh.triangles.iter().map(|triangle| drawn_by(&[*triangle])).collect();
        let pixels: usize = alone.iter().map(BTreeSet::len).sum();
        assert_eq!(pixels, whole.len(), "pixels drawn twice");
        // In a disc or a square, no row has a gap.
        for y in 0..128 {
            let row: Vec<usize> = whole.range(y * 128..(y + 1) * 128).copied().collect();
            let [Some(first), Some(last)] = [row.first(), row.last()] else { continue };
            assert_eq!(last - first + 1, row.len(), "row {y}");
        }
        assert!(whole.len() >= least, "{} of {least}", whole.len());
    }
}

#[test]
fn of_equal_depth_the_first_triangle_is_seen_and_runs_agree() {
    let triangle = [Vec3::new(-1.0, -1.0, 0.0), Vec3::new(1.0, -1.0, 0.0), Vec3::Y];
    let mesh = loose(&[triangle; 5000]);
    let camera = Camera::framing(mesh.bounds(), 20.0, 10.0, 40.0);
    let found = visible(&mesh, &camera, 64, 64);
    assert!(found.values().iter().all(|seen| [0, NO_TRIANGLE].contains(&seen.triangle)));
    assert!(found[(32, 32)].triangle == 0);
    let mesh = random_triangles(9000, 4);
    let camera = inside_them();
    assert_eq!(visible(&mesh, &camera, 200, 100), visible(&mesh, &camera, 200, 100));
}

#[test]
fn the_front_of_a_closed_mesh_is_all_that_is_seen_of_it() {
    for mesh in [Mesh::sphere(900), Mesh::torus_knot(4000)] {
        let camera = Camera::framing(mesh.bounds(), 35.0, 25.0, 30.0);
        let both = visible(&mesh, &camera, 150, 150);
        let mut front = VisibilityBuffer::filled(150, 150, Fragment::EMPTY);
        let clip_from_model = camera.clip_from_model(1.0);
        Rasteriser::default().draw(
            clip_from_model,
            &mesh.positions,
            &mesh.triangles,
            Sides::Front,
            &mut front,
        );
        let differ = both.values().iter().zip(front.values()).filter(|(a, b)| a != b).count();
        assert!(differ <= 3, "{differ} pixels");
        let seen = both.values().iter().filter(|seen| seen.triangle != NO_TRIANGLE).count();
        assert!(seen > 4000, "{seen}");
    }
}

#[test]
fn empty_pictures_and_empty_meshes_show_nothing() {
    let camera = inside_them();
    assert_eq!(visible(&Mesh::sphere(100), &camera, 0, 5).values().len(), 0);
    let nothing = visible(&Mesh::default(), &camera, 5, 5);
    assert!(nothing.values().iter().all(|seen| *seen == Fragment::EMPTY));
}

#[test]
fn the_whole_box_is_framed_from_every_side() {
    let bounds = [Vec3::new(-3.0, 1.0, -0.5), Vec3::new(2.0, 2.5, 0.7)];
    let shares = |camera: &Camera, aspect: f32| {
        let corners = (0..8).map(|bits: usize| {
            Vec3::from([0, 1, 2].map(|axis: usize| bounds[bits >> axis & 1][axis]))
        });
        let clips = corners.map(|corner| camera.clip_from_model(aspect) * corner.extend(1.0));
        clips.fold([0.0f32; 2], |[x, y], clip| {
            assert!(clip.z > 0.0 && clip.z < clip.w, "between the planes: {clip}");
            [x.max((clip.x / clip.w).abs()), y.max((clip.y / clip.w).abs())]
        })
    };
    for azimuth_deg in [-170.0, -90.0, 0.0, 33.0, 90.0] {
        for elevation_deg in [-90.0, -30.0, 0.0, 45.0, 90.0] {
            for aspect in [0.5, 1.0, 1.6] {
                let framing =
                    Framing { azimuth_deg, elevation_deg, aspect, field_of_view_deg: 40.0 };
                let [x, y] = shares(&framing.camera(bounds), aspect);
                let most = x.max(y);
                assert!((0.9..0.95).contains(&most), "{framing:?}: {x} {y}");
                for camera in framing.turntable(bounds, 24) {
                    let [x, y] = shares(&camera, aspect);
                    assert!(x.max(y) < 0.95, "{camera:?}: {x} {y}");
                }
            }
        }
    }
}

#[test]
fn the_closest_camera_has_all_places_and_no_more() {
    for mesh in [Mesh::torus_knot(2000), SampleModel::StillLife.mesh(2000)] {
        let extent = |camera: &Camera, aspect: f32| {
            let clips = mesh.positions.iter().map(|&place| {
                let clip = camera.clip_from_model(aspect) * Vec3::from(place).extend(1.0);
                assert!(clip.z > 0.0 && clip.z < clip.w, "between the planes: {clip}");
                [clip.x / clip.w, clip.y / clip.w]
            });
            clips.fold([[f32::MAX, f32::MIN]; 2], |[x, y], at| {
                [[x[0].min(at[0]), x[1].max(at[0])], [y[0].min(at[1]), y[1].max(at[1])]]
            })
        };
        for (azimuth_deg, aspect) in [(0.0, 1.3), (77.0, 0.6)] {
            let framing =
                Framing { azimuth_deg, elevation_deg: 25.0, field_of_view_deg: 30.0, aspect };
            let [x, y] = extent(&framing.fit(&mesh.positions), aspect);
            assert!((x[0] + x[1]).abs() < 0.2 && (y[0] + y[1]).abs() < 0.2, "{x:?} {y:?}");
            let most = [x[1], -x[0], y[1], -y[0]].into_iter().fold(0.0, f32::max);
            assert!((0.915..0.925).contains(&most), "{x:?} {y:?}");
            for camera in framing.fit_turntable(&mesh.positions, 7) {
                let [x, y] = extent(&camera, aspect);
                let most = [x[1], -x[0], y[1], -y[0]].into_iter().fold(0.0, f32::max);
                assert!((0.4..0.925).contains(&most), "{x:?} {y:?}");
            }
        }
    }
    let nothing = Framing::default().fit(&[]);
    assert!(nothing.eye.is_finite() && nothing.near > 0.0, "{nothing:?}");
}

const PATH: &str = "
frames = 9
[[keyframe]]
eye = [0, 0, 10]
target = [0, 0, 0]
field_of_view_deg = 40
[[keyframe]]
eye = [10.0, 0.0, 0.0]
target = [0.0, 1.0, 0.0]
field_of_view_deg = 20
[[keyframe]]
eye = [0.0, 0.0, -10.0]
target = [0.0, 0.0, 0.0]
";

const BOUNDS: [Vec3; 2] = [Vec3::NEG_ONE, Vec3::ONE];

fn cameras(text: &str) -> Vec<Camera> {
    CameraPath::from_text("a path", text).unwrap().cameras(BOUNDS)
}

#[test]
fn a_path_goes_through_its_keyframes_evenly() {
    let cameras = cameras(PATH);
    assert_eq!(cameras.len(), 9);
    for (frame, eye, field) in [
        (0, Vec3::new(0.0, 0.0, 10.0), 40.0),
        (4, Vec3::new(10.0, 0.0, 0.0), 20.0),
        (8, Vec3::new(0.0, 0.0, -10.0), 35.0),
    ] {
        let camera = cameras[frame];
        assert!(camera.eye.distance(eye) < 1e-4, "{frame}: {camera:?}");
        assert!((camera.field_of_view_deg - field).abs() < 1e-3, "{frame}: {camera:?}");
    }
    assert!(cameras[4].target.distance(Vec3::Y) < 1e-5);
    // The path is smooth, so consecutive steps have similar directions.
    let steps: Vec<Vec3> = cameras.windows(2).map(|pair| pair[1].eye - pair[0].eye).collect();
    assert!(steps.windows(2).all(|pair| pair[0].normalize().dot(pair[1].normalize()) > 0.6));
    for camera in &cameras {
        for corner in [Vec3::NEG_ONE, Vec3::ONE, Vec3::new(1.0, -1.0, 1.0)] {
            let clip = camera.clip_from_model(1.0) * corner.extend(1.0);
            assert!(clip.z > 0.0 && clip.z < clip.w, "{camera:?} cuts {corner}");
        }
    }
}

#[test]
fn a_closed_path_comes_back_and_one_keyframe_stands_still() {
    let closed = cameras(&PATH.replace("frames = 9", "frames = 9\nclosed = true"));
    for (frame, eye) in [(0, [0.0, 0.0, 10.0]), (3, [10.0, 0.0, 0.0]), (6, [0.0, 0.0, -10.0])] {
        assert!(closed[frame].eye.distance(eye.into()) < 1e-4, "{frame}: {:?}", closed[frame]);
    }
    // The step from the last frame to the first is about as long as the others.
    let last = closed[0].eye.distance(closed[8].eye);
    assert!((2.0..8.0).contains(&last), "{last}");
    let still = cameras("frames = 3\n[[keyframe]]\neye = [1, 2, 3]\ntarget = [0, 0, 0]\n");
    assert!(still.iter().all(|camera| *camera == still[0]) && still.len() == 3);
    assert_eq!(still[0].eye, Vec3::new(1.0, 2.0, 3.0));
}

#[test]
fn a_way_through_the_target_has_a_sight_everywhere() {
    let text = "frames = 21\n[[keyframe]]\neye = [0, 0, 1]\ntarget = [0, 0, -1]\n\
                [[keyframe]]\neye = [0, 0, -1]\ntarget = [0, 0, 1]\nup = [0, -1, 0]\n";
    for camera in cameras(text) {
        let [right, up, back] = camera.axes();
        assert!(right.is_finite() && up.is_finite() && back.is_finite(), "{camera:?}");
    }
}

#[test]
fn bad_paths_are_refused_with_their_place() {
    for (from, to, wanted) in [
        ("frames = 9", "frames = 0", "`frames`: 0"),
        ("frames = 9", "frames = 9000000", "`frames`: 9000000"),
        ("frames = 9", "", "line 1: the key `frames` is missing"),
        ("frames = 9", "frames = 9\nfps = 3", "line 3: fps: unknown key `fps`"),
        ("target = [0, 0, 0]", "target = [0, 0, 10]", "`keyframe 1: target`"),
        ("target = [0, 0, 0]", "target = [0, 0]", "line 5"),
        ("target = [0, 0, 0]", "target = [0, nan, 0]", "`keyframe 1: target`"),
        ("= 40", "= 180", "`keyframe 1: field_of_view_deg`: `180`"),
        (
            "= 20",
            "= 20\nup = [1, 0, 0]\nroll = 3",
            "line 12: [[keyframe]] 2, roll: unknown key `roll`",
        ),
        ("target = [0, 0, 0]", "target = [0, 0, 0]\nup = [0, 0, 2]", "`keyframe 1: up`"),
        ("eye = [0, 0, 10]\n", "", "the key `eye` is missing"),
        ("[[keyframe]]", "[keyframe]", "duplicate key"),
    ] {
        let text = PATH.replacen(from, to, 1);
        assert_ne!(text, PATH);
        let error = CameraPath::from_text("a path", &text).unwrap_err();
        let message = error.to_string();
        assert!(
            message.contains(wanted) && message.contains("a path"),
            "no `{wanted}` in: {message}"
        );
        assert!(!message.contains('\n') && error.hint().is_some());
    }
    assert!(CameraPath::from_text("a path", "frames = 3").is_err());
    let error = CameraPath::open(std::path::Path::new("no/such.toml")).unwrap_err();
    assert_eq!(error.fault(), Fault::Environment, "{error}");
}
