//! A tile of brushwork.

use graphics::encoding::lab_from_linear;
use graphics::field::Field;
use graphics::picture::Picture;

use crate::sample::TexelPaint;

/// Brushwork of one tone on a square that tiles in both directions. Strokes run along y.
#[derive(Debug, Clone, PartialEq)]
pub struct Tile {
    /// Colour under a level surface, in linear sRGB with white at 1.
    pub color: Picture,
    /// Paint of each texel; `None` for maps without pigments.
    pub paint: Option<Field<TexelPaint>>,
    /// Height of the surface above the ground in mm; `None` without relief.
    pub height_mm: Option<Field<f32>>,
}

impl Tile {
    /// Width and height in texels.
    #[must_use]
    pub fn size(&self) -> usize {
        self.color.width()
    }

    /// Mean L*, the tone of the tile.
    #[must_use]
    pub fn tone(&self) -> f64 {
        let lab = lab_from_linear(&self.color);
        let sum: f64 = lab.values().iter().map(|lab| f64::from(lab[0])).sum();
        sum / lab.values().len().max(1) as f64
    }
}
