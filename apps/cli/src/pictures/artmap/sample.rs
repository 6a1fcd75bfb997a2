//! `impasto artmap sample` takes samples of a picture, by marks. With `--propose` it writes marks
//! that you can edit.

use std::path::PathBuf;

use artmap::passages::{Density, OverSegmentation, StrokesSeen, drawn_in};
use clap::{Args, ValueEnum, value_parser};
use documents::counted;
use pictures::{MarkFigures, MarksRequest, SampleFigures, SampleRequest};

use super::table::{Printed, Table, file_name, size, spacing};
use crate::console::Console;
use crate::failure::Result;
use crate::pictures::exports::heard;

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
    #[arg(long, value_name = "N", value_parser = value_parser!(u64).range(1..=MarksRequest::MOST as u64),
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
        let printed = Printed::of(self.json, self.csv);
        match self.propose {
            Some(count) => propose(&self.marks_request(count as usize), printed, console),
            None => sample(&self.request(), printed, console),
        }
    }

    /// The samples that these options ask for.
    fn request(self) -> SampleRequest {
        SampleRequest {
            over: self.over.method(),
            painting: self.painting,
            marks: self.marks,
            output: self.output,
            sheet: self.sheet,
            marked: self.marked,
            reach: self.reach,
            spacing: self.spacing,
            density: match self.density {
                ResizedBy::Uniform => Density::Uniform,
                ResizedBy::Width => Density::Width,
            },
            guess_relief: self.guess_relief,
            merge_minor: self.merge_minor,
        }
    }

    /// The marks that `--propose` asks for.
    fn marks_request(self, count: usize) -> MarksRequest {
        MarksRequest {
            over: self.over.method(),
            painting: self.painting,
            count,
            output: self.output,
            marked: self.marked,
            reach: self.reach,
            merge_minor: self.merge_minor,
        }
    }
}

impl Over {
    fn method(self) -> OverSegmentation {
        match self {
            Self::Jseg => OverSegmentation::Jseg,
            Self::MeanShift => OverSegmentation::MeanShift,
        }
    }
}

/// Takes samples, and prints a line on each.
fn sample(request: &SampleRequest, printed: Printed, console: &mut Console<'_>) -> Result<()> {
    let set = heard(console, |task, listener| Ok(request.run_heard(task, listener)?))?;
    if printed.as_data(&set, "samples", console)? {
        return Ok(());
    }
    console.line(format!(
        "{}: {} of {}, strokes {} apart",
        request.output.display(),
        counted(set.samples.len(), "sample"),
        file_name(&request.painting),
        spacing(&set)
    ))?;
    print(&set.samples, console)
}

fn print(samples: &[SampleFigures], console: &mut Console<'_>) -> Result<()> {
    let mut table =
        Table::new(&["name", "texels", "strokes at", "coherence", "spacing", "scale", "L*"]);
    for sample in samples {
        let Some(passage) = &sample.passage else { continue };
        let direction = passage.direction;
        let source = match (passage.sharpness, passage.spacing_seen_in) {
            (Some(sharpness), Some(seen)) => format!("sharpness {sharpness:.2}{}", in_relief(seen)),
            _ => passage.spacing_source.to_owned(),
        };
        let [across, along] = passage.scale;
        table.row(vec![
            sample.name.clone(),
            size(sample),
            match direction.turned {
                true => format!("{:.1} deg", direction.degrees),
                false => "none".to_owned(),
            },
            format!("{:.2}{}", direction.coherence, in_relief(direction.seen_in)),
            format!("{:.1} px ({source})", passage.spacing_px),
            if across == along {
                format!("{across:.2}")
            } else {
                format!("{across:.2} x {along:.2}")
            },
            format!("{:.1}", sample.lightness),
        ]);
    }
    table.print(console)
}

/// Words that say that strokes were seen in the relief. Empty if they were seen in the colours.
fn in_relief(seen: StrokesSeen) -> &'static str {
    if seen == StrokesSeen::Relief { " in relief" } else { "" }
}

/// Proposes marks, prints them, and prints the next command.
fn propose(request: &MarksRequest, printed: Printed, console: &mut Console<'_>) -> Result<()> {
    let marks = heard(console, |task, listener| Ok(request.run_heard(task, listener)?))?;
    if printed.as_data(&marks, "samples", console)? {
        return Ok(());
    }
    let path = request.output.display();
    console.line(format!("{path}: {}", counted(marks.samples.len(), "proposed sample")))?;
    print_proposed(&marks.samples, request.marked.is_some(), console)?;
    if !marks.without_spacing.is_empty() {
        console.remark(format!(
            "the distance between strokes cannot be seen in {}: mark their spacing, or leave them out",
            marks.without_spacing.join(", ")
        ))?;
    }
    console.remark(format!(
        "next: edit {path}, then impasto artmap sample {} --marks {path} --output samples.exr",
        request.painting.display()
    ))
}

/// Prints the lines, and the colours in which they were drawn.
fn print_proposed(marks: &[MarkFigures], drawn: bool, console: &mut Console<'_>) -> Result<()> {
    let headings = ["name", "scribble", "drawn in"];
    let mut table = Table::new(&headings[..if drawn { 3 } else { 2 }]);
    for (index, mark) in marks.iter().enumerate() {
        let line: Vec<String> = mark.scribble.iter().map(|[x, y]| format!("[{x}, {y}]")).collect();
        let mut cells = vec![mark.name.clone(), line.join(" to ")];
        cells.extend(drawn.then(|| drawn_in(index).to_owned()));
        table.row(cells);
    }
    table.print(console)
}
