//! The column of a table that holds the names of its samples, by its heading.

use super::csv_row::CsvRow;

/// Headings of names in lower case without spaces and signs, the most telling first. Later ones
/// name samples only in tables without the earlier: running numbers, and the word that stands above
/// the names where wavelengths are the headings of all other columns.
const NAMES: [&str; 19] = [
    "sample",
    "samplename",
    "dataname",
    "usercolorname",
    "usercolourname",
    "colorname",
    "colourname",
    "name",
    "originalcolorname",
    "specimen",
    "swatch",
    "patch",
    "label",
    "sampleid",
    "sampleno",
    "samplenumber",
    "wavelength",
    "wavelengthnm",
    "nm",
];

/// First of [`NAMES`] that names samples only where all other columns are wavelengths.
const OVER_NAMES: &str = "wavelength";

/// Place of a heading among those that name samples, 0 for the most telling; `None` for any other.
pub(super) fn name_rank(heading: &str) -> Option<usize> {
    let letters = heading.chars().filter(|c| c.is_alphanumeric());
    let plain: String = letters.flat_map(char::to_lowercase).collect();
    NAMES.iter().position(|name| *name == plain)
}

/// The column of names among `headings`. `is_wavelength` says which of the headings are wavelengths: where
/// all the others are, an unnamed first column holds the names, and so does one headed `wavelength`.
pub(super) fn name_column(
    headings: &[&str],
    is_wavelength: impl Fn(&str) -> bool,
) -> Option<usize> {
    let ranked = headings.iter().enumerate();
    let ranked = ranked.filter_map(|(index, heading)| Some((name_rank(heading)?, index)));
    let others_are_wavelengths = |place: usize| {
        let mut others = headings.iter().enumerate().filter(|(index, _)| *index != place);
        headings.len() > 2 && others.all(|(_, heading)| is_wavelength(heading))
    };
    let over_names = NAMES.iter().position(|name| *name == OVER_NAMES).unwrap_or(NAMES.len());
    match ranked.min() {
        Some((rank, index)) if rank < over_names || others_are_wavelengths(index) => Some(index),
        _ => (headings.first() == Some(&"") && others_are_wavelengths(0)).then_some(0),
    }
}

/// The first of the columns `places` in which every row has a name; the first one if none has.
pub(super) fn filled_column(places: &[usize], rows: &[CsvRow]) -> Option<usize> {
    places
        .iter()
        .find(|place: &&usize| {
            rows.iter().all(|row| row.cells.get(**place).is_some_and(|name| !name.is_empty()))
        })
        .or(places.first())
        .copied()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(headings: &[&str]) -> Option<usize> {
        name_column(headings, |heading| heading.parse::<f64>().is_ok())
    }

    #[test]
    fn names_are_known_in_every_spelling_and_the_most_telling_is_taken() {
        for heading in
            ["sample", "Name", "SAMPLE_ID", "SampleName", "Data Name", "Color Name", "Sample-ID"]
        {
            assert_eq!(found(&["400", heading, "410"]), Some(1), "{heading}");
        }
        assert_eq!(found(&["SAMPLE_ID", "SAMPLE_NAME", "400"]), Some(1));
        assert_eq!(found(&["Red", "400", "410"]), None);
    }

    #[test]
    fn a_column_before_wavelengths_only_holds_names() {
        assert_eq!(found(&["wavelength", "400", "410"]), Some(0));
        assert_eq!(found(&["Wavelength (nm)", "400", "410"]), Some(0));
        assert_eq!(found(&["", "400", "410"]), Some(0));
        for headings in
            [["wavelength", "400", "Red"], ["wavelength", "Red", "Blue"], ["", "400", "Red"]]
        {
            assert_eq!(found(&headings), None, "{headings:?}");
        }
    }
}
