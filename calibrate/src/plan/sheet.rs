//! The empty measurement file of a plan.

use spectra::Grid;

use super::palette::Palette;
use super::recipe::Recipe;

/// The cards that every film is laid over, and read bare.
const BACKINGS: [&str; 2] = ["white", "black"];

/// What the empty file should ask for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sheet {
    /// The wavelengths.
    pub grid: Grid,
    /// Readings of each film and card, 1 and up.
    pub replicates: usize,
}

/// A name for each recipe, its number first: `07 Cobalt Blue tint 1:4`.
#[must_use]
pub fn sample_names(palette: &Palette, recipes: &[Recipe]) -> Vec<String> {
    let width = recipes.len().to_string().len().max(2);
    let named = |(index, recipe): (usize, &Recipe)| {
        format!("{:0width$} {}", index + 1, recipe.name(palette))
    };
    recipes.iter().enumerate().map(named).collect()
}

impl Sheet {
    /// The file: the bare cards, then every swatch over both cards, with the
    /// `grams` of each paint and no readings.
    #[must_use]
    pub fn csv(
        &self,
        palette: &Palette,
        samples: &[String],
        grams: &[Vec<(usize, f64)>],
    ) -> Vec<u8> {
        let mut writer = csv::Writer::from_writer(Vec::new());
        let mut write = |record: Vec<String>| {
            writer.write_record(&record).expect("rows are of one length, and memory takes them");
        };
        let fixed = ["sample", "film", "backing", "replicate"].map(str::to_owned);
        let wavelengths = self.grid.wavelengths_nm().map(|nm| nm.to_string());
        write(fixed.into_iter().chain(palette.names.iter().cloned()).chain(wavelengths).collect());
        let mut rows = |sample: &str, film: &str, grams: &[(usize, f64)]| {
            for backing in BACKINGS {
                for replicate in 1..=self.replicates {
                    let mut row = vec![String::new(); palette.names.len() + self.grid.count() + 4];
                    row[0] = sample.to_owned();
                    row[1] = film.to_owned();
                    row[2] = backing.to_owned();
                    row[3] = replicate.to_string();
                    for (paint, grams) in grams {
                        row[4 + paint] = grams.to_string();
                    }
                    write(row);
                }
            }
        };
        rows("card", "none", &[]);
        for (sample, grams) in samples.iter().zip(grams) {
            rows(sample, "paint", grams);
        }
        writer.into_inner().expect("memory takes it")
    }
}
