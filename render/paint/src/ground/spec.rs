//! Descriptions of grounds in scripts of strokes. You can also choose a kind of ground by its name.

use std::str::FromStr;

use documents::hint::Explain;
use pigment::library::PigmentLibrary;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

use super::primer::Primer;
use super::relief::{Linen, Panel, Paper, PictureRelief, Wood};
use super::{Ground, GroundError};
use crate::amount::QUANTA_PER_CELL;
use crate::optics::Gloss;
use graphics::field::Field;

/// Description of a ground in a script of strokes. You write it as `{"kind": "linen", "seed": 1,
/// "reflectance": {"rgb": "#f4f1e8"}}`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Map<String, Value>")]
pub struct GroundSpec {
    /// Kind of ground and its relief.
    #[serde(flatten)]
    pub relief: GroundRelief,
    /// Colour of the priming. If you leave this out, you get the library's white, or walnut brown
    /// for wood.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reflectance: Option<Primer>,
    /// Gloss of the bare ground. If you leave this out, the ground is matt, or varnished if it is
    /// wood.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub gloss: Option<Gloss>,
}

/// Kind of ground, with the settings of its relief.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "lowercase")]
pub enum GroundRelief {
    /// Primed linen in plain weave.
    Linen(Linen),
    /// Watercolour paper, cold pressed by default.
    Paper(Paper),
    /// A primed panel, nearly flat.
    Panel(Panel),
    /// A varnished wooden palette.
    Wood(Wood),
    /// Heights from a picture.
    Image(PictureRelief),
}

/// Kind of ground by name, for programs that let users choose one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum GroundKind {
    /// Primed linen in plain weave.
    #[default]
    Linen,
    /// Cold-pressed watercolour paper.
    Paper,
    /// A primed panel, nearly flat.
    Panel,
    /// A varnished wooden palette.
    Wood,
}

const MATT: Gloss = Gloss { strength: 0.0, exponent: 10.0 };

/// Greatest height of a ground, in cell widths. We leave the rest of the range of heights for
/// paint.
const HIGHEST_CELLS: f64 = 256.0;

impl GroundKind {
    /// Kinds on which you paint pictures. [`GroundKind::Wood`] is for palettes.
    pub const CANVASES: [Self; 3] = [Self::Linen, Self::Paper, Self::Panel];

    /// Name of the kind as users write it: `linen`, `paper`, `panel` or `wood`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Linen => "linen",
            Self::Paper => "paper",
            Self::Panel => "panel",
            Self::Wood => "wood",
        }
    }

    /// Description of a new ground of this kind with default relief, colour and gloss. The seed decides
    /// the details of its relief. For example, scripts use 1 by default.
    #[must_use]
    pub fn spec(self, seed: u64) -> GroundSpec {
        match self {
            Self::Linen => GroundRelief::Linen(Linen {
                seed,
                unevenness: Linen::UNEVENNESS,
                ..Linen::default()
            }),
            Self::Paper => GroundRelief::Paper(Paper { seed, ..Paper::default() }),
            Self::Panel => GroundRelief::Panel(Panel { seed, ..Panel::default() }),
            Self::Wood => GroundRelief::Wood(Wood { seed, ..Wood::default() }),
        }
        .into()
    }
}

/// A name does not belong to a kind of ground.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error, Explain)]
#[error("a ground is linen, paper, panel or wood, found `{0}`")]
pub struct ParseGroundKindError(pub String);

impl FromStr for GroundKind {
    type Err = ParseGroundKindError;

    fn from_str(name: &str) -> Result<Self, Self::Err> {
        let all = [Self::Linen, Self::Paper, Self::Panel, Self::Wood];
        let found = all.into_iter().find(|kind| kind.name() == name);
        found.ok_or_else(|| ParseGroundKindError(name.to_owned()))
    }
}

impl Default for GroundSpec {
    /// Linen with default settings.
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
    /// Makes the ground of `width` x `height` cells, each `cell_mm` wide, with its
    /// reflectance on the grid of `library`.
    ///
    /// # Errors
    /// [`GroundError`] for a setting out of range or a picture that cannot be read.
    pub fn build(
        &self,
        width: usize,
        height: usize,
        cell_mm: f64,
        library: &PigmentLibrary,
    ) -> Result<Ground, GroundError> {
        let reflectance = self.reflectance(library)?;
        let (name, heights_mm) = self.relief.heights_mm(width, height, cell_mm)?;
        let default_gloss =
            if let GroundRelief::Wood(_) = self.relief { Wood::VARNISH } else { MATT };
        let height = Field::from_values(width, height, quanta(&heights_mm, cell_mm)?);
        Ok(Ground { name, height, reflectance, gloss: self.gloss.unwrap_or(default_gloss) })
    }

    /// Measured reflectance of the ground on the grid of `library`. This does not make its relief.
    ///
    /// # Errors
    /// [`GroundError`] for a colour or spectrum that is invalid.
    pub fn reflectance(&self, library: &PigmentLibrary) -> Result<Vec<f64>, GroundError> {
        match (&self.reflectance, &self.relief) {
            (Some(primer), _) => primer.reflectance(library),
            (None, GroundRelief::Wood(_)) => Wood::walnut().reflectance(library),
            (None, _) => Ok(Primer::library_white(library)),
        }
    }
}

impl GroundRelief {
    /// Human-readable name of the ground, and its heights in mm.
    fn heights_mm(
        &self,
        width: usize,
        height: usize,
        cell_mm: f64,
    ) -> Result<(String, Field<f32>), GroundError> {
        Ok(match self {
            Self::Linen(linen) => {
                (format!("linen, seed {}", linen.seed), linen.heights_mm(width, height, cell_mm)?)
            }
            Self::Paper(paper) => {
                (format!("paper, seed {}", paper.seed), paper.heights_mm(width, height, cell_mm)?)
            }
            Self::Panel(panel) => {
                (format!("panel, seed {}", panel.seed), panel.heights_mm(width, height, cell_mm)?)
            }
            Self::Wood(wood) => {
                (format!("wood, seed {}", wood.seed), wood.heights_mm(width, height, cell_mm)?)
            }
            Self::Image(picture) => {
                (format!("picture {}", picture.path), picture.heights_mm(width, height)?)
            }
        })
    }
}

/// Rounds heights in mm to whole quanta. [`GroundError::TooHigh`] above [`HIGHEST_CELLS`].
fn quanta(heights_mm: &Field<f32>, cell_mm: f64) -> Result<Vec<i32>, GroundError> {
    let highest_mm = HIGHEST_CELLS * cell_mm;
    let quanta_per_mm = f64::from(QUANTA_PER_CELL) / cell_mm;
    heights_mm
        .values()
        .iter()
        .map(|&mm: &f32| {
            let mm = f64::from(mm);
            if mm > highest_mm {
                return Err(GroundError::TooHigh { mm, highest_mm });
            }
            Ok((mm * quanta_per_mm).round() as i32)
        })
        .collect()
}
