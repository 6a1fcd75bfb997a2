//! Counts what makes a code base easy or hard to read. For example, we count small files, closures
//! with a name, tuples that are taken apart at once, and words of comments that slow a reader down.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

use crate::files::folder_of;

const SMALL: usize = 60;

/// Doc comments that begin so are hard to read alone.
const RIDDLES: [&str; 3] = ["What ", "The same", "As "];

/// Something that we count, with a list of the places where it occurs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Mark {
    /// Folders with more than 20 sources.
    FullFolders,
    /// Files of declarations only, in folders with fewer than four other sources.
    DeclarationFiles,
    /// Files below 60 lines.
    SmallFiles,
    /// Types with inherent `impl`s in more than three files.
    SpreadTypes,
    /// `let name = |..| ..`.
    NamedClosures,
    /// `let (a, b) = (x, y);`.
    PackedLets,
    /// "that of", "those of" in comments.
    ThatOf,
    /// "whose" in comments.
    Whose,
    /// Semicolons in comments, except in examples.
    Semicolons,
    /// "you", "your", "we", "our" and "this" in comments.
    YouWeThis,
    /// "for example", "e.g." in comments.
    ForExample,
    /// Doc comments that begin with "What", "The same" or "As".
    Riddles,
    /// Doc comments of one or two words.
    ShortDocs,
}

impl Mark {
    /// All marks, in the order of the enum.
    pub const ALL: [Self; 13] = [
        Self::FullFolders,
        Self::DeclarationFiles,
        Self::SmallFiles,
        Self::SpreadTypes,
        Self::NamedClosures,
        Self::PackedLets,
        Self::ThatOf,
        Self::Whose,
        Self::Semicolons,
        Self::YouWeThis,
        Self::ForExample,
        Self::Riddles,
        Self::ShortDocs,
    ];
}

/// The name that you pass to `cargo xtask figures --list` to see the places.
impl fmt::Display for Mark {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::FullFolders => "full-folders",
            Self::DeclarationFiles => "declaration-files",
            Self::SmallFiles => "small-files",
            Self::SpreadTypes => "spread-types",
            Self::NamedClosures => "named-closures",
            Self::PackedLets => "packed-lets",
            Self::ThatOf => "that-of",
            Self::Whose => "whose",
            Self::Semicolons => "semicolons",
            Self::YouWeThis => "you-we-this",
            Self::ForExample => "for-example",
            Self::Riddles => "riddles",
            Self::ShortDocs => "short-docs",
        })
    }
}

/// The counts over a set of files.
#[derive(Debug, Clone, Default)]
pub struct Figures {
    /// Number of Rust files.
    pub files: usize,
    /// Lines of Rust.
    pub lines: usize,
    /// Lines of Rust that are neither blank nor a comment. Tests count too.
    pub code: usize,
    /// Lines that begin with `use`.
    pub uses: usize,
    /// Words of comments without their examples.
    pub words: usize,
    /// Lines of the longest file, shaders included.
    pub longest: usize,
    /// Path of the longest file.
    pub longest_path: String,
    /// Places of each mark. A line with two of them stands here twice.
    pub places: BTreeMap<Mark, Vec<String>>,
}

impl Figures {
    /// Counts in `texts`, Rust files and shaders by their paths.
    #[must_use]
    pub fn of(texts: &BTreeMap<String, String>) -> Self {
        let mut figures = Self::default();
        let mut sources_in: BTreeMap<&str, usize> = BTreeMap::new();
        for (path, text) in texts {
            *sources_in.entry(folder_of(path)).or_default() += 1;
            let lines = text.lines().count();
            if lines > figures.longest {
                figures.longest = lines;
                figures.longest_path.clone_from(path);
            }
        }
        for (folder, count) in sources_in.iter().filter(|(_, count)| **count > 20) {
            figures.note(Mark::FullFolders, format!("{folder}: {count} files"));
        }
        let rust = texts.iter().filter(|(path, _)| path.ends_with(".rs"));
        for (path, text) in rust.clone() {
            figures.count(path, text);
            let name = path.rsplit('/').next().unwrap_or_default();
            let others = sources_in[folder_of(path)] - 1;
            if !["lib.rs", "main.rs"].contains(&name) && others < 4 && declares_only(text) {
                figures.note(Mark::DeclarationFiles, path.clone());
            }
        }
        for (name, files) in spread_types(rust) {
            figures.note(Mark::SpreadTypes, format!("{name}: {}", files.join(", ")));
        }
        figures
    }

