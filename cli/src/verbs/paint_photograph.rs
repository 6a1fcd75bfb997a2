//! `impasto paint --from`: a photograph to pigments, and to strokes.

use std::path::PathBuf;

use calibrate::library::PigmentLibrary;
use clap::{Args, ValueEnum};
use render::light::Light;
use render::paint::document::{Lighting, Medium, Slots};
use render::paint::ground::{GroundRelief, GroundSpec, Linen, Panel, Paper};
use render::paint::painting::Painting;
use render::paint::session::PaintingSession;
use render::paint::strokes::{Canvas, MAX_CELLS, PaletteSpec, StrokeScript};
use render::photograph::{
    FilmMaterials, LevelReport, PaintFilm, Painted, Painter, Photograph, Picture, Plan, Separation,
    SeparationSettings, black_compensated, choose_palette,
};
use serde_json::json;

use super::separated;
use crate::console::Console;
use crate::engine::EngineOptions;
use crate::failure::Refusal;
use crate::output::Output;
use crate::palette::palette;
use crate::pictures::Exports;
use crate::progress::{Progress, Waiting};

/// The narrowest brush, in cells: a narrower one lays no even line.
const NARROWEST_CELLS: f64 = 2.0;
/// Films of a painted photograph, in mm.
const THINNEST_MM: f64 = 0.03;
const THICKEST_MM: f64 = 0.12;

#[derive(Debug, Clone, Copy, ValueEnum)]
enum GroundName {
    Linen,
    Paper,
    Panel,
}

/// What to do with a photograph.
#[derive(Debug, Args)]
#[command(next_help_heading = "Photographs")]
pub(crate) struct PhotographOptions {
    /// Paint after this photograph (PNG or JPEG, taken as sRGB)
    #[arg(long, value_name = "PHOTO")]
    from: Option<PathBuf>,
    /// Up to eight pigments of the library, separated by commas [default: those that come nearest
    /// to the photograph's colours]
    #[arg(long, value_name = "PIGMENTS", value_delimiter = ',', conflicts_with = "script")]
    palette: Vec<String>,
    /// Width of the painting; its height follows the photograph's shape
    #[arg(long, value_name = "MM", default_value_t = 200.0, conflicts_with = "script")]
    width_mm: f64,
    /// Width of a cell: smaller ones show finer relief, and take time by their square
    #[arg(long, value_name = "MM", default_value_t = 0.25, conflicts_with = "script")]
    cell_mm: f64,
    /// What is painted on
    #[arg(long, value_enum, default_value = "linen", conflicts_with = "script")]
    ground: GroundName,
    /// Widths of the brushes in mm, separated by commas; used from the broadest to the finest
    /// [default: 16,8,4,2 on 200 mm, and in proportion]
    #[arg(long, value_name = "MM", value_delimiter = ',', conflicts_with = "script")]
    brushes: Vec<f64>,
    /// The difference in CIELAB that is painted over: less takes more strokes
    #[arg(long, value_name = "DELTA_E", default_value_t = 6.0, conflicts_with = "script")]
    tolerance: f64,
    /// Seed of all that is drawn by lot
    #[arg(long, value_name = "N", default_value_t = 1, conflicts_with = "script")]
    seed: u64,
    /// Write the strokes as a script (.json) that paints the same, bit for bit
    #[arg(long, value_name = "FILE", conflicts_with = "script")]
    strokes_out: Option<PathBuf>,
    /// Write a map of each pigment, the picture they make and its colour error into this folder;
    /// paints nothing unless another file is asked for
    #[arg(long, value_name = "FOLDER", conflicts_with = "script")]
    separate: Option<PathBuf>,
    /// Let the ground shine through in --separate, which reaches lighter and purer colours
    #[arg(long, requires = "separate")]
    thin: bool,
}

/// What both painting and separating start from.
struct Start {
    canvas: Canvas,
    names: Vec<String>,
    separation: Separation,
    /// The photograph on the canvas, in tones that paint reaches.
    target: Picture,
}

