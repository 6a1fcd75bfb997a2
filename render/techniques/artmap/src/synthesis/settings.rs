//! Settings and errors of the synthesis.

use documents::hint::{Explain, Fault, Hint};
use serde::{Deserialize, Serialize};

/// Properties by which patches of two samples are compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Features {
    /// Strength of edges, lightness, height, a* and b*.
    #[default]
    Tone,
    /// Strength of edges, a* and b*: equations 1 and 2 of Yan and others (2008), with a* and b*
    /// instead of the angle of hue, which means nothing in greys.
    Paper,
}

/// Settings of [`key_maps`](super::key_maps).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
pub struct SynthesisSettings {
    /// Width and height of the maps in texels, [`SynthesisSettings::SIZES`].
    pub size: usize,
    /// Name of the sample whose map is made first and which the others follow; without it the
    /// sample with the strongest contrast of lightness.
    pub first: Option<String>,
    /// Properties by which patches are compared.
    pub features: Features,
    /// Number of links of a patch to each other sample, 1..=512.
    pub links: usize,
    /// Weight of the likeness of linked patches beside that of overlaps, 0..=16: higher keeps
    /// maps closer to the first one, lower makes better seams.
    pub follow: f32,
    /// Penalty on places that were used before, 0..=16.
    pub uniformity: f32,
    /// Seed of the choices of the first map.
    pub seed: u64,
}

impl SynthesisSettings {
    /// Range of [`SynthesisSettings::size`].
    pub const SIZES: std::ops::RangeInclusive<usize> = 64..=1024;

    /// Least distance of neighbouring strokes in texels.
    pub const LEAST_SPACING: f64 = 6.0;
}

impl Default for SynthesisSettings {
    fn default() -> Self {
        Self {
            size: 256,
            first: None,
            features: Features::default(),
            links: 32,
            follow: 8.0,
            uniformity: 1.0,
            seed: 1,
        }
    }
}

/// Why maps could not be synthesised.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SynthesisError {
    /// There are no samples.
    #[error("there is no sample to synthesise from")]
    NoSample,
    /// A setting is out of its range.
    #[error("`{name}` is {found}, it must lie within {range}")]
    Setting {
        /// Name of the setting.
        name: &'static str,
        /// Its value.
        found: String,
        /// The range.
        range: String,
    },
    /// No sample has the name of the first map.
    #[error("no sample is called `{name}`; there are {}", .known.join(", "))]
    UnknownFirst {
        /// The name that was asked for.
        name: String,
        /// Names of all samples.
        known: Vec<String>,
    },
    /// Strokes stand too close, or too far apart for the size of the maps.
    #[error(
        "strokes of sample `{name}` are {spacing:.1} texels apart; maps of {size} texels take \
         {least} to {most:.0}"
    )]
    Spacing {
        /// Name of the sample.
        name: String,
        /// Its spacing in texels.
        spacing: f64,
        /// Size of the maps in texels.
        size: usize,
        /// Least spacing.
        least: f64,
        /// Most spacing.
        most: f64,
    },
    /// The samples have different spacings.
    #[error(
        "strokes of sample `{name}` are {spacing:.1} texels apart, those of `{first}` {wanted:.1}"
    )]
    UnlikeSpacings {
        /// Name of the sample.
        name: String,
        /// Its spacing in texels.
        spacing: f64,
        /// Name of the first sample.
        first: String,
        /// Its spacing in texels.
        wanted: f64,
    },
    /// No patch lies wholly in the sample.
    #[error(
        "sample `{name}` of {width} x {height} texels has no room for a patch of {patch} x {patch}"
    )]
    TooSmall {
        /// Name of the sample.
        name: String,
        /// Its width in texels.
        width: usize,
        /// Its height in texels.
        height: usize,
        /// Side of a patch in texels.
        patch: usize,
    },
    /// A sample is of one colour, without any relief.
    #[error("sample `{name}` is of one colour: it has no strokes")]
    Flat {
        /// Name of the sample.
        name: String,
    },
}

impl Explain for SynthesisError {
    fn hint(&self) -> Option<Hint> {
        Some(Hint::new(match self {
            Self::NoSample => "mark at least one passage of the painting".to_owned(),
            Self::Setting { name, .. } => format!("change [{name}]"),
            Self::UnknownFirst { .. } => "name one of the samples as [first]".to_owned(),
            Self::Spacing { .. } => "scale the picture, or make maps of another [size]".to_owned(),
            Self::UnlikeSpacings { .. } => "scale the samples to one spacing".to_owned(),
            Self::TooSmall { .. } => {
                "mark a passage at least four times as wide and high as its strokes are apart"
                    .to_owned()
            }
            Self::Flat { .. } => "mark a passage whose strokes show".to_owned(),
        }))
    }

    fn fault(&self) -> Fault {
        match self {
            Self::Setting { .. } | Self::UnknownFirst { .. } => Fault::Setting,
            _ => Fault::Input,
        }
    }
}
