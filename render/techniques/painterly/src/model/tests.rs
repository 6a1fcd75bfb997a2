use artmap::map::ArtMap;
use artmap::measures::{Texture, co_occurrence_error, contrast, stroke_length};
use glam::Vec2;
use graphics::camera::{Camera, Framing};
use graphics::coherence::{NoiseFrame, Popping};
use graphics::encoding::lab_from_linear;
use graphics::mesh::{GridSize, Material, SampleModel};
use graphics::picture::Picture;
use graphics::tile::Rect;
use spectra::color::Rgb;

use documents::hint::Explain;

use graphics::coherence::{Projection, depth_field};
use graphics::compute::Compute;
use graphics::distant_light::DistantLight;
use graphics::field::Field;
use graphics::surface::Model;

use super::super::painter::Painter;
use super::super::passes::PaintedPicture;
use super::super::settings::{ColorSource, LightWith, Offsets};
use super::super::splats::StrokeSplat;
use super::super::test_scenes::{SPACING, map};
use super::*;

/// A square of side 2 that faces +z, in many triangles.
pub(super) fn flat() -> Mesh {
    let mut mesh = Mesh { materials: vec![Material::plain([0.8; 3])], ..Mesh::default() };
    let cells = GridSize { columns: 24, rows: 24 };
    mesh.add_grid(cells, 0, |at: Vec2| Vec3::new(2.0 * at.x - 1.0, 1.0 - 2.0 * at.y, 0.0));
    mesh
}

/// The middle of the flat square, seen from the front with one texel to a pixel.
pub(super) fn front(settings: &Settings, size: usize) -> Field<[f32; 4]> {
    let mesh = flat();
    let camera = Camera {
        eye: Vec3::Z * 30.0,
        target: Vec3::ZERO,
        up: Vec3::Y,
        field_of_view_deg: 2.4,
        near: 20.0,
        far: 40.0,
    };
    let width_px = SPACING as f32;
    let mut settings = settings.clone();
    settings.reference_px = size as f32;
    settings.strokes.width_px = width_px;
    // One tone, the middle tile's.
    (settings.light.darkest, settings.light.lightest) = (0.5, 0.5);
    let mut painter = Painter::of_model(&mesh, &map(1), &settings).unwrap();
    painter.paint(&camera, (size, size), 0.0).unwrap().color
}

fn linear(picture: &Field<[f32; 4]>) -> Picture {
    let values = picture.values().iter().map(|[r, g, b, _]| {
        Rgb([r, g, b].map(|value| f64::from(*value))).linear().0.map(|value| value as f32)
    });
    Field::from_values(picture.width(), picture.height(), values.collect())
}

/// Contrast and stroke length relative to the map, co-occurrence error, and bare pixels.
fn figures(settings: &Settings) -> [f64; 4] {
    let picture = front(settings, 320);
    let tile = Texture::tiled(&map(1).keys[0].tile.color);
    let all = Field::filled(picture.width(), picture.height(), true);
    let found = Texture::masked(&linear(&picture), &all);
    let bare = picture.values().iter().filter(|pixel| pixel[3] < 0.5).count();
    [
        contrast(&found) / contrast(&tile),
        stroke_length(&found) / stroke_length(&tile),
        co_occurrence_error(&tile, &found),
        bare as f64 / picture.values().len() as f64,
    ]
}

#[test]
fn a_flat_patch_shows_the_brushwork_of_the_map() {
    let [contrast, length, error, bare] = figures(&Settings::default());
    assert!(contrast >= 0.8, "contrast {contrast}");
    assert!((0.8..=1.25).contains(&length), "stroke length {length}");
    assert!(error <= 0.3, "co-occurrence error {error}");
    assert!(bare <= 0.001, "{bare} bare");
}

#[test]
fn the_published_way_blurs_strokes() {
    let mut settings = Settings::default();
    settings.overlap.sharpness = 1;
    settings.overlap.ridges = 0.0;
    settings.overlap.offsets = Offsets::Random;
    let [contrast, ..] = figures(&settings);
    assert!(contrast < 0.65, "contrast {contrast}");
}

