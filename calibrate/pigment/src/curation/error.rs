//! Why a library cannot be changed as asked.

use spectra::InterpolateError;

use crate::library::RecipeError;

/// A change of libraries that the data forbid.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CurationError {
    /// A name that is no pigment's.
    #[error("{file}: {error}")]
    Pigment {
        /// The library's file.
        file: String,
        /// What is wrong with the name.
        error: RecipeError,
    },
    /// A reference whose S is not known.
    #[error("{file}: the scattering of `{pigment}` is not known, so it cannot be the reference")]
    UnknownScattering {
        /// The library's file.
        file: String,
        /// The pigment.
        pigment: String,
    },
    /// A reference without S at a wavelength.
    #[error("{file}: the reference needs S above 0, and S of {pigment} at {nm} nm is `{value}`")]
    NoScattering {
        /// The library's file.
        file: String,
        /// The pigment.
        pigment: String,
        /// Where.
        nm: f64,
        /// The S there.
        value: f64,
    },
    /// Wavelengths beyond the library's.
    #[error("{file}: {error}")]
    Grid {
        /// The library's file.
        file: String,
        /// Which, and how far the library reaches.
        error: InterpolateError,
    },
    /// Shares and amounts on an area do not mix.
    #[error("{file} holds {found} amounts and {first} {wanted} ones, which mean different things")]
    Amounts {
        /// The first library's file.
        first: String,
        /// What that holds.
        wanted: &'static str,
        /// The other library's file.
        file: String,
        /// What the other holds.
        found: &'static str,
    },
    /// Two libraries of absolute amounts, whose unit no file tells.
    #[error("{first} and {file}: K and S are per unit of amount, and no file says of which unit")]
    Units {
        /// The first library's file.
        first: String,
        /// The other library's file.
        file: String,
    },
    /// K and S found under different surfaces or film models.
    #[error("{file}: {what} differs, {wanted} in {first}, found `{found}`")]
    Surface {
        /// What differs.
        what: &'static str,
        /// The first library's file.
        first: String,
        /// What that has.
        wanted: String,
        /// The other library's file.
        file: String,
        /// What the other has.
        found: String,
    },
    /// The first library has no reference white.
    #[error("{file}: the library has no reference white, so nothing can be scaled to it")]
    NoReference {
        /// The library's file.
        file: String,
    },
    /// No pigment is the reference of the first.
    #[error("{file}: no pigment is called `{reference}`, the reference of {first}")]
    NoCommonPigment {
        /// The first library's file.
        first: String,
        /// The other library's file.
        file: String,
        /// The reference.
        reference: String,
    },
    /// One name for two pigments.
    #[error(
        "{first} and {file} both have `{pigment}` with figures that differ, {delta_e:.2} CIEDE2000 between the masstones"
    )]
    Clash {
        /// The file of the one.
        first: String,
        /// The file of the other.
        file: String,
        /// The name.
        pigment: String,
        /// How far the masstones are apart.
        delta_e: f64,
    },
    /// A name that is taken, or none.
    #[error("{file}: a pigment needs a name of its own, found `{name}`")]
    Name {
        /// The library's file.
        file: String,
        /// The name.
        name: String,
    },
    /// A subset without its reference.
    #[error("{file}: the reference `{reference}` would be left out")]
    ReferenceLeftOut {
        /// The library's file.
        file: String,
        /// The reference.
        reference: String,
    },
    /// Nothing left.
    #[error("{file}: no pigment would be left")]
    Empty {
        /// The library's file.
        file: String,
    },
    /// A colour that no paint under the library's surface has.
    #[error(
        "no paint under this surface (k1 = {k1}, k2 = {k2}) has this colour; the nearest is {delta_e:.2} CIEDE2000 off, found `{nearest}`"
    )]
    OutOfReach {
        /// Of the surface.
        k1: f64,
        /// Of the surface.
        k2: f64,
        /// The nearest colour as sRGB.
        nearest: String,
        /// How far it is.
        delta_e: f64,
    },
    /// A guess for a library of absolute amounts.
    #[error("a guessed pigment has no unit of amount, and this library is of absolute amounts")]
    GuessedAmount,
}

impl CurationError {
    /// What to try, where there is something.
    #[must_use]
    pub fn hint(&self) -> Option<String> {
        Some(match self {
            Self::Pigment { error, .. } => return error.hint(),
            Self::UnknownScattering { .. } | Self::NoScattering { .. } => {
                "name a pigment that was measured in mixtures and scatters, such as a white".into()
            }
            Self::Grid { error: InterpolateError::TooFew { .. }, .. } => {
                "straight lines need two wavelengths only: --interpolation linear".into()
            }
            Self::Grid { .. } => {
                "take wavelengths within the library's, or hold its end values: --hold-ends".into()
            }
            Self::Amounts { .. } => {
                "bring the absolute one to shares first: impasto library convert FILE --reference WHITE --output RELATIVE.json".into()
            }
            Self::Units { .. } => {
                "if both were measured in the same unit on the same area: --same-unit".into()
            }
            Self::Surface { .. } => {
                "K and S hold under the surface they were found with; fit both with one --saunderson, or take the first's: --any-surface".into()
            }
            Self::NoReference { .. } => "name one of its pigments: --reference WHITE".into(),
            Self::NoCommonPigment { reference, .. } => {
                format!("if it has {reference} under another name: --as NAME")
            }
            Self::Clash { pigment, file, .. } => format!(
                "choose: --prefer first or --prefer last; or rename: impasto library rename {file} \"{pigment}={pigment} (2)\" --output RENAMED.json"
            ),
            Self::Name { .. } => "choose another name".into(),
            Self::ReferenceLeftOut { reference, .. } => {
                format!("keep {reference}, or choose a new reference: --reference WHITE")
            }
            Self::Empty { .. } => "name a pigment to keep".into(),
            Self::OutOfReach { .. } => "take the nearest: --nearest".into(),
            Self::GuessedAmount => {
                "bring the library to shares first: impasto library convert".into()
            }
        })
    }
}
