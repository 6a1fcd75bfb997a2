//! Paints and recipes of a plan, the empty measurement file that you fill in, and reasons why a plan is
//! impossible.

use documents::{Cancelled, hint::Explain, spreadsheet_cell};
use pigment::{PigmentId, Recipe, RecipeError};
use spectra::Grid;

use crate::measurement::names_a_pigment;

/// The paints that you measure: the white, the colours, the black.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PaintSet {
    /// Names of all paints: the white, the colours in their given order, the black.
    pub names: Vec<String>,
    /// Index of the black, if there is one.
    pub black: Option<PigmentId>,
}

impl PaintSet {
    /// Index of the white, with S = 1.
    pub const WHITE: PigmentId = PigmentId(0);

    /// Collects the paints. You may name white and black among the colours too.
    ///
    /// # Errors
    /// [`PlanError::Name`] for a name that a column of a measurement file cannot have,
    /// [`PlanError::Twice`] for one given twice, [`PlanError::NoColor`] for a white alone.
    pub fn new(colors: &[String], white: &str, black: Option<&str>) -> Result<Self, PlanError> {
        let mut names = vec![white.to_owned()];
        let others = colors.iter().filter(|name| *name != white && Some(name.as_str()) != black);
        names.extend(others.cloned());
        names.extend(black.map(str::to_owned));
        for (index, name) in names.iter().enumerate() {
            if !names_a_pigment(name) {
                return Err(PlanError::Name(name.clone()));
            }
            if names[..index].contains(name) {
                return Err(PlanError::Twice(name.clone()));
            }
        }
        if names.len() < 2 {
            return Err(PlanError::NoColor);
        }
        let black = black.map(|_| PigmentId(names.len() - 1));
        Ok(Self { names, black })
    }

    /// Indices of all paints.
    pub fn ids(&self) -> impl Iterator<Item = PigmentId> + Clone + use<> {
        (0..self.names.len()).map(PigmentId)
    }

    /// Indices of all paints but white and black.
    pub fn colors(&self) -> impl Iterator<Item = PigmentId> + Clone + use<> {
        let end = self.black.map_or(self.names.len(), PigmentId::index);
        (1..end).map(PigmentId)
    }

    /// Name of one paint.
    ///
    /// # Panics
    /// If `paint` belongs to a larger set.
    #[must_use]
    pub fn name(&self, paint: PigmentId) -> &str {
        &self.names[paint.index()]
    }

    /// Number of unknowns per wavelength: K of every paint, and S of all but the white. You need at least
    /// this many swatches.
    #[must_use]
    pub fn unknowns(&self) -> usize {
        2 * self.names.len() - 1
    }
}

/// Paints of a planned swatch with their parts.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SwatchRecipe {
    /// Reason why the swatch is in the plan.
    pub purpose: Purpose,
    /// Paints of the set with their parts, 1 and up.
    pub parts: Vec<(PigmentId, u32)>,
}

/// Reason why a swatch is in the plan.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Purpose {
    /// One paint by itself.
    Masstone,
    /// One paint lightened with the white.
    Tint,
    /// One colour darkened with the black.
    Shade,
    /// Two colours mixed.
    Cross,
    /// Two colours lightened with the white.
    CrossTint,
}

impl SwatchRecipe {
    /// Paints with their shares, sum 1.
    #[must_use]
    pub fn shares(&self) -> Recipe {
        let total = f64::from(self.total());
        self.parts.iter().map(|&(paint, parts)| (paint, f64::from(parts) / total)).collect()
    }

    /// Smallest share of any paint.
    #[must_use]
    pub fn least_share(&self) -> f64 {
        self.shares().iter().map(|(_, share)| *share).fold(1.0, f64::min)
    }

    /// Sum of all parts.
    #[must_use]
    pub fn total(&self) -> u32 {
        self.parts.iter().map(|(_, parts)| parts).sum()
    }

