//! Recipe search with progress, and with cancelling from another thread.

use std::thread;
use std::time::{Duration, Instant};

use calibrate::PigmentId;
use calibrate::matching::{
    FilmKind, MatchRequest, RequiredPigment, SearchControl, Target, recipes, recipes_with_control,
};
use spectra::color::Lab;
use suite::oils::library as oils;

use super::conditions;

fn target(request: &MatchRequest) -> Target {
    Target::from_lab("grey", Lab { lightness: 55.0, a: 3.0, b: -6.0 }, &request.conditions)
}

#[test]
fn a_watched_search_finds_the_same_and_its_share_ends_at_one() {
    let library = oils();
    for at_most in 1..=4 {
        let plain = MatchRequest::new(&library, conditions(&["D65"]), FilmKind::Hiding);
        let whole_parts = (at_most == 3).then_some(12);
        let request = MatchRequest { at_most, whole_parts, ..plain };
        let target = target(&request);
        let control = SearchControl::default();
        assert_eq!(control.progress(), 0.0);
        let watched = recipes_with_control(&library, &target, &request, &control).unwrap().unwrap();
        assert_eq!(watched, recipes(&library, &target, &request).unwrap());
        assert_eq!(control.progress(), 1.0, "up to {at_most} pigments");
    }
}

#[test]
fn with_required_pigments_the_share_ends_at_one_too() {
    let library = oils();
    let mut request = MatchRequest::new(&library, conditions(&["D65"]), FilmKind::Hiding);
    request.required =
        [0, 3].map(|id| RequiredPigment { pigment: PigmentId(id), share: None }).to_vec();
    let control = SearchControl::default();
    recipes_with_control(&library, &target(&request), &request, &control).unwrap().unwrap();
    assert_eq!(control.progress(), 1.0);
}

#[test]
fn a_search_that_is_stopped_gives_nothing_and_ends_early() {
    let library = oils();
    let mut request = MatchRequest::new(&library, conditions(&["D65", "A"]), FilmKind::Hiding);
    request.at_most = 8;
    let target = target(&request);
    let control = SearchControl::default();
    control.cancel();
    assert_eq!(recipes_with_control(&library, &target, &request, &control).unwrap(), None);
    assert_eq!(control.progress(), 0.0, "nothing was tried");
    let running = SearchControl::default();
    thread::scope(|scope| {
        let search = scope.spawn(|| recipes_with_control(&library, &target, &request, &running));
        let patience = Instant::now() + Duration::from_secs(60);
        while running.progress() == 0.0 && Instant::now() < patience {
            thread::sleep(Duration::from_micros(100));
        }
        running.cancel();
        assert_eq!(search.join().unwrap().unwrap(), None);
    });
    assert!(running.progress() > 0.0 && running.progress() < 1.0, "{}", running.progress());
}
