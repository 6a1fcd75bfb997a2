//! Tests of the pen module as a whole, without a window.

use web_time::{Duration, Instant};

use eframe::egui::{
    Event, Modifiers, PointerButton, Pos2, Rect, TouchDeviceId, TouchId, TouchPhase, pos2,
};
use paint::pose::Sample;
use paint::strokes::{SampleDecimals, SurfaceId};

use super::{
    Device, Pen, PenEvent, PenSettings, PenTargets, PointerState, Report, ReportKind, Script,
    SurfaceTransform,
};
use session::PenSample;

/// Canvas and palette at 4 points per mm; the palette begins at x = 800.
fn transforms() -> [SurfaceTransform; 2] {
    let area = |x, width| Rect::from_min_size(pos2(x, 0.0), eframe::egui::vec2(width, 600.0));
    let mm = |at: Pos2| (f64::from(at.x) / 4.0, f64::from(at.y) / 4.0);
    [
        SurfaceTransform::new(SurfaceId::Canvas, area(0.0, 800.0), mm),
        SurfaceTransform::new(SurfaceId::Palette, area(800.0, 200.0), move |at: Pos2| {
            mm(at - eframe::egui::vec2(800.0, 0.0))
        }),
    ]
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

    /// Adds a report of the pen's tip at `ms`.
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
    let letter = |event: &PenEvent| match event {
        PenEvent::Down { .. } => 'D',
        PenEvent::Move(_) => 'M',
        PenEvent::Up => 'U',
        PenEvent::Hover { .. } => 'H',
        PenEvent::Leave => 'L',
        PenEvent::Barrel { .. } => 'B',
        PenEvent::Tap { .. } => 'T',
    };
    output.iter().map(letter).collect()
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
    // The stroke goes on beyond the canvas, over the palette.
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
    // The rest of the mouse events is ignored; later the mouse can paint again.
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
    // A straight line does not lead from one surface to the other.
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
    // A report earlier than the last one, which no clock should produce.
    test.feed(2, ReportKind::Moved(state(12.0, -1.0)));
    let output = samples(&test.frame(8, &[]));
    assert_eq!(output.len(), 2);
    assert_eq!((output[0].sample.pressure, output[1].sample.pressure), (1.0, 0.0));
    assert!(output.iter().all(|sample| sample.sample.tilt_x_deg.abs() <= 90.0), "{output:?}");
    assert!(output.is_sorted_by_key(|sample| sample.sample.seconds), "{output:?}");
    // A report that arrives after the sample of a resting pen, although it is older.
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
    // A press without a way keeps the rotation of the grip.
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
    // Whole points of a straight way of 20 degrees, in steps of 1 to 3 points.
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
    let tap = |x: f32| {
        let touch = |id, phase, x| {
            let device_id = TouchDeviceId(0);
            let id = TouchId(id);
            Event::Touch { device_id, id, phase, pos: pos2(x, 99.0), force: None }
        };
        let both = |phase| [touch(1, phase, x), touch(2, phase, x + 30.0)];
        [both(TouchPhase::Start), both(TouchPhase::End)].concat()
    };
    let mut test = TestPen::new();
    assert_eq!(letters(&test.frame(0, &tap(300.0))), "T");
    assert_eq!(letters(&test.frame(100, &tap(1300.0))), "", "beside the surfaces");
    test.feed(190, ReportKind::Moved(state(300.0, 0.0)));
    assert_eq!(letters(&test.frame(200, &tap(300.0))), "H", "the pen is near");
    assert_eq!(letters(&test.frame(900, &tap(300.0))), "T", "it is gone");
}
