//! `impasto artmap sample` takes samples of a picture, by marks. With `--propose` it writes marks
//! that you can edit.

use std::path::{Path, PathBuf};

use artmap::passages::{
    Density, Mark, MarkedArea, Marks, OverSegmentation, PassageError, PassageReport,
    PassageSettings, SourcePicture, SpacingSource, StrokesSeen, drawn_in, marked_picture,
    propose_marks, samples_of_picture,
};
use artmap::sample::{SampleSet, file};
use artmap::sheet::sheet;
use artmap::synthesis::SynthesisSettings;
use clap::{Args, ValueEnum, value_parser};
use documents::file::is_standard_input;
use documents::{counted, counted_as};
use serde_json::{Value, json};

use super::table::{FileAndSheet, Table, file_name, sample_json, set_json, size, source, spacing};
use crate::console::Console;
use crate::failure::Result;
use crate::output::Output;
use crate::pictures::{picture_bytes, picture_output, refuse_same};
use crate::progress::Waiting;
use crate::readings::is_toml;

/// Most samples that are proposed.
const MOST_PROPOSED: u64 = 64;

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Over {
    /// By colour and texture (Deng and Manjunath 2001)
    Jseg,
    /// By colour and place (Comaniciu and Meer 2002); suits scans with fine cracks
    MeanShift,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum ResizedBy {
    /// Both directions alike: strokes keep their shape
    Uniform,
    /// Across the strokes only
    Width,
}

/// Take samples from a painting or photograph, by marks
///
/// A mark is a scribble over a passage, which grows from there to the regions that are alike, or a
/// rectangle. Marks are a file (.toml) or a PNG of lines on a transparent ground, as large as the
/// picture, with one opaque colour for each sample. Without --marks the whole picture is one sample; --propose
/// writes marks to begin with.
///
/// Each sample is turned until its strokes run from top to bottom, and resized until all have the
/// distance between strokes of the median sample. Strokes should be at least 6 px apart in the picture,
/// and a passage at least four of them wide. Look at --marked first: it shows the passages.
#[derive(Debug, Args)]
pub(super) struct Sample {
    /// A picture (.png, .jpg, .tif, .webp), or a painting (.exr, as `impasto paint --output` writes
    /// it), which keeps its pigments and relief
    painting: PathBuf,
    /// Marks of the samples (.toml), or lines over the picture (.png)
    #[arg(long, value_name = "FILE", conflicts_with = "propose")]
    marks: Option<PathBuf>,
    /// Propose marks of this number of samples, to be edited: write them to --output (.toml), and
    /// take no samples
    #[arg(long, value_name = "N", value_parser = value_parser!(u64).range(1..=MOST_PROPOSED),
          conflicts_with_all = ["density", "spacing", "sheet"])]
    propose: Option<u64>,
    /// Write the samples (.exr); with --propose the marks (.toml)
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// Write a picture of all samples side by side, dark to light, the relief of the paint under a
    /// raking light below (.png, .exr)
    #[arg(long, value_name = "FILE")]
    sheet: Option<PathBuf>,
    /// Write the picture with the marks and the outlines of the passages drawn on it (.png, .exr)
    #[arg(long, value_name = "FILE")]
    marked: Option<PathBuf>,
    /// Method that divides the picture into small regions, which grow into passages
    #[arg(long, value_enum, default_value = "jseg")]
    over: Over,
    /// How unlike regions may be to join a passage, 0 to 10
    #[arg(long, value_name = "X", default_value_t = 1.0)]
    reach: f64,
    /// Distance between neighbouring strokes in pixels, 1 to 1000, for samples without a `spacing` in
    /// the marks [default: estimated; it is an error if the strokes are too unclear for that]
    #[arg(long, value_name = "PX")]
    spacing: Option<f64>,
    /// Directions in which samples are resized until all have the same distance between strokes
    #[arg(long, value_enum, default_value = "uniform")]
    density: ResizedBy,
    /// Guess the relief of a picture from its lightness: dark is deep. MM is the height from furrow to
    /// ridge, above 0 to 10; 0.2 is usual for oil. Light from one side and lighter paint are mistaken
    /// for relief
    #[arg(long, value_name = "MM", conflicts_with = "propose")]
    guess_relief: Option<f64>,
    /// If a painting has more than eight pigments, count each below 1 % as the one nearest in colour
    #[arg(long)]
    merge_minor: bool,
    /// Print JSON: provenance, spacing, pigments, and of each sample name, size, lightness, colour,
    /// height_mm, regions_under, direction, spacing_px and its source, scale, bounds in the picture ..
    #[arg(long)]
    json: bool,
    /// Print the samples as CSV
    #[arg(long, conflicts_with = "json")]
    csv: bool,
}

