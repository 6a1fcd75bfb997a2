//! SVG elements, with escaped text.

use std::fmt::Write;

use crate::lettering::fitted;
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

/// An SVG drawing of rectangles, lines and text, for figures that are not charts.
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

    /// Draws a line of text, vertically centred at `at`; `size` is the font size in px.
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

    /// Draws a name that reads upwards and starts at `at`, in the middle of its lines; `space` is its
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

/// The opening tag of a document of `width` x `height` px, whose view box has `fine` units per
/// px. A rim of paper around letters keeps them readable over colours.
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
}
