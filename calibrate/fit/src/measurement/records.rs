//! Spectra of an instrument's file as readings of paint.

use std::collections::{BTreeMap, BTreeSet};

use spectra::Grid;
use spectra::instrument::{MeasuredQuantity, MeasuredSpectrum, Role, Unit};

use super::error::MeasurementError;
use super::scale::{
    DarkReadings, MEASURABLE_NM, SOUND, Scale, ScaleChoice, is_reflectance, just_below_zero,
    left_out, may_be_left_out, outside_remark, without_ends,
};
use super::table::{Film, MeasurementTable, Reading, grid_of, on_grid, one_geometry};
use spectra::csv_table::CellPlace;

/// Treatment of an instrument's spectra.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct RecordChoice {
    /// Percent or fraction. By default we use what the file states, else what its largest value suggests.
    pub scale: ScaleChoice,
    /// Whether transmittance counts as reflectance. Some programs state transmittance although the
    /// spectrometer measured a surface against a white tile.
    pub transmittance_is_reflectance: bool,
}

impl MeasurementTable {
    /// Reads `records`, the spectra of `file`, as readings of paint. We use only spectra of reflectance, or
    /// of a quantity that the file does not state. The name of a record is the sample. Records of one name
    /// are repeated readings. The table has no pigments and no backings.
    ///
    /// We cut off wavelengths outside 200 to 2500 nm. Outside 400 to 700 nm we cut off the ends of a
    /// spectrum up to their last impossible value. Values down to -2 % count as 0, with a remark. We leave out
    /// a spectrum with a noisy point from 400 to 700 nm, with a remark, if they are few. We refuse the file if
    /// most values of a spectrum are impossible. If spectra have
    /// different wavelengths, we interpolate them to the grid of the coarsest, where all overlap.
    ///
    /// # Errors
    /// [`MeasurementError`] with the line on which the spectrum begins.
    pub fn from_records(
        file: &str,
        records: &[MeasuredSpectrum],
        choice: RecordChoice,
    ) -> Result<Self, MeasurementError> {
        let mut remarks = Vec::new();
        let mut spectra = reflectances(file, records, choice, &mut remarks)?;
        let all_nm = spectra.iter().flat_map(|spectrum| spectrum.wavelengths_nm.iter().copied());
        remarks.extend(outside_remark(all_nm));
        for spectrum in &mut spectra {
            spectrum.cut_to_band(file)?;
        }
        let (scale, dark) = scale(file, &mut spectra, choice.scale)?;
        remarks.extend(dark);
        let noisy = spectra.iter_mut().map(|spectrum| spectrum.cut_noise(file, &mut remarks));
        let noisy: Vec<Option<NoisyPoint>> = noisy.collect::<Result<_, _>>()?;
        leave_out_noisy(file, &mut spectra, noisy, &mut remarks)?;
        let first = &spectra[0];
        let alike = spectra.iter().all(|s| s.wavelengths_nm == first.wavelengths_nm);
        let (grid, count) = if alike {
            (grid_of(&first.wavelengths_nm), first.wavelengths_nm.len())
        } else {
            let (grid, count) = overlap(file, &spectra)?;
            remarks.push(format!("spectra on different wavelengths brought to {grid}"));
            (grid, count)
        };
        remarks.extend(repeated(&spectra));
        let stated = spectra.iter().filter_map(|spectrum| spectrum.record.stated_geometry());
        let (geometry, agree) = one_geometry(stated.collect());
        if !agree {
            let mixed = "some spectra hold the specular reflection and others do not";
            remarks.push(mixed.to_owned());
        }
        let resampled = alike && Grid::through(&first.wavelengths_nm).is_none();
        let readings = spectra.into_iter().map(|spectrum| Reading {
            file: file.into(),
            row: spectrum.record.line as u64,
            sample: name(&spectrum.record.name),
            film: Film::Paint,
            backing: "".into(),
            thickness_mm: None,
            conditions: [].into(),
            amounts: Box::default(),
            reflectance: on_grid(grid, &spectrum.wavelengths_nm, spectrum.values).into(),
        });
        Ok(Self {
            pigments: Vec::new(),
            grid,
            resampled_from: resampled.then_some(count),
            scale,
            geometry,
            readings: readings.collect(),
            remarks,
        })
    }
}

