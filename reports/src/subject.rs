//! What a report is about, and what its sections are made of.

use calibrate::comparison::{ComparedFilm, Comparison};
use calibrate::evaluate::Viewing;
use calibrate::library::{AmountKind, PigmentLibrary};
use calibrate::palette::Cards;
use calibrate::quadrature::QuadratureTrial;
use calibrate::validation::Validation;
use spectra::TristimulusWeights;

use crate::figure::{Drawing, Figure, Words};
use crate::style::Color;
use crate::table::Table;

/// A library, how it is looked at, and what its measurements say of it.
#[derive(Debug)]
pub struct Subject<'a> {
    /// The library.
    pub library: &'a PigmentLibrary,
    /// Light and observer of all colours and colour errors.
    pub viewing: &'a Viewing,
    /// Weights of that light on the library's grid.
    pub weights: TristimulusWeights,
    /// The command line that makes this report.
    pub command: String,
    /// Measured against predicted films; none without measurements.
    pub comparison: Option<Comparison>,
    /// Mixtures predicted unseen; none if not asked for, or not possible.
    pub validation: Option<Validation>,
    /// The black and the white card that films lie on.
    pub cards: Cards,
    /// Ways to choose a few wavelengths for that light, by method and number.
    pub quadratures: Vec<QuadratureTrial>,
    /// The two pigments of figures about a pair, chosen by the user.
    pub pair: Option<(usize, usize)>,
}

/// A part of the page under one heading.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Section {
    /// Its heading.
    pub title: String,
    /// Words before the figures, a paragraph each.
    pub words: Vec<String>,
    /// Figures and tables in order.
    pub parts: Vec<Part>,
}

/// A figure or a table.
#[derive(Debug, Clone, PartialEq)]
pub enum Part {
    /// A figure.
    Figure(Box<Figure>),
    /// A table, with its title.
    Table(String, Table),
}

impl Section {
    /// A section without words and parts.
    #[must_use]
    pub fn new(title: &str) -> Self {
        Self { title: title.to_owned(), ..Self::default() }
    }

    /// The same with one more paragraph.
    #[must_use]
    pub fn saying(mut self, words: impl Into<String>) -> Self {
        self.words.push(words.into());
        self
    }

    /// The same with one more figure.
    #[must_use]
    pub fn with(mut self, figure: Figure) -> Self {
        self.parts.push(Part::Figure(Box::new(figure)));
        self
    }

    /// The same with one more table.
    #[must_use]
    pub fn with_table(mut self, title: &str, table: Table) -> Self {
        self.parts.push(Part::Table(title.to_owned(), table));
        self
    }

    /// Its figures.
    pub fn figures(&self) -> impl Iterator<Item = &Figure> {
        self.parts.iter().filter_map(|part| match part {
            Part::Figure(figure) => Some(figure.as_ref()),
            Part::Table(..) => None,
        })
    }

    /// Whether there is nothing to show.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.words.is_empty() && self.parts.is_empty()
    }
}

impl Subject<'_> {
    /// A figure of this report.
    ///
    /// # Panics
    /// As [`Figure::new`].
    #[must_use]
    pub fn figure(&self, words: Words<'_>, drawing: Drawing, data: Table) -> Figure {
        Figure::new(words, &self.command, drawing, data)
    }

    /// The colour of a reflectance on the library's grid, as a patch.
    #[must_use]
    pub fn color(&self, reflectance: &[f64]) -> Color {
        Color::of(self.weights.xyz(reflectance), self.weights.white())
    }

    /// The masstone of a pigment in a film that hides, as a patch.
    ///
    /// # Panics
    /// If the library has no such pigment.
    #[must_use]
    pub fn masstone(&self, pigment: usize) -> Color {
        let mixture = self.library.mix(&[(pigment, 1.0)]).expect("one part makes a mixture");
        self.color(&mixture.hiding(self.library.saunderson))
    }

    /// A pigment's name, marked where its K and S are no measurement.
    #[must_use]
    pub fn label(&self, pigment: usize) -> String {
        let name = &self.library.pigments[pigment].name;
        self.mark(pigment).map_or_else(|| name.clone(), |mark| format!("{name} ({mark})"))
    }

    /// Why a pigment's K and S are no measurement; nothing if they are one.
    #[must_use]
    pub fn mark(&self, pigment: usize) -> Option<&'static str> {
        let pigment = &self.library.pigments[pigment];
        match (pigment.guessed, pigment.identified) {
            (true, _) => Some("guessed"),
            (_, false) => Some("S unknown"),
            _ => None,
        }
    }

    /// A sample's name, with a star where its recipe holds a pigment whose K and
    /// S are no measurement.
    #[must_use]
    pub fn sample(&self, film: &ComparedFilm) -> String {
        format!("{}{}", film.sample, if film.unsure { "*" } else { "" })
    }

    /// A recipe in words: percent of shares, or amounts as they are.
    #[must_use]
    pub fn recipe(&self, recipe: &[(usize, f64)]) -> String {
        let absolute = self.library.amounts == AmountKind::Absolute;
        let part = |&(pigment, amount): &(usize, f64)| {
            let label = self.label(pigment);
            match (recipe.len(), absolute) {
                (1, false) => label,
                (_, false) => format!("{} % {label}", short(100.0 * amount)),
                (_, true) => format!("{} {label}", short(amount)),
            }
        };
        recipe.iter().map(part).collect::<Vec<_>>().join(" + ")
    }

    /// The unit of K and S.
    #[must_use]
    pub fn unit(&self) -> String {
        match (&self.library.reference, self.library.amounts) {
            (Some(white), AmountKind::Relative) => format!("S of {white} = 1"),
            (None, AmountKind::Relative) => "relative".to_owned(),
            (_, AmountKind::Absolute) => "per unit of amount".to_owned(),
        }
    }

    /// Light and observer in words.
    #[must_use]
    pub fn light(&self) -> String {
        format!("{}, observer {}", self.viewing.illuminant.name(), self.viewing.observer)
    }
}

/// A number to three significant digits.
fn short(value: f64) -> f64 {
    format!("{value:.2e}").parse().unwrap_or(value)
}
