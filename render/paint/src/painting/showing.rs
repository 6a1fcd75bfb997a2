//! The painting as it is seen.

use super::failure::PaintingError;
use super::state::Painting;
use super::views::Unseen;
use crate::document::{Lighting, Slots};
use crate::engine::View;
use crate::optics::Scene;
use crate::scene::{Appearance, SpectralStack};
use graphics::field::Field;
use graphics::tile::{Rect, TileSet};

impl Painting {
    /// Computes what of the picture changed, or of that under the `second` light;
    /// gives the tiles that may look other than when it was last asked.
    ///
    /// # Errors
    /// [`PaintingError`] if the device was lost, or has no room for a second view.
    ///
    /// # Panics
    /// If there is no second light, as the next.
    pub fn refresh(&mut self, second: bool) -> Result<TileSet, PaintingError> {
        let view = view(second);
        self.compute(view, &self.scene(view))?;
        Ok(self.unseen_of(view).untold.take())
    }

    /// The picture in `rect` as last computed, or that under the `second` light;
    /// costs no more than `rect` holds.
    ///
    /// # Errors
    /// [`PaintingError`] if the device was lost.
    ///
    /// # Panics
    /// If `rect` has cells that the canvas has not.
    pub fn picture_in(
        &mut self,
        second: bool,
        rect: Rect,
    ) -> Result<Field<[f32; 4]>, PaintingError> {
        assert!(!second || self.views.second.is_some(), "{SECOND}");
        Ok(self.engine.picture_in(view(second), rect)?)
    }

    /// The picture in linear sRGB, white at 1. Only what changed since the last
    /// call is computed.
    ///
    /// # Errors
    /// [`PaintingError`] if the device was lost.
    pub fn picture(&mut self) -> Result<Field<[f32; 4]>, PaintingError> {
        self.compute(View::First, &self.scene(View::First))?;
        Ok(self.engine.picture()?)
    }

    /// The same without relief and gloss: the colours alone.
    ///
    /// # Errors
    /// [`PaintingError`] if the device was lost.
    pub fn flat_picture(&mut self) -> Result<Field<[f32; 4]>, PaintingError> {
        let mut scene = self.scene(View::First);
        let lamp = &mut scene.lamp;
        lamp.relief = 0.0;
        for gloss in [&mut lamp.wet, &mut lamp.dry, &mut lamp.ground] {
            gloss.strength = 0.0;
        }
        let all = TileSet::all(self.engine.bounds());
        self.views.first.shown = all.clone();
        let computed = self.compute(View::First, &scene);
        self.views.first.shown = all;
        computed?;
        Ok(self.engine.picture()?)
    }

    /// The reflectance on the library's grid, the mean over the cells of `rect`,
    /// as an instrument would read it: in f64, without relief and gloss.
    ///
    /// # Errors
    /// [`PaintingError`] if the device was lost.
    ///
    /// # Panics
    /// If `rect` is empty, or has cells that the canvas has not.
    pub fn reflectance_in(&mut self, rect: Rect) -> Result<Vec<f64>, PaintingError> {
        assert!(!rect.is_empty(), "a reflectance of no cells");
        let dry = (0..self.state.dry.len()).map(|index| self.engine.dry_layer_in(index, rect));
        let mut layers = dry.collect::<Result<Vec<_>, _>>()?;
        layers.push(self.engine.wet_in(rect)?);
        let dry = self.dry_states();
        let stack = SpectralStack::full(&self.appearance(&dry, &self.state.lighting));
        let cells = rect.width * rect.height;
        let mut mean = vec![0.0; stack.count()];
        for index in 0..cells {
            let pigments = layers.iter().map(|layer| layer.pigments.values()[index]);
            for (mean, one) in mean.iter_mut().zip(stack.measured_reflectance(pigments)) {
                *mean += one / cells as f64;
            }
        }
        Ok(mean)
    }

    fn dry_states(&self) -> Vec<(Slots, f64)> {
        self.state.dry.iter().map(|dry| (dry.slots, dry.opacity)).collect()
    }

    fn appearance<'a>(&'a self, dry: &'a [(Slots, f64)], lighting: &'a Lighting) -> Appearance<'a> {
        Appearance {
            library: &self.library,
            medium: &self.state.medium,
            ground: &self.ground,
            cell_mm: self.cell_mm,
            dry,
            slots: &self.state.slots,
            lighting,
        }
    }

    fn scene(&self, view: View) -> Scene {
        let (lighting, light) = match (view, &self.views.second) {
            (View::First, _) => (&self.state.lighting, &self.light),
            (View::Second, second) => {
                let second = second.as_ref().expect(SECOND);
                (&second.lighting, &second.light)
            }
        };
        self.appearance(&self.dry_states(), lighting).scene(light)
    }

    fn unseen_of(&mut self, view: View) -> &mut Unseen {
        match view {
            View::First => &mut self.views.first,
            View::Second => &mut self.views.second.as_mut().expect(SECOND).unseen,
        }
    }

    fn compute(&mut self, view: View, scene: &Scene) -> Result<(), PaintingError> {
        let unseen = self.unseen_of(view);
        let (baked, shown) = (unseen.baked.clone(), unseen.shown.clone());
        self.engine.render(view, scene, &baked, &shown)?;
        let unseen = self.unseen_of(view);
        (unseen.baked, unseen.shown) = Default::default();
        for tile in baked.iter().chain(shown.iter()) {
            unseen.untold.insert_tile(tile);
        }
        Ok(())
    }
}

const SECOND: &str = "there is a second light, as the caller must know";

fn view(second: bool) -> View {
    if second { View::Second } else { View::First }
}

#[cfg(test)]
mod tests {
    use pigment::library::PigmentLibrary;

    use super::*;
    use crate::brush::HeadShape;
    use crate::document::{Document, Medium};
    use crate::engine::PaintEngine;
    use crate::ground::GroundSpec;
    use crate::layer::SLOTS;
    use crate::pose::Sample;

    fn opened(document: Document) -> Painting {
        let engine = PaintEngine::on_cpu(document.ground.height.clone());
        Painting::open(document, engine, 1 << 24).unwrap()
    }

    fn bare() -> Painting {
        let library = PigmentLibrary::van_gogh_oils();
        let ground = GroundSpec::default().build(300, 200, 0.1, &library).unwrap();
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
