//! Summaries of the dry layers, computed while the worker is idle.

use std::sync::Arc;

use paint::document::LayerId;
use paint::light::Light;
use paint::painting::{DryLayerState, Painting, PaintingError};

use super::srgb::SrgbBytes;
use super::state::{LayerState, Thumbnail};
use super::thumbnail::LayerSummary;

/// Summary of one layer.
#[derive(Debug)]
struct LayerEntry {
    id: LayerId,
    /// Whether the summary describes the dry paint as it is now.
    current: bool,
    summary: Option<LayerSummary>,
    /// State that was sent last, and the light under which its thumbnail was rendered.
    sent: Option<(LayerState, Arc<Light>)>,
}

/// Summaries of all dry layers.
#[derive(Debug, Default)]
pub(super) struct Layers {
    changes: u64,
    entries: Vec<LayerEntry>,
}

impl Layers {
    /// Marks all summaries as outdated if dry paint of `painting` changed. Outdated summaries are
    /// used until [`Self::summarize_next`] replaces them, each for the layer that it was made of,
    /// wherever that lies now.
    pub(super) fn update(&mut self, painting: &Painting) {
        let dry = &painting.state().dry;
        let same = dry.iter().map(|layer| layer.id).eq(self.entries.iter().map(|entry| entry.id));
        if painting.dry_changes() == self.changes && same {
            return;
        }
        self.changes = painting.dry_changes();
        let mut former = std::mem::take(&mut self.entries);
        self.entries = dry
            .iter()
            .map(|layer: &DryLayerState| {
                let known = former.iter().position(|entry| entry.id == layer.id);
                let known = known.map(|index| former.swap_remove(index));
                LayerEntry {
                    current: false,
                    ..known.unwrap_or_else(|| LayerEntry {
                        id: layer.id,
                        current: false,
                        summary: None,
                        sent: None,
                    })
                }
            })
            .collect();
    }

    /// Whether a summary is outdated.
    pub(super) fn is_behind(&self) -> bool {
        self.entries.iter().any(|entry| !entry.current)
    }

    /// Computes the first summary that is outdated. Layers may have come or gone since the last
    /// update, as states are sent less often than paint changes.
    ///
    /// # Errors
    /// [`PaintingError`] if the device was lost.
    pub(super) fn summarize_next(&mut self, painting: &mut Painting) -> Result<(), PaintingError> {
        self.update(painting);
        let outdated = self.entries.iter().position(|entry| !entry.current);
        let Some(index) = outdated else { return Ok(()) };
        let bounds = painting.bounds();
        let cell_mm = painting.cell_mm();
        let summary = LayerSummary::new(bounds, cell_mm, |rect| painting.dry_in(index, rect))?;
        let entry = &mut self.entries[index];
        (entry.current, entry.summary, entry.sent) = (true, Some(summary), None);
        Ok(())
    }

    /// States of all layers. A layer without a summary has zeros and an empty thumbnail.
    pub(super) fn states(&mut self, painting: &Painting, bytes: &SrgbBytes) -> Vec<LayerState> {
        self.update(painting);
        let light = painting.light();
        let layers = self.entries.iter_mut().zip(&painting.state().dry);
        let state = |(entry, dry): (&mut LayerEntry, &DryLayerState)| {
            let Some(summary) = &entry.summary else { return blank(dry) };
            if let Some((sent, under)) = &mut entry.sent
                && (sent.slots, sent.opacity) == (dry.slots, dry.opacity)
                && Arc::ptr_eq(under, light)
            {
                dry.name.clone_into(&mut sent.name);
                sent.visible = dry.visible;
                return sent.clone();
            }
            let state = summary.state(dry, painting, bytes);
            entry.sent = Some((state.clone(), Arc::clone(light)));
            state
        };
        layers.map(state).collect()
    }
}

/// State of a layer that was not summarized yet.
fn blank(dry: &DryLayerState) -> LayerState {
    LayerState {
        id: dry.id,
        name: dry.name.clone(),
        visible: dry.visible,
        slots: dry.slots,
        opacity: dry.opacity,
        mean_mm: 0.0,
        max_mm: 0.0,
        coverage: 0.0,
        thumbnail: Arc::new(Thumbnail { width: 1, height: 1, pixels: vec![[0; 4]] }),
    }
}

#[cfg(test)]
mod tests {
    use graphics::gpu::BackendChoice;
    use paint::strokes::{Action, Squeeze, SurfaceId};
    use pigment::library::PigmentLibrary;

    use super::super::backend::Backend;
    use super::super::defaults::blank_canvas;
    use super::super::prepare::prepare;
    use super::*;

    #[test]
    fn a_layer_that_is_undone_before_its_summary_is_not_asked_for() {
        let origin = blank_canvas(PigmentLibrary::van_gogh_oils(), 4.0, 3.0, 0.1);
        let backend = &mut Backend::new(BackendChoice::Cpu);
        let mut session = prepare(origin, backend, 1 << 24).unwrap().session;
        let heap = Squeeze {
            on: SurfaceId::Canvas,
            recipe: [("Vermilion".to_owned(), 1.0)].into(),
            vehicle: 0.0,
            x_mm: 2.0,
            y_mm: 1.5,
            volume_mm3: 0.5,
        };
        session.apply(&Action::Squeeze(heap)).unwrap();
        session.apply(&Action::Dry { fraction: 1.0 }).unwrap();
        let mut layers = Layers::default();
        layers.update(session.canvas());
        assert!(layers.is_behind());
        session.apply(&Action::Undo {}).unwrap();
        layers.summarize_next(session.canvas_mut()).unwrap();
        assert!(!layers.is_behind() && layers.entries.is_empty());
    }
}
