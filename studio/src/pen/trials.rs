//! The pen as a whole, tried without a window.

use std::time::{Duration, Instant};

use eframe::egui::{Event, Modifiers, PointerButton, Pos2, Rect, pos2};
use render::paint::strokes::SurfaceId;

use super::{Device, Hold, Pen, PenEvent, PenSettings, Report, Script, Sight, View, What};
use session::PenSample;

/// 4 points a mm; the palette to the right of 800.
fn sights() -> [Sight; 2] {
    let area = |x, width| Rect::from_min_size(pos2(x, 0.0), eframe::egui::vec2(width, 600.0));
    let mm = |at: Pos2| (f64::from(at.x) / 4.0, f64::from(at.y) / 4.0);
    let palette = move |at: Pos2| mm(at - eframe::egui::vec2(800.0, 0.0));
    [
        Sight::new(SurfaceId::Canvas, area(0.0, 800.0), mm),
        Sight::new(SurfaceId::Palette, area(800.0, 200.0), palette),
    ]
}

struct Trial {
    pen: Pen,
    start: Instant,
    sights: [Sight; 2],
    modifiers: Modifiers,
}

impl Trial {
    fn new() -> Self {
        let pen = Pen::new(PenSettings::default());
        Self { pen, start: Instant::now(), sights: sights(), modifiers: Modifiers::NONE }
    }

    fn at(&self, ms: u64) -> Instant {
        self.start + Duration::from_millis(ms)
    }

    fn frame(&mut self, ms: u64, events: &[Event]) -> Vec<PenEvent> {
        let now = self.at(ms);
        let view = View { surfaces: &self.sights, covered: &|_| false };
        self.pen.frame(events, self.modifiers, now, &view)
    }

    /// A report of the tip, at some time.
    fn feed(&mut self, ms: u64, what: What) {
        let arrived = self.at(ms);
        self.pen.feed(Report { device: Device::Pen, arrived, what });
    }
}

fn moved(x: f32, y: f32) -> Event {
    Event::PointerMoved(pos2(x, y))
}

fn button(x: f32, y: f32, pressed: bool) -> Event {
    let (button, modifiers) = (PointerButton::Primary, Modifiers::NONE);
    Event::PointerButton { pos: pos2(x, y), button, pressed, modifiers }
}

fn hold(x: f32, pressure: f64) -> Hold {
    let (tilt_deg, twist_deg) = (Some((20.0, -10.0)), Some(5.0));
    Hold { at: pos2(x, 40.0), pressure: Some(pressure), tilt_deg, twist_deg }
}

fn samples(told: &[PenEvent]) -> Vec<PenSample> {
    let moves = told.iter().filter_map(|event| match event {
        PenEvent::Move(samples) => Some(samples.clone()),
        _ => None,
    });
    moves.flatten().collect()
}

/// D down, M samples, U up, H hover, L leave, B barrel.
fn letters(told: &[PenEvent]) -> String {
    let letter = |event: &PenEvent| match event {
        PenEvent::Down { .. } => 'D',
        PenEvent::Move(_) => 'M',
        PenEvent::Up => 'U',
        PenEvent::Hover { .. } => 'H',
        PenEvent::Leave => 'L',
        PenEvent::Barrel { .. } => 'B',
    };
    told.iter().map(letter).collect()
}

#[test]
fn every_sample_between_two_frames_is_told_in_order_with_its_own_time() {
    let mut trial = Trial::new();
    let holds = (0_u8..200).map(|step| hold(f32::from(step) * 3.0, 0.5 + f64::from(step) / 400.0));
    let mut script = Script::new(Device::Pen).stroke(holds, Duration::from_millis(5));
    let (start, mut all) = (trial.start, Vec::new());
    for frame in 0..70 {
        let now = trial.at(frame * 16);
        script.due(start, now).into_iter().for_each(|report| trial.pen.feed(report));
        all.extend(trial.frame(frame * 16, &[]));
    }
    let samples = samples(&all);
    assert_eq!(samples.len(), 200);
    for (step, told) in (0_u32..).zip(&samples) {
        let wanted = (f64::from(step) * 0.75, f64::from(5 * step) / 1000.0);
        assert_eq!((told.sample.x_mm, told.sample.seconds), wanted, "{step}");
        assert_eq!(told.arrived, start + Duration::from_millis(5) * (step + 1));
        let held = (told.sample.tilt_x_deg, told.sample.tilt_y_deg, told.sample.twist_deg);
        assert_eq!(held, (20.0, -10.0, 5.0));
    }
    assert!(samples.is_sorted_by_key(|told| told.sample.pressure));
    let told = letters(&all);
    assert!(told.starts_with("DM") && told.ends_with("MUH"), "{told}");
    assert_eq!(told.matches('U').count(), 1);
}

