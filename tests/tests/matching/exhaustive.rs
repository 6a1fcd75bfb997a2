//! Recipe search compared with an exhaustive search over a grid of shares, which recipes are shown
//! in which order, and limits of a search: allowed and required pigments, their number, shares,
//! whole parts.

use calibrate::evaluate::lab;
use calibrate::library::PigmentLibrary;
use calibrate::matching::{
    FilmKind, MatchError, RecipeLimits, RecipeMatch, RequiredPigment, Target, recipes,
};
use calibrate::{PigmentId, Recipe};
use documents::Task;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use spectra::color::{Lab, delta_e_cie76, delta_e_ciede2000};

use super::{conditions, oils, target_of};

const PIGMENTS: usize = 12;
const STEPS: usize = 20;

/// Every division of `left` steps among `count` pigments, with at least one step each.
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
    let masks = masks.filter(|mask| mask.count_ones() <= 4).map(|mask| {
        let chosen = pigments.iter().enumerate().filter(|(place, _)| mask >> place & 1 == 1);
        chosen.map(|(_, pigment)| *pigment).collect()
    });
    masks.collect()
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

/// Random colour with L*, a* and b* in these ranges.
fn random_lab(random: &mut ChaCha8Rng, ranges: [(f64, f64); 3]) -> Lab {
    let [lightness, a, b] =
        ranges.map(|(least, most)| least + (most - least) * random.random::<f64>());
    Lab { lightness, a, b }
}

/// Target colours. Half are random points in CIELAB, half are random mixtures.
fn targets(library: &PigmentLibrary, pigments: &[PigmentId], count: usize) -> Vec<Lab> {
    let mut random = ChaCha8Rng::seed_from_u64(2004);
    let weights = conditions(&["D65"])[0].viewing.weights(library.grid).unwrap();
    let targets = (0..count).map(|number| {
        if number.is_multiple_of(2) {
            return random_lab(&mut random, [(5.0, 95.0), (-60.0, 60.0), (-60.0, 80.0)]);
        }
        let parts: Recipe = (0..random.random_range(2..6))
            .map(|_| (pigments[random.random_range(0..pigments.len())], random.random()))
            .collect();
        lab(&weights, &library.mix(&parts).unwrap().hiding(library.saunderson))
    });
    targets.collect()
}

