//! Ocean Optics and Ocean Insight: text of SpectraSuite, OceanView and Jaz, and `.ProcSpec`.
//!
//! Text has lines `Key: value`, then data from `>>>>>Begin` to `>>>>>End` or the end of the file:
//! two columns, or in Jaz files wavelength, dark, reference, sample and processed (W D R S P). With
//! a reference the software writes percent of it (or absorbance) and does not state which. Without
//! one it writes counts. Jaz files contain the counts as well. Only the first line of a Jaz file or
//! the ending (`.JazIrrad`, `.OVIrrad`) says that the values are absolute irradiance.
//!
//! `.ProcSpec` is a zip archive with the file `ps_N.xml`, in which lists of `double` hold
//! wavelengths, counts of sample, white and dark, and the processed spectrum. Element names are
//! those that the R package lightr reads. SpectraSuite writes bytes into the XML that are not text.
//! We leave these out.

use super::columns::{Axis, ColumnLabel, table};
use super::decode::{Archive, Decimal, lines, required_number};
use super::measured::{InstrumentError, MeasuredSpectrum, Role, Unit, stem};
use super::points::{Duplicates, Point, ordered};
use super::quantity::MeasuredQuantity;
use super::xml::{Element, parse};

pub(super) fn read_text(file: &str, text: &str) -> Result<Vec<MeasuredSpectrum>, InstrumentError> {
    let mut blocks: Vec<Vec<MeasuredSpectrum>> = Vec::new();
    let mut details: Vec<(String, String)> = Vec::new();
    // Lines outside the data are left empty, so that the others keep their line numbers.
    let mut data: Option<String> = None;
    let mut last = 0;
    let ending = file.rsplit_once('.').map_or("", |(_, ending)| ending).to_ascii_lowercase();
    let first = text.trim_start().lines().next().unwrap_or_default().to_ascii_lowercase();
    let is_irradiance = ending.ends_with("irrad") || first.contains("irradiance");
    for (number, line) in lines(text) {
        last = number;
        if line.starts_with(">>>>>Begin") {
            if let Some(data) = data.take() {
                blocks.push(spectra(file, &data, std::mem::take(&mut details), number)?);
            }
            data = Some("\n".repeat(number));
        } else if line.starts_with(">>>>>End") {
            if let Some(data) = data.take() {
                blocks.push(spectra(file, &data, std::mem::take(&mut details), number)?);
            }
        } else if let Some(data) = &mut data {
            data.push_str(line);
            data.push('\n');
        } else if let Some((key, value)) = line.split_once(':') {
            details.push((key.trim().to_owned(), value.trim().to_owned()));
        }
    }
    if let Some(data) = data {
        blocks.push(spectra(file, &data, details, last)?);
    }
    blocks.retain(|block| !block.is_empty());
    if is_irradiance {
        for block in &mut blocks {
            block[0].quantity = MeasuredQuantity::Power;
        }
    }
    if blocks.len() > 1 {
        let name = stem(file);
        for (block, number) in blocks.iter_mut().zip(1..) {
            for record in block {
                record.name.insert_str(name.len(), &format!(" {number}"));
            }
        }
    }
    Ok(blocks.into_iter().flatten().collect())
}

