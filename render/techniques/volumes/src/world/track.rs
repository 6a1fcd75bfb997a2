//! Where something that moves is at a time.

use glam::Vec3;

use super::error::WorldError;
use crate::saved::{Reader, Stored};

/// A place, or places at times with straight lines between.
#[derive(Debug, Clone, PartialEq)]
pub struct Track {
    knots: Vec<(f64, Vec3)>,
}

impl Track {
    /// A place that stays, in the unit of the scene.
    #[must_use]
    pub fn at(place: Vec3) -> Self {
        Self { knots: vec![(0.0, place)] }
    }

    /// Places (in the unit of the scene) at rising times in seconds; before the first and after
    /// the last time the place stays.
    ///
    /// # Errors
    /// If there is no place, a number is not finite, or the times do not rise.
    pub fn along(knots: Vec<(f64, Vec3)>) -> Result<Self, WorldError> {
        let number =
            |key, found| Err(WorldError::Number { key, range: "finite and rising", found });
        let mut last = f64::NEG_INFINITY;
        for (seconds, place) in &knots {
            if !(seconds.is_finite() && *seconds > last) {
                return number("a time of the path", *seconds);
            }
            if !place.is_finite() {
                return number("a place of the path", f64::from(place.element_sum()));
            }
            last = *seconds;
        }
        if knots.is_empty() {
            return number("a path without places", f64::NAN);
        }
        Ok(Self { knots })
    }

    /// The place after `seconds`.
    #[must_use]
    pub fn after(&self, seconds: f64) -> Vec3 {
        let next = self.knots.partition_point(|(time, _)| *time <= seconds);
        match (next.checked_sub(1).map(|last| self.knots[last]), self.knots.get(next)) {
            (Some((from, a)), Some((to, b))) => {
                a + (*b - a) * ((seconds - from) / (to - from)) as f32
            }
            (Some((_, place)), None) => place,
            (None, first) => first.map_or(Vec3::ZERO, |(_, place)| *place),
        }
    }

    /// The places that it turns at.
    pub fn places(&self) -> impl Iterator<Item = Vec3> + '_ {
        self.knots.iter().map(|(_, place)| *place)
    }
}

impl Stored for Track {
    fn store(&self, bytes: &mut Vec<u8>) {
        self.knots.store(bytes);
    }

    fn read(from: &mut Reader<'_>) -> Option<Self> {
        Self::along(Stored::read(from)?).ok()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_track_stays_before_and_after_its_times() {
        let track = Track::along(vec![(1.0, Vec3::X), (3.0, Vec3::Y)]).unwrap();
        for (seconds, place) in [(0.0, Vec3::X), (2.0, (Vec3::X + Vec3::Y) / 2.0), (9.0, Vec3::Y)] {
            assert_eq!(track.after(seconds), place);
        }
        for times in [vec![], vec![1.0, 1.0], vec![f64::NAN]] {
            let knots = times.into_iter().map(|time| (time, Vec3::ZERO)).collect();
            assert!(Track::along(knots).is_err());
        }
    }
}
