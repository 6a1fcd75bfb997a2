use graphics::camera::Framing;
use graphics::mesh::{DirectionField, DirectionSettings};
use graphics::surface::position_at;

use super::*;

const SIZE: [u32; 2] = [400, 300];

fn guides(lines: Vec<Vec<[f64; 2]>>) -> Guides {
    Guides {
        file: "g.toml".to_owned(),
        picture: None,
        size_px: SIZE,
        camera: Some([0.0, 0.0, 30.0]),
        lines,
    }
}

/// Angle in degrees between two lines.
fn between(one: Vec3, other: Vec3) -> f32 {
    one.normalize().dot(other.normalize()).abs().min(1.0).acos().to_degrees()
}

/// Angles between the field and a straight line over the ball, all along the line. The direction of
/// the line is that between surface points 8 px apart.
fn angles(mesh: &Mesh, camera: &Camera, field: &DirectionField, line: &[[f64; 2]]) -> Vec<f32> {
    let visible = visible(mesh, camera, SIZE[0] as usize, SIZE[1] as usize);
    let seen = |at: DVec2| visible[(at.x as usize, at.y as usize)];
    let steps: Vec<Step> = steps(line, DVec2::ONE).collect();
    steps[8..steps.len() - 8]
        .iter()
        .map(|step: &Step| {
            let ends =
                [-4.0, 4.0].map(|ahead| position_at(mesh, seen(step.at + ahead * step.along)));
            let here = seen(step.at);
            let weights = [1.0 - here.second - here.third, here.second, here.third];
            let corners = mesh.triangles[here.triangle as usize].corners;
            between(field.within(corners, weights).into(), ends[1] - ends[0])
        })
        .collect()
}

#[test]
fn a_guide_across_a_ball_turns_the_field_along_it() {
    let mesh = Mesh::sphere(5000);
    // In whole pixels, so that ends of 8 px have their direction.
    let line = vec![[120.5, 150.5], [280.5, 150.5]];
    let guides = guides(vec![line.clone()]);
    let camera = guides.camera_around(&mesh.positions).unwrap();
    let settings = DirectionSettings::default();
    let laid = guides.on_mesh(&mesh, &camera).unwrap();
    assert!(laid.len() > 10, "{} vertices", laid.len());
    assert!(laid.iter().all(|guide| guide.along[0] > 0.0), "{laid:?}");
    let free = DirectionField::of_curvature(&mesh, &settings, &[]).unwrap();
    let free = angles(&mesh, &camera, &free, &line);
    assert!(free.iter().all(|&angle| angle > 60.0), "it runs upwards without the guide: {free:?}");
    let turned = DirectionField::of_curvature(&mesh, &settings, &laid).unwrap();
    let turned = angles(&mesh, &camera, &turned, &line);
    assert!(turned.iter().all(|&angle| angle < 5.0), "{turned:?}");
}

#[test]
fn a_direction_is_that_of_the_line_at_any_angle() {
    let mesh = Mesh::sphere(20_000);
    let camera = guides(Vec::new()).camera_around(&mesh.positions).unwrap();
    for degrees in [0.0_f64, 20.0, 70.0, 130.0, 200.0] {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let middle = [200.0, 150.0];
        let line = [-6.0, 6.0].map(|far| [middle[0] + far * cos, middle[1] + far * sin]);
        let laid = guides(vec![line.to_vec()]).on_mesh(&mesh, &camera).unwrap();
        for Guide { along: [x, y, _], .. } in laid {
            // The middle of the ball faces the camera; y of the picture points down.
            let found = f64::from(-y).atan2(f64::from(x)).to_degrees();
            let off = (found - degrees + 180.0).rem_euclid(360.0) - 180.0;
            assert!(off.abs() < 2.0, "{found} of {degrees} degrees");
        }
    }
}

#[test]
fn a_line_over_an_outline_has_a_gap_and_no_direction_to_what_is_behind() {
    let mut mesh = Mesh::sphere(2000);
    // A second ball far behind the first, to its right.
    let behind = Mesh::sphere(2000);
    let first = mesh.positions.len() as u32;
    mesh.positions
        .extend(behind.positions.into_iter().map(|[x, y, z]: [f32; 3]| [x + 6.5, y, z - 20.0]));
    mesh.normals.extend(behind.normals);
    mesh.triangles.extend(behind.triangles.into_iter().map(|mut triangle| {
        triangle.corners = triangle.corners.map(|corner| corner + first);
        triangle
    }));
    let framing = Framing { azimuth_deg: 0.0, elevation_deg: 0.0, ..Framing::default() };
    let camera = Camera {
        eye: Vec3::new(0.0, 0.0, 6.0),
        target: Vec3::ZERO,
        near: 0.1,
        far: 100.0,
        ..framing.camera(mesh.bounds())
    };
    let laid = guides(vec![vec![[20.0, 150.0], [390.0, 150.0]]]).on_mesh(&mesh, &camera).unwrap();
    assert!(laid.iter().any(|guide| guide.vertex < first), "the ball in front");
    assert!(laid.iter().any(|guide| guide.vertex >= first), "the ball behind");
    for Guide { vertex, along } in laid {
        let along = Vec3::from(along);
        let middle = if vertex < first { Vec3::ZERO } else { Vec3::new(6.5, 0.0, -20.0) };
        let out = (Vec3::from(mesh.positions[vertex as usize]) - middle).normalize();
        assert!(along.dot(out).abs() < 0.3, "{along} leaves the surface at {out}");
        let right = (Vec3::from(mesh.positions[vertex as usize]) - camera.eye).cross(Vec3::Y);
        assert!(along.dot(right) > 0.0, "{along} runs back");
    }
}

#[test]
fn guides_off_the_mesh_are_named() {
    let mesh = Mesh::sphere(500);
    let on = vec![[150.0, 150.0], [250.0, 150.0]];
    let guides = guides(vec![on, vec![[2.0, 2.0], [30.0, 2.0]]]);
    let camera = guides.camera_around(&mesh.positions).unwrap();
    let error = guides.on_mesh(&mesh, &camera).unwrap_err();
    assert_eq!(error.to_string(), "g.toml, guide 2: nothing of the model is seen along the line");
    assert!(documents::hint::Explain::hint(&error).is_some(), "a way out");
}
