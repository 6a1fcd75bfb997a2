//! Readings of one name that are no repeated readings: those under several geometries, sides or doses, and
//! those in several files. Each gets a name of its own.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use documents::{counted, counted_as};
use spectra::headings::{ConditionKind, condition, with_condition};

use super::table::{Film, FilmKey, MeasurementTable, Reading, film};

/// Samples that were told apart by the columns of their conditions.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct SplitSamples {
    /// Heading of the first column that tells them apart.
    pub(super) heading: String,
    /// Row and name of the first sample, as the file has it.
    pub(super) row: u64,
    pub(super) sample: String,
    /// New name of the first reading.
    pub(super) example: String,
    /// Number of cells that differ in the readings of this sample.
    pub(super) count: usize,
    pub(super) is_geometry: bool,
}

impl SplitSamples {
    pub(super) fn remark(&self) -> String {
        let Self { heading, sample, example, count, .. } = self;
        format!(
            "samples are told apart by the column `{heading}`: {sample} has readings of {count} kinds, such as {example}"
        )
    }
}

/// Adds to the names of samples the conditions in which readings of one film differ.
pub(super) fn split_by_condition(readings: &mut [Reading]) -> Option<SplitSamples> {
    // Values of each heading by film, then the headings that differ by sample.
    let mut values: BTreeMap<FilmKey<'_>, BTreeMap<&str, BTreeSet<&str>>> = BTreeMap::new();
    for reading in readings.iter() {
        for (heading, value) in reading.conditions.iter().filter(|(_, value)| !value.is_empty()) {
            values.entry(film(reading)).or_default().entry(heading).or_default().insert(value);
        }
    }
    let mut differing: BTreeMap<String, BTreeMap<String, usize>> = BTreeMap::new();
    for ((sample, ..), headings) in values {
        for (heading, values) in headings.into_iter().filter(|(_, values)| values.len() > 1) {
            let known = differing.entry(sample.to_owned()).or_default();
            let count = known.entry(heading.to_owned()).or_default();
            *count = values.len().max(*count);
        }
    }
    let mut first: Option<SplitSamples> = None;
    for reading in readings.iter_mut() {
        let Some(headings) = differing.get(&reading.sample) else { continue };
        let mut name = reading.sample.clone();
        for (heading, value) in reading.conditions.iter().filter(|(_, value)| !value.is_empty()) {
            let Some(&count) = headings.get(&**heading) else { continue };
            name = with_condition(&name, heading, value);
            let is_geometry = condition(heading) == Some(ConditionKind::Geometry);
            let split = first.get_or_insert_with(|| SplitSamples {
                heading: heading.to_string(),
                row: reading.row,
                sample: reading.sample.clone(),
                example: name.clone(),
                count,
                is_geometry,
            });
            split.is_geometry |= is_geometry;
        }
        reading.sample = name;
    }
    first
}

/// Whether a remark says which readings are averaged. It does not hold if recipes tell them apart.
pub(crate) fn tells_of_means(remark: &str) -> bool {
    remark.contains(" is the mean of ")
}

/// A remark if readings of one film are averaged.
pub(super) fn repeated(readings: &[Reading]) -> Option<String> {
    let mut counts: BTreeMap<FilmKey<'_>, usize> = BTreeMap::new();
    for reading in readings {
        *counts.entry(film(reading)).or_default() += 1;
    }
    let first = readings.iter().find(|reading| counts[&film(reading)] > 1)?;
    let count = counts[&film(first)];
    let others = counts.values().filter(|count| **count > 1).count() - 1;
    let others = match others {
        0 => String::new(),
        1 => ", and so is 1 other".to_owned(),
        _ => format!(", and so are {others} others"),
    };
    let spectra = counted_as(counts.len(), "spectrum", "spectra");
    let all = readings.len();
    Some(format!("{all} readings, {spectra}: {} is the mean of {count}{others}", first.sample))
}

/// Name of `file` among `files`: without its folder, if no other has the same.
pub(super) fn label(file: &str, files: &BTreeSet<&str>) -> String {
    let short = |file: &str| {
        let name = Path::new(file).file_name();
        name.map_or_else(|| file.to_owned(), |name| name.to_string_lossy().into_owned())
    };
    let own = short(file);
    let is_shared = files.iter().any(|other| *other != file && short(other) == own);
    if is_shared { file.to_owned() } else { own }
}

/// Samples that occur in several of `tables`.
fn shared_samples(
    tables: &[MeasurementTable],
    is_counted: fn(&Reading) -> bool,
) -> BTreeSet<String> {
    let mut files: BTreeMap<&str, BTreeSet<&str>> = BTreeMap::new();
    let readings = tables.iter().flat_map(|table| &table.readings);
    for reading in readings.filter(|reading| is_counted(reading)) {
        files.entry(&reading.sample).or_default().insert(&reading.file);
    }
    let shared = files.into_iter().filter(|(_, files)| files.len() > 1);
    shared.map(|(sample, _)| sample.to_owned()).collect()
}

fn files(tables: &[MeasurementTable]) -> BTreeSet<String> {
    let readings = tables.iter().flat_map(|table: &MeasurementTable| &table.readings);
    readings.map(|reading| reading.file.to_string()).collect()
}

