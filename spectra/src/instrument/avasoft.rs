//! Spectra of Avantes AvaSoft's binary files, which hold a value for each pixel of the detector.

use super::error::InstrumentError;
use super::measured::{MeasuredQuantity, MeasuredSpectrum, Role, Unit};
use super::points::{Duplicates, Point, ordered};

/// One spectrum of `values` at the wavelengths `nm` of the pixels. Pixels without a finite value are left
/// out, with a remark.
pub(super) fn of_pixels(
    file: &str,
    name: String,
    quantity: MeasuredQuantity,
    role: Role,
    nm: &[f64],
    values: &[f64],
) -> Result<MeasuredSpectrum, InstrumentError> {
    let points = nm.iter().zip(values).map(|(&nm, &value)| Point { line: 1, nm, value });
    let points: Vec<Point> = points.filter(|point| point.value.is_finite()).collect();
    let dropped = values.len() - points.len();
    let ordered = ordered(file, points, Duplicates::Average)?;
    let one = "wavelength without light of the white is";
    let many = "wavelengths without light of the white are";
    let remark = format!("{} left out", documents::counted_as(dropped, one, many));
    Ok(MeasuredSpectrum {
        name,
        quantity,
        role,
        unit: if quantity == MeasuredQuantity::Counts { Unit::Unstated } else { Unit::Percent },
        wavelengths_nm: ordered.wavelengths_nm,
        values: ordered.values,
        line: 1,
        details: Vec::new(),
        remarks: (dropped > 0).then_some(remark).into_iter().chain(ordered.remarks).collect(),
    })
}

/// The light of the sample relative to that of the white in percent, then the counts of sample, white and
/// dark.
pub(super) fn of_counts(
    file: &str,
    name: &str,
    quantity: MeasuredQuantity,
    nm: &[f64],
    [sample, white, dark]: [&[f64]; 3],
) -> Result<Vec<MeasuredSpectrum>, InstrumentError> {
    let counts = sample.iter().zip(white).zip(dark);
    let ratio = counts.map(|((sample, white), dark)| 100.0 * (sample - dark) / (white - dark));
    let ratio: Vec<f64> = ratio.collect();
    let of = |letter: &str, role, values| {
        of_pixels(file, format!("{name} ({letter})"), MeasuredQuantity::Counts, role, nm, values)
    };
    Ok(vec![
        of_pixels(file, name.to_owned(), quantity, Role::Main, nm, &ratio)?,
        of("S", Role::Sample, sample)?,
        of("R", Role::White, white)?,
        of("D", Role::Dark, dark)?,
    ])
}
