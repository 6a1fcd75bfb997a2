//! Pictures, reflectances and lights of a painting.

use std::sync::Arc;

use graphics::field::Field;
use graphics::tile::{Rect, TileSet};

use super::failure::PaintingError;
use super::state::{Painting, PendingTiles, SecondLight};
use crate::document::{Lighting, Slots};
use crate::engine::View;
use crate::light::Light;
use crate::optics::Scene;
use crate::scene::{Appearance, PixelsPerCell, SpectralStack, fine_picture};

impl Painting {
    /// Renders the parts of the picture that are out of date, and returns the tiles rendered since
    /// the last call. If `second` is true, this is the picture under the second light.
    ///
    /// # Errors
    /// [`PaintingError`] if the device was lost, or its memory does not suffice for a second
    /// picture.
    ///
    /// # Panics
    /// With `second`, if there is no second light.
    pub fn refresh(&mut self, second: bool) -> Result<TileSet, PaintingError> {
        let view = view(second);
        self.compute(view, &self.scene(view))?;
        Ok(self.pending_of(view).unreported.take())
    }

    /// The picture in `rect` as last rendered, in linear sRGB. With `second`, the picture
    /// under the second light. Only these cells are read from the device.
    ///
    /// # Errors
    /// [`PaintingError`] if the device was lost.
    ///
    /// # Panics
    /// If `rect` is not within the canvas or, with `second`, if there is no second light.
    pub fn picture_in(
        &mut self,
        second: bool,
        rect: Rect,
    ) -> Result<Field<[f32; 4]>, PaintingError> {
        assert!(!second || self.views.second.is_some(), "{SECOND}");
        Ok(self.engine.picture_in(view(second), rect)?)
    }

    /// The picture in linear sRGB, white at 1. Only the parts that are out of date are
    /// rendered.
    ///
    /// # Errors
    /// [`PaintingError`] if the device was lost.
    pub fn picture(&mut self) -> Result<Field<[f32; 4]>, PaintingError> {
        self.compute(View::First, &self.scene(View::First))?;
        Ok(self.engine.picture()?)
    }

    /// The picture in linear sRGB with several pixels a cell, see [`fine_picture`]. With one
    /// pixel a cell it is [`Painting::picture`].
    ///
    /// # Errors
    /// [`PaintingError`] if the device was lost.
    pub fn fine_picture(
        &mut self,
        pixels: PixelsPerCell,
    ) -> Result<Field<[f32; 4]>, PaintingError> {
        if pixels == PixelsPerCell::default() {
            return self.picture();
        }
        let scene = self.scene(View::First);
        Ok(fine_picture(&self.document()?, &scene, pixels))
    }

    /// The picture in linear sRGB without shading of the relief and without gloss.
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
        self.views.first.wet = all.clone();
        let computed = self.compute(View::First, &scene);
        self.views.first.wet = all;
        computed?;
        Ok(self.engine.picture()?)
    }

    /// Mean reflectance of the cells of `rect` on the grid of the library, as an instrument
    /// would measure it: in f64, without relief and gloss.
    ///
    /// # Errors
    /// [`PaintingError`] if the device was lost.
    ///
    /// # Panics
    /// If `rect` is empty or not within the canvas.
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
        self.state.dry.iter().map(|dry| (dry.slots, dry.shown_opacity())).collect()
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

    fn pending_of(&mut self, view: View) -> &mut PendingTiles {
        match view {
            View::First => &mut self.views.first,
            View::Second => &mut self.views.second.as_mut().expect(SECOND).pending,
        }
    }

    fn compute(&mut self, view: View, scene: &Scene) -> Result<(), PaintingError> {
        let pending = self.pending_of(view);
        let dry = pending.dry.clone();
        let wet = pending.wet.clone();
        self.engine.render(view, scene, &dry, &wet)?;
        let pending = self.pending_of(view);
        (pending.dry, pending.wet) = Default::default();
        for tile in dry.iter().chain(wet.iter()) {
            pending.unreported.insert_tile(tile);
        }
        Ok(())
    }
}

const SECOND: &str = "the painting has a second light";

fn view(second: bool) -> View {
    if second { View::Second } else { View::First }
}

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

    /// Also keeps a picture under a second light, for a view that is split between the two. `None`
    /// frees its memory. This is not an action of the history.
    ///
    /// # Errors
    /// [`PaintingError::Light`] if the light is unknown. The second light stays unchanged.
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
    pub(crate) fn relight_as(&mut self, other: &Self) -> Result<(), PaintingError> {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::brush::HeadShape;
    use crate::document::{Document, Medium};
    use crate::engine::PaintEngine;
    use crate::ground::GroundSpec;
    use crate::layer::SLOTS;
    use crate::pose::Sample;
    use pigment::PigmentId;
    use pigment::library::PigmentLibrary;

    fn opened(document: Document) -> Painting {
        let engine = PaintEngine::on_cpu(document.ground.height.clone());
        Painting::open(document, engine, 1 << 24).unwrap()
    }

    fn bare() -> Painting {
        let library = PigmentLibrary::van_gogh_oils();
        let ground = GroundSpec::default().build(300, 200, 0.1, &library).unwrap();
        let medium = Medium::default();
        let lighting = Lighting::default();
        let slots = std::array::from_fn(|slot| Some(PigmentId(slot)));
        opened(Document::bare("", 0.1, ground, library, medium, slots, lighting))
    }

    /// Asserts that the picture equals the picture of the same painting opened anew.
    fn assert_picture(painting: &mut Painting, after: &str) {
        let shown = painting.picture().unwrap();
        let whole = opened(painting.document().unwrap()).picture().unwrap();
        assert!(shown == whole, "after {after}");
    }

    #[test]
    fn an_updated_picture_equals_a_new_one() {
        let mut painting = bare();
        assert_picture(&mut painting, "nothing");
        let brush = painting.add_brush(HeadShape::Flat, 3.0).unwrap();
        for end_mm in [14.0, 25.0] {
            painting.load(brush, &[1.0; SLOTS], 0.1, 0.3).unwrap();
            painting.stroke(brush, &[sample(0.0, 3.0), sample(1.0, end_mm)]).unwrap();
            assert_picture(&mut painting, "a stroke");
            assert!(painting.dry(0.5).unwrap(), "there is paint to dry");
            assert_picture(&mut painting, "drying");
        }
        let turned = Lighting { azimuth_deg: 90.0, ..Lighting::default() };
        painting.relight(turned).unwrap();
        assert_picture(&mut painting, "turning the lamp");
        for undone in ["the lamp", "the drying", "the stroke", "the first drying"] {
            assert!(painting.undo().unwrap(), "{undone}");
            assert_picture(&mut painting, &format!("undoing {undone}"));
        }
    }

    fn sample(seconds: f64, x_mm: f64) -> Sample {
        Sample {
            seconds,
            x_mm,
            y_mm: 6.0,
            pressure: 0.7,
            tilt_x_deg: 10.0,
            tilt_y_deg: 0.0,
            twist_deg: 90.0,
        }
    }
}