/// Width and height of the pictures of a turning model.
pub(super) const TURNED: (usize, usize) = (320, 240);

/// Root mean square change of lightness at the same point of the model over a turn of `degrees`. It
/// is relative to the change if the picture stood still while the model turns. Mean of `steps`
/// turns.
fn popping(mesh: &Mesh, settings: &Settings, degrees: f32, steps: usize) -> f64 {
    let mut painter = Painter::of_model(mesh, &map(3), settings).unwrap();
    popping_of(mesh, degrees, steps, |camera, _| painter.paint(camera, TURNED, 0.0).unwrap().color)
}

/// Popping, as `popping` measures it, of the pictures that `picture` returns for a camera and its
/// number in the turn.
pub(super) fn popping_of(
    mesh: &Mesh,
    degrees: f32,
    steps: usize,
    mut picture: impl FnMut(&Camera, usize) -> Field<[f32; 4]>,
) -> f64 {
    let mut compute = Compute::cpu();
    let mut model = Model::new(&mut compute, PackedMesh::new(mesh)).unwrap();
    let framing = Framing { aspect: 4.0 / 3.0, ..Framing::default() };
    let frames = (360.0 / degrees).round() as usize;
    let cameras = framing.fit_turntable(&mesh.positions, frames);
    let [mut moved, mut still] = [Popping::default(); 2];
    for step in 0..steps {
        let first = step * frames / steps;
        let [before, mut after] = [first, (first + 1) % frames].map(|number: usize| {
            let camera = &cameras[number];
            let visible = model.visible(&mut compute, camera, TURNED.0, TURNED.1).unwrap();
            let lab = lab_from_linear(&linear(&picture(camera, number)));
            let values = lab.values().iter().map(|lab| lab[0]).collect();
            let lightness = Field::from_values(TURNED.0, TURNED.1, values);
            (Projection::new(camera, TURNED.0, TURNED.1), depth_field(visible.host()), lightness)
        });
        // Where the picture that stands still shows no model it cannot be compared.
        let pairs = after.1.values_mut().iter_mut().zip(before.1.values());
        pairs.filter(|(_, before)| **before == 1.0).for_each(|(after, _)| *after = 1.0);
        let last = NoiseFrame { projection: &before.0, depth: &before.1, noise: &before.2 };
        let [next, stays] = [&after.2, &before.2].map(|noise| NoiseFrame {
            projection: &after.0,
            depth: &after.1,
            noise,
        });
        moved = moved.merge(Popping::between(last, next));
        // The picture stays where it is on the screen while the model turns.
        still = still.merge(Popping::between(last, stays));
    }
    moved.rms() / still.rms()
}

/// Settings for measures of popping: light that moves with the model, so that only strokes change.
pub(super) fn lit_with_the_model() -> Settings {
    let mut settings = Settings::default();
    settings.strokes.width_px = 15.0;
    settings.light.with = LightWith::Model;
    settings
}

#[test]
fn strokes_stay_on_a_turning_model() {
    for shape in [SampleModel::Sphere, SampleModel::TorusKnot] {
        let mesh = shape.mesh(8000);
        let settings = lit_with_the_model();
        let six = popping(&mesh, &settings, 6.0, 4);
        let thirty = popping(&mesh, &settings, 30.0, 2);
        assert!(six <= 0.25, "{}: {six} in 6 degrees", shape.name());
        assert!(thirty <= 0.5, "{}: {thirty} in 30 degrees", shape.name());
        let mut published = settings;
        published.overlap.offsets = Offsets::Random;
        published.strokes.tilt = 0.0;
        let published = popping(&mesh, &published, 6.0, 2);
        assert!(six < 0.9 * published, "{}: {six}, published {published}", shape.name());
    }
}

