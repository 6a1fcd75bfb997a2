//! Merging of regions that are too small, or too similar to a neighbour.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::region_graph::RegionGraph;

/// Merges each region of fewer than `least_px` pixels into the neighbour whose mean mode is
/// nearest in colour, the smallest region first, until none is left or there is one region.
/// Ties go to the smallest label.
pub(super) fn join_small(graph: &mut RegionGraph, least_px: u32) {
    let all = (0..graph.count() as u32).map(|region| Reverse((graph.pixels(region), region)));
    let mut small: BinaryHeap<_> = all.filter(|Reverse((pixels, _))| *pixels < least_px).collect();
    while let Some(Reverse((pixels, region))) = small.pop() {
        // It may have been joined since.
        if graph.pixels(region) != pixels {
            continue;
        }
        let around = graph.around(region).to_vec();
        let apart = |other: u32| graph.apart(region, other);
        let nearest = around.into_iter().min_by(|&a, &b| apart(a).total_cmp(&apart(b)));
        let Some(nearest) = nearest else { continue };
        let whole = graph.join(region, nearest);
        if graph.pixels(whole) < least_px {
            small.push(Reverse((graph.pixels(whole), whole)));
        }
    }
}

/// Merges neighbours whose mean modes are at most `range` apart in CIELUV, the nearest
/// first. Ties go to the smallest labels.
pub(super) fn join_alike(graph: &mut RegionGraph, range: f64) {
    // Distances are not negative, so their bit patterns sort in the same order.
    let mut pairs = BinaryHeap::new();
    for region in 0..graph.count() as u32 {
        for other in graph.around(region).to_vec() {
            let apart = graph.apart(region, other);
            if region < other && apart <= range {
                pairs.push(Reverse((apart.to_bits(), region, other)));
            }
        }
    }
    while let Some(Reverse((apart, one, other))) = pairs.pop() {
        // Either may have changed since.
        let current = graph.pixels(one) > 0
            && graph.pixels(other) > 0
            && graph.apart(one, other).to_bits() == apart;
        if !current {
            continue;
        }
        let whole = graph.join(one, other);
        for other in graph.around(whole).to_vec() {
            let apart = graph.apart(whole, other);
            if apart <= range {
                let one = whole.min(other);
                let other = whole.max(other);
                pairs.push(Reverse((apart.to_bits(), one, other)));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::mean_shift::Mode;
    use super::*;
    use crate::field::Field;

    /// The labels of a row of regions after `joining`; a region is given by its number of
    /// pixels and its L*.
    fn joined(regions: &[(usize, f32)], joining: impl Fn(&mut RegionGraph)) -> Vec<u32> {
        let mut labels = Vec::new();
        let mut modes = Vec::new();
        for (label, &(pixels, l)) in (0..).zip(regions) {
            labels.extend(vec![label; pixels]);
            modes.extend(vec![Mode { color: [l, 0.0, 0.0], ..Mode::default() }; pixels]);
        }
        let width = labels.len();
        let mut labels = Field::from_values(width, 1, labels);
        let modes = Field::from_values(width, 1, modes);
        let mut graph = RegionGraph::new(&labels, regions.len(), &modes, |_| true);
        joining(&mut graph);
        let count = graph.relabel(&mut labels);
        assert_eq!(labels.values().last().copied(), Some(count as u32 - 1));
        labels.values().to_vec()
    }

    #[test]
    fn the_small_join_the_nearest_in_color() {
        let row = |l: f32| joined(&[(3, 10.0), (1, l), (3, 60.0)], |graph| join_small(graph, 2));
        assert_eq!(row(40.0), [0, 0, 0, 1, 1, 1, 1]);
        assert_eq!(row(30.0), [0, 0, 0, 0, 1, 1, 1]);
    }

    #[test]
    fn the_smallest_goes_first_and_the_whole_counts() {
        let row = [(4, 0.0), (1, 50.0), (2, 60.0), (4, 90.0)];
        let found = joined(&row, |graph| join_small(graph, 3));
        assert_eq!(found, [0, 0, 0, 0, 1, 1, 1, 2, 2, 2, 2]);
        // A single region has no neighbour to join.
        assert_eq!(joined(&[(2, 0.0)], |graph| join_small(graph, 10)), [0, 0]);
        let row = [(2, 0.0), (1, 9.0), (3, 20.0)];
        assert_eq!(joined(&row, |graph| join_small(graph, 10)), [0; 6]);
    }

    #[test]
    fn the_alike_are_joined_the_nearest_first() {
        // 7 with 9.9, then 4 with 1; their means, 2 and 8.45, are too far apart.
        let row = [(2, 1.0), (1, 4.0), (2, 7.0), (2, 9.9)];
        let found = joined(&row, |graph| join_alike(graph, 4.0));
        assert_eq!(found, [0, 0, 0, 1, 1, 1, 1]);
        assert_eq!(joined(&row, |graph| join_alike(graph, 2.0)), [0, 0, 1, 2, 2, 3, 3]);
    }

    #[test]
    fn paint_does_not_join_paper_unless_it_must() {
        let mut labels = Field::from_values(5, 1, vec![0, 0, 1, 2, 2]);
        let modes = Field::filled(5, 1, Mode::default());
        let mut graph = RegionGraph::new(&labels, 3, &modes, |pixel| pixel > 1);
        join_small(&mut graph, 2);
        join_alike(&mut graph, 100.0);
        assert_eq!(graph.relabel(&mut labels), 2);
        assert_eq!(labels.values(), [0, 0, 1, 1, 1]);
    }
}