impl Sample {
    pub(super) fn run(self, console: &mut Console<'_>) -> Result<()> {
        let settings = self.settings();
        let mut inputs = vec![self.painting.clone()];
        inputs.extend(self.marks.clone());
        if let Some(count) = self.propose {
            let files = ProposalFiles::open(&self.output, self.marked.as_deref(), &inputs)?;
            let source = source(&self.painting, self.merge_minor, console)?;
            let proposal = Proposal { painting: &self.painting, count: count as usize, settings };
            return proposal.write(&source, files, (self.json, self.csv), console);
        }
        let files = FileAndSheet::open(&self.output, self.sheet.as_deref(), &inputs)?;
        let marked = picture_output(self.marked.as_deref(), &inputs)?;
        let [samples, sheet_file] = files.outputs();
        refuse_same(&[samples, sheet_file, marked.as_deref()])?;
        let source = source(&self.painting, self.merge_minor, console)?;
        let marks = self.marks(source.size(), console)?;
        let waiting = Waiting::new("finding passages", console.shows_progress());
        let (set, reports) = samples_of_picture(&source, &marks, &settings)?;
        let set = match self.guess_relief {
            Some(relief_mm) => set.with_guessed_relief(relief_mm)?,
            None => set,
        };
        drop(waiting);
        remark(&set, &reports, self.guess_relief.is_some(), console)?;
        let marked = match marked {
            Some(output) => {
                let shown = marked_picture(&source.color, &marks, &reports)?;
                Some((picture_bytes(&shown, &output, console)?, output))
            }
            None => None,
        };
        files.write(file::write(&set)?, || sheet(&set), console)?;
        if let Some((bytes, output)) = marked {
            output.write(bytes, console)?;
        }
        if self.json || self.csv {
            let samples = set.samples.iter().zip(&reports);
            let samples = samples.map(|(sample, report)| report_json(sample_json(sample), report));
            let samples: Vec<Value> = samples.collect();
            return match self.csv {
                true => console.csv_rows(&samples),
                false => console.json(&set_json(&set, samples)),
            };
        }
        console.line(format!(
            "{}: {} of {}, strokes {} apart",
            self.output.display(),
            counted(set.samples.len(), "sample"),
            file_name(&self.painting),
            spacing(&set)
        ))?;
        print(&set, &reports, console)
    }

    fn settings(&self) -> PassageSettings {
        PassageSettings {
            over: match self.over {
                Over::Jseg => OverSegmentation::Jseg,
                Over::MeanShift => OverSegmentation::MeanShift,
            },
            reach: self.reach,
            density: match self.density {
                ResizedBy::Uniform => Density::Uniform,
                ResizedBy::Width => Density::Width,
            },
            spacing: self.spacing,
            ..PassageSettings::default()
        }
    }

    /// The marks of `--marks`, or one of the whole picture.
    fn marks(&self, size: (usize, usize), console: &mut Console<'_>) -> Result<Marks> {
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
            Some(other) if other != own => console
                .warnings(&[format!("{} marks the picture {other}, not {own}", path.display())])?,
            _ => {}
        }
        Ok(marks)
    }
}

