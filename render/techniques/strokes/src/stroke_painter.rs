//! A photograph painted in strokes, or separated into a map of each pigment, with all the set-up:
//! canvas, palette, light and tones that paint reaches.

use documents::hint::Explain;
use documents::{Cancelled, Task};
use graphics::export::{ExportError, png8};
use graphics::field::Field;
use graphics::gpu::{BackendChoice, DeviceError};
use graphics::picture::{Photograph, Picture};
use paint::document::{Lighting, Medium, PaletteError, Slots, palette_slots};
use paint::engine::PaintEngine;
use paint::export::{NamedFile, PigmentMap, pigment_maps};
use paint::ground::{ColorPrimer, Ground, GroundError, Primer};
use paint::light::{Light, PaintLightError};
use paint::painting::{Painting, PaintingError};
use paint::separation::{
    ColorErrors, FilmMaterials, PaintFilm, Separation, SeparationError, SeparationSettings,
    choose_palette, rebuild_picture,
};
use paint::session::PaintingSession;
use paint::strokes::{PaletteSpec, Resolved, ScriptError, StrokeScript};
use pigment::PigmentLibrary;
use pigment::library::to_text;
use rayon::prelude::*;
use serde_json::json;
use spectra::color::Rgb;

use super::painter::{LevelReport, Painter, PainterError};
use super::settings::{Plan, StrokeSettings, StrokeSettingsError};

/// Heights of the films of a painted photograph in mm (chosen by eye: the thinnest still
/// hides with most pigments, the thickest shows relief at the default cell size).
const FILM_MM: [f64; 2] = [0.03, 0.12];

/// Paints one photograph in strokes of calibrated paint.
///
/// ```no_run
/// use documents::Task;
/// use graphics::gpu::BackendChoice;
/// use graphics::picture::Photograph;
/// use pigment::PigmentLibrary;
/// use strokes::{StrokePainter, StrokeSettings};
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let oils = PigmentLibrary::van_gogh_oils();
/// let photograph = Photograph::open("wheat.jpg".as_ref())?;
/// let painter = StrokePainter::new(&photograph, &oils, &StrokeSettings::default())?;
/// let mut painted = painter.paint(BackendChoice::Auto, &Task::default())?;
/// println!("{}: {:.1} CIEDE2000", painter.pigments().join(", "), painted.error.mean);
/// painted.painting_mut().document()?.save("wheat.exr".as_ref())?;
/// # Ok(())
/// # }
/// ```
#[derive(Debug)]
pub struct StrokePainter {
    /// Header of the script of strokes: canvas, palette and title.
    script: StrokeScript,
    resolved: Resolved,
    library: PigmentLibrary,
    ground: Ground,
    pigments: Vec<String>,
    separation: Separation,
    /// The photograph on the canvas in tones that paint reaches.
    target: Picture,
    plan: Plan,
}

/// A photograph that has been painted in strokes.
#[derive(Debug)]
pub struct PaintedPhotograph {
    /// The session on the painted canvas. You cannot undo here.
    pub session: PaintingSession,
    /// The strokes. If you play them on a bare canvas, you get this painting bit for bit.
    pub script: StrokeScript,
    /// Report of each brush, coarse to fine.
    pub levels: Vec<LevelReport>,
    /// Colour error of the painting at the scale of the finest brush, see
    /// [`Painter::blur_cells`].
    pub error: ColorErrors,
}

impl PaintedPhotograph {
    /// The painting, for its pictures and its document.
    pub fn painting_mut(&mut self) -> &mut Painting {
        self.session.canvas_mut()
    }
}

impl StrokePainter {
    /// Fits the photograph to a canvas, chooses the pigments and computes the separation. This
    /// takes some seconds. The light is the one of [`Lighting::default`].
    ///
    /// # Errors
    /// [`StrokePainterError`] for settings out of range, unknown pigments, and pigments that
    /// give no separation.
    pub fn new(
        photograph: &Photograph,
        library: &PigmentLibrary,
        settings: &StrokeSettings,
    ) -> Result<Self, StrokePainterError> {
        let mut canvas = settings.canvas(photograph.size())?;
        let (width, height) = canvas.cells();
        let seen = photograph.on_canvas(width, height);
        let (separation, slots) = separation(&seen, library, settings)?;
        let target = black_compensated(&seen, separation.black());
        if settings.hides {
            canvas.ground.reflectance = Some(toned_priming(&target));
        }
        let names = slots.iter().flatten().map(|&pigment| library[pigment].name.clone());
        let pigments: Vec<String> = names.collect();
        let palette = PaletteSpec::from_names(pigments.iter().map(String::as_str));
        let mut script = StrokeScript::new(&settings.title, "", canvas, palette);
        script.library = Some(library.title.clone());
        // The separation computed its films in this medium.
        script.medium = Some(Medium::of(library));
        let resolved = script.resolve(library)?;
        let ground = script.canvas.ground(library)?;
        let library = library.clone();
        let plan = settings.plan();
        Ok(Self { script, resolved, library, ground, pigments, separation, target, plan })
    }

