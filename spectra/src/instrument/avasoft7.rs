//! Binary files of Avantes AvaSoft 6 and 7: `.ROH`, `.REF` and `.DRK` hold counts, `.TRM` and `.ABS`
//! those of sample, white and dark for each pixel.
//!
//! All numbers have 4 bytes. Layout as published by Avantes and read by Karapetyan (MATLAB, 2011) and
//! the R package lightr: version (60 or 70), the serial number and in version 70 a name (a number for
//! each letter), five coefficients of the wavelength over the pixel, first and last pixel, settings, data.

use super::avasoft::{of_counts, of_pixels};
use super::binary_bytes::BinaryBytes;
use super::error::InstrumentError;
use super::measured::{MeasuredQuantity, MeasuredSpectrum, Role, stem};

const FORMAT: &str = "Avantes AvaSoft 7";

/// Numbers between the coefficients and the pixels in version 60, where the serial number stands there.
const SERIAL: usize = 9;
/// Numbers of serial number and name before the coefficients in version 70.
const NAMES: usize = SERIAL + 64;
/// Numbers between the pixels and the data in either version.
const SETTINGS: [usize; 2] = [2, 19];

pub(super) fn is_binary(bytes: &[u8]) -> bool {
    [60_f32, 70.0].iter().any(|version| bytes.starts_with(&version.to_le_bytes()))
}

pub(super) fn read(file: &str, bytes: &[u8]) -> Result<Vec<MeasuredSpectrum>, InstrumentError> {
    let mut reader = BinaryBytes::new(file, FORMAT, bytes);
    let is_new = reader.f32()? > 65.0;
    if is_new {
        reader.f32s(NAMES)?;
    }
    let coefficients = reader.f32s(5)?;
    if !is_new {
        reader.f32s(SERIAL)?;
    }
    let first = reader.f32()?;
    let last = reader.f32()?;
    reader.f32s(SETTINGS[usize::from(is_new)])?;
    let is_pixel = |pixel: f64| pixel.fract() == 0.0 && (0.0..65536.0).contains(&pixel);
    if !(is_pixel(first) && is_pixel(last) && first <= last) {
        return Err(reader.faulty(format!("it states pixels from {first} to {last}")));
    }
    let count = (last - first) as usize + 1;
    let nm = (0..count).map(|index| {
        let pixel = first + index as f64;
        coefficients.iter().rev().fold(0.0, |sum, coefficient| sum * pixel + coefficient)
    });
    let nm: Vec<f64> = nm.collect();
    let ending = file.rsplit_once('.').map_or("", |(_, ending)| ending).to_ascii_lowercase();
    let stem = stem(file);
    let mut records: Vec<MeasuredSpectrum> = if matches!(ending.as_str(), "trm" | "abs") {
        let data = reader.f32s(3 * count)?;
        let column =
            |place: usize| -> Vec<f64> { data.chunks_exact(3).map(|pixel| pixel[place]).collect() };
        // AvaSoft calls light over that of the white transmittance, though it may be reflected.
        let quantity = MeasuredQuantity::Transmittance;
        of_counts(file, &stem, quantity, &nm, [&column(0), &column(1), &column(2)])?
    } else {
        let counts = MeasuredQuantity::Counts;
        let values = reader.f32s(count)?;
        vec![of_pixels(file, stem, counts, Role::Main, &nm, &values)?]
    };
    let time = reader.f32()?;
    let detail = ("Integration time".to_owned(), format!("{time} ms"));
    records.iter_mut().for_each(|record| record.details.push(detail.clone()));
    records.retain(|record| !record.values.is_empty());
    Ok(records)
}

#[cfg(test)]
pub(super) mod tests {
    use super::super::measured::Unit;
    use super::*;

    /// A file of `version` whose pixels 2 to 4 lie at 400, 450 and 500 nm.
    pub(in super::super) fn avasoft7(version: f32, data: &[f32]) -> Vec<u8> {
        let mut numbers = vec![version];
        numbers.extend(vec![65.0; if version > 65.0 { NAMES } else { 0 }]);
        numbers.extend([300.0, 50.0, 0.0, 0.0, 0.0]);
        numbers.extend(vec![65.0; if version > 65.0 { 0 } else { SERIAL }]);
        numbers.extend([2.0, 4.0]);
        numbers.extend(vec![0.0; SETTINGS[usize::from(version > 65.0)]]);
        numbers.extend(data);
        numbers.extend([20.0, 5.0]);
        numbers.into_iter().flat_map(f32::to_le_bytes).collect()
    }

    /// Sample, white and dark of three pixels; the second has no light.
    const PIXELS: [f32; 9] = [30.0, 110.0, 10.0, 10.0, 10.0, 10.0, 60.0, 110.0, 10.0];

    #[test]
    fn both_versions_are_read() {
        for version in [60.0, 70.0] {
            let bytes = avasoft7(version, &PIXELS);
            assert!(is_binary(&bytes));
            let found = read("a/red.TRM", &bytes).unwrap();
            let names: Vec<&str> = found.iter().map(|record| record.name.as_str()).collect();
            assert_eq!(names, ["red", "red (S)", "red (R)", "red (D)"]);
            assert_eq!(
                (&found[0].wavelengths_nm, &found[0].values),
                (&vec![400.0, 500.0], &vec![20.0, 50.0])
            );
            assert_eq!(
                (found[0].quantity, found[0].unit),
                (MeasuredQuantity::Transmittance, Unit::Percent)
            );
            assert_eq!(found[2].values, [110.0, 10.0, 110.0]);
            assert_eq!(found[0].details[0].1, "20 ms");
            let scope = &read("red.ROH", &avasoft7(version, &PIXELS[..3])).unwrap()[0];
            assert_eq!(
                (scope.quantity, &scope.values),
                (MeasuredQuantity::Counts, &vec![30.0, 110.0, 10.0])
            );
        }
    }

    #[test]
    fn a_file_that_is_cut_anywhere_is_refused_by_name() {
        let bytes = avasoft7(70.0, &PIXELS);
        for length in 4..bytes.len() - 4 {
            let error = read("some.trm", &bytes[..length]).unwrap_err().to_string();
            assert!(error.starts_with("some.trm: faulty Avantes"), "{error}");
        }
        let far = read("f.roh", &avasoft7(70.0, &[]).repeat(2)).unwrap();
        assert_eq!(far[0].values.len(), 3);
    }
}
