//! A photograph and pigments as the subject of the technique of strokes.

use documents::Task;
use graphics::picture::Photograph;
use paint::engine::PaintEngine;
use paint::technique::Technique;
use pigment::PigmentLibrary;

use super::settings::{StrokePreset, StrokeSettings};
use super::stroke_painter::{PaintedPhotograph, StrokePainter, StrokePainterError};

/// A photograph, and the pigments that it is painted in.
#[derive(Debug, Clone, Copy)]
pub struct Subject<'a> {
    /// The photograph.
    pub photograph: &'a Photograph,
    /// The library of the pigments.
    pub library: &'a PigmentLibrary,
}

impl Technique for StrokePainter {
    const NAME: &'static str = "strokes";
    const EXAMPLES: &'static [&'static str] = &["tolerance=3", "brushes_mm=[8, 2]"];

    type Settings = StrokeSettings;
    type Preset = StrokePreset;
    type Subject<'a> = Subject<'a>;
    /// An engine that you opened over the heights of [`StrokePainter::ground`].
    type View<'a> = PaintEngine;
    type Picture = PaintedPhotograph;
    type Error = StrokePainterError;

    fn prepare(
        subject: Subject<'_>,
        settings: &StrokeSettings,
        task: &Task,
    ) -> Result<Self, StrokePainterError> {
        task.stage("mixing colours");
        task.check()?;
        Self::new(subject.photograph, subject.library, settings)
    }

    fn paint(
        &mut self,
        engine: PaintEngine,
        task: &Task,
    ) -> Result<PaintedPhotograph, StrokePainterError> {
        task.stage("painting");
        self.paint_with(engine, task)
    }
}
