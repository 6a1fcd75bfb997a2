//! Swatches: all readings of one sample, averaged, and the cards on which they were painted.

use std::collections::BTreeMap;
use std::sync::Arc;

use pigment::palette::Cards;
use spectra::{Grid, TristimulusWeights};

use crate::measurement::{CellPlace, Film, MeasurementError, MeasurementTable, Reading};

/// One painted sample, with its recipe and its averaged films.
#[derive(Debug, Clone, PartialEq)]
pub struct Swatch {
    /// Name of the sample.
    pub sample: String,
    /// File of the first reading.
    pub file: Arc<str>,
    /// Row of the first reading in that file.
    pub row: u64,
    /// Amount of each pigment of the set, as written in the file.
    pub amounts: Vec<f64>,
    /// Share of each pigment of the set, sum 1.
    pub shares: Vec<f64>,
    /// Films of the sample by backing and thickness; at least one.
    pub films: Vec<SwatchFilm>,
}

/// Averaged readings of one film on one backing.
#[derive(Debug, Clone, PartialEq)]
pub struct SwatchFilm {
    /// Name of the backing, or empty if the file does not state it.
    pub backing: String,
    /// Thickness of the film in mm, if known.
    pub thickness_mm: Option<f64>,
    /// Mean measured reflectance, as a fraction, on the set's grid.
    pub reflectance: Vec<f64>,
    /// Standard deviation of repeated readings, root mean square over wavelengths. `None` for a single
    /// reading.
    pub spread: Option<f64>,
    /// Measured reflectance of the bare backing, if you read it: the sample's own card, else the mean over
    /// the file.
    pub bare: Option<Vec<f64>>,
}

/// All swatches of the measurement files, in order of first appearance.
#[derive(Debug, Clone, PartialEq)]
pub struct SwatchSet {
    /// Wavelengths of every reflectance.
    pub grid: Grid,
    /// Names of the pigments, in order of their columns.
    pub pigments: Vec<String>,
    /// Swatches. This is empty if the files hold bare cards only.
    pub swatches: Vec<Swatch>,
}

impl SwatchSet {
    /// Groups the readings of `table` by sample, averages repeated readings, and finds the bare backing of
    /// each film.
    ///
    /// # Errors
    /// [`MeasurementError::Contradiction`] if rows of one sample have different recipes,
    /// [`MeasurementError::NoRecipe`] for paint without a pigment, [`MeasurementError::NoFilms`] if there
    /// are bare cards only.
    pub fn from_table(table: &MeasurementTable) -> Result<Self, MeasurementError> {
        let cards = BareCards::of(table);
        let mut order: Vec<&str> = Vec::new();
        let mut by_sample: BTreeMap<&str, Vec<&Reading>> = BTreeMap::new();
        for reading in table.readings.iter().filter(|r| r.film == Film::Paint) {
            let readings = by_sample.entry(&reading.sample).or_default();
            if readings.is_empty() {
                order.push(&reading.sample);
            }
            readings.push(reading);
        }
        let swatches: Vec<Swatch> = order
            .into_iter()
            .map(|sample| swatch(table, sample, &by_sample[sample], &cards))
            .collect::<Result<_, _>>()?;
        if swatches.is_empty() {
            return Err(MeasurementError::NoFilms);
        }
        let all = Self { grid: table.grid, pigments: table.pigments.clone(), swatches };
        // Drops the columns without any amount.
        Ok(all.retaining(|_| true))
    }

    /// Copy with the swatches that `keep` selects. Pigments that none of them contains are dropped.
    #[must_use]
    pub fn retaining(&self, keep: impl Fn(&Swatch) -> bool) -> Self {
        let swatches: Vec<Swatch> = self.swatches.iter().filter(|s| keep(s)).cloned().collect();
        let used: Vec<bool> = (0..self.pigments.len())
            .map(|index| swatches.iter().any(|s| s.amounts[index] > 0.0))
            .collect();
        let only_used = |values: &[f64]| -> Vec<f64> {
            values.iter().zip(&used).filter(|(_, used)| **used).map(|(v, _)| *v).collect()
        };
        let swatches = swatches
            .into_iter()
            .map(|swatch| Swatch {
                amounts: only_used(&swatch.amounts),
                shares: only_used(&swatch.shares),
                ..swatch
            })
            .collect();
        let pigments =
            self.pigments.iter().zip(&used).filter(|(_, used)| **used).map(|(p, _)| p.clone());
        Self { grid: self.grid, pigments: pigments.collect(), swatches }
    }

    /// Mixtures with amounts that do not sum to 100 % (or 1), with their sum in percent. If most mixtures
    /// have other sums, you get an empty list, because the file states parts.
    #[must_use]
    pub fn uneven_recipes(&self) -> Vec<(&str, f64)> {
        // You may write a masstone as 1 where you count mixtures in parts.
        let mixtures: Vec<&Swatch> = self
            .swatches
            .iter()
            .filter(|s: &&Swatch| s.amounts.iter().filter(|a| **a > 0.0).count() > 1)
            .collect();
        let totals: Vec<f64> = mixtures.iter().map(|s| s.amounts.iter().sum()).collect();
        for whole in [100.0, 1.0] {
            let even = |total: f64| (total / whole - 1.0).abs() < 1e-3;
            if 2 * totals.iter().filter(|t| even(**t)).count() > totals.len() {
                let pairs = mixtures.into_iter().zip(totals);
                return pairs
                    .filter(|(_, total)| !even(*total))
                    .map(|(swatch, total)| (swatch.sample.as_str(), 100.0 * total / whole))
                    .collect();
            }
        }
        Vec::new()
    }
}

