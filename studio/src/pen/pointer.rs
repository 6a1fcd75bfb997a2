//! Mice and fingers, from what egui tells.

use std::time::{Duration, Instant};

use eframe::egui::{Event, PointerButton, Pos2, TouchId, TouchPhase};

use super::report::{Device, Hold, Report, What};

/// A finger paints once it has moved this far, in points, or been down this
/// long: until then a second finger may make it a gesture.
const DECIDED_POINTS: f32 = 6.0;
const DECIDED: Duration = Duration::from_millis(70);

/// What happened between two frames is thought to have happened within this.
const FRAME: Duration = Duration::from_millis(34);

/// Mice and fingers.
#[derive(Debug, Default)]
pub(super) struct Pointer {
    last_frame: Option<Instant>,
    /// Fingers that are down; the first may paint.
    fingers: Vec<TouchId>,
    finger: Finger,
}

/// What the first finger does.
#[derive(Debug, Default)]
enum Finger {
    /// It is not there.
    #[default]
    Up,
    /// Too soon to tell. What it did is kept: nothing of a stroke is lost.
    Undecided { from: Pos2, since: Option<Instant>, kept: Vec<Report> },
    /// It paints.
    Paints,
    /// It zooms or pans with others, until all are lifted.
    Gesture,
}

impl Pointer {
    /// What happened since the last frame, in order. egui tells no times: they
    /// are spread evenly between the last frame and `now`.
    pub(super) fn reports(&mut self, events: &[Event], now: Instant) -> Vec<Report> {
        let mut told = Vec::new();
        for event in events {
            self.hear(event, now, &mut told);
        }
        let from = self.last_frame.unwrap_or(now);
        let from = from.max(now.checked_sub(FRAME).unwrap_or(now)).min(now);
        let count = u32::try_from(told.len()).unwrap_or(u32::MAX).max(1);
        for (order, report) in (1..=count).zip(&mut told) {
            report.arrived = from + (now - from).mul_f64(f64::from(order) / f64::from(count));
        }
        self.last_frame = Some(now);
        self.decide(told, now)
    }

    /// Whether a finger waits to be told from a gesture.
    pub(super) fn undecided(&self) -> bool {
        matches!(self.finger, Finger::Undecided { .. })
    }

    fn hear(&mut self, event: &Event, now: Instant, told: &mut Vec<Report>) {
        let mut tell = |device, what| told.push(Report { device, arrived: now, what });
        match *event {
            Event::Touch { id, phase, pos, force, .. } => {
                let hold = Hold { pressure: force.map(f64::from), ..Hold::at(pos) };
                let first = self.fingers.first() == Some(&id);
                match phase {
                    TouchPhase::Start => {
                        self.fingers.push(id);
                        if self.fingers.len() == 1 {
                            tell(Device::Touch, What::Pressed(hold));
                        } else {
                            // More than one: `decide` takes it for a gesture.
                            tell(Device::Touch, What::Gone);
                        }
                    }
                    TouchPhase::Move if first => tell(Device::Touch, What::Moved(hold)),
                    TouchPhase::Move => {}
                    TouchPhase::End | TouchPhase::Cancel => {
                        self.fingers.retain(|&finger| finger != id);
                        if first || self.fingers.is_empty() {
                            tell(Device::Touch, What::Released);
                        }
                    }
                }
            }
            // A finger moves the pointer too.
            _ if !self.fingers.is_empty() => {}
            Event::PointerMoved(at) => tell(Device::Mouse, What::Moved(Hold::at(at))),
            Event::PointerButton { pos, button: PointerButton::Primary, pressed, .. } => {
                let what = if pressed { What::Pressed(Hold::at(pos)) } else { What::Released };
                tell(Device::Mouse, what);
            }
            Event::PointerGone => tell(Device::Mouse, What::Gone),
            Event::WindowFocused(false) => tell(Device::Mouse, What::Released),
            _ => {}
        }
    }