/// Prints what deserves a look before the samples are used.
fn remark(
    set: &SampleSet,
    reports: &[PassageReport],
    guess: bool,
    console: &mut Console<'_>,
) -> Result<()> {
    for report in reports.iter().filter(|report| !report.direction.turned) {
        console.remark(format!(
            "{}: the strokes have no common direction (coherence {:.2}), so it is not turned",
            report.name, report.direction.coherence
        ))?;
    }
    if guess && !set.samples.iter().any(|sample| sample.guessed_relief) {
        console.remark("the painting has true relief, so none is guessed")?;
    }
    let least = SynthesisSettings::LEAST_SPACING;
    if let Some(close) = set.samples.iter().find(|sample| sample.spacing < least) {
        console.warnings(&[format!(
            "strokes are {:.1} texels apart, too close for a map, which needs {least}: take a larger picture",
            close.spacing
        )])?;
    }
    if set.samples.len() == 1 {
        console
            .remark("one sample has a single tone: mark several passages, from dark to light")?;
    }
    Ok(())
}

/// Prints a line on each sample.
fn print(set: &SampleSet, reports: &[PassageReport], console: &mut Console<'_>) -> Result<()> {
    let mut table =
        Table::new(&["name", "texels", "strokes at", "coherence", "spacing", "scale", "L*"]);
    for (sample, report) in set.samples.iter().zip(reports) {
        let direction = report.direction;
        let source = match report.spacing_source {
            SpacingSource::Marked => "marked".to_owned(),
            SpacingSource::Set => "set".to_owned(),
            SpacingSource::Estimated { sharpness, seen } => {
                format!("sharpness {sharpness:.2}{}", in_relief(seen))
            }
        };
        let [across, along] = report.scale;
        table.row(vec![
            sample.name.clone(),
            size(sample),
            match direction.turned {
                true => format!("{:.1} deg", direction.degrees),
                false => "none".to_owned(),
            },
            format!("{:.2}{}", direction.coherence, in_relief(report.direction_seen)),
            format!("{:.1} px ({source})", report.spacing_px),
            if across == along {
                format!("{across:.2}")
            } else {
                format!("{across:.2} x {along:.2}")
            },
            format!("{:.1}", report.lightness),
        ]);
    }
    table.print(console)
}

/// Words that say that strokes were seen in the relief. Empty if they were seen in the colours.
fn in_relief(seen: StrokesSeen) -> &'static str {
    if seen == StrokesSeen::Relief { " in relief" } else { "" }
}

/// Name of a channel in JSON.
fn channel(seen: StrokesSeen) -> &'static str {
    match seen {
        StrokesSeen::Color => "colour",
        StrokesSeen::Relief => "relief",
    }
}

/// Adds the report of a sample to its JSON.
fn report_json(mut sample: Value, report: &PassageReport) -> Value {
    let direction = report.direction;
    let (source, sharpness, seen) = match report.spacing_source {
        SpacingSource::Marked => ("marked", None, None),
        SpacingSource::Set => ("set", None, None),
        SpacingSource::Estimated { sharpness, seen } => {
            ("estimated", Some(sharpness), Some(channel(seen)))
        }
    };
    let found = json!({
        "lightness": report.lightness,
        "pixels": report.pixels(),
        "bounds": report.bounds(),
        "regions_under": report.regions_under,
        "direction": {
            "degrees": direction.degrees,
            "coherence": direction.coherence,
            "turned": direction.turned,
            "seen_in": channel(report.direction_seen),
        },
        "spacing_px": report.spacing_px,
        "spacing_source": source,
        "sharpness": sharpness,
        "spacing_seen_in": seen,
        "scale": report.scale,
    });
    if let (Value::Object(sample), Value::Object(found)) = (&mut sample, found) {
        sample.extend(found);
    }
    sample
}

/// Head of a file of proposed marks, for whoever edits it.
const HEAD: &str = "\
# Marks of samples, in pixels from the upper left corner of the picture.
# scribble: points of a line over the passage, which grows from there.
# rectangle = [x, y, width, height]: exactly these pixels, instead of a scribble.
# spacing = [[x, y], [x, y]]: the middles of two neighbouring strokes, if their distance
# cannot be estimated.

";

/// Files of a proposal, checked to be writable.
pub(super) struct ProposalFiles {
    marks: Output,
    marked: Option<Output>,
}

