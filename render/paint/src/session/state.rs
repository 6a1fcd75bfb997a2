//! A painting session: its surfaces, its brushes by name, and a short interface for programs.

use std::collections::BTreeSet;
use std::path::Path;

use pigment::library::PigmentLibrary;

use super::history::{Record, SharedHistory};
use crate::brush::Head;
use crate::document::{Canvas, Document, Medium};
use crate::engine::{BrushId, PaintEngine};
use crate::layer::{Layer, LayerRef};
use crate::painting::{OpenStroke, Painting, PaintingError, StrokeReport, UNDO_BYTES};
use crate::pose::Sample;
use crate::strokes::{
    Action, ActionLimits, BrushSpec, CheckContext, InvalidValue, Load, PaletteSpec, PerSurface,
    PigmentNames, Recipe, Stroke, StrokeScript, SurfaceId, check_size, pigment_names, six_digits,
};

/// The open adjustment of a session.
#[derive(Debug)]
pub(super) struct Adjusting {
    pub(super) control: Control,
    /// The action with the latest values.
    pub(super) action: Action,
    /// Whether it changes each surface.
    pub(super) changed: PerSurface<bool>,
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
    pub(super) stroke: Option<OpenStroke>,
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

impl Outcome {
    pub(super) fn of(done: bool) -> Self {
        if done { Self::Done } else { Self::Nothing }
    }
}

impl PaintingSession {
    /// Starts a session on a canvas and, optionally, a palette to mix on. Both must have the
    /// same library, the same pigments in the same slots, the same light and medium, and
    /// cells of the same width. Nothing is recorded.
    ///
    /// Both share the memory that they were opened with for the history. See
    /// [`PaintingSession::set_undo_bytes`].
    ///
    /// # Errors
    /// [`PaintingError::Unlike`] if canvas and palette do not go together.
    pub fn new(canvas: Painting, palette: Option<Painting>) -> Result<Self, PaintingError> {
        if let Some(palette) = &palette {
            let unlike = [
                ("pigment libraries", palette.library() != canvas.library()),
                ("cells", palette.cell_mm() != canvas.cell_mm()),
                ("pigments", palette.state().slots != canvas.state().slots),
                ("lights", palette.state().lighting != canvas.state().lighting),
                ("media", palette.medium() != canvas.medium()),
            ];
            if let Some((what, _)) = unlike.iter().find(|(_, unlike)| *unlike) {
                return Err(PaintingError::Unlike(what));
            }
        }
        let own = PaletteSpec::from_names(pigment_names(&canvas.state().slots, canvas.library()));
        let (scope, _) = PigmentNames::new(&own, canvas.library())?;
        let undo_limit =
            undo_limit_of(&canvas).saturating_add(palette.as_ref().map_or(0, undo_limit_of));
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
    /// [`PaintingError`] if the header describes other surfaces.
    pub fn recorded(
        canvas: Painting,
        palette: Option<Painting>,
        script: &StrokeScript,
    ) -> Result<Self, PaintingError> {
        let mut session = Self::new(canvas, palette)?;
        let mut header = script.rounded_header()?;
        let (canvas, slots) = (&session.canvas, session.canvas.state().slots);
        let (scope, named) = PigmentNames::new(&header.palette, canvas.library())?;
        let own = (&slots, canvas.library());
        header.check_painting(canvas.bounds(), canvas.cell_mm(), own, &named)?;
        let cells = session.palette.as_ref().map(|palette| palette.bounds());
        let cells = cells.map(|bounds| (bounds.width, bounds.height));
        if cells != header.mixing.as_ref().map(|mixing| mixing.cells()) {
            return Err(PaintingError::Unlike("palettes than the script describes"));
        }
        let bare = header.start.is_none();
        let medium = header.medium.clone().unwrap_or_else(|| Medium::of(canvas.library()));
        if bare && medium != *canvas.medium() {
            return Err(PaintingError::Unlike("media than the script describes"));
        }
        if bare && header.lighting.clone().unwrap_or_default() != canvas.state().lighting {
            return Err(PaintingError::Unlike("lights than the script describes"));
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

    /// Painting of a surface, for reading its pictures and paint. Change it only through the
    /// session, because the history of the session does not know of other changes.
    pub fn painting_mut(&mut self, surface: SurfaceId) -> Option<&mut Painting> {
        match surface {
            SurfaceId::Canvas => Some(&mut self.canvas),
            SurfaceId::Palette => self.palette.as_mut(),
        }
    }

    /// The paintings of canvas and palette.
    pub(super) fn paintings_mut(&mut self) -> impl Iterator<Item = &mut Painting> {
        [Some(&mut self.canvas), self.palette.as_mut()].into_iter().flatten()
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
    /// washed and replaced. If it belongs to the same head, nothing changes. Any open stroke
    /// or adjustment is finished first.
    ///
    /// # Errors
    /// [`PaintingError`] for a head that cannot be made on cells of this width, or if the
    /// device was lost.
    pub fn set_brush(&mut self, name: &str, spec: &BrushSpec) -> Result<(), PaintingError> {
        let spec = BrushSpec { size_mm: six_digits(spec.size_mm), ..spec.clone() };
        check_size(&CheckContext::default(), "size_mm", spec.size_mm)?;
        Head::new(spec.shape, spec.size_mm, self.canvas.cell_mm())?;
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
        self.brushes.named_heads().map(|(name, tool)| (name, &tool.spec))
    }

    /// Paint on a brush. `None` if there is no such brush, or if it was never used.
    ///
    /// # Errors
    /// [`PaintingError`] if the device was lost.
    pub fn brush_paint(&mut self, name: &str) -> Result<Option<Layer>, PaintingError> {
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
    /// [`PaintingError`] if the device was lost.
    pub fn documents(&mut self) -> Result<(Document, Option<Document>), PaintingError> {
        let canvas = self.canvas.document()?;
        let palette = self.palette.as_mut().map(Painting::document).transpose()?;
        Ok((canvas, palette))
    }

    /// The recording so far, without an open stroke or adjustment. `None` if the session
    /// records nothing.
    #[must_use]
    pub fn recording(&self) -> Option<&StrokeScript> {
        self.record.as_ref().map(|record| &record.script)
    }

    /// Why the recording ended early, if it did: a script may not be longer, or the backend failed.
    /// The session goes on without recording.
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
        let own = ActionLimits {
            canvas_mm: self.canvas.longer_side_mm(),
            palette_mm: self.palette.as_ref().map(Painting::longer_side_mm),
        };
        self.recording().map_or(own, StrokeScript::limits)
    }

    /// Painting of a surface. An error if the session does not have it.
    pub(super) fn surface_mut(
        &mut self,
        surface: SurfaceId,
    ) -> Result<&mut Painting, PaintingError> {
        self.surfaces().reach_mm(&CheckContext::default(), surface)?;
        Ok(match (surface, &mut self.palette) {
            (SurfaceId::Palette, Some(palette)) => palette,
            _ => &mut self.canvas,
        })
    }
}

fn undo_limit_of(painting: &Painting) -> u64 {
    painting.undo_bytes().1
}

impl PaintingSession {
    /// Starts a session on a bare canvas, painted on the processor and recorded. The
    /// palette holds the reference white of `library` or, if there is none, another of its
    /// pigments. [`PaintingSession::load`] adds pigments as they are needed.
    ///
    /// The documentation of the crate has an example.
    ///
    /// # Errors
    /// [`PaintingError`] for a canvas that cannot be made, or a library without a pigment.
    pub fn on_canvas(library: &PigmentLibrary, canvas: &Canvas) -> Result<Self, PaintingError> {
        let pigments = &library.pigments;
        let known = pigments.iter().find(|pigment| pigment.identified).or(pigments.first());
        let first = library.reference.as_deref().or(known.map(|pigment| pigment.name.as_str()));
        let palette = PaletteSpec::from_names(first);
        let script = StrokeScript::new("untitled", "", canvas.clone(), palette);
        let (document, _) = script.surfaces(library, None)?;
        let engine = PaintEngine::on_cpu(document.ground.height.clone());
        let painting = Painting::open(document, engine, UNDO_BYTES)?;
        Self::recorded(painting, None, &script)
    }

    /// Adds paint to a brush, `amount_mm` mm high on every cell of its head. `recipe` lists
    /// pigments by their names in the library, with their parts by volume. Pigments that
    /// are not on the palette are added to it.
    ///
    /// # Errors
    /// [`PaintingError`] for an unknown brush or pigment, for more than eight pigments on the
    /// palette, and if the brush cannot hold that much.
    pub fn load<'a>(
        &mut self,
        brush: &str,
        recipe: impl IntoIterator<Item = (&'a str, f64)>,
        amount_mm: f64,
    ) -> Result<(), PaintingError> {
        let parts: Vec<(&str, f64)> = recipe.into_iter().collect();
        let library = self.canvas.library();
        let slots = self.canvas.state().slots;
        let mut names = pigment_names(&slots, library);
        let before = names.len();
        for (name, _) in &parts {
            let pigment = library.pigments.iter().find(|pigment| pigment.name == *name);
            if let Some(pigment) = pigment.filter(|pigment| !names.contains(&pigment.name.as_str()))
            {
                names.push(&pigment.name);
            }
        }
        if names.len() > before {
            let palette = Action::Palette(PaletteSpec::from_names(names));
            self.apply(&palette)?;
        }
        let recipe: Recipe =
            parts.into_iter().map(|(name, part)| (name.to_owned(), part)).collect();
        self.apply(&Action::Load(Load {
            brush: brush.to_owned(),
            recipe,
            vehicle: 0.0,
            amount_mm,
        }))?;
        Ok(())
    }

    /// Paints a stroke on the canvas. An undo takes it back.
    ///
    /// # Errors
    /// [`PaintingError`] for an unknown brush and for impossible samples. Nothing is painted
    /// then.
    pub fn stroke(
        &mut self,
        brush: &str,
        samples: &[Sample],
    ) -> Result<StrokeReport, PaintingError> {
        let brush = brush.to_owned();
        let stroke = Stroke { brush, samples: samples.to_vec(), ..Stroke::default() };
        Ok(match self.apply(&Action::Stroke(stroke))? {
            Outcome::Painted(report) => report,
            Outcome::Done | Outcome::Nothing => StrokeReport::default(),
        })
    }

    /// Saves the canvas as a painting file (OpenEXR, see [`crate::file`]).
    ///
    /// # Errors
    /// [`PaintingError`] if the file cannot be written.
    pub fn save(&mut self, path: impl AsRef<Path>) -> Result<(), PaintingError> {
        self.finish_open()?;
        Ok(self.canvas.document()?.save(path.as_ref())?)
    }
}

/// A head of a session.
#[derive(Debug, Clone, PartialEq)]
pub struct KeptHead {
    /// Name under which it was added.
    pub name: String,
    /// Its name in the recording, unique among all heads.
    pub recorded: String,
    /// Shape and size.
    pub spec: BrushSpec,
    /// Whether its name refers to it now. Another head may have taken the name.
    pub named: bool,
    /// Surface whose painting holds its paint. In the other one it is clean.
    pub at: SurfaceId,
    /// Its id in the painting of each surface, once it was used there.
    pub ids: PerSurface<Option<BrushId>>,
    /// The paint on it, by slots of the palette. `None` if it is clean. Also `None` while a session
    /// uses the head, because the painting of its surface then holds the paint.
    pub paint: Option<Layer>,
}

impl KeptHead {
    pub(super) fn used(&self) -> bool {
        self.ids.iter().any(Option::is_some)
    }
}

/// State of a head after it was added.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Added {
    /// No wash needed: the head was never used, or the name referred to it already.
    Ready,
    /// The name refers again to a head that had it before. The head was used, so it may have paint
    /// on it.
    Used,
}

/// All brushes of a session.
#[derive(Debug, Default)]
pub(super) struct Brushes {
    /// All heads, including those whose name now belongs to another: undo needs them.
    pub(super) tools: Vec<KeptHead>,
}

impl Brushes {
    /// Adds a brush under a name, in place of the one with that name.
    pub(super) fn add(&mut self, name: &str, spec: &BrushSpec) -> Added {
        if let Some(now) = self.find(name) {
            if self.tools[now].spec == *spec {
                return Added::Ready;
            }
            let again = self.tools.iter().position(|t| t.name == name && t.spec == *spec);
            if let Some(again) = again {
                self.tools[now].named = false;
                self.tools[again].named = true;
                return if self.tools[again].used() { Added::Used } else { Added::Ready };
            }
            if !self.tools[now].used() {
                self.tools[now].spec = spec.clone();
                return Added::Ready;
            }
        }
        self.restore(KeptHead {
            name: name.to_owned(),
            recorded: self.free_name(name),
            spec: spec.clone(),
            named: true,
            at: SurfaceId::Canvas,
            ids: PerSurface::default(),
            paint: None,
        });
        Added::Ready
    }

    /// Adds a head. If it is `named`, it takes its name from the head that has it.
    pub(super) fn restore(&mut self, head: KeptHead) {
        if let Some(before) = self.find(&head.name).filter(|_| head.named) {
            self.tools[before].named = false;
        }
        self.tools.push(head);
    }

    /// Index of the head that has a name now.
    pub(super) fn find(&self, name: &str) -> Option<usize> {
        self.tools.iter().position(|tool| tool.named && tool.name == name)
    }

    /// The heads that have a name now, with their names, sorted by name.
    pub(super) fn named_heads(&self) -> impl Iterator<Item = (&str, &KeptHead)> + Clone {
        let mut named: Vec<_> = self.tools.iter().filter(|tool| tool.named).collect();
        named.sort_by(|a, b| a.name.cmp(&b.name));
        named.into_iter().map(|tool| (tool.name.as_str(), tool))
    }

    /// Heads whose name now belongs to another.
    pub(super) fn replaced(&self) -> Vec<usize> {
        (0..self.tools.len()).filter(|&tool| !self.tools[tool].named).collect()
    }

    /// `name`, with a number appended if another head was recorded under it.
    fn free_name(&self, name: &str) -> String {
        let used: BTreeSet<&str> = self.tools.iter().map(|tool| &*tool.recorded).collect();
        let numbered = (2_usize..).map(|number| format!("{name} {number}"));
        let mut names = std::iter::once(name.to_owned()).chain(numbered);
        names.find(|name| !used.contains(name.as_str())).unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::brush::HeadShape;

    fn spec(size_mm: f64) -> BrushSpec {
        BrushSpec { shape: HeadShape::Round, size_mm }
    }

    fn now(brushes: &Brushes, name: &str) -> (usize, String) {
        let tool = brushes.find(name).expect("it was added");
        (tool, brushes.tools[tool].recorded.clone())
    }

    #[test]
    fn a_used_head_keeps_its_recorded_name_and_others_get_their_own() {
        let mut brushes = Brushes::default();
        assert_eq!(brushes.add("round", &spec(6.0)), Added::Ready);
        // The brush is not used yet, so its entry is replaced.
        brushes.add("round", &spec(7.0));
        assert_eq!((now(&brushes, "round"), brushes.tools.len()), ((0, "round".to_owned()), 1));
        brushes.tools[0].ids[SurfaceId::Canvas] = Some(BrushId(0));
        brushes.add("round", &spec(8.0));
        assert_eq!(now(&brushes, "round"), (1, "round 2".to_owned()));
        brushes.add("round 2", &spec(8.0));
        assert_eq!(now(&brushes, "round 2"), (2, "round 2 2".to_owned()));
        assert_eq!(brushes.add("round", &spec(7.0)), Added::Used, "the first again");
        assert_eq!(brushes.add("round", &spec(7.0)), Added::Ready, "it is in hand");
        assert_eq!(now(&brushes, "round"), (0, "round".to_owned()));
        assert_eq!(brushes.add("round", &spec(8.0)), Added::Ready, "it was never used");
        assert_eq!(brushes.replaced(), [0], "`round` is the second again");
        let names: Vec<&str> = brushes.named_heads().map(|(name, _)| name).collect();
        assert_eq!(names, ["round", "round 2"]);
    }
}
