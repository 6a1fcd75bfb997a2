//! The data of JCAMP-DX: pairs, rows of ordinates, plain or packed, and the pages of NTUPLES.
//!
//! A packed ordinate (ASDF form) begins with a letter that encodes its first digit and sign:
//! SQZ for a value, DIF for the difference from the previous value, DUP for the number of
//! repetitions of the previous item. If a row ends with a difference, the next row repeats the
//! last value as a check.
//!
//! NTUPLES are tables with variables that are described in lists (Lampen, Hillig, Davies and Linscheid,
//! "JCAMP-DX for mass spectrometry", Applied Spectroscopy 48 (1994) 1545). `##SYMBOL=` names the variables.
//! `##FACTOR=`, `##FIRST=`, `##LAST=`, `##VAR_DIM=` and `##UNITS=` list one value for each variable, in the
//! same order. Each `##PAGE=` has a `##DATA TABLE=` of two variables.

use super::super::decode::{Decimal, number, required_number};
use super::super::measured::InstrumentError;
use super::super::points::Point;

/// Maximum number of points. No spectrometer writes so many, and this bounds the memory that a DUP
/// count can request.
const MOST_POINTS: usize = 4_000_000;

/// A labelled record, and the lines of its value.
pub(super) struct Field<'a> {
    /// The label without spaces and signs, in upper case.
    pub(super) label: String,
    pub(super) lines: Vec<(usize, &'a str)>,
}

/// The step of abscissas that a file states (DELTAX).
#[derive(Clone, Copy)]
pub(super) struct StatedStep {
    pub(super) line: usize,
    pub(super) step: f64,
    /// Half of the last decimal place that the file writes.
    pub(super) rounding: f64,
}

/// A stated step may differ by this share from the step that limits and number give.
const STEP_TOLERANCE: f64 = 0.01;

impl StatedStep {
    fn check(&self, file: &str, step: f64) -> Result<(), InstrumentError> {
        let apart = (self.step.abs() - step.abs()).abs();
        if self.step == 0.0 || apart <= self.rounding.max(STEP_TOLERANCE * step.abs()) {
            return Ok(());
        }
        let expected = "a DELTAX that leads from FIRSTX to LASTX in NPOINTS steps";
        let text = format!("{}, where {step} does", self.step);
        Err(InstrumentError::line(file, self.line, expected, &text))
    }
}

/// Factors and limits that convert the numbers of a block into abscissas and ordinates.
pub(super) struct Scaling {
    pub(super) x: f64,
    pub(super) y: f64,
    pub(super) first_x: Option<f64>,
    pub(super) last_x: Option<f64>,
    pub(super) count: Option<f64>,
    pub(super) stated_step: Option<StatedStep>,
}

impl Scaling {
    fn point(&self, file: &str, line: usize, x: f64, y: f64) -> Result<Point, InstrumentError> {
        let value = y * self.y;
        if value.is_finite() {
            Ok(Point { line, nm: x, value })
        } else {
            Err(InstrumentError::line(file, line, "a value", &value.to_string()))
        }
    }
}

/// Reads `(XY..XY)`: pairs separated by commas, semicolons or blanks. The field `nm` of each point
/// holds the abscissa in whatever unit.
pub(super) fn points(
    file: &str,
    lines: &[(usize, &str)],
    scaling: &Scaling,
) -> Result<Vec<Point>, InstrumentError> {
    let mut points = Vec::new();
    for &(line, text) in lines {
        let cells = text.split(|c: char| c == ',' || c == ';' || c.is_whitespace());
        let cells: Vec<&str> = cells.filter(|cell| !cell.is_empty()).collect();
        if !cells.len().is_multiple_of(2) {
            return Err(InstrumentError::line(file, line, "pairs of abscissa and ordinate", text));
        }
        for pair in cells.chunks_exact(2) {
            let x = required_number(file, line, "an abscissa", pair[0], Decimal::Point)?;
            let y = required_number(file, line, "an ordinate", pair[1], Decimal::Point)?;
            points.push(scaling.point(file, line, x * scaling.x, y)?);
        }
    }
    Ok(points)
}

