//! Which recipes are shown, and in which order.

use calibrate::matching::{FilmKind, MatchRequest, RecipeMatch, Target, recipes};
use calibrate::{PigmentId, Recipe};
use spectra::color::Lab;

use super::{conditions, oils, target_of};

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
        let mut request = MatchRequest::new(&library, conditions.clone(), FilmKind::Hiding);
        request.tolerance = 1e-3;
        let found = &recipes(&library, &target, &request).unwrap()[0];
        let mut wanted = pigments.to_vec();
        wanted.sort_unstable();
        assert_eq!(sorted(found), wanted, "{names:?}");
        for &(pigment, share) in &recipe {
            let told = found.shares.iter().find(|(p, _)| *p == pigment).unwrap().1;
            assert!((told - share).abs() < 1e-3, "{names:?}: {told} for {share}");
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
    // Errors of the best recipe without ultramarine: under D65, and root mean square of the three
    // lights.
    let apart = |weights: [f64; 3]| {
        let mut conditions = three.clone();
        conditions
            .iter_mut()
            .zip(weights)
            .for_each(|(condition, weight)| condition.weight = weight);
        let mut request = MatchRequest::new(&library, conditions, FilmKind::Hiding);
        request.allowed.retain(|&pigment| pigment != blue);
        let best = recipes(&library, &target, &request).unwrap().remove(0);
        let squares: f64 = best.delta_e.iter().map(|difference| difference * difference).sum();
        (best.delta_e[0], (squares / 3.0).sqrt())
    };
    let daylight = apart([1.0, 1e-9, 1e-9]);
    let all = apart([1.0, 1.0, 1.0]);
    assert!(daylight.0 < all.0, "under daylight: {daylight:?} {all:?}");
    assert!(all.1 < 0.9 * daylight.1, "over three lights: {all:?} for {daylight:?}");
}

#[test]
fn equally_near_recipes_come_with_few_pigments_first_and_cheapest_first_if_priced() {
    let library = oils();
    let conditions = conditions(&["D65"]);
    let target = Target::from_lab("", Lab { lightness: 60.0, a: 5.0, b: 20.0 }, &conditions);
    let mut request = MatchRequest::new(&library, conditions, FilmKind::Hiding);
    (request.tolerance, request.count) = (0.5, 10);
    let nearest =
        |found: &[RecipeMatch]| found.iter().map(|r| r.distance).fold(f64::INFINITY, f64::min);
    let found = recipes(&library, &target, &request).unwrap();
    let equal = |found: &[RecipeMatch]| -> Vec<RecipeMatch> {
        let most = nearest(found) + 0.5;
        found.iter().filter(|recipe| recipe.distance <= most).cloned().collect()
    };
    let equals = equal(&found);
    let smallest = |recipe: &RecipeMatch| recipe.shares.iter().map(|s| s.1).fold(1.0, f64::min);
    let steps = |recipe: &RecipeMatch| ((recipe.distance - nearest(&found)) / 0.05).floor();
    assert!(
        equals.len() > 1
            && equals.is_sorted_by(|a: &RecipeMatch, b: &RecipeMatch| {
                let key = |r: &RecipeMatch| (r.shares.len() as f64, steps(r), -smallest(r));
                key(a) <= key(b)
            }),
        "{equals:?}"
    );

    request.costs = (0..library.pigments.len()).map(|index| (index * 7 % 11) as f64).collect();
    let priced = recipes(&library, &target, &request).unwrap();
    let costs: Vec<f64> = equal(&priced).iter().map(|recipe| recipe.cost.unwrap()).collect();
    assert!(costs.len() > 1 && costs.is_sorted(), "{costs:?}");
    assert!(found.iter().all(|recipe| recipe.cost.is_none()));
}

#[test]
fn a_pigment_that_brings_nothing_is_not_shown() {
    let library = oils();
    let conditions = conditions(&["D65"]);
    let target = Target::from_lab("", Lab { lightness: 60.0, a: 5.0, b: 20.0 }, &conditions);
    let mut request = MatchRequest::new(&library, conditions, FilmKind::Hiding);
    let names = ["Zinc White", "Minium", "Chrome Yellow", "Cobalt Blue", "Viridian", "Bone Black"];
    request.allowed = names.map(|name| library.find(name).unwrap()).to_vec();
    // More than the 56 sets of one to four of six pigments.
    request.count = 100;
    let found = recipes(&library, &target, &request).unwrap();
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
    let request = MatchRequest::new(&library, conditions, FilmKind::Hiding);
    let first = recipes(&library, &target, &request).unwrap();
    assert_eq!(first, recipes(&library, &target, &request).unwrap());
}
