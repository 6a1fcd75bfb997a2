//! Tests of pen input without a window: they feed reports of a device and check the samples, plain,
//! led by a guide, and stabilised.

use eframe::egui::{
    Event, Modifiers, PointerButton, Pos2, Rect, TouchDeviceId, TouchId, TouchPhase, pos2, vec2,
};
use paint::pose::Sample;
use paint::strokes::{SampleDecimals, SurfaceId};
use session::PenSample;
use session::brushes::{LengthUnit, StabiliserMethod, StabiliserSettings};
use web_time::{Duration, Instant};

use super::{
    Device, Guide, Pen, PenEvent, PenSettings, PenTargets, Perspective, PointerState, Report,
    ReportKind, Ruler, RulerShape, Script, SurfaceTransform, TestField,
};

/// Canvas and palette at 4 points per mm; the palette begins at x = 800.
fn transforms() -> [SurfaceTransform; 2] {
    [(SurfaceId::Canvas, 0.0, 800.0), (SurfaceId::Palette, 800.0, 200.0)].map(
        |(id, left, width)| {
            let area = Rect::from_min_size(pos2(left, 0.0), vec2(width, 600.0));
            SurfaceTransform::new(id, area, |at| {
                (f64::from(at.x - left) / 4.0, f64::from(at.y) / 4.0)
            })
        },
    )
}

struct TestPen {
    pen: Pen,
    start: Instant,
    transforms: [SurfaceTransform; 2],
    modifiers: Modifiers,
}

impl TestPen {
    fn new() -> Self {
        let pen = Pen::new(PenSettings::default());
        Self { pen, start: Instant::now(), transforms: transforms(), modifiers: Modifiers::NONE }
    }

    fn at(&self, ms: u64) -> Instant {
        self.start + Duration::from_millis(ms)
    }

    fn frame(&mut self, ms: u64, events: &[Event]) -> Vec<PenEvent> {
        let now = self.at(ms);
        let targets = PenTargets { surfaces: &self.transforms, covered: &|_| false };
        self.pen.process_frame(events, self.modifiers, now, &targets)
    }

    fn feed(&mut self, ms: u64, kind: ReportKind) {
        let arrived = self.at(ms);
        self.pen.feed(Report { device: Device::Pen, arrived, kind });
    }
}

fn moved(x: f32, y: f32) -> Event {
    Event::PointerMoved(pos2(x, y))
}

fn button(x: f32, y: f32, pressed: bool) -> Event {
    let button = PointerButton::Primary;
    let modifiers = Modifiers::NONE;
    Event::PointerButton { pos: pos2(x, y), button, pressed, modifiers }
}

fn state(x: f32, pressure: f64) -> PointerState {
    let tilt_deg = Some((20.0, -10.0));
    let twist_deg = Some(5.0);
    PointerState { at: pos2(x, 40.0), pressure: Some(pressure), tilt_deg, twist_deg }
}

/// All samples of the output, with the rounding of a stroke.
fn samples(output: &[PenEvent]) -> Vec<PenSample> {
    let moves = output.iter().filter_map(|event| match event {
        PenEvent::Move(samples) => Some(
            samples
                .iter()
                .map(|sample: &PenSample| PenSample {
                    sample: SampleDecimals::PEN.round(&sample.sample),
                    ..*sample
                })
                .collect::<Vec<_>>(),
        ),
        _ => None,
    });
    moves.flatten().collect()
}

/// The events as letters: D down, M move, U up, H hover, L leave, B barrel.
fn letters(output: &[PenEvent]) -> String {
    output
        .iter()
        .map(|event| match event {
            PenEvent::Down { .. } => 'D',
            PenEvent::Move(_) => 'M',
            PenEvent::Up => 'U',
            PenEvent::Hover { .. } => 'H',
            PenEvent::Leave => 'L',
            PenEvent::Barrel { .. } => 'B',
            PenEvent::Tap { .. } => 'T',
        })
        .collect()
}

