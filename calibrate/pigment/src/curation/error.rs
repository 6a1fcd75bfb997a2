//! Reasons why a library cannot be changed as requested.

use documents::hint::{Explain, Fault, Hint};
use spectra::InterpolateError;
use spectra::color::ColorCodeError;

use crate::library::RecipeError;

/// A change of libraries that the data do not allow.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CurationError {
    /// A name does not denote one pigment.
    #[error("{file}: {error}")]
    Pigment {
        /// File of the library.
        file: String,
        /// Reason why the name denotes no pigment.
        error: RecipeError,
    },
    /// The new reference white has an unknown S.
    #[error("{file}: the scattering of `{pigment}` is not known, so it cannot be the reference")]
    UnknownScattering {
        /// File of the library.
        file: String,
        /// Name of the pigment.
        pigment: String,
    },
    /// The new reference white has S = 0 at a wavelength.
    #[error("{file}: the reference needs S above 0, and S of {pigment} at {nm} nm is `{value}`")]
    NoScattering {
        /// File of the library.
        file: String,
        /// Name of the pigment.
        pigment: String,
        /// Wavelength in nm.
        nm: f64,
        /// S at that wavelength.
        value: f64,
    },
    /// The new grid cannot be reached from the library's.
    #[error("{file}: {error}")]
    Grid {
        /// File of the library.
        file: String,
        /// Wavelength that is out of reach, and the library's band.
        error: InterpolateError,
    },
    /// One library holds shares, the other amounts on an area.
    #[error("{file} holds {found} amounts and {first} {wanted} ones, which mean different things")]
    Amounts {
        /// File of the first library.
        first: String,
        /// Kind of amounts in the first library.
        wanted: &'static str,
        /// File of the other library.
        file: String,
        /// Kind of amounts in the other library.
        found: &'static str,
    },
    /// Both libraries hold absolute amounts, whose unit no file states.
    #[error("{first} and {file}: K and S are per unit of amount, and no file states the unit")]
    Units {
        /// File of the first library.
        first: String,
        /// File of the other library.
        file: String,
    },
    /// K and S were found under different surfaces or film models.
    #[error("{file}: {what} differs, {wanted} in {first}, found `{found}`")]
    Surface {
        /// Name of the property that differs.
        what: &'static str,
        /// File of the first library.
        first: String,
        /// Value in the first library.
        wanted: String,
        /// File of the other library.
        file: String,
        /// Value in the other library.
        found: String,
    },
    /// The first library has no reference white.
    #[error("{file}: the library has no reference white, so nothing can be scaled to it")]
    NoReference {
        /// File of the library.
        file: String,
    },
    /// The other library lacks the reference white of the first.
    #[error("{file}: no pigment is called `{reference}`, the reference of {first}")]
    NoCommonPigment {
        /// File of the first library.
        first: String,
        /// File of the other library.
        file: String,
        /// Name of the reference white.
        reference: String,
    },
    /// One name stands for two different pigments.
    #[error(
        "{first} and {file} both have `{pigment}` with figures that differ, {delta_e:.2} CIEDE2000 between the masstones"
    )]
    Clash {
        /// File of the first pigment.
        first: String,
        /// File of the second pigment.
        file: String,
        /// Name of both pigments.
        pigment: String,
        /// CIEDE2000 between their masstones.
        delta_e: f64,
    },
    /// A new name is empty or already taken.
    #[error("{file}: a pigment needs a name of its own, found `{name}`")]
    Name {
        /// File of the library.
        file: String,
        /// The new name.
        name: String,
    },
    /// A subset would lose its reference white.
    #[error("{file}: the reference `{reference}` would be left out")]
    ReferenceLeftOut {
        /// File of the library.
        file: String,
        /// Name of the reference white.
        reference: String,
    },
    /// A subset would be empty.
    #[error("{file}: no pigment would be left")]
    Empty {
        /// File of the library.
        file: String,
    },
    /// No paint under the library's surface has the requested colour.
    #[error(
        "no paint under this surface (k1 = {k1}, k2 = {k2}) has this colour; the nearest is {delta_e:.2} CIEDE2000 off, found `{nearest}`"
    )]
    OutOfReach {
        /// Share of arriving light that the surface reflects.
        k1: f64,
        /// Share of diffuse light that the surface turns back inside.
        k2: f64,
        /// Nearest possible colour as `#rrggbb` of sRGB.
        nearest: String,
        /// CIEDE2000 from the requested colour to the nearest.
        delta_e: f64,
    },
    /// Tints were requested of a library without a reference white.
    #[error("the library has no reference white to tint with")]
    NoWhite,
    /// The ratio of a tint is out of range.
    #[error("a tint has more than 0 and up to 1e6 parts of white, found `{parts}`")]
    TintParts {
        /// Parts of white to one of the pigment.
        parts: f64,
    },
    /// A text is not a colour.
    #[error(transparent)]
    Color(#[from] ColorCodeError),
    /// A pigment was to be guessed without a name.
    #[error("a pigment needs a name")]
    Unnamed,
    /// A pigment was to be guessed under the name of another.
    #[error("the library has a pigment called `{name}`")]
    NameTaken {
        /// The name.
        name: String,
    },
    /// A pigment was to be guessed for a library of absolute amounts.
    #[error("a guessed pigment has no unit of amount, and this library is of absolute amounts")]
    GuessedAmount,
}

