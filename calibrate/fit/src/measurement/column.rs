//! Meaning of the columns of a measurement file, found from their headers.
//!
//! Instruments' programs write a title or lines about the measurement above the headings, and spreadsheets
//! write a line `sep=;`. We find here the row of headings, the column of names, and columns of colour
//! coordinates, which we skip.

use spectra::csv_table::{CellPlace, CsvTableError, wavelength_of_header};

use super::error::MeasurementError;

#[derive(Debug, Clone, PartialEq)]
pub(super) enum Column {
    Sample,
    Film,
    Backing,
    Thickness,
    Replicate,
    /// In a file of recipes: the name of the reading in the measurement file.
    Reading,
    /// Notes of an instrument or its user; not a pigment.
    Ignored,
    Pigment(String),
    Wavelength(f64),
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum TableKind {
    /// Readings, with wavelengths.
    Readings,
    /// Recipes, without wavelengths.
    Recipes,
}

/// Returns the meaning of each column of a header row. `place` tells errors where a header stands in the
/// file. If you pass `pigments`, only these headings name pigments. Otherwise every unknown heading does.
/// We check that there is a column of names, that no name occurs twice and that wavelengths rise or fall
/// throughout.
pub(super) fn columns(
    place: &dyn Fn(usize) -> CellPlace,
    headers: &[String],
    kind: TableKind,
    pigments: Option<&[String]>,
) -> Result<Vec<Column>, MeasurementError> {
    // A header such as R254 may be a pigment (e.g. Pigment Red 254) or a wavelength.
    let letters = kind == TableKind::Readings
        && !headers.iter().any(|header: &String| {
            let lower = header.trim().to_ascii_lowercase();
            !is_letter_and_number(&lower) && wavelength_of_header(&lower).is_some()
        });
    let names: Vec<&str> = headers.iter().map(|header| header.trim()).collect();
    let sample = name_column(&names, is_wavelength_heading);
    let has_included = names.iter().any(|name| has_word(name, "sci"));
    let mut columns = Vec::with_capacity(headers.len());
    for (index, &name) in names.iter().enumerate() {
        if Some(index) == sample {
            columns.push(Column::Sample);
            continue;
        }
        // We know row numbers, which programs for statistics write first, by their missing heading.
        if names[..=index].iter().all(|name| name.is_empty()) {
            columns.push(Column::Ignored);
            continue;
        }
        if name.is_empty() {
            let CellPlace { file, row, .. } = place(index);
            let number = index + 1;
            return Err(MeasurementError::UnnamedColumn { file, row, number });
        }
        if let Some(before) = headers[..index].iter().position(|h| h.trim() == name) {
            return Err(MeasurementError::RepeatedColumn {
                place: place(index),
                first: before + 1,
                second: index + 1,
            });
        }
        if name.contains(char::is_control) {
            return Err(MeasurementError::Sheet(CsvTableError::Cell {
                place: place(index),
                wanted: "a name without control characters",
                text: name.escape_default().to_string(),
            }));
        }
        let column = match name.to_ascii_lowercase().as_str() {
            "reading" if kind == TableKind::Recipes => Some(Column::Reading),
            // Readings without the specular component beside those with it are other readings.
            _ if has_included && excludes_specular(name) => Some(Column::Ignored),
            _ => column(name, letters),
        };
        columns.push(
            match (column.ok_or_else(|| MeasurementError::WavelengthRange(place(index)))?, pigments)
            {
                (Column::Pigment(_) | Column::Ignored, Some(names))
                    if names.iter().any(|pigment| pigment == name) =>
                {
                    Column::Pigment(name.to_owned())
                }
                (Column::Pigment(_), Some(_)) => Column::Ignored,
                (Column::Pigment(_), None) if is_coordinate(headers, index) => Column::Ignored,
                (column, _) => column,
            },
        );
    }
    let file = headers.first().map_or_else(String::new, |_| place(0).file);
    if !columns.contains(&Column::Sample) {
        let column = "sample";
        return Err(MeasurementError::Sheet(CsvTableError::MissingColumn { file, column }));
    }
    let wavelengths = columns.iter().enumerate().filter_map(|(index, column)| match column {
        Column::Wavelength(nm) => Some((index, *nm)),
        _ => None,
    });
    let wavelengths: Vec<(usize, f64)> = wavelengths.collect();
    if wavelengths.is_empty() && kind == TableKind::Readings {
        let column = "400 (a wavelength in nm)";
        return Err(MeasurementError::Sheet(CsvTableError::MissingColumn { file, column }));
    }
    let falls = wavelengths.len() > 1 && wavelengths[1].1 < wavelengths[0].1;
    for pair in wavelengths.windows(2) {
        let (_, before) = pair[0];
        let (index, nm) = pair[1];
        if nm == before {
            return Err(MeasurementError::RepeatedWavelength { place: place(index), nm });
        }
        if (nm < before) != falls {
            return Err(MeasurementError::UnorderedWavelength { place: place(index), before, nm });
        }
    }
    Ok(columns)
}

pub(super) fn is_wavelength_heading(heading: &str) -> bool {
    let nm = wavelength_of_header(&heading.trim().to_ascii_lowercase());
    nm.is_some_and(|nm| MEASURABLE_NM.contains(&nm))
}

/// Whether `heading` names readings without the specular component, for example `SCE 400nm`.
pub(super) fn excludes_specular(heading: &str) -> bool {
    has_word(heading, "sce") && is_wavelength_heading(heading)
}

/// Whether a heading in lower case is a single letter before a number, such as `r254`, which may
/// name a pigment.
fn is_letter_and_number(lower: &str) -> bool {
    let number = lower.strip_prefix(['r', 'x']);
    number.is_some_and(|number| number.trim().parse::<f64>().is_ok())
}

fn has_word(heading: &str, word: &str) -> bool {
    let words = heading.split(|c: char| !c.is_ascii_alphabetic());
    words.into_iter().any(|found| found.eq_ignore_ascii_case(word))
}

/// Meaning of the header `name`, or `None` for a number outside the wavelengths at which you measure
/// paint. `letters` says whether `R400` is a wavelength. It is a pigment if other headers of the table are
/// plain numbers.
fn column(name: &str, letters: bool) -> Option<Column> {
    let lower = name.to_ascii_lowercase();
    match lower.as_str() {
        "film" => Some(Column::Film),
        "backing" => Some(Column::Backing),
        "thickness_mm" => Some(Column::Thickness),
        "replicate" => Some(Column::Replicate),
        lower if NO_PIGMENTS.contains(&lower) => Some(Column::Ignored),
        // Another column holds the names.
        lower if name_rank(lower).is_some() => Some(Column::Ignored),
        _ => match wavelength_of_header(&lower) {
            Some(nm) if !is_letter_and_number(&lower) => {
                MEASURABLE_NM.contains(&nm).then_some(Column::Wavelength(nm))
            }
            Some(nm) if letters && MEASURABLE_NM.contains(&nm) => Some(Column::Wavelength(nm)),
            _ => Some(Column::Pigment(name.to_owned())),
        },
    }
}

/// Whether we read a column headed `name` as a pigment, in a file with plain numbers as wavelengths.
#[must_use]
pub fn names_a_pigment(name: &str) -> bool {
    let plain = !name.is_empty() && name.trim() == name && !name.contains(char::is_control);
    plain && matches!(column(name, false), Some(Column::Pigment(_)))
}

/// Wavelengths in nm at which instruments for paint measure.
pub(super) const MEASURABLE_NM: std::ops::RangeInclusive<f64> = 200.0..=2500.0;

/// Headings of instruments' tables and of notes, none of which is the name of a pigment.
const NO_PIGMENTS: [&str; 47] = [
    "no",
    "no.",
    "nr",
    "nr.",
    "#",
    "id",
    "index",
    "row",
    "batch",
    "gloss",
    "temperature",
    "humidity",
    "remark",
    "l*",
    "a*",
    "b*",
    "c*",
    "h*",
    "hue",
    "chroma",
    "lab_l",
    "lab_a",
    "lab_b",
    "xyz_x",
    "xyz_y",
    "xyz_z",
    "rgb_r",
    "rgb_g",
    "rgb_b",
    "cie l*",
    "cie a*",
    "cie b*",
    "date",
    "time",
    "datetime",
    "instrument",
    "serial",
    "serial number",
    "operator",
    "user",
    "comment",
    "comments",
    "illuminant",
    "observer",
    "geometry",
    "aperture",
    "filter",
];

/// Headings of columns of names in lower case without spaces and signs, the most specific first. We use a
/// later one only if a table has none of the earlier ones. The last ones are numbers of samples, and the
/// word `wavelength`, which stands above the names in tables where all other columns are wavelengths.
const NAMES: [&str; 32] = [
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
    "pigment",
    "paint",
    "material",
    "color",
    "colour",
    "title",
    "filename",
    "file",
    "code",
    "id",
    "number",
    "no",
    "nr",
    "wavelength",
    "wavelengthnm",
    "nm",
];

/// First of [`NAMES`] that stands above other columns too. We say that we took it for the names.
const GUESSED: &str = "pigment";

/// Whether a column headed `heading` usually holds something else than the names of samples.
pub(super) fn is_guessed_name(heading: &str) -> bool {
    let first = NAMES.iter().position(|name| *name == GUESSED).unwrap_or(NAMES.len());
    name_rank(heading).is_some_and(|rank| rank >= first)
}

/// First of [`NAMES`] that names samples only where all other columns are wavelengths.
const OVER_NAMES: &str = "wavelength";

/// Rank of a heading among the headings that name samples, 0 for the most specific. `None` for any other
/// heading.
pub(super) fn name_rank(heading: &str) -> Option<usize> {
    let letters = heading.chars().filter(|c| c.is_alphanumeric());
    let plain: String = letters.flat_map(char::to_lowercase).collect();
    NAMES.iter().position(|name| *name == plain)
}

/// The column of names among `headings`. You say with `is_wavelength` which of the headings are
/// wavelengths. If all the others are, we take an unnamed first column for the names, and also one headed
/// `wavelength`.
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

/// The first of the columns `places` in which every row has a name, or the first one if none has.
pub(super) fn filled_column(places: &[usize], rows: &[CsvRow]) -> Option<usize> {
    places
        .iter()
        .find(|place: &&usize| {
            rows.iter().all(|row| row.cells.get(**place).is_some_and(|name| !name.is_empty()))
        })
        .or(places.first())
        .copied()
}

/// We look for the headings in this many lines at most (chosen by eye).
const MOST_ABOVE: usize = 200;

/// Separators of cells, in the order in which they are tried.
const SEPARATORS: [u8; 3] = [b',', b';', b'\t'];

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct HeadingRow {
    /// The character between cells, an ASCII character.
    pub(super) separator: u8,
    /// Number of bytes of the text before the row.
    pub(super) offset: usize,
}

impl HeadingRow {
    /// Finds the headings of a table in `text`. If a cell of the first line is `sample`, it is this line.
    /// Otherwise we take the row with the most wavelengths (of a file of recipes, the most cells) among
    /// those with a column for names.
    pub(super) fn of(text: &str, kind: TableKind) -> Option<Self> {
        let mut best: Option<(usize, Self)> = None;
        let mut offset = 0;
        let mut is_first = true;
        for line in text.split_inclusive(['\n', '\r']).take(2 * MOST_ABOVE) {
            let at = offset;
            offset += line.len();
            if line.trim().is_empty() {
                continue;
            }
            for separator in SEPARATORS {
                let cells = cells(line, separator);
                let found = Self { separator, offset: at };
                if is_first && cells.iter().any(|cell| cell.eq_ignore_ascii_case("sample")) {
                    return Some(found);
                }
                if let Some(score) = score(&cells, kind)
                    && best.is_none_or(|(most, _)| score > most)
                {
                    best = Some((score, found));
                }
            }
            is_first = false;
        }
        best.map(|(_, found)| found)
    }

