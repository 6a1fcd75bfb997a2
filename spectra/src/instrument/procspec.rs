//! Ocean Optics and Ocean Insight `.ProcSpec`: a zip archive with the file `ps_N.xml`, in which lists of
//! `double` hold wavelengths, counts of sample, white and dark, and the processed spectrum.
//!
//! Element names as the R package lightr reads them. SpectraSuite writes bytes into the XML that are
//! no text; those are left out.

use super::error::InstrumentError;
use super::measured::{MeasuredQuantity, MeasuredSpectrum, Role, Unit, stem};
use super::number::{Decimal, required_number};
use super::points::{Duplicates, Point, ordered};
use super::xml::{Element, parse};
use super::zip_archive::Archive;

const FORMAT: &str = "Ocean Optics ProcSpec";

/// Whether the file of an archive is that of the spectrum.
pub(super) fn is_spectrum(name: &str) -> bool {
    let number = name.strip_prefix("ps_").and_then(|rest| rest.strip_suffix(".xml"));
    number.is_some_and(|number| number.bytes().all(|byte| byte.is_ascii_digit()))
}

pub(super) fn read(file: &str, bytes: &[u8]) -> Result<Vec<MeasuredSpectrum>, InstrumentError> {
    let mut archive = Archive::open(file, bytes)?;
    let Some(name) = archive.find(is_spectrum) else {
        return Err(InstrumentError::faulty(file, FORMAT, "it has no file `ps_N.xml`"));
    };
    let text: String = archive
        .read(&name)?
        .into_iter()
        .filter(|byte: &u8| byte.is_ascii_graphic() || b" \n\r\t".contains(byte))
        .map(char::from)
        .collect();
    let root = parse(file, &text)?;
    let white_element = find(&root, "referenceSpectrum", &[]);
    let dark_element = find(&root, "darkSpectrum", &[]);
    let apart = ["referenceSpectrum", "darkSpectrum"];
    let numbers = |element: Option<&Element>| {
        element.map_or_else(|| Ok(Vec::new()), |element| doubles(file, element))
    };
    let list = |name: &str| numbers(find(&root, name, &apart));
    let nm = list("channelWavelengths")?;
    let processed = list("processedPixels")?;
    let sample = list("pixelValues")?;
    let counts = |element: Option<&Element>| {
        numbers(element.and_then(|element| find(element, "pixelValues", &[])))
    };
    let white = counts(white_element)?;
    let dark = counts(dark_element)?;
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
            details: details.clone(),
            remarks: ordered.remarks,
        });
    }
    Ok(records)
}

/// The first descendant called `name` that is in none of the elements `apart`.
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

/// Whether the spectrum was processed to irradiance, which the class of a processor names.
fn has_irradiance(element: &Element) -> bool {
    let class = element.attribute("class").unwrap_or_default();
    class.to_ascii_lowercase().contains("irradiance") || element.children.iter().any(has_irradiance)
}

#[cfg(test)]
pub(super) mod tests {
    use super::super::zip_archive::tests::archive;
    use super::*;

    fn list(name: &str, values: &[f64]) -> String {
        let doubles = values.iter().map(|value| format!("<double>{value}</double>\n"));
        format!("<{name}>\n{}</{name}>\n", doubles.collect::<String>())
    }

    /// The XML of a spectrum, with the class of its processor.
    fn xml(class: &str) -> String {
        let counts = |values| list("pixelValues", values);
        format!(
            "<?xml version=\"1.0\"?>\n<com.Processed>\n<source>\n<userName>A\u{1}nna</userName>\n\
             <darkSpectrum>{}</darkSpectrum><referenceSpectrum>{}</referenceSpectrum>{}{}\n\
             <processor class=\"{class}\"/></source>{}</com.Processed>\n",
            counts(&[1.0, 1.0]),
            counts(&[101.0, 201.0]),
            list("channelWavelengths", &[400.0, 401.5]),
            counts(&[11.0, 101.0]),
            list("processedPixels", &[10.0, 50.0])
        )
    }

    pub(in super::super) fn procspec(class: &str) -> Vec<u8> {
        archive(&[("OOISignatures.xml", b"<x/>"), ("ps_0.xml", xml(class).as_bytes())])
    }

    #[test]
    fn the_processed_spectrum_and_its_counts_are_read() {
        let found = read("a/red.ProcSpec", &procspec("Reflection")).unwrap();
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
        let lamp = read("f", &procspec("com.AbsoluteIrradianceProcessor")).unwrap();
        assert_eq!(lamp[0].quantity, MeasuredQuantity::Power);
    }

    #[test]
    fn faults_are_told_with_file_and_line() {
        let with = |old: &str, new: &str| {
            let text = xml("").replacen(old, new, 1);
            read("some.ProcSpec", &archive(&[("ps_0.xml", text.as_bytes())]))
                .unwrap_err()
                .to_string()
        };
        let error = with("<double>10<", "<double>1O<");
        assert!(error.starts_with("some.ProcSpec, line") && error.contains("`1O`"), "{error}");
        let error = with("<double>10</double>", "");
        assert!(error.contains("2 wavelengths for the 1 values of some"), "{error}");
        assert!(with("</com.Processed>", "").contains("never closed"));
    }

    #[test]
    fn an_archive_that_is_cut_anywhere_is_refused_by_name() {
        let bytes = procspec("");
        for length in 4..bytes.len() {
            let error = read("some.ProcSpec", &bytes[..length]).unwrap_err().to_string();
            assert!(error.starts_with("some.ProcSpec"), "{error}");
        }
    }
}