impl PhotographOptions {
    pub(super) fn run(
        self,
        library: PigmentLibrary,
        library_path: Option<PathBuf>,
        engine: &EngineOptions,
        exports: Exports,
        as_json: bool,
        console: &mut Console<'_>,
    ) -> anyhow::Result<()> {
        let from = self.from.clone().unwrap_or_default();
        let paints = exports.any() || self.strokes_out.is_some();
        if !paints && self.separate.is_none() {
            return Err(Refusal::usage(
                "nothing would be written",
                "add --picture painting.png, --output painting.exr, or --separate FOLDER",
            ));
        }
        self.check()?;
        if paints && self.thin {
            return Err(Refusal::usage(
                "--thin is for --separate alone: strokes lie over each other and hide",
                "leave --thin out, or separate first and paint in a second run",
            ));
        }
        let photograph = Photograph::open(&from)?;
        let canvas = self.canvas(photograph.size())?;
        let inputs: Vec<PathBuf> =
            std::iter::once(from.clone()).chain(library_path.clone()).collect();
        let exports = exports.open(&inputs)?;
        let strokes_out = self.strokes_out.as_ref().map(|path| Output::open(path, &inputs));
        let strokes_out = strokes_out.transpose()?;
        let start = self.start(&photograph, canvas, &library, console)?;
        if let Some(folder) = &self.separate {
            let cell_mm = self.cell_mm;
            let Start { separation, target, names, .. } = &start;
            let errors = separated::write(folder, separation, target, names, cell_mm)?;
            if !paints {
                return separated::tell(&errors, names, as_json, console);
            }
        }
        let title = from.file_stem().map(|stem| stem.to_string_lossy().into_owned());
        let palette = PaletteSpec::from_names(start.names.iter().map(String::as_str));
        let mut script = StrokeScript::new(&title.unwrap_or_default(), "", start.canvas, palette);
        script.library =
            Some(library_path.map_or(library.title.clone(), |path| path.display().to_string()));
        let resolved = script.resolve(&library)?;
        let (width, height) = script.canvas.cells();
        let ground = script.canvas.ground.build(width, height, self.cell_mm, &library)?;
        let backend = engine.engine(&ground.height, console)?;
        // Nothing is ever taken back here.
        let canvas = Painting::open(script.bare(&library, &resolved, ground), backend, 0)?;
        let mut session = PaintingSession::new(canvas, None)?;
        let plan = self.plan();
        let painter = Painter { target: &start.target, separation: &start.separation, plan: &plan };
        let bar = Progress::new(0, "painting", console.screen.progress);
        let levels = painter.paint(&mut session, &mut script, |painted| match painted {
            Painted::Planned(strokes) => bar.expect(strokes),
            Painted::Stroke => bar.step(),
        });
        bar.done();
        let levels = levels?;
        if let Some(output) = strokes_out {
            output.write(script.to_json()?)?;
        }
        exports.write(session.canvas_mut(), console)?;
        tell(&painter, &levels, session.canvas_mut(), &start.names, as_json, console)
    }

    /// Refuses numbers that no painting has.
    fn check(&self) -> anyhow::Result<()> {
        let range = |option: &str, value: f64, least: f64, most: f64, hint: &str| {
            if (least..=most).contains(&value) {
                return Ok(());
            }
            Err(Refusal::usage(format!("{option} takes {least} to {most}, found `{value}`"), hint))
        };
        range("--width-mm", self.width_mm, 5.0, 5000.0, "200 mm is usual")?;
        range("--cell-mm", self.cell_mm, 0.02, 5.0, "0.25 mm is usual, 0.1 mm is fine")?;
        range("--tolerance", self.tolerance, 0.5, 100.0, "6 is usual; 3 paints more strokes")?;
        let narrowest = (NARROWEST_CELLS * self.cell_mm).max(0.2);
        let broadest = self.width_mm.min(100.0);
        for &size in &self.brushes {
            let hint = "brushes are two cells wide or more, at most 100 mm, none wider than the painting; --cell-mm takes smaller cells";
            range("--brushes", size, narrowest, broadest, hint)?;
        }
        Ok(())
    }

