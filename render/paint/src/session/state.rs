//! State of a painting session.

use super::brushes::{Added, Brushes};
use super::failure::SessionError;
use super::history::SharedHistory;
use super::record::Record;
use crate::brush::Head;
use crate::document::{Document, Medium};
use crate::engine::BrushId;
use crate::layer::Layer;
use crate::painting::{LayerRef, OpenStroke, Painting, PaintingError, StrokeReport};
use crate::pose::Sample;
use crate::stroke::SampleDecimals;
use crate::strokes::{
    Action, ActionLimits, BrushSpec, CheckContext, InvalidValue, PaletteSpec, PerSurface,
    PigmentNames, StrokeScript, StrokeTool, SurfaceId, check_size, pigment_names, six_digits,
};

/// The open stroke of a session.
#[derive(Debug)]
pub(super) struct SessionStroke {
    pub(super) on: SurfaceId,
    /// Index of the brush.
    pub(super) tool: usize,
    /// Decimals that samples are rounded to.
    pub(super) decimals: SampleDecimals,
    /// The tool that the head is used as.
    pub(super) working: StrokeTool,
    /// Rounded samples that were accepted.
    pub(super) samples: Vec<Sample>,
    /// Surface that the brush came from; `None` before the first sample.
    pub(super) from: Option<SurfaceId>,
    pub(super) stroke: OpenStroke,
}

/// The open adjustment of a session.
#[derive(Debug)]
pub(super) struct Adjusting {
    pub(super) control: Control,
    /// The action with the latest values.
    pub(super) action: Action,
    /// Surfaces that it changes.
    pub(super) on: PerSurface<bool>,
}

/// Property that an adjustment changes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Control {
    Light,
    Gloss,
    Stiffness,
    Opacity(LayerRef),
}

/// A canvas, an optional palette to mix on, brushes, and a recording of all actions.
#[derive(Debug)]
pub struct PaintingSession {
    pub(super) canvas: Painting,
    pub(super) palette: Option<Painting>,
    pub(super) brushes: Brushes,
    /// Meaning of pigment names after the actions so far.
    pub(super) scope: PigmentNames,
    pub(super) history: SharedHistory,
    /// Limit of the memory for undo on both surfaces, in bytes.
    pub(super) undo_limit: u64,
    pub(super) record: Option<Record>,
    pub(super) stroke: Option<SessionStroke>,
    pub(super) adjusting: Option<Adjusting>,
}

/// Result of an action.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outcome {
    /// The action changed something.
    Done,
    /// There was nothing to do: no wet paint to dry or scrape away, nothing to undo or
    /// redo.
    Nothing,
    /// A stroke was painted.
    Painted(StrokeReport),
}

impl PaintingSession {
    /// Starts a session on a canvas and, optionally, a palette to mix on. Both must have the
    /// same library, the same pigments in the same slots, the same light and medium, and
    /// cells of the same width. Nothing is recorded.
    ///
    /// Both share the memory that they were opened with for the history; see
    /// [`PaintingSession::set_undo_bytes`].
    ///
    /// # Errors
    /// [`SessionError::Unlike`] if canvas and palette do not go together.
    pub fn new(canvas: Painting, palette: Option<Painting>) -> Result<Self, SessionError> {
        if let Some(palette) = &palette {
            let unlike = [
                ("pigment libraries", palette.library() != canvas.library()),
                ("cells", palette.cell_mm() != canvas.cell_mm()),
                ("pigments", palette.state().slots != canvas.state().slots),
                ("lights", palette.state().lighting != canvas.state().lighting),
                ("media", palette.medium() != canvas.medium()),
            ];
            if let Some((what, _)) = unlike.iter().find(|(_, unlike)| *unlike) {
                return Err(SessionError::Unlike { what });
            }
        }
        let own = PaletteSpec::from_names(pigment_names(&canvas.state().slots, canvas.library()));
        let (scope, _) = PigmentNames::new(&own, canvas.library())?;
        let limit = |painting: &Painting| painting.undo_bytes().1;
        let undo_limit = limit(&canvas).saturating_add(palette.as_ref().map_or(0, limit));
        Ok(Self {
            canvas,
            palette,
            undo_limit,
            brushes: Brushes::default(),
            scope,
            history: SharedHistory::default(),
            record: None,
            stroke: None,
            adjusting: None,
        })
    }

