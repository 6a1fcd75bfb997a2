//! Readings of a table as fractions, without noise.

use super::column::Column;
use super::csv_rows::CsvRows;
use super::error::MeasurementError;
use super::heading_row::CsvRow;
use super::scale::{
    DarkReadings, SOUND, Scale, ScaleChoice, is_reflectance, just_below_zero, left_out,
    may_be_left_out, without_ends,
};
use super::table::Reading;

/// Readings of a table on its wavelengths, as fractions.
pub(super) struct ScaledReadings {
    /// Unit of the file.
    pub(super) scale: Scale,
    /// Wavelengths in nm, strictly rising.
    pub(super) wavelengths_nm: Vec<f64>,
    pub(super) readings: Vec<Reading>,
    pub(super) remarks: Vec<String>,
}

impl ScaledReadings {
    /// Converts the readings of `table` to fractions. If the table `is_whole`, noise at the ends of the
    /// wavelengths is cut, and a few readings with a noisy point are left out. Each gives a remark.
    pub(super) fn of(
        table: &CsvRows,
        mut readings: Vec<Reading>,
        choice: ScaleChoice,
        is_whole: bool,
    ) -> Result<Self, MeasurementError> {
        let places = table.columns.iter().enumerate().filter_map(|(index, column)| match column {
            Column::Wavelength(nm) => Some((index, *nm)),
            _ => None,
        });
        let mut places: Vec<(usize, f64)> = places.collect();
        if places.is_sorted_by(|a, b| a.1 > b.1) {
            places.reverse();
            readings.iter_mut().for_each(|reading| reading.reflectance.reverse());
        }
        let mut remarks = Vec::new();
        let scale = match choice {
            ScaleChoice::Known(scale) => scale,
            ScaleChoice::Converted(values) => {
                if let Some((reflectance, words)) = values.conversion() {
                    let all = readings.iter_mut().flat_map(|r| r.reflectance.iter_mut());
                    all.for_each(|value| *value = reflectance(*value));
                    remarks.push(words.to_owned());
                }
                Scale::Fraction
            }
            ScaleChoice::ByFile if table.has_percent_cells => Scale::Percent,
            ScaleChoice::ByFile => {
                let largest: Vec<f64> = readings.iter().map(|r| largest(r, &places)).collect();
                let scale = Scale::of_largest(largest.iter().copied().fold(0.0, f64::max));
                if scale == Scale::Percent {
                    let mut dark = DarkReadings::default();
                    readings
                        .iter()
                        .zip(largest)
                        .for_each(|(r, most)| dark.add(r.row, &r.sample, most));
                    remarks.extend(dark.checked(&table.file)?);
                }
                scale
            }
        };
        let factor = scale.to_fraction();
        for value in readings.iter_mut().flat_map(|reading| &mut reading.reflectance) {
            *value *= factor;
        }
        let wavelengths_nm = places.iter().map(|(_, nm)| *nm).collect();
        let mut scaled = Self { scale, wavelengths_nm, readings, remarks };
        scaled.without_noise(table, &places, is_whole)?;
        scaled.without_negatives();
        Ok(scaled)
    }

    fn without_noise(
        &mut self,
        table: &CsvRows,
        places: &[(usize, f64)],
        is_whole: bool,
    ) -> Result<(), MeasurementError> {
        let nm = &self.wavelengths_nm;
        let mut sound = 0..nm.len();
        // The first impossible value of each reading where readings must be valid.
        let mut noisy: Vec<Option<usize>> = Vec::with_capacity(self.readings.len());
        let mut values = Vec::new();
        for (reading, row) in self.readings.iter().zip(&table.rows) {
            let all = &reading.reflectance;
            let invalid = (0..all.len()).filter(|&index| !is_reflectance(all[index]));
            let invalid: Vec<usize> = invalid.collect();
            let refused = !is_whole || 2 * invalid.len() > all.len();
            if let Some(&first) = invalid.first().filter(|_| refused) {
                return Err(self.impossible(table, row, reading, places, first));
            }
            let (own, inside) = without_ends(nm, invalid.iter().copied());
            if own != (0..nm.len()) {
                let at = invalid[0];
                self.remarks.push(format!(
                    "{}: readings are cut to {} to {} nm, since it reads {} at {} nm (row {})",
                    reading.sample,
                    nm[own.start],
                    nm[own.end - 1],
                    self.in_unit(all[at]),
                    nm[at],
                    reading.row
                ));
            }
            sound = sound.start.max(own.start)..sound.end.min(own.end);
            values.extend(inside.iter().map(|&index| all[index]));
            noisy.push(inside.first().copied());
        }
        let count = noisy.iter().flatten().count();
        let is_fine = may_be_left_out(noisy.len(), count, values.into_iter());
        for ((reading, row), at) in self.readings.iter().zip(&table.rows).zip(&noisy) {
            let Some(at) = *at else { continue };
            if !is_fine {
                return Err(self.impossible(table, row, reading, places, at));
            }
            let value = self.number(reading.reflectance[at]);
            let remark = left_out(&reading.sample, reading.row, nm[at], value, self.scale);
            self.remarks.push(remark);
        }
        let mut noisy = noisy.into_iter();
        self.readings.retain(|_| noisy.next().is_some_and(|at| at.is_none()));
        if sound != (0..nm.len()) {
            for reading in &mut self.readings {
                reading.reflectance = reading.reflectance[sound.clone()].into();
            }
            self.wavelengths_nm = self.wavelengths_nm[sound].to_vec();
        }
        Ok(())
    }

