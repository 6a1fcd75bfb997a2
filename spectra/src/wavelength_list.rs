//! Lists of wavelengths that stand apart from their values: a file, a range such as `380..730:10`, or a list
//! in a header, in nm or micrometres.

use std::path::Path;

use documents::file::{self, FileError};
use documents::hint::Explain;

use crate::grid::{Grid, GridError};

/// Shortest wavelength of a reflectance scan, in nm.
const SHORTEST_NM: f64 = 150.0;
/// Longest wavelength of a reflectance scan, in nm.
const LONGEST_NM: f64 = 30_000.0;

/// Wavelengths in nm, and how the unit was found.
///
/// ```
/// let list = spectra::WavelengthList::named("380..730:10").unwrap();
/// assert_eq!((list.nm.len(), list.nm[35]), (36, 730.0));
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct WavelengthList {
    /// The wavelengths, in the order of the list. None occurs twice.
    pub nm: Vec<f64>,
    /// Factor from the unit of the list to nm.
    pub factor: f64,
    /// Remark if we judged the unit by the range.
    pub remark: Option<String>,
}

/// Factor from the unit `name` to nm. You get `Ok(None)` if the name is not a unit.
fn factor(name: &str) -> Result<Option<f64>, String> {
    let plain = name.trim().trim_matches(['"', '{', '}']).trim().to_lowercase();
    match plain.as_str() {
        "" | "unknown" | "none" | "wavelength" => Ok(None),
        "nm" | "nanometer" | "nanometers" | "nanometre" | "nanometres" => Ok(Some(1.0)),
        // Micro signs, and a micro sign of Latin-1 read as UTF-8.
        "um" | "\u{b5}m" | "\u{3bc}m" | "\u{fffd}m" | "micrometer" | "micrometers"
        | "micrometre" | "micrometres" | "micron" | "microns" => Ok(Some(1000.0)),
        "mm" | "millimeter" | "millimeters" => Ok(Some(1e6)),
        "cm" | "centimeter" | "centimeters" => Ok(Some(1e7)),
        "m" | "meter" | "meters" => Ok(Some(1e9)),
        "angstrom" | "angstroms" => Ok(Some(0.1)),
        _ => Err(format!("has the unit `{}`, which is not a length", name.trim())),
    }
}

impl WavelengthList {
    /// The wavelengths that `text` names: `FIRST..LAST:STEP` in nm, or the path of a file, which
    /// [`WavelengthList::from_text`] reads.
    ///
    /// # Errors
    /// [`WavelengthListError`] with file and line.
    pub fn named(text: &str) -> Result<Self, WavelengthListError> {
        if let Some(list) = Self::of_range(text)? {
            return Ok(list);
        }
        let bytes = file::read(Path::new(text))?;
        Self::from_text(text, &String::from_utf8_lossy(&bytes))
    }

    /// The wavelengths of a range `FIRST..LAST:STEP` in nm. `None` if `text` is no range.
    ///
    /// # Errors
    /// [`WavelengthListError::Range`] if the last wavelength is not a whole number of steps from the first.
    pub fn of_range(text: &str) -> Result<Option<Self>, WavelengthListError> {
        let parts = text.split_once("..").and_then(|(first, rest)| {
            let (last, step) = rest.split_once(':')?;
            let number = |text: &str| text.trim().parse::<f64>().ok();
            Some((number(first)?, number(last)?, number(step)?))
        });
        let Some((first, last, step)) = parts else { return Ok(None) };
        let grid = Grid::from_range(first, last, step)?;
        Ok(Some(Self { nm: grid.wavelengths_nm().collect(), factor: 1.0, remark: None }))
    }

