//! Joining of regions to passages, from the scribbles on.

use std::collections::{BTreeSet, VecDeque};

use graphics::field::Field;

use super::gaps::filled;
use super::regions::{Regions, beside, joined};
use super::traits::{RegionTraits, traits_of};

/// A region while regions are joined.
#[derive(Debug, Clone, PartialEq)]
struct Candidate {
    traits: RegionTraits,
    /// Index of the scribble that runs over it.
    scribble: Option<usize>,
}

/// A passage: all pixels that were joined to a scribble, and the number of regions under it.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Passage {
    pub(super) pixels: Vec<u32>,
    pub(super) regions_under: usize,
}

/// The passage of each scribble.
///
/// All regions under a scribble belong to it; a region under several scribbles is divided among
/// them. Then neighbours are joined, the most alike first, while their unlikeness is below
/// `reach`; regions of different scribbles never are. Gaps are filled at last.
pub(super) fn passages(
    regions: &Regions,
    scribbles: &[Vec<u32>],
    intensity: &Field<f32>,
    gradient: &Field<[f32; 2]>,
    reach: f64,
) -> Vec<Passage> {
    let (regions, under) = united(&divided(regions, scribbles), scribbles);
    let traits = traits_of(&regions, intensity, gradient);
    let mut candidates: Vec<Candidate> =
        traits.into_iter().map(|traits| Candidate { traits, scribble: None }).collect();
    for (number, scribble) in scribbles.iter().enumerate() {
        let first = scribble.first().map(|&pixel| regions.labels.values()[pixel as usize]);
        if let Some(label) = first {
            candidates[label as usize].scribble = Some(number);
        }
    }
    let (regions, candidates) = joined(&regions, candidates, reach, apart, unite);
    let owners: Vec<Option<usize>> =
        candidates.iter().map(|candidate| candidate.scribble).collect();
    let traits: Vec<RegionTraits> =
        candidates.into_iter().map(|candidate| candidate.traits).collect();
    let owners = filled(&regions, &traits, &owners, reach);
    let mut found: Vec<Passage> = under
        .into_iter()
        .map(|regions_under| Passage { pixels: Vec::new(), regions_under })
        .collect();
    for (pixel, &label) in (0..).zip(regions.labels.values()) {
        if let Some(number) = owners[label as usize] {
            found[number].pixels.push(pixel);
        }
    }
    found
}

/// Regions of like traits, joined without scribbles, and their traits.
pub(super) fn joined_alike(
    regions: &Regions,
    intensity: &Field<f32>,
    gradient: &Field<[f32; 2]>,
    reach: f64,
) -> (Regions, Vec<RegionTraits>) {
    let traits = traits_of(regions, intensity, gradient);
    joined(regions, traits, reach, RegionTraits::apart, |whole, part| whole.add(&part))
}

fn apart(one: &Candidate, other: &Candidate) -> f64 {
    match (one.scribble, other.scribble) {
        (Some(first), Some(second)) if first != second => f64::INFINITY,
        _ => one.traits.apart(&other.traits),
    }
}

fn unite(whole: &mut Candidate, part: Candidate) {
    whole.traits.add(&part.traits);
    whole.scribble = whole.scribble.or(part.scribble);
}

/// Divides regions under several scribbles: each pixel goes to the scribble nearest along a path
/// of rows and columns inside the region; of equally near ones to the first.
fn divided(regions: &Regions, scribbles: &[Vec<u32>]) -> Regions {
    let width = regions.labels.width();
    let height = regions.labels.height();
    let mut owners = vec![BTreeSet::new(); regions.count];
    for (number, scribble) in scribbles.iter().enumerate() {
        for &pixel in scribble {
            owners[regions.labels.values()[pixel as usize] as usize].insert(number);
        }
    }
    let shared = |pixel: u32| owners[regions.labels.values()[pixel as usize] as usize].len() > 1;
    let mut labels = regions.labels.clone();
    let mut reached = vec![false; width * height];
    let mut queue = VecDeque::new();
    let mut next = regions.count as u32;
    for scribble in scribbles {
        // One scribble may run over several shared regions, so each has its own new label.
        let mut names = vec![None; regions.count];
        for &pixel in scribble.iter().filter(|&&pixel| shared(pixel)) {
            let region = regions.labels.values()[pixel as usize];
            let name = *names[region as usize].get_or_insert_with(|| {
                next += 1;
                next - 1
            });
            labels.values_mut()[pixel as usize] = name;
            reached[pixel as usize] = true;
            queue.push_back(pixel);
        }
    }
    while let Some(pixel) = queue.pop_front() {
        let region = regions.labels.values()[pixel as usize];
        let name = labels.values()[pixel as usize];
        for other in beside(pixel, width, height) {
            let inside = regions.labels.values()[other as usize] == region;
            if inside && !std::mem::replace(&mut reached[other as usize], true) {
                labels.values_mut()[other as usize] = name;
                queue.push_back(other);
            }
        }
    }
    Regions::numbered(labels, next as usize)
}

