//! What is painted on: its relief, made from a seed or taken from a picture, and
//! the reflectance of its priming.
//!
//! Heights are above the deepest point of the ground, in mm; what a kind of
//! ground is like by default is told with it. The same description gives the
//! same bytes.

mod linen;

mod panel;

mod paper;

mod picture_relief;

mod primer;

mod wood;

pub use linen::Linen;
pub use panel::Panel;
pub use paper::{Making, Paper};
pub use picture_relief::PictureRelief;
pub use primer::{ColorPrimer, MeasuredPrimer, Primer, PrimerSpectrum};
pub use wood::Wood;

use pigment::library::PigmentLibrary;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

use crate::amount::QUANTA_PER_CELL;
use crate::document::Ground;
use crate::optics::Gloss;
use graphics::field::Field;

/// A ground as a file of strokes describes it:
/// `{"kind": "linen", "seed": 1, "reflectance": {"rgb": "#f4f1e8"}}`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Map<String, Value>")]
pub struct GroundSpec {
    /// Its relief.
    #[serde(flatten)]
    pub relief: GroundRelief,
    /// Its colour; the library's white if not given, of wood a walnut brown.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reflectance: Option<Primer>,
    /// Its shine; matt if not given, of wood that of its varnish.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub gloss: Option<Gloss>,
}

/// The kinds of relief.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "lowercase")]
pub enum GroundRelief {
    /// Primed linen in plain weave.
    Linen(Linen),
    /// Watercolour paper.
    Paper(Paper),
    /// A primed panel, nearly flat.
    Panel(Panel),
    /// A varnished wooden palette.
    Wood(Wood),
    /// Heights from a picture.
    Image(PictureRelief),
}

/// A ground without shine.
const MATT: Gloss = Gloss { strength: 0.0, exponent: 10.0 };

/// The highest ground, in cell widths; heights must leave room for paint.
const HIGHEST_CELLS: f64 = 256.0;

impl Default for GroundSpec {
    /// Linen as it comes.
    fn default() -> Self {
        GroundRelief::Linen(Linen::default()).into()
    }
}

impl From<GroundRelief> for GroundSpec {
    fn from(relief: GroundRelief) -> Self {
        Self { relief, reflectance: None, gloss: None }
    }
}

impl TryFrom<Map<String, Value>> for GroundSpec {
    type Error = serde_json::Error;

    fn try_from(mut map: Map<String, Value>) -> Result<Self, Self::Error> {
        let reflectance = map.remove("reflectance").map(serde_json::from_value).transpose()?;
        let gloss = map.remove("gloss").map(serde_json::from_value).transpose()?;
        let relief = serde_json::from_value(Value::Object(map))?;
        Ok(Self { relief, reflectance, gloss })
    }
}

impl GroundSpec {
    /// The ground of `width` x `height` cells of `cell_mm`, its reflectance on
    /// the grid of `library`.
    ///
    /// # Errors
    /// [`GroundError`] if a figure cannot be, or the picture cannot be read.
    pub fn ground(
        &self,
        width: usize,
        height: usize,
        cell_mm: f64,
        library: &PigmentLibrary,
    ) -> Result<Ground, GroundError> {
        let reflectance = match (&self.reflectance, &self.relief) {
            (Some(primer), _) => primer.reflectance(library)?,
            (None, GroundRelief::Wood(_)) => Wood::walnut().reflectance(library)?,
            (None, _) => Primer::of_library(library),
        };
        let bare = if let GroundRelief::Wood(_) = self.relief { Wood::VARNISH } else { MATT };
        let (name, heights_mm) = match &self.relief {
            GroundRelief::Linen(linen) => {
                (format!("linen, seed {}", linen.seed), linen.heights_mm(width, height, cell_mm)?)
            }
            GroundRelief::Paper(paper) => {
                (format!("paper, seed {}", paper.seed), paper.heights_mm(width, height, cell_mm)?)
            }
            GroundRelief::Panel(panel) => {
                (format!("panel, seed {}", panel.seed), panel.heights_mm(width, height, cell_mm)?)
            }
            GroundRelief::Wood(wood) => {
                (format!("wood, seed {}", wood.seed), wood.heights_mm(width, height, cell_mm)?)
            }
            GroundRelief::Image(picture) => {
                (format!("picture {}", picture.path), picture.heights_mm(width, height)?)
            }
        };
        let highest_mm = HIGHEST_CELLS * cell_mm;
        let quanta_per_mm = f64::from(QUANTA_PER_CELL) / cell_mm;
        let quantum = |&mm: &f32| {
            let mm = f64::from(mm);
            if mm > highest_mm {
                return Err(GroundError::TooHigh { mm, highest_mm });
            }
            Ok((mm * quanta_per_mm).round() as i32)
        };
        let quanta = heights_mm.values().iter().map(quantum).collect::<Result<_, _>>()?;
        let height = Field::from_values(width, height, quanta);
        Ok(Ground { name, height, reflectance, gloss: self.gloss.unwrap_or(bare) })
    }
}

/// `value` if it lies within `range`.
fn within(
    name: &'static str,
    unit: &'static str,
    value: f64,
    [least, most]: [f64; 2],
) -> Result<f64, GroundError> {
    if (least..=most).contains(&value) {
        Ok(value)
    } else {
        Err(GroundError::Figure { name, unit, least, most, value })
    }
}

/// Why there is no such ground.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum GroundError {
    /// A figure out of its range.
    #[error("{name} of a ground is {least} to {most}{unit}, found `{value}`")]
    Figure {
        /// As the description calls it.
        name: &'static str,
        /// With a space before it.
        unit: &'static str,
        /// The least.
        least: f64,
        /// The most.
        most: f64,
        /// What was given.
        value: f64,
    },
    /// Higher than amounts can tell.
    #[error("a ground may be {highest_mm} mm high over cells of this size, found `{mm}`")]
    TooHigh {
        /// What was found.
        mm: f64,
        /// What there may be.
        highest_mm: f64,
    },
    /// No colour.
    #[error("the colour of a ground is written #rrggbb, found `{text}`")]
    Color {
        /// What was given.
        text: String,
    },
    /// A spectrum that cannot be.
    #[error("reflectance of the ground: {0}")]
    Spectrum(#[from] spectra::SpectrumError),
    /// A spectrum that cannot be brought to the library's grid.
    #[error("reflectance of the ground: {0}")]
    Resampled(#[from] spectra::InterpolateError),
    /// A spectrum that stops short of the library's band altogether.
    #[error("the ground is measured from {start_nm} to {end_nm} nm only")]
    Band {
        /// Where it starts.
        start_nm: f64,
        /// Where it ends.
        end_nm: f64,
        /// The library's grid, in words.
        library: String,
    },
    /// A picture that cannot be read.
    #[error("{path}: {reason}")]
    Picture {
        /// The file.
        path: String,
        /// Why.
        reason: String,
    },
}

impl GroundError {
    /// What to try.
    #[must_use]
    pub fn hint(&self) -> Option<String> {
        match self {
            Self::TooHigh { .. } => Some("use larger cells, or a lower ground".to_owned()),
            Self::Color { .. } => {
                Some("or give a number 0 to 1, or {\"spectrum\": {..}}".to_owned())
            }
            Self::Band { library, .. } => Some(format!("the library stands on {library}")),
            Self::Picture { .. } => {
                Some("the relief of a ground is a grey PNG or JPEG, white the highest".to_owned())
            }
            _ => None,
        }
    }
}
