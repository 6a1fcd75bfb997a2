//! A figure: a drawing, its words and its numbers.

use crate::panel::Chart;
use crate::style::Color;
use crate::svg::{Canvas, escaped};
use crate::table::Table;

/// A figure of a report.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// The stem of its files and its anchor on the page: lower case, digits and
    /// hyphens.
    pub name: String,
    /// What it shows, in a few words.
    pub title: String,
    /// How to read it, in a sentence or two.
    pub caption: String,
    /// What can be seen, for those who cannot see it.
    pub alt: String,
    /// The command line that made it.
    pub command: String,
    /// The drawing.
    pub svg: String,
    /// Its numbers, so that others can draw them.
    pub data: Table,
}

/// What is drawn: axes with curves, or patches and words.
#[derive(Debug, Clone)]
pub enum Drawing {
    /// Panels.
    Chart(Chart),
    /// Patches.
    Canvas(Canvas),
}

/// The words of a figure.
#[derive(Debug, Clone, Copy)]
pub struct Words<'a> {
    /// See [`Figure::name`].
    pub name: &'a str,
    /// See [`Figure::title`].
    pub title: &'a str,
    /// See [`Figure::caption`].
    pub caption: &'a str,
    /// See [`Figure::alt`].
    pub alt: &'a str,
}

impl Figure {
    /// A figure made by `command`.
    ///
    /// # Panics
    /// If the name is none for a file.
    #[must_use]
    pub fn new(words: Words<'_>, command: &str, drawing: Drawing, data: Table) -> Self {
        let plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
        let named = !words.name.is_empty() && words.name.chars().all(plain);
        assert!(named, "a figure's name is lower case, found `{}`", words.name);
        let drawn = match drawing {
            Drawing::Chart(chart) => chart.svg(),
            Drawing::Canvas(canvas) => canvas.finished(),
        };
        let told = format!(
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
            svg: drawn.replacen('>', &told, 1),
            data,
        }
    }

    /// The colours of its strokes, dots, areas and words; not those of patches,
    /// which are `rect` elements and mean just the colour they have.
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
