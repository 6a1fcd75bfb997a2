//! Brush heads: bending spines that carry a surface with paint on it.
//!
//! We follow Baxter, Wendt and Lin 2004, section 3, and Baxter et al. 2001 ("DAB: interactive
//! haptic painting with 3D virtual brushes"): a head is a skeleton with a subdivision surface
//! around it. The skeleton lies on the canvas in equilibrium, without masses and springs. In each
//! sub-step you get one [`Contact`](super::contact::Contact) from this surface.
mod relief;
mod spines;
mod surface;
mod locks;
mod uptake;
mod footprint;
mod head;
mod tool;
mod mark;

#[cfg(test)]
mod tests;

use std::fmt;
use std::str::FromStr;

use documents::hint::Explain;

pub use head::Head;
pub use mark::ContactMark;
pub use relief::{BLOCK, Relief};
pub use surface::HeadMesh;
pub(crate) use tool::SideBySide;
pub use tool::{StrokeTool, ToolError};

/// Number of nodes of a spine, including the one in the ferrule.
const NODES: usize = 6;

/// Shape of a head, by its trade name.
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
    /// All shapes, in the order of declaration.
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

    /// Name in files and options.
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

    /// Contour seen from the broad side, from the ferrule to the tip. You get the distance from the
    /// ferrule and half the width there, in widths of the head.
    #[must_use]
    pub fn contour(self) -> Vec<(f32, f32)> {
        let of = self.proportions();
        (0..NODES)
            .map(|node: usize| {
                let share = node as f32 / (NODES - 1) as f32;
                let spread = of.root + (1.0 - of.root) * share;
                (of.length * share, 0.5 * of.width[node] * spread)
            })
            .collect()
    }

    fn proportions(self) -> &'static Proportions {
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

/// The name does not belong to a shape.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error, Explain)]
#[error("no brush has this shape: `{name}`")]
#[hint("shapes are {}", HeadShape::ALL.map(HeadShape::name).join(", "))]
pub struct UnknownShape {
    /// The unknown name.
    pub name: String,
}

/// Proportions of a head, in widths of the head. Profiles run from the ferrule to the tip.
///
/// Lengths follow catalogues of artists' brushes. For example, a bright is about as long as wide, a
/// flat and a filbert 1.5 times, a round 2.5, a rigger 6. We chose give, splay and the profiles
/// near the tip such that a head marks its own width at middle pressure. We chose the unevenness of
/// bristles by eye.
#[derive(Debug)]
struct Proportions {
    length: f32,
    /// Thickness at the thickest position.
    thickness: f32,
    /// Number of spines side by side.
    spines: usize,
    /// Width at which the spines leave the ferrule, as a fraction of the width at the tip.
    root: f32,
    /// Fraction of the hair that lies on the canvas at full pressure.
    give: f32,
    /// Relative increase of the width under full pressure, where the head lies on the canvas.
    splay: f32,
    width: [f32; NODES],
    /// Profile of the thickness along the head, as a fraction of the thickest position. 0 at
    /// the tip closes it.
    depth: [f32; NODES],
    /// Whether the head has tufts with gaps between them.
    gaps: bool,
    rigid: bool,
    /// Largest recess of bristles from the surface, in tenths of a mm.
    recess: f32,
    /// Variation of the coat between locks of hair, relative to its mean (chosen by measured
    /// furrows).
    variation: f32,
}

const ROUND: Proportions = Proportions {
    length: 2.5,
    thickness: 1.0,
    spines: 1,
    root: 1.0,
    give: 0.7,
    splay: 0.85,
    width: [0.82, 0.94, 1.0, 0.98, 0.87, 0.0],
    depth: [0.82, 0.94, 1.0, 0.98, 0.87, 0.0],
    gaps: false,
    rigid: false,
    recess: 0.5,
    variation: 0.6,
};

const FLAT: Proportions = Proportions {
    length: 1.5,
    thickness: 0.3,
    spines: 5,
    give: 0.6,
    width: [1.0, 1.0, 1.0, 1.0, 1.0, 0.98],
    depth: [1.0, 0.95, 0.85, 0.65, 0.45, 0.0],
    splay: 0.2,
    recess: 0.9,
    ..ROUND
};

const FILBERT: Proportions = Proportions {
    thickness: 0.35,
    give: 0.65,
    width: [1.0, 1.0, 1.0, 1.0, 0.97, 0.55],
    splay: 0.4,
    ..FLAT
};

const BRIGHT: Proportions = Proportions { length: 1.0, give: 0.4, splay: 0.15, ..FLAT };

const FAN: Proportions = Proportions {
    length: 0.9,
    thickness: 0.1,
    spines: 7,
    root: 0.3,
    give: 0.45,
    splay: 0.1,
    width: [1.0; NODES],
    depth: [1.0, 0.9, 0.8, 0.7, 0.6, 0.0],
    gaps: true,
    recess: 0.3,
    ..FLAT
};

const RIGGER: Proportions = Proportions {
    length: 6.0,
    give: 0.65,
    splay: 0.8,
    width: [0.95, 1.0, 1.0, 0.98, 0.94, 0.0],
    depth: [0.95, 1.0, 1.0, 0.98, 0.94, 0.0],
    recess: 0.0,
    ..ROUND
};

const MOP: Proportions = Proportions {
    length: 1.6,
    give: 0.6,
    splay: 1.0,
    width: [0.6, 0.9, 1.0, 1.0, 0.87, 0.0],
    depth: [0.6, 0.9, 1.0, 1.0, 0.87, 0.0],
    recess: 0.3,
    ..ROUND
};

const KNIFE: Proportions = Proportions {
    length: 2.0,
    thickness: 0.03,
    spines: 3,
    splay: 0.0,
    width: [0.7, 0.9, 1.0, 1.0, 1.0, 0.91],
    depth: [1.0, 1.0, 1.0, 1.0, 1.0, 0.0],
    rigid: true,
    recess: 0.0,
    variation: 0.12,
    ..FLAT
};

/// Why a head cannot be made.
#[derive(Debug, Clone, PartialEq, thiserror::Error, Explain)]
pub enum BrushError {
    /// The width of the head is out of range.
    #[error("a head is 0.2 to 100 mm wide: `{0}` mm")]
    #[hint("give the width of the head in mm, such as 6")]
    Size(f64),
    /// The width of a cell is not above 0.
    #[error("cells have a width above 0 mm: `{0}` mm")]
    #[hint("give the width of a cell in mm, such as 0.1")]
    Cell(f64),
    /// The head would have more cells than allowed.
    #[error("a head is at most 2048 cells wide: `{size_mm}` mm over cells of {cell_mm} mm")]
    #[hint("take a smaller brush or larger cells")]
    TooFine {
        /// Width of the head in mm.
        size_mm: f64,
        /// Width of a cell in mm.
        cell_mm: f64,
    },
}

#[cfg(test)]
mod shape_tests {
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
        let hint = error.hint().unwrap().to_string();
        assert!(hint.contains("round, flat, filbert, bright, fan, rigger, mop, knife"));
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
