//! How high a film stands from its rim inwards.

/// The shape of a film across its rim: thin at the edge, with a ridge behind it, as paint that
/// dries from its rim leaves it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FilmProfile {
    /// Width over which the film rises, in radii of its volume, 0 to 1.
    pub rim: f32,
    /// How much higher the film is near its rim, 0 to 4.
    pub edge: f32,
    /// Product of the normals of a point and of its volume's cell below which the film leaves the
    /// point out, -1 to 1.
    pub gate: f32,
}

impl Default for FilmProfile {
    /// A rim of 0.15 radii, an edge of 0.5 and a gate of -0.2.
    fn default() -> Self {
        Self { rim: 0.15, edge: 0.5, gate: -0.2 }
    }
}

/// Narrowest rim in radii, which keeps divisions finite.
const NARROWEST: f32 = 1e-4;

/// Height at the very edge of a film whose rim is not wider than usual.
const LEAST: f32 = 0.25;

impl FilmProfile {
    /// Height relative to that of a film without rim, at a depth of `depth` radii inside of the
    /// farthest reach of the volume: a quarter at its very edge, less for rims wider than usual, and
    /// 1 far inside.
    #[must_use]
    #[inline]
    pub fn height(&self, depth: f32) -> f32 {
        let rims = depth / self.rim.max(NARROWEST);
        // Most of a film lies there.
        if rims >= 3.0 {
            return 1.0;
        }
        // Volumes with wide rims blend where they meet.
        let least = LEAST * (Self::default().rim / self.rim.max(NARROWEST)).min(1.0);
        let risen = least + (1.0 - least) * smooth_step(rims);
        risen * (1.0 + self.edge * (1.0 - smooth_step(rims * (1.0 / 3.0))))
    }

    /// The most that [`Self::height`] can be.
    #[must_use]
    pub fn most(&self) -> f32 {
        1.0 + self.edge.max(0.0)
    }
}

/// Rises from 0 to 1 where `at` does, with slopes of 0 at both ends.
#[inline]
pub(super) fn smooth_step(at: f32) -> f32 {
    let at = at.clamp(0.0, 1.0);
    at * at * (3.0 - 2.0 * at)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn films_rise_over_the_rim_stand_higher_behind_it_and_are_level_inside() {
        let profile = FilmProfile::default();
        let at = |radii: f32| profile.height(radii);
        assert_eq!(at(0.0), 0.25 * 1.5);
        assert_eq!(at(0.45), 1.0);
        assert_eq!(at(2.0), 1.0);
        assert!(at(0.15) > 1.25 && at(0.05) < at(0.1), "{}", at(0.15));
        let most = (0..1000).map(|i| at(i as f32 / 1000.0)).fold(0.0, f32::max);
        assert!(most <= profile.most() && most > 1.2, "{most}");
        let wide = FilmProfile { rim: 1.0, edge: 0.0, ..profile };
        assert!(wide.height(0.0) < 0.04 && wide.height(1.0) == 1.0, "{}", wide.height(0.0));
        let hard = FilmProfile { rim: 0.0, edge: 0.0, ..profile };
        assert_eq!(hard.height(0.01), 1.0);
        assert!(hard.height(0.0).is_finite());
    }
}