impl Explain for CurationError {
    fn hint(&self) -> Option<Hint> {
        Some(Hint::new(match self {
            Self::Pigment { error, .. } => return error.hint(),
            Self::UnknownScattering { .. } | Self::NoScattering { .. } => {
                "name a pigment that was measured in mixtures and scatters, such as a white".into()
            }
            Self::Grid { error: InterpolateError::TooFew { .. }, .. } => {
                "straight lines need only two wavelengths: [interpolation=linear]".into()
            }
            Self::Grid { .. } => {
                "choose wavelengths within the library's, or hold its end values: [hold_ends]".into()
            }
            Self::Amounts { .. } => {
                "first convert the absolute library to shares: `impasto library convert` with [reference=WHITE]".into()
            }
            Self::Units { .. } => {
                "if both were measured in the same unit on the same area: [same_unit]".into()
            }
            Self::Surface { .. } => {
                "K and S hold under the surface they were found with; fit both with one [saunderson], or use the first's: [any_surface]".into()
            }
            Self::NoReference { .. } => "name one of its pigments: [reference=WHITE]".into(),
            Self::NoCommonPigment { reference, .. } => {
                format!("if it has {reference} under another name: [as=NAME]")
            }
            Self::Clash { pigment, file, .. } => format!(
                "choose one: [prefer=first] or [prefer=last]; or rename one: impasto library rename {file} \"{pigment}={pigment} (2)\" [output=RENAMED.json]"
            ),
            Self::Name { .. } => "choose another name".into(),
            Self::ReferenceLeftOut { reference, .. } => {
                format!("keep {reference}, or choose a new reference: [reference=WHITE]")
            }
            Self::Empty { .. } => "name a pigment to keep".into(),
            Self::OutOfReach { .. } => "accept the nearest colour: [nearest]".into(),
            Self::Color(error) => return error.hint(),
            Self::NoWhite => "leave out [tints]".into(),
            Self::TintParts { .. } => "try [tints=1,4,9]".into(),
            Self::Unnamed => "give [name=\"Sky Blue\"]".into(),
            Self::NameTaken { .. } => "choose another [name]".into(),
            Self::GuessedAmount => {
                "first convert the library to shares: `impasto library convert` with [reference=WHITE]".into()
            }
        }))
    }

    fn fault(&self) -> Fault {
        match self {
            Self::TintParts { .. } | Self::Unnamed | Self::Color(_) => Fault::Setting,
            _ => Fault::Input,
        }
    }
}
