//! A search that others look at.

use std::thread;
use std::time::{Duration, Instant};

use calibrate::matching::{FilmKind, MatchRequest, Target, Watch, recipes, recipes_watched};
use spectra::color::Lab;
use suite::oils::library as oils;

use super::sights;

fn target(request: &MatchRequest) -> Target {
    Target::from_lab("grey", Lab { lightness: 55.0, a: 3.0, b: -6.0 }, &request.sights)
}

#[test]
fn a_watched_search_finds_the_same_and_its_share_ends_at_one() {
    let library = oils();
    for at_most in 1..=4 {
        let plain = MatchRequest::new(&library, sights(&["D65"]), FilmKind::Hiding);
        let whole_parts = (at_most == 3).then_some(12);
        let request = MatchRequest { at_most, whole_parts, ..plain };
        let target = target(&request);
        let watch = Watch::default();
        assert_eq!(watch.share(), 0.0);
        let watched = recipes_watched(&library, &target, &request, &watch).unwrap().unwrap();
        assert_eq!(watched, recipes(&library, &target, &request).unwrap());
        assert_eq!(watch.share(), 1.0, "up to {at_most} pigments");
    }
}

#[test]
fn with_required_pigments_the_share_ends_at_one_too() {
    let library = oils();
    let mut request = MatchRequest::new(&library, sights(&["D65"]), FilmKind::Hiding);
    request.required = vec![(0, None), (3, None)];
    let watch = Watch::default();
    recipes_watched(&library, &target(&request), &request, &watch).unwrap().unwrap();
    assert_eq!(watch.share(), 1.0);
}

#[test]
fn a_search_that_is_stopped_gives_nothing_and_ends_early() {
    let library = oils();
    let mut request = MatchRequest::new(&library, sights(&["D65", "A"]), FilmKind::Hiding);
    request.at_most = 8;
    let target = target(&request);
    let watch = Watch::default();
    watch.stop();
    assert_eq!(recipes_watched(&library, &target, &request, &watch).unwrap(), None);
    assert_eq!(watch.share(), 0.0, "nothing was tried");
    let running = Watch::default();
    thread::scope(|scope| {
        let search = scope.spawn(|| recipes_watched(&library, &target, &request, &running));
        let patience = Instant::now() + Duration::from_secs(60);
        while running.share() == 0.0 && Instant::now() < patience {
            thread::sleep(Duration::from_micros(100));
        }
        running.stop();
        assert_eq!(search.join().unwrap().unwrap(), None);
    });
    assert!(running.share() > 0.0 && running.share() < 1.0, "{}", running.share());
}
