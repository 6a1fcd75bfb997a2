//! Runs requests for samples of brushwork and art maps. Each run first checks that its files can be written, then
//! does the work, then writes the files, each as a whole.

use std::{
    path::{Path, PathBuf},
    sync::Arc,
};

use artmap::{
    map::{self, ArtMap, Between},
    painted::{PaintedSettings, SwatchPainter},
    passages::{
        Marks, PassageError, PassageReport, SourcePicture, marked_picture, propose_marks,
        samples_of_picture,
    },
    sample::{self, SampleSet, WholePainting},
    sheet::sheet,
    synthesis::{Stage, SynthesisSettings},
    texel_file::TexelFileError,
};
use calibrate::Remark;
use documents::{
    Task, counted_as,
    file::{Output, is_standard_input, refuse_same},
    text::is_toml,
};
use graphics::{
    export::{PictureFormat, picture_file},
    field::Field,
    picture::{Photograph, Picture},
};
use paint::{document::Document, technique::Technique};

use crate::artmap_outcomes::{ArtMapOutcome, BrushworkOutcome, MarksOutcome, SamplesOutcome};
use crate::artmap_request::{
    ArtMapCheckRequest, ArtMapRequest, MarksRequest, SampleRequest, SheetRequest, SwatchRequest,
};
use crate::brushwork::style_of;
use crate::error::{PictureError, SettingError};
use crate::exports::{Listener, Note, PX_MM, StageFolder, Written, gamut_remark, opened, write};
use crate::style::library_of;

impl SampleRequest {
    /// Takes the samples, and writes their file, the sheet and the picture with its marks. Nothing is written
    /// before all samples were taken. `task` may end the work.
    ///
    /// ```
    /// use documents::Task;
    /// use documents::request::request_from_json;
    /// use graphics::{export::png8, field::Field};
    /// use pictures::SampleRequest;
    ///
    /// // Upright strokes, 8 pixels apart.
    /// let strokes = (0..64 * 48).map(|pixel| {
    ///     let light = 0.4 + 0.2 * (std::f32::consts::TAU * (pixel % 64) as f32 / 8.0).cos();
    ///     [light, light, light, 1.0]
    /// });
    /// let picture = Field::from_values(64, 48, strokes.collect());
    /// let folder = tempfile::tempdir()?;
    /// let painting = folder.path().join("strokes.png");
    /// std::fs::write(&painting, png8(&picture, 1.0)?.bytes)?;
    ///
    /// let output = folder.path().join("samples.exr");
    /// let json = format!(r#"{{"painting": {painting:?}, "output": {output:?}, "spacing": 8}}"#);
    /// let outcome = request_from_json::<SampleRequest>(&json)?.run(&Task::default())?;
    /// assert_eq!((outcome.samples.len(), outcome.spacing), (1, Some(8.0)));
    /// assert_eq!(outcome.written.files, [output]);
    /// println!("{}", serde_json::to_string(&outcome)?);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`PictureError`] for a setting out of its range, marks that do not fit the picture, strokes that cannot be
    /// seen, a file that cannot be read or written, and if `task` is cancelled.
    pub fn run(&self, task: &Task) -> Result<SamplesOutcome, PictureError> {
        self.run_heard(task, &mut |_| {})
    }

    /// Like [`Self::run`], but `listener` hears of each remark and each file when it happens.
    ///
    /// # Errors
    /// The errors of [`Self::run`].
    pub fn run_heard(
        &self,
        task: &Task,
        listener: &mut Listener<'_>,
    ) -> Result<SamplesOutcome, PictureError> {
        let (outcome, written) = collected(listener, |listener| {
            let inputs: Vec<PathBuf> =
                [&self.painting].into_iter().chain(&self.marks).cloned().collect();
            let files = FileAndSheet::open(&self.output, self.sheet.as_ref(), &inputs)?;
            let marked = picture_output(self.marked.as_ref(), &inputs)?;
            refuse_same(&[Some(&files.file), files.sheet.as_ref(), marked.as_ref()])?;
            begin(task, "finding passages")?;
            let source = source(&self.painting, self.merge_minor, listener)?;
            let marks = self.read_marks(source.size(), listener)?;
            let (set, reports) = samples_of_picture(&source, &marks, &self.settings())?;
            let set = match self.guess_relief {
                Some(relief_mm) => set.with_guessed_relief(relief_mm)?,
                None => set,
            };
            task.check()?;
            self.remark(&set, &reports, listener);
            let marked = marked_bytes(marked, &source, &marks, &reports, listener)?;
            files.write(sample::file::write(&set)?, || sheet(&set), listener)?;
            write_picture(marked, listener)?;
            Ok(SamplesOutcome::of_passages(&set, &reports))
        })?;
        Ok(SamplesOutcome { written, ..outcome })
    }

