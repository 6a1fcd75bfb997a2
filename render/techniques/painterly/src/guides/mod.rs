//! Guides are lines that you draw by hand over a view of a model or over a picture. Strokes run
//! along them.
//!
//! You write them in a TOML file, for example:
//!
//! ```toml
//! picture = "view.png"
//! size_px = [800, 600]
//! camera = [30.0, 20.0, 30.0]
//!
//! [[guide]]
//! points = [[10, 20], [40, 25], [90, 60]]
//! ```
//!
//! Places are pixels from the upper left corner of a picture of `size_px`. They may be fractions.
//! Strokes run along a line. Anything that flows goes from its first point to its last. You give
//! `camera` for views of models: degrees around the model, above the horizon, and of the field of
//! view.

mod on_mesh;

use std::path::Path;

use documents::file::{FileError, write_whole};
use documents::hint::Explain;
use documents::text::{Source, TextError, line_of, read_text};
use glam::DVec2;
use graphics::camera::{Camera, Framing};
use serde::{Deserialize, Serialize};
use toml::Spanned;

pub use on_mesh::GuideSample;

/// Longest side of the picture in pixels.
const LONGEST_SIDE: u32 = 1 << 14;

/// Most pixels of the picture: a view of a model takes 16 bytes for each.
const MOST_PIXELS: u64 = 1 << 26;

/// Lines along which strokes run, drawn over one picture.
#[derive(Debug, Clone, PartialEq)]
pub struct Guides {
    /// Name of the file of the guides, for messages.
    pub file: String,
    /// File of the picture that they were drawn on, where it is known.
    pub picture: Option<String>,
    /// Width and height of that picture, 1 to 16384.
    pub size_px: [u32; 2],
    /// The camera of a view of a model, in degrees: around the model, above the horizon (-90 to
    /// 90), and of the field of view (1 to 170). `None` for other pictures.
    pub camera: Option<[f32; 3]>,
    /// The lines, each of two points or more in pixels from the upper left corner.
    pub lines: Vec<Vec<[f64; 2]>>,
}

impl Guides {
    /// Checks that the guides are on the picture.
    ///
    /// # Errors
    /// [`GuidesError`] with guide and point.
    pub fn check(&self) -> Result<(), GuidesError> {
        let [width, height] = self.size_px;
        let sides = 1..=LONGEST_SIDE;
        let pixels = u64::from(width) * u64::from(height);
        if !sides.contains(&width) || !sides.contains(&height) || pixels > MOST_PIXELS {
            return Err(GuidesError::Size { file: self.file.clone(), found: self.size_px });
        }
        if let Some(found @ [around, above, view]) = self.camera
            && !(around.is_finite() && above.abs() <= 90.0 && (1.0..=170.0).contains(&view))
        {
            return Err(GuidesError::Camera { file: self.file.clone(), found });
        }
        if self.lines.is_empty() {
            return Err(GuidesError::NoGuides(self.file.clone()));
        }
        self.lines.iter().enumerate().try_for_each(|(index, line)| {
            check_line(line, self.size_px).map_err(|fault| self.fault(index, fault))
        })
    }

    /// The camera from which you drew on a model of these vertices, `None` if the guides do not
    /// say.
    #[must_use]
    pub fn camera_around(&self, positions: &[[f32; 3]]) -> Option<Camera> {
        let [azimuth_deg, elevation_deg, field_of_view_deg] = self.camera?;
        let [width, height] = self.size_px.map(|side| side.max(1) as f32);
        let framing =
            Framing { azimuth_deg, elevation_deg, field_of_view_deg, aspect: width / height };
        Some(framing.fit(positions))
    }

    /// The error that the guide of this index has a fault.
    fn fault(&self, index: usize, fault: GuideFault) -> GuidesError {
        GuidesError::Guide { file: self.file.clone(), line: None, guide: index + 1, fault }
    }
}

fn check_line(points: &[[f64; 2]], size_px: [u32; 2]) -> Result<(), GuideFault> {
    if points.len() < 2 {
        return Err(GuideFault::FewPoints(points.len()));
    }
    for (&at, point) in points.iter().zip(1..) {
        if let Some(&value) = at.iter().find(|value| !value.is_finite()) {
            return Err(GuideFault::NotFinite { point, value });
        }
        if !at.iter().zip(size_px).all(|(place, side)| (0.0..f64::from(side)).contains(place)) {
            return Err(GuideFault::OffPicture { point, at, size_px });
        }
    }
    if points.iter().all(|point| *point == points[0]) {
        return Err(GuideFault::NoLength);
    }
    Ok(())
}

