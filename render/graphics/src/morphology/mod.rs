//! Mathematical morphology of colour pictures: openings and closings with a round structuring
//! element, after Serra, "Image analysis and mathematical morphology" (1982).
//!
//! An opening removes what is lighter than its surroundings and too small for the element. A
//! closing removes what is darker. We process channels independently, coverage among them. So pass
//! bare paper as white: specks of paint on paper then count as dark details, and gaps in paint as
//! light ones.
//!
//! The element is an octagon, which is the sum of a square and a diamond. Both are sums of
//! segments, so a pass needs a few comparisons per pixel at any radius. Minimum and maximum are
//! exact, so both forms of [`crate::compute::Compute`] agree bit for bit.
mod extremum;

pub use extremum::{EXTREMUM, closing, extremum, opening, opening_then_closing};

/// Whether to take the minimum or the maximum of the pixels under a structuring element.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Extremum {
    /// The minimum: an erosion.
    Minimum,
    /// The maximum: a dilation.
    Maximum,
}

/// The sum of a square and a diamond, which is an octagon: all pixels (x, y) with
/// max(|x| - square, 0) + max(|y| - square, 0) <= diamond.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct StructuringElement {
    square: u32,
    diamond: u32,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Crossing {
    along: [i32; 2],
    across: [i32; 2],
    reach_along: u32,
    reach_across: u32,
}

impl StructuringElement {
    /// The octagon closest to a regular one that reaches `radius_px` along rows and columns. A
    /// regular octagon contains the disc of this radius and reaches 8 % beyond it.
    #[must_use]
    pub fn round(radius_px: u32) -> Self {
        // The share of the diamond in a regular octagon: 2 - sqrt(2).
        let diamond = (f64::from(radius_px) * (2.0 - std::f64::consts::SQRT_2)).round() as u32;
        Self { square: radius_px - diamond, diamond }
    }

    /// The element that has the effect of two passes with this one.
    #[must_use]
    pub fn twice(self) -> Self {
        Self { square: 2 * self.square, diamond: 2 * self.diamond }
    }

    fn square(self) -> u32 {
        self.square
    }

    fn diagonal(self) -> u32 {
        (self.diamond - self.crosses()) / 2
    }

    /// Reach along rows and columns, in pixels.
    #[must_use]
    pub fn reach(self) -> u32 {
        self.square + self.diamond
    }

    /// Whether the element contains the pixel at this offset (x, y) from its centre.
    #[must_use]
    pub fn covers(self, x: i32, y: i32) -> bool {
        [x, y].map(|at| at.unsigned_abs().saturating_sub(self.square)).iter().sum::<u32>()
            <= self.diamond
    }

    /// Number of crosses of 5 pixels among the parts of the element. The sum of two diagonals has
    /// only every other pixel of a diamond. The square fills in the rest. If there is no square,
    /// crosses do this.
    fn crosses(self) -> u32 {
        match (self.diamond % 2, self.square, self.diamond) {
            (1, _, _) => 1,
            (_, 0, 2..) => 2,
            _ => 0,
        }
    }

    /// The element as a Minkowski sum of crosses and segments, at least one.
    fn crossings(self) -> Vec<Crossing> {
        fn segment(along: [i32; 2], reach_along: u32) -> Crossing {
            Crossing { along, across: [0, 0], reach_along, reach_across: 0 }
        }
        let cross = Crossing { along: [1, 0], across: [0, 1], reach_along: 1, reach_across: 1 };
        let mut all = vec![cross; self.crosses() as usize];
        let diagonal = self.diagonal();
        if diagonal > 0 {
            all.extend([segment([1, 1], diagonal), segment([-1, 1], diagonal)]);
        }
        if self.square > 0 || all.is_empty() {
            all.extend([segment([1, 0], self.square), segment([0, 1], self.square)]);
        }
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn elements_are_round() {
        for radius in 1..=40u32 {
            let element = StructuringElement::round(radius);
            assert_eq!(element.reach(), radius);
            let reach = radius as i32;
            let square = f64::from(radius).powi(2);
            let mut pixels = 0;
            let mut inside = 0;
            for y in -reach..=reach {
                for x in -reach..=reach {
                    pixels += i32::from(element.covers(x, y));
                    let distance = f64::from(x * x + y * y);
                    inside += i32::from(distance <= square);
                    // The element contains the disc except for half a pixel, and ends 9 % and 1 px
                    // beyond it.
                    let core = distance.sqrt() <= f64::from(radius) - 0.5;
                    assert!(!core || element.covers(x, y), "{radius}: {x} {y}");
                    let far = distance.sqrt() > 1.09 * f64::from(radius) + 1.0;
                    assert!(!far || !element.covers(x, y), "{radius}: {x} {y}");
                }
            }
            assert!(pixels >= inside, "{radius}: {pixels} of {inside}");
        }
    }

    #[test]
    fn crossings_sum_to_the_element() {
        for radius in 0..=20 {
            for element in
                [StructuringElement::round(radius), StructuringElement::round(radius).twice()]
            {
                let reach = element.reach() as i32;
                let mut points = std::collections::BTreeSet::from([(0, 0)]);
                for crossing in element.crossings() {
                    fn segment(step: [i32; 2], reach: u32) -> impl Iterator<Item = (i32, i32)> {
                        let reach = reach as i32;
                        (-reach..=reach).map(move |i| (i * step[0], i * step[1]))
                    }
                    let own: Vec<_> = segment(crossing.along, crossing.reach_along)
                        .chain(segment(crossing.across, crossing.reach_across))
                        .collect();
                    points = points
                        .iter()
                        .flat_map(|&(x, y): &(i32, i32)| {
                            own.clone().into_iter().map(move |(dx, dy)| (x + dx, y + dy))
                        })
                        .collect();
                }
                let area = (-reach..=reach).flat_map(|y| (-reach..=reach).map(move |x| (x, y)));
                let wanted = area.filter(|&(x, y)| element.covers(x, y)).collect();
                assert_eq!(points, wanted, "{element:?}");
            }
        }
    }
}
