//! Synthetic watercolours on white paper: ladders of every paint and mixtures of every pair. Their
//! K and S are invented. The hard set deviates from Kubelka-Munk theory as real washes do: by
//! errors of amount, uneven films, a surface and noise.

use calibrate::Curves;
use calibrate::measurement::{MeasurementTable, ScaleChoice};
use calibrate::swatch::SwatchSet;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use spectra::Grid;
use spectra::optics::{Specular, Surface, UnevenFilm};

/// Name, then K per mL as a constant plus Gaussian bands (height, centre in nm, standard deviation
/// in nm), then S per mL at 550 nm.
type Paint = (&'static str, f64, &'static [(f64, f64, f64)], f64);

/// Thirteen paints, from transparent (S of 1.5 per mL) to opaque (S of 55 per mL).
const PAINTS: [Paint; 13] = [
    ("cadmium red", 1.0, &[(150.0, 460.0, 75.0)], 45.0),
    ("alizarin", 1.0, &[(120.0, 525.0, 38.0), (35.0, 430.0, 45.0)], 2.0),
    ("burnt sienna", 6.0, &[(90.0, 430.0, 80.0)], 12.0),
    ("lemon yellow", 0.5, &[(80.0, 420.0, 40.0)], 15.0),
    ("cadmium yellow", 0.6, &[(120.0, 430.0, 48.0)], 40.0),
    ("raw sienna", 3.0, &[(55.0, 430.0, 60.0)], 8.0),
    ("sap green", 8.0, &[(50.0, 420.0, 40.0), (45.0, 640.0, 45.0)], 3.0),
    ("cerulean", 2.0, &[(50.0, 640.0, 55.0)], 22.0),
    ("cobalt blue", 2.0, &[(70.0, 590.0, 50.0)], 10.0),
    ("ultramarine", 1.5, &[(100.0, 590.0, 42.0)], 4.0),
    ("prussian blue", 5.0, &[(160.0, 690.0, 95.0)], 1.5),
    ("ivory black", 90.0, &[(10.0, 560.0, 90.0)], 5.0),
    ("chinese white", 0.3, &[(3.0, 390.0, 12.0)], 55.0),
];

/// Readings of films of known amounts, and the K that they were computed with.
#[derive(Debug)]
pub struct Watercolors {
    /// K per mL, by paint and wavelength.
    pub absorption: Vec<Vec<f64>>,
    csv: String,
}

impl Watercolors {
    /// Readings of even films without a surface, as the theory predicts them, without errors.
    #[must_use]
    pub fn exact() -> Self {
        let even = UnevenFilm { surface: Surface::NONE, unevenness: 0.0 };
        Self::made(even, &mut |amount| amount, &mut || 0.0)
    }

    /// Readings with errors: log-normal errors of the amount in the pipette (5 %) and of the amount
    /// that stays on the paper (12 %), films of unevenness 0.5, a surface that the file does not
    /// state, and normal noise of 0.003 in the reflectance.
    #[must_use]
    pub fn hard(seed: u64) -> Self {
        let surface = Surface { k1: 0.01, k2: 0.5, specular: Specular::Included };
        let film = UnevenFilm { surface, unevenness: 0.5 };
        let mut amounts = ChaCha8Rng::seed_from_u64(seed);
        let mut readings = ChaCha8Rng::seed_from_u64(seed + 1);
        fn normal(random: &mut ChaCha8Rng) -> f64 {
            StandardNormal.sample(random)
        }
        Self::made(
            film,
            &mut |amount| {
                let pipette = (0.05 * normal(&mut amounts)).exp();
                // The paper keeps a smaller share of a larger amount: power 0.85, unchanged at 0.04
                // mL.
                let kept: f64 = amount * pipette * (0.12 * normal(&mut amounts)).exp();
                (kept / 0.04).powf(0.85) * 0.04
            },
            &mut || 0.003 * normal(&mut readings),
        )
    }

