//! The command line as a whole: the options of every verb, and verbs in groups. We also make
//! completions and manual pages of it.

use std::path::PathBuf;

use clap::{Args, Command, CommandFactory, Parser, Subcommand};
use clap_complete::Shell;

use crate::console::{Console, Voice};
use crate::failure::{Failure, Result};
use crate::manual::{pages, with_examples};
use crate::output::OutputFolder;
use crate::verbs::{LACKING, Verb};

/// Measure real paint, calibrate it, and paint with it.
#[derive(Debug, Parser)]
#[command(name = "impasto", version, propagate_version = true, max_term_width = 100)]
pub(crate) struct Arguments {
    /// Print results, warnings and errors only
    #[arg(short, long, global = true, conflicts_with = "verbose", help_heading = "Messages")]
    quiet: bool,
    /// Also print what was chosen and how long it took
    #[arg(short, long, global = true, help_heading = "Messages")]
    verbose: bool,
    #[command(subcommand)]
    pub(crate) task: Task,
}

impl Arguments {
    /// How much we print beside results.
    pub(crate) fn voice(&self) -> Voice {
        match (self.quiet, self.verbose) {
            (true, _) => Voice::Quiet,
            (_, true) => Voice::Verbose,
            _ => Voice::Usual,
        }
    }
}

/// A verb, or a file made of the command line.
#[derive(Debug, Subcommand)]
pub(crate) enum Task {
    #[command(flatten)]
    Verb(Box<Verb>),
    Completions(Completions),
    Man(Man),
}

/// Print the completions of a shell
#[derive(Debug, Args)]
pub(crate) struct Completions {
    /// Shell to write the completions for
    shell: Shell,
}

/// Write a manual page of every verb
#[derive(Debug, Args)]
pub(crate) struct Man {
    /// The folder, such as man/man1; created if missing
    folder: PathBuf,
}

impl Completions {
    pub(crate) fn run(self, console: &mut Console<'_>) -> Result<()> {
        let mut script = Vec::new();
        clap_complete::generate(self.shell, &mut command(), "impasto", &mut script);
        console.text(&(String::from_utf8_lossy(&script).trim_end().to_owned() + "\n"))
    }
}

impl Man {
    pub(crate) fn run(self, console: &mut Console<'_>) -> Result<()> {
        let folder = OutputFolder::open(&self.folder, &[])?;
        let mut whole = command();
        whole.build();
        let pages = pages(&whole)
            .map_err(|(name, error)| Failure::from(error).within(format!("the page of {name}")))?;
        let names = pages.iter().map(|(name, _)| name.clone());
        for (output, (_, page)) in folder.outputs(names)?.into_iter().zip(&pages) {
            output.put(page)?;
        }
        folder.told(console)
    }
}

/// Headings of the help with the verbs below each, in the order in which you need them.
const GROUPS: [(&str, &[&str]); 5] = [
    ("Measure and calibrate", &["plan", "color", "light", "film", "fit", "validate", "report"]),
    ("Mix and match", &["mix", "match", "correct", "library", "quadrature"]),
    ("Map a scan", &["map", "identify", "simulate-scan"]),
    ("Paint", &["paint", "relight", "watercolor", "artmap", "painterly", "stencil"]),
    ("The program", &["demo", "gpu", "completions", "man", "help"]),
];

/// The whole command line, with verbs in groups and examples.
pub(crate) fn command() -> Command {
    let plain = short_help(with_examples(Arguments::command()));
    let verbs = grouped(&plain);
    let mut more =
        "`impasto VERB --help` explains a verb; docs/guide/index.md lists the guides.".to_owned();
    if let Some(lacking) = LACKING {
        more += &format!("\n{lacking}");
    }
    plain.help_template(format!(
        "{{about-with-newline}}\n{{usage-heading}} {{usage}}\n\n{verbs}Options:\n{{options}}\n\n{more}\n"
    ))
}

/// A verb that this program was compiled without, if `words`, the command line behind the name of the program, begin
/// with one.
pub(crate) fn left_out_verb(words: &[String]) -> Option<&'static str> {
    let first = words.iter().find(|word| !word.starts_with('-'))?;
    let all = GROUPS.iter().flat_map(|(_, names)| names.iter().copied());
    let whole = command();
    all.filter(|name| *name != "help" && whole.find_subcommand(name).is_none())
        .find(|name| name == first)
}

/// `-h` shows at most this many letters of an option's help, on one line of 80 columns.
const SHORT: usize = 70;
/// A shortened help has at least this many letters.
const SHORTEST: usize = 20;

