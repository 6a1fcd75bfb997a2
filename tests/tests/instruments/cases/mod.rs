//! Layouts in which strangers bring their files. One row is one case: how a file of known curves is
//! written, and what reading it gives, says or refuses.
mod made;
mod tables;
mod formats;

use std::error::Error;

use calibrate::{ReadingOptions, Readings};

use made::{Table, Written};

/// The expected result of reading a file.
#[derive(Debug, Clone, Copy)]
enum Gives {
    /// The spectra with these names, separated by `|`.
    Spectra(&'static str),
    /// Spectra with the names in the first text, and a remark with the word in the second. If the first text
    /// is empty, we do not check names.
    Says(&'static str, &'static str),
    /// An error that holds each of these words, separated by `|`.
    Refused(&'static str),
}

/// Wavelengths in nm at which the values are compared, where a file has them.
const CHECKED_NM: [f64; 4] = [400.0, 500.0, 560.0, 700.0];

/// The message of an error, with its reasons.
fn told(error: &dyn Error) -> String {
    let reason = error.source().map_or_else(String::new, |reason| format!(": {}", told(reason)));
    format!("{error}{reason}")
}

/// The faults of one case, as text.
fn faults(
    (file, bytes): (String, Vec<u8>),
    gives: Gives,
    expected: impl Fn(f64) -> Option<Vec<f64>>,
) -> Vec<String> {
    let read = Readings::spectra_from_files(&[(file, bytes)], &ReadingOptions::default());
    let (names, word) = match gives {
        Gives::Refused(words) => {
            let error = match read {
                Ok(_) => return vec!["was read".to_owned()],
                Err(error) => told(&error),
            };
            let lacks = words.split('|').filter(|word| !error.contains(word));
            return lacks.map(|word| format!("no `{word}` in: {error}")).collect();
        }
        Gives::Spectra(names) => (names, ""),
        Gives::Says(names, word) => (names, word),
    };
    let readings = match read {
        Ok(readings) => readings,
        Err(error) => return vec![told(&error)],
    };
    let mut faults = Vec::new();
    let remarks: Vec<String> = readings.remarks.iter().skip(1).map(ToString::to_string).collect();
    if !word.is_empty() && !remarks.iter().any(|remark| remark.contains(word)) {
        faults.push(format!("no `{word}` in {remarks:?}"));
    }
    let averaged = readings.table.averaged();
    let found: Vec<&str> = averaged.spectra.iter().map(|s| s.name.as_str()).collect();
    if !names.is_empty() && found.join("|") != names {
        faults.push(format!("names {found:?}"));
    }
    for nm in CHECKED_NM {
        let Some(wanted) = expected(nm) else { continue };
        if !averaged.grid.covers(nm) || wanted.len() < found.len() {
            faults.push(format!("{} spectra on {}", found.len(), averaged.grid));
            break;
        }
        if wanted.len() > found.len() {
            continue;
        }
        let at = (nm - averaged.grid.start_nm()) / averaged.grid.step_nm();
        for (spectrum, wanted) in averaged.spectra.iter().zip(wanted) {
            let value = spectrum.reflectance[at.round() as usize];
            if (value - wanted).abs() > 2e-5 {
                faults.push(format!("{} at {nm} nm: {value}, not {wanted}", spectrum.name));
            }
        }
    }
    faults
}

fn check(cases: &[(Written, Table, Gives)]) {
    let faults: Vec<String> = cases
        .iter()
        .flat_map(|(written, table, gives)| {
            let expected = |nm| table.is_at(nm).then(|| table.expected(nm));
            let found = faults(table.file(*written), *gives, expected);
            found.into_iter().map(move |fault| format!("{written:?} {table:?}: {fault}"))
        })
        .collect();
    assert!(faults.is_empty(), "{} faults:\n{}", faults.len(), faults.join("\n"));
}

/// The pigments that `fit` finds in a table, or its error.
#[test]
fn pigments_are_the_columns_of_amounts() {
    let mut faults = Vec::new();
    for (written, table, gives) in tables::RECIPES {
        let read = Readings::from_files(&[table.file(*written)], &ReadingOptions::default());
        let (pigments, error, remarks) = match &read {
            Ok(read) => {
                let remarks: Vec<String> = read.remarks.iter().map(ToString::to_string).collect();
                (read.table.pigments.join("|"), String::new(), remarks.join("\n"))
            }
            Err(error) => (String::new(), told(error), String::new()),
        };
        let is_right = match gives {
            Gives::Spectra(names) => pigments == *names,
            Gives::Says(names, word) => pigments == *names && remarks.contains(word),
            Gives::Refused(words) => {
                read.is_err() && words.split('|').all(|word| error.contains(word))
            }
        };
        if !is_right {
            faults.push(format!("{written:?} {table:?}: `{pigments}` {error} {remarks}"));
        }
    }
    assert!(faults.is_empty(), "{} faults:\n{}", faults.len(), faults.join("\n"));
}

#[test]
fn lamps_are_read_as_power() {
    let mut faults = Vec::new();
    for (written, table, gives) in tables::LAMPS {
        let (file, bytes) = table.file(*written);
        match (spectra::lamp_from_bytes(&file, &bytes, None), gives) {
            (Err(error), Gives::Refused(words))
                if words.split('|').all(|word| told(&error).contains(word)) => {}
            (Ok(lamp), Gives::Spectra(_)) => {
                let power = |nm: f64| {
                    let at = (nm - lamp.power().grid().start_nm()) / lamp.power().grid().step_nm();
                    lamp.power().values()[at.round() as usize]
                };
                for nm in CHECKED_NM {
                    let found = power(nm) / power(560.0);
                    let wanted = made::curve(0, nm) / made::curve(0, 560.0);
                    if (found - wanted).abs() > 1e-4 {
                        faults.push(format!(
                            "{written:?} {table:?}: {found} at {nm} nm, not {wanted}"
                        ));
                    }
                }
            }
            (found, _) => faults.push(format!("{written:?} {table:?}: {found:?}")),
        }
    }
    assert!(faults.is_empty(), "{} faults:\n{}", faults.len(), faults.join("\n"));
}

#[test]
fn words_in_names_of_paints_are_no_quantities() {
    check(tables::PAINTS);
}

#[test]
fn wavelengths_out_of_range_are_cut_and_said() {
    check(tables::CUT);
}

#[test]
fn repeated_names_and_deviations_are_said() {
    check(tables::REPEATED);
}

#[test]
fn other_quantities_are_refused() {
    check(tables::OTHER_QUANTITIES);
}

#[test]
fn percent_and_fractions_are_told_apart() {
    check(tables::UNITS);
}

#[test]
fn units_of_wavelengths_are_found_or_asked_for() {
    check(tables::WAVELENGTHS);
}

#[test]
fn numbers_without_a_heading_are_read() {
    check(tables::NO_HEADING);
}

#[test]
fn names_are_found_by_any_heading() {
    check(tables::NAMES);
}

#[test]
fn quantities_of_jcamp_files_are_known_or_refused() {
    for (yunits, white, gives) in formats::JCAMP {
        let file = ("made.jdx".to_owned(), made::jcamp(yunits, *white));
        let found = faults(file, *gives, |nm| Some(vec![made::curve(0, nm)]));
        assert!(found.is_empty(), "{yunits}: {found:?}");
    }
}

#[test]
fn patches_of_cgats_files_keep_their_unit() {
    for (heading, white, last, gives) in formats::CGATS {
        let names = ["A", "B", "C", "D", "Black"];
        let file = ("made.ti3".to_owned(), made::cgats(heading, &names, *white, *last));
        let expected = |nm| {
            Some((0..5).map(|i| made::curve(i, nm) * if i == 4 { *last } else { 1.0 }).collect())
        };
        let found = faults(file, *gives, expected);
        assert!(found.is_empty(), "{heading} {white}: {found:?}");
    }
}
