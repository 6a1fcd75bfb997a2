//! Names beside points, set so that they do not cover each other.

use crate::panel::Frame;
use crate::svg::{Anchor, estimated_width};

/// A name with its place in px.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Placed<'a> {
    pub(crate) at: (f64, f64),
    pub(crate) anchor: Anchor,
    pub(crate) text: &'a str,
}

/// Half the side of what a dot takes, in px.
const DOT: f64 = 3.5;

/// Left, top, right and bottom in px.
type Edges = [f64; 4];

/// Each name to the right, left, above or below its point, where it covers
/// no dot and no former name and stays in the frame; a name without such a place is left out.
pub(crate) fn placed<'a>(
    names: &[((f64, f64), &'a str)],
    dots: &[(f64, f64)],
    size: f64,
    frame: Frame,
) -> Vec<Placed<'a>> {
    let mut taken: Vec<Edges> =
        dots.iter().map(|&(x, y)| [x - DOT, y - DOT, x + DOT, y + DOT]).collect();
    let mut placed = Vec::new();
    for &((x, y), text) in names {
        let width = estimated_width(text, size);
        let tries = [
            (x + 6.0, y, Anchor::Start),
            (x - 6.0, y, Anchor::End),
            (x, y - size, Anchor::Middle),
            (x, y + size, Anchor::Middle),
            (x + 6.0, y - size, Anchor::Start),
            (x - 6.0, y - size, Anchor::End),
            (x + 6.0, y + size, Anchor::Start),
            (x - 6.0, y + size, Anchor::End),
        ];
        let edges = |&(x, y, anchor): &(f64, f64, Anchor)| -> Edges {
            let left = match anchor {
                Anchor::Start => x,
                Anchor::Middle => x - width / 2.0,
                Anchor::End => x - width,
            };
            [left, y - 0.6 * size, left + width, y + 0.6 * size]
        };
        let free = |place: &&(f64, f64, Anchor)| {
            let [left, top, right, bottom] = edges(place);
            let inside = left >= frame.x
                && right <= frame.x + frame.width + 10.0
                && top >= frame.y - 4.0
                && bottom <= frame.y + frame.height;
            let covers = |[l, t, r, b]: &Edges| left < *r && *l < right && top < *b && *t < bottom;
            inside && !taken.iter().any(covers)
        };
        if let Some(place) = tries.iter().find(free) {
            taken.push(edges(place));
            placed.push(Placed { at: (place.0, place.1), anchor: place.2, text });
        }
    }
    placed
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_stand_apart_and_inside() {
        let frame = Frame { x: 0.0, y: 0.0, width: 100.0, height: 50.0 };
        let points = [((50.0, 25.0), "one"), ((51.0, 25.0), "two"), ((99.0, 25.0), "edge")];
        let placed = placed(&points, &[], 10.0, frame);
        assert_eq!(placed.len(), 3);
        assert_eq!(placed[0].anchor, Anchor::Start);
        assert_eq!(placed[1].anchor, Anchor::End);
        assert_eq!(placed[2].anchor, Anchor::Middle);
        let beside_a_dot = super::placed(&points[..1], &[(60.0, 25.0)], 10.0, frame);
        assert_eq!(beside_a_dot[0].anchor, Anchor::End);
    }
}
