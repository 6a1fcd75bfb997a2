use glam::{Quat, Vec3};

use super::{Along, DirectionFault, DirectionField, DirectionSettings, FlowField, Guide, Line};
use crate::mesh::SampleModel;
use crate::mesh::model::Mesh;
use crate::mesh::test_shapes::{
    bare, cylinder, degrees_between, ellipsoid, ragged, ridge, rough, square, torus, turned,
};

fn field(mesh: &Mesh) -> DirectionField {
    DirectionField::of_curvature(mesh, &DirectionSettings::default(), &[]).unwrap()
}

fn edges(mesh: &Mesh) -> impl Iterator<Item = [usize; 2]> {
    mesh.triangles.iter().flat_map(|triangle| {
        let [a, b, c] = triangle.corners.map(|corner| corner as usize);
        [[a, b], [b, c], [c, a]]
    })
}

/// Root mean square angle between the lines at both ends of the edges, in degrees.
fn roughness(mesh: &Mesh, field: &DirectionField) -> f32 {
    let angles = edges(mesh).map(|[a, b]| degrees_between(field.along(a), field.along(b).into()));
    let (sum, count) =
        angles.fold((0.0, 0), |(sum, count), angle| (sum + angle * angle, count + 1));
    (sum / count as f32).sqrt()
}

fn greatest_error(
    mesh: &Mesh,
    field: &DirectionField,
    chosen: impl Fn(Vec3) -> bool,
    wanted: impl Fn(Vec3) -> Vec3,
) -> f32 {
    let vertices = mesh.positions.iter().map(|&at| Vec3::from(at)).enumerate();
    let angles = vertices
        .filter(|&(_, at)| chosen(at))
        .map(|(vertex, at)| degrees_between(field.along(vertex), wanted(at)));
    angles.fold(0.0, f32::max)
}

/// Checks that every direction and arrow is a unit vector, that strengths and reliabilities are 0
/// to 1, and that flow is no longer than 1.
fn assert_sound(name: &str, mesh: &Mesh, field: &DirectionField, flow: &FlowField) {
    for vertex in 0..mesh.positions.len() {
        for direction in [field.along(vertex), flow.arrow(vertex)] {
            let length = Vec3::from(direction).length();
            assert!((length - 1.0).abs() < 1e-5, "{name}, vertex {vertex}: {direction:?}");
        }
        let strength = flow.strength(vertex);
        assert!((0.0..=1.0).contains(&strength), "{name}, vertex {vertex}: {strength}");
        assert!((0.0..=1.0).contains(&field.reliability(vertex)), "{name}, vertex {vertex}");
    }
    for triangle in &mesh.triangles {
        let weights = [0.5, 0.2, 0.3];
        let line = Vec3::from(field.within(triangle.corners, weights)).length();
        let along = Vec3::from(flow.within(triangle.corners, weights)).length();
        assert!((line - 1.0).abs() < 1e-5 && along < 1.00001, "{name}: {line}, {along}");
    }
}

#[test]
fn lines_follow_the_least_or_the_greatest_curvature() {
    let ring = torus(4000, 1.0, 0.4);
    fn around(at: Vec3) -> Vec3 {
        Vec3::Z.cross(at).normalize()
    }
    let error = greatest_error(&ring, &field(&ring), |_| true, around);
    assert!(error < 1.0, "torus, least: {error} deg");
    let settings = DirectionSettings { along: Along::Greatest, ..DirectionSettings::default() };
    let across = DirectionField::of_curvature(&ring, &settings, &[]).unwrap();
    for vertex in 0..ring.positions.len() {
        let sine = Vec3::from(across.along(vertex)).dot(around(ring.positions[vertex].into()));
        assert!(sine.abs() < 0.02, "torus, greatest, vertex {vertex}: {sine}");
    }
    let pipe = cylinder(2000, 0.4);
    let error = greatest_error(&pipe, &field(&pipe), |_| true, |_| Vec3::Y);
    assert!(error < 1.0, "cylinder: {error} deg");
}

