//! SVG elements with escaped text, and widths of texts.

use std::fmt::Write;

use crate::style::{Color, FONTS, PAPER};

/// Escapes `text` for the content or an attribute of an XML element.
#[must_use]
pub fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '&' => out.push_str("&amp;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&apos;"),
            // XML allows no control characters.
            c if c.is_control() => out.push(' '),
            c => out.push(c),
        }
    }
    out
}

/// Horizontal position of a text relative to its point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Anchor {
    /// The text starts at the point.
    Start,
    /// The text is centred on the point.
    Middle,
    /// The text ends at the point.
    End,
}

/// An SVG drawing of rectangles, lines and text. Use this for figures that are not charts.
#[derive(Debug, Clone)]
pub struct Canvas {
    text: String,
}

impl Canvas {
    /// An empty drawing of `width` x `height` px in the colour of paper.
    #[must_use]
    pub fn new(width: u32, height: u32) -> Self {
        let mut canvas = Self { text: opening(width, height, 1) };
        let size = (f64::from(width), f64::from(height));
        canvas.rectangle((0.0, 0.0), size, PAPER);
        canvas
    }

    /// Draws a filled rectangle with its upper left corner `at`, in px.
    pub fn rectangle(&mut self, at: (f64, f64), size: (f64, f64), fill: Color) {
        let (x, y) = at;
        let (width, height) = size;
        let fill = fill.hex();
        self.element(format_args!(
            r#"<rect x="{x:.1}" y="{y:.1}" width="{width:.1}" height="{height:.1}" fill="{fill}"/>"#
        ));
    }

    /// Draws a straight line of `width` px.
    pub fn line(&mut self, from: (f64, f64), to: (f64, f64), width: f64, color: Color) {
        let (x1, y1) = from;
        let (x2, y2) = to;
        let color = color.hex();
        self.element(format_args!(
            r#"<line x1="{x1:.1}" y1="{y1:.1}" x2="{x2:.1}" y2="{y2:.1}" stroke="{color}" stroke-width="{width}"/>"#
        ));
    }

    /// Draws a line of text, vertically centred at `at`. `size` is the font size in px.
    pub fn text(&mut self, at: (f64, f64), size: f64, anchor: Anchor, color: Color, text: &str) {
        let x = at.0;
        let y = at.1 + 0.35 * size;
        let anchor = match anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        let color = color.hex();
        let text = escaped(text);
        self.element(format_args!(
            r#"<text x="{x:.1}" y="{y:.1}" font-size="{size}" text-anchor="{anchor}" fill="{color}">{text}</text>"#
        ));
    }

    /// Draws a name vertically centred at `at`, in as many lines as `space` (width and height in px)
    /// needs, of font size `size` at most.
    pub fn name(
        &mut self,
        at: (f64, f64),
        space: (f64, f64),
        size: f64,
        anchor: Anchor,
        color: Color,
        text: &str,
    ) {
        let text = fitted(text, size, space);
        for (line, below) in text.lines.iter().zip(text.offsets()) {
            self.text((at.0, at.1 + below), text.size, anchor, color, line);
        }
    }

    /// Draws a name that reads upwards and starts at `at`, in the middle of its lines. `space` is its
    /// length and its width in px.
    pub fn name_upwards(
        &mut self,
        at: (f64, f64),
        space: (f64, f64),
        size: f64,
        color: Color,
        text: &str,
    ) {
        let text = fitted(text, size, space);
        for (line, right) in text.lines.iter().zip(text.offsets()) {
            self.text_upwards((at.0 + right, at.1), text.size, color, line);
        }
    }

    /// Draws a line of text that reads upwards and starts at `at`.
    fn text_upwards(&mut self, at: (f64, f64), size: f64, color: Color, text: &str) {
        let x = at.0 + 0.35 * size;
        let y = at.1;
        let color = color.hex();
        let text = escaped(text);
        self.element(format_args!(
            r#"<text x="{x:.1}" y="{y:.1}" font-size="{size}" transform="rotate(-90 {x:.1} {y:.1})" fill="{color}">{text}</text>"#
        ));
    }

    /// Closes the document and returns it.
    #[must_use]
    pub fn into_svg(mut self) -> String {
        self.text.push_str("</svg>\n");
        self.text
    }

    fn element(&mut self, element: std::fmt::Arguments<'_>) {
        self.text.write_fmt(element).expect("writing to memory does not fail");
        self.text.push('\n');
    }
}

/// The opening tag of a document of `width` x `height` px, with a view box of `fine` units per px.
/// A rim of paper around letters keeps them readable over colours, so you need not care where they
/// lie.
#[must_use]
pub fn opening(width: u32, height: u32, fine: u32) -> String {
    let w = width * fine;
    let h = height * fine;
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
         viewBox=\"0 0 {w} {h}\" font-family=\"{FONTS}\">\n\
         <style>text{{paint-order:stroke;stroke:{};stroke-width:.2em;stroke-linejoin:round}}</style>\n",
        PAPER.hex()
    )
}

const LINE: f64 = 1.15;
/// Smallest font size of a fitted text, in px.
const SMALLEST: f64 = 6.5;

/// Approximate width of `text` in px at font size `size`, in px, for a wide sans-serif font. This
/// is an estimate, because we do not know the reader's font.
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

/// Breaks `text` between words until it fits `space` (width and height in px), and makes it smaller
/// than `size` if this is not enough. One line is always allowed. If the text does not fit at the
/// smallest size, this also breaks words, and ends the text with an ellipsis only if even that is
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

/// Breaks a text into lines of whole words, each as long as `width` allows.
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
    fn markup_in_text_is_escaped() {
        assert_eq!(escaped("<b>&\"'\u{7}"), "&lt;b&gt;&amp;&quot;&apos; ");
        let mut canvas = Canvas::new(10, 10);
        canvas.text((1.0, 1.0), 10.0, Anchor::Start, crate::style::INK, "</text><b>");
        let svg = canvas.into_svg();
        assert!(svg.contains("&lt;/text&gt;&lt;b&gt;</text>"), "{svg}");
    }

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
