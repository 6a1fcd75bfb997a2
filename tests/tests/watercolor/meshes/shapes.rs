//! Normals, closed surfaces, faults of meshes, and the sample models.

use documents::hint::Explain;
use glam::Vec3;
use graphics::mesh::{GridSize, Mesh, MeshFault, SampleModel, Texture};

/// Largest angle in degrees between `normals` and the radii of a ball.
fn worst(mesh: &Mesh, normals: &[[f32; 3]]) -> f32 {
    let angles = mesh.positions.iter().zip(normals).map(|(&place, &normal)| {
        Vec3::from(place).normalize().dot(normal.into()).clamp(-1.0, 1.0).acos().to_degrees()
    });
    angles.fold(0.0, f32::max)
}

#[test]
fn a_ball_has_its_radii_as_normals() {
    let ball = Mesh::sphere(5000);
    ball.check().unwrap();
    assert!(worst(&ball, &ball.normals) < 0.2, "{}", worst(&ball, &ball.normals));
    let made = ball.vertex_normals();
    assert!(worst(&ball, &made) < 0.5, "{}", worst(&ball, &made));
}

#[test]
fn smoothing_keeps_a_ball_and_evens_bumps() {
    let mut ball = Mesh::sphere(5000);
    let kept = ball.smoothed_normals(20);
    // Around the poles, triangles are uneven, so averaged normals deviate.
    assert!(worst(&ball, &kept) < 4.0, "{}", worst(&ball, &kept));
    let smooth = ball.normals.clone();
    // Perturbs each normal by its position, and equally on both sides of the seam.
    for (normal, place) in ball.normals.iter_mut().zip(&ball.positions) {
        let [x, y, z] = place.map(|at| (at * 977.0).sin() * 0.4);
        *normal = (Vec3::from(*normal) + Vec3::new(x, y, z)).normalize().into();
    }
    let bumpy = ball.normals.clone();
    let rounds = [0, 1, 4, 16].map(|rounds| {
        let normals = ball.smoothed_normals(rounds);
        let off = normals.iter().zip(&smooth).map(|(&a, &b)| Vec3::from(a).distance(b.into()));
        off.sum::<f32>() / smooth.len() as f32
    });
    assert!(rounds.is_sorted_by(|a, b| b < a) && rounds[3] < rounds[0] / 8.0, "{rounds:?}");
    assert_eq!(ball.smoothed_normals(0), bumpy);
    // Vertices at the same position keep equal normals.
    let normals = ball.smoothed_normals(3);
    let GridSize { columns, rows } = GridSize::for_triangles(5000, 2.0);
    let width = columns + 1;
    assert_eq!(ball.positions.len(), width * (rows + 1));
    for row in 0..=rows {
        assert_eq!(ball.positions[row * width], ball.positions[row * width + width - 1]);
        assert_eq!(normals[row * width], normals[row * width + width - 1], "row {row}");
    }
}

#[test]
fn closed_surfaces_are_told_from_open_and_inverted_ones() {
    let mut ball = Mesh::sphere(500);
    assert!(ball.is_closed() && Mesh::torus_knot(3000).is_closed());
    ball.triangles.iter_mut().for_each(|triangle| triangle.corners.swap(0, 1));
    assert!(!ball.is_closed(), "inside out");
    let mut open = Mesh::sphere(500);
    open.triangles.pop();
    assert!(!open.is_closed(), "a hole");
    assert!(!Mesh::default().is_closed());
}

#[test]
fn what_cannot_be_drawn_is_found() {
    type Change = (fn(&mut Mesh), &'static str);
    let cases: [Change; 7] = [
        (|mesh| mesh.triangles.clear(), "no triangle"),
        (|mesh| mesh.colors.truncate(1), "1 colours for"),
        (|mesh| mesh.positions[3][1] = f32::NAN, "vertex 3 has the position"),
        (|mesh| mesh.triangles[2].corners[1] = 4000, "triangle 2 has vertex 4000"),
        (|mesh| mesh.triangles[2].material = 1, "triangle 2 has material 1, of 1"),
        (|mesh| mesh.materials[0].color[2] = 1.5, "material 0 has the colour"),
        (
            |mesh| {
                let texture = Texture { width: 2, height: 2, texels: vec![0; 3] };
                mesh.materials[0].texture = Some(texture);
            },
            "3 texels for 2 x 2",
        ),
    ];
    let found = cases.map(|(change, words)| {
        let mut mesh = Mesh::sphere(100);
        change(&mut mesh);
        (mesh.check().unwrap_err(), words)
    });
    assert_eq!(found[0].0, MeshFault::NoTriangle);
    for (fault, words) in found {
        assert!(fault.to_string().contains(words), "{fault}");
        assert!(fault.hint().is_some());
    }
}

#[test]
fn shapes_are_whole_and_as_fine_as_asked() {
    for shape in SampleModel::ALL {
        assert_eq!(SampleModel::from_name(shape.name()), Some(shape));
        for triangles in [3000, 25_000, 60_000] {
            let mesh = shape.mesh(triangles);
            mesh.check().unwrap();
            let found = mesh.triangles.len();
            let near = triangles * 85 / 100..triangles * 115 / 100;
            assert!(near.contains(&found), "{}: {found} for {triangles}", shape.name());
            let lengths = mesh.normals.iter().map(|&normal| Vec3::from(normal).length());
            assert!(lengths.into_iter().all(|length| (length - 1.0).abs() < 1e-4));
            let colors = mesh.colors.iter().flatten();
            assert!(colors.into_iter().all(|value| (0.0..=1.0).contains(value)));
            // Normals point to the side where corners run counter-clockwise.
            let agree = mesh.triangles.iter().filter(|triangle| {
                let at = triangle.corners.map(|at| Vec3::from(mesh.positions[at as usize]));
                let normal: Vec3 =
                    triangle.corners.iter().map(|&at| Vec3::from(mesh.normals[at as usize])).sum();
                (at[1] - at[0]).cross(at[2] - at[0]).dot(normal) > 0.0
            });
            let share = agree.count() as f64 / found as f64;
            assert!(share > 0.995, "{} of {triangles}: {share}", shape.name());
        }
    }
    assert_eq!(SampleModel::from_name("teapot"), None);
    assert_eq!(SampleModel::Village.mesh(3000), SampleModel::Village.mesh(3000));
}
