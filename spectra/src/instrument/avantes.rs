//! Files of Avantes AvaSoft: text and the binary formats of versions 6, 7 and 8.
//!
//! Text (.ttt, .trt, .txt) has a few lines on the measurement, a line of headings that starts with `Wave`, a line
//! of units that starts with `[nm]`, then rows of numbers. Next to the processed column there may be columns
//! with the counts of sample, dark and reference.
//!
//! Binary files of versions 6 and 7 hold counts (`.ROH`, `.REF`, `.DRK`), or sample, white and dark for each
//! pixel (`.TRM`, `.ABS`). All numbers have 4 bytes. Layout as published by Avantes and read by Karapetyan
//! (MATLAB, 2011) and the R package lightr: version (60 or 70), the serial number and in version 70 a name (a
//! number for each letter), five coefficients of the wavelength over the pixel, first and last pixel, settings,
//! data.
//!
//! Binary files of version 8 (`.RAW8`, `.RFL8`, `.TRM8`, `.ABS8`, `.IRR8` ..) hold wavelengths and the counts of
//! sample, dark and white. Layout as Avantes described it to the authors of the R package lightr: `AVS82`, the
//! number of spectra, and for each its length, number, mode, serial number and settings, a comment, four tables
//! of 4-byte numbers.

use super::columns::{Axis, ColumnLabel, below, table};
use super::decode::{BinaryBytes, lines};
use super::measured::{InstrumentError, MeasuredSpectrum, Role, Unit, stem};
use super::points::{Duplicates, Point, ordered};
use super::quantity::MeasuredQuantity;

pub(super) fn read_text(file: &str, text: &str) -> Result<Vec<MeasuredSpectrum>, InstrumentError> {
    let lines: Vec<(usize, &str)> = lines(text).collect();
    let heading = lines.windows(2).find(|pair| {
        pair[0].1.trim_start().starts_with("Wave") && pair[1].1.trim_start().starts_with("[nm]")
    });
    let Some([(_, headings), (at, units)]) = heading else { return Ok(Vec::new()) };
    let data = below(text, *at);
    let table = table(file, &data)?;
    let Some((row, first)) = table.rows.first() else { return Ok(Vec::new()) };
    let headings = cells(headings);
    let units = cells(units);
    if headings.len() != first.len() || units.len() != first.len() {
        let expected = "a value for every heading";
        let text = lines[row - 1].1;
        return Err(InstrumentError::line(file, *row, expected, text));
    }
    let counts = ["sample", "dark", "reference", "scope"];
    let is_counts: Vec<bool> =
        headings.iter().map(|it| counts.contains(&it.to_lowercase().as_str())).collect();
    let processed = (1..headings.len()).rev().find(|&column| !is_counts[column]);
    let sample = (1..headings.len()).find(|&c| headings[c].eq_ignore_ascii_case("sample"));
    let column = processed.or(sample).unwrap_or(1);
    let quantity = if is_counts[column] {
        MeasuredQuantity::Counts
    } else {
        MeasuredQuantity::of_words(&format!("{} {}", headings[column], units[column]))
    };
    let unit = if units[column].contains('%') { Unit::Percent } else { Unit::Unstated };
    let label = ColumnLabel { name: stem(file), quantity, unit };
    let mut record = table.spectrum(file, column, Axis::Nanometres, label)?;
    let comments = lines[..*at].iter().filter_map(|(_, line)| line.split_once(':'));
    record.details = comments.map(|(key, value)| (plain(key), plain(value))).collect();
    Ok(vec![record])
}

fn plain(text: &str) -> String {
    text.trim_matches(|c: char| c.is_whitespace() || c == '\0').to_owned()
}

fn cells(line: &str) -> Vec<String> {
    line.trim_end().split([';', '\t']).map(|cell| cell.trim().to_owned()).collect()
}

const FORMAT: &str = "Avantes AvaSoft 7";

/// Version 60 writes the serial number in this many 4-byte numbers, between the coefficients and the pixels.
const SERIAL: usize = 9;
/// Version 70 writes serial number and name in this many 4-byte numbers, before the coefficients.
const NAMES: usize = SERIAL + 64;
/// Count of 4-byte numbers between the pixels and the data, in version 60 and in version 70.
const SETTINGS: [usize; 2] = [2, 19];

pub(super) fn is_avasoft7(bytes: &[u8]) -> bool {
    [60_f32, 70.0].iter().any(|version| bytes.starts_with(&version.to_le_bytes()))
}

pub(super) fn read_avasoft7(
    file: &str,
    bytes: &[u8],
) -> Result<Vec<MeasuredSpectrum>, InstrumentError> {
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
        let [sample, white, dark] = [0, 1, 2].map(|place: usize| -> Vec<f64> {
            data.chunks_exact(3).map(|pixel| pixel[place]).collect()
        });
        // AvaSoft calls the ratio of sample to white transmittance, even if the light is reflected.
        let quantity = MeasuredQuantity::Transmittance;
        of_counts(file, &stem, quantity, &nm, [&sample, &white, &dark])?
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

fn is_pixel(pixel: f64) -> bool {
    pixel.fract() == 0.0 && (0.0..65536.0).contains(&pixel)
}

const AVASOFT8_FORMAT: &str = "Avantes AvaSoft 8";

/// Bytes between the averages and the comment of a measurement: corrections, triggers, times,
/// temperatures and coefficients.
const AVASOFT8_SETTINGS: usize = 25 + 8 + 20 + 40;
/// Length of the comment in bytes.
const COMMENT: usize = 130;
/// Length in bytes of the group behind the tables.
const GROUP: usize = 10;

pub(super) fn is_avasoft8(bytes: &[u8]) -> bool {
    bytes.starts_with(b"AVS8")
}

pub(super) fn read_avasoft8(
    file: &str,
    bytes: &[u8],
) -> Result<Vec<MeasuredSpectrum>, InstrumentError> {
    let mut reader = BinaryBytes::new(file, AVASOFT8_FORMAT, bytes);
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

/// Reads the next spectrum and the counts from which it was made.
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
    reader.take(AVASOFT8_SETTINGS)?;
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

/// One spectrum of `values` at the wavelengths `nm` of the pixels. This leaves out pixels without a
/// finite value and adds a remark.
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
        point_lines: ordered.lines,
        details: Vec::new(),
        remarks: (dropped > 0).then_some(remark).into_iter().chain(ordered.remarks).collect(),
    })
}

