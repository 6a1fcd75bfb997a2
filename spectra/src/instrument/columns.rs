//! Columns of numbers: a wavelength and one or more values, with or without headings.
//!
//! Cells are separated by semicolon, tab, spaces or comma. You may write a decimal comma if commas
//! do not separate cells. Lines that start with `#` are comments. Bruker OPUS data point tables
//! (.dpt) are columns without a heading.

use super::decode::{Decimal, lines, number, required_number};
use super::measured::{InstrumentError, MeasuredSpectrum, Role, Unit, deviations, stem};
use super::points::{Duplicates, Point, ordered};
use super::quantity::{MeasuredQuantity, line_states_percent, states_percent};
use crate::headings::{is_wavelength, name_rank, without_unit};

/// Whether `text` consists of columns: most lines are numbers, and each starts with a wavelength.
pub(super) fn is_column_text(text: &str) -> bool {
    let Some(layout) = Layout::of(content(text).map(|(_, line)| line)) else { return false };
    let mut firsts = Vec::new();
    let mut above = Vec::new();
    let mut others = 0_usize;
    for (_, line) in content(text) {
        if !layout.is_row(line) {
            others += 1;
            above.push(line);
        } else {
            let cells = layout.cells(line);
            // If decimal signs are mixed, an error names the odd cell.
            let first = number(cells[0], layout.decimal).or_else(|| any_number(cells[0]));
            firsts.push(first.unwrap_or(f64::NAN));
        }
    }
    let are_wavelengths = firsts.iter().all(|nm| *nm >= 100.0) || are_micrometres(&above, &firsts);
    are_wavelengths && firsts.len() >= 2 && firsts.len() >= others
}

/// Wavelengths in micrometres lie in this range. The spectral libraries of geologists end at about 15.
const MICROMETRES: [f64; 2] = [0.2, 20.0];
/// So many numbers without a word must rise or fall before we take them for micrometres.
const LEAST_MICROMETRES: usize = 8;

/// Whether `firsts`, the numbers of the first column, are micrometres: by a word in the lines above, or
/// because they rise or fall throughout from less than 2.5 within 0.2 to 20, as whole numbers do not.
fn are_micrometres(above: &[&str], firsts: &[f64]) -> bool {
    let [shortest, longest] = MICROMETRES;
    if !firsts.iter().all(|x| (shortest..=longest).contains(x)) {
        return false;
    }
    let named = above.iter().find_map(|line| Axis::of_words(line));
    let has_unit = named.is_some() && !above.iter().all(|line| Axis::is_without_unit(line));
    named == Some(Axis::Micrometres)
        || (!has_unit
            && firsts.len() >= LEAST_MICROMETRES
            && firsts.iter().any(|x| *x < 2.5)
            && firsts.iter().any(|x| x.fract() != 0.0)
            && (firsts.is_sorted_by(|a, b| a < b) || firsts.is_sorted_by(|a, b| a > b)))
}

/// Beyond this in nm few instruments measure, and infrared spectra in waves per cm begin.
const LONGEST_UNNAMED: f64 = 2500.0;

/// The unit of the first column, which no word states, with a remark if we guess.
fn unnamed_axis(
    file: &str,
    table: &NumberTable<'_>,
) -> Result<(Axis, Option<String>), InstrumentError> {
    let firsts: Vec<f64> = table.rows.iter().map(|(_, row)| row[0]).collect();
    let from = firsts.iter().copied().fold(f64::INFINITY, f64::min);
    let to = firsts.iter().copied().fold(0.0, f64::max);
    if are_micrometres(&[], &firsts) {
        let remark = format!("wavelengths have no unit: {from} to {to} are taken for micrometres");
        return Ok((Axis::Micrometres, Some(remark)));
    }
    if to > LONGEST_UNNAMED {
        let file = file.to_owned();
        return Err(InstrumentError::AxisUnit { file, line: table.rows[0].0, from, to });
    }
    Ok((Axis::Nanometres, None))
}