    /// Starts a session like [`PaintingSession::new`] that records all actions under the
    /// header of `script`, which must describe these surfaces as they are now (see
    /// [`StrokeScript::surfaces`]).
    ///
    /// # Errors
    /// [`SessionError`] if the header describes other surfaces.
    pub fn recorded(
        canvas: Painting,
        palette: Option<Painting>,
        script: &StrokeScript,
    ) -> Result<Self, SessionError> {
        let mut session = Self::new(canvas, palette)?;
        let mut header = script.rounded_header()?;
        let (canvas, slots) = (&session.canvas, session.canvas.state().slots);
        let (scope, named) = PigmentNames::new(&header.palette, canvas.library())?;
        let own = (&slots, canvas.library());
        header.check_painting(canvas.bounds(), canvas.cell_mm(), own, &named)?;
        let cells = session.palette.as_ref().map(|palette| palette.bounds());
        let cells = cells.map(|bounds| (bounds.width, bounds.height));
        if cells != header.mixing.as_ref().map(|mixing| mixing.cells()) {
            return Err(SessionError::Unlike { what: "palettes than the script describes" });
        }
        let bare = header.start.is_none();
        let medium = header.medium.clone().unwrap_or_else(|| Medium::of(canvas.library()));
        if bare && medium != *canvas.medium() {
            return Err(SessionError::Unlike { what: "media than the script describes" });
        }
        if bare && header.lighting.clone().unwrap_or_default() != canvas.state().lighting {
            return Err(SessionError::Unlike { what: "lights than the script describes" });
        }
        header.palette = PaletteSpec::from_names(pigment_names(&slots, canvas.library()));
        header.brushes.clear();
        header.library.get_or_insert_with(|| canvas.library().title.clone());
        session.record = Some(Record::new(header));
        session.scope = scope;
        Ok(session)
    }

    /// Painting of a surface, if the session has it.
    #[must_use]
    pub fn painting(&self, surface: SurfaceId) -> Option<&Painting> {
        match surface {
            SurfaceId::Canvas => Some(&self.canvas),
            SurfaceId::Palette => self.palette.as_ref(),
        }
    }

    /// Painting of a surface, for reading its pictures and paint. Change it only through
    /// the session, whose history does not know of other changes.
    pub fn painting_mut(&mut self, surface: SurfaceId) -> Option<&mut Painting> {
        match surface {
            SurfaceId::Canvas => Some(&mut self.canvas),
            SurfaceId::Palette => self.palette.as_mut(),
        }
    }

    /// Painting of the canvas.
    #[must_use]
    pub fn canvas(&self) -> &Painting {
        &self.canvas
    }

    /// Painting of the canvas, for reading (see [`PaintingSession::painting_mut`]).
    pub fn canvas_mut(&mut self) -> &mut Painting {
        &mut self.canvas
    }

    /// Adds a clean brush under a name. If the name belongs to another head, that one is
    /// washed and replaced; if it belongs to the same head, nothing changes. Any open stroke
    /// or adjustment is finished first.
    ///
    /// # Errors
    /// [`SessionError`] for a head that cannot be made on cells of this width, or if the
    /// device was lost.
    pub fn set_brush(&mut self, name: &str, spec: &BrushSpec) -> Result<(), SessionError> {
        let spec = BrushSpec { size_mm: six_digits(spec.size_mm), ..spec.clone() };
        check_size(&CheckContext::default(), "size_mm", spec.size_mm)?;
        Head::new(spec.shape, spec.size_mm, self.canvas.cell_mm()).map_err(PaintingError::from)?;
        self.finish_open()?;
        let wash = Action::Wash { brush: name.to_owned() };
        let now = self.brushes.find(name).map(|tool| &self.brushes.tools[tool]);
        if now.is_some_and(|tool| tool.spec != spec && tool.used()) {
            self.apply(&wash)?;
        }
        // An undo may have restored paint on a head that had this name before.
        if self.brushes.add(name, &spec) == Added::Used {
            self.apply(&wash)?;
        }
        Ok(())
    }

