use graphics::camera::{Camera, PictureView};
use graphics::encoding::lab_from_linear;
use graphics::export::frame_png;
use graphics::picture::Picture;
use spectra::color::Rgb;

use super::super::made_up::map;
use super::super::picture_form::FlowPicture;
use super::super::regions::{Region, RegionArea};
use super::super::settings::{ColorSource, Offsets};
use super::*;

/// A photograph from encoded bytes.
pub(super) fn photograph(
    width: usize,
    height: usize,
    color: impl Fn(usize, usize) -> [u8; 3],
) -> Photograph {
    let values = (0..width * height).map(|at| color(at % width, at / width)).collect();
    let png = frame_png(&Field::from_values(width, height, values)).unwrap();
    Photograph::from_bytes("made up", &png).unwrap()
}

/// Diagonal stripes that fade to the right.
fn stripes() -> Photograph {
    photograph(200, 120, |x, y| {
        let wave = ((x + y) as f32 * 0.25).sin() * (1.0 - x as f32 / 300.0);
        [128.0 + 90.0 * wave, 110.0 + 60.0 * wave, 90.0].map(|value| value as u8)
    })
}

/// The camera that sees exactly a picture.
pub(super) fn view(picture: &Photograph) -> Camera {
    PictureView::of(picture.size()).camera()
}

fn settings() -> Settings {
    let mut settings = Settings { reference_px: 400.0, ..Settings::default() };
    settings.strokes.width_px = 8.0;
    settings
}

fn lab(picture: &Field<[f32; 4]>) -> Field<[f32; 3]> {
    let linear = |[r, g, b, _]: &[f32; 4]| {
        Rgb([r, g, b].map(|value| f64::from(*value))).linear().0.map(|value| value as f32)
    };
    let linear = picture.values().iter().map(linear).collect();
    lab_from_linear(&Picture::from_values(picture.width(), picture.height(), linear))
}

/// Mean colour of a part of a picture.
fn mean(lab: &Field<[f32; 3]>, x: std::ops::Range<usize>, y: std::ops::Range<usize>) -> Vec3 {
    let cells = y.flat_map(|y| x.clone().map(move |x| (x, y)));
    let (sum, count) =
        cells.fold((Vec3::ZERO, 0.0), |(sum, count), at| (sum + Vec3::from(lab[at]), count + 1.0));
    sum / count
}

#[test]
fn a_picture_keeps_its_colours_and_is_covered_to_its_edges() {
    let left = [150, 60, 40];
    let right = [70, 110, 160];
    let picture = photograph(160, 120, |x, _| if x < 80 { left } else { right });
    let mut painter = Painter::of_picture(&picture, &map(3), &settings()).unwrap();
    let painted = painter.paint(&view(&picture), (320, 240), 0.0).unwrap().color;
    assert!(painted.values().iter().all(|pixel| pixel[3] == 1.0));
    let lab = lab(&painted);
    for (color, columns) in [(left, 20..130), (right, 190..300)] {
        let texel = color.map(|byte| f64::from(byte) / 255.0);
        let linear = Rgb(texel).linear().0.map(|value| value as f32);
        let wanted = Vec3::from(lab_from_linear(&Field::filled(1, 1, linear)).values()[0]);
        let found = mean(&lab, columns, 20..220);
        assert!(found.distance(wanted) < 3.0, "{found} {wanted}");
    }
}

#[test]
fn strokes_run_along_the_edges_of_the_picture() {
    let mut painter = Painter::of_picture(&stripes(), &map(2), &settings()).unwrap();
    let (_, splats) = painter.splats(&view(&stripes()), (400, 240), 0.0).unwrap();
    let inside = splats[0].iter().filter(|splat| splat.x > 20.0 && splat.x < 300.0);
    let mut along = 0;
    let mut count = 0;
    for splat in inside {
        // Lines of equal x + y rise to the right.
        let off = (splat.turn() + std::f32::consts::FRAC_PI_4).sin().abs();
        along += usize::from(off < 8.0_f32.to_radians().sin());
        count += 1;
    }
    assert!(count > 300 && along * 100 > count * 95, "{along} of {count}");
}

