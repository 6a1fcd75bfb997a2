//! ASD FieldSpec: the binary `.asd` file and the text that ASD's programs convert it to.
//!
//! Layout: "ASD File Format version 8, revision B" (Analytical Spectral Devices). The spectrum
//! follows a header of 484 bytes; from version 2 on a reading of the white follows, with the state
//! of the instrument in which the sample was read, so that their ratio is the reflectance.

use super::axis::Axis;
use super::binary_bytes::BinaryBytes;
use super::columns::{ColumnLabel, below, table};
use super::error::InstrumentError;
use super::measured::{MeasuredQuantity, MeasuredSpectrum, Role, Unit, stem};
use super::points::{Duplicates, Point, ordered};
use super::text::lines;

const FORMAT: &str = "ASD FieldSpec";

/// Byte at which the spectrum begins.
const SPECTRUM: usize = 484;

/// A stored ratio is below this, and counts of a detector are above.
const MOST_RATIO: f64 = 2.5;

/// Whether a binary file is of this format: its first bytes name the version.
pub(super) fn is_binary(bytes: &[u8]) -> bool {
    let versions = [b"ASD", b"as2", b"as3", b"as4", b"as5", b"as6", b"as7", b"as8"];
    versions.iter().any(|version| bytes.starts_with(*version))
        && bytes[3..bytes.len().min(SPECTRUM)].contains(&0)
}

/// Whether a text is the conversion of such a file.
pub(super) fn is_text(text: &str) -> bool {
    lines(text).take(60).any(|(_, line)| line.contains("ASD spectrum file"))
}

/// The spectrum of a binary file.
pub(super) fn read_binary(
    file: &str,
    bytes: &[u8],
) -> Result<Vec<MeasuredSpectrum>, InstrumentError> {
    let mut reader = BinaryBytes::new(file, FORMAT, bytes);
    let comment = reader.seek(3).text(157)?;
    let kind = reader.seek(186).u8()?;
    let start = reader.seek(191).f32()?;
    let step = reader.f32()?;
    let size = reader.u8()?;
    let channels = usize::from(reader.seek(204).u16()?);
    let milliseconds = reader.seek(390).u32()?;
    if !(start.is_finite() && step.is_finite() && start > 0.0 && step > 0.0) || channels == 0 {
        return Err(reader.faulty(format!(
            "its header states {channels} wavelengths from {start} nm in steps of {step} nm"
        )));
    }
    let numbers = |reader: &mut BinaryBytes<'_>| match size {
        0 => reader.f32s(channels),
        2 => reader.f64s(channels),
        other => Err(reader.faulty(format!("its header states numbers of the kind {other}"))),
    };
    let spectrum = numbers(reader.seek(SPECTRUM))?;
    let mut white = None;
    if reader.left() > 0 {
        let is_taken = reader.u16()? != 0;
        reader.take(16)?;
        let description = usize::from(reader.u16()?);
        reader.take(description)?;
        white = is_taken.then(|| numbers(&mut reader)).transpose()?;
    }
    let largest = |values: &[f64]| values.iter().copied().fold(0.0, f64::max);
    let is_ratio = kind == 1 && largest(&spectrum) <= MOST_RATIO;
    let white = white.filter(|white| !(is_ratio && largest(white) > MOST_RATIO));
    let (quantity, values) = match (kind, white) {
        (0 | 1, Some(white)) => {
            let ratio = spectrum.iter().zip(&white).map(|(sample, white)| sample / white);
            (MeasuredQuantity::Reflectance, ratio.collect())
        }
        (1, None) if is_ratio => (MeasuredQuantity::Reflectance, spectrum),
        (0 | 1, None) => (MeasuredQuantity::Counts, spectrum),
        (2 | 4, _) => (MeasuredQuantity::Power, spectrum),
        (6, _) => (MeasuredQuantity::Transmittance, spectrum),
        (8, _) => (MeasuredQuantity::Absorbance, spectrum),
        _ => (MeasuredQuantity::Unstated, spectrum),
    };
    let points = values.iter().enumerate();
    let points =
        points.map(|(index, &value)| Point { line: 1, nm: start + step * index as f64, value });
    let points: Vec<Point> = points.filter(|point| point.value.is_finite()).collect();
    let dropped = channels - points.len();
    if points.is_empty() {
        return Err(reader.faulty("none of its values is a number"));
    }
    let ordered = ordered(file, points, Duplicates::Refuse)?;
    let mut details = vec![("Integration time".to_owned(), format!("{milliseconds} ms"))];
    details.extend((!comment.is_empty()).then(|| ("Comment".to_owned(), comment)));
    let one = "wavelength without light of the white is";
    let many = "wavelengths without light of the white are";
    let remark = format!("{} left out", documents::counted_as(dropped, one, many));
    Ok(vec![MeasuredSpectrum {
        name: stem(file),
        quantity,
        role: Role::Main,
        unit: unit(quantity),
        wavelengths_nm: ordered.wavelengths_nm,
        values: ordered.values,
        line: 1,
        details,
        remarks: (dropped > 0).then_some(remark).into_iter().collect(),
    }])
}