#[test]
fn flat_places_take_the_direction_of_their_neighbours() {
    let mesh = ridge(5000, 0.2);
    let along = Vec3::new(1.0, 1.0, 0.0).normalize();
    let error =
        greatest_error(&mesh, &field(&mesh), |at: Vec3| (at.x - at.y).abs() > 0.8, |_| along);
    assert!(error < 3.0, "{error} deg");
}

#[test]
fn a_ball_has_smooth_lines_with_two_poles() {
    let mesh = Mesh::sphere(6000);
    let field = field(&mesh);
    let error = greatest_error(
        &mesh,
        &field,
        |at| at.y.abs() < 0.9,
        |at: Vec3| (Vec3::Y - at * at.y).normalize(),
    );
    assert!(error < 1.0, "{error} deg");
    let flow = field.oriented(2);
    assert!(
        (0..mesh.positions.len()).any(|vertex| flow.is_singular(vertex)),
        "the poles are singular"
    );
    for (vertex, position) in mesh.positions.iter().enumerate() {
        assert!(!flow.is_singular(vertex) || position[1].abs() > 0.95, "{position:?} is singular");
    }
}

#[test]
fn a_plane_follows_its_guides_or_else_an_axis() {
    let mesh = square(1000);
    let error = greatest_error(&mesh, &field(&mesh), |_| true, |_| Vec3::Y);
    assert!(error < 0.01, "{error} deg from the axis");
    let floor = turned(&mesh, Quat::from_rotation_x(-std::f32::consts::FRAC_PI_2));
    let error = greatest_error(&floor, &field(&floor), |_| true, |_| Vec3::X);
    assert!(error < 0.01, "{error} deg from the second axis");
    let along = Vec3::new(1.0, -0.4, 0.0).normalize();
    let guide = Guide { vertex: 40, along: (along * 5.0 + Vec3::Z).to_array() };
    let settings = DirectionSettings::default();
    let guided = DirectionField::of_curvature(&mesh, &settings, &[guide]).unwrap();
    let error = greatest_error(&mesh, &guided, |_| true, |_| along);
    assert!(error < 0.01, "{error} deg from the guide");
}

#[test]
fn smoothing_lowers_the_roughness_of_a_noisy_field_and_keeps_guides() {
    let mesh = rough(&cylinder(4000, 0.4), 0.004);
    let along = Vec3::new(0.3, 0.7, 0.6);
    let guides: Vec<Guide> =
        (0..1000).step_by(50).map(|vertex| Guide { vertex, along: along.to_array() }).collect();
    fn of(smoothing: f64, guides: &[Guide], mesh: &Mesh) -> DirectionField {
        let settings =
            DirectionSettings { smoothing, normal_rounds: 0, ..DirectionSettings::default() };
        DirectionField::of_curvature(mesh, &settings, guides).unwrap()
    }
    let [raw, some, much] =
        [0.0, 0.05, 0.2].map(|smoothing| roughness(&mesh, &of(smoothing, &[], &mesh)));
    assert!(some < 0.5 * raw && much < 0.3 * raw, "{raw}, {some}, {much} deg");
    let free = of(0.2, &[], &mesh);
    let guided = of(0.2, &guides, &mesh);
    let mut moved = 0.0_f32;
    for guide in &guides {
        let vertex = guide.vertex as usize;
        let flat = along.reject_from(mesh.normals[vertex].into()).normalize();
        let error = degrees_between(guided.along(vertex), flat);
        assert!(error < 2.0, "vertex {vertex}: {error} deg");
        moved = moved.max(degrees_between(free.along(vertex), flat));
    }
    assert!(moved > 30.0, "the guides ask for nothing new: {moved} deg");
}

