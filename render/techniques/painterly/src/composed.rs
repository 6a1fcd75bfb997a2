//! Pictures of layers, one over the other.

use graphics::field::Field;
use rayon::prelude::*;

use super::passes::PaintedPicture;

/// Paints one layer over another of the same size. Heights add up, as a dry layer lies on the one
/// below.
pub(super) fn over(mut lower: PaintedPicture, upper: &PaintedPicture) -> PaintedPicture {
    let colors = lower.color.values_mut().par_iter_mut().zip(upper.color.values());
    colors.for_each(|(lower, upper)| {
        let share = upper[3];
        let rest = lower[3] * (1.0 - upper[3]);
        let cover = share + rest;
        if share > 0.0 {
            for channel in 0..3 {
                lower[channel] = (upper[channel] * share + lower[channel] * rest) / cover;
            }
            lower[3] = cover;
        }
    });
    add(&mut lower.height_mm, &upper.height_mm);
    lower
}

fn add(lower: &mut Field<f32>, upper: &Field<f32>) {
    lower.values_mut().iter_mut().zip(upper.values()).for_each(|(lower, upper)| *lower += upper);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_layer_covers_what_lies_below_by_its_share() {
        let one = |color: [f32; 4], height| PaintedPicture {
            color: Field::filled(1, 1, color),
            height_mm: Field::filled(1, 1, height),
        };
        let lower = one([0.2, 0.4, 0.6, 1.0], 0.1);
        let half = over(lower.clone(), &one([1.0, 0.0, 0.0, 0.5], 0.2));
        assert_eq!(half.color.values()[0], [0.6, 0.2, 0.3, 1.0]);
        assert!((half.height_mm.values()[0] - 0.3).abs() < 1e-6);
        assert_eq!(over(lower.clone(), &one([0.9; 4].map(|_| 0.0), 0.0)), lower);
        let beyond = over(one([0.0; 4], 0.0), &one([0.3, 0.5, 0.7, 0.4], 0.2));
        assert_eq!(beyond.color.values()[0], [0.3, 0.5, 0.7, 0.4]);
    }
}
