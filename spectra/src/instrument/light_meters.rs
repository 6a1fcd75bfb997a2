//! Light meters: UPRtek, LI-COR LI-180, Sekonic, and the standard form IES TM-27.
//!
//! UPRtek and the LI-180 write rows of a key and a value between tabs, with rows such as `380nm 0.0303` for the
//! spectrum. UPRtek gives such files the ending `.xls`.
//!
//! Sekonic's light spectrometers (C-700, C-800, C-7000) write CSV rows of a key and a value, with the spectrum
//! once at 5 nm and once at 1 nm. A file of several readings has a column for each.
//!
//! IES TM-27-14, "IES Standard Format for the Electronic Transfer of Spectral Data", is XML: `.spdx`.

use super::decode::{Decimal, lines, number, required_number};
use super::measured::{InstrumentError, MeasuredSpectrum, Role, Unit, stem};
use super::points::{Duplicates, Point, ordered, sorted};
use super::quantity::MeasuredQuantity;
use super::xml::parse;

/// Splits a row into its key and the rest.
fn key_and_value(line: &str) -> Option<(&str, &str)> {
    let (key, value) = line.split_once(['\t', ';']).or_else(|| line.split_once(','))?;
    Some((key.trim().trim_matches('"'), value))
}

/// The wavelength in the key of a row, for example 380 in `380nm`.
fn wavelength(key: &str) -> Option<f64> {
    number(key.strip_suffix("nm")?, Decimal::Point).filter(|nm| (100.0..=5000.0).contains(nm))
}

/// Keys of the numbers that accompany the spectrum of a light.
const OF_A_LIGHT: [&str; 6] = ["Model Name", "LUX", "CCT", "PPFD", "LambdaP", "IRR"];

/// Whether a text has rows of a UPRtek spectrum and the usual keys of a light meter.
pub(super) fn is_uprtek(text: &str) -> bool {
    let wavelengths = lines(text)
        .filter_map(|(_, line)| key_and_value(line))
        .filter(|(key, _)| wavelength(key).is_some())
        .take(2)
        .count();
    wavelengths == 2
        && lines(text)
            .filter_map(|(_, line)| key_and_value(line))
            .any(|(key, _)| OF_A_LIGHT.contains(&key))
}

/// The readings of a UPRtek or LI-180 file, one per column: the power of a light.
pub(super) fn read_uprtek(
    file: &str,
    text: &str,
) -> Result<Vec<MeasuredSpectrum>, InstrumentError> {
    let mut details: Vec<(String, Vec<&str>)> = Vec::new();
    let mut tables: Vec<Vec<(usize, f64, Vec<&str>)>> = Vec::new();
    let mut last_nm = f64::INFINITY;
    for (line, text) in lines(text) {
        let Some((key, value)) = key_and_value(text) else { continue };
        let comma = !text.contains(['\t', ';']);
        let cells = value.split(|c| c == '\t' || c == ';' || (comma && c == ','));
        let cells: Vec<&str> = cells.map(|cell| cell.trim().trim_matches('"')).collect();
        let kept = cells.iter().rposition(|cell| !cell.is_empty()).map_or(0, |last| last + 1);
        let cells = cells[..kept].to_vec();
        let Some(nm) = wavelength(key) else {
            details.push((key.to_owned(), cells));
            continue;
        };
        // A smaller wavelength starts the next table.
        if nm < last_nm {
            tables.push(Vec::new());
        }
        last_nm = nm;
        if let Some(table) = tables.last_mut() {
            table.push((line, nm, cells));
        }
    }
    let finest = tables.into_iter().max_by_key(Vec::len).unwrap_or_default();
    let Some((first_line, _, first)) = finest.first() else { return Ok(Vec::new()) };
    let decimal = Decimal::of(finest.iter().flat_map(|(_, _, cells)| cells.iter().copied()));
    let mut records = Vec::new();
    for column in 0..first.len().max(1) {
        let points = finest
            .iter()
            .map(|(line, nm, cells)| {
                let cell = cells.get(column).copied().unwrap_or_default();
                let value =
                    required_number(file, *line, "a value for every reading", cell, decimal)?;
                Ok(Point { line: *line, nm: *nm, value })
            })
            .collect::<Result<Vec<Point>, InstrumentError>>()?;
        let ordered = ordered(file, points, Duplicates::Refuse)?;
        let name = stem(file);
        records.push(MeasuredSpectrum {
            name: if first.len() > 1 { format!("{name} {}", column + 1) } else { name },
            quantity: MeasuredQuantity::Power,
            role: Role::Main,
            unit: Unit::Unstated,
            wavelengths_nm: ordered.wavelengths_nm,
            values: ordered.values,
            line: *first_line,
            point_lines: ordered.lines,
            details: details
                .iter()
                .filter_map(|(key, cells)| Some((key.clone(), (*cells.get(column)?).to_owned())))
                .collect(),
            remarks: ordered.remarks,
        });
    }
    Ok(records)
}

