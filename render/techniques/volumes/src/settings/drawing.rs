//! Settings of colour inside of volumes, and of pencil hatching.

use serde::{Deserialize, Serialize};

use super::setting::{
    Setting,
    Takes::{Color, Number, Numbers, Switch, Words},
};
use crate::pigments::{FilmKind, InsidePaint, UnderPainting};

/// How volumes show what they hold.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct DrawingTable {
    /// Sizes of the concentric shells of a volume by its own, falling, 0.01..=1; 1 to
    /// [`MOST_SHELLS`](super::MOST_SHELLS).
    pub shells: Vec<f32>,
    /// Share of colour by the number of shells that hold a place, from 0 shells on, 0..=1 and
    /// rising: one more than there are shells. Empty for even steps from 0 to 1.
    pub tint: Vec<f32>,
    /// Colour that the drawing is multiplied by inside of volumes, below its own colours, written
    /// `#rrggbb`; not in pigments.
    pub stain: String,
    /// Cosine between the normals of a place and of its cell below which it is not painted,
    /// -1..=1.
    pub gate: f32,
    /// Appearance of the scene inside of volumes.
    pub inside: InsidePaint,
    /// Layer under a film of pigments.
    pub under: UnderPainting,
    /// Whether the greys of a grisaille take a third paint against the cast of white and black.
    pub neutral: bool,
    /// Where the film of pigments lies.
    pub film: FilmKind,
    /// Width of the thin rim of a film by the radius, 0..=1.
    pub rim: f32,
    /// How much thicker a film dries near its rim, 0..=4.
    pub edge: f32,
}

impl Default for DrawingTable {
    fn default() -> Self {
        Self {
            shells: vec![1.0, 0.93, 0.86, 0.79],
            tint: Vec::new(),
            stain: "#ffffff".to_owned(),
            gate: -0.2,
            inside: InsidePaint::OwnColors,
            under: UnderPainting::Grisaille,
            neutral: true,
            film: FilmKind::Surface,
            rim: 0.15,
            edge: 0.5,
        }
    }
}

/// Where strokes lie on surfaces.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum StrokesAlong {
    /// Projected along the three axes, each where the surface faces it.
    #[default]
    Axes,
    /// Along the scene's own texture coordinates where these are useful.
    Texture,
}

/// Pencil hatching, which conveys the light.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct HatchingTable {
    /// Strength of strokes inside of volumes, 0..=1.
    pub inside: f32,
    /// Strength of strokes outside of volumes, 0..=1.
    pub outside: f32,
    /// Where strokes lie.
    pub along: StrokesAlong,
    /// Grey of the pencil, 0 (black) to 1 (white).
    pub pencil: f32,
    /// Width of a stroke in px, 1..=16; it varies by a third either way.
    pub width_px: f32,
    /// Half the range of tone over which a stroke fades in, 0.01..=0.15.
    pub softness: f32,
    /// Tone of the darkest shade, 0 (no paper between strokes) to 1 (bare paper).
    pub darkest: f32,
    /// Direction of strokes in degrees from the horizontal, -360..=360.
    pub angle_deg: f32,
}

impl Default for HatchingTable {
    fn default() -> Self {
        Self {
            inside: 1.0,
            outside: 1.0,
            along: StrokesAlong::default(),
            pencil: 0.15,
            width_px: 2.8,
            softness: 0.12,
            darkest: 0.15,
            angle_deg: 32.0,
        }
    }
}

const INSIDE: &[&str] = &["own-colours", "glaze", "both"];
const UNDER: &[&str] = &["grisaille", "own-colours", "none"];

pub(super) const SETTINGS: [Setting; 18] = [
    Setting::new(
        "drawing.shells",
        Numbers(0.01, 1.0),
        "",
        "Sizes of a volume's concentric shells, falling; one shell has a hard edge.",
    ),
    Setting::new(
        "drawing.tint",
        Numbers(0.0, 1.0),
        "",
        "Share of colour in 0, 1, 2, ... shells, rising; [] takes even steps from 0 to 1.",
    ),
    Setting::new(
        "drawing.stain",
        Color,
        "",
        "The drawing is multiplied by this colour inside of volumes, below its own colours; not in \
         pigments.",
    ),
    Setting::new(
        "drawing.gate",
        Number(-1.0, 1.0),
        "cosine",
        "Surfaces that face away from those of their cell by more than this stay unpainted.",
    ),
    Setting::new(
        "drawing.inside",
        Words(INSIDE),
        "",
        "Volumes show the scene's own colours, a glaze of the poured pigments, or both.",
    ),
    Setting::new("drawing.under", Words(UNDER), "", "Painting that lies under the glaze."),
    Setting::new(
        "drawing.neutral",
        Switch,
        "",
        "Whether greys of the grisaille take a third paint against the cast of white and black.",
    ),
    Setting::new(
        "drawing.film",
        Words(&["surface", "through"]),
        "",
        "The glaze lies on the surface, or is looked through along the eye ray.",
    ),
    Setting::new("drawing.rim", Number(0.0, 1.0), "radii", "Width over which a film thins out."),
    Setting::new(
        "drawing.edge",
        Number(0.0, 4.0),
        "",
        "How much thicker a film dries near its rim.",
    ),
    Setting::new(
        "hatching.inside",
        Number(0.0, 1.0),
        "",
        "Strength of pencil strokes inside of volumes.",
    ),
    Setting::new(
        "hatching.outside",
        Number(0.0, 1.0),
        "",
        "Strength of pencil strokes outside of volumes.",
    ),
    Setting::new(
        "hatching.along",
        Words(&["axes", "texture"]),
        "",
        "Strokes are projected along the three axes, or follow the scene's texture coordinates.",
    ),
    Setting::new(
        "hatching.pencil",
        Number(0.0, 1.0),
        "",
        "Grey of the pencil: 0 is black, 1 is white.",
    ),
    Setting::new(
        "hatching.width_px",
        Number(1.0, 16.0),
        "px",
        "Width of a stroke, which varies by a third either way.",
    ),
    Setting::new(
        "hatching.softness",
        Number(0.01, 0.15),
        "",
        "Change of tone over which a stroke fades in: little draws a hard pencil.",
    ),
    Setting::new(
        "hatching.darkest",
        Number(0.0, 1.0),
        "",
        "Tone of the darkest shade; 0 leaves no paper between strokes.",
    ),
    Setting::new(
        "hatching.angle_deg",
        Number(-360.0, 360.0),
        "degrees",
        "Slant of the strokes, from the horizontal.",
    ),
];
