//! The cheapest cut through an overlap, by dynamic programming (Efros and Freeman 2001).

/// Column of the cut in every row of a strip with `width` errors a row. Columns of neighbouring
/// rows differ by one at most; the sum of errors along the cut is the least possible. Of equal
/// ones the leftmost is taken.
pub(crate) fn cheapest_cut(errors: &[f32], width: usize) -> Vec<usize> {
    let rows = errors.len() / width;
    let mut sums = errors.to_vec();
    for row in 1..rows {
        for x in 0..width {
            let from = x.saturating_sub(1);
            let to = (x + 1).min(width - 1);
            let above = &sums[(row - 1) * width..][from..=to];
            let least = above.iter().copied().fold(f32::INFINITY, f32::min);
            sums[row * width + x] += least;
        }
    }
    let mut cut = vec![0; rows];
    for row in (0..rows).rev() {
        let (from, to) = if row + 1 == rows {
            (0, width - 1)
        } else {
            let below: usize = cut[row + 1];
            (below.saturating_sub(1), (below + 1).min(width - 1))
        };
        let sums = &sums[row * width..][..width];
        cut[row] = (from..=to).fold(from, |best, x| if sums[x] < sums[best] { x } else { best });
    }
    cut
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_cut_follows_a_valley_and_is_the_cheapest_of_all() {
        let width = 4;
        let errors = [9., 1., 9., 9., 9., 9., 2., 9., 9., 9., 1., 9., 9., 0., 9., 9.];
        let cut = cheapest_cut(&errors, width);
        assert_eq!(cut, [1, 2, 2, 1]);
        let cost = |cut: &[usize]| -> f32 {
            cut.iter().enumerate().map(|(row, &x)| errors[row * width + x]).sum()
        };
        for index in 0..256_usize {
            let other: Vec<usize> = (0..4).map(|row| index >> (2 * row) & 3).collect();
            let steady = other.windows(2).all(|pair| pair[0].abs_diff(pair[1]) <= 1);
            assert!(!steady || cost(&other) >= cost(&cut), "{other:?}");
        }
    }
}