#[test]
fn every_sample_between_two_frames_is_reported_in_order_with_its_own_time() {
    let mut test = TestPen::new();
    let holds = (0_u8..200).map(|step| state(f32::from(step) * 3.0, 0.5 + f64::from(step) / 400.0));
    let mut script = Script::new(Device::Pen).stroke(holds, Duration::from_millis(5));
    let start = test.start;
    let mut all = Vec::new();
    for frame in 0..70 {
        let now = test.at(frame * 16);
        script.due(start, now).into_iter().for_each(|report| test.pen.feed(report));
        all.extend(test.frame(frame * 16, &[]));
    }
    let samples = samples(&all);
    assert_eq!(samples.len(), 200);
    for (step, sample) in (0_u32..).zip(&samples) {
        let wanted = (f64::from(step) * 0.75, f64::from(5 * step) / 1000.0);
        assert_eq!((sample.sample.x_mm, sample.sample.seconds), wanted, "{step}");
        assert_eq!(sample.arrived, start + Duration::from_millis(5) * (step + 1));
        let Sample { tilt_x_deg, tilt_y_deg, twist_deg, .. } = sample.sample;
        assert_eq!((tilt_x_deg, tilt_y_deg, twist_deg), (20.0, -10.0, 5.0));
    }
    assert!(samples.is_sorted_by_key(|sample| sample.sample.pressure));
    let output = letters(&all);
    assert!(output.starts_with("DM") && output.ends_with("MUH"), "{output}");
    assert_eq!(output.matches('U').count(), 1);
}

#[test]
fn a_mouse_paints_with_the_grip_and_pressure_from_speed() {
    let mut test = TestPen::new();
    assert_eq!(letters(&test.frame(0, &[moved(100.0, 40.0)])), "H");
    let events = [button(100.0, 40.0, true), moved(104.0, 40.0), moved(110.0, 40.0)];
    let output = test.frame(16, &events);
    assert_eq!(letters(&output), "DM");
    let first = samples(&output);
    assert_eq!(first.len(), 3);
    let seconds: Vec<f64> = first.iter().map(|sample| sample.sample.seconds).collect();
    assert_eq!(seconds, [0.0, 0.0053, 0.0107]);
    let pressures: Vec<f64> = first.iter().map(|sample| sample.sample.pressure).collect();
    assert!(pressures[0] > 0.0 && pressures.is_sorted(), "{pressures:?}");
    assert_eq!((first[2].sample.tilt_x_deg, first[2].sample.tilt_y_deg), (3.54, 3.54));
    // The stroke continues beyond the canvas, over the palette.
    let output = test.frame(32, &[moved(900.0, 40.0), button(900.0, 40.0, false)]);
    assert_eq!(letters(&output), "MUH");
    let last = samples(&output);
    assert_eq!((last[0].sample.x_mm, last[0].sample.y_mm), (225.0, 10.0));
    let lifted = last.last().map(|sample| sample.sample.pressure);
    assert_eq!(lifted, Some(0.0));
    let PenEvent::Hover { surface, .. } = output[2] else { panic!("{output:?}") };
    assert_eq!(surface, SurfaceId::Palette);
}

#[test]
fn a_pen_at_rest_sends_one_rest_sample_until_it_moves_again() {
    let mut test = TestPen::new();
    test.feed(0, ReportKind::Pressed(state(10.0, 0.4)));
    test.feed(4, ReportKind::Moved(state(20.0, 0.4)));
    assert_eq!(samples(&test.frame(10, &[])).len(), 2);
    let waits = test.pen.repaint_after(test.at(10));
    assert_eq!(waits, Some(Duration::from_millis(24)));
    assert_eq!(letters(&test.frame(30, &[])), "");
    let still = samples(&test.frame(34, &[]));
    assert_eq!(still.len(), 1);
    let (sample, seconds) = (still[0].sample, still[0].sample.seconds);
    assert_eq!((sample.x_mm, sample.pressure, seconds), (5.0, 0.4, 0.034));
    for ms in [50, 90, 400] {
        assert_eq!(letters(&test.frame(ms, &[])), "", "{ms}");
    }
    assert_eq!(test.pen.repaint_after(test.at(400)), None);
    test.feed(500, ReportKind::Moved(state(20.0, 0.6)));
    assert_eq!(samples(&test.frame(500, &[])).len(), 1);
    assert_eq!(samples(&test.frame(540, &[])).len(), 1);
    test.feed(600, ReportKind::Released);
    assert_eq!(letters(&test.frame(600, &[])), "UH");
}

