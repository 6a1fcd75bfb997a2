//! Words of messages: names with a similar spelling, numbers with their nouns, and lists of names.
//! This also rewrites messages of parsers of TOML and JSON, so that they speak of the file and not
//! of the program.

use std::fmt::{self, Display};

/// A suggestion holds at most this many names.
const MOST: usize = 3;

/// A single word of a name is compared from this many letters.
const SHORTEST_WORD: usize = 4;

/// Up to three of `known` that are spelt like `name`, the most similar first. A single word is also compared
/// with each word of the names.
///
/// ```
/// use documents::similar_names;
/// assert_eq!(similar_names("viridan", ["Viridian", "Zinc White"]), ["Viridian"]);
/// assert_eq!(similar_names("umbr", ["Raw Umber", "Zinc White"]), ["Raw Umber"]);
/// ```
#[must_use]
pub fn similar_names<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Vec<&'a str> {
    let name: Vec<char> = name.to_lowercase().chars().take(100).collect();
    let is_word = name.len() >= SHORTEST_WORD && !name.contains(&' ');
    let mut ranked: Vec<_> = known
        .into_iter()
        .filter_map(|other| {
            let lower = other.to_lowercase();
            // The whole name first, then its words.
            let whole = edits(&name, &lower).map(|edits| (edits, false));
            let words = lower.split_whitespace().filter(|word| word.len() >= SHORTEST_WORD);
            let words = words.filter_map(|word| edits(&name, word).map(|edits| (edits, true)));
            let nearest = whole.into_iter().chain(words.filter(|_| is_word)).min();
            nearest.map(|rank| (rank, other))
        })
        .collect();
    ranked.sort_unstable();
    ranked.into_iter().take(MOST).map(|(_, other)| other).collect()
}

/// Edit distance between two names, if they are spelt alike: one edit in three letters, or one at all.
fn edits(name: &[char], other: &str) -> Option<usize> {
    let letters: Vec<char> = other.chars().collect();
    let edits = edit_distance(name, &letters);
    (edits <= (name.len().max(letters.len()) / 3).max(1)).then_some(edits)
}

/// The question "did you mean A or B?" with the names of `known` that are spelt like `name`. If
/// there are none, this is `None`.
///
/// ```
/// use documents::did_you_mean;
/// let question = did_you_mean("Zink White", ["Viridian", "Zinc White"]);
/// assert_eq!(question.as_deref(), Some("did you mean Zinc White?"));
/// ```
#[must_use]
pub fn did_you_mean<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Option<String> {
    let similar = similar_names(name, known);
    (!similar.is_empty()).then(|| format!("did you mean {}?", similar.join(" or ")))
}

/// The question of [`did_you_mean`] with a space behind it, or an empty text. Write it before a list
/// of all names.
///
/// ```
/// let known = ["Viridian".to_owned(), "Zinc White".to_owned()];
/// let hint = documents::question("Viridan", &known) + "pigments: " + &known.join(", ");
/// assert_eq!(hint, "did you mean Viridian? pigments: Viridian, Zinc White");
/// assert_eq!(documents::question("Umber", &known), "");
/// ```
#[must_use]
pub fn question<S: AsRef<str>>(name: &str, known: &[S]) -> String {
    did_you_mean(name, known.iter().map(AsRef::as_ref))
        .map_or_else(String::new, |question| question + " ")
}

