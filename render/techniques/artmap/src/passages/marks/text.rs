//! Files of marks in TOML.

use std::path::Path;

use documents::file::write_whole;
use documents::text::{Source, read_text};
use serde::{Deserialize, Serialize};

use super::error::{MarkFault, MarksError};
use super::mark::{Mark, MarkedArea, Marks};

/// The way out where the parser knows none.
const KEYS: &str =
    "keys are painting, and in each sample name, spacing, and scribble, rectangle or pixels";

/// The whole file.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct FileOfMarks {
    #[serde(skip_serializing_if = "Option::is_none")]
    painting: Option<String>,
    #[serde(default)]
    sample: Vec<EntryOfSample>,
}

/// One `[[sample]]`.
#[derive(Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct EntryOfSample {
    name: String,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    scribble: Option<Vec<[f64; 2]>>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    rectangle: Option<[f64; 4]>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pixels: Option<Vec<[u32; 2]>>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    spacing: Option<[[f64; 2]; 2]>,
}

impl Marks {
    /// Reads a TOML file of marks.
    ///
    /// # Errors
    /// [`MarksError`] with file, line, sample and key.
    pub fn open(path: &Path) -> Result<Self, MarksError> {
        Self::from_toml(&path.display().to_string(), &read_text(path)?)
    }

    /// Parses the text of a file of marks. Errors call the file `file`.
    ///
    /// # Errors
    /// [`MarksError`] with line, sample and key.
    pub fn from_toml(file: &str, text: &str) -> Result<Self, MarksError> {
        let whole: FileOfMarks = Source::toml_with_hint(file, text, KEYS)?.typed()?;
        if whole.sample.is_empty() {
            return Err(MarksError::NoSamples { file: file.to_owned() });
        }
        let mut samples: Vec<Mark> = Vec::new();
        for entry in whole.sample {
            let name = entry.name.clone();
            let taken = samples.iter().any(|other| other.name == name);
            let mark = if taken { Err(("name", MarkFault::RepeatedName)) } else { entry.mark() };
            samples.push(mark.map_err(|(key, fault)| MarksError::Sample {
                file: file.to_owned(),
                sample: name,
                key,
                fault,
            })?);
        }
        Ok(Self { file: file.to_owned(), painting: whole.painting, samples })
    }

    /// Text of a file of these marks.
    ///
    /// # Panics
    /// Never: all marks can be written.
    #[must_use]
    pub fn to_toml(&self) -> String {
        let sample = self.samples.iter().map(EntryOfSample::of).collect();
        let whole = FileOfMarks { painting: self.painting.clone(), sample };
        toml::to_string(&whole).expect("numbers and names can be written")
    }

    /// Writes the marks to a TOML file.
    ///
    /// # Errors
    /// [`MarksError::File`].
    pub fn save(&self, path: &Path) -> Result<(), MarksError> {
        Ok(write_whole(path, self.to_toml().as_bytes())?)
    }
}

impl EntryOfSample {
    fn of(mark: &Mark) -> Self {
        let mut entry = Self { name: mark.name.clone(), spacing: mark.spacing, ..Self::default() };
        match &mark.area {
            MarkedArea::Scribble(points) => entry.scribble = Some(points.clone()),
            MarkedArea::Pixels(pixels) => entry.pixels = Some(pixels.clone()),
            &MarkedArea::Rectangle { x, y, width, height } => {
                entry.rectangle = Some([x, y, width, height].map(f64::from));
            }
        }
        entry
    }

    fn mark(self) -> Result<Mark, (&'static str, MarkFault)> {
        if self.name.trim().is_empty() {
            return Err(("name", MarkFault::NoName));
        }
        let points = self.scribble.iter().flatten().flatten();
        finite(points).map_err(|fault| ("scribble", fault))?;
        finite(self.spacing.iter().flatten().flatten()).map_err(|fault| ("spacing", fault))?;
        let scribble = self.scribble.map(MarkedArea::Scribble);
        let pixels = self.pixels.map(MarkedArea::Pixels);
        let rectangle = self.rectangle.map(rectangle).transpose();
        let rectangle = rectangle.map_err(|fault| ("rectangle", fault))?;
        let mut areas: Vec<MarkedArea> =
            [scribble, pixels, rectangle].into_iter().flatten().collect();
        let area = match areas.pop() {
            Some(area) if areas.is_empty() => area,
            last => {
                let found = areas.len() + usize::from(last.is_some());
                return Err(("scribble", MarkFault::Areas { found }));
            }
        };
        let empty = match &area {
            MarkedArea::Scribble(points) => points.is_empty(),
            MarkedArea::Pixels(pixels) => pixels.is_empty(),
            MarkedArea::Rectangle { .. } => false,
        };
        if empty {
            return Err((area.key(), MarkFault::NoPoints));
        }
        let mark = Mark { name: self.name, area, spacing: self.spacing };
        match mark.spacing_px() {
            Some(0.0) => Err(("spacing", MarkFault::NoDistance)),
            _ => Ok(mark),
        }
    }
}

