//! Reads marks from a TOML file or from a picture of coloured lines over the painting. Also finds
//! the pixels under each line.

use std::path::Path;

use documents::file::write_whole;
use documents::name_violation;
use documents::text::{Source, read_text};
use graphics::field::Field;
use graphics::picture::Photograph;
use serde::{Deserialize, Serialize};
use spectra::color::Rgb;

use super::{Mark, MarkFault, MarkedArea, Marks, MarksError};

/// The hint for a fault that the parser has no hint for.
const KEYS: &str =
    "keys are painting, and in each sample name, spacing, and scribble, rectangle or pixels";

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

    /// Parses the text of a file of marks. `file` stands for the path in errors.
    ///
    /// # Errors
    /// [`MarksError`] with line, sample and key.
    pub fn from_toml(file: &str, text: &str) -> Result<Self, MarksError> {
        let whole: FileOfMarks = Source::toml_with_hint(file, text, KEYS)?.typed()?;
        if whole.sample.is_empty() {
            return Err(MarksError::NoSamples(file.to_owned()));
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

    /// These marks as the text of a TOML file.
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
        if name_violation(&self.name).is_some() {
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
                return Err(("scribble", MarkFault::Areas(found)));
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
        Some(&value) => Err(MarkFault::NotFinite(value)),
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

/// We allow this many lines. If there are more colours, they come from soft brushes or from the
/// painting itself.
const MOST_COLORS: usize = 64;

impl Marks {
    /// Reads a PNG of coloured lines on a transparent ground, as large as the painting. Each
    /// opaque colour is the scribble of one sample, named like `#c9a227`. This leaves out pixels
    /// that are not quite opaque, e.g. soft edges of a line.
    ///
    /// # Errors
    /// [`MarksError`] if the file cannot be read, has another size, or holds no lines or more than
    /// 64 colours.
    pub fn from_overlay(path: &Path, painting: (usize, usize)) -> Result<Self, MarksError> {
        let photograph = Photograph::open(path)?;
        let file = path.display().to_string();
        let (width, height) = photograph.size();
        if (width, height) != painting {
            return Err(MarksError::OverlaySize { file, found: (width, height), wanted: painting });
        }
        Self::from_lines(&file, &photograph.with_opacity(width, height))
    }

    /// Takes the lines from a picture of encoded sRGB with opacity, like [`Marks::from_overlay`].
    ///
    /// # Errors
    /// [`MarksError`] if there are no lines or more than 64 colours.
    pub fn from_lines(file: &str, lines: &Field<[f32; 4]>) -> Result<Self, MarksError> {
        let mut pixels: Vec<([u8; 3], u32)> = (0..)
            .zip(lines.values())
            .filter(|(_, [.., opacity])| *opacity > 1.0 - 0.5 / 255.0)
            .map(|(pixel, &[r, g, b, _])| (Rgb([r, g, b].map(f64::from)).to_bytes(), pixel))
            .collect();
        pixels.sort_unstable();
        let colors: Vec<&[([u8; 3], u32)]> = pixels.chunk_by(|a, b| a.0 == b.0).collect();
        let file = file.to_owned();
        if colors.is_empty() {
            return Err(MarksError::NoSamples(file));
        }
        if colors.len() > MOST_COLORS || pixels.len() == lines.values().len() {
            return Err(MarksError::OverlayColors { file, colors: colors.len() });
        }
        let width = lines.width() as u32;
        Ok(Self {
            file,
            painting: None,
            samples: colors
                .iter()
                .map(|line: &&[([u8; 3], u32)]| {
                    let name = Rgb(line[0].0.map(|byte| f64::from(byte) / 255.0)).to_hex();
                    let places =
                        line.iter().map(|(_, pixel)| [pixel % width, pixel / width]).collect();
                    Mark { name, area: MarkedArea::Pixels(places), spacing: None }
                })
                .collect(),
        })
    }
}

#[derive(Debug, Clone, PartialEq)]
pub(crate) enum DrawnArea {
    /// Pixels of a line. The sample grows from there.
    Line(Vec<u32>),
    Whole(Vec<u32>),
}

impl Marks {
    /// Checks that all marks lie on a picture of `width` x `height` pixels, and that no lines of
    /// two samples cross. You may pass marks without any sample.
    ///
    /// # Errors
    /// [`MarksError`] with sample and place.
    pub fn check(&self, width: usize, height: usize) -> Result<(), MarksError> {
        self.lines(width, height).map(|_| ())
    }

    /// The pixels of each mark on a picture of `width` x `height` pixels.
    ///
    /// # Errors
    /// [`MarksError`] if there are no samples, a place lies off the picture or two lines cross.
    pub(crate) fn drawn(&self, width: usize, height: usize) -> Result<Vec<DrawnArea>, MarksError> {
        if self.samples.is_empty() {
            return Err(MarksError::NoSamples(self.file.clone()));
        }
        let lines = self.lines(width, height)?.into_iter();
        let areas = lines.zip(&self.samples).map(|(line, mark)| match line {
            Some(pixels) => DrawnArea::Line(pixels),
            None => DrawnArea::Whole(mark.area.rectangle_pixels(width)),
        });
        Ok(areas.collect())
    }

    /// The pixels of each line. `None` for rectangles, which only have to lie on the picture.
    fn lines(&self, width: usize, height: usize) -> Result<Vec<Option<Vec<u32>>>, MarksError> {
        let fault = |mark: &Mark, key: &'static str, fault: MarkFault| MarksError::Sample {
            file: self.file.clone(),
            sample: mark.name.clone(),
            key,
            fault,
        };
        // Pixels of the lines so far with the numbers of their samples.
        let mut owners: Vec<(u32, usize)> = Vec::new();
        let mut lines = Vec::new();
        for (number, mark) in self.samples.iter().enumerate() {
            let key = mark.area.key();
            let line = mark.area.line(width, height).map_err(|found| fault(mark, key, found))?;
            for &[x, y] in mark.spacing.iter().flatten() {
                inside(x, y, width, height).map_err(|found| fault(mark, "spacing", found))?;
            }
            for &pixel in line.iter().flatten() {
                if let Ok(at) = owners.binary_search_by_key(&pixel, |&(taken, _)| taken) {
                    let other = self.samples[owners[at].1].name.clone();
                    let x = pixel as usize % width;
                    let y = pixel as usize / width;
                    return Err(fault(mark, key, MarkFault::Crossing { other, x, y }));
                }
            }
            owners.extend(line.iter().flatten().map(|&pixel| (pixel, number)));
            owners.sort_unstable();
            lines.push(line);
        }
        Ok(lines)
    }
}

fn inside(x: f64, y: f64, width: usize, height: usize) -> Result<(), MarkFault> {
    fn within(place: f64, size: usize) -> bool {
        (0.0..size as f64).contains(&place)
    }
    if within(x, width) && within(y, height) {
        return Ok(());
    }
    Err(MarkFault::OffPicture { x, y, width, height })
}

impl MarkedArea {
    /// The pixels of a line, in order and each once. `None` for a rectangle.
    fn line(&self, width: usize, height: usize) -> Result<Option<Vec<u32>>, MarkFault> {
        let mut pixels = Vec::new();
        let index = |x: usize, y: usize| (y * width + x) as u32;
        match self {
            Self::Scribble(points) => {
                points.iter().try_for_each(|&[x, y]| inside(x, y, width, height))?;
                let ends = points.iter().zip(points.iter().skip(1).chain(points.last()));
                for (&from, &to) in ends {
                    line(from, to, |x, y| pixels.push(index(x, y)));
                }
            }
            Self::Pixels(places) => {
                for &[x, y] in places {
                    inside(x.into(), y.into(), width, height)?;
                    pixels.push(index(x as usize, y as usize));
                }
            }
            &Self::Rectangle { x, y, width: across, height: down } => {
                inside(x.into(), y.into(), width, height)?;
                let right = f64::from(x) + f64::from(across) - 1.0;
                let below = f64::from(y) + f64::from(down) - 1.0;
                inside(right, below, width, height)?;
                return Ok(None);
            }
        }
        pixels.sort_unstable();
        pixels.dedup();
        Ok(Some(pixels))
    }

    /// The pixels of a rectangle on a picture of this width. Other areas give none.
    fn rectangle_pixels(&self, width: usize) -> Vec<u32> {
        let &Self::Rectangle { x, y, width: across, height: down } = self else {
            return Vec::new();
        };
        let rows = (y..y + down).map(|y| y as usize * width);
        let columns = (x..x + across).map(|x| x as usize);
        rows.flat_map(|row| columns.clone().map(move |x| (row + x) as u32)).collect()
    }
}

/// Calls `at` for the pixels of a line. Each is in the same row or column as the one before. This
/// way two lines that cross share a pixel.
fn line([x, y]: [f64; 2], [to_x, to_y]: [f64; 2], mut at: impl FnMut(usize, usize)) {
    let steps = (to_x - x).abs().max((to_y - y).abs()).ceil().max(1.0);
    let mut row = y as usize;
    for step in 0..=steps as usize {
        let share = step as f64 / steps;
        let place = [x + share * (to_x - x), y + share * (to_y - y)].map(|place| place as usize);
        at(place[0], row);
        row = place[1];
        at(place[0], row);
    }
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
        fn sample(rest: &str) -> String {
            format!("[[sample]]\nname = \"a\"\n{rest}\n")
        }
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
            (TEXT.replace("180.5", "inf"), "m.toml, sample `sky`, scribble: `inf` is not a place"),
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

    fn lines() -> Field<[f32; 4]> {
        let mut lines = Field::filled(12, 8, [0.0; 4]);
        for x in 2..9 {
            lines[(x, 2)] = [1.0, 0.0, 0.0, 1.0];
            lines[(x, 6)] = [0.0, 0.0, 1.0, 1.0];
        }
        lines[(9, 2)] = [0.9, 0.1, 0.0, 0.5];
        lines
    }

    #[test]
    fn each_opaque_color_is_a_line() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("lines.png");
        let mut encoder = png::Encoder::new(std::fs::File::create(&path).unwrap(), 12, 8);
        encoder.set_color(png::ColorType::Rgba);
        let lines = lines();
        let bytes = lines.values().iter().flatten().map(|v| (v * 255.0).round() as u8);
        encoder.write_header().unwrap().write_image_data(&bytes.collect::<Vec<u8>>()).unwrap();
        let marks = Marks::from_overlay(&path, (12, 8)).unwrap();
        let names: Vec<&str> = marks.samples.iter().map(|mark| mark.name.as_str()).collect();
        assert_eq!(names, ["#0000ff", "#ff0000"]);
        let places: Vec<[u32; 2]> = (2..9).map(|x| [x, 2]).collect();
        assert_eq!(marks.samples[1].area, MarkedArea::Pixels(places));
        let read = Marks::from_toml(&marks.file, &marks.to_toml()).unwrap();
        assert_eq!(read, marks, "and can be written as text");
        let error = Marks::from_overlay(&path, (12, 9)).unwrap_err().to_string();
        assert!(error.ends_with("12 x 8 pixels, but the painting has 12 x 9"), "{error}");
    }

    #[test]
    fn pictures_without_lines_are_refused() {
        let empty = Field::filled(5, 5, [0.3, 0.2, 0.1, 0.0]);
        let error = Marks::from_lines("l.png", &empty).unwrap_err();
        assert_eq!(error.to_string(), "l.png: there are no samples");
        let opaque = Field::filled(5, 5, [0.3, 0.2, 0.1, 1.0]);
        let error = Marks::from_lines("l.png", &opaque).unwrap_err();
        assert!(error.to_string().starts_with("l.png: 1 opaque colours"), "{error}");
        let mut many = Field::filled(100, 1, [0.0; 4]);
        (0..70).for_each(|x| many[(x, 0)] = [x as f32 / 100.0, 0.0, 0.0, 1.0]);
        let error = Marks::from_lines("l.png", &many).unwrap_err();
        assert!(error.to_string().starts_with("l.png: 70 opaque colours"), "{error}");
    }

    fn marks(areas: Vec<MarkedArea>) -> Marks {
        fn name(number: usize) -> String {
            ["one", "two", "three"][number].to_owned()
        }
        let samples = areas.into_iter().enumerate();
        let samples =
            samples.map(|(number, area)| Mark { name: name(number), area, spacing: None });
        Marks { file: "marks.toml".to_owned(), painting: None, samples: samples.collect() }
    }

    #[test]
    fn a_line_covers_each_row_that_it_passes() {
        let steep = marks(vec![MarkedArea::Scribble(vec![[2.0, 0.0], [4.9, 9.5]])]);
        let [DrawnArea::Line(pixels)] = &steep.drawn(10, 10).unwrap()[..] else {
            panic!("one line")
        };
        let rows: Vec<u32> = pixels.iter().map(|pixel| pixel / 10).collect();
        assert!((0..10).all(|row| rows.contains(&row)), "{pixels:?}");
        assert_eq!((pixels[0], pixels.last()), (2, Some(&94)));
    }

    #[test]
    fn a_rectangle_is_its_pixels() {
        let area = MarkedArea::Rectangle { x: 1, y: 2, width: 2, height: 2 };
        let drawn = marks(vec![area]).drawn(4, 4).unwrap();
        assert_eq!(drawn, [DrawnArea::Whole(vec![9, 10, 13, 14])]);
    }

    #[test]
    fn faults_name_file_sample_and_place() {
        fn line(from: [f64; 2], to: [f64; 2]) -> MarkedArea {
            MarkedArea::Scribble(vec![from, to])
        }
        let rectangle = MarkedArea::Rectangle { x: 5, y: 0, width: u32::MAX, height: 1 };
        let cases = [
            (
                marks(vec![line([1.0, 1.0], [8.0, 8.0]), line([8.0, 1.0], [1.0, 8.0])]),
                "marks.toml, sample `two`, scribble: crosses the line of sample `one` at [4, 4]",
            ),
            (
                marks(vec![line([1.0, 1.0], [10.0, 3.0])]),
                "marks.toml, sample `one`, scribble: [10, 3] lies off the picture of 10 x 10 pixels",
            ),
            (
                marks(vec![rectangle]),
                "marks.toml, sample `one`, rectangle: [4294967299, 0] lies off the picture of \
                 10 x 10 pixels",
            ),
            (
                marks(vec![MarkedArea::Pixels(vec![[3, 12]])]),
                "marks.toml, sample `one`, pixels: [3, 12] lies off the picture of 10 x 10 pixels",
            ),
            (marks(Vec::new()), "marks.toml: there are no samples"),
        ];
        for (marks, message) in cases {
            let error = marks.drawn(10, 10).unwrap_err();
            assert_eq!(error.to_string(), message);
            assert!(documents::hint::Explain::hint(&error).is_some(), "{message}");
            let checked = marks.check(10, 10).map_err(|error| error.to_string());
            let wanted = if marks.samples.is_empty() { Ok(()) } else { Err(message.to_owned()) };
            assert_eq!(checked, wanted, "{marks:?}");
        }
        let mut far = marks(vec![MarkedArea::Scribble(vec![[1.0, 1.0]])]);
        far.samples[0].spacing = Some([[1.0, 1.0], [1.0, -3.0]]);
        let message = far.drawn(10, 10).unwrap_err().to_string();
        assert!(message.contains("spacing: [1, -3] lies off"), "{message}");
    }
}
