//! Single parts of a picture. The processor makes them.

use glam::Vec3;
use graphics::camera::Camera;
use graphics::compute::Image;
use graphics::field::Field;
use graphics::surface::{Fragment, NO_TRIANGLE, SurfacePoint, VisibilityBuffer};

use super::drawer::{Drawer, averaged};
use super::error::PaintingError;
use super::in_sight;
use crate::drawing::{TintTable, shade_apart};
use crate::pigments::SeenPlaces;

impl Drawer {
    /// Name of a region. If it has none, this is its number from 1.
    pub(super) fn region_name(&self, index: usize) -> String {
        match self.regions[index].name.as_str() {
            "" => (index + 1).to_string(),
            name => name.to_owned(),
        }
    }

    pub(super) fn tints(&self, index: usize) -> TintTable {
        self.regions[index].shells.table().clone()
    }

    pub(super) fn paper(&self) -> [f32; 3] {
        in_sight::paper(&self.settings)
    }

    pub(super) fn samples_a_pixel(&self) -> usize {
        self.look.samples
    }

    pub(super) fn uploaded<T: bytemuck::Pod>(
        &mut self,
        field: &Field<T>,
    ) -> Result<Image<T>, PaintingError> {
        Ok(self.scene.compute.upload(field)?)
    }

    pub(super) fn downloaded<T: bytemuck::Pod>(
        &mut self,
        image: &Image<T>,
    ) -> Result<Field<T>, PaintingError> {
        Ok(self.scene.compute.download(image)?)
    }

    /// Applies `value` to the counts of a pixel's samples, and averages the results.
    pub(super) fn of_counts(
        &mut self,
        counts: &Image<i32>,
        value: impl Fn(i32) -> f32,
    ) -> Result<Field<f32>, PaintingError> {
        let counts = self.downloaded(counts)?;
        let values = counts.values().iter().map(|&count| value(count)).collect();
        let field = Field::from_values(counts.width(), counts.height(), values);
        Ok(averaged(field, self.look.samples))
    }

    /// The view of `camera` at `width` x `height` samples, on the processor.
    pub(super) fn seen(
        &mut self,
        camera: &Camera,
        (width, height): (usize, usize),
    ) -> Result<Image<Fragment>, PaintingError> {
        self.load_on_host()?;
        let host = self.host.as_mut().unwrap_or(&mut self.scene);
        Ok(host.model.visible(&mut host.compute, camera, width, height)?)
    }

    pub(super) fn ink(
        &mut self,
        camera: &Camera,
        size: (usize, usize),
    ) -> Result<Field<f32>, PaintingError> {
        let visible = self.seen(camera, self.samples(size)?)?;
        let hatching = &self.host.as_ref().unwrap_or(&self.scene).hatching;
        Ok(shade_apart(&self.packed, visible.host(), camera, &self.look, hatching)?.1)
    }

    pub(super) fn strokes(
        &mut self,
        camera: &Camera,
        size: (usize, usize),
    ) -> Result<Field<[f32; 4]>, PaintingError> {
        let ink = averaged(self.ink(camera, size)?, self.look.samples);
        let darker = 1.0 - self.look.hatching.pencil;
        let values = ink
            .values()
            .iter()
            .map(|&ink: &f32| {
                let grey = 1.0 - ink * darker;
                [grey, grey, grey, 1.0]
            })
            .collect();
        Ok(Field::from_values(ink.width(), ink.height(), values))
    }

    /// Place and normal that each sample shows. They are zeros where nothing is seen.
    pub(super) fn surfaces_seen(
        &mut self,
        camera: &Camera,
        size: (usize, usize),
    ) -> Result<[Field<[f32; 3]>; 2], PaintingError> {
        let visible = self.seen(camera, self.samples(size)?)?;
        let visible = visible.host();
        let of = |value: &dyn Fn(SurfacePoint<'_>) -> Vec3| {
            let values = visible.values().iter().map(|seen| match seen.triangle {
                NO_TRIANGLE => [0.0; 3],
                _ => value(SurfacePoint::new(&self.packed, *seen)).to_array(),
            });
            Field::from_values(visible.width(), visible.height(), values.collect())
        };
        Ok([of(&|point| point.position()), of(&|point| point.normal(camera.eye))])
    }

    /// The fragment and the place that each pixel shows. The place is NaN where nothing is seen.
    pub(super) fn places(
        &mut self,
        camera: &Camera,
        size: (usize, usize),
    ) -> Result<(VisibilityBuffer, Field<Vec3>), PaintingError> {
        self.samples(size)?;
        let visible = self.seen(camera, size)?.host().clone();
        let places = SeenPlaces::of(&self.packed, &self.facets, &visible).places;
        Ok((visible, places))
    }
}
