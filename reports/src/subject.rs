//! The subject of a report (library, viewing, measurements), and the sections that we draw from it.

use calibrate::comparison::{ComparedFilm, Comparison};
use calibrate::evaluate::Viewing;
use calibrate::library::{AmountKind, PigmentLibrary};
use calibrate::palette::Cards;
use calibrate::quadrature::QuadratureTrial;
use calibrate::validation::Validation;
use calibrate::{PigmentId, Recipe};
use spectra::{InterpolateError, TristimulusWeights};

use crate::figure::{Drawing, Figure, Table, Words};
use crate::style::Color;

/// The input of a report: a library, the viewing condition, and its comparison with
/// measurements.
#[derive(Debug)]
pub struct Subject<'a> {
    /// The library to be drawn.
    pub library: &'a PigmentLibrary,
    /// Light and observer for all colours and colour errors.
    pub viewing: &'a Viewing,
    /// Tristimulus weights of `viewing` on the library's grid.
    pub weights: TristimulusWeights,
    /// The command line that makes the report. We print it with each figure.
    pub command: String,
    /// Measured and predicted films, or `None` without measurements.
    pub comparison: Option<Comparison>,
    /// Leave-one-out validation of mixtures, or `None` if you do not want it or it is not possible.
    pub validation: Option<Validation>,
    /// Black and white card under the films.
    pub cards: Cards,
    /// Quadratures of a few wavelengths for `viewing`, by method and number of wavelengths.
    pub quadratures: Vec<QuadratureTrial>,
    /// The pigments of the graded mixture. If this is `None`, we choose pairs from the library.
    pub pair: Option<(PigmentId, PigmentId)>,
}

/// One section of the page.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Section {
    /// Heading of the section.
    pub title: String,
    /// Paragraphs before the figures.
    pub paragraphs: Vec<String>,
    /// Figures and tables in the order of the page.
    pub parts: Vec<Part>,
}

/// One figure or table of a section.
#[derive(Debug, Clone, PartialEq)]
pub enum Part {
    /// A figure with its caption.
    Figure(Box<Figure>),
    /// A table and its title.
    Table(String, Table),
}

impl Section {
    /// A section with only a heading.
    #[must_use]
    pub fn new(title: &str) -> Self {
        Self { title: title.to_owned(), ..Self::default() }
    }

    /// Adds a paragraph.
    #[must_use]
    pub fn with_paragraph(mut self, text: impl Into<String>) -> Self {
        self.paragraphs.push(text.into());
        self
    }

    /// Adds a figure.
    #[must_use]
    pub fn with_figure(mut self, figure: Figure) -> Self {
        self.parts.push(Part::Figure(Box::new(figure)));
        self
    }

    /// Adds a table.
    #[must_use]
    pub fn with_table(mut self, title: &str, table: Table) -> Self {
        self.parts.push(Part::Table(title.to_owned(), table));
        self
    }

    /// The figures of the section, in order.
    pub fn figures(&self) -> impl Iterator<Item = &Figure> {
        self.parts.iter().filter_map(|part| match part {
            Part::Figure(figure) => Some(figure.as_ref()),
            Part::Table(..) => None,
        })
    }

    /// Whether the section has neither paragraphs nor figures nor tables.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.paragraphs.is_empty() && self.parts.is_empty()
    }
}

impl<'a> Subject<'a> {
    /// A report on a library alone, without measurements. We print `command` with each figure.
    pub fn of_library(
        library: &'a PigmentLibrary,
        viewing: &'a Viewing,
        command: impl Into<String>,
    ) -> Result<Self, InterpolateError> {
        Ok(Self {
            library,
            viewing,
            weights: viewing.weights(library.grid)?,
            command: command.into(),
            comparison: None,
            validation: None,
            cards: Cards::standard(library.grid),
            quadratures: Vec::new(),
            pair: None,
        })
    }
}