/// The spectra of a converted text: one column each below the heading `Wavelength`.
pub(super) fn read_text(file: &str, text: &str) -> Result<Vec<MeasuredSpectrum>, InstrumentError> {
    let is_heading = |line: &str| line.trim_start().to_ascii_lowercase().starts_with("wavelength");
    let Some((at, heading)) = lines(text).find(|(_, line)| is_heading(line)) else {
        return Ok(Vec::new());
    };
    let head: String = lines(text).take(at).map(|(_, line)| line.to_owned() + "\n").collect();
    let quantity = quantity(&head);
    let data = below(text, at);
    let table = table(file, &data)?;
    let Some((_, first)) = table.rows.first() else { return Ok(Vec::new()) };
    let names: Vec<&str> = heading.trim().split(['\t', ';', ',']).map(str::trim).collect();
    let width = first.len();
    let name = |column: usize| match names.get(column) {
        Some(name) if names.len() == width && !name.is_empty() => (*name).to_owned(),
        _ if width > 2 => format!("{} {column}", stem(file)),
        _ => stem(file),
    };
    let details: Vec<(String, String)> = lines(&head)
        .filter_map(|(_, line)| line.split_once(':'))
        .map(|(key, value)| (key.trim().to_owned(), value.trim().to_owned()))
        .filter(|(_, value)| !value.is_empty())
        .collect();
    (1..width)
        .map(|column| {
            let label = ColumnLabel { name: name(column), quantity, unit: unit(quantity) };
            let record = table.spectrum(file, column, Axis::Nanometres, label)?;
            Ok(MeasuredSpectrum { details: details.clone(), ..record })
        })
        .collect()
}

fn unit(quantity: MeasuredQuantity) -> Unit {
    match quantity {
        MeasuredQuantity::Reflectance | MeasuredQuantity::Transmittance => Unit::Fraction,
        _ => Unit::Unstated,
    }
}

