//! Recipe search compared with an exhaustive search over a grid of shares.

use calibrate::evaluate::lab;
use calibrate::library::PigmentLibrary;
use calibrate::matching::{FilmKind, MatchRequest, Target, recipes};
use calibrate::{PigmentId, Recipe};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use spectra::color::{Lab, delta_e_cie76, delta_e_ciede2000};

use super::{conditions, oils};

const PIGMENTS: usize = 12;
const STEPS: usize = 20;

/// Every division of `left` steps among `count` pigments with at least one step each.
fn shares(count: usize, left: usize) -> Vec<Vec<usize>> {
    if count == 1 {
        return vec![vec![left]];
    }
    let first = 1..=left - (count - 1);
    first
        .flat_map(|step: usize| {
            shares(count - 1, left - step).into_iter().map(move |mut rest| {
                rest.insert(0, step);
                rest
            })
        })
        .collect()
}

/// Every set of one to four of the pigments.
fn sets(pigments: &[PigmentId]) -> Vec<Vec<PigmentId>> {
    let masks = 1..1u32 << pigments.len();
    let of = |mask: u32| {
        let chosen = pigments.iter().enumerate().filter(|(place, _)| mask >> place & 1 == 1);
        chosen.map(|(_, pigment)| *pigment).collect()
    };
    masks.filter(|mask| mask.count_ones() <= 4).map(of).collect()
}

/// Colours of all hiding mixtures of one to four pigments in shares of 1 / `STEPS`.
fn colors(library: &PigmentLibrary, pigments: &[PigmentId]) -> Vec<Lab> {
    let weights = conditions(&["D65"])[0].viewing.weights(library.grid).unwrap();
    let by_count: Vec<Vec<Vec<usize>>> = (1..=4).map(|count| shares(count, STEPS)).collect();
    let mut colors = Vec::new();
    for set in sets(pigments) {
        for steps in &by_count[set.len() - 1] {
            let parts: Recipe =
                set.iter().zip(steps).map(|(&pigment, &step)| (pigment, step as f64)).collect();
            let mixture = library.mix(&parts).unwrap();
            colors.push(lab(&weights, &mixture.hiding(library.saunderson)));
        }
    }
    colors
}

/// Target colours: half are random points in CIELAB, half are random mixtures.
fn targets(library: &PigmentLibrary, pigments: &[PigmentId], count: usize) -> Vec<Lab> {
    let mut random = ChaCha8Rng::seed_from_u64(2004);
    let weights = conditions(&["D65"])[0].viewing.weights(library.grid).unwrap();
    let target = |number: usize| {
        if number.is_multiple_of(2) {
            let mut within =
                |least: f64, most: f64| least + (most - least) * random.random::<f64>();
            return Lab {
                lightness: within(5.0, 95.0),
                a: within(-60.0, 60.0),
                b: within(-60.0, 80.0),
            };
        }
        let parts: Recipe = (0..random.random_range(2..6))
            .map(|_| (pigments[random.random_range(0..pigments.len())], random.random()))
            .collect();
        lab(&weights, &library.mix(&parts).unwrap().hiding(library.saunderson))
    };
    (0..count).map(target).collect()
}

#[test]
fn recipes_are_at_least_as_near_as_an_exhaustive_search_on_200_targets() {
    let library = oils();
    let conditions = conditions(&["D65"]);
    let mut request = MatchRequest::new(&library, conditions.clone(), FilmKind::Hiding);
    request.allowed.truncate(PIGMENTS);
    request.least_share = 1.0 / STEPS as f64;
    request.tolerance = 0.0;
    request.count = 1;
    let every = colors(&library, &request.allowed);
    let mut reached = 0;
    for (number, wanted) in targets(&library, &request.allowed, 200).into_iter().enumerate() {
        let target = Target::from_lab("", wanted, &conditions);
        let found = recipes(&library, &target, &request).unwrap()[0].distance;
        // Only a colour nearer than the one found matters. CIEDE2000 is at least a twelfth of CIE 1976 at these
        // chromas, and at least the difference of lightness by its greatest weight, 1.748: farther ones are skipped.
        let nearest = every.iter().fold(found, |least, &color| {
            let far = (wanted.lightness - color.lightness).abs() > 1.748 * least
                || delta_e_cie76(wanted, color) > 12.0 * least;
            if far { least } else { least.min(delta_e_ciede2000(wanted, color)) }
        });
        assert!(found <= nearest + 1e-6, "target {number}, {wanted:?}: {found} for {nearest}");
        reached += usize::from(found < 0.01);
    }
    assert!((60..190).contains(&reached), "{reached} of 200 targets are in reach");
}

#[test]
fn whole_parts_are_as_near_as_every_whole_recipe() {
    let library = oils();
    let conditions = conditions(&["D65"]);
    let weights = conditions[0].viewing.weights(library.grid).unwrap();
    let mut request = MatchRequest::new(&library, conditions.clone(), FilmKind::Hiding);
    request.allowed = [1, 4, 7, 11, 12].map(PigmentId).to_vec();
    request.whole_parts = Some(9);
    request.tolerance = 0.0;
    let mut every = Vec::new();
    for set in sets(&request.allowed) {
        for total in set.len()..=9 {
            for parts in shares(set.len(), total) {
                let recipe: Recipe =
                    set.iter().zip(&parts).map(|(&p, &part)| (p, part as f64)).collect();
                let mixture = library.mix(&recipe).unwrap();
                every.push(lab(&weights, &mixture.hiding(library.saunderson)));
            }
        }
    }
    for wanted in targets(&library, &request.allowed, 60) {
        let found =
            recipes(&library, &Target::from_lab("", wanted, &conditions), &request).unwrap();
        let parts = found[0].parts.as_ref().unwrap();
        assert!(parts.iter().sum::<u32>() <= 9 && parts.iter().all(|part| *part > 0), "{parts:?}");
        let nearest = every.iter().map(|&color| delta_e_ciede2000(wanted, color));
        let nearest = nearest.fold(f64::INFINITY, f64::min);
        assert!(
            found[0].distance <= nearest + 1e-6,
            "{wanted:?}: {} for {nearest}",
            found[0].distance
        );
    }
}