    /// Reads wavelengths from `text`, the content of `file`: one in each line or all in one line. They are
    /// in nm, or in micrometres if a heading or their range shows this. If there are several columns, we
    /// take the one with a heading of wavelengths, or else the last number of each line. Text after `#` is
    /// a comment.
    ///
    /// # Errors
    /// [`WavelengthListError`] with the line.
    pub fn from_text(file: &str, text: &str) -> Result<Self, WavelengthListError> {
        let mut rows: Vec<Vec<f64>> = Vec::new();
        let mut heading = None;
        for (line, number) in text.trim_start_matches('\u{feff}').lines().zip(1..) {
            let line = line.split('#').next().unwrap_or_default().trim();
            let words = words(line);
            let numbers: Vec<f64> = words.iter().filter_map(|word| number_of(word)).collect();
            // A title may hold a number, as in `Wavelengths ASD 0.35-2.5 microns 2151 channels`.
            let is_title = numbers.is_empty()
                || (words.len() > 2 * numbers.len() && heading_of(&words).is_some());
            match (words.is_empty(), is_title) {
                (true, _) => {}
                (false, true) if rows.is_empty() => {
                    heading = heading.or_else(|| heading_of(&words));
                }
                (false, true) if numbers.is_empty() => {
                    return Err(WavelengthListError::Line {
                        file: file.to_owned(),
                        line: number,
                        text: line.chars().take(40).collect(),
                    });
                }
                // Words beside the numbers, such as names of pictures, keep their columns.
                (false, _) => {
                    let cells = words.iter().map(|word| number_of(word).unwrap_or(f64::NAN));
                    rows.push(cells.collect());
                }
            }
        }
        let (column, unit) = heading.unwrap_or((None, None));
        // The words of a title stand above no columns.
        let width = rows.iter().map(Vec::len).max().unwrap_or(0);
        let column = column.filter(|column| *column < width);
        let values: Vec<f64> = match &rows[..] {
            // Units and words between the numbers are passed over.
            [list] if column.is_none() => {
                list.iter().copied().filter(|nm| nm.is_finite()).collect()
            }
            rows => rows
                .iter()
                .map(|row: &Vec<f64>| match column {
                    Some(column) => row.get(column).copied().unwrap_or(f64::NAN),
                    None => {
                        let last = row.iter().copied().rev().find(|value| value.is_finite());
                        last.unwrap_or(f64::NAN)
                    }
                })
                .collect(),
        };
        let faulty = |problem: String| WavelengthListError::List { file: file.to_owned(), problem };
        if values.is_empty() {
            return Err(faulty("holds no wavelengths".to_owned()));
        }
        Self::of(&values, unit).map_err(|problem| faulty(format!("the list {problem}")))
    }

    /// Converts `values` with the unit `unit`. If you pass no unit, we take values from 0.15 to 30
    /// for micrometres and values from 150 to 30,000 for nm.
    ///
    /// # Errors
    /// The fault of the list as part of a sentence, without the name of the list.
    pub fn of(values: &[f64], unit: Option<&str>) -> Result<Self, String> {
        let told = unit.map(factor).transpose()?.flatten();
        if let Some(at) = values.iter().position(|value| !(value.is_finite() && *value > 0.0)) {
            return Err(format!(
                "has `{}` as number {}, which is not a wavelength",
                values[at],
                at + 1
            ));
        }
        let least = values.iter().copied().fold(f64::INFINITY, f64::min);
        let most = values.iter().copied().fold(0.0, f64::max);
        let inside = |factor: f64| least * factor >= SHORTEST_NM && most * factor <= LONGEST_NM;
        let judged = [(1.0, "nm"), (1000.0, "micrometres")].into_iter().find(|it| inside(it.0));
        let (factor, remark) = match (told, judged) {
            (Some(factor), _) if inside(factor) => (factor, None),
            (Some(_), Some((_, better))) => {
                let unit = unit.unwrap_or_default().trim();
                return Err(format!(
                    "runs from `{least}` to `{most}`, which are not {unit}: these look like {better}"
                ));
            }
            (None, Some((factor, name))) => {
                let remark =
                    format!("wavelengths have no unit: {least} to {most} are taken for {name}");
                (factor, Some(remark))
            }
            (_, None) => {
                return Err(format!(
                    "runs from `{least}` to `{most}`, expected {SHORTEST_NM} to {LONGEST_NM} nm"
                ));
            }
        };
        let nm: Vec<f64> = values.iter().map(|value| value * factor).collect();
        let mut order: Vec<usize> = (0..nm.len()).collect();
        order.sort_by(|&a, &b| nm[a].total_cmp(&nm[b]));
        if let Some(pair) = order.windows(2).find(|pair| nm[pair[0]] >= nm[pair[1]]) {
            let a = pair[0].min(pair[1]) + 1;
            let b = pair[0].max(pair[1]) + 1;
            return Err(format!("has `{}` twice, as numbers {a} and {b}", values[pair[0]]));
        }
        Ok(Self { nm, factor, remark })
    }
}

