//! Colours of the kept mixtures under the light of the painting.

use std::sync::Arc;

use paint::light::Light;
use pigment::library::PigmentLibrary;
use session::PaintingState;
use session::swatches::{KeptMixture, SwatchBook};

/// Colours by index of the list, computed anew when light, library or list change.
#[derive(Debug, Clone, Default)]
pub(super) struct SwatchColors {
    of: Option<(Arc<PigmentLibrary>, Arc<Light>, SwatchBook)>,
    colors: Vec<[u8; 3]>,
}

impl SwatchColors {
    /// sRGB of each mixture of `book`; one whose pigments are missing has the colour with which it
    /// was kept.
    pub(super) fn get(&mut self, painting: &PaintingState, book: &SwatchBook) -> &[[u8; 3]] {
        let PaintingState { library, light, .. } = painting;
        let same = self.of.as_ref().is_some_and(|(own, under, list)| {
            Arc::ptr_eq(own, library) && Arc::ptr_eq(under, light) && list == book
        });
        if !same && let Ok(weights) = light.viewing.weights(library.grid) {
            self.colors = book
                .swatches
                .iter()
                .map(|kept: &KeptMixture| kept.screen_color(library, &weights))
                .collect();
            self.of = Some((Arc::clone(library), Arc::clone(light), book.clone()));
        }
        &self.colors
    }
}
