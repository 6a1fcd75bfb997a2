//! The options that tell a film's surface.

use clap::{Args, ValueEnum};
use spectra::optics::{Specular, Surface};

use crate::failure::{Failure, Result};

#[derive(Debug, Clone, Copy, ValueEnum)]
enum SpecularName {
    Included,
    Excluded,
}

/// A surface.
#[derive(Debug, Clone, Args)]
pub(crate) struct SurfaceOptions {
    /// Surface reflection as K1,K2, or none [default: 0.03,0.6; where absolute amounts are fitted,
    /// k1 = 0 and the k2 that predicts best]
    #[arg(long, value_name = "K1,K2")]
    saunderson: Option<String>,
    /// Whether the readings hold the mirror reflection
    #[arg(long, value_enum, default_value = "included")]
    specular: SpecularName,
}

impl SurfaceOptions {
    /// `None` if not told.
    pub(crate) fn surface(&self) -> Result<Option<Surface>> {
        let wrong = |text: &str| {
            Failure::usage(
                format!("--saunderson takes K1,K2 or none, found `{text}`"),
                "try --saunderson 0.03,0.6",
            )
        };
        Ok(match self.saunderson.as_deref() {
            None => None,
            Some("none") => Some(Surface::NONE),
            Some(text) => {
                let (k1, k2) = text.split_once(',').ok_or_else(|| wrong(text))?;
                let number = |part: &str| part.trim().parse().map_err(|_| wrong(text));
                Some(Surface::new(number(k1)?, number(k2)?, self.specular())?)
            }
        })
    }

    /// The surface told, else that of most paints.
    pub(crate) fn surface_or_usual(&self) -> Result<Surface> {
        let usual = Surface { k1: 0.03, k2: 0.6, specular: self.specular() };
        Ok(self.surface()?.unwrap_or(usual))
    }

    /// Whether shares of light were told.
    pub(crate) fn given(&self) -> bool {
        self.saunderson.is_some()
    }

    pub(crate) fn specular(&self) -> Specular {
        match self.specular {
            SpecularName::Included => Specular::Included,
            SpecularName::Excluded => Specular::Excluded,
        }
    }
}
