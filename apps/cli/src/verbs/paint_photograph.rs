//! `impasto paint --from`: separates a photograph into pigments, or paints it in strokes.

use std::path::PathBuf;

use calibrate::library::PigmentLibrary;
use clap::Args;
use documents::hint::Explain;
use paint::export::save_files;
use paint::ground::GroundKind;
use serde_json::json;
use strokes::{
    ColorErrors, LevelReport, PaintProgress, PaintedPhotograph, Photograph, SeparatedFiles,
    StrokePainter, StrokePainterError, StrokeSettings, StrokeSettingsError,
};

use crate::canvas::grounds;
use crate::console::Console;
use crate::engine::EngineOptions;
use crate::failure::{Failure, Result, with_options};
use crate::output::Output;
use crate::palette::pigment_names;
use crate::pictures::Exports;
use crate::progress::{Progress, Waiting};

/// Options for painting a photograph.
#[derive(Debug, Args)]
#[command(next_help_heading = "Photographs")]
pub(crate) struct PhotographOptions {
    /// Paint this photograph (PNG, JPEG, TIFF or WebP; without a colour profile read as sRGB)
    #[arg(long, value_name = "PHOTO")]
    from: Option<PathBuf>,
    /// Up to eight pigments of the library, separated by commas [default: those that come nearest
    /// to the photograph's colours]
    #[arg(long, value_name = "PIGMENTS", requires = "from")]
    palette: Vec<String>,
    /// Width of the painting; its height follows the photograph's shape
    #[arg(long, value_name = "MM", default_value_t = 200.0, requires = "from")]
    width_mm: f64,
    /// Width of a cell; smaller cells show finer relief, half the width takes four times as long
    #[arg(long, value_name = "MM", default_value_t = 0.25, requires = "from")]
    cell_mm: f64,
    /// Ground to paint on
    #[arg(long, value_parser = grounds(), default_value = "linen", requires = "from")]
    ground: GroundKind,
    /// Widths of the brushes in mm, separated by commas; used from the broadest to the finest
    /// [default: 16,8,4,2,1 on 200 mm, and in proportion]
    #[arg(long, value_name = "MM", value_delimiter = ',', requires = "from")]
    brushes: Vec<f64>,
    /// Difference in CIELAB above which an area is painted over; less takes more strokes
    #[arg(long, value_name = "DELTA_E", default_value_t = 6.0, requires = "from")]
    tolerance: f64,
    /// Seed of all random choices
    #[arg(long, value_name = "N", default_value_t = 1, requires = "from")]
    seed: u64,
    /// Write the strokes as a script (.json) that paints the same, bit for bit
    #[arg(long, value_name = "FILE", requires = "from")]
    strokes_out: Option<PathBuf>,
    /// Write a map of each pigment, the picture they make and its colour error into this folder;
    /// paints nothing unless another file is asked for
    #[arg(long, value_name = "FOLDER", requires = "from")]
    separate: Option<PathBuf>,
    /// Let the ground show through in --separate, which reaches lighter and purer colours
    #[arg(long, requires = "separate")]
    thin: bool,
}

impl PhotographOptions {
    /// Whether a photograph is painted.
    pub(super) fn is_present(&self) -> bool {
        self.from.is_some()
    }

    pub(super) fn run(
        self,
        library: PigmentLibrary,
        library_path: Option<PathBuf>,
        engine: &EngineOptions,
        exports: Exports,
        as_json: bool,
        console: &mut Console<'_>,
    ) -> Result<()> {
        let from = self.from.clone().unwrap_or_default();
        let paints = exports.any() || self.strokes_out.is_some();
        if !paints && self.separate.is_none() {
            return Err(Failure::usage(
                "nothing would be written",
                "add --picture painting.png, --output painting.exr, or --separate FOLDER",
            ));
        }
        let settings = self.settings(&library);
        settings.check().map_err(settings_failure)?;
        if paints && self.thin {
            return Err(Failure::usage(
                "--thin works only with --separate: strokes overlap and must hide",
                "leave --thin out, or separate first and paint in a second run",
            ));
        }
        let photograph = Photograph::open(&from)?;
        settings.canvas(photograph.size()).map_err(settings_failure)?;
        let inputs: Vec<PathBuf> = std::iter::once(from).chain(library_path.clone()).collect();
        let exports = exports.open(&inputs)?;
        let strokes_out = self.strokes_out.as_ref().map(|path| Output::open(path, &inputs));
        let strokes_out = strokes_out.transpose()?;
        let waiting = Waiting::new("mixing colours", console.shows_progress());
        let painter =
            StrokePainter::new(&photograph, &library, &settings).map_err(painter_failure)?;
        drop(waiting);
        if let Some(folder) = &self.separate {
            let separated = painter.separate()?;
            save_files(folder, &separated.files)?;
            console.wrote(folder)?;
            if !paints {
                return report_separation(&separated, painter.pigments(), as_json, console);
            }
        }
        let engine = engine.engine(&painter.ground().height, console)?;
        let bar = Progress::new(0, "painting", console.shows_progress());
        let painted = painter.paint_with(engine, |progress| match progress {
            PaintProgress::Planned(strokes) => bar.expect(strokes),
            PaintProgress::Stroke => bar.step(),
        });
        bar.done();
        let mut painted = painted?;
        if let Some(path) = library_path {
            painted.script.library = Some(path.display().to_string());
        }
        if let Some(output) = strokes_out {
            output.write(painted.script.to_json()?, console)?;
        }
        exports.write(painted.painting_mut(), console)?;
        report(&painted, painter.pigments(), as_json, console)
    }