/// Names the samples that occur in several files by their files too, and returns a remark.
pub(crate) fn split_by_file(tables: &mut [MeasurementTable]) -> Option<String> {
    let shared = shared_samples(tables, |_| true);
    let files = files(tables);
    let files: BTreeSet<&str> = files.iter().map(String::as_str).collect();
    let mut example = None;
    for reading in tables.iter_mut().flat_map(|table| &mut table.readings) {
        if shared.contains(&reading.sample) {
            reading.sample = format!("{} ({})", reading.sample, label(&reading.file, &files));
            example.get_or_insert_with(|| reading.sample.clone());
        }
    }
    let example = example?;
    let count = counted(shared.len(), "name");
    let occur = if shared.len() == 1 { "occurs" } else { "occur" };
    Some(format!(
        "{count} {occur} in several files; such samples are named by their file: {example}"
    ))
}

/// Names readings by their files too if `is_wanted` says so of this name, such as `Blue (a.txt)`.
pub(super) fn name_by_file(table: &mut MeasurementTable, is_wanted: impl Fn(&str) -> bool) {
    let files: BTreeSet<String> = table.readings.iter().map(|r| r.file.to_string()).collect();
    let files: BTreeSet<&str> = files.iter().map(String::as_str).collect();
    for reading in &mut table.readings {
        let name = format!("{} ({})", reading.sample, label(&reading.file, &files));
        if is_wanted(&name) {
            reading.sample = name;
        }
    }
}

/// A remark if a sample occurs in several files, because its readings are averaged.
pub(crate) fn joined_over_files(tables: &[MeasurementTable]) -> Option<String> {
    let shared = shared_samples(tables, |reading| reading.film == Film::Paint);
    let first = shared.first()?;
    let files = files(tables);
    let files: BTreeSet<&str> = files.iter().map(String::as_str).collect();
    let readings = tables.iter().flat_map(|table| &table.readings);
    let file = readings.filter(|reading| reading.sample == *first).map(|reading| &reading.file);
    let file = file.map(|file| label(file, &files)).next().unwrap_or_default();
    let others = match shared.len() - 1 {
        0 => String::new(),
        1 => ", and so does 1 other sample".to_owned(),
        more => format!(", and so do {more} other samples"),
    };
    Some(format!(
        "{first} occurs in several files{others}: readings of one name and one recipe are averaged; recipes may name a reading by its file, such as `{first} ({file})`"
    ))
}

#[cfg(test)]
mod tests {
    use super::super::scale::ScaleChoice;
    use super::*;

    fn table(file: &str, text: &str) -> MeasurementTable {
        MeasurementTable::spectra_from_csv(file, text.as_bytes(), ScaleChoice::ByFile).unwrap()
    }

    fn names(table: &MeasurementTable) -> Vec<&str> {
        table.readings.iter().map(|reading| reading.sample.as_str()).collect()
    }

    #[test]
    fn geometries_sides_and_doses_are_samples_of_their_own() {
        for (heading, cells, wanted) in [
            ("Geometry", ["15as15", "45as15"], ["Blue 15as15", "Blue 45as15"]),
            ("Winkel", ["15", "45"], ["Blue Winkel 15", "Blue Winkel 45"]),
            ("Side", ["front", "back"], ["Blue front", "Blue back"]),
            ("Dose [MJ/m2]", ["0", "0.5"], ["Blue Dose 0", "Blue Dose 0.5"]),
            ("Date", ["1.1.", "2.1."], ["Blue", "Blue"]),
            ("Mode", ["M0", "M0"], ["Blue", "Blue"]),
        ] {
            let [a, b] = cells;
            let text = format!(
                "Name,{heading},400,410\nBlue,{a},0.1,0.1\nBlue,{b},0.3,0.3\nRed,{a},0.2,0.2\n"
            );
            let found = table("f", &text);
            assert_eq!(names(&found), [wanted[0], wanted[1], "Red"], "{heading}");
            let is_split = wanted[0] != wanted[1];
            let remark =
                if is_split { "told apart by the column" } else { "Blue is the mean of 2" };
            assert!(found.remarks[0].contains(remark), "{heading}: {:?}", found.remarks);
        }
    }

    #[test]
    fn samples_of_several_files_are_named_by_file() {
        let text = "sample,400,410\nBlue,0.1,0.1\nRed,0.3,0.3\n";
        let mut tables =
            vec![table("x/a.csv", text), table("x/b.csv", &text.replace("Red", "Ochre"))];
        assert!(joined_over_files(&tables).unwrap().starts_with("Blue occurs in several files:"));
        let remark = split_by_file(&mut tables).unwrap();
        assert!(remark.ends_with("Blue (a.csv)"), "{remark}");
        assert_eq!(names(&tables[0]), ["Blue (a.csv)", "Red"]);
        assert_eq!(names(&tables[1]), ["Blue (b.csv)", "Ochre"]);
        let mut alike = vec![table("x/a.csv", text), table("y/a.csv", text)];
        split_by_file(&mut alike);
        assert_eq!(names(&alike[1])[0], "Blue (y/a.csv)");
    }
}
