//! Form of a picture beside its colours: depth, flow, guides.

use std::path::Path;

use glam::Vec2;
use graphics::field::Field;
use graphics::picture::{Photograph, PhotographError};

use super::guides::{GuideSample, Guides, GuidesError};

/// Values of red and green this near the middle are no direction: the middle of 8 bits is none.
const STILL: f32 = 0.01;

/// Form of a picture; the default has none.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PictureForm {
    /// Depth from 0 (far) to 1 (near), stretched over the picture.
    pub depth: Option<Field<f32>>,
    /// Directions and flow of strokes.
    pub flow: Option<FlowPicture>,
    /// Places, 0 to 1 over the width and height of the picture, and directions of strokes there, of
    /// any length, in px (x to the right, y downwards).
    pub guides: Vec<[[f32; 2]; 2]>,
}

/// Arrows over a picture.
#[derive(Debug, Clone, PartialEq)]
pub struct FlowPicture {
    /// Arrows, x to the right and y downwards, whose length is the strength, 0 to 1.
    arrows: Field<[f32; 2]>,
}

impl PictureForm {
    /// Reads guides drawn over the picture.
    ///
    /// # Errors
    /// [`GuidesError`] with the path and the guide.
    pub fn guides_of(path: &Path) -> Result<Vec<[[f32; 2]; 2]>, GuidesError> {
        let guides = Guides::open(path)?;
        let [width, height] = guides.size_px;
        let samples = guides.on_picture(width as usize, height as usize)?;
        Ok(samples
            .into_iter()
            .map(|sample: GuideSample| {
                let share = [sample.x / f64::from(width), sample.y / f64::from(height)];
                [share, sample.along].map(|pair| pair.map(|value| value as f32))
            })
            .collect())
    }

    /// Depth of a picture whose white is near and whose black is far.
    ///
    /// # Errors
    /// [`PhotographError`] with the path.
    pub fn depth_of(path: &Path) -> Result<Field<f32>, PhotographError> {
        let picture = Photograph::open(path)?;
        let (width, height) = picture.size();
        let encoded = picture.with_opacity(width, height);
        let grey = encoded.values().iter().map(|[r, g, b, _]| (r + g + b) / 3.0);
        Ok(Field::from_values(width, height, grey.collect()))
    }
}

impl FlowPicture {
    /// Reads a picture of arrows: red to the right and green upwards, both about one half; blue is
    /// the strength. Neutral pixels (one half each), and those of no strength, have no arrow.
    ///
    /// # Errors
    /// [`PhotographError`] with the path.
    pub fn open(path: &Path) -> Result<Self, PhotographError> {
        let picture = Photograph::open(path)?;
        let (width, height) = picture.size();
        let encoded = picture.with_opacity(width, height);
        let arrows = encoded
            .values()
            .iter()
            .map(|&[red, green, blue, opacity]: &[f32; 4]| {
                let way = Vec2::new(red - 0.5, 0.5 - green);
                let way = if way.abs().max_element() < STILL { Vec2::ZERO } else { way };
                (way.normalize_or_zero() * blue * opacity).to_array()
            })
            .collect();
        Ok(Self { arrows: Field::from_values(width, height, arrows) })
    }

    /// Arrows from values.
    #[must_use]
    pub fn of(arrows: Field<[f32; 2]>) -> Self {
        Self { arrows }
    }

    /// The arrow at a place, 0 to 1 over width and height.
    pub(super) fn at(&self, share: Vec2) -> Vec2 {
        let cell = |share: f32, count: usize| ((share * count as f32) as usize).min(count - 1);
        let width = self.arrows.width();
        let height = self.arrows.height();
        self.arrows[(cell(share.x, width), cell(share.y, height))].into()
    }
}
