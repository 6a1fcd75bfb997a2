//! Figures of the brushwork of one texture, to be compared with another's.

use super::texture::Texture;

/// Grey levels of co-occurrences.
const LEVELS: usize = 16;
/// Shares of the texels below the darkest and above the lightest level.
const TAILS: f64 = 0.005;
/// Distances in texels at which texels are compared: along both axes and both diagonals.
const STEPS: [[isize; 2]; 14] = [
    [1, 0],
    [2, 0],
    [4, 0],
    [8, 0],
    [0, 1],
    [0, 2],
    [0, 4],
    [0, 8],
    [1, 1],
    [3, 3],
    [6, 6],
    [1, -1],
    [3, -3],
    [6, -6],
];
/// Correlation at which a stroke ends.
const END: f64 = 0.05;

/// Average co-occurrence error between two textures, 0 (alike) to 2: how often grey levels stand
/// at given distances from each other, a figure that predicts how people rank textures (Benard,
/// Thollot and Sillion 2009). The levels are 16 between the 0.5 and 99.5 percentiles of L* of
/// `reference`.
#[must_use]
pub fn co_occurrence_error(reference: &Texture, other: &Texture) -> f64 {
    let mut sorted: Vec<f32> = reference.inside().collect();
    if sorted.is_empty() {
        return 2.0;
    }
    sorted.sort_by(f32::total_cmp);
    let tail = (TAILS * sorted.len() as f64) as usize;
    let least = sorted[tail];
    let most = sorted[sorted.len() - 1 - tail];
    let per_level = LEVELS as f32 / (most - least).max(1e-6);
    let level = |value: f32| (((value - least) * per_level).max(0.0) as usize).min(LEVELS - 1);
    let shares = |texture: &Texture, step: [isize; 2]| {
        let mut counts = [0_u64; LEVELS * LEVELS];
        texture.pairs(step, |a, b| counts[level(a) * LEVELS + level(b)] += 1);
        let total = counts.iter().sum::<u64>().max(1) as f64;
        counts.map(|count| count as f64 / total)
    };
    STEPS
        .iter()
        .map(|&step: &[isize; 2]| {
            let first = shares(reference, step);
            let second = shares(other, step);
            first.iter().zip(second).map(|(a, b)| (a - b).abs()).sum::<f64>()
        })
        .sum::<f64>()
        / STEPS.len() as f64
}

/// Standard deviation of L*.
#[must_use]
pub fn contrast(texture: &Texture) -> f64 {
    moments(texture).1.sqrt()
}

/// Length of strokes in texels along y: the integral of the autocorrelation of L* until it falls
/// below 0.05. Unevenness over long distances counts as well: compare textures of different size
/// after [`Texture::levelled`].
#[must_use]
pub fn stroke_length(texture: &Texture) -> f64 {
    let (mean, variance) = moments(texture);
    if variance <= 0.0 {
        return 0.0;
    }
    let mut length = 0.5;
    for step in 1..texture.size().1 / 2 {
        let mut sum = 0.0;
        let mut count = 0_u64;
        texture.pairs([0, step as isize], |a, b| {
            sum += (f64::from(a) - mean) * (f64::from(b) - mean);
            count += 1;
        });
        let correlation = sum / count.max(1) as f64 / variance;
        if correlation < END {
            break;
        }
        length += correlation;
    }
    length
}

/// Mean and variance of L*.
fn moments(texture: &Texture) -> (f64, f64) {
    let count = texture.inside().count().max(1) as f64;
    let mean = texture.inside().map(f64::from).sum::<f64>() / count;
    let squares = texture.inside().map(|value| (f64::from(value) - mean).powi(2));
    (mean, squares.sum::<f64>() / count)
}

#[cfg(test)]
mod tests {
    use graphics::field::Field;

    use super::*;

    /// Vertical dashes, `length` texels long, `spacing` texels apart.
    fn dashes(size: usize, length: usize, spacing: usize, dark: f32) -> Texture {
        let values = (0..size * size)
            .map(|index: usize| {
                let x = index % size;
                let y = index / size;
                let column = x / spacing;
                let even = ((y + 7 * column * column) / length).is_multiple_of(2);
                let on = even && x % spacing < spacing / 2;
                [if on { dark } else { 0.8 }; 3]
            })
            .collect();
        Texture::tiled(&Field::from_values(size, size, values))
    }

    #[test]
    fn a_texture_has_no_error_to_itself_and_much_to_another() {
        let short = dashes(96, 8, 8, 0.1);
        assert_eq!(co_occurrence_error(&short, &short), 0.0);
        let moved = dashes(96, 8, 8, 0.1);
        assert!(co_occurrence_error(&short, &moved) < 0.05);
        let other = dashes(96, 24, 16, 0.4);
        assert!(co_occurrence_error(&short, &other) > 0.8);
    }

    #[test]
    fn longer_dashes_have_longer_strokes_and_paler_ones_less_contrast() {
        let short = dashes(96, 8, 8, 0.1);
        let long = dashes(96, 24, 8, 0.1);
        let ratio = stroke_length(&long) / stroke_length(&short);
        assert!((2.0..4.0).contains(&ratio), "{ratio}");
        assert!(contrast(&dashes(96, 8, 8, 0.4)) < 0.6 * contrast(&short));
    }

    #[test]
    fn a_gradient_does_not_lengthen_the_strokes_of_a_levelled_texture() {
        let short = dashes(96, 8, 8, 0.5);
        let mask = Field::filled(96, 96, true);
        let uneven = Field::from_values(
            96,
            96,
            (0..96 * 96)
                .map(|index: usize| {
                    let on = short.lightness().values()[index] < 80.0;
                    [(if on { 0.5 } else { 0.8 }) * (0.1 + (index / 96) as f32 / 96.0); 3]
                })
                .collect(),
        );
        let uneven = Texture::masked(&uneven, &mask);
        assert!(stroke_length(&uneven) > 1.5 * stroke_length(&short));
        let ratio = stroke_length(&uneven.levelled(16.0)) / stroke_length(&short.levelled(16.0));
        assert!((0.8..1.2).contains(&ratio), "{ratio}");
    }

    #[test]
    fn a_flat_texture_has_neither_contrast_nor_strokes() {
        let flat = Texture::tiled(&Field::filled(32, 32, [0.5; 3]));
        assert_eq!((contrast(&flat) < 1e-4, stroke_length(&flat)), (true, 0.0));
    }
}