pub(super) fn read(file: &str, text: &str) -> Result<Vec<MeasuredSpectrum>, InstrumentError> {
    let table = table(file, text)?;
    let Some(first) = table.rows.first() else { return Ok(Vec::new()) };
    let width = first.1.len();
    let heads = table.heads(width);
    let commas = table.layout.is_some_and(|layout| layout.separator == Some(','));
    if heads.is_empty() && width > 2 && commas && !table.has_points {
        // `400,0,5` may contain a decimal comma.
        let expected = "a wavelength and one value, or a heading for every column";
        let line = lines(text).nth(first.0 - 1).map_or("", |(_, line)| line);
        return Err(InstrumentError::line(file, first.0, expected, line));
    }
    let words: String = table.above.join(" ");
    let axis = heads.first().and_then(|head| Axis::of_words(head.lowest()));
    let (axis, guess) = match axis.or_else(|| Axis::of_words(&words)) {
        Some(Axis::Nanometres) if Axis::is_without_unit(&table.above.join(" ")) => {
            // The word `wavelength` alone leaves nm open to values that can only be micrometres.
            unnamed_axis(file, &table).unwrap_or((Axis::Nanometres, None))
        }
        Some(axis) => (axis, None),
        None => unnamed_axis(file, &table)?,
    };
    let in_percent = table.above.iter().any(|line| line_states_percent(line));
    let above = table.above.iter().map(|line| MeasuredQuantity::of_words(line));
    let stated = |quantity: &MeasuredQuantity| {
        !matches!(quantity, MeasuredQuantity::Deviation | MeasuredQuantity::Unstated)
    };
    let above = match above.into_iter().find(stated) {
        None if is_of_a_light(&words) => MeasuredQuantity::Power,
        stated => stated.unwrap_or(MeasuredQuantity::Unstated),
    };
    let of_values: Vec<&str> = heads.iter().skip(1).map(ColumnHead::lowest).collect();
    let quantities: Vec<MeasuredQuantity> = (1..width)
        .map(|column| {
            let head = heads.get(column);
            match head.map_or(MeasuredQuantity::Unstated, |head| head.quantity(&of_values)) {
                MeasuredQuantity::Unstated => above,
                stated => stated,
            }
        })
        .collect();
    let names: Vec<String> = heads.iter().skip(1).map(ColumnHead::name).collect();
    let of_others = deviations(&names.iter().map(String::as_str).collect::<Vec<&str>>());
    let is_deviation = |column: usize| {
        quantities[column - 1] == MeasuredQuantity::Deviation
            || of_others.get(column - 1) == Some(&true)
    };
    let (deviations, kept): (Vec<usize>, Vec<usize>) = (1..width).partition(|c| is_deviation(*c));
    let kept = if kept.is_empty() { deviations.clone() } else { kept };
    kept.iter()
        .map(|&column| {
            let quantity = quantities[column - 1];
            let name = match heads.get(column).map(ColumnHead::name) {
                Some(name) if is_name(&name) => name,
                Some(name) if kept.len() > 1 && !name.is_empty() => name,
                _ if width > 2 && kept.len() > 1 => format!("{} {column}", stem(file)),
                _ => stem(file),
            };
            let is_percent =
                heads.get(column).is_some_and(ColumnHead::states_percent) || in_percent;
            let unit = if is_percent { Unit::Percent } else { Unit::Unstated };
            let label = ColumnLabel { name, quantity, unit };
            let mut record = table.spectrum(file, column, axis, label)?;
            record.remarks.extend(guess.clone());
            if column == kept[0] && kept != deviations {
                let mut names: Vec<String> = Vec::new();
                for name in deviations.iter().map(|&column| heads[column].lowest().to_owned()) {
                    if !names.contains(&name) {
                        names.push(name);
                    }
                }
                record.remarks.extend(
                    names.iter().map(|name| {
                        format!("the column `{name}` holds deviations and is left out")
                    }),
                );
            }
            Ok(record)
        })
        .collect()
}

/// The cells above a column, from the lowest row up. Some tables have two rows of headings: doses above
/// `mean` and `std`, or names above units.
struct ColumnHead<'a>(Vec<&'a str>);