/// The light of the sample in percent of the white, then the counts of sample, white and dark.
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
    let mut found = vec![of_pixels(file, name.to_owned(), quantity, Role::Main, nm, &ratio)?];
    for (letter, role, values) in
        [("S", Role::Sample, sample), ("R", Role::White, white), ("D", Role::Dark, dark)]
    {
        let name = format!("{name} ({letter})");
        found.push(of_pixels(file, name, MeasuredQuantity::Counts, role, nm, values)?);
    }
    Ok(found)
}

#[cfg(test)]
pub(super) mod avasoft8_tests {
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
            bytes.extend([0; AVASOFT8_SETTINGS]);
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
            let found = read_avasoft8("a/red.RFL8", &avasoft8(b"AVS82", 1, mode)).unwrap();
            assert_eq!((found[0].quantity, &found[0].values[..]), (quantity, values), "{mode}");
            assert_eq!(found[0].name, "red");
        }
        let found = read_avasoft8("red.RFL8", &avasoft8(b"AVS82", 2, 4)).unwrap();
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
            let error = read_avasoft8("f.IRR8", &bytes).unwrap_err().to_string();
            assert!(error.contains(words) && error.starts_with("f.IRR8: "), "{error}");
        }
        assert!(read_avasoft8("f.RFL8", &avasoft8(b"AVS84", 1, 4)).is_ok());
    }

    #[test]
    fn a_file_that_is_cut_anywhere_is_refused_by_name() {
        let bytes = avasoft8(b"AVS82", 2, 4);
        for length in 5..bytes.len() {
            let error = read_avasoft8("some.rfl8", &bytes[..length]).unwrap_err().to_string();
            assert!(error.starts_with("some.rfl8: faulty Avantes"), "{error}");
        }
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::super::measured::Unit;
    use super::*;

    #[test]
    fn the_processed_column_and_its_unit_are_found() {
        let text = "0804016U1-\r\nIntegration time: 100.00 ms\r\nWave   ;Transmittance\r\n\
            [nm]   ;[% transmittance]\r\n300.00;3.5\r\n301.00;4.5\r\n";
        let found = &read_text("x.ttt", text).unwrap()[0];
        assert_eq!((found.quantity, found.unit), (MeasuredQuantity::Transmittance, Unit::Percent));
        assert_eq!((&found.wavelengths_nm, &found.values), (&vec![300.0, 301.0], &vec![3.5, 4.5]));
        assert_eq!(found.details, [("Integration time".to_owned(), "100.00 ms".to_owned())]);
        let text = "Wave;Sample;Dark;Reference;Reflectance\n[nm];[counts];[counts];[counts];[%]\n\n\
            400,5;10;1;20;47,4\n401,5;11;1;20;52,6\n";
        let found = &read_text("x.txt", text).unwrap()[0];
        assert_eq!((found.line, &found.values), (4, &vec![47.4, 52.6]));
        assert_eq!((found.quantity, found.unit), (MeasuredQuantity::Reflectance, Unit::Percent));
        // Columns of counts may follow the processed one.
        let behind = "Wave;Reflectance;Sample;Dark\n[nm];[%];[counts];[counts]\n\
            400;47;10;1\n401;52;11;1\n";
        assert_eq!(read_text("x.txt", behind).unwrap()[0].values, [47.0, 52.0]);
        let bad = read_text("x.txt", &text.replace("52,6", "?"));
        assert!(matches!(bad, Err(InstrumentError::Line { line: 5, .. })), "{bad:?}");
    }

    /// A file of `version` with pixels 2 to 4 at 400, 450 and 500 nm.
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

    /// Sample, white and dark of three pixels. The second has no light.
    const PIXELS: [f32; 9] = [30.0, 110.0, 10.0, 10.0, 10.0, 10.0, 60.0, 110.0, 10.0];

    #[test]
    fn both_versions_are_read() {
        for version in [60.0, 70.0] {
            let bytes = avasoft7(version, &PIXELS);
            assert!(is_avasoft7(&bytes));
            let found = read_avasoft7("a/red.TRM", &bytes).unwrap();
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
            let scope = &read_avasoft7("red.ROH", &avasoft7(version, &PIXELS[..3])).unwrap()[0];
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
            let error = read_avasoft7("some.trm", &bytes[..length]).unwrap_err().to_string();
            assert!(error.starts_with("some.trm: faulty Avantes"), "{error}");
        }
        let far = read_avasoft7("f.roh", &avasoft7(70.0, &[]).repeat(2)).unwrap();
        assert_eq!(far[0].values.len(), 3);
    }
}
