//! Marks proposed by `impasto artmap sample --propose`.

use std::path::{Path, PathBuf};

use artmap::passages::{
    Mark, MarkedArea, Marks, PassageError, PassageSettings, SourcePicture, drawn_in,
    marked_picture, propose_marks, samples_of_picture,
};
use documents::{counted, counted_as};
use serde_json::{Value, json};

use super::source::file_name;
use super::table::Table;
use crate::console::Console;
use crate::failure::Result;
use crate::output::Output;
use crate::plain_picture::{picture_bytes, picture_output, refuse_same};
use crate::progress::Waiting;

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
        refuse_same(&[Some(&marks), marked.as_ref()])?;
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
        print(&marks, drawn, console)?;
        if !without.is_empty() {
            console.remark(format!(
                "the distance of strokes cannot be seen in {}: mark their spacing, or leave them out",
                without.join(", ")
            ))?;
        }
        console.remark(format!(
            "next: edit {path}, then impasto artmap sample {} --marks {path} --output samples.exr",
            self.painting.display()
        ))
    }
}

/// Names of the samples whose distance of strokes would have to be marked.
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

/// Points of the line of a mark; none for other areas.
fn points(mark: &Mark) -> &[[f64; 2]] {
    match &mark.area {
        MarkedArea::Scribble(points) => points,
        MarkedArea::Pixels(_) | MarkedArea::Rectangle { .. } => &[],
    }
}

/// Prints the lines, and the colours in which they were drawn.
fn print(marks: &Marks, drawn: bool, console: &mut Console<'_>) -> Result<()> {
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