/// Edit distance between `a` and `b` (Levenshtein 1966): insertions, deletions and
/// substitutions of letters.
fn edit_distance(a: &[char], b: &[char]) -> usize {
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, left) in a.iter().enumerate() {
        let mut diagonal = std::mem::replace(&mut row[0], i + 1);
        for (j, right) in b.iter().enumerate() {
            let substituted = diagonal + usize::from(left != right);
            diagonal = row[j + 1];
            row[j + 1] = substituted.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row[b.len()]
}

/// A number with its noun, in the plural unless it is one: `1 pigment`, `3 pigments`.
///
/// ```
/// use documents::counted;
/// assert_eq!([counted(1, "pigment"), counted(0, "pigment")], ["1 pigment", "0 pigments"]);
/// ```
#[must_use]
pub fn counted<N: Display + PartialEq + From<u8>>(number: N, noun: &str) -> String {
    counted_as(number, noun, &format!("{noun}s"))
}

/// A number with a noun that has the plural `many`.
///
/// ```
/// assert_eq!(documents::counted_as(2, "swatch", "swatches"), "2 swatches");
/// ```
#[must_use]
pub fn counted_as<N: Display + PartialEq + From<u8>>(number: N, one: &str, many: &str) -> String {
    let noun = if number == N::from(1) { one } else { many };
    format!("{number} {noun}")
}

/// The first `most` of `names`, and how many more there are: `a, b and 3 more`.
///
/// ```
/// use documents::name_list;
///
/// assert_eq!(name_list(&["a", "b", "c"], 2, ", "), "a, b and 1 more");
/// assert_eq!(name_list(&["a", "b"], 2, " or "), "a or b");
/// ```
#[must_use]
pub fn name_list<S: AsRef<str>>(names: &[S], most: usize, separator: &str) -> String {
    let shown: Vec<&str> = names.iter().take(most).map(AsRef::as_ref).collect();
    let shown = shown.join(separator);
    match names.len().saturating_sub(most) {
        0 => shown,
        more => format!("{shown} and {more} more"),
    }
}

/// A hint lists at most this many known keys.
const MOST_KEYS: usize = 30;

/// Names of types and our words for them. If one name begins another, the longer comes first.
const TYPES: [(&str, &str); 16] = [
    ("a sequence", "a list"),
    ("a map", "a table"),
    ("a boolean", "true or false"),
    ("a string", "a text"),
    ("usize", "a whole number, 0 or more"),
    ("u64", "a whole number, 0 or more"),
    ("u32", "a whole number, 0 or more"),
    ("u16", "a whole number, 0 or more"),
    ("u8", "a whole number, 0 or more"),
    ("isize", "a whole number"),
    ("i64", "a whole number"),
    ("i32", "a whole number"),
    ("i16", "a whole number"),
    ("i8", "a whole number"),
    ("f64", "a number"),
    ("f32", "a number"),
];

/// Reason and remedy that the error of a parser gives.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ParserReason {
    /// The reason on one line, without names of types.
    pub reason: String,
    /// The remedy, if the message gives one.
    pub hint: Option<String>,
}

impl ParserReason {
    /// The reason that the `message` of a parser (serde, TOML or JSON) gives.
    ///
    /// ```
    /// use documents::ParserReason;
    /// let message = "unknown field `strenght`, expected one of `strength`, `reach`";
    /// let told = ParserReason::of(message);
    /// assert_eq!(told.reason, "unknown key `strenght`");
    /// assert_eq!(told.hint.as_deref(), Some("did you mean strength?"));
    /// ```
    #[must_use]
    pub fn of(message: &str) -> Self {
        let message = message.split_whitespace().collect::<Vec<_>>().join(" ");
        let quoted: Vec<&str> = message.split('`').skip(1).step_by(2).collect();
        for (begins, kind) in [("unknown field", "key"), ("unknown variant", "word")] {
            let [name, known @ ..] = &quoted[..] else { continue };
            if message.starts_with(begins) {
                let similar = did_you_mean(name, known.iter().copied());
                let hint = similar.or_else(|| {
                    (!known.is_empty()).then(|| {
                        format!("it takes the {kind}s {}", name_list(known, MOST_KEYS, ", "))
                    })
                });
                return Self { reason: format!("unknown {kind} `{name}`"), hint };
            }
        }
        if let Some(key) = message.strip_prefix("missing field ") {
            let hint = Some(format!("add a line {key} = ..."));
            return Self { reason: format!("the key {key} is missing"), hint };
        }
        Self { reason: plain_parser_message(&message), hint: None }
    }
}

impl Display for ParserReason {
    /// Writes the reason, then the remedy after a semicolon.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.hint {
            Some(hint) => write!(f, "{}; {hint}", self.reason),
            None => f.write_str(&self.reason),
        }
    }
}

