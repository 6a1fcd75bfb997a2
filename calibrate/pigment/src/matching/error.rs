//! Reasons why there are no recipes.

use documents::hint::{Explain, Fault, Hint};
use spectra::InterpolateError;

use crate::backing::BackingError;
use crate::library::RecipeError;
use crate::visible_band::BandError;

/// A request for recipes that cannot be met.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum MatchError {
    /// No pigment may take part.
    #[error("no pigment is left to mix with")]
    NoPigments,
    /// The request names no light.
    #[error("a recipe is judged under at least one light")]
    NoLight,
    /// One light is named twice.
    #[error("the light {name} is given twice")]
    RepeatedLight {
        /// Name of the light.
        name: String,
    },
    /// A number of the request is out of range.
    #[error("{what}, found `{value}`")]
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
    TooManyRequired {
        /// Number of required pigments.
        required: usize,
        /// Most pigments of a recipe.
        at_most: usize,
    },
    /// One pigment is both required and excluded.
    #[error("{name} is both required and excluded")]
    RequiredAndExcluded {
        /// Name of the pigment.
        name: String,
    },
    /// Fixed shares leave nothing for the other pigments, or exceed the whole.
    #[error(
        "fixed shares are above 0 and leave room for the other pigments, found a sum of `{total}`"
    )]
    Shares {
        /// Sum of all fixed shares.
        total: f64,
    },
    /// Recipes in whole parts cannot have fixed shares.
    #[error("recipes in whole parts take no fixed shares")]
    SharesInParts,
    /// A film that hides is requested from a library of absolute amounts, which needs a film over a ground.
    #[error("a library of absolute amounts makes films over a ground")]
    AbsoluteHiding,
    /// A batch is corrected with a library of absolute amounts, which holds no masses.
    #[error("a batch is corrected by shares, and this library's amounts are absolute")]
    AbsoluteBatch,
    /// A ground is given, but the film hides it.
    #[error("a film that hides shows no ground")]
    HiddenGround,
    /// A search by spectrum was asked for a target that is only a colour.
    #[error("a match by spectrum needs a measured spectrum, and `{name}` is only a colour")]
    NoSpectrum {
        /// Name of the target.
        name: String,
    },
    /// A target was not measured where the library was.
    #[error(
        "`{name}` was measured from {} to {} nm, the library from {} to {} nm: they share no band",
        target_nm[0], target_nm[1], library_nm[0], library_nm[1]
    )]
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
    NoRecipe,
    /// A pigment's name is not in the library.
    #[error(transparent)]
    Recipe(#[from] RecipeError),
    /// A row of a price list names no pigment of the library.
    #[error("{place}, column `pigment`")]
    PricedPigment {
        /// File and row.
        place: String,
        /// Reason why the name denotes no pigment.
        #[source]
        error: RecipeError,
    },
    /// Pigments that may take part have no price, while others have one.
    #[error("no price for {}", pigments.join(", "))]
    NoPrice {
        /// Names of these pigments.
        pigments: Vec<String>,
    },
    /// The ground cannot be used.
    #[error(transparent)]
    Backing(#[from] BackingError),
    /// The library or the target has no visible wavelength.
    #[error(transparent)]
    Band(#[from] BandError),
    /// The target's spectrum cannot be interpolated.
    #[error(transparent)]
    Interpolate(#[from] InterpolateError),
}

impl Explain for MatchError {
    fn hint(&self) -> Option<Hint> {
        Some(Hint::new(match self {
            Self::NoPigments => "allow more of the library's pigments",
            Self::RepeatedLight { .. } => {
                "give each light once, with its weight: [illuminant=D65=2] [illuminant=A]"
            }
            Self::Number { hint, .. } => hint,
            Self::TooManyRequired { .. } => "raise [at_most], or require fewer pigments",
            Self::RequiredAndExcluded { .. } => "name it in one of [with] and [without] only",
            Self::Shares { .. } => "let fixed shares sum to less than 1",
            Self::SharesInParts => "leave out [parts], or the share of the pigment",
            Self::AbsoluteHiding => "give a [thickness]",
            Self::AbsoluteBatch => "use a library of relative amounts, fitted to films that hide",
            Self::HiddenGround => "give [over] a [thickness], such as 1 or 0.2:3",
            Self::NoSpectrum { .. } => {
                "give the file of its reading, FILE or FILE#SAMPLE, or match by colour: [by=color]"
            }
            Self::NoSharedBand { .. } => "measure the target over the band of the library",
            Self::NoRecipe => {
                "allow more pigments ([at_most]), more parts ([parts]), a smaller [least], or amounts that were \
                 not measured ([beyond_measured])"
            }
            Self::NoPrice { .. } => {
                "price every pigment that may take part, or leave some out with [without] or [only]"
            }
            Self::Recipe(error) | Self::PricedPigment { error, .. } => return error.hint(),
            Self::Backing(error) => return error.hint(),
            Self::Band(error) => return error.hint(),
            Self::NoLight | Self::Interpolate(_) => return None,
        }))
    }

    fn fault(&self) -> Fault {
        match self {
            Self::Backing(error) => error.fault(),
            Self::NoRecipe
            | Self::NoSharedBand { .. }
            | Self::Recipe(_)
            | Self::PricedPigment { .. }
            | Self::NoPrice { .. }
            | Self::Band(_)
            | Self::Interpolate(_) => Fault::Input,
            _ => Fault::Setting,
        }
    }
}
