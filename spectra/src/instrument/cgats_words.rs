//! Splitting a line of CGATS into words.

/// Line number (from 1) and text of a cell.
pub(super) type Cell = (usize, String);

/// The words of a line, separated by blanks. Quotes around a word are removed, `""` inside
/// quotes stands for a quote, and a comment from `#` on is dropped.
pub(super) fn words(line: &str) -> Vec<String> {
    let mut found = Vec::new();
    let mut characters = line.chars().peekable();
    while let Some(&first) = characters.peek() {
        if first.is_whitespace() {
            characters.next();
            continue;
        }
        if first == '#' {
            break;
        }
        let mut text = String::new();
        if first == '"' {
            characters.next();
            while let Some(c) = characters.next() {
                if c != '"' {
                    text.push(c);
                } else if characters.next_if_eq(&'"').is_some() {
                    text.push('"');
                } else {
                    break;
                }
            }
        } else {
            while let Some(c) = characters.next_if(|c| !c.is_whitespace()) {
                text.push(c);
            }
        }
        found.push(text);
    }
    found
}