/// The message of a parser without names of types. This leaves keys and places as they are.
///
/// ```
/// let message = "invalid type: integer `3`, expected struct Surface at line 2 column 9";
/// let plain = "invalid type: number `3`, expected a table of keys at line 2 column 9";
/// assert_eq!(documents::plain_parser_message(message), plain);
/// ```
#[must_use]
pub fn plain_parser_message(message: &str) -> String {
    let Some((before, wanted)) = message.split_once("expected ") else { return message.to_owned() };
    let wanted = match type_and_rest(wanted) {
        Some((word, rest)) => format!("{word}{rest}"),
        None => wanted.to_owned(),
    };
    // `before` describes what was found by the same names.
    let mut before = before.to_owned();
    for (from, to) in [
        ("floating point ", "number "),
        ("integer ", "number "),
        ("boolean ", ""),
        ("string ", "text "),
        ("sequence", "a list"),
        ("map", "a table"),
    ] {
        before = before.replace(&format!("invalid type: {from}"), &format!("invalid type: {to}"));
        before = before.replace(&format!("invalid value: {from}"), &format!("invalid value: {to}"));
    }
    format!("{before}expected {wanted}")
}

/// The words for a type at the start of `wanted`, and the text after it.
fn type_and_rest(wanted: &str) -> Option<(&str, &str)> {
    for named in ["struct ", "enum ", "tuple struct ", "unit struct ", "variant "] {
        if let Some(rest) = wanted.strip_prefix(named) {
            let end = rest.find([' ', ',']).unwrap_or(rest.len());
            let word = if named == "struct " { "a table of keys" } else { "one of its words" };
            return Some((word, &rest[end..]));
        }
    }
    TYPES.into_iter().find_map(|(name, word)| Some((word, wanted.strip_prefix(name)?)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_misspelt_pigment_finds_its_name() {
        let known = ["Zinc White", "Prussian Blue", "Viridian", "Cobalt Blue"];
        assert_eq!(similar_names("prusian blue", known), ["Prussian Blue"]);
        assert_eq!(similar_names("Viridan", known), ["Viridian"]);
        assert!(similar_names("Octarine", known).is_empty(), "no similar name");
        let series = ["FL3.1", "FL3.2", "FL3.3", "FL3.4", "FL3"];
        assert_eq!(similar_names("fl3.4", series), ["FL3.4", "FL3.1", "FL3.2"], "three at most");
        assert_eq!(edit_distance(&['a', 'b'], &['b', 'a', 'c']), 2);
    }

    #[test]
    fn types_are_told_in_words_of_the_file() {
        for (message, reason) in [
            (
                "invalid type: integer `3`, expected struct EdgeSettings",
                "invalid type: number `3`, expected a table of keys",
            ),
            (
                "invalid type: string \"much\", expected f64",
                "invalid type: text \"much\", expected a number",
            ),
            (
                "invalid type: string \"a\", expected a sequence at line 3",
                "invalid type: text \"a\", expected a list at line 3",
            ),
            (
                "invalid value: integer `-3`, expected u32",
                "invalid value: number `-3`, expected a whole number, 0 or more",
            ),
            (
                "invalid type: string \"on\", expected enum Paper",
                "invalid type: text \"on\", expected one of its words",
            ),
            ("expected\nnewline", "expected newline"),
        ] {
            assert_eq!(
                ParserReason::of(message),
                ParserReason { reason: reason.to_owned(), hint: None }
            );
        }
    }

    #[test]
    fn unknown_and_missing_keys_have_a_way_out() {
        let parsed = ParserReason::of("unknown field `wide`, expected `a` or `b`");
        assert_eq!(parsed.hint.as_deref(), Some("it takes the keys a, b"));
        let parsed = ParserReason::of("unknown variant `rogh`, expected one of `rough`, `smooth`");
        assert_eq!(parsed.reason, "unknown word `rogh`");
        assert_eq!(parsed.hint.as_deref(), Some("did you mean rough?"));
        assert_eq!(parsed.to_string(), "unknown word `rogh`; did you mean rough?");
        let parsed = ParserReason::of("missing field `k`");
        assert_eq!(parsed.to_string(), "the key `k` is missing; add a line `k` = ...");
        assert_eq!(ParserReason::of("expected a newline").to_string(), "expected a newline");
    }
}