#[test]
fn a_turned_mesh_has_the_turned_field() {
    let turn = Quat::from_scaled_axis(Vec3::new(-0.4, 2.1, 0.9));
    for mesh in [torus(3000, 1.0, 0.4), Mesh::torus_knot(6000), ridge(2000, 0.2)] {
        let before = field(&mesh);
        let after = field(&turned(&mesh, turn));
        for vertex in 0..mesh.positions.len() {
            let wanted = turn * Vec3::from(before.along(vertex));
            let found = Vec3::from(after.along(vertex));
            let off = (found - wanted).length().min((found + wanted).length());
            assert!(off < 1e-4, "vertex {vertex}: {off}");
        }
    }
}

#[test]
fn arrows_agree_with_their_neighbours_wherever_there_is_flow() {
    let models = [
        ("torus", torus(4000, 1.0, 0.4), 0.0),
        ("knot", Mesh::torus_knot(6000), 0.0),
        ("egg", ellipsoid(6000, Vec3::new(1.0, 0.6, 0.4)), 0.2),
        ("still life", SampleModel::StillLife.mesh(8000), 0.3),
    ];
    for (name, mesh, most) in models {
        let flow = field(&mesh).oriented(2);
        let normals = mesh.smoothed_normals(1);
        for [a, b] in edges(&mesh) {
            if flow.strength(a) > 0.0 && flow.strength(b) > 0.0 {
                let turn = Quat::from_rotation_arc(normals[a].into(), normals[b].into());
                let cosine = (turn * Vec3::from(flow.arrow(a))).dot(flow.arrow(b).into());
                assert!(cosine > -0.02, "{name}, edge {a} {b}: {cosine}");
            }
        }
        let vertices = 0..mesh.positions.len();
        let singular = vertices.clone().filter(|&vertex| flow.is_singular(vertex)).count();
        let share = singular as f32 / vertices.len() as f32;
        assert!(share <= most && (share > 0.0) == (most > 0.0), "{name}: {share} singular");
        assert!(vertices.clone().all(|at| flow.is_singular(at) == (flow.strength(at) == 0.0)));
    }
}

#[test]
fn flow_fades_over_rings_of_edges() {
    let mesh = Mesh::sphere(6000);
    let field = field(&mesh);
    let strengths = |rings| {
        let flow = field.oriented(rings);
        let mut found: Vec<f32> = (0..mesh.positions.len()).map(|at| flow.strength(at)).collect();
        found.sort_by(f32::total_cmp);
        found.dedup();
        found
    };
    assert_eq!(strengths(0), [0.0, 1.0]);
    assert!(strengths(usize::MAX).into_iter().all(|strength| strength < 0.01), "endless rings");
    fn smooth(at: f32) -> f32 {
        at * at * (3.0 - 2.0 * at)
    }
    let [first, second] = [smooth(1.0 / 3.0), smooth(2.0 / 3.0)];
    for (found, wanted) in strengths(2).into_iter().zip([0.0, first, second, 1.0]) {
        assert!((found - wanted).abs() < 1e-6, "{found}, {wanted}");
    }
}

#[test]
fn directions_inside_triangles_ignore_signs_and_agree_along_edges() {
    let mesh = Mesh::torus_knot(3000);
    let field = field(&mesh);
    let flow = field.oriented(2);
    for triangle in &mesh.triangles {
        let [a, b, c] = triangle.corners;
        let at_corner = field.within([a, b, c], [0.0, 1.0, 0.0]);
        let error = degrees_between(at_corner, field.along(b as usize).into());
        assert!(error < 0.1, "{error} deg");
        let edge =
            [field.within([a, b, c], [0.3, 0.7, 0.0]), field.within([b, 0, a], [0.7, 0.0, 0.3])];
        let error = degrees_between(edge[0], edge[1].into());
        assert!(error < 0.1, "{error} deg");
        let middle = Vec3::from(flow.within([a, b, c], [0.3, 0.3, 0.4]));
        let line = field.within([a, b, c], [0.3, 0.3, 0.4]);
        assert!(middle.length() > 0.9 && degrees_between(line, middle.normalize()) < 1.0);
    }
}