    /// Swatches read from the measurement file.
    ///
    /// # Panics
    /// If the measurement file is not valid.
    #[must_use]
    pub fn swatches(&self) -> SwatchSet {
        let table =
            MeasurementTable::from_csv("made.csv", self.csv.as_bytes(), ScaleChoice::ByFile);
        SwatchSet::from_table(&table.expect("a sound file")).expect("sound swatches")
    }

    /// The readings as a measurement file in CSV.
    #[must_use]
    pub fn csv(&self) -> &str {
        &self.csv
    }

    fn made(
        film: UnevenFilm,
        laid: &mut dyn FnMut(f64) -> f64,
        noise: &mut dyn FnMut() -> f64,
    ) -> Self {
        let grid = Grid::from_nm(400.0, 10.0, 31).expect("a grid");
        let absorption: Vec<Vec<f64>> = PAINTS
            .iter()
            .map(|&(_, base, bands, _)| {
                let at = grid.wavelengths_nm().map(|nm| {
                    let heights = bands.iter().map(|&(height, middle, width)| {
                        height * (-0.5 * ((nm - middle) / width).powi(2)).exp()
                    });
                    base + heights.sum::<f64>()
                });
                at.collect()
            })
            .collect();
        let scattering: Vec<Vec<f64>> = PAINTS
            .iter()
            .map(|p| grid.wavelengths_nm().map(|nm| p.3 * (nm / 550.0).powf(-0.4)).collect())
            .collect();
        let paper: Vec<f64> = grid
            .wavelengths_nm()
            .map(|nm| 0.86 + 0.04 * (nm - 550.0) / 300.0 - 0.1 * (-(nm - 400.0) / 18.0).exp())
            .collect();

        let mut csv = String::from("sample,film,backing");
        PAINTS.iter().for_each(|paint| csv += &format!(",{}", paint.0));
        grid.wavelengths_nm().for_each(|nm| csv += &format!(",{nm}"));
        let mut row = |name: &str, kind: &str, amounts: &[f64], values: &[f64]| {
            csv += &format!("\n{name},{kind},paper");
            amounts
                .iter()
                .for_each(|a| csv += &if *a > 0.0 { format!(",{a}") } else { ",".into() });
            values.iter().for_each(|v| csv += &format!(",{v:.6}"));
        };
        row("bare", "none", &[0.0; 13], &paper);
        for (number, amounts) in recipes().into_iter().enumerate() {
            let parts = amounts.iter().enumerate().filter(|(_, a)| **a > 0.0).map(|(paint, &a)| {
                (laid(a), absorption[paint].as_slice(), scattering[paint].as_slice())
            });
            let reflectance = Curves::weighted_sum(grid, parts).film(1.0, &paper, film);
            let read: Vec<f64> =
                reflectance.into_iter().map(|r| (r + noise()).clamp(0.0, 1.0)).collect();
            row(&format!("W{number:03}"), "paint", &amounts, &read);
        }
        Self { absorption, csv }
    }
}

/// Amounts in mL of each film: twelve steps of every paint, then every pair of paints in three
/// ratios at three levels.
fn recipes() -> Vec<Vec<f64>> {
    fn with(parts: &[(usize, f64)]) -> Vec<f64> {
        let mut amounts = vec![0.0; PAINTS.len()];
        parts.iter().for_each(|&(paint, amount)| amounts[paint] = amount);
        amounts
    }
    let mut recipes = Vec::new();
    for paint in 0..PAINTS.len() {
        for step in [1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 12, 16] {
            recipes.push(with(&[(paint, 0.01 * f64::from(step))]));
        }
    }
    for first in 0..PAINTS.len() {
        for second in 0..first {
            for (a, b) in [(0.01, 0.01), (0.01, 0.02), (0.02, 0.01)] {
                for level in [1.0, 2.0, 4.0] {
                    recipes.push(with(&[(first, level * a), (second, level * b)]));
                }
            }
        }
    }
    recipes
}
