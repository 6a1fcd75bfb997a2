//! A script played on a painting.

use std::collections::BTreeMap;

use super::action::{Action, LayerName};
use super::resolve::{ActionPigments, Resolved};
use super::script::Strokes;
use crate::layer::SLOTS;
use crate::paint::painting::{Coating, Painting, PaintingError, StrokeReport};

/// What a replay did.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct ReplayReport {
    /// Actions played.
    pub actions: u64,
    /// Strokes among them.
    pub strokes: u64,
    /// Sub-steps of all strokes in which the head was over the canvas.
    pub substeps: u64,
    /// Cells of all their rectangles.
    pub cells: u64,
    /// Undo and redo that found nothing to do.
    pub idle: u64,
    /// Strokes too large for undo.
    pub not_undoable: u64,
}

/// Why a replay ended early; `E` is the saver's own error.
#[derive(Debug, thiserror::Error)]
pub enum ReplayError<E: std::error::Error + 'static> {
    /// An action that the painting refuses.
    #[error("action {index} ({kind})")]
    Action {
        /// Which action, counted from 0.
        index: usize,
        /// Its key in the file.
        kind: &'static str,
        /// Why.
        #[source]
        error: PaintingError,
    },
    /// A file that could not be saved.
    #[error("action {index} (save)")]
    Save {
        /// Which action, counted from 0.
        index: usize,
        /// Why.
        #[source]
        error: E,
    },
}

impl Strokes {
    /// Plays all actions on `painting`, which must be of the library of
    /// `resolved`. `save` is called for each action that saves, with its path;
    /// `step` after each action.
    ///
    /// # Errors
    /// [`ReplayError`] at the first action that cannot be done.
    pub fn replay<E: std::error::Error + 'static>(
        &self,
        resolved: &Resolved,
        painting: &mut Painting,
        mut save: impl FnMut(&str, &mut Painting) -> Result<(), E>,
        mut step: impl FnMut(),
    ) -> Result<ReplayReport, ReplayError<E>> {
        let mut report = ReplayReport::default();
        let mut brushes = BTreeMap::new();
        for (index, (action, pigments)) in self.actions.iter().zip(&resolved.actions).enumerate() {
            if let Action::Save { path } = action {
                save(path, painting).map_err(|error| ReplayError::Save { index, error })?;
            } else {
                self.act(action, pigments, painting, &mut brushes, &mut report)
                    .map_err(|error| ReplayError::Action { index, kind: action.kind(), error })?;
            }
            report.actions += 1;
            step();
        }
        Ok(report)
    }

    fn act<'a>(
        &'a self,
        action: &'a Action,
        pigments: &ActionPigments,
        painting: &mut Painting,
        brushes: &mut BTreeMap<&'a str, usize>,
        report: &mut ReplayReport,
    ) -> Result<(), PaintingError> {
        // A brush is taken from the jar when it is first used.
        let mut brush = |name: &'a str, painting: &mut Painting| match brushes.get(name) {
            Some(&brush) => Ok(brush),
            None => {
                let spec = &self.brushes[name];
                let brush = painting.add_brush(spec.shape, spec.size_mm)?;
                brushes.insert(name, brush);
                Ok::<_, PaintingError>(brush)
            }
        };
        match (action, pigments) {
            (Action::Load(load), ActionPigments::Recipe(parts)) => {
                let brush = brush(&load.brush, painting)?;
                let recipe = recipe(painting, parts)?;
                painting.load(brush, &recipe, load.vehicle, load.amount_mm)?;
            }
            (Action::Stroke(stroke), _) => {
                let brush = brush(&stroke.brush, painting)?;
                let StrokeReport { substeps, cells, undoable } =
                    painting.stroke(brush, &stroke.samples)?;
                report.strokes += 1;
                report.substeps += substeps;
                report.cells += cells;
                report.not_undoable += u64::from(!undoable);
            }
            (Action::Wipe { brush: name, keep }, _) => {
                let brush = brush(name, painting)?;
                painting.wipe(brush, *keep)?;
            }
            (Action::Wash { brush: name }, _) => {
                let brush = brush(name, painting)?;
                painting.wash(brush)?;
            }
            (Action::Dry { fraction }, _) => {
                painting.dry(*fraction)?;
            }
            (Action::Palette(_), ActionPigments::Palette(slots)) => {
                let pigments: Vec<usize> = slots.iter().flatten().copied().collect();
                painting.set_palette(&pigments)?;
            }
            (Action::Undo {}, _) => report.idle += u64::from(!painting.undo()?),
            (Action::Redo {}, _) => report.idle += u64::from(!painting.redo()?),
            (Action::Light(lighting), _) => painting.relight(lighting.clone())?,
            (Action::Opacity { layer, value }, _) => {
                painting.set_opacity(coating(*layer), *value)?;
            }
            (Action::Swap { layer, .. }, ActionPigments::Swap { from, to }) => {
                painting.swap_pigment(coating(*layer), *from, *to)?;
            }
            (Action::Merge { layer }, _) => painting.merge(layer.saturating_sub(1))?,
            (action, _) => unreachable!("{} is resolved otherwise", action.kind()),
        }
        Ok(())
    }
}

fn coating(layer: LayerName) -> Coating {
    match layer {
        LayerName::Wet => Coating::Wet,
        LayerName::Dry(index) => Coating::Dry(index),
    }
}

/// Parts by slot of the palette of this moment.
fn recipe(painting: &Painting, parts: &[(usize, f64)]) -> Result<[f64; SLOTS], PaintingError> {
    let mut recipe = [0.0; SLOTS];
    for &(pigment, part) in parts {
        recipe[painting.slot_of(pigment)?] = part;
    }
    Ok(recipe)
}