    /// The first row that is not empty, with the separator that occurs most often in it.
    pub(super) fn first(text: &str) -> Self {
        let offset = text.len() - text.trim_start_matches(['\n', '\r', ' ']).len();
        let line = text[offset..].lines().next().unwrap_or_default();
        // We search the maximum from behind, to get the first of several.
        let separators = SEPARATORS.into_iter().rev();
        let separator = separators
            .max_by_key(|separator| line.bytes().filter(|byte| byte == separator).count())
            .unwrap_or(b',');
        Self { separator, offset }
    }
}

/// Score of a row: the number of its wavelengths, or of its cells in a file of recipes. The row of
/// headings has the highest. `None` if it has no column for names, or only this column.
fn score(cells: &[String], kind: TableKind) -> Option<usize> {
    let names: Vec<&str> = cells.iter().map(String::as_str).collect();
    let wavelengths = names.iter().filter(|cell| is_wavelength_heading(cell)).count();
    match kind {
        TableKind::Readings => {
            name_column(&names, is_wavelength_heading)?;
            (wavelengths > 1).then_some(wavelengths)
        }
        TableKind::Recipes => {
            names.iter().find_map(|name| name_rank(name))?;
            (names.len() > 1).then_some(names.len())
        }
    }
}

/// The cells of a line, without empty ones at its end.
fn cells(line: &str, separator: u8) -> Vec<String> {
    let mut reader = csv::ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .trim(csv::Trim::All)
        .delimiter(separator)
        .from_reader(line.as_bytes());
    let record = reader.records().next().and_then(Result::ok).unwrap_or_default();
    let mut cells: Vec<String> = record.iter().map(plain_heading).collect();
    while cells.last().is_some_and(String::is_empty) {
        cells.pop();
    }
    cells
}

/// A heading, with a decimal point for a decimal comma: `400,5` becomes `400.5`.
pub(super) fn plain_heading(heading: &str) -> String {
    let pointed = heading.replace(',', ".");
    if pointed.parse::<f64>().is_ok() { pointed } else { heading.to_owned() }
}

/// Coordinates of colour as tables of instruments write them. We recognise a coordinate only if the table
/// has several of its row.
const COORDINATES: [&[&str]; 6] = [
    &["L", "a", "b"],
    &["L", "C", "h"],
    &["L", "u", "v"],
    &["X", "Y", "Z"],
    &["x", "y", "Y"],
    &["R", "G", "B"],
];

/// Whether the heading at `index` is a coordinate of a colour space, and the table has others of this
/// space.
pub(super) fn is_coordinate(headings: &[String], index: usize) -> bool {
    let has = |name: &str| headings.iter().any(|heading| heading.trim() == name);
    let own = headings[index].trim();
    COORDINATES.iter().any(|set| {
        set.contains(&own) && has(set[0]) && set.iter().filter(|name| has(name)).count() > 1
    })
}

/// Cells of a row below the header, and the number of the row in the file, from 1.
pub(super) struct CsvRow {
    pub(super) number: u64,
    pub(super) cells: csv::StringRecord,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn headers_of_wavelengths_are_read_in_every_spelling() {
        for header in
            ["400", "400nm", "400 nm", "R400", "SPEC_400", "nm400", "400.0", "400[nm]", "R400 nm"]
        {
            assert_eq!(column(header, true), Some(Column::Wavelength(400.0)), "{header}");
        }
        assert_eq!(column("381.2", true), Some(Column::Wavelength(381.2)));
        assert_eq!(column("Red Ochre", true), Some(Column::Pigment("Red Ochre".into())));
        assert_eq!(column("PB29", true), Some(Column::Pigment("PB29".into())));
        assert_eq!(column("99999", true), None);
    }

