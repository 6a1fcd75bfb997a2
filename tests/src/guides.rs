//! Commands in the guides, taken from their pages as a reader copies them.

/// A command of a page.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Command {
    /// The command as it is printed, on one line.
    pub line: String,
    /// Its words, without comment and redirection.
    pub words: Vec<String>,
    /// The file that its output is written to, `> FILE`.
    pub output: Option<String>,
}

/// The commands of all blocks of `page` that a shell runs, in order. Blocks whose fence says `ignore`
/// are passed over.
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

/// Splits a command into words as a shell does, with double quotes; a comment is left out.
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