fn finite<'a>(mut values: impl Iterator<Item = &'a f64>) -> Result<(), MarkFault> {
    match values.find(|value| !value.is_finite()) {
        Some(&value) => Err(MarkFault::NotFinite { value }),
        None => Ok(()),
    }
}

fn rectangle(numbers: [f64; 4]) -> Result<MarkedArea, MarkFault> {
    let [x, y, width, height] = numbers.map(|value| value as u32);
    if !numbers
        .into_iter()
        .all(|value: f64| value.fract() == 0.0 && (0.0..f64::from(u32::MAX)).contains(&value))
        || width == 0
        || height == 0
    {
        return Err(MarkFault::Rectangle);
    }
    Ok(MarkedArea::Rectangle { x, y, width, height })
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "painting = \"orchard.png\"\n\n[[sample]]\nname = \"sky\"\n\
        scribble = [[40, 32], [180.5, 60]]\nspacing = [[90, 40], [93, 44]]\n\n\
        [[sample]]\nname = \"grass\"\nrectangle = [20, 300, 120, 90]\n";

    #[test]
    fn a_file_is_read_and_written_back() {
        let marks = Marks::from_toml("m.toml", TEXT).unwrap();
        assert_eq!(marks.painting.as_deref(), Some("orchard.png"));
        let scribble = MarkedArea::Scribble(vec![[40.0, 32.0], [180.5, 60.0]]);
        assert_eq!(marks.samples[0].area, scribble);
        assert_eq!(marks.samples[0].spacing_px(), Some(5.0));
        let rectangle = MarkedArea::Rectangle { x: 20, y: 300, width: 120, height: 90 };
        assert_eq!((&marks.samples[1].area, marks.samples[1].spacing), (&rectangle, None));
        assert_eq!(Marks::from_toml("m.toml", &marks.to_toml()).unwrap(), marks);
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("m.toml");
        marks.save(&path).unwrap();
        assert_eq!(Marks::open(&path).unwrap().samples, marks.samples);
    }

    #[test]
    fn faults_name_file_line_sample_and_key() {
        let sample = |rest: &str| format!("[[sample]]\nname = \"a\"\n{rest}\n");
        let cases = [
            (
                TEXT.replace("spacing", "spaceing"),
                "m.toml, line 6: [[sample]] 1, spaceing: unknown key `spaceing`",
            ),
            (TEXT.replace("rectangle", "name"), "m.toml, line 10: duplicate key"),
            (
                TEXT.replace("[20, 300, 120, 90]", "\"x\""),
                "m.toml, line 10: [[sample]] 2, rectangle: invalid type",
            ),
            (TEXT.replace("grass", "sky"), "m.toml, sample `sky`, name: another sample"),
            (TEXT.replace("[93, 44]", "[90, 40]"), "m.toml, sample `sky`, spacing: both points"),
            (TEXT.replace("120, 90", "120, 0"), "m.toml, sample `grass`, rectangle: [x, y"),
            (TEXT.replace("180.5", "inf"), "m.toml, sample `sky`, scribble: `inf` is no place"),
            (TEXT.replace("\"grass\"", "\" \""), "m.toml, sample ` `, name: a sample needs"),
            (sample(""), "m.toml, sample `a`, scribble: a sample has one of"),
            (sample("scribble = []"), "m.toml, sample `a`, scribble: a line needs"),
            (
                sample("scribble = [[1,1]]\npixels = [[1,1]]"),
                "m.toml, sample `a`, scribble: a sample has one of",
            ),
            (String::new(), "m.toml: there are no samples"),
            ("painting = 3".to_owned(), "m.toml, line 1: painting: invalid type"),
        ];
        for (text, message) in cases {
            let error = Marks::from_toml("m.toml", &text).unwrap_err();
            assert!(error.to_string().starts_with(message), "{error}, wanted {message}");
            assert!(documents::hint::Explain::hint(&error).is_some(), "{message}");
        }
    }

    #[test]
    fn a_missing_file_is_named() {
        let error = Marks::open(Path::new("nowhere/m.toml")).unwrap_err();
        assert!(error.to_string().contains("nowhere/m.toml"), "{error}");
    }
}