#[test]
fn a_mouse_at_rest_reaches_full_pressure_by_time() {
    let mut test = TestPen::new();
    test.frame(0, &[moved(40.0, 40.0)]);
    let mut output = test.frame(10, &[button(40.0, 40.0, true)]);
    for ms in [20, 40, 50, 60, 70, 80, 200, 300] {
        output.extend(test.frame(ms, &[]));
    }
    let pressures: Vec<f64> =
        samples(&output).iter().map(|sample| sample.sample.pressure).collect();
    assert_eq!(pressures.first(), Some(&0.095));
    assert_eq!(pressures.last(), Some(&0.475));
    assert!(pressures.len() >= 3 && pressures.is_sorted(), "{pressures:?}");
    assert_eq!(letters(&test.frame(310, &[button(40.0, 40.0, false)])), "MUH");
}

#[test]
fn mouse_events_sent_for_a_pen_do_not_paint_again() {
    let mut test = TestPen::new();
    test.feed(0, ReportKind::Moved(state(30.0, 0.0)));
    test.feed(6, ReportKind::Pressed(state(32.0, 0.3)));
    let as_mouse = [moved(30.0, 40.0), button(32.0, 40.0, true), moved(36.0, 40.0)];
    let output = test.frame(10, &as_mouse);
    assert_eq!(letters(&output), "DM");
    assert_eq!(samples(&output).len(), 1);
    test.feed(20, ReportKind::Moved(state(40.0, 0.5)));
    test.feed(24, ReportKind::Released);
    let output = test.frame(26, &[moved(40.0, 40.0), button(40.0, 40.0, false)]);
    assert_eq!((letters(&output).as_str(), samples(&output).len()), ("MUH", 1));
    // The other mouse events are ignored. Later you can paint with the mouse again.
    assert_eq!(letters(&test.frame(200, &[button(9.0, 9.0, true)])), "");
    assert_eq!(letters(&test.frame(220, &[button(9.0, 9.0, false)])), "");
    assert_eq!(letters(&test.frame(600, &[button(9.0, 9.0, true)])), "D");
}

#[test]
fn a_stroke_begun_by_mouse_events_is_taken_over_by_the_pen() {
    let mut test = TestPen::new();
    test.frame(0, &[]);
    assert_eq!(letters(&test.frame(10, &[button(30.0, 40.0, true)])), "D");
    test.feed(9, ReportKind::Pressed(state(30.0, 0.3)));
    test.feed(14, ReportKind::Moved(state(34.0, 0.35)));
    let output = test.frame(16, &[moved(34.0, 40.0)]);
    assert_eq!(letters(&output), "M");
    let pressures: Vec<f64> =
        samples(&output).iter().map(|sample| sample.sample.pressure).collect();
    assert!(pressures.ends_with(&[0.3, 0.35]), "{pressures:?}");
    assert_eq!(letters(&test.frame(20, &[button(34.0, 40.0, false)])), "");
    test.feed(21, ReportKind::Released);
    assert_eq!(letters(&test.frame(22, &[])), "UH");
}

#[test]
fn a_press_outside_the_surfaces_paints_nothing() {
    let mut test = TestPen::new();
    assert_eq!(letters(&test.frame(0, &[moved(10.0, 700.0), button(10.0, 700.0, true)])), "");
    assert_eq!(letters(&test.frame(16, &[moved(10.0, 40.0)])), "");
    assert_eq!(letters(&test.frame(32, &[button(10.0, 40.0, false)])), "H");
    let covered = PenTargets { surfaces: &test.transforms, covered: &|at| at.x < 50.0 };
    let now = test.start + Duration::from_millis(48);
    let events = [button(10.0, 40.0, true), button(10.0, 40.0, false)];
    let output = test.pen.process_frame(&events, Modifiers::NONE, now, &covered);
    assert_eq!(letters(&output), "L");
}

