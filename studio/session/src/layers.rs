//! Summaries of the dry layers, computed while the worker is idle.

use std::sync::Arc;

use render::light::Light;
use render::paint::painting::{Painting, PaintingError};

use super::srgb::SrgbBytes;
use super::state::{LayerState, Thumbnail};
use super::thumbnail::LayerSummary;

/// Summary of one layer.
#[derive(Debug)]
struct LayerEntry {
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
    /// used until [`Self::summarize_next`] replaces them.
    pub(super) fn update(&mut self, painting: &Painting) {
        let count = painting.state().dry.len();
        if painting.dry_changes() != self.changes || count != self.entries.len() {
            self.changes = painting.dry_changes();
            let new = || LayerEntry { current: false, summary: None, sent: None };
            self.entries.resize_with(count, new);
            for entry in &mut self.entries {
                entry.current = false;
            }
        }
    }

    /// Whether a summary is outdated.
    pub(super) fn is_behind(&self) -> bool {
        self.entries.iter().any(|entry| !entry.current)
    }

    /// Computes the first summary that is outdated.
    ///
    /// # Errors
    /// [`PaintingError`] if the device was lost.
    pub(super) fn summarize_next(&mut self, painting: &mut Painting) -> Result<(), PaintingError> {
        let outdated = self.entries.iter().position(|entry| !entry.current);
        let Some(index) = outdated else { return Ok(()) };
        let (bounds, cell_mm) = (painting.bounds(), painting.cell_mm());
        let summary = LayerSummary::new(bounds, cell_mm, |rect| painting.dry_in(index, rect))?;
        self.entries[index] = LayerEntry { current: true, summary: Some(summary), sent: None };
        Ok(())
    }

    /// States of all layers. A layer without a summary has zeros and an empty thumbnail.
    pub(super) fn states(&mut self, painting: &Painting, bytes: &SrgbBytes) -> Vec<LayerState> {
        self.update(painting);
        let light = painting.light();
        let layers = self.entries.iter_mut().zip(&painting.state().dry);
        let state = |(entry, dry): (&mut LayerEntry, &render::paint::painting::DryLayerState)| {
            let Some(summary) = &entry.summary else { return blank(dry.slots, dry.opacity) };
            if let Some((sent, under)) = &entry.sent
                && (sent.slots, sent.opacity) == (dry.slots, dry.opacity)
                && Arc::ptr_eq(under, light)
            {
                return sent.clone();
            }
            let state = summary.state(dry.slots, dry.opacity, painting, bytes);
            entry.sent = Some((state.clone(), Arc::clone(light)));
            state
        };
        layers.map(state).collect()
    }
}

fn blank(slots: render::paint::document::Slots, opacity: f64) -> LayerState {
    let thumbnail = Arc::new(Thumbnail { width: 1, height: 1, pixels: vec![[0; 4]] });
    LayerState { slots, opacity, mean_mm: 0.0, max_mm: 0.0, coverage: 0.0, thumbnail }
}