#[test]
fn a_mouse_paints_with_the_grip_and_pressure_from_speed() {
    let mut trial = Trial::new();
    assert_eq!(letters(&trial.frame(0, &[moved(100.0, 40.0)])), "H");
    let events = [button(100.0, 40.0, true), moved(104.0, 40.0), moved(110.0, 40.0)];
    let told = trial.frame(16, &events);
    assert_eq!(letters(&told), "DM");
    let first = samples(&told);
    assert_eq!(first.len(), 3);
    let seconds: Vec<f64> = first.iter().map(|told| told.sample.seconds).collect();
    assert_eq!(seconds, [0.0, 0.0053, 0.0107]);
    let pressures: Vec<f64> = first.iter().map(|told| told.sample.pressure).collect();
    assert!(pressures[0] > 0.0 && pressures.is_sorted(), "{pressures:?}");
    assert_eq!((first[2].sample.tilt_x_deg, first[2].sample.tilt_y_deg), (26.34, 26.34));
    // The mouse leads on beyond the canvas, over the palette.
    let told = trial.frame(32, &[moved(900.0, 40.0), button(900.0, 40.0, false)]);
    assert_eq!(letters(&told), "MUH");
    let last = samples(&told);
    assert_eq!((last[0].sample.x_mm, last[0].sample.y_mm), (225.0, 10.0));
    let lifted = last.last().map(|told| told.sample.pressure);
    assert_eq!(lifted, Some(0.0));
    let PenEvent::Hover { surface, .. } = told[2] else { panic!("{told:?}") };
    assert_eq!(surface, SurfaceId::Palette);
}

#[test]
fn a_still_pen_tells_one_still_sample_until_it_moves_again() {
    let mut trial = Trial::new();
    trial.feed(0, What::Pressed(hold(10.0, 0.4)));
    trial.feed(4, What::Moved(hold(20.0, 0.4)));
    assert_eq!(samples(&trial.frame(10, &[])).len(), 2);
    let waits = trial.pen.next_frame(trial.at(10));
    assert_eq!(waits, Some(Duration::from_millis(24)));
    assert_eq!(letters(&trial.frame(30, &[])), "");
    let still = samples(&trial.frame(34, &[]));
    assert_eq!(still.len(), 1);
    let (sample, seconds) = (still[0].sample, still[0].sample.seconds);
    assert_eq!((sample.x_mm, sample.pressure, seconds), (5.0, 0.4, 0.034));
    for ms in [50, 90, 400] {
        assert_eq!(letters(&trial.frame(ms, &[])), "", "{ms}");
    }
    assert_eq!(trial.pen.next_frame(trial.at(400)), None);
    trial.feed(500, What::Moved(hold(20.0, 0.6)));
    assert_eq!(samples(&trial.frame(500, &[])).len(), 1);
    assert_eq!(samples(&trial.frame(540, &[])).len(), 1);
    trial.feed(600, What::Released);
    assert_eq!(letters(&trial.frame(600, &[])), "UH");
}

#[test]
fn a_mouse_held_down_lands_in_its_own_time() {
    let mut trial = Trial::new();
    trial.frame(0, &[moved(40.0, 40.0)]);
    let mut told = trial.frame(10, &[button(40.0, 40.0, true)]);
    for ms in [20, 40, 50, 60, 70, 80, 200, 300] {
        told.extend(trial.frame(ms, &[]));
    }
    let pressures: Vec<f64> = samples(&told).iter().map(|told| told.sample.pressure).collect();
    assert_eq!(pressures.first(), Some(&0.095));
    assert_eq!(pressures.last(), Some(&0.475));
    assert!(pressures.len() >= 3 && pressures.is_sorted(), "{pressures:?}");
    assert_eq!(letters(&trial.frame(310, &[button(40.0, 40.0, false)])), "MUH");
}