#[test]
fn tones_follow_the_lightness_of_the_picture_or_light() {
    let picture = photograph(160, 120, |x, _| if x < 80 { [40; 3] } else { [200; 3] });
    let of = |text: &str| {
        let settings = settings().changed("test", text).unwrap();
        let mut painter = Painter::of_picture(&picture, &map(3), &settings).unwrap();
        let painted = painter.paint(&view(&picture), (160, 120), 0.0).unwrap().color;
        let lab = lab(&painted);
        mean(&lab, 90..150, 10..110).x - mean(&lab, 10..70, 10..110).x
    };
    assert!(of("colour.from = \"map\"") > 20.0);
    assert!(of("colour.from = \"map\"\nlight.tone = \"light\"").abs() < 2.0);
}

#[test]
fn guides_flow_pictures_and_regions_turn_strokes() {
    let even = photograph(160, 120, |_, _| [120; 3]);
    let map = map(1);
    let turned = |form: &PictureForm, regions: Vec<Region>| {
        let regions = Regions { list: regions, ..Regions::default() };
        let brushwork = Brushwork { regions, ..Brushwork::of(&map) };
        let mut painter = Painter::of_picture_with(&even, &brushwork, form, &settings()).unwrap();
        let (_, splats) = painter.splats(&view(&even), (160, 120), 0.0).unwrap();
        splats[0]
            .iter()
            .map(|splat| (Vec2::new(splat.x, splat.y), splat.turn()))
            .collect::<Vec<_>>()
    };
    let off = |turn: f32, wanted: Vec2| Vec2::from_angle(turn).perp_dot(wanted.normalize()).abs();
    let guide = [[0.2, 0.5], [3.0, 3.0]];
    let form = PictureForm { guides: vec![guide], ..PictureForm::default() };
    assert!(turned(&form, Vec::new()).iter().all(|(_, turn)| off(*turn, Vec2::ONE) < 0.1));
    let arrows = Field::filled(2, 2, [0.0, -0.5]);
    let form = PictureForm { flow: Some(FlowPicture::of(arrows)), ..PictureForm::default() };
    assert!(turned(&form, Vec::new()).iter().all(|(_, turn)| off(*turn, Vec2::Y) < 0.1));
    let whole = RegionArea::Polygon(vec![[0.0, 0.0], [160.0, 0.0], [160.0, 120.0], [0.0, 120.0]]);
    let around = Region { around: Some([80.0, 60.0]), ..Region::new("a", whole.clone()) };
    let swirl = turned(&PictureForm::default(), vec![around]);
    let far = swirl.iter().filter(|(at, _)| at.distance(Vec2::new(80.0, 60.0)) > 25.0);
    assert!(far.clone().count() > 50);
    for (at, turn) in far {
        assert!(off(*turn, (*at - Vec2::new(80.0, 60.0)).perp()) < 0.3, "{at} {turn}");
    }
    let angle = Region { angle_deg: Some(30.0), ..Region::new("a", whole) };
    let wanted = Vec2::from_angle(30_f32.to_radians());
    let slanted = turned(&PictureForm::default(), vec![angle]);
    assert!(slanted.iter().all(|(_, turn)| off(*turn, wanted) < 0.05));
}

#[test]
fn regions_have_their_map_size_and_tones() {
    let even = photograph(160, 120, |_, _| [120; 3]);
    let first = map(1);
    let mut second = map(1);
    // Blue strokes instead of ochre ones.
    second.keys[0].tile.color.values_mut().iter_mut().for_each(|rgb| rgb.reverse());
    let area = RegionArea::Polygon(vec![[0.0, 0.0], [80.0, 0.0], [80.0, 120.0], [0.0, 120.0]]);
    let region = Region { map: Some("blue".to_owned()), size: 2.0, ..Region::new("left", area) };
    let regions = Regions { list: vec![region], ..Regions::default() };
    let brushwork = Brushwork { maps: vec![("ochre", &first), ("blue", &second)], regions };
    let mut settings = settings();
    settings.color.from = ColorSource::Map;
    let form = PictureForm::default();
    let mut painter = Painter::of_picture_with(&even, &brushwork, &form, &settings).unwrap();
    let camera = view(&even);
    let lab = lab(&painter.paint(&camera, (320, 240), 0.0).unwrap().color);
    let [left, right] = [10..130, 190..310].map(|columns| mean(&lab, columns, 10..230));
    assert!(left.z < -5.0 && right.z > 5.0, "{left} {right}");
    let (_, splats) = painter.splats(&camera, (320, 240), 0.0).unwrap();
    let mut widths = [0.0; 2];
    let mut counts = [0.0_f32; 2];
    for splat in splats[0].iter().filter(|splat| (splat.x - 160.0).abs() > 20.0) {
        let side = usize::from(splat.x > 160.0);
        widths[side] += 1.0 / Vec2::from(splat.across).length();
        counts[side] += 1.0;
    }
    let ratio = (widths[0] / counts[0]) / (widths[1] / counts[1]);
    assert!((ratio - 2.0).abs() < 0.05, "{ratio}");
    assert!((counts[1] / counts[0] - 4.0).abs() < 1.0, "{counts:?}");
}

