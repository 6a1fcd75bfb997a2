//! Limits of recipes: the pigments, by their indices in a library, and the film that a recipe makes. You
//! also find here the reasons why there are no recipes.

use documents::{Cancelled, hint::Explain};
use spectra::InterpolateError;

use super::target::{Metric, ViewingCondition};
use crate::color::{BackingError, THICKEST};
use crate::evaluate::BandError;
use crate::least_squares::MAX_PIGMENTS;
use crate::library::{AmountKind, PigmentLibrary, RecipeError};
use crate::recipe::PigmentId;

/// Greatest weight of a viewing condition.
const LARGEST_WEIGHT: f64 = 1e9;
/// Range of whole parts of one recipe.
const WHOLE_PARTS: std::ops::RangeInclusive<u32> = 1..=1000;
/// Range of K d + S d of the usual wash, averaged over pigments and wavelengths: from nearly clear to
/// nearly hiding. We chose it by eye.
const USUAL_WASH: [f64; 2] = [0.01, 10.0];

/// Recipes within this CIEDE2000 are equally near, if we know nothing about the library's own error.
pub const USUAL_TOLERANCE: f64 = 0.05;

/// Recipes within this root mean square in percent of reflectance are equally near by spectrum. We chose it
/// by eye.
pub const USUAL_SPECTRUM_TOLERANCE: f64 = 0.2;

/// A pigment that every recipe must contain.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RequiredPigment {
    /// Pigment of the library.
    pub pigment: PigmentId,
    /// Fixed share of the whole, above 0 and up to 1. `None` if the search chooses it.
    pub share: Option<f64>,
}

/// Limits of the recipes that you search. You give pigments by their indices in a library.
///
/// Use [`MatchRequest`](super::MatchRequest) to state this by name.
#[derive(Debug, Clone, PartialEq)]
pub struct RecipeLimits {
    /// Lights under which recipes are judged, at least one.
    pub conditions: Vec<ViewingCondition>,
    /// Measure of the difference from the target.
    pub metric: Metric,
    /// Film that the recipe will make.
    pub film: FilmKind,
    /// Pigments that may take part.
    pub allowed: Vec<PigmentId>,
    /// Pigments that must take part. Each must also be allowed.
    pub required: Vec<RequiredPigment>,
    /// Most pigments of one recipe, 1 to 8.
    pub at_most: usize,
    /// Least share of a pigment that takes part, 0 to below 1. It is the smallest share that you can weigh
    /// or cut off with a knife.
    pub least_share: f64,
    /// Most parts of a recipe in whole parts, 1 to 1000. `None` for shares of any size.
    pub whole_parts: Option<u32>,
    /// Least and greatest absolute amount of each pigment of the library, above 0. `None` for any amount.
    /// Empty for no limits. If you fix a share, it has no limit.
    pub amounts: Vec<Option<[f64; 2]>>,
    /// Price of one unit of amount by pigment of the library, 0 and up, empty if unknown.
    pub costs: Vec<f64>,
    /// Recipes count as equally near if their distance exceeds the nearest one's by no more than this. 0 to
    /// 1000, in the unit of the metric.
    pub tolerance: f64,
    /// Number of recipes to return.
    pub count: usize,
}

impl RecipeLimits {
    /// Limits with the [usual pigments](PigmentLibrary::usual_pigments) of `library`, up to four in a
    /// recipe, shares from 1/50, amounts as they were measured, and five recipes.
    #[must_use]
    pub fn new(
        library: &PigmentLibrary,
        conditions: Vec<ViewingCondition>,
        film: FilmKind,
    ) -> Self {
        Self {
            conditions,
            metric: Metric::default(),
            film,
            allowed: library.usual_pigments(),
            required: Vec::new(),
            at_most: 4,
            least_share: 0.02,
            whole_parts: None,
            amounts: measured_amounts(library),
            costs: Vec::new(),
            tolerance: USUAL_TOLERANCE,
            count: 5,
        }
    }

