//! Options for the surface reflection of a paint film, for the ground under a film (`--over`, e.g.
//! a grey or a measured spectrum), and for regular wavelengths (`--grid`, as `FIRST,LAST,STEP`).

use calibrate::{Backing, BackingTextError, backing_from_text};
use clap::{Args, ValueEnum};
use documents::request::RequestError;
use spectra::optics::{Specular, Surface};
use spectra::{Grid, GridError};

use crate::console::Console;
use crate::failure::{Failure, Result};

#[derive(Debug, Clone, Copy, ValueEnum)]
enum SpecularName {
    Included,
    Excluded,
}

/// Surface reflection of a film: Saunderson's k1 and k2, and whether readings include the specular part.
#[derive(Debug, Clone, Args)]
pub(crate) struct SurfaceOptions {
    /// Surface reflection as K1,K2, or none [default: 0.03,0.6, with a smaller k1 if a reading is below
    /// 0.03; in a fit of absolute amounts k1 = 0 and the k2 that predicts best]
    #[arg(long, value_name = "K1,K2")]
    saunderson: Option<String>,
    /// Whether the readings include the specular reflection
    #[arg(long, value_enum, default_value = "included")]
    specular: SpecularName,
}

impl SurfaceOptions {
    /// Surface that you give by `--saunderson`, `None` if the option is absent.
    pub(crate) fn surface(&self) -> Result<Option<Surface>> {
        let surface = self.saunderson.as_deref().map(|text| {
            let refused = |error: RequestError| {
                Failure::of_request(&error.at("saunderson"), |key| format!("--{key}"))
            };
            let surface = text.parse::<Surface>().map_err(refused)?;
            Ok(match text {
                "none" => surface,
                _ => Surface { specular: self.specular(), ..surface },
            })
        });
        surface.transpose()
    }

    /// Surface that you give by `--saunderson`. If it is absent, this is the surface of most
    /// paints.
    pub(crate) fn surface_or_usual(&self) -> Result<Surface> {
        Ok(self.surface()?.unwrap_or_else(|| Surface::of_most_paints(self.specular())))
    }

    /// Whether `--saunderson` is present.
    pub(crate) fn is_present(&self) -> bool {
        self.saunderson.is_some()
    }

    /// Whether readings include the specular reflection.
    pub(crate) fn specular(&self) -> Specular {
        match self.specular {
            SpecularName::Included => Specular::Included,
            SpecularName::Excluded => Specular::Excluded,
        }
    }
}

/// Parses `--over`: a reflectance from 0 to 1, `white`, `black`, or one spectrum of a file.
pub(crate) fn ground(text: &str, console: &mut Console<'_>) -> Result<Backing> {
    let mut remarks = Vec::new();
    let backing = backing_from_text(text, &mut remarks);
    console.remarks(&remarks)?;
    backing.map_err(|error| match error {
        BackingTextError::Text(error) => {
            Failure::of_request(&error.at("over"), |key| format!("--{key}"))
        }
        error => error.into(),
    })
}

/// Parses a grid `FIRST,LAST,STEP` in nm.
pub(crate) fn grid(text: &str) -> Result<Grid> {
    let invalid = || {
        Failure::usage(
            format!(
                "--grid takes FIRST,LAST,STEP in nm, LAST a whole number of steps from FIRST, found `{text}`"
            ),
            "try --grid 400,700,10",
        )
    };
    let [first, last, step] = numbers(text).ok_or_else(invalid)?;
    Grid::from_range(first, last, step).map_err(|error| match error {
        GridError::Range { .. } => invalid(),
        error => Failure::usage(format!("--grid {text}: {error}"), "try --grid 400,700,10"),
    })
}

/// Parses exactly N numbers separated by commas.
pub(crate) fn numbers<const N: usize>(text: &str) -> Option<[f64; N]> {
    let numbers: Option<Vec<f64>> = text.split(',').map(|part| part.trim().parse().ok()).collect();
    numbers?.try_into().ok()
}