/// The spectra of one block of data, the main one first. The block ends before line `end`.
fn spectra(
    file: &str,
    data: &str,
    details: Vec<(String, String)>,
    end: usize,
) -> Result<Vec<MeasuredSpectrum>, InstrumentError> {
    let detail = |start: &str| {
        let found = details.iter().find(|(key, _)| key.starts_with(start));
        found.map(|(_, value)| value.as_str())
    };
    let table = table(file, data)?;
    let stated_count = detail("Number of Pixels").and_then(|count| count.parse::<usize>().ok());
    let found = table.rows.len();
    if let Some(expected) = stated_count.filter(|count| *count > found) {
        let file = file.to_owned();
        let what = "pixels";
        return Err(InstrumentError::Count { file, line: end, what, expected, found });
    }
    let Some((_, first)) = table.rows.first() else { return Ok(Vec::new()) };
    let letters = table.above.last().map_or(Vec::new(), |line| line.split_whitespace().collect());
    let column_of = |letter: &str| {
        let column = letters.iter().position(|l| *l == letter);
        column.filter(|column| *column < first.len())
    };
    let is_missing = |start: &str| detail(start).is_some_and(|word| word == "No");
    let raw = is_missing("Reference Spectrum Present") || is_missing("Processed Spectrum Present");
    let main = if raw { "S" } else { "P" };
    let record = |column, name, quantity, role| {
        let label = ColumnLabel { name, quantity, unit: Unit::Unstated };
        let record = table.spectrum(file, column, Axis::Nanometres, label)?;
        Ok(MeasuredSpectrum { role, details: details.clone(), ..record })
    };
    let quantity = if raw { MeasuredQuantity::Counts } else { MeasuredQuantity::Unstated };
    let column = column_of(main).unwrap_or(first.len() - 1);
    let mut records = vec![record(column, stem(file), quantity, Role::Main)?];
    // OceanView joins spectra and states the number of pixels of the first.
    if let Some(count) = stated_count.filter(|count| *count < found) {
        let remark = format!("the file states {count} pixels and has {found}");
        records[0].remarks.push(remark);
    }
    for (letter, role, kind) in [
        ("S", Role::Sample, "Sample Spectrum Present"),
        ("R", Role::White, "Reference Spectrum Present"),
        ("D", Role::Dark, "Dark Spectrum Present"),
    ] {
        // An absent spectrum is a column of zeros.
        if let Some(column) = column_of(letter).filter(|_| letter != main && !is_missing(kind)) {
            let name = format!("{} ({letter})", stem(file));
            records.push(record(column, name, MeasuredQuantity::Counts, role)?);
        }
    }
    Ok(records)
}

const FORMAT: &str = "Ocean Optics ProcSpec";

/// Whether the file of an archive holds the spectrum.
pub(super) fn is_spectrum(name: &str) -> bool {
    let number = name.strip_prefix("ps_").and_then(|rest| rest.strip_suffix(".xml"));
    number.is_some_and(|number| number.bytes().all(|byte| byte.is_ascii_digit()))
}

pub(super) fn read_procspec(
    file: &str,
    bytes: &[u8],
) -> Result<Vec<MeasuredSpectrum>, InstrumentError> {
    let mut archive = Archive::open(file, bytes)?;
    let Some(name) = archive.find(is_spectrum) else {
        return Err(InstrumentError::faulty(file, FORMAT, "it has no file `ps_N.xml`"));
    };
    let text: String = archive
        .read(&name)?
        .into_iter()
        .filter(|byte| byte.is_ascii_graphic() || b" \n\r\t".contains(byte))
        .map(char::from)
        .collect();
    let root = parse(file, &text)?;
    let white_element = find(&root, "referenceSpectrum", &[]);
    let dark_element = find(&root, "darkSpectrum", &[]);
    let apart = ["referenceSpectrum", "darkSpectrum"];
    let all = |name: &str| {
        let mut found = Vec::new();
        places(&mut vec![&root], name, &apart, &mut found);
        found.iter().map(|place| resolved(place)).collect::<Vec<Option<&Element>>>()
    };
    let first = |name: &str| numbers(file, all(name).first().copied().flatten());
    let nm = first("channelWavelengths")?;
    let sample = first("pixelValues")?;
    // Every step of processing has pixels of its own. The last step gives the result, which is that of the
    // sample if nothing was processed.
    let last = all("processedPixels").last().copied().flatten();
    let last = last.filter(|element| element.name == "processedPixels");
    let processed = numbers(file, last)?;
    let [white, dark] = [white_element, dark_element].map(|element| {
        numbers(file, element.and_then(|element| find(element, "pixelValues", &[])))
    });
    let white = white?;
    let dark = dark?;
    let quantity = if has_irradiance(&root) {
        MeasuredQuantity::Power
    } else if processed.is_empty() {
        MeasuredQuantity::Counts
    } else {
        MeasuredQuantity::Unstated
    };
    let mut details = Vec::new();
    for key in
        ["userName", "spectrometerSerialNumber", "integrationTime", "scansToAverage", "boxcarWidth"]
    {
        let found = find(&root, key, &apart);
        details.extend(found.map(|element| (key.to_owned(), element.text.trim().to_owned())));
    }
    let has_white = if white.is_empty() { "No" } else { "Yes" };
    details.push(("Reference Spectrum Present".to_owned(), has_white.to_owned()));
    let stem = stem(file);
    let mut records = Vec::new();
    let main = if processed.is_empty() { &sample } else { &processed };
    let counts = MeasuredQuantity::Counts;
    for (values, name, quantity, role) in [
        (main, stem.clone(), quantity, Role::Main),
        (&sample, format!("{stem} (S)"), counts, Role::Sample),
        (&white, format!("{stem} (R)"), counts, Role::White),
        (&dark, format!("{stem} (D)"), counts, Role::Dark),
    ] {
        if values.is_empty() || (processed.is_empty() && role == Role::Sample) {
            continue;
        }
        if values.len() != nm.len() {
            let fault =
                format!("{} wavelengths for the {} values of {name}", nm.len(), values.len());
            return Err(InstrumentError::faulty(file, FORMAT, fault));
        }
        let points = nm.iter().zip(values);
        let points = points.map(|(&(line, nm), &(_, value))| Point { line, nm, value });
        let ordered = ordered(file, points.collect(), Duplicates::Average)?;
        records.push(MeasuredSpectrum {
            name,
            quantity,
            role,
            unit: Unit::Unstated,
            wavelengths_nm: ordered.wavelengths_nm,
            values: ordered.values,
            line: values[0].0,
            point_lines: ordered.lines,
            details: details.clone(),
            remarks: ordered.remarks,
        });
    }
    Ok(records)
}

