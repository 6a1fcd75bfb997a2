//! The shapes of heads, and their proportions.

use std::fmt;
use std::str::FromStr;

/// How many nodes a spine has, the one in the ferrule included.
pub(super) const NODES: usize = 6;

/// The shape of a head, by its name in the trade.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum HeadShape {
    /// A round belly that ends in a point.
    Round,
    /// A long bar with a straight edge.
    Flat,
    /// A flat with an oval tip.
    Filbert,
    /// A short, stiff flat.
    Bright,
    /// Thin tufts spread over an arc.
    Fan,
    /// A very long, thin round for lines.
    Rigger,
    /// A soft and full round.
    Mop,
    /// A rigid trowel blade with a straight edge.
    Knife,
}

impl HeadShape {
    /// All shapes.
    pub const ALL: [Self; 8] = [
        Self::Round,
        Self::Flat,
        Self::Filbert,
        Self::Bright,
        Self::Fan,
        Self::Rigger,
        Self::Mop,
        Self::Knife,
    ];

    /// Its name, as files and options have it.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Round => "round",
            Self::Flat => "flat",
            Self::Filbert => "filbert",
            Self::Bright => "bright",
            Self::Fan => "fan",
            Self::Rigger => "rigger",
            Self::Mop => "mop",
            Self::Knife => "knife",
        }
    }

    /// Its contour seen from the broad side, from the ferrule to the tip: distance
    /// from the ferrule, and half the width there, in widths of the head.
    #[must_use]
    pub fn contour(self) -> Vec<(f32, f32)> {
        let of = self.proportions();
        let point = |node: usize| {
            let share = node as f32 / (NODES - 1) as f32;
            let spread = of.root + (1.0 - of.root) * share;
            (of.length * share, 0.5 * of.width[node] * spread)
        };
        (0..NODES).map(point).collect()
    }

    pub(super) fn proportions(self) -> &'static Proportions {
        match self {
            Self::Round => &ROUND,
            Self::Flat => &FLAT,
            Self::Filbert => &FILBERT,
            Self::Bright => &BRIGHT,
            Self::Fan => &FAN,
            Self::Rigger => &RIGGER,
            Self::Mop => &MOP,
            Self::Knife => &KNIFE,
        }
    }
}

impl fmt::Display for HeadShape {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for HeadShape {
    type Err = UnknownShape;

