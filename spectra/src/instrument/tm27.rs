//! IES TM-27-14, "IES Standard Format for the Electronic Transfer of Spectral Data": `.spdx`.

use super::error::InstrumentError;
use super::measured::{MeasuredQuantity, MeasuredSpectrum, Role, Unit, stem};
use super::number::{Decimal, required_number};
use super::points::{Duplicates, Point, ordered, sorted};
use super::xml::parse;

/// The spectral distributions of a TM-27 file.
pub(super) fn read(file: &str, text: &str) -> Result<Vec<MeasuredSpectrum>, InstrumentError> {
    let root = parse(file, text)?;
    if !root.name.starts_with("IESTM27") {
        return Err(InstrumentError::line(file, root.line, "an IESTM2714 element", &root.name));
    }
    let header = root.child("Header").map_or_else(Vec::new, |header| header.leaves());
    let header_text = |name: &str| {
        let text = header.iter().find(|(key, _)| key == name).map(|(_, text)| text.as_str());
        text.filter(|text| !matches!(*text, "N/A" | "Unknown"))
    };
    let name = header_text("Description").or_else(|| header_text("CatalogNumber"));
    let name = name.map_or_else(|| stem(file), str::to_owned);
    let mut records = Vec::new();
    for distribution in root.all("SpectralDistribution") {
        let mut points = Vec::new();
        for datum in distribution.all("SpectralData") {
            let nm = datum.attribute("wavelength").unwrap_or_default();
            let nm = required_number(file, datum.line, "a wavelength in nm", nm, Decimal::Point)?;
            let value = required_number(file, datum.line, "a number", &datum.text, Decimal::Point)?;
            points.push(Point { line: datum.line, nm, value });
        }
        if points.is_empty() {
            continue;
        }
        let (points, order) = sorted(points);
        let ordered = ordered(file, points, Duplicates::Refuse)?;
        let mut details = header.clone();
        details.extend(distribution.leaves().into_iter().filter(|(key, _)| key != "SpectralData"));
        let quantity = details.iter().find(|(key, _)| key == "SpectralQuantity");
        records.push(MeasuredSpectrum {
            name: name.clone(),
            quantity: quantity.map_or(MeasuredQuantity::Unstated, |(_, word)| quantity_of(word)),
            role: Role::Main,
            unit: Unit::Unstated,
            wavelengths_nm: ordered.wavelengths_nm,
            values: ordered.values,
            line: distribution.line,
            details,
            remarks: order.into_iter().chain(ordered.remarks).collect(),
        });
    }
    Ok(records)
}

/// The quantity for a term of the standard; `relative` is relative power.
fn quantity_of(word: &str) -> MeasuredQuantity {
    match word.to_ascii_lowercase().as_str() {
        "flux" | "intensity" | "irradiance" | "radiance" | "exitance" | "relative" => {
            MeasuredQuantity::Power
        }
        "reflectance" | "r-factor" => MeasuredQuantity::Reflectance,
        "transmittance" | "t-factor" => MeasuredQuantity::Transmittance,
        _ => MeasuredQuantity::Unstated,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(description: &str, quantity: &str, data: &str) -> String {
        format!(
            "<?xml version='1.0'?>\n<IESTM2714 xmlns='iestm2714' version='1.0'><Header>\
             <Description>{description}</Description></Header><SpectralDistribution>\
             <SpectralQuantity>{quantity}</SpectralQuantity>\n{data}\
             </SpectralDistribution></IESTM2714>"
        )
    }

    const DATA: &str = "<SpectralData wavelength='400.0'>0.034</SpectralData>\n\
                        <SpectralData wavelength='403.1'>1.5e-2</SpectralData>\n";

    #[test]
    fn a_lamp_has_its_name_its_quantity_and_its_wavelengths() {
        let records = read("f.spdx", &file("Rare earth", "relative", DATA)).unwrap();
        assert_eq!(records.len(), 1);
        assert_eq!(records[0].name, "Rare earth");
        assert_eq!(records[0].quantity, MeasuredQuantity::Power);
        assert_eq!(records[0].wavelengths_nm, [400.0, 403.1]);
        assert_eq!(records[0].values, [0.034, 0.015]);
        let (first, second) = DATA.split_at(DATA.find("\n").unwrap() + 1);
        let third = first.replace("400.0", "402").replace("0.034", "1");
        let mixed = read("f.spdx", &file("d", "flux", &[first, second, &third].concat())).unwrap();
        assert_eq!(mixed[0].values, [0.034, 1.0, 0.015]);
        assert!(mixed[0].remarks[0].contains("sorted"), "{:?}", mixed[0].remarks);
        let unnamed = read("a/lamp.spdx", &file("N/A", "reflectance", DATA)).unwrap();
        assert_eq!(unnamed[0].name, "lamp");
        assert_eq!(unnamed[0].quantity, MeasuredQuantity::Reflectance);
    }

    #[test]
    fn faults_name_the_line() {
        for (data, fault) in [
            (
                "<SpectralData wavelength='x'>1</SpectralData>",
                "f, line 3: expected a wavelength in nm",
            ),
            ("\n<SpectralData wavelength='400'/>", "f, line 4: expected a number"),
            (
                "<SpectralData wavelength='-1'>1</SpectralData>",
                "f, line 3: expected a wavelength above 0",
            ),
        ] {
            let error = read("f", &file("d", "flux", data)).unwrap_err().to_string();
            assert!(error.starts_with(fault), "{error}");
        }
        let error = read("f", "<a/>").unwrap_err().to_string();
        assert!(error.starts_with("f, line 1: expected an IESTM2714 element"), "{error}");
        assert_eq!(read("f", &file("d", "flux", "")).unwrap(), []);
    }
}
