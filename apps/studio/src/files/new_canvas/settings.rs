//! The canvas of a new painting, as a painter describes it.

use std::path::PathBuf;

use paint::ground::{GroundKind, GroundRelief};
use paint::strokes::Canvas;
use serde::{Deserialize, Serialize};

use super::format::Format;
use super::unit::LengthUnit;

/// Maximum number of cells of a canvas: 64 million.
pub(crate) const MAX_CELLS: usize = 64 << 20;

/// Shortest and longest side of a canvas, in mm.
pub(crate) const SIDE_MM: [f64; 2] = [5.0, 2000.0];

/// Smallest and largest cell, in mm.
const CELL_MM: [f64; 2] = [0.02, 2.0];

/// Memory that a cell of a canvas takes while it is painted on, in bytes.
const CELL_BYTES: u64 = 90;

/// Memory that a cell of a dry layer takes, in bytes.
const LAYER_BYTES: u64 = 36;

/// The canvas of a new painting.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct NewCanvas {
    /// Size, cells and ground.
    pub canvas: Canvas,
    /// Unit in which the size is shown.
    pub unit: LengthUnit,
    /// Whether the painting uses the library and palette of the current one.
    pub same_pigments: bool,
    /// A picture whose colours become the first dry layer, in paint of the palette.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub first_layer: Option<PathBuf>,
}

impl Default for NewCanvas {
    fn default() -> Self {
        Self {
            canvas: Canvas::default(),
            unit: LengthUnit::Mm,
            same_pigments: true,
            first_layer: None,
        }
    }
}

impl NewCanvas {
    /// Moves numbers that are out of range to the nearest that are allowed.
    pub(crate) fn bound(&mut self) {
        let within = |value: f64, [least, most]: [f64; 2], usual: f64| {
            if value.is_finite() { value.clamp(least, most) } else { usual }
        };
        let canvas = &mut self.canvas;
        canvas.width_mm = within(canvas.width_mm, SIDE_MM, 192.0);
        canvas.height_mm = within(canvas.height_mm, SIDE_MM, 108.0);
        canvas.cell_mm = within(canvas.cell_mm, CELL_MM, 0.1);
    }

    /// Gives the canvas the size of a format, upright or across as it is now.
    pub(crate) fn set_format(&mut self, format: &Format) {
        let upright = self.is_upright();
        let Canvas { width_mm, height_mm, .. } = &mut self.canvas;
        (*width_mm, *height_mm) = (format.long_mm, format.short_mm);
        self.set_upright(upright);
    }

    /// Whether the canvas is higher than it is wide.
    #[must_use]
    pub(crate) fn is_upright(&self) -> bool {
        self.canvas.height_mm > self.canvas.width_mm
    }

    /// Turns the canvas upright or across.
    pub(crate) fn set_upright(&mut self, upright: bool) {
        let Canvas { width_mm, height_mm, .. } = &mut self.canvas;
        if upright != (*height_mm > *width_mm) {
            std::mem::swap(width_mm, height_mm);
        }
    }

    /// Number of cells of the canvas.
    #[must_use]
    pub(crate) fn cell_count(&self) -> usize {
        let (width, height) = self.canvas.cells();
        width.saturating_mul(height)
    }

    /// Whether the canvas has at most [`MAX_CELLS`] cells.
    #[must_use]
    pub(crate) fn fits(&self) -> bool {
        self.cell_count() <= MAX_CELLS
    }

    /// Memory of the canvas while it is painted on, and of each dry layer, in bytes.
    #[must_use]
    pub(crate) fn memory(&self) -> [u64; 2] {
        [CELL_BYTES, LAYER_BYTES].map(|bytes| bytes.saturating_mul(self.cell_count() as u64))
    }

