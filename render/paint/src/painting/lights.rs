//! The lights that a painting is seen under.

use std::sync::Arc;

use pigment::evaluate::Viewing;

use super::failure::PaintingError;
use super::state::Painting;
use super::views::{SecondLight, Unseen};
use crate::document::Lighting;
use crate::engine::View;
use crate::light::Light;
use crate::optics::Gloss;
use graphics::tile::TileSet;

impl Painting {
    /// Shows the painting under another light, one that has a name.
    ///
    /// # Errors
    /// [`PaintingError`] for a light that nobody knows.
    pub fn relight(&mut self, lighting: Lighting) -> Result<(), PaintingError> {
        let light = if same_lamp(&self.state.lighting, &lighting) {
            None
        } else {
            Some(Light::named(&self.library, &lighting.illuminant, &lighting.observer)?)
        };
        self.shine(lighting, light)
    }

    /// Shows the painting under a measured light, which `lighting` calls by some
    /// name of its own.
    ///
    /// # Errors
    /// [`PaintingError`] for a light without wavelengths to choose from.
    pub fn relight_with(
        &mut self,
        viewing: &Viewing,
        lighting: Lighting,
    ) -> Result<(), PaintingError> {
        let light = Light::new(&self.library, viewing)?;
        self.shine(lighting, Some(light))
    }

    fn shine(&mut self, lighting: Lighting, light: Option<Light>) -> Result<(), PaintingError> {
        self.acting(|painting| {
            painting.state.lighting = lighting;
            match light {
                Some(light) => {
                    painting.light = Arc::new(light);
                    painting.views.first.unbake(painting.engine.bounds());
                }
                None => painting.views.first.shown = TileSet::all(painting.engine.bounds()),
            }
            Ok(())
        })
    }

    /// Other shine of wet and of dry paint.
    ///
    /// # Errors
    /// [`PaintingError::Gloss`] for strengths outside 0..100 or exponents outside
    /// 0..1e6.
    pub fn set_gloss(&mut self, wet: Gloss, dry: Gloss) -> Result<(), PaintingError> {
        for Gloss { strength, exponent } in [wet, dry] {
            if !((0.0..=100.0).contains(&strength) && (0.0..=1e6).contains(&exponent)) {
                return Err(PaintingError::Gloss { strength, exponent });
            }
        }
        self.acting(|painting| {
            let medium = &mut painting.state.medium;
            (medium.wet, medium.dry) = (wet, dry);
            painting.views.unshown();
            Ok(())
        })
    }

    /// Keeps the picture under a second light beside the first, for a view split
    /// between the two; none gives its memory back. It is no action: undo leaves
    /// it as it is.
    ///
    /// # Errors
    /// [`PaintingError`] for a light that nobody knows; the second light stays as
    /// it was.
    pub fn set_second_light(&mut self, lighting: Option<Lighting>) -> Result<(), PaintingError> {
        let Some(lighting) = lighting else {
            self.views.second = None;
            self.engine.forget_view(View::Second);
            return Ok(());
        };
        let known = self.views.second.as_ref();
        let known = known.map(|second| (&second.lighting, &second.light));
        let known = known.into_iter().chain([(&self.state.lighting, &self.light)]);
        let light = match known.into_iter().find(|(known, _)| same_lamp(known, &lighting)) {
            Some((_, light)) => Arc::clone(light),
            None => {
                let Lighting { illuminant, observer, .. } = &lighting;
                Arc::new(Light::named(&self.library, illuminant, observer)?)
            }
        };
        self.shine_second(lighting, light);
        Ok(())
    }

    fn shine_second(&mut self, lighting: Lighting, light: Arc<Light>) {
        let bounds = self.engine.bounds();
        let unseen = match self.views.second.take() {
            Some(SecondLight { light: before, mut unseen, .. }) if Arc::ptr_eq(&before, &light) => {
                unseen.shown = TileSet::all(bounds);
                unseen
            }
            _ => Unseen::all(bounds),
        };
        self.views.second = Some(SecondLight { lighting, light, unseen });
    }

    /// The second light, if there is one.
    #[must_use]
    pub fn second_light(&self) -> Option<&Lighting> {
        self.views.second.as_ref().map(|second| &second.lighting)
    }
}

fn same_lamp(a: &Lighting, b: &Lighting) -> bool {
    (&a.illuminant, &a.observer) == (&b.illuminant, &b.observer)
}
