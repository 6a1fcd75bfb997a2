//! Books of named colours: swatch files ([`swatch_file`](crate::swatch_file)) and tables of L\*, a\*, b\*, of X, Y, Z,
//! or of codes such as `#4a7d8c`.
//!
//! A table is a CSV file with commas, semicolons or tabs, or a sheet of a workbook. One row holds headings. We find
//! the colour by these columns, in this order:
//!
//! | columns | content |
//! |---|---|
//! | `L`, `a`, `b` (also `L*`, `LAB_L`, `L* (D65/10)`) | CIELAB |
//! | `X`, `Y`, `Z` | tristimulus values, the white with Y = 100 or Y = 1 |
//! | `hex` (also `HTML`) | sRGB codes |
//! | `R`, `G`, `B` | sRGB in 8 bits |
//!
//! A list without headings may hold names and codes with `#`. You find a colour by any of its other texts.

use std::path::Path;

use documents::file::{FileError, read};
use documents::hint::Explain;
use documents::{
    counted, excerpt, from_spreadsheet_cell, name_list, name_violation, plain_name, question,
};

use crate::color::{Lab, Rgb, Xyz};
use crate::csv_table::{CellPlace, RowNumbers, wavelength_of_header};
use crate::grid::Grid;
use crate::illuminant::{Illuminant, Observer};
use crate::instrument::FileText;
use crate::swatch_file::{SwatchColor, SwatchFileError, d50_white, read_swatch_file};
use crate::viewing::Viewing;

/// A named colour of a [`ColorBook`].
#[derive(Debug, Clone, PartialEq)]
pub struct BookColor {
    /// Name of the colour.
    pub name: String,
    /// Other texts in its row, for example a number of the maker. You find the colour by them too.
    pub other_names: Vec<String>,
    /// The colour itself.
    pub value: BookValue,
}

/// A colour as a book states it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum BookValue {
    /// Encoded sRGB, each channel 0 to 1.
    Srgb(Rgb),
    /// CIELAB relative to `white`, the white of the light under which it holds (Y = 100).
    Lab {
        /// L\* from 0 to 110, a\* and b\* from -300 to 300.
        lab: Lab,
        /// XYZ of the white.
        white: Xyz,
    },
}

/// Named colours of a file.
#[derive(Debug, Clone, PartialEq)]
pub struct ColorBook {
    /// Path of the file, as you gave it.
    pub file: String,
    /// The colours in the order of the file, at least one.
    pub colors: Vec<BookColor>,
    /// The light that we took because a table of CIELAB or XYZ states none and you gave none. It is D65 for the
    /// observer of 1931. Otherwise this is `None`.
    pub assumed_light: Option<Viewing>,
    /// Remarks on colours that we left out, and on other choices.
    pub remarks: Vec<String>,
}

/// A table is searched for its row of headings in this many rows.
const MOST_ABOVE: usize = 30;
const SEPARATORS: [u8; 3] = [b',', b';', b'\t'];
/// An error lists this many names.
const LISTED: usize = 8;
/// A table with a tristimulus value above this counts from 0 to 100, another from 0 to 1.
const MOST_FRACTION: f64 = 2.0;