    fn from_str(name: &str) -> Result<Self, UnknownShape> {
        let found = Self::ALL.into_iter().find(|shape| shape.name() == name);
        found.ok_or_else(|| UnknownShape { name: name.to_owned() })
    }
}

/// A name that no head has.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("no brush has this shape: `{name}`")]
pub struct UnknownShape {
    /// As it was given.
    pub name: String,
}

impl UnknownShape {
    /// The names there are.
    #[must_use]
    pub fn hint(&self) -> String {
        format!("shapes are {}", HeadShape::ALL.map(HeadShape::name).join(", "))
    }
}

/// A head in widths of itself. Profiles run from the ferrule to the tip.
///
/// Lengths are as catalogues of artists' brushes show them: a bright about as
/// long as wide, a flat and a filbert 1.5 times, a round 2.5, a rigger 6. How a
/// head gives, stiffens and splays, and how uneven its bristles are, is ours, chosen by
/// eye.
#[derive(Debug)]
pub(super) struct Proportions {
    /// From the ferrule to the tip.
    pub(super) length: f32,
    /// Of the thickest place.
    pub(super) thickness: f32,
    /// Spines side by side.
    pub(super) spines: usize,
    /// Width where the spines leave the ferrule, as a share of that at the tip.
    pub(super) root: f32,
    /// How far full pressure lowers the ferrule, as a share of its height.
    pub(super) give: f32,
    /// Which share of a bend is straightened in one iteration, at the ferrule.
    pub(super) stiffness: f32,
    /// How much wider full pressure makes it where it lies on the canvas.
    pub(super) splay: f32,
    /// Width along the head.
    pub(super) width: [f32; NODES],
    /// Thickness along the head, as a share of the thickest place; 0 at the tip
    /// closes it.
    pub(super) depth: [f32; NODES],
    /// Tufts with gaps between them.
    pub(super) gaps: bool,
    /// It does not bend.
    pub(super) rigid: bool,
    /// How far bristles draw back at most from where the surface is, in cells.
    pub(super) bristles: f32,
}

const ROUND: Proportions = Proportions {
    length: 2.5,
    thickness: 1.0,
    spines: 1,
    root: 1.0,
    give: 0.6,
    stiffness: 0.6,
    splay: 0.45,
    width: [0.82, 0.94, 1.0, 0.9, 0.6, 0.0],
    depth: [0.82, 0.94, 1.0, 0.9, 0.6, 0.0],
    gaps: false,
    rigid: false,
    bristles: 0.5,
};

const FLAT: Proportions = Proportions {
    length: 1.5,
    thickness: 0.3,
    spines: 5,
    width: [1.0, 1.0, 1.0, 1.0, 1.0, 0.98],
    depth: [1.0, 0.95, 0.85, 0.65, 0.45, 0.0],
    splay: 0.2,
    bristles: 0.9,
    ..ROUND
};

const FILBERT: Proportions =
    Proportions { thickness: 0.35, width: [1.0, 1.0, 1.0, 0.96, 0.8, 0.4], splay: 0.3, ..FLAT };

const BRIGHT: Proportions =
    Proportions { length: 1.0, give: 0.4, stiffness: 0.8, splay: 0.15, ..FLAT };

const FAN: Proportions = Proportions {
    length: 0.9,
    thickness: 0.1,
    spines: 7,
    root: 0.3,
    give: 0.45,
    stiffness: 0.7,
    splay: 0.1,
    width: [1.0; NODES],
    depth: [1.0, 0.9, 0.8, 0.7, 0.6, 0.0],
    gaps: true,
    bristles: 0.3,
    ..FLAT
};

const RIGGER: Proportions = Proportions {
    length: 6.0,
    give: 0.4,
    stiffness: 0.4,
    splay: 0.3,
    width: [0.95, 1.0, 0.92, 0.8, 0.6, 0.0],
    depth: [0.95, 1.0, 0.92, 0.8, 0.6, 0.0],
    bristles: 0.0,
    ..ROUND
};

const MOP: Proportions = Proportions {
    length: 1.6,
    give: 0.5,
    stiffness: 0.3,
    splay: 0.8,
    width: [0.6, 0.9, 1.0, 1.0, 0.8, 0.0],
    depth: [0.6, 0.9, 1.0, 1.0, 0.8, 0.0],
    bristles: 0.3,
    ..ROUND
};

const KNIFE: Proportions = Proportions {
    length: 2.0,
    thickness: 0.03,
    spines: 3,
    splay: 0.0,
    width: [0.7, 0.9, 1.0, 1.0, 1.0, 1.0],
    depth: [1.0, 1.0, 1.0, 1.0, 1.0, 0.0],
    rigid: true,
    bristles: 0.0,
    ..FLAT
};

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_contour_is_as_long_and_wide_as_the_head() {
        for shape in HeadShape::ALL {
            let contour = shape.contour();
            let widest = contour.iter().map(|(_, half)| 2.0 * half).fold(0.0, f32::max);
            assert_eq!(contour[0].0, 0.0, "{shape}");
            assert_eq!(contour[NODES - 1].0, shape.proportions().length, "{shape}");
            assert!((0.98..=1.0).contains(&widest), "{shape} is {widest} wide");
        }
    }

    #[test]
    fn names_come_back_and_others_are_refused_with_a_list() {
        for shape in HeadShape::ALL {
            assert_eq!(shape.name().parse(), Ok(shape));
            assert_eq!(serde_json::to_string(&shape).unwrap(), format!("\"{shape}\""));
        }
        let error = "broom".parse::<HeadShape>().unwrap_err();
        assert_eq!(error.to_string(), "no brush has this shape: `broom`");
        assert!(error.hint().contains("round, flat, filbert, bright, fan, rigger, mop, knife"));
    }

    #[test]
    fn a_head_is_as_wide_as_its_size_somewhere_and_closed_at_its_tip() {
        for shape in HeadShape::ALL {
            let of = shape.proportions();
            let widest = of.width.iter().fold(0.0, |a: f32, &b| a.max(b));
            assert_eq!(widest, 1.0, "{shape}");
            assert_eq!(of.depth[NODES - 1], 0.0, "{shape}");
            assert!(of.spines > 1 || of.width[NODES - 1] == 0.0, "{shape}");
        }
    }
}
