//! Options for the surface reflection of a paint film.

use clap::{Args, ValueEnum};
use spectra::optics::{Specular, Surface};

use crate::failure::{Failure, Result};

#[derive(Debug, Clone, Copy, ValueEnum)]
enum SpecularName {
    Included,
    Excluded,
}

/// Surface reflection of a film: Saunderson's k1 and k2, and whether readings include the specular part.
#[derive(Debug, Clone, Args)]
pub(crate) struct SurfaceOptions {
    /// Surface reflection as K1,K2, or none [default: 0.03,0.6, k1 lower where a reading is; for
    /// absolute amounts k1 = 0 and the k2 that predicts best]
    #[arg(long, value_name = "K1,K2")]
    saunderson: Option<String>,
    /// Whether the readings include the specular reflection
    #[arg(long, value_enum, default_value = "included")]
    specular: SpecularName,
}

impl SurfaceOptions {
    /// Surface given by `--saunderson`; `None` if the option is absent.
    pub(crate) fn surface(&self) -> Result<Option<Surface>> {
        let invalid = |text: &str| {
            Failure::usage(
                format!("--saunderson takes K1,K2 or none, found `{text}`"),
                "try --saunderson 0.03,0.6",
            )
        };
        Ok(match self.saunderson.as_deref() {
            None => None,
            Some("none") => Some(Surface::NONE),
            Some(text) => {
                let (k1, k2) = text.split_once(',').ok_or_else(|| invalid(text))?;
                let number = |part: &str| part.trim().parse().map_err(|_| invalid(text));
                Some(Surface::new(number(k1)?, number(k2)?, self.specular())?)
            }
        })
    }

    /// Surface given by `--saunderson`; if it is absent, that of most paints.
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