    /// Least and greatest thickness. 1 for a film that hides.
    pub(super) fn thickness(&self) -> (f64, f64) {
        match &self.film {
            FilmKind::Hiding => (1.0, 1.0),
            FilmKind::Over { thickness, .. } => thickness.bounds(),
        }
    }

    /// Fixed share of a pigment. `None` if the search chooses it.
    fn fixed_share(&self, pigment: PigmentId) -> Option<f64> {
        self.required.iter().find(|required| required.pigment == pigment)?.share
    }

    /// Least and greatest share of a pigment that takes part, whatever its amount.
    pub(super) fn share_bounds(&self, pigment: PigmentId) -> (f64, f64) {
        let fixed = self.fixed_share(pigment);
        fixed.map_or((self.least_share, 1.0), |share| (share, share))
    }

    /// Least and greatest absolute amount of a pigment. `None` for any.
    pub(super) fn amount_bounds(&self, pigment: PigmentId) -> Option<[f64; 2]> {
        let limits = self.amounts.get(pigment.index()).copied().flatten();
        limits.filter(|_| self.fixed_share(pigment).is_none())
    }

    /// Least and greatest share of a pigment that takes part in a film of this thickness, which is the sum
    /// of all absolute amounts. If the film allows no share, the least share is above the greatest.
    pub(super) fn share_bounds_at(&self, pigment: PigmentId, thickness: f64) -> (f64, f64) {
        let (least, most) = self.share_bounds(pigment);
        match self.amount_bounds(pigment) {
            None => (least, most),
            Some(amounts) => {
                let [fewest, greatest] = amounts.map(|amount| amount / thickness);
                (least.max(fewest), most.min(greatest))
            }
        }
    }

    /// # Errors
    /// [`MatchError`] if no recipe can keep the limits.
    pub(super) fn check(&self, library: &PigmentLibrary) -> Result<(), MatchError> {
        if self.allowed.is_empty() {
            return Err(MatchError::NoPigments);
        }
        if self.conditions.is_empty() {
            return Err(MatchError::NoLight);
        }
        if let Some(condition) =
            self.conditions.iter().find(|c| !(c.weight > 0.0 && c.weight < LARGEST_WEIGHT))
        {
            return invalid(
                "a light's weight must be above 0",
                condition.weight,
                "give the weight behind the light: [illuminant=D65] [illuminant=A=0.5]",
            );
        }
        if !(1..=MAX_PIGMENTS).contains(&self.at_most) {
            return invalid("a recipe has 1 to 8 pigments", self.at_most as f64, "try [at_most=4]");
        }
        if self.required.len() > self.at_most {
            return Err(MatchError::TooManyRequired {
                required: self.required.len(),
                at_most: self.at_most,
            });
        }
        if !(0.0..1.0).contains(&self.least_share) {
            return invalid(
                "the least share is 0 or more and below 1",
                self.least_share,
                "try [least=1/50]",
            );
        }
        if !(0.0..1e3).contains(&self.tolerance) {
            return invalid("the tolerance is 0 or more", self.tolerance, "try [tolerance=0.05]");
        }
        if let Some(cost) = self.costs.iter().find(|c| !(c.is_finite() && **c >= 0.0)) {
            return invalid("a cost is 0 or more", *cost, "try [cost=\"Cobalt Blue=0.9\"]");
        }
        let mut fixed = self.required.iter().filter_map(|required| required.share);
        let total: f64 = fixed.clone().sum();
        let all_fixed =
            !self.required.is_empty() && self.required.iter().all(|r| r.share.is_some());
        let whole = total > 1.0 + 1e-9 || (total > 1.0 - 1e-9 && !all_fixed);
        if whole || fixed.any(|share| !(share > 0.0 && share <= 1.0)) {
            return Err(MatchError::Shares(total));
        }
        if self.whole_parts.is_some() && total > 0.0 {
            return Err(MatchError::SharesInParts);
        }
        if self.whole_parts.is_some_and(|parts| !WHOLE_PARTS.contains(&parts)) {
            return invalid(
                "whole parts are 1 to 1000",
                f64::from(self.whole_parts.unwrap_or(0)),
                "try [parts=12]",
            );
        }
        let (thinnest, thickest) = self.thickness();
        if !(thinnest > 0.0 && thinnest <= thickest && thickest <= THICKEST) {
            return invalid("a thickness is above 0", thinnest, "try [thickness=1]");
        }
        let absolute = library.amounts == AmountKind::Absolute;
        if absolute && self.film == FilmKind::Hiding {
            return Err(MatchError::AbsoluteHiding);
        }
        Ok(())
    }