#[test]
fn shift_draws_a_straight_line_from_the_last_end() {
    let mut test = TestPen::new();
    test.frame(0, &[button(40.0, 40.0, true), moved(80.0, 40.0), button(80.0, 40.0, false)]);
    test.modifiers = Modifiers::SHIFT;
    // Shift draws no straight line from one surface to the other.
    let output = test.frame(100, &[button(900.0, 40.0, true), button(900.0, 40.0, false)]);
    assert_eq!(samples(&output)[0].sample.x_mm, 25.0);
    let output = test.frame(200, &[button(980.0, 100.0, true), moved(984.0, 100.0)]);
    let line = samples(&output);
    let places: Vec<(f64, f64)> =
        line.iter().map(|sample| (sample.sample.x_mm, sample.sample.y_mm)).collect();
    assert_eq!(places, [(25.0, 10.0), (26.6, 11.2), (45.0, 25.0), (46.0, 25.0)]);
    let seconds: Vec<f64> = line.iter().map(|sample| sample.sample.seconds).collect();
    assert_eq!(seconds[..3], [0.0, 0.02, 0.25]);
    assert!(seconds.is_sorted(), "{seconds:?}");
    assert!(line[0].sample.pressure < 0.1 && line[2].sample.pressure == 0.475, "{line:?}");
}

#[test]
fn the_pen_follows_a_transform_that_changes() {
    let mut test = TestPen::new();
    test.feed(0, ReportKind::Moved(state(40.0, 0.0)));
    assert_eq!(letters(&test.frame(1, &[])), "H");
    assert_eq!(letters(&test.frame(2, &[])), "");
    test.transforms[0] =
        SurfaceTransform::new(SurfaceId::Canvas, test.transforms[0].area, |at: Pos2| {
            (100.0 - f64::from(at.x) / 4.0, f64::from(at.y) / 4.0)
        });
    let output = test.frame(3, &[]);
    let [PenEvent::Hover { sample, .. }] = output[..] else { panic!("{output:?}") };
    let sample = SampleDecimals::PEN.round(&sample);
    assert_eq!((sample.x_mm, sample.tilt_x_deg, sample.tilt_y_deg), (90.0, -20.0, -10.0));
    // During a stroke each sample uses the transform of its frame.
    test.feed(4, ReportKind::Pressed(state(40.0, 0.5)));
    assert_eq!(samples(&test.frame(5, &[]))[0].sample.x_mm, 90.0);
    test.transforms = transforms();
    test.feed(6, ReportKind::Moved(state(40.0, 0.5)));
    assert_eq!(samples(&test.frame(7, &[]))[0].sample.x_mm, 10.0);
    test.feed(8, ReportKind::Gone);
    assert_eq!(letters(&test.frame(9, &[])), "UL");
}

