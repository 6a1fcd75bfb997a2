//! A figure: drawing, title, caption and the data behind it.

use crate::panel::Chart;
use crate::style::Color;
use crate::svg::{Canvas, escaped};
use crate::table::Table;

/// A figure of a report.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// Stem of the figure's files and its anchor on the page: lower-case letters, digits and
    /// hyphens.
    pub name: String,
    /// Title, a few words without a full stop.
    pub title: String,
    /// Caption: one or two sentences on how to read the figure.
    pub caption: String,
    /// Alternative text for readers who cannot see the figure.
    pub alt: String,
    /// The command line that made the figure.
    pub command: String,
    /// The drawing as an SVG document.
    pub svg: String,
    /// The plotted numbers, so that others can draw them.
    pub data: Table,
}

/// The drawing of a figure.
#[derive(Debug, Clone)]
pub enum Drawing {
    /// Panels with axes and marks.
    Chart(Chart),
    /// Free drawing of patches and text.
    Canvas(Canvas),
}

/// The texts of a figure; see the fields of [`Figure`].
#[derive(Debug, Clone, Copy)]
pub struct Words<'a> {
    /// File stem and anchor ([`Figure::name`]).
    pub name: &'a str,
    /// Title, a few words.
    pub title: &'a str,
    /// Caption, one or two sentences.
    pub caption: &'a str,
    /// Alternative text for readers who cannot see the figure.
    pub alt: &'a str,
}

impl Figure {
    /// Renders `drawing` and joins it with its texts and data. `command` is the command line
    /// that made the figure; the SVG names it in its description.
    ///
    /// # Panics
    /// If the name is empty or has other characters than lower-case letters, digits and hyphens.
    #[must_use]
    pub fn new(words: Words<'_>, command: &str, drawing: Drawing, data: Table) -> Self {
        let named = !words.name.is_empty()
            && words
                .name
                .chars()
                .all(|c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-');
        assert!(
            named,
            "a figure's name has lower-case letters, digits and hyphens only, found `{}`",
            words.name
        );
        let svg = match drawing {
            Drawing::Chart(chart) => chart.svg(),
            Drawing::Canvas(canvas) => canvas.into_svg(),
        };
        let description = format!(
            " role=\"img\" aria-label=\"{}\">\n<desc>{}. {} Made by: {}</desc>",
            escaped(words.alt),
            escaped(words.title),
            escaped(words.caption),
            escaped(command)
        );
        Self {
            name: words.name.to_owned(),
            title: words.title.to_owned(),
            caption: words.caption.to_owned(),
            alt: words.alt.to_owned(),
            command: command.to_owned(),
            svg: svg.replacen('>', &description, 1),
            data,
        }
    }

    /// The colours of lines, dots, areas and text, sorted and without repeats. The colours of
    /// patches (`rect` elements) are left out: a dark page must not change them.
    #[must_use]
    pub fn line_colors(&self) -> Vec<Color> {
        let mut found = Vec::new();
        let elements = self.svg.lines().filter(|line| line.starts_with('<'));
        for element in elements.filter(|line| !line.starts_with("<rect")) {
            for attribute in ["fill=\"#", "stroke=\"#"] {
                let Some((_, rest)) = element.split_once(attribute) else { continue };
                let byte = |at: usize| u8::from_str_radix(rest.get(at..at + 2)?, 16).ok();
                if let (Some(r), Some(g), Some(b)) = (byte(0), byte(2), byte(4)) {
                    found.push(Color([r, g, b]));
                }
            }
        }
        found.sort_unstable();
        found.dedup();
        found
    }
}