impl ColorBook {
    /// Reads `bytes`, the content of `file`. You get `None` if it is neither a swatch file nor a table of colours,
    /// for example if it holds spectra.
    ///
    /// Pass as `light` the light and the observer of a table of CIELAB or XYZ. Otherwise the headings may state
    /// them, as in `L* (D50/2)`. Lab in swatch files is always under D50.
    ///
    /// ```
    /// use spectra::color_book::{BookValue, ColorBook};
    ///
    /// let table = b"Number;L*;a*;b*\nRAL 5012;55,1;-15,3;-31,9\nRAL 9010;94,6;-0,8;6,9\n";
    /// let book = ColorBook::read("book.csv", table, None)?.expect("a table of colours");
    /// let BookValue::Lab { lab, .. } = book.find("ral 5012")?.value else { panic!() };
    /// assert_eq!(lab.to_array(), [55.1, -15.3, -31.9]);
    /// assert!(book.assumed_light.is_some());
    /// # Ok::<(), spectra::color_book::ColorBookError>(())
    /// ```
    ///
    /// # Errors
    /// [`ColorBookError`] for a damaged swatch file, a cell that does not hold the number that its column needs,
    /// or a file without colours.
    pub fn read(
        file: &str,
        bytes: &[u8],
        light: Option<&Viewing>,
    ) -> Result<Option<Self>, ColorBookError> {
        if let Some(swatches) = read_swatch_file(file, bytes)? {
            let mut inks = 0;
            let mut colors = Vec::new();
            for (place, swatch) in (1..).zip(swatches.swatches) {
                let value = match swatch.color {
                    SwatchColor::Lab(lab) => BookValue::Lab { lab, white: d50_white() },
                    SwatchColor::Rgb(rgb) => BookValue::Srgb(rgb),
                    SwatchColor::Grey(grey) => BookValue::Srgb(Rgb([grey; 3])),
                    SwatchColor::Cmyk(_) => {
                        inks += 1;
                        continue;
                    }
                };
                let name = named_or_place(&swatch.name, place);
                colors.push(BookColor { name, other_names: Vec::new(), value });
            }
            let inks = (inks > 0).then(|| {
                format!("{file}: left out {}, which define no colour", counted(inks, "CMYK ink"))
            });
            let remarks = Vec::from_iter(inks);
            let book = Self { file: file.to_owned(), colors, assumed_light: None, remarks };
            return book.checked().map(Some);
        }
        // Another reader tells what is wrong with files that hold no text.
        let Ok(Some(FileText { file, text, .. })) = FileText::of(file, bytes) else {
            return Ok(None);
        };
        match Table::of(&file, &text) {
            Some(table) => table.book(light)?.checked().map(Some),
            None => Ok(None),
        }
    }

    /// Reads the file at `path` as [`Self::read`] does.
    ///
    /// # Errors
    /// [`ColorBookError`], also if the file cannot be read.
    pub fn open(
        path: impl AsRef<Path>,
        light: Option<&Viewing>,
    ) -> Result<Option<Self>, ColorBookError> {
        let path = path.as_ref();
        Self::read(&path.display().to_string(), &read(path)?, light)
    }

    /// The one colour with this name. We try, in this order, names as you write them, other texts of the rows, both
    /// in any letter case, the start of a name if only one has it, and the place in the book, counted from 1.
    ///
    /// # Errors
    /// [`ColorBookError::Unknown`] or [`ColorBookError::Several`].
    pub fn find(&self, name: &str) -> Result<&BookColor, ColorBookError> {
        let name = name.trim();
        let lower = name.to_lowercase();
        let tests: [&dyn Fn(&BookColor) -> bool; 5] = [
            &|color| color.name == name,
            &|color| color.other_names.iter().any(|other| other == name),
            &|color| color.name.to_lowercase() == lower,
            &|color| color.other_names.iter().any(|other| other.to_lowercase() == lower),
            &|color| !lower.is_empty() && color.name.to_lowercase().starts_with(&lower),
        ];
        for test in tests {
            let found: Vec<usize> =
                (0..self.colors.len()).filter(|&at| test(&self.colors[at])).collect();
            match found[..] {
                [] => {}
                [at] => return Ok(&self.colors[at]),
                _ => {
                    let each = |at: &usize| {
                        format!("{}#{} ({})", self.file, at + 1, self.colors[*at].name)
                    };
                    let places: Vec<String> = found.iter().map(each).collect();
                    return Err(ColorBookError::Several { name: name.to_owned(), places });
                }
            }
        }
        let place = name.parse::<usize>().ok().and_then(|place| place.checked_sub(1));
        place.and_then(|place| self.colors.get(place)).ok_or_else(|| ColorBookError::Unknown {
            file: self.file.clone(),
            name: name.to_owned(),
            names: self.colors.iter().map(|color| color.name.clone()).collect(),
        })
    }

    fn checked(self) -> Result<Self, ColorBookError> {
        match self.colors.is_empty() {
            true => Err(ColorBookError::Empty { file: self.file, left_out: self.remarks.len() }),
            false => Ok(self),
        }
    }
}

