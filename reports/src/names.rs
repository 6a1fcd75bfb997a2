//! Placement of labels next to points without overlap.

use crate::lettering::estimated_width;
use crate::panel::Frame;
use crate::svg::Anchor;

/// A label with its position in px.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Placed<'a> {
    pub(crate) at: (f64, f64),
    pub(crate) anchor: Anchor,
    pub(crate) text: &'a str,
}

/// Half the side of the square kept free for a dot, in px.
const DOT: f64 = 3.5;

/// Left, top, right and bottom of a box in px.
type Edges = [f64; 4];

/// Places each label to the right, left, above or below its point, where it covers no dot and no
/// earlier label and stays in the frame. Where that fails, only the part before a colon is tried;
/// where that fails too, the label is left out.
pub(crate) fn place_labels<'a>(
    names: &[((f64, f64), &'a str)],
    dots: &[(f64, f64)],
    size: f64,
    frame: Frame,
) -> Vec<Placed<'a>> {
    let mut occupied: Vec<Edges> =
        dots.iter().map(|&(x, y)| [x - DOT, y - DOT, x + DOT, y + DOT]).collect();
    let mut placed = Vec::new();
    for &(at, text) in names {
        let short = text.split(": ").next().unwrap_or(text);
        let place = |text| free_place(at, text, size, frame, &occupied);
        if let Some((edges, name)) = place(text).or_else(|| place(short)) {
            occupied.push(edges);
            placed.push(name);
        }
    }
    placed
}

fn free_place<'a>(
    (x, y): (f64, f64),
    text: &'a str,
    size: f64,
    frame: Frame,
    occupied: &[Edges],
) -> Option<(Edges, Placed<'a>)> {
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
    tries.into_iter().find_map(|(x, y, anchor)| {
        let left = match anchor {
            Anchor::Start => x,
            Anchor::Middle => x - width / 2.0,
            Anchor::End => x - width,
        };
        let edges = [left, y - 0.6 * size, left + width, y + 0.6 * size];
        let [left, top, right, bottom] = edges;
        let inside = left >= frame.x
            && right <= frame.x + frame.width + 10.0
            && top >= frame.y - 4.0
            && bottom <= frame.y + frame.height;
        let free = inside
            && !occupied
                .iter()
                .any(|[l, t, r, b]: &Edges| left < *r && *l < right && top < *b && *t < bottom);
        free.then_some((edges, Placed { at: (x, y), anchor, text }))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_do_not_overlap_and_stay_in_the_frame() {
        let frame = Frame { x: 0.0, y: 0.0, width: 100.0, height: 50.0 };
        let points = [((50.0, 25.0), "one"), ((51.0, 25.0), "two"), ((99.0, 5.0), "edge")];
        let placed = place_labels(&points, &[], 10.0, frame);
        assert_eq!(placed.len(), 3);
        assert_eq!(placed[0].anchor, Anchor::Start);
        assert_eq!(placed[1].anchor, Anchor::End);
        assert_eq!(placed[2].anchor, Anchor::End);
        let narrow = Frame { width: 50.0, ..frame };
        let cut = place_labels(&[((40.0, 25.0), "17F: a long recipe")], &[], 10.0, narrow);
        assert_eq!((cut[0].text, cut.len()), ("17F", 1));
        let next_to_dot = place_labels(&points[..1], &[(60.0, 25.0)], 10.0, frame);
        assert_eq!(next_to_dot[0].anchor, Anchor::End);
    }
}
