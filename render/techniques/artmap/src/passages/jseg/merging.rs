//! Merging of neighbours with alike histograms of colour.

use graphics::field::Field;

use crate::passages::regions::{Regions, joined};

/// Distance of histograms below which neighbours are merged. Deng and Manjunath take 0.4; an
/// over-segmentation keeps more regions apart.
const ALIKE: f64 = 0.1;

/// Pixels of a region by colour class.
type Histogram = Vec<f64>;

/// Regions in which no two neighbours have histograms closer than 0.1: the Euclidean distance of
/// the shares of the classes of CIELUV (Deng and Manjunath 2001, section IV C).
pub(super) fn merged(regions: &Regions, classes: &Field<u8>) -> Regions {
    let most = classes.values().iter().max().map_or(0, |&class| class as usize + 1);
    let mut histograms: Vec<Histogram> = vec![vec![0.0; most]; regions.count];
    for (&label, &class) in regions.labels.values().iter().zip(classes.values()) {
        histograms[label as usize][class as usize] += 1.0;
    }
    joined(regions, histograms, ALIKE, apart, |whole: &mut Histogram, part: Histogram| {
        whole.iter_mut().zip(part).for_each(|(sum, more)| *sum += more);
    })
    .0
}

fn apart(one: &Histogram, other: &Histogram) -> f64 {
    let [pixels, other_pixels] = [one, other].map(|histogram| histogram.iter().sum::<f64>());
    let shares = one.iter().zip(other).map(|(a, b)| a / pixels - b / other_pixels);
    shares.map(|share| share * share).sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_neighbours_of_one_mixture_are_merged() {
        // Three strips of 40 columns: the first two have classes 0 and 1 in equal parts.
        let class = |x: usize, y: usize| match x / 40 {
            0 => (x + y) % 2,
            1 => (x / 2 + y) % 2,
            _ => 1 + (x + y) % 2,
        };
        let values = (0..120 * 20).map(|i| class(i % 120, i / 120) as u8).collect();
        let classes = Field::from_values(120, 20, values);
        let labels = (0..120 * 20).map(|i| (i % 120 / 40) as u32).collect();
        let regions = Regions::numbered(Field::from_values(120, 20, labels), 3);
        let found = merged(&regions, &classes);
        assert_eq!(found.count, 2);
        assert_eq!([5, 45, 85].map(|x| found.labels[(x, 3)]), [0, 0, 1]);
    }
}