/// The command and all verbs below it, with a short help of each option for `-h`. `--help` shows all.
fn short_help(command: Command) -> Command {
    let names: Vec<String> =
        command.get_subcommands().map(|verb| verb.get_name().to_owned()).collect();
    let command =
        names.into_iter().fold(command, |command, name| command.mut_subcommand(name, short_help));
    command.mut_args(|option| {
        let Some(whole) = option.get_help().map(ToString::to_string) else { return option };
        match shortened(&whole) {
            Some(short) if option.get_long_help().is_none() => option.help(short).long_help(whole),
            Some(short) => option.help(short),
            None => option,
        }
    })
}

/// The beginning of a help that is too long for a line, up to the end of a clause. `None` for a short one.
fn shortened(help: &str) -> Option<String> {
    if help.chars().count() <= SHORT {
        return None;
    }
    let ends = [". ", ": ", "; ", " [default: "].iter();
    let end = ends.filter_map(|end| help.match_indices(end).find(|(at, _)| *at >= SHORTEST));
    end.map(|(at, _)| help[..at].to_owned()).min_by_key(String::len)
}

/// The verbs in their groups, each with the first line of its help.
fn grouped(command: &Command) -> String {
    let named: Vec<&str> = GROUPS.iter().flat_map(|(_, names)| names.iter().copied()).collect();
    let others = command.get_subcommands().filter(|verb| !verb.is_hide_set());
    let others: Vec<&str> =
        others.map(Command::get_name).filter(|name| !named.contains(name)).collect();
    let groups = GROUPS.iter().map(|(title, names)| {
        let is_there = |name: &&str| *name == "help" || command.find_subcommand(name).is_some();
        (*title, names.iter().copied().filter(is_there).collect())
    });
    let widest = GROUPS.iter().flat_map(|(_, names)| names.iter()).map(|name| name.len()).max();
    let width = widest.unwrap_or_default();
    let mut text = String::new();
    for (title, names) in groups.chain([("More", others)]).filter(|(_, names)| !names.is_empty()) {
        text += &format!("{title}:\n");
        for name in names {
            let help =
                (name == "help").then(|| "Print this message or the help of a verb".to_owned());
            let found = command.find_subcommand(name);
            let about =
                found.map(|verb| verb.get_about().map(ToString::to_string).unwrap_or_default());
            if let Some(about) = about.or(help) {
                text += &format!("  {name:width$}  {about}\n");
            }
        }
        text.push('\n');
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_command_line_is_sound() {
        command().debug_assert();
    }

    #[test]
    fn long_helps_end_with_a_clause_in_the_short_help() {
        for (help, expected) in [
            ("Readings are fractions, white near 1", None),
            (
                "Recipes for measurement files that hold none (CSV): a column `sample`, then one each",
                Some("Recipes for measurement files that hold none (CSV)"),
            ),
            (
                "Light: a CIE illuminant (D65, A, FL11, LED-B3 ..), or a lamp's file [default: D65]",
                Some("Light: a CIE illuminant (D65, A, FL11, LED-B3 ..), or a lamp's file"),
            ),
        ] {
            assert_eq!(shortened(help).as_deref(), expected, "{help}");
        }
    }

    #[test]
    fn the_short_help_of_a_fit_is_about_a_screen_and_a_half_and_ends_with_the_files() {
        let whole = command().max_term_width(80).term_width(80);
        let mut fit = whole.find_subcommand("fit").unwrap().clone().term_width(80);
        let help = fit.render_help().to_string();
        assert!(help.lines().count() <= 78, "{}\n{help}", help.lines().count());
        let at = |text: &str| help.find(text).unwrap_or_else(|| panic!("{text}: {help}"));
        assert!(at("--white <PIGMENT>") < at("Files of instruments:"));
        for option in ["--percent", "--format", "--white-reading", "--tile"] {
            assert!(at(option) > at("Files of instruments:"), "{option}");
        }
        let long = fit.render_long_help().to_string();
        assert!(long.contains("--least-light") && long.contains("a column `sample`"), "{long}");
    }

    #[test]
    fn every_verb_is_in_one_group() {
        let whole = command();
        let shown: Vec<&str> = whole
            .get_subcommands()
            .filter(|verb| !verb.is_hide_set())
            .map(Command::get_name)
            .collect();
        for verb in &shown {
            let groups = GROUPS.iter().filter(|(_, names)| names.contains(verb)).count();
            assert_eq!(groups, 1, "{verb}");
        }
        for name in GROUPS.iter().flat_map(|(_, names)| names.iter()) {
            let is_there = *name == "help" || shown.contains(name);
            assert!(is_there || LACKING.is_some(), "there is no verb {name}");
        }
    }
}

/// Tests that every option named in a hint or a message, such as `--output`, is an option of a verb.
#[cfg(all(test, feature = "pictures"))]
mod named_options {
    use std::collections::BTreeSet;
    use std::path::Path;

    use super::*;
    use crate::failure::with_options;

    /// Words in square brackets that no error shows as a setting: tables of TOML, units and columns of files.
    /// Below them options that every program has, and one of cargo.
    const NO_SETTINGS: [&str; 9] = [
        "--counts",
        "--nm",
        "--table",
        "--x",
        "--fill",
        "--stroke",
        "--help",
        "--version",
        "--no-default-features",
    ];

    /// The options of a verb and of its own verbs, without old spellings.
    fn options_of(verb: &Command) -> BTreeSet<String> {
        let own = verb.get_arguments().filter(|option| !option.is_hide_set());
        let own = own.flat_map(|option| {
            let aliases = option.get_visible_aliases().unwrap_or_default();
            option.get_long().into_iter().chain(aliases).collect::<Vec<_>>()
        });
        let own = own.map(|name| format!("--{name}"));
        own.chain(verb.get_subcommands().flat_map(options_of)).collect()
    }

    /// The texts in double quotes of a source, without its comments and its tests, each with its line.
    fn literals(source: &str) -> Vec<(usize, String)> {
        let source = source.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default();
        let mut found = Vec::new();
        let mut rest = source;
        while let Some(at) = rest.find(['"', '/', '\'', 'r']) {
            let before = &rest[..at];
            rest = &rest[at..];
            let raw =
                rest.strip_prefix("r#\"").filter(|_| !before.ends_with(char::is_alphanumeric));
            if rest.starts_with("//") {
                rest = rest.split_once('\n').map_or("", |(_, rest)| rest);
            } else if let Some(inside) = raw {
                rest = inside.split_once("\"#").map_or("", |(_, rest)| rest);
            } else if let Some(inside) = rest.strip_prefix('"') {
                let line = source[..source.len() - rest.len()].lines().count();
                let mut escaped = false;
                let end = inside.find(|c| {
                    let ends = c == '"' && !escaped;
                    escaped = c == '\\' && !escaped;
                    ends
                });
                let end = end.unwrap_or(inside.len());
                found.push((line, inside[..end].to_owned()));
                rest = inside.get(end + 1..).unwrap_or_default();
            } else if rest.starts_with("'\"'") {
                rest = &rest[3..];
            } else if rest.starts_with("'\\") {
                rest = rest.get(4..).unwrap_or_default();
            } else {
                rest = &rest[1..];
            }
        }
        found
    }

    /// The options in a text.
    fn options_in(text: &str) -> Vec<String> {
        let starts = text.match_indices("--").filter(|(at, _)| {
            let before = &text[..*at];
            // Properties of a style sheet look alike.
            let begins = before.is_empty() || before.ends_with([' ', '`', '\'', '(', '|']);
            begins && !before.ends_with("var(")
        });
        let words = starts.map(|(at, _)| {
            let end = text[at + 2..].find(|c: char| !c.is_ascii_lowercase() && c != '-');
            &text[at..end.map_or(text.len(), |end| at + 2 + end)]
        });
        let is_option = |word: &&str| word[2..].starts_with(|c: char| c.is_ascii_lowercase());
        words.filter(is_option).map(str::to_owned).collect()
    }

    /// Sources below `folder` that are no tests.
    fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
        for entry in std::fs::read_dir(folder).expect("a folder of sources") {
            let path = entry.expect("a source").path();
            let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
            if path.is_dir() && !["tests", "examples", "benches", "target"].contains(&name) {
                sources(&path, found);
            } else if name.ends_with(".rs") && !name.ends_with("tests.rs") {
                found.push(path);
            }
        }
    }

    #[test]
    fn hints_name_options_that_exist() {
        let command = command();
        let all = options_of(&command);
        let scans = ["map", "identify", "simulate-scan"].map(|verb| command.find_subcommand(verb));
        let of_scans: BTreeSet<String> = scans.into_iter().flatten().flat_map(options_of).collect();
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
        let (mut wrong, mut count) = (Vec::new(), 0);
        for folder in ["documents", "spectra", "calibrate", "render", "reports", "apps/cli/src"] {
            let mut files = Vec::new();
            sources(&root.join(folder), &mut files);
            for path in files {
                let name = path.display().to_string();
                let known = if name.contains("calibrate/maps/") { &of_scans } else { &all };
                for (line, text) in literals(&std::fs::read_to_string(&path).unwrap()) {
                    let hint = with_options(&documents::hint::Hint::new(text));
                    let options = options_in(&hint);
                    count += options.len();
                    let unknown = options.into_iter().filter(|option| {
                        !known.contains(option) && !NO_SETTINGS.contains(&option.as_str())
                    });
                    wrong.extend(unknown.map(|option| format!("{name}:{line}: {option}")));
                }
            }
        }
        assert!(wrong.is_empty(), "{}", wrong.join("\n"));
        assert!(count > 300, "{count} options were found");
    }
}