#[test]
fn values_out_of_range_are_clamped_or_dropped() {
    let mut test = TestPen::new();
    let odd = PointerState { tilt_deg: Some((400.0, -90.0)), ..state(10.0, 7.0) };
    test.feed(0, ReportKind::Pressed(odd));
    test.feed(5, ReportKind::Moved(PointerState { pressure: Some(f64::NAN), ..odd }));
    test.feed(6, ReportKind::Moved(PointerState { at: pos2(f32::INFINITY, 0.0), ..odd }));
    // This report is earlier than the last one, which no clock should produce.
    test.feed(2, ReportKind::Moved(state(12.0, -1.0)));
    let output = samples(&test.frame(8, &[]));
    assert_eq!(output.len(), 2);
    assert_eq!((output[0].sample.pressure, output[1].sample.pressure), (1.0, 0.0));
    assert!(output.iter().all(|sample| sample.sample.tilt_x_deg.abs() <= 90.0), "{output:?}");
    assert!(output.is_sorted_by_key(|sample| sample.sample.seconds), "{output:?}");
    // This report is older than the sample of the resting pen, but arrives after it.
    assert_eq!(samples(&test.frame(48, &[])).len(), 1);
    test.feed(44, ReportKind::Moved(state(14.0, 0.5)));
    let output = samples(&test.frame(50, &[]));
    assert_eq!((output[0].sample.x_mm, output[0].sample.seconds), (3.5, 0.048));
    // A second press without a release ends the stroke and begins another.
    test.feed(60, ReportKind::Pressed(state(50.0, 0.5)));
    assert_eq!(letters(&test.frame(61, &[])), "UDM");
    assert_eq!(letters(&test.pen.end_stroke(test.at(70))), "U");
    assert_eq!(letters(&test.pen.end_stroke(test.at(70))), "");
}

#[test]
fn a_following_brush_turns_its_broad_side_across_the_path() {
    let mut test = TestPen::new();
    test.frame(0, &[button(40.0, 40.0, true)]);
    let events: Vec<Event> = (1_u8..=60).map(|x| moved(40.0 + 5.0 * f32::from(x), 40.0)).collect();
    let output = samples(&test.frame(200, &events));
    let twists: Vec<f64> = output.iter().map(|sample| sample.sample.twist_deg.abs()).collect();
    assert_eq!(twists.len(), 61, "every sample");
    assert!(twists.iter().all(|twist| (twist - 90.0).abs() < 0.1), "from the start: {twists:?}");
    // Round a corner the brush turns gradually.
    let events: Vec<Event> = (1_u8..=60).map(|y| moved(340.0, 40.0 + 5.0 * f32::from(y))).collect();
    let output = samples(&test.frame(400, &events));
    let twists: Vec<f64> = output.iter().map(|sample| sample.sample.twist_deg.abs()).collect();
    let off: Vec<f64> = twists.iter().map(|twist| (twist - 90.0).abs()).collect();
    assert!(off.is_sorted() && off[0] < 20.0, "{off:?}");
    assert!((off[59] - 90.0).abs() < 0.1, "{off:?}");
}

#[test]
fn the_first_samples_wait_for_the_direction_but_not_long() {
    let mut test = TestPen::new();
    assert_eq!(letters(&test.frame(0, &[button(40.0, 40.0, true)])), "D");
    assert_eq!(letters(&test.frame(20, &[moved(42.0, 40.0)])), "");
    let waits = test.pen.repaint_after(test.at(70));
    assert!(waits.is_some_and(|waits| waits <= Duration::from_millis(10)), "{waits:?}");
    let output = samples(&test.frame(80, &[]));
    assert!(output.len() >= 3 && output[0].arrived == test.start, "{output:?}");
    assert!(
        output.iter().all(|sample: &PenSample| sample.sample.twist_deg.rem_euclid(180.0) == 90.0),
        "{output:?}"
    );
    // A press without a movement keeps the rotation of the grip.
    test.frame(100, &[button(42.0, 40.0, false)]);
    test.pen.settings.grip.twist_deg = 30.0;
    let output = test.frame(200, &[button(90.0, 90.0, true), button(90.0, 90.0, false)]);
    let dab = samples(&output);
    assert_eq!(letters(&output), "DMUH");
    assert!(dab.iter().all(|sample| sample.sample.twist_deg == 30.0), "{dab:?}");
}

#[test]
fn a_straight_line_is_painted_with_the_broad_side_across() {
    let mut test = TestPen::new();
    test.frame(0, &[button(40.0, 40.0, true), moved(80.0, 40.0), button(80.0, 40.0, false)]);
    test.modifiers = Modifiers::SHIFT;
    let line = samples(&test.frame(200, &[button(140.0, 100.0, true)]));
    assert_eq!(line.len(), 3);
    let twists: Vec<f64> =
        line.iter().map(|sample| sample.sample.twist_deg.rem_euclid(180.0)).collect();
    assert!(twists.iter().all(|twist| (twist - 135.0).abs() < 0.1), "{twists:?}");
}

