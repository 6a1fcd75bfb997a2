//! Names and other texts from files of strangers: the limits of a name, and how such texts are shown
//! on a terminal, in columns and in a spreadsheet, so that they can do no harm there.

use std::borrow::Cow;

/// A name has at most this many letters. Sample, pigment, column, brush: anything that a file or an
/// option names.
pub const LONGEST_NAME: usize = 200;

/// A terminal shows at most this many letters of one text: half a screen. Lists of a hundred names
/// are shorter.
const LONGEST_SHOWN: usize = 4000;

/// Letters of a cut text that are shown from its end, where messages often say what was expected.
const SHOWN_OF_END: usize = 400;

/// Whether a terminal or a page obeys `c` instead of showing it: control characters (C0 and C1),
/// marks of the direction of writing such as U+202E, and characters without width. The two joiners
/// without width (U+200C, U+200D), which Persian and many emoji need, are letters here.
#[must_use]
pub fn is_hidden(c: char) -> bool {
    c.is_control()
        || matches!(
            c,
            '\u{61c}'
                | '\u{180e}'
                | '\u{200b}'
                | '\u{200e}'
                | '\u{200f}'
                | '\u{2028}'..='\u{202e}'
                | '\u{2060}'..='\u{206f}'
                | '\u{feff}'
                | '\u{fff9}'..='\u{fffb}'
                | '\u{e0000}'..='\u{e007f}'
        )
}

/// Returns `None` if something may have this name, else a description of the names allowed. An error
/// can say `expected {}` with it.
///
/// ```
/// use documents::name_violation;
///
/// assert_eq!(name_violation("Zinc White"), None);
/// assert_eq!(name_violation(" "), Some("a name that is not empty"));
/// assert_eq!(name_violation(&"a".repeat(201)), Some("a name of at most 200 letters"));
/// assert_eq!(name_violation("\u{1b}[2J"), Some("a name without control characters"));
/// ```
#[must_use]
pub fn name_violation(name: &str) -> Option<&'static str> {
    if name.contains(is_hidden) {
        return Some("a name without control characters");
    }
    if name.trim().is_empty() {
        return Some("a name that is not empty");
    }
    (name.chars().nth(LONGEST_NAME).is_some()).then_some("a name of at most 200 letters")
}

/// A name with a blank in place of each character that is not shown, without blanks at its ends. Use this
/// where a foreign program wrote the name and you cannot ask anybody to correct it.
///
/// ```
/// assert_eq!(documents::plain_name("Red\u{202e}dark\n"), "Red dark");
/// ```
#[must_use]
pub fn plain_name(name: &str) -> String {
    name.replace(is_hidden, " ").trim().to_owned()
}

/// `text` on one line, as a terminal can show it: characters that it would obey are escaped, and a text of more than
/// 4,000 letters is cut in its middle.
///
/// ```
/// use documents::printable;
///
/// assert_eq!(printable("Zinc White"), "Zinc White");
/// assert_eq!(printable("a\u{1b}[2J\u{202e}b"), "a\\u{1b}[2J\\u{202e}b");
/// let long = printable(&"x".repeat(15_000_000)).into_owned();
/// assert!(long.len() < 5000 && long.contains("xx [14996000 letters more] xx"), "{long}");
/// ```
#[must_use]
pub fn printable(text: &str) -> Cow<'_, str> {
    // Most texts are short, so that bytes tell enough.
    let shown = match text.len() > LONGEST_SHOWN {
        true => cut(text, LONGEST_SHOWN, SHOWN_OF_END),
        false => Cow::Borrowed(text),
    };
    if !shown.contains(is_hidden) {
        return shown;
    }
    let mut escaped = String::with_capacity(shown.len() + 16);
    for c in shown.chars() {
        match is_hidden(c) {
            true => escaped.extend(c.escape_unicode()),
            false => escaped.push(c),
        }
    }
    Cow::Owned(escaped)
}

/// `text` with `most` letters, of which `end` are its last ones, and a note on how many it lacks.
fn cut(text: &str, most: usize, end: usize) -> Cow<'_, str> {
    let letters = text.chars().count();
    if letters <= most {
        return Cow::Borrowed(text);
    }
    let [start, rest] = [most - end, letters - end]
        .map(|letter| text.char_indices().nth(letter).map_or(text.len(), |(at, _)| at));
    let [start, rest] = [&text[..start], &text[rest..]];
    Cow::Owned(format!("{start} [{} letters more] {rest}", letters - most))
}

/// The message of an error of another crate, in one line. Such messages may quote a damaged file at any length, so
/// we cut them to 300 letters.
///
/// ```
/// use documents::foreign_message;
///
/// assert_eq!(foreign_message(&"no such\ntag"), "no such tag");
/// let long = foreign_message(&"9, ".repeat(13_000));
/// assert!(long.len() < 340 && long.contains(" letters more] "), "{long}");
/// ```
#[must_use]
pub fn foreign_message(error: &impl std::fmt::Display) -> String {
    const LONGEST: usize = 300;
    cut(&plain_name(&error.to_string()), LONGEST, 60).into_owned()
}

