//! Elements of SVG, escaped.

use std::fmt::Write;

use crate::style::{Color, FONTS};

/// `text` as the content or an attribute of an element.
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
            // No document may hold other control characters.
            c if c.is_control() => out.push(' '),
            c => out.push(c),
        }
    }
    out
}

/// Where a text stands from its point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Anchor {
    /// To the right of it.
    Start,
    /// On it.
    Middle,
    /// To the left of it.
    End,
}

/// A picture drawn element by element: patches and words, for what is no chart.
#[derive(Debug, Clone)]
pub struct Canvas {
    text: String,
}

impl Canvas {
    /// An empty paper of `width` x `height` px.
    #[must_use]
    pub fn new(width: u32, height: u32) -> Self {
        let mut canvas = Self { text: opening(width, height, 1) };
        let size = (f64::from(width), f64::from(height));
        canvas.rectangle((0.0, 0.0), size, crate::style::PAPER);
        canvas
    }

    /// A filled rectangle, `at` its upper left corner, in px.
    pub fn rectangle(&mut self, at: (f64, f64), size: (f64, f64), fill: Color) {
        let ((x, y), (width, height)) = (at, size);
        let fill = fill.hex();
        self.element(format_args!(
            r#"<rect x="{x:.1}" y="{y:.1}" width="{width:.1}" height="{height:.1}" fill="{fill}"/>"#
        ));
    }

    /// A straight line.
    pub fn line(&mut self, from: (f64, f64), to: (f64, f64), width: f64, color: Color) {
        let ((x1, y1), (x2, y2)) = (from, to);
        let color = color.hex();
        self.element(format_args!(
            r#"<line x1="{x1:.1}" y1="{y1:.1}" x2="{x2:.1}" y2="{y2:.1}" stroke="{color}" stroke-width="{width}"/>"#
        ));
    }

    /// A line of text, `at` its middle height.
    pub fn text(&mut self, at: (f64, f64), size: f64, anchor: Anchor, color: Color, text: &str) {
        let (x, y) = (at.0, at.1 + 0.35 * size);
        let anchor = match anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        let (color, text) = (color.hex(), escaped(text));
        self.element(format_args!(
            r#"<text x="{x:.1}" y="{y:.1}" font-size="{size}" text-anchor="{anchor}" fill="{color}">{text}</text>"#
        ));
    }

    /// A line of text that reads upwards, `at` its foot and middle height.
    pub fn text_upwards(&mut self, at: (f64, f64), size: f64, color: Color, text: &str) {
        let (x, y) = (at.0 + 0.35 * size, at.1);
        let (color, text) = (color.hex(), escaped(text));
        self.element(format_args!(
            r#"<text x="{x:.1}" y="{y:.1}" font-size="{size}" transform="rotate(-90 {x:.1} {y:.1})" fill="{color}">{text}</text>"#
        ));
    }

    /// The document.
    #[must_use]
    pub fn finished(mut self) -> String {
        self.text.push_str("</svg>\n");
        self.text
    }

    fn element(&mut self, element: std::fmt::Arguments<'_>) {
        self.text.write_fmt(element).expect("memory takes any text");
        self.text.push('\n');
    }
}

/// The opening of a document of `width` x `height` px, drawn in `fine` units to
/// a px.
#[must_use]
pub fn opening(width: u32, height: u32, fine: u32) -> String {
    let (w, h) = (width * fine, height * fine);
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
         viewBox=\"0 0 {w} {h}\" font-family=\"{FONTS}\">\n"
    )
}

/// The width of `text` in px, roughly, for one of the wider fonts: there is none
/// that a page is sure to find.
#[must_use]
pub fn estimated_width(text: &str, size: f64) -> f64 {
    let em = |c: char| match c {
        'i' | 'j' | 'l' | 'I' | '.' | ',' | ':' | ';' | '\'' | '|' | '!' => 0.32,
        'f' | 't' | 'r' | '(' | ')' | ' ' | '-' => 0.4,
        'm' | 'w' | 'M' | 'W' | '%' => 0.9,
        c if c.is_uppercase() => 0.7,
        c if (c as u32) > 0x2e80 => 1.0,
        _ => 0.62,
    };
    size * text.chars().map(em).sum::<f64>()
}

/// `text` cut to a width in px, three points where something is missing.
#[must_use]
pub fn shortened(text: &str, size: f64, width: f64) -> String {
    if estimated_width(text, size) <= width {
        return text.to_owned();
    }
    let mut kept: String = text.to_owned();
    while kept.pop().is_some() && estimated_width(&kept, size) > width - size {}
    kept.trim_end().to_owned() + "\u{2026}"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn markup_in_names_stays_text() {
        assert_eq!(escaped("<b>&\"'\u{7}"), "&lt;b&gt;&amp;&quot;&apos; ");
        let mut canvas = Canvas::new(10, 10);
        canvas.text((1.0, 1.0), 10.0, Anchor::Start, crate::style::INK, "</text><b>");
        let drawn = canvas.finished();
        assert!(drawn.contains("&lt;/text&gt;&lt;b&gt;</text>"), "{drawn}");
    }

    #[test]
    fn long_names_are_cut_to_their_room() {
        assert_eq!(shortened("short", 10.0, 100.0), "short");
        let cut = shortened("a very long name of a pigment", 10.0, 60.0);
        assert!(cut.ends_with('\u{2026}') && cut.starts_with("a very"), "{cut}");
        assert!(estimated_width(&cut, 10.0) <= 60.0, "{cut}");
    }
}
