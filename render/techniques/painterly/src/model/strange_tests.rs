//! Meshes as they come from other programs: damaged, degenerate, or very large.
//!
//! With the environment variable `IMPASTO_PAINTERLY` the large mesh has 10 million triangles.

use documents::hint::Explain;
use graphics::camera::{Camera, Framing};
use graphics::mesh::{GridSize, Material, SampleModel, Triangle};

use super::super::made_up::map;
use super::super::passes::PaintedPicture;
use super::tests::flat;
use super::*;

const SIZE: (usize, usize) = (120, 90);

fn painter(mesh: &Mesh) -> Result<Painter, PainterError> {
    let mut settings = Settings::default();
    // About 3 pixels in a picture of this size.
    settings.strokes.width_px = 25.0;
    Painter::of_model(mesh, &map(2), &settings)
}

fn camera(mesh: &Mesh) -> Camera {
    Framing { aspect: 4.0 / 3.0, ..Framing::default() }.fit(&mesh.positions)
}

/// Paints a mesh. Every number of the picture is finite. Returns the number of pixels that show the
/// mesh, and of those that strokes cover.
fn covered(mesh: &Mesh, camera: &Camera) -> [usize; 2] {
    let mut painter = painter(mesh).unwrap();
    let (depth, _) = painter.splats(camera, SIZE, 0.0).unwrap();
    let PaintedPicture { color, height_mm } = painter.paint(camera, SIZE, 0.0).unwrap();
    assert!(color.values().iter().flatten().all(|value| (0.0..=1.0).contains(value)));
    assert!(height_mm.values().iter().all(|height| height.is_finite()));
    let seen: Vec<bool> = depth.values().iter().map(|depth| *depth < 1.0).collect();
    let pixels = color.values().iter().zip(&seen);
    let painted = pixels.filter(|(pixel, seen)| **seen && pixel[3] > 0.5).count();
    [seen.iter().filter(|seen| **seen).count(), painted]
}

/// Strokes cover what shows of a mesh, but for one pixel in 100.
fn assert_covered(mesh: &Mesh, camera: &Camera, least: usize) {
    let [seen, painted] = covered(mesh, camera);
    assert!(seen >= least && painted * 100 >= seen * 99, "{painted} of {seen}");
}

/// The flat square in cells of this number.
fn square(columns: usize, rows: usize) -> Mesh {
    let mut mesh = Mesh { materials: vec![Material::plain([0.8; 3])], ..Mesh::default() };
    mesh.add_grid(GridSize { columns, rows }, 0, |at| {
        Vec3::new(2.0 * at.x - 1.0, 1.0 - 2.0 * at.y, 0.0)
    });
    mesh
}

#[test]
fn needles_and_triangles_without_area_are_painted_over() {
    let mut needles = square(3000, 1);
    let [seen, _] = covered(&needles, &camera(&needles));
    // Corners on a line, and three times the same corner.
    let add = |corners| Triangle { corners, material: 0 };
    needles.triangles.extend([add([0, 1, 2]), add([0, 1500, 3000]), add([7, 7, 7])]);
    assert_covered(&needles, &camera(&needles), seen);
    let mut one = square(1, 1);
    one.triangles.truncate(1);
    assert_covered(&one, &camera(&one), 1000);
}

#[test]
fn numbers_that_are_none_are_refused_with_their_vertex() {
    type Spoil = fn(&mut Mesh);
    let spoilt: [(Spoil, &str); 5] = [
        (|mesh| mesh.positions[5][1] = f32::NAN, "vertex 5 has the position"),
        (|mesh| mesh.positions[9][0] = f32::INFINITY, "vertex 9 has the position"),
        (|mesh| mesh.normals[3][2] = f32::NAN, "vertex 3 has the normal"),
        (|mesh| mesh.normals.clear(), "0 normals for 625 vertices"),
        (|mesh| mesh.triangles[2].corners[0] = 700, "triangle 2 has vertex 700, of 625"),
    ];
    for (spoil, message) in spoilt {
        let mut mesh = flat();
        spoil(&mut mesh);
        let error = painter(&mesh).unwrap_err();
        assert!(error.to_string().starts_with(message), "{error}");
        assert!(error.hint().is_some(), "{error}");
    }
}