    /// The marks of the file. Without a file, this is one mark for the whole picture.
    fn read_marks(
        &self,
        size: (usize, usize),
        listener: &mut Listener<'_>,
    ) -> Result<Marks, PictureError> {
        let Some(path) = &self.marks else {
            let stem = self.painting.file_stem().unwrap_or_default().to_string_lossy();
            return Ok(Marks::of_whole(&stem, size));
        };
        let streamed = is_standard_input(path) && !is_toml(path);
        if streamed || path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("png")) {
            return Ok(Marks::from_overlay(path, size)?);
        }
        let marks = Marks::open(path)?;
        let own = file_name(&self.painting);
        match marks.painting.as_deref().map(|painting| file_name(Path::new(painting))) {
            Some(other) if other != own => listener(Note::Remark(Remark::warning(format!(
                "{} marks the picture {other}, not {own}",
                path.display()
            )))),
            _ => {}
        }
        Ok(marks)
    }

    /// Reports what you should check before you use the samples.
    fn remark(&self, set: &SampleSet, reports: &[PassageReport], listener: &mut Listener<'_>) {
        for report in reports.iter().filter(|report| !report.direction.turned) {
            listener(Note::Remark(Remark::note(format!(
                "{}: the strokes have no common direction (coherence {:.2}), so it is not turned",
                report.name, report.direction.coherence
            ))));
        }
        if self.guess_relief.is_some() && !set.samples.iter().any(|sample| sample.guessed_relief) {
            let text = "the painting has true relief, so none is guessed";
            listener(Note::Remark(Remark::note(text)));
        }
        let least = SynthesisSettings::LEAST_SPACING;
        if let Some(close) = set.samples.iter().find(|sample| sample.spacing < least) {
            listener(Note::Remark(Remark::warning(format!(
                "strokes are {:.1} texels apart, too close for a map, which needs {least}: take a larger picture",
                close.spacing
            ))));
        }
        if set.samples.len() == 1 {
            let text = "one sample has a single tone: mark several passages, from dark to light";
            listener(Note::Remark(Remark::note(text)));
        }
    }
}

/// Comments at the head of a file of proposed marks. They help you to edit it.
const HEAD: &str = "\
# Marks of samples, in pixels from the upper left corner of the picture.
# scribble: points of a line over the passage, which grows from there.
# rectangle = [x, y, width, height]: exactly these pixels, instead of a scribble.
# spacing = [[x, y], [x, y]]: the middles of two neighbouring strokes, if their distance
# cannot be estimated.

";

impl MarksRequest {
    /// Looks for passages that have strokes and that differ most from each other, and writes marks for them. You
    /// can then edit the file and name it in a [`SampleRequest`].
    ///
    /// # Errors
    /// [`PictureError`] for a setting out of its range, a picture without strokes, a file that cannot be read or
    /// written, and if `task` is cancelled.
    pub fn run(&self, task: &Task) -> Result<MarksOutcome, PictureError> {
        self.run_heard(task, &mut |_| {})
    }

    /// Like [`Self::run`], but `listener` hears of each remark and each file when it happens.
    ///
    /// # Errors
    /// The errors of [`Self::run`].
    pub fn run_heard(
        &self,
        task: &Task,
        listener: &mut Listener<'_>,
    ) -> Result<MarksOutcome, PictureError> {
        let (outcome, written) = collected(listener, |listener| self.propose(task, listener))?;
        Ok(MarksOutcome { written, ..outcome })
    }