fn numbers(file: &str, element: Option<&Element>) -> Result<Vec<(usize, f64)>, InstrumentError> {
    element.map_or_else(|| Ok(Vec::new()), |element| doubles(file, element))
}

/// Finds every descendant called `name` outside the elements `apart`, each with the elements that hold it,
/// from the root on. `within` holds the elements down to the one that we search.
fn places<'a>(
    within: &mut Vec<&'a Element>,
    name: &str,
    apart: &[&str],
    found: &mut Vec<Vec<&'a Element>>,
) {
    let Some(element) = within.last().copied() else { return };
    for child in &element.children {
        within.push(child);
        if child.name == name {
            found.push(within.clone());
        } else if !apart.contains(&child.name.as_str()) {
            places(within, name, apart, found);
        }
        within.pop();
    }
}

/// References that refer to references are followed so often.
const MOST_REFERENCES: usize = 16;

/// The element at a place, or the one that its attribute `reference` names. XStream, which wrote the file,
/// writes an object once and then refers to it by a path such as `../../b/c[2]`. `None` if there is no
/// such element.
fn resolved<'a>(place: &[&'a Element]) -> Option<&'a Element> {
    let mut place = place.to_vec();
    for _ in 0..MOST_REFERENCES {
        let element = *place.last()?;
        let Some(path) = element.attribute("reference") else { return Some(element) };
        if path.starts_with('/') {
            place.truncate(1);
        }
        // The first part of an absolute path is the root itself.
        let skipped = if path.starts_with('/') { 2 } else { 0 };
        for part in path.split('/').skip(skipped) {
            if part == ".." {
                place.pop();
                continue;
            }
            let (name, number) = match part.split_once('[') {
                Some((name, number)) => (name, number.trim_end_matches(']').parse().ok()?),
                None => (part, 1_usize),
            };
            place.push(place.last()?.all(name).nth(number.checked_sub(1)?)?);
        }
    }
    None
}

/// The first descendant called `name` outside the elements `apart`.
fn find<'a>(element: &'a Element, name: &str, apart: &[&str]) -> Option<&'a Element> {
    element.children.iter().find_map(|child| {
        if child.name == name {
            Some(child)
        } else if apart.contains(&child.name.as_str()) {
            None
        } else {
            find(child, name, apart)
        }
    })
}

/// Line and value of every `double` in an element.
fn doubles(file: &str, element: &Element) -> Result<Vec<(usize, f64)>, InstrumentError> {
    let mut found = Vec::new();
    for child in &element.children {
        if child.name == "double" {
            let value = required_number(file, child.line, "a number", &child.text, Decimal::Point)?;
            found.push((child.line, value));
        } else {
            found.extend(doubles(file, child)?);
        }
    }
    Ok(found)
}

/// Whether the spectrum was processed to irradiance. The class of a processor tells us.
fn has_irradiance(element: &Element) -> bool {
    let class = element.attribute("class").unwrap_or_default();
    class.to_ascii_lowercase().contains("irradiance") || element.children.iter().any(has_irradiance)
}

#[cfg(test)]
pub(super) mod tests {
    use super::super::decode::tests::archive;
    use super::super::measured::choose_spectrum;
    use super::*;