/// A line of the spectrum starts with this, e.g. `Spectral Data 380[nm],0.001`.
const SPECTRAL: &str = "Spectral Data";

/// The readings of a Sekonic file, each at the finest step of the file.
pub(super) fn read_sekonic(
    file: &str,
    text: &str,
) -> Result<Vec<MeasuredSpectrum>, InstrumentError> {
    let head =
        lines(text).find(|(_, line)| line.starts_with(SPECTRAL)).map_or("", |(_, line)| line);
    let separator = [';', '\t', ','].into_iter().find(|&c| head.contains(c)).unwrap_or(',');
    let decimal =
        if separator != ',' && head.contains(',') { Decimal::Comma } else { Decimal::Point };
    let mut details: Vec<(String, Vec<String>)> = Vec::new();
    let mut tables: Vec<Vec<Row>> = Vec::new();
    let mut last_nm = f64::INFINITY;
    for (line, text) in lines(text) {
        let mut cells = text.split(separator).map(|cell| cell.trim().trim_matches('"'));
        let Some(key) = cells.next().filter(|key| !key.is_empty()) else { continue };
        let Some(nm) = key.strip_prefix(SPECTRAL) else {
            details.push((key.to_owned(), cells.map(str::to_owned).collect()));
            continue;
        };
        let nm = nm.trim().trim_end_matches("[nm]");
        let nm = required_number(file, line, "a wavelength in nm", nm, Decimal::Point)?;
        let values = cells
            .map(|cell| required_number(file, line, "a number", cell, decimal))
            .collect::<Result<Vec<f64>, _>>()?;
        // A smaller wavelength starts the next table.
        if nm < last_nm {
            tables.push(Vec::new());
        }
        last_nm = nm;
        if let Some(table) = tables.last_mut() {
            table.push(Row { line, nm, values });
        }
    }
    // The table with the most rows, the first of several.
    let finest = tables.into_iter().rev().max_by_key(Vec::len).unwrap_or_default();
    let Some(first) = finest.first() else { return Ok(Vec::new()) };
    (0..first.values.len()).map(|column| spectrum(file, column, &finest, &details)).collect()
}

struct Row {
    line: usize,
    nm: f64,
    values: Vec<f64>,
}