/// Reads `(X++(Y..Y))`: rows of one abscissa and evenly spaced ordinates.
pub(super) fn runs(
    file: &str,
    lines: &[(usize, &str)],
    scaling: &Scaling,
) -> Result<Vec<Point>, InstrumentError> {
    // Line, abscissa and index of each row's first ordinate, to check the abscissas once the
    // step is known.
    let mut starts: Vec<(usize, f64, usize)> = Vec::new();
    let mut ordinates: Vec<(usize, f64)> = Vec::new();
    let mut check = false;
    for &(line, text) in lines {
        let tokens = tokens(text).ok_or_else(|| {
            InstrumentError::line(file, line, "an abscissa and ordinates (AFFN or packed)", text)
        })?;
        let mut tokens = tokens.into_iter();
        let Some(Token::Value(x)) = tokens.next() else {
            return Err(InstrumentError::line(file, line, "an abscissa", text));
        };
        let mut before: Option<Token> = None;
        let start = ordinates.len() - usize::from(check);
        starts.push((line, x * scaling.x, start));
        let mut checks = check;
        for token in tokens {
            let last = ordinates.last().map(|(_, y)| *y);
            let times = match token {
                Token::Times(times) => times - 1,
                Token::Value(_) | Token::Difference(_) => 1,
            };
            let repeated = if matches!(token, Token::Times(_)) { before } else { Some(token) };
            let value = match (repeated, last) {
                (Some(Token::Value(y)), _) => Some((y, 0.0)),
                (Some(Token::Difference(d)), Some(last)) => Some((last + d, d)),
                _ => None,
            };
            let Some((first, step)) = value else {
                let expected = "a value before a difference or a repetition";
                return Err(InstrumentError::line(file, line, expected, text));
            };
            if std::mem::take(&mut checks) {
                if last.is_some_and(|last| last != first) || times != 1 {
                    let expected = "the last ordinate of the previous line as a check";
                    return Err(InstrumentError::line(file, line, expected, text));
                }
            } else if ordinates.len() + times > MOST_POINTS {
                return Err(InstrumentError::line(file, line, "at most 4000000 ordinates", text));
            } else {
                let mut value = first;
                for _ in 0..times {
                    ordinates.push((line, value));
                    value += step;
                }
            }
            before = repeated;
        }
        check = matches!(before, Some(Token::Difference(_)));
    }
    let (Some(&(line, first_x, _)), true) = (starts.first(), ordinates.len() > 1) else {
        return match (starts.first(), ordinates.first()) {
            (Some(&(_, x, _)), Some(&(line, y))) => Ok(vec![scaling.point(file, line, x, y)?]),
            _ => Ok(Vec::new()),
        };
    };
    let steps = (ordinates.len() - 1) as f64;
    // A file that was cut off still states the step of the whole.
    let intervals = scaling.count.filter(|count| *count > 1.0).map_or(steps, |count| count - 1.0);
    let first_x = scaling.first_x.unwrap_or(first_x);
    let step = match (scaling.last_x, scaling.stated_step) {
        (Some(last_x), _) => (last_x - first_x) / intervals,
        (None, Some(stated)) => stated.step,
        (None, None) => {
            return Err(InstrumentError::line(file, line, "##LASTX=", "no such label"));
        }
    };
    if let Some(stated) = scaling.stated_step {
        stated.check(file, step)?;
    }
    let at = |index: usize| first_x + step * index as f64;
    for &(line, x, index) in &starts {
        // Abscissas of rows are often rounded to whole units.
        if (x - at(index)).abs() > (0.6 * step.abs()).max(0.6 * scaling.x.abs()) {
            let text = format!("{x}, where {} follows", at(index));
            return Err(InstrumentError::line(file, line, "the next abscissa", &text));
        }
    }
    let points = ordinates.iter().enumerate();
    points.map(|(index, &(line, y))| scaling.point(file, line, at(index), y)).collect()
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Token {
    Value(f64),
    Difference(f64),
    Times(usize),
}

/// The tokens of a row, or `None` if one is invalid.
fn tokens(text: &str) -> Option<Vec<Token>> {
    let mut found = Vec::new();
    let mut rest = text.trim_start_matches(is_blank);
    while let Some(first) = rest.chars().next() {
        let (kind, digit) = packed(first);
        let body = &rest[first.len_utf8()..];
        let length = body_length(body);
        let text = digit.map_or_else(|| first.to_string(), |digit| digit.to_string());
        let value = number(&(text + &body[..length]), Decimal::Point)?;
        found.push(match kind {
            Kind::Value => Token::Value(value),
            Kind::Difference => Token::Difference(value),
            Kind::Times if value >= 1.0 && value <= MOST_POINTS as f64 => {
                Token::Times(value as usize)
            }
            Kind::Times => return None,
        });
        rest = body[length..].trim_start_matches(is_blank);
    }
    Some(found)
}

fn is_blank(c: char) -> bool {
    c.is_whitespace() || c == ','
}

/// Length of the number that `body` starts with: digits, a decimal point, and an exponent with
/// digits.
fn body_length(body: &str) -> usize {
    let bytes = body.as_bytes();
    let digits = bytes.iter().take_while(|b| b.is_ascii_digit() || **b == b'.').count();
    let exponent = &bytes[digits..];
    // `E` alone is the packed digit 5. Only a sign makes it an exponent.
    if let [b'E' | b'e', b'+' | b'-', digit, ..] = exponent
        && digit.is_ascii_digit()
    {
        let more = exponent[2..].iter().take_while(|b| b.is_ascii_digit()).count();
        return digits + 2 + more;
    }
    digits
}

enum Kind {
    Value,
    Difference,
    Times,
}

/// Decodes the first character of a number: its kind and, if packed, its first digit with its
/// sign.
fn packed(first: char) -> (Kind, Option<String>) {
    match first {
        '@' => (Kind::Value, digit("", 0)),
        'A'..='I' => (Kind::Value, digit("", 1 + letters_after(first, 'A'))),
        'a'..='i' => (Kind::Value, digit("-", 1 + letters_after(first, 'a'))),
        '%' => (Kind::Difference, digit("", 0)),
        'J'..='R' => (Kind::Difference, digit("", 1 + letters_after(first, 'J'))),
        'j'..='r' => (Kind::Difference, digit("-", 1 + letters_after(first, 'j'))),
        'S'..='Z' => (Kind::Times, digit("", 1 + letters_after(first, 'S'))),
        's' => (Kind::Times, digit("", 9)),
        _ => (Kind::Value, None),
    }
}

fn digit(sign: &str, digit: u32) -> Option<String> {
    Some(format!("{sign}{digit}"))
}

fn letters_after(first: char, zero: char) -> u32 {
    (first as u32).wrapping_sub(zero as u32)
}

pub(super) struct Page {
    /// The value of the page variable, e.g. `N=1`.
    pub(super) name: String,
    pub(super) variable: String,
    pub(super) units: String,
    pub(super) x_units: String,
    pub(super) line: usize,
    /// Points with the independent variable, in its own unit, in the field `nm`.
    pub(super) points: Vec<Point>,
}

/// The pages of a block with the labelled records `fields`.
pub(super) fn pages(file: &str, fields: &[Field<'_>]) -> Result<Vec<Page>, InstrumentError> {
    let lists = Lists { file, fields };
    let symbols = lists.list("SYMBOL");
    let mut name = String::new();
    let mut found = Vec::new();
    for field in fields {
        let (line, value) = field.lines[0];
        if field.label == "PAGE" {
            value.clone_into(&mut name);
        } else if field.label == "DATATABLE" {
            let form: String = value.chars().filter(|c| !c.is_whitespace()).collect();
            let end = form.rfind(')').map_or(0, |end| end + 1);
            let form = form[..end].to_ascii_uppercase();
            let variables = variables(&symbols, &form);
            let Some((x, y, is_run)) = variables else {
                let expected = "(X++(Y..Y)) or (XY..XY) of variables that ##SYMBOL= names";
                return Err(InstrumentError::line(file, line, expected, value));
            };
            let scaling = Scaling {
                x: lists.number("FACTOR", x)?.unwrap_or(1.0),
                y: lists.number("FACTOR", y)?.unwrap_or(1.0),
                first_x: lists.number("FIRST", x)?,
                last_x: lists.number("LAST", x)?,
                count: lists.number("VARDIM", x)?,
                stated_step: None,
            };
            let lines = &field.lines[1..];
            let points =
                if is_run { runs(file, lines, &scaling)? } else { points(file, lines, &scaling)? };
            let count = points.len();
            if let Some(expected) = scaling.count.filter(|stated| *stated != count as f64) {
                let line = field.lines[field.lines.len() - 1].0;
                let what = "points (VAR_DIM)";
                let expected = expected.max(0.0) as usize;
                let file = file.to_owned();
                return Err(InstrumentError::Count { file, line, what, expected, found: count });
            }
            let text = |label: &str, place: usize| {
                lists.list(label).get(place).map_or_else(String::new, |text| (*text).to_owned())
            };
            found.push(Page {
                name: name.clone(),
                variable: text("VARNAME", y),
                units: text("UNITS", y),
                x_units: [text("UNITS", x), text("VARNAME", x)]
                    .into_iter()
                    .find(|text| !text.is_empty())
                    .unwrap_or_default(),
                line,
                points,
            });
        }
    }
    found.retain(|page: &Page| !page.points.is_empty());
    Ok(found)
}

/// Indices in `symbols` of the two variables of a form such as `(X++(R..R))` or `(XY..XY)`, and whether the
/// file gives the first one only once for each row.
fn variables(symbols: &[&str], form: &str) -> Option<(usize, usize, bool)> {
    let pairs = (0..symbols.len()).flat_map(|x| (0..symbols.len()).map(move |y| (x, y)));
    pairs.filter(|(x, y)| !symbols[*x].is_empty() && !symbols[*y].is_empty()).find_map(|(x, y)| {
        let is_run = form_of(symbols, "(X++(Y..Y))".to_owned(), x, y) == form;
        let is_pairs = form_of(symbols, "(XY..XY)".to_owned(), x, y) == form;
        (x != y && (is_run || is_pairs)).then_some((x, y, is_run))
    })
}

fn form_of(symbols: &[&str], form: String, x: usize, y: usize) -> String {
    let x = symbols[x].to_ascii_uppercase();
    let y = symbols[y].to_ascii_uppercase();
    form.replace('X', "\0").replace('Y', &y).replace('\0', &x)
}

/// The lists that describe the variables.
struct Lists<'a> {
    file: &'a str,
    fields: &'a [Field<'a>],
}

impl<'a> Lists<'a> {
    fn field(&self, label: &str) -> Option<(usize, &'a str)> {
        self.fields.iter().find(|field| field.label == label)?.lines.first().copied()
    }

    fn list(&self, label: &str) -> Vec<&'a str> {
        let (_, text) = self.field(label).unwrap_or((1, ""));
        text.split(',').map(str::trim).collect()
    }

    fn number(&self, label: &str, place: usize) -> Result<Option<f64>, InstrumentError> {
        let text = self.list(label).get(place).copied().unwrap_or_default();
        if text.is_empty() {
            return Ok(None);
        }
        let line = self.field(label).map_or(1, |(line, _)| line);
        required_number(self.file, line, "a number", text, Decimal::Point).map(Some)
    }
}