    #[test]
    fn two_columns_with_decimal_commas() {
        let text = "SpectraSuite Data File\r\nUser: A\r\nReference Spectrum Present: Yes\r\n\
            Number of Pixels in Processed Spectrum: 2\r\n>>>>>Begin Processed Spectral Data<<<<<\r\n\
            400,25\t12,5\r\n401,5\t1,2E1\r\n>>>>>End Processed Spectral Data<<<<<\r\n";
        let found = &read_text("d/Red.txt", text).unwrap()[0];
        assert_eq!((found.name.as_str(), found.line), ("Red", 6));
        assert_eq!(found.quantity, MeasuredQuantity::Unstated);
        assert_eq!(
            (&found.wavelengths_nm, &found.values),
            (&vec![400.25, 401.5], &vec![12.5, 12.0])
        );
        let raw = &read_text("d/Red.txt", &text.replace("Yes", "No")).unwrap()[0];
        assert_eq!(raw.quantity, MeasuredQuantity::Counts);
        let cut = read_text("d/Red.txt", &text.replace("401,5\t1,2E1\r\n", ""));
        assert!(matches!(cut, Err(InstrumentError::Count { line: 7, found: 1, .. })), "{cut:?}");
        let bad = read_text("d/Red.txt", &text.replace("1,2E1", "1,2Z1"));
        assert!(matches!(bad, Err(InstrumentError::Line { line: 7, .. })), "{bad:?}");
    }

    #[test]
    fn jaz_files_give_the_processed_column_and_the_counts() {
        let text = "Jaz Data File\nProcessed Spectrum Present: Yes\n>>>>>Begin Processed\n\
            W\tD\tR\tS\tP\n400.0\t1\t100\t50\t49.5\n401.0\t1\t100\t20\t19.2\n>>>>>End\n";
        assert_eq!(summary(text), counts_of(""));
        assert_eq!(summary(&text.repeat(2)), [counts_of(" 1"), counts_of(" 2")].concat());
        let raw = text.replace("Yes", "No\nReference Spectrum Present: No");
        let sample = ("a".to_owned(), MeasuredQuantity::Counts, Role::Main, vec![50.0, 20.0]);
        assert_eq!(summary(&raw), [sample, counts_of("").remove(3)]);
        // Without a name the main spectrum is selected.
        let records = read_text("a.jaz", text).unwrap();
        assert_eq!(choose_spectrum("a.jaz", &records, None).unwrap().name, "a");
        assert_eq!(choose_spectrum("a.jaz", &records[3..], None).unwrap().name, "a (D)");
    }

    #[test]
    fn absolute_irradiance_is_the_power_of_a_light() {
        let text = "Jaz Absolute Irradiance File\nReference Spectrum Present: Yes\n\
            >>>>>Begin Processed\nW\tD\tS\tP\n400.0\t1\t50\t0.5\n700.0\t1\t20\t0.7\n>>>>>End\n";
        assert_eq!(quantity("a.txt", text), MeasuredQuantity::Power);
        let data = text.replace("Absolute Irradiance", "Data");
        assert_eq!(quantity("a.jaz", &data), MeasuredQuantity::Unstated);
        for file in ["sun.JazIrrad", "b/sun.OVIrrad"] {
            assert_eq!(quantity(file, &data), MeasuredQuantity::Power, "{file}");
        }
    }

    fn list(name: &str, values: &[f64]) -> String {
        let doubles = values.iter().map(|value| format!("<double>{value}</double>\n"));
        format!("<{name}>\n{}</{name}>\n", doubles.collect::<String>())
    }

    /// The XML of a spectrum, with the class of its processor.
    fn xml(class: &str) -> String {
        format!(
            "<?xml version=\"1.0\"?>\n<com.Processed>\n<source>\n<userName>A\u{1}nna</userName>\n\
             <darkSpectrum>{}</darkSpectrum><referenceSpectrum>{}</referenceSpectrum>{}{}\n\
             <processor class=\"{class}\"/></source>{}</com.Processed>\n",
            list("pixelValues", &[1.0, 1.0]),
            list("pixelValues", &[101.0, 201.0]),
            list("channelWavelengths", &[400.0, 401.5]),
            list("pixelValues", &[11.0, 101.0]),
            list("processedPixels", &[10.0, 50.0])
        )
    }

    pub(in super::super) fn procspec(class: &str) -> Vec<u8> {
        archive(&[("OOISignatures.xml", b"<x/>"), ("ps_0.xml", xml(class).as_bytes())])
    }