/// A remark if spectra have one name, because readings of one name are averaged.
fn repeated(spectra: &[Spectrum<'_>]) -> Option<String> {
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    for spectrum in spectra {
        *counts.entry(&spectrum.record.name).or_default() += 1;
    }
    let first = spectra.iter().find(|spectrum| counts[spectrum.record.name.as_str()] > 1)?;
    let first = first.record.name.as_str();
    let count = counts[first];
    let samples = documents::counted(counts.len(), "sample");
    let others = counts.values().filter(|count| **count > 1).count() - 1;
    let others = if others > 0 { format!(", and so are {others} others") } else { String::new() };
    Some(format!(
        "{} spectra, {samples}: {} is the mean of {count}{others}",
        spectra.len(),
        name(first)
    ))
}

/// Name for a table: without control characters, and not empty.
fn name(raw: &str) -> String {
    let plain = documents::plain_name(raw);
    if plain.is_empty() { "unnamed".to_owned() } else { plain }
}

struct Spectrum<'a> {
    record: &'a MeasuredSpectrum,
    wavelengths_nm: Vec<f64>,
    values: Vec<f64>,
    /// Unit of the values in the file, and of `values` until [`Self::cut_noise`] converts them to
    /// fractions.
    scale: Scale,
}

/// Selects the records that are readings, and names the others in `remarks`. This fails if no record is a
/// reading.
fn reflectances<'a>(
    file: &str,
    records: &'a [MeasuredSpectrum],
    choice: RecordChoice,
    remarks: &mut Vec<String>,
) -> Result<Vec<Spectrum<'a>>, MeasurementError> {
    let (kept, others): (Vec<&MeasuredSpectrum>, Vec<&MeasuredSpectrum>) =
        records.iter().partition(|record: &&MeasuredSpectrum| match record.quantity {
            _ if record.role != Role::Main => false,
            MeasuredQuantity::Reflectance | MeasuredQuantity::Unstated => true,
            MeasuredQuantity::Transmittance => choice.transmittance_is_reflectance,
            _ => false,
        });
    if kept.is_empty() {
        let Some(record) = others.first() else {
            return Err(MeasurementError::Empty(file.to_owned()));
        };
        return Err(MeasurementError::NoReflectance {
            file: file.to_owned(),
            line: record.line as u64,
            sample: name(&record.name),
            quantity: record.quantity,
            stated: stated_unit(record),
        });
    }
    for record in others.into_iter().filter(|record| record.role == Role::Main) {
        remarks.push(format!("{} is left out, it is {}", name(&record.name), record.quantity));
    }
    // Records with each remark.
    let mut counts: BTreeMap<&String, usize> = BTreeMap::new();
    for record in &kept {
        for remark in record.remarks.iter().collect::<BTreeSet<_>>() {
            *counts.entry(remark).or_default() += 1;
        }
    }
    let mut told: BTreeSet<String> = remarks.iter().cloned().collect();
    for record in &kept {
        for remark in &record.remarks {
            let of_all = counts[remark] == kept.len();
            let text =
                if of_all { remark.clone() } else { format!("{}: {remark}", name(&record.name)) };
            if told.insert(text.clone()) {
                remarks.push(text);
            }
        }
    }
    Ok(kept
        .into_iter()
        .map(|record: &'a MeasuredSpectrum| Spectrum {
            record,
            wavelengths_nm: record.wavelengths_nm.clone(),
            values: record.values.clone(),
            scale: Scale::Fraction,
        })
        .collect())
}

