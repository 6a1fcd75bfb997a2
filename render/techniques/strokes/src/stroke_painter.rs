//! Painting of a photograph in strokes, with all its set-up.

use documents::hint::{Explain, Fault, Hint};
use graphics::gpu::{BackendChoice, DeviceError};
use graphics::picture::{Photograph, Picture};
use paint::document::{Lighting, Medium, Slots};
use paint::engine::PaintEngine;
use paint::ground::{Ground, GroundError};
use paint::light::{Light, PaintLightError};
use paint::painting::{Painting, PaintingError};
use paint::palette::{PaletteError, palette_slots};
use paint::separation::{
    ColorErrors, FilmMaterials, PaintFilm, Separation, SeparationError, SeparationSettings,
    choose_palette,
};
use paint::session::{PaintingSession, SessionError};
use paint::strokes::{PaletteSpec, Resolved, ScriptError, StrokeScript};
use pigment::PigmentLibrary;

use super::painter::{LevelReport, PaintProgress, Painter, PainterError};
use super::plan::Plan;
use super::stroke_settings::{StrokeSettings, StrokeSettingsError};
use super::tones::{black_compensated, toned_priming};

/// Heights of the films of a painted photograph in mm (chosen by eye: the thinnest still
/// hides with most pigments, the thickest shows relief at the default cell size).
const FILM_MM: [f64; 2] = [0.03, 0.12];

/// Paints one photograph in strokes of calibrated paint.
///
/// ```no_run
/// use graphics::gpu::BackendChoice;
/// use graphics::picture::Photograph;
/// use pigment::PigmentLibrary;
/// use strokes::{StrokePainter, StrokeSettings};
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let oils = PigmentLibrary::van_gogh_oils();
/// let photograph = Photograph::open("wheat.jpg".as_ref())?;
/// let painter = StrokePainter::new(&photograph, &oils, &StrokeSettings::default())?;
/// let mut painted = painter.paint(BackendChoice::Auto, |_| {})?;
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
    /// The session on the painted canvas; it cannot undo.
    pub session: PaintingSession,
    /// The strokes. Played on a bare canvas, they give the same painting bit for bit.
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
    /// Fits the photograph to a canvas, chooses the pigments and computes the separation,
    /// which takes some seconds. The light is that of [`Lighting::default`].
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
        // The films of the separation are those of this medium.
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

    /// Paints on the device that `backend` chooses. `progress` is called when strokes have
    /// been planned, and after each stroke.
    ///
    /// # Errors
    /// [`StrokePainterError`] if the device cannot be used, or was lost.
    pub fn paint(
        &self,
        backend: BackendChoice,
        progress: impl FnMut(PaintProgress),
    ) -> Result<PaintedPhotograph, StrokePainterError> {
        let opened = PaintEngine::open(backend, &self.ground.height)?;
        self.paint_with(opened.engine, progress)
    }

    /// Paints with an engine that has been opened over the heights of
    /// [`StrokePainter::ground`]. For `progress` see [`StrokePainter::paint`].
    ///
    /// # Errors
    /// [`StrokePainterError`] if the engine was opened over another ground, or its device
    /// was lost.
    pub fn paint_with(
        &self,
        engine: PaintEngine,
        progress: impl FnMut(PaintProgress),
    ) -> Result<PaintedPhotograph, StrokePainterError> {
        let mut script = self.script.clone();
        let bare = script.bare(&self.library, &self.resolved, self.ground.clone());
        // Nothing is undone, so undo needs no memory.
        let mut session = PaintingSession::new(Painting::open(bare, engine, 0)?, None)?;
        let painter =
            Painter { target: &self.target, separation: &self.separation, plan: &self.plan };
        let levels = painter.paint(&mut session, &mut script, progress)?;
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
    let film = |materials: FilmMaterials<'_>| PaintFilm::at_nodes(materials, &light.quadrature);
    let slots = if settings.palette.is_empty() {
        let toned = black_compensated(seen, library.saunderson.floor() as f32);
        choose_palette(&toned, materials, film, &table)?.slots
    } else {
        palette_slots(&settings.palette, library)?
    };
    let separation = Separation::new(film(FilmMaterials { slots: &slots, ..materials }), &table)?;
    Ok((separation, slots))
}

/// A photograph cannot be painted in strokes.
#[derive(Debug, thiserror::Error)]
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
    /// The painting cannot be opened, or its picture cannot be computed.
    #[error(transparent)]
    Painting(#[from] PaintingError),
    /// The session cannot be set up.
    #[error(transparent)]
    Session(#[from] SessionError),
    /// The painting cannot go on.
    #[error(transparent)]
    Strokes(#[from] PainterError),
}

impl StrokePainterError {
    fn cause(&self) -> &dyn Explain {
        match self {
            Self::Settings(error) => error,
            Self::Palette(error) => error,
            Self::Light(error) => error,
            Self::Ground(error) => error,
            Self::Separation(error) => error,
            Self::Script(error) => error,
            Self::Device(error) => error,
            Self::Painting(error) => error,
            Self::Session(error) => error,
            Self::Strokes(error) => error,
        }
    }
}

impl Explain for StrokePainterError {
    fn hint(&self) -> Option<Hint> {
        self.cause().hint()
    }

    fn fault(&self) -> Fault {
        self.cause().fault()
    }
}
