//! Growing of valleys until they fill their region.
//!
//! First parts of small J that touch one valley only go to it, at this scale and all finer ones;
//! then single pixels follow, smallest J at the finest scale first (Deng and Manjunath 2001,
//! section IV B).

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use graphics::field::Field;

use super::valleys::components;
use crate::passages::regions::beside;

/// Marks pixels that belong to no valley yet.
const NOBODY: u32 = u32::MAX;

/// Divides a region among its valleys: replaces `label` in `labels` by `first_new` and up for the
/// second valley and the following ones. The first valley keeps `label`.
///
/// `j` holds the fields of J from this scale to the finest.
pub(super) fn grow(
    labels: &mut Field<u32>,
    label: u32,
    pixels: &[u32],
    valleys: &[Vec<u32>],
    j: &[Field<f32>],
    first_new: u32,
) {
    let Some(finest) = j.last() else { return };
    let size = (labels.width(), labels.height());
    pixels.iter().for_each(|&pixel| labels.values_mut()[pixel as usize] = NOBODY);
    let names = std::iter::once(label).chain(first_new..);
    let names: Vec<u32> = names.take(valleys.len()).collect();
    for (valley, &name) in valleys.iter().zip(&names) {
        valley.iter().for_each(|&pixel| labels.values_mut()[pixel as usize] = name);
    }
    for j in j {
        grow_parts(labels, pixels, &names, j);
    }
    let mut queue = BinaryHeap::new();
    // The bits of J, which is at least 0, are in its order.
    let entry = |pixel: u32| Reverse((finest.values()[pixel as usize].to_bits(), pixel));
    for &pixel in pixels.iter().filter(|&&pixel| labels.values()[pixel as usize] == NOBODY) {
        if beside(pixel, size.0, size.1)
            .any(|other: u32| names.binary_search(&labels.values()[other as usize]).is_ok())
        {
            queue.push(entry(pixel));
        }
    }
    while let Some(Reverse((_, pixel))) = queue.pop() {
        if labels.values()[pixel as usize] != NOBODY {
            continue;
        }
        let around =
            beside(pixel, size.0, size.1).map(|other: u32| labels.values()[other as usize]);
        let Some(owner) = around.filter(|owner| names.binary_search(owner).is_ok()).min() else {
            continue;
        };
        labels.values_mut()[pixel as usize] = owner;
        for other in beside(pixel, size.0, size.1) {
            if labels.values()[other as usize] == NOBODY {
                queue.push(entry(other));
            }
        }
    }
}

/// Gives the parts of the remaining pixels with J below their mean to the only valley that they
/// touch.
fn grow_parts(labels: &mut Field<u32>, pixels: &[u32], names: &[u32], j: &Field<f32>) {
    let width = labels.width();
    let height = labels.height();
    let value = |pixel: u32| f64::from(j.values()[pixel as usize]);
    let is_left = |labels: &Field<u32>, pixel: u32| labels.values()[pixel as usize] == NOBODY;
    let left: Vec<u32> = pixels.iter().copied().filter(|&pixel| is_left(labels, pixel)).collect();
    let mean = left.iter().map(|&pixel| value(pixel)).sum::<f64>() / left.len().max(1) as f64;
    for part in components(&left, (width, height), |pixel: u32| {
        is_left(labels, pixel) && value(pixel) <= mean
    }) {
        let around = part.iter().flat_map(|&pixel| beside(pixel, width, height));
        let mut owners = around
            .map(|other| labels.values()[other as usize])
            .filter(|owner| names.binary_search(owner).is_ok());
        let Some(owner) = owners.next() else { continue };
        if owners.all(|other| other == owner) {
            part.iter().for_each(|&pixel| labels.values_mut()[pixel as usize] = owner);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn valleys_meet_at_the_ridge() {
        // J rises towards column 6; the valleys are the outermost columns.
        let j: Vec<f32> = (0..13 * 3).map(|i| 6.0 - f32::abs((i % 13) as f32 - 6.0)).collect();
        let j = Field::from_values(13, 3, j);
        let mut labels = Field::filled(13, 3, 4);
        let pixels: Vec<u32> = (0..39).collect();
        let valleys = [vec![0, 13, 26], vec![12, 25, 38]];
        grow(&mut labels, 4, &pixels, &valleys, &[j], 9);
        for y in 0..3 {
            assert_eq!(labels.row(y, 0, 6), [4; 6]);
            assert_eq!(labels.row(y, 7, 6), [9; 6]);
        }
        assert!([4, 9].contains(&labels[(6, 1)]), "the ridge belongs to one of them");
    }

    #[test]
    fn pixels_of_other_regions_stay() {
        let mut labels = Field::from_values(5, 1, vec![0, 0, 0, 7, 7]);
        let j = Field::from_values(5, 1, vec![0.0, 0.3, 0.5, 0.1, 0.1]);
        grow(&mut labels, 0, &[0, 1, 2], &[vec![0], vec![2]], &[j], 8);
        assert_eq!(labels.values()[3..], [7, 7]);
        assert_eq!(labels.values()[..3], [0, 0, 8]);
    }
}