/// Mean readings of bare backings: by sample and backing, and by backing alone.
struct BareCards {
    own: BTreeMap<(String, String), Vec<f64>>,
    any: BTreeMap<String, Vec<f64>>,
}

impl BareCards {
    fn of(table: &MeasurementTable) -> Self {
        let mut own: BTreeMap<(String, String), Vec<&Reading>> = BTreeMap::new();
        let mut any: BTreeMap<String, Vec<&Reading>> = BTreeMap::new();
        for reading in table.readings.iter().filter(|r| r.film == Film::None) {
            let backing = reading.backing.to_string();
            own.entry((reading.sample.clone(), backing.clone())).or_default().push(reading);
            any.entry(backing).or_default().push(reading);
        }
        Self {
            own: own.into_iter().map(|(key, group)| (key, mean(&group))).collect(),
            any: any.into_iter().map(|(key, group)| (key, mean(&group))).collect(),
        }
    }

    fn under(&self, sample: &str, backing: &str) -> Option<Vec<f64>> {
        let own = self.own.get(&(sample.to_owned(), backing.to_owned()));
        own.or_else(|| self.any.get(backing)).cloned()
    }
}

fn swatch(
    table: &MeasurementTable,
    sample: &str,
    readings: &[&Reading],
    cards: &BareCards,
) -> Result<Swatch, MeasurementError> {
    let first = readings[0];
    for reading in &readings[1..] {
        if let Some(index) = first
            .amounts
            .iter()
            .zip(&reading.amounts)
            .position(|(a, b): (&f64, &f64)| (a - b).abs() > 1e-9 * a.abs().max(b.abs()))
        {
            return Err(MeasurementError::Contradiction {
                place: CellPlace::new(&reading.file, reading.row, &table.pigments[index]),
                sample: sample.to_owned(),
                first_file: Arc::clone(&first.file),
                first_row: first.row,
                amount: reading.amounts[index],
            });
        }
    }
    let total: f64 = first.amounts.iter().sum();
    if total <= 0.0 {
        return Err(MeasurementError::NoRecipe {
            file: first.file.to_string(),
            row: first.row,
            sample: sample.to_owned(),
            has_cards: table.readings.iter().any(|reading| reading.film == Film::None),
        });
    }
    let mut films: Vec<SwatchFilm> = Vec::new();
    for reading in readings {
        if films.iter().any(|other: &SwatchFilm| {
            *other.backing == *reading.backing && other.thickness_mm == reading.thickness_mm
        }) {
            continue;
        }
        let group: Vec<&Reading> = readings
            .iter()
            .filter(|r| r.backing == reading.backing && r.thickness_mm == reading.thickness_mm)
            .copied()
            .collect();
        films.push(SwatchFilm {
            backing: reading.backing.to_string(),
            thickness_mm: reading.thickness_mm,
            reflectance: mean(&group),
            spread: spread(&group),
            bare: cards.under(sample, &reading.backing),
        });
    }
    Ok(Swatch {
        sample: sample.to_owned(),
        file: Arc::clone(&first.file),
        row: first.row,
        amounts: first.amounts.to_vec(),
        shares: first.amounts.iter().map(|amount| amount / total).collect(),
        films,
    })
}

fn mean(readings: &[&Reading]) -> Vec<f64> {
    let count = readings.len() as f64;
    (0..readings[0].reflectance.len())
        .map(|w| readings.iter().map(|r| r.reflectance[w]).sum::<f64>() / count)
        .collect()
}

fn spread(readings: &[&Reading]) -> Option<f64> {
    if readings.len() < 2 {
        return None;
    }
    let mean = mean(readings);
    let freedom = ((readings.len() - 1) * mean.len()) as f64;
    let squares: f64 = readings
        .iter()
        .flat_map(|r| r.reflectance.iter().zip(&mean).map(|(v, m)| (v - m).powi(2)))
        .sum();
    Some((squares / freedom).sqrt())
}

impl SwatchSet {
    /// Cards under the films of this set, chosen by [`Cards::among`]. You get the standard cards if the set
    /// is on another grid than `weights`.
    #[must_use]
    pub fn cards(&self, weights: &TristimulusWeights) -> Cards {
        if self.grid != weights.grid() {
            return Cards::standard(weights.grid());
        }
        Cards::among(bare_backings(self), weights)
    }
}

/// Mean bare reflectance of each backing over the films that lie on it.
fn bare_backings(set: &SwatchSet) -> Vec<Vec<f64>> {
    let films = || set.swatches.iter().flat_map(|swatch| &swatch.films);
    let mut names: Vec<&str> = films().map(|film| film.backing.as_str()).collect();
    names.sort_unstable();
    names.dedup();
    names
        .into_iter()
        .filter_map(|name: &str| {
            let bare: Vec<&[f64]> = films()
                .filter(|film| film.backing == name)
                .filter_map(|film| film.bare.as_deref())
                .collect();
            let means = (0..set.grid.count())
                .map(|at| bare.iter().map(|card| card[at]).sum::<f64>() / bare.len() as f64);
            (!bare.is_empty()).then(|| means.collect())
        })
        .collect()
}
