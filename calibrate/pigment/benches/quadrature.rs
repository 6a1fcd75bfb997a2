//! Quadratures with effective K and S: `cargo bench -p impasto-pigment --bench quadrature`.
//!
//! We allow 2 s on 2 cores for a library of 60 pigments, which includes reading the library and
//! testing the result on films.

use divan::{Bencher, black_box};
use documents::Task;
use pigment::evaluate::Viewing;
use pigment::library::PigmentLibrary;
use pigment::quadrature::EffectiveQuadrature;
use spectra::{Illuminant, Observer};

fn main() {
    divan::main();
}

fn daylight() -> Viewing {
    let illuminant = Illuminant::named("D65").expect("a CIE light");
    Viewing { illuminant, observer: Observer::default() }
}

/// `count` pigments: the oils, with K and S changed by factors that are smooth over wavelength.
fn pigments(count: usize) -> PigmentLibrary {
    let mut library = PigmentLibrary::van_gogh_oils();
    let oils = library.pigments.clone();
    for number in oils.len()..count {
        let mut pigment = oils[number % oils.len()].clone();
        pigment.name = format!("{} {number}", pigment.name);
        let number = number as f64;
        for (at, k) in pigment.absorption.iter_mut().enumerate() {
            *k *= (0.5 * (0.2 * at as f64 + 2.0 * number).sin()).exp();
        }
        for (at, s) in pigment.scattering.iter_mut().enumerate() {
            *s *= (0.2 * (0.1 * at as f64 + 3.0 * number).sin()).exp();
        }
        library.pigments.push(pigment);
    }
    library
}

#[divan::bench(args = [20, 60], sample_count = 3)]
fn effective(bencher: Bencher<'_, '_>, count: usize) {
    let library = pigments(count);
    bencher.bench(|| {
        EffectiveQuadrature::of(&daylight(), black_box(&library), 8, &Task::default())
            .expect("eight nodes")
    });
}
