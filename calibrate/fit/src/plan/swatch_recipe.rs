//! Recipe of a planned swatch, in whole parts.

use super::paints::PaintSet;
use pigment::{PigmentId, Recipe};

/// Paints of a planned swatch with their parts.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SwatchRecipe {
    /// Reason why the swatch is in the plan.
    pub purpose: Purpose,
    /// Paints of the set with their parts, 1 and up.
    pub parts: Vec<(PigmentId, u32)>,
}

/// Reason why a swatch is in the plan.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Purpose {
    /// One paint by itself.
    Masstone,
    /// One paint lightened with the white.
    Tint,
    /// One colour darkened with the black.
    Shade,
    /// Two colours mixed.
    Cross,
    /// Two colours lightened with the white.
    CrossTint,
}

impl SwatchRecipe {
    /// Paints with their shares, sum 1.
    #[must_use]
    pub fn shares(&self) -> Recipe {
        let total = f64::from(self.total());
        self.parts.iter().map(|&(paint, parts)| (paint, f64::from(parts) / total)).collect()
    }

    /// Smallest share of any paint.
    #[must_use]
    pub fn least_share(&self) -> f64 {
        self.shares().iter().map(|(_, share)| *share).fold(1.0, f64::min)
    }

    /// Sum of all parts.
    #[must_use]
    pub fn total(&self) -> u32 {
        self.parts.iter().map(|(_, parts)| parts).sum()
    }

    /// Name of the recipe, such as `Cobalt Blue tint 1:4`.
    #[must_use]
    pub fn name(&self, paints: &PaintSet) -> String {
        let names: Vec<&str> = self.parts.iter().map(|(paint, _)| paints.name(*paint)).collect();
        let ratio: Vec<String> = self.parts.iter().map(|(_, parts)| parts.to_string()).collect();
        let ratio = ratio.join(":");
        match self.purpose {
            Purpose::Masstone => format!("{} masstone", names[0]),
            Purpose::Tint => format!("{} tint {ratio}", names[0]),
            Purpose::Shade => format!("{} shade {ratio}", names[0]),
            Purpose::Cross => format!("{} x {} {ratio}", names[0], names[1]),
            Purpose::CrossTint => format!("{} x {} tint {ratio}", names[0], names[1]),
        }
    }
}

impl Purpose {
    /// Purpose in a word or two.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Masstone => "masstone",
            Self::Tint => "tint",
            Self::Shade => "shade",
            Self::Cross => "cross",
            Self::CrossTint => "cross tint",
        }
    }

    /// Information that the swatch gives, in a few words.
    #[must_use]
    pub fn why(self) -> &'static str {
        match self {
            Self::Masstone => "K/S of the paint itself",
            Self::Tint => "ties K and S to the white's S",
            Self::Shade => "S against a known K",
            Self::Cross => "K of one against S of the other; checks the mixing",
            Self::CrossTint => "two colours where both show; checks the mixing",
        }
    }
}
