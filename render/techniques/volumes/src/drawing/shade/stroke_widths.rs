//! Tests of the width of strokes on pictures of models.

use graphics::camera::Framing;
use graphics::mesh::SampleModel;

use super::*;
use crate::hatching::sample_texture;

/// Mean width of the dark strips of a picture: twice their area by the length of their outline,
/// which is the mean number of dark runs along parallel lines a pixel apart, over all directions,
/// times pi (Crofton's formula); here over four directions.
fn width_of_strips((width, height): (i32, i32), dark: impl Fn(i32, i32) -> bool) -> f32 {
    let mut area = 0.0;
    let mut crossings = 0.0;
    for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
        if dark(x, y) {
            area += 1.0;
            // Lines along the diagonals lie closer together.
            let diagonal = std::f64::consts::FRAC_1_SQRT_2;
            for (dx, dy, apart) in [(1, 0, 1.0), (0, 1, 1.0), (1, 1, diagonal), (-1, 1, diagonal)] {
                crossings += if dark(x - dx, y - dy) { 0.0 } else { apart };
            }
        }
    }
    (8.0 * area / (std::f64::consts::PI * crossings)) as f32
}

#[test]
fn strips_of_a_known_width_are_measured() {
    for (slope, width) in [(0.0, 3.0), (0.3, 3.0), (1.0, 4.0), (2.5, 6.0)] {
        let across = f64::hypot(1.0, slope);
        let found = f64::from(width_of_strips((400, 400), |x: i32, y: i32| {
            (0..400).contains(&x)
                && (0..400).contains(&y)
                && ((f64::from(y) + slope * f64::from(x)) / across).rem_euclid(20.0) < width
        }));
        assert!((found / width - 1.0).abs() < 0.12, "{slope} {width}: {found}");
    }
}

#[test]
fn strokes_on_a_village_are_2_to_4_pixels_wide_from_near_and_far() {
    let mut mesh = SampleModel::Village.mesh(8000);
    // Without light black has the darkest tone, here the same on all surfaces.
    mesh.colors.iter_mut().for_each(|color| *color = [0.0; 3]);
    let packed = PackedMesh::new(&mesh);
    let mut compute = Compute::cpu();
    let hatching = Hatching::new(&mut compute, sample_texture(), &packed).unwrap();
    let mut model = Model::new(&mut compute, packed).unwrap();
    for ((width, height), zoom, tone) in [
        ((750, 570), 1.0, 0.65),
        ((750, 570), 2.9, 0.8),
        ((750, 570), 8.0, 0.6),
        ((1280, 800), 1.0, 0.65),
        ((1280, 800), 4.3, 0.65),
        ((1920, 1080), 1.0, 0.65),
        ((1920, 1080), 8.0, 0.65),
    ] {
        let aspect = width as f32 / height as f32;
        let mut camera = Framing { aspect, ..Framing::default() }.fit(&mesh.positions);
        let half = (0.5 * camera.field_of_view_deg).to_radians().tan() / zoom;
        camera.field_of_view_deg = 2.0 * half.atan().to_degrees();
        let mut look = DrawingLook { lit: false, ..DrawingLook::default() };
        look.hatching.coordinates = Some(Coordinates::ThreePlanes);
        look.hatching.darkest = tone;
        let visible = model.visible(&mut compute, &camera, width, height).unwrap();
        let mesh = model.host().mesh();
        let (_, ink) = shade_apart(mesh, visible.host(), &camera, &look, &hatching).unwrap();
        let within = |at: i32, end: usize| usize::try_from(at).is_ok_and(|at| at < end);
        let found = width_of_strips((width as i32, height as i32), |x: i32, y: i32| {
            within(x, width) && within(y, height) && ink[(x as usize, y as usize)] > 0.5
        });
        assert!((2.0..4.0).contains(&found), "{width} x {height}, x{zoom}, tone {tone}: {found}");
    }
}