/// The quantity that the lines above a converted spectrum state.
fn quantity(head: &str) -> MeasuredQuantity {
    let has = |words: &str| head.contains(words);
    let kind = lines(head).find_map(|(_, line)| line.trim().strip_prefix("Spectrum file is "));
    let stated = kind.map_or(MeasuredQuantity::Unstated, MeasuredQuantity::of_words);
    if has("Data is compared to a white reference") {
        MeasuredQuantity::Reflectance
    } else if has("cosine receptor attached") {
        MeasuredQuantity::Power
    } else if stated == MeasuredQuantity::Unstated && has("Data is not compared to a white") {
        MeasuredQuantity::Counts
    } else {
        stated
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// A file of version 7 in which `kind` is the stored quantity, with a white if there is one.
    pub(in super::super) fn asd(kind: u8, sample: &[f64], white: Option<&[f64]>) -> Vec<u8> {
        let mut bytes = vec![0; SPECTRUM];
        bytes[..3].copy_from_slice(b"as7");
        bytes[3..8].copy_from_slice(b"paint");
        bytes[186] = kind;
        bytes[191..195].copy_from_slice(&400_f32.to_le_bytes());
        bytes[195..199].copy_from_slice(&100_f32.to_le_bytes());
        bytes[199] = 2;
        bytes[204..206].copy_from_slice(&(sample.len() as u16).to_le_bytes());
        bytes[390] = 34;
        bytes.extend(sample.iter().flat_map(|value| value.to_le_bytes()));
        if let Some(white) = white {
            bytes.extend([255, 255]);
            bytes.extend([0; 16]);
            bytes.extend([3, 0, b'a', b'b', b'c']);
            bytes.extend(white.iter().flat_map(|value| value.to_le_bytes()));
        }
        bytes
    }

    const SAMPLE: [f64; 4] = [100.0, 200.0, 600.0, 700.0];
    const WHITE: [f64; 4] = [1000.0, 1000.0, 1000.0, 2000.0];

    #[test]
    fn counts_are_divided_by_those_of_the_white() {
        let bytes = asd(0, &SAMPLE, Some(&WHITE));
        assert!(is_binary(&bytes));
        let found = &read_binary("a/Red.asd", &bytes).unwrap()[0];
        assert_eq!(found.wavelengths_nm, [400.0, 500.0, 600.0, 700.0]);
        assert_eq!(found.values, [0.1, 0.2, 0.6, 0.35]);
        assert_eq!((found.quantity, found.unit), (MeasuredQuantity::Reflectance, Unit::Fraction));
        assert_eq!((found.name.as_str(), found.details[1].1.as_str()), ("Red", "paint"));
        let dark =
            read_binary("f", &asd(0, &SAMPLE, Some(&[0.0, 1000.0, 1000.0, 1000.0]))).unwrap();
        assert_eq!((dark[0].wavelengths_nm[0], dark[0].remarks.len()), (500.0, 1));
    }

    #[test]
    fn the_stored_kind_is_kept_apart() {
        let ratio = [0.1, 0.2, 0.6, 0.7];
        for (kind, sample, white, quantity) in [
            (0, &SAMPLE, None, MeasuredQuantity::Counts),
            (1, &ratio, None, MeasuredQuantity::Reflectance),
            (1, &ratio, Some(&WHITE), MeasuredQuantity::Reflectance),
            (2, &ratio, Some(&ratio), MeasuredQuantity::Power),
            (4, &ratio, None, MeasuredQuantity::Power),
            (6, &ratio, None, MeasuredQuantity::Transmittance),
            (8, &ratio, None, MeasuredQuantity::Absorbance),
        ] {
            let found = read_binary("f", &asd(kind, sample, white.map(|w| &w[..]))).unwrap();
            assert_eq!(found[0].quantity, quantity, "{kind}");
            assert_eq!(found[0].values, sample, "{kind}");
        }
    }

    #[test]
    fn a_file_that_is_cut_anywhere_is_refused_by_name() {
        let bytes = asd(0, &SAMPLE, Some(&WHITE));
        let without_white = SPECTRUM + 8 * SAMPLE.len();
        for length in 3..bytes.len() {
            match read_binary("some.asd", &bytes[..length]) {
                Err(error) => {
                    assert!(error.to_string().starts_with("some.asd: faulty ASD"), "{error}");
                }
                Ok(found) => {
                    assert_eq!(length, without_white);
                    assert_eq!(found[0].quantity, MeasuredQuantity::Counts);
                }
            }
        }
    }

    const TEXT: &str = "\nText conversion of header file red.asd\nNew ASD spectrum file: Program version = 6.04\n\
        Spectrum saved: 05/21/2024 at 11:24:16\nData is compared to a white reference:\n\
        Spectrum file is raw data with embedded reference\n\nWavelength\tred.asd\n\
        400\t 1,0E-02 \n500\t 0,02 \n";

    #[test]
    fn a_converted_text_states_what_it_holds() {
        assert!(is_text(TEXT));
        let found = &read_text("f", TEXT).unwrap()[0];
        assert_eq!((found.name.as_str(), found.line), ("red.asd", 9));
        assert_eq!(found.values, [0.01, 0.02]);
        assert_eq!((found.quantity, found.unit), (MeasuredQuantity::Reflectance, Unit::Fraction));
        let bare = TEXT.replace("is compared", "is not compared");
        assert_eq!(read_text("f", &bare).unwrap()[0].quantity, MeasuredQuantity::Counts);
        let sky = bare.replace("Spectrum file", "There was a remote cosine receptor attached\nx");
        assert_eq!(read_text("f", &sky).unwrap()[0].quantity, MeasuredQuantity::Power);
        let cut = read_text("f", &TEXT.replace("0,02", "0,0x"));
        assert!(matches!(cut, Err(InstrumentError::Line { line: 10, .. })), "{cut:?}");
    }
}
