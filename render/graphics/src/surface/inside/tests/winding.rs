//! The oracle: winding numbers in f64, and which points lie too near an outline or a skin for
//! rasterised faces to decide.

use glam::{DVec2, DVec3, Vec3};

/// The number of times that closed faces wind around `point`: their solid angles over 4 pi
/// (van Oosterom, Strackee 1983, eq. 8).
pub(super) fn winding_number(point: DVec3, faces: &[[DVec3; 3]]) -> f64 {
    let angles = faces.iter().map(|face| {
        let [a, b, c] = face.map(|corner| corner - point);
        let [la, lb, lc] = [a.length(), b.length(), c.length()];
        let over = a.dot(b.cross(c));
        let under = la * lb * lc + a.dot(b) * lc + a.dot(c) * lb + b.dot(c) * la;
        2.0 * over.atan2(under)
    });
    angles.sum::<f64>() / (4.0 * std::f64::consts::PI)
}

/// A closed surface of the oracle.
pub(super) struct Solid {
    faces: Vec<[DVec3; 3]>,
    low: DVec3,
    high: DVec3,
}

impl Solid {
    pub(super) fn new(faces: impl Iterator<Item = [Vec3; 3]>) -> Self {
        let faces: Vec<_> = faces.map(|face| face.map(Vec3::as_dvec3)).collect();
        let corners = || faces.iter().flatten().copied();
        let low = corners().fold(DVec3::INFINITY, DVec3::min);
        let high = corners().fold(DVec3::NEG_INFINITY, DVec3::max);
        Self { faces, low, high }
    }

    /// Whether it holds `point`.
    pub(super) fn holds(&self, point: DVec3) -> bool {
        // Outside of the bounding box nothing winds around a point.
        let inside = point.cmpge(self.low).all() && point.cmple(self.high).all();
        inside && winding_number(point, &self.faces) > 0.5
    }

    /// Whether `point` is within `share` of the radius from the skin.
    pub(super) fn has_skin_at(&self, point: DVec3, share: f64) -> bool {
        let near = share * (self.high - self.low).max_element() / 2.0;
        let box_distance = (self.low - point).max(point - self.high).max_element();
        box_distance <= near
            && self.faces.iter().any(|&face| distance_to_triangle(point, face) <= near)
    }

    /// Whether the outline seen from `eye` passes within `near` pixels of `at`; `project`
    /// takes a point before the near plane, whose distance along `forward` is given, to pixels.
    pub(super) fn has_outline_at(&self, at: DVec2, near: f64, view: &View) -> bool {
        let faces_eye = |[a, b, c]: [DVec3; 3]| (b - a).cross(c - a).dot(view.eye - a) > 0.0;
        let fronts = self.faces.iter().filter(|&&face| faces_eye(face));
        // An edge is of the outline if only one of its two faces faces the eye.
        let mut edges: Vec<[[u64; 3]; 2]> = Vec::new();
        let bits = |corner: DVec3| corner.to_array().map(f64::to_bits);
        for [a, b, c] in fronts.map(|face| face.map(bits)) {
            edges.extend([[a, b], [b, c], [c, a]]);
        }
        edges.sort_unstable();
        let alone = edges.iter().filter(|[a, b]| edges.binary_search(&[*b, *a]).is_err());
        alone.copied().any(|edge| {
            let ends = view
                .segment(edge.map(|bits: [u64; 3]| DVec3::from_array(bits.map(f64::from_bits))));
            ends.is_some_and(|[a, b]| distance_to_segment(at, a, b) <= near)
        })
    }
}

/// A camera in f64.
pub(super) struct View {
    pub(super) eye: DVec3,
    pub(super) right: DVec3,
    pub(super) up: DVec3,
    pub(super) forward: DVec3,
    pub(super) near: f64,
    pub(super) focal_px: f64,
    pub(super) middle: DVec2,
}

impl View {
    /// The ends in pixels of the part of a segment beyond the near plane.
    fn segment(&self, [a, b]: [DVec3; 2]) -> Option<[DVec2; 2]> {
        let [to_a, to_b] = [a, b].map(|at| (at - self.eye).dot(self.forward) - self.near);
        if to_a < 0.0 && to_b < 0.0 {
            return None;
        }
        let cut = a + (b - a) * (to_a / (to_a - to_b));
        let ends = [if to_a < 0.0 { cut } else { a }, if to_b < 0.0 { cut } else { b }];
        Some(ends.map(|at| {
            let from_eye = at - self.eye;
            let along = from_eye.dot(self.forward).max(self.near * 0.5);
            let at = DVec2::new(from_eye.dot(self.right), -from_eye.dot(self.up));
            self.middle + at * (self.focal_px / along)
        }))
    }
}

fn distance_to_segment(at: DVec2, a: DVec2, b: DVec2) -> f64 {
    let along = b - a;
    let share = (at - a).dot(along) / along.length_squared().max(f64::MIN_POSITIVE);
    at.distance(a + along * share.clamp(0.0, 1.0))
}

fn distance_to_triangle(at: DVec3, [a, b, c]: [DVec3; 3]) -> f64 {
    let normal = (b - a).cross(c - a).normalize_or_zero();
    let beside = |from: DVec3, to: DVec3| normal.cross(to - from).dot(at - from) >= 0.0;
    if normal != DVec3::ZERO && beside(a, b) && beside(b, c) && beside(c, a) {
        return (at - a).dot(normal).abs();
    }
    let to_edge = |from: DVec3, to: DVec3| {
        let along = to - from;
        let share = (at - from).dot(along) / along.length_squared().max(f64::MIN_POSITIVE);
        at.distance(from + along * share.clamp(0.0, 1.0))
    };
    to_edge(a, b).min(to_edge(b, c)).min(to_edge(c, a))
}

#[test]
fn the_oracle_knows_inside_from_outside() {
    let mut surfaces = super::shapes::Surfaces::default();
    surfaces.add_box(Vec3::ZERO, Vec3::ONE);
    let faces: Vec<_> = surfaces.faces(0).map(|face| face.map(Vec3::as_dvec3)).collect();
    for (x, number) in [(-0.5, 0.0), (0.01, 1.0), (0.99, 1.0), (1.01, 0.0)] {
        let found = winding_number(DVec3::new(x, 0.3, 0.6), &faces);
        assert!((found - number).abs() < 1e-9, "{x}: {found}");
    }
    assert!((distance_to_triangle(DVec3::new(0.6, 0.3, 1.5), faces[2]) - 0.5).abs() < 1e-12);
}
