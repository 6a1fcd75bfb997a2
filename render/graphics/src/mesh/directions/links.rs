//! Links between neighbouring places: how squares of tangent vectors turn on the way, and how
//! strongly the link holds both together.

use std::ops::Range;

use glam::DVec2;

use crate::mesh::places::Places;
use crate::mesh::tangent_plane::TangentPlane;

/// A link from one place to a neighbour.
#[derive(Debug, Clone, Copy)]
pub(super) struct Link {
    /// Place at the other end.
    pub(super) to: u32,
    /// Above 0, and the same in both directions.
    pub(super) stiffness: f64,
    /// Factor that carries squares of vectors from the neighbour's tangent plane to this one.
    pub(super) turn: DVec2,
}

/// The links of every place.
#[derive(Debug, Clone)]
pub(super) struct Links {
    starts: Vec<u32>,
    all: Vec<Link>,
}

impl Links {
    /// The links along the edges of the triangles. The stiffness is that of the edge times (1 +
    /// cosine of the angle between the normals) / 2; places of opposite normals have no link.
    pub(super) fn new(places: &Places, planes: &[TangentPlane]) -> Self {
        let mut starts = vec![0];
        let mut all = Vec::with_capacity(places.stiffness.len());
        for place in 0..places.neighbours.count() {
            let stiffness = &places.stiffness[places.neighbours.slots(place)];
            for (&to, stiffness) in places.neighbours.of(place).iter().zip(stiffness) {
                let here = &planes[place];
                let there = &planes[to as usize];
                if let Some(turn) = there.turn_of_squares(here) {
                    let folded = 0.5 * (1.0 + here.normal.dot(there.normal));
                    all.push(Link { to, stiffness: stiffness * folded, turn });
                }
            }
            starts.push(all.len() as u32);
        }
        Self { starts, all }
    }

    /// Number of places.
    pub(super) fn count(&self) -> usize {
        self.starts.len() - 1
    }

    /// The links of a place.
    pub(super) fn of(&self, place: usize) -> &[Link] {
        &self.all[self.starts[place] as usize..self.starts[place + 1] as usize]
    }

    /// The places in connected groups: a list of all places, and the range of each group in it.
    /// Groups are ordered by their first place.
    pub(super) fn parts(&self) -> (Vec<u32>, Vec<Range<usize>>) {
        let mut reached = vec![false; self.count()];
        let mut order: Vec<u32> = Vec::with_capacity(self.count());
        let mut parts = Vec::new();
        for first in 0..self.count() {
            if reached[first] {
                continue;
            }
            reached[first] = true;
            let start = order.len();
            let mut next = start;
            order.push(first as u32);
            while next < order.len() {
                for link in self.of(order[next] as usize) {
                    if !std::mem::replace(&mut reached[link.to as usize], true) {
                        order.push(link.to);
                    }
                }
                next += 1;
            }
            parts.push(start..order.len());
        }
        (order, parts)
    }
}