fn words(line: &str) -> Vec<&str> {
    let words = line.split([',', ';', '\t', ' ']).map(|word| word.trim().trim_matches('"'));
    words.filter(|word| !word.is_empty()).collect()
}

/// Reads a number, also with its unit, e.g. `450` or `450nm`.
fn number_of(word: &str) -> Option<f64> {
    word.strip_suffix("nm").unwrap_or(word).parse().ok().filter(|value: &f64| value.is_finite())
}

/// Column and unit of the wavelengths, if a line of words names them.
fn heading_of(words: &[&str]) -> Option<(Option<usize>, Option<&'static str>)> {
    let lower: Vec<String> = words.iter().map(|word| word.to_lowercase()).collect();
    let units = [("nm", &["nm", "nanomet"][..]), ("um", &["micromet", "micron", "(um)", "_um"])];
    let unit = units.into_iter().find(|(_, parts)| lower.iter().any(|word| has(word, parts)));
    let unit = unit.map(|(name, _)| name);
    let column =
        lower.iter().position(|word: &String| has(word, &["wavelength", "lambda"]) || word == "nm");
    (column.is_some() || unit.is_some()).then_some((column, unit))
}

fn has(word: &str, parts: &[&str]) -> bool {
    parts.iter().any(|part| word.contains(part))
}

