//! Regions as data.

use graphics::field::Field;

/// The regions of a subject. A later region lies over earlier ones.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Regions {
    /// Name for messages: the file that they were read from.
    pub name: String,
    /// The regions.
    pub list: Vec<Region>,
    /// Width and height in px of the picture that polygons and centres refer to; `None` for the
    /// subject's own size.
    pub size_px: Option<[u32; 2]>,
    /// Colours of labels, of any size: it is stretched over the subject.
    pub labels: Option<Field<[u8; 3]>>,
}

/// How a part of a subject is painted. What is `None` is as everywhere else.
#[derive(Debug, Clone, PartialEq)]
pub struct Region {
    /// Name for messages.
    pub name: String,
    /// Its place.
    pub area: RegionArea,
    /// Name of the map of its brushwork.
    pub map: Option<String>,
    /// Direction of strokes in degrees: 0 to the right, 90 downwards, -360..=360. Pictures only.
    pub angle_deg: Option<f32>,
    /// Point in px that strokes run around, clockwise. Pictures only.
    pub around: Option<[f32; 2]>,
    /// Size of strokes by that of the settings, 0.1..=10.
    pub size: f32,
    /// Lengths of the map by which strokes move in a loop, 0..=16.
    pub flow: Option<u32>,
    /// How much lighter and darker strokes become by turns, by the range of tones, 0..=1.
    pub twinkle: Option<f32>,
    /// Duration of one change to lighter and darker in seconds, 0.1..=3600.
    pub twinkle_seconds: Option<f32>,
    /// Darkest and lightest tone, 0 to 1.
    pub tones: Option<[f32; 2]>,
}

/// Place of a region.
#[derive(Debug, Clone, PartialEq)]
pub enum RegionArea {
    /// Inside this polygon, in px from the upper left corner of a picture; where it crosses itself,
    /// by the even-odd rule.
    Polygon(Vec<[f32; 2]>),
    /// Where the picture of labels has this colour, encoded sRGB.
    Label([u8; 3]),
    /// All of these parts of a model: materials with this name.
    Material(String),
}

impl Region {
    /// A region that differs in nothing.
    #[must_use]
    pub fn new(name: &str, area: RegionArea) -> Self {
        Self {
            name: name.to_owned(),
            area,
            map: None,
            angle_deg: None,
            around: None,
            size: 1.0,
            flow: None,
            twinkle: None,
            twinkle_seconds: None,
            tones: None,
        }
    }
}

impl RegionArea {
    /// Key of the area in a file of regions.
    #[must_use]
    pub fn key(&self) -> &'static str {
        match self {
            Self::Polygon(_) => "polygon",
            Self::Label(_) => "label",
            Self::Material(_) => "material",
        }
    }
}
