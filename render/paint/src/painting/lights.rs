//! Lights of a painting, gloss and stiffness of its paint.

use std::sync::Arc;

use super::failure::PaintingError;
use super::state::Painting;
use super::views::{PendingTiles, SecondLight};
use crate::document::Lighting;
use crate::engine::View;
use crate::light::Light;
use crate::optics::Gloss;
use graphics::tile::TileSet;

impl Painting {
    /// Shows the painting under another light, given by name.
    ///
    /// # Errors
    /// [`PaintingError::Light`] if the light is unknown.
    ///
    /// # Panics
    /// If a stroke is open.
    pub fn relight(&mut self, lighting: Lighting) -> Result<(), PaintingError> {
        let light = if same_light(&self.state.lighting, &lighting) {
            None
        } else {
            Some(Light::named(&self.library, &lighting.illuminant, &lighting.observer)?)
        };
        self.apply_action(|painting| {
            painting.state.lighting = lighting;
            match light {
                Some(light) => {
                    painting.light = Arc::new(light);
                    painting.views.first.mark_all(painting.engine.bounds());
                }
                None => painting.views.first.wet = TileSet::all(painting.engine.bounds()),
            }
            Ok(())
        })
    }

    /// Sets the gloss of wet and of dry paint.
    ///
    /// # Errors
    /// [`PaintingError::Gloss`] if a strength is outside 0 to 100 or an exponent outside 0 to
    /// 1e6.
    ///
    /// # Panics
    /// If a stroke is open.
    pub fn set_gloss(&mut self, wet: Gloss, dry: Gloss) -> Result<(), PaintingError> {
        for Gloss { strength, exponent } in [wet, dry] {
            if !((0.0..=100.0).contains(&strength) && (0.0..=1e6).contains(&exponent)) {
                return Err(PaintingError::Gloss { strength, exponent });
            }
        }
        self.apply_action(|painting| {
            let medium = &mut painting.state.medium;
            (medium.wet, medium.dry) = (wet, dry);
            painting.views.mark_all_wet();
            Ok(())
        })
    }

    /// Sets the stiffness of the wet paint ([`stiffness`](crate::document::Medium::stiffness)).
    /// Paint levels by it after the next stroke.
    ///
    /// # Errors
    /// [`PaintingError::Stiffness`] outside 0 to 1.
    ///
    /// # Panics
    /// If a stroke is open.
    pub fn set_stiffness(&mut self, stiffness: f64) -> Result<(), PaintingError> {
        if !(0.0..=1.0).contains(&stiffness) {
            return Err(PaintingError::Stiffness { stiffness });
        }
        self.apply_action(|painting| {
            painting.state.medium.stiffness = stiffness;
            Ok(())
        })
    }

    /// Also keeps a picture under a second light, for a view that is split between the two;
    /// `None` frees its memory. Not an action of the history.
    ///
    /// # Errors
    /// [`PaintingError::Light`] if the light is unknown; the second light stays unchanged.
    pub fn set_second_light(&mut self, lighting: Option<Lighting>) -> Result<(), PaintingError> {
        let Some(lighting) = lighting else {
            self.views.second = None;
            self.engine.forget_view(View::Second);
            return Ok(());
        };
        let known = self.views.second.as_ref();
        let known = known.map(|second| (&second.lighting, &second.light));
        let known = known.into_iter().chain([(&self.state.lighting, &self.light)]);
        let light = match known.into_iter().find(|(known, _)| same_light(known, &lighting)) {
            Some((_, light)) => Arc::clone(light),
            None => {
                let Lighting { illuminant, observer, .. } = &lighting;
                Arc::new(Light::named(&self.library, illuminant, observer)?)
            }
        };
        self.replace_second_light(lighting, light);
        Ok(())
    }

    fn replace_second_light(&mut self, lighting: Lighting, light: Arc<Light>) {
        let bounds = self.engine.bounds();
        let pending = match self.views.second.take() {
            Some(SecondLight { light: before, mut pending, .. })
                if Arc::ptr_eq(&before, &light) =>
            {
                pending.wet = TileSet::all(bounds);
                pending
            }
            _ => PendingTiles::all(bounds),
        };
        self.views.second = Some(SecondLight { lighting, light, pending });
    }

    /// The second light, if there is one.
    #[must_use]
    pub fn second_light(&self) -> Option<&Lighting> {
        self.views.second.as_ref().map(|second| &second.lighting)
    }

    /// Shows the painting under the light of another painting of the same library.
    ///
    /// # Errors
    /// [`PaintingError`] if the device was lost.
    ///
    /// # Panics
    /// If a stroke is open.
    pub fn relight_as(&mut self, other: &Self) -> Result<(), PaintingError> {
        self.apply_action(|painting| {
            painting.state.lighting = other.state.lighting.clone();
            let bounds = painting.engine.bounds();
            if Arc::ptr_eq(&painting.light, &other.light) {
                painting.views.first.wet = TileSet::all(bounds);
            } else {
                painting.light = Arc::clone(&other.light);
                painting.views.first.mark_all(bounds);
            }
            Ok(())
        })
    }
}

/// Whether both name the same illuminant and observer.
fn same_light(a: &Lighting, b: &Lighting) -> bool {
    (&a.illuminant, &a.observer) == (&b.illuminant, &b.observer)
}