    /// All brushes, in the order of their names.
    pub fn brushes(&self) -> impl Iterator<Item = (&str, &BrushSpec)> {
        self.brushes.names().map(|(name, tool)| (name, &tool.spec))
    }

    /// Paint on a brush; `None` if there is no such brush, or if it was never used.
    ///
    /// # Errors
    /// [`SessionError`] if the device was lost.
    pub fn brush_paint(&mut self, name: &str) -> Result<Option<Layer>, SessionError> {
        let Some(tool) = self.brushes.find(name) else { return Ok(None) };
        let at = self.brushes.tools[tool].at;
        let Some(id) = self.brush_id_on(name, at) else { return Ok(None) };
        let painting = self.surface_mut(at)?;
        Ok(Some(painting.brush_paint(id)?))
    }

    /// Id of a brush in the painting of a surface, once it was used there.
    #[must_use]
    pub fn brush_id_on(&self, name: &str, surface: SurfaceId) -> Option<BrushId> {
        let tool = self.brushes.find(name)?;
        self.brushes.tools[tool].ids[surface]
    }

    /// Canvas and palette as they are now, with the painted part of an open stroke.
    ///
    /// # Errors
    /// [`SessionError`] if the device was lost.
    pub fn documents(&mut self) -> Result<(Document, Option<Document>), SessionError> {
        let canvas = self.canvas.document()?;
        let palette = self.palette.as_mut().map(Painting::document).transpose()?;
        Ok((canvas, palette))
    }

    /// The recording so far, without an open stroke or adjustment; `None` if the session
    /// records nothing.
    #[must_use]
    pub fn recording(&self) -> Option<&StrokeScript> {
        self.record.as_ref().map(|record| &record.script)
    }

    /// Reason why the recording ended early, if it did: it holds no more than a script may, or
    /// the backend failed. The session goes on without recording.
    #[must_use]
    pub fn recording_stopped(&self) -> Option<&str> {
        self.record.as_ref()?.stopped.as_deref()
    }

    /// Adds the short names of `palette`.
    pub(crate) fn add_names_of(&mut self, palette: &PaletteSpec) -> Result<(), Box<InvalidValue>> {
        let action = Action::Palette(palette.clone());
        let slots =
            self.scope.pigments_of(&CheckContext::default(), &action, self.canvas.library())?;
        self.scope.add_palette_of(&action, &slots);
        Ok(())
    }

    /// Sizes of the surfaces, for the checks of actions.
    pub(super) fn surfaces(&self) -> ActionLimits {
        let side_mm = |painting: &Painting| {
            let bounds = painting.bounds();
            bounds.width.max(bounds.height) as f64 * painting.cell_mm()
        };
        let own = ActionLimits {
            canvas_mm: side_mm(&self.canvas),
            palette_mm: self.palette.as_ref().map(side_mm),
        };
        self.recording().map_or(own, StrokeScript::limits)
    }

    /// Painting of a surface; an error if the session does not have it.
    pub(super) fn surface_mut(
        &mut self,
        surface: SurfaceId,
    ) -> Result<&mut Painting, SessionError> {
        self.surfaces().reach_mm(&CheckContext::default(), surface)?;
        Ok(match (surface, &mut self.palette) {
            (SurfaceId::Palette, Some(palette)) => palette,
            _ => &mut self.canvas,
        })
    }
}
