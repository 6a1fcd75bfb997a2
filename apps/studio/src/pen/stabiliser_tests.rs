//! Tests of stabilised strokes, from reports of a device to samples.

use web_time::{Duration, Instant};

use eframe::egui::{Modifiers, Pos2, Rect, pos2, vec2};
use paint::pose::Sample;
use paint::strokes::SurfaceId;
use session::brushes::{LengthUnit, StabiliserMethod, StabiliserSettings};

use super::{
    Device, Pen, PenEvent, PenSettings, PenTargets, PointerState, Report, ReportKind, Script,
    SurfaceTransform, TestField,
};

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

/// States of a pen that draws a wave from x = 10 to 80 mm.
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

/// Events of a stroke along these states, one report each 5 ms, two in each frame.
fn stroke(pen: &mut Pen, device: Device, states: Vec<PointerState>) -> Vec<PenEvent> {
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

fn samples(events: &[PenEvent]) -> Vec<Sample> {
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
        let states = || wave(device.is_pen());
        let mut plain = Pen::new(PenSettings::default());
        let plain = samples(&stroke(&mut plain, device, states()));
        for method in [StabiliserMethod::Average, StabiliserMethod::String] {
            let mut pen = Pen::new(settings(method, 12.0, LengthUnit::Mm));
            let steady = samples(&stroke(&mut pen, device, states()));
            let swing = |samples: &[Sample]| {
                let ys = samples.iter().filter(|at| (30.0..70.0).contains(&at.x_mm));
                let ys: Vec<f64> = ys.map(|sample| sample.y_mm).collect();
                let most = ys.iter().copied().fold(f64::MIN, f64::max);
                most - ys.iter().copied().fold(f64::MAX, f64::min)
            };
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
    let found = samples(&stroke(&mut pen, Device::Pen, wave(true)));
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
    let most = |device, pen: &mut Pen| {
        let found = samples(&stroke(pen, device, wave(true)));
        found.iter().map(|sample| sample.pressure).fold(0.0, f64::max)
    };
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
