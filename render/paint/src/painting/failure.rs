//! Why a painting refuses something.

use crate::brush::BrushError;
use crate::light::LightFailure;
use crate::stroke::StrokeError;
use graphics::gpu::DeviceError;
use spectra::hint::Explain;

/// What a painting refuses.
#[derive(Debug, thiserror::Error)]
pub enum PaintingError {
    /// The backend could not go on.
    #[error(transparent)]
    Engine(#[from] DeviceError),
    /// No such light.
    #[error(transparent)]
    Light(#[from] LightFailure),
    /// No such brush.
    #[error(transparent)]
    Brush(#[from] BrushError),
    /// A stroke with impossible samples.
    #[error(transparent)]
    Stroke(#[from] StrokeError),
    /// A recipe without parts, or with negative ones.
    #[error("a recipe needs parts above 0, none below, unless it is vehicle alone")]
    NoMixture,
    /// A share outside 0..1.
    #[error("{what} is a share of 0 to 1, found `{value}`")]
    Share {
        /// Of what.
        what: &'static str,
        /// What was given.
        value: f64,
    },
    /// An amount that is none.
    #[error("an amount of paint is 0 mm or more, found `{value}`")]
    Amount {
        /// What was given.
        value: f64,
    },
    /// A volume that is none.
    #[error("a volume of paint is above 0 mm3 and at most a litre, 1000000 mm3, found `{value}`")]
    Volume {
        /// What was given.
        value: f64,
    },
    /// A place beside the canvas.
    #[error("there is no canvas {x_mm} mm from its left and `{y_mm}` mm from its upper edge")]
    OffCanvas {
        /// From the left edge.
        x_mm: f64,
        /// From the upper edge.
        y_mm: f64,
    },
    /// A heap where paint is piled up already.
    #[error("the paint {x_mm} mm from the left and `{y_mm}` mm from the top is too high for more")]
    NoRoom {
        /// From the left edge.
        x_mm: f64,
        /// From the upper edge.
        y_mm: f64,
    },
    /// A shine that is none.
    #[error(
        "a gloss has a strength of 0 to 100 and an exponent of 0 to 1e6, found `{strength}` and `{exponent}`"
    )]
    Gloss {
        /// What was given.
        strength: f32,
        /// What was given.
        exponent: f32,
    },
    /// Paint of a slot that holds no pigment.
    #[error("no pigment is squeezed out in slot {slot}")]
    EmptySlot {
        /// Which.
        slot: usize,
    },
    /// More than a head holds.
    #[error("the brush holds {most_mm:.2} mm more at most, found `{amount_mm}`")]
    Overloaded {
        /// What was given.
        amount_mm: f64,
        /// What there is room for.
        most_mm: f64,
    },
    /// A pigment that is still wet on canvas or brush.
    #[error("{pigment} is still wet, so it cannot leave the palette")]
    StillWet {
        /// Which.
        pigment: String,
    },
    /// More pigments than a layer holds.
    #[error("a layer holds 8 pigments, found `{found}`")]
    TooManyPigments {
        /// How many.
        found: usize,
    },
    /// A pigment the layer does not have.
    #[error("the layer has no {pigment}")]
    NotThere {
        /// Which.
        pigment: String,
    },
    /// A pigment the layer has already.
    #[error("the layer has {pigment} already")]
    AlreadyThere {
        /// Which.
        pigment: String,
    },
    /// A pigment that is not on the palette now.
    #[error("{pigment} is not on the palette now")]
    OffPalette {
        /// Which.
        pigment: String,
    },
    /// An opacity of wet paint.
    #[error("wet paint has no opacity of its own")]
    WetOpacity,
    /// An opacity out of range.
    #[error("an opacity is 0 to 1000, found `{value}`")]
    Opacity {
        /// What was given.
        value: f64,
    },
    /// No room left above.
    #[error("the paint is piled as high as it can be, 512 cell widths, at column {x}, row `{y}`")]
    TooHigh {
        /// The column of cells.
        x: usize,
        /// The row.
        y: usize,
    },
    /// Two layers to be merged that are seen differently.
    #[error("the two layers have different opacities")]
    UnlikeOpacity,
    /// A dry layer that does not exist.
    #[error("there are {count} dry layers, counted from 0, found `{index}`")]
    NoLayer {
        /// What was given.
        index: usize,
        /// How many there are.
        count: usize,
    },
    /// Two layers that cannot become one without being seen.
    #[error(
        "merging these layers would move a colour by {delta_e:.2} CIEDE2000 (at column {x}, row {y})"
    )]
    MergeShows {
        /// The largest difference.
        delta_e: f64,
        /// Where.
        x: usize,
        /// Where.
        y: usize,
    },
}

impl PaintingError {
    /// What to try, where there is something.
    #[must_use]
    pub fn hint(&self) -> Option<String> {
        match self {
            Self::Engine(error) => error.hint().map(|hint| {
                hint.with_settings(|name, value| format!("--{name} {}", value.unwrap_or_default()))
            }),
            Self::Light(error) => error.hint(),
            Self::Brush(error) => Some(error.hint().to_owned()),
            Self::Stroke(error) => Some(error.hint().to_owned()),
            Self::TooHigh { .. } => Some("paint thinner, or with larger cells".to_owned()),
            Self::StillWet { .. } => Some("dry the painting and wash the brushes first".to_owned()),
            Self::TooManyPigments { .. } => {
                Some("dry the painting, then go on with another palette".to_owned())
            }
            Self::MergeShows { .. } => Some("keep them apart; layers are unlimited".to_owned()),
            Self::AlreadyThere { .. } => {
                Some("a layer holds each pigment once: choose one that it lacks".to_owned())
            }
            Self::OffCanvas { .. } => Some("places are in mm from the canvas's corner".to_owned()),
            Self::NoRoom { .. } => Some("squeeze beside it, or spread it first".to_owned()),
            Self::WetOpacity => Some("dry it first".to_owned()),
            Self::OffPalette { .. } => {
                Some("put it there with a palette action, or undo less".to_owned())
            }
            Self::UnlikeOpacity => Some("give both the same opacity".to_owned()),
            Self::Overloaded { .. } => Some("wipe or wash the brush first".to_owned()),
            _ => None,
        }
    }
}
