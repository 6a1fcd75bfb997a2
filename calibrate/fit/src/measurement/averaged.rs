//! Means of repeated readings, found by name.

use documents::hint::{Explain, Hint};
use documents::{did_you_mean, name_list};
use spectra::Grid;

use super::table::{Film, MeasurementTable, Reading};

/// Maximum number of names that a hint lists; chosen by eye.
const LISTED: usize = 8;

/// Mean of the repeated readings of one film or card.
#[derive(Debug, Clone, PartialEq)]
pub struct AveragedSpectrum {
    /// Name of the sample.
    pub sample: String,
    /// Whether paint or a bare backing was read.
    pub film: Film,
    /// Name of the sample, followed by backing and thickness if the sample has several spectra.
    pub name: String,
    /// Reflectance on the table's grid.
    pub reflectance: Vec<f64>,
}

/// Averaged spectra of a table.
#[derive(Debug, Clone, PartialEq)]
pub struct AveragedSpectra {
    /// Wavelengths of all spectra.
    pub grid: Grid,
    /// Spectra in the order of their first readings.
    pub spectra: Vec<AveragedSpectrum>,
}

impl MeasurementTable {
    /// Averages repeated readings: those of one sample on one backing with one thickness.
    #[must_use]
    pub fn averaged(&self) -> AveragedSpectra {
        let same = |a: &Reading, b: &Reading| {
            (&a.sample, a.film, &a.backing, a.thickness_mm)
                == (&b.sample, b.film, &b.backing, b.thickness_mm)
        };
        let mut groups: Vec<Vec<&Reading>> = Vec::new();
        for reading in &self.readings {
            match groups.iter_mut().find(|group| same(group[0], reading)) {
                Some(group) => group.push(reading),
                None => groups.push(vec![reading]),
            }
        }
        let averaged = |group: &Vec<&Reading>| {
            let first = group[0];
            let alone = groups.iter().filter(|other| other[0].sample == first.sample).count() == 1;
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
            let reflectance = (0..self.grid.count()).map(mean).collect();
            AveragedSpectrum { sample: first.sample.clone(), film: first.film, name, reflectance }
        };
        AveragedSpectra { grid: self.grid, spectra: groups.iter().map(averaged).collect() }
    }
}

impl AveragedSpectra {
    /// The spectrum with exactly this name, or else all of the sample with this name, in their
    /// order.
    ///
    /// # Errors
    /// [`SpectrumNameError::Unknown`] if there is none.
    pub fn find(&self, name: &str) -> Result<Vec<&AveragedSpectrum>, SpectrumNameError> {
        if let Some(spectrum) = self.spectra.iter().find(|spectrum| spectrum.name == name) {
            return Ok(vec![spectrum]);
        }
        let found: Vec<&AveragedSpectrum> =
            self.spectra.iter().filter(|spectrum| spectrum.sample == name).collect();
        if found.is_empty() {
            let mut samples: Vec<String> = self.spectra.iter().map(|s| s.sample.clone()).collect();
            samples.dedup();
            return Err(SpectrumNameError::Unknown { name: name.to_owned(), samples });
        }
        Ok(found)
    }

    /// The one spectrum with this name, or of the sample with this name.
    ///
    /// # Errors
    /// [`SpectrumNameError`] if there is none, or several.
    pub fn find_one(&self, name: &str) -> Result<&AveragedSpectrum, SpectrumNameError> {
        match self.find(name)?.as_slice() {
            &[spectrum] => Ok(spectrum),
            several => Err(SpectrumNameError::Several {
                name: name.to_owned(),
                spectra: several.iter().map(|spectrum| spectrum.name.clone()).collect(),
            }),
        }
    }
}

/// A name that does not denote one spectrum.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum SpectrumNameError {
    /// No spectrum and no sample has this name.
    #[error("no spectrum is called `{name}`")]
    Unknown {
        /// The name that no spectrum has.
        name: String,
        /// Names of all samples.
        samples: Vec<String>,
    },
    /// The sample has several spectra, of which one is needed.
    #[error("`{name}` has several spectra")]
    Several {
        /// Name of the sample.
        name: String,
        /// Names of its spectra.
        spectra: Vec<String>,
    },
}

impl Explain for SpectrumNameError {
    fn hint(&self) -> Option<Hint> {
        Some(Hint::verbatim(match self {
            Self::Unknown { name, samples } => {
                let question = did_you_mean(name, samples.iter().map(String::as_str));
                let question = question.map_or_else(String::new, |question| question + " ");
                format!("{question}samples: {}", name_list(samples, LISTED, ", "))
            }
            Self::Several { spectra, .. } => format!("select one of them: {}", spectra.join(", ")),
        }))
    }
}