    fn propose(
        &self,
        task: &Task,
        listener: &mut Listener<'_>,
    ) -> Result<MarksOutcome, PictureError> {
        if !(1..=Self::MOST).contains(&self.count) {
            let reason = format!("takes 1 to {}, found `{}`", Self::MOST, self.count);
            return Err(SettingError::of("count", reason, "try [count=8]").into());
        }
        let inputs = std::slice::from_ref(&self.painting);
        let output = Output::with_ending(&self.output, &["toml"], inputs)?;
        let marked = picture_output(self.marked.as_ref(), inputs)?;
        refuse_same(&[Some(&output), marked.as_ref()])?;
        begin(task, "looking for passages")?;
        let source = source(&self.painting, self.merge_minor, listener)?;
        let mut marks = propose_marks(&source.color, self.count, &self.settings())?;
        task.check()?;
        let without_spacing = match samples_of_picture(&source, &marks, &self.settings()) {
            Err(PassageError::NoSpacing(samples)) => samples,
            _ => Vec::new(),
        };
        task.check()?;
        let painting = file_name(&self.painting);
        marks.painting = Some(painting.clone());
        let marked = marked_bytes(marked, &source, &marks, &[], listener)?;
        write(&output, (HEAD.to_owned() + &marks.to_toml()).into_bytes(), listener)?;
        write_picture(marked, listener)?;
        let found = marks.samples.len();
        if found < self.count {
            let passages =
                counted_as(found, "passage has strokes and is", "passages have strokes and are");
            listener(Note::Remark(Remark::note(format!("only {passages} large enough"))));
        }
        let samples = marks.samples.iter().map(Into::into).collect();
        Ok(MarksOutcome { painting, samples, without_spacing, written: Written::default() })
    }
}

impl SwatchRequest {
    /// Paints the samples, and writes their file and the sheet. The same request gives the same bytes.
    ///
    /// # Errors
    /// [`PictureError`] for a style or hue that cannot be painted, a file that cannot be read or written, and if
    /// `task` is cancelled.
    pub fn run(&self, task: &Task) -> Result<SamplesOutcome, PictureError> {
        self.run_heard(task, &mut |_| {})
    }

    /// Like [`Self::run`], but `listener` hears of the library when it is read, and of each file when it is
    /// written.
    ///
    /// # Errors
    /// The errors of [`Self::run`].
    pub fn run_heard(
        &self,
        task: &Task,
        listener: &mut Listener<'_>,
    ) -> Result<SamplesOutcome, PictureError> {
        let (outcome, written) = collected(listener, |listener| {
            let (style, file) = style_of(&self.style)?;
            let library = Arc::new(library_of(self.library.as_deref(), listener)?);
            let inputs: Vec<PathBuf> = self.library.iter().cloned().chain(file).collect();
            let files = FileAndSheet::open(&self.output, self.sheet.as_ref(), &inputs)?;
            let colors = PaintedSettings {
                library,
                hue: self.hue.clone(),
                tones: self.tones,
                seed: self.seed,
            };
            let set = SwatchPainter::prepare(&colors, &style, task)?.paint((), task)?;
            files.write(sample::file::write(&set)?, || sheet(&set), listener)?;
            Ok(SamplesOutcome { style: Some(style.name), ..(&set).into() })
        })?;
        Ok(SamplesOutcome { written, ..outcome })
    }
}

impl ArtMapRequest {
    /// Makes the map, and writes its file, the sheet and the stages.
    ///
    /// This paints two tones and makes a map of them:
    ///
    /// ```
    /// use artmap::painted::Style;
    /// use documents::Task;
    /// use documents::request::request_from_json;
    /// use pictures::{ArtMapRequest, SwatchRequest};
    ///
    /// let folder = tempfile::tempdir()?;
    /// let [style, samples, map] =
    ///     ["small.toml", "samples.exr", "map.exr"].map(|name| folder.path().join(name));
    /// let dabs = Style::text("dabs")?.replace("= 300", "= 64").replace("= 0.18", "= 0.36");
    /// std::fs::write(&style, dabs)?;
    /// let json = format!(r#"{{"style": {style:?}, "tones": 2, "output": {samples:?}}}"#);
    /// let task = Task::default();
    /// let painted = request_from_json::<SwatchRequest>(&json)?.run(&task)?;
    /// assert_eq!(painted.samples.len(), 2);
    ///
    /// let json = format!(r#"{{"samples": [{samples:?}], "size": 64, "output": {map:?}}}"#);
    /// let made = request_from_json::<ArtMapRequest>(&json)?.run(&task)?;
    /// assert_eq!((made.tiles.len(), made.size), (2, 64));
    /// assert_eq!(made.pigments, painted.pigments);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`PictureError`] for a setting out of its range, samples that do not make a map, a file that cannot be
    /// read or written, and if `task` is cancelled.
    pub fn run(&self, task: &Task) -> Result<ArtMapOutcome, PictureError> {
        self.run_heard(task, &mut |_| {})
    }

