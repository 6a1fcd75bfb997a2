//! The limits of the figures, in one table. ARCHITECTURE.md holds the same rules and limits.

use std::fmt;

use crate::figures::{Figures, Mark};

/// The most or the least that a figure may be.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Limit {
    /// The most that is allowed.
    AtMost(f64),
    /// The least that is allowed.
    AtLeast(f64),
}

impl fmt::Display for Limit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::AtMost(most) => write!(f, "at most {most}"),
            Self::AtLeast(least) => write!(f, "at least {least}"),
        }
    }
}

/// A figure and its limit.
#[derive(Debug, Clone, Copy)]
pub struct Rule {
    /// Name of the figure, as it stands in the table.
    pub name: &'static str,
    /// The most or the least that the figure may be.
    pub limit: Limit,
    /// The mark to pass to `cargo xtask figures --list` if you want to see the places.
    pub mark: Option<Mark>,
    figure: fn(&Figures) -> f64,
}

impl Rule {
    /// Reads this figure from `figures`.
    #[must_use]
    pub fn figure(&self, figures: &Figures) -> f64 {
        (self.figure)(figures)
    }

    /// Whether `figures` keep this limit.
    #[must_use]
    pub fn is_kept(&self, figures: &Figures) -> bool {
        match self.limit {
            Limit::AtMost(most) => self.figure(figures) <= most,
            Limit::AtLeast(least) => self.figure(figures) >= least,
        }
    }
}

/// All rules. We tighten a limit when the figure has improved, and never loosen it.
pub const RULES: [Rule; 16] = [
    Rule {
        name: "Rust files per 1,000 lines of code",
        limit: Limit::AtMost(4.4),
        mark: Some(Mark::SmallFiles),
        figure: Figures::files_per_code,
    },
    Rule {
        name: "files below 60 lines",
        limit: Limit::AtMost(132.0),
        mark: Some(Mark::SmallFiles),
        figure: |figures| count(figures, Mark::SmallFiles),
    },
    Rule {
        name: "lines of the longest file",
        limit: Limit::AtMost(800.0),
        mark: None,
        figure: |figures| number(figures.longest),
    },
    Rule {
        name: "folders with more than 20 sources",
        limit: Limit::AtMost(0.0),
        mark: Some(Mark::FullFolders),
        figure: |figures| count(figures, Mark::FullFolders),
    },
    Rule {
        name: "files of declarations only, in folders with fewer than four others",
        limit: Limit::AtMost(1.0),
        mark: Some(Mark::DeclarationFiles),
        figure: |figures| count(figures, Mark::DeclarationFiles),
    },
    Rule {
        name: "types with `impl`s of their own in more than three files",
        limit: Limit::AtMost(1.0),
        mark: Some(Mark::SpreadTypes),
        figure: |figures| count(figures, Mark::SpreadTypes),
    },
    Rule {
        name: "`use` lines, per cent of the code",
        limit: Limit::AtMost(3.9),
        mark: None,
        figure: |figures| 100.0 * number(figures.uses) / number(figures.code).max(1.0),
    },
    Rule {
        name: "closures with a name, per 1,000 lines of code",
        limit: Limit::AtMost(3.0),
        mark: Some(Mark::NamedClosures),
        figure: |figures| figures.per_code(Mark::NamedClosures),
    },
    Rule {
        name: "`let (a, b) = (x, y);`, per 1,000 lines of code",
        limit: Limit::AtMost(0.3),
        mark: Some(Mark::PackedLets),
        figure: |figures| figures.per_code(Mark::PackedLets),
    },
    Rule {
        name: "\"that of\", \"those of\", per 1,000 words",
        limit: Limit::AtMost(0.2),
        mark: Some(Mark::ThatOf),
        figure: |figures| figures.per_words(Mark::ThatOf),
    },
    Rule {
        name: "\"whose\", per 1,000 words",
        limit: Limit::AtMost(0.25),
        mark: Some(Mark::Whose),
        figure: |figures| figures.per_words(Mark::Whose),
    },
    Rule {
        name: "semicolons, per 1,000 words",
        limit: Limit::AtMost(0.9),
        mark: Some(Mark::Semicolons),
        figure: |figures| figures.per_words(Mark::Semicolons),
    },
    Rule {
        name: "\"you\", \"we\", \"this\", per 1,000 words",
        limit: Limit::AtLeast(10.0),
        mark: Some(Mark::YouWeThis),
        figure: |figures| figures.per_words(Mark::YouWeThis),
    },
    Rule {
        name: "\"for example\", \"e.g.\", per 1,000 words",
        limit: Limit::AtLeast(0.6),
        mark: Some(Mark::ForExample),
        figure: |figures| figures.per_words(Mark::ForExample),
    },
    Rule {
        name: "doc comments that begin with \"What\", \"The same\", \"As\"",
        limit: Limit::AtMost(0.0),
        mark: Some(Mark::Riddles),
        figure: |figures| count(figures, Mark::Riddles),
    },
    Rule {
        name: "doc comments of one or two words",
        limit: Limit::AtMost(88.0),
        mark: Some(Mark::ShortDocs),
        figure: |figures| count(figures, Mark::ShortDocs),
    },
];

