//! What an session consists of.

use super::adjusting::Adjusting;
use super::brushes::{Brushes, Taken};
use super::failure::SessionError;
use super::history::SharedHistory;
use super::live::Live;
use super::record::Record;
use crate::brush::Head;
use crate::document::Document;
use crate::layer::Layer;
use crate::painting::{Painting, PaintingError, StrokeReport};
use crate::strokes::{
    Action, ActionLimits, BrushSpec, CheckContext, InvalidValue, PaletteSpec, PigmentNames,
    StrokeScript, SurfaceId, check_size, pigment_names, six_digits,
};

/// A canvas, a palette beside it, brushes, and the record of what was done.
#[derive(Debug)]
pub struct PaintingSession {
    pub(super) canvas: Painting,
    pub(super) palette: Option<Painting>,
    pub(super) brushes: Brushes,
    /// What names of pigments mean by now.
    pub(super) scope: PigmentNames,
    pub(super) history: SharedHistory,
    pub(super) record: Option<Record>,
    pub(super) live: Option<Live>,
    pub(super) adjusting: Option<Adjusting>,
}

/// What an action came to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outcome {
    /// It was done.
    Done,
    /// There was nothing to do: no wet paint to dry or to scrape away, nothing
    /// to take back.
    Nothing,
    /// A stroke was painted.
    Painted(StrokeReport),
}

impl PaintingSession {
    /// Sets up a canvas, and a palette to mix on, if there is to be one. Both are
    /// of one library, show the same pigments in the same slots under the same
    /// light, and have cells of the same width. Nothing is recorded.
    ///
    /// Each keeps its own part of what can be undone, within the memory that it
    /// was opened with; see [`PaintingSession::set_undo_bytes`].
    ///
    /// # Errors
    /// [`SessionError::Unlike`] for two that do not go together.
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
        Ok(Self {
            canvas,
            palette,
            brushes: Brushes::default(),
            scope,
            history: SharedHistory::default(),
            record: None,
            live: None,
            adjusting: None,
        })
    }

    /// The same, and records all that is done from now on under the header of
    /// `script`, which must describe these surfaces as they are now, as
    /// [`StrokeScript::surfaces`] makes them.
    ///
    /// # Errors
    /// [`SessionError`] where the header describes others.
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
        if bare && header.medium.clone().unwrap_or_default() != *canvas.medium() {
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

    /// The painting of a surface, if there is one.
    #[must_use]
    pub fn painting(&self, surface: SurfaceId) -> Option<&Painting> {
        match surface {
            SurfaceId::Canvas => Some(&self.canvas),
            SurfaceId::Palette => self.palette.as_ref(),
        }
    }

    /// The same, for its pictures and its paint to be read. What changes a
    /// painting goes through the session: the history would not know it.
    pub fn painting_mut(&mut self, surface: SurfaceId) -> Option<&mut Painting> {
        match surface {
            SurfaceId::Canvas => Some(&mut self.canvas),
            SurfaceId::Palette => self.palette.as_mut(),
        }
    }

    /// What is painted on.
    #[must_use]
    pub fn canvas(&self) -> &Painting {
        &self.canvas
    }

    /// The same, to be read as with [`PaintingSession::painting_mut`].
    pub fn canvas_mut(&mut self) -> &mut Painting {
        &mut self.canvas
    }

    /// Takes a clean brush under a name, or another head in place of the one of
    /// that name, which is washed; the same head stays as it is. What is open
    /// ends first.
    ///
    /// # Errors
    /// [`SessionError`] for heads that there are not on cells of this width, or if
    /// the device was lost.
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
        // An undo may have given paint back to one that was there before.
        if self.brushes.take(name, &spec) == Taken::Used {
            self.apply(&wash)?;
        }
        Ok(())
    }

    /// The brushes there are, in the order of their names.
    pub fn brushes(&self) -> impl Iterator<Item = (&str, &BrushSpec)> {
        self.brushes.names().map(|(name, tool)| (name, &tool.spec))
    }

    /// The paint on a brush; nothing if there is no such brush, or if it was
    /// never used.
    ///
    /// # Errors
    /// [`SessionError`] if the device was lost.
    pub fn brush_paint(&mut self, name: &str) -> Result<Option<Layer>, SessionError> {
        let Some(tool) = self.brushes.find(name) else { return Ok(None) };
        let at = self.brushes.tools[tool].at;
        let Some(number) = self.brush_number(name, at) else { return Ok(None) };
        let painting = self.surface_mut(at)?;
        Ok(Some(painting.brush_paint(number)?))
    }

    /// The number of a brush in the painting of a surface, once it was used there.
    #[must_use]
    pub fn brush_number(&self, name: &str, surface: SurfaceId) -> Option<usize> {
        let tool = self.brushes.find(name)?;
        self.brushes.tools[tool].numbers[surface as usize]
    }

    /// Canvas and palette as they are now, a stroke that is open as far as it is.
    ///
    /// # Errors
    /// [`SessionError`] if the device was lost.
    pub fn documents(&mut self) -> Result<(Document, Option<Document>), SessionError> {
        let canvas = self.canvas.document()?;
        let palette = self.palette.as_mut().map(Painting::document).transpose()?;
        Ok((canvas, palette))
    }

    /// All that was done so far, without what is open; none if nothing is
    /// recorded.
    #[must_use]
    pub fn recording(&self) -> Option<&StrokeScript> {
        self.record.as_ref().map(|record| &record.script)
    }

    /// Why the recording ended before now, if it did: it holds no more than can
    /// be read again, and painting goes on without it.
    #[must_use]
    pub fn recording_stopped(&self) -> Option<&str> {
        self.record.as_ref()?.stopped.as_deref()
    }

    /// From now on `palette`'s short names mean its pigments.
    pub(super) fn know(&mut self, palette: &PaletteSpec) -> Result<(), Box<InvalidValue>> {
        let action = Action::Palette(palette.clone());
        let slots =
            self.scope.pigments_of(&CheckContext::default(), &action, self.canvas.library())?;
        self.scope.add_palette_of(&action, &slots);
        Ok(())
    }

    /// Where actions may be, for checks.
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

    /// The painting of a surface; a fault where there is none.
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
