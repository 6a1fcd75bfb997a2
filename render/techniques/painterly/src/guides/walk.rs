//! Steps along a line.

use glam::DVec2;

/// One step of at most 1 px: its middle, and the unit direction of the line there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Step {
    pub(super) at: DVec2,
    pub(super) along: DVec2,
}

/// The steps of a line from its first point to its last, places times `scale`.
pub(super) fn steps(points: &[[f64; 2]], scale: DVec2) -> impl Iterator<Item = Step> {
    points.windows(2).flat_map(move |ends| {
        let [from, to] = [ends[0], ends[1]].map(|end| DVec2::from(end) * scale);
        let length = (to - from).length();
        let count = length.ceil();
        // A piece of length 0 has no step.
        let along = (to - from) / length.max(f64::MIN_POSITIVE);
        (0..count as usize).map(move |step| {
            let share = (step as f64 + 0.5) / count;
            Step { at: from.lerp(to, share), along }
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_at_most_a_pixel_and_follow_the_line() {
        let points = [[0.0, 0.0], [3.0, 0.0], [3.0, 0.0], [3.0, 2.5]];
        let found: Vec<Step> = steps(&points, DVec2::new(1.0, 2.0)).collect();
        let right = found.iter().take(3).map(|step| (step.at.to_array(), step.along));
        let wanted = [0.5, 1.5, 2.5].map(|x| ([x, 0.0], DVec2::X));
        assert_eq!(right.collect::<Vec<_>>(), wanted);
        assert_eq!(found.len(), 3 + 5);
        assert_eq!(found[7], Step { at: DVec2::new(3.0, 4.5), along: DVec2::Y });
    }
}
