//! Predicts the spectrum and colour of a mixture. You give pigment names and parts, for example nine parts
//! of white and one of blue.
//!
//! [`Backing`] is the ground under the film. [`Appearance`] is the colour under one light in the forms that
//! you use. [`IlluminantChange`] names a metamerism index.

use std::str::FromStr;

use documents::hint::Explain;
use serde_json::{Value, json};
use spectra::color::{Adaptation, Lab, Rgb, RgbSpace, Xyz};
use spectra::{
    Extrapolation, Grid, InterpolateError, Interpolation, Reflectance, Spectrum, SpectrumError,
};

use crate::evaluate::{BandError, Remark, Viewing, check_visible_band};
use crate::library::{AmountKind, PigmentLibrary, RecipeError};
use crate::recipe::Recipe;

/// Greatest thickness of a film. At this thickness a film hides its ground if K and S exceed 1e-7.
pub(crate) const THICKEST: f64 = 1e9;

/// A film of given thickness over a ground.
#[derive(Debug, Clone, PartialEq)]
pub struct FilmOver {
    /// Thickness in the library's unit, above 0 and up to 1e9. At 1 the reference white has S d = 1. For
    /// absolute amounts, at 1 you have the amounts of the recipe.
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
    /// Encoded sRGB. We adapt it from the light to the display (Bradford). It is outside 0..1 where sRGB
    /// cannot show the colour.
    pub srgb: Rgb,
    /// Warnings, e.g. about guessed pigments, pigments with unknown S, and a ground or a library that
    /// covers only part of the visible band.
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
    /// Predicts the colour of a mixture. You give pigments by name with their parts. In a library of
    /// relative amounts the film hides its ground. In one of absolute amounts the parts are the amounts on
    /// the library's area, over a perfect white.
    ///
    /// ```
    /// use pigment::{PigmentLibrary, Viewing};
    ///
    /// let oils = PigmentLibrary::van_gogh_oils();
    /// let viewing = Viewing::default();
    /// let color = oils.color([("Zinc White", 9.0), ("Cobalt Blue", 1.0)], &viewing)?;
    /// assert_eq!(color.hex(), "#5798e3");
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

    /// Predicts the colour of a mixture that you lay as `film` over a ground. Use this if the ground shows
    /// through.
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
                    return Err(ColorError::Thickness(thickness));
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

    /// Warnings about pigments of a recipe that we guessed, and about mixed pigments of unknown S.
    fn reservations(&self, recipe: &Recipe) -> Vec<Remark> {
        let guessed = recipe.pigments().filter(|id| self[*id].guessed);
        let mixed = recipe.pigments().filter(|id| recipe.len() > 1 && !self[*id].identified);
        guessed
            .chain(mixed)
            .map(|id| Remark::warning(format!("{}: {}", self[id].name, self[id].notes.join("; "))))
            .collect()
    }
}

