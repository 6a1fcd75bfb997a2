//! Scans of known mixtures.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use calibrate::PigmentLibrary;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, Normal};

/// Recipes of the patches, each four columns wide.
pub(crate) const RECIPES: [&[(&str, f64)]; 6] = [
    &[("Lead White", 0.9), ("Ultramarine", 0.1)],
    &[("Lead White", 0.5), ("Viridian", 0.5)],
    &[("Chrome Yellow", 1.0)],
    &[("Chrome Yellow", 0.7), ("Vermilion", 0.3)],
    &[("Vermilion", 1.0)],
    &[("Lead White", 1.0)],
];

/// Writes an ENVI scan of `rows` x 24 pixels of patches with noise, of each pixel's value times `scale`.
pub(crate) fn written(folder: &Path, rows: usize, scale: f64) -> PathBuf {
    let oils = PigmentLibrary::van_gogh_oils();
    let noise = Normal::new(0.0, 0.002).unwrap();
    let mut random = ChaCha8Rng::seed_from_u64(4);
    let mut data = Vec::new();
    for _ in 0..rows {
        for column in 0..24 {
            let mixture =
                oils.mix(oils.recipe(RECIPES[column / 4].iter().copied()).unwrap()).unwrap();
            for value in mixture.hiding(oils.saunderson) {
                let value = (scale * (value + noise.sample(&mut random))) as f32;
                data.extend_from_slice(&value.to_le_bytes());
            }
        }
    }
    let mut nm = String::new();
    for (index, wavelength) in oils.grid.wavelengths_nm().enumerate() {
        write!(nm, "{}{wavelength}", if index == 0 { "" } else { ", " }).unwrap();
    }
    let header = format!(
        "ENVI\nsamples = 24\nlines = {rows}\nbands = {}\nheader offset = 0\ndata type = 4\n\
         interleave = bip\nbyte order = 0\nwavelength units = Nanometers\nwavelength = {{{nm}}}\n",
        oils.grid.count()
    );
    std::fs::write(folder.join("scan.bip"), data).unwrap();
    let path = folder.join("scan.hdr");
    std::fs::write(&path, header).unwrap();
    path
}