    /// Like [`Self::run`], but `listener` hears of each remark and each file when it happens.
    ///
    /// # Errors
    /// The errors of [`Self::run`].
    pub fn run_heard(
        &self,
        task: &Task,
        listener: &mut Listener<'_>,
    ) -> Result<ArtMapOutcome, PictureError> {
        let (outcome, written) = collected(listener, |listener| {
            let files = FileAndSheet::open(&self.output, self.sheet.as_ref(), &self.samples)?;
            let folder = self.stages.as_deref();
            let folder =
                folder.map(|folder| StageFolder::open(folder, &self.samples)).transpose()?;
            begin(task, "building the map")?;
            let sets = self.samples.iter().map(|path| SampleSet::open(path));
            let set = SampleSet::joined(sets.collect::<Result<Vec<_>, _>>()?)?;
            task.check()?;
            let (map, stages) = match folder {
                Some(_) => ArtMap::with_stages(&set, &self.settings())?,
                None => (ArtMap::of(&set, &self.settings())?, Vec::new()),
            };
            task.check()?;
            let outcome = ArtMapOutcome::from(&map);
            task.check()?;
            if let Some(folder) = folder {
                write_stages(&folder, &stages, listener)?;
            }
            files.write(map::file::write(&map)?, || map.sheet(Between::default()), listener)?;
            Ok(outcome)
        })?;
        Ok(ArtMapOutcome { written, ..outcome })
    }
}

impl ArtMapCheckRequest {
    /// Reads the map and measures it. A fault of the map is not an error: you find it in the outcome.
    ///
    /// # Errors
    /// [`PictureError`] for a file that cannot be read or is not a map, and if `task` is cancelled.
    pub fn run(&self, task: &Task) -> Result<ArtMapOutcome, PictureError> {
        begin(task, "checking the map")?;
        Ok(ArtMapOutcome::from(&ArtMap::open(&self.map)?))
    }
}

/// Content of a file of brushwork.
enum Content {
    Samples(SampleSet),
    Map(Box<ArtMap>),
}

impl SheetRequest {
    /// Reads the file, and draws the sheet if you ask for one.
    ///
    /// # Errors
    /// [`PictureError`] for a file that cannot be read or holds neither samples nor a map, a sheet that cannot be
    /// written, and if `task` is cancelled.
    pub fn run(&self, task: &Task) -> Result<BrushworkOutcome, PictureError> {
        self.run_heard(task, &mut |_| {})
    }

    /// Like [`Self::run`], but `listener` hears of the sheet when it is written.
    ///
    /// # Errors
    /// The errors of [`Self::run`].
    pub fn run_heard(
        &self,
        task: &Task,
        listener: &mut Listener<'_>,
    ) -> Result<BrushworkOutcome, PictureError> {
        let (content, written) = collected(listener, |listener| {
            let output = picture_output(self.sheet.as_ref(), std::slice::from_ref(&self.file))?;
            begin(task, "reading brushwork")?;
            let content = self.content()?;
            if let Some(output) = output {
                let picture = match &content {
                    Content::Samples(set) => sheet(set),
                    Content::Map(map) => map.sheet(self.between),
                };
                let bytes = picture_bytes(&picture, &output, listener)?;
                write(&output, bytes, listener)?;
            }
            Ok(content)
        })?;
        Ok(match content {
            Content::Samples(set) => {
                BrushworkOutcome::Samples(SamplesOutcome { written, ..(&set).into() })
            }
            Content::Map(map) => BrushworkOutcome::Map(ArtMapOutcome { written, ..(&*map).into() }),
        })
    }