    #[test]
    fn wavelengths_fall_or_rise_and_turn_nowhere() {
        let falling = columns_of("Name,700,600,500", TableKind::Readings).unwrap();
        assert_eq!(falling[1], Column::Wavelength(700.0));
        assert_eq!(
            columns_of("Name,700,500,600", TableKind::Readings).unwrap_err(),
            "f, row 3, column `600`: wavelengths must rise or fall throughout, found 600 nm after 500 nm"
        );
        let error = columns_of("Name,700,600,600nm", TableKind::Readings).unwrap_err();
        assert!(error.contains("600 nm occurs twice"), "{error}");
    }

    fn columns_of(headings: &str, kind: TableKind) -> Result<Vec<Column>, String> {
        let names: Vec<String> = headings.split(',').map(str::to_owned).collect();
        columns(&|index| CellPlace::new("f", 3, &names[index]), &names, kind, None)
            .map_err(|error| error.to_string())
    }

    #[test]
    fn readings_without_the_specular_component_are_ignored_beside_those_with_it() {
        let both = "Data Name,SCI 400nm,SCI 410nm,SCE 400nm,SCE 410nm";
        let both = columns_of(both, TableKind::Readings).unwrap();
        let nm = Column::Wavelength;
        assert_eq!(both[1..], [nm(400.0), nm(410.0), Column::Ignored, Column::Ignored]);
        let one = "Data Name,SCE 400nm,SCE 410nm,SCE 420nm,L*(D65)";
        let one = columns_of(one, TableKind::Readings).unwrap();
        assert_eq!(one[1..4], [nm(400.0), nm(410.0), nm(420.0)]);
    }