fn named_or_place(name: &str, place: usize) -> String {
    if name.is_empty() { format!("colour {place}") } else { name.to_owned() }
}

/// Places of the columns of a colour.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum ColorColumns {
    Lab([usize; 3]),
    Xyz([usize; 3]),
    Hex(usize),
    Rgb([usize; 3]),
}

/// A table whose headings name colours.
struct Table<'a> {
    file: &'a str,
    separator: u8,
    /// The headings, none in a list of names and codes.
    headings: Vec<String>,
    columns: ColorColumns,
    /// Number of each row, and its cells.
    rows: Vec<(u64, csv::StringRecord)>,
}

impl<'a> Table<'a> {
    fn of(file: &'a str, text: &str) -> Option<Self> {
        let mut offset = 0;
        for line in text.split_inclusive(['\n', '\r']).take(2 * MOST_ABOVE) {
            let at = offset;
            offset += line.len();
            for separator in SEPARATORS {
                let cells: Vec<String> =
                    records(line, separator).next().map_or_else(Vec::new, |cells| {
                        cells.iter().map(|cell| cell.trim_matches('\u{feff}').to_owned()).collect()
                    });
                let lower = cells.iter().map(|cell| cell.to_lowercase());
                if lower.filter(|cell| wavelength_of_header(cell).is_some_and(is_visible)).count()
                    > 1
                {
                    return None;
                }
                let listed = cells.iter().position(|cell| is_code(cell));
                let (columns, start) = match (ColorColumns::of(&cells), listed) {
                    (Some(columns), _) => (columns, at + line.len()),
                    (None, Some(code)) if cells.len() > 1 => (ColorColumns::Hex(code), at),
                    _ => continue,
                };
                let headings = if start == at { Vec::new() } else { cells };
                let mut numbers = RowNumbers::of(text.as_bytes());
                let rows = records(&text[start..], separator).map(|cells| {
                    let byte = cells.position().map_or(0, csv::Position::byte);
                    (numbers.at(start as u64 + byte), cells)
                });
                return Some(Self { file, separator, headings, columns, rows: rows.collect() });
            }
        }
        None
    }

    fn book(&self, light: Option<&Viewing>) -> Result<ColorBook, ColorBookError> {
        let file = self.file.to_owned();
        let is_measured = matches!(self.columns, ColorColumns::Lab(_) | ColorColumns::Xyz(_));
        let stated = light.cloned().or_else(|| self.stated_light());
        let assumed_light = (is_measured && stated.is_none()).then(Viewing::default);
        let viewing = stated.or_else(|| assumed_light.clone()).unwrap_or_default();
        let weights = viewing.weights(Grid::cie());
        let white = weights.expect("linear interpolation suits any grid").white();
        let name_column = self.name_column();
        let mut numbers = Vec::new();
        let mut colors = Vec::new();
        let mut left_out = 0;
        for (row, cells) in &self.rows {
            if cells.iter().all(str::is_empty) {
                continue;
            }
            let places = self.columns.places();
            if places.iter().all(|&at| cells.get(at).is_none_or(str::is_empty)) {
                left_out += 1;
                continue;
            }
            let value = self.value(*row, cells, white)?;
            let name = name_column.and_then(|at| cells.get(at)).unwrap_or_default();
            let name = plain_name(from_spreadsheet_cell(name));
            if let (Some(at), Some(wanted)) = (name_column, name_violation(&name))
                && !name.is_empty()
            {
                return Err(self.wrong(*row, cells, at, wanted));
            }
            let texts = cells.iter().enumerate().filter(|(at, text)| {
                !places.contains(at)
                    && Some(*at) != name_column
                    && !text.is_empty()
                    && number(text, self.separator).is_none()
            });
            colors.push(BookColor {
                name: named_or_place(&name, colors.len() + 1),
                other_names: texts.map(|(_, text)| text.to_owned()).collect(),
                value: BookValue::Srgb(Rgb([0.0; 3])),
            });
            numbers.push(value);
        }
        let mut remarks = Vec::new();
        if left_out > 0 {
            remarks.push(format!("{file}: left out {} without a colour", counted(left_out, "row")));
        }
        // A table of XYZ has one scale.
        let is_fraction = matches!(self.columns, ColorColumns::Xyz(_))
            && numbers.iter().flatten().all(|value| *value <= MOST_FRACTION);
        if is_fraction && !numbers.is_empty() {
            remarks.push(format!(
                "{file}: X, Y and Z are taken as 0 to 1, because none is above {MOST_FRACTION}"
            ));
        }
        let scale = if is_fraction { 100.0 } else { 1.0 };
        for (color, numbers) in colors.iter_mut().zip(numbers) {
            color.value = match self.columns {
                ColorColumns::Lab(_) => BookValue::Lab { lab: numbers.into(), white },
                ColorColumns::Xyz(_) => {
                    let xyz = Xyz::from(numbers.map(|value| value * scale));
                    BookValue::Lab { lab: Lab::from_xyz(xyz, white), white }
                }
                ColorColumns::Hex(_) | ColorColumns::Rgb(_) => BookValue::Srgb(Rgb(numbers)),
            };
        }
        Ok(ColorBook { file, colors, assumed_light, remarks })
    }