    /// Reads the file. If it holds neither samples nor a map, the error says that it has no samples.
    fn content(&self) -> Result<Content, PictureError> {
        match SampleSet::open(&self.file) {
            Ok(set) => Ok(Content::Samples(set)),
            Err(error @ TexelFileError::Format { .. }) => match ArtMap::open(&self.file) {
                Err(TexelFileError::Format { .. }) => Err(error.into()),
                map => Ok(Content::Map(Box::new(map?))),
            },
            Err(error) => Err(error.into()),
        }
    }
}

/// Reports that a stage begins. This fails if `task` is cancelled.
fn begin(task: &Task, stage: &str) -> Result<(), PictureError> {
    task.stage(stage);
    Ok(task.check()?)
}

/// Does `work` and returns its result with the files and remarks that it reported. They also go to `listener`.
fn collected<T>(
    listener: &mut Listener<'_>,
    work: impl FnOnce(&mut Listener<'_>) -> Result<T, PictureError>,
) -> Result<(T, Written), PictureError> {
    let mut written = Written::default();
    let done = work(&mut |note| written.pass(note, listener))?;
    Ok((done, written))
}

/// The file of samples or of a map, and its sheet. We have checked that you can write them.
struct FileAndSheet {
    file: Output,
    sheet: Option<Output>,
}

impl FileAndSheet {
    /// Checks, before long work, that both files can be written.
    fn open(
        file: &Path,
        sheet: Option<&PathBuf>,
        inputs: &[PathBuf],
    ) -> Result<Self, PictureError> {
        let file = Output::with_ending(file, &["exr"], inputs)?;
        let sheet = picture_output(sheet, inputs)?;
        refuse_same(&[Some(&file), sheet.as_ref()])?;
        Ok(Self { file, sheet })
    }

    /// Encodes both files, then writes them. This calls `sheet` to draw the sheet only if you ask for one.
    fn write(
        self,
        bytes: Vec<u8>,
        sheet: impl FnOnce() -> Picture,
        listener: &mut Listener<'_>,
    ) -> Result<(), PictureError> {
        let sheet = match self.sheet {
            Some(output) => Some((picture_bytes(&sheet(), &output, listener)?, output)),
            None => None,
        };
        write(&self.file, bytes, listener)?;
        write_picture(sheet, listener)
    }
}

/// The output of a picture that you only look at.
fn picture_output(
    path: Option<&PathBuf>,
    inputs: &[PathBuf],
) -> Result<Option<Output>, PictureError> {
    opened(path, &["png", "exr"], inputs)
}

/// Encodes a picture of linear sRGB for `output`. The listener hears of colours that the file cannot hold.
fn picture_bytes(
    picture: &Picture,
    output: &Output,
    listener: &mut Listener<'_>,
) -> Result<Vec<u8>, PictureError> {
    let opaque = picture.values().iter().map(|&[r, g, b]| [r, g, b, 1.0]).collect();
    let opaque = Field::from_values(picture.width(), picture.height(), opaque);
    let format = PictureFormat::from_path(output.path()).unwrap_or_default();
    let file = picture_file(&opaque, PX_MM, format)?;
    if let Some(outside) = file.outside_gamut() {
        listener(Note::Remark(gamut_remark(output.path(), outside)));
    }
    Ok(file.bytes)
}

/// Draws the marks on the picture and encodes it, if there is an `output`.
fn marked_bytes(
    output: Option<Output>,
    source: &SourcePicture,
    marks: &Marks,
    reports: &[PassageReport],
    listener: &mut Listener<'_>,
) -> Result<Option<(Vec<u8>, Output)>, PictureError> {
    let Some(output) = output else { return Ok(None) };
    let marked = marked_picture(&source.color, marks, reports)?;
    Ok(Some((picture_bytes(&marked, &output, listener)?, output)))
}

/// Writes an encoded picture to its output, if there is one.
fn write_picture(
    picture: Option<(Vec<u8>, Output)>,
    listener: &mut Listener<'_>,
) -> Result<(), PictureError> {
    picture.map_or(Ok(()), |(bytes, output)| write(&output, bytes, listener))
}

/// Writes the stages of a synthesis, numbered from 1.
fn write_stages(
    folder: &StageFolder,
    stages: &[Stage],
    listener: &mut Listener<'_>,
) -> Result<(), PictureError> {
    let outputs = folder.outputs(stages.iter().map(|stage| stage.name.as_str()))?;
    for (output, stage) in outputs.into_iter().zip(stages) {
        output.put(picture_bytes(&stage.picture, &output, listener)?)?;
    }
    listener(Note::Wrote(folder.path().to_owned()));
    Ok(())
}

/// Last part of a path, as text.
fn file_name(path: &Path) -> String {
    path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
}

/// Reads the picture at `path`. A painting (.exr) keeps its paint and relief. If it has more than eight
/// pigments and `merge_minor` is set, each pigment below 1 % counts as another one.
fn source(
    path: &Path,
    merge_minor: bool,
    listener: &mut Listener<'_>,
) -> Result<SourcePicture, PictureError> {
    if path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("exr")) {
        let painting = WholePainting::of(&Document::open(path)?, merge_minor)?;
        for [minor, into] in &painting.merged {
            let text = format!("{minor} is below 1 % of the pigment and counts as {into}");
            listener(Note::Remark(Remark::note(text)));
        }
        return Ok(SourcePicture::of_painting(painting));
    }
    let photograph = Photograph::open(path)?;
    let (width, height) = photograph.size();
    let provenance = format!("picture {}", file_name(path));
    Ok(SourcePicture::of_colors(photograph.on_canvas(width, height), provenance))
}

