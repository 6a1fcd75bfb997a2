//! The drawing aids of a painting.

use serde::{Deserialize, Serialize};

use super::course::Course;
use super::perspective::Perspective;
use super::place::Place;
use super::ruler::Ruler;
use super::symmetry::Symmetry;

/// Kind of a guide.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum GuideKind {
    /// The ruler, straight or an ellipse.
    Ruler,
    /// The perspective guide with its vanishing points.
    Perspective,
}

/// A guide that leads strokes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Guide {
    /// A ruler: each stroke keeps to it.
    Ruler(Ruler),
    /// Perspective: each stroke keeps to the line from its start to a vanishing point.
    Perspective(Perspective),
}

impl Guide {
    /// The line or ellipse of a stroke that starts at `start`; for perspective also by its way to
    /// `to`. `None` if there is none.
    pub(super) fn course(&self, start: Place, to: Place) -> Option<Course> {
        match self {
            Self::Ruler(ruler) => ruler.course(start),
            Self::Perspective(perspective) => perspective.course(start, to),
        }
    }
}

/// The drawing aids of a painting: one guide at a time, and symmetry. All are off at first.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct DrawingAids {
    /// The guide that is shown.
    pub guide: Option<GuideKind>,
    /// Whether the guide leads strokes; otherwise it is only shown.
    pub snaps: bool,
    /// The ruler, shown or not.
    pub ruler: Ruler,
    /// The perspective guide, shown or not.
    pub perspective: Perspective,
    /// Symmetry, on or off.
    pub symmetry: Symmetry,
    /// Width and height of the canvas that they are placed on, in mm.
    pub canvas_mm: [f64; 2],
}

impl Default for DrawingAids {
    fn default() -> Self {
        Self {
            guide: None,
            snaps: true,
            ruler: Ruler::default(),
            perspective: Perspective::default(),
            symmetry: Symmetry::default(),
            canvas_mm: [0.0; 2],
        }
    }
}

impl DrawingAids {
    /// Shows a guide in place of another one, or takes it away if it is shown.
    pub fn toggle(&mut self, kind: GuideKind) {
        self.guide = if self.guide == Some(kind) { None } else { Some(kind) };
    }

    /// The guide that leads strokes, if one is shown and does.
    #[must_use]
    pub fn leading(&self) -> Option<Guide> {
        let guide = match self.guide? {
            GuideKind::Ruler => Guide::Ruler(self.ruler),
            GuideKind::Perspective => Guide::Perspective(self.perspective),
        };
        self.snaps.then_some(guide)
    }

    /// Puts all aids to their usual places on a canvas of this width and height in mm, unless they
    /// are placed on one of this size.
    pub fn fit(&mut self, canvas_mm: [f64; 2]) {
        if self.canvas_mm != canvas_mm {
            self.canvas_mm = canvas_mm;
            self.put_back();
        }
    }

    /// Puts all aids to their usual places on the canvas.
    pub fn put_back(&mut self) {
        let [width, height] = self.canvas_mm;
        self.ruler = Ruler::in_middle_of(self.canvas_mm, self.ruler.shape);
        self.perspective = Perspective::in_middle_of(self.canvas_mm, self.perspective.count);
        self.symmetry.centre = [0.5 * width, 0.5 * height];
        self.symmetry.angle_deg = 0.0;
    }

    /// Sets the number of vanishing points, 1 to 3, and puts them to their usual places.
    pub fn set_vanishing_points(&mut self, count: usize) {
        self.perspective = Perspective::in_middle_of(self.canvas_mm, count);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_guide_is_shown_at_a_time_and_leads_only_if_it_is_to() {
        let mut aids = DrawingAids::default();
        assert_eq!(aids.leading(), None);
        aids.toggle(GuideKind::Ruler);
        assert_eq!(aids.leading(), Some(Guide::Ruler(aids.ruler)));
        aids.toggle(GuideKind::Perspective);
        assert_eq!(aids.leading(), Some(Guide::Perspective(aids.perspective)));
        aids.snaps = false;
        assert_eq!((aids.leading(), aids.guide), (None, Some(GuideKind::Perspective)));
        aids.toggle(GuideKind::Perspective);
        assert_eq!(aids.guide, None);
    }

    #[test]
    fn aids_stay_where_they_are_while_the_canvas_has_their_size() {
        let mut aids = DrawingAids::default();
        aids.fit([40.0, 20.0]);
        assert_eq!(aids.symmetry.centre, [20.0, 10.0]);
        assert_eq!(aids.ruler.ends, [[10.0, 10.0], [30.0, 10.0]]);
        aids.symmetry.centre = [5.0, 6.0];
        aids.symmetry.arms = 9;
        let text = serde_json::to_string(&aids).unwrap();
        let mut read: DrawingAids = serde_json::from_str(&text).unwrap();
        assert_eq!(read, aids);
        read.fit([40.0, 20.0]);
        assert_eq!(read, aids, "those of an autosave too");
        read.fit([40.0, 30.0]);
        assert_eq!((read.symmetry.centre, read.symmetry.arms), ([20.0, 15.0], 9));
        assert_eq!(serde_json::from_str::<DrawingAids>("{}").unwrap(), DrawingAids::default());
    }
}