    /// Usual film of `library`. It hides its ground. For absolute amounts it is a wash over `ground` from
    /// nearly clear to nearly hiding: the mean of K + S over pigments and wavelengths, times the thickness,
    /// is 0.01 to 10.
    #[must_use]
    pub fn usual_film(library: &PigmentLibrary, ground: Vec<f64>) -> FilmKind {
        if library.amounts == AmountKind::Relative {
            return FilmKind::Hiding;
        }
        let curves = library.pigments.iter().flat_map(|p| p.absorption.iter().zip(&p.scattering));
        let count = (library.pigments.len() * library.grid.count()) as f64;
        let mean = (curves.map(|(k, s)| k + s).sum::<f64>() / count).max(1e-9);
        let [clear, hiding] = USUAL_WASH;
        FilmKind::Over { ground, thickness: Thickness::Between(clear / mean, hiding / mean) }
    }
}

fn invalid(what: &'static str, value: f64, hint: &'static str) -> Result<(), MatchError> {
    Err(MatchError::Number { what, value, hint })
}

/// Measured amounts of each pigment of a library of absolute amounts, empty for others.
fn measured_amounts(library: &PigmentLibrary) -> Vec<Option<[f64; 2]>> {
    match library.amounts {
        AmountKind::Relative => Vec::new(),
        AmountKind::Absolute => library.pigments.iter().map(|p| p.measured_amounts).collect(),
    }
}

/// Film that a recipe will make.
#[derive(Debug, Clone, PartialEq)]
pub enum FilmKind {
    /// So thick that its ground does not show.
    Hiding,
    /// A film over a ground.
    Over {
        /// Measured reflectance of the bare ground on the library's grid.
        ground: Vec<f64>,
        /// Thickness, or a range in which the search chooses it.
        thickness: Thickness,
    },
}

/// Thickness of a film in the library's unit. At 1 the reference white has S d = 1. For absolute amounts
/// this is the sum of all amounts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Thickness {
    /// This thickness, above 0.
    Fixed(f64),
    /// The search chooses within this range, least to greatest.
    Between(f64, f64),
}

impl Thickness {
    /// Least and greatest thickness.
    #[must_use]
    pub fn bounds(self) -> (f64, f64) {
        match self {
            Self::Fixed(thickness) => (thickness, thickness),
            Self::Between(least, most) => (least, most),
        }
    }
}

