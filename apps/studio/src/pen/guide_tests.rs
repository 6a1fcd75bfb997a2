//! Tests of strokes that a guide leads, without a window.

use web_time::{Duration, Instant};

use eframe::egui::{Modifiers, Pos2, Rect, pos2, vec2};
use paint::pose::Sample;
use paint::strokes::SurfaceId;
use session::brushes::StabiliserMethod;

use super::{
    Device, Guide, Pen, PenEvent, PenSettings, PenTargets, Perspective, PointerState, Ruler,
    RulerShape, Script, SurfaceTransform,
};

/// Canvas of 200 x 150 mm at 4 points per mm; right of it the palette, which begins at 0 mm too.
fn transforms() -> [SurfaceTransform; 2] {
    let area = |x, width| Rect::from_min_size(pos2(x, 0.0), vec2(width, 600.0));
    let mm = |at: Pos2| (f64::from(at.x) / 4.0, f64::from(at.y) / 4.0);
    [
        SurfaceTransform::new(SurfaceId::Canvas, area(0.0, 800.0), mm),
        SurfaceTransform::new(SurfaceId::Palette, area(800.0, 200.0), move |at| {
            mm(at - vec2(800.0, 0.0))
        }),
    ]
}

/// A pen at a place in mm of the canvas, without twist.
fn hold(x_mm: f64, y_mm: f64) -> PointerState {
    let at = pos2(4.0 * x_mm as f32, 4.0 * y_mm as f32);
    PointerState { pressure: Some(0.5), ..PointerState::at(at) }
}

/// A wavy stroke to the lower right.
fn wavy() -> Vec<PointerState> {
    (0..60)
        .map(|step: u8| {
            let along = 0.7 * f64::from(step);
            hold(60.0 + along, 50.0 + 0.4 * along + 2.0 * along.sin())
        })
        .collect()
}

/// Samples of each of the strokes of a pen, one after another.
fn strokes(pen: &mut Pen, strokes: &[Vec<PointerState>], modifiers: Modifiers) -> Vec<Vec<Sample>> {
    let start = Instant::now();
    let transforms = transforms();
    let mut script = Script::new(Device::Pen);
    for holds in strokes {
        script = script.stroke(holds.iter().copied(), Duration::from_millis(5));
    }
    let mut all: Vec<Vec<Sample>> = Vec::new();
    for frame in 0..200 {
        let now = start + Duration::from_millis(10 * frame);
        script.due(start, now).into_iter().for_each(|report| pen.feed(report));
        let targets = PenTargets { surfaces: &transforms, covered: &|_| false };
        for event in pen.process_frame(&[], modifiers, now, &targets) {
            match event {
                PenEvent::Down { .. } => all.push(Vec::new()),
                PenEvent::Move(samples) => {
                    let stroke = all.last_mut().expect("a stroke has begun");
                    stroke.extend(samples.into_iter().map(|sample| sample.sample));
                }
                _ => {}
            }
        }
    }
    all
}

fn led_by(guide: Option<Guide>, settings: PenSettings) -> Pen {
    let mut pen = Pen::new(settings);
    pen.guide = guide;
    pen
}

fn stroke(guide: Option<Guide>, holds: Vec<PointerState>) -> Vec<Sample> {
    let mut pen = led_by(guide, PenSettings::default());
    strokes(&mut pen, &[holds], Modifiers::NONE).remove(0)
}

fn ruler() -> Guide {
    Guide::Ruler(Ruler { ends: [[10.0, 20.0], [110.0, 95.0]], ..Ruler::default() })
}

fn perspective() -> Guide {
    let points = [[0.0, 0.0], [200.0, 10.0], [0.0, 0.0]];
    Guide::Perspective(Perspective { count: 2, points })
}

/// Farthest distance of samples from the line through two places.
fn off(samples: &[Sample], [from, to]: [[f64; 2]; 2]) -> f64 {
    let right = to[0] - from[0];
    let down = to[1] - from[1];
    samples
        .iter()
        .map(|sample: &Sample| {
            let x = sample.x_mm - from[0];
            let y = sample.y_mm - from[1];
            (x * down - y * right).abs() / right.hypot(down)
        })
        .fold(0.0, f64::max)
}

#[test]
fn a_stroke_along_the_ruler_is_straight_and_keeps_time_and_pressure() {
    let free = stroke(None, wavy());
    assert!(off(&free, [[10.0, 20.0], [110.0, 95.0]]) > 1.0, "the hand shakes");
    let led = stroke(Some(ruler()), wavy());
    assert!(off(&led, [[10.0, 20.0], [110.0, 95.0]]) < 1e-9);
    assert_eq!(led.len(), free.len());
    for (led, free) in led.iter().zip(&free) {
        assert_eq!((led.seconds, led.pressure), (free.seconds, free.pressure));
    }
    // The broad side is across the ruler, whose slope is 3 to 4, from the first sample on.
    let across = 0.75_f64.atan().to_degrees() + 90.0;
    let twist = |sample: &Sample| (sample.twist_deg - across + 90.0).rem_euclid(180.0) - 90.0;
    assert!(led.iter().all(|sample| twist(sample).abs() < 1e-3), "{:?}", led[0]);
}

