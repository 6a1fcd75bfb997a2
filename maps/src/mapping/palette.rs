//! The palette of a scan: which pigments its survey cannot do without.
//!
//! A painter uses few of a library's pigments, and each of them more than once. A pigment that is needed
//! nowhere is therefore unlikely wherever it would do as well as others, above all in dark paint.

use std::collections::BTreeMap;

use crate::search::engine::NEGLIGIBLE;
use crate::search::set_fit::SetFit;

/// Mean rise of the score without a pigment, in the paints that need it most, from which it is more likely than
/// not in the palette. Chosen of 4 to 18 on simulated paintings.
const NEEDED: f32 = 14.0;
/// Number of paints whose mean tells how much a pigment is needed, where a scan has many: one of many may be off
/// by chance.
const PAINTS: usize = 2;
/// Number of paints from which a scan has many.
const MANY: usize = 16;

/// Probability of each of `pigments` pigments to be in the palette. `found` holds the sets of each surveyed
/// pixel, the best first, and `paints` a number for each pixel: pixels of one number are one paint, because
/// they share the errors of the library.
pub(crate) fn palette(found: &[Vec<SetFit>], paints: &[usize], pigments: usize) -> Vec<f32> {
    let survey = Survey::new(found, paints, pigments);
    let mut palette = (0..pigments).fold(0, |bits, pigment| bits | 1u64 << pigment);
    let has = |palette: u64, pigment: usize| palette >> pigment & 1 == 1;
    // The pigment that is needed least goes first: another may take its place.
    loop {
        let needs = survey.needs(palette);
        let inside = (0..pigments).filter(|&pigment| has(palette, pigment));
        let least = inside.min_by(|&a, &b| needs[a].total_cmp(&needs[b]));
        match least.filter(|&pigment| needs[pigment] < NEEDED) {
            Some(pigment) => palette &= !(1 << pigment),
            None => break,
        }
    }
    let inside = survey.needs(palette);
    let need = |pigment: usize| match has(palette, pigment) {
        true => inside[pigment],
        false => survey.needs(palette | 1 << pigment)[pigment],
    };
    (0..pigments).map(|pigment| 1.0 / (1.0 + (0.5 * (NEEDED - need(pigment))).exp())).collect()
}

/// Sets of all surveyed pixels as bits of their pigments, with their scores.
struct Survey {
    sets: Vec<Vec<(u64, f32)>>,
    /// Place of each pixel's paint.
    paints: Vec<usize>,
    /// Pixels of each paint.
    sizes: Vec<f32>,
    pigments: usize,
}

impl Survey {
    fn new(found: &[Vec<SetFit>], numbers: &[usize], pigments: usize) -> Self {
        let mut places = BTreeMap::new();
        let mut sizes = Vec::new();
        let place = |number: &usize| {
            let place = *places.entry(*number).or_insert_with(|| {
                sizes.push(0.0);
                sizes.len() - 1
            });
            sizes[place] += 1.0;
            place
        };
        let paints = numbers.iter().map(place).collect();
        let bits = |set: &SetFit| set.parts().fold(0, |bits, (member, _)| bits | 1 << member);
        let of_pixel = |sets: &Vec<SetFit>| sets.iter().map(|set| (bits(set), set.score)).collect();
        Self { sets: found.iter().map(of_pixel).collect(), paints, sizes, pigments }
    }

    /// Rise of the score without each pigment of `palette`, in the paints that need it most.
    fn needs(&self, palette: u64) -> Vec<f32> {
        let mut rises = vec![vec![0.0; self.sizes.len()]; self.pigments];
        for (sets, &paint) in self.sets.iter().zip(&self.paints) {
            let best = |palette: u64| sets.iter().find(|(set, _)| set & !palette == 0);
            let Some(&(set, score)) = best(palette) else { continue };
            for (pigment, rises) in rises.iter_mut().enumerate() {
                if set >> pigment & 1 == 1 {
                    let without = best(palette & !(1 << pigment));
                    let rise = without.map_or(NEGLIGIBLE, |(_, without)| without - score);
                    rises[paint] += rise.min(NEGLIGIBLE) / self.sizes[paint];
                }
            }
        }
        let counted = if self.sizes.len() < MANY { 1 } else { PAINTS };
        let most = |mut rises: Vec<f32>| {
            rises.sort_by(|a, b| b.total_cmp(a));
            rises.iter().take(counted).sum::<f32>() / counted as f32
        };
        rises.into_iter().map(most).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Sets of a pixel with their scores, the best first.
    fn pixel(sets: &[(&[usize], f32)]) -> Vec<SetFit> {
        let set = |(members, score): &(&[usize], f32)| {
            let share = 1.0 / members.len() as f32;
            let parts: Vec<(usize, f32)> = members.iter().map(|&m| (m, share)).collect();
            SetFit { score: *score, ..SetFit::of_parts(&parts).unwrap() }
        };
        sets.iter().map(set).collect()
    }

    #[test]
    fn a_pigment_that_two_paints_cannot_do_without_is_in_the_palette() {
        let needed = pixel(&[(&[0, 1], 5.0), (&[0, 2], 24.0)]);
        let doubtful = pixel(&[(&[0, 2], 5.0), (&[0, 1], 6.0)]);
        let found = [needed.clone(), needed.clone(), doubtful.clone(), doubtful];
        let palette = palette(&found, &[7, 3, 9, 4], 4);
        assert!(palette[0] > 0.9 && palette[1] > 0.9, "{palette:?}");
        assert!(palette[2] < 0.01, "a little better in two paints: {palette:?}");
        assert!(palette[3] < 0.01, "found nowhere: {palette:?}");
    }

    #[test]
    fn one_paint_tells_as_much_as_its_mean_pixel() {
        let needed = pixel(&[(&[0, 1], 5.0), (&[0, 2], 40.0)]);
        let not = pixel(&[(&[0], 5.0)]);
        let pixels = [needed.clone(), not.clone(), not.clone(), not.clone()];
        let mixed = palette(&pixels, &[1, 1, 1, 1], 3);
        assert!(mixed[1] < 0.1 && mixed[0] > 0.5, "one of four pixels of one paint: {mixed:?}");
        let often = palette(&[needed.clone(), needed.clone(), not.clone()], &[1, 1, 2], 3);
        assert!(often[1] > 0.9, "one of two paints: {often:?}");
        // Of many paints two must need it.
        let many = |needing: usize| {
            let pixel = |paint| if paint < needing { needed.clone() } else { not.clone() };
            palette(&(0..MANY).map(pixel).collect::<Vec<_>>(), &(0..MANY).collect::<Vec<_>>(), 3)
        };
        assert!(many(1)[1] < 0.2 && many(2)[1] > 0.9, "{:?} {:?}", many(1), many(2));
    }

    #[test]
    fn of_two_that_do_alike_the_one_that_is_needed_more_stays() {
        let alike = |first: f32, second: f32| {
            let mut sets = pixel(&[(&[1], first), (&[2], second), (&[0], 50.0)]);
            sets.sort_by(|a, b| a.score.total_cmp(&b.score));
            sets
        };
        let found = [alike(5.0, 7.0), alike(6.0, 5.0), alike(5.0, 8.0)];
        let palette = palette(&found, &[1, 2, 3], 3);
        assert!(palette[1] > 0.9 && palette[2] < 0.01, "{palette:?}");
    }
}
