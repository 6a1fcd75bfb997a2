//! Reports of mice and fingers, made from egui's events, and taps of several fingers at once.

use eframe::egui::{Event, PointerButton, Pos2, TouchId, TouchPhase};
use web_time::{Duration, Instant};

use super::report::{Device, PointerState, Report, ReportKind, Stamp, Stamps, filled};

/// A finger paints after moving this far, in points. Until then a second finger can turn the touch
/// into a gesture.
const DECIDED_POINTS: f32 = 6.0;
/// A finger paints after this time, even if it has not moved that far.
const DECIDED: Duration = Duration::from_millis(70);

/// We spread the events between two frames over this time at most. It is the duration of a slow
/// frame.
const FRAME: Duration = Duration::from_millis(34);

#[derive(Debug, Default)]
pub(super) struct Pointer {
    last_frame: Option<Instant>,
    stamps: Stamps,
    /// Fingers that are down, in order of contact. Only the first can paint.
    fingers: Vec<TouchId>,
    finger: Finger,
    taps: Taps,
    tapped: Option<Tap>,
}

/// State of the finger that can paint.
#[derive(Debug, Default)]
enum Finger {
    #[default]
    Up,
    /// The touch may still become a gesture. We keep its reports, so that the start of a stroke is
    /// not lost.
    Undecided {
        from: Pos2,
        since: Option<Instant>,
        kept: Vec<Report>,
    },
    Paints,
    /// The fingers zoom or pan until you lift all of them.
    Gesture,
}

impl Pointer {
    /// Adds times of mouse events that the window system reported.
    pub(super) fn stamp(&mut self, stamps: impl IntoIterator<Item = Stamp>) {
        self.stamps.extend(stamps);
    }

    /// Reports since the last frame, in order. Events of egui carry no times. If the window system
    /// reported the time of an event, we use it. We spread the others evenly between these times,
    /// from the last frame to `now`.
    pub(super) fn reports(&mut self, events: &[Event], now: Instant) -> Vec<Report> {
        let mut reports = Vec::new();
        self.tapped = None;
        for (at, event) in events.iter().enumerate() {
            self.tapped = self.taps.read(event, now).or(self.tapped);
            if !is_of_touch(event, events.get(at + 1)) {
                self.read_event(event, now, &mut reports);
            }
        }
        let from = self.last_frame.unwrap_or(now);
        let from = from.max(now.checked_sub(FRAME).unwrap_or(now)).min(now);
        let known: Vec<Option<Instant>> = reports
            .iter()
            .map(|report| match report.kind {
                ReportKind::Moved(state) | ReportKind::Pressed(state)
                    if report.device == Device::Mouse =>
                {
                    self.stamps.take(state.at, now)
                }
                _ => None,
            })
            .collect();
        for (report, time) in reports.iter_mut().zip(filled(&known, from, now)) {
            report.arrived = time;
        }
        self.last_frame = Some(now);
        self.decide(reports, now)
    }

    /// The tap of several fingers that ended in the last frame; `None` if one of them painted
    /// before.
    pub(super) fn tapped(&self) -> Option<Tap> {
        self.tapped
    }

    /// Whether we still wait to see if the finger paints or makes a gesture.
    pub(super) fn undecided(&self) -> bool {
        matches!(self.finger, Finger::Undecided { .. })
    }

    fn read_event(&mut self, event: &Event, now: Instant, reports: &mut Vec<Report>) {
        let mut report = |device, kind| reports.push(Report { device, arrived: now, kind });
        match *event {
            Event::Touch { id, phase, pos, force, .. } => {
                let state =
                    PointerState { pressure: force.map(f64::from), ..PointerState::at(pos) };
                let first = self.fingers.first() == Some(&id);
                match phase {
                    TouchPhase::Start => {
                        self.fingers.push(id);
                        if self.fingers.len() == 1 {
                            report(Device::Touch, ReportKind::Pressed(state));
                        } else {
                            // With more than one finger, `decide` makes this a gesture.
                            report(Device::Touch, ReportKind::Gone);
                        }
                    }
                    TouchPhase::Move if first => report(Device::Touch, ReportKind::Moved(state)),
                    TouchPhase::Move => {}
                    TouchPhase::End | TouchPhase::Cancel => {
                        self.fingers.retain(|&finger| finger != id);
                        if first || self.fingers.is_empty() {
                            report(Device::Touch, ReportKind::Released);
                        }
                    }
                }
            }
            // While a finger is down, egui sends pointer events for it too. We ignore them.
            _ if !self.fingers.is_empty() => {}
            Event::PointerMoved(at) => {
                report(Device::Mouse, ReportKind::Moved(PointerState::at(at)));
            }
            Event::PointerButton { pos, button: PointerButton::Primary, pressed, .. } => {
                let kind = if pressed {
                    ReportKind::Pressed(PointerState::at(pos))
                } else {
                    ReportKind::Released
                };
                report(Device::Mouse, kind);
            }
            Event::PointerGone => report(Device::Mouse, ReportKind::Gone),
            Event::WindowFocused(false) => report(Device::Mouse, ReportKind::Released),
            _ => {}
        }
    }