    /// How often we found `mark`.
    #[must_use]
    pub fn count_of(&self, mark: Mark) -> usize {
        self.places.get(&mark).map_or(0, Vec::len)
    }

    /// How often we found `mark` in 1,000 lines of code.
    #[must_use]
    pub fn per_code(&self, mark: Mark) -> f64 {
        per_thousand(self.count_of(mark), self.code)
    }

    /// How often we found `mark` in 1,000 words of comments.
    #[must_use]
    pub fn per_words(&self, mark: Mark) -> f64 {
        per_thousand(self.count_of(mark), self.words)
    }

    /// Files per 1,000 lines of code.
    #[must_use]
    pub fn files_per_code(&self) -> f64 {
        per_thousand(self.files, self.code)
    }

    fn note(&mut self, mark: Mark, place: String) {
        self.places.entry(mark).or_default().push(place);
    }

    fn count(&mut self, path: &str, text: &str) {
        self.files += 1;
        let mut code = String::new();
        let mut lines = 0;
        // Examples inside comments are code, not words.
        let mut is_example = false;
        for (line, number) in text.lines().map(str::trim).zip(1..) {
            lines = number;
            if line.starts_with("//") {
                let words = line.trim_start_matches(['/', '!']);
                if words.trim_start().starts_with("```") {
                    is_example = !is_example;
                } else if !is_example {
                    self.count_words(words, &format!("{path}:{number}"));
                }
            } else if !line.is_empty() {
                self.code += 1;
                let rest = line.strip_prefix("pub").unwrap_or(line);
                let rest = rest.strip_prefix('(').and_then(|rest| rest.split_once(')'));
                let rest = rest.map_or(line.strip_prefix("pub ").unwrap_or(line), |(_, rest)| rest);
                self.uses += usize::from(rest.trim_start().starts_with("use "));
                code.push_str(line);
            }
            code.push('\n');
        }
        self.lines += lines;
        if lines < SMALL {
            self.note(Mark::SmallFiles, format!("{path}: {lines} lines"));
        }
        for (mark, at) in lets(&code) {
            let number = code[..at].matches('\n').count() + 1;
            let line = code[at..].lines().next().unwrap_or_default();
            self.note(mark, format!("{path}:{number}: {line}"));
        }
        if path.contains("src/") && !path.starts_with("tests/") {
            for (number, comment) in doc_comments(text) {
                let riddle = RIDDLES.iter().any(|opener| comment.starts_with(opener));
                if riddle {
                    self.note(Mark::Riddles, format!("{path}:{number}: {comment}"));
                }
                if comment.split_whitespace().count() <= 2 {
                    self.note(Mark::ShortDocs, format!("{path}:{number}: {comment}"));
                }
            }
        }
    }

    fn count_words(&mut self, line: &str, place: &str) {
        let lower = line.to_lowercase();
        let words: Vec<&str> = words(&lower).collect();
        self.words += words.len();
        let mut marks = vec![Mark::Semicolons; line.matches(';').count()];
        marks.extend(vec![Mark::ForExample; lower.matches("e.g.").count()]);
        for pair in words.windows(2) {
            match pair {
                ["that" | "those", "of"] => marks.push(Mark::ThatOf),
                ["for", "example"] => marks.push(Mark::ForExample),
                _ => {}
            }
        }
        for word in words {
            match word {
                "whose" => marks.push(Mark::Whose),
                "you" | "your" | "we" | "our" | "this" => marks.push(Mark::YouWeThis),
                _ => {}
            }
        }
        for mark in marks {
            self.note(mark, format!("{place}: {}", line.trim()));
        }
    }
}

#[expect(clippy::cast_precision_loss, reason = "counts of lines are far below 2^52")]
fn per_thousand(count: usize, of: usize) -> f64 {
    1000.0 * count as f64 / of.max(1) as f64
}

/// The words of `text`, letters with apostrophes and hyphens inside.
fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split(|c: char| !(c.is_ascii_alphabetic() || c == '\'' || c == '-'))
        .map(|word| word.trim_matches(['\'', '-']))
        .filter(|word| !word.is_empty())
}

/// Doc comments of a source, each joined to one line, with the number of its first line.
#[must_use]
pub fn doc_comments(source: &str) -> Vec<(usize, String)> {
    let mut found: Vec<(usize, String)> = Vec::new();
    let mut before = None;
    for (line, number) in source.lines().map(str::trim).zip(1..) {
        let kind = line.get(..3).filter(|kind| ["///", "//!"].contains(kind));
        let Some(kind) = kind.filter(|_| !line.starts_with("////")) else {
            before = None;
            continue;
        };
        let words = line[3..].trim();
        match found.last_mut().filter(|_| before == Some(kind)) {
            Some((_, text)) => *text = format!("{text} {words}").trim().to_owned(),
            None => found.push((number, words.to_owned())),
        }
        before = Some(kind);
    }
    found
}