#[test]
fn a_following_brush_does_not_jitter_with_the_whole_points_of_a_mouse() {
    let mut test = TestPen::new();
    test.frame(0, &[button(40.0, 40.0, true)]);
    // A straight way at 20 degrees in whole points, in steps of 1 to 3 points.
    let events: Vec<Event> = (1_u8..=200)
        .map(|step| {
            let way = f32::from(step) * 2.0 + f32::from(step % 3);
            moved((40.0 + 0.94 * way).round(), (40.0 + 0.342 * way).round())
        })
        .collect();
    let output = samples(&test.frame(900, &events));
    let twists: Vec<f64> =
        output.iter().skip(80).map(|sample| sample.sample.twist_deg.rem_euclid(180.0)).collect();
    assert!(twists.iter().all(|twist| (twist - 110.0).abs() < 3.0), "{twists:?}");
    let jitter = twists.windows(2).map(|pair| (pair[1] - pair[0]).abs()).fold(0.0, f64::max);
    assert!(jitter < 0.5, "{jitter}: {twists:?}");
}

#[test]
fn barrel_buttons_are_reported() {
    let mut test = TestPen::new();
    test.feed(0, ReportKind::Barrel { button: 1, pressed: true });
    assert_eq!(test.frame(1, &[]), [PenEvent::Barrel { button: 1, pressed: true }]);
}

#[test]
fn a_tap_beside_a_surface_or_of_a_hand_that_holds_a_pen_is_none() {
    fn tap(x: f32) -> Vec<Event> {
        let both = [TouchPhase::Start, TouchPhase::End].map(|phase| {
            [(1, x), (2, x + 30.0)].map(|(id, x)| {
                let device_id = TouchDeviceId(0);
                Event::Touch { device_id, id: TouchId(id), phase, pos: pos2(x, 99.0), force: None }
            })
        });
        both.concat()
    }
    let mut test = TestPen::new();
    assert_eq!(letters(&test.frame(0, &tap(300.0))), "T");
    assert_eq!(letters(&test.frame(100, &tap(1300.0))), "", "beside the surfaces");
    test.feed(190, ReportKind::Moved(state(300.0, 0.0)));
    assert_eq!(letters(&test.frame(200, &tap(300.0))), "H", "the pen is near");
    assert_eq!(letters(&test.frame(900, &tap(300.0))), "T", "it is gone");
}

fn hold(x_mm: f64, y_mm: f64) -> PointerState {
    let at = pos2(4.0 * x_mm as f32, 4.0 * y_mm as f32);
    PointerState { pressure: Some(0.5), ..PointerState::at(at) }
}

fn wavy() -> Vec<PointerState> {
    (0..60)
        .map(|step: u8| {
            let along = 0.7 * f64::from(step);
            hold(60.0 + along, 50.0 + 0.4 * along + 2.0 * along.sin())
        })
        .collect()
}

/// The samples of each stroke.
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

/// Largest distance of the samples from the line through two places.
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
    // The broad side lies across the ruler (slope 3 to 4) from the first sample on.
    let across = 0.75_f64.atan().to_degrees() + 90.0;
    assert!(
        led.iter().all(|sample| ((sample.twist_deg - across + 90.0).rem_euclid(180.0) - 90.0)
            .abs()
            < 1e-3),
        "{:?}",
        led[0]
    );
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
    fn places(samples: &[Sample]) -> Vec<[f64; 2]> {
        samples.iter().map(|sample| [sample.x_mm, sample.y_mm]).collect::<Vec<_>>()
    }
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

/// A canvas at 4 points a mm.
fn canvas() -> [SurfaceTransform; 1] {
    let area = Rect::from_min_size(Pos2::ZERO, vec2(800.0, 600.0));
    [SurfaceTransform::new(SurfaceId::Canvas, area, |at: Pos2| {
        (f64::from(at.x) / 4.0, f64::from(at.y) / 4.0)
    })]
}