    /// Holds the reports of a finger back until we know that it paints, and drops the reports of a
    /// gesture. Reports of the mouse pass unchanged.
    fn decide(&mut self, reports: Vec<Report>, now: Instant) -> Vec<Report> {
        let mut out = Vec::new();
        for report in reports {
            if report.device != Device::Touch {
                out.push(report);
                continue;
            }
            match (&mut self.finger, report.kind) {
                (Finger::Up, ReportKind::Pressed(state)) => {
                    let from = state.at;
                    let since = Some(report.arrived);
                    self.finger = Finger::Undecided { from, since, kept: vec![report] };
                }
                (Finger::Undecided { from, kept, .. }, ReportKind::Moved(state)) => {
                    kept.push(report);
                    if state.at.distance(*from) > DECIDED_POINTS {
                        out.append(kept);
                        self.finger = Finger::Paints;
                    }
                }
                (Finger::Undecided { kept, .. }, ReportKind::Released) => {
                    kept.push(report);
                    out.append(kept);
                    self.finger = Finger::Up;
                }
                (Finger::Paints, ReportKind::Gone) => {
                    out.push(Report { kind: ReportKind::Released, ..report });
                    self.finger = Finger::Gesture;
                    self.taps.paints();
                    self.tapped = None;
                }
                (_, ReportKind::Gone) => self.finger = Finger::Gesture,
                (Finger::Paints, ReportKind::Released) => {
                    out.push(report);
                    self.finger = Finger::Up;
                }
                (Finger::Gesture, ReportKind::Released) if self.fingers.is_empty() => {
                    self.finger = Finger::Up;
                }
                (Finger::Paints, _) => out.push(report),
                _ => {}
            }
        }
        if let Finger::Undecided { since: Some(since), kept, .. } = &mut self.finger
            && now.saturating_duration_since(*since) >= DECIDED
        {
            out.append(kept);
            self.finger = Finger::Paints;
        }
        out
    }
}

/// Whether egui made this press from the touch event that follows. In a page the press comes before
/// the touch, so without this check the finger would begin a stroke as a mouse.
fn is_of_touch(event: &Event, next: Option<&Event>) -> bool {
    match (event, next) {
        (
            Event::PointerButton { pos, pressed: true, .. },
            Some(Event::Touch { phase: TouchPhase::Start, pos: touched, .. }),
        ) => pos == touched,
        _ => false,
    }
}

/// All fingers of a tap must come down within this time.
const DOWN: Duration = Duration::from_millis(250);

/// You must lift all of them within this time from the first contact.
const UP: Duration = Duration::from_millis(450);

/// A finger of a tap can move this far, in points.
const STILL: f32 = 10.0;

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Tap {
    /// Number of fingers, 2 or more.
    pub(super) fingers: usize,
    pub(super) at: Pos2,
}

/// The fingers since the first one came down.
#[derive(Debug, Default)]
pub(super) struct Taps {
    since: Option<Instant>,
    /// All fingers that came down, with their first places.
    fingers: Vec<(TouchId, Pos2)>,
    down: usize,
    /// Whether this cannot be a tap any more.
    spoiled: bool,
}

