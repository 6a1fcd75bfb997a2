//! Taps of several fingers at once.

use web_time::{Duration, Instant};

use eframe::egui::{Event, Pos2, TouchId, TouchPhase};

/// Time within which all fingers of a tap come down.
const DOWN: Duration = Duration::from_millis(250);

/// Time within which all of them are lifted, from the first contact.
const UP: Duration = Duration::from_millis(450);

/// Distance in points by which a finger of a tap may move.
const STILL: f32 = 10.0;

/// A tap of several fingers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Tap {
    /// Number of fingers, 2 or more.
    pub(super) fingers: usize,
    /// Place of the first contact.
    pub(super) at: Pos2,
}

/// The fingers since the first one came down.
#[derive(Debug, Default)]
pub(super) struct Taps {
    since: Option<Instant>,
    /// All fingers that came down, with their first places.
    fingers: Vec<(TouchId, Pos2)>,
    /// Number of fingers that are down.
    down: usize,
    /// Whether this cannot be a tap any more.
    spoiled: bool,
}

impl Taps {
    /// Reads an event of the frame at `now`. Returns the tap that ends with it.
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

    /// Notes that a finger paints: until all are lifted, this is no tap.
    pub(super) fn paints(&mut self) {
        self.spoiled |= self.since.is_some();
    }
}

#[cfg(test)]
mod tests {
    use eframe::egui::{TouchDeviceId, pos2};

    use super::*;

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

    use TouchPhase::{Cancel, End, Move, Start};

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