#[test]
fn a_picture_has_the_same_bits_on_any_number_of_threads_and_again() {
    let mesh = Mesh::torus_knot(4000);
    let camera = Framing { aspect: 4.0 / 3.0, ..Framing::default() }.fit(&mesh.positions);
    let mut settings = Settings::default();
    settings.color.from = ColorSource::Model;
    let pictures = [1, 2, 5].map(|threads| {
        rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap().install(|| {
            let mut painter = Painter::of_model(&mesh, &map(3), &settings).unwrap();
            painter.paint(&camera, (161, 119), 0.0).unwrap()
        })
    });
    fn bits(picture: &PaintedPicture) -> Vec<u32> {
        let color = picture.color.values().iter().flatten();
        color.chain(picture.height_mm.values()).map(|value| value.to_bits()).collect()
    }
    assert!(pictures.iter().all(|picture| bits(picture) == bits(&pictures[0])));
    let covered = pictures[0].color.values().iter().filter(|pixel| pixel[3] > 0.9).count();
    assert!(covered > 161 * 119 / 5, "{covered}");
}

/// The splats of a knot from two cameras. Each pair has the same splat from both. We leave out
/// splats of hardly any weight.
fn turns(settings: &Settings, degrees: f32) -> Vec<[StrokeSplat; 2]> {
    let mesh = Mesh::torus_knot(8000);
    let mut painter = Painter::of_model(&mesh, &map(2), settings).unwrap();
    let cameras = Framing::default().fit_turntable(&mesh.positions, (360.0 / degrees) as usize);
    let [before, after] =
        [0, 1].map(|at| painter.splats(&cameras[at], (300, 300), 0.0).unwrap().1.concat());
    // Splats have no name, so we use their start in the map, which no other splat has.
    fn key(splat: &StrokeSplat) -> [u32; 2] {
        splat.offset.map(f32::to_bits)
    }
    let mut after: Vec<_> = after.iter().map(|splat| (key(splat), *splat)).collect();
    after.sort_unstable_by_key(|(key, _)| *key);
    before
        .iter()
        .filter(|splat| splat.weight > 0.05)
        .filter_map(|splat: &StrokeSplat| {
            let at = after.binary_search_by_key(&key(splat), |(key, _)| *key).ok()?;
            Some([*splat, after[at].1])
        })
        .collect()
}

#[test]
fn strokes_turn_little_from_frame_to_frame() {
    let mut settings = Settings::default();
    settings.overlap.offsets = Offsets::Random;
    let pairs = turns(&settings, 6.0);
    assert!(pairs.len() > 300, "{}", pairs.len());
    let mut turns: Vec<f32> = pairs
        .iter()
        .map(|[a, b]: &[StrokeSplat; 2]| {
            let by = (a.turn() - b.turn()).rem_euclid(std::f32::consts::PI);
            by.min(std::f32::consts::PI - by).to_degrees()
        })
        .collect();
    turns.sort_by(f32::total_cmp);
    let most = turns[turns.len() * 99 / 100];
    assert!(most < 12.0, "99 of 100 below {most} degrees");
}

#[test]
fn faces_of_a_closed_model_that_turn_away_have_no_strokes() {
    let closed = Mesh::sphere(2000);
    let camera = Framing::default().fit(&closed.positions);
    let mut open = closed.clone();
    open.triangles.pop();
    fn count(mesh: &Mesh, camera: &Camera) -> f32 {
        let mut painter = Painter::of_model(mesh, &map(1), &Settings::default()).unwrap();
        painter.splats(camera, (300, 300), 0.0).unwrap().1.concat().len() as f32
    }
    let front = count(&closed, &camera);
    let both = count(&open, &camera);
    assert!((0.35..0.6).contains(&(front / both)), "{front} of {both}");
    let inside = Camera { eye: Vec3::ZERO, target: Vec3::Z, near: 0.01, ..camera };
    assert!(count(&closed, &inside) > 50.0, "seen from inside");
}

