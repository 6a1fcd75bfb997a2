//! Pixels of a rectangular surface as the window shows them, computed on the processor.
//!
//! A page in a browser shows a stroke by them between its frames: a browser without a graphics card
//! takes 60 ms to draw a frame, and 8 ms to show a patch.

use eframe::egui::{Color32, Rect, lerp, pos2};

use super::outline::{SHADE, SHADOW};
use super::picture::{Picture, Shown};
use super::transform::Placement;
use crate::theme;

/// Colour of the line at the edge of a surface.
const EDGE: u8 = 76;

/// A rectangle of physical pixels of the window.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Patch {
    /// First column of the window.
    pub left: usize,
    /// First row of the window.
    pub top: usize,
    /// Number of columns.
    pub width: usize,
    /// Number of rows.
    pub height: usize,
    /// 8-bit sRGB and 255, row by row: `4 * width * height` bytes.
    pub rgba: Vec<u8>,
}

impl Patch {
    /// Pixels of a rectangle in points, at `density` physical pixels per point: the picture, and
    /// around it the shadow and the surround.
    pub(super) fn of(picture: &Picture, placement: &Placement, rect: Rect, density: f32) -> Self {
        if !rect.is_positive() {
            return Self::default();
        }
        let whole = |points: f32| (points * density).max(0.0);
        let [left, top] = [rect.min.x, rect.min.y].map(|at| whole(at).floor() as usize);
        let [right, bottom] = [rect.max.x, rect.max.y].map(|at| whole(at).ceil() as usize);
        let width = right - left;
        let height = bottom - top;
        let place = |x: f32, y: f32| placement.cell(pos2(x / density, y / density));
        let x = left as f32 + 0.5;
        let y = top as f32 + 0.5;
        let from = place(x, y);
        let step = |to: [f64; 2]| [(to[0] - from[0]) as f32, (to[1] - from[1]) as f32];
        let right = step(place(x + 1.0, y));
        let down = step(place(x, y + 1.0));
        let cells = Cells::new(picture, placement, density);
        let mut rgba = Vec::with_capacity(4 * width * height);
        for row in 0..height {
            let first = [0, 1].map(|axis: usize| from[axis] as f32 + row as f32 * down[axis]);
            for column in 0..width {
                let at = [0, 1].map(|axis: usize| first[axis] + column as f32 * right[axis]);
                rgba.extend(cells.color(at).to_array());
            }
        }
        Self { left, top, width, height, rgba }
    }
}

/// Cells of a picture at the level that is shown.
struct Cells<'a> {
    size: [f32; 2],
    /// Cells in a cell of the level, along each side.
    scale: f32,
    columns: usize,
    rows: usize,
    pixels: &'a [Color32],
    interpolate: bool,
    /// Points of the window in a cell.
    points: f32,
}

impl<'a> Cells<'a> {
    fn new(picture: &'a Picture, placement: &Placement, density: f32) -> Self {
        let Shown { level, interpolate } = picture.shown(placement, f64::from(density));
        let (columns, pixels) = picture.levels().cells(level);
        let (width, height) = picture.cells();
        Self {
            size: [width as f32, height as f32],
            scale: (1_usize << level) as f32,
            columns,
            rows: pixels.len() / columns.max(1),
            pixels,
            interpolate,
            points: placement.scale() as f32,
        }
    }

    /// Colour at a place in cells.
    fn color(&self, [x, y]: [f32; 2]) -> Color32 {
        let beyond = |at: f32, size: f32| (-at).max(at - size);
        let outside = self.points * beyond(x, self.size[0]).max(beyond(y, self.size[1]));
        let color = if outside < 0.0 {
            self.sample(x / self.scale, y / self.scale)
        } else {
            let share = (outside / SHADOW).min(1.0);
            let grey = lerp(f32::from(SHADE.r())..=f32::from(theme::SURROUND.r()), share);
            Color32::from_gray(grey.round() as u8)
        };
        // The line is half a point wide to both sides and fades out over as much.
        let covered = 1.0 - outside.abs();
        if covered > 0.0 { color.lerp_to_gamma(Color32::from_gray(EDGE), covered) } else { color }
    }

    /// Colour at a place in cells of the level.
    fn sample(&self, x: f32, y: f32) -> Color32 {
        let cell = |column: usize, row: usize| {
            self.pixels[row.min(self.rows - 1) * self.columns + column.min(self.columns - 1)]
        };
        if !self.interpolate {
            return cell(x as usize, y as usize);
        }
        // Weights of 8 bits, as samplers of graphics cards have them.
        let along = |at: f32| {
            let at = ((at - 0.5).max(0.0) * 256.0) as usize;
            (at >> 8, (at & 255) as u32)
        };
        let (column, right) = along(x);
        let (row, down) = along(y);
        let [a, b] = [cell(column, row), cell(column + 1, row)];
        let [c, d] = [cell(column, row + 1), cell(column + 1, row + 1)];
        let mixed = |channel: fn(&Color32) -> u8| {
            let of = |color: &Color32| u32::from(channel(color));
            let upper = of(&a) * (256 - right) + of(&b) * right;
            let lower = of(&c) * (256 - right) + of(&d) * right;
            ((upper * (256 - down) + lower * down + (1 << 15)) >> 16) as u8
        };
        Color32::from_rgb(mixed(Color32::r), mixed(Color32::g), mixed(Color32::b))
    }
}