fn spectrum(
    file: &str,
    column: usize,
    rows: &[Row],
    details: &[(String, Vec<String>)],
) -> Result<MeasuredSpectrum, InstrumentError> {
    let mut points = Vec::new();
    for row in rows {
        let line = row.line;
        let nm = row.nm;
        let value = *row
            .values
            .get(column)
            .ok_or_else(|| InstrumentError::line(file, line, "a value for every reading", ""))?;
        points.push(Point { line, nm, value });
    }
    let ordered = ordered(file, points, Duplicates::Refuse)?;
    let details: Vec<(String, String)> = details
        .iter()
        .filter_map(|(key, values)| {
            Some((key.clone(), values.get(column).filter(|value| !value.is_empty())?.clone()))
        })
        .collect();
    let title = details.iter().find(|(key, _)| key == "Title").map(|(_, title)| title.clone());
    Ok(MeasuredSpectrum {
        name: title.unwrap_or_else(|| stem(file)),
        quantity: MeasuredQuantity::Power,
        role: Role::Main,
        unit: Unit::Unstated,
        wavelengths_nm: ordered.wavelengths_nm,
        values: ordered.values,
        line: rows.first().map_or(1, |row| row.line),
        point_lines: ordered.lines,
        details,
        remarks: ordered.remarks,
    })
}

pub(super) fn read_tm27(file: &str, text: &str) -> Result<Vec<MeasuredSpectrum>, InstrumentError> {
    let root = parse(file, text)?;
    if !root.name.starts_with("IESTM27") {
        return Err(InstrumentError::line(file, root.line, "an IESTM2714 element", &root.name));
    }
    let header = root.child("Header").map_or_else(Vec::new, |header| header.leaves());
    let mut names = ["Description", "CatalogNumber"].into_iter().filter_map(|name| {
        let text = header.iter().find(|(key, _)| key == name).map(|(_, text)| text.as_str());
        text.filter(|text| !matches!(*text, "N/A" | "Unknown"))
    });
    let name = names.next().map_or_else(|| stem(file), str::to_owned);
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
            point_lines: ordered.lines,
            details,
            remarks: order.into_iter().chain(ordered.remarks).collect(),
        });
    }
    Ok(records)
}

/// The quantity for a term of the standard. `relative` is relative power.
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
mod sekonic_tests {
    use super::*;

    const FILE: &str = "Date Saved,1/2/2021\nTitle,lamp one,lamp two\nTcp [K],3000,4000\n\n\
                        Spectral Data 380[nm],1,2\nSpectral Data 385[nm],3,4\n\n\
                        Spectral Data 380[nm],1,2\nSpectral Data 381[nm],1.5,2\n\
                        Spectral Data 385[nm],3,4\n\nPeak,1\n";

    #[test]
    fn the_finest_table_is_taken_for_every_reading() {
        let records = read_sekonic("f", FILE).unwrap();
        let names: Vec<_> = records.iter().map(|record| record.name.as_str()).collect();
        assert_eq!(names, ["lamp one", "lamp two"]);
        assert_eq!(records[0].wavelengths_nm, [380.0, 381.0, 385.0]);
        assert_eq!(records[0].values, [1.0, 1.5, 3.0]);
        assert_eq!(records[1].values, [2.0, 2.0, 4.0]);
        assert_eq!(records[1].details[1], ("Tcp [K]".to_owned(), "4000".to_owned()));
        assert_eq!((records[0].line, records[0].quantity), (8, MeasuredQuantity::Power));
    }

    #[test]
    fn decimal_commas_are_read_between_semicolons() {
        let records =
            read_sekonic("a/lamp.csv", "Spectral Data 380[nm];0,5\nSpectral Data 385[nm];1\n");
        let records = records.unwrap();
        assert_eq!(
            (records[0].values.as_slice(), records[0].name.as_str()),
            (&[0.5, 1.0][..], "lamp")
        );
    }