    /// The three numbers of a colour: of a code or RGB, the channels from 0 to 1.
    fn value(
        &self,
        row: u64,
        cells: &csv::StringRecord,
        white: Xyz,
    ) -> Result<[f64; 3], ColorBookError> {
        let most = 2.0 * white.to_array().into_iter().fold(0.0, f64::max);
        if let ColorColumns::Hex(at) = self.columns {
            let code = Rgb::from_hex(cells.get(at).unwrap_or_default());
            return code
                .map(|rgb| rgb.0)
                .ok_or_else(|| self.wrong(row, cells, at, "a code such as #4a7d8c"));
        }
        let mut values = [0.0; 3];
        for (channel, at) in self.columns.places().into_iter().enumerate() {
            let (range, wanted) = match (self.columns, channel) {
                (ColorColumns::Lab(_), 0) => (0.0..=110.0, "L* from 0 to 100"),
                (ColorColumns::Lab(_), _) => (-300.0..=300.0, "a number from -300 to 300"),
                (ColorColumns::Xyz(_), _) => (0.0..=most, "a tristimulus value, 0 and up"),
                _ => (0.0..=255.0, "a whole number from 0 to 255"),
            };
            let is_byte = matches!(self.columns, ColorColumns::Rgb(_));
            let found = cells.get(at).and_then(|cell| number(cell, self.separator));
            let found = found.filter(|value| range.contains(value));
            let found = found.filter(|value| !is_byte || value.fract() == 0.0);
            let found = found.ok_or_else(|| self.wrong(row, cells, at, wanted))?;
            values[channel] = if is_byte { found / 255.0 } else { found };
        }
        Ok(values)
    }

    /// The error of a cell that does not hold what is `wanted`.
    fn wrong(
        &self,
        row: u64,
        cells: &csv::StringRecord,
        at: usize,
        wanted: &'static str,
    ) -> ColorBookError {
        let heading = self.headings.get(at).map_or("colour", String::as_str);
        let place = CellPlace::new(self.file, row, heading);
        let text = cells.get(at).unwrap_or_default().to_owned();
        ColorBookError::Cell { place, wanted, text }
    }

    /// Light and observer that the headings of the colour state.
    fn stated_light(&self) -> Option<Viewing> {
        let headings = self.columns.places().into_iter().filter_map(|at| self.headings.get(at));
        let words: Vec<String> = headings.flat_map(|heading| words(heading)).collect();
        let illuminant = words.iter().find_map(|word| light_of_word(word))?;
        let is_ten = words.iter().any(|word| word == "10");
        let observer = if is_ten { Observer::Cie1964Deg10 } else { Observer::Cie1931Deg2 };
        Some(Viewing { illuminant, observer })
    }