/// Guides cannot be read, or do not fit their picture or model.
#[derive(Debug, thiserror::Error, Explain)]
pub enum GuidesError {
    /// The file cannot be written.
    #[error(transparent)]
    File(#[from] FileError),
    /// The text cannot be read.
    #[error(transparent)]
    Text(#[from] TextError),
    /// The picture has no pixel, or too many.
    #[error("{file}, size_px: a picture of {} x {} pixels", found[0], found[1])]
    #[hint(
        verbatim,
        "write [800, 600] for a width and height of 1 to 16384, at most 67108864 \
        pixels"
    )]
    Size {
        /// Name of the file.
        file: String,
        /// Width and height.
        found: [u32; 2],
    },
    /// The camera is out of its range.
    #[error("{file}, camera: found `{found:?}`")]
    #[hint(
        verbatim,
        "write [30.0, 20.0, 30.0]: degrees around the model, above the horizon (-90 \
        to 90), and of the field of view (1 to 170)"
    )]
    Camera {
        /// Name of the file.
        file: String,
        /// Degrees around the model, above the horizon, and of the field of view.
        found: [f32; 3],
    },
    /// There is no guide.
    #[error("{0}: there are no guides")]
    #[hint(verbatim, "add a [[guide]] with points = [[10, 20], [90, 60]]")]
    NoGuides(String),
    /// A guide has a fault.
    #[error("{file}{}, guide {guide}: {fault}", line.map_or(String::new(), |at| format!(", line {at}")))]
    #[hint(verbatim, "{}", fault.way_out())]
    Guide {
        /// Name of the file.
        file: String,
        /// Line, counted from 1, where the guides were read from text.
        line: Option<usize>,
        /// Number of the guide, from 1.
        guide: usize,
        /// The fault.
        fault: GuideFault,
    },
}

/// Fault of one guide. Points count from 1.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum GuideFault {
    /// There are fewer than two points.
    #[error("a line needs at least two points, found {0}")]
    FewPoints(usize),
    /// A number is infinite or NaN.
    #[error("point {point}: `{value}` is not a place in a picture")]
    NotFinite {
        /// Number of the point.
        point: usize,
        /// The number found.
        value: f64,
    },
    /// A point lies outside of the picture.
    #[error("point {point}: [{}, {}] lies off the picture of {} x {} pixels", at[0], at[1], size_px[0], size_px[1])]
    OffPicture {
        /// Number of the point.
        point: usize,
        /// Column and row.
        at: [f64; 2],
        /// Width and height of the picture.
        size_px: [u32; 2],
    },
    /// All points are at one place.
    #[error("all points are at the same place")]
    NoLength,
    /// Nothing of the model is seen along the line.
    #[error("nothing of the model is seen along the line")]
    OffMesh,
}

impl GuideFault {
    /// Number of the point that has the fault, from 1.
    fn point(&self) -> Option<usize> {
        match *self {
            Self::NotFinite { point, .. } | Self::OffPicture { point, .. } => Some(point),
            _ => None,
        }
    }

    fn way_out(&self) -> &'static str {
        match self {
            Self::FewPoints(..) | Self::NoLength => {
                "draw the line from where strokes come to where they go"
            }
            Self::NotFinite { .. } | Self::OffPicture { .. } => {
                "places are [column, row] in pixels from the upper left corner of a picture of size_px"
            }
            Self::OffMesh => {
                "check camera and size_px: they must be those of the view that it was drawn on"
            }
        }
    }
}

/// One step of at most 1 px: its middle, and the unit direction of the line there.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Step {
    at: DVec2,
    along: DVec2,
}

/// The steps of a line from its first point to its last, places times `scale`.
fn steps(points: &[[f64; 2]], scale: DVec2) -> impl Iterator<Item = Step> {
    points.windows(2).flat_map(move |ends| {
        let [from, to] = [ends[0], ends[1]].map(|end| DVec2::from(end) * scale);
        let length = (to - from).length();
        let count = length.ceil();
        // A piece of length 0 has no step.
        let along = (to - from) / length.max(f64::MIN_POSITIVE);
        (0..count as usize).map(move |step| {
            let share = (step as f64 + 0.5) / count;
            Step { at: from.lerp(to, share), along }
        })
    })
}

/// The hint if the parser has none.
const KEYS: &str = "keys are picture, size_px and camera, and points in each [[guide]]";

/// The whole file, with the places of its points.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FileOfGuides {
    picture: Option<String>,
    size_px: Exactly<u32, 2>,
    camera: Option<Exactly<f32, 3>>,
    #[serde(default)]
    guide: Vec<EntryOfGuide>,
}