    #[test]
    fn faults_name_the_line() {
        for (text, fault) in [
            ("Spectral Data 380[nm],x\n", "f, line 1: expected a number, found `x`"),
            ("\nSpectral Data 3x0[nm],1\n", "f, line 2: expected a wavelength in nm, found `3x0`"),
            (
                "Spectral Data 380[nm],1,2\nSpectral Data 385[nm],1\n",
                "f, line 2: expected a value for every",
            ),
            ("Spectral Data 380[nm],1\nSpectral Data 380[nm],2\n", "f, line 2: the wavelength 380"),
        ] {
            let error = read_sekonic("f", text).unwrap_err().to_string();
            assert!(error.starts_with(fault), "{error}");
        }
        assert_eq!(read_sekonic("f", "Title,x\n").unwrap(), []);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FILE: &str = "Model Name\tLI-180\nTime\t2021/03/02_09:24:26\nPFD-R\t49.5\nI-Time\t92.0\n\
                        380nm\t27.5\n381nm\t28.5\n382nm\t29\nCCT\t5465\n";

    #[test]
    fn rows_of_wavelengths_are_the_power_of_a_light() {
        assert!(is_uprtek(FILE) && !is_uprtek("Model Name\tLI-180\n380nm\t1\n"));
        assert!(!is_uprtek("nm,reflectance\n380nm,1\n381nm,1\n"), "no light");
        let found = &read_uprtek("a/sky.txt", FILE).unwrap()[0];
        assert_eq!((found.name.as_str(), found.line), ("sky", 5));
        assert_eq!(
            (&found.wavelengths_nm, &found.values),
            (&vec![380.0, 381.0, 382.0], &vec![27.5, 28.5, 29.0])
        );
        assert_eq!(found.quantity, MeasuredQuantity::Power);
        assert_eq!(found.details[0], ("Model Name".to_owned(), "LI-180".to_owned()));
        let commas = FILE.replace(".5", ",5");
        assert_eq!(read_uprtek("f", &commas).unwrap()[0].values, [27.5, 28.5, 29.0]);
        let csv = FILE.replace('\t', ",");
        assert_eq!(read_uprtek("f", &csv).unwrap()[0].values, [27.5, 28.5, 29.0]);
        let two = read_uprtek(
            "f",
            &FILE.replace("7.5", "7.5\t1").replace("8.5", "8.5\t2").replace("\t29", "\t29\t3"),
        );
        assert_eq!(two.unwrap()[1].values, [1.0, 2.0, 3.0]);
    }

    #[test]
    fn faults_name_their_line() {
        for (old, new, at) in [("28.5", "x", 6), ("\t28.5", "\t", 6), ("381nm", "380nm", 6)] {
            let found = read_uprtek("f", &FILE.replace(old, new));
            let Err(InstrumentError::Line { line, .. } | InstrumentError::Duplicate { line, .. }) =
                found
            else {
                panic!("{found:?}")
            };
            assert_eq!(line, at, "{new}");
        }
    }

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
        let records = read_tm27("f.spdx", &file("Rare earth", "relative", DATA)).unwrap();
        assert_eq!(records.len(), 1);
        assert_eq!(records[0].name, "Rare earth");
        assert_eq!(records[0].quantity, MeasuredQuantity::Power);
        assert_eq!(records[0].wavelengths_nm, [400.0, 403.1]);
        assert_eq!(records[0].values, [0.034, 0.015]);
        let (first, second) = DATA.split_at(DATA.find("\n").unwrap() + 1);
        let third = first.replace("400.0", "402").replace("0.034", "1");
        let mixed =
            read_tm27("f.spdx", &file("d", "flux", &[first, second, &third].concat())).unwrap();
        assert_eq!(mixed[0].values, [0.034, 1.0, 0.015]);
        assert!(mixed[0].remarks[0].contains("sorted"), "{:?}", mixed[0].remarks);
        let unnamed = read_tm27("a/lamp.spdx", &file("N/A", "reflectance", DATA)).unwrap();
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
            let error = read_tm27("f", &file("d", "flux", data)).unwrap_err().to_string();
            assert!(error.starts_with(fault), "{error}");
        }
        let error = read_tm27("f", "<a/>").unwrap_err().to_string();
        assert!(error.starts_with("f, line 1: expected an IESTM2714 element"), "{error}");
        assert_eq!(read_tm27("f", &file("d", "flux", "")).unwrap(), []);
    }
}