/// Finds named closures and packed lets. Pass code without comments.
fn lets(code: &str) -> Vec<(Mark, usize)> {
    let mut found = Vec::new();
    for (at, _) in code.match_indices("let ") {
        let inside = code[..at].chars().next_back();
        if inside.is_some_and(|c| c.is_alphanumeric() || c == '_') {
            continue;
        }
        let Some((pattern, value)) = code[at + 4..].split_once('=') else { continue };
        let pattern = pattern.trim();
        let value = value.trim_start();
        if pattern.contains([';', '|']) || value.starts_with('=') {
            continue;
        }
        let name = pattern.split(':').next().unwrap_or_default().trim();
        let name = name.strip_prefix("mut ").unwrap_or(name);
        let is_name = name.chars().all(|c| c.is_alphanumeric() || c == '_');
        let body = value.strip_prefix("move").map_or(value, str::trim_start);
        if is_name && body.starts_with('|') {
            found.push((Mark::NamedClosures, at));
        }
        if pattern.starts_with('(') && is_tuple(value) {
            found.push((Mark::PackedLets, at));
        }
    }
    found
}

/// Whether `value` is a tuple in parentheses and nothing follows in the statement.
fn is_tuple(value: &str) -> bool {
    let mut depth = 0;
    let mut commas = 0;
    for (at, c) in value.char_indices() {
        match c {
            '(' | '[' | '{' => depth += 1,
            ')' | ']' | '}' => depth -= 1,
            ',' if depth == 1 => commas += 1,
            _ => {}
        }
        if depth == 0 {
            let rest = value[at + c.len_utf8()..].trim_start();
            return at > 0 && commas > 0 && (rest.starts_with(';') || rest.starts_with("else"));
        }
    }
    false
}

/// `source` without comments and attributes.
fn bare(source: &str) -> String {
    let lines = source.lines().map(str::trim).filter(|line| !line.starts_with("//"));
    let code = lines.collect::<Vec<_>>().join("\n");
    let mut bare = String::new();
    let mut rest = code.as_str();
    while let Some(at) = rest.find("#[").into_iter().chain(rest.find("#![")).min() {
        bare.push_str(&rest[..at]);
        let mut depth = 0;
        let end = rest[at..].char_indices().find(|(_, c)| {
            depth += i32::from(*c == '[') - i32::from(*c == ']');
            *c == ']' && depth == 0
        });
        rest = end.map_or("", |(end, _)| &rest[at + end + 1..]);
    }
    bare + rest
}

/// Whether a source holds `mod` and `use` lines and nothing else.
fn declares_only(source: &str) -> bool {
    let bare = bare(source);
    let mut statements = bare.split(';').map(str::trim).filter(|text| !text.is_empty()).peekable();
    statements.peek().is_some()
        && statements.all(|statement| {
            let words: Vec<&str> = statement.split_whitespace().collect();
            match words[..] {
                ["mod", _] => true,
                [visible, "mod", _] => visible.starts_with("pub"),
                [first, second, ..] => {
                    first == "use" || first.starts_with("pub") && second == "use"
                }
                _ => false,
            }
        })
}

/// Types with inherent `impl`s in more than three files, by folder of the crate and name, with
/// these files. If a crate has several types of one name, each may have three files.
fn spread_types<'a>(
    texts: impl Iterator<Item = (&'a String, &'a String)>,
) -> Vec<(String, Vec<String>)> {
    let mut files: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    let mut defined: BTreeMap<String, usize> = BTreeMap::new();
    for (path, text) in texts {
        let Some((crate_folder, inside)) = path.split_once("/src/") else { continue };
        for line in text.lines() {
            let words: Vec<&str> =
                line.split(|c: char| !(c.is_alphanumeric() || c == '_')).collect();
            let kind = words.iter().position(|word| ["struct", "enum", "union"].contains(word));
            if let Some(name) = kind.and_then(|kind| words.get(kind + 1))
                && !line.trim_start().starts_with("//")
            {
                *defined.entry(format!("{crate_folder}: {name}")).or_default() += 1;
            }
        }
        for name in inherent(&bare(text)) {
            let key = format!("{crate_folder}: {name}");
            files.entry(key).or_default().insert(inside.to_owned());
        }
    }
    let spread = files.into_iter().filter(|(name, files)| {
        let types = defined.get(name).copied().unwrap_or(1).max(1);
        files.len() > 3 * types
    });
    spread.map(|(name, files)| (name, files.into_iter().collect())).collect()
}

