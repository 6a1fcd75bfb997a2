//! Prepares paintings to be worked on, with default canvas, palette and brushes.

use std::collections::BTreeMap;
use std::sync::Arc;

use documents::file::disk;
use documents::hint::Explain;
use paint::brush::HeadShape;
use paint::document::{Document, Lighting};
use paint::file::{self, PaintingFileError};
use paint::ground::{GroundKind, GroundSpec};
use paint::light::Light;
use paint::painting::{Painting, PaintingError};
use paint::session::{KeptSession, PaintingSession};
use paint::strokes::{
    Action, BrushSpec, Canvas, KeptBrush, Load, PaletteSpec, ScriptStartError, SideTable,
    StrokeScript,
};
use pigment::library::PigmentLibrary;

use super::backend::Backend;
use super::command::{Command, Origin};

#[derive(Debug)]
pub(super) struct PreparedPainting {
    pub(super) session: PaintingSession,
    pub(super) library: Arc<PigmentLibrary>,
    /// Reflectance of the ground at the wavelengths of the library.
    pub(super) ground: Arc<Vec<f64>>,
    pub(super) remarks: Vec<String>,
}

#[derive(Debug, thiserror::Error, Explain)]
pub(super) enum OpenError {
    #[error(transparent)]
    ScriptStart(#[from] ScriptStartError),
    #[error(transparent)]
    Painting(#[from] PaintingError),
    #[error("the painting that the script continues: {path}: {reason}")]
    #[hint("put it back where the script names it")]
    Start { path: String, reason: String },
    #[error("the painting that the script continues: {0}")]
    #[hint(inner)]
    StartFile(#[from] PaintingFileError),
}

/// Prepares the painting of `origin`.
pub(super) fn prepare(
    origin: Origin,
    backend: &mut Backend,
    undo_bytes: u64,
) -> Result<PreparedPainting, OpenError> {
    match origin {
        Origin::Blank { script, library } => prepare_script(&script, &library, backend, undo_bytes),
        Origin::Painting(canvas) => {
            let script = continue_from(&canvas);
            let library = canvas.library.clone();
            let lighting = canvas.lighting.clone();
            let surfaces = Surfaces::new(&library, &lighting, || {
                Ok(script.surfaces_with_table(&library, Some(*canvas), None)?)
            })?;
            surfaces.into_session(Beginning::Recorded(&script), backend, undo_bytes)
        }
        Origin::WithTable { canvas, table } if !table.palette.belongs_to(&canvas) => {
            let mut prepared = prepare(Origin::Painting(canvas), backend, undo_bytes)?;
            let remark = "the palette in the file belongs to another painting; it begins bare";
            prepared.remarks.push(remark.to_owned());
            Ok(prepared)
        }
        Origin::WithTable { canvas, table } => {
            let script = StrokeScript::continue_with_table(&path_of(&canvas), &canvas, &table);
            let library = canvas.library.clone();
            let lighting = canvas.lighting.clone();
            let surfaces = Surfaces::new(&library, &lighting, || {
                Ok(script.surfaces_with_table(&library, Some(*canvas), Some(*table))?)
            })?;
            surfaces.into_session(Beginning::Recorded(&script), backend, undo_bytes)
        }
        Origin::Recovered { canvas, palette, kept } => {
            let library = canvas.library.clone();
            let lighting = canvas.lighting.clone();
            let surfaces =
                Surfaces::new(&library, &lighting, || Ok((*canvas, Some(*palette), Vec::new())))?;
            let kept = kept.unwrap_or_default();
            surfaces.into_session(Beginning::Kept(kept), backend, undo_bytes)
        }
    }
}

/// Prepares the surfaces that a script starts on. If the script has no palette, it gets one. If it
/// continues a painting, this reads that painting from its path.
pub(super) fn prepare_script(
    script: &StrokeScript,
    library: &PigmentLibrary,
    backend: &mut Backend,
    undo_bytes: u64,
) -> Result<PreparedPainting, OpenError> {
    let mut script = script.header();
    script.mixing.get_or_insert_with(|| default_mixing_canvas(script.canvas.cell_mm));
    let (start, table) = match &script.start {
        Some(start) => {
            let (painting, table) = read(start, script.table)?;
            (Some(painting), table)
        }
        None => (None, None),
    };
    let library = start.as_ref().map_or(library, |start| &start.library).clone();
    let lighting = match &start {
        Some(start) => start.lighting.clone(),
        None => script.lighting.clone().unwrap_or_default(),
    };
    let surfaces = Surfaces::new(&library, &lighting, || {
        Ok(script.surfaces_with_table(&library, start, table)?)
    })?;
    surfaces.into_session(Beginning::Recorded(&script), backend, undo_bytes)
}

/// Reads a painting and, if you ask for them, the palette and the brushes saved with it.
fn read(path: &str, with_table: bool) -> Result<(Document, Option<SideTable>), OpenError> {
    let bytes = disk::read(path)
        .map_err(|error| OpenError::Start { path: path.to_owned(), reason: error.to_string() })?;
    let table = if with_table { file::read_table(path, &bytes)? } else { None };
    Ok((file::read(path, &bytes)?, table))
}

/// The file that a recording names as its start if it continues this painting.
fn path_of(canvas: &Document) -> String {
    let title = if canvas.title.is_empty() { "painting" } else { canvas.title.as_str() };
    format!("{title}.exr")
}

/// Header of a recording that continues a painting.
fn continue_from(canvas: &Document) -> StrokeScript {
    let mut script = StrokeScript::continue_from(&path_of(canvas), canvas);
    script.mixing = Some(default_mixing_canvas(script.canvas.cell_mm));
    script
}

/// How a session begins: with a new recording, or as the continuation of a saved session.
enum Beginning<'a> {
    Recorded(&'a StrokeScript),
    Kept(Box<KeptSession>),
}

/// Documents of canvas and palette, brushes with their loads, and the light.
struct Surfaces {
    canvas: Document,
    palette: Option<Document>,
    brushes: Vec<KeptBrush>,
    light: Light,
    remarks: Vec<String>,
}

/// Canvas, palette, and brushes with their loads.
type SurfacesOfScript = (Document, Option<Document>, Vec<KeptBrush>);

impl Surfaces {
    /// Makes the surfaces while another thread computes the light, since both take about as long.
    /// If the light cannot be found, e.g. because the file of a lamp is missing, this uses the
    /// default light and adds a remark.
    fn new(
        library: &PigmentLibrary,
        lighting: &Lighting,
        surfaces: impl FnOnce() -> Result<SurfacesOfScript, OpenError> + Send,
    ) -> Result<Self, OpenError> {
        let named =
            |lighting: &Lighting| Light::named(library, &lighting.illuminant, &lighting.observer);
        let (light, surfaces) = rayon::join(|| named(lighting), surfaces);
        let (mut canvas, mut palette, brushes) = surfaces?;
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
        Ok(Self { canvas, palette, brushes, light, remarks })
    }

    /// A session on these surfaces. Without brushes it gets the default ones.
    fn into_session(
        self,
        beginning: Beginning<'_>,
        backend: &mut Backend,
        undo_bytes: u64,
    ) -> Result<PreparedPainting, OpenError> {
        let Self { canvas, palette, brushes: kept, light, mut remarks } = self;
        let library = Arc::new(canvas.library.clone());
        let ground = Arc::new(canvas.ground.reflectance.clone());
        let (engine, reason) = backend.engine(&canvas.ground.height);
        let palette = palette.map(|palette| {
            let (engine, _) = backend.engine(&palette.ground.height);
            (palette, engine)
        });
        remarks.extend(reason.map(|reason| format!("{reason}; painting on the processor")));
        // Lights are compared by address, so both paintings must share this one.
        let light = Arc::new(light);
        let (canvas, palette) = rayon::join(
            || Painting::open_under(canvas, Arc::clone(&light), engine, undo_bytes),
            || {
                palette.map(|(palette, engine)| {
                    Painting::open_under(palette, Arc::clone(&light), engine, undo_bytes)
                })
            },
        );
        let canvas = canvas?;
        let palette = palette.transpose()?;
        let mut session = match beginning {
            Beginning::Recorded(script) => {
                let mut session = PaintingSession::recorded(canvas, palette, script)?;
                for brush in session.take_up(&kept)? {
                    remarks
                        .push(format!("the brush `{brush}` has another head now and begins clean"));
                }
                for (name, spec) in &script.brushes {
                    session.set_brush(name, spec)?;
                }
                session
            }
            Beginning::Kept(kept) => PaintingSession::restored(canvas, palette, *kept)?,
        };
        session.set_undo_bytes(undo_bytes);
        if session.brushes().next().is_none() {
            for (name, spec) in default_brushes() {
                session.set_brush(&name, &spec)?;
            }
        }
        Ok(PreparedPainting { session, library, ground, remarks })
    }
}

/// Pigments of the default palette: white, a cool and a warm one of each primary, and black.
const TUBES: [&str; 8] = [
    "Zinc White",
    "Chrome Yellow (Otero)",
    "Chrome Yellow",
    "Vermilion",
    "Cochineal Lake",
    "Ultramarine",
    "Prussian Blue",
    "Bone Black",
];

/// Default brushes: name, shape and size in mm.
const BRUSHES: [(&str, HeadShape, f64); 6] = [
    ("round", HeadShape::Round, 6.0),
    ("flat", HeadShape::Flat, 10.0),
    ("filbert", HeadShape::Filbert, 8.0),
    ("rigger", HeadShape::Rigger, 1.5),
    ("fan", HeadShape::Fan, 12.0),
    ("knife", HeadShape::Knife, 14.0),
];

/// Default brushes by name.
#[must_use]
pub fn default_brushes() -> BTreeMap<String, BrushSpec> {
    BRUSHES
        .into_iter()
        .map(|(name, shape, size_mm): (&str, _, _)| (name.to_owned(), BrushSpec { shape, size_mm }))
        .collect()
}

/// A wooden palette of 640 x 420 cells of `cell_mm` mm: 64 x 42 mm for cells of 0.1 mm.
#[must_use]
pub fn default_mixing_canvas(cell_mm: f64) -> Canvas {
    let ground = GroundKind::Wood.spec(1);
    let width_mm = 640.0 * cell_mm;
    let height_mm = 420.0 * cell_mm;
    Canvas { width_mm, height_mm, cell_mm, ground }
}

/// A canvas of `width_mm` x `height_mm` mm of primed linen with cells of `cell_mm` mm, pigments of
/// `library` and the default brushes. If you pass the Van Gogh oils, you get a painter's choice of
/// eight pigments. Any other library gives its white and the first pigments with known scattering.
#[must_use]
pub fn blank_canvas(
    library: PigmentLibrary,
    width_mm: f64,
    height_mm: f64,
    cell_mm: f64,
) -> Origin {
    let tubes = tubes_of(&library);
    let tubes = PaletteSpec::from_names(tubes.iter().map(String::as_str));
    let canvas = Canvas { width_mm, height_mm, cell_mm, ground: GroundSpec::default() };
    let mut script = StrokeScript::new("untitled", "", canvas, tubes);
    script.library = Some(library.title.clone());
    script.mixing = Some(default_mixing_canvas(cell_mm));
    script.brushes = default_brushes();
    Origin::Blank { script: Box::new(script), library: Box::new(library) }
}

/// The default tubes of a library, see [`blank_canvas`].
pub(super) fn tubes_of(library: &PigmentLibrary) -> Vec<String> {
    let mixed = library.pigments.iter().filter(|pigment| pigment.identified);
    let mut names: Vec<&str> = mixed.map(|pigment| pigment.name.as_str()).collect();
    names.sort_by_key(|name| Some(*name) != library.reference.as_deref());
    let own = TUBES.iter().all(|tube| names.contains(tube));
    let tubes = if own { TUBES.to_vec() } else { names };
    tubes.into_iter().take(TUBES.len()).map(str::to_owned).collect()
}

/// First commands of a front end: a linen canvas of 1920 x 1080 cells (192 x 108 mm), and blue on
/// the round brush.
#[must_use]
pub fn initial_commands() -> Vec<Command> {
    let paint = Load {
        brush: "round".to_owned(),
        recipe: [("Ultramarine".to_owned(), 1.0)].into(),
        vehicle: 0.15,
        amount_mm: 0.3,
    };
    vec![
        Command::Open(blank_canvas(PigmentLibrary::van_gogh_oils(), 192.0, 108.0, 0.1)),
        Command::Apply(Action::Load(paint)),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_initial_commands_are_valid() {
        let mut commands = initial_commands().into_iter();
        let Some(Command::Open(Origin::Blank { mut script, library })) = commands.next() else {
            panic!("a canvas is opened first");
        };
        for command in commands {
            let Command::Apply(action) = command else { panic!("then there are actions only") };
            script.actions.push(action);
        }
        assert_eq!(script.canvas.cells(), (1920, 1080));
        let resolved = script.resolve(&library).unwrap();
        for pigment in resolved.slots {
            let pigment = &library[pigment.expect("eight tubes")];
            assert!(pigment.identified, "{} can be mixed", pigment.name);
        }
    }

    #[test]
    fn another_library_opens_with_its_white_and_identified_pigments() {
        let mut library = PigmentLibrary::van_gogh_oils();
        library.pigments.retain(|pigment| pigment.name != "Vermilion");
        library.pigments[3].identified = false;
        let Origin::Blank { script, .. } = blank_canvas(library, 20.0, 10.0, 0.1) else {
            panic!("a bare canvas");
        };
        let names: Vec<String> =
            script.palette.pigments.into_iter().map(|(_, name)| name).collect();
        let wanted = [
            "Zinc White",
            "Eosin Lake (wax)",
            "Eosin Lake",
            "Bone Black",
            "Cochineal Lake",
            "Minium",
            "Lead White",
            "Viridian",
        ];
        assert_eq!(names, wanted);
    }
}
