//! Paintings taken up.

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

/// A painting on the session, with what of it never changes.
#[derive(Debug)]
pub(super) struct PreparedPainting {
    pub(super) session: PaintingSession,
    pub(super) library: Arc<PigmentLibrary>,
    /// Reflectance of the ground.
    pub(super) ground: Arc<Vec<f64>>,
    /// What was not as asked for.
    pub(super) remarks: Vec<String>,
}

/// Why a painting cannot be taken up.
#[derive(Debug, thiserror::Error)]
pub(super) enum OpenError {
    #[error(transparent)]
    ScriptStart(#[from] ScriptStartError),
    #[error(transparent)]
    Painting(#[from] PaintingError),
    #[error(transparent)]
    Session(#[from] SessionError),
    #[error("the painting that the script goes on with: {path}: {reason}")]
    Start { path: String, reason: String },
    #[error("the painting that the script goes on with: {0}")]
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

/// Takes up what `origin` tells.
///
/// # Errors
/// [`OpenError`]; nothing was changed then.
pub(super) fn opened(
    origin: Origin,
    backend: &mut Backend,
    undo_bytes: u64,
) -> Result<PreparedPainting, OpenError> {
    match origin {
        Origin::Blank { script, library } => from_script(&script, &library, backend, undo_bytes),
        Origin::Painting(canvas) => {
            let script = continue_from(&canvas);
            let (library, lighting) = (canvas.library.clone(), canvas.lighting.clone());
            let surfaces = || Ok(script.surfaces(&canvas.library.clone(), Some(*canvas))?);
            let begun = Surfaces::new(&library, &lighting, surfaces)?;
            begun.set_up(Some(&script), backend, undo_bytes)
        }
        Origin::Recovered { canvas, palette } => {
            let (library, lighting) = (canvas.library.clone(), canvas.lighting.clone());
            let begun = Surfaces::new(&library, &lighting, || Ok((*canvas, Some(*palette))))?;
            begun.set_up(None, backend, undo_bytes)
        }
    }
}

/// The surfaces that a script begins on. A script without a palette gets one;
/// the painting that it goes on with is read from where it says.
///
/// # Errors
/// As [`opened`].
pub(super) fn from_script(
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
    let begun = Surfaces::new(&library, &lighting, || Ok(script.surfaces(&library, start)?))?;
    begun.set_up(Some(&script), backend, undo_bytes)
}

fn read(path: &str) -> Result<Document, OpenError> {
    let bytes = std::fs::read(path)
        .map_err(|error| OpenError::Start { path: path.to_owned(), reason: error.to_string() })?;
    Ok(render::paint::file::read(path, &bytes)?)
}

/// A header for what is done to a painting from now on.
fn continue_from(canvas: &Document) -> StrokeScript {
    let title = if canvas.title.is_empty() { "painting" } else { canvas.title.as_str() };
    let mut script = StrokeScript::continue_from(&format!("{title}.exr"), canvas);
    script.mixing = Some(default_mixing_canvas(script.canvas.cell_mm));
    script
}

/// Canvas and palette at rest, and their light.
struct Surfaces {
    canvas: Document,
    palette: Option<Document>,
    light: Light,
    remarks: Vec<String>,
}

impl Surfaces {
    /// Makes the surfaces while another thread works out the light, which takes
    /// as long. A painting whose light is gone (a lamp's file) is shown under the
    /// usual one.
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
            let usual = Lighting::default();
            let Lighting { illuminant, observer, .. } = usual.clone();
            remarks.push(format!("{error}; shown under {illuminant}"));
            for document in std::iter::once(&mut canvas).chain(&mut palette) {
                document.lighting.illuminant.clone_from(&illuminant);
                document.lighting.observer.clone_from(&observer);
            }
            named(&usual)
        });
        let light = light.map_err(PaintingError::from)?;
        Ok(Self { canvas, palette, light, remarks })
    }

    /// Puts them on an session that records under the header of `script`.
    fn set_up(
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
        // The same, so that nobody takes it for another one.
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
        let stand = script.map(|script| &script.brushes).filter(|stand| !stand.is_empty());
        for (name, spec) in stand.cloned().unwrap_or_else(default_brushes) {
            session.set_brush(&name, &spec)?;
        }
        Ok(PreparedPainting { session, library, ground, remarks })
    }
}
