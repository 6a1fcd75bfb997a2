//! A painting at rest: all that its file keeps.

use pigment::library::PigmentLibrary;

use crate::layer::{Layer, SLOTS};
use crate::optics::Gloss;
use graphics::field::Field;

/// The pigments of a layer: an index into the library for each slot in use.
pub type Slots = [Option<usize>; SLOTS];

/// What is painted on.
#[derive(Debug, Clone, PartialEq)]
pub struct Ground {
    /// What it is, for people: `linen, seed 1`.
    pub name: String,
    /// Height over the plane of the canvas, in quanta.
    pub height: Field<i32>,
    /// Reflectance as an instrument would read it, on the library's grid.
    pub reflectance: Vec<f64>,
    /// Its shine.
    pub gloss: Gloss,
}

/// A dry layer.
#[derive(Debug, Clone, PartialEq)]
pub struct DryLayer {
    /// Its pigments.
    pub slots: Slots,
    /// What its optical thickness is multiplied with; 1 as painted, 0 hides it.
    pub opacity: f64,
    /// Its paint.
    pub paint: Layer,
}

/// The light that a painting is shown under.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Lighting {
    /// The illuminant, as `--illuminant` names it (`D65`, `A`, `4000K`).
    pub illuminant: String,
    /// The observer, as `--observer` names it.
    pub observer: String,
    /// Where the light stands, in degrees clockwise from the top of the canvas.
    pub azimuth_deg: f64,
    /// How high, in degrees above the canvas, above 0 up to 90.
    pub elevation_deg: f64,
    /// Share of the light that comes from all sides, 0..1.
    pub ambient: f64,
    /// How much the relief counts: 0 flat, 1 as it is.
    pub relief: f64,
}

impl Default for Lighting {
    /// Daylight from the upper left, half of it from all sides.
    fn default() -> Self {
        Self {
            illuminant: "D65".to_owned(),
            observer: "1931-2".to_owned(),
            azimuth_deg: 315.0,
            elevation_deg: 50.0,
            ambient: 0.5,
            relief: 1.0,
        }
    }
}

/// What the binder is: how strong a film of given height is, and how it shines.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Medium {
    /// The reference white's S per mm of height, by which heights become the
    /// library's thickness; a library alone does not know millimetres.
    pub scattering_per_mm: f64,
    /// Shine of wet paint.
    pub wet: Gloss,
    /// Shine of dry paint.
    pub dry: Gloss,
}

impl Default for Medium {
    /// Oil: a tenth of a millimetre of white hides nearly all (S d = 5).
    fn default() -> Self {
        Self {
            scattering_per_mm: 50.0,
            wet: Gloss { strength: 0.25, exponent: 60.0 },
            dry: Gloss { strength: 0.06, exponent: 20.0 },
        }
    }
}

/// A painting at rest.
#[derive(Debug, Clone, PartialEq)]
pub struct Document {
    /// What it is called.
    pub title: String,
    /// Width and height of a cell in mm.
    pub cell_mm: f64,
    /// What is painted on.
    pub ground: Ground,
    /// The pigments that its layers name.
    pub library: PigmentLibrary,
    /// The binder.
    pub medium: Medium,
    /// Dry layers, lowest first.
    pub dry: Vec<DryLayer>,
    /// The pigments of the wet layer: the palette.
    pub slots: Slots,
    /// The wet paint.
    pub wet: Layer,
    /// The light it is shown under.
    pub lighting: Lighting,
}

impl Document {
    /// A canvas without paint.
    #[must_use]
    pub fn bare(
        title: &str,
        cell_mm: f64,
        ground: Ground,
        library: PigmentLibrary,
        medium: Medium,
        slots: Slots,
        lighting: Lighting,
    ) -> Self {
        let wet = Layer::empty(ground.height.width(), ground.height.height());
        let title = title.to_owned();
        Self { title, cell_mm, ground, library, medium, dry: Vec::new(), slots, wet, lighting }
    }
}