/// A list of exactly `N` numbers. If a file has more than `N`, serde would accept them as an array
/// of `N`. This type refuses them.
#[derive(Deserialize)]
#[serde(try_from = "Vec<T>")]
struct Exactly<T, const N: usize>([T; N]);

impl<T, const N: usize> TryFrom<Vec<T>> for Exactly<T, N> {
    type Error = String;

    fn try_from(numbers: Vec<T>) -> Result<Self, String> {
        numbers
            .try_into()
            .map(Self)
            .map_err(|numbers: Vec<T>| format!("expected {N} numbers, found {}", numbers.len()))
    }
}

/// One `[[guide]]`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct EntryOfGuide {
    points: Spanned<Vec<Spanned<Exactly<f64, 2>>>>,
}

/// The whole file as it is written.
#[derive(Serialize)]
struct WrittenGuides<'a> {
    #[serde(skip_serializing_if = "Option::is_none")]
    picture: Option<&'a str>,
    size_px: [u32; 2],
    #[serde(skip_serializing_if = "Option::is_none")]
    camera: Option<[f32; 3]>,
    guide: Vec<WrittenGuide<'a>>,
}

/// One `[[guide]]` as it is written.
#[derive(Serialize)]
struct WrittenGuide<'a> {
    points: &'a [[f64; 2]],
}

impl Guides {
    /// Reads a TOML file of guides.
    ///
    /// # Errors
    /// [`GuidesError`] with file, line, guide and point.
    pub fn open(path: &Path) -> Result<Self, GuidesError> {
        Self::from_toml(&path.display().to_string(), &read_text(path)?)
    }

    /// Parses the text of a file of guides. `file` is the name of the file in errors.
    ///
    /// # Errors
    /// [`GuidesError`] with line, guide and point.
    pub fn from_toml(file: &str, text: &str) -> Result<Self, GuidesError> {
        let whole: FileOfGuides = Source::toml_with_hint(file, text, KEYS)?.typed()?;
        let FileOfGuides { picture, size_px, camera, guide: entries } = whole;
        let points = entries.iter().map(|entry: &EntryOfGuide| entry.points.get_ref().iter());
        let lines = points.map(|points| points.map(|point| point.get_ref().0).collect()).collect();
        let size_px = size_px.0;
        let camera = camera.map(|camera| camera.0);
        let guides = Self { file: file.to_owned(), picture, size_px, camera, lines };
        let checked = guides.check().map_err(|error| match error {
            GuidesError::Guide { file, guide, fault, .. } => {
                let points = &entries[guide - 1].points;
                let point = fault.point().and_then(|number| points.get_ref().get(number - 1));
                let place = point.map_or(points.span().start, |point| point.span().start);
                GuidesError::Guide { file, line: Some(line_of(text, place)), guide, fault }
            }
            other => other,
        });
        checked.map(|()| guides)
    }

    /// Text of a file of these guides.
    ///
    /// # Panics
    /// Never: all guides can be written.
    #[must_use]
    pub fn to_toml(&self) -> String {
        let guide = self.lines.iter().map(|points| WrittenGuide { points }).collect();
        let Self { size_px, camera, .. } = *self;
        let whole = WrittenGuides { picture: self.picture.as_deref(), size_px, camera, guide };
        toml::to_string(&whole).expect("numbers and names can be written")
    }

