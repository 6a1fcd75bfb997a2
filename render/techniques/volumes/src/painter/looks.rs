//! Settings of a file as looks of a drawing.

use graphics::distant_light::DistantLight;
use graphics::tones::ToneRamp;
use spectra::color::Rgb;

use crate::drawing::{DrawingLook, ShellError, Shells};
use crate::hatching::{Coordinates, HatchingLook};
use crate::pigments::{FilmProfile, InsidePaint};
use crate::script::RegionStyle;
use crate::settings::{DrawingTable, LightWith, Settings, StrokesAlong};

/// How a region shows what its volumes hold.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct RegionLook {
    pub(super) name: String,
    pub(super) inside: InsidePaint,
    pub(super) shells: Shells,
    /// Colour that the drawing is multiplied by inside, encoded sRGB.
    pub(super) stain: [f32; 3],
}

impl RegionLook {
    pub(super) fn of(style: &RegionStyle) -> Result<Self, ShellError> {
        Ok(Self {
            name: style.name.clone(),
            inside: style.inside,
            shells: Shells::new(style.shells.clone(), style.tints.clone())?,
            stain: encoded(&style.stain),
        })
    }
}

/// How surfaces are lit, made grey and hatched.
pub(super) fn drawing_look(settings: &Settings) -> DrawingLook {
    let light = &settings.light;
    let hatching = &settings.hatching;
    let with_camera = DistantLight::with_camera(light.azimuth_deg, light.elevation_deg);
    let direction = match (light.with, with_camera) {
        (LightWith::Model, DistantLight::WithCamera(towards)) => DistantLight::WithModel(towards),
        (_, direction) => direction,
    };
    DrawingLook {
        light: direction,
        tones: ToneRamp::steps(light.levels as usize, light.softness),
        lit: light.lit,
        shade: light.shade,
        pale: settings.grey.pale,
        weights: settings.grey.weights,
        hatching: HatchingLook {
            coordinates: match hatching.along {
                StrokesAlong::Axes => Some(Coordinates::ThreePlanes),
                StrokesAlong::Texture => None,
            },
            inside: hatching.inside,
            outside: hatching.outside,
            pencil: hatching.pencil,
            width_px: hatching.width_px,
            softness: hatching.softness,
            darkest: hatching.darkest,
            angle_deg: hatching.angle_deg,
        },
        samples: settings.picture.samples as usize,
    }
}

/// Colour of the paper, encoded sRGB.
pub(super) fn paper(settings: &Settings) -> [f32; 3] {
    encoded(&settings.picture.paper)
}

/// A colour written `#rrggbb`; white if it is none.
fn encoded(text: &str) -> [f32; 3] {
    Rgb::from_hex(text).unwrap_or(Rgb([1.0; 3])).0.map(|value| value as f32)
}

/// How films stand over their rims.
pub(super) fn profile(settings: &Settings) -> FilmProfile {
    let DrawingTable { rim, edge, gate, .. } = settings.drawing;
    FilmProfile { rim, edge, gate }
}

/// The insides of the volumes of all regions together.
pub(super) fn inside(regions: &[RegionLook]) -> InsidePaint {
    let any = |wanted: fn(InsidePaint) -> bool| regions.iter().any(|own| wanted(own.inside));
    match (any(InsidePaint::has_own_colors), any(InsidePaint::has_films)) {
        (true, false) => InsidePaint::OwnColors,
        (false, _) => InsidePaint::Glaze,
        (true, true) => InsidePaint::Both,
    }
}
