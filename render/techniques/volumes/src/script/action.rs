//! Actions on a world of volumes.

use std::collections::BTreeMap;

use super::rows::Ball;

/// Pigments by their letters in the palette, with their parts. Without a palette it is empty.
pub type Recipe = BTreeMap<String, f64>;

/// An action on a world of volumes. Within one step, we do actions in the order of these variants,
/// and several of one kind in the order of the script.
#[derive(Debug, Clone, PartialEq)]
pub enum Action {
    /// A single volume begins.
    Volume(NewVolume),
    /// Paint is poured.
    Pour(Pour),
    /// Air pushes volumes.
    Push(Push),
    /// A sponge takes paint up.
    Lift(Lift),
    /// Single volumes become volumes of the grid.
    Split(Split),
    /// Paint on the scene dries.
    Dry(Dry),
}

/// Where you pour or lift paint.
#[derive(Debug, Clone, PartialEq)]
pub enum Place {
    /// At a place in the unit of the scene.
    At([f64; 3]),
    /// At what the first picture shows. You give shares of its width from the left and its height
    /// from the top.
    Picked([f64; 2]),
    /// Along a path, straight from point to point. It rests before the first and after the last
    /// point.
    Path(Vec<PathPoint>),
}

/// A point of a path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PathPoint {
    /// Seconds since the start of the action.
    pub seconds: f64,
    /// Place in the unit of the scene.
    pub at: [f64; 3],
}

/// How much paint is poured.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Quantity {
    /// In mm3, evenly over the duration.
    Amount(f64),
    /// In mm3 per second.
    Rate(f64),
}

/// Paint that you pour.
#[derive(Debug, Clone, PartialEq)]
pub struct Pour {
    /// Where it is poured.
    pub place: Place,
    /// How much is poured.
    pub quantity: Quantity,
    /// Pigments of its paint.
    pub recipe: Recipe,
    /// Index of the region of its volumes.
    pub region: usize,
}

/// A single volume.
#[derive(Debug, Clone, PartialEq)]
pub struct NewVolume {
    /// Its centre in the unit of the scene.
    pub center: [f64; 3],
    /// Its radius in the unit of the scene, above 0.
    pub radius: f64,
    /// Level of detail of its mesh.
    pub detail: u8,
    /// Pigments of its paint.
    pub recipe: Recipe,
    /// Index of its region.
    pub region: usize,
}

/// Air that pushes the volumes in a ball, e.g. from a straw.
#[derive(Debug, Clone, PartialEq)]
pub struct Push {
    /// Centre of the ball in the unit of the scene.
    pub at: [f64; 3],
    /// Direction of any length above 0.
    pub towards: [f64; 3],
    /// Radius of the ball in the unit of the scene.
    pub radius: f64,
    /// Acceleration in cells per second squared.
    pub strength: f64,
}

/// A sponge that takes paint up.
#[derive(Debug, Clone, PartialEq)]
pub struct Lift {
    /// Where it is pressed.
    pub place: Place,
    /// Its radius in the unit of the scene.
    pub radius: f64,
    /// Share of the paint below it that it takes up per second, 0 to 120.
    pub rate: f64,
}

/// Single volumes become volumes of the grid.
#[derive(Debug, Clone, PartialEq)]
pub struct Split {
    /// Index of the single volume in the order of the script. If you leave this out, all split.
    pub volume: Option<usize>,
}

/// Paint that dries.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Dry {
    /// The volumes in this ball dry, in the unit of the scene. If you leave this out, all dry.
    pub ball: Option<Ball>,
}

impl Action {
    pub(crate) fn rank(&self) -> usize {
        match self {
            Self::Volume(_) => 0,
            Self::Pour(_) => 1,
            Self::Push(_) => 2,
            Self::Lift(_) => 3,
            Self::Split(_) => 4,
            Self::Dry(_) => 5,
        }
    }
}

impl Place {
    /// The place in the unit of the scene, `seconds` after the start of the action. `None` if you
    /// pick it in a picture.
    #[must_use]
    pub fn at(&self, seconds: f64) -> Option<[f64; 3]> {
        let points = match self {
            Self::At(at) => return Some(*at),
            Self::Picked(_) => return None,
            Self::Path(points) => points,
        };
        let next = points.partition_point(|point| point.seconds <= seconds);
        let before = points.get(next.wrapping_sub(1));
        let after = points.get(next);
        let (Some(before), Some(after)) = (before, after) else {
            return before.or(after).map(|point| point.at);
        };
        let share = (seconds - before.seconds) / (after.seconds - before.seconds);
        Some(
            [0, 1, 2]
                .map(|axis: usize| before.at[axis] + (after.at[axis] - before.at[axis]) * share),
        )
    }
}

impl Quantity {
    /// The whole amount in mm3 over `seconds`.
    #[must_use]
    pub fn amount_mm3(self, seconds: f64) -> f64 {
        match self {
            Self::Amount(amount) => amount,
            Self::Rate(rate) => rate * seconds,
        }
    }

    /// The amount per second in mm3/s, if you pour paint for `seconds`, above 0.
    #[must_use]
    pub fn rate_mm3_s(self, seconds: f64) -> f64 {
        match self {
            Self::Amount(amount) => amount / seconds,
            Self::Rate(rate) => rate,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_is_straight_between_its_points_and_rests_at_its_ends() {
        fn point(seconds: f64, x: f64) -> PathPoint {
            PathPoint { seconds, at: [x, 0.0, 1.0] }
        }
        let path = Place::Path(vec![point(1.0, 2.0), point(3.0, 6.0)]);
        for (seconds, x) in [(0.0, 2.0), (1.0, 2.0), (1.5, 3.0), (3.0, 6.0), (9.0, 6.0)] {
            assert_eq!(path.at(seconds), Some([x, 0.0, 1.0]), "{seconds}");
        }
        assert_eq!(Place::Picked([0.5; 2]).at(1.0), None);
        assert_eq!(Quantity::Rate(40.0).amount_mm3(2.0), 80.0);
        assert_eq!(Quantity::Amount(40.0).rate_mm3_s(2.0), 20.0);
    }
}