#[test]
fn what_the_system_tells_of_a_pen_as_a_mouse_paints_only_once() {
    let mut trial = Trial::new();
    trial.feed(0, What::Moved(hold(30.0, 0.0)));
    trial.feed(6, What::Pressed(hold(32.0, 0.3)));
    let as_mouse = [moved(30.0, 40.0), button(32.0, 40.0, true), moved(36.0, 40.0)];
    let told = trial.frame(10, &as_mouse);
    assert_eq!(letters(&told), "DM");
    assert_eq!(samples(&told).len(), 1);
    trial.feed(20, What::Moved(hold(40.0, 0.5)));
    trial.feed(24, What::Released);
    let told = trial.frame(26, &[moved(40.0, 40.0), button(40.0, 40.0, false)]);
    assert_eq!((letters(&told).as_str(), samples(&told).len()), ("MUH", 1));
    // The mouse's tail is ignored, and a while later the mouse is free again.
    assert_eq!(letters(&trial.frame(200, &[button(9.0, 9.0, true)])), "");
    assert_eq!(letters(&trial.frame(220, &[button(9.0, 9.0, false)])), "");
    assert_eq!(letters(&trial.frame(600, &[button(9.0, 9.0, true)])), "DM");
}

#[test]
fn a_press_told_as_a_mouse_first_goes_over_to_the_pen() {
    let mut trial = Trial::new();
    trial.frame(0, &[]);
    assert_eq!(letters(&trial.frame(10, &[button(30.0, 40.0, true)])), "DM");
    trial.feed(9, What::Pressed(hold(30.0, 0.3)));
    trial.feed(14, What::Moved(hold(34.0, 0.35)));
    let told = trial.frame(16, &[moved(34.0, 40.0)]);
    assert_eq!(letters(&told), "M");
    let pressures: Vec<f64> = samples(&told).iter().map(|told| told.sample.pressure).collect();
    assert!(pressures.ends_with(&[0.3, 0.35]), "{pressures:?}");
    assert_eq!(letters(&trial.frame(20, &[button(34.0, 40.0, false)])), "");
    trial.feed(21, What::Released);
    assert_eq!(letters(&trial.frame(22, &[])), "UH");
}

#[test]
fn what_begins_elsewhere_paints_nothing() {
    let mut trial = Trial::new();
    assert_eq!(letters(&trial.frame(0, &[moved(10.0, 700.0), button(10.0, 700.0, true)])), "");
    assert_eq!(letters(&trial.frame(16, &[moved(10.0, 40.0)])), "");
    assert_eq!(letters(&trial.frame(32, &[button(10.0, 40.0, false)])), "H");
    let covered = View { surfaces: &trial.sights, covered: &|at| at.x < 50.0 };
    let now = trial.start + Duration::from_millis(48);
    let events = [button(10.0, 40.0, true), button(10.0, 40.0, false)];
    let told = trial.pen.frame(&events, Modifiers::NONE, now, &covered);
    assert_eq!(letters(&told), "L");
}

#[test]
fn shift_draws_a_straight_line_from_the_last_end() {
    let mut trial = Trial::new();
    trial.frame(0, &[button(40.0, 40.0, true), moved(80.0, 40.0), button(80.0, 40.0, false)]);
    trial.modifiers = Modifiers::SHIFT;
    // Not from one surface to the other.
    let told = trial.frame(100, &[button(900.0, 40.0, true), button(900.0, 40.0, false)]);
    assert_eq!(samples(&told)[0].sample.x_mm, 25.0);
    let told = trial.frame(200, &[button(980.0, 100.0, true), moved(984.0, 100.0)]);
    let line = samples(&told);
    let places: Vec<(f64, f64)> =
        line.iter().map(|told| (told.sample.x_mm, told.sample.y_mm)).collect();
    assert_eq!(places, [(25.0, 10.0), (26.6, 11.2), (45.0, 25.0), (46.0, 25.0)]);
    let seconds: Vec<f64> = line.iter().map(|told| told.sample.seconds).collect();
    assert_eq!(seconds[..3], [0.0, 0.02, 0.25]);
    assert!(seconds.is_sorted(), "{seconds:?}");
    assert!(line[0].sample.pressure < 0.1 && line[2].sample.pressure == 0.475, "{line:?}");
}

