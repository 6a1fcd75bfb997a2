//! The spectra of a file by name: a sample may have several.

use calibrate::measurement::{Film, MeasurementTable, Reading};

use crate::failure::Refusal;

/// One averaged spectrum.
pub(crate) struct NamedSpectrum {
    /// Its sample.
    pub(crate) sample: String,
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
            NamedSpectrum { sample: first.sample.clone(), name, reflectance }
        })
        .collect()
}

/// The indices of the `(name, sample)` called `wanted`: the one of that name, or
/// all of the sample of that name.
pub(crate) fn matching(names: &[(&str, &str)], wanted: &str) -> anyhow::Result<Vec<usize>> {
    if let Some(index) = names.iter().position(|(name, _)| *name == wanted) {
        return Ok(vec![index]);
    }
    let of_sample: Vec<usize> = (0..names.len()).filter(|&i| names[i].1 == wanted).collect();
    if !of_sample.is_empty() {
        return Ok(of_sample);
    }
    let mut known: Vec<&str> = names.iter().map(|(_, sample)| *sample).collect();
    known.dedup();
    Err(Refusal::data(
        format!("no spectrum is called `{wanted}`"),
        format!("samples: {}", known.join(", ")),
    ))
}
