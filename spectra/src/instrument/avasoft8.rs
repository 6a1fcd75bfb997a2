//! Binary files of Avantes AvaSoft 8 (`.RAW8`, `.RFL8`, `.TRM8`, `.ABS8`, `.IRR8` ..): wavelengths and
//! the counts of sample, dark and white.
//!
//! Layout as Avantes told the authors of the R package lightr: `AVS82`, the number of spectra, and for each
//! its length, number, mode, serial number and settings, a comment, four tables of 4-byte numbers.

use super::avasoft::{of_counts, of_pixels};
use super::binary_bytes::BinaryBytes;
use super::error::InstrumentError;
use super::measured::{MeasuredQuantity, MeasuredSpectrum, Role, stem};

const FORMAT: &str = "Avantes AvaSoft 8";

/// Bytes from the settings of a measurement behind its averages to the comment: corrections and triggers,
/// times and temperatures, coefficients.
const SETTINGS: usize = 25 + 8 + 20 + 40;
/// Bytes of the comment, and of the group behind the tables.
const COMMENT: usize = 130;
const GROUP: usize = 10;

pub(super) fn is_binary(bytes: &[u8]) -> bool {
    bytes.starts_with(b"AVS8")
}

pub(super) fn read(file: &str, bytes: &[u8]) -> Result<Vec<MeasuredSpectrum>, InstrumentError> {
    let mut reader = BinaryBytes::new(file, FORMAT, bytes);
    let version = reader.text(5)?;
    let count = reader.u8()?;
    // Later versions have more behind the tables of a spectrum.
    if version != "AVS82" && count > 1 {
        return Err(InstrumentError::NotRead {
            file: file.to_owned(),
            kind: "a file of AvaSoft 8.4 or later with several spectra",
            way: "export it as text (ASCII) in AvaSoft",
        });
    }
    let mut records = Vec::new();
    for number in 1..=count {
        let stem = stem(file);
        let name = if count > 1 { format!("{stem} {number}") } else { stem };
        records.extend(spectrum(file, &mut reader, &name)?);
    }
    Ok(records)
}

