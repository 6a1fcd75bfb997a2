//! Recipe search: `cargo bench -p impasto-pigment --bench matching`.
//!
//! We allow 0.5 s on 2 cores for recipes of up to 4 of 20 pigments. A public Python tool takes about 112 s
//! for 13 pigments.

use divan::{Bencher, black_box};
use documents::Task;
use pigment::evaluate::Viewing;
use pigment::library::PigmentLibrary;
use pigment::matching::{FilmKind, RecipeLimits, Target, Thickness, ViewingCondition, recipes};
use spectra::color::Lab;
use spectra::{Illuminant, Observer};

fn main() {
    divan::main();
}

fn oils() -> PigmentLibrary {
    PigmentLibrary::van_gogh_oils()
}

/// Request for recipes of up to four of all 20 pigments, under the lights named in `lights`.
fn limits(library: &PigmentLibrary, lights: &[&str], film: FilmKind) -> RecipeLimits {
    let conditions = lights.iter().map(|name| {
        let illuminant = Illuminant::named(name).expect("a CIE light");
        ViewingCondition {
            viewing: Viewing { illuminant, observer: Observer::default() },
            weight: 1.0,
        }
    });
    let allowed = library.ids().collect();
    RecipeLimits { allowed, ..RecipeLimits::new(library, conditions.collect(), film) }
}

fn search(bencher: Bencher<'_, '_>, lights: &[&str], change: impl Fn(&mut RecipeLimits)) {
    let library = oils();
    let mut limits = limits(&library, lights, FilmKind::Hiding);
    change(&mut limits);
    let wanted = Lab { lightness: 49.5, a: -12.9, b: -13.5 };
    let target = Target::from_lab("", wanted, &limits.conditions);
    bencher.bench(|| {
        recipes(black_box(&library), &target, &limits, &Task::default()).expect("recipes")
    });
}

#[divan::bench(sample_count = 10)]
fn hiding_one_light(bencher: Bencher<'_, '_>) {
    search(bencher, &["D65"], |_| {});
}

#[divan::bench(sample_count = 10)]
fn hiding_three_lights(bencher: Bencher<'_, '_>) {
    search(bencher, &["D65", "A", "FL11"], |_| {});
}

#[divan::bench(sample_count = 10)]
fn twelve_whole_parts(bencher: Bencher<'_, '_>) {
    search(bencher, &["D65"], |limits| limits.whole_parts = Some(12));
}

#[divan::bench(sample_count = 10)]
fn glaze_of_any_thickness(bencher: Bencher<'_, '_>) {
    search(bencher, &["D65"], |limits| {
        let ground = vec![0.85; 31];
        let thickness = Thickness::Between(0.1, 10.0);
        limits.film = FilmKind::Over { ground, thickness };
    });
}
