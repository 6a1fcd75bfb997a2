//! The presets that come with the library.

use serde::{Deserialize, Serialize};

/// A shipped style with a name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Preset {
    /// Pencil hatching and own colours with a hard edge, after ten Bosch (2005).
    Sketch,
    /// Four shells: colour washes out towards the rim.
    Washed,
    /// A grey drawing, tinted, with a glow of colour at the core.
    Tinted,
    /// Glazes of pigments over a grisaille.
    Grisaille,
    /// Paint that frays along the microstructure of the surface.
    Bleed,
}

impl Preset {
    /// All presets, in the order in which programs list them.
    pub const ALL: [Self; 5] =
        [Self::Sketch, Self::Washed, Self::Tinted, Self::Grisaille, Self::Bleed];

    /// The name in lower case, which `parse` accepts.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Sketch => "sketch",
            Self::Washed => "washed",
            Self::Tinted => "tinted",
            Self::Grisaille => "grisaille",
            Self::Bleed => "bleed",
        }
    }

    /// A sentence on the style.
    #[must_use]
    pub fn about(self) -> &'static str {
        match self {
            Self::Sketch => "Sketch: a pencil drawing whose own colours return with a hard edge.",
            Self::Washed => "Washed: colour in four steps, which washes out towards the rim.",
            Self::Tinted => "Tinted: a drawing with a breath of colour, which glows at the core.",
            Self::Grisaille => "Grisaille: glazes of pigments over an underpainting in greys.",
            Self::Bleed => "Bleed: paint that frays along the grain of the surface.",
        }
    }

    /// The TOML file of the preset, with a comment above each key.
    #[must_use]
    pub fn text(self) -> &'static str {
        match self {
            Self::Sketch => include_str!("../presets/sketch.toml"),
            Self::Washed => include_str!("../presets/washed.toml"),
            Self::Tinted => include_str!("../presets/tinted.toml"),
            Self::Grisaille => include_str!("../presets/grisaille.toml"),
            Self::Bleed => include_str!("../presets/bleed.toml"),
        }
    }
}