#[test]
fn size_and_density_of_strokes_stay_while_the_model_moves_away() {
    let mesh = Mesh::sphere(20_000);
    let mut painter = Painter::of_model(&mesh, &map(2), &Settings::default()).unwrap();
    let mut densities = Vec::new();
    for distance in [1.0, 1.5, 2.0, 3.0, 5.0, 8.0] {
        let mut camera = Framing::default().fit(&mesh.positions);
        let away = camera.eye - camera.target;
        camera.eye = camera.target + away * distance;
        camera.far += away.length() * (distance - 1.0);
        let (depth, splats) = painter.splats(&camera, (900, 900), 0.0).unwrap();
        let seen = depth.values().iter().filter(|depth| **depth < 1.0).count();
        let splats = splats.concat();
        let weight: f32 = splats.iter().map(|splat| splat.cover).sum();
        densities.push(weight / seen as f32);
        let expected = 900.0 / 1000.0 * 15.0;
        let tilt = painter.settings().strokes.tilt;
        for splat in splats.iter().filter(|splat| splat.weight > 0.9) {
            let width = 1.0 / Vec2::from(splat.across).length();
            assert!(width <= expected * 1.05 && width > expected * (1.0 - tilt), "{width}");
        }
    }
    let mean = densities.iter().sum::<f32>() / densities.len() as f32;
    let off: f32 = densities.iter().map(|density| (density / mean - 1.0).powi(2)).sum();
    let deviation = (off / densities.len() as f32).sqrt();
    assert!(deviation <= 0.08, "{deviation}: {densities:?}");
}

#[test]
fn a_loop_of_flow_closes_to_the_bit_and_goes_on_evenly() {
    let mesh = Mesh::torus_knot(4000);
    let camera = Framing::default().fit(&mesh.positions);
    let mut settings = Settings::default();
    settings.strokes.width_px = 10.0;
    (settings.flow.periods, settings.flow.loop_seconds) = (1, 2.0);
    let mut painter = Painter::of_model(&mesh, &map(2), &settings).unwrap();
    let frames = [0, 1, 47, 48].map(|number: i32| {
        let seconds = f64::from(number) * 2.0 / 48.0;
        painter.paint(&camera, (200, 200), seconds).unwrap().color
    });
    assert_eq!(frames[0], frames[3]);
    fn change(a: &Field<[f32; 4]>, b: &Field<[f32; 4]>) -> f64 {
        let pairs = a.values().iter().zip(b.values());
        pairs.map(|(a, b)| f64::from(a[1] - b[1]).powi(2)).sum::<f64>().sqrt()
    }
    let [first, last] = [change(&frames[0], &frames[1]), change(&frames[2], &frames[3])];
    assert!(first > 0.1, "strokes move: {first}");
    assert!((last / first - 1.0).abs() < 0.02, "{first} {last}");
}

#[test]
fn bad_input_is_refused_and_strange_input_painted() {
    let map = map(1);
    let painter = |mesh: &Mesh| Painter::of_model(mesh, &map, &Settings::default());
    fn hint(error: PainterError) -> String {
        assert!(error.hint().is_some(), "{error}");
        error.to_string()
    }
    assert_eq!(hint(painter(&Mesh::default()).unwrap_err()), "the mesh has no triangle");
    let mut line = Mesh::sphere(100);
    line.positions.iter_mut().for_each(|place| *place = [place[0], 0.0, 0.0]);
    assert_eq!(hint(painter(&line).unwrap_err()), "no triangle of the mesh has an area");
    let mut settings = Settings::default();
    settings.light.wrap = f32::NAN;
    let error = Painter::of_model(&Mesh::sphere(100), &map, &settings).unwrap_err();
    assert!(hint(error).contains("light.wrap takes 0 to 1"));
    let empty = ArtMap { keys: Vec::new(), ..map.clone() };
    let error = Painter::of_model(&Mesh::sphere(100), &empty, &Settings::default()).unwrap_err();
    assert_eq!(hint(error), "the art map has no tile");

    let mut one = flat();
    one.triangles.truncate(1);
    let camera = Framing::default().fit(&one.positions);
    let mut painter = painter(&one).unwrap();
    assert!(hint(painter.paint(&camera, (0, 10), 0.0).unwrap_err()).contains("0 x 10"));
    assert!(hint(painter.paint(&camera, (9, 9), f64::NAN).unwrap_err()).contains("NaN"));
    let nowhere = Camera { eye: camera.target, ..camera };
    assert!(hint(painter.paint(&nowhere, (9, 9), 0.0).unwrap_err()).contains("looks at"));
    for size in [(1, 1), (7, 200)] {
        let picture = painter.paint(&camera, size, 1e9).unwrap();
        assert!(picture.color.values().iter().flatten().all(|value| value.is_finite()));
    }
    let inside =
        Camera { eye: Vec3::new(0.1, 0.1, 0.01), target: Vec3::ZERO, near: 1e-4, ..camera };
    let picture = painter.paint(&inside, (40, 30), 0.0).unwrap();
    assert!(picture.color.values().iter().flatten().all(|value| value.is_finite()));
}