impl<'a> ColumnHead<'a> {
    fn lowest(&self) -> &'a str {
        self.0.first().copied().unwrap_or_default()
    }

    /// The cells that name a sample, from the highest down. If none does, the lowest cell.
    fn name(&self) -> String {
        let telling = self.0.iter().rev().filter(|cell| is_name(cell));
        let telling: Vec<&str> = telling.map(|cell| without_unit(cell).0).collect();
        if telling.is_empty() { self.lowest().to_owned() } else { telling.join(" ") }
    }

    /// The quantity that the cells state. `of_values` are the lowest cells of all columns of values.
    fn quantity(&self, of_values: &[&str]) -> MeasuredQuantity {
        let lowest = MeasuredQuantity::of_heading(self.lowest(), of_values);
        let mut all: Vec<MeasuredQuantity> =
            self.0.iter().skip(1).map(|cell| MeasuredQuantity::of_words(cell)).collect();
        all.insert(0, lowest);
        let is_deviation = all.contains(&MeasuredQuantity::Deviation);
        let stated = all.into_iter().find(|quantity| *quantity != MeasuredQuantity::Unstated);
        match stated {
            Some(_) if is_deviation => MeasuredQuantity::Deviation,
            stated => stated.unwrap_or(MeasuredQuantity::Unstated),
        }
    }

    fn states_percent(&self) -> bool {
        self.0.iter().any(|cell| states_percent(cell))
    }
}

/// Number of different names among the columns of values that hold no deviations, and whether each
/// column has a cell that names it.
fn told_apart(heads: &[ColumnHead<'_>]) -> (usize, bool) {
    let values = heads.iter().skip(1);
    let values = values.filter(|head| head.quantity(&[]) != MeasuredQuantity::Deviation);
    let mut names: Vec<String> = values.map(ColumnHead::name).collect();
    let all_named = names.iter().all(|name| is_name(name));
    names.sort_unstable();
    names.dedup();
    (names.len(), all_named)
}

/// Whether the lines above the rows state figures of a light, e.g. lux. Light meters write these.
fn is_of_a_light(words: &str) -> bool {
    let lower = words.to_ascii_lowercase();
    lower
        .split(|c: char| !c.is_ascii_alphanumeric())
        .filter(|word| ["lux", "cct", "cri", "ppfd", "duv"].contains(word))
        .count()
        > 1
}

/// Whether a heading names a sample rather than a quantity.
fn is_name(heading: &str) -> bool {
    let lower = heading.to_ascii_lowercase();
    let generic = ["", "r", "%r", "y", "v", "value", "values", "intensity", "spd", "spectrum"];
    !generic.contains(&lower.as_str())
        && heading.chars().any(char::is_alphanumeric)
        && MeasuredQuantity::of_words(heading) == MeasuredQuantity::Unstated
}

/// Name, quantity and unit of a column.
pub(super) struct ColumnLabel {
    pub(super) name: String,
    pub(super) quantity: MeasuredQuantity,
    pub(super) unit: Unit,
}

/// Rows of numbers, and the lines above them.
pub(super) struct NumberTable<'a> {
    pub(super) above: Vec<&'a str>,
    layout: Option<Layout>,
    /// Whether a number has a decimal point.
    has_points: bool,
    /// Rows with their line numbers. All rows have the same number of cells, at least 2.
    pub(super) rows: Vec<(usize, Vec<f64>)>,
}

