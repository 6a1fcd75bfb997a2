//! Regions of a subject that you paint in another way than the rest, for example the sky with
//! longer strokes. This file holds their data, their TOML files and the faults of those files.

mod area;

use std::path::Path;

use documents::file::{NamedFileError, NamedFiles};
use documents::hint::Explain;
use documents::text::{Source, TextError, read_text};
use documents::{counted, name_violation};
use graphics::field::Field;
use graphics::picture::{Photograph, PhotographError};
use serde::Deserialize;
use spectra::color::Rgb;

pub(super) use area::{RegionMap, Style};

/// The regions of a subject. A later region lies over earlier ones.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Regions {
    /// Name for messages: the file that they were read from.
    pub name: String,
    /// The regions.
    pub list: Vec<Region>,
    /// Width and height in px of the picture that polygons and centres refer to, `None` for the
    /// subject's own size.
    pub size_px: Option<[u32; 2]>,
    /// Picture of labels, where each colour means a region. It has any size and is stretched over
    /// the subject.
    pub labels: Option<Field<[u8; 3]>>,
}

/// How you paint a part of a subject. Everything that is `None` stays as it is elsewhere.
#[derive(Debug, Clone, PartialEq)]
pub struct Region {
    /// Name for messages.
    pub name: String,
    /// The part of the subject that it covers.
    pub area: RegionArea,
    /// Name of the map of its brushwork.
    pub map: Option<String>,
    /// Direction of strokes in degrees: 0 to the right, 90 downwards, -360..=360. Pictures only.
    pub angle_deg: Option<f32>,
    /// Point in px that strokes run around, clockwise. Pictures only.
    pub around: Option<[f32; 2]>,
    /// Size of strokes relative to the settings, 0.1..=10.
    pub size: f32,
    /// Number of lengths of the map by which strokes move in a loop, 0..=16.
    pub flow: Option<u32>,
    /// How much lighter and darker strokes become in turn, as a share of the range of tones, 0..=1.
    pub twinkle: Option<f32>,
    /// Duration of one change to lighter and darker in seconds, 0.1..=3600.
    pub twinkle_seconds: Option<f32>,
    /// Darkest and lightest tone, 0 to 1.
    pub tones: Option<[f32; 2]>,
}

/// Place of a region.
#[derive(Debug, Clone, PartialEq)]
pub enum RegionArea {
    /// Inside this polygon, in px from the upper left corner of a picture. If the polygon crosses
    /// itself, the even-odd rule applies.
    Polygon(Vec<[f32; 2]>),
    /// Where the picture of labels has this colour, encoded sRGB.
    Label([u8; 3]),
    /// All parts of a model with this material.
    Material(String),
}

impl Region {
    /// A region that changes nothing yet.
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

/// Regions cannot be read, or do not fit the subject.
#[derive(Debug, thiserror::Error, Explain)]
pub enum RegionsError {
    /// The text cannot be read.
    #[error(transparent)]
    Text(#[from] TextError),
    /// The picture of labels is not there, or must not be named.
    #[error(transparent)]
    Named(#[from] NamedFileError),
    /// The picture of labels cannot be read.
    #[error(transparent)]
    Labels(#[from] PhotographError),
    /// A region has a fault.
    #[hint("{hint}")]
    #[error("{file}, region `{region}`: {fault}")]
    Region {
        /// Name of the file.
        file: String,
        /// Name of the region.
        region: String,
        /// The fault.
        fault: String,
        /// The way out.
        hint: String,
    },
}

impl RegionsError {
    fn region(file: &str, region: &str, fault: String, hint: &str) -> Self {
        let file = file.to_owned();
        let region = region.to_owned();
        Self::Region { file, region, fault, hint: hint.to_owned() }
    }
}

/// The way out where the parser knows none.
const KEYS: &str = "a region has a name and one of polygon, label and material; \
    docs/guide/painterly.md lists all keys";

/// The whole file.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FileOfRegions {
    labels: Option<String>,
    size_px: Option<[u32; 2]>,
    #[serde(default)]
    region: Vec<Entry>,
}

/// One `[[region]]`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Entry {
    name: String,
    polygon: Option<Vec<[f32; 2]>>,
    label: Option<String>,
    material: Option<String>,
    map: Option<String>,
    angle_deg: Option<f32>,
    around: Option<[f32; 2]>,
    size: Option<f32>,
    flow: Option<u32>,
    twinkle: Option<f32>,
    twinkle_seconds: Option<f32>,
    tones: Option<[f32; 2]>,
}

impl Regions {
    /// Reads a TOML file of regions, and the picture of labels that it names. `files` finds that
    /// picture, relative to the file.
    ///
    /// # Errors
    /// [`RegionsError`] with file, line or region, and key.
    pub fn open(path: &Path, files: &mut NamedFiles) -> Result<Self, RegionsError> {
        let name = path.display().to_string();
        let (mut own, labels) = parsed(&name, &read_text(path)?)?;
        if let Some(file) = labels {
            let found = files.find("labels", &file)?;
            own.labels = Some(labels_of(&Photograph::open(&found)?));
        }
        own.checked()
    }