#[test]
fn strokes_change_no_more_than_the_light_that_turns() {
    let mesh = Mesh::sphere(8000);
    let camera = Framing::default().fit(&mesh.positions);
    let size = (240, 240);
    let map = map(3);
    let projection = Projection::new(&camera, size.0, size.1);
    let range = map.keys[2].tone - map.keys[0].tone;
    let [(before, shade_before), (after, shade_after)] = [315.0, 321.0].map(|azimuth_deg: f32| {
        let mut settings = lit_with_the_model();
        settings.light.azimuth_deg = azimuth_deg;
        let light = DistantLight::with_camera(azimuth_deg, settings.light.elevation_deg);
        let DistantLight::WithCamera(light) = light else { unreachable!("made so") };
        let mut painter = Painter::of_model(&mesh, &map, &settings).unwrap();
        let (depth, _) = painter.splats(&camera, size, 0.0).unwrap();
        let lab = lab_from_linear(&linear(&painter.paint(&camera, size, 0.0).unwrap().color));
        (lab, move |at: (usize, usize)| {
            let normal = projection.unproject(at, depth[at]).normalize();
            let wrap = settings.light.wrap;
            let seen = (depth[at] < 1.0).then_some(normal)?;
            Some(f64::from(((seen.dot(light) + wrap) / (1.0 + wrap)).clamp(0.0, 1.0)) * range)
        })
    });
    let mut strokes = 0.0;
    let mut shades = 0.0;
    for at in (0..size.0 * size.1).map(|index| (index % size.0, index / size.0)) {
        let (Some(was), Some(is)) = (shade_before(at), shade_after(at)) else { continue };
        shades += (is - was).powi(2);
        strokes += f64::from(after[at][0] - before[at][0]).powi(2);
    }
    let ratio = (strokes / shades).sqrt();
    assert!((0.7..=1.15).contains(&ratio), "{ratio}");
}

#[test]
fn outlines_are_dark_lines_of_even_width_that_come_in_smoothly() {
    let mesh = Mesh::sphere(8000);
    let camera = Framing::default().fit(&mesh.positions);
    let mut settings = Settings::default();
    // The map's lightest tone everywhere but on lines.
    (settings.light.darkest, settings.light.lightest) = (1.0, 1.0);
    let [(none, _), (thin, inside), (wide, _)] = [0.0, 10.0, 20.0].map(|width_px: f32| {
        settings.silhouette.width_px = width_px;
        let mut painter = Painter::of_model(&mesh, &map(2), &settings).unwrap();
        let picture = painter.paint(&camera, (500, 500), 0.0).unwrap().color;
        fn is_dark(pixel: &[f32; 4]) -> bool {
            pixel[3] > 0.9 && pixel[1] < 0.35
        }
        let middle = picture.part(Rect { x: 150, y: 150, width: 200, height: 200 });
        let inside = middle.values().iter().filter(|pixel| is_dark(pixel)).count();
        (picture.values().iter().filter(|pixel| is_dark(pixel)).count() - inside, inside)
    });
    // The outline has a circumference of 1445 px. Lines are 5 and 10 px wide in this picture.
    let [thin, wide] = [thin, wide].map(|count| (count - none) as f32 / 1445.0);
    assert!((3.0..8.0).contains(&thin), "{thin} px for 5");
    assert!((6.0..16.0).contains(&wide) && wide > 1.6 * thin, "{wide} px for 10, {thin} for 5");
    assert!(inside < 100, "{inside} in the middle of the ball");
}
