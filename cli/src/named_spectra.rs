//! Averaged spectra of a measurement file, selected by name. A sample may have several.

use std::path::{Path, PathBuf};

use calibrate::measurement::{Film, MeasurementTable, Reading};
use spectra::Grid;
use spectra::instrument::split_file_and_name;

use crate::console::Console;
use crate::failure::{Failure, Result};
use crate::readings::{ReadingOptions, spectra};

/// Maximum number of names that an error lists; chosen by eye.
const LISTED: usize = 8;

/// Mean of the repeated readings of one film or card.
pub(crate) struct NamedSpectrum {
    /// Name of the sample.
    pub(crate) sample: String,
    /// Whether the reading is of paint or of the bare backing.
    pub(crate) film: Film,
    /// Name of the sample, followed by the backing if the sample has several spectra.
    pub(crate) name: String,
    /// Reflectance on the table's grid.
    pub(crate) reflectance: Vec<f64>,
}

/// Averages repeated readings of `table`. Returns the means in the order of their first readings.
pub(crate) fn named_spectra(table: &MeasurementTable) -> Vec<NamedSpectrum> {
    let same = |a: &Reading, b: &Reading| {
        (&a.sample, a.film, &a.backing, a.thickness_mm)
            == (&b.sample, b.film, &b.backing, b.thickness_mm)
    };
    let mut groups: Vec<Vec<&Reading>> = Vec::new();
    for reading in &table.readings {
        match groups.iter_mut().find(|group| same(group[0], reading)) {
            Some(group) => group.push(reading),
            None => groups.push(vec![reading]),
        }
    }
    groups
        .iter()
        .map(|group| {
            let first = group[0];
            let alone = groups.iter().filter(|g| g[0].sample == first.sample).count() == 1;
            let name = match (alone, first.film) {
                (true, _) => first.sample.clone(),
                (_, Film::None) => format!("{} bare {}", first.sample, first.backing),
                (_, Film::Paint) => match first.thickness_mm {
                    Some(mm) => format!("{} on {}, {mm} mm", first.sample, first.backing),
                    None => format!("{} on {}", first.sample, first.backing),
                },
            };
            let mean = |at: usize| {
                group.iter().map(|r| r.reflectance[at]).sum::<f64>() / group.len() as f64
            };
            let reflectance = (0..table.grid.count()).map(mean).collect();
            NamedSpectrum { sample: first.sample.clone(), film: first.film, name, reflectance }
        })
        .collect()
}

/// Spectra of one file, selected by `FILE` or `FILE#NAME`.
pub(crate) struct SelectedSpectra {
    /// Path of the file.
    pub(crate) file: String,
    /// Wavelengths of all spectra.
    pub(crate) grid: Grid,
    /// One or more spectra, in the order of the file.
    pub(crate) spectra: Vec<NamedSpectrum>,
}

/// Reads the spectra that `text` selects: all of `FILE`, or those of `FILE#NAME`. Returns `None` if
/// there is no such file.
pub(crate) fn select_spectra(
    text: &str,
    reading: &ReadingOptions,
    console: &mut Console<'_>,
) -> Result<Option<SelectedSpectra>> {
    let (file, name) = split_file_and_name(text);
    if !Path::new(file).is_file() {
        return Ok(None);
    }
    let table = spectra(&[PathBuf::from(file)], reading, console)?;
    let all = named_spectra(&table);
    let indices = match name {
        Some(name) => find_by_name(&all, name)?,
        None => (0..all.len()).collect(),
    };
    let mut indices = indices.into_iter().peekable();
    let is_selected = |(index, _): &(usize, NamedSpectrum)| indices.next_if_eq(index).is_some();
    let spectra =
        all.into_iter().enumerate().filter(is_selected).map(|(_, spectrum)| spectrum).collect();
    Ok(Some(SelectedSpectra { file: file.to_owned(), grid: table.grid, spectra }))
}

/// Returns the ascending indices of the `spectra` called `name`: the one with exactly this name, or
/// all of the sample with this name.
pub(crate) fn find_by_name(spectra: &[NamedSpectrum], name: &str) -> Result<Vec<usize>> {
    if let Some(index) = spectra.iter().position(|spectrum| spectrum.name == name) {
        return Ok(vec![index]);
    }
    let of_sample: Vec<usize> =
        (0..spectra.len()).filter(|&index| spectra[index].sample == name).collect();
    if !of_sample.is_empty() {
        return Ok(of_sample);
    }
    let mut samples: Vec<&str> = spectra.iter().map(|spectrum| spectrum.sample.as_str()).collect();
    samples.dedup();
    Err(Failure::data(
        format!("no spectrum is called `{name}`"),
        format!("samples: {}", join_first(&samples, ", ")),
    ))
}

/// Joins the first eight of `names`, and adds how many more there are.
pub(crate) fn join_first(names: &[&str], separator: &str) -> String {
    let listed = names[..names.len().min(LISTED)].join(separator);
    match names.len().saturating_sub(LISTED) {
        0 => listed,
        more => format!("{listed} .. and {more} more"),
    }
}