    /// Sets values just below zero to 0.
    fn without_negatives(&mut self) {
        let mut count = 0;
        let mut first = None;
        for reading in &mut self.readings {
            for value in reading.reflectance.iter_mut().filter(|value| **value < 0.0) {
                first.get_or_insert_with(|| reading.sample.clone());
                count += 1;
                *value = 0.0;
            }
        }
        self.remarks.extend(first.map(|first| just_below_zero(&first, count)));
    }

    /// A fraction in the unit of the file.
    fn number(&self, fraction: f64) -> f64 {
        let number = fraction / self.scale.to_fraction();
        // 2.009 of 200.9 %.
        (number * 1e9).round() / 1e9
    }

    fn in_unit(&self, fraction: f64) -> String {
        let sign = if self.scale == Scale::Percent { " %" } else { "" };
        format!("{}{sign}", self.number(fraction))
    }

    fn impossible(
        &self,
        table: &CsvRows,
        row: &CsvRow,
        reading: &Reading,
        places: &[(usize, f64)],
        at: usize,
    ) -> MeasurementError {
        MeasurementError::Reflectance {
            place: table.place(row, places[at].0),
            sample: reading.sample.clone(),
            range: self.scale.range(),
            value: self.number(reading.reflectance[at]),
        }
    }
}

/// Largest value where readings must be valid. If there is no such wavelength, the largest of all.
fn largest(reading: &Reading, places: &[(usize, f64)]) -> f64 {
    let values = reading.reflectance.iter().zip(places);
    let sound = values.filter(|(_, (_, nm))| SOUND.contains(nm)).map(|(value, _)| *value);
    let largest = sound.reduce(f64::max);
    largest.unwrap_or_else(|| reading.reflectance.iter().copied().fold(0.0, f64::max))
}

#[cfg(test)]
mod tests {
    use super::super::table::MeasurementTable;
    use super::*;

    /// Eight samples from 360 to 760 nm in percent, with `value` in the third at `nm`.
    fn read(nm: u32, value: &str) -> Result<MeasurementTable, MeasurementError> {
        let all: Vec<u32> = (0..21).map(|at| 360 + 20 * at).collect();
        let mut text = "sample".to_owned();
        all.iter().for_each(|nm| text += &format!(",{nm}"));
        for sample in 1..=8 {
            text += &format!("\ns{sample}");
            for own in &all {
                let is_bad = sample == 3 && *own == nm;
                text += &format!(",{}", if is_bad { value } else { "40" });
            }
        }
        MeasurementTable::spectra_from_csv("f", text.as_bytes(), ScaleChoice::ByFile)
    }

    #[test]
    fn noise_at_the_ends_is_cut_and_a_noisy_point_costs_its_reading() {
        for (nm, value, start_nm, samples, remark) in [
            (
                380,
                "200.9",
                400.0,
                8,
                "s3: readings are cut to 400 to 760 nm, since it reads 200.9 % at 380 nm (row 4)",
            ),
            (
                740,
                "-5",
                360.0,
                8,
                "s3: readings are cut to 360 to 720 nm, since it reads -5 % at 740 nm (row 4)",
            ),
            (
                560,
                "200.9",
                360.0,
                7,
                "s3 is left out: it reads 200.9 % at 560 nm (row 4), and readings are from 0 to 200 %",
            ),
            (560, "-1.5", 360.0, 8, "s3: 1 reading just below zero counts as 0"),
        ] {
            let found = read(nm, value).unwrap();
            assert_eq!((found.grid.start_nm(), found.readings.len()), (start_nm, samples), "{nm}");
            assert_eq!(found.remarks, [remark]);
        }
    }

    #[test]
    fn mistakes_are_refused_with_sample_and_place() {
        for value in ["4000", "-40"] {
            let error = read(560, value).unwrap_err().to_string();
            let wanted = format!(
                "f, row 4, column `560`: expected a reflectance from 0 to 200 % of s3, found `{value}`"
            );
            assert_eq!(error, wanted);
        }
    }

    #[test]
    fn cells_with_a_sign_are_percent() {
        let text = b"sample,400,410\nBlack,0.5%,0.6 %\nGrey,0.7%,0.8%\n";
        let choice = ScaleChoice::ByFile;
        let found = MeasurementTable::spectra_from_csv("f", text, choice).unwrap();
        assert!((found.readings[1].reflectance[0] - 0.007).abs() < 1e-12);
        let mixed = b"sample,400,410\nBlack,0.5%,0.6\n";
        let error = MeasurementTable::spectra_from_csv("f", mixed, choice).unwrap_err();
        assert!(error.to_string().starts_with("f, row 2, column `410`: expected"), "{error}");
    }
}
