//! The tree along which lines are given signs.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use super::links::{Link, Links};

/// A place reached by the tree, from a place reached before, or as the first of its part.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Step {
    pub(super) place: u32,
    pub(super) from: Option<u32>,
}

/// A link that the tree may grow along.
#[derive(Debug, Clone, Copy)]
struct Candidate {
    reliability: f64,
    place: u32,
    from: u32,
}

impl Ord for Candidate {
    /// The greater is taken first: the more reliable, then the lower indices.
    fn cmp(&self, other: &Self) -> Ordering {
        self.reliability
            .total_cmp(&other.reliability)
            .then(other.place.cmp(&self.place))
            .then(other.from.cmp(&self.from))
    }
}

impl PartialOrd for Candidate {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Candidate {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Candidate {}

/// All places in the order in which the spanning tree of greatest reliability reaches them, grown
/// from the most reliable place of each connected part (Prim, "Shortest connection networks and
/// some generalizations", 1957; over surfaces: Hoppe et al., "Surface reconstruction from
/// unorganized points", 1992). Parts with places among `seeds` grow from all of these at once.
/// Ties go to the lower index.
pub(super) fn spanning_tree(
    links: &Links,
    of_place: &[f64],
    seeds: &[u32],
    of_link: impl Fn(usize, &Link) -> f64,
) -> Vec<Step> {
    let mut roots: Vec<u32> = (0..links.count() as u32).collect();
    roots.sort_unstable_by(|&a, &b| {
        of_place[b as usize].total_cmp(&of_place[a as usize]).then(a.cmp(&b))
    });
    let mut reached = vec![false; links.count()];
    let mut steps = Vec::with_capacity(links.count());
    let mut candidates = BinaryHeap::new();
    let mut reach = |step: Step, reached: &mut [bool], candidates: &mut BinaryHeap<Candidate>| {
        reached[step.place as usize] = true;
        steps.push(step);
        for link in links.of(step.place as usize) {
            if !reached[link.to as usize] {
                let reliability = of_link(step.place as usize, link);
                candidates.push(Candidate { reliability, place: link.to, from: step.place });
            }
        }
    };
    for &place in seeds {
        reach(Step { place, from: None }, &mut reached, &mut candidates);
    }
    for root in roots {
        while let Some(step) = unreached(&mut candidates, &reached) {
            reach(step, &mut reached, &mut candidates);
        }
        if !reached[root as usize] {
            reach(Step { place: root, from: None }, &mut reached, &mut candidates);
        }
    }
    while let Some(step) = unreached(&mut candidates, &reached) {
        reach(step, &mut reached, &mut candidates);
    }
    steps
}

/// The best candidate whose place is not reached yet.
fn unreached(candidates: &mut BinaryHeap<Candidate>, reached: &[bool]) -> Option<Step> {
    while let Some(Candidate { place, from, .. }) = candidates.pop() {
        if !reached[place as usize] {
            return Some(Step { place, from: Some(from) });
        }
    }
    None
}