/// Determines the unit of every spectrum, and returns the unit of the first, with a remark on dark ones.
fn scale(
    file: &str,
    spectra: &mut [Spectrum<'_>],
    choice: ScaleChoice,
) -> Result<(Scale, Option<String>), MeasurementError> {
    let stated = |record: &MeasuredSpectrum| match (choice, record.unit) {
        (ScaleChoice::Known(scale), _) => Some(scale),
        // The reader of the file converts the values.
        (ScaleChoice::Converted(_), _) => Some(Scale::Fraction),
        (ScaleChoice::ByFile, Unit::Percent) => Some(Scale::Percent),
        (ScaleChoice::ByFile, Unit::Fraction) => Some(Scale::Fraction),
        (ScaleChoice::ByFile, Unit::Unstated) => None,
    };
    let unstated = spectra.iter().filter(|s| stated(s.record).is_none()).map(Spectrum::largest);
    let found = Scale::of_largest(unstated.fold(0.0, f64::max));
    let mut dark = DarkReadings::default();
    for spectrum in &mut *spectra {
        spectrum.scale = stated(spectrum.record).unwrap_or(found);
        if stated(spectrum.record).is_none() && found == Scale::Percent {
            dark.add(spectrum.record.line as u64, &spectrum.record.name, spectrum.largest());
        }
    }
    let dark = match choice {
        ScaleChoice::ByFile => dark.checked(file)?.or_else(|| all_below_one(spectra)),
        _ => None,
    };
    Ok((spectra[0].scale, dark))
}

/// A remark if all spectra are stated in percent, and no value exceeds 1.
fn all_below_one(spectra: &[Spectrum<'_>]) -> Option<String> {
    let are_percent = spectra.iter().all(|spectrum| spectrum.record.unit == Unit::Percent);
    let largest = spectra.iter().map(Spectrum::largest).fold(0.0, f64::max);
    (are_percent && largest > 0.0 && largest <= 1.2).then(|| {
        format!(
            "the file states percent, but no value exceeds {largest}: it is read as nearly black; set [fraction] if white is near 1, or [percent]"
        )
    })
}

/// The unit that a file states for a quantity that we do not know, as an addition to its name.
fn stated_unit(record: &MeasuredSpectrum) -> String {
    let units = record.details.iter().find(|(key, _)| key == "YUNITS");
    match (record.quantity, units) {
        (MeasuredQuantity::Unknown, Some((_, text))) => format!(" (`{text}`)"),
        _ => String::new(),
    }
}

impl Spectrum<'_> {
    /// Largest value where readings must be valid. If there is none, this is the largest of all values.
    fn largest(&self) -> f64 {
        let all = self.wavelengths_nm.iter().zip(&self.values);
        let sound = all.filter(|(nm, _)| SOUND.contains(nm)).map(|(_, value)| *value);
        let largest = sound.reduce(f64::max);
        largest.unwrap_or_else(|| self.values.iter().copied().fold(0.0, f64::max))
    }

    /// Keeps the points of indices `from` up to, but not including, `to`.
    fn keep(&mut self, from: usize, to: usize) {
        self.wavelengths_nm = self.wavelengths_nm[from..to].to_vec();
        self.values = self.values[from..to].to_vec();
    }

    fn cut_to_band(&mut self, file: &str) -> Result<(), MeasurementError> {
        let start = *MEASURABLE_NM.start();
        let end = *MEASURABLE_NM.end();
        let from = self.wavelengths_nm.partition_point(|nm| *nm < start);
        let to = self.wavelengths_nm.partition_point(|nm| *nm <= end);
        if from >= to {
            return Err(self.no_band(file));
        }
        self.keep(from, to);
        Ok(())
    }

    fn no_band(&self, file: &str) -> MeasurementError {
        let all = &self.record.wavelengths_nm;
        MeasurementError::Band {
            file: file.to_owned(),
            line: self.record.line as u64,
            sample: name(&self.record.name),
            first_nm: all.first().copied().unwrap_or_default(),
            last_nm: all.last().copied().unwrap_or_default(),
        }
    }

    /// Converts the values to fractions. Outside the band in which readings must be valid, we cut off the
    /// ends up to their last impossible value. Returns the point within it that is impossible, if any, with
    /// its value in the unit of the file.
    fn cut_noise(
        &mut self,
        file: &str,
        remarks: &mut Vec<String>,
    ) -> Result<Option<NoisyPoint>, MeasurementError> {
        let factor = self.scale.to_fraction();
        let invalid = self.values.iter().enumerate();
        let invalid = invalid.filter(|(_, value)| !is_reflectance(**value * factor));
        let invalid: Vec<usize> = invalid.map(|(index, _)| index).collect();
        if 2 * invalid.len() > self.values.len() {
            return Err(MeasurementError::Noise {
                file: file.to_owned(),
                line: self.record.line as u64,
                sample: name(&self.record.name),
                range: self.scale.range(),
                count: self.values.len(),
                bad: invalid.len(),
            });
        }
        let (sound, inside) = without_ends(&self.wavelengths_nm, invalid.iter().copied());
        if let Some(&first) = inside.first() {
            let nm = self.wavelengths_nm[first];
            let values = inside.iter().map(|&index| self.values[index] * factor).collect();
            return Ok(Some(NoisyPoint {
                row: self.record.line_at(nm) as u64,
                nm,
                value: self.values[first],
                fractions: values,
            }));
        }
        if !invalid.is_empty() {
            remarks.push(format!(
                "{}: cut to {} to {} nm; beyond, readings are not {}",
                name(&self.record.name),
                tenths(self.wavelengths_nm[sound.start]),
                tenths(self.wavelengths_nm[sound.end - 1]),
                self.scale.range(),
            ));
        }
        self.keep(sound.start, sound.end);
        let below = self.values.iter().filter(|value| **value < 0.0).count();
        if below > 0 {
            remarks.push(just_below_zero(&name(&self.record.name), below));
        }
        self.values.iter_mut().for_each(|value| *value = (*value * factor).max(0.0));
        Ok(None)
    }
}

/// The first impossible value of a spectrum where readings must be valid.
struct NoisyPoint {
    row: u64,
    nm: f64,
    /// In the unit of the file.
    value: f64,
    /// All such values as fractions.
    fractions: Vec<f64>,
}

/// Leaves out the readings with a noisy point, with a remark on each. If they are too many or too far off,
/// this fails.
fn leave_out_noisy(
    file: &str,
    spectra: &mut Vec<Spectrum<'_>>,
    noisy: Vec<Option<NoisyPoint>>,
    remarks: &mut Vec<String>,
) -> Result<(), MeasurementError> {
    let points = || noisy.iter().flatten();
    let values = points().flat_map(|point| point.fractions.iter().copied());
    let is_fine = may_be_left_out(noisy.len(), points().count(), values);
    for (spectrum, point) in spectra.iter().zip(&noisy) {
        let Some(NoisyPoint { row, nm, value, .. }) = point else { continue };
        let sample = name(&spectrum.record.name);
        if !is_fine {
            return Err(MeasurementError::Reflectance {
                place: CellPlace::new(file, *row, &format!("{nm} nm")),
                sample,
                range: spectrum.scale.range(),
                value: *value,
            });
        }
        remarks.push(left_out(&sample, *row, *nm, *value, spectrum.scale));
    }
    let mut noisy = noisy.into_iter();
    spectra.retain(|_| noisy.next().is_some_and(|point| point.is_none()));
    Ok(())
}

fn tenths(nm: f64) -> f64 {
    (10.0 * nm).round() / 10.0
}

/// Grid of the coarsest spectrum where all spectra overlap, and its number of wavelengths there.
fn overlap(file: &str, spectra: &[Spectrum<'_>]) -> Result<(Grid, usize), MeasurementError> {
    let mut latest = &spectra[0];
    let mut earliest = &spectra[0];
    let mut coarsest = &spectra[0];
    for spectrum in spectra {
        latest = if first_nm(spectrum) > first_nm(latest) { spectrum } else { latest };
        earliest = if last_nm(spectrum) < last_nm(earliest) { spectrum } else { earliest };
        coarsest = if step(spectrum) > step(coarsest) { spectrum } else { coarsest };
    }
    let start_nm = first_nm(latest);
    let end_nm = last_nm(earliest);
    let shared = coarsest.wavelengths_nm.iter().filter(|nm| (start_nm..=end_nm).contains(*nm));
    let shared: Vec<f64> = shared.copied().collect();
    if shared.is_empty() {
        return Err(MeasurementError::Apart {
            file: file.to_owned(),
            first: name(&earliest.record.name),
            end_nm,
            second: name(&latest.record.name),
            start_nm,
        });
    }
    Ok((grid_of(&shared), shared.len()))
}

fn step(s: &Spectrum<'_>) -> f64 {
    (last_nm(s) - first_nm(s)) / s.wavelengths_nm.len() as f64
}

fn last_nm(s: &Spectrum<'_>) -> f64 {
    s.wavelengths_nm[s.wavelengths_nm.len() - 1]
}

fn first_nm(s: &Spectrum<'_>) -> f64 {
    s.wavelengths_nm[0]
}

#[cfg(test)]
mod tests {
    use super::*;
    use spectra::instrument::read;

    fn table(text: &str) -> Result<MeasurementTable, MeasurementError> {
        let records = read("f.txt", text.as_bytes(), None).unwrap().spectra;
        MeasurementTable::from_records("f.txt", &records, RecordChoice::default())
    }

    #[test]
    fn columns_of_one_name_are_told() {
        let text = "nm,A:1,B:3,B:3\n400,0.1,0.2,0.4\n410,0.1,0.2,0.4\n420,0.1,0.2,0.4\n";
        let found = table(text).unwrap();
        assert_eq!(found.remarks, ["3 spectra, 2 samples: B:3 is the mean of 2"]);
        assert!(table(&text.replacen("B:3", "B:2", 1)).unwrap().remarks.is_empty());
    }

    #[test]
    fn a_black_column_of_a_table_in_percent_is_percent() {
        let mut text = "nm,black,a,b,c,d\n".to_owned();
        for nm in [400, 410, 420, 430] {
            text += &format!("{nm},0.75,20,30,40,50\n");
        }
        let found = table(&text).unwrap();
        assert_eq!(found.readings[0].reflectance[0], 0.0075);
        let remark = "black is read as at most 0.75 %, since the file is in percent";
        assert_eq!(found.remarks, [remark]);
        let two = text.replace(",20,30", ",0.2,0.3");
        assert!(matches!(table(&two), Err(MeasurementError::MixedScale { .. })));
        // One of three is a black patch, one of two may be either.
        let of = |columns: &str| {
            table(
                &text
                    .lines()
                    .map(|row| {
                        let cells: Vec<&str> = row.split(',').collect();
                        columns
                            .chars()
                            .map(|at| cells[at.to_digit(10).unwrap() as usize])
                            .collect::<Vec<_>>()
                            .join(",")
                            + "\n"
                    })
                    .collect::<String>(),
            )
        };
        assert_eq!(of("0123").unwrap().readings[0].reflectance[0], 0.0075);
        assert!(matches!(of("012"), Err(MeasurementError::MixedScale { .. })));
    }

    #[test]
    fn a_heading_in_percent_above_fractions_is_told() {
        let text = "nm\tReflectance[%]\n400\t0.98\n500\t0.99\n600\t0.99\n700\t0.99\n";
        let found = table(text).unwrap();
        let told = &found.remarks[0];
        assert!(told.contains("no value exceeds 0.99") && told.contains("[fraction]"), "{told}");
        assert_eq!(found.scale, Scale::Percent);
        assert!(table(&text.replace("0.9", "90.")).unwrap().remarks.is_empty());
        let records = read("f.txt", text.as_bytes(), None).unwrap().spectra;
        let scale = ScaleChoice::Known(Scale::Percent);
        let choice = RecordChoice { scale, ..RecordChoice::default() };
        let known = MeasurementTable::from_records("f.txt", &records, choice).unwrap();
        assert!(known.remarks.is_empty(), "{:?}", known.remarks);
    }
}