fn count(figures: &Figures, mark: Mark) -> f64 {
    number(figures.count_of(mark))
}

#[expect(clippy::cast_precision_loss, reason = "counts are far below 2^52")]
fn number(count: usize) -> f64 {
    count as f64
}

/// The first line of the table.
pub const HEAD: &str = "| rule | figure | limit |";

/// The table of ARCHITECTURE.md for `figures`, with a line break after each row.
#[must_use]
pub fn table(figures: &Figures) -> String {
    let mut rows = format!("{HEAD}\n| --- | --- | --- |\n");
    for rule in &RULES {
        let figure = rule.figure(figures);
        let digits = if figure.fract() == 0.0 { 0 } else { 2 };
        rows += &format!("| {} | {figure:.digits$} | {} |\n", rule.name, rule.limit);
    }
    rows
}

/// The rows of the table in `page`, each as its cells.
#[must_use]
pub fn rows_of(page: &str) -> Vec<[&str; 3]> {
    let lines = page.lines().skip_while(|line| *line != HEAD).skip(2);
    lines.map_while(cells).collect()
}

fn cells(line: &str) -> Option<[&str; 3]> {
    let inside = line.strip_prefix("| ")?.strip_suffix(" |")?;
    inside.split(" | ").collect::<Vec<_>>().try_into().ok()
}

/// Replaces the table in `page` by `table`. If `page` does not hold a table, this is `None`.
#[must_use]
pub fn with_table(page: &str, table: &str) -> Option<String> {
    let start = page.find(HEAD)?;
    let length: usize = page[start..]
        .split_inclusive('\n')
        .take_while(|line| line.starts_with('|'))
        .map(str::len)
        .sum();
    Some([&page[..start], table, &page[start + length..]].concat())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_of_a_page_is_replaced() {
        let table = table(&Figures::default());
        let page =
            format!("# Page\n\n{HEAD}\n| --- | --- | --- |\n| old | 1 | at most 2 |\n\nMore.\n");
        assert_eq!(rows_of(&page), [["old", "1", "at most 2"]]);
        let written = with_table(&page, &table).unwrap_or_default();
        assert_eq!(written, format!("# Page\n\n{table}\nMore.\n"));
        assert_eq!(rows_of(&written).len(), RULES.len());
        assert_eq!(with_table("# Page\n", &table), None);
    }

    #[test]
    fn limits_are_kept_on_either_side() {
        let lines = RULES.iter().find(|rule| rule.limit == Limit::AtMost(800.0));
        let lines = lines.expect("a rule for the longest file");
        assert!(lines.is_kept(&Figures { longest: 800, ..Figures::default() }), "800 lines");
        assert!(!lines.is_kept(&Figures { longest: 801, ..Figures::default() }), "801 lines");
        let words = RULES.iter().find(|rule| matches!(rule.limit, Limit::AtLeast(_)));
        let words = words.expect("a rule with a least figure");
        assert!(!words.is_kept(&Figures { words: 1000, ..Figures::default() }), "no such word");
    }
}
