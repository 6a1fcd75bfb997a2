//! A swatch's recipe, in whole parts.

use super::palette::Palette;

/// Paints with their parts.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Recipe {
    /// What the swatch is for.
    pub purpose: Purpose,
    /// Paint by its place in the palette, with its parts.
    pub parts: Vec<(usize, u32)>,
}

/// Why a swatch is in the plan.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Purpose {
    /// A paint by itself.
    Masstone,
    /// A paint let down with the white.
    Tint,
    /// A colour darkened with the black.
    Shade,
    /// Two colours.
    Cross,
    /// Two colours and the white.
    CrossTint,
}

impl Recipe {
    /// Share of each paint, sum 1.
    #[must_use]
    pub fn shares(&self) -> Vec<(usize, f64)> {
        let total = f64::from(self.total());
        self.parts.iter().map(|&(paint, parts)| (paint, f64::from(parts) / total)).collect()
    }

    /// The smallest share.
    #[must_use]
    pub fn least_share(&self) -> f64 {
        self.shares().iter().map(|(_, share)| *share).fold(1.0, f64::min)
    }

    /// Sum of the parts.
    #[must_use]
    pub fn total(&self) -> u32 {
        self.parts.iter().map(|(_, parts)| parts).sum()
    }

    /// Such as `Cobalt Blue tint 1:4`.
    #[must_use]
    pub fn name(&self, palette: &Palette) -> String {
        let names: Vec<&str> =
            self.parts.iter().map(|(paint, _)| palette.names[*paint].as_str()).collect();
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
    /// The purpose in a word.
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

    /// What the swatch tells, in a few words.
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