    /// Holds back what a finger did until it is known to paint.
    fn decide(&mut self, told: Vec<Report>, now: Instant) -> Vec<Report> {
        let mut out = Vec::new();
        for report in told {
            if report.device != Device::Touch {
                out.push(report);
                continue;
            }
            match (&mut self.finger, report.what) {
                (Finger::Up, What::Pressed(hold)) => {
                    let (from, since) = (hold.at, Some(report.arrived));
                    self.finger = Finger::Undecided { from, since, kept: vec![report] };
                }
                (Finger::Undecided { from, kept, .. }, What::Moved(hold)) => {
                    kept.push(report);
                    if hold.at.distance(*from) > DECIDED_POINTS {
                        out.append(kept);
                        self.finger = Finger::Paints;
                    }
                }
                (Finger::Undecided { kept, .. }, What::Released) => {
                    kept.push(report);
                    out.append(kept);
                    self.finger = Finger::Up;
                }
                (Finger::Paints, What::Gone) => {
                    out.push(Report { what: What::Released, ..report });
                    self.finger = Finger::Gesture;
                }
                (_, What::Gone) => self.finger = Finger::Gesture,
                (Finger::Paints, What::Released) => {
                    out.push(report);
                    self.finger = Finger::Up;
                }
                (Finger::Gesture, What::Released) if self.fingers.is_empty() => {
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

#[cfg(test)]
mod tests {
    use eframe::egui::{Modifiers, TouchDeviceId, pos2};

    use super::*;

    fn touch(id: u64, phase: TouchPhase, x: f32) -> Event {
        let (device_id, id) = (TouchDeviceId(0), TouchId(id));
        Event::Touch { device_id, id, phase, pos: pos2(x, 0.0), force: Some(0.5) }
    }

    fn button(pressed: bool) -> Event {
        let (pos, button, modifiers) = (pos2(1.0, 0.0), PointerButton::Primary, Modifiers::NONE);
        Event::PointerButton { pos, button, pressed, modifiers }
    }

    /// What was told, in letters.
    fn letters(reports: &[Report]) -> String {
        let letter = |report: &Report| match (report.device, report.what) {
            (Device::Touch, What::Pressed(_)) => 'P',
            (Device::Touch, What::Moved(_)) => 'M',
            (Device::Touch, What::Released) => 'R',
            (_, What::Pressed(_)) => 'p',
            (_, What::Moved(_)) => 'm',
            (_, What::Released) => 'r',
            (_, What::Gone) => 'g',
            (_, What::Barrel { .. }) => 'b',
        };
        reports.iter().map(letter).collect()
    }

    #[test]
    fn every_event_is_told_and_times_are_spread_evenly() {
        let start = Instant::now();
        let at = |ms| start + Duration::from_millis(ms);
        let mut pointer = Pointer::default();
        assert!(pointer.reports(&[], at(0)).is_empty());
        let mut events: Vec<Event> =
            (0_u8..9).map(|x| Event::PointerMoved(pos2(f32::from(x), 0.0))).collect();
        events.insert(4, button(true));
        let told = pointer.reports(&events, at(20));
        assert_eq!(letters(&told), "mmmmpmmmmm");
        let times: Vec<Instant> = told.iter().map(|report| report.arrived).collect();
        assert_eq!(times, (1..=10).map(|step| at(2 * step)).collect::<Vec<_>>());
        // A long pause is no part of the movement after it.
        let told = pointer.reports(&[button(false), Event::PointerGone], at(5_000));
        assert_eq!(letters(&told), "rg");
        assert_eq!([told[0].arrived, told[1].arrived], [at(4_983), at(5_000)]);
    }

    #[test]
    fn a_finger_paints_once_it_is_sure_to_be_alone_and_nothing_is_lost() {
        let start = Instant::now();
        let at = |ms| start + Duration::from_millis(ms);
        let mut pointer = Pointer::default();
        let mut tell = |ms, events: &[Event]| letters(&pointer.reports(events, at(ms)));
        // With the pointer that egui moves for it.
        let down = [touch(1, TouchPhase::Start, 0.0), button(true)];
        assert_eq!(tell(0, &down), "");
        let moved = [touch(1, TouchPhase::Move, 4.0), Event::PointerMoved(pos2(4.0, 0.0))];
        assert_eq!(tell(16, &moved), "");
        assert_eq!(tell(32, &[touch(1, TouchPhase::Move, 9.0)]), "PMM");
        assert_eq!(tell(48, &[touch(1, TouchPhase::Move, 30.0)]), "M");
        assert_eq!(tell(64, &[touch(1, TouchPhase::End, 30.0), button(false)]), "Rr");
        // A finger that waits.
        assert_eq!(tell(100, &down), "");
        assert_eq!(tell(160, &[]), "");
        assert_eq!(tell(180, &[]), "P");
        assert_eq!(tell(190, &[touch(1, TouchPhase::End, 0.0)]), "R");
        // A tap.
        assert_eq!(tell(300, &down), "");
        assert_eq!(tell(310, &[touch(1, TouchPhase::End, 0.0)]), "PR");
    }

    #[test]
    fn two_fingers_paint_nothing_and_end_a_stroke() {
        let start = Instant::now();
        let at = |ms| start + Duration::from_millis(ms);
        let mut pointer = Pointer::default();
        let mut tell = |ms, events: &[Event]| letters(&pointer.reports(events, at(ms)));
        let first = touch(1, TouchPhase::Start, 0.0);
        let pinch = [first.clone(), touch(2, TouchPhase::Start, 50.0)];
        assert_eq!(tell(0, &pinch), "");
        assert_eq!(tell(200, &[touch(1, TouchPhase::Move, 90.0)]), "");
        assert_eq!(tell(210, &[touch(1, TouchPhase::End, 90.0)]), "");
        assert_eq!(tell(220, &[touch(2, TouchPhase::Move, 90.0)]), "");
        assert_eq!(tell(230, &[touch(2, TouchPhase::End, 90.0)]), "");
        assert_eq!(tell(300, &[first, touch(1, TouchPhase::Move, 20.0)]), "PM");
        assert_eq!(tell(310, &[touch(2, TouchPhase::Start, 50.0)]), "R");
        assert_eq!(tell(320, &[touch(1, TouchPhase::Move, 60.0)]), "");
    }
}
