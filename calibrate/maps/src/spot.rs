//! Spots of a scan: the measured spectrum of a pixel or a region beside that of its mapped mixture.

use documents::hint::{Explain, Fault, Hint};
use pigment::{PigmentLibrary, RecipeError};

use crate::cube::CubeError;
use crate::map_error::MapError;
use crate::surveyed::{Region, SurveyedScan};

/// Share below which a pigment takes no part in the mapped mixture of a spot.
const LEAST_SHARE: f32 = 1e-4;

/// A pigment or group in a spot.
#[derive(Debug, Clone, PartialEq)]
pub struct SpotPigment {
    /// Name of the pigment or group.
    pub name: String,
    /// Share of the paint, 0 to 1.
    pub share: f64,
    /// Standard deviation of the share.
    pub share_sd: f64,
    /// Probability that it is there, 0 to 1.
    pub presence: f64,
}

/// A pixel or region of a scan, its mean spectrum mapped as one pixel.
#[derive(Debug, Clone, PartialEq)]
pub struct Spot {
    /// Rows and columns.
    pub region: Region,
    /// Number of pixels that could be mapped, whose mean was taken.
    pub pixels: usize,
    /// Wavelengths of the scan's bands in nm.
    pub measured_nm: Vec<f64>,
    /// Mean measured reflectance of each band.
    pub measured: Vec<f64>,
    /// Wavelengths of the library in nm.
    pub mapped_nm: Vec<f64>,
    /// Reflectance of the mapped mixture, of its single pigments.
    pub mapped: Vec<f64>,
    /// Pigments and groups with a share, the greatest first; none where the spectrum is out of gamut.
    pub pigments: Vec<SpotPigment>,
    /// Chi-square per degree of freedom.
    pub chi2: f64,
    /// Root mean square difference in reflectance.
    pub rms: f64,
}

impl SurveyedScan {
    /// Maps the mean spectrum of `region`. `library` is that of the survey.
    ///
    /// # Errors
    /// [`SpotError`] if the region is not within the scan, or none of its pixels can be mapped.
    pub fn spot(&self, library: &PigmentLibrary, region: Region) -> Result<Spot, SpotError> {
        let (pixels, measured) = self.cube().mean(region.rows.clone(), region.columns.clone())?;
        if pixels == 0 {
            return Err(SpotError::NothingMapped { region });
        }
        let mean: Vec<f32> = measured.iter().map(|value| *value as f32).collect();
        let maps = self.map_pixels(&mean)?;
        if !maps.mask[0].is_compared() {
            return Err(SpotError::NothingMapped { region });
        }
        let columns = self.mapper().columns();
        let Some(set) = self.best_set(&mean)? else {
            return Err(SpotError::NothingMapped { region });
        };
        let mixture = library.mix(library.recipe(set)?)?;
        let told = columns.iter().enumerate().map(|(place, column)| SpotPigment {
            name: column.name.clone(),
            share: f64::from(maps.share[place]),
            share_sd: f64::from(maps.share_sd[place]),
            presence: f64::from(maps.presence[place]),
        });
        let mut pigments: Vec<SpotPigment> =
            told.filter(|pigment| pigment.share > f64::from(LEAST_SHARE)).collect();
        pigments.sort_by(|a, b| b.share.total_cmp(&a.share));
        Ok(Spot {
            region,
            pixels,
            measured_nm: self.cube().wavelengths_nm().to_vec(),
            measured,
            mapped_nm: library.grid.wavelengths_nm().collect(),
            mapped: mixture.hiding(library.saunderson),
            pigments,
            chi2: f64::from(maps.chi2[0]),
            rms: f64::from(maps.rms[0]),
        })
    }
}

/// A spot that cannot be told.
#[derive(Debug, thiserror::Error)]
pub enum SpotError {
    /// The region is not within the scan, or the scan cannot be read.
    #[error(transparent)]
    Cube(#[from] CubeError),
    /// The spectrum does not fit the survey.
    #[error(transparent)]
    Map(#[from] MapError),
    /// The library lacks a pigment of the survey.
    #[error(transparent)]
    Recipe(#[from] RecipeError),
    /// No pixel of the region can be mapped.
    #[error(
        "rows {}..{}, columns {}..{}: none of these pixels can be mapped",
        region.rows.start, region.rows.end, region.columns.start, region.columns.end
    )]
    NothingMapped {
        /// Region of the spot.
        region: Region,
    },
}

impl Explain for SpotError {
    fn hint(&self) -> Option<Hint> {
        match self {
            Self::Cube(error) => error.hint(),
            Self::Map(error) => error.hint(),
            Self::Recipe(error) => error.hint(),
            Self::NothingMapped { .. } => Some(Hint::new("choose another [spot]")),
        }
    }

    fn fault(&self) -> Fault {
        match self {
            Self::Cube(error) => error.fault(),
            Self::Map(error) => error.fault(),
            Self::Recipe(error) => error.fault(),
            Self::NothingMapped { .. } => Fault::Setting,
        }
    }
}
