//! The presets that come with the library.

/// A shipped style with a name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Preset {
    /// Soft light, fine grain, edges that stay where they are.
    Portrait,
    /// Wet clouds on rough paper.
    Landscape,
    /// Few colours, strong edges, much bare paper.
    Sketch,
}

impl Preset {
    /// All presets, in the order in which programs list them.
    pub const ALL: [Self; 3] = [Self::Portrait, Self::Landscape, Self::Sketch];

    /// The name in lower case, which `parse` accepts.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Portrait => "portrait",
            Self::Landscape => "landscape",
            Self::Sketch => "sketch",
        }
    }

    /// The TOML file of the preset, with a comment above each key.
    #[must_use]
    pub fn text(self) -> &'static str {
        match self {
            Self::Portrait => include_str!("../presets/portrait.toml"),
            Self::Landscape => include_str!("../presets/landscape.toml"),
            Self::Sketch => include_str!("../presets/sketch.toml"),
        }
    }
}