#[test]
fn a_stabilised_stroke_ends_on_the_ruler_too() {
    let mut settings = PenSettings::default();
    settings.stabiliser.method = StabiliserMethod::String;
    let mut pen = led_by(Some(ruler()), settings);
    let led = strokes(&mut pen, &[wavy()], Modifiers::NONE).remove(0);
    assert!(off(&led, [[10.0, 20.0], [110.0, 95.0]]) < 1e-9);
    let first = led[0];
    let last = led[led.len() - 1];
    assert!(last.x_mm - first.x_mm > 30.0, "it catches up: {first:?} {last:?}");
}

#[test]
fn perspective_leads_all_samples_to_the_point_of_the_first_direction() {
    let holds: Vec<PointerState> = (0..60)
        .map(|step: u8| {
            let along = 0.7 * f64::from(step);
            hold(60.0 + along, 50.0 + 0.7 * along + 0.8 * (2.0 * along).sin())
        })
        .collect();
    let led = stroke(Some(perspective()), holds.clone());
    let start = [led[0].x_mm, led[0].y_mm];
    assert_eq!(start, [60.0, 50.0]);
    assert!(off(&led, [[0.0, 0.0], start]) < 1e-9, "away from the first vanishing point");
    assert_eq!(led.len(), stroke(None, holds).len(), "no sample is lost");
    let twists = led.iter().map(|sample| sample.twist_deg);
    let least = twists.clone().fold(360.0, f64::min);
    let most = twists.fold(-360.0, f64::max);
    assert!(most - least < 1e-3, "the brush does not turn: {least} to {most}");
}

#[test]
fn a_touch_in_perspective_paints_a_dot() {
    let touch = vec![hold(40.0, 40.0), hold(40.5, 40.2), hold(40.2, 40.1)];
    let led = stroke(Some(perspective()), touch.clone());
    let free = stroke(None, touch);
    assert!(led.len() >= 3);
    let places = |samples: &[Sample]| {
        samples.iter().map(|sample| [sample.x_mm, sample.y_mm]).collect::<Vec<_>>()
    };
    assert_eq!(places(&led)[..3], places(&free)[..3]);
}

#[test]
fn strokes_on_the_palette_are_free() {
    let right =
        wavy().into_iter().map(|state| PointerState { at: state.at + vec2(600.0, 0.0), ..state });
    let right: Vec<PointerState> = right.collect();
    assert_eq!(stroke(Some(ruler()), right.clone()), stroke(None, right));
}

#[test]
fn a_line_with_shift_goes_on_parallel_to_the_ruler() {
    let Guide::Ruler(ruler) = ruler() else { panic!("a ruler") };
    let parallel = Guide::Ruler(Ruler { shape: RulerShape::Parallel, ..ruler });
    let mut pen = led_by(Some(parallel), PenSettings::default());
    let shift = Modifiers::SHIFT;
    let both = strokes(&mut pen, &[wavy(), vec![hold(150.0, 60.0), hold(150.0, 60.0)]], shift);
    let [first, second] = &both[..] else { panic!("two strokes: {}", both.len()) };
    let end = first[first.len() - 1];
    let line = [[end.x_mm, end.y_mm], [end.x_mm + 4.0, end.y_mm + 3.0]];
    assert!(off(second, line) < 1e-9, "on the line of the first");
    let gap = (end.x_mm - second[0].x_mm).hypot(end.y_mm - second[0].y_mm);
    assert!(gap < 1e-9, "from the end of the first: {gap} mm");
}

#[test]
fn pens_with_twist_and_mice_are_led_from_the_first_sample_to_the_last() {
    let twisted = wavy().into_iter().map(|state| PointerState { twist_deg: Some(30.0), ..state });
    let led = stroke(Some(perspective()), twisted.collect());
    let first = led[0];
    let last = led[led.len() - 1];
    let line = [[first.x_mm, first.y_mm], [last.x_mm, last.y_mm]];
    assert!(off(&led, line) < 1e-9 && last.twist_deg == led[5].twist_deg, "{first:?} {last:?}");
    let mouse = wavy().into_iter().map(|state| PointerState { pressure: None, ..state });
    let led = stroke(Some(ruler()), mouse.collect());
    assert!(led[led.len() - 1].pressure < 0.1, "the mouse is lifted");
    assert!(off(&led, [[10.0, 20.0], [110.0, 95.0]]) < 1e-9);
}