    /// Names of the palette's pigments, in the order of their slots.
    #[must_use]
    pub fn pigments(&self) -> &[String] {
        &self.pigments
    }

    /// Films of the palette that come nearest to each colour.
    #[must_use]
    pub fn separation(&self) -> &Separation {
        &self.separation
    }

    /// The photograph on the canvas, one colour per cell, its black raised to a tone that
    /// the palette reaches.
    #[must_use]
    pub fn target(&self) -> &Picture {
        &self.target
    }

    /// Width and height of a cell in mm.
    #[must_use]
    pub fn cell_mm(&self) -> f64 {
        self.script.canvas.cell_mm
    }

    /// The bare ground of the canvas. Its heights are what [`PaintEngine::open`] needs.
    #[must_use]
    pub fn ground(&self) -> &Ground {
        &self.ground
    }

    /// Paints on the device that `backend` chooses. `task` shows how many of the strokes planned so
    /// far are painted.
    ///
    /// # Errors
    /// [`StrokePainterError`] if the device cannot be used or was lost, or if `task` was
    /// cancelled.
    pub fn paint(
        &self,
        backend: BackendChoice,
        task: &Task,
    ) -> Result<PaintedPhotograph, StrokePainterError> {
        let opened = PaintEngine::open(backend, &self.ground.height)?;
        self.paint_with(opened.engine, task)
    }

    /// Paints with an engine that you opened over the heights of [`StrokePainter::ground`]. For
    /// `task` see [`StrokePainter::paint`].
    ///
    /// # Errors
    /// [`StrokePainterError`] if the engine was opened over another ground, if its device
    /// was lost, or if `task` was cancelled.
    pub fn paint_with(
        &self,
        engine: PaintEngine,
        task: &Task,
    ) -> Result<PaintedPhotograph, StrokePainterError> {
        let mut script = self.script.clone();
        let bare = script.bare(&self.library, &self.resolved, self.ground.clone());
        // Nothing is undone, so undo needs no memory.
        let mut session = PaintingSession::new(Painting::open(bare, engine, 0)?, None)?;
        let painter =
            Painter { target: &self.target, separation: &self.separation, plan: &self.plan };
        let levels = painter.paint(&mut session, &mut script, task)?;
        let finest_mm = levels.last().map_or(0.0, |level| level.size_mm);
        let blur_cells = Painter::blur_cells(finest_mm, self.cell_mm());
        let error = painter.errors(session.canvas_mut(), blur_cells)?;
        Ok(PaintedPhotograph { session, script, levels, error })
    }
}

/// Separation for the colours of `seen`, and the slots of its palette.
fn separation(
    seen: &Picture,
    library: &PigmentLibrary,
    settings: &StrokeSettings,
) -> Result<(Separation, Slots), StrokePainterError> {
    let lighting = Lighting::default();
    let light = Light::named(library, &lighting.illuminant, &lighting.observer)?;
    let ground = settings.ground.spec(1).reflectance(library)?;
    let [least_mm, most_mm] = FILM_MM;
    let table = SeparationSettings {
        least_mm,
        most_mm,
        hides: settings.hides,
        ..SeparationSettings::default()
    };
    let bare = Slots::default();
    let materials = FilmMaterials {
        library,
        slots: &bare,
        ground: &ground,
        scattering_per_mm: Medium::of(library).scattering_per_mm,
    };
    let nodes = &light.quadrature;
    let slots = if settings.palette.is_empty() {
        let toned = black_compensated(seen, library.saunderson.floor() as f32);
        choose_palette(&toned, materials, |own| PaintFilm::at_nodes(own, nodes), &table)?.slots
    } else {
        palette_slots(&settings.palette, library)?
    };
    let film = PaintFilm::at_nodes(FilmMaterials { slots: &slots, ..materials }, nodes);
    Ok((Separation::new(film, &table)?, slots))
}