#[test]
fn the_field_is_the_same_on_every_number_of_threads_and_without_seams() {
    let mesh = SampleModel::StillLife.mesh(12_000);
    fn on(threads: usize, mesh: &Mesh) -> Vec<([f32; 3], [f32; 3], f32)> {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let field = field(mesh);
            let flow = field.oriented(2);
            let vertices = 0..mesh.positions.len();
            vertices.map(|at: usize| (field.along(at), flow.arrow(at), flow.strength(at))).collect()
        })
    }
    let whole = on(1, &mesh);
    assert!(whole == on(2, &mesh), "threads matter");
    let apart = on(2, &ragged(&mesh));
    let corners = mesh.triangles.iter().flat_map(|triangle| triangle.corners);
    for (corner, apart) in corners.zip(apart) {
        assert_eq!(whole[corner as usize], apart, "vertex {corner}");
    }
}

#[test]
fn bad_meshes_have_sound_fields() {
    let corners = [
        [0.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [1.0, 0.0, 0.0],
        [-1.0, 0.0, 0.2],
        [0.1, 0.0, 1.0],
        [9.0, 9.0, 9.0],
        [0.0, 0.5, 1e-7],
    ];
    let fan = [[0, 1, 2], [0, 1, 3], [0, 1, 4], [4, 1, 0]];
    let mut without_normals = bare(&corners, &fan);
    without_normals.normals.fill([0.0; 3]);
    let mut unruly = Mesh::torus_knot(2000);
    for (index, triangle) in unruly.triangles.iter_mut().enumerate() {
        if index % 3 == 0 {
            triangle.corners.swap(0, 1);
        }
    }
    for (name, mesh) in [
        ("one triangle", bare(&corners, &[[0, 1, 2]])),
        ("needle", bare(&corners, &[[0, 1, 6]])),
        ("no area", bare(&corners, &[[0, 0, 1], [1, 1, 1]])),
        ("three sheets on an edge", bare(&corners, &fan)),
        ("two sides", bare(&corners, &[[0, 1, 2], [0, 2, 1]])),
        ("huge", bare(&corners.map(|at| at.map(|value| value * 1e18)), &fan)),
        ("tiny", bare(&corners.map(|at| at.map(|value| value * 1e-30)), &fan)),
        ("no normals", without_normals),
        ("unruly", unruly),
        ("no vertex", Mesh::default()),
    ] {
        let field = field(&mesh);
        assert_sound(name, &mesh, &field, &field.oriented(2));
    }
}

#[test]
fn faults_of_settings_and_guides_are_named() {
    let mesh = square(100);
    fn of(smoothing: f64, vertex: u32, along: [f32; 3], mesh: &Mesh) -> Option<DirectionFault> {
        let settings = DirectionSettings { smoothing, ..DirectionSettings::default() };
        DirectionField::of_curvature(mesh, &settings, &[Guide { vertex, along }]).err()
    }
    for found in [-0.1, 1.1] {
        assert_eq!(of(found, 0, [1.0; 3], &mesh), Some(DirectionFault::Smoothing(found)));
    }
    assert!(of(f64::NAN, 0, [1.0; 3], &mesh).is_some());
    let vertices = mesh.positions.len();
    let fault = DirectionFault::NoSuchVertex { guide: 0, found: 500, vertices };
    assert_eq!(of(0.1, 500, [1.0; 3], &mesh), Some(fault));
    let found = [0.0, 0.0, 2.0];
    assert_eq!(
        of(0.1, 3, found, &mesh),
        Some(DirectionFault::OffSurface { guide: 0, vertex: 3, found })
    );
    for along in [[0.0; 3], [f32::NAN, 1.0, 0.0], [f32::INFINITY, 1.0, 0.0]] {
        assert!(
            matches!(of(0.1, 3, along, &mesh), Some(DirectionFault::OffSurface { .. })),
            "{along:?}"
        );
    }
}

#[test]
fn given_lines_are_followed_and_spread_where_none_are_given() {
    let mesh = square(400);
    let wanted = Vec3::new(0.6, 0.8, 0.0);
    let lines: Vec<Line> = mesh
        .positions
        .iter()
        .map(|at: &[f32; 3]| match at[0] > 0.3 {
            true => Line {
                along: (wanted * if at[1] > 0.0 { 3.0 } else { -1.0 }).to_array(),
                weight: 1.0,
            },
            false => Line { along: [0.8, -0.6, 0.0], weight: 0.0 },
        })
        .collect();
    let field = DirectionField::of_lines(&mesh, &lines, &DirectionSettings::default(), &[]);
    let worst = greatest_error(&mesh, &field.unwrap(), |_| true, |_| wanted);
    assert!(worst < 0.5, "{worst}");
}

#[test]
fn arrows_take_the_signs_that_are_given_and_others_follow_their_part() {
    let mesh = square(400);
    let field = field(&mesh);
    let usual = field.oriented(0);
    let up = Vec3::from(usual.arrow(0));
    let given = |way: Vec3, chosen: &dyn Fn(Vec3) -> bool| -> Vec<[f32; 3]> {
        mesh.positions
            .iter()
            .map(|at: &[f32; 3]| if chosen(Vec3::from(*at)) { way } else { Vec3::ZERO })
            .map(Vec3::into)
            .collect()
    };
    let flipped = field.oriented_by(&given(-0.1 * up, &|at| at.x > 0.4), 0);
    for vertex in 0..mesh.positions.len() {
        assert!(Vec3::from(flipped.arrow(vertex)).dot(up) < -0.999, "{vertex}");
    }
    let mut both = given(up, &|at| at.x > 0.0);
    for (both, other) in both.iter_mut().zip(given(-up, &|at| at.x <= 0.0)) {
        *both = (Vec3::from(*both) + Vec3::from(other)).into();
    }
    let split = field.oriented_by(&both, 1);
    for (vertex, at) in mesh.positions.iter().enumerate() {
        assert!(Vec3::from(split.arrow(vertex)).dot(Vec3::from(both[vertex])) > 0.99);
        // Columns are 1/7 apart. One ring of edges on both sides of the cut is weak.
        let near = (at[0] - 0.07).abs() < 0.25;
        assert!(!near || split.strength(vertex) < 1.0, "{at:?}");
    }
}

#[test]
fn flow_runs_along_every_guide_and_stops_where_guides_meet() {
    let mesh = square(1000);
    let settings = DirectionSettings::default();
    fn flow(guides: &[Guide], mesh: &Mesh, settings: &DirectionSettings) -> FlowField {
        DirectionField::of_curvature(mesh, settings, guides).unwrap().oriented(1)
    }
    fn guide(vertex: usize, along: Vec3) -> Guide {
        Guide { vertex: vertex as u32, along: along.to_array() }
    }
    fn most(side: f32, mesh: &Mesh) -> usize {
        let places = mesh.positions.iter().map(|&[x, ..]| side * x).enumerate();
        places.max_by(|a, b| a.1.total_cmp(&b.1)).unwrap().0
    }
    let left = most(-1.0, &mesh);
    let right = most(1.0, &mesh);
    for along in [Vec3::Y, -Vec3::Y, Vec3::X, -Vec3::X] {
        let one = flow(&[guide(left, along)], &mesh, &settings);
        for vertex in 0..mesh.positions.len() {
            assert!(Vec3::from(one.arrow(vertex)).dot(along) > 0.9, "vertex {vertex} of {along}");
            assert!(!one.is_singular(vertex), "vertex {vertex} of {along}");
        }
    }
    let two = flow(&[guide(left, Vec3::Y), guide(right, -Vec3::Y)], &mesh, &settings);
    assert!(two.arrow(left)[1] > 0.9 && two.arrow(right)[1] < -0.9, "both have their sign");
    assert!(two.strength(left) > 0.0 && two.strength(right) > 0.0, "both flow");
    assert!((0..mesh.positions.len()).any(|vertex| two.is_singular(vertex)), "they meet");
}
