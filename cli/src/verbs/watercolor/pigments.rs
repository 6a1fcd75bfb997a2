//! Calibrated pigments instead of the paper's colour model.

use std::path::PathBuf;

use calibrate::library::PigmentLibrary;
use clap::Args;
use render::light::Light;
use render::paint::document::{Document, Lighting, Slots};
use render::paint::engine::PaintEngine;
use render::paint::ground::{ColorPrimer, Primer};
use render::paint::painting::Painting;
use render::watercolor::{Glazes, Settings, Textures, Wash};

use crate::console::Console;
use crate::ground::ground;
use crate::input::{library, viewing};
use crate::palette::palette;

#[derive(Debug, Args)]
#[command(next_help_heading = "Pigments")]
pub(super) struct PigmentOptions {
    /// Paint with this library: every colour is its best recipe as a glaze over the paper, and
    /// density is how thick it lies
    #[arg(long, value_name = "LIBRARY")]
    pigments: Option<PathBuf>,
    /// Up to eight pigments of the library, separated by commas [default: those that come nearest
    /// to the picture's colours]
    #[arg(long, value_name = "PIGMENTS", value_delimiter = ',', requires = "pigments")]
    palette: Vec<String>,
    /// Reflectance of the paper as measured: 0 to 1, or a file of spectra (FILE#SAMPLE)
    /// [default: one of the setting paper.colour]
    #[arg(long, value_name = "PAPER", requires = "pigments")]
    over: Option<String>,
    /// Light, as other verbs take it: D65, A, FL11, 5600K, a lamp's file
    #[arg(long, value_name = "LIGHT", default_value = "D65", requires = "pigments")]
    illuminant: String,
}

/// Glazes, once they are found.
pub(super) struct Glazing {
    library: PigmentLibrary,
    slots: Option<Slots>,
    paper: Vec<f64>,
    light: Light,
    lighting: Lighting,
    glazes: Option<Glazes>,
}

impl PigmentOptions {
    /// The library's file, if there is one.
    pub(super) fn input(&self) -> Option<&PathBuf> {
        self.pigments.as_ref()
    }

    /// All that glazes take, if they are asked for.
    pub(super) fn glazing(
        &self,
        settings: &Settings,
        console: &mut Console<'_>,
    ) -> anyhow::Result<Option<Glazing>> {
        let Some(path) = &self.pigments else { return Ok(None) };
        let library = library(path)?;
        let slots = match self.palette.is_empty() {
            true => None,
            false => Some(palette(&self.palette, &library)?),
        };
        let paper = match &self.over {
            Some(text) => {
                let (paper, warning) = ground(text, console)?.on_grid(library.grid)?;
                console.remarks(&warning)?;
                paper
            }
            None => {
                let rgb = settings.paper.color.clone();
                Primer::Color(ColorPrimer { rgb }).reflectance(&library)?
            }
        };
        let lighting = Lighting { illuminant: self.illuminant.clone(), ..Lighting::default() };
        let light = Light::new(&library, &viewing(&lighting.illuminant, &lighting.observer)?)?;
        Ok(Some(Glazing { library, slots, paper, light, lighting, glazes: None }))
    }
}

impl Glazing {
    /// The painting of a wash. The first one chooses the pigments, if nobody did.
    pub(super) fn painting(
        &mut self,
        title: &str,
        wash: &Wash,
        textures: &Textures,
        settings: &Settings,
    ) -> anyhow::Result<Painting> {
        let document = self.document(title, wash, textures, settings)?;
        let engine = PaintEngine::on_cpu(document.ground.height.clone());
        Ok(Painting::open_under(document, self.light.clone(), engine, 0)?)
    }

    fn document(
        &mut self,
        title: &str,
        wash: &Wash,
        textures: &Textures,
        settings: &Settings,
    ) -> anyhow::Result<Document> {
        let lighting = self.lighting.clone();
        Ok(self.choose(wash)?.painted(title, wash, textures, settings, lighting)?)
    }

    /// Chooses the pigments by this wash, if that was not done before.
    pub(super) fn choose(&mut self, wash: &Wash) -> anyhow::Result<&Glazes> {
        let Self { library, slots, paper, light, glazes, .. } = self;
        if glazes.is_none() {
            let slots = match slots {
                Some(slots) => *slots,
                None => Glazes::palette(wash, library, paper, light)?,
            };
            *glazes = Some(Glazes::new(library, &slots, paper.clone(), light)?);
        }
        Ok(glazes.as_ref().expect("just found"))
    }

    /// What makes its pictures, beside the wash.
    pub(super) fn wish(&self) -> impl std::fmt::Debug {
        (&self.library, self.slots, &self.paper, &self.lighting, &self.light)
    }

    /// The pigments in use.
    pub(super) fn names(&self) -> Vec<&str> {
        let slots = self.glazes.as_ref().map(|glazes| *glazes.slots()).unwrap_or_default();
        slots.iter().flatten().map(|&i| self.library.pigments[i].name.as_str()).collect()
    }
}
