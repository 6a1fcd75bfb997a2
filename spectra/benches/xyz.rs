//! XYZ of spectra with 31 bands: `cargo bench -p impasto-spectra`. For comparison: colour-science
//! 0.4.7 computes 9.9 million spectra a second.

use divan::counter::ItemsCount;
use spectra::color::Xyz;
use spectra::{Grid, Viewing};

fn main() {
    divan::main();
}

#[divan::bench(args = [1_000, 100_000, 1_000_000])]
fn xyz_of_31_bands(bencher: divan::Bencher<'_, '_>, spectra: usize) {
    let grid = Grid::from_nm(400.0, 10.0, 31).expect("the grid is regular");
    let weights = Viewing::default().weights(grid).expect("31 wavelengths are enough");
    let reflectances: Vec<f64> = (0..spectra * 31).map(|i| (i % 97) as f64 / 97.0).collect();
    let mut xyz = vec![Xyz::default(); spectra];
    bencher.counter(ItemsCount::new(spectra)).bench_local(|| {
        let reflectances = divan::black_box(&reflectances).chunks_exact(31);
        for (xyz, reflectance) in divan::black_box(&mut xyz).iter_mut().zip(reflectances) {
            *xyz = weights.xyz(reflectance);
        }
    });
}

#[divan::bench(args = [1_000, 100_000, 1_000_000])]
fn xyz_of_rows_of_31_bands(bencher: divan::Bencher<'_, '_>, spectra: usize) {
    let grid = Grid::from_nm(400.0, 10.0, 31).expect("the grid is regular");
    let weights = Viewing::default().weights(grid).expect("31 wavelengths are enough");
    let reflectances: Vec<f64> = (0..spectra * 31).map(|i| (i % 97) as f64 / 97.0).collect();
    let mut xyz = vec![[0.0; 3]; spectra];
    bencher.counter(ItemsCount::new(spectra)).bench_local(|| {
        weights.xyz_of_rows(divan::black_box(&reflectances), divan::black_box(&mut xyz));
    });
}