#[test]
fn normals_of_no_length_or_all_alike_do_not_leave_holes() {
    let ball = Mesh::sphere(3000);
    for normal in [[0.0; 3], [0.0, 1.0, 0.0], [1e-30; 3], [1e30; 3]] {
        let mut mesh = ball.clone();
        mesh.normals.iter_mut().for_each(|own| *own = normal);
        assert_covered(&mesh, &camera(&mesh), 2000);
    }
}

#[test]
fn sheets_that_share_an_edge_and_meshes_that_are_open_are_painted() {
    // Three pages at one spine, one of them wound the other way round.
    let page = square(12, 12);
    let mut book = Mesh { materials: page.materials.clone(), ..Mesh::default() };
    for (turn, flipped) in [(0.3_f32, false), (1.5, true), (2.6, false)] {
        let first = book.positions.len() as u32;
        book.positions.extend(
            page.positions
                .iter()
                .copied()
                .map(|[x, y, _]: [f32; 3]| [(x + 1.0) * turn.cos(), y, (x + 1.0) * turn.sin()]),
        );
        let side = if flipped { 1.0 } else { -1.0 };
        let normal = [side * turn.sin(), 0.0, -side * turn.cos()];
        book.normals.extend(page.normals.iter().map(|_| normal));
        book.texture_coordinates.extend(&page.texture_coordinates);
        book.colors.extend(&page.colors);
        book.triangles.extend(page.triangles.iter().map(|triangle| {
            let [a, b, c] = triangle.corners.map(|corner| corner + first);
            Triangle { corners: if flipped { [a, c, b] } else { [a, b, c] }, material: 0 }
        }));
    }
    assert_covered(&book, &camera(&book), 500);
    let mut torn = Mesh::torus_knot(4000);
    let mut number = 0;
    torn.triangles.retain(|_| {
        number += 1;
        number % 7 != 0
    });
    assert_covered(&torn, &camera(&torn), 500);
}

#[test]
fn a_ball_that_bends_alike_in_all_directions_has_strokes_everywhere() {
    for triangles in [100, 20_000] {
        let ball = Mesh::sphere(triangles);
        assert_covered(&ball, &camera(&ball), 800);
        let inside = Camera { eye: Vec3::ZERO, target: Vec3::X, near: 0.01, ..camera(&ball) };
        assert_covered(&ball, &inside, SIZE.0 * SIZE.1);
    }
    // Faces of a ball of six triangles are so steep that planes of splats miss some of their pixels.
    let coarse = Mesh::sphere(6);
    let [seen, painted] = covered(&coarse, &camera(&coarse));
    assert!(seen > 2000 && painted * 100 > seen * 95, "{painted} of {seen}");
}

#[test]
fn the_size_of_a_model_and_its_place_do_not_matter() {
    for (scale, away) in [(1e-6, 0.0), (1e6, 0.0), (1e-3, 1.0), (1.0, 300.0)] {
        let mut mesh = Mesh::torus_knot(3000);
        mesh.positions.iter_mut().flatten().for_each(|at| *at = *at * scale + away);
        assert_covered(&mesh, &camera(&mesh), 1000);
    }
}

#[test]
fn a_large_mesh_is_painted() {
    let whole = std::env::var_os("IMPASTO_PAINTERLY").is_some();
    let triangles = if whole { 10_000_000 } else { 100_000 };
    let mesh = SampleModel::TorusKnot.mesh(triangles);
    assert!(mesh.triangles.len() > triangles * 9 / 10);
    assert_covered(&mesh, &camera(&mesh), 1000);
}

#[test]
fn cameras_around_a_model_see_it_from_outside() {
    for shape in [SampleModel::TorusKnot, SampleModel::StillLife] {
        let mesh = shape.mesh(3000);
        let painter = Painter::of_model(&mesh, &map(1), &Settings::default()).unwrap();
        let framing = Framing::default();
        for camera in framing.fit_turntable(&mesh.positions, 24) {
            assert!(!painter.holds(&camera), "{}: {camera:?}", shape.name());
        }
        let camera = framing.fit(&mesh.positions);
        let near = Camera { near: (camera.eye - camera.target).length(), ..camera };
        assert!(painter.holds(&near), "the near plane cuts it");
        let inside = Camera { eye: camera.target + 0.01 * (camera.eye - camera.target), ..camera };
        assert!(painter.holds(&inside), "the eye is inside");
    }
}