#[test]
fn twinkling_changes_tones_in_a_loop_that_closes() {
    let even = photograph(160, 120, |_, _| [120; 3]);
    let mut settings = settings();
    (settings.flow.twinkle, settings.flow.loop_seconds) = (0.3, 2.0);
    let mut painter = Painter::of_picture(&even, &map(3), &settings).unwrap();
    let camera = view(&even);
    let mut at = |seconds: f64| painter.paint(&camera, (160, 120), seconds).unwrap().color;
    let [first, then, last] = [0.0, 0.6, 2.0].map(&mut at);
    assert_eq!(first, last);
    let change = first.values().iter().zip(then.values()).map(|(a, b)| (a[1] - b[1]).abs());
    assert!(change.sum::<f32>() / first.values().len() as f32 > 0.02);
}

#[test]
fn a_relief_looks_the_same_from_the_front_and_shifts_from_the_side() {
    let picture = stripes();
    let depth = Field::from_values(20, 12, (0..240).map(|at| (at % 20) as f32 / 19.0).collect());
    let form = PictureForm { depth: Some(depth), ..PictureForm::default() };
    let map = map(2);
    let mut settings = settings();
    settings.overlap.offsets = Offsets::Random;
    let brushwork = Brushwork::of(&map);
    let mut relief = Painter::of_picture_with(&picture, &brushwork, &form, &settings).unwrap();
    let [front, side] =
        [0.0, 20.0].map(|right_deg| PictureView::of(picture.size()).turned(right_deg, 0.0));
    let size = (200, 120);
    let seen = |painter: &mut Painter, camera| {
        let (depth, _) = painter.splats(&camera, size, 0.0).unwrap();
        depth
    };
    let flat = seen(&mut relief, front);
    assert!(flat.values().iter().all(|depth| *depth < 1.0), "it fills the picture");
    assert!(flat[(190, 60)] < flat[(10, 60)], "white is near");
    let turned = seen(&mut relief, side);
    assert!(turned.values().contains(&1.0));
    // The camera of the picture sees every point of the relief at its own place.
    let painted = relief.paint(&front, size, 0.0).unwrap().color;
    let mut plane = Painter::of_picture(&picture, &map, &settings).unwrap();
    let wanted = plane.paint(&front, size, 0.0).unwrap().color;
    let [found, wanted] = [lab(&painted), lab(&wanted)];
    let part = |lab: &Field<[f32; 3]>| mean(lab, 30..90, 30..90);
    assert!(part(&found).distance(part(&wanted)) < 3.0);
}

#[test]
fn layers_show_detail_that_large_strokes_blur() {
    let picture = photograph(320, 240, |x, y| {
        let fine = x > 160 && (x / 8 + y / 8).is_multiple_of(2);
        if fine { [220, 200, 160] } else { [70, 60, 60] }
    });
    let error = |layers: u32| {
        let mut settings = settings();
        settings.strokes.width_px = 16.0;
        settings.layers.count = layers;
        let mut painter = Painter::of_picture(&picture, &map(3), &settings).unwrap();
        let painted = painter.paint(&view(&picture), (320, 240), 0.0).unwrap().color;
        let found = lab(&painted);
        let wanted = lab_from_linear(&picture.on_canvas(320, 240));
        let off = found.values().iter().zip(wanted.values());
        off.map(|(a, b)| Vec3::from(*a).distance(Vec3::from(*b))).sum::<f32>() / 76_800.0
    };
    let [one, three] = [1, 3].map(error);
    assert!(three < 0.75 * one, "{three} {one}");
}

#[test]
fn strange_pictures_are_painted() {
    for (width, height) in [(1, 1), (3, 200), (200, 2)] {
        let picture = photograph(width, height, |_, _| [90, 120, 30]);
        let mut painter = Painter::of_picture(&picture, &map(1), &settings()).unwrap();
        let camera = view(&picture);
        let painted = painter.paint(&camera, (width.max(2), height.max(2)), 0.0).unwrap();
        assert!(painted.color.values().iter().flatten().all(|value| value.is_finite()));
    }
}