    /// The column of names: the one with such a heading, or else the first with text.
    fn name_column(&self) -> Option<usize> {
        let is_named = |at: &usize, names: &[&str]| {
            let heading = words(&self.headings[*at]).join(" ");
            !self.columns.places().contains(at) && names.contains(&heading.as_str())
        };
        let all = 0..self.headings.len();
        let named = [&NAMES[..], &NUMBERS[..]];
        let named = named.into_iter().find_map(|names| all.clone().find(|at| is_named(at, names)));
        named.or_else(|| {
            let width = self.rows.iter().map(|(_, cells)| cells.len()).max().unwrap_or(0);
            (0..width).filter(|at| !self.columns.places().contains(at)).find(|&at| {
                let texts = self.rows.iter().filter_map(|(_, cells)| cells.get(at));
                let mut texts = texts.filter(|text| !text.is_empty());
                texts.any(|text| number(text, self.separator).is_none())
            })
        })
    }
}

/// Headings of names, the surest first.
const NAMES: [&str; 9] = [
    "name",
    "names",
    "color name",
    "colour name",
    "sample",
    "sample name",
    "color",
    "colour",
    "swatch",
];
/// Headings of numbers by which people know a colour.
const NUMBERS: [&str; 9] =
    ["code", "number", "nr", "no", "id", "sample id", "ral", "ncs", "pantone"];

impl ColorColumns {
    fn of(headings: &[String]) -> Option<Self> {
        let letters: Vec<Option<String>> = headings.iter().map(|text| letter(text)).collect();
        let at = |wanted: &str, from: usize| {
            letters.iter().skip(from).position(|l| l.as_deref() == Some(wanted)).map(|at| at + from)
        };
        // Of several columns called `b`, the one of CIELAB stands behind `a`.
        let three = |names: [&str; 3]| {
            let first = at(names[0], 0)?;
            let second = at(names[1], first).or_else(|| at(names[1], 0))?;
            let third = at(names[2], second).or_else(|| at(names[2], 0))?;
            Some([first, second, third])
        };
        three(["l", "a", "b"])
            .map(Self::Lab)
            .or_else(|| three(["x", "y", "z"]).map(Self::Xyz))
            .or_else(|| at("hex", 0).map(Self::Hex))
            .or_else(|| three(["r", "g", "b"]).map(Self::Rgb))
    }

    fn places(self) -> Vec<usize> {
        match self {
            Self::Lab(three) | Self::Xyz(three) | Self::Rgb(three) => three.to_vec(),
            Self::Hex(at) => vec![at],
        }
    }
}

/// The letter of a colour that a heading names, or `hex`.
fn letter(heading: &str) -> Option<String> {
    let all = words(heading);
    let is_hex = all.iter().any(|word| word == "hex" || word == "html");
    let mut rest = all.iter().filter(|word| {
        !(BESIDE.contains(&word.as_str())
            || is_hex && OF_CODES.contains(&word.as_str())
            || light_of_word(word).is_some())
    });
    match (rest.next(), rest.next()) {
        (Some(word), None) if word == "lightness" => Some("l".to_owned()),
        (Some(word), None) if ["l", "a", "b", "x", "y", "z", "r", "g"].contains(&word.as_str()) => {
            Some(word.clone())
        }
        (None, None) if is_hex => Some("hex".to_owned()),
        _ => None,
    }
}

/// Words beside the letter of a colour.
const BESIDE: [&str; 14] = [
    "cie", "lab", "cielab", "xyz", "star", "mean", "value", "sci", "sce", "1931", "1964", "2",
    "10", "deg",
];
const OF_CODES: [&str; 8] = ["hex", "html", "code", "rgb", "srgb", "color", "colour", "web"];

/// The words of a heading in lower case.
fn words(heading: &str) -> Vec<String> {
    let is_between = |c: char| !c.is_alphanumeric() || c == '\u{ba}';
    let words = heading.split(is_between).filter(|word| !word.is_empty());
    words.map(str::to_lowercase).collect()
}

/// The light of a word, such as `d65`. Letters alone are no light, because they name columns.
fn light_of_word(word: &str) -> Option<Illuminant> {
    (word.len() > 1 && word.chars().any(|c| c.is_ascii_digit()))
        .then(|| Illuminant::named(word).ok())
        .flatten()
}

fn is_visible(nm: f64) -> bool {
    (200.0..=2500.0).contains(&nm)
}

/// Whether a cell is a code with `#`.
fn is_code(cell: &str) -> bool {
    cell.starts_with('#') && Rgb::from_hex(cell).is_some()
}

