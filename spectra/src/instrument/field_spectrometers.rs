//! Field spectrometers: ASD FieldSpec, Spectral Evolution and Spectra Vista.
//!
//! The binary `.asd` file follows "ASD File Format version 8, revision B" (Analytical Spectral
//! Devices). The spectrum follows a header of 484 bytes. From version 2 on a reading of the white
//! follows, with the same state of the instrument, so that their ratio is the reflectance. ASD's
//! programs convert the file to text, and we read that as well.
//!
//! Spectral Evolution `.sed` has lines `Key: value`, a line `Data:`, a line of headings that names
//! wavelength, white and sample, and rows between tabs. Columns are named as DARWin writes them:
//! `Wvl`, `Rad. (Ref.)`, `Rad. (Target)`, `Reflect. %` or `Reflect. [1.0]`, `Tgt./Ref. %`,
//! `Irrad. (Target)`, `Norm. DN (Target)` and `Chan.#`.
//!
//! Spectra Vista `.sig` has a first line in comment signs, lines `key= value`, a line `data=`, and
//! rows of wavelength, white, sample and reflectance in percent. Without the last column the file
//! holds power or counts. Where the software did not remove the overlap of the detectors, the
//! wavelengths go back once or twice beyond 900 nm.

use super::columns::{Axis, ColumnLabel, below, table};
use super::decode::{BinaryBytes, lines};
use super::measured::{InstrumentError, MeasuredSpectrum, Role, Unit, stem};
use super::points::{Duplicates, Point, ordered};
use super::quantity::MeasuredQuantity;

const FORMAT: &str = "ASD FieldSpec";

/// The spectrum begins at this byte.
const SPECTRUM: usize = 484;

/// Numbers below this are a ratio, and larger ones are counts of a detector.
const MOST_RATIO: f64 = 2.5;

/// Whether a binary file is of ASD: its first bytes name the version.
pub(super) fn is_asd_binary(bytes: &[u8]) -> bool {
    let versions = [b"ASD", b"as2", b"as3", b"as4", b"as5", b"as6", b"as7", b"as8"];
    versions.iter().any(|version| bytes.starts_with(*version))
        && bytes[3..bytes.len().min(SPECTRUM)].contains(&0)
}

/// Whether a text was converted from an `.asd` file.
pub(super) fn is_asd_text(text: &str) -> bool {
    lines(text).take(60).any(|(_, line)| line.contains("ASD spectrum file"))
}

pub(super) fn read_asd_binary(
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
        point_lines: ordered.lines,
        details,
        remarks: (dropped > 0).then_some(remark).into_iter().collect(),
    }])
}

fn largest(values: &[f64]) -> f64 {
    values.iter().copied().fold(0.0, f64::max)
}