    #[test]
    fn a_letter_with_a_number_is_a_pigment_beside_plain_wavelengths() {
        let beside = columns_of("sample,R254,R101,400", TableKind::Readings).unwrap();
        assert_eq!(beside[1], Column::Pigment("R254".into()));
        let alone = columns_of("sample,R101,R400,R500", TableKind::Readings).unwrap();
        assert_eq!(alone[1], Column::Pigment("R101".into()));
        assert_eq!(alone[2], Column::Wavelength(400.0));
        let recipe = columns_of("sample,R254,a*", TableKind::Recipes).unwrap();
        assert_eq!(recipe[1], Column::Pigment("R254".into()));
        assert_eq!(recipe[2], Column::Ignored);
    }

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
    fn other_columns_of_text_are_names_where_there_is_no_better_one() {
        for heading in
            ["ID", "Pigment", "Paint", "Colour", "File", "Code", "Material", "Title", "No."]
        {
            assert_eq!(found(&[heading, "400", "410"]), Some(0), "{heading}");
            assert_eq!(found(&[heading, "400", "sample"]), Some(2), "{heading}");
            assert!(is_guessed_name(heading) && !is_guessed_name("sample"), "{heading}");
        }
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

    fn heading_row(text: &str, kind: TableKind) -> Option<(char, usize)> {
        HeadingRow::of(text, kind).map(|row| (char::from(row.separator), row.offset))
    }

    #[test]
    fn lines_above_the_headings_are_passed_over() {
        assert_eq!(readings("sample,400\n"), Some((',', 0)));
        assert_eq!(readings("My paints\n\nName;400;410\n"), Some((';', 11)));
        assert_eq!(readings("sep=;\r\nName,Anna\r\nName;400,5;410,5\r\n"), Some((';', 18)));
        assert_eq!(readings("Date\t1.1.26\nwavelength\t400\t410\nA\t1\t2\n"), Some(('\t', 12)));
        assert_eq!(readings("Name,Anna\nwavelength,Red,Blue\n400,1,2\n"), None);
        assert_eq!(readings("400,1\n410,2\n"), None);
        assert_eq!(readings("Name,500\nwavelength,Red\n400,1\n"), None, "a name that is a number");
    }

    fn readings(text: &str) -> Option<(char, usize)> {
        heading_row(text, TableKind::Readings)
    }

    #[test]
    fn recipes_have_the_row_with_the_most_cells() {
        assert_eq!(
            heading_row("Name,Anna\nName,White,Red\nw,1,\n", TableKind::Recipes),
            Some((',', 10))
        );
        assert_eq!(heading_row("White,Red\n1,2\n", TableKind::Recipes), None);
    }
}
