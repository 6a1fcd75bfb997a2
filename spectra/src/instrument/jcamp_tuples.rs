//! The pages of JCAMP-DX NTUPLES: tables whose variables are described in lists.
//!
//! Lampen, Hillig, Davies and Linscheid, "JCAMP-DX for mass spectrometry", Applied Spectroscopy 48
//! (1994) 1545. `##SYMBOL=` names the variables; `##FACTOR=`, `##FIRST=`, `##LAST=`, `##VAR_DIM=` and
//! `##UNITS=` describe each in its place; each `##PAGE=` has a `##DATA TABLE=` of two of them.

use super::error::InstrumentError;
use super::jcamp_data::{Field, Scaling, points, runs};
use super::number::{Decimal, required_number};
use super::points::Point;

/// One page of a file.
pub(super) struct Page {
    /// The value of the page variable, such as `N=1`.
    pub(super) name: String,
    /// Name of the dependent variable.
    pub(super) variable: String,
    /// Unit of the dependent variable.
    pub(super) units: String,
    /// Unit of the independent variable.
    pub(super) x_units: String,
    /// Line on which the table begins.
    pub(super) line: usize,
    /// Points whose `nm` is the independent variable in its unit.
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

/// Places of the two variables that a form such as `(X++(R..R))` or `(XY..XY)` names, and whether
/// the first is given once for each row only.
fn variables(symbols: &[&str], form: &str) -> Option<(usize, usize, bool)> {
    let pairs = (0..symbols.len()).flat_map(|x| (0..symbols.len()).map(move |y| (x, y)));
    let of = |form: String, x: usize, y: usize| {
        let upper = |place: usize| symbols[place].to_ascii_uppercase();
        form.replace('X', "\0").replace('Y', &upper(y)).replace('\0', &upper(x))
    };
    let named = |&(x, y): &(usize, usize)| {
        let is_run = of("(X++(Y..Y))".to_owned(), x, y) == form;
        let is_pairs = of("(XY..XY)".to_owned(), x, y) == form;
        (x != y && (is_run || is_pairs)).then_some((x, y, is_run))
    };
    pairs
        .filter(|(x, y)| !symbols[*x].is_empty() && !symbols[*y].is_empty())
        .find_map(|pair| named(&pair))
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
