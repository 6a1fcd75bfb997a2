//! What is known of the dry layers, looked at when there is time.

use std::sync::Arc;

use render::light::Light;
use render::paint::painting::{Painting, PaintingError};

use super::srgb::SrgbBytes;
use super::state::{LayerState, Thumbnail};
use super::thumbnail::LayerSummary;

/// One layer.
#[derive(Debug)]
struct Known {
    /// Whether it was looked at since dry paint last changed.
    looked: bool,
    glance: Option<LayerSummary>,
    /// As last told, and the light of its thumbnail.
    told: Option<(LayerState, Arc<Light>)>,
}

/// All dry layers.
#[derive(Debug, Default)]
pub(super) struct Layers {
    changes: u64,
    known: Vec<Known>,
}

impl Layers {
    /// Follows `painting`: after dry paint came or went all layers are looked at
    /// anew, and shown as they were until then.
    pub(super) fn follow(&mut self, painting: &Painting) {
        let count = painting.state().dry.len();
        if painting.dry_changes() != self.changes || count != self.known.len() {
            self.changes = painting.dry_changes();
            self.known.resize_with(count, || Known { looked: false, glance: None, told: None });
            for known in &mut self.known {
                known.looked = false;
            }
        }
    }

    /// Whether a layer waits to be looked at.
    pub(super) fn is_behind(&self) -> bool {
        self.known.iter().any(|known| !known.looked)
    }

    /// Looks at one layer that waits.
    ///
    /// # Errors
    /// [`PaintingError`] if the device was lost.
    pub(super) fn look(&mut self, painting: &mut Painting) -> Result<(), PaintingError> {
        let waits = self.known.iter().position(|known| !known.looked);
        let Some(index) = waits else { return Ok(()) };
        let (bounds, cell_mm) = (painting.bounds(), painting.cell_mm());
        let glance = LayerSummary::at(bounds, cell_mm, |rect| painting.dry_in(index, rect))?;
        let told = None;
        self.known[index] = Known { looked: true, glance: Some(glance), told };
        Ok(())
    }

    /// The layers for the window; one that nobody looked at yet has no figures and
    /// an empty thumbnail.
    pub(super) fn states(&mut self, painting: &Painting, bytes: &SrgbBytes) -> Vec<LayerState> {
        self.follow(painting);
        let light = painting.light();
        let layers = self.known.iter_mut().zip(&painting.state().dry);
        let state = |(known, dry): (&mut Known, &render::paint::painting::DryLayerState)| {
            let Some(glance) = &known.glance else { return blank(dry.slots, dry.opacity) };
            if let Some((told, under)) = &known.told
                && (told.slots, told.opacity) == (dry.slots, dry.opacity)
                && Arc::ptr_eq(under, light)
            {
                return told.clone();
            }
            let state = glance.state(dry.slots, dry.opacity, painting, bytes);
            known.told = Some((state.clone(), Arc::clone(light)));
            state
        };
        layers.map(state).collect()
    }
}

fn blank(slots: render::paint::document::Slots, opacity: f64) -> LayerState {
    let thumbnail = Arc::new(Thumbnail { width: 1, height: 1, pixels: vec![[0; 4]] });
    LayerState { slots, opacity, mean_mm: 0.0, max_mm: 0.0, coverage: 0.0, thumbnail }
}