    /// A canvas of the photograph's shape.
    fn canvas(&self, (width, height): (usize, usize)) -> anyhow::Result<Canvas> {
        let columns = (self.width_mm / self.cell_mm).round().max(1.0);
        let rows = (columns * height as f64 / width as f64).round().max(1.0);
        if columns * rows > MAX_CELLS as f64 {
            return Err(Refusal::usage(
                format!("a canvas has at most {MAX_CELLS} cells, found `{columns} x {rows}`"),
                "take larger cells (--cell-mm) or a smaller painting (--width-mm)",
            ));
        }
        let relief = match self.ground {
            GroundName::Linen => GroundRelief::Linen(Linen::default()),
            GroundName::Paper => GroundRelief::Paper(Paper::default()),
            GroundName::Panel => GroundRelief::Panel(Panel::default()),
        };
        Ok(Canvas {
            width_mm: columns * self.cell_mm,
            height_mm: rows * self.cell_mm,
            cell_mm: self.cell_mm,
            ground: relief.into(),
        })
    }

    fn plan(&self) -> Plan {
        let mut plan = Plan::for_width(self.width_mm);
        // The finest of the usual five shows on close view only.
        plan.sizes_mm.truncate(4);
        plan.sizes_mm.retain(|size| *size >= (NARROWEST_CELLS * self.cell_mm).max(0.2));
        if !self.brushes.is_empty() || plan.sizes_mm.is_empty() {
            plan.sizes_mm.clone_from(&self.brushes);
        }
        plan.sizes_mm.sort_by(|a, b| b.total_cmp(a));
        Plan { tolerance: self.tolerance, seed: self.seed, ..plan }
    }

    fn start(
        &self,
        photograph: &Photograph,
        canvas: Canvas,
        library: &PigmentLibrary,
        console: &Console<'_>,
    ) -> anyhow::Result<Start> {
        let waiting = Waiting::new("mixing colours", console.screen.progress);
        let (width, height) = canvas.cells();
        let seen = photograph.on_canvas(width, height);
        let lighting = Lighting::default();
        let light = Light::named(library, &lighting.illuminant, &lighting.observer)?;
        let ground = GroundSpec::default().build(1, 1, canvas.cell_mm, library)?.reflectance;
        let settings = SeparationSettings {
            least_mm: THINNEST_MM,
            most_mm: THICKEST_MM,
            hides: !self.thin,
            ..SeparationSettings::default()
        };
        let bare = Slots::default();
        let materials = FilmMaterials {
            library,
            slots: &bare,
            ground: &ground,
            scattering_per_mm: Medium::default().scattering_per_mm,
        };
        let film = |materials: FilmMaterials<'_>| PaintFilm::at_nodes(materials, &light.quadrature);
        let slots = if self.palette.is_empty() {
            let toned = black_compensated(&seen, library.saunderson.floor() as f32);
            choose_palette(&toned, materials, film, &settings)?.slots
        } else {
            palette(&self.palette, library)?
        };
        let separation =
            Separation::new(film(FilmMaterials { slots: &slots, ..materials }), &settings)?;
        let target = black_compensated(&seen, separation.black());
        let names = slots.iter().flatten().map(|&i| library.pigments[i].name.clone()).collect();
        drop(waiting);
        Ok(Start { canvas, names, separation, target })
    }
}

fn tell(
    painter: &Painter<'_>,
    levels: &[LevelReport],
    painting: &mut Painting,
    names: &[String],
    as_json: bool,
    console: &mut Console<'_>,
) -> anyhow::Result<()> {
    let finest_mm = levels.last().map_or(0.0, |level| level.size_mm);
    let blur = Painter::sight_cells(finest_mm, painting.cell_mm());
    let error = painter.errors(painting, blur)?;
    let bounds = painting.bounds();
    if as_json {
        return console.json(&json!({
            "canvas": [bounds.width, bounds.height],
            "backend": painting.backend(),
            "palette": names,
            "levels": levels,
            "error": error,
        }));
    }
    console.line(format!(
        "{} x {} cells on {}, painted with {}",
        bounds.width,
        bounds.height,
        painting.backend(),
        names.join(", ")
    ))?;
    for LevelReport { shape, size_mm, strokes, mean_error, .. } in levels {
        console.line(format!(
            "{shape} of {size_mm} mm: {strokes} strokes, then {mean_error:.2} from the photograph at its scale"
        ))?;
    }
    console.line(format!(
        "colour error at the scale of the {finest_mm} mm brush (CIEDE2000): {}",
        separated::in_words(&error)
    ))
}