    /// Writes the guides to a TOML file.
    ///
    /// # Errors
    /// [`GuidesError::File`].
    pub fn save(&self, path: &Path) -> Result<(), GuidesError> {
        Ok(write_whole(path, self.to_toml().as_bytes())?)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_camera_fits_the_model_into_a_picture_of_that_shape() {
        let mut guides = Guides {
            file: "g.toml".to_owned(),
            picture: None,
            size_px: [800, 400],
            camera: None,
            lines: vec![vec![[1.0, 1.0], [2.0, 2.0]]],
        };
        let corners = [[-1.0, -1.0, -1.0], [1.0, 1.0, 1.0]];
        assert_eq!(guides.camera_around(&corners), None);
        guides.camera = Some([30.0, 20.0, 40.0]);
        let wanted = Framing {
            azimuth_deg: 30.0,
            elevation_deg: 20.0,
            field_of_view_deg: 40.0,
            aspect: 2.0,
        };
        assert_eq!(guides.camera_around(&corners), Some(wanted.fit(&corners)));
    }

    #[test]
    fn steps_are_at_most_a_pixel_and_follow_the_line() {
        let points = [[0.0, 0.0], [3.0, 0.0], [3.0, 0.0], [3.0, 2.5]];
        let found: Vec<Step> = steps(&points, DVec2::new(1.0, 2.0)).collect();
        let right = found.iter().take(3).map(|step| (step.at.to_array(), step.along));
        let wanted = [0.5, 1.5, 2.5].map(|x| ([x, 0.0], DVec2::X));
        assert_eq!(right.collect::<Vec<_>>(), wanted);
        assert_eq!(found.len(), 3 + 5);
        assert_eq!(found[7], Step { at: DVec2::new(3.0, 4.5), along: DVec2::Y });
    }

    const TEXT: &str = "picture = \"view.png\"\nsize_px = [800, 600]\ncamera = [30, 20.1, 30]\n\n\
        [[guide]]\npoints = [[10, 20], [40.5, 25],\n  [90, 60]]\n\n\
        [[guide]]\npoints = [[0, 0], [799.9, 599]]\n";

    #[test]
    fn a_file_is_read_and_written_back() {
        let guides = Guides::from_toml("g.toml", TEXT).unwrap();
        assert_eq!(guides.picture.as_deref(), Some("view.png"));
        assert_eq!((guides.size_px, guides.camera), ([800, 600], Some([30.0, 20.1, 30.0])));
        assert_eq!(guides.lines[0], [[10.0, 20.0], [40.5, 25.0], [90.0, 60.0]]);
        assert_eq!(guides.lines.len(), 2);
        assert_eq!(Guides::from_toml("g.toml", &guides.to_toml()).unwrap(), guides);
        let bare = Guides { picture: None, camera: None, ..guides.clone() };
        assert_eq!(Guides::from_toml("g.toml", &bare.to_toml()).unwrap(), bare);
        let folder = std::env::temp_dir().join(format!("impasto-guides-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        let path = folder.join("g.toml");
        guides.save(&path).unwrap();
        let read = Guides::open(&path).unwrap();
        std::fs::remove_dir_all(&folder).unwrap();
        assert_eq!(read.lines, guides.lines);
    }

    #[test]
    fn faults_name_file_line_guide_and_point() {
        let swap = |from: &str, to: &str| TEXT.replace(from, to);
        let cases = [
            (swap("[90, 60]", "[800, 60]"), "g.toml, line 7, guide 1: point 3: [800, 60] lies off"),
            (swap("[0, 0]", "[0, -1]"), "g.toml, line 10, guide 2: point 1: [0, -1] lies off"),
            (swap("40.5", "nan"), "g.toml, line 6, guide 1: point 2: `NaN` is not a place"),
            (swap("799.9", "inf"), "g.toml, line 10, guide 2: point 2: `inf` is not a place"),
            (swap(", [799.9, 599]", ""), "g.toml, line 10, guide 2: a line needs at least two"),
            (swap("[799.9, 599]", "[0, 0]"), "g.toml, line 10, guide 2: all points are at"),
            (
                swap("[799.9, 599]", "[1, 2, 3]"),
                "g.toml, line 10: [[guide]] 2, points: expected 2 numbers, found 3",
            ),
            (
                swap("800, 600", "800, 600, 3"),
                "g.toml, line 2: size_px: expected 2 numbers, found 3",
            ),
            (swap("[0, 0]", "\"x\""), "g.toml, line 10: [[guide]] 2, points 1: invalid type"),
            (swap("picture", "pictures"), "g.toml, line 1: pictures: unknown key `pictures`"),
            (
                swap("points = [[0", "points = []\npoint = [[0"),
                "g.toml, line 11: [[guide]] 2, point: unknown",
            ),
            (swap("800, 600", "800, 0"), "g.toml, size_px: a picture of 800 x 0"),
            (swap("800, 600", "16384, 16384"), "g.toml, size_px: a picture of 16384 x"),
            (swap("800, 600", "800, -6"), "g.toml, line 2: "),
            (swap("20.1", "91"), "g.toml, camera: found `[30.0, 91.0, 30.0]`"),
            (swap("[30, 20.1, 30]", "[nan, 20, 30]"), "g.toml, camera: found"),
            ("size_px = [8, 6]".to_owned(), "g.toml: there are no guides"),
            (String::new(), "g.toml, line 1: the key `size_px` is missing"),
        ];
        for (text, message) in cases {
            let error = Guides::from_toml("g.toml", &text).unwrap_err();
            assert!(error.to_string().starts_with(message), "{error}, wanted {message}");
            assert!(Explain::hint(&error).is_some(), "{message}");
        }
        let error = Guides::open(Path::new("nowhere/g.toml")).unwrap_err();
        assert!(error.to_string().contains("nowhere/g.toml"), "{error}");
    }
}
