//! Limits of a recipe search: allowed and required pigments, their number, shares, whole parts.

use calibrate::PigmentId;
use calibrate::matching::{FilmKind, MatchError, MatchRequest, RequiredPigment, Target, recipes};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use spectra::color::Lab;

use super::{conditions, oils};

fn required_pigment(&(pigment, share): &(PigmentId, Option<f64>)) -> RequiredPigment {
    RequiredPigment { pigment, share }
}

fn two(first: Option<f64>, second: Option<f64>) -> Vec<RequiredPigment> {
    [(PigmentId(0), first), (PigmentId(1), second)].iter().map(required_pigment).collect()
}

fn colors() -> Vec<Lab> {
    let mut random = ChaCha8Rng::seed_from_u64(5);
    let mut within = |least: f64, most: f64| least + (most - least) * random.random::<f64>();
    (0..12)
        .map(|_| Lab {
            lightness: within(20.0, 90.0),
            a: within(-40.0, 50.0),
            b: within(-50.0, 60.0),
        })
        .collect()
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
            let mut request = MatchRequest::new(&library, conditions.clone(), FilmKind::Hiding);
            request.allowed.retain(|&pigment| pigment != viridian && pigment.index() < 16);
            request.required = required.iter().map(required_pigment).collect();
            (request.at_most, request.least_share, request.count) = (at_most, least, 20);
            for wanted in colors() {
                let target = Target::from_lab("", wanted, &conditions);
                let found = recipes(&library, &target, &request).unwrap();
                assert!(!found.is_empty(), "no recipe for {wanted:?}");
                for recipe in found {
                    let sum: f64 = recipe.shares.iter().map(|(_, share)| share).sum();
                    assert!((sum - 1.0).abs() < 1e-9, "{sum}");
                    assert!(recipe.shares.len() <= at_most, "{recipe:?}");
                    for &(pigment, share) in &recipe.shares {
                        assert!(request.allowed.contains(&pigment), "{pigment:?} was not allowed");
                        assert!(share >= least - 1e-9, "{share} of {pigment:?}");
                    }
                    for (pigment, told) in &required {
                        let share = recipe.shares.iter().find(|(p, _)| p == pigment).unwrap().1;
                        assert!(told.is_none_or(|told| (told - share).abs() < 1e-9), "{share}");
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
    for wanted in colors() {
        let target = Target::from_lab("", wanted, &conditions);
        let mut before = f64::INFINITY;
        for at_most in 1..=4 {
            let mut request = MatchRequest::new(&library, conditions.clone(), FilmKind::Hiding);
            (request.at_most, request.tolerance) = (at_most, 0.0);
            let nearest = recipes(&library, &target, &request).unwrap()[0].distance;
            assert!(nearest <= before + 1e-9, "{at_most} pigments: {nearest} after {before}");
            before = nearest;
        }
    }
}

#[test]
fn an_unidentified_pigment_takes_no_part_unless_it_is_asked_for() {
    let library = oils();
    let request = MatchRequest::new(&library, conditions(&["D65"]), FilmKind::Hiding);
    let unknown: Vec<PigmentId> = library.ids().filter(|&id| !library[id].identified).collect();
    assert_eq!(unknown.len(), 2);
    assert!(unknown.iter().all(|index| !request.allowed.contains(index)));
}

#[test]
fn what_no_recipe_can_meet_is_refused() {
    let library = oils();
    let conditions = conditions(&["D65"]);
    let wanted = Target::from_lab("", Lab { lightness: 50.0, a: 0.0, b: 0.0 }, &conditions);
    let good = MatchRequest::new(&library, conditions.clone(), FilmKind::Hiding);
    let refusal = |change: &dyn Fn(&mut MatchRequest)| {
        let mut request = good.clone();
        change(&mut request);
        recipes(&library, &wanted, &request).unwrap_err()
    };
    assert_eq!(refusal(&|r| r.allowed.clear()), MatchError::NoPigments);
    assert_eq!(refusal(&|r| r.conditions.clear()), MatchError::NoLight);
    let number = |error: MatchError| matches!(error, MatchError::Number { .. });
    assert!(number(refusal(&|r| r.at_most = 0)));
    assert!(number(refusal(&|r| r.at_most = 9)));
    assert!(number(refusal(&|r| r.least_share = f64::NAN)));
    assert!(number(refusal(&|r| r.tolerance = -1.0)));
    assert!(number(refusal(&|r| r.conditions[0].weight = 0.0)));
    assert!(number(refusal(&|r| r.costs = vec![-1.0; 20])));
    assert!(number(refusal(&|r| r.whole_parts = Some(0))));
    let too_many = MatchError::TooManyRequired { required: 2, at_most: 1 };
    assert_eq!(refusal(&|r| (r.required, r.at_most) = (two(None, None), 1)), too_many);
    let shares = |error: MatchError| matches!(error, MatchError::Shares { .. });
    assert!(shares(refusal(&|r| r.required = two(Some(0.7), Some(0.7)))));
    assert!(shares(refusal(&|r| r.required = two(Some(1.0), None))));
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
    let mut request = MatchRequest::new(&library, conditions, FilmKind::Hiding);
    request.least_share = 0.4;
    let found = recipes(&library, &wanted, &request).unwrap();
    assert!(found.iter().all(|recipe| recipe.shares.len() <= 2), "{found:?}");
}

#[test]
fn whole_parts_keep_the_least_share() {
    let library = oils();
    let conditions = conditions(&["D65"]);
    let mut request = MatchRequest::new(&library, conditions.clone(), FilmKind::Hiding);
    (request.least_share, request.whole_parts) = (0.2, Some(12));
    for wanted in colors() {
        let target = Target::from_lab("", wanted, &conditions);
        for recipe in recipes(&library, &target, &request).unwrap() {
            assert!(recipe.shares.iter().all(|(_, share)| *share >= 0.2 - 1e-9), "{recipe:?}");
        }
    }
}
