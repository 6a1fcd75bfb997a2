use graphics::surface::{Crossings, PackedMesh, VisibilityBuffer, visible};
use paint::amount::mm_from_quanta;
use paint::layer::Cell;

use super::*;
use crate::pigments::{Facets, SeenPlaces};
use crate::surfaces::VolumeSurfaces;
use crate::test_volumes::{bumpy, camera, plane};

const SIZE: (usize, usize) = (121, 97);

/// Fine units of length.
const UNITS: f32 = 1e6;

/// Lengths of the eye rays inside of volumes over a plane, in the unit of the scene.
fn lengths(volumes: &[Volume], camera: &Camera, beyond: bool) -> (Field<f32>, Field<Vec3>) {
    let mesh = plane(3);
    let seen: VisibilityBuffer = visible(&mesh, camera, SIZE.0, SIZE.1);
    let mesh = PackedMesh::new(&mesh);
    let facets = Facets::of(&mesh);
    let places = SeenPlaces::of(&mesh, &facets, &seen).places;
    let mut density = Density([0.0; SLOTS + 1]);
    density.0[2] = UNITS;
    let densities = vec![density; volumes.len()];
    let through = FilmThrough::new(&densities, camera, &places, beyond);
    let surfaces = VolumeSurfaces::of(volumes);
    let sums = Crossings::default().sum(&through, surfaces.closed(), camera, &seen);
    (
        Field::from_values(
            SIZE.0,
            SIZE.1,
            sums.values()
                .iter()
                .map(|heights: &FilmHeights| {
                    assert_eq!((heights.0[0], heights.0[SLOTS]), (0, 0));
                    heights.0[2] as f32 / UNITS
                })
                .collect(),
        ),
        places,
    )
}

/// The ray of a pixel, of length 1.
fn ray(camera: &Camera, pixel: usize) -> Vec3 {
    let [right, up, back] = camera.axes();
    let column = pixel % SIZE.0;
    let row = pixel / SIZE.0;
    let tangent = (camera.field_of_view_deg.to_radians() / 2.0).tan() / SIZE.1 as f32;
    let x = ((2 * column + 1) as f32 - SIZE.0 as f32) * tangent;
    let y = (SIZE.1 as f32 - (2 * row + 1) as f32) * tangent;
    (x * right + y * up - back).normalize()
}

/// Length of a ray from `eye` within a ball, up to `end`.
fn in_ball(eye: Vec3, ray: Vec3, (center, radius): (Vec3, f32), end: f32) -> f32 {
    let middle = (center - eye).dot(ray);
    let from_center = (eye + middle * ray).distance(center);
    if from_center >= radius {
        return 0.0;
    }
    let half = (radius * radius - from_center * from_center).sqrt();
    (middle + half).clamp(0.0, end) - (middle - half).clamp(0.0, end)
}

/// Sums of what is found and expected over all pixels, and of their differences.
fn compared(ball: (Vec3, f32), camera: &Camera, beyond: bool) -> [f64; 3] {
    let volume = Volume::ball(ball.0, ball.1, 4, 0);
    let (lengths, places) = lengths(&[volume], camera, beyond);
    let mut sums = [0.0; 3];
    for (pixel, &length) in lengths.values().iter().enumerate() {
        let seen = places.values()[pixel].distance(camera.eye);
        let nothing = if beyond { f32::INFINITY } else { 0.0 };
        let end = if seen.is_nan() { nothing } else { seen };
        let wanted = in_ball(camera.eye, ray(camera, pixel), ball, end);
        sums[0] += f64::from(length);
        sums[1] += f64::from(wanted);
        sums[2] += f64::from((length - wanted).abs());
    }
    sums
}

#[test]
fn rays_through_a_resting_ball_have_the_length_of_its_chords() {
    // In the air, half sunk into the plane, around the eye, and beside the plane.
    let cases = [
        (Vec3::new(2.1, 2.0, 1.5), 0.7, camera(10.0, 6.0), false),
        (Vec3::new(2.0, 1.8, 0.1), 0.9, camera(40.0, 6.0), false),
        (camera(30.0, 6.0).eye + Vec3::new(0.1, 0.0, 0.0), 1.5, camera(30.0, 6.0), false),
        (Vec3::new(5.0, 2.0, 0.0), 1.5, camera(0.0, 8.0), true),
    ];
    for (center, radius, camera, beyond) in cases {
        let [found, wanted, off] = compared((center, radius), &camera, beyond);
        assert!(wanted > 300.0, "{wanted}");
        assert!(off <= 0.01 * wanted, "{found} for {wanted}, {off} off");
    }
}

#[test]
fn rays_that_miss_or_end_before_a_volume_have_no_film_at_all() {
    // Behind the plane, and before it.
    let hidden = [bumpy(Vec3::new(2.0, 2.0, -1.0), 0.6, 3, 1)];
    let (hidden_lengths, _) = lengths(&hidden, &camera(0.0, 6.0), false);
    assert!(hidden_lengths.values().iter().all(|&length| length == 0.0));
    let shown = [bumpy(Vec3::new(2.0, 2.0, 1.0), 0.6, 3, 1)];
    let (lengths, places) = lengths(&shown, &camera(0.0, 6.0), false);
    let zero = lengths.values().iter().filter(|&&length| length == 0.0).count();
    assert!((6000..11_000).contains(&zero), "{zero}");
    assert!(places.values().iter().any(|place| place.is_nan()));
    assert!(lengths.values().iter().all(|&length| (0.0..2.0).contains(&length)));
}

#[test]
fn densities_spread_the_paint_over_the_inside() {
    let mut volume = Volume::ball(Vec3::ZERO, 0.5, 4, 0);
    let scale = FilmScale { quantum_mm3: 2e-6, unit_mm: 10.0, cell_mm: 0.1 };
    volume.paint = Cell { pigments: [0, 5_000_000, 0, 0, 0, 0, 0, 0], vehicle: 1000 };
    let ball = 4.0 / 3.0 * std::f64::consts::PI * 0.125;
    assert!((enclosed(&volume) / ball - 1.0).abs() < 0.003, "{}", enclosed(&volume));
    let Density(density) = Density::of(&volume, &scale);
    let mm_per_mm = 5e6 * 2e-6 / (ball * 1000.0);
    let found = f64::from(density[1]) * mm_from_quanta(1, 0.1) / 10.0;
    assert!((found / mm_per_mm - 1.0).abs() < 0.003, "{found} {mm_per_mm}");
    assert_eq!((density[0], density[8] > 0.0), (0.0, true));
}
