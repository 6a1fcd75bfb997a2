//! Files of guides in TOML.

use std::path::Path;

use documents::file::write_whole;
use documents::text::{Source, line_of, read_text};
use serde::{Deserialize, Serialize};
use toml::Spanned;

use super::error::GuidesError;
use super::lines::Guides;

/// The way out where the parser knows none.
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

/// A list of `N` numbers: serde takes an array of more for one of `N`.
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

    /// Parses the text of a file of guides. Errors call the file `file`.
    ///
    /// # Errors
    /// [`GuidesError`] with line, guide and point.
    pub fn from_toml(file: &str, text: &str) -> Result<Self, GuidesError> {
        let whole: FileOfGuides = Source::toml_with_hint(file, text, KEYS)?.typed()?;
        let FileOfGuides { picture, size_px, camera, guide: entries } = whole;
        let points = |entry: &EntryOfGuide| {
            entry.points.get_ref().iter().map(|point| point.get_ref().0).collect()
        };
        let lines = entries.iter().map(points).collect();
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
            (swap("40.5", "nan"), "g.toml, line 6, guide 1: point 2: `NaN` is no place"),
            (swap("799.9", "inf"), "g.toml, line 10, guide 2: point 2: `inf` is no place"),
            (swap(", [799.9, 599]", ""), "g.toml, line 10, guide 2: a line needs at least two"),
            (swap("[799.9, 599]", "[0, 0]"), "g.toml, line 10, guide 2: all points are at"),
            (
                swap("[799.9, 599]", "[1, 2, 3]"),
                "g.toml, line 10: [[guide]] 2, points 2: expected 2 numbers",
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
            assert!(documents::hint::Explain::hint(&error).is_some(), "{message}");
        }
        let error = Guides::open(Path::new("nowhere/g.toml")).unwrap_err();
        assert!(error.to_string().contains("nowhere/g.toml"), "{error}");
    }
}
