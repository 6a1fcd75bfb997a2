//! Options for painting with calibrated pigments instead of the colour model of Bousseau et al.
//! (2006).

use std::path::PathBuf;

use clap::Args;
use paint::document::{Document, Lighting};
use paint::engine::PaintEngine;
use paint::light::Light;
use paint::painting::Painting;
use watercolor::{GlazePainter, Settings};

use crate::console::Console;
use crate::failure::Result;
use crate::ground::ground;
use crate::input::{library, viewing};
use crate::palette::palette;

#[derive(Debug, Args)]
#[command(next_help_heading = "Pigments")]
pub(super) struct PigmentOptions {
    /// Paint with this library: every colour is matched by a glaze over the paper, and density
    /// becomes its thickness
    #[arg(value_name = "LIBRARY", group = "library_of_paint")]
    pigments: Option<PathBuf>,
    /// The library, as it was named before
    #[arg(long = "pigments", value_name = "LIBRARY", hide = true, group = "library_of_paint")]
    pigments_before: Option<PathBuf>,
    /// Up to eight pigments of the library, separated by commas [default: those that come nearest
    /// to the picture's colours]
    #[arg(long, value_name = "PIGMENTS", requires = "library_of_paint")]
    palette: Vec<String>,
    /// Reflectance of the paper as measured: 0 to 1, or a file of spectra (FILE#SAMPLE)
    /// [default: computed from the setting paper.colour]
    #[arg(long, value_name = "PAPER", requires = "library_of_paint")]
    over: Option<String>,
    /// Light: D65, A, FL11, 5600K, or the file of a lamp
    #[arg(long, value_name = "LIGHT", default_value = "D65", requires = "library_of_paint")]
    illuminant: String,
}

impl PigmentOptions {
    /// Path of the library, if given.
    pub(super) fn input(&self) -> Option<&PathBuf> {
        self.pigments.as_ref().or(self.pigments_before.as_ref())
    }

    /// Creates the painter of glazes, if a library is given.
    pub(super) fn glaze_painter(
        &self,
        settings: &Settings,
        console: &mut Console<'_>,
    ) -> Result<Option<GlazePainter>> {
        let Some(path) = self.input() else { return Ok(None) };
        let library = library(path)?;
        let palette = match self.palette.is_empty() {
            true => None,
            false => Some(palette(&self.palette, &library)?),
        };
        let paper = match &self.over {
            Some(text) => {
                let (paper, remark) = ground(text, console)?.on_grid(library.grid)?;
                console.remarks(&remark)?;
                paper
            }
            None => GlazePainter::paper_of_settings(settings, &library)?,
        };
        let lighting = Lighting { illuminant: self.illuminant.clone(), ..Lighting::default() };
        let light = Light::new(&library, &viewing(&lighting.illuminant, &lighting.observer)?)?;
        let painter = GlazePainter::new(library, paper, light, lighting);
        Ok(Some(match palette {
            Some(palette) => painter.with_palette(palette),
            None => painter,
        }))
    }
}

/// Opens a painting of glazes under the light that they were matched under.
pub(super) fn open_painting(document: Document, glazes: &GlazePainter) -> Result<Painting> {
    let engine = PaintEngine::on_cpu(document.ground.height.clone());
    Ok(Painting::open_under(document, glazes.light().clone(), engine, 0)?)
}
