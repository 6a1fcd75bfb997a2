//! Tristimulus values of 31-band spectra: `cargo bench -p impasto-spectra`.
//! Figures to beat: colour-science 0.4.7, 9.9 million spectra a second.

use divan::counter::ItemsCount;
use spectra::color::Xyz;
use spectra::{Grid, Illuminant, Interpolation, Observer, TristimulusWeights};

fn main() {
    divan::main();
}

#[divan::bench(args = [1_000, 100_000, 1_000_000])]
fn xyz_of_31_bands(bencher: divan::Bencher<'_, '_>, spectra: usize) {
    let grid = Grid::from_nm(400.0, 10.0, 31).expect("a grid");
    let weights = TristimulusWeights::new(
        grid,
        &Illuminant::d65(),
        Observer::default(),
        Interpolation::Sprague,
    )
    .expect("31 wavelengths are enough");
    let reflectances: Vec<f64> = (0..spectra * 31).map(|i| (i % 97) as f64 / 97.0).collect();
    let mut xyz = vec![Xyz::default(); spectra];
    bencher.counter(ItemsCount::new(spectra)).bench_local(|| {
        weights.xyz_of_many(divan::black_box(&reflectances), divan::black_box(&mut xyz));
    });
}