    #[test]
    fn the_processed_spectrum_and_its_counts_are_read() {
        let found = read_procspec("a/red.ProcSpec", &procspec("Reflection")).unwrap();
        let names: Vec<&str> = found.iter().map(|record| record.name.as_str()).collect();
        assert_eq!(names, ["red", "red (S)", "red (R)", "red (D)"]);
        assert_eq!(
            (&found[0].wavelengths_nm, &found[0].values),
            (&vec![400.0, 401.5], &vec![10.0, 50.0])
        );
        assert_eq!((&found[1].values, &found[2].values), (&vec![11.0, 101.0], &vec![101.0, 201.0]));
        assert_eq!((found[0].quantity, found[2].role), (MeasuredQuantity::Unstated, Role::White));
        assert!(found[0].is_relative_to_white(), "its white makes it no lamp");
        assert_eq!(found[0].details[0].1, "Anna");
        let lamp = read_procspec("f", &procspec("com.AbsoluteIrradianceProcessor")).unwrap();
        assert_eq!(lamp[0].quantity, MeasuredQuantity::Power);
    }

    #[test]
    fn references_between_steps_of_processing_are_followed() {
        let steps = format!(
            "<steps><step><processedPixels reference=\"../../../source/pixelValues\"/></step>\
             <step>{}</step>\
             <step><processedPixels reference=\"../../step[2]/processedPixels\"/></step></steps>",
            list("processedPixels", &[10.0, 50.0])
        );
        let plain = xml("Reflection");
        let (before, _) = plain.split_once("<processedPixels>").unwrap();
        let of = |steps: &str| {
            let text = format!("{before}{steps}</com.Processed>");
            read_procspec("red.ProcSpec", &archive(&[("ps_0.xml", text.as_bytes())])).unwrap()
        };
        let found = of(&steps);
        assert_eq!(found[0].values, [10.0, 50.0]);
        assert_eq!(found[0].quantity, MeasuredQuantity::Unstated);
        let absolute = steps.replace("../../step[2]", "/com.Processed/steps/step[2]");
        assert_eq!(of(&absolute), found);
        // A step that refers to the counts of the sample has not processed them.
        let raw = "<processedPixels reference=\"../source/pixelValues\"/>";
        assert_eq!(of(raw)[0].quantity, MeasuredQuantity::Counts);
        for bad in ["../nowhere", "../processedPixels", "../step[0]", "[x]", "", ".."] {
            let raw = format!("<processedPixels reference=\"{bad}\"/>");
            assert_eq!(of(&raw)[0].quantity, MeasuredQuantity::Counts, "{bad}");
        }
    }

    #[test]
    fn faults_are_reported_with_file_and_line() {
        let error = fault_with("<double>10<", "<double>1O<");
        assert!(error.starts_with("some.ProcSpec, line") && error.contains("`1O`"), "{error}");
        let error = fault_with("<double>10</double>", "");
        assert!(error.contains("2 wavelengths for the 1 values of some"), "{error}");
        assert!(fault_with("</com.Processed>", "").contains("never closed"));
    }

    #[test]
    fn an_archive_that_is_cut_anywhere_is_refused_by_name() {
        let bytes = procspec("");
        for length in 4..bytes.len() {
            let error = read_procspec("some.ProcSpec", &bytes[..length]).unwrap_err().to_string();
            assert!(error.starts_with("some.ProcSpec"), "{error}");
        }
    }

    fn fault_with(old: &str, new: &str) -> String {
        let text = xml("").replacen(old, new, 1);
        read_procspec("some.ProcSpec", &archive(&[("ps_0.xml", text.as_bytes())]))
            .unwrap_err()
            .to_string()
    }

    fn quantity(file: &str, text: &str) -> MeasuredQuantity {
        read_text(file, text).unwrap()[0].quantity
    }

    fn counts_of(number: &str) -> Vec<(String, MeasuredQuantity, Role, Vec<f64>)> {
        let main = (format!("a{number}"), MeasuredQuantity::Unstated, Role::Main, vec![49.5, 19.2]);
        let mut spectra = vec![main];
        for (letter, role, values) in [
            ("S", Role::Sample, vec![50.0, 20.0]),
            ("R", Role::White, vec![100.0, 100.0]),
            ("D", Role::Dark, vec![1.0, 1.0]),
        ] {
            let name = format!("a{number} ({letter})");
            spectra.push((name, MeasuredQuantity::Counts, role, values));
        }
        spectra
    }

    fn summary(text: &str) -> Vec<(String, MeasuredQuantity, Role, Vec<f64>)> {
        read_text("a.jaz", text)
            .unwrap()
            .into_iter()
            .map(|r| (r.name, r.quantity, r.role, r.values))
            .collect()
    }
}