impl Taps {
    /// Reads an event of the frame at `now`. Returns the tap if one ends here.
    pub(super) fn read(&mut self, event: &Event, now: Instant) -> Option<Tap> {
        let Event::Touch { id, phase, pos, .. } = *event else { return None };
        let since = match (phase, self.since) {
            (TouchPhase::Start, None) => *self.since.insert(now),
            (_, since) => since?,
        };
        let age = now.saturating_duration_since(since);
        let first = self.fingers.iter().rfind(|(finger, _)| *finger == id).map(|(_, at)| *at);
        self.spoiled |= match phase {
            TouchPhase::Start => age > DOWN,
            TouchPhase::Move => first.is_some_and(|first| first.distance(pos) > STILL),
            TouchPhase::End => age > UP || first.is_some_and(|first| first.distance(pos) > STILL),
            TouchPhase::Cancel => true,
        };
        match phase {
            TouchPhase::Start => {
                self.fingers.push((id, pos));
                self.down += 1;
                None
            }
            TouchPhase::Move => None,
            TouchPhase::End | TouchPhase::Cancel => {
                self.down = self.down.saturating_sub(1);
                if self.down > 0 {
                    return None;
                }
                let Self { fingers, spoiled, .. } = std::mem::take(self);
                let (_, at) = *fingers.first()?;
                (!spoiled && fingers.len() > 1).then_some(Tap { fingers: fingers.len(), at })
            }
        }
    }