impl ProposalFiles {
    /// Checks, before the slow part of the verb, that the files can be written.
    pub(super) fn open(marks: &Path, marked: Option<&Path>, inputs: &[PathBuf]) -> Result<Self> {
        let marks = Output::with_ending(marks, &["toml"], inputs)?;
        let marked = picture_output(marked, inputs)?;
        refuse_same(&[Some(&marks), marked.as_deref()])?;
        Ok(Self { marks, marked })
    }
}

/// Marks that are asked for.
pub(super) struct Proposal<'a> {
    pub(super) painting: &'a Path,
    /// Most samples.
    pub(super) count: usize,
    pub(super) settings: PassageSettings,
}

impl Proposal<'_> {
    /// Proposes marks for a picture, writes them, and prints them.
    pub(super) fn write(
        &self,
        source: &SourcePicture,
        files: ProposalFiles,
        (as_json, as_csv): (bool, bool),
        console: &mut Console<'_>,
    ) -> Result<()> {
        let waiting = Waiting::new("looking for passages", console.shows_progress());
        let mut marks = propose_marks(&source.color, self.count, &self.settings)?;
        let without = without_spacing(source, &marks, &self.settings);
        drop(waiting);
        marks.painting = Some(file_name(self.painting));
        let path = files.marks.path().display().to_string();
        let marked = match files.marked {
            Some(output) => {
                let shown = marked_picture(&source.color, &marks, &[])?;
                Some((picture_bytes(&shown, &output, console)?, output))
            }
            None => None,
        };
        let drawn = marked.is_some();
        files.marks.write(HEAD.to_owned() + &marks.to_toml(), console)?;
        if let Some((bytes, output)) = marked {
            output.write(bytes, console)?;
        }
        let found = marks.samples.len();
        if found < self.count {
            let passages =
                counted_as(found, "passage has strokes and is", "passages have strokes and are");
            console.remark(format!("only {passages} large enough"))?;
        }
        let samples: Vec<Value> = marks.samples.iter().map(mark_json).collect();
        if as_csv {
            return console.csv_rows(&samples);
        }
        if as_json {
            return console.json(&json!({
                "painting": marks.painting,
                "samples": samples,
                "without_spacing": without,
            }));
        }
        console.line(format!("{path}: {}", counted(found, "proposed sample")))?;
        print_proposed(&marks, drawn, console)?;
        if !without.is_empty() {
            console.remark(format!(
                "the distance between strokes cannot be seen in {}: mark their spacing, or leave them out",
                without.join(", ")
            ))?;
        }
        console.remark(format!(
            "next: edit {path}, then impasto artmap sample {} --marks {path} --output samples.exr",
            self.painting.display()
        ))
    }
}

/// Names of the samples for which you would have to mark the distance between strokes.
fn without_spacing(
    source: &SourcePicture,
    marks: &Marks,
    settings: &PassageSettings,
) -> Vec<String> {
    match samples_of_picture(source, marks, settings) {
        Err(PassageError::NoSpacing { samples }) => samples,
        _ => Vec::new(),
    }
}

/// Points of the line of a mark. Other areas have none.
fn points(mark: &Mark) -> &[[f64; 2]] {
    match &mark.area {
        MarkedArea::Scribble(points) => points,
        MarkedArea::Pixels(_) | MarkedArea::Rectangle { .. } => &[],
    }
}

/// Prints the lines, and the colours in which they were drawn.
fn print_proposed(marks: &Marks, drawn: bool, console: &mut Console<'_>) -> Result<()> {
    let headings = ["name", "scribble", "drawn in"];
    let mut table = Table::new(&headings[..if drawn { 3 } else { 2 }]);
    for (index, mark) in marks.samples.iter().enumerate() {
        let line: Vec<String> = points(mark).iter().map(|[x, y]| format!("[{x}, {y}]")).collect();
        let mut cells = vec![mark.name.clone(), line.join(" to ")];
        cells.extend(drawn.then(|| drawn_in(index).to_owned()));
        table.row(cells);
    }
    table.print(console)
}

fn mark_json(mark: &Mark) -> Value {
    json!({"name": mark.name, "scribble": points(mark)})
}