impl Subject<'_> {
    /// Makes a figure with the command line of this report.
    ///
    /// # Panics
    /// If you cannot use the name for a file (see [`Figure::new`]).
    #[must_use]
    pub fn figure(&self, words: Words<'_>, drawing: Drawing, data: Table) -> Figure {
        Figure::new(words, &self.command, drawing, data)
    }

    /// The colour of a reflectance on the library's grid, for a patch.
    #[must_use]
    pub fn color(&self, reflectance: &[f64]) -> Color {
        Color::from_xyz(self.weights.xyz(reflectance), self.weights.white())
    }

    /// The masstone of a pigment (an opaque film), for a patch.
    ///
    /// # Panics
    /// If the library has no pigment of this index.
    #[must_use]
    pub fn masstone(&self, pigment: PigmentId) -> Color {
        let mixture = self.library.mix([(pigment, 1.0)]).expect("one part makes a mixture");
        self.color(&mixture.hiding(self.library.saunderson))
    }

    /// A pigment's name, followed by its mark ([`Subject::mark`]) in brackets if it has one.
    #[must_use]
    pub fn label(&self, pigment: PigmentId) -> String {
        let name = &self.library[pigment].name;
        self.mark(pigment).map_or_else(|| name.clone(), |mark| format!("{name} ({mark})"))
    }

    /// Why a pigment's K and S are not measured: `guessed` from a colour, or `S unknown`. `None`
    /// if both are measured.
    #[must_use]
    pub fn mark(&self, pigment: PigmentId) -> Option<&'static str> {
        let pigment = &self.library[pigment];
        match (pigment.guessed, pigment.identified) {
            (true, _) => Some("guessed"),
            (_, false) => Some("S unknown"),
            _ => None,
        }
    }

    /// A sample's name, with a star if its recipe has a pigment without measured K and S.
    #[must_use]
    pub fn sample(&self, film: &ComparedFilm) -> String {
        format!("{}{}", film.sample, if film.unsure { "*" } else { "" })
    }

    /// A recipe as text: percentages if the library has relative amounts, otherwise the amounts.
    #[must_use]
    pub fn recipe(&self, recipe: &Recipe) -> String {
        let absolute = self.library.amounts == AmountKind::Absolute;
        recipe
            .iter()
            .map(|&(pigment, amount): &(PigmentId, f64)| {
                let label = self.label(pigment);
                match (recipe.len(), absolute) {
                    (1, false) => label,
                    (_, false) => format!("{} % {label}", short(100.0 * amount)),
                    (_, true) => format!("{} {label}", short(amount)),
                }
            })
            .collect::<Vec<_>>()
            .join(" + ")
    }

    /// Name and recipe of each compared sample that `text` names, in the order of the text. This
    /// passes over a name that is a number, because texts have numbers of other things.
    pub(crate) fn named_recipes(&self, text: &str) -> Vec<(String, String)> {
        let mut named: Vec<(usize, String, String)> = Vec::new();
        for film in self.comparison.iter().flat_map(|comparison| &comparison.films) {
            let name = film.sample.as_str();
            if let Some(at) = word_at(text, name).filter(|_| name.parse::<f64>().is_err()) {
                named.push((at, name.to_owned(), self.recipe(&film.recipe)));
            }
        }
        named.sort();
        named.into_iter().map(|(_, name, recipe)| (name, recipe)).collect()
    }

    /// The unit of K and S, as text.
    #[must_use]
    pub fn unit(&self) -> String {
        match (&self.library.reference, self.library.amounts) {
            (Some(white), AmountKind::Relative) => format!("S of {white} = 1"),
            (None, AmountKind::Relative) => "relative".to_owned(),
            (_, AmountKind::Absolute) => "per unit of amount".to_owned(),
        }
    }

    /// Light and observer as text.
    #[must_use]
    pub fn light(&self) -> String {
        format!("{}, observer {}", self.viewing.illuminant.name(), self.viewing.observer)
    }
}

/// Where `text` has `word` as a whole word.
fn word_at(text: &str, word: &str) -> Option<usize> {
    let mut places = text.match_indices(word).map(|(at, _)| at);
    places.find(|at| {
        ends(text[..*at].chars().next_back()) && ends(text[at + word.len()..].chars().next())
    })
}

fn ends(c: Option<char>) -> bool {
    c.is_none_or(|c| !c.is_alphanumeric())
}

fn short(value: f64) -> f64 {
    format!("{value:.2e}").parse().unwrap_or(value)
}