#[cfg(test)]
mod tests {
    use documents::hint::Explain;
    use graphics::export::png8;
    use serde_json::{Value, json};
    use tempfile::TempDir;

    use super::*;

    /// A picture of 200 x 100 pixels with upright strokes, 8 pixels apart: dark on the left, light on the right.
    fn strokes(folder: &TempDir) -> PathBuf {
        let colors = (0..200 * 100).map(|pixel| {
            let x = (pixel % 200) as f32;
            let grey = if x < 100.0 { 0.1 } else { 0.5 };
            let light = grey * (1.0 + 0.2 * (std::f32::consts::TAU * x / 8.0).cos());
            [light, light, light, 1.0]
        });
        let picture = Field::from_values(200, 100, colors.collect());
        let path = folder.path().join("strokes.png");
        std::fs::write(&path, png8(&picture, 1.0).unwrap().bytes).unwrap();
        path
    }

    const MARKS: &str = "\
        painting = \"strokes.png\"\n\
        [[sample]]\nname = \"light\"\nrectangle = [102, 2, 96, 96]\nspacing = [[120, 9], [128, 9]]\n\
        [[sample]]\nname = \"dark\"\nrectangle = [2, 2, 96, 96]\nspacing = [[20, 9], [28, 9]]\n";

    fn sample(folder: &TempDir) -> SampleRequest {
        let marks = folder.path().join("marks.toml");
        std::fs::write(&marks, MARKS).unwrap();
        SampleRequest {
            painting: strokes(folder),
            marks: Some(marks),
            output: folder.path().join("samples.exr"),
            sheet: None,
            marked: None,
            over: Default::default(),
            reach: 1.0,
            spacing: None,
            density: Default::default(),
            guess_relief: None,
            merge_minor: false,
        }
    }

    fn map_of(samples: &Path, output: PathBuf) -> ArtMapRequest {
        let json = json!({"samples": [samples], "size": 64, "output": output});
        serde_json::from_value(json).unwrap()
    }

