//! Regions that volumes are kept in.

use glam::Vec3;

/// A convex region that holds every volume: its walls push particles back, and none passes them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum KeepIn {
    /// A box along the axes.
    Box {
        /// Its least corner.
        low: Vec3,
        /// Its greatest corner.
        high: Vec3,
    },
    /// A ball, with its inside.
    Ball {
        /// Centre in the unit of the scene.
        center: Vec3,
        /// Radius, above 0, in the unit of the scene.
        radius: f32,
    },
    /// The half of space above a plane.
    Above {
        /// A point of the plane.
        point: Vec3,
        /// The unit normal of the plane, towards the region.
        normal: Vec3,
    },
}

impl KeepIn {
    /// The way from `place` to the nearest point that is at least `inset` inside; zero for places
    /// farther inside.
    #[must_use]
    pub fn way_back(&self, place: Vec3, inset: f32) -> Vec3 {
        match *self {
            Self::Box { low, high } => {
                let middle = (low + high) * 0.5;
                let low = (low + inset).min(middle);
                let high = (high - inset).max(middle);
                place.max(low).min(high) - place
            }
            Self::Ball { center, radius } => {
                let from = place - center;
                let distance = from.dot(from).sqrt();
                let most = (radius - inset).max(0.0);
                if distance > most { from * (most / distance - 1.0) } else { Vec3::ZERO }
            }
            Self::Above { point, normal } => {
                normal * (inset - (place - point).dot(normal)).max(0.0)
            }
        }
    }

    /// The greatest share, 0 to 1, of the way from `center` to `center + offset` that lies inside; 0
    /// if `center` lies outside.
    #[must_use]
    pub fn share_inside(&self, center: Vec3, offset: Vec3) -> f32 {
        match *self {
            Self::Box { low, high } => {
                let mut share = 1.0;
                for axis in 0..3 {
                    let rise = high[axis] - center[axis];
                    let fall = center[axis] - low[axis];
                    share = within(rise, offset[axis], share);
                    share = within(fall, -offset[axis], share);
                }
                share
            }
            Self::Ball { center: middle, radius } => {
                let from = center - middle;
                let room = radius * radius - from.dot(from);
                let square = offset.dot(offset);
                let along = from.dot(offset);
                if room <= 0.0 {
                    return 0.0;
                }
                if square + 2.0 * along <= room {
                    return 1.0;
                }
                // The positive root of `square t^2 + 2 along t = room`, without cancellation.
                let root = (along * along + square * room).sqrt();
                if along > 0.0 { room / (along + root) } else { (root - along) / square }
            }
            Self::Above { point, normal } => {
                within((center - point).dot(normal), -offset.dot(normal), 1.0)
            }
        }
    }

    /// Whether the whole ball about `center` lies at least `inset` inside.
    pub(super) fn holds_ball(&self, center: Vec3, radius: f32, inset: f32) -> bool {
        let far = radius + inset;
        match *self {
            Self::Box { low, high } => {
                (center - low).cmpge(Vec3::splat(far)).all()
                    && (high - center).cmpge(Vec3::splat(far)).all()
            }
            Self::Ball { center: middle, radius } => {
                (center - middle).length_squared().sqrt() + far <= radius
            }
            Self::Above { point, normal } => (center - point).dot(normal) >= far,
        }
    }

    /// Its numbers, which tell two regions apart.
    pub(super) fn numbers(&self) -> [f32; 7] {
        let (kind, [a, b, c], [d, e, f]) = match *self {
            Self::Box { low, high } => (0.0, low.to_array(), high.to_array()),
            Self::Ball { center, radius } => (1.0, center.to_array(), [radius, 0.0, 0.0]),
            Self::Above { point, normal } => (2.0, point.to_array(), normal.to_array()),
        };
        [kind, a, b, c, d, e, f]
    }
}

/// The share of a way of `length` towards a wall that `room` allows, at most `share`.
fn within(room: f32, length: f32, share: f32) -> f32 {
    if room <= 0.0 {
        0.0
    } else if length * share > room {
        room / length
    } else {
        share
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn regions() -> [KeepIn; 3] {
        [
            KeepIn::Box { low: Vec3::splat(-1.0), high: Vec3::new(1.0, 2.0, 3.0) },
            KeepIn::Ball { center: Vec3::new(0.2, 0.1, 0.0), radius: 1.5 },
            KeepIn::Above { point: Vec3::new(0.0, -0.5, 0.0), normal: Vec3::new(0.6, 0.8, 0.0) },
        ]
    }

    #[test]
    fn the_share_inside_ends_at_the_wall() {
        let center = Vec3::new(0.3, 0.2, -0.1);
        for region in regions() {
            for offset in [Vec3::new(-3.0, -4.0, 1.0), Vec3::new(-0.1, 0.1, 0.0), Vec3::NEG_Y * 9.0]
            {
                let share = region.share_inside(center, offset);
                let end = center + offset * share;
                assert!(region.way_back(end, 0.0).length() < 1e-5, "{region:?} {offset}");
                let further = center + offset * (share * 1.01);
                assert!(
                    share == 1.0 || region.way_back(further, 0.0).length() > 1e-4,
                    "{region:?}"
                );
            }
            assert_eq!(region.share_inside(Vec3::new(-9.0, -9.0, 0.0), Vec3::X), 0.0);
        }
    }

    #[test]
    fn the_way_back_leads_inside_and_no_farther() {
        for region in regions() {
            let place = Vec3::new(-4.0, -3.0, 0.5);
            let back = place + region.way_back(place, 0.25);
            assert!(region.way_back(back, 0.2499).length() < 1e-6, "{region:?}");
            assert!(region.way_back(back, 0.26).length() > 0.005, "{region:?}");
            assert!(region.holds_ball(Vec3::new(0.2, 0.4, 0.0), 0.3, 0.1), "{region:?}");
            assert!(!region.holds_ball(Vec3::new(0.2, 0.4, 0.0), 2.0, 0.1), "{region:?}");
        }
    }
}