/// The next spectrum, with the counts of which it is made.
fn spectrum(
    file: &str,
    reader: &mut BinaryBytes<'_>,
    name: &str,
) -> Result<Vec<MeasuredSpectrum>, InstrumentError> {
    reader.take(5)?;
    let mode = reader.u8()?;
    reader.take(2)?;
    let serial = reader.text(10)?;
    reader.take(65)?;
    let first = reader.u16()?;
    let last = reader.u16()?;
    let milliseconds = reader.f32()?;
    reader.take(4)?;
    let averages = reader.u32()?;
    reader.take(SETTINGS)?;
    let comment = reader.text(COMMENT)?;
    if last < first {
        return Err(reader.faulty(format!("it states pixels from {first} to {last}")));
    }
    if matches!(mode, 5 | 6) {
        return Err(InstrumentError::NotRead {
            file: file.to_owned(),
            kind: "an irradiance of AvaSoft 8, stored as counts",
            way: "export the irradiance as text (ASCII) in AvaSoft; it is the light of a lamp, no reflectance",
        });
    }
    let pixels = usize::from(last - first) + 1;
    let nm = reader.f32s(pixels)?;
    let [sample, dark, white] = [reader.f32s(pixels)?, reader.f32s(pixels)?, reader.f32s(pixels)?];
    reader.take(GROUP)?;
    let mut details = vec![
        ("Serial number".to_owned(), serial),
        ("Integration time".to_owned(), format!("{milliseconds} ms")),
        ("Averages".to_owned(), averages.to_string()),
    ];
    details.extend((!comment.is_empty()).then(|| ("Comment".to_owned(), comment)));
    let quantity = match mode {
        4 => MeasuredQuantity::Reflectance,
        // An absorbance is stored as the same counts.
        1 | 3 => MeasuredQuantity::Transmittance,
        _ => MeasuredQuantity::Counts,
    };
    let mut records = if quantity == MeasuredQuantity::Counts {
        let corrected = sample.iter().zip(&dark);
        let values: Vec<f64> = match mode {
            2 => corrected.map(|(sample, dark)| sample - dark).collect(),
            _ => sample,
        };
        vec![of_pixels(file, name.to_owned(), quantity, Role::Main, &nm, &values)?]
    } else {
        of_counts(file, name, quantity, &nm, [&sample, &white, &dark])?
    };
    records.iter_mut().for_each(|record| record.details.clone_from(&details));
    records.retain(|record| !record.values.is_empty());
    Ok(records)
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// A file of `count` spectra in `mode`, at 400, 450 and 500 nm.
    pub(in super::super) fn avasoft8(version: &[u8; 5], count: u8, mode: u8) -> Vec<u8> {
        let mut bytes = version.to_vec();
        bytes.push(count);
        for _ in 0..count {
            bytes.extend([0, 0, 0, 0, 1, mode, 16, 0]);
            bytes.extend(b"1405123U1\0");
            bytes.extend([0; 65]);
            bytes.extend([2, 0, 4, 0]);
            bytes.extend(20_f32.to_le_bytes());
            bytes.extend([0; 4]);
            bytes.extend(5_u32.to_le_bytes());
            bytes.extend([0; SETTINGS]);
            bytes.extend(b"red");
            bytes.extend([0; COMMENT - 3]);
            let tables: [f32; 12] =
                [400.0, 450.0, 500.0, 30.0, 10.0, 60.0, 10.0, 10.0, 10.0, 110.0, 10.0, 110.0];
            bytes.extend(tables.iter().flat_map(|value| value.to_le_bytes()));
            bytes.extend([0; GROUP]);
        }
        bytes
    }

    #[test]
    fn the_mode_decides_what_the_counts_are() {
        for (mode, quantity, values) in [
            (0, MeasuredQuantity::Counts, &[30.0, 10.0, 60.0][..]),
            (2, MeasuredQuantity::Counts, &[20.0, 0.0, 50.0]),
            (3, MeasuredQuantity::Transmittance, &[20.0, 50.0]),
            (4, MeasuredQuantity::Reflectance, &[20.0, 50.0]),
        ] {
            let found = read("a/red.RFL8", &avasoft8(b"AVS82", 1, mode)).unwrap();
            assert_eq!((found[0].quantity, &found[0].values[..]), (quantity, values), "{mode}");
            assert_eq!(found[0].name, "red");
        }
        let found = read("red.RFL8", &avasoft8(b"AVS82", 2, 4)).unwrap();
        assert_eq!((found[0].name.as_str(), found[4].name.as_str()), ("red 1", "red 2"));
        assert_eq!((found[6].role, &found[6].values), (Role::White, &vec![110.0, 10.0, 110.0]));
        assert_eq!(found[0].details[0].1, "1405123U1");
        assert_eq!(found[0].wavelengths_nm, [400.0, 500.0]);
    }

    #[test]
    fn irradiance_and_later_versions_are_refused_by_name() {
        for (bytes, words) in
            [(avasoft8(b"AVS82", 1, 5), "irradiance"), (avasoft8(b"AVS84", 2, 4), "AvaSoft 8.4")]
        {
            let error = read("f.IRR8", &bytes).unwrap_err().to_string();
            assert!(error.contains(words) && error.starts_with("f.IRR8: "), "{error}");
        }
        assert!(read("f.RFL8", &avasoft8(b"AVS84", 1, 4)).is_ok());
    }

    #[test]
    fn a_file_that_is_cut_anywhere_is_refused_by_name() {
        let bytes = avasoft8(b"AVS82", 2, 4);
        for length in 5..bytes.len() {
            let error = read("some.rfl8", &bytes[..length]).unwrap_err().to_string();
            assert!(error.starts_with("some.rfl8: faulty Avantes"), "{error}");
        }
    }
}
