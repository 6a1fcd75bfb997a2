//! What lies under a film: a grey, or a measured spectrum.

use std::path::{Path, PathBuf};

use calibrate::library::PigmentLibrary;
use spectra::{Ends, Interpolation, Reflectance, Spectrum};

use crate::console::Console;
use crate::failure::Refusal;
use crate::named_spectra::{matching, named_spectra};
use crate::readings::{ReadingOptions, spectra};

/// The ground's measured reflectance on the library's grid.
pub(crate) fn ground(
    text: &str,
    library: &PigmentLibrary,
    console: &mut Console<'_>,
) -> anyhow::Result<Vec<f64>> {
    let even = match text {
        "white" => Some(1.0),
        "black" => Some(0.0),
        _ => text.parse().ok().filter(|v| (0.0..=1.0).contains(v)),
    };
    if let Some(value) = even {
        return Ok(vec![value; library.grid.count()]);
    }
    // A whole name that is a file wins over the part before a `#`.
    let (file, sample) = match text.rsplit_once('#') {
        Some((file, sample)) if !Path::new(text).is_file() => (file, Some(sample)),
        _ => (text, None),
    };
    if !Path::new(file).is_file() {
        return Err(Refusal::usage(
            format!("--over takes 0 to 1, white, black or a file, found `{text}`"),
            "try --over 0.85 or --over paper.csv#SAMPLE",
        ));
    }
    let table = spectra(&[PathBuf::from(file)], &ReadingOptions::default(), console)?;
    let found = named_spectra(&table);
    let names: Vec<(&str, &str)> =
        found.iter().map(|s| (s.name.as_str(), s.sample.as_str())).collect();
    let chosen = match sample {
        Some(sample) => matching(&names, sample)?,
        None => (0..found.len()).collect(),
    };
    let &[one] = chosen.as_slice() else {
        let names: Vec<&str> = chosen.iter().take(8).map(|&i| found[i].name.as_str()).collect();
        return Err(Refusal::data(
            format!("{file}: one ground is wanted, found `{}` spectra", chosen.len()),
            format!("name one: --over \"{file}#{}\"", names.join("\" or \"#")),
        ));
    };
    let spectrum = Spectrum::<Reflectance>::new(table.grid, found[one].reflectance.clone())?;
    let (start, end) = (table.grid.start_nm(), table.grid.end_nm());
    if start > library.grid.end_nm() || end < library.grid.start_nm() {
        return Err(Refusal::data(
            format!("{file}: the ground is measured from {start} to {end} nm only"),
            format!("the library stands on {}", library.grid),
        ));
    }
    if start > library.grid.start_nm() || end < library.grid.end_nm() {
        console.warnings(&[format!(
            "the ground is measured from {start} to {end} nm; beyond, its end values are held"
        )])?;
    }
    let method = Interpolation::best_for(table.grid);
    Ok(spectrum.resampled(library.grid, method, Ends::Hold)?.into_values())
}