/// The spectra of text converted from an `.asd` file: one column each below the heading `Wavelength`.
pub(super) fn read_asd_text(
    file: &str,
    text: &str,
) -> Result<Vec<MeasuredSpectrum>, InstrumentError> {
    let Some((at, heading)) = lines(text)
        .find(|(_, line)| line.trim_start().to_ascii_lowercase().starts_with("wavelength"))
    else {
        return Ok(Vec::new());
    };
    let head: String = lines(text).take(at).map(|(_, line)| line.to_owned() + "\n").collect();
    let quantity = quantity(&head);
    let data = below(text, at);
    let table = table(file, &data)?;
    let Some((_, first)) = table.rows.first() else { return Ok(Vec::new()) };
    let names: Vec<&str> = heading.trim().split(['\t', ';', ',']).map(str::trim).collect();
    let width = first.len();
    let details: Vec<(String, String)> = lines(&head)
        .filter_map(|(_, line)| line.split_once(':'))
        .map(|(key, value)| (key.trim().to_owned(), value.trim().to_owned()))
        .filter(|(_, value)| !value.is_empty())
        .collect();
    (1..width)
        .map(|column| {
            let name = match names.get(column) {
                Some(name) if names.len() == width && !name.is_empty() => (*name).to_owned(),
                _ if width > 2 => format!("{} {column}", stem(file)),
                _ => stem(file),
            };
            let label = ColumnLabel { name, quantity, unit: unit(quantity) };
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
    let kind = lines(head).find_map(|(_, line)| line.trim().strip_prefix("Spectrum file is "));
    let stated = kind.map_or(MeasuredQuantity::Unstated, MeasuredQuantity::of_words);
    if head.contains("Data is compared to a white reference") {
        MeasuredQuantity::Reflectance
    } else if head.contains("cosine receptor attached") {
        MeasuredQuantity::Power
    } else if stated == MeasuredQuantity::Unstated
        && head.contains("Data is not compared to a white")
    {
        MeasuredQuantity::Counts
    } else {
        stated
    }
}

/// Whether `line`, which follows the line `before`, holds the headings.
pub(super) fn is_heading(before: &str, line: &str) -> bool {
    before.trim() == "Data:" && (line.starts_with("Wvl") || line.starts_with("Chan.#"))
}

/// The main spectrum of a `.sed` file: reflectance if there is one, otherwise the reading of the sample.
pub(super) fn read_sed(file: &str, text: &str) -> Result<Vec<MeasuredSpectrum>, InstrumentError> {
    let lines: Vec<(usize, &str)> = lines(text).collect();
    let found = lines.windows(2).find(|pair| is_heading(pair[0].1, pair[1].1.trim()));
    let Some([_, (at, headings)]) = found else { return Ok(Vec::new()) };
    let mut headings: Vec<String> =
        headings.trim().split('\t').map(|heading| heading.trim().to_lowercase()).collect();
    let data = below(text, *at);
    let mut table = table(file, &data)?;
    let Some(&(line, ref first)) = table.rows.first() else { return Ok(Vec::new()) };
    let wavelength = headings.iter().position(|heading| heading == "wvl");
    let Some(wavelength) = wavelength.filter(|_| headings.len() == first.len()) else {
        let expected = "a column `Wvl`, and a value for every heading";
        return Err(InstrumentError::line(file, line, expected, lines[line - 1].1));
    };
    table.rows.iter_mut().for_each(|(_, row)| row.swap(0, wavelength));
    headings.swap(0, wavelength);
    let column = |words: &[&str]| {
        headings.iter().position(|heading| words.iter().any(|word| heading.contains(word)))
    };
    let ratio = column(&["reflect", "tgt./ref", "trans"]);
    let Some(chosen) = ratio.or(column(&["(target", "tgt"])) else {
        let expected = "a column of reflectance, or of the target";
        return Err(InstrumentError::line(file, *at, expected, &headings.join(" ")));
    };
    let heading = &headings[chosen];
    let quantity = if heading.contains("dn") {
        MeasuredQuantity::Counts
    } else if heading.contains("trans") {
        MeasuredQuantity::Transmittance
    } else if ratio.is_some() {
        MeasuredQuantity::Reflectance
    } else {
        MeasuredQuantity::Power
    };
    let unit = match heading {
        _ if ratio.is_none() => Unit::Unstated,
        heading if heading.contains('%') => Unit::Percent,
        heading if heading.contains("[1.0]") => Unit::Fraction,
        _ => Unit::Unstated,
    };
    let label = ColumnLabel { name: stem(file), quantity, unit };
    let mut records = vec![table.spectrum(file, chosen, Axis::Nanometres, label)?];
    if let Some(white) = column(&["dn (ref"]) {
        let quantity = MeasuredQuantity::Counts;
        let label =
            ColumnLabel { name: format!("{} (white)", stem(file)), quantity, unit: Unit::Unstated };
        let record = table.spectrum(file, white, Axis::Nanometres, label)?;
        records.push(MeasuredSpectrum { role: Role::White, ..record });
    }
    let stated = lines[..*at].iter().filter_map(|(_, line)| line.split_once(':'));
    let details: Vec<(String, String)> = stated
        .map(|(key, value)| (key.trim().to_owned(), value.trim().to_owned()))
        .filter(|(_, value)| !value.is_empty())
        .collect();
    records.iter_mut().for_each(|record| record.details.clone_from(&details));
    Ok(records)
}

const FIRST: &str = "/*** Spectra Vista";

pub(super) fn is_sig(text: &str) -> bool {
    text.trim_start().starts_with(FIRST)
}

/// Reads a `.sig` file: reflectance, or sample and white, in the band of the first detector.
pub(super) fn read_sig(file: &str, text: &str) -> Result<Vec<MeasuredSpectrum>, InstrumentError> {
    let Some((at, _)) = lines(text).find(|(_, line)| line.trim_start().starts_with("data=")) else {
        return Ok(Vec::new());
    };
    let stated = lines(text).take(at - 1).filter_map(|(_, line)| line.split_once('='));
    let details: Vec<(String, String)> =
        stated.map(|(key, value)| (key.trim().to_owned(), value.trim().to_owned())).collect();
    let units = details.iter().find(|(key, _)| key == "units");
    let units = units.map_or("", |(_, value)| value.as_str());
    let data = below(text, at);
    let mut table = table(file, &data)?;
    let Some(&(line, ref first)) = table.rows.first() else { return Ok(Vec::new()) };
    let width = first.len();
    if !(3..=4).contains(&width) {
        let expected = "wavelength, white, sample and reflectance";
        let text = lines(text).nth(line - 1).map_or("", |(_, line)| line);
        return Err(InstrumentError::line(file, line, expected, text));
    }
    let back = table.rows.windows(2).position(|pair| pair[1].1[0] <= pair[0].1[0]);
    let overlap = back.filter(|&at| table.rows[at].1[0] > 900.0).map(|at| {
        let nm = table.rows[at].1[0];
        table.rows.truncate(at + 1);
        format!("the detectors overlap from {nm} nm on; longer wavelengths are left out")
    });
    let name = stem(file);
    let raw = match MeasuredQuantity::of_words(units) {
        MeasuredQuantity::Unstated => MeasuredQuantity::Counts,
        stated => stated,
    };
    let columns = if width == 4 {
        vec![(3, name, MeasuredQuantity::Reflectance, Unit::Percent, Role::Main)]
    } else {
        let white = format!("{name} (white)");
        vec![
            (2, name, raw, Unit::Unstated, Role::Main),
            (1, white, raw, Unit::Unstated, Role::White),
        ]
    };
    columns
        .into_iter()
        .map(|(column, name, quantity, unit, role)| {
            let label = ColumnLabel { name, quantity, unit };
            let mut record = table.spectrum(file, column, Axis::Nanometres, label)?;
            record.remarks.extend(overlap.clone());
            Ok(MeasuredSpectrum { role, details: details.clone(), ..record })
        })
        .collect()
}

#[cfg(test)]
mod svc_tests {
    use super::*;

    const FILE: &str = "/*** Spectra Vista SIG Data ***/\nname= leaf.sig\nunits= Radiance, Radiance\n\
        data= \n400.0  100.00  10.00  10.00\n500.0  100.00  20.00  20.00\n980.0  1.00  0.5  50\n\
        970.0  1.00  0.5  50\n";

    #[test]
    fn reflectance_in_percent_is_read_up_to_the_overlap() {
        let found = &read_sig("a/leaf.sig", FILE).unwrap()[0];
        assert!(is_sig(FILE));
        assert_eq!((found.name.as_str(), found.line), ("leaf", 5));
        assert_eq!(found.wavelengths_nm, [400.0, 500.0, 980.0]);
        assert_eq!(found.values, [10.0, 20.0, 50.0]);
        assert_eq!((found.quantity, found.unit), (MeasuredQuantity::Reflectance, Unit::Percent));
        assert!(found.remarks[0].contains("980 nm"), "{:?}", found.remarks);
    }

    #[test]
    fn files_without_reflectance_hold_power_or_counts() {
        let text =
            FILE.replace("  10.00\n", "\n").replace("  20.00\n", "\n").replace("  50\n", "\n");
        let found = read_sig("f", &text).unwrap();
        assert_eq!((found[0].quantity, found[1].role), (MeasuredQuantity::Power, Role::White));
        assert_eq!(found[0].values, [10.0, 20.0, 0.5]);
        let found = read_sig("f", &text.replace("Radiance", "Counts")).unwrap();
        assert_eq!(found[0].quantity, MeasuredQuantity::Counts);
    }

    #[test]
    fn faults_name_their_line() {
        for (old, new, at) in [
            ("20.00\n", "x\n", 6),
            ("  20.00\n", "\n", 6),
            ("980.0", "450.0", 7),
            ("400.0  100.00  10.00", "400", 6),
        ] {
            let found = read_sig("f", &FILE.replacen(old, new, 1));
            let Err(InstrumentError::Line { line, .. } | InstrumentError::Order { line, .. }) =
                found
            else {
                panic!("{new}: {found:?}")
            };
            assert_eq!(line, at, "{new}");
        }
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
        assert!(is_asd_binary(&bytes));
        let found = &read_asd_binary("a/Red.asd", &bytes).unwrap()[0];
        assert_eq!(found.wavelengths_nm, [400.0, 500.0, 600.0, 700.0]);
        assert_eq!(found.values, [0.1, 0.2, 0.6, 0.35]);
        assert_eq!((found.quantity, found.unit), (MeasuredQuantity::Reflectance, Unit::Fraction));
        assert_eq!((found.name.as_str(), found.details[1].1.as_str()), ("Red", "paint"));
        let dark =
            read_asd_binary("f", &asd(0, &SAMPLE, Some(&[0.0, 1000.0, 1000.0, 1000.0]))).unwrap();
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
            let found = read_asd_binary("f", &asd(kind, sample, white.map(|w| &w[..]))).unwrap();
            assert_eq!(found[0].quantity, quantity, "{kind}");
            assert_eq!(found[0].values, sample, "{kind}");
        }
    }

    #[test]
    fn a_file_that_is_cut_anywhere_is_refused_by_name() {
        let bytes = asd(0, &SAMPLE, Some(&WHITE));
        let without_white = SPECTRUM + 8 * SAMPLE.len();
        for length in 3..bytes.len() {
            match read_asd_binary("some.asd", &bytes[..length]) {
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
        assert!(is_asd_text(TEXT));
        let found = &read_asd_text("f", TEXT).unwrap()[0];
        assert_eq!((found.name.as_str(), found.line), ("red.asd", 9));
        assert_eq!(found.values, [0.01, 0.02]);
        assert_eq!((found.quantity, found.unit), (MeasuredQuantity::Reflectance, Unit::Fraction));
        let bare = TEXT.replace("is compared", "is not compared");
        assert_eq!(read_asd_text("f", &bare).unwrap()[0].quantity, MeasuredQuantity::Counts);
        let sky = bare.replace("Spectrum file", "There was a remote cosine receptor attached\nx");
        assert_eq!(read_asd_text("f", &sky).unwrap()[0].quantity, MeasuredQuantity::Power);
        let cut = read_asd_text("f", &TEXT.replace("0,02", "0,0x"));
        assert!(matches!(cut, Err(InstrumentError::Line { line: 10, .. })), "{cut:?}");
    }

    const FILE: &str = "Comment:\r\nVersion: 2.4\r\nMeasurement: REFLECTANCE\r\nColumns [4]:\r\nData:\r\n\
        Wvl\tRad. (Ref.)\tRad. (Target)\tReflect. %\r\n400.0\t1.1e-002\t4.5e-005\t10.5\r\n\
        401.0\t1.2e-002\t4.6e-005\t11.5\r\n";

    #[test]
    fn reflectance_is_found_by_its_heading_with_its_unit() {
        let found = &read_sed("a/leaf.sed", FILE).unwrap()[0];
        assert_eq!((found.name.as_str(), found.line), ("leaf", 7));
        assert_eq!(
            (&found.wavelengths_nm, &found.values),
            (&vec![400.0, 401.0], &vec![10.5, 11.5])
        );
        assert_eq!((found.quantity, found.unit), (MeasuredQuantity::Reflectance, Unit::Percent));
        assert!(found.details.contains(&("Version".to_owned(), "2.4".to_owned())));
        let fraction = &read_sed("f", &FILE.replace("Reflect. %", "Reflect. [1.0]")).unwrap()[0];
        assert_eq!(fraction.unit, Unit::Fraction);
        let numbered = FILE.replace("Wvl\t", "Chan.#\tWvl\t").replace("\n40", "\n7\t40");
        assert_eq!(read_sed("f", &numbered).unwrap()[0].wavelengths_nm, [400.0, 401.0]);
    }

    #[test]
    fn power_and_counts_are_no_reflectance() {
        for (heading, quantity) in [
            ("Irrad. (Target)", MeasuredQuantity::Power),
            ("Norm. DN (Target)", MeasuredQuantity::Counts),
        ] {
            let text = FILE.replace("Rad. (Target)\tReflect. %", &format!("x\t{heading}"));
            assert_eq!(read_sed("f", &text).unwrap()[0].quantity, quantity, "{heading}");
        }
        let counts = FILE.replace("Rad. (Ref.)", "Norm. DN (Ref.)");
        assert_eq!(read_sed("f", &counts).unwrap()[1].role, Role::White);
    }

    #[test]
    fn faults_name_their_line() {
        for (old, new, at) in [
            ("11.5", "x", 8),
            ("\t11.5", "", 8),
            ("Reflect. %", "Reflect. %\tmore", 7),
            ("Rad. (Target)\tReflect. %", "x\ty", 6),
        ] {
            let found = read_sed("f", &FILE.replace(old, new));
            let Err(InstrumentError::Line { line, .. }) = found else { panic!("{found:?}") };
            assert_eq!(line, at, "{new}");
        }
    }
}
