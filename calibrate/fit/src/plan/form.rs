//! The empty measurement file of a plan, to be filled in.

use spectra::Grid;

use super::paints::PaintSet;
use pigment::Recipe;

/// Names of the cards on which every film is laid, and which are read bare.
const BACKINGS: [&str; 2] = ["white", "black"];

/// Layout of the empty measurement file.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeasurementForm {
    /// Wavelengths of the columns.
    pub grid: Grid,
    /// Number of readings of each film and card, 1 to 100.
    pub replicates: usize,
}

impl Default for MeasurementForm {
    /// 400 to 700 nm in steps of 10 nm, two readings each.
    fn default() -> Self {
        Self { grid: Grid::from_nm(400.0, 10.0, 31).expect("a regular grid"), replicates: 2 }
    }
}

impl MeasurementForm {
    /// Writes the file: the bare cards, then every swatch over both cards, with the grams of each paint
    /// and empty cells for the readings. `swatches` are names with their grams.
    pub(super) fn csv<'a>(
        &self,
        paints: &PaintSet,
        swatches: impl IntoIterator<Item = (&'a str, &'a Recipe)>,
    ) -> Vec<u8> {
        let mut writer = csv::Writer::from_writer(Vec::new());
        let mut write = |record: Vec<String>| {
            writer.write_record(&record).expect("rows have one length, and memory can be written");
        };
        let fixed = ["sample", "film", "backing", "replicate"].map(str::to_owned);
        let wavelengths = self.grid.wavelengths_nm().map(|nm| nm.to_string());
        write(fixed.into_iter().chain(paints.names.iter().cloned()).chain(wavelengths).collect());
        let mut rows = |sample: &str, film: &str, grams: &Recipe| {
            for backing in BACKINGS {
                for replicate in 1..=self.replicates {
                    let mut row = vec![String::new(); paints.names.len() + self.grid.count() + 4];
                    row[0] = sample.to_owned();
                    row[1] = film.to_owned();
                    row[2] = backing.to_owned();
                    row[3] = replicate.to_string();
                    for (paint, grams) in grams {
                        row[4 + paint.index()] = grams.to_string();
                    }
                    write(row);
                }
            }
        };
        rows("card", "none", &Recipe::default());
        for (sample, grams) in swatches {
            rows(sample, "paint", grams);
        }
        writer.into_inner().expect("memory can be written")
    }
}
