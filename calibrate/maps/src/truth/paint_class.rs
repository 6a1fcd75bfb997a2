//! Kinds of pixels by the paint that is seen.

/// Part of the ground from which a film is thin.
const THIN: f64 = 0.05;
/// Part of the ground from which no paint is seen.
const BARE: f64 = 0.95;
/// Part of all paint that one layer must have to be seen alone.
const ALONE: f64 = 0.95;
/// Share error between a pixel and its blurred neighbourhood from which it lies at an edge.
const EDGE: f64 = 0.1;

/// Kind of a pixel by the paint that is seen.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[repr(u8)]
pub enum PaintClass {
    /// One layer of one mixture hides all below it: what maps take for granted.
    Hiding = 0,
    /// Two layers or more are seen through each other, such as a glaze on white.
    Glaze = 1,
    /// The ground shows through by 5 % or more.
    Thin = 2,
    /// The ground shows by 95 % or more.
    Bare = 3,
    /// The blur of the camera joins paints of other shares: an edge.
    Edge = 4,
}

impl PaintClass {
    /// Every class in the order of its number.
    pub const ALL: [Self; 5] = [Self::Hiding, Self::Glaze, Self::Thin, Self::Bare, Self::Edge];

    /// Number that files store.
    #[must_use]
    pub const fn code(self) -> u8 {
        self as u8
    }

    /// Class of a stored number.
    #[must_use]
    pub fn from_code(code: u8) -> Option<Self> {
        Self::ALL.get(usize::from(code)).copied()
    }

    /// Name in files and tables.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Hiding => "hiding",
            Self::Glaze => "glaze",
            Self::Thin => "thin",
            Self::Bare => "bare",
            Self::Edge => "edge",
        }
    }

    /// Class of a pixel. `ground` is the part of it that shows the ground, `greatest` the part of the paint
    /// seen that belongs to one layer, the one seen most. `apart` is half the sum of the absolute
    /// differences between its own shares and the blurred ones.
    #[must_use]
    pub fn of(ground: f64, greatest: f64, apart: f64) -> Self {
        match (ground, greatest, apart) {
            (ground, ..) if ground >= BARE => Self::Bare,
            (ground, ..) if ground >= THIN => Self::Thin,
            (_, _, apart) if apart > EDGE => Self::Edge,
            (_, greatest, _) if greatest < ALONE => Self::Glaze,
            _ => Self::Hiding,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn classes_survive_their_numbers_and_follow_the_paint() {
        for class in PaintClass::ALL {
            assert_eq!(PaintClass::from_code(class.code()), Some(class));
        }
        assert_eq!(PaintClass::from_code(5), None);
        assert_eq!(PaintClass::of(0.97, 1.0, 0.0), PaintClass::Bare);
        assert_eq!(PaintClass::of(0.2, 1.0, 0.0), PaintClass::Thin);
        assert_eq!(PaintClass::of(0.01, 0.6, 0.0), PaintClass::Glaze);
        assert_eq!(PaintClass::of(0.01, 0.99, 0.3), PaintClass::Edge);
        assert_eq!(PaintClass::of(0.01, 0.99, 0.02), PaintClass::Hiding);
    }
}
