//! Quotes the command line so that it can be typed again.

/// Joins the words of a command line with spaces, each quoted for a POSIX shell where needed.
pub(crate) fn command_line<'a>(words: impl IntoIterator<Item = &'a str>) -> String {
    let quoted: Vec<String> = words.into_iter().map(quoted).collect();
    quoted.join(" ")
}

/// Quotes `word` for a POSIX shell unless it holds only plain characters.
fn quoted(word: &str) -> String {
    if !word.is_empty()
        && word.chars().all(|c: char| c.is_ascii_alphanumeric() || "-_./,:+=@%".contains(c))
    {
        return word.to_owned();
    }
    format!("'{}'", word.replace('\'', "'\\''"))
}

#[cfg(test)]
mod tests {
    use super::quoted;

    #[test]
    fn a_shell_reads_back_what_was_quoted() {
        for word in ["out/a.json", "Zinc White", "", "it's $HOME `x` \"y\" \\"] {
            let shell = std::process::Command::new("sh")
                .args(["-c", &format!("printf %s {}", quoted(word))])
                .output()
                .unwrap();
            assert_eq!(String::from_utf8(shell.stdout).unwrap(), word);
        }
    }
}