#[test]
fn recipes_are_at_least_as_near_as_an_exhaustive_search_on_200_targets() {
    let library = oils();
    let conditions = conditions(&["D65"]);
    let mut limits = RecipeLimits::new(&library, conditions.clone(), FilmKind::Hiding);
    limits.allowed.truncate(PIGMENTS);
    limits.least_share = 1.0 / STEPS as f64;
    limits.tolerance = 0.0;
    limits.count = 1;
    let every = colors(&library, &limits.allowed);
    let mut reached = 0;
    for (number, wanted) in targets(&library, &limits.allowed, 200).into_iter().enumerate() {
        let target = Target::from_lab("", wanted, &conditions);
        let found = recipes(&library, &target, &limits, &Task::default()).unwrap()[0].distance;
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
    let mut limits = RecipeLimits::new(&library, conditions.clone(), FilmKind::Hiding);
    limits.allowed = [1, 4, 7, 11, 12].map(PigmentId).to_vec();
    limits.whole_parts = Some(9);
    limits.tolerance = 0.0;
    let mut every = Vec::new();
    for set in sets(&limits.allowed) {
        for total in set.len()..=9 {
            for parts in shares(set.len(), total) {
                let recipe: Recipe =
                    set.iter().zip(&parts).map(|(&p, &part)| (p, part as f64)).collect();
                let mixture = library.mix(&recipe).unwrap();
                every.push(lab(&weights, &mixture.hiding(library.saunderson)));
            }
        }
    }
    for wanted in targets(&library, &limits.allowed, 60) {
        let found = recipes(
            &library,
            &Target::from_lab("", wanted, &conditions),
            &limits,
            &Task::default(),
        )
        .unwrap();
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

fn sorted(recipe: &RecipeMatch) -> Vec<PigmentId> {
    let mut pigments: Vec<PigmentId> = recipe.shares.iter().map(|(pigment, _)| *pigment).collect();
    pigments.sort_unstable();
    pigments
}

#[test]
fn a_mixture_is_found_again_from_its_color_under_three_lights() {
    let library = oils();
    let conditions = conditions(&["D65", "A", "FL11"]);
    for names in [
        ["Zinc White", "Cobalt Blue", "Vermilion"],
        ["Lead White", "Viridian", "Bone Black"],
        ["Zinc White", "Chrome Yellow", "Prussian Blue"],
    ] {
        let pigments = names.map(|name| library.find(name).unwrap());
        let recipe: Recipe = pigments.into_iter().zip([0.6, 0.3, 0.1]).collect();
        let mixed = library.mix(&recipe).unwrap().hiding(library.saunderson);
        let target = target_of(&library, &mixed, &conditions);
        let mut limits = RecipeLimits::new(&library, conditions.clone(), FilmKind::Hiding);
        limits.tolerance = 1e-3;
        let found = &recipes(&library, &target, &limits, &Task::default()).unwrap()[0];
        let mut wanted = pigments.to_vec();
        wanted.sort_unstable();
        assert_eq!(sorted(found), wanted, "{names:?}");
        for &(pigment, share) in &recipe {
            let found_share = found.shares.iter().find(|(p, _)| *p == pigment).unwrap().1;
            assert!((found_share - share).abs() < 1e-3, "{names:?}: {found_share} for {share}");
        }
    }
}

#[test]
fn lights_that_count_rank_metameric_recipes_lower() {
    let library = oils();
    let three = conditions(&["D65", "A", "FL11"]);
    let blue = library.find("Ultramarine").unwrap();
    let white = library.find("Zinc White").unwrap();
    let tint = library.mix([(blue, 1.0), (white, 4.0)]).unwrap().hiding(library.saunderson);
    let target = target_of(&library, &tint, &three);
    // Errors of the best recipe without ultramarine: under D65, and as root mean square over the
    // three lights.
    let [daylight, all] = [[1.0, 1e-9, 1e-9], [1.0; 3]].map(|weights| {
        let mut conditions = three.clone();
        conditions
            .iter_mut()
            .zip(weights)
            .for_each(|(condition, weight)| condition.weight = weight);
        let mut limits = RecipeLimits::new(&library, conditions, FilmKind::Hiding);
        limits.allowed.retain(|&pigment| pigment != blue);
        let best = recipes(&library, &target, &limits, &Task::default()).unwrap().remove(0);
        let squares: f64 = best.delta_e.iter().map(|difference| difference * difference).sum();
        (best.delta_e[0], (squares / 3.0).sqrt())
    });
    assert!(daylight.0 < all.0, "under daylight: {daylight:?} {all:?}");
    assert!(all.1 < 0.9 * daylight.1, "over three lights: {all:?} for {daylight:?}");
}

#[test]
fn equally_near_recipes_come_with_few_pigments_first_and_cheapest_first_if_priced() {
    let library = oils();
    let conditions = conditions(&["D65"]);
    let target = Target::from_lab("", Lab { lightness: 60.0, a: 5.0, b: 20.0 }, &conditions);
    let mut limits = RecipeLimits::new(&library, conditions, FilmKind::Hiding);
    (limits.tolerance, limits.count) = (0.5, 10);
    let nearest =
        |found: &[RecipeMatch]| found.iter().map(|r| r.distance).fold(f64::INFINITY, f64::min);
    let found = recipes(&library, &target, &limits, &Task::default()).unwrap();
    let equal = |found: &[RecipeMatch]| -> Vec<RecipeMatch> {
        let most = nearest(found) + 0.5;
        found.iter().filter(|recipe| recipe.distance <= most).cloned().collect()
    };
    let equals = equal(&found);
    assert!(
        equals.len() > 1
            && equals.is_sorted_by_key(|recipe| {
                let steps = ((recipe.distance - nearest(&found)) / 0.05).floor();
                let smallest = recipe.shares.iter().map(|s| s.1).fold(1.0, f64::min);
                (recipe.shares.len() as f64, steps, -smallest)
            }),
        "{equals:?}"
    );

    limits.costs = (0..library.pigments.len()).map(|index| (index * 7 % 11) as f64).collect();
    let priced = recipes(&library, &target, &limits, &Task::default()).unwrap();
    let costs: Vec<f64> = equal(&priced).iter().map(|recipe| recipe.cost.unwrap()).collect();
    assert!(costs.len() > 1 && costs.is_sorted(), "{costs:?}");
    assert!(found.iter().all(|recipe| recipe.cost.is_none()));
}

#[test]
fn a_pigment_that_brings_nothing_is_not_shown() {
    let library = oils();
    let conditions = conditions(&["D65"]);
    let target = Target::from_lab("", Lab { lightness: 60.0, a: 5.0, b: 20.0 }, &conditions);
    let mut limits = RecipeLimits::new(&library, conditions, FilmKind::Hiding);
    let names = ["Zinc White", "Minium", "Chrome Yellow", "Cobalt Blue", "Viridian", "Bone Black"];
    limits.allowed = names.map(|name| library.find(name).unwrap()).to_vec();
    // This is more than the 56 sets of one to four of six pigments.
    limits.count = 100;
    let found = recipes(&library, &target, &limits, &Task::default()).unwrap();
    assert!((2..56).contains(&found.len()), "{} recipes", found.len());
    for (place, recipe) in found.iter().enumerate() {
        assert!(recipe.shares.parts().is_sorted_by(|a, b| a.1 >= b.1), "{recipe:?}");
        for before in &found[..place] {
            let larger = sorted(before).iter().all(|p| sorted(recipe).contains(p));
            assert!(!larger || recipe.distance < before.distance - 0.05, "{before:?}\n{recipe:?}");
        }
    }
}

#[test]
fn the_same_request_gives_the_same_recipes() {
    let library = oils();
    let conditions = conditions(&["D65", "FL11"]);
    let target = Target::from_lab("", Lab { lightness: 35.0, a: -20.0, b: -5.0 }, &conditions);
    let limits = RecipeLimits::new(&library, conditions, FilmKind::Hiding);
    let first = recipes(&library, &target, &limits, &Task::default()).unwrap();
    assert_eq!(first, recipes(&library, &target, &limits, &Task::default()).unwrap());
}

fn required_pigment(&(pigment, share): &(PigmentId, Option<f64>)) -> RequiredPigment {
    RequiredPigment { pigment, share }
}

fn two(first: Option<f64>, second: Option<f64>) -> Vec<RequiredPigment> {
    [(PigmentId(0), first), (PigmentId(1), second)].iter().map(required_pigment).collect()
}

fn colors_within_limits() -> Vec<Lab> {
    let mut random = ChaCha8Rng::seed_from_u64(5);
    let ranges = [(20.0, 90.0), (-40.0, 50.0), (-50.0, 60.0)];
    (0..12).map(|_| random_lab(&mut random, ranges)).collect()
}

#[test]
fn every_recipe_keeps_every_limit() {
    let library = oils();
    let conditions = conditions(&["D65"]);
    let white = library.find("Lead White").unwrap();
    let black = library.find("Bone Black").unwrap();
    let viridian = library.find("Viridian").unwrap();
    for required in [vec![], vec![(white, None)], vec![(white, Some(0.4)), (black, None)]] {
        for (at_most, least) in [(2, 0.02), (3, 0.1), (4, 0.2)] {
            let mut limits = RecipeLimits::new(&library, conditions.clone(), FilmKind::Hiding);
            limits.allowed.retain(|&pigment| pigment != viridian && pigment.index() < 16);
            limits.required = required.iter().map(required_pigment).collect();
            (limits.at_most, limits.least_share, limits.count) = (at_most, least, 20);
            for wanted in colors_within_limits() {
                let target = Target::from_lab("", wanted, &conditions);
                let found = recipes(&library, &target, &limits, &Task::default()).unwrap();
                assert!(!found.is_empty(), "no recipe for {wanted:?}");
                for recipe in found {
                    let sum: f64 = recipe.shares.iter().map(|(_, share)| share).sum();
                    assert!((sum - 1.0).abs() < 1e-9, "{sum}");
                    assert!(recipe.shares.len() <= at_most, "{recipe:?}");
                    for &(pigment, share) in &recipe.shares {
                        assert!(limits.allowed.contains(&pigment), "{pigment:?} was not allowed");
                        assert!(share >= least - 1e-9, "{share} of {pigment:?}");
                    }
                    for (pigment, given) in &required {
                        let share = recipe.shares.iter().find(|(p, _)| p == pigment).unwrap().1;
                        assert!(given.is_none_or(|given| (given - share).abs() < 1e-9), "{share}");
                    }
                }
            }
        }
    }
}

#[test]
fn a_wider_choice_is_never_farther() {
    let library = oils();
    let conditions = conditions(&["D65"]);
    for wanted in colors_within_limits() {
        let target = Target::from_lab("", wanted, &conditions);
        let mut before = f64::INFINITY;
        for at_most in 1..=4 {
            let mut limits = RecipeLimits::new(&library, conditions.clone(), FilmKind::Hiding);
            (limits.at_most, limits.tolerance) = (at_most, 0.0);
            let nearest =
                recipes(&library, &target, &limits, &Task::default()).unwrap()[0].distance;
            assert!(nearest <= before + 1e-9, "{at_most} pigments: {nearest} after {before}");
            before = nearest;
        }
    }
}

#[test]
fn an_unidentified_pigment_takes_no_part_unless_it_is_asked_for() {
    let library = oils();
    let limits = RecipeLimits::new(&library, conditions(&["D65"]), FilmKind::Hiding);
    let unknown: Vec<PigmentId> = library.ids().filter(|&id| !library[id].identified).collect();
    assert_eq!(unknown.len(), 2);
    assert!(unknown.iter().all(|index| !limits.allowed.contains(index)));
}

#[test]
fn what_no_recipe_can_meet_is_refused() {
    let library = oils();
    let conditions = conditions(&["D65"]);
    let wanted = Target::from_lab("", Lab { lightness: 50.0, a: 0.0, b: 0.0 }, &conditions);
    let good = RecipeLimits::new(&library, conditions.clone(), FilmKind::Hiding);
    let refusal = |change: &dyn Fn(&mut RecipeLimits)| {
        let mut limits = good.clone();
        change(&mut limits);
        recipes(&library, &wanted, &limits, &Task::default()).unwrap_err()
    };
    assert_eq!(refusal(&|r| r.allowed.clear()), MatchError::NoPigments);
    assert_eq!(refusal(&|r| r.conditions.clear()), MatchError::NoLight);
    let numbers: [&dyn Fn(&mut RecipeLimits); 7] = [
        &|r| r.at_most = 0,
        &|r| r.at_most = 9,
        &|r| r.least_share = f64::NAN,
        &|r| r.tolerance = -1.0,
        &|r| r.conditions[0].weight = 0.0,
        &|r| r.costs = vec![-1.0; 20],
        &|r| r.whole_parts = Some(0),
    ];
    for change in numbers {
        assert!(matches!(refusal(change), MatchError::Number { .. }));
    }
    let too_many = MatchError::TooManyRequired { required: 2, at_most: 1 };
    assert_eq!(refusal(&|r| (r.required, r.at_most) = (two(None, None), 1)), too_many);
    for second in [(Some(0.7), Some(0.7)), (Some(1.0), None)] {
        let error = refusal(&|r| r.required = two(second.0, second.1));
        assert!(matches!(error, MatchError::Shares(..)), "{error}");
    }
    assert_eq!(
        refusal(&|r| (r.required, r.whole_parts) =
            (vec![required_pigment(&(PigmentId(0), Some(0.5)))], Some(9))),
        MatchError::SharesInParts
    );
}

#[test]
fn a_least_share_that_leaves_no_room_gives_no_recipe_of_that_size() {
    let library = oils();
    let conditions = conditions(&["D65"]);
    let wanted = Target::from_lab("", Lab { lightness: 50.0, a: 0.0, b: 0.0 }, &conditions);
    let mut limits = RecipeLimits::new(&library, conditions, FilmKind::Hiding);
    limits.least_share = 0.4;
    let found = recipes(&library, &wanted, &limits, &Task::default()).unwrap();
    assert!(found.iter().all(|recipe| recipe.shares.len() <= 2), "{found:?}");
}

#[test]
fn whole_parts_keep_the_least_share() {
    let library = oils();
    let conditions = conditions(&["D65"]);
    let mut limits = RecipeLimits::new(&library, conditions.clone(), FilmKind::Hiding);
    (limits.least_share, limits.whole_parts) = (0.2, Some(12));
    for wanted in colors_within_limits() {
        let target = Target::from_lab("", wanted, &conditions);
        for recipe in recipes(&library, &target, &limits, &Task::default()).unwrap() {
            assert!(recipe.shares.iter().all(|(_, share)| *share >= 0.2 - 1e-9), "{recipe:?}");
        }
    }
}