    /// Notes that a finger paints. Until you lift all fingers, this is not a tap.
    pub(super) fn paints(&mut self) {
        self.spoiled |= self.since.is_some();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use TouchPhase::{Cancel, End, Move, Start};
    use eframe::egui::{Modifiers, TouchDeviceId, pos2};

    const MS: Duration = Duration::from_millis(1);

    fn touch(id: u64, phase: TouchPhase, x: f32) -> Event {
        let device_id = TouchDeviceId(0);
        let id = TouchId(id);
        Event::Touch { device_id, id, phase, pos: pos2(x, 0.0), force: Some(0.5) }
    }

    fn button(pressed: bool) -> Event {
        let pos = pos2(1.0, 0.0);
        let button = PointerButton::Primary;
        let modifiers = Modifiers::NONE;
        Event::PointerButton { pos, button, pressed, modifiers }
    }

    /// The reports as letters: upper case for touch, lower case for the mouse.
    fn letters(reports: &[Report]) -> String {
        reports
            .iter()
            .map(|report| match (report.device, report.kind) {
                (Device::Touch, ReportKind::Pressed(_)) => 'P',
                (Device::Touch, ReportKind::Moved(_)) => 'M',
                (Device::Touch, ReportKind::Released) => 'R',
                (_, ReportKind::Pressed(_)) => 'p',
                (_, ReportKind::Moved(_)) => 'm',
                (_, ReportKind::Released) => 'r',
                (_, ReportKind::Gone) => 'g',
                (_, ReportKind::Barrel { .. }) => 'b',
            })
            .collect()
    }

    #[test]
    fn every_event_is_reported_and_times_are_spread_evenly() {
        let start = Instant::now();
        let mut pointer = Pointer::default();
        assert!(pointer.reports(&[], start).is_empty());
        let mut events: Vec<Event> =
            (0_u8..9).map(|x| Event::PointerMoved(pos2(f32::from(x), 0.0))).collect();
        events.insert(4, button(true));
        let reports = pointer.reports(&events, start + 20 * MS);
        assert_eq!(letters(&reports), "mmmmpmmmmm");
        let times: Vec<Instant> = reports.iter().map(|report| report.arrived).collect();
        assert_eq!(times, (1..=10_u32).map(|step| start + 2 * step * MS).collect::<Vec<_>>());
        // A long pause does not count as part of the next movement.
        let reports = pointer.reports(&[button(false), Event::PointerGone], start + 5_000 * MS);
        assert_eq!(letters(&reports), "rg");
        let times = [reports[0].arrived, reports[1].arrived];
        assert_eq!(times, [start + 4_983 * MS, start + 5_000 * MS]);
    }

    #[test]
    fn events_that_the_system_timed_have_its_times() {
        let start = Instant::now();
        let mut pointer = Pointer::default();
        pointer.reports(&[], start);
        let stamps = [(2.0, 3_u32), (7.0, 5), (8.0, 15)];
        pointer.stamp(stamps.map(|(x, ms)| (pos2(x, 0.0), start + ms * MS)));
        let events: Vec<Event> =
            [2.0, 7.0, 8.0, 9.0].map(|x| Event::PointerMoved(pos2(x, 0.0))).to_vec();
        let reports = pointer.reports(&events, start + 20 * MS);
        let times: Vec<Instant> = reports.iter().map(|report| report.arrived).collect();
        assert_eq!(times, [3_u32, 5, 15, 20].map(|ms| start + ms * MS));
    }

    #[test]
    fn a_finger_paints_once_no_second_one_can_follow_and_no_report_is_lost() {
        let start = Instant::now();
        let mut pointer = Pointer::default();
        let mut frame = |ms, events: &[Event]| {
            letters(&pointer.reports(events, start + Duration::from_millis(ms)))
        };
        // egui adds these pointer events for a finger.
        let down = [touch(1, Start, 0.0), button(true)];
        assert_eq!(frame(0, &down), "");
        let moved = [touch(1, Move, 4.0), Event::PointerMoved(pos2(4.0, 0.0))];
        assert_eq!(frame(16, &moved), "");
        assert_eq!(frame(32, &[touch(1, Move, 9.0)]), "PMM");
        assert_eq!(frame(48, &[touch(1, Move, 30.0)]), "M");
        assert_eq!(frame(64, &[touch(1, End, 30.0), button(false)]), "Rr");
        // This finger rests in place.
        assert_eq!(frame(100, &down), "");
        assert_eq!(frame(160, &[]), "");
        assert_eq!(frame(180, &[]), "P");
        assert_eq!(frame(190, &[touch(1, End, 0.0)]), "R");
        // A tap is a short press at one place.
        assert_eq!(frame(300, &down), "");
        assert_eq!(frame(310, &[touch(1, End, 0.0)]), "PR");
    }

    #[test]
    fn a_finger_in_a_page_is_no_mouse() {
        let start = Instant::now();
        let mut pointer = Pointer::default();
        let press = [button(true), touch(1, Start, 1.0)];
        assert_eq!(letters(&pointer.reports(&press, start)), "");
        let moved = [Event::PointerMoved(pos2(20.0, 0.0)), touch(1, Move, 20.0)];
        assert_eq!(letters(&pointer.reports(&moved, start + 10 * MS)), "PM");
        let lifted = [button(false), Event::PointerGone, touch(1, End, 20.0)];
        assert_eq!(letters(&pointer.reports(&lifted, start + 20 * MS)), "R");
        // A mouse elsewhere stays a mouse.
        let both = [button(true), touch(2, Start, 50.0)];
        assert_eq!(letters(&pointer.reports(&both, start + 30 * MS)), "p");
    }

    #[test]
    fn two_fingers_paint_nothing_and_end_a_stroke() {
        let start = Instant::now();
        let mut pointer = Pointer::default();
        let mut frame = |ms, events: &[Event]| {
            letters(&pointer.reports(events, start + Duration::from_millis(ms)))
        };
        let first = touch(1, Start, 0.0);
        let pinch = [first.clone(), touch(2, Start, 50.0)];
        assert_eq!(frame(0, &pinch), "");
        assert_eq!(frame(200, &[touch(1, Move, 90.0)]), "");
        assert_eq!(frame(210, &[touch(1, End, 90.0)]), "");
        assert_eq!(frame(220, &[touch(2, Move, 90.0)]), "");
        assert_eq!(frame(230, &[touch(2, End, 90.0)]), "");
        assert_eq!(frame(300, &[first, touch(1, Move, 20.0)]), "PM");
        assert_eq!(frame(310, &[touch(2, Start, 50.0)]), "R");
        assert_eq!(frame(320, &[touch(1, Move, 60.0)]), "");
    }

    #[test]
    fn a_tap_of_two_fingers_is_told_unless_one_of_them_painted() {
        let start = Instant::now();
        let mut pointer = Pointer::default();
        let mut frame = |ms, events: &[Event]| {
            let reports = pointer.reports(events, start + Duration::from_millis(ms));
            (letters(&reports), pointer.tapped().map(|tap| (tap.fingers, tap.at.x)))
        };
        let none = |letters: &str| (letters.to_owned(), None);
        let [first, second] = [(1, 7.0), (2, 50.0)].map(|(id, x)| touch(id, Start, x));
        let [end, last] = [(1, 7.0), (2, 50.0)].map(|(id, x)| touch(id, End, x));
        assert_eq!(frame(0, std::slice::from_ref(&first)), none(""));
        assert_eq!(frame(50, std::slice::from_ref(&second)), none(""));
        assert_eq!(frame(90, std::slice::from_ref(&last)), none(""));
        assert_eq!(frame(100, std::slice::from_ref(&end)), (String::new(), Some((2, 7.0))));
        assert_eq!(frame(116, &[]), none(""), "it is reported once");
        // The first finger rests and paints before the second one comes.
        assert_eq!(frame(1000, std::slice::from_ref(&first)), none(""));
        assert_eq!(frame(1080, &[]), none("P"));
        assert_eq!(frame(1100, std::slice::from_ref(&second)), none("R"));
        assert_eq!(frame(1150, &[end.clone(), last.clone()]), none(""));
        // All of this happens in one slow frame, once with a stroke before the second finger.
        let whole = [first.clone(), second.clone(), end.clone(), last.clone()];
        assert_eq!(frame(2000, &whole), (String::new(), Some((2, 7.0))));
        let stroke = touch(1, Move, 16.0);
        assert_eq!(frame(3000, &[first, stroke, second, end, last]), none("PMR"));
    }

    /// Fingers with the time of an event in ms, its place, and its phase.
    type Script<'a> = &'a [(u64, u64, f32, TouchPhase)];

    /// Number of fingers of the taps in a script.
    fn taps(script: Script<'_>) -> Vec<usize> {
        let mut taps = Taps::default();
        let start = Instant::now();
        let found = script.iter().filter_map(|&(id, ms, x, phase)| {
            let device_id = TouchDeviceId(0);
            let id = TouchId(id);
            let pos = pos2(x, 0.0);
            let event = Event::Touch { device_id, id, phase, pos, force: None };
            taps.read(&event, start + Duration::from_millis(ms)).map(|tap| tap.fingers)
        });
        found.collect()
    }

    #[test]
    fn fingers_that_touch_together_and_rest_are_a_tap() {
        let two = [(1, 0, 0.0, Start), (2, 60, 50.0, Start), (1, 90, 4.0, Move)];
        let two: Vec<_> =
            two.into_iter().chain([(1, 150, 4.0, End), (2, 200, 55.0, End)]).collect();
        assert_eq!(taps(&two), [2]);
        let three = [(1, 0, 0.0, Start), (2, 60, 50.0, Start), (3, 80, 90.0, Start)];
        let ends = [(3, 200, 90.0, End), (2, 210, 50.0, End), (1, 220, 0.0, End)];
        let three: Vec<_> = three.into_iter().chain(ends).collect();
        assert_eq!(taps(&three), [3]);
        let later = three.iter().map(|&(id, ms, x, phase)| (id, ms + 9000, x, phase));
        assert_eq!(taps(&two.iter().copied().chain(later).collect::<Vec<_>>()), [2, 3]);
    }

    #[test]
    fn one_finger_a_late_a_long_a_moved_and_a_cancelled_one_are_none() {
        let two = |late: u64, moved: f32, end: u64, phase| {
            let down = [(1, 0, 0.0, Start), (2, late, 50.0, Start), (2, late, 50.0 + moved, Move)];
            let up = [(1, end, 0.0, End), (2, end, 50.0, phase)];
            taps(&down.into_iter().chain(up).collect::<Vec<_>>())
        };
        assert_eq!(two(250, 10.0, 450, End), [2], "as late as it may be");
        assert_eq!(two(251, 0.0, 300, End), [0_usize; 0], "the second finger is late");
        assert_eq!(two(10, 10.5, 100, End), [0_usize; 0], "one moved");
        assert_eq!(two(10, 0.0, 451, End), [0_usize; 0], "they rested too long");
        assert_eq!(two(10, 0.0, 100, Cancel), [0_usize; 0], "the system took it");
        assert_eq!(taps(&[(1, 0, 0.0, Start), (1, 90, 0.0, End)]), [0_usize; 0], "a single one");
        assert_eq!(taps(&[(1, 0, 0.0, End)]), [0_usize; 0], "one that never came down");
    }
}