    /// Kind of the ground; `None` for the relief of a picture.
    #[must_use]
    pub(crate) fn kind(&self) -> Option<GroundKind> {
        match self.canvas.ground.relief {
            GroundRelief::Linen(_) => Some(GroundKind::Linen),
            GroundRelief::Paper(_) => Some(GroundKind::Paper),
            GroundRelief::Panel(_) => Some(GroundKind::Panel),
            GroundRelief::Wood(_) => Some(GroundKind::Wood),
            GroundRelief::Image(_) => None,
        }
    }

    /// Seed of the ground's relief; `None` for the relief of a picture.
    pub(crate) fn seed(&mut self) -> Option<&mut u64> {
        match &mut self.canvas.ground.relief {
            GroundRelief::Linen(linen) => Some(&mut linen.seed),
            GroundRelief::Paper(paper) => Some(&mut paper.seed),
            GroundRelief::Panel(panel) => Some(&mut panel.seed),
            GroundRelief::Wood(wood) => Some(&mut wood.seed),
            GroundRelief::Image(_) => None,
        }
    }

    /// Changes the kind of the ground. Its seed and its colour stay.
    pub(crate) fn set_kind(&mut self, kind: GroundKind) {
        let seed = self.seed().map_or(1, |seed| *seed);
        self.canvas.ground.relief = kind.spec(seed).relief;
    }

    /// Height of the ground's relief in mm: of a picture that of white.
    pub(crate) fn relief_mm(&mut self) -> &mut f64 {
        match &mut self.canvas.ground.relief {
            GroundRelief::Linen(linen) => &mut linen.relief_mm,
            GroundRelief::Paper(paper) => &mut paper.relief_mm,
            GroundRelief::Panel(panel) => &mut panel.relief_mm,
            GroundRelief::Wood(wood) => &mut wood.relief_mm,
            GroundRelief::Image(picture) => &mut picture.depth_mm,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::format::FORMATS;
    use super::*;

    fn format(name: &str) -> &'static Format {
        FORMATS.iter().find(|format| format.name == name).unwrap()
    }

    #[test]
    fn a_format_keeps_the_canvas_upright_or_across() {
        let mut new = NewCanvas::default();
        new.set_format(format("A4"));
        assert_eq!((new.canvas.width_mm, new.canvas.height_mm), (297.0, 210.0));
        new.set_upright(true);
        assert_eq!((new.canvas.width_mm, new.canvas.height_mm), (210.0, 297.0));
        new.set_format(format("30 x 40 cm"));
        assert_eq!((new.canvas.width_mm, new.canvas.height_mm), (300.0, 400.0));
    }

    #[test]
    fn memory_is_counted_by_cells_and_layers() {
        let new = NewCanvas::default();
        assert_eq!(new.cell_count(), 1920 * 1080);
        assert_eq!(new.memory(), [1920 * 1080 * 90, 1920 * 1080 * 36]);
        let mut large = new.clone();
        large.set_format(format("60 F"));
        assert!(new.fits() && !large.fits(), "{} cells", large.cell_count());
    }

    #[test]
    fn another_kind_of_ground_keeps_seed_and_color() {
        let mut new = NewCanvas::default();
        *new.seed().unwrap() = 7;
        new.canvas.ground.reflectance = Some(paint::ground::Primer::Grey(0.5));
        new.set_kind(GroundKind::Paper);
        assert_eq!((new.kind(), new.seed().copied()), (Some(GroundKind::Paper), Some(7)));
        assert!(new.canvas.ground.reflectance.is_some(), "the colour is gone");
        let paper = paint::ground::Paper::default();
        assert_eq!(*new.relief_mm(), paper.relief_mm, "the relief is that of the kind");
    }

    #[test]
    fn numbers_out_of_range_are_moved_into_it() {
        let mut new = NewCanvas::default();
        new.canvas.width_mm = f64::NAN;
        new.canvas.height_mm = 1e9;
        new.canvas.cell_mm = 0.0;
        new.bound();
        let Canvas { width_mm, height_mm, cell_mm, .. } = new.canvas;
        assert_eq!((width_mm, height_mm, cell_mm), (192.0, 2000.0, 0.02));
    }
}