impl<'a> NumberTable<'a> {
    /// The headings of each column. It is empty if no line above the rows has cells for the columns.
    ///
    /// The names stand in the lowest line that begins with a word for wavelengths, else in the lowest that
    /// begins with a word for names, else in the lowest. If they are alike, or if they are quantities, we
    /// add the cells of lines above. A cell of those reaches to the next one, as merged cells do.
    fn heads(&self, width: usize) -> Vec<ColumnHead<'a>> {
        let Some(layout) = self.layout else { return Vec::new() };
        // A quoted sentence is no line of headings.
        let whole = |line: &&&str| layout.separator.is_some() || !line.contains('"');
        let lines = self.above.iter().rev().filter(whole).map(|line| layout.cells(line));
        let lines: Vec<Vec<&str>> =
            lines.filter(|cells| (2..=width).contains(&cells.len())).collect();
        let find = |is_wanted: &dyn Fn(&[&str]) -> bool| {
            let is_full = |cells: &Vec<&str>| cells.len() == width && is_wanted(cells);
            lines.iter().position(is_full)
        };
        let axis = |cells: &[&str]| {
            let is_other =
                matches!(Axis::of_words(cells[0]), Some(Axis::Micrometres | Axis::Wavenumbers));
            is_other || is_wavelength(cells[0])
        };
        let lowest = find(&axis)
            .or_else(|| find(&|cells| name_rank(cells[0]).is_some()))
            .or_else(|| find(&|_| true))
            .or_else(|| lines.iter().position(|cells| axis(cells)));
        let Some(lowest) = lowest else { return Vec::new() };
        let mut heads: Vec<ColumnHead<'a>> = Vec::new();
        for line in &lines[lowest..] {
            let (names, all_named) = told_apart(&heads);
            let count = heads.iter().skip(1);
            let count = count.filter(|h| h.quantity(&[]) != MeasuredQuantity::Deviation).count();
            if !heads.is_empty() && all_named && names == count {
                break;
            }
            let added: Vec<ColumnHead<'a>> = if heads.is_empty() {
                let cells = (0..width).map(|at| line.get(at).copied().unwrap_or_default());
                cells.map(|cell| ColumnHead(vec![cell])).collect()
            } else {
                let both = heads.iter().zip(filled(line, width));
                both.map(|(head, cell)| ColumnHead([&head.0[..], &[cell]].concat())).collect()
            };
            let names_samples = !all_named && name_rank(line[0]).is_some();
            if heads.is_empty() || told_apart(&added).0 > names || names_samples {
                heads = added;
            }
        }
        heads
    }

    pub(super) fn spectrum(
        &self,
        file: &str,
        column: usize,
        axis: Axis,
        label: ColumnLabel,
    ) -> Result<MeasuredSpectrum, InstrumentError> {
        let points = self.rows.iter().map(|(line, row)| Point {
            line: *line,
            nm: axis.nm(row[0]),
            value: row[column],
        });
        let ordered = ordered(file, points.collect(), Duplicates::Average)?;
        Ok(MeasuredSpectrum {
            name: label.name,
            quantity: label.quantity,
            role: Role::Main,
            unit: label.unit,
            wavelengths_nm: ordered.wavelengths_nm,
            values: ordered.values,
            line: self.rows.first().map_or(1, |(line, _)| *line),
            point_lines: ordered.lines,
            details: Vec::new(),
            remarks: ordered.remarks,
        })
    }
}

/// `width` cells, in which each empty one of values has the text of the one before.
fn filled<'a>(cells: &[&'a str], width: usize) -> Vec<&'a str> {
    let mut filled: Vec<&str> = Vec::with_capacity(width);
    for column in 0..width {
        let own = cells.get(column).copied().unwrap_or_default();
        let before = if column > 1 { filled[column - 1] } else { "" };
        filled.push(if own.is_empty() { before } else { own });
    }
    filled
}

/// Reads the rows of numbers in a text. All lines after the first row must be rows.
pub(super) fn table<'a>(file: &str, text: &'a str) -> Result<NumberTable<'a>, InstrumentError> {
    let layout = Layout::of(content(text).map(|(_, line)| line));
    let mut table = NumberTable { above: Vec::new(), layout, has_points: false, rows: Vec::new() };
    for (number, line) in content(text) {
        let width = table.rows.first().map_or(0, |(_, row)| row.len());
        match layout {
            Some(layout) if width > 0 || layout.is_row(line) => {
                table.rows.push((number, layout.numbers(file, number, line, width)?));
                table.has_points |= line.contains('.');
            }
            _ => table.above.push(line),
        }
    }
    Ok(table)
}

/// Empties the first `count` lines of the text. The others keep their line numbers.
pub(super) fn below(text: &str, count: usize) -> String {
    let mut data = "\n".repeat(count);
    for (_, line) in lines(text).skip(count) {
        data.push_str(line);
        data.push('\n');
    }
    data
}

