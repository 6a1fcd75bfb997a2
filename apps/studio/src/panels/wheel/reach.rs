//! How near the tubes come to a colour, searched on a background thread.

use std::sync::Arc;

use eframe::egui::Context;
use pigment::matching::{MatchRequest, Target, ViewingCondition};
use session::PaintingState;
use spectra::color::Lab;

use crate::recipe_search::{RecipeSearch, SearchRequest};

/// Search for the nearest mixture of the tubes.
#[derive(Debug, Default)]
pub(super) struct Reach {
    search: RecipeSearch,
    of: Option<SearchRequest>,
}

impl Reach {
    /// Follows the colour that is wanted, the tubes and the light.
    pub(super) fn update(
        &mut self,
        context: &Context,
        painting: &PaintingState,
        wanted: Option<Lab>,
    ) {
        self.search.update();
        let request = wanted.map(|wanted| request(painting, wanted));
        if self.of == request {
            return;
        }
        self.of.clone_from(&request);
        let context = context.clone();
        match request {
            Some(request) => self.search.start(request, move || context.request_repaint()),
            None => self.search.cancel(),
        }
    }

    /// CIEDE2000 from the wanted colour to the nearest mixture; `None` while it is searched.
    pub(super) fn delta_e(&self) -> Option<f64> {
        let result =
            self.search.result().filter(|result| Some(&result.request) == self.of.as_ref())?;
        let nearest = result.recipes.as_ref().ok()?.first()?;
        nearest.delta_e.first().copied()
    }
}

/// Search for the best recipe of the tubes, with shares of any size.
fn request(painting: &PaintingState, wanted: Lab) -> SearchRequest {
    let library = Arc::clone(&painting.library);
    let viewing = painting.light.viewing.clone();
    let conditions = vec![ViewingCondition { viewing, weight: 1.0 }];
    let target = Target::from_lab("wanted", wanted, &conditions);
    let film = MatchRequest::usual_film(&library, painting.ground_reflectance.to_vec());
    let mut limits = MatchRequest::new(&library, conditions, film);
    limits.allowed = painting
        .slots
        .iter()
        .copied()
        .flatten()
        .filter(|pigment: &_| library[*pigment].identified)
        .collect();
    limits.allowed.sort_unstable();
    limits.allowed.dedup();
    (limits.least_share, limits.count) = (0.0, 1);
    SearchRequest { library, target, limits }
}
