//! Part of a painting as a painting of its own.

use crate::document::{Document, DryLayer};
use graphics::tile::Rect;

impl Document {
    /// The painting of the cells in `rect` alone: ground, dry layers and wet paint stay as they
    /// are, to the quantum; light, binder and pigments are those of the whole.
    ///
    /// Beyond its edges a painting has no ground that could be continued, since a file keeps the
    /// relief of a ground and not how it was made. So a painting can be cropped, but not enlarged.
    ///
    /// # Panics
    /// If `rect` is empty or reaches beyond the canvas.
    #[must_use]
    pub fn cropped(&self, rect: Rect) -> Self {
        assert!(rect.width > 0 && rect.height > 0, "a crop without cells");
        let dry = self.dry.iter().map(|layer| DryLayer {
            id: layer.id,
            name: layer.name.clone(),
            visible: layer.visible,
            slots: layer.slots,
            opacity: layer.opacity,
            paint: layer.paint.part(rect),
        });
        let mut ground = self.ground.clone();
        ground.height = ground.height.part(rect);
        Self {
            title: self.title.clone(),
            cell_mm: self.cell_mm,
            ground,
            library: self.library.clone(),
            medium: self.medium.clone(),
            dry: dry.collect(),
            next_layer: self.next_layer,
            slots: self.slots,
            wet: self.wet.part(rect),
            lighting: self.lighting.clone(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ground::GroundSpec;
    use crate::layer::{Cell, Layer};
    use crate::strokes::{Canvas, PaletteSpec, StrokeScript};
    use pigment::library::PigmentLibrary;

    /// A painting of 8 x 6 cells, with the number of each cell as its paint.
    fn numbered() -> Document {
        let library = PigmentLibrary::van_gogh_oils();
        let canvas =
            Canvas { width_mm: 4.0, height_mm: 3.0, cell_mm: 0.5, ground: GroundSpec::default() };
        let palette = PaletteSpec::from_names(["Zinc White", "Vermilion"]);
        let script = StrokeScript::new("numbered", "", canvas, palette);
        let (mut document, _) = script.surfaces(&library, None).unwrap();
        let mut paint = Layer::empty(8, 6);
        for index in 0..48 {
            let mut cell = Cell { vehicle: 7, ..Cell::default() };
            cell.pigments[1] = 100 + index as u32;
            paint.set_cell(index, cell);
        }
        let slots = document.slots;
        document.push_dry(slots, paint.clone());
        document.dry[0].opacity = 0.5;
        document.wet = paint;
        document
    }

    #[test]
    fn a_crop_keeps_the_paint_and_the_ground_of_its_cells() {
        let whole = numbered();
        let part = whole.cropped(Rect { x: 2, y: 1, width: 3, height: 4 });
        assert_eq!((part.wet.width(), part.wet.height()), (3, 4));
        for (x, y) in [(0, 0), (2, 3), (1, 2)] {
            let own = y * 3 + x;
            let there = (y + 1) * 8 + x + 2;
            assert_eq!(part.wet.cell(own), whole.wet.cell(there), "wet paint at {x}, {y}");
            assert_eq!(part.dry[0].paint.cell(own), whole.dry[0].paint.cell(there));
            assert_eq!(part.ground.height[(x, y)], whole.ground.height[(x + 2, y + 1)]);
        }
        assert_eq!(part.dry[0].opacity, 0.5);
        assert_eq!(part.lighting, whole.lighting);
        let all = Rect { x: 0, y: 0, width: 8, height: 6 };
        assert_eq!(whole.cropped(all), whole, "the whole is itself");
    }

    #[test]
    fn a_cropped_painting_survives_its_file() {
        let part = numbered().cropped(Rect { x: 5, y: 2, width: 2, height: 3 });
        let file = crate::file::write(&part).unwrap();
        assert_eq!(crate::file::read("part", &file).unwrap(), part);
    }
}
