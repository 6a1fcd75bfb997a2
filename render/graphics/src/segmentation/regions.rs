//! Regions: connected pixels whose modes are close.

use super::mean_shift::{Bandwidth, Mode};
use crate::field::Field;

/// Disjoint sets (union-find), each identified by its smallest member.
pub(super) struct Sets {
    parents: Vec<u32>,
}

impl Sets {
    /// `count` sets of one member each.
    pub(super) fn new(count: usize) -> Self {
        Self { parents: (0..count as u32).collect() }
    }

    /// The smallest member of the set of `member`.
    pub(super) fn least(&mut self, mut member: u32) -> u32 {
        while self.parents[member as usize] != member {
            let parent = self.parents[member as usize];
            self.parents[member as usize] = self.parents[parent as usize];
            member = parent;
        }
        member
    }

    /// Unites the sets of two members. Returns the smallest member of the union.
    pub(super) fn join(&mut self, one: u32, other: u32) -> u32 {
        let one = self.least(one);
        let other = self.least(other);
        let least = one.min(other);
        let greater = one.max(other);
        self.parents[greater as usize] = least;
        least
    }
}

/// Renumbers labels without gaps, in the order of their first appearance row by row. Returns
/// the number of different labels.
pub(super) fn numbered(sets: &mut Sets, labels: &mut [u32], count: usize) -> usize {
    const NONE: u32 = u32::MAX;
    let mut numbers = vec![NONE; count];
    let mut found = 0;
    for label in labels {
        let number = &mut numbers[sets.least(*label) as usize];
        if *number == NONE {
            *number = found;
            found += 1;
        }
        *label = *number;
    }
    found as usize
}

/// Largest distance in colour of the modes of linked neighbours, in range radii. With 1, the
/// pixels of a soft edge would link the regions on both sides. A region that this value
/// divides needlessly is merged again later.
const LINK: f32 = 0.5;

/// Labels every pixel with its region. Returns the labels with the number of regions.
/// Neighbours in a row or column are linked if their modes are within the spatial radius and
/// half the range radius of each other, and both are `painted` or both bare; regions are the
/// connected components (Comaniciu and Meer 2002, section 4.2, step 2).
pub(super) fn linked(
    modes: &Field<Mode>,
    painted: impl Fn(usize) -> bool,
    bandwidth: Bandwidth,
) -> (Field<u32>, usize) {
    let width = modes.width();
    let height = modes.height();
    let [near_px, near] = [bandwidth.spatial_px.powi(2), (LINK * bandwidth.range).powi(2)];
    let values = modes.values();
    let alike = |one: usize, other: usize| {
        let a = &values[one];
        let b = &values[other];
        let [l, u, v] = [0, 1, 2].map(|i| a.color[i] - b.color[i]);
        let x = a.x - b.x;
        let y = a.y - b.y;
        (l * l + u * u + v * v <= near)
            & (x * x + y * y <= near_px)
            & (painted(one) == painted(other))
    };
    let mut sets = Sets::new(values.len());
    for y in 0..height {
        for x in 0..width {
            let pixel = y * width + x;
            if x > 0 && alike(pixel, pixel - 1) {
                sets.join(pixel as u32, pixel as u32 - 1);
            }
            if y > 0 && alike(pixel, pixel - width) {
                sets.join(pixel as u32, (pixel - width) as u32);
            }
        }
    }
    let mut labels: Vec<u32> = (0..values.len() as u32).collect();
    let count = numbered(&mut sets, &mut labels, values.len());
    (Field::from_values(width, height, labels), count)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sets_are_told_by_their_least() {
        let mut sets = Sets::new(5);
        assert_eq!(sets.join(4, 2), 2);
        assert_eq!(sets.join(4, 1), 1);
        assert_eq!([0, 1, 2, 3, 4].map(|member| sets.least(member)), [0, 1, 1, 3, 1]);
        let mut labels = [3, 4, 0, 2];
        assert_eq!(numbered(&mut sets, &mut labels, 5), 3);
        assert_eq!(labels, [0, 1, 2, 1]);
    }

    #[test]
    fn links_reach_over_steps_within_the_bandwidths_only() {
        let mode = |x: f32, l: f32| Mode { x, y: 0.0, color: [l, 0.0, 0.0] };
        // Steps in L* of 2, 2, 3; a step of place; the paper's edge.
        let row = [(0.0, 10.0), (0.0, 12.0), (0.0, 14.0), (0.0, 17.0), (9.0, 17.0), (9.0, 17.0)];
        let modes = Field::from_values(6, 1, row.map(|(x, l)| mode(x, l)).to_vec());
        let bandwidth = Bandwidth { spatial_px: 4.0, range: 4.0 };
        let (labels, count) = linked(&modes, |pixel| pixel < 5, bandwidth);
        assert_eq!((labels.values(), count), (&[0, 0, 0, 1, 2, 3][..], 4));
    }
}