/// Numbered lines that are neither empty nor comments.
fn content(text: &str) -> impl Iterator<Item = (usize, &str)> + Clone {
    let trimmed = lines(text).map(|(number, line)| (number, line.trim_matches([' ', '\0'])));
    let lines: Vec<_> =
        trimmed.filter(|(_, l)| !l.trim().is_empty() && !l.starts_with('#')).collect();
    lines.into_iter()
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Axis {
    Nanometres,
    Micrometres,
    /// Waves per centimetre.
    Wavenumbers,
}

impl Axis {
    /// The unit named in `words`, for example in the heading of a column. `None` if they name no unit.
    pub(super) fn of_words(words: &str) -> Option<Self> {
        let lower = words.to_lowercase();
        let contains_any = |signs: &[&str]| signs.iter().any(|sign| lower.contains(sign));
        let words = lower.split(|c: char| !c.is_alphanumeric());
        // A unit may follow its number, as in `300-900NM`.
        let words: Vec<&str> =
            words.map(|word| word.trim_start_matches(|c: char| c.is_ascii_digit())).collect();
        let begins = |stems: &[&str]| {
            words.iter().any(|word| stems.iter().any(|stem| word.starts_with(stem)))
        };
        if contains_any(&["1/cm", "cm-1", "cm^-1", "wave number"]) || begins(&["wavenumber"]) {
            Some(Self::Wavenumbers)
        } else if contains_any(&["\u{b5}m", "\u{3bc}m"])
            || begins(&["micromet", "micron"])
            || words.contains(&"um")
        {
            Some(Self::Micrometres)
        } else if begins(&["nanomet", "wavelength"]) || words.contains(&"nm") {
            Some(Self::Nanometres)
        } else {
            None
        }
    }

    /// Whether `words` speak of wavelengths, if at all, without a unit.
    fn is_without_unit(words: &str) -> bool {
        let lower = words.to_lowercase();
        let mut words = lower.split(|c: char| !c.is_alphabetic());
        matches!(Self::of_words(&lower), None | Some(Self::Nanometres))
            && !words.any(|word| word == "nm" || word.starts_with("nanomet"))
    }

    /// Wavelength in nm at the abscissa `x`, not finite for a wavenumber of 0.
    pub(super) fn nm(self, x: f64) -> f64 {
        match self {
            Self::Nanometres => x,
            Self::Micrometres => 1000.0 * x,
            Self::Wavenumbers => 1e7 / x,
        }
    }
}

/// Separator and decimal sign of a text.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Layout {
    /// Character between cells. `None` for any run of blanks.
    pub(super) separator: Option<char>,
    pub(super) decimal: Decimal,
}

impl Layout {
    /// Finds the layout that makes the most lines rows of two or more numbers, or `None` if it
    /// makes none. We take a comma as separator only if no other separator fits as well.
    pub(super) fn of<'a>(lines: impl Iterator<Item = &'a str> + Clone) -> Option<Self> {
        let mut best: (usize, Option<Self>) = (0, None);
        for separator in [Some(';'), Some('\t'), None, Some(',')] {
            let cells = lines.clone().map(|line| split(line, separator));
            let rows = cells.filter(|cells| is_row(cells));
            let mut count = 0;
            let cells: Vec<&str> = rows.inspect(|_| count += 1).flatten().collect();
            if count > best.0 {
                let decimal = Self::decimal_of(cells.into_iter());
                best = (count, Some(Self { separator, decimal }));
            }
        }
        best.1
    }

    /// The decimal sign of the numbers in `cells`. If both signs occur, we take the more frequent, so that
    /// an error names a cell with the other.
    pub(super) fn decimal_of<'a>(cells: impl Iterator<Item = &'a str>) -> Decimal {
        let [mut commas, mut points] = [0_usize; 2];
        for cell in cells {
            commas += usize::from(cell.contains(','));
            points += usize::from(cell.contains('.'));
        }
        if commas > 0 && commas >= points { Decimal::Comma } else { Decimal::Point }
    }

    /// The cells of a line, trimmed, but not the empty ones at its end.
    pub(super) fn cells<'a>(&self, line: &'a str) -> Vec<&'a str> {
        split(line, self.separator)
    }

    /// Whether all cells of a line are numbers, and there are at least two.
    pub(super) fn is_row(&self, line: &str) -> bool {
        is_row(&split(line, self.separator))
    }

    /// The numbers in the cells of a line. The line must have exactly `width` cells, or, if `width` is
    /// 0, any count of at least two.
    pub(super) fn numbers(
        &self,
        file: &str,
        line: usize,
        text: &str,
        width: usize,
    ) -> Result<Vec<f64>, InstrumentError> {
        let cells = self.cells(text);
        if cells.len() < 2 || (width > 0 && cells.len() != width) {
            let expected = "a wavelength and as many values as in the lines before";
            return Err(InstrumentError::line(file, line, expected, text));
        }
        let parsed = cells.iter().enumerate().map(|(column, cell)| {
            let expected = if column == 0 { "a wavelength" } else { "a value" };
            required_number(file, line, expected, cell, self.decimal)
        });
        parsed.collect()
    }
}

