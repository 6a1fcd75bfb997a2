//! The painting as it is seen.

use calibrate::evaluate::Viewing;

use super::failure::PaintingError;
use super::state::Painting;
use crate::field::Field;
use crate::light::Light;
use crate::optics::Scene;
use crate::paint::document::Lighting;
use crate::paint::scene::Appearance;
use crate::tile::TileSet;

impl Painting {
    /// Shows the painting under another light, one that has a name.
    ///
    /// # Errors
    /// [`PaintingError`] for a light that nobody knows.
    pub fn relight(&mut self, lighting: Lighting) -> Result<(), PaintingError> {
        let light = if self.same_lamp(&lighting) {
            None
        } else {
            Some(Light::named(&self.library, &lighting.illuminant, &lighting.observer)?)
        };
        self.shine(lighting, light);
        Ok(())
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
        self.shine(lighting, Some(light));
        Ok(())
    }

    fn same_lamp(&self, lighting: &Lighting) -> bool {
        let now = &self.state.lighting;
        (&now.illuminant, &now.observer) == (&lighting.illuminant, &lighting.observer)
    }

    fn shine(&mut self, lighting: Lighting, light: Option<Light>) {
        self.history.begin(self.state.clone());
        self.state.lighting = lighting;
        self.history.commit();
        if let Some(light) = light {
            self.light = light;
            self.all_unseen();
        } else {
            // The same lamp from elsewhere: what is baked does not know it.
            self.unshown = TileSet::all(self.engine.bounds());
        }
    }

    /// The picture in linear sRGB, white at 1. Only what changed since the last
    /// call is computed.
    ///
    /// # Errors
    /// [`PaintingError`] if the device was lost.
    pub fn picture(&mut self) -> Result<Field<[f32; 4]>, PaintingError> {
        let scene = self.scene();
        self.shown(&scene)
    }

    /// The same without relief and gloss: the colours alone.
    ///
    /// # Errors
    /// [`PaintingError`] if the device was lost.
    pub fn flat_picture(&mut self) -> Result<Field<[f32; 4]>, PaintingError> {
        let mut scene = self.scene();
        let lamp = &mut scene.lamp;
        lamp.relief = 0.0;
        for gloss in [&mut lamp.wet, &mut lamp.dry, &mut lamp.ground] {
            gloss.strength = 0.0;
        }
        self.unshown = TileSet::all(self.engine.bounds());
        let picture = self.shown(&scene);
        self.unshown = TileSet::all(self.engine.bounds());
        picture
    }

    fn scene(&self) -> Scene {
        let dry: Vec<_> = self.state.dry.iter().map(|dry| (dry.slots, dry.opacity)).collect();
        let appearance = Appearance {
            library: &self.library,
            medium: &self.medium,
            ground: &self.ground,
            cell_mm: self.cell_mm,
            dry: &dry,
            slots: &self.state.slots,
            lighting: &self.state.lighting,
        };
        appearance.scene(&self.light)
    }

    fn shown(&mut self, scene: &Scene) -> Result<Field<[f32; 4]>, PaintingError> {
        let (baked, mut shown) = (self.unbaked.take(), self.unshown.take());
        // The relief of a cell reaches to its neighbours.
        let bounds = self.engine.bounds();
        for tile in shown.clone().iter() {
            shown.insert(tile.rect(bounds).grown(1, bounds));
        }
        self.engine.light(scene, &baked, &shown)?;
        Ok(self.engine.picture()?)
    }
}
