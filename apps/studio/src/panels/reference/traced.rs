//! Lines traced by the pointer: the part on the picture, with few points.

/// Places are rounded to this part of a pixel.
const ROUNDED_TO: f64 = 0.1;

/// The part of a traced line up to where it first leaves a picture of this width and height, in
/// pixels, with points only where it bends by more than `tolerance` pixels. Fewer than two points
/// if nothing of it is on the picture.
pub(super) fn traced(points: &[[f64; 2]], size: [usize; 2], tolerance: f64) -> Vec<[f64; 2]> {
    // The last pixel ends where no place is any more.
    let most = size.map(|side| side as f64 - ROUNDED_TO);
    let rounded = |place: f64, most: f64| {
        // Divided, because a tenth is not exact in binary.
        ((place / ROUNDED_TO).round() / ROUNDED_TO.recip()).clamp(0.0, most.max(0.0))
    };
    let piece = first_piece(points, most);
    let mut line: Vec<[f64; 2]> = simplified(&piece, tolerance)
        .into_iter()
        .map(|[x, y]| [rounded(x, most[0]), rounded(y, most[1])])
        .collect();
    line.dedup();
    line
}

/// Points of a line from where it enters a rectangle of this size to where it leaves it.
fn first_piece(points: &[[f64; 2]], most: [f64; 2]) -> Vec<[f64; 2]> {
    let mut piece: Vec<[f64; 2]> = Vec::new();
    for ends in points.windows(2) {
        match inside(ends[0], ends[1], most) {
            Some([from, to]) => {
                if piece.is_empty() {
                    piece.push(from);
                }
                piece.push(to);
                if to != ends[1] {
                    break;
                }
            }
            None if piece.is_empty() => {}
            None => break,
        }
    }
    piece
}

/// The part of a segment in a rectangle from the origin (Liang and Barsky, "A new concept and method
/// for line clipping", 1984).
fn inside(from: [f64; 2], to: [f64; 2], most: [f64; 2]) -> Option<[[f64; 2]; 2]> {
    let mut first = 0.0_f64;
    let mut last = 1.0_f64;
    for axis in 0..2 {
        let step = to[axis] - from[axis];
        for (toward, room) in [(-step, from[axis]), (step, most[axis] - from[axis])] {
            if toward == 0.0 && room < 0.0 {
                return None;
            }
            let at = room / toward;
            if toward < 0.0 {
                first = first.max(at);
            } else if toward > 0.0 {
                last = last.min(at);
            }
        }
    }
    let at = |share: f64| [0, 1].map(|axis| from[axis] + share * (to[axis] - from[axis]));
    let end = if last == 1.0 { to } else { at(last) };
    (first <= last).then(|| [at(first), end])
}

/// The ends of a line and the points between that are farther than `tolerance` from the line without
/// them (Douglas and Peucker, "Algorithms for the reduction of the number of points required to
/// represent a digitized line", 1973).
fn simplified(points: &[[f64; 2]], tolerance: f64) -> Vec<[f64; 2]> {
    let Some(last) = points.len().checked_sub(1) else { return Vec::new() };
    let mut kept = vec![false; points.len()];
    (kept[0], kept[last]) = (true, true);
    let mut pieces = vec![(0, last)];
    while let Some((from, to)) = pieces.pop() {
        let far = |at: usize| distance(points[at], [points[from], points[to]]);
        let farthest = (from + 1..to).max_by(|&one, &other| far(one).total_cmp(&far(other)));
        if let Some(at) = farthest.filter(|&at| far(at) > tolerance) {
            kept[at] = true;
            pieces.extend([(from, at), (at, to)]);
        }
    }
    points.iter().zip(kept).filter(|(_, kept)| *kept).map(|(point, _)| *point).collect()
}

/// Distance of a point from a segment.
pub(super) fn distance([x, y]: [f64; 2], [from, to]: [[f64; 2]; 2]) -> f64 {
    let right = to[0] - from[0];
    let down = to[1] - from[1];
    let square = right * right + down * down;
    let along = (x - from[0]) * right + (y - from[1]) * down;
    let share = if square > 0.0 { (along / square).clamp(0.0, 1.0) } else { 0.0 };
    (x - from[0] - share * right).hypot(y - from[1] - share * down)
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZE: [usize; 2] = [100, 50];

    #[test]
    fn a_straight_line_keeps_its_ends_and_a_bend_its_corner() {
        let points: Vec<[f64; 2]> = (0..=20).map(|step| [f64::from(step) * 2.0, 10.04]).collect();
        assert_eq!(traced(&points, SIZE, 0.5), [[0.0, 10.0], [40.0, 10.0]]);
        let down = (1..=10).map(|step| [40.0, 10.04 + f64::from(step)]);
        let bent: Vec<[f64; 2]> = points.into_iter().chain(down).collect();
        assert_eq!(traced(&bent, SIZE, 0.5), [[0.0, 10.0], [40.0, 10.0], [40.0, 20.0]]);
    }

    #[test]
    fn a_line_ends_where_it_leaves_the_picture() {
        let out = [[50.0, 25.0], [90.0, 25.0], [110.0, 25.0], [60.0, 40.0]];
        assert_eq!(traced(&out, SIZE, 0.5), [[50.0, 25.0], [99.9, 25.0]]);
        let into = [[50.0, -10.0], [50.0, 10.0], [60.0, 10.0]];
        assert_eq!(traced(&into, SIZE, 0.5), [[50.0, 0.0], [50.0, 10.0], [60.0, 10.0]]);
        assert_eq!(traced(&[[-5.0, 60.0], [120.0, 70.0]], SIZE, 0.5), [] as [[f64; 2]; 0]);
        let across = [[-50.0, 25.0], [150.0, 25.0], [150.0, 45.0], [-50.0, 45.0]];
        assert_eq!(traced(&across, SIZE, 0.5), [[0.0, 25.0], [99.9, 25.0]], "the first part alone");
    }

    #[test]
    fn a_line_without_length_has_one_point_or_none() {
        assert_eq!(traced(&[[3.0, 4.0]], SIZE, 0.5).len(), 0);
        assert_eq!(traced(&[[3.0, 4.0], [3.02, 4.0]], SIZE, 0.5), [[3.0, 4.0]]);
    }

    #[test]
    fn the_distance_from_a_segment_is_that_from_its_nearest_point() {
        let segment = [[0.0, 0.0], [10.0, 0.0]];
        assert_eq!(distance([5.0, 3.0], segment), 3.0);
        assert_eq!(distance([13.0, 4.0], segment), 5.0);
        assert_eq!(distance([3.0, 4.0], [[0.0, 0.0]; 2]), 5.0);
    }
}
