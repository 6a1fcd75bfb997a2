//! The target as the brush of one level can show it.

use rayon::prelude::*;

use super::trace::distance;
use graphics::blurred;
use graphics::encoding::lab_from_linear;
use graphics::field::Field;
use graphics::orientation::OrientationField;
use graphics::picture::Picture;
use paint::separation::Separation;

/// Standard deviation of the blur at which pictures are compared, in brush widths (chosen by
/// eye).
pub(super) const BLUR_SIZES: f64 = 0.2;
/// Change of the target in CIELAB over the width of a brush from which on it is detail (chosen by
/// eye).
const DETAIL: f32 = 16.0;
/// Factor on differences where the target does not change at all (chosen by eye).
const SMOOTH: f32 = 0.5;

/// All that the strokes of a level need of the target, which stays while the canvas changes.
#[derive(Debug)]
pub(super) struct LevelTarget {
    /// Index of the brush in the plan.
    pub(super) level: usize,
    /// Width of the brush in cells.
    pub(super) size: f64,
    /// Standard deviation in cells of the blur at which pictures are compared.
    pub(super) blur_cells: f64,
    /// The target, blurred.
    pub(super) picture: Picture,
    /// The same in CIELAB.
    pub(super) lab: Field<[f32; 3]>,
    /// Directions of its structure.
    pub(super) flow: OrientationField,
    /// CIELAB of the nearest colours that the palette reaches.
    reached: Field<[f32; 3]>,
}

impl LevelTarget {
    /// Prepares `target` for the brush number `level`, which is `size` cells wide.
    pub(super) fn new(target: &Picture, separation: &Separation, size: f64, level: usize) -> Self {
        let blur_cells = BLUR_SIZES * size;
        let picture = blurred(target, blur_cells);
        let lab = lab_from_linear(&picture);
        let flow = OrientationField::from_lab(&lab, blur_cells);
        let colors = picture.values().par_iter().with_min_len(1024);
        let reached = colors.map(|&rgb| separation.film().rgb(&separation.heights_mm(rgb)));
        let reached =
            Field::from_values(picture.width(), picture.height(), reached.collect::<Vec<_>>());
        let reached = lab_from_linear(&reached);
        Self { level, size, blur_cells, picture, lab, flow, reached }
    }

    /// CIELAB difference (CIE 1976) of the canvas from the target or from the nearest colour that
    /// the palette reaches, whichever is less. From the third brush on it counts less where the
    /// target is smooth.
    ///
    /// # Panics
    /// If the pictures differ in size.
    pub(super) fn differences(&self, current: &Picture) -> Field<f32> {
        assert_eq!(self.picture.bounds(), current.bounds(), "pictures differ in size");
        let painted = lab_from_linear(&blurred(current, self.blur_cells));
        let all = self.lab.values().iter().zip(self.reached.values()).zip(painted.values());
        let differences = all.map(|((&target, &reached), &painted)| {
            distance(target, painted).min(distance(reached, painted))
        });
        let width = painted.width();
        let height = painted.height();
        let mut differences = Field::from_values(width, height, differences.collect());
        if self.level > 1 {
            leave_smooth_alone(&mut differences, &self.lab, self.size);
        }
        differences
    }
}

/// Reduces the difference where the target is smooth at the scale of a brush `size` cells wide:
/// there the strokes of broader brushes may stay as they are.
fn leave_smooth_alone(difference: &mut Field<f32>, target_lab: &Field<[f32; 3]>, size: f64) {
    let width = target_lab.width();
    let height = target_lab.height();
    let reach = (size / 2.0).ceil() as usize;
    let change = |at: usize| {
        let x = at % width;
        let y = at / width;
        let left = x.saturating_sub(reach);
        let right = (x + reach).min(width - 1);
        let above = y.saturating_sub(reach);
        let below = (y + reach).min(height - 1);
        let across = distance(target_lab[(left, y)], target_lab[(right, y)]);
        let down = distance(target_lab[(x, above)], target_lab[(x, below)]);
        [across.max(down)]
    };
    let changes = (0..width * height).into_par_iter().map(change).collect();
    let changes = blurred(&Field::from_values(width, height, changes), size / 4.0);
    for (difference, [change]) in difference.values_mut().iter_mut().zip(changes.values()) {
        *difference *= SMOOTH + (1.0 - SMOOTH) * (change / DETAIL).min(1.0);
    }
}