fn settings(method: StabiliserMethod, length: f64, unit: LengthUnit) -> PenSettings {
    let stabiliser = StabiliserSettings { method, length, unit };
    PenSettings { stabiliser, ..PenSettings::default() }
}

fn wave(measures: bool) -> Vec<PointerState> {
    (0..=100)
        .map(|at: u8| {
            let share = f32::from(at) / 100.0;
            let at = pos2(40.0 + 280.0 * share, 200.0 + 10.0 * (40.0 * share).sin());
            let pressure = measures.then_some(0.2 + 0.5 * f64::from(share));
            PointerState { pressure, ..PointerState::at(at) }
        })
        .collect()
}

/// A stroke along these states, with a report every 5 ms and two reports in each frame.
fn stabilised_stroke(pen: &mut Pen, device: Device, states: Vec<PointerState>) -> Vec<PenEvent> {
    let start = Instant::now();
    let mut script = Script::new(device).stroke(states, Duration::from_millis(5));
    let transforms = canvas();
    let targets = PenTargets { surfaces: &transforms, covered: &|_| false };
    let mut events = Vec::new();
    for frame in 0..60 {
        let now = start + Duration::from_millis(10) * frame;
        script.due(start, now).into_iter().for_each(|report| pen.feed(report));
        events.extend(pen.process_frame(&[], Modifiers::NONE, now, &targets));
    }
    events
}

fn moved_samples(events: &[PenEvent]) -> Vec<Sample> {
    let moves = events.iter().filter_map(|event| match event {
        PenEvent::Move(samples) => Some(samples.iter().map(|sample| sample.sample)),
        _ => None,
    });
    moves.flatten().collect()
}

#[test]
fn a_stabilised_stroke_is_steadier_ends_at_the_pen_and_keeps_its_times_in_order() {
    let end = wave(true)[100].at;
    for device in [Device::Pen, Device::Mouse] {
        let mut plain = Pen::new(PenSettings::default());
        let plain = moved_samples(&stabilised_stroke(&mut plain, device, wave(device.is_pen())));
        for method in [StabiliserMethod::Average, StabiliserMethod::String] {
            let mut pen = Pen::new(settings(method, 12.0, LengthUnit::Mm));
            let steady = moved_samples(&stabilised_stroke(&mut pen, device, wave(device.is_pen())));
            fn swing(samples: &[Sample]) -> f64 {
                let ys = samples.iter().filter(|at| (30.0..70.0).contains(&at.x_mm));
                let ys: Vec<f64> = ys.map(|sample| sample.y_mm).collect();
                let most = ys.iter().copied().fold(f64::MIN, f64::max);
                most - ys.iter().copied().fold(f64::MAX, f64::min)
            }
            assert!(
                swing(&steady) < 0.8 * swing(&plain),
                "{device:?} {method:?}: {} of {}",
                swing(&steady),
                swing(&plain)
            );
            let last = steady[steady.len() - 1];
            let at = (f64::from(end.x) / 4.0, f64::from(end.y) / 4.0);
            assert_eq!((last.x_mm, last.y_mm), at, "{device:?} {method:?}");
            assert!(steady.is_sorted_by_key(|sample| sample.seconds), "{device:?} {method:?}");
            assert!(!device.is_pen() || last.pressure > 0.69, "the pen's last pressure: {last:?}");
            assert!(device.is_pen() || last.pressure == 0.0, "lifted: {last:?}");
        }
    }
}

#[test]
fn without_a_stabiliser_the_samples_are_the_reports() {
    let mut pen = Pen::new(PenSettings::default());
    let found = moved_samples(&stabilised_stroke(&mut pen, Device::Pen, wave(true)));
    let places: Vec<(f64, f64)> = found.iter().map(|sample| (sample.x_mm, sample.y_mm)).collect();
    let wanted = wave(true);
    let wanted = wanted.iter().map(|at| (f64::from(at.at.x) / 4.0, f64::from(at.at.y) / 4.0));
    assert_eq!(places, wanted.collect::<Vec<_>>());
    assert_eq!(pen.string_line(), None);
}