/// A photograph cannot be painted in strokes.
#[derive(Debug, thiserror::Error, Explain)]
pub enum StrokePainterError {
    /// The settings are invalid.
    #[error(transparent)]
    Settings(#[from] StrokeSettingsError),
    /// The names of the pigments do not make a palette.
    #[error(transparent)]
    Palette(#[from] PaletteError),
    /// The light cannot be used with the library.
    #[error(transparent)]
    Light(#[from] PaintLightError),
    /// The ground cannot be made.
    #[error(transparent)]
    Ground(#[from] GroundError),
    /// The pigments give no separation.
    #[error(transparent)]
    Separation(#[from] SeparationError),
    /// The script of strokes is invalid.
    #[error(transparent)]
    Script(#[from] ScriptError),
    /// The device cannot be used.
    #[error(transparent)]
    Device(#[from] DeviceError),
    /// The painting cannot be opened, its picture computed, or its session set up.
    #[error(transparent)]
    Painting(#[from] PaintingError),
    /// The painting cannot go on.
    #[error(transparent)]
    Strokes(#[from] PainterError),
    /// The task was cancelled.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// Start of the file names.
const STEM: &str = "separation";

/// A photograph separated into pigments, as files in memory.
#[derive(Debug, Clone, PartialEq)]
pub struct SeparatedFiles {
    /// The files of [`pigment_maps`], then `separation.rebuilt.png`, the picture that the
    /// pigments make together, and `separation.errors.json`, its colour error.
    pub files: Vec<NamedFile>,
    /// Colour error of the rebuilt picture.
    pub error: ColorErrors,
}

impl StrokePainter {
    /// Separates the photograph into a map of each pigment. You can write the files with
    /// [`save_files`](paint::export::save_files).
    ///
    /// # Errors
    /// [`ExportError`] if a file cannot be encoded.
    pub fn separate(&self) -> Result<SeparatedFiles, ExportError> {
        let separation = self.separation();
        let target = self.target();
        let heights = separation.separate(target);
        let width = target.width();
        let height = target.height();
        let mut maps = Vec::new();
        for (slot, name) in self.pigments().iter().enumerate() {
            let values = heights.values().iter().map(|cell| cell[slot]).collect();
            let height_mm = Field::from_values(width, height, values);
            maps.push(PigmentMap { name: name.clone(), height_mm });
        }
        let picture = rebuild_picture(separation.film(), &heights);
        let error = ColorErrors::between(separation, target, &picture);
        let opaque = picture.values().iter().map(|&[red, green, blue]| [red, green, blue, 1.0]);
        let opaque = Field::from_values(width, height, opaque.collect());
        let mut files = pigment_maps(STEM, &maps, self.cell_mm())?;
        let errors = to_text(&json!({"palette": self.pigments(), "error": error}));
        files.extend([
            NamedFile {
                name: format!("{STEM}.rebuilt.png"),
                bytes: png8(&opaque, self.cell_mm())?.bytes,
            },
            NamedFile { name: format!("{STEM}.errors.json"), bytes: errors.into_bytes() },
        ]);
        Ok(SeparatedFiles { files, error })
    }
}

/// Linear tone of the priming relative to the mean of the picture (chosen by eye).
const TONE: f64 = 0.4;

/// Raises the black of a photograph in linear sRGB to the luminance `black` (0..1) and keeps
/// its white, so that differences in shadows survive: black point compensation (ISO
/// 18619:2015).
///
/// The surface of paint alone reflects about 3 %, so no palette reaches a photograph's darkest
/// tones. `black` is [`Separation::black`](paint::separation::Separation::black) or, before
/// there is a palette, the surface reflection of the library.
#[must_use]
pub fn black_compensated(picture: &Picture, black: f32) -> Picture {
    let values = picture
        .values()
        .par_iter()
        .with_min_len(4096)
        .map(|rgb: &[f32; 3]| rgb.map(|value| black + (1.0 - black) * value))
        .collect();
    Field::from_values(picture.width(), picture.height(), values)
}

/// Priming in a dark tone of the mean colour of `picture`. If strokes leave some of it open, this
/// looks like a shadow of the picture.
pub(super) fn toned_priming(picture: &Picture) -> Primer {
    let mut sum = [0.0; 3];
    for color in picture.values() {
        sum.iter_mut().zip(color).for_each(|(sum, value)| *sum += f64::from(*value));
    }
    let tone = Rgb(sum.map(|sum| TONE * sum / picture.values().len() as f64)).encoded();
    Primer::Color(ColorPrimer { rgb: tone.to_hex() })
}