/// Names of the types with an inherent `impl`. Pass code without comments.
fn inherent(code: &str) -> Vec<&str> {
    let mut found = Vec::new();
    for (at, _) in code.match_indices("impl") {
        let begins = code[..at].is_empty() || code[..at].ends_with('\n');
        let rest = &code[at + 4..];
        if !begins || !rest.starts_with([' ', '<']) {
            continue;
        }
        let Some(head) = rest.split('{').next() else { continue };
        let head = after_generics(head);
        let named = head.split(" where ").next().unwrap_or(head);
        if named.contains(" for ") {
            continue;
        }
        let path = named.split('<').next().unwrap_or_default().trim();
        found.push(path.rsplit("::").next().unwrap_or(path));
    }
    found
}

/// Skips the generic parameters at the start of `head`.
fn after_generics(head: &str) -> &str {
    if !head.starts_with('<') {
        return head;
    }
    let mut depth = 0;
    let mut before = ' ';
    for (at, c) in head.char_indices() {
        match c {
            '<' => depth += 1,
            '>' if before != '-' => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return &head[at + 1..];
        }
        before = c;
    }
    head
}

#[cfg(test)]
mod tests {
    use super::*;

    fn figures(files: &[(&str, &str)]) -> Figures {
        let texts = files.iter().map(|(path, text)| ((*path).to_owned(), (*text).to_owned()));
        Figures::of(&texts.collect())
    }

    #[test]
    fn closures_and_packed_lets_are_found() {
        let code = "fn f() {\n    let add = |a, b| a + b;\n    let mut run = move || 1;\n    \
            let typed: &dyn Fn(i32) = &|x| x;\n    let or = a | b;\n    let (a, b) = (1, f(2, 3));\n    \
            let (c, d) = (a + b).split();\n    let (e, g) = pair();\n    let Some((h, i)) = (x) else {};\n    \
            if let (Some(a), None) = (x, y) {}\n}\n";
        let figures = figures(&[("a/src/lib.rs", code)]);
        assert_eq!(figures.count_of(Mark::NamedClosures), 2, "{:?}", figures.places);
        assert_eq!(figures.count_of(Mark::PackedLets), 1, "{:?}", figures.places);
        assert_eq!(
            figures.places[&Mark::PackedLets],
            ["a/src/lib.rs:6: let (a, b) = (1, f(2, 3));"]
        );
        assert_eq!((figures.code, figures.words), (11, 0));
    }

    #[test]
    fn words_of_comments_are_counted() {
        let code = "//! The width, that of a head whose hair is wet; e.g. this one.\n//! ```\n//! let a = 1;\n//! ```\nconst A: u8 = 1; // no\n";
        let figures = figures(&[("a/src/lib.rs", code)]);
        assert_eq!(figures.words, 14);
        for mark in [Mark::ThatOf, Mark::Whose, Mark::Semicolons, Mark::ForExample, Mark::YouWeThis]
        {
            assert_eq!(figures.count_of(mark), 1, "{mark}");
        }
    }

    #[test]
    fn files_of_declarations_are_found() {
        assert!(declares_only(
            "//! Docs; of it.\n\n#[cfg(test)]\nmod tests;\npub(crate) use a::{b, c};\n"
        ));
        assert!(declares_only("#![expect(\n    a::b,\n    reason = \"c [d]\"\n)]\n\nmod e;\n"));
        assert!(!declares_only("mod a;\nconst B: usize = 1;\n"));
        assert!(!declares_only("mod tests {\n    use super::*;\n}\n"));
        assert!(!declares_only("//! Empty.\n"));
    }

    #[test]
    fn types_in_many_files_are_found() {
        let own = "impl<T: Fn() -> u8> Wide<T> {\n}\nimpl fmt::Display for Wide<u8> {\n}\n";
        let mut files: Vec<(String, &str)> =
            (0..4).map(|number| (format!("a/src/f{number}.rs"), own)).collect();
        files.push(("a/src/wide.rs".to_owned(), "pub struct Wide<T>(T);\n"));
        let files: Vec<(&str, &str)> = files.iter().map(|(path, text)| (&**path, *text)).collect();
        let found = figures(&files);
        assert_eq!(found.places[&Mark::SpreadTypes], ["a: Wide: f0.rs, f1.rs, f2.rs, f3.rs"]);
        assert_eq!(figures(&files[1..]).count_of(Mark::SpreadTypes), 0);
    }
}
