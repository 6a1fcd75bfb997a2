//! Short interface for programs: a session on a bare canvas, pigments and brushes by name.

use std::path::Path;

use pigment::library::PigmentLibrary;

use super::failure::SessionError;
use super::state::{Outcome, PaintingSession};
use crate::canvas::Canvas;
use crate::engine::PaintEngine;
use crate::painting::{Painting, StrokeReport, UNDO_BYTES};
use crate::pose::Sample;
use crate::strokes::{
    Action, Load, PaletteSpec, Recipe, Stroke, StrokeScript, StrokeTool, SurfaceId, pigment_names,
};

impl PaintingSession {
    /// Starts a session on a bare canvas, painted on the processor and recorded. The
    /// palette holds the reference white of `library` or, if there is none, another of its
    /// pigments. [`PaintingSession::load`] adds pigments as they are needed.
    ///
    /// The documentation of the crate has an example.
    ///
    /// # Errors
    /// [`SessionError`] for a canvas that cannot be made, or a library without a pigment.
    pub fn on_canvas(library: &PigmentLibrary, canvas: &Canvas) -> Result<Self, SessionError> {
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
    /// [`SessionError`] for an unknown brush or pigment, for more than eight pigments on the
    /// palette, and if the brush cannot hold that much.
    pub fn load<'a>(
        &mut self,
        brush: &str,
        recipe: impl IntoIterator<Item = (&'a str, f64)>,
        amount_mm: f64,
    ) -> Result<(), SessionError> {
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
    /// [`SessionError`] for an unknown brush and for impossible samples; nothing is painted
    /// then.
    pub fn stroke(
        &mut self,
        brush: &str,
        samples: &[Sample],
    ) -> Result<StrokeReport, SessionError> {
        self.stroke_as(StrokeTool::Paint, brush, samples)
    }

    /// Works the wet paint of the canvas with the head of a brush as `tool`. An undo takes it back.
    ///
    /// # Errors
    /// [`SessionError`] for an unknown brush, and for impossible samples and tools; nothing is
    /// changed then.
    pub fn stroke_as(
        &mut self,
        tool: StrokeTool,
        brush: &str,
        samples: &[Sample],
    ) -> Result<StrokeReport, SessionError> {
        let samples = samples.to_vec();
        let stroke = Stroke { brush: brush.to_owned(), on: SurfaceId::Canvas, tool, samples };
        Ok(match self.apply(&Action::Stroke(stroke))? {
            Outcome::Painted(report) => report,
            Outcome::Done | Outcome::Nothing => StrokeReport::default(),
        })
    }

    /// Saves the canvas as a painting file (OpenEXR, see [`crate::file`]).
    ///
    /// # Errors
    /// [`SessionError`] if the file cannot be written.
    pub fn save(&mut self, path: impl AsRef<Path>) -> Result<(), SessionError> {
        self.finish_open()?;
        Ok(self.canvas.document()?.save(path.as_ref())?)
    }
}
