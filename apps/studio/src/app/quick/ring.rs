//! Geometry of a ring of wedges.

use std::f32::consts::TAU;

use eframe::egui::{Color32, Mesh, Pos2, Vec2, vec2};

/// Largest angle that one piece of a wedge's edge spans, in radians.
const PIECE: f32 = 0.08;

/// A ring of equal wedges around a centre, clockwise from the top.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Ring {
    /// Radius of the inner edge, in points.
    pub(super) inner: f32,
    /// Radius of the outer edge, in points.
    pub(super) outer: f32,
    /// Number of wedges.
    pub(super) count: usize,
}

impl Ring {
    /// Index of the wedge at an offset from the centre.
    pub(super) fn wedge_at(&self, offset: Vec2) -> Option<usize> {
        let radius = offset.length();
        if self.count == 0 || radius < self.inner || radius >= self.outer {
            return None;
        }
        // The first wedge lies around the upward direction.
        let turn = offset.x.atan2(-offset.y) / TAU + 0.5 / self.count as f32;
        Some((turn.rem_euclid(1.0) * self.count as f32) as usize % self.count)
    }

    /// Offset of the middle of a wedge from the centre.
    pub(super) fn middle(&self, index: usize) -> Vec2 {
        0.5 * (self.inner + self.outer) * direction(self.angle(index as f32))
    }

    /// A wedge as a mesh of one colour, with a gap to its neighbours.
    pub(super) fn mesh(&self, center: Pos2, index: usize, fill: Color32) -> Mesh {
        let mut mesh = Mesh::default();
        for (at, [near, far]) in self.edge(center, index).into_iter().enumerate() {
            mesh.colored_vertex(near, fill);
            mesh.colored_vertex(far, fill);
            let last = 2 * at as u32;
            if at > 0 {
                mesh.add_triangle(last - 2, last - 1, last);
                mesh.add_triangle(last - 1, last + 1, last);
            }
        }
        mesh
    }

    /// Outline of a wedge as a closed line.
    pub(super) fn outline(&self, center: Pos2, index: usize) -> Vec<Pos2> {
        let edge = self.edge(center, index);
        let near = edge.iter().map(|[near, _]| *near);
        near.chain(edge.iter().rev().map(|[_, far]| *far)).collect()
    }

    /// Points of the inner and the outer edge of a wedge, clockwise.
    fn edge(&self, center: Pos2, index: usize) -> Vec<[Pos2; 2]> {
        let from = self.angle(index as f32 - 0.5);
        let to = self.angle(index as f32 + 0.5);
        let pieces = ((to - from) / PIECE).ceil().max(1.0) as usize;
        let point = |radius: f32, share: f32| {
            // A gap of one point on either side, at any radius.
            let gap = 1.0 / radius;
            let angle = from + gap + (to - from - 2.0 * gap) * share;
            center + radius * direction(angle)
        };
        let shares = (0..=pieces).map(|piece| piece as f32 / pieces as f32);
        shares
            .map(|share| [point(self.inner + 1.0, share), point(self.outer - 1.0, share)])
            .collect()
    }

    /// Angle clockwise from the top at a number of wedges.
    fn angle(&self, wedges: f32) -> f32 {
        TAU * wedges / self.count as f32
    }
}

fn direction(angle: f32) -> Vec2 {
    vec2(angle.sin(), -angle.cos())
}

#[cfg(test)]
mod tests {
    use super::*;

    const RING: Ring = Ring { inner: 40.0, outer: 90.0, count: 8 };

    #[test]
    fn every_wedge_is_found_at_its_middle_and_none_beside_the_ring() {
        for count in [1, 3, 8, 12] {
            let ring = Ring { count, ..RING };
            for index in 0..count {
                assert_eq!(ring.wedge_at(ring.middle(index)), Some(index), "of {count}");
            }
        }
        for offset in [Vec2::ZERO, vec2(39.0, 0.0), vec2(0.0, 91.0)] {
            assert_eq!(RING.wedge_at(offset), None, "{offset:?}");
        }
        assert_eq!(Ring { count: 0, ..RING }.wedge_at(vec2(60.0, 0.0)), None);
    }

    #[test]
    fn wedges_go_clockwise_from_the_top_and_meet_half_way() {
        assert_eq!(RING.wedge_at(vec2(0.0, -60.0)), Some(0), "the top");
        assert_eq!(RING.wedge_at(vec2(60.0, 0.0)), Some(2), "the right");
        let between = |degrees: f32| RING.wedge_at(60.0 * direction(degrees.to_radians()));
        assert_eq!([between(22.0), between(23.0), between(-23.0)], [Some(0), Some(1), Some(7)]);
    }

    #[test]
    fn a_wedge_is_large_enough_for_a_finger_and_lies_within_its_ring() {
        let center = Pos2::new(100.0, 100.0);
        for point in RING.outline(center, 3) {
            let radius = point.distance(center);
            assert!((40.0..=90.0).contains(&radius), "{radius}");
            assert!(RING.wedge_at(point - center) == Some(3), "{point:?}");
        }
        let chord = (RING.middle(0) - RING.middle(1)).length();
        assert!(chord >= 44.0, "{chord}");
    }
}