    /// Name of the recipe, such as `Cobalt Blue tint 1:4`.
    #[must_use]
    pub fn name(&self, paints: &PaintSet) -> String {
        let names: Vec<&str> = self.parts.iter().map(|(paint, _)| paints.name(*paint)).collect();
        let ratio: Vec<String> = self.parts.iter().map(|(_, parts)| parts.to_string()).collect();
        let ratio = ratio.join(":");
        match self.purpose {
            Purpose::Masstone => format!("{} masstone", names[0]),
            Purpose::Tint => format!("{} tint {ratio}", names[0]),
            Purpose::Shade => format!("{} shade {ratio}", names[0]),
            Purpose::Cross => format!("{} x {} {ratio}", names[0], names[1]),
            Purpose::CrossTint => format!("{} x {} tint {ratio}", names[0], names[1]),
        }
    }
}

impl Purpose {
    /// Purpose in a word or two.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Masstone => "masstone",
            Self::Tint => "tint",
            Self::Shade => "shade",
            Self::Cross => "cross",
            Self::CrossTint => "cross tint",
        }
    }

    /// Information that you get from this swatch, in a few words.
    #[must_use]
    pub fn why(self) -> &'static str {
        match self {
            Self::Masstone => "K/S of the paint itself",
            Self::Tint => "ties K and S to the white's S",
            Self::Shade => "S against a known K",
            Self::Cross => "K of one against S of the other; checks the mixing",
            Self::CrossTint => "two colours where both show; checks the mixing",
        }
    }
}

/// You lay every film on these cards, and read them bare.
const BACKINGS: [&str; 2] = ["white", "black"];

/// Layout of the empty measurement file.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeasurementForm {
    /// Wavelengths of the columns.
    pub grid: Grid,
    /// Number of readings of each film and card, 1 to 100.
    pub replicates: usize,
}

impl Default for MeasurementForm {
    /// 400 to 700 nm in steps of 10 nm, two readings each.
    fn default() -> Self {
        Self { grid: Grid::from_nm(400.0, 10.0, 31).expect("a regular grid"), replicates: 2 }
    }
}

impl MeasurementForm {
    /// Writes the file: the bare cards, then every swatch over both cards, with the grams of each paint
    /// and empty cells for the readings. `swatches` are names with their grams.
    pub(super) fn csv<'a>(
        &self,
        paints: &PaintSet,
        swatches: impl IntoIterator<Item = (&'a str, &'a Recipe)>,
    ) -> Vec<u8> {
        let wavelengths = self.grid.wavelengths_nm().map(|nm| nm.to_string());
        self.rows("replicate", paints, swatches, &wavelengths.collect::<Vec<_>>(), |row| {
            row.replicate.to_string()
        })
    }

    /// Writes the recipes without readings: one row for each reading of [`Self::csv`], with the name that
    /// you give it in the program of the instrument.
    pub(super) fn recipes<'a>(
        &self,
        paints: &PaintSet,
        swatches: impl IntoIterator<Item = (&'a str, &'a Recipe)>,
    ) -> Vec<u8> {
        self.rows("reading", paints, swatches, &[], |row| {
            // The number of a sample is enough to type.
            let short = row.sample.split(' ').next().unwrap_or(row.sample);
            let name = format!("{short} {}", row.backing);
            if self.replicates == 1 { name } else { format!("{name} {}", row.replicate) }
        })
    }

    fn rows<'a>(
        &self,
        fourth: &str,
        paints: &PaintSet,
        swatches: impl IntoIterator<Item = (&'a str, &'a Recipe)>,
        wavelengths: &[String],
        fourth_of: impl Fn(FormRow<'_>) -> String,
    ) -> Vec<u8> {
        let mut writer = csv::Writer::from_writer(Vec::new());
        let mut write = |record: Vec<String>| {
            let cells = record.iter().map(|cell| spreadsheet_cell(cell).into_owned());
            writer.write_record(cells).expect("rows have one length, and memory can be written");
        };
        let fixed = ["sample", "film", "backing", fourth].map(str::to_owned);
        let names = paints.names.iter().chain(wavelengths).cloned();
        write(fixed.into_iter().chain(names).collect());
        let card = Recipe::default();
        let films = std::iter::once(("card", "none", &card))
            .chain(swatches.into_iter().map(|(sample, grams)| (sample, "paint", grams)));
        for (sample, film, grams) in films {
            for backing in BACKINGS {
                for replicate in 1..=self.replicates {
                    let mut row = vec![String::new(); 4 + paints.names.len() + wavelengths.len()];
                    row[0] = sample.to_owned();
                    row[1] = film.to_owned();
                    row[2] = backing.to_owned();
                    row[3] = fourth_of(FormRow { sample, backing, replicate });
                    for (paint, grams) in grams {
                        row[4 + paint.index()] = grams.to_string();
                    }
                    write(row);
                }
            }
        }
        writer.into_inner().expect("memory can be written")
    }
}

