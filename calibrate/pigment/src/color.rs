//! Predicts the spectrum and colour of a mixture given by pigment names and parts.

use documents::hint::{Explain, Fault, Hint};
use spectra::color::{Lab, Rgb, Xyz};
use spectra::{Reflectance, Spectrum, SpectrumError};

use crate::appearance::Appearance;
use crate::backing::{Backing, BackingError};
use crate::evaluate::Viewing;
use crate::library::{AmountKind, PigmentLibrary, RecipeError};
use crate::recipe::Recipe;
use crate::remark::Remark;
use crate::visible_band::{BandError, check_visible_band};

/// Greatest thickness of a film. A film of this thickness hides its ground if K and S exceed 1e-7.
const THICKEST: f64 = 1e9;

/// A film of given thickness over a ground.
#[derive(Debug, Clone, PartialEq)]
pub struct FilmOver {
    /// Thickness in the library's unit, above 0 and up to 1e9: 1 is the thickness at which the
    /// reference white has S d = 1 or, for absolute amounts, the amounts of the recipe.
    pub thickness: f64,
    /// Bare ground under the film.
    pub ground: Backing,
}

impl Default for FilmOver {
    /// Thickness 1 over a perfect white.
    fn default() -> Self {
        Self { thickness: 1.0, ground: Backing::default() }
    }
}

/// Spectrum and colour of a mixture under one light.
#[derive(Debug, Clone, PartialEq)]
pub struct MixtureColor {
    /// Recipe of the mixture.
    pub recipe: Recipe,
    /// Measured reflectance, surface included, on the library's grid.
    pub reflectance: Spectrum<Reflectance>,
    /// Tristimulus values, Y = 100 for the white.
    pub xyz: Xyz,
    /// CIELAB relative to the light's own white.
    pub lab: Lab,
    /// Encoded sRGB, adapted from the light to the display (Bradford); outside 0..1 where sRGB cannot
    /// show the colour.
    pub srgb: Rgb,
    /// Warnings: pigments that were guessed or whose S is unknown, and a ground or a library that covers only
    /// part of the visible band.
    pub remarks: Vec<Remark>,
}

impl MixtureColor {
    /// Nearest displayable colour as `#rrggbb`.
    #[must_use]
    pub fn hex(&self) -> String {
        self.srgb.to_hex()
    }
}

impl PigmentLibrary {
    /// Predicts the colour of a mixture, given as pigments by name with their parts. In a library of relative
    /// amounts the film hides its ground. In one of absolute amounts the parts are the amounts on the
    /// library's area, over a perfect white.
    ///
    /// ```
    /// use pigment::{PigmentLibrary, Viewing};
    ///
    /// let oils = PigmentLibrary::van_gogh_oils();
    /// let viewing = Viewing::default();
    /// let color = oils.color([("Zinc White", 9.0), ("Cobalt Blue", 1.0)], &viewing)?;
    /// assert_eq!(color.hex(), "#5698e4");
    /// assert_eq!(color.reflectance.grid(), oils.grid);
    /// # Ok::<(), pigment::ColorError>(())
    /// ```
    ///
    /// # Errors
    /// [`ColorError`] for an unknown pigment, impossible parts, or a library without visible wavelengths.
    pub fn color<N: AsRef<str>>(
        &self,
        parts: impl IntoIterator<Item = (N, f64)>,
        viewing: &Viewing,
    ) -> Result<MixtureColor, ColorError> {
        let recipe = self.recipe(parts)?;
        match self.amounts {
            AmountKind::Relative => self.recipe_color(recipe, None, viewing),
            AmountKind::Absolute => self.recipe_color(recipe, Some(&FilmOver::default()), viewing),
        }
    }

    /// Predicts the colour of a mixture laid as `film` over a ground.
    ///
    /// # Errors
    /// [`ColorError`] as for [`Self::color`], or for a thickness or ground that is impossible.
    pub fn film_color<N: AsRef<str>>(
        &self,
        parts: impl IntoIterator<Item = (N, f64)>,
        film: &FilmOver,
        viewing: &Viewing,
    ) -> Result<MixtureColor, ColorError> {
        let recipe = self.recipe(parts)?;
        self.recipe_color(recipe, Some(film), viewing)
    }

    fn recipe_color(
        &self,
        recipe: Recipe,
        film: Option<&FilmOver>,
        viewing: &Viewing,
    ) -> Result<MixtureColor, ColorError> {
        let mixture = self.mix(&recipe)?;
        let mut remarks = Vec::new();
        let reflectance = match film {
            None => mixture.hiding(self.saunderson),
            Some(&FilmOver { thickness, ref ground }) => {
                if !(thickness > 0.0 && thickness <= THICKEST) {
                    return Err(ColorError::Thickness { thickness });
                }
                let (ground, warning) = ground.on_grid(self.grid)?;
                remarks.extend(warning);
                mixture.film(thickness, &ground, self.film())
            }
        };
        remarks.extend(self.reservations(&recipe));
        remarks.extend(check_visible_band(self.grid)?);
        let weights = viewing.weights(self.grid).expect("the method fits the grid");
        let Appearance { xyz, lab, srgb } =
            Appearance::of(weights.xyz(&reflectance), weights.white());
        let reflectance = Spectrum::new(self.grid, reflectance)?;
        Ok(MixtureColor { recipe, reflectance, xyz, lab, srgb, remarks })
    }

    /// Warnings about pigments of a recipe that were guessed, and about mixed pigments of unknown S.
    fn reservations(&self, recipe: &Recipe) -> Vec<Remark> {
        let guessed = recipe.pigments().filter(|id| self[*id].guessed);
        let mixed = recipe.pigments().filter(|id| recipe.len() > 1 && !self[*id].identified);
        guessed
            .chain(mixed)
            .map(|id| Remark::warning(format!("{}: {}", self[id].name, self[id].notes.join("; "))))
            .collect()
    }
}

/// A mixture whose colour cannot be predicted.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ColorError {
    /// The recipe cannot be mixed.
    #[error(transparent)]
    Recipe(#[from] RecipeError),
    /// The thickness of the film is impossible.
    #[error("a film's thickness is above 0 and up to 1e9, found `{thickness}`")]
    Thickness {
        /// Thickness that was given.
        thickness: f64,
    },
    /// The ground cannot be used.
    #[error(transparent)]
    Backing(#[from] BackingError),
    /// The library has no visible wavelength.
    #[error(transparent)]
    Band(#[from] BandError),
    /// K and S of the library make an impossible reflectance.
    #[error(transparent)]
    Spectrum(#[from] SpectrumError),
}

impl Explain for ColorError {
    fn hint(&self) -> Option<Hint> {
        match self {
            Self::Recipe(error) => error.hint(),
            Self::Thickness { .. } => {
                Some(Hint::new("leave [thickness] out for a film that hides"))
            }
            Self::Backing(error) => error.hint(),
            Self::Band(error) => error.hint(),
            Self::Spectrum(_) => None,
        }
    }

    fn fault(&self) -> Fault {
        match self {
            Self::Thickness { .. } => Fault::Setting,
            Self::Backing(error) => error.fault(),
            Self::Recipe(_) | Self::Band(_) | Self::Spectrum(_) => Fault::Input,
        }
    }
}