/// The start of a cell or a line that an error quotes: at most 60 letters, without line breaks and blanks at its
/// ends.
///
/// ```
/// use documents::excerpt;
///
/// assert_eq!(excerpt(" 12\tmm "), "12 mm");
/// assert_eq!(excerpt(&"9".repeat(1000)), "9".repeat(60) + " ..");
/// ```
#[must_use]
pub fn excerpt(text: &str) -> String {
    const LONGEST: usize = 60;
    let mut letters = text.trim().chars();
    let short: String = letters.by_ref().take(LONGEST).collect();
    let short = short.replace(is_hidden, " ");
    if letters.next().is_some() { short + " .." } else { short }
}

/// Width of a column for `cells` below a heading of `least` letters. Longer cells than 200 letters do
/// not widen it, because a format takes no width above 65,535.
///
/// ```
/// let long = "a".repeat(100_000);
/// assert_eq!(documents::column_width(["Red", "Umber"], 4), 5);
/// assert_eq!(documents::column_width([long.as_str()], 4), 200);
/// ```
#[must_use]
pub fn column_width<S: AsRef<str>>(cells: impl IntoIterator<Item = S>, least: usize) -> usize {
    let widths = cells.into_iter().map(|cell| cell.as_ref().chars().take(LONGEST_NAME).count());
    widths.max().unwrap_or(0).max(least)
}

/// Whether spreadsheets take `text` for a formula: it begins with `=`, `+`, `-` or `@`, or a tab or a line break,
/// which they skip, and is not a number.
fn is_formula(text: &str) -> bool {
    let mut letters = text.chars();
    let begins = letters.next().is_some_and(|first| "=+-@\t\r\n".contains(first));
    begins && letters.next().is_some() && text.parse::<f64>().is_err()
}

/// `text` as a cell of a CSV file that you may open in a spreadsheet. If the spreadsheet would take it for a
/// formula, a `'` stands before it, as you would type it there. [`from_spreadsheet_cell`] takes it away.
///
/// ```
/// use documents::{from_spreadsheet_cell, spreadsheet_cell};
///
/// assert_eq!(spreadsheet_cell("=HYPERLINK(A1)"), "'=HYPERLINK(A1)");
/// assert_eq!(from_spreadsheet_cell("'=HYPERLINK(A1)"), "=HYPERLINK(A1)");
/// for plain in ["Zinc White", "-1.5", "+3", "-", "'t Hooft", ""] {
///     assert_eq!((&*spreadsheet_cell(plain), from_spreadsheet_cell(plain)), (plain, plain));
/// }
/// ```
#[must_use]
pub fn spreadsheet_cell(text: &str) -> Cow<'_, str> {
    match is_formula(text.trim_start_matches('\'')) {
        true => Cow::Owned(format!("'{text}")),
        false => Cow::Borrowed(text),
    }
}

/// The text that [`spreadsheet_cell`] wrote as `cell`.
#[must_use]
pub fn from_spreadsheet_cell(cell: &str) -> &str {
    let quoted = cell.strip_prefix('\'');
    quoted.filter(|text| is_formula(text.trim_start_matches('\''))).unwrap_or(cell)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn terminals_get_no_character_that_they_obey() {
        for hidden in ["\u{7}", "\u{7f}", "\u{9b}", "\u{202e}", "\u{2066}", "\u{200b}", "\u{feff}"]
        {
            let text = format!("a{hidden}b\nerror: {hidden}");
            let shown = printable(&text);
            assert!(!shown.contains(hidden) && !shown.contains('\n'), "{shown:?}");
            assert!(name_violation(&text).is_some() && !plain_name(&text).contains(is_hidden));
        }
        for kept in ["Gr\u{fc}nspan", "\u{645}\u{6cc}\u{200c}\u{62e}", "\u{1f469}\u{200d}\u{1f3a8}"]
        {
            assert_eq!((&*printable(kept), name_violation(kept)), (kept, None));
        }
    }

    #[test]
    fn a_long_text_keeps_its_start_and_its_end() {
        let text = format!("a.csv, row 3: expected a number, found `{}`", "\u{fc}".repeat(9000));
        let shown = printable(&text);
        assert!(shown.starts_with("a.csv, row 3: expected a number"), "{shown}");
        assert!(shown.ends_with("\u{fc}`") && shown.chars().count() < 4100, "{shown}");
        let longest = "\u{fc}".repeat(LONGEST_SHOWN);
        assert_eq!(printable(&longest), longest);
    }

    #[test]
    fn cells_for_spreadsheets_are_read_back_as_they_were() {
        for text in ["=1+1", "@x", "+x", "-x", "'=1", "''=1", "\t=1", "-1e3", "'", "=", "--1"] {
            let cell = spreadsheet_cell(text);
            assert!(!is_formula(&cell), "{cell}");
            assert_eq!(from_spreadsheet_cell(&cell), text);
        }
    }
}
