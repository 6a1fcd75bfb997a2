//! Settings of a file as looks of a drawing.

use graphics::distant_light::DistantLight;
use graphics::tones::ToneRamp;
use spectra::color::Rgb;

use crate::drawing::{self, DrawingLook, ShellError, Shells};
use crate::hatching::{Coordinates, HatchingLook};
use crate::pigments::{FilmKind, FilmProfile, InsidePaint, UnderPainting};
use crate::script::RegionStyle;
use crate::settings::{Film, GreyWeights, Inside, LightWith, Settings, StrokesAlong, Under};

/// How a region shows what its volumes hold.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct RegionLook {
    pub(super) name: String,
    pub(super) inside: Inside,
    pub(super) shells: Shells,
}

impl RegionLook {
    pub(super) fn of(style: &RegionStyle) -> Result<Self, ShellError> {
        Ok(Self {
            name: style.name.clone(),
            inside: style.inside,
            shells: Shells::new(style.shells.clone(), style.tints.clone())?,
        })
    }
}

/// How surfaces are lit, made grey and hatched.
pub(super) fn drawing_look(settings: &Settings) -> DrawingLook {
    let (light, hatching) = (&settings.light, &settings.hatching);
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
        weights: match settings.grey.weights {
            GreyWeights::Luminance => drawing::GreyWeights::Luminance,
            GreyWeights::Rec601 => drawing::GreyWeights::Rec601,
        },
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
    let white = Rgb([1.0; 3]);
    Rgb::from_hex(&settings.picture.paper).unwrap_or(white).0.map(|value| value as f32)
}

/// How films stand over their rims.
pub(super) fn profile(settings: &Settings) -> FilmProfile {
    FilmProfile { rim: settings.drawing.rim, edge: settings.drawing.edge }
}

/// What lies under films.
pub(super) fn under(settings: &Settings) -> UnderPainting {
    match settings.drawing.under {
        Under::Grisaille => UnderPainting::Grisaille,
        Under::OwnColors => UnderPainting::OwnColors,
        Under::None => UnderPainting::None,
    }
}

/// What the volumes of all regions show together.
pub(super) fn inside(regions: &[RegionLook]) -> InsidePaint {
    let any = |wanted: fn(Inside) -> bool| regions.iter().any(|region| wanted(region.inside));
    match (any(has_own_colors), any(has_films)) {
        (true, false) => InsidePaint::OwnColors,
        (false, _) => InsidePaint::Glaze,
        (true, true) => InsidePaint::Both,
    }
}

/// Whether volumes show the scene's own colours.
pub(super) fn has_own_colors(inside: Inside) -> bool {
    inside != Inside::Glaze
}

/// Whether volumes show films of their pigments.
pub(super) fn has_films(inside: Inside) -> bool {
    inside != Inside::OwnColors
}

/// Where films lie.
pub(super) fn film_kind(settings: &Settings) -> FilmKind {
    match settings.drawing.film {
        Film::Surface => FilmKind::Surface,
        Film::Through => FilmKind::Through,
    }
}
