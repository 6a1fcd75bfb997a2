//! The spectra of a file by name: a sample may have several.

use std::path::{Path, PathBuf};

use calibrate::measurement::{Film, MeasurementTable, Reading};
use spectra::Grid;
use spectra::instrument::split_file_and_name;

use crate::console::Console;
use crate::failure::{Failure, Result};
use crate::readings::{ReadingOptions, spectra};

/// How many names an error lists.
const LISTED: usize = 8;

/// One averaged spectrum.
pub(crate) struct NamedSpectrum {
    /// Its sample.
    pub(crate) sample: String,
    /// Whether it is of paint, or of the bare backing.
    pub(crate) film: Film,
    /// The sample's name, and the backing where the sample has several spectra.
    pub(crate) name: String,
    /// Reflectance on the table's grid.
    pub(crate) reflectance: Vec<f64>,
}

/// The spectra of `table`, repeated readings averaged.
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

/// The spectra that a user means by `FILE` or `FILE#NAME`.
pub(crate) struct Chosen {
    /// The file.
    pub(crate) file: String,
    /// The wavelengths of all.
    pub(crate) grid: Grid,
    /// One or more, in the file's order.
    pub(crate) spectra: Vec<NamedSpectrum>,
}

/// The spectra that `text`, `FILE` or `FILE#NAME`, stands for; `None` if there is no such file.
pub(crate) fn chosen(
    text: &str,
    reading: &ReadingOptions,
    console: &mut Console<'_>,
) -> Result<Option<Chosen>> {
    let (file, wanted) = split_file_and_name(text);
    if !Path::new(file).is_file() {
        return Ok(None);
    }
    let table = spectra(&[PathBuf::from(file)], reading, console)?;
    let all = named_spectra(&table);
    let indices = match wanted {
        Some(wanted) => matching(&all, wanted)?,
        None => (0..all.len()).collect(),
    };
    let mut places = indices.into_iter().peekable();
    let taken = |(place, _): &(usize, NamedSpectrum)| places.next_if_eq(place).is_some();
    let spectra = all.into_iter().enumerate().filter(taken).map(|(_, one)| one).collect();
    Ok(Some(Chosen { file: file.to_owned(), grid: table.grid, spectra }))
}

/// The indices of the `spectra` called `wanted`, rising: the one of that name, or
/// all of the sample of that name.
pub(crate) fn matching(spectra: &[NamedSpectrum], wanted: &str) -> Result<Vec<usize>> {
    if let Some(index) = spectra.iter().position(|one| one.name == wanted) {
        return Ok(vec![index]);
    }
    let of_sample: Vec<usize> =
        (0..spectra.len()).filter(|&index| spectra[index].sample == wanted).collect();
    if !of_sample.is_empty() {
        return Ok(of_sample);
    }
    let mut known: Vec<&str> = spectra.iter().map(|one| one.sample.as_str()).collect();
    known.dedup();
    Err(Failure::data(
        format!("no spectrum is called `{wanted}`"),
        format!("samples: {}", first_few(&known, ", ")),
    ))
}

/// The first few of `names`, and how many more there are.
pub(crate) fn first_few(names: &[&str], between: &str) -> String {
    let listed = names[..names.len().min(LISTED)].join(between);
    match names.len().saturating_sub(LISTED) {
        0 => listed,
        more => format!("{listed} .. and {more} more"),
    }
}