/// Regions in which those under one scribble are one, and their former number for each scribble.
fn united(regions: &Regions, scribbles: &[Vec<u32>]) -> (Regions, Vec<usize>) {
    let mut names: Vec<u32> = (0..regions.count as u32).collect();
    let mut under = Vec::new();
    for scribble in scribbles {
        let labels = scribble.iter().map(|&pixel| regions.labels.values()[pixel as usize]);
        let labels: BTreeSet<u32> = labels.collect();
        under.push(labels.len());
        if let Some(&first) = labels.first() {
            labels.iter().for_each(|&label| names[label as usize] = first);
        }
    }
    let labels = regions.labels.values().iter().map(|&label| names[label as usize]).collect();
    let width = regions.labels.width();
    let height = regions.labels.height();
    (Regions::numbered(Field::from_values(width, height, labels), regions.count), under)
}

#[cfg(test)]
mod tests {
    use super::super::perceived::gradient_of;
    use super::*;

    /// Six strips of 10 columns with the given tones.
    fn strips(tones: [f32; 6]) -> (Regions, Field<f32>) {
        let labels = (0..60 * 20).map(|i| (i % 60 / 10) as u32).collect();
        let regions = Regions { labels: Field::from_values(60, 20, labels), count: 6 };
        let intensity = (0..60 * 20).map(|i| tones[i % 60 / 10]).collect();
        (regions, Field::from_values(60, 20, intensity))
    }

    fn columns(passage: &Passage) -> Vec<u32> {
        let columns: BTreeSet<u32> = passage.pixels.iter().map(|pixel| pixel % 60 / 10).collect();
        columns.into_iter().collect()
    }

    #[test]
    fn scribbles_grow_over_like_regions_and_never_meet() {
        let (regions, intensity) = strips([0.30, 0.32, 0.34, 0.36, 0.80, 0.82]);
        let gradient = gradient_of(&intensity);
        let find = |scribbles: &[Vec<u32>], reach| {
            passages(&regions, scribbles, &intensity, &gradient, reach)
        };
        let one = find(&[vec![5]], 1.0);
        assert_eq!((columns(&one[0]), one[0].regions_under), (vec![0, 1, 2, 3], 1));
        let both = find(&[vec![5], vec![35]], 1.0);
        let found: Vec<Vec<u32>> = both.iter().map(columns).collect();
        assert_eq!(found, [vec![0, 1], vec![2, 3]]);
        assert_eq!(columns(&find(&[vec![5]], 0.1)[0]), [0], "a small reach");
        let bridge = find(&[(5..45).collect()], 1.0);
        assert_eq!(bridge[0].regions_under, 5, "regions under a scribble belong to it");
    }

    #[test]
    fn a_region_under_two_scribbles_is_divided_between_them() {
        let (_, intensity) = strips([0.4; 6]);
        let whole = Regions { labels: Field::filled(60, 20, 0), count: 1 };
        let scribbles = [vec![10], vec![50]];
        let found = passages(&whole, &scribbles, &intensity, &gradient_of(&intensity), 1.0);
        assert_eq!(found[0].pixels.len() + found[1].pixels.len(), 1200);
        // Columns up to 30 are as near to the first scribble as to the second, or nearer.
        assert_eq!(found[0].pixels.len(), 31 * 20);
    }
}
