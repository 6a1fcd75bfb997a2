//! Leads one stroke along a guide.

use super::course::Course;
use super::place::{length, way};
use super::settings::Guide;

/// A place on a surface, in mm.
type Spot = (f64, f64);

/// The way of one stroke along a guide.
#[derive(Debug, Clone)]
pub(in crate::pen) struct Lead {
    state: State,
    /// The last place that was led.
    last: Option<Spot>,
}

#[derive(Debug, Clone)]
enum State {
    /// Nothing leads the stroke.
    Free,
    /// The line follows from the start of the stroke and from the direction in which it goes.
    Undecided { guide: Guide, start: Option<Spot>, decided_mm: f64 },
    /// The stroke keeps to this.
    Along(Course),
}

impl Lead {
    /// The lead of a stroke that has not begun. Perspective is decided once the pen is `decided_mm`
    /// away from its start.
    pub(in crate::pen) fn new(guide: Option<Guide>, decided_mm: f64) -> Self {
        Self {
            state: guide.map_or(State::Free, |guide| State::Undecided {
                guide,
                start: None,
                decided_mm,
            }),
            last: None,
        }
    }

    /// Whether the stroke goes where the pen does.
    pub(in crate::pen) fn is_off(&self) -> bool {
        matches!(self.state, State::Free)
    }

    /// Whether the line of the stroke is not decided yet.
    pub(in crate::pen) fn is_open(&self) -> bool {
        matches!(self.state, State::Undecided { .. })
    }

    /// The last place that was led; `None` before the first.
    pub(in crate::pen) fn last(&self) -> Option<Spot> {
        self.last
    }

    /// The place of the stroke for a place of the brush. While the line is not decided, that is the
    /// place itself.
    pub(in crate::pen) fn follow(&mut self, place: Spot) -> Spot {
        self.decide(place);
        let led = self.led(place);
        self.last = Some(led);
        led
    }

    /// The place on the line of the stroke for a place, as [`Lead::follow`] without moving there.
    pub(in crate::pen) fn led(&self, place: Spot) -> Spot {
        match &self.state {
            State::Along(course) => course.led(place.into()).into(),
            State::Free | State::Undecided { .. } => place,
        }
    }

    /// Ends the wait for the direction of the stroke: one that is too short to have one is free.
    pub(in crate::pen) fn settle(&mut self) {
        if self.is_open() {
            self.state = State::Free;
        }
    }

    fn decide(&mut self, place: Spot) {
        let State::Undecided { guide, start, decided_mm } = &mut self.state else { return };
        let start = *start.get_or_insert(place);
        let far = length(way(start.into(), place.into())) >= *decided_mm;
        if let Guide::Ruler(_) = guide {
            let course = guide.course(start.into(), place.into());
            self.state = course.map_or(State::Free, State::Along);
        } else if far && let Some(course) = guide.course(start.into(), place.into()) {
            self.state = State::Along(course);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::perspective::Perspective;
    use super::super::ruler::Ruler;
    use super::*;

    fn perspective() -> Option<Guide> {
        let points = [[0.0, 0.0], [100.0, 0.0], [0.0, 0.0]];
        Some(Guide::Perspective(Perspective { count: 2, points }))
    }

    #[test]
    fn a_stroke_without_a_guide_goes_where_the_pen_does() {
        let mut lead = Lead::new(None, 2.0);
        assert!(lead.is_off() && !lead.is_open());
        for place in [(1.0, 2.0), (1.3, 2.7), (9.0, -4.0)] {
            assert_eq!((lead.follow(place), lead.last()), (place, Some(place)));
        }
    }

    #[test]
    fn a_ruler_leads_from_the_first_place_on() {
        let ruler = Ruler { ends: [[0.0, 5.0], [10.0, 5.0]], ..Ruler::default() };
        let mut lead = Lead::new(Some(Guide::Ruler(ruler)), 2.0);
        assert_eq!(lead.follow((3.0, 9.0)), (3.0, 5.0));
        assert!(!lead.is_open() && !lead.is_off());
        assert_eq!(lead.follow((-4.0, 2.0)), (-4.0, 5.0));
        let mut lead = Lead::new(Some(Guide::Ruler(Ruler::default())), 2.0);
        assert_eq!(lead.follow((3.0, 9.0)), (3.0, 9.0), "a ruler without extent");
        assert!(lead.is_off());
    }

    #[test]
    fn perspective_is_decided_once_the_pen_is_far_enough() {
        let mut lead = Lead::new(perspective(), 2.0);
        assert_eq!(lead.follow((50.0, 50.0)), (50.0, 50.0));
        assert_eq!(lead.follow((49.0, 49.2)), (49.0, 49.2));
        assert!(lead.is_open());
        let (x, y) = lead.follow((48.0, 48.4));
        assert!(!lead.is_open() && (x - y).abs() < 1e-9, "{x} {y}");
        // Later the stroke keeps to its line, whichever way the pen goes.
        let (x, y) = lead.follow((70.0, 30.0));
        assert!((x - 50.0).abs() < 1e-9 && (y - 50.0).abs() < 1e-9, "{x} {y}");
    }

    #[test]
    fn a_touch_without_direction_is_free() {
        let mut lead = Lead::new(perspective(), 2.0);
        lead.follow((50.0, 50.0));
        lead.settle();
        assert!(lead.is_off());
        assert_eq!(lead.follow((90.0, 50.0)), (90.0, 50.0));
    }
}