    /// Settings of the painter.
    fn settings(&self, library: &PigmentLibrary) -> StrokeSettings {
        let from = self.from.as_deref().and_then(|from| from.file_stem());
        StrokeSettings {
            title: from.map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default(),
            width_mm: self.width_mm,
            cell_mm: self.cell_mm,
            ground: self.ground,
            palette: pigment_names(&self.palette, library),
            brushes_mm: self.brushes.clone(),
            tolerance: self.tolerance,
            seed: self.seed,
            hides: !self.thin,
        }
    }
}

/// Converts an error of the painter, naming the option if a setting is out of range.
fn painter_failure(error: StrokePainterError) -> Failure {
    match error {
        StrokePainterError::Settings(error) => settings_failure(error),
        error => error.into(),
    }
}

/// Converts an error of the settings, naming the option if one is out of range.
fn settings_failure(error: StrokeSettingsError) -> Failure {
    let hint = error.hint().map(|hint| with_options(&hint)).unwrap_or_default();
    let StrokeSettingsError::OutOfRange { setting, value, least, most } = error else {
        return Failure::usage(error.to_string(), hint);
    };
    let option = match setting {
        "brushes_mm" => "--brushes".to_owned(),
        setting => format!("--{}", setting.replace('_', "-")),
    };
    Failure::usage(format!("{option} takes {least} to {most}, found `{value}`"), hint)
}

fn report_separation(
    separated: &SeparatedFiles,
    pigments: &[String],
    as_json: bool,
    console: &mut Console<'_>,
) -> Result<()> {
    if as_json {
        return console.json(&json!({"palette": pigments, "error": separated.error}));
    }
    console.line(format!("separated into {}", pigments.join(", ")))?;
    console.line(format!("colour error (CIEDE2000): {}", error_summary(&separated.error)))
}

fn report(
    painted: &PaintedPhotograph,
    pigments: &[String],
    as_json: bool,
    console: &mut Console<'_>,
) -> Result<()> {
    let PaintedPhotograph { session, levels, error, .. } = painted;
    let bounds = session.canvas().bounds();
    let backend = session.canvas().backend();
    if as_json {
        return console.json(&json!({
            "canvas": [bounds.width, bounds.height],
            "backend": backend,
            "palette": pigments,
            "levels": levels,
            "error": error,
        }));
    }
    console.line(format!(
        "{} x {} cells on {backend}, painted with {}",
        bounds.width,
        bounds.height,
        pigments.join(", ")
    ))?;
    for LevelReport { shape, size_mm, strokes, mean_error, .. } in levels {
        console.line(format!(
            "{shape} of {size_mm} mm: {}, then a mean colour error of {mean_error:.2} at its scale",
            documents::counted(*strokes, "stroke")
        ))?;
    }
    let finest_mm = levels.last().map_or(0.0, |level| level.size_mm);
    console.line(format!(
        "colour error at the scale of the {finest_mm} mm brush (CIEDE2000): {}",
        error_summary(error)
    ))
}

/// Formats colour errors in one line.
fn error_summary(errors: &ColorErrors) -> String {
    let ColorErrors { mean, median, p95, max, out_of_gamut, .. } = errors;
    format!(
        "mean {mean:.2}, median {median:.2}, 95th percentile {p95:.2}, largest {max:.2}; {:.1} % out of gamut",
        100.0 * out_of_gamut
    )
}
