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
    /// Separate round touches, close together.
    Pointillist,
    /// Broad slabs with hard edges.
    Knife,
    /// Thin long strokes that lie along the form.
    Fur,
    /// Long strokes that swirl, flow and twinkle.
    Night,
}

impl Preset {
    /// All presets, in the order in which programs list them.
    pub const ALL: [Self; 7] = [
        Self::Impressionist,
        Self::Pointillist,
        Self::Knife,
        Self::Hatching,
        Self::Fur,
        Self::Night,
        Self::Paper,
    ];

    /// The name in lower case, which `parse` accepts.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Paper => "paper",
            Self::Impressionist => "impressionist",
            Self::Hatching => "hatching",
            Self::Pointillist => "pointillist",
            Self::Knife => "knife",
            Self::Fur => "fur",
            Self::Night => "night",
        }
    }

    /// Name of the style of samples that suits the preset
    /// ([`Style::named`](artmap::painted::Style::named)).
    #[must_use]
    pub fn style(self) -> &'static str {
        match self {
            Self::Paper | Self::Impressionist => "oil-flat",
            Self::Hatching => "hatching",
            Self::Pointillist => "dabs",
            Self::Knife => "knife",
            Self::Fur | Self::Night => "oil-long",
        }
    }

    /// The TOML file of the preset, with a comment above each key.
    #[must_use]
    pub fn text(self) -> &'static str {
        match self {
            Self::Paper => include_str!("../presets/paper.toml"),
            Self::Impressionist => include_str!("../presets/impressionist.toml"),
            Self::Hatching => include_str!("../presets/hatching.toml"),
            Self::Pointillist => include_str!("../presets/pointillist.toml"),
            Self::Knife => include_str!("../presets/knife.toml"),
            Self::Fur => include_str!("../presets/fur.toml"),
            Self::Night => include_str!("../presets/night.toml"),
        }
    }
}