/// A list of wavelengths that cannot be read.
#[derive(Debug, Clone, PartialEq, thiserror::Error, Explain)]
pub enum WavelengthListError {
    /// The file cannot be read.
    #[error(transparent)]
    #[hint("name a file with one wavelength in nm in each line, or a range such as 380..730:10")]
    File(#[from] FileError),
    /// The range is none.
    #[error(transparent)]
    #[hint("write FIRST..LAST:STEP in nm, such as 380..730:10")]
    #[fault(Setting)]
    Range(#[from] GridError),
    /// A line holds no wavelength.
    #[error("{file}: line {line}: `{text}` is not a wavelength")]
    #[hint("write one wavelength in nm in each line")]
    Line {
        /// Path of the file.
        file: String,
        /// Line number, from 1.
        line: usize,
        /// The line, shortened to 40 characters.
        text: String,
    },
    /// The numbers are not wavelengths.
    #[error("{file}: {problem}")]
    #[hint("write one wavelength in nm in each line")]
    List {
        /// Path of the file.
        file: String,
        /// The fault, as part of a sentence.
        problem: String,
    },
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Vec<f64>, String> {
        let found = WavelengthList::from_text("wavelengths.txt", text);
        found.map(|list| list.nm).map_err(|error| error.to_string())
    }

    #[test]
    fn ranges_name_their_wavelengths() {
        let nm = |text: &str| WavelengthList::of_range(text).map(|list| list.map(|list| list.nm));
        assert_eq!(nm("400..420:10"), Ok(Some(vec![400.0, 410.0, 420.0])));
        assert_eq!(nm("some/file.txt"), Ok(None));
        assert!(matches!(nm("400..425:10"), Err(WavelengthListError::Range(..))));
        let missing = WavelengthList::named("no/such.txt").unwrap_err();
        assert!(matches!(missing, WavelengthListError::File(..)), "{missing}");
    }

    #[test]
    fn lists_of_all_shapes_are_read() {
        for text in [
            "450\n500.5\n",
            "450, 500.5",
            "450 500.5\n",
            "450 nm, 500.5 nm\n",
            "wavelength_nm\n450\n500.5",
            "band,wavelength\n1,450\n2,500.5\n",
            "wavelength,fwhm\n450,9\n500.5,9\n",
            "file;nm\na.png;450\nb.png;500.5\n",
            "# two filters\n450nm # blue\n500.5nm\n",
            "\u{feff}1\t450\n2\t500.5\n",
            "wavelength (um)\n0.45\n0.5005\n",
            " splib07a Record=1: Wavelengths in microns ASD 2 channels\n 0.45\n 0.5005\n",
        ] {
            let found = read(text).unwrap();
            let near = found.iter().zip([450.0, 500.5]).all(|(a, b)| (a - b).abs() < 1e-9);
            assert!(near && found.len() == 2, "{text:?}: {found:?}");
        }
    }

    #[test]
    fn faults_name_the_line() {
        let error = read("450\nblue\n").unwrap_err();
        assert!(error.ends_with("wavelengths.txt: line 2: `blue` is not a wavelength"), "{error}");
        assert!(read("# nothing\n").unwrap_err().ends_with("holds no wavelengths"));
        assert!(read("1\n2\n300\n").unwrap_err().contains("the list runs from"));
    }

    fn nm(values: &[f64], unit: Option<&str>) -> Result<Vec<f64>, String> {
        WavelengthList::of(values, unit).map(|found| found.nm)
    }

    #[test]
    fn units_by_name_give_nm() {
        for unit in ["nm", "Nanometers", " nanometre "] {
            assert_eq!(nm(&[400.0, 700.5], Some(unit)), Ok(vec![400.0, 700.5]), "{unit}");
        }
        for unit in ["um", "Micrometers", "\u{b5}m", "\u{fffd}m", "microns"] {
            assert_eq!(nm(&[0.5, 2.5], Some(unit)), Ok(vec![500.0, 2500.0]), "{unit}");
        }
        assert_eq!(nm(&[4000.0], Some("Angstroms")), Ok(vec![400.0]));
        let error = nm(&[1.0, 2.0], Some("Index")).unwrap_err();
        assert_eq!(error, "has the unit `Index`, which is not a length");
        assert!(nm(&[20_000.0], Some("Wavenumber")).is_err(), "a wavenumber is not a wavelength");
    }

    #[test]
    fn a_missing_unit_is_judged_by_the_range_and_told() {
        let found = WavelengthList::of(&[400.0, 1000.0], None).unwrap();
        assert_eq!(found.nm, [400.0, 1000.0]);
        let remark = found.remark.unwrap();
        assert_eq!(remark, "wavelengths have no unit: 400 to 1000 are taken for nm");
        let found = WavelengthList::of(&[0.4, 1.0], Some("Unknown")).unwrap();
        assert_eq!((found.nm, found.factor), (vec![400.0, 1000.0], 1000.0));
        assert!(found.remark.unwrap().ends_with("are taken for micrometres"));
        assert!(nm(&[1.0, 31.0], None).is_err(), "numbers of bands are not wavelengths");
    }

    #[test]
    fn a_wrong_unit_is_refused_with_the_better_one() {
        let error = nm(&[400.0, 700.0], Some("Micrometers")).unwrap_err();
        assert!(error.ends_with("are not Micrometers: these look like nm"), "{error}");
        let error = nm(&[0.4, 0.7], Some("nm")).unwrap_err();
        assert!(error.ends_with("are not nm: these look like micrometres"), "{error}");
    }

    #[test]
    fn lists_that_are_no_wavelengths_are_refused() {
        assert!(nm(&[400.0, f64::NAN], None).unwrap_err().contains("number 2"));
        assert!(nm(&[-400.0], None).unwrap_err().contains("`-400`"));
        let error = nm(&[410.0, 400.0, 410.0], Some("nm")).unwrap_err();
        assert_eq!(error, "has `410` twice, as numbers 1 and 3");
    }
}
