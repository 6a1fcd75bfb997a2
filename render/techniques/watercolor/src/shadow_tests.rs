//! The border of a cast shadow: how light comes back across it.

use glam::Vec3;

use super::shadow_map::{ShadowMap, ShadowView};
use super::toon::{Toon, shade_toon};
use graphics::camera::Camera;
use graphics::compute::Compute;
use graphics::distant_light::DistantLight;
use graphics::field::Field;
use graphics::mesh::{GridSize, Material, Mesh};
use graphics::surface::{Model, NO_TRIANGLE, PackedMesh, position_at};
use graphics::tones::ToneRamp;

const SIZE: (usize, usize) = (400, 400);

/// Towards the light, so that the shadow of the ball lies beside it on the floor.
const LIGHT: Vec3 = Vec3::new(0.6, 0.8, 0.0);

/// A white ball of radius 1 that floats over a white floor at -1.5.
fn ball_over_floor() -> Mesh {
    let mut mesh = Mesh::sphere(4000);
    mesh.colors.fill([1.0; 3]);
    mesh.materials[0] = Material::plain([1.0; 3]);
    let first = mesh.positions.len();
    mesh.add_grid(GridSize { columns: 9, rows: 9 }, 0, |at| {
        Vec3::new(12.0 * at.x - 6.0, -1.5, 12.0 * at.y - 6.0)
    });
    mesh.normals[first..].fill([0.0, 1.0, 0.0]);
    mesh
}

/// Shadows at half the brightness, and nothing else that changes a white surface.
fn shaded(mesh: &Mesh, camera: &Camera, side: usize) -> (Field<[f32; 4]>, ShadowView) {
    let compute = &mut Compute::cpu();
    let toon = Toon {
        light: DistantLight::WithModel(LIGHT),
        tones: ToneRamp::steps(1, 0.0),
        shadow_color: [0.5; 3],
        ..Toon::default()
    };
    let mut model = Model::new(compute, PackedMesh::new(mesh)).unwrap();
    let [low, high] = mesh.bounds();
    let sphere = ((low + high) / 2.0, low.distance(high) / 2.0);
    let map = ShadowMap::new(compute, &mut model, LIGHT, sphere, side).unwrap();
    let visible = model.visible(compute, camera, SIZE.0, SIZE.1).unwrap();
    let color = shade_toon(compute, &model, &visible, camera, &toon, Some(&map)).unwrap();
    (compute.download(&color).unwrap(), map.view())
}

/// For each pixel of the floor the distance of its ray of light from the ball, below 0 where
/// the ball is in its way, and the share of light that reaches it.
fn floor(side: usize) -> (Vec<[f32; 2]>, ShadowView) {
    let mesh = ball_over_floor();
    let camera = Camera::framing(mesh.bounds(), 0.0, 65.0, 14.0);
    let (picture, view) = shaded(&mesh, &camera, side);
    let seen = graphics::surface::visible(&mesh, &camera, SIZE.0, SIZE.1);
    let mut found = Vec::new();
    for (fragment, color) in seen.values().iter().zip(picture.values()) {
        if fragment.triangle == NO_TRIANGLE {
            continue;
        }
        let place = position_at(&mesh, *fragment);
        if place.y < -1.499 {
            let away = (place - LIGHT * place.dot(LIGHT)).length() - 1.0;
            found.push([away, 2.0 * color[1] - 1.0]);
        }
    }
    (found, view)
}

#[test]
fn light_comes_back_evenly_over_the_border_of_a_shadow() {
    for (side, soft) in [(1024, 4), (512, 2)] {
        let (found, view) = floor(side);
        assert_eq!(view.soft, soft);
        let half = (soft as f32 + 0.5) * view.pixel;
        // Corners of the square that is averaged reach farther than its sides, and places are
        // lifted by the offset.
        let far = 1.5 * half + 2.0 * view.pixel;
        for [away, lit] in &found {
            let wanted = if *away < 0.0 { 0.0 } else { 1.0 };
            let far_off = away.abs() > far;
            assert!(!far_off || (lit - wanted).abs() < 1e-3, "{side}: {lit} at {away}");
        }
        let means = [-1.0, -0.5, 0.0, 0.5].map(|from: f32| {
            let between = (from * half)..((from + 0.5) * half);
            let lit = found.iter().filter(|[away, _]| between.contains(away));
            let (sum, count) = lit.fold((0.0, 0), |(sum, n), [_, lit]| (sum + lit, n + 1));
            assert!(count > 20, "{side}: {count} pixels from {from}");
            sum / count as f32
        });
        let wanted = [0.125, 0.375, 0.625, 0.875];
        let even = means.iter().zip(wanted).all(|(lit, wanted)| (lit - wanted).abs() < 0.12);
        assert!(even, "{side}: {means:?}");
    }
}

#[test]
fn a_shadow_glazes_white_surfaces_and_leaves_colours_to_their_density() {
    for (own, wanted) in [([1.0, 0.8, 0.4], [0.8, 0.64, 0.32]), ([0.9, 0.1, 0.0], [0.9, 0.1, 0.0])]
    {
        let mut mesh = ball_over_floor();
        mesh.materials[0] = Material::plain(own);
        let camera = Camera::framing(mesh.bounds(), 0.0, 65.0, 14.0);
        let (picture, _) = shaded(&mesh, &camera, 512);
        let seen = picture.values().iter().filter(|color| color[3] == 1.0);
        let darkest = seen.min_by(|a, b| a[0].total_cmp(&b[0])).unwrap();
        let near = darkest.iter().zip(wanted).all(|(found, wanted)| (found - wanted).abs() < 1e-3);
        assert!(near, "{darkest:?} for {wanted:?}");
    }
}
