//! The presets that come with the library.

/// A shipped style with a name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Preset {
    /// As Yan, Chi, Lee and Lin (2008) published it.
    Paper,
    /// Short strokes along the form, each seen.
    Impressionist,
    /// Lines around the form.
    Hatching,
}

impl Preset {
    /// All presets, in the order in which programs list them.
    pub const ALL: [Self; 3] = [Self::Impressionist, Self::Hatching, Self::Paper];

    /// The name in lower case, which `parse` accepts.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Paper => "paper",
            Self::Impressionist => "impressionist",
            Self::Hatching => "hatching",
        }
    }

    /// The TOML file of the preset, with a comment above each key.
    #[must_use]
    pub fn text(self) -> &'static str {
        match self {
            Self::Paper => include_str!("../presets/paper.toml"),
            Self::Impressionist => include_str!("../presets/impressionist.toml"),
            Self::Hatching => include_str!("../presets/hatching.toml"),
        }
    }
}