#[test]
fn a_view_that_moves_takes_the_pen_along() {
    let mut trial = Trial::new();
    trial.feed(0, What::Moved(hold(40.0, 0.0)));
    assert_eq!(letters(&trial.frame(1, &[])), "H");
    assert_eq!(letters(&trial.frame(2, &[])), "");
    let mirrored = |at: Pos2| (100.0 - f64::from(at.x) / 4.0, f64::from(at.y) / 4.0);
    trial.sights[0] = Sight::new(SurfaceId::Canvas, trial.sights[0].area, mirrored);
    let told = trial.frame(3, &[]);
    let [PenEvent::Hover { sample, .. }] = told[..] else { panic!("{told:?}") };
    assert_eq!((sample.x_mm, sample.tilt_x_deg, sample.tilt_y_deg), (90.0, -20.0, -10.0));
    // Within a stroke too: each sample by the view of its frame.
    trial.feed(4, What::Pressed(hold(40.0, 0.5)));
    assert_eq!(samples(&trial.frame(5, &[]))[0].sample.x_mm, 90.0);
    trial.sights = sights();
    trial.feed(6, What::Moved(hold(40.0, 0.5)));
    assert_eq!(samples(&trial.frame(7, &[]))[0].sample.x_mm, 10.0);
    trial.feed(8, What::Gone);
    assert_eq!(letters(&trial.frame(9, &[])), "UL");
}

#[test]
fn nothing_out_of_range_comes_through() {
    let mut trial = Trial::new();
    let odd = Hold { tilt_deg: Some((400.0, -90.0)), ..hold(10.0, 7.0) };
    trial.feed(0, What::Pressed(odd));
    trial.feed(5, What::Moved(Hold { pressure: Some(f64::NAN), ..odd }));
    trial.feed(6, What::Moved(Hold { at: pos2(f32::INFINITY, 0.0), ..odd }));
    // Earlier than the last, as no clock should tell.
    trial.feed(2, What::Moved(hold(12.0, -1.0)));
    let told = samples(&trial.frame(8, &[]));
    assert_eq!(told.len(), 2);
    assert_eq!((told[0].sample.pressure, told[1].sample.pressure), (1.0, 0.0));
    assert!(told.iter().all(|told| told.sample.tilt_x_deg.abs() <= 90.0), "{told:?}");
    assert!(told.is_sorted_by_key(|told| told.sample.seconds), "{told:?}");
    // A report that was late: the still sample had gone before it.
    assert_eq!(samples(&trial.frame(48, &[])).len(), 1);
    trial.feed(44, What::Moved(hold(14.0, 0.5)));
    let told = samples(&trial.frame(50, &[]));
    assert_eq!((told[0].sample.x_mm, told[0].sample.seconds), (3.5, 0.048));
    // A release that was lost.
    trial.feed(60, What::Pressed(hold(50.0, 0.5)));
    assert_eq!(letters(&trial.frame(61, &[])), "UDM");
    assert_eq!(letters(&trial.pen.let_go(trial.at(70))), "U");
    assert_eq!(letters(&trial.pen.let_go(trial.at(70))), "");
}

#[test]
fn a_brush_that_follows_turns_its_broad_side_across_the_way() {
    let mut trial = Trial::new();
    trial.pen.settings.follow = true;
    trial.frame(0, &[button(40.0, 40.0, true)]);
    let events: Vec<Event> = (1_u8..=60).map(|x| moved(40.0 + 5.0 * f32::from(x), 40.0)).collect();
    let told = samples(&trial.frame(200, &events));
    let twists: Vec<f64> = told.iter().map(|told| told.sample.twist_deg.abs()).collect();
    assert!(twists.is_sorted() && twists[0] < 20.0, "{twists:?}");
    assert!((twists[59] - 90.0).abs() < 0.1, "{twists:?}");
}

#[test]
fn buttons_of_the_barrel_are_told() {
    let mut trial = Trial::new();
    trial.feed(0, What::Barrel { button: 1, pressed: true });
    assert_eq!(trial.frame(1, &[]), [PenEvent::Barrel { button: 1, pressed: true }]);
}
