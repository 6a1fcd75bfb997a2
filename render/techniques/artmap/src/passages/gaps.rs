//! Gaps of passages: single strokes that are unlike the mean of the strokes around them.

use super::regions::Regions;
use super::traits::RegionTraits;

/// A gap borders on passages with more than this share of its border.
const LEAST_BORDER: f64 = 0.5;

/// Largest area of a gap as a share of its passage.
const MOST_AREA: f64 = 0.2;

/// How many times more unlike a gap may be than a region that is joined.
const MORE_UNLIKE: f64 = 2.5;

/// The passage of each region, with gaps filled: regions of small areas that belong to no passage
/// and border mainly on passages go to the one that they are most like, unless they are very unlike
/// all.
///
/// A region of the size of a stroke has the tone of that stroke, which scatters about the mean of
/// the passage; so the place decides with the traits. Regions behind a gap that are like the
/// passage count as its border, and are joined once the gap is filled. The edge of the picture is
/// no border.
/// This is ours; Yan, Chi, Lee and Lin do not say what becomes of such regions.
pub(super) fn filled(
    regions: &Regions,
    traits: &[RegionTraits],
    passages: &[Option<usize>],
    reach: f64,
) -> Vec<Option<usize>> {
    let borders = borders(regions);
    let whole = sums(traits, passages);
    let mut found = passages.to_vec();
    loop {
        let mut changed = false;
        for label in 0..regions.count {
            if found[label].is_none() {
                found[label] = around(label, &borders[label], traits, &whole, &found, reach);
                changed |= found[label].is_some();
            }
        }
        if !changed {
            return found;
        }
    }
}

/// Traits of each passage.
fn sums(traits: &[RegionTraits], passages: &[Option<usize>]) -> Vec<RegionTraits> {
    let count = passages.iter().flatten().max().map_or(0, |&last| last + 1);
    let mut whole = vec![RegionTraits::default(); count];
    for (traits, passage) in traits.iter().zip(passages) {
        if let Some(passage) = *passage {
            whole[passage].add(traits);
        }
    }
    whole
}

/// The passage that the region `label` touches and belongs to; of several the most alike.
fn around(
    label: usize,
    borders: &[(u32, u32)],
    traits: &[RegionTraits],
    whole: &[RegionTraits],
    found: &[Option<usize>],
    reach: f64,
) -> Option<usize> {
    let own = &traits[label];
    let length = |chosen: &dyn Fn(u32) -> bool| -> u32 {
        borders.iter().filter(|(other, _)| chosen(*other)).map(|(_, length)| length).sum()
    };
    let all = length(&|_| true);
    let belongs = |passage: &usize| {
        let whole = &whole[*passage];
        let inside = |other: u32| found[other as usize] == Some(*passage);
        let taken = |other: u32| {
            found[other as usize].is_some() || traits[other as usize].apart(whole) < reach
        };
        let enclosed = f64::from(length(&taken)) > LEAST_BORDER * f64::from(all);
        let small = own.pixels < MOST_AREA * whole.pixels;
        let gap = enclosed && small && own.apart(whole) < MORE_UNLIKE * reach;
        length(&inside) > 0 && (gap || own.apart(whole) < reach)
    };
    let unlike = |passage: &usize| own.apart(&whole[*passage]);
    (0..whole.len()).filter(belongs).min_by(|one, other| unlike(one).total_cmp(&unlike(other)))
}

/// The neighbours of each region by rising label, and the lengths of the common borders in pixels.
fn borders(regions: &Regions) -> Vec<Vec<(u32, u32)>> {
    let width = regions.labels.width();
    let height = regions.labels.height();
    let mut pairs = Vec::new();
    for y in 0..height {
        for x in 0..width {
            let own = regions.labels[(x, y)];
            let right = (x + 1 < width).then(|| regions.labels[(x + 1, y)]);
            let below = (y + 1 < height).then(|| regions.labels[(x, y + 1)]);
            for other in [right, below].into_iter().flatten().filter(|&other| other != own) {
                pairs.extend([(own, other), (other, own)]);
            }
        }
    }
    pairs.sort_unstable();
    let mut borders = vec![Vec::new(); regions.count];
    for same in pairs.chunk_by(|one, other| one == other) {
        borders[same[0].0 as usize].push((same[0].1, same.len() as u32));
    }
    borders
}

#[cfg(test)]
mod tests {
    use graphics::field::Field;

    use super::super::perceived::gradient_of;
    use super::super::traits::traits_of;
    use super::*;

    /// Passages of strips, from the first column of each, its tone, and the passages known before.
    fn strips<const N: usize>(
        starts: [usize; N],
        tones: [f32; N],
        known: [Option<usize>; N],
    ) -> Vec<Option<usize>> {
        let label = |i: usize| starts.partition_point(|&start| start <= i % 100) - 1;
        let labels = (0..100 * 40).map(|i| label(i) as u32).collect();
        let regions = Regions { labels: Field::from_values(100, 40, labels), count: N };
        let intensity = (0..100 * 40).map(|i| tones[label(i)]).collect();
        let intensity = Field::from_values(100, 40, intensity);
        let traits = traits_of(&regions, &intensity, &gradient_of(&intensity));
        filled(&regions, &traits, &known, 1.0)
    }

    #[test]
    fn a_small_stroke_between_two_passages_goes_to_the_like_one() {
        let known = [Some(0), None, Some(1)];
        let found = |tone| strips([0, 48, 52], [0.5, tone, 0.9], known)[1];
        assert_eq!(found(0.62), Some(0));
        assert_eq!(found(0.75), Some(1));
        assert_eq!(found(0.2), None, "unlike both");
        let wide = strips([0, 40, 60], [0.5, 0.62, 0.9], known)[1];
        assert_eq!(wide, None, "a large area is no stroke");
        let beside_free = strips([0, 48, 52], [0.5, 0.62, 0.9], [Some(0), None, None])[1];
        assert_eq!(beside_free, None, "only half of its border");
    }

    #[test]
    fn a_like_region_behind_a_gap_is_joined() {
        let known = [Some(0), None, None, Some(1)];
        let found = strips([0, 50, 54, 70], [0.5, 0.4, 0.5, 0.8], known);
        assert_eq!(found, [Some(0), Some(0), Some(0), Some(1)]);
    }
}
