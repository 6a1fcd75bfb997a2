//! The painting as it is seen.

use std::sync::Arc;

use calibrate::evaluate::Viewing;

use super::failure::PaintingError;
use super::state::Painting;
use crate::field::Field;
use crate::light::Light;
use crate::optics::Scene;
use crate::paint::document::Lighting;
use crate::paint::scene::Appearance;

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

    fn same_lamp(&self, lighting: &Lighting) -> bool {
        let now = &self.state.lighting;
        (&now.illuminant, &now.observer) == (&lighting.illuminant, &lighting.observer)
    }

    fn shine(&mut self, lighting: Lighting, light: Option<Light>) -> Result<(), PaintingError> {
        self.acting(|painting| {
            painting.state.lighting = lighting;
            match light {
                Some(light) => {
                    painting.light = Arc::new(light);
                    painting.all_unseen();
                }
                None => painting.all_unshown(),
            }
            Ok(())
        })?;
        Ok(())
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
        self.all_unshown();
        let picture = self.shown(&scene);
        self.all_unshown();
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

#[cfg(test)]
mod tests {
    use calibrate::library::PigmentLibrary;

    use super::*;
    use crate::layer::SLOTS;
    use crate::paint::brush::HeadShape;
    use crate::paint::document::{Document, Medium};
    use crate::paint::ground::GroundSpec;
    use crate::paint::on_cpu::OnCpu;
    use crate::paint::pose::Sample;

    fn opened(document: Document) -> Painting {
        let engine = OnCpu::new(document.ground.height.clone());
        Painting::open(document, Box::new(engine), 1 << 24).unwrap()
    }

    fn bare() -> Painting {
        let text = include_str!("../../../../measurements/van-gogh-oils.pigments.json");
        let library = PigmentLibrary::from_json("van-gogh-oils.pigments.json", text).unwrap();
        let ground = GroundSpec::default().ground(300, 200, 0.1, &library).unwrap();
        let (medium, lighting) = (Medium::default(), Lighting::default());
        let slots = std::array::from_fn(Some);
        opened(Document::bare("", 0.1, ground, library, medium, slots, lighting))
    }

    /// What is computed piece by piece is what a painting taken up anew shows.
    fn assert_shown(painting: &mut Painting, after: &str) {
        let shown = painting.picture().unwrap();
        let whole = opened(painting.document().unwrap()).picture().unwrap();
        assert!(shown == whole, "after {after}");
    }

    #[test]
    fn what_changed_is_all_that_had_to_be_computed() {
        let mut painting = bare();
        assert_shown(&mut painting, "nothing");
        let brush = painting.add_brush(HeadShape::Flat, 3.0).unwrap();
        let sample = |seconds: f64, x_mm: f64| Sample {
            seconds,
            x_mm,
            y_mm: 6.0,
            pressure: 0.7,
            tilt_x_deg: 10.0,
            tilt_y_deg: 0.0,
            twist_deg: 90.0,
        };
        for end_mm in [14.0, 25.0] {
            painting.load(brush, &[1.0; SLOTS], 0.1, 0.3).unwrap();
            painting.stroke(brush, &[sample(0.0, 3.0), sample(1.0, end_mm)]).unwrap();
            assert_shown(&mut painting, "a stroke");
            assert!(painting.dry(0.5).unwrap(), "there is paint to dry");
            assert_shown(&mut painting, "drying");
        }
        let turned = Lighting { azimuth_deg: 90.0, ..Lighting::default() };
        painting.relight(turned).unwrap();
        assert_shown(&mut painting, "turning the lamp");
        for undone in ["the lamp", "the drying", "the stroke", "the first drying"] {
            assert!(painting.undo().unwrap(), "{undone}");
            assert_shown(&mut painting, &format!("undoing {undone}"));
        }
    }
}