/// Reasons why we cannot predict the colour of a mixture.
#[derive(Debug, Clone, PartialEq, thiserror::Error, Explain)]
pub enum ColorError {
    /// The recipe cannot be mixed.
    #[error(transparent)]
    Recipe(#[from] RecipeError),
    /// The thickness of the film is impossible.
    #[error("a film's thickness is above 0 and up to 1e9, found `{0}`")]
    #[hint("leave [thickness] out for a film that hides")]
    #[fault(Setting)]
    Thickness(f64),
    /// The ground cannot be used.
    #[error(transparent)]
    Backing(#[from] BackingError),
    /// The library has no visible wavelength.
    #[error(transparent)]
    #[fault(Input)]
    Band(#[from] BandError),
    /// K and S of the library make an impossible reflectance.
    #[error(transparent)]
    Spectrum(#[from] SpectrumError),
}

/// A colour under one light.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Appearance {
    /// Tristimulus values, Y = 100 for the white.
    pub xyz: Xyz,
    /// CIELAB relative to the light's own white.
    pub lab: Lab,
    /// Encoded sRGB. We adapt it from the light to the display (Bradford). It is outside 0..1 where sRGB
    /// cannot show the colour.
    pub srgb: Rgb,
}

impl Appearance {
    /// Computes the appearance of `xyz` under a light with the white point `white`.
    #[must_use]
    pub fn of(xyz: Xyz, white: Xyz) -> Self {
        Self {
            xyz,
            lab: Lab::from_xyz(xyz, white),
            srgb: RgbSpace::Srgb.encoded_from_xyz(xyz, white, Adaptation::Bradford),
        }
    }
}

/// Measured reflectance of the bare ground under a film, surface included.
///
/// ```
/// use pigment::Backing;
///
/// let paper: Backing = "0.85".parse()?;
/// assert_eq!(paper, Backing::even(0.85)?);
/// assert!("grey".parse::<Backing>().is_err());
/// # Ok::<(), pigment::BackingError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub enum Backing {
    /// One reflectance at every wavelength, 0 to 1.
    Even(f64),
    /// A measured spectrum.
    Measured(Spectrum<Reflectance>),
}

impl Default for Backing {
    /// A perfect white.
    fn default() -> Self {
        Self::Even(1.0)
    }
}

impl Backing {
    /// Backing with one reflectance at every wavelength.
    ///
    /// # Errors
    /// [`BackingError::Reflectance`] unless it is 0 to 1.
    pub fn even(reflectance: f64) -> Result<Self, BackingError> {
        if (0.0..=1.0).contains(&reflectance) {
            return Ok(Self::Even(reflectance));
        }
        Err(BackingError::Reflectance(reflectance.to_string()))
    }

    /// Reflectance at each wavelength of `grid`. Where a measured spectrum is shorter, we hold its end
    /// values, and return a warning.
    ///
    /// # Errors
    /// [`BackingError::Band`] if the spectrum has no wavelength within the grid.
    pub fn on_grid(&self, grid: Grid) -> Result<(Vec<f64>, Option<Remark>), BackingError> {
        let spectrum = match self {
            Self::Even(value) => return Ok((vec![*value; grid.count()], None)),
            Self::Measured(spectrum) => spectrum,
        };
        let from = spectrum.grid();
        let start = from.start_nm();
        let end = from.end_nm();
        if start > grid.end_nm() || end < grid.start_nm() {
            return Err(BackingError::Band { start_nm: start, end_nm: end, wanted: grid });
        }
        let shorter = start > grid.start_nm() || end < grid.end_nm();
        let warning = shorter.then(|| {
            Remark::warning(format!(
                "the ground is measured from {start} to {end} nm; beyond, its end values are held"
            ))
        });
        let resampled =
            spectrum.resampled(grid, Interpolation::best_for(from), Extrapolation::Hold)?;
        Ok((resampled.into_values(), warning))
    }
}

impl FromStr for Backing {
    type Err = BackingError;

    /// Reads `white`, `black`, or a reflectance from 0 to 1.
    fn from_str(text: &str) -> Result<Self, BackingError> {
        match text {
            "white" => Ok(Self::Even(1.0)),
            "black" => Ok(Self::Even(0.0)),
            _ => text
                .parse()
                .ok()
                .and_then(|value| Self::even(value).ok())
                .ok_or_else(|| BackingError::Reflectance(text.to_owned())),
        }
    }
}

/// A backing that you cannot use.
#[derive(Debug, Clone, PartialEq, thiserror::Error, Explain)]
pub enum BackingError {
    /// The reflectance is not a number from 0 to 1.
    #[error("the ground's reflectance is 0 to 1, white or black, found `{0}`")]
    #[hint("try [over=0.85] or [over=paper.csv#SAMPLE]")]
    #[fault(Setting)]
    Reflectance(String),
    /// The spectrum has no wavelength in common with the library.
    #[error("the ground is measured from {start_nm} to {end_nm} nm only")]
    #[hint("the library has the wavelengths {wanted}")]
    Band {
        /// First wavelength of the spectrum in nm.
        start_nm: f64,
        /// Last wavelength of the spectrum in nm.
        end_nm: f64,
        /// Wavelengths of the library.
        wanted: Grid,
    },
    /// The spectrum cannot be interpolated.
    #[error(transparent)]
    Interpolate(#[from] InterpolateError),
}

/// A special metamerism index tells you how much a pair differs after this change of lights.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct IlluminantChange<'a> {
    /// Name of the light under which the pair should match.
    pub reference: &'a str,
    /// Name of the light to which the pair is brought.
    pub test: &'a str,
}

impl IlluminantChange<'_> {
    /// Meaning of a column of these indices, as a line for its table.
    pub const LEGEND: &'static str = "metamerism: special metamerism index, change of illuminant, in CIEDE2000 (CIE 15:2018, 9.2)";

    /// Both lights, for the heading of a column.
    #[must_use]
    pub fn heading(self) -> String {
        format!("{} to {}", self.reference, self.test)
    }

    /// The index with its name, lights and unit as JSON. Null where it is not defined.
    #[must_use]
    pub fn to_json(self, index: Option<f64>) -> Value {
        json!({
            "kind": "special metamerism index, change of illuminant",
            "change": self.heading(),
            "from": self.reference,
            "to": self.test,
            "unit": "CIEDE2000",
            "index": index,
        })
    }
}