#[test]
fn the_eraser_end_has_the_options_of_its_own_brush() {
    let mut pen = Pen::new(PenSettings::default());
    pen.options.range = [0.9, 1.0];
    pen.eraser_options.range = [0.0, 0.5];
    fn most(device: Device, pen: &mut Pen) -> f64 {
        let found = moved_samples(&stabilised_stroke(pen, device, wave(true)));
        found.iter().map(|sample| sample.pressure).fold(0.0, f64::max)
    }
    assert!((most(Device::Pen, &mut pen) - 0.97).abs() < 1e-9, "the brush in hand");
    assert!((most(Device::Eraser, &mut pen) - 0.35).abs() < 1e-9, "that of the eraser");
}

#[test]
fn the_string_is_shown_from_the_brush_to_the_pen_at_its_length() {
    for (length, unit) in [(10.0, LengthUnit::Mm), (40.0, LengthUnit::Px)] {
        let mut pen = Pen::new(settings(StabiliserMethod::String, length, unit));
        let start = Instant::now();
        let transforms = canvas();
        let targets = PenTargets { surfaces: &transforms, covered: &|_| false };
        for (order, x) in [40.0, 60.0, 140.0].into_iter().enumerate() {
            let state = PointerState { pressure: Some(0.5), ..PointerState::at(pos2(x, 80.0)) };
            let kind =
                if order == 0 { ReportKind::Pressed(state) } else { ReportKind::Moved(state) };
            let arrived = start + Duration::from_millis(5 * order as u64);
            pen.feed(Report { device: Device::Pen, arrived, kind });
        }
        let now = start + Duration::from_millis(16);
        pen.process_frame(&[], Modifiers::NONE, now, &targets);
        let [brush, tip] = pen.string_line().unwrap();
        assert!((brush - pos2(100.0, 80.0)).length() < 1e-3, "{unit:?}: {brush:?}");
        assert_eq!(tip, pos2(140.0, 80.0));
    }
}

#[test]
fn the_test_field_draws_what_would_be_painted() {
    let mut pen = Pen::new(PenSettings::default());
    pen.options.range = [0.5, 1.0];
    let mut field = TestField::default();
    let area = Rect::from_min_size(pos2(20.0, 20.0), vec2(400.0, 400.0));
    let start = Instant::now();
    let mut script = Script::new(Device::Pen).stroke(wave(true), Duration::from_millis(5));
    let targets = PenTargets { surfaces: &[], covered: &|_| false };
    for frame in 0..60 {
        let now = start + Duration::from_millis(10) * frame;
        script.due(start, now).into_iter().for_each(|report| pen.feed(report));
        assert!(pen.process_frame(&[], Modifiers::NONE, now, &targets).is_empty());
        field.update(&pen, area, true, now);
    }
    let [stroke] = field.strokes() else { panic!("{field:?}") };
    assert!(!field.is_drawing() && stroke.len() >= 101, "{} points", stroke.len());
    let first = stroke[0];
    let wanted = wave(true)[0].at - area.min.to_vec2();
    assert!((first.at - wanted).length() < 1e-2, "{first:?}");
    // Half of the range and half of the pressure.
    assert!((first.pressure - 0.6).abs() < 1e-12, "{first:?}");
    // A press outside draws nothing.
    let beside = Rect::from_min_size(pos2(600.0, 20.0), vec2(100.0, 100.0));
    let mut script = Script::new(Device::Pen).stroke(wave(true), Duration::from_millis(5));
    script
        .due(start, start + Duration::from_secs(9))
        .into_iter()
        .for_each(|report| pen.feed(report));
    pen.process_frame(&[], Modifiers::NONE, start, &targets);
    field.update(&pen, beside, true, start);
    assert_eq!(field.strokes().len(), 1);
    field.clear();
    assert!(field.strokes().is_empty());
}