/// One reading of a form.
#[derive(Clone, Copy)]
struct FormRow<'a> {
    sample: &'a str,
    backing: &'a str,
    replicate: usize,
}

/// A plan that cannot be made.
#[derive(Debug, Clone, PartialEq, thiserror::Error, Explain)]
#[fault(Setting)]
pub enum PlanError {
    /// A name cannot head a pigment's column of a measurement file.
    #[error("in a measurement file this heading would not be read as a pigment: `{0}`")]
    #[hint(
        "use a word that is none of the file's own columns (sample, film, backing, thickness_mm, replicate) and no number"
    )]
    Name(String),
    /// Two paints have one name.
    #[error("each paint is named once, found twice `{0}`")]
    #[hint("remove one, or give the second paint another name")]
    Twice(String),
    /// There is no paint besides the white.
    #[error("a plan needs a pigment beside the white")]
    #[hint("name the pigments: impasto plan \"Cobalt Blue\" [white=\"Titanium White\"]")]
    NoColor,
    /// The number of swatches is out of range.
    #[error("{paints} paints are planned with {least} to {most} swatches, found `{swatches}`")]
    #[hint(
        if swatches < least,
        "try [swatches={least}] or more; K of every paint and S of all but the white are unknown"
    )]
    #[hint("try [swatches={most}] or fewer; [replicates] repeat one swatch")]
    Swatches {
        /// Number of paints.
        paints: usize,
        /// Least number of swatches: one for each unknown of a wavelength.
        least: usize,
        /// Greatest number of swatches: every recipe that can be weighed.
        most: usize,
        /// Number of swatches that was requested.
        swatches: usize,
    },
    /// The number of swatches is given twice, as a number and as a time.
    #[error("a number of swatches and a time for them exclude each other")]
    #[hint("leave out [swatches] or [minutes]")]
    CountAndTime,
    /// The time is not enough for as many swatches as there are unknowns.
    #[error(
        "{least} swatches, the fewest for these paints, take {needed} minutes at {each} minutes each, found `{minutes}`"
    )]
    #[hint("try [minutes={needed}], or plan for fewer pigments")]
    Time {
        /// Least number of swatches: one for each unknown of a wavelength.
        least: usize,
        /// Minutes that they take.
        needed: f64,
        /// Minutes for one swatch.
        each: f64,
        /// Minutes that were requested.
        minutes: f64,
    },
    /// The mass of a swatch is too small for the balance: a tint of 1 to 4 cannot be weighed.
    #[error(
        "a tint of 1 to 4 needs {needed} g a swatch on a balance that shows {resolution} g, found `{grams}`"
    )]
    #[hint("try [grams={needed}], or a finer [balance]")]
    Grams {
        /// Least mass of a swatch in grams.
        needed: f64,
        /// Step of the balance in grams.
        resolution: f64,
        /// Mass of a swatch that was requested, in grams.
        grams: f64,
    },
    /// A number is not above 0.
    #[error("{what} must be above 0 and finite, found `{value}`")]
    #[hint("{example}")]
    NotPositive {
        /// Name of the quantity.
        what: &'static str,
        /// Hint with possible values.
        example: &'static str,
        /// Value that was given.
        value: f64,
    },
    /// Expected errors are out of range.
    #[error(
        "expected noise is two errors from 0 to below 1, one of them above 0, found `{constant}` and `{even}`"
    )]
    #[hint("try 0.002 of the instrument and 0.01 of weighing and mixing")]
    Noise {
        /// Error of the instrument that was given.
        constant: f64,
        /// Error of weighing and mixing that was given.
        even: f64,
    },
    /// The swatches would not identify every pigment.
    #[error("these swatches would not identify `{}`", .0.join(", "))]
    #[hint("give more [swatches]")]
    #[fault(Input)]
    Unidentified(Vec<String>),
    /// A name does not denote one pigment of the prior library.
    #[error(transparent)]
    Prior(#[from] RecipeError),
    /// The search was cancelled.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}