pub(super) fn split(line: &str, separator: Option<char>) -> Vec<&str> {
    let mut cells: Vec<&str> = match separator {
        Some(separator) => {
            // A separator between quotes is part of its cell.
            let mut quoted = false;
            let cells = line.split(|c: char| {
                quoted ^= c == '"';
                c == separator && !quoted
            });
            cells.map(|cell| cell.trim().trim_matches('"')).collect()
        }
        None => line.split_whitespace().collect(),
    };
    let kept = cells.iter().rposition(|cell| !cell.is_empty()).map_or(0, |last| last + 1);
    cells.truncate(kept);
    cells
}

fn is_row(cells: &[&str]) -> bool {
    cells.len() > 1 && cells.iter().all(|cell: &&str| any_number(cell).is_some())
}

/// The number in a cell with either decimal sign.
fn any_number(cell: &str) -> Option<f64> {
    number(cell, Decimal::Point).or_else(|| number(cell, Decimal::Comma))
}

/// We take an abscissa above this for a wavenumber, because no colour instrument measures longer
/// wavelengths.
const LONGEST_NM: f64 = 3300.0;

pub(super) fn read_bruker(
    file: &str,
    text: &str,
) -> Result<Vec<MeasuredSpectrum>, InstrumentError> {
    let table = table(file, text)?;
    let Some((_, first)) = table.rows.first() else { return Ok(Vec::new()) };
    let wide = table.rows.iter().any(|(_, row)| row[0] > LONGEST_NM);
    let axis = if wide { Axis::Wavenumbers } else { Axis::Nanometres };
    let unit = if wide { "as wavenumbers in 1/cm" } else { "as wavelengths in nm" };
    let remark = format!("the file does not state the unit of its first column; read {unit}");
    let width = first.len();
    (1..width)
        .map(|column| {
            let name = if width > 2 { format!("{} {column}", stem(file)) } else { stem(file) };
            let quantity = MeasuredQuantity::Unstated;
            let unit = Unit::Unstated;
            let mut record =
                table.spectrum(file, column, axis, ColumnLabel { name, quantity, unit })?;
            record.remarks.insert(0, remark.clone());
            Ok(record)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn headings_name_spectra_and_their_unit() {
        let found = read("a/b.txt", "# x\nnm;Red %;Blue %\n420;1,5;2\n400;1;3\n").unwrap();
        assert_eq!(found.len(), 2);
        assert_eq!((found[1].name.as_str(), found[1].unit), ("Blue %", Unit::Percent));
        assert_eq!(found[0].wavelengths_nm, [400.0, 420.0]);
        assert_eq!(found[0].values, [1.0, 1.5]);
        let found = read("a/b.txt", "wavelength,reflectance\n400,0.1\n410,0.2\n").unwrap();
        assert_eq!((found[0].name.as_str(), found[0].line), ("b", 2));
        assert_eq!(found[0].quantity, MeasuredQuantity::Reflectance);
    }

    #[test]
    fn a_heading_that_is_the_name_of_a_paint_states_no_quantity() {
        let text = "nm,Raw Umber,Straw Yellow,Absorbing Black\n400,5,6,2\n410,6,7,2\n";
        for record in read("f", text).unwrap() {
            assert_eq!(record.quantity, MeasuredQuantity::Unstated, "{}", record.name);
        }
        for (heading, wanted) in [
            ("A", MeasuredQuantity::Absorbance),
            ("%T", MeasuredQuantity::Transmittance),
            ("K/S", MeasuredQuantity::KubelkaMunk),
            ("n", MeasuredQuantity::OpticalConstant),
            ("red", MeasuredQuantity::Unstated),
        ] {
            let found = read("f", &format!("nm,{heading}\n400,0.1\n410,0.2\n")).unwrap();
            assert_eq!(found[0].quantity, wanted, "{heading}");
        }
        let letters = read("f", "nm,A,K\n400,0.1,0.2\n410,0.2,0.3\n").unwrap();
        assert!(letters.iter().all(|record| record.quantity == MeasuredQuantity::Unstated));
    }

    #[test]
    fn deviations_are_set_aside_with_a_remark() {
        let found = read("f", "nm,Mean,StdDev\n400,0.1,0.01\n410,0.2,0.01\n").unwrap();
        let [record] = &found[..] else { panic!("{found:?}") };
        assert_eq!((record.name.as_str(), record.values[1]), ("Mean", 0.2));
        let remark = "the column `StdDev` holds deviations and is left out";
        assert_eq!(record.remarks, [remark]);
        let alone = read("f", "nm,StdDev\n400,0.1\n410,0.2\n").unwrap();
        assert_eq!(alone[0].quantity, MeasuredQuantity::Deviation);
    }

    #[test]
    fn figures_of_a_light_above_the_rows_make_them_its_power() {
        let text = "LUX = 695\nCCT = 5198\n400 0.1\n410 0.2\n";
        assert_eq!(read("f", text).unwrap()[0].quantity, MeasuredQuantity::Power);
        let text = text.replace("CCT", "x");
        assert_eq!(read("f", &text).unwrap()[0].quantity, MeasuredQuantity::Unstated);
    }

    #[test]
    fn micrometres_are_known_by_a_word_or_guessed_with_a_remark() {
        for head in [
            "Wavelength_um,R\n",
            "Wavelength (um),R\n",
            "micrometers,R\n",
            "Type: manmade\nX Units: Wavelength (micrometers)\nY Units: Reflectance (percent)\n",
        ] {
            let text = format!("{head}0.4,0.1\n0.5,0.2\n0.6,0.2\n");
            assert!(is_column_text(&text), "{head}");
            let found = &read("f", &text).unwrap()[0];
            assert_eq!(found.wavelengths_nm, [400.0, 500.0, 600.0], "{head}");
            assert_eq!(found.unit == Unit::Percent, head.contains("percent"), "{head}");
            assert!(found.remarks.is_empty(), "{:?}", found.remarks);
        }
        let rows = |first: fn(u32) -> f64| -> String {
            (0..10).map(|at| format!("{} 0.{at}\n", first(at))).collect()
        };
        let guessed = rows(|at| 14.0 - 1.5 * f64::from(at));
        assert!(is_column_text(&guessed));
        let found = &read("f", &guessed).unwrap()[0];
        assert_eq!((found.wavelengths_nm[0], found.values[0]), (500.0, 0.9));
        assert!(found.remarks[0].contains("are taken for micrometres"), "{:?}", found.remarks);
        for other in [rows(|at| f64::from(at + 1)), rows(|at| 0.4 + f64::from(at % 2))] {
            assert!(!is_column_text(&other), "{other}");
        }
    }

    #[test]
    fn numbers_beyond_2500_without_a_word_are_asked_about() {
        for text in ["399 0.1\n4000 0.2\n", "4000 0.1\n2600 0.2\n399 0.3\n"] {
            let asked = read("f", text).unwrap_err();
            let wanted = matches!(asked, InstrumentError::AxisUnit { from: 399.0, to: 4000.0, .. });
            assert!(wanted && asked.to_string().contains("line 1"), "{asked}");
            let named = read("f", &format!("cm-1 R\n{text}")).unwrap();
            assert_eq!(named[0].wavelengths_nm[0], 2500.0);
            assert!(read("f", &format!("nm R\n{text}")).is_ok());
        }
        assert!(read("f", "350 0.1\n2500 0.2\n").is_ok());
    }

    #[test]
    fn percent_is_stated_by_units_and_not_by_notes() {
        for (text, wanted) in [
            ("Wavelength[nm]\tReflectance[%]\n400\t1\n410\t2\n", Unit::Percent),
            ("quartz, 100% abundance\nnm R\n400 0.1\n410 0.2\n", Unit::Unstated),
            ("nm,20% tint,50% tint\n400,0.1,0.1\n410,0.2,0.1\n", Unit::Unstated),
        ] {
            assert_eq!(read("f", text).unwrap()[0].unit, wanted, "{text}");
        }
    }

    #[test]
    fn photons_above_the_rows_are_a_light() {
        let text = "\"REM: GR8 (QNTM)\"\n\"DATE:08/18 15:27\"\n 400  1.0E-04\n 410  2.0E-04\n";
        let found = &read("d/lamp.PRN", text).unwrap()[0];
        assert_eq!((found.name.as_str(), found.quantity), ("lamp", MeasuredQuantity::Photons));
    }

    #[test]
    fn wavenumbers_become_wavelengths() {
        let found = read("f", "cm-1,R\n20000,0.1\n25000,0.2\n").unwrap();
        assert_eq!(
            (&found[0].wavelengths_nm, &found[0].values),
            (&vec![400.0, 500.0], &vec![0.2, 0.1])
        );
    }

    #[test]
    fn faults_name_their_line() {
        for (text, at) in [
            ("400,0.1\n410,x\n", 2),
            ("400,0.1\n\n410,nan\n", 3),
            ("400,0.1\n410\n", 2),
            ("400,0,1\n410,0,2\n", 1),
            ("400;0,1\n410;0.2\n420;0,3\n", 2),
        ] {
            let found = read("f", text);
            let Err(InstrumentError::Line { line, .. }) = found else { panic!("{found:?}") };
            assert_eq!(line, at, "{text}");
        }
        let found = read("f", "400,0.1\n420,0.1\n410,0.2\n");
        assert!(matches!(found, Err(InstrumentError::Order { line: 3, .. })), "{found:?}");
    }

    #[test]
    fn tables_of_other_things_are_not_columns() {
        assert!(is_column_text("nm value\n400 0.1\n410 0.2\n"));
        assert!(!is_column_text("name,400,410\nA,0.1,0.2\nB,0.1,0.2\n"));
        assert!(!is_column_text("0.1,0.2\n0.3,0.4\n"));
        assert!(!is_column_text("hello\n"));
    }

    #[test]
    fn separators_and_decimal_commas_are_distinguished() {
        use Decimal::{Comma, Point};
        for (line, separator, decimal) in [
            ("400;0,5", Some(';'), Comma),
            ("400;0.5;", Some(';'), Point),
            ("400\t0,5", Some('\t'), Comma),
            ("400,5 0,123", None, Comma),
            ("  400   0.5", None, Point),
            ("400,0.5", Some(','), Point),
            ("400, 0.5", Some(','), Point),
            ("400 , 0.5", Some(','), Point),
            ("\"400\",\"0,5\"", Some(','), Comma),
            ("400,\"0,5\"", Some(','), Comma),
        ] {
            assert_eq!(
                Layout::of([line].into_iter()),
                Some(Layout { separator, decimal }),
                "{line}"
            );
        }
        assert_eq!(Layout::of(["wavelength,value"].into_iter()), None);
    }

    #[test]
    fn the_first_column_is_nm_or_wavenumbers_by_its_size() {
        let found = &read_bruker("x/a.0.dpt", "25000.0,0.2\n20000.0,0.1\n").unwrap()[0];
        assert_eq!((found.name.as_str(), &found.wavelengths_nm), ("a.0", &vec![400.0, 500.0]));
        assert_eq!(found.values, [0.2, 0.1]);
        let found = &read_bruker("a.dpt", "400.0,0.2\n500.0,0.1\n").unwrap()[0];
        assert_eq!(found.wavelengths_nm, [400.0, 500.0]);
        assert!(found.remarks[0].contains("nm"), "{:?}", found.remarks);
    }
}
