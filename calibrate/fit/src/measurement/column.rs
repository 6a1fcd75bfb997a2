//! Meaning of the columns of a measurement file, found from their headers.
//!
//! We find here the column of names, and the columns of colours and notes, which we skip.

use std::collections::{BTreeMap, BTreeSet};

use documents::name_violation;
use spectra::csv_table::{CellPlace, CsvTableError, wavelength_of_header};
use spectra::headings::{self, condition, is_wavelength, name_rank, plain, without_unit};

use super::error::MeasurementError;
use super::scale::MEASURABLE_NM;

#[derive(Debug, Clone, PartialEq)]
pub(super) enum Column {
    Sample,
    Film,
    Backing,
    Thickness,
    Replicate,
    /// In a file of recipes: the name of the reading in the measurement file.
    Reading,
    /// A property under which samples are read several times, e.g. a geometry.
    Condition,
    /// Notes of an instrument or its user; not a pigment.
    Ignored,
    Pigment(String),
    Wavelength(f64),
    /// A wavelength at which no colour instrument measures.
    Outside(f64),
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum TableKind {
    /// Readings, with wavelengths.
    Readings,
    /// Readings of which only names, films and wavelengths matter.
    Spectra,
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
    let letters = kind != TableKind::Recipes
        && !headers.iter().any(|header: &String| {
            let lower = header.trim().to_ascii_lowercase();
            !is_letter_and_number(&lower) && wavelength_of_header(&lower).is_some()
        });
    let names: Vec<&str> = headers.iter().map(|header| header.trim()).collect();
    let sample = name_column(&names, is_wavelength_heading);
    let coordinates = coordinates_of(headers);
    let listed_names: Option<BTreeSet<&str>> =
        pigments.map(|names| names.iter().map(String::as_str).collect());
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
        if let Some(wanted) = name_violation(name) {
            let place = place(index);
            let text = name.to_owned();
            return Err(MeasurementError::Sheet(CsvTableError::Cell { place, wanted, text }));
        }
        // `Red [%]` and `Red (g)` are the pigment Red.
        let bare = without_unit(name).0;
        let listed =
            listed_names.as_ref().map(|names| names.contains(name) || names.contains(bare));
        let column = match column(name, letters) {
            _ if kind == TableKind::Recipes && is_reading(name) => Column::Reading,
            // Readings without the specular component beside those with it are other readings.
            _ if has_included && excludes_specular(name) => Column::Ignored,
            Column::Pigment(_)
            | Column::Ignored
            | Column::Condition
            | Column::Outside(_)
            | Column::Wavelength(_)
                if listed == Some(true) =>
            {
                let is_own = listed_names.as_ref().is_some_and(|names| names.contains(name));
                Column::Pigment(if is_own { name } else { bare }.to_owned())
            }
            Column::Pigment(_) if listed == Some(false) || kind == TableKind::Spectra => {
                Column::Ignored
            }
            Column::Pigment(_) if coordinates.contains(&index) => Column::Ignored,
            column => column,
        };
        columns.push(column);
    }
    decide_outside(place, kind, pigments.is_some(), headers, &mut columns)?;
    check_repeated(place, headers, &columns)?;
    // A row of empty cells has no heading, but a file and a number.
    let CellPlace { file, row, .. } = place(0);
    if !columns.contains(&Column::Sample) {
        let column = "sample";
        return Err(MeasurementError::Sheet(CsvTableError::MissingColumn { file, row, column }));
    }
    let wavelengths = columns.iter().enumerate().filter_map(|(index, column)| match column {
        Column::Wavelength(nm) => Some((index, *nm)),
        _ => None,
    });
    let wavelengths: Vec<(usize, f64)> = wavelengths.collect();
    if wavelengths.is_empty() && kind != TableKind::Recipes {
        let column = "400 (a wavelength in nm)";
        return Err(MeasurementError::Sheet(CsvTableError::MissingColumn { file, row, column }));
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

/// Decides what the numbers in `columns` are that are no wavelengths from 200 to 2500 nm. Beside those they
/// go on to shorter or longer ones, and are left out. In recipes they name pigments, e.g. pastes `08` and
/// `12`.
fn decide_outside(
    place: &dyn Fn(usize) -> CellPlace,
    kind: TableKind,
    pigments_are_listed: bool,
    headers: &[String],
    columns: &mut [Column],
) -> Result<(), MeasurementError> {
    let nm: Vec<Option<f64>> = columns
        .iter()
        .map(|column| match column {
            Column::Wavelength(nm) | Column::Outside(nm) => Some(*nm),
            _ => None,
        })
        .collect();
    let mut goes_on: Vec<bool> =
        columns.iter().map(|column| matches!(column, Column::Wavelength(_))).collect();
    let count = columns.len();
    for index in (1..count).chain((0..count.saturating_sub(1)).rev()) {
        for (near, far) in [(index.wrapping_sub(1), index.wrapping_sub(2)), (index + 1, index + 2)]
        {
            let at = |place: usize| nm.get(place).copied().flatten();
            if let (Some(own), Some(near_nm), Some(far_nm)) = (at(index), at(near), at(far))
                && goes_on[near]
                && goes_on[far]
                && (1e-6..=2.0).contains(&((own - near_nm) / (near_nm - far_nm)))
            {
                goes_on[index] = true;
            }
        }
    }
    for index in 0..count {
        if !matches!(columns[index], Column::Outside(_)) || goes_on[index] {
            continue;
        }
        columns[index] = match kind {
            TableKind::Recipes if !pigments_are_listed => Column::Pigment(headers[index].clone()),
            TableKind::Readings if !pigments_are_listed => {
                return Err(MeasurementError::WavelengthRange(place(index)));
            }
            _ => Column::Ignored,
        };
    }
    Ok(())
}

/// Checks that no column that we read occurs twice, and that amounts have one unit.
fn check_repeated(
    place: &dyn Fn(usize) -> CellPlace,
    headers: &[String],
    columns: &[Column],
) -> Result<(), MeasurementError> {
    let mut first_unit: Option<(usize, String)> = None;
    let mut names: BTreeMap<&str, usize> = BTreeMap::new();
    let mut others: Vec<(&Column, usize)> = Vec::new();
    for (index, column) in columns.iter().enumerate() {
        match column {
            Column::Ignored
            | Column::Condition
            | Column::Replicate
            | Column::Wavelength(_)
            | Column::Outside(_) => continue,
            _ => {}
        }
        let first = if let Column::Pigment(name) = column {
            names.insert(name, index)
        } else {
            let first = others.iter().find(|(other, _)| *other == column).map(|(_, first)| *first);
            others.push((column, index));
            first
        };
        if let Some(first) = first {
            return Err(MeasurementError::RepeatedColumn {
                place: place(index),
                first: first + 1,
                second: index + 1,
            });
        }
        let Some(unit) = without_unit(&headers[index]).1.filter(|_| is_pigment(column)) else {
            continue;
        };
        let unit = unit.to_lowercase();
        match &first_unit {
            Some((first, first_one)) if *first_one != unit => {
                return Err(MeasurementError::MixedAmounts {
                    place: place(index),
                    unit,
                    first: headers[*first].clone(),
                });
            }
            Some(_) => {}
            None => first_unit = Some((index, unit)),
        }
    }
    Ok(())
}

fn is_pigment(column: &Column) -> bool {
    matches!(column, Column::Pigment(_))
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

/// Whether a heading has a meaning of its own, and is no note.
pub(super) fn is_known(name: &str) -> bool {
    matches!(
        column(name, false),
        Column::Film | Column::Backing | Column::Thickness | Column::Replicate | Column::Condition
    )
}

/// Meaning of the header `name`. `letters` says whether `R400` is a wavelength. It is a pigment if other
/// headers of the table are plain numbers.
fn column(name: &str, letters: bool) -> Column {
    let lower = name.to_ascii_lowercase();
    let plain = plain(name);
    let known = COLUMNS.iter().find(|(headings, _)| headings.contains(&plain.as_str()));
    if let Some((_, column)) = known {
        return column.clone();
    }
    if condition(name).is_some() {
        return Column::Condition;
    }
    // If a heading names samples, another column holds the names.
    if NOTES.contains(&plain.as_str())
        || name == "#"
        || is_color(name)
        || name_rank(name).is_some()
        || is_wavelength(name)
    {
        return Column::Ignored;
    }
    match wavelength_of_header(&lower) {
        Some(nm) if letters || !is_letter_and_number(&lower) => {
            let is_measured = MEASURABLE_NM.contains(&nm);
            match is_measured {
                true => Column::Wavelength(nm),
                // `R8` is no wavelength.
                false if is_letter_and_number(&lower) => Column::Pigment(name.to_owned()),
                false => Column::Outside(nm),
            }
        }
        _ => Column::Pigment(without_unit(name).0.to_owned()),
    }
}

/// Whether we read a column headed `name` as a pigment, in a file with plain numbers as wavelengths.
#[must_use]
pub fn names_a_pigment(name: &str) -> bool {
    let plain = name.trim() == name && name_violation(name).is_none();
    plain && column(name, false) == Column::Pigment(name.to_owned())
}

/// Headings of columns with a meaning, as [`plain`] gives them.
const COLUMNS: [(&[&str], Column); 4] = [
    (&["film", "schicht", "couche", "pelicula", "strato", "laag"], Column::Film),
    (
        &[
            "backing",
            "substrate",
            "untergrund",
            "unterlage",
            "hintergrund",
            "support",
            "fond",
            "soporte",
            "fondo",
            "sustrato",
            "supporto",
            "sottofondo",
            "ondergrond",
            "achtergrond",
        ],
        Column::Backing,
    ),
    (
        &[
            "thicknessmm",
            "filmthicknessmm",
            "dickemm",
            "schichtdickemm",
            "epaisseurmm",
            "espesormm",
            "spessoremm",
            "diktemm",
            "laagdiktemm",
        ],
        Column::Thickness,
    ),
    (
        &[
            "replicate",
            "replikat",
            "wiederholung",
            "replicat",
            "repetition",
            "replica",
            "repeticion",
            "ripetizione",
            "herhaling",
        ],
        Column::Replicate,
    ),
];

/// Whether a column of recipes holds the names of readings.
fn is_reading(heading: &str) -> bool {
    [
        "reading", "messung", "mesure", "lecture", "lectura", "medicion", "lettura", "misura",
        "meting",
    ]
    .contains(&plain(heading).as_str())
}

/// Headings of notes as [`plain`] gives them, none of which is the name of a pigment.
const NOTES: [&str; 55] = [
    "index",
    "row",
    "batch",
    "temperature",
    "humidity",
    "remark",
    "remarks",
    "note",
    "notes",
    "comment",
    "comments",
    "bemerkung",
    "bemerkungen",
    "kommentar",
    "remarque",
    "remarques",
    "commentaire",
    "observaciones",
    "osservazioni",
    "opmerking",
    "opmerkingen",
    "date",
    "datum",
    "fecha",
    "data",
    "time",
    "datetime",
    "timestamp",
    "uhrzeit",
    "heure",
    "hora",
    "ora",
    "tijd",
    "instrument",
    "serial",
    "serialnumber",
    "operator",
    "user",
    "illuminant",
    "observer",
    "aperture",
    "hue",
    "chroma",
    "lightness",
    "hex",
    "html",
    "hexcode",
    "lrv",
    "opacity",
    "whiteness",
    "yellowness",
    "gloss",
    "thickness",
    "metamerism",
    "tint",
];

/// Words for a space of colours, in small letters.
const SPACES: [&str; 16] = [
    "cie",
    "cielab",
    "cielch",
    "lab",
    "lch",
    "lchab",
    "lchuv",
    "luv",
    "xyz",
    "xyy",
    "hsl",
    "hsv",
    "hsb",
    "hunterlab",
    "hunter",
    "oklab",
];

/// Words for densities and amounts of inks or lights, in small letters.
const INKS: [&str; 13] = [
    "density",
    "densities",
    "dichte",
    "densit\u{e9}",
    "densidad",
    "densit\u{e0}",
    "dichtheid",
    "rgb",
    "srgb",
    "adobergb",
    "prophoto",
    "cmyk",
    "cmy",
];

/// Whether a heading is a coordinate of a colour, a difference of colours or a density, e.g. `L*(D65)`,
/// `sRGB R`, `LAB_L`, `dE00`, `Density C` or `Gloss60`.
fn is_color(name: &str) -> bool {
    let lower = name.to_lowercase();
    // `L*` alone, with lights and observers behind it.
    let starred = lower.split_once('*').is_some_and(|(before, _)| {
        let letter = before.trim_start_matches(['d', '\u{394}', '\u{3b4}', ' ']);
        let letter = letter.rsplit([' ', '_']).next().unwrap_or_default();
        ["l", "a", "b", "c", "h", "u", "v", "e", "ab"].contains(&letter)
    });
    let words = lower.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty());
    let words: Vec<&str> = words.collect();
    let is_short = |word: &&str| word.len() <= 2 || is_light(word);
    let is_of = |spaces: &[&str], has_inks: bool| {
        let (named, others): (Vec<&str>, Vec<&str>) =
            words.iter().partition(|word| spaces.contains(word));
        !named.is_empty() && others.iter().all(|w| is_short(w) || (has_inks && is_ink(w)))
    };
    let of_space = is_of(&SPACES, false) || is_of(&INKS, true);
    let difference = name.trim_start().starts_with("dE")
        || lower.strip_prefix("delta").is_some_and(|rest| {
            let rest = rest.trim_start_matches([' ', '_', '-']);
            ["e", "l", "a", "b", "c", "h"].iter().any(|letter| rest.starts_with(letter))
                && !rest.chars().skip(1).any(char::is_alphabetic)
        });
    let gloss = words.first().is_some_and(|word| {
        word.strip_prefix("gloss").is_some_and(|angle| angle.parse::<f64>().is_ok())
    });
    starred || of_space || gloss || difference
}

fn is_light(word: &str) -> bool {
    ["d50", "d55", "d65", "d75", "2deg", "10deg", "deg", "m0", "m1", "m2", "m3"].contains(&word)
}

/// Whether a word beside `density` or `RGB` names a filter or a primary.
fn is_ink(word: &str) -> bool {
    ["cyan", "magenta", "yellow", "black", "visual", "vis", "red", "green", "blue", "status"]
        .contains(&word)
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
    match ranked.min() {
        Some((_, index)) => Some(index),
        None => {
            let over_names = headings.iter().position(|heading| headings::is_wavelength(heading));
            over_names
                .filter(|index| others_are_wavelengths(*index))
                .or((headings.first() == Some(&"") && others_are_wavelengths(0)).then_some(0))
        }
    }
}

/// Coordinates of colour as tables of instruments write them. We recognise a coordinate only if the table
/// has several of its row.
const COORDINATES: [&[&str]; 7] = [
    &["L", "a", "b"],
    &["L", "C", "h"],
    &["L", "c", "h"],
    &["L", "u", "v"],
    &["X", "Y", "Z"],
    &["x", "y", "Y"],
    &["R", "G", "B"],
];

/// Places of the headings that are coordinates of a colour space of which the table has several.
fn coordinates_of(headings: &[String]) -> BTreeSet<usize> {
    // Some programs number what occurs twice: L, a, b, L2, c, h.
    let bare = headings
        .iter()
        .map(|heading| heading.trim().trim_end_matches(['2', '3', '.', '*', '\u{b0}']));
    let bare: Vec<&str> = bare.collect();
    let all: BTreeSet<&str> = bare.iter().copied().collect();
    let sets = COORDINATES.iter().filter(|set| {
        all.contains(set[0]) && set.iter().filter(|name| all.contains(*name)).count() > 1
    });
    let names: BTreeSet<&str> = sets.flat_map(|set| set.iter().copied()).collect();
    (0..bare.len()).filter(|at| names.contains(bare[*at])).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use spectra::headings::is_guessed_name;
    use std::time::Instant;

    #[test]
    fn headers_of_wavelengths_are_read_in_every_spelling() {
        for header in
            ["400", "400nm", "400 nm", "R400", "SPEC_400", "nm400", "400.0", "400[nm]", "R400 nm"]
        {
            assert_eq!(column(header, true), Column::Wavelength(400.0), "{header}");
        }
        assert_eq!(column("381.2", true), Column::Wavelength(381.2));
        assert_eq!(column("Red Ochre", true), Column::Pigment("Red Ochre".into()));
        assert_eq!(column("PB29", true), Column::Pigment("PB29".into()));
        assert_eq!(column("99999", true), Column::Outside(99999.0));
    }

    #[test]
    fn many_pigments_take_time_in_proportion() {
        let started = Instant::now();
        let pigments: String = (0..100_000).map(|at| format!(",Paint {at} (g)")).collect();
        let found = columns_of(&format!("Name{pigments},400,500"), TableKind::Readings).unwrap();
        assert_eq!(found[100_000], Column::Pigment("Paint 99999".into()));
        let twice = format!("Name{pigments},Paint 7,400,500");
        let error = columns_of(&twice, TableKind::Readings).unwrap_err();
        assert!(error.contains("occurs twice, as column number 9 and 100002"), "{error}");
        // Where every heading is searched among all before, it takes more than half a minute.
        assert!(started.elapsed().as_secs() < 10, "{:?}", started.elapsed());
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

    #[test]
    fn headings_are_known_in_six_languages() {
        let known = |headings: &[&str], wanted: Column| {
            for heading in headings {
                assert_eq!(column(heading, false), wanted, "{heading}");
            }
        };
        known(&["film", "Schicht", "couche", "strato", "laag"], Column::Film);
        known(&["Backing", "Untergrund", "fond", "Soporte", "Ondergrond"], Column::Backing);
        known(&["thickness_mm", "Schichtdicke [mm]", "\u{c9}paisseur (mm)"], Column::Thickness);
        known(&["Wiederholung", "R\u{e9}p\u{e9}tition"], Column::Replicate);
        known(&["Geometry", "Winkel", "Dosis"], Column::Condition);
        known(&["Wellenl\u{e4}nge", "Datum", "Probe", "Bemerkung"], Column::Ignored);
        for heading in
            ["Probe", "\u{c9}chantillon", "Echantillon", "Muestra", "campione", "Monster"]
        {
            assert_eq!(found(&["400", heading, "410"]), Some(1), "{heading}");
        }
        for heading in ["Wellenl\u{e4}nge [nm]", "Longueur d'onde", "golflengte"] {
            assert_eq!(found(&[heading, "400", "410"]), Some(0), "{heading}");
        }
        let pigment = |name: &str| Column::Pigment(name.to_owned());
        for (heading, name) in [
            ("Titanwei\u{df}", "Titanwei\u{df}"),
            ("Blanc de titane [%]", "Blanc de titane"),
            ("Red (g)", "Red"),
            ("Red (PR101)", "Red (PR101)"),
        ] {
            assert_eq!(column(heading, false), pigment(name), "{heading}");
        }
    }

    #[test]
    fn colors_and_densities_are_no_pigments() {
        for heading in [
            "L*",
            "L*(D65)",
            "a* (D50/2)",
            "LAB_L",
            "CIE L",
            "Lab b",
            "sRGB R",
            "RGB Red",
            "Hex",
            "dE00",
            "Delta E",
            "Density",
            "Density C",
            "Cyan density",
            "Gloss60",
            "CMYK K",
        ] {
            assert_eq!(column(heading, false), Column::Ignored, "{heading}");
        }
        for heading in
            ["Red", "PB29", "Hunter Green", "Lab Red", "Glossy Black", "L", "DE Yellow", "C"]
        {
            assert_eq!(column(heading, false), Column::Pigment(heading.to_owned()), "{heading}");
        }
        let nix = "Name,L,a,b,L,c,h,Density,sRGB R,400,410";
        let nix = columns_of(nix, TableKind::Readings).unwrap();
        assert!(nix[1..9].iter().all(|column| *column == Column::Ignored), "{nix:?}");
        let numbered = columns_of("Name,L,a,b,L2,c,h,400", TableKind::Readings).unwrap();
        assert!(numbered[1..7].iter().all(|column| *column == Column::Ignored), "{numbered:?}");
    }

    #[test]
    fn wavelengths_beyond_those_of_instruments_are_cut_and_other_numbers_are_pigments_if_named() {
        let wide = "Name,190,195,200,205,2490,2500,2510,2520";
        let wide = columns_of(wide, TableKind::Readings).unwrap();
        assert_eq!(wide[1..3], [Column::Outside(190.0), Column::Outside(195.0)]);
        assert_eq!(wide[7..], [Column::Outside(2510.0), Column::Outside(2520.0)]);
        let error = columns_of("Name,08,12,400,410", TableKind::Readings).unwrap_err();
        assert_eq!(error, "f, row 3, column `08` is not a wavelength from 200 to 2500 nm");
        let spectra = columns_of("Name,08,12,400,410", TableKind::Spectra).unwrap();
        assert_eq!(spectra[1..3], [Column::Ignored, Column::Ignored]);
        let recipe = columns_of("Name,08,12", TableKind::Recipes).unwrap();
        assert_eq!(recipe[1], Column::Pigment("08".into()));
        let names: Vec<String> = ["Name", "08", "12", "400", "410"].map(str::to_owned).into();
        let place = |index: usize| CellPlace::new("f", 3, &names[index]);
        let listed = ["08".to_owned()];
        let found = columns(&place, &names, TableKind::Readings, Some(&listed)).unwrap();
        assert_eq!(found[1..3], [Column::Pigment("08".into()), Column::Ignored]);
    }

    #[test]
    fn amounts_have_one_unit() {
        let grams = columns_of("Name,Red (g),Blue [g],400", TableKind::Readings).unwrap();
        assert_eq!(grams[2], Column::Pigment("Blue".into()));
        let error = columns_of("Name,Red (g),Blue (mg),400", TableKind::Readings).unwrap_err();
        assert!(error.contains("column `Blue (mg)`: the amount is in `mg`"), "{error}");
        let twice = columns_of("Name,Red (g),Red [g],400", TableKind::Readings).unwrap_err();
        assert!(twice.contains("occurs twice, as column number 2 and 3"), "{twice}");
    }
}
