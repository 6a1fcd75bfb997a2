//! Widths of texts, and texts fitted into a space.

/// Height of a line in font sizes.
const LINE: f64 = 1.15;
/// Smallest font size of a fitted text, in px.
const SMALLEST: f64 = 6.5;

/// Approximate width of `text` in px at font size `size`, in px, for a wide sans-serif font. It is
/// an estimate, because the reader's font is not known.
#[must_use]
pub fn estimated_width(text: &str, size: f64) -> f64 {
    size * text
        .chars()
        .map(|c: char| match c {
            'i' | 'j' | 'l' | 'I' | '.' | ',' | ':' | ';' | '\'' | '|' | '!' => 0.32,
            'f' | 't' | 'r' | '(' | ')' | ' ' | '-' => 0.4,
            'm' | 'w' | 'M' | 'W' | '%' => 0.9,
            c if c.is_uppercase() => 0.7,
            c if (c as u32) > 0x2e80 => 1.0,
            _ => 0.62,
        })
        .sum::<f64>()
}

/// A text as it fits a space.
#[derive(Debug, Clone, PartialEq)]
pub struct Fitted {
    /// The lines, from above to below.
    pub lines: Vec<String>,
    /// Font size in px.
    pub size: f64,
}

impl Fitted {
    /// Distance of the middle of each line below the middle of the text, in px.
    pub fn offsets(&self) -> impl Iterator<Item = f64> + use<> {
        let count = self.lines.len();
        let line = LINE * self.size;
        (0..count).map(move |index| (index as f64 - (count as f64 - 1.0) / 2.0) * line)
    }

    /// Width of the longest line, in px.
    #[must_use]
    pub fn width(&self) -> f64 {
        self.lines.iter().map(|line| estimated_width(line, self.size)).fold(0.0, f64::max)
    }
}

/// Breaks `text` between words and, where that is not enough, makes it smaller than `size`, until it
/// fits `space` (width and height in px). One line is always allowed. A text that does not fit at
/// the smallest size is also broken within words, and ends with an ellipsis only if even that is
/// too high.
#[must_use]
pub fn fitted(text: &str, size: f64, space: (f64, f64)) -> Fitted {
    let (width, height) = space;
    let most = |size: f64| ((height / (LINE * size)) as usize).max(1);
    let mut tried = size;
    while tried > SMALLEST {
        let lines = broken(text, tried, width);
        let wide = lines.iter().any(|line| estimated_width(line, tried) > width);
        if !wide && lines.len() <= most(tried) {
            return Fitted { lines, size: tried };
        }
        tried -= 0.5;
    }
    let mut lines = Vec::new();
    for line in broken(text, SMALLEST, width) {
        lines.extend(pieces(&line, SMALLEST, width));
    }
    if lines.len() > most(SMALLEST) {
        lines.truncate(most(SMALLEST));
        if let Some(last) = lines.last_mut() {
            last.pop();
            last.push('\u{2026}');
        }
    }
    Fitted { lines, size: SMALLEST }
}

/// Lines of whole words, each as long as `width` allows.
fn broken(text: &str, size: f64, width: f64) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in text.split_whitespace() {
        let line = lines.last_mut().expect("there is a line");
        let longer = if line.is_empty() { word.to_owned() } else { format!("{line} {word}") };
        // A number stays with its percent sign, and a plus sign with what it adds.
        let ends_open = line.ends_with(" +") || word == "%";
        if line.is_empty() || ends_open || estimated_width(&longer, size) <= width {
            *line = longer;
        } else {
            lines.push(word.to_owned());
        }
    }
    lines
}

/// A line cut into pieces of `width` px.
fn pieces(line: &str, size: f64, width: f64) -> Vec<String> {
    let mut pieces = vec![String::new()];
    for c in line.chars() {
        let piece = pieces.last_mut().expect("there is a piece");
        if !piece.is_empty() && estimated_width(&format!("{piece}{c}"), size) > width {
            pieces.push(c.to_string());
        } else {
            piece.push(c);
        }
    }
    pieces
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_names_are_broken_then_made_smaller_and_keep_every_letter() {
        let name = "Benzimidazolone Yellow PY154 (cold pressed linseed oil)";
        assert_eq!(fitted("short", 10.0, (100.0, 12.0)).lines, ["short"]);
        for space in [(160.0, 24.0), (110.0, 24.0), (90.0, 36.0), (300.0, 12.0)] {
            let found = fitted(name, 12.0, space);
            assert_eq!(found.lines.join(" "), name, "{space:?}");
            assert!(found.width() <= space.0 && found.size >= SMALLEST, "{space:?}: {found:?}");
            let high = found.lines.len() as f64 * LINE * found.size;
            assert!(high <= space.1 + 1e-9, "{space:?}: {found:?}");
        }
        let first = fitted(name, 12.0, (160.0, 30.0));
        let last = fitted(name, 12.0, (160.0, 60.0));
        assert!(first.size < last.size, "more room, larger letters");
        let offsets: Vec<f64> = last.offsets().collect();
        assert!(offsets.iter().sum::<f64>().abs() < 1e-9, "{offsets:?} are around the middle");
    }

    #[test]
    fn one_long_word_is_cut_into_pieces_and_only_the_hopeless_is_shortened() {
        let word = "Dichlorodiketopyrrolopyrrole";
        let found = fitted(word, 12.0, (60.0, 30.0));
        assert_eq!(found.lines.concat(), word);
        assert!(found.lines.len() > 1 && found.width() <= 60.0, "{found:?}");
        let hopeless = fitted(word, 12.0, (20.0, 12.0));
        assert!(hopeless.lines[0].ends_with('\u{2026}'), "{hopeless:?}");
    }
}
