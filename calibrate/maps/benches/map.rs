//! Pixels mapped on one core: `cargo bench -p impasto-maps --bench map`.
//!
//! The pixels are simulated with 8 of 18 oils, noise 0.003, and K and S off by 10 %. We map them with
//! this error as the stated one, and with the errors of left-out mixtures.

use divan::counter::ItemsCount;
use divan::{Bencher, black_box};
use documents::Task;
use maps::accuracy::{Painting, PaintingPlan};
use maps::{Book, MapSettings, Mapper, ModelError};
use pigment::PigmentLibrary;

fn main() {
    // The numbers are measured on one core.
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build_global();
    pool.expect("the first pool");
    divan::main();
}

const PIXELS: usize = 4000;

struct Scan {
    mapper: Mapper,
    spectra: Vec<f32>,
}

/// Simulates a scan in the 31 bands of the library, or in `bands` even bands from 400 to 700 nm.
fn scan(bands: usize, model_error: Option<ModelError>) -> Scan {
    let oils = PigmentLibrary::van_gogh_oils();
    let plan = PaintingPlan { pixels: PIXELS, ..PaintingPlan::default() };
    let Painting { spectra, .. } = Painting::simulate(&oils, &oils, &plan);
    let settings = MapSettings { group_alike: false, model_error, ..MapSettings::default() };
    let own: Vec<f64> = oils.grid.wavelengths_nm().collect();
    let (nm, spectra) = if bands == own.len() {
        (own, spectra)
    } else {
        let step = 300.0 / (bands - 1) as f64;
        let nm: Vec<f64> = (0..bands).map(|band| 400.0 + step * band as f64).collect();
        let fine = spectra.chunks_exact(own.len()).flat_map(|pixel| {
            nm.iter().map(|nm| {
                let place = (nm - 400.0) / 10.0;
                let index = (place as usize).min(29);
                let part = (place - index as f64) as f32;
                pixel[index] * (1.0 - part) + pixel[index + 1] * part
            })
        });
        let fine = fine.collect();
        (nm, fine)
    };
    Scan { mapper: Mapper::new(&oils, &nm, &settings).expect("a mapper"), spectra }
}

fn book(scan: &Scan) -> Book {
    scan.mapper.survey(&scan.spectra, &Task::default()).expect("a book")
}

/// Stated error of K and S: 10 %, as in the simulated pixels.
const STATED: Option<ModelError> = Some(ModelError::Stated(0.1));

#[divan::bench(args = [31, 204], sample_count = 5)]
fn map(bencher: Bencher, bands: usize) {
    mapped(bencher, scan(bands, STATED));
}

#[divan::bench(args = [31, 204], sample_count = 5)]
fn map_by_residuals(bencher: Bencher, bands: usize) {
    mapped(bencher, scan(bands, None));
}

fn mapped(bencher: Bencher, scan: Scan) {
    let book = scan.mapper.open_book(&book(&scan)).expect("its own book");
    bencher
        .counter(ItemsCount::new(PIXELS))
        .bench(|| scan.mapper.map(&book, black_box(&scan.spectra), &[]));
}

#[divan::bench(args = [31], sample_count = 5)]
fn whole_search(bencher: Bencher, bands: usize) {
    let scan = scan(bands, STATED);
    bencher.counter(ItemsCount::new(PIXELS)).bench(|| scan.mapper.search(black_box(&scan.spectra)));
}

#[divan::bench(args = [31], sample_count = 5)]
fn whole_search_by_residuals(bencher: Bencher, bands: usize) {
    let scan = scan(bands, None);
    bencher.counter(ItemsCount::new(PIXELS)).bench(|| scan.mapper.search(black_box(&scan.spectra)));
}