/// A number, with a decimal comma where cells are not separated by commas.
fn number(cell: &str, separator: u8) -> Option<f64> {
    let plain = cell.replace('\u{2212}', "-");
    let plain = if separator == b',' { plain } else { plain.replace(',', ".") };
    plain.parse().ok().filter(|value: &f64| value.is_finite())
}

fn records(text: &str, separator: u8) -> impl Iterator<Item = csv::StringRecord> {
    let reader = csv::ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .trim(csv::Trim::All)
        .delimiter(separator)
        .from_reader(text.as_bytes());
    reader.into_records().map_while(Result::ok)
}

/// A book of colours that cannot be read, or a name that it does not hold.
#[derive(Debug, Clone, PartialEq, thiserror::Error, Explain)]
pub enum ColorBookError {
    /// The file could not be read.
    #[error(transparent)]
    File(#[from] FileError),
    /// A swatch file is damaged.
    #[error(transparent)]
    Swatches(#[from] SwatchFileError),
    /// A cell does not hold the number that its column needs.
    #[error("{place}: expected {wanted}, found `{}`", excerpt(text))]
    Cell {
        /// File, row and column of the cell.
        place: CellPlace,
        /// Description of the required number.
        wanted: &'static str,
        /// Content of the cell.
        text: String,
    },
    /// There is no colour in the file.
    #[error("{file}: the file holds no colour")]
    #[hint(if *left_out > 0, "its rows without colours, or its inks, do not count")]
    Empty {
        /// Path of the file.
        file: String,
        /// Number of remarks on what was left out.
        left_out: usize,
    },
    /// No colour has this name.
    #[error("{file}: no colour is called `{name}`")]
    #[hint(verbatim, "{}colours: {}", question(name, names), name_list(names, LISTED, ", "))]
    Unknown {
        /// Path of the file.
        file: String,
        /// The name that you asked for.
        name: String,
        /// Names of all colours.
        names: Vec<String>,
    },
    /// Several colours fit this name.
    #[error("`{name}` may be {}", counted(places.len(), "colour"))]
    #[hint(verbatim, "name one of them by its place: {}", name_list(places, LISTED, ", "))]
    Several {
        /// The name that you asked for.
        name: String,
        /// File and place of each.
        places: Vec<String>,
    },
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read_text(text: &str) -> Result<Option<ColorBook>, ColorBookError> {
        ColorBook::read("book.csv", text.as_bytes(), None)
    }

    /// CIELAB of a colour, or its code.
    fn told(color: &BookColor) -> String {
        match color.value {
            BookValue::Srgb(rgb) => rgb.to_hex(),
            BookValue::Lab { lab, .. } => {
                lab.to_array().map(|value| format!("{value:.1}")).join(",")
            }
        }
    }

    #[test]
    fn tables_of_many_layouts_name_colours() {
        for (text, name, expected) in [
            ("name,L,a,b\nSky,60,-5,-30\n", "Sky", "60.0,-5.0,-30.0"),
            ("Number;L*;a*;b*\nRAL 5012;60,5;-5;-30,2\n", "ral 5012", "60.5,-5.0,-30.2"),
            (
                "Code\tName\tLAB_L\tLAB_A\tLAB_B\nB12\tSky\t60\t-5\t\u{2212}30\n",
                "B12",
                "60.0,-5.0,-30.0",
            ),
            (
                "Book of colours 2024\n\nColour,hex,L,a,b\nSky,#000000,60,-5,-30\n",
                "sky",
                "60.0,-5.0,-30.0",
            ),
            ("R,G,B,L,a,b,name\n1,2,3,60,-5,-30,Sky\n", "Sky", "60.0,-5.0,-30.0"),
            ("name,X,Y,Z\nGrey,17.5,18.42,20.06\n", "Grey", "50.0,-0.0,-0.0"),
            ("name,X,Y,Z\nGrey,0.17506,0.18419,0.20056\n", "Grey", "50.0,-0.0,-0.0"),
            ("RAL,HEX,English\nRAL 5012,#3b83bd,Light blue\n", "light blue", "#3b83bd"),
            ("name,html\nSky,3B83BD\n", "S", "#3b83bd"),
            ("name,R,G,B\nSky,59,131,189\n", "1", "#3b83bd"),
            ("Sky,#3b83bd\nSea,#003b83\n", "2", "#003b83"),
            ("name,L,a,b\n,60,-5,-30\n", "colour 1", "60.0,-5.0,-30.0"),
            ("name,L,a,b\n\"Sky, pale\",60,-5,-30\n", "Sky, pale", "60.0,-5.0,-30.0"),
        ] {
            let book = read_text(text).unwrap().unwrap_or_else(|| panic!("{text}"));
            assert_eq!(
                told(book.find(name).unwrap()).replace("-0.0", "0.0"),
                expected.replace("-0.0", "0.0"),
                "{text}"
            );
        }
    }

    #[test]
    fn spectra_and_other_tables_are_no_books() {
        for text in [
            "sample,400,410,420\na,1,2,3\n",
            "name,L,a,b,400 nm,410 nm\nSky,60,-5,-30,0.5,0.5\n",
            "400 0.5\n410 0.6\n",
            "pigment,price\nZinc White,3\n",
            "",
        ] {
            assert_eq!(read_text(text).unwrap(), None, "{text}");
        }
    }

    #[test]
    fn faults_name_row_and_column_and_names_that_are_meant() {
        for (text, name, message) in [
            (
                "name,L,a,b\nSky,60,x,-30\n",
                "",
                "book.csv, row 2, column `a`: expected a number from -300 to 300, found `x`",
            ),
            (
                "name,L,a,b\n\nSky,600,0,-30\n",
                "",
                "book.csv, row 3, column `L`: expected L* from 0 to 100, found `600`",
            ),
            (
                "name,hex\nSky,blue\n",
                "",
                "book.csv, row 2, column `hex`: expected a code such as #4a7d8c, found `blue`",
            ),
            (
                "name,R,G,B\nSky,0.2,0.3,0.4\n",
                "",
                "book.csv, row 2, column `R`: expected a whole number from 0 to 255, found `0.2`",
            ),
            ("name,L,a,b\nSky,,,\n", "", "book.csv: the file holds no colour"),
            ("name,L,a,b\nSky,60,0,0\n", "Skye", "book.csv: no colour is called `Skye`"),
            ("name,L,a,b\nSky,60,0,0\n", "3", "book.csv: no colour is called `3`"),
            ("name,L,a,b\nSky,60,0,0\nSky,70,0,0\n", "Sky", "`Sky` may be 2 colours"),
        ] {
            let error = read_text(text).and_then(|book| book.unwrap().find(name).cloned());
            let error = error.unwrap_err();
            assert_eq!(error.to_string(), message);
            if !name.is_empty() {
                let hint = error.hint().unwrap().to_string();
                assert!(hint.contains("Sky"), "{hint}");
            }
        }
    }

    #[test]
    fn the_light_of_a_table_is_stated_given_or_assumed() {
        let white = |text: &str, light: Option<&Viewing>| {
            let book = ColorBook::read("book.csv", text.as_bytes(), light).unwrap().unwrap();
            let BookValue::Lab { white, .. } = book.colors[0].value else { panic!("{book:?}") };
            (white.x.round(), white.z.round(), book.assumed_light.is_some())
        };
        let plain = "name,L,a,b\nSky,60,-5,-30\n";
        let stated = "name,L* (D50/2),a* (D50/2),b* (D50/2)\nSky,60,-5,-30\n";
        let a = Viewing::named("A", "1931-2").unwrap();
        assert_eq!(white(plain, None), (95.0, 109.0, true));
        assert_eq!(white(stated, None), (96.0, 83.0, false));
        assert_eq!(white(plain, Some(&a)), (110.0, 36.0, false));
    }

    #[test]
    fn rows_and_inks_without_a_colour_are_left_out_with_a_remark() {
        let book = read_text("name,L,a,b\nBlues,,,\nSky,60,-5,-30\n").unwrap().unwrap();
        assert_eq!(book.remarks, ["book.csv: left out 1 row without a colour"]);
        assert_eq!(book.colors.len(), 1);
    }
}