/// A request for recipes that we cannot meet.
#[derive(Debug, Clone, PartialEq, thiserror::Error, Explain)]
#[fault(Setting)]
pub enum MatchError {
    /// The search was cancelled.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    /// No pigment may take part.
    #[error("no pigment is left to mix with")]
    #[hint("allow more of the library's pigments")]
    NoPigments,
    /// The request names no light.
    #[error("a recipe is judged under at least one light")]
    NoLight,
    /// One light is named twice.
    #[error("the light {0} is given twice")]
    #[hint("give each light once, with its weight: [illuminant=D65=2] [illuminant=A]")]
    RepeatedLight(String),
    /// A number of the request is out of range.
    #[error("{what}, found `{value}`")]
    #[hint("{hint}")]
    Number {
        /// Description of the allowed range.
        what: &'static str,
        /// Number that was given.
        value: f64,
        /// Advice, with the setting in square brackets.
        hint: &'static str,
    },
    /// More pigments are required than a recipe may have.
    #[error("{required} pigments must take part, but a recipe has `{at_most}` at most")]
    #[hint("raise [at_most], or require fewer pigments")]
    TooManyRequired {
        /// Number of required pigments.
        required: usize,
        /// Most pigments of a recipe.
        at_most: usize,
    },
    /// One pigment is both required and excluded.
    #[error("{0} is both required and excluded")]
    #[hint("name it in one of [with] and [without] only")]
    RequiredAndExcluded(String),
    /// Fixed shares leave nothing for the other pigments, or exceed the whole.
    #[error("fixed shares are above 0 and leave room for the other pigments, found a sum of `{0}`")]
    #[hint("let fixed shares sum to less than 1")]
    Shares(f64),
    /// Recipes in whole parts cannot have fixed shares.
    #[error("recipes in whole parts take no fixed shares")]
    #[hint("leave out [parts], or the share of the pigment")]
    SharesInParts,
    /// A film that hides is requested from a library of absolute amounts, which needs a film over a ground.
    #[error("a library of absolute amounts makes films over a ground")]
    #[hint("give a [thickness]")]
    AbsoluteHiding,
    /// A batch is corrected with a library of absolute amounts, which holds no masses.
    #[error("a batch is corrected by shares, and this library's amounts are absolute")]
    #[hint("use a library of relative amounts, fitted to films that hide")]
    AbsoluteBatch,
    /// A ground is given, but the film hides it.
    #[error("a film that hides shows no ground")]
    #[hint("give [over] a [thickness], such as 1 or 0.2:3")]
    HiddenGround,
    /// A search by spectrum was asked for a target that is only a colour.
    #[error("a match by spectrum needs a measured spectrum, and `{0}` is only a colour")]
    #[hint("give the file of its reading, FILE or FILE#SAMPLE, or match by colour: [by=color]")]
    NoSpectrum(String),
    /// The wavelengths of the target and of the library do not overlap.
    #[error(
        "`{name}` was measured from {} to {} nm, the library from {} to {} nm: they share no band",
        target_nm[0], target_nm[1], library_nm[0], library_nm[1]
    )]
    #[hint("measure the target over the band of the library")]
    #[fault(Input)]
    NoSharedBand {
        /// Name of the target.
        name: String,
        /// First and last wavelength of the target in nm.
        target_nm: [f64; 2],
        /// First and last wavelength of the library in nm.
        library_nm: [f64; 2],
    },
    /// No recipe lies within the limits of the request.
    #[error("no recipe fits inside these limits")]
    #[hint(
        "allow more pigments ([at_most]), more parts ([parts]), a smaller [least], or amounts that were \
         not measured ([beyond_measured])"
    )]
    #[fault(Input)]
    NoRecipe,
    /// A pigment's name is not in the library.
    #[error(transparent)]
    #[fault(Input)]
    Recipe(#[from] RecipeError),
    /// A row of a price list names no pigment of the library.
    #[error("{0}, column `pigment`")]
    #[hint(inner = 1)]
    #[fault(Input)]
    PricedPigment(String, #[source] RecipeError),
    /// Pigments that may take part have no price, while others have one.
    #[error("no price for {}", .0.join(", "))]
    #[hint("price every pigment that may take part, or leave some out with [without] or [only]")]
    #[fault(Input)]
    NoPrice(Vec<String>),
    /// The ground cannot be used.
    #[error(transparent)]
    Backing(#[from] BackingError),
    /// The library or the target has no visible wavelength.
    #[error(transparent)]
    #[fault(Input)]
    Band(#[from] BandError),
    /// The target's spectrum cannot be interpolated.
    #[error(transparent)]
    #[fault(Input)]
    Interpolate(#[from] InterpolateError),
}
