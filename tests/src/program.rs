//! Runs the program `impasto` in process and captures its output, takes commands from the pages of
//! the guides as a reader copies them, and opens the graphics device for tests.

use std::io::Write;
use std::path::PathBuf;

use graphics::gpu::{BackendChoice, Device, choose};

/// Exit status and output of a run.
#[derive(Debug)]
pub struct Run {
    /// Exit status: 0 done, 1 if the data or a comparison fails, 2 if the program could not run.
    pub status: u8,
    /// Standard output: the results.
    pub out: String,
    /// Standard error: remarks and errors.
    pub err: String,
}

impl Run {
    /// Parses the results as JSON.
    ///
    /// # Panics
    /// If the results are not JSON.
    #[must_use]
    pub fn json(&self) -> serde_json::Value {
        serde_json::from_str(&self.out)
            .unwrap_or_else(|error| panic!("{error}: {}\n{}", self.out, self.err))
    }
}

/// Runs `impasto` with `arguments`.
#[must_use]
pub fn impasto(arguments: &[&str]) -> Run {
    let mut out = Vec::new();
    let mut err = Vec::new();
    let all = std::iter::once("impasto").chain(arguments.iter().copied());
    let status = impasto::run(all, &mut out, &mut err, impasto::Screen::default());
    let [out, err] =
        [out, err].map(|bytes| String::from_utf8(bytes).expect("the program writes UTF-8"));
    Run { status, out, err }
}

/// Path of a file of the repository, valid from any working folder.
#[must_use]
pub fn repository(file: &str) -> String {
    let root = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("..");
    root.join(file).display().to_string()
}

/// A command of a page.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Command {
    /// The command as the page prints it, but on one line.
    pub line: String,
    /// Its words, without comment and redirection.
    pub words: Vec<String>,
    /// The file that its output is written to, `> FILE`.
    pub output: Option<String>,
}

/// The commands of all blocks of `page` that a shell runs, in order. Skips blocks with `ignore` in
/// their fence.
#[must_use]
pub fn commands(page: &str) -> Vec<Command> {
    let mut found = Vec::new();
    let mut inside = None;
    for line in page.lines() {
        match (line.strip_prefix("```"), inside) {
            (Some(_), Some(_)) => inside = None,
            (Some(fence), None) => inside = Some(fence.trim() == "sh"),
            (None, Some(true)) => found.push(line.to_owned()),
            (None, _) => {}
        }
    }
    let joined = found.join("\n").replace("\\\n", " ");
    joined.lines().filter(|line| !line.trim().is_empty()).map(command).collect()
}

fn command(line: &str) -> Command {
    let mut words = words(line);
    let at = words.iter().position(|word| word == ">");
    let output = at.and_then(|at| words.get(at + 1).cloned());
    words.truncate(at.unwrap_or(words.len()));
    Command { line: line.split_whitespace().collect::<Vec<_>>().join(" "), words, output }
}

/// Splits a command into words as a shell does, with double quotes. Leaves out a comment.
fn words(line: &str) -> Vec<String> {
    let mut words: Vec<String> = Vec::new();
    let mut quoted = false;
    let mut open = false;
    for (index, c) in line.char_indices() {
        match c {
            '"' => {
                (quoted, open) = (!quoted, true);
                if quoted && !line[..index].ends_with(|before: char| !before.is_whitespace()) {
                    words.push(String::new());
                }
            }
            '#' if !quoted && !open => break,
            c if c.is_whitespace() && !quoted => open = false,
            c => {
                if !open {
                    words.push(String::new());
                    open = true;
                }
                if let Some(word) = words.last_mut() {
                    word.push(c);
                }
            }
        }
    }
    words
}

/// Opens the graphics device for a test, and prefers a hardware adapter. Without an adapter you get
/// `None` and a note on standard error. If the environment variable `IMPASTO_GPU_TESTS` names a file,
/// this appends the name of the adapter (or `none`) to it.
///
/// # Panics
/// If that file cannot be written.
#[must_use]
pub fn device() -> Option<Device> {
    let device = choose(BackendChoice::Gpu).ok().flatten();
    let name = device.as_ref().map_or("none", |device| &device.adapter().name);
    if let Some(path) = std::env::var_os("IMPASTO_GPU_TESTS") {
        let file = std::fs::OpenOptions::new().append(true).create(true).open(path);
        let written = file.and_then(|mut file| file.write_all(format!("{name}\n").as_bytes()));
        assert!(written.is_ok(), "IMPASTO_GPU_TESTS: {written:?}");
    }
    if device.is_none() {
        let _ = writeln!(std::io::stderr(), "no graphics adapter: not tested");
    }
    device
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_of_a_shell_are_read_as_a_shell_reads_them() {
        let page = "```sh\nimpasto mix a.json \"Zinc White=9\" \\\n    b=\"1 2\" > out.txt  # why\n```\n\
            ```toml\nno = 1\n```\n```sh ignore\nopen it\n```\n```sh\nimpasto match \"#fff\" c#d\n```\n";
        let found = commands(page);
        assert_eq!(found.len(), 2);
        assert_eq!(found[0].words, ["impasto", "mix", "a.json", "Zinc White=9", "b=1 2"]);
        assert_eq!(found[0].output.as_deref(), Some("out.txt"));
        assert_eq!(found[1].words, ["impasto", "match", "#fff", "c#d"]);
    }
}