    /// Parses the text of a file of regions without labels. `name` is the name of the file in
    /// errors.
    ///
    /// # Errors
    /// [`RegionsError`] with line or region, and key.
    pub fn from_toml(name: &str, text: &str) -> Result<Self, RegionsError> {
        parsed(name, text)?.0.checked()
    }

    /// Checks names, numbers and polygons, and that the picture of labels has every colour that a
    /// region names.
    ///
    /// # Errors
    /// [`RegionsError::Region`].
    pub fn checked(self) -> Result<Self, RegionsError> {
        for (index, region) in self.list.iter().enumerate() {
            let error = |fault, hint: &str| {
                Err(RegionsError::region(&self.name, &region.name, fault, hint))
            };
            if let Some(wanted) = name_violation(&region.name) {
                return error(format!("it needs {wanted}"), "shorten or correct its name");
            }
            if self.list[..index].iter().any(|other| other.name == region.name) {
                return error("two regions have this name".to_owned(), "give each its own name");
            }
            if let Some((key, value, range)) = region.out_of_range() {
                let [least, most] = range;
                let fault = format!("{key} takes {least} to {most}, found `{value}`");
                return error(fault, "write a number within the range");
            }
            match &region.area {
                RegionArea::Polygon(points) if points.len() < 3 => {
                    let fault = format!("polygon has {}", counted(points.len(), "point"));
                    return error(fault, "three points or more enclose an area");
                }
                RegionArea::Polygon(points)
                    if points.iter().flatten().any(|at| !at.is_finite()) =>
                {
                    let fault = "polygon has a point that is not a number".to_owned();
                    return error(fault, "points are px from the upper left corner");
                }
                &RegionArea::Label(color) => {
                    let hex = Rgb(color.map(|byte| f64::from(byte) / 255.0)).to_hex();
                    let Some(labels) = &self.labels else {
                        let fault = format!("label {hex} needs a picture of labels");
                        return error(fault, "add labels = \"labels.png\" above the regions");
                    };
                    if !labels.values().contains(&color) {
                        let fault = format!("the picture of labels has no pixel of {hex}");
                        return error(fault, "draw labels with a hard brush and save them as PNG");
                    }
                }
                _ => {}
            }
        }
        Ok(self)
    }
}

/// The regions, not checked, and the file of their labels.
fn parsed(name: &str, text: &str) -> Result<(Regions, Option<String>), RegionsError> {
    let whole: FileOfRegions = Source::toml_with_hint(name, text, KEYS)?.typed()?;
    let list: Result<Vec<Region>, RegionsError> =
        whole.region.into_iter().map(|entry| entry.region(name)).collect();
    let own = Regions { name: name.to_owned(), list: list?, size_px: whole.size_px, labels: None };
    Ok((own, whole.labels))
}

impl Entry {
    fn region(self, file: &str) -> Result<Region, RegionsError> {
        let error = |fault: &str, hint: &str| {
            RegionsError::region(file, &self.name, fault.to_owned(), hint)
        };
        let label = match self.label.as_deref().map(|text| (text, Rgb::from_hex(text))) {
            Some((text, None)) => {
                return Err(error(&format!("label `{text}` is not a colour"), "write \"#3050a0\""));
            }
            found => found.and_then(|(_, color)| color),
        };
        let areas = [
            self.polygon.clone().map(RegionArea::Polygon),
            label.map(|color| RegionArea::Label(color.to_bytes())),
            self.material.clone().map(RegionArea::Material),
        ];
        let mut areas = areas.into_iter().flatten();
        let (Some(area), None) = (areas.next(), areas.next()) else {
            return Err(error(
                "it needs exactly one of polygon, label and material",
                "polygon = [[0, 0], [640, 0], [640, 200]]",
            ));
        };
        if self.angle_deg.is_some() && self.around.is_some() {
            return Err(error("it has both angle_deg and around", "leave one of them out"));
        }
        Ok(Region {
            area,
            map: self.map,
            angle_deg: self.angle_deg,
            around: self.around,
            size: self.size.unwrap_or(1.0),
            flow: self.flow,
            twinkle: self.twinkle,
            twinkle_seconds: self.twinkle_seconds,
            tones: self.tones,
            name: self.name,
        })
    }
}

impl Region {
    /// The first number out of its range, with its key and the range.
    fn out_of_range(&self) -> Option<(&'static str, f32, [f32; 2])> {
        let numbers = [
            ("size", Some(self.size), [0.1, 10.0]),
            ("angle_deg", self.angle_deg, [-360.0, 360.0]),
            ("around", self.around.map(|[x, y]| x + y), [-1e6, 1e6]),
            ("flow", self.flow.map(|periods| periods as f32), [0.0, 16.0]),
            ("twinkle", self.twinkle, [0.0, 1.0]),
            ("twinkle_seconds", self.twinkle_seconds, [0.1, 3600.0]),
            ("tones", self.tones.map(|[darkest, _]| darkest), [0.0, 1.0]),
            ("tones", self.tones.map(|[_, lightest]| lightest), [0.0, 1.0]),
        ];
        let given =
            numbers.into_iter().filter_map(|(key, value, range)| Some((key, value?, range)));
        let mut wrong = given.filter(|(_, value, [least, most])| !(*least..=*most).contains(value));
        wrong.next()
    }
}

/// The colours of a picture of labels.
fn labels_of(picture: &Photograph) -> Field<[u8; 3]> {
    let (width, height) = picture.size();
    let colors = picture.with_opacity(width, height);
    let bytes = colors.values().iter();
    let bytes = bytes.map(|&[r, g, b, _]| Rgb([r, g, b].map(f64::from)).to_bytes()).collect();
    Field::from_values(width, height, bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "size_px = [640, 480]\n\n[[region]]\nname = \"sky\"\n\
        polygon = [[0, 0], [640, 0], [640, 200]]\nmap = \"night.exr\"\naround = [300, 90]\n\
        flow = 2\ntwinkle = 0.2\ntones = [0.1, 0.9]\nsize = 1.5\n\n\
        [[region]]\nname = \"roofs\"\nmaterial = \"roof\"\n";

    #[test]
    fn a_file_is_read() {
        let regions = Regions::from_toml("r.toml", TEXT).unwrap();
        assert_eq!(regions.size_px, Some([640, 480]));
        let [sky, roofs] = &regions.list[..] else { panic!("{regions:?}") };
        assert_eq!((sky.around, sky.flow, sky.size), (Some([300.0, 90.0]), Some(2), 1.5));
        assert_eq!((sky.map.as_deref(), sky.tones), (Some("night.exr"), Some([0.1, 0.9])));
        assert_eq!(*roofs, Region::new("roofs", RegionArea::Material("roof".to_owned())));
    }

    #[test]
    fn faults_name_line_region_and_key() {
        let region = |text: &str| format!("[[region]]\nname = \"a\"\n{text}");
        let polygon = "polygon = [[0, 0], [9, 0], [9, 9]]\n";
        for (text, wanted) in [
            (region("colour = 1"), "r.toml, line 3: [[region]] 1, colour: unknown key `colour`"),
            (region(""), "r.toml, region `a`: it needs exactly one of"),
            (region(&format!("{polygon}material = \"b\"")), "r.toml, region `a`: it needs"),
            (region("polygon = [[0, 0], [9, 0]]"), "r.toml, region `a`: polygon has 2 points"),
            (region("polygon = [[0, 0], [9, 0], [nan, 1]]"), "r.toml, region `a`: polygon has a"),
            (region("label = \"blue\""), "r.toml, region `a`: label `blue` is not a colour"),
            (region("label = \"#102030\""), "r.toml, region `a`: label #102030 needs a picture"),
            (region(&format!("{polygon}size = 20")), "r.toml, region `a`: size takes 0.1 to 10"),
            (region(&format!("{polygon}twinkle = nan")), "r.toml, region `a`: twinkle takes 0"),
            (
                region(&format!("{polygon}angle_deg = 1\naround = [1, 1]")),
                "r.toml, region `a`: it has both",
            ),
            (
                format!("{}\n{}", region(polygon), region(polygon)),
                "r.toml, region `a`: two regions have this name",
            ),
        ] {
            let error = Regions::from_toml("r.toml", &text).unwrap_err();
            assert!(error.to_string().starts_with(wanted), "{error}");
            assert!(Explain::hint(&error).is_some());
        }
    }

    #[test]
    fn labels_must_hold_the_colours_of_their_regions() {
        let labels = Field::from_values(2, 1, vec![[16, 32, 48], [0; 3]]);
        let [held, missing] = [[16, 32, 48], [16, 32, 49]].map(|color| {
            let list = vec![Region::new("a", RegionArea::Label(color))];
            Regions { list, labels: Some(labels.clone()), ..Regions::default() }.checked()
        });
        assert!(held.is_ok());
        let error = missing.unwrap_err().to_string();
        assert!(error.contains("no pixel of #102031"), "{error}");
    }
}