    fn names(folder: &TempDir) -> Vec<String> {
        let entries = std::fs::read_dir(folder.path()).unwrap();
        let names = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap());
        let mut names: Vec<String> = names.collect();
        names.sort();
        names
    }

    #[track_caller]
    fn refused<T: std::fmt::Debug>(run: Result<T, PictureError>) -> (String, String) {
        let error = run.unwrap_err();
        (error.to_string(), error.hint().map(|hint| hint.to_string()).unwrap_or_default())
    }

    #[test]
    fn samples_and_their_files_are_those_of_the_marks() {
        let folder = tempfile::tempdir().unwrap();
        let file = |name: &str| folder.path().join(name);
        let request = SampleRequest {
            sheet: Some(file("sheet.png")),
            marked: Some(file("marked.png")),
            guess_relief: Some(0.2),
            ..sample(&folder)
        };
        let mut collected = Written::default();
        let mut listener = |note| collected.pass(note, &mut |_| {});
        let outcome = request.run_heard(&Task::default(), &mut listener).unwrap();
        let files = ["samples.exr", "sheet.png", "marked.png"].map(file);
        assert_eq!(outcome.written.files, files);
        assert_eq!(collected, outcome.written);
        let json = serde_json::to_value(&outcome).unwrap();
        let keys: Vec<&String> = json.as_object().unwrap().keys().collect();
        assert_eq!(keys, ["provenance", "spacing", "pigments", "samples"]);
        assert_eq!(
            (&json["provenance"], &json["spacing"]),
            (&json!("picture strokes.png"), &json!(8.0))
        );
        for (found, wanted) in json["samples"].as_array().unwrap().iter().zip(["dark", "light"]) {
            assert_eq!(
                (&found["name"], &found["spacing_source"]),
                (&json!(wanted), &json!("marked"))
            );
            assert_eq!(
                (&found["guessed_relief"], &found["sharpness"]),
                (&json!(true), &Value::Null)
            );
            assert_eq!(found["direction"]["seen_in"], "colour");
        }
        let sheet =
            SheetRequest { file: file("samples.exr"), sheet: None, between: Between::Blend };
        let BrushworkOutcome::Samples(shown) = sheet.run(&Task::default()).unwrap() else {
            panic!("samples are no map");
        };
        assert_eq!((shown.spacing, shown.samples.len()), (Some(8.0), 2));
        assert!(shown.samples.iter().all(|sample| sample.passage.is_none()));
    }

    #[test]
    fn a_single_sample_is_remarked() {
        let folder = tempfile::tempdir().unwrap();
        for (marks, remarks) in [(2, 0), (1, 1)] {
            let request = sample(&folder);
            let text: Vec<&str> = MARKS.split_inclusive("[[sample]]").collect();
            let text = text[..=marks].concat();
            std::fs::write(request.marks.as_ref().unwrap(), text.trim_end_matches("[[sample]]"))
                .unwrap();
            let outcome = request.run(&Task::default()).unwrap();
            let single = outcome.written.remarks.iter().filter(|text| text.contains("single tone"));
            assert_eq!(single.count(), remarks, "{outcome:?}");
        }
    }

    #[test]
    fn a_map_is_made_checked_and_drawn() {
        let folder = tempfile::tempdir().unwrap();
        let file = |name: &str| folder.path().join(name);
        let samples = sample(&folder);
        samples.run(&Task::default()).unwrap();
        let request = ArtMapRequest {
            stages: Some(file("stages")),
            ..map_of(&samples.output, file("map.exr"))
        };
        let made = request.run(&Task::default()).unwrap();
        assert_eq!(made.written.files, [file("stages"), file("map.exr")]);
        let json = serde_json::to_value(&made).unwrap();
        assert_eq!((&json["size"], &json["tiles"][0]["name"]), (&json!(64), &json!("dark")));
        assert!(json["faults"].as_array().unwrap().iter().all(Value::is_string), "{json}");
        assert_eq!(made.tiles.iter().filter(|tile| tile.is_first).count(), 1);

        let checked = ArtMapCheckRequest { map: file("map.exr") }.run(&Task::default()).unwrap();
        assert_eq!(serde_json::to_value(&checked).unwrap(), json);
        let sheet = Some(file("sheet.png"));
        let sheet = SheetRequest { file: file("map.exr"), sheet, between: Between::Dissolve };
        let BrushworkOutcome::Map(shown) = sheet.run(&Task::default()).unwrap() else {
            panic!("a map is no samples");
        };
        assert_eq!(shown.written.files, [file("sheet.png")]);
        assert_eq!(ArtMapOutcome { written: made.written.clone(), ..shown }, made);
    }

    #[test]
    fn proposed_marks_are_written_for_the_picture() {
        let folder = tempfile::tempdir().unwrap();
        let output = folder.path().join("marks.toml");
        let json = json!({"painting": strokes(&folder), "count": 64, "output": output});
        let request: MarksRequest = serde_json::from_value(json).unwrap();
        let outcome = request.run(&Task::default()).unwrap();
        assert_eq!(
            (outcome.painting.as_str(), &outcome.written.files),
            ("strokes.png", &vec![output.clone()])
        );
        let marks = Marks::open(&output).unwrap();
        assert_eq!(marks.samples.len(), outcome.samples.len());
        assert!(outcome.samples.iter().all(|mark| !mark.scribble.is_empty()), "{outcome:?}");
        let found = outcome.samples.len();
        for (count, remarks) in [(64, 1), (found + 1, 1), (found, 0)] {
            let outcome = MarksRequest { count, ..request.clone() }.run(&Task::default()).unwrap();
            let only = outcome.written.remarks.iter().filter(|text| text.starts_with("only "));
            assert_eq!(only.count(), remarks, "{count} of {found}: {outcome:?}");
        }
        for count in [0, 65] {
            let refused = refused(MarksRequest { count, ..request.clone() }.run(&Task::default()));
            let wanted = format!("count takes 1 to 64, found `{count}`");
            assert_eq!((refused.0, refused.1.as_str()), (wanted, "try `count = 8`"));
        }
    }

    #[test]
    fn requests_that_cannot_run_name_the_key_and_the_way_out_and_write_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let file = |name: &str| folder.path().join(name);
        let task = Task::default();
        let good = sample(&folder);
        type Change = fn(&mut SampleRequest);
        let changes: [(Change, &str, &str); 6] = [
            (|r| r.reach = 11.0, "reach takes 0 to 10, found `11`", "1 is usual"),
            (
                |r| r.spacing = Some(0.0),
                "spacing takes 1 to 1000, found `0`",
                "leave `spacing` out",
            ),
            (|r| r.guess_relief = Some(0.0), "a guessed relief is above 0", "guess_relief = 0.2"),
            (|r| r.output = r.painting.with_extension("png"), "ends in .exr", "strokes.exr"),
            (|r| r.sheet = Some(r.painting.clone()), "is an input file", "another file name"),
            (|r| r.marked = Some(r.output.clone()), "two outputs have this file name", "its own"),
        ];
        for (change, message, hint) in changes {
            let mut request = good.clone();
            change(&mut request);
            let found = refused(request.run(&task));
            assert!(found.0.contains(message) && found.1.contains(hint), "{found:?}");
        }
        let swatch = |style: &str, tones: usize| SwatchRequest {
            style: style.into(),
            library: None,
            hue: "#c9a227".to_owned(),
            tones,
            seed: None,
            output: file("swatches.exr"),
            sheet: None,
        };
        let unknown = refused(swatch("oils", 2).run(&task));
        assert_eq!(unknown.0, "there is no style called `oils`");
        assert!(unknown.1.starts_with("choose `style` among oil-flat"), "{unknown:?}");
        let one = refused(swatch("dabs", 1).run(&task));
        assert!(one.0.contains("2 to 12 tones, found `1`") && one.1.contains("`tones`"), "{one:?}");
        assert_eq!(names(&folder), ["marks.toml", "strokes.png"], "nothing was written");

        good.run(&task).unwrap();
        let map = map_of(&good.output, file("map.exr"));
        let small = refused(ArtMapRequest { size: 32, ..map.clone() }.run(&task));
        assert!(small.0.starts_with("`size` is 32") && small.1 == "change `size`", "{small:?}");
        let first =
            refused(ArtMapRequest { first: Some("x".to_owned()), ..map.clone() }.run(&task));
        assert!(first.1.ends_with("as `first`"), "{first:?}");
        let none = refused(ArtMapRequest { samples: Vec::new(), ..map }.run(&task));
        assert_eq!(none.0, "there is no sample to synthesise from");
        let check = refused(ArtMapCheckRequest { map: good.output.clone() }.run(&task));
        assert!(check.0.contains("no art map of impasto") && !check.1.is_empty(), "{check:?}");
        assert!(!names(&folder).contains(&"map.exr".to_owned()), "nothing was written");
    }

    #[test]
    fn cancelled_work_ends_and_writes_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let request = sample(&folder);
        let task = Task::default();
        task.cancel();
        assert!(matches!(request.run(&task), Err(PictureError::Cancelled(_))));
        let map = map_of(&request.output, folder.path().join("map.exr"));
        assert!(matches!(map.run(&task), Err(PictureError::Cancelled(_))));
        let swatches = json!({"style": "dabs", "output": folder.path().join("swatches.exr")});
        let swatches: SwatchRequest = serde_json::from_value(swatches).unwrap();
        assert!(swatches.run(&task).is_err());
        assert_eq!(names(&folder), ["marks.toml", "strokes.png"]);
    }
}
