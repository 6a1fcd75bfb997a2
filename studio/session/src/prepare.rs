//! Preparing paintings to be worked on.

use std::sync::Arc;

use pigment::library::PigmentLibrary;
use render::light::Light;
use render::paint::document::{Document, Lighting};
use render::paint::file::PaintingFileError;
use render::paint::painting::{Painting, PaintingError};
use render::paint::session::{PaintingSession, SessionError};
use render::paint::strokes::{ScriptStartError, StrokeScript};
use spectra::hint::{Explain, Hint};

use super::backend::Backend;
use super::command::Origin;
use super::defaults::{default_brushes, default_mixing_canvas};

/// A session and its constant properties.
#[derive(Debug)]
pub(super) struct PreparedPainting {
    pub(super) session: PaintingSession,
    pub(super) library: Arc<PigmentLibrary>,
    /// Reflectance of the ground on the grid of the library.
    pub(super) ground: Arc<Vec<f64>>,
    /// Messages about differences from the request.
    pub(super) remarks: Vec<String>,
}

/// Why a painting cannot be opened.
#[derive(Debug, thiserror::Error)]
pub(super) enum OpenError {
    #[error(transparent)]
    ScriptStart(#[from] ScriptStartError),
    #[error(transparent)]
    Painting(#[from] PaintingError),
    #[error(transparent)]
    Session(#[from] SessionError),
    #[error("the painting that the script continues: {path}: {reason}")]
    Start { path: String, reason: String },
    #[error("the painting that the script continues: {0}")]
    StartFile(#[from] PaintingFileError),
}

impl Explain for OpenError {
    fn hint(&self) -> Option<Hint> {
        match self {
            Self::ScriptStart(error) => error.hint(),
            Self::Painting(error) => error.hint(),
            Self::Session(error) => error.hint(),
            Self::Start { .. } => Some(Hint::new("put it back where the script names it")),
            Self::StartFile(error) => error.hint(),
        }
    }
}

/// Prepares the painting of `origin`.
///
/// # Errors
/// [`OpenError`]; nothing is changed then.
pub(super) fn prepare(
    origin: Origin,
    backend: &mut Backend,
    undo_bytes: u64,
) -> Result<PreparedPainting, OpenError> {
    match origin {
        Origin::Blank { script, library } => prepare_script(&script, &library, backend, undo_bytes),
        Origin::Painting(canvas) => {
            let script = continue_from(&canvas);
            let (library, lighting) = (canvas.library.clone(), canvas.lighting.clone());
            let surfaces = || Ok(script.surfaces(&canvas.library.clone(), Some(*canvas))?);
            let surfaces = Surfaces::new(&library, &lighting, surfaces)?;
            surfaces.into_session(Some(&script), backend, undo_bytes)
        }
        Origin::Recovered { canvas, palette } => {
            let (library, lighting) = (canvas.library.clone(), canvas.lighting.clone());
            let surfaces = Surfaces::new(&library, &lighting, || Ok((*canvas, Some(*palette))))?;
            surfaces.into_session(None, backend, undo_bytes)
        }
    }
}

/// Prepares the surfaces that a script starts on. A script without a palette gets one; the
/// painting that it continues is read from its path.
///
/// # Errors
/// [`OpenError`]; nothing is changed then.
pub(super) fn prepare_script(
    script: &StrokeScript,
    library: &PigmentLibrary,
    backend: &mut Backend,
    undo_bytes: u64,
) -> Result<PreparedPainting, OpenError> {
    let mut script = script.header();
    script.mixing.get_or_insert_with(|| default_mixing_canvas(script.canvas.cell_mm));
    let start = script.start.as_deref().map(read).transpose()?;
    let library = start.as_ref().map_or(library, |start| &start.library).clone();
    let lighting = match &start {
        Some(start) => start.lighting.clone(),
        None => script.lighting.clone().unwrap_or_default(),
    };
    let surfaces = Surfaces::new(&library, &lighting, || Ok(script.surfaces(&library, start)?))?;
    surfaces.into_session(Some(&script), backend, undo_bytes)
}

fn read(path: &str) -> Result<Document, OpenError> {
    let bytes = std::fs::read(path)
        .map_err(|error| OpenError::Start { path: path.to_owned(), reason: error.to_string() })?;
    Ok(render::paint::file::read(path, &bytes)?)
}

/// Header of a recording that continues a painting.
fn continue_from(canvas: &Document) -> StrokeScript {
    let title = if canvas.title.is_empty() { "painting" } else { canvas.title.as_str() };
    let mut script = StrokeScript::continue_from(&format!("{title}.exr"), canvas);
    script.mixing = Some(default_mixing_canvas(script.canvas.cell_mm));
    script
}

/// Documents of canvas and palette, and their light.
struct Surfaces {
    canvas: Document,
    palette: Option<Document>,
    light: Light,
    remarks: Vec<String>,
}

impl Surfaces {
    /// Makes the surfaces while another thread computes the light, since both take about as long.
    /// If the light cannot be found, such as a lamp whose file is missing, the default light is
    /// used and a remark says so.
    fn new(
        library: &PigmentLibrary,
        lighting: &Lighting,
        surfaces: impl FnOnce() -> Result<(Document, Option<Document>), OpenError> + Send,
    ) -> Result<Self, OpenError> {
        let named =
            |lighting: &Lighting| Light::named(library, &lighting.illuminant, &lighting.observer);
        let (light, surfaces) = rayon::join(|| named(lighting), surfaces);
        let (mut canvas, mut palette) = surfaces?;
        let mut remarks = Vec::new();
        let light = light.or_else(|error| {
            let fallback = Lighting::default();
            let Lighting { illuminant, observer, .. } = fallback.clone();
            remarks.push(format!("{error}; shown under {illuminant}"));
            for document in std::iter::once(&mut canvas).chain(&mut palette) {
                document.lighting.illuminant.clone_from(&illuminant);
                document.lighting.observer.clone_from(&observer);
            }
            named(&fallback)
        });
        let light = light.map_err(PaintingError::from)?;
        Ok(Self { canvas, palette, light, remarks })
    }

    /// A session on these surfaces, which records if `script`, the header, is given.
    fn into_session(
        self,
        script: Option<&StrokeScript>,
        backend: &mut Backend,
        undo_bytes: u64,
    ) -> Result<PreparedPainting, OpenError> {
        let Self { canvas, palette, light, mut remarks } = self;
        let library = Arc::new(canvas.library.clone());
        let ground = Arc::new(canvas.ground.reflectance.clone());
        let (engine, reason) = backend.engine(&canvas.ground.height);
        let palette = palette.map(|palette| {
            let (engine, _) = backend.engine(&palette.ground.height);
            (palette, engine)
        });
        remarks.extend(reason.map(|reason| format!("{reason}; painting on the processor")));
        // Both paintings share one light, because lights are compared by address.
        let light = Arc::new(light);
        let (canvas, palette) = rayon::join(
            || Painting::open_under(canvas, Arc::clone(&light), engine, undo_bytes),
            || {
                palette.map(|(palette, engine)| {
                    Painting::open_under(palette, Arc::clone(&light), engine, undo_bytes)
                })
            },
        );
        let (canvas, palette) = (canvas?, palette.transpose()?);
        let mut session = match script {
            Some(script) => PaintingSession::recorded(canvas, palette, script)?,
            None => PaintingSession::new(canvas, palette)?,
        };
        session.set_undo_bytes(undo_bytes);
        let brushes = script.map(|script| &script.brushes).filter(|brushes| !brushes.is_empty());
        for (name, spec) in brushes.cloned().unwrap_or_else(default_brushes) {
            session.set_brush(&name, &spec)?;
        }
        Ok(PreparedPainting { session, library, ground, remarks })
    }
}
